// overlays.js - what the library draws as lines and points: contacts, forces, joints, bounds. And the outline of what is picked.
import * as THREE from 'three';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';

// Lines of some pixels, from vertices of fe_world_draw_lines
class Lines {
    constructor(width, through, colour) {
        this.material = new LineMaterial({ linewidth: width, vertexColors: colour === undefined, color: colour ?? 0xffffff, depthTest: !through, depthWrite: false, transparent: true });
        this.object = new LineSegments2(new LineSegmentsGeometry(), this.material);
        this.object.frustumCulled = false, this.object.renderOrder = through ? 5 : 2, this.object.visible = false;
        this.room = 0;
    }
    set({ count, stride, floats, words }) {
        const n = count >> 1;
        this.object.visible = n > 0;
        if (n > this.room) this.#grow(Math.ceil(1.5 * n));
        const { places, colours } = this;
        for (let k = 0; k < 2 * n; ++k) {
            const from = k * stride, to = 3 * k, rgba = words[from + 3];
            places.array[to] = floats[from], places.array[to + 1] = floats[from + 1], places.array[to + 2] = floats[from + 2];
            if (colours) colours.array[to] = srgb(rgba & 255), colours.array[to + 1] = srgb((rgba >> 8) & 255), colours.array[to + 2] = srgb((rgba >> 16) & 255);
        }
        if (!n) return;
        places.needsUpdate = true;
        if (colours) colours.needsUpdate = true;
        this.object.geometry.instanceCount = n;
    }
    #grow(room) {
        this.object.geometry.dispose();
        const g = this.object.geometry = new LineSegmentsGeometry(), buffer = () => new THREE.InstancedInterleavedBuffer(new Float32Array(6 * room), 6, 1).setUsage(THREE.DynamicDrawUsage);
        const both = (name, data) => g.setAttribute(`instance${name}Start`, new THREE.InterleavedBufferAttribute(data, 3, 0)).setAttribute(`instance${name}End`, new THREE.InterleavedBufferAttribute(data, 3, 3));
        both('', (this.places = buffer()));
        this.colours = this.material.vertexColors ? buffer() : null;
        if (this.colours) both('Color', this.colours);
        this.room = room;
    }
}
const srgb = (byte) => { const c = byte / 255; return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; };

function disc() {
    const c = document.createElement('canvas'), size = (c.width = c.height = 64), g = c.getContext('2d');
    g.fillStyle = '#fff', g.beginPath(), g.arc(size / 2, size / 2, size / 2 - 3, 0, 7), g.fill();
    return new THREE.CanvasTexture(c);
}
class Points {
    constructor() {
        this.object = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ size: 8, sizeAttenuation: false, vertexColors: true, map: disc(), alphaTest: 0.4, depthTest: false, transparent: true }));
        this.object.frustumCulled = false, this.object.renderOrder = 6, this.object.visible = false, this.room = 0;
    }
    set({ count, stride, floats, words }) {
        this.object.visible = count > 0;
        if (count > this.room) {
            this.room = Math.ceil(1.5 * count);
            this.object.geometry.dispose();
            this.object.geometry = new THREE.BufferGeometry();
            for (const name of ['position', 'color']) this.object.geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * this.room), 3).setUsage(THREE.DynamicDrawUsage));
        }
        if (!count) return;
        const { position, color } = this.object.geometry.attributes;
        for (let k = 0; k < count; ++k) {
            const from = k * stride, rgba = words[from + 3];
            position.setXYZ(k, floats[from], floats[from + 1], floats[from + 2]);
            color.setXYZ(k, srgb(rgba & 255), srgb((rgba >> 8) & 255), srgb((rgba >> 16) & 255));
        }
        position.needsUpdate = color.needsUpdate = true;
        this.object.geometry.setDrawRange(0, count);
    }
}

const MOST_OUTLINE = 1200; // vertices: of a heightfield or a mesh the box around it is drawn instead

// Parts that are seen through bodies, and those that are not
const THROUGH = ['contacts', 'forces', 'joints', 'limits', 'centres'], SOLID = ['bounds', 'trees'];

export class Overlays {
    constructor(scene) {
        this.through = new Lines(1.8, true), this.solid = new Lines(1.1, false), this.points = new Points();
        this.outline = new Lines(2.4, true, 0xffffff);
        this.frame = new THREE.Group(), this.frame.matrixAutoUpdate = false;
        this.frame.add(this.outline.object);
        scene.add(this.through.object, this.solid.object, this.points.object, this.frame);
    }
    clear() { for (const lines of [this.through, this.solid, this.points, this.outline]) lines.set({ count: 0 }); }
    // After a step: `parts` is a set of names, `only` a body or nothing
    take(world, origin, parts, scale) {
        const draw = (names) => names.filter((name) => parts.has(name)), none = { count: 0 };
        const [over, under] = [draw(THROUGH), draw(SOLID)], points = over.filter((p) => p === 'contacts' || p === 'joints' || p === 'centres');
        this.through.set(over.length ? world.drawLines({ origin, parts: over, scale }) : none);
        this.solid.set(under.length ? world.drawLines({ origin, parts: under, scale }) : none);
        this.points.set(points.length ? world.drawPoints({ origin, parts: points, scale }) : none);
    }
    // The outline of a body as it is after the step; `follow` then carries it to where the body is drawn
    pick(world, origin, body, colour) {
        let lines = body ? world.drawLines({ origin, parts: ['shapes'], only: body, segments: 40 }) : { count: 0 };
        if (lines.count > MOST_OUTLINE) lines = world.drawLines({ origin, parts: ['bounds'], only: body });
        this.outline.set(lines);
        this.outline.material.color.set(colour);
    }
    follow(instances, body) {
        const k = instances.instancesOf(body)[0];
        if (k === undefined) return;
        instances.matrixOf(k, drawn), drawn.decompose(p, q, s);
        instances.poseOf(k, p0, q0);
        this.frame.matrix.compose(p, q, ONE).multiply(drawn.compose(p0, q0, ONE).invert());
        this.frame.matrixWorldNeedsUpdate = true;
    }
}
const drawn = new THREE.Matrix4(), p = new THREE.Vector3(), s = new THREE.Vector3(), q = new THREE.Quaternion(), p0 = new THREE.Vector3(), q0 = new THREE.Quaternion(), ONE = new THREE.Vector3(1, 1, 1);
