// scene.js - renderer, camera, light, shadow. Everything is drawn relative to `origin`, near which the camera stays, so that
// worlds far from their zero are as sharp as others.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { ground } from './materials.js';

const LOOKS = {
    dark: { sky: 0x1b1f25, horizon: 0x2b3038, ground: 0x343a43, grid: 0x5a636f, fill: [0xdbe4f2, 0x4a453f, 1.7], sun: 2.2 },
    light: { sky: 0xdfe6ee, horizon: 0xeef2f6, ground: 0xe3e7ec, grid: 0xb4bcc6, fill: [0xffffff, 0xc4bfb6, 2.1], sun: 1.9 },
};
const SUN = new THREE.Vector3(-0.45, 0.8, 0.4).normalize(), SHADOW = 2048; // texels
const FAR_FROM_ORIGIN = 2000; // m, beyond which the origin follows the camera

export class View {
    constructor(canvas) {
        this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance', preserveDrawingBuffer: false });
        this.renderer.shadowMap.enabled = true, this.renderer.shadowMap.type = THREE.PCFShadowMap;
        this.renderer.toneMapping = THREE.NeutralToneMapping;
        this.scene = new THREE.Scene();
        this.camera = new THREE.PerspectiveCamera(42, 1, 0.05, 4000);
        this.camera.position.set(14, 8, 18);
        this.controls = new OrbitControls(this.camera, canvas);
        Object.assign(this.controls, { enableDamping: true, dampingFactor: 0.12, zoomToCursor: true, minDistance: 0.1, maxDistance: 3000, maxPolarAngle: Math.PI * 0.98 });
        this.fill = new THREE.HemisphereLight(0xffffff, 0x888888, 1);
        this.sun = new THREE.DirectionalLight(0xfff4e2, 2.4);
        this.sun.castShadow = true, this.sun.shadow.mapSize.set(SHADOW, SHADOW), this.sun.shadow.bias = -0.0003, this.sun.shadow.normalBias = 0.02, this.sun.shadow.radius = 2.5;
        this.scene.add(this.fill, this.sun, this.sun.target);
        this.origin = [0, 0, 0], this.dirty = true, this.range = 40;
        this.sky = this.#sky();
        this.look('dark');
        const resize = () => this.resize();
        addEventListener('resize', resize), resize();
        this.controls.addEventListener('change', () => (this.dirty = true));
    }
    #sky() {
        const sky = new THREE.Mesh(new THREE.SphereGeometry(1, 24, 16), new THREE.ShaderMaterial({
            side: THREE.BackSide, depthWrite: false, depthTest: false, uniforms: { up: { value: new THREE.Color() }, level: { value: new THREE.Color() } },
            vertexShader: 'varying vec3 v; void main() { v = position; vec4 p = projectionMatrix * mat4(mat3(viewMatrix)) * vec4(position, 1.0); gl_Position = p.xyww; }',
            fragmentShader: 'varying vec3 v; uniform vec3 up, level; void main() { float y = normalize(v).y; gl_FragColor = vec4(mix(level, up, smoothstep(0.0, 0.55, abs(y))), 1.0);\n#include <colorspace_fragment>\n}',
        }));
        sky.frustumCulled = false, sky.renderOrder = -2;
        this.scene.add(sky);
        return sky;
    }
    look(name) {
        const look = LOOKS[name], [up, down, strength] = look.fill;
        this.sky.material.uniforms.up.value.set(look.sky), this.sky.material.uniforms.level.value.set(look.horizon);
        ground.uGround.value.set(look.ground), ground.uGrid.value.set(look.grid);
        this.fill.color.set(up), this.fill.groundColor.set(down), this.fill.intensity = strength, this.sun.intensity = look.sun;
        this.dirty = true;
    }
    resize() {
        const { clientWidth: w, clientHeight: h } = this.renderer.domElement;
        if (!w || !h) return;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.renderer.setSize(w, h, false);
        this.camera.aspect = w / h, this.camera.updateProjectionMatrix();
        this.width = w, this.height = h, this.centre(...(this.free ?? [0, 0, w, h]));
    }
    // What the camera looks at lies in the middle of what panels leave free: left, top, right, bottom
    centre(left, top, right, bottom) {
        this.free = [left, top, right, bottom];
        this.camera.setViewOffset(this.width, this.height, (this.width - left - right) / 2, (this.height - top - bottom) / 2, this.width, this.height);
        this.dirty = true;
    }
    // The box into the picture, from where the camera looks now
    frame(box, near = 1) {
        if (box.isEmpty()) return;
        const centre = box.getCenter(new THREE.Vector3()), radius = Math.max(box.getSize(new THREE.Vector3()).length() / 2, 0.05);
        const half = THREE.MathUtils.degToRad(this.camera.fov / 2), [left, top, right, bottom] = this.free;
        const narrow = Math.min(bottom - top, right - left) / this.height; // of the height, what is free
        const away = this.camera.position.clone().sub(this.controls.target).setLength((0.92 * near * radius) / Math.sin(half) / Math.max(narrow, 0.1));
        this.controls.target.copy(centre), this.camera.position.copy(centre).add(away);
        this.controls.update(), this.dirty = true;
    }
    direct(x, y, z) { // looks from there at the target
        const far = this.camera.position.distanceTo(this.controls.target);
        this.camera.position.copy(this.controls.target).addScaledVector(new THREE.Vector3(x, y, z).normalize(), far);
        this.controls.update(), this.dirty = true;
    }
    // True when the origin moved: all is to be taken anew
    rebase() {
        const t = this.controls.target;
        if (t.length() < FAR_FROM_ORIGIN) return false;
        // in tens, so that the grid of planes stays where it is
        const by = [t.x, t.y, t.z].map((v) => 10 * Math.round(v / 10));
        this.origin = this.origin.map((o, k) => o + by[k]);
        const shift = new THREE.Vector3(...by);
        this.camera.position.sub(shift), t.sub(shift);
        return true;
    }
    // Origin and translation of the ray under a place of the page, world space
    ray(x, y, length = 5000) {
        this.camera.updateMatrixWorld();
        const from = this.camera.position, to = new THREE.Vector3((x / this.width) * 2 - 1, 1 - (y / this.height) * 2, 0.5).unproject(this.camera).sub(from).setLength(length);
        return [[0, 1, 2].map((k) => this.origin[k] + from.getComponent(k)), to.toArray()];
    }
    // Where a point of the world is on the page
    project(point) {
        const p = new THREE.Vector3(point.x - this.origin[0], point.y - this.origin[1], point.z - this.origin[2]).project(this.camera);
        return { x: ((p.x + 1) / 2) * this.width, y: ((1 - p.y) / 2) * this.height, ahead: p.z < 1 };
    }
    render() {
        const { camera, controls, sun } = this, far = camera.position.distanceTo(controls.target), reach = Math.min(Math.max(far * 0.9, 2), Math.max(1.5 * this.range, 6));
        camera.near = Math.max(far / 400, 0.01), camera.far = Math.max(far * 60, 1500), camera.updateProjectionMatrix();
        const texel = (2 * reach) / SHADOW, snap = (v) => Math.round(v / (16 * texel)) * 16 * texel;
        sun.target.position.set(snap(controls.target.x), snap(controls.target.y), snap(controls.target.z));
        sun.position.copy(sun.target.position).addScaledVector(SUN, 3 * reach);
        const s = sun.shadow.camera;
        if (s.right !== reach) s.left = s.bottom = -reach, s.right = s.top = reach, s.near = 0.1, s.far = 6 * reach, s.updateProjectionMatrix();
        ground.uEye.value.copy(camera.position), ground.uFar.value = Math.max(60, far * 9);
        this.renderer.render(this.scene, camera);
        this.dirty = false;
    }
}
