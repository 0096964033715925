// instances.js - all shapes of a world as a few InstancedMeshes: one a form, and one more for what is see-through.
//
// `take` copies what the world draws after a step; `draw` writes the matrices of what moved, between the step before
// and this one, straight into the meshes' arrays.
import * as THREE from 'three';
import { instanceType } from 'feather-physics/module';
import { formOf, isBuilt } from './forms.js';
import { materialOf, depthOf } from './materials.js';
import { SLOT } from './series.js';

// Of fe_draw_instance, in words
const TYPE = 0, RGBA = 1, SHAPE = 2, BODY = 4, ASSET = 6, POSE = 8;
const RGB = 0xffffff, STATIC = 154 | (160 << 8) | (166 << 16); // of the library's table
const FLOATS = 10; // position, rotation, half extents
const PLANE = 4000; // m, half of what is drawn of a plane; it fades before
const TINTS = 5, TINT = 0.05; // bodies of one hue differ by as many shades
const linear = Float32Array.from({ length: 256 }, (_, k) => (k / 255 <= 0.04045 ? k / 255 / 12.92 : ((k / 255 + 0.055) / 1.055) ** 2.4));

class Bucket {
    constructor(geometry, kind, see) {
        this.kind = kind, this.see = see, this.geometry = geometry, this.count = 0, this.room = 0, this.mesh = null;
    }
    // Room for n instances; what was there is kept
    need(n, group) {
        if (n <= this.room) return;
        const room = Math.max(n, 2 * this.room, 8), old = this.mesh, g = this.geometry;
        const mesh = new THREE.InstancedMesh(g, materialOf(this.kind, this.see), room);
        mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
        mesh.instanceColor = new THREE.InstancedBufferAttribute(new Float32Array(3 * room), 3);
        if (this.kind === 'capsule') {
            const ratio = new THREE.InstancedBufferAttribute(new Float32Array(room), 1);
            if (old) ratio.array.set(g.attributes.ratio.array);
            g.setAttribute('ratio', ratio);
            mesh.customDepthMaterial = depthOf('capsule');
        }
        if (old) mesh.instanceMatrix.array.set(old.instanceMatrix.array), mesh.instanceColor.array.set(old.instanceColor.array), group.remove(old), old.dispose();
        mesh.castShadow = this.kind !== 'plane' && !this.see, mesh.receiveShadow = true;
        mesh.frustumCulled = false, mesh.renderOrder = this.see ? 1 : 0;
        group.add(mesh);
        this.mesh = mesh, this.room = room;
    }
    end(group) {
        if (this.mesh) group.remove(this.mesh), this.mesh.dispose();
        this.geometry.dispose();
    }
}

export class Instances {
    #names = []; // of forms
    // `ghost`: all in this colour, see-through, without what is static
    constructor(ghost = 0) {
        this.ghost = ghost;
        this.group = new THREE.Group();
        this.clear();
    }
    typeOf(number) { return (this.#names[number] ??= instanceType({ words: [number], stride: 1 }, 0)); }
    clear() {
        for (const bucket of this.buckets?.values() ?? []) bucket.end(this.group);
        this.buckets = new Map(), this.count = 0, this.ids = new Uint32Array(0), this.now = this.before = new Float32Array(0);
        this.colours = new Uint32Array(0), this.slots = new Int32Array(0), this.bucketOf = [], this.moving = new Uint8Array(0);
        this.slotOf = new Map(); // body's handle: its instances
        this.fresh = true, this.room = 0;
    }
    // After a step, or a jump: `follows` says that what was there lies one step back
    take(world, origin, parts, follows) {
        const { count, stride, floats, words } = world.drawInstances({ origin, parts });
        if (count > this.room || !this.room) this.#grow(count);
        [this.now, this.before] = [this.before, this.now];
        const { now, ids, colours } = this;
        let same = count === this.count && !this.fresh;
        for (let k = 0; k < count; ++k) {
            const from = k * stride, id = 7 * k;
            for (let j = 0; j < 2; ++j) {
                if (ids[id + j] !== words[from + SHAPE + j]) same = false, ids[id + j] = words[from + SHAPE + j];
                ids[id + 2 + j] = words[from + BODY + j];
                if (ids[id + 4 + j] !== words[from + ASSET + j]) same = false, ids[id + 4 + j] = words[from + ASSET + j];
            }
            const rgba = this.ghost && (words[from + RGBA] & RGB) !== STATIC ? this.ghost : words[from + RGBA];
            if (ids[id + 6] !== words[from + TYPE] || colours[k] >>> 24 !== rgba >>> 24) same = false, ids[id + 6] = words[from + TYPE];
            for (let j = 0; j < FLOATS; ++j) now[FLOATS * k + j] = floats[from + POSE + j];
            if (colours[k] !== rgba) colours[k] = rgba, this.moving[k] |= 2;
        }
        this.count = count;
        if (!same) this.#place(world, origin);
        if (!same || !follows) this.before.set(now.subarray(0, FLOATS * count)), this.moving.fill(3, 0, count);
        else {
            const { before, moving } = this;
            for (let k = 0; k < count; ++k) {
                for (let j = FLOATS * k, end = j + FLOATS; j < end; ++j) if (now[j] !== before[j]) { moving[k] |= 1; break; }
            }
        }
        this.fresh = false, this.changed = true;
    }
    #grow(count) {
        const room = this.room = Math.max(64, Math.ceil(1.5 * count));
        const more = (array, type, n) => { const out = new type(n); out.set(array.subarray(0, Math.min(n, array.length))); return out; };
        this.now = more(this.now, Float32Array, FLOATS * room), this.before = more(this.before, Float32Array, FLOATS * room);
        this.ids = more(this.ids, Uint32Array, 7 * room), this.colours = more(this.colours, Uint32Array, room);
        this.slots = more(this.slots, Int32Array, room), this.moving = more(this.moving, Uint8Array, room);
    }
    // Each instance its place in a bucket
    #place(world, origin) {
        for (const bucket of this.buckets.values()) bucket.count = 0;
        this.bucketOf.length = this.count;
        this.slotOf.clear();
        for (let k = 0; k < this.count; ++k) {
            const type = this.typeOf(this.ids[7 * k + 6]), see = this.colours[k] >>> 24 < 255;
            const asset = isBuilt(type) ? '' : `${this.ids[7 * k + 4]},${this.ids[7 * k + 5]}`, key = type + asset + (see ? '*' : '');
            let bucket = this.buckets.get(key);
            if (!bucket) this.buckets.set(key, bucket = new Bucket(this.#form(world, origin, k, type), type, see));
            this.bucketOf[k] = bucket, this.slots[k] = bucket.count++;
            const body = this.bodyAt(k), list = this.slotOf.get(body);
            if (list) list.push(k); else this.slotOf.set(body, [k]);
        }
        for (const bucket of this.buckets.values()) {
            bucket.need(bucket.count, this.group);
            if (bucket.mesh) bucket.mesh.count = bucket.count, bucket.mesh.visible = bucket.count > 0 && !(this.ghost && !bucket.see);
        }
    }
    #form(world, origin, k, type) {
        const p = this.now, i = FLOATS * k, place = { origin, position: new THREE.Vector3(p[i], p[i + 1], p[i + 2]),
            rotation: new THREE.Quaternion(p[i + 3], p[i + 4], p[i + 5], p[i + 6]), scale: new THREE.Vector3(p[i + 7], p[i + 8], p[i + 9]) };
        return formOf(world, { type, asset: this.handleAt(k, 4), shape: this.handleAt(k, 0), body: this.bodyAt(k), count: this.count }, place);
    }
    handleAt(k, j) { return this.ids[7 * k + j] + this.ids[7 * k + j + 1] * 4294967296; }
    bodyAt(k) { return this.handleAt(k, 2); }
    instancesOf(body) { return this.slotOf.get(body) ?? []; }
    colourOf(body) { const k = this.instancesOf(body)[0]; return k === undefined ? 0 : this.colours[k]; }

    // Where an instance was drawn last
    matrixOf(k, out) { return out.fromArray(this.bucketOf[k].mesh.instanceMatrix.array, 16 * this.slots[k]); }
    // Pose of an instance after the step, without its size
    poseOf(k, position, rotation) {
        const i = FLOATS * k, n = this.now;
        position.set(n[i], n[i + 1], n[i + 2]), rotation.set(n[i + 3], n[i + 4], n[i + 5], n[i + 6]);
    }
    // What differs between two steps is drawn at `part` of the way, 0..1
    draw(part) {
        if (!this.changed) return;
        const { now, before, moving, slots, bucketOf, colours } = this;
        let still = true;
        for (let k = 0; k < this.count; ++k) {
            const state = moving[k];
            if (!state) continue;
            const bucket = bucketOf[k], { mesh } = bucket;
            if (state & 2) this.#colour(mesh, slots[k], colours[k], k, bucket.kind);
            const moves = this.#matrix(mesh.instanceMatrix.array, 16 * slots[k], before, now, FLOATS * k, part, bucket);
            mesh.instanceMatrix.needsUpdate = true;
            moving[k] = moves && part < 1 ? 1 : 0;
            if (moves && part < 1) still = false;
        }
        if (still) this.changed = false;
    }
    #colour(mesh, slot, rgba, k, kind) {
        const body = this.ids[7 * k + 2] % SLOT, shade = kind === 'plane' ? 1 : 1 + TINT * ((body * 2) % TINTS - (TINTS >> 1)), c = mesh.instanceColor;
        c.array[3 * slot] = linear[rgba & 255] * shade, c.array[3 * slot + 1] = linear[(rgba >> 8) & 255] * shade, c.array[3 * slot + 2] = linear[(rgba >> 16) & 255] * shade;
        c.needsUpdate = true;
    }
    #matrix(out, o, before, now, i, part, bucket) {
        let moves = false, dot = 0;
        for (let j = i; j < i + 7; ++j) if (before[j] !== now[j]) { moves = true; break; }
        for (let j = i + 3; j < i + 7; ++j) dot += before[j] * now[j];
        const a = moves ? 1 - part : 0, b = 1 - a, turn = dot < 0 ? -a : a; // the shorter way round
        let x = turn * before[i + 3] + b * now[i + 3], y = turn * before[i + 4] + b * now[i + 4];
        let z = turn * before[i + 5] + b * now[i + 5], w = turn * before[i + 6] + b * now[i + 6];
        const r = 1 / Math.sqrt(x * x + y * y + z * z + w * w);
        x *= r, y *= r, z *= r, w *= r;
        const isPlane = bucket.kind === 'plane', sx = isPlane ? PLANE : now[i + 7], sz = isPlane ? PLANE : now[i + 9];
        let sy = now[i + 8];
        if (bucket.kind === 'capsule') {
            const ratio = bucket.geometry.attributes.ratio, at = (o / 16) | 0, value = sy / sx;
            if (ratio.array[at] !== value) ratio.array[at] = value, ratio.needsUpdate = true;
            sy = sx;
        } else if (isPlane) sy = 1;
        out[o] = (1 - 2 * (y * y + z * z)) * sx, out[o + 1] = 2 * (x * y + z * w) * sx, out[o + 2] = 2 * (x * z - y * w) * sx, out[o + 3] = 0;
        out[o + 4] = 2 * (x * y - z * w) * sy, out[o + 5] = (1 - 2 * (x * x + z * z)) * sy, out[o + 6] = 2 * (y * z + x * w) * sy, out[o + 7] = 0;
        out[o + 8] = 2 * (x * z + y * w) * sz, out[o + 9] = 2 * (y * z - x * w) * sz, out[o + 10] = (1 - 2 * (x * x + y * y)) * sz, out[o + 11] = 0;
        out[o + 12] = a * before[i] + b * now[i], out[o + 13] = a * before[i + 1] + b * now[i + 1], out[o + 14] = a * before[i + 2] + b * now[i + 2], out[o + 15] = 1;
        return moves;
    }

    // The box around all but planes and what is far larger than the rest; dynamic bodies count before static ones
    bounds(body) {
        const box = new THREE.Box3(), dynamic = new THREE.Box3(), p = new THREE.Vector3(), { now, colours } = this;
        for (let k = 0; k < this.count; ++k) {
            if (body !== undefined && this.bodyAt(k) !== body) continue;
            const type = this.typeOf(this.ids[7 * k + 6]), i = FLOATS * k;
            if (type === 'plane') continue;
            p.set(now[i], now[i + 1], now[i + 2]);
            const own = isBuilt(type) ? Math.hypot(now[i + 7], now[i + 8], now[i + 9]) : this.#radius(this.bucketOf[k]);
            for (const b of (colours[k] & RGB) === STATIC ? [box] : [box, dynamic]) b.expandByPoint(p.clone().addScalar(own)), b.expandByPoint(p.clone().addScalar(-own));
        }
        return dynamic.isEmpty() ? box : dynamic;
    }
    #radius(bucket) {
        if (!bucket.geometry.boundingSphere) bucket.geometry.computeBoundingSphere();
        return bucket.geometry.boundingSphere.radius;
    }
}
