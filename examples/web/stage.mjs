// What the scenes share: what is seen, the mouse as a hand, and frames.
import * as THREE from 'three';
import { BodyInstances, rayOf } from 'feather-physics/three';

export const STEP = 1 / 60; // s
export { THREE };

export class Stage {
    #drawn = [];
    #grip = null;
    #turning = false;
    #view = { round: 0, up: 0.35, far: 0 };
    // Called before each step
    onStep = () => {};
    // @param height  of what the camera looks at, m;  @param far  how far away it is, m;
    // @param round  from which side it looks, rad
    constructor(world, { height = 4, far = 27, round = 0.7 } = {}) {
        this.world = world, this.target = new THREE.Vector3(0, height, 0);
        this.#view.far = far, this.#view.round = round;
        this.renderer = new THREE.WebGLRenderer({ antialias: true });
        this.renderer.shadowMap.enabled = true;
        document.body.append(this.renderer.domElement);
        this.scene = new THREE.Scene(), this.camera = new THREE.PerspectiveCamera(50, 1, 0.1, 500);
        this.scene.background = new THREE.Color(0x20242b);
        this.scene.add(new THREE.HemisphereLight(0xcfe2ff, 0x403830, 1.6));
        this.sun = new THREE.DirectionalLight(0xffffff, 2.2);
        this.sun.castShadow = true, this.sun.shadow.mapSize.set(2048, 2048);
        Object.assign(this.sun.shadow.camera, { left: -25, right: 25, top: 25, bottom: -25, far: 90 });
        this.scene.add(this.sun, this.sun.target);
        const grey = new THREE.MeshStandardMaterial({ color: 0x4a5059 });
        this.ground = new THREE.Mesh(new THREE.PlaneGeometry(400, 400), grey);
        this.ground.rotation.x = -Math.PI / 2, this.ground.receiveShadow = true;
        this.scene.add(this.ground);
        addEventListener('resize', () => this.#resize());
        addEventListener('pointerdown', (e) => this.#press(e));
        addEventListener('pointermove', (e) => this.#move(e));
        addEventListener('pointerup', () => this.#release());
        this.#resize();
    }
    // Bodies of one form, drawn together. `scales`: 3 numbers a body, or 3 for all
    add(geometry, bodies, colour, scales) {
        const surface = new THREE.MeshStandardMaterial({ roughness: 0.6 });
        const mesh = new THREE.InstancedMesh(geometry, surface, bodies.length);
        bodies.forEach((_, k) => mesh.setColorAt(k, colour(k)));
        mesh.castShadow = mesh.receiveShadow = true, mesh.frustumCulled = false;
        this.scene.add(mesh);
        this.#drawn.push(new BodyInstances(mesh, this.world, bodies, scales));
    }

    // ---- the hand: a spring from a point of a body to the place under the pointer, as far away as it was gripped ----
    #ray({ clientX, clientY }) {
        return rayOf(this.camera, (clientX / innerWidth) * 2 - 1, 1 - (clientY / innerHeight) * 2);
    }
    #press(e) {
        if (e.target !== this.renderer.domElement) return;
        const { world } = this, hit = world.raycast(...this.#ray(e)), body = hit && world.body(hit.body);
        this.#turning = body?.type !== 'dynamic';
        if (this.#turning) return;
        const hand = world.createBody({ type: 'kinematic', position: hit.point });
        world.addMotorJoint(hand, body, 4, 1, 400 * body.mass, 40 * body.mass);
        this.#grip = { hand, far: hit.fraction };
    }
    #move(e) {
        if (this.#grip) {
            const [from, to] = this.#ray(e);
            this.#grip.hand.setTarget({ position: from.addScaledVector(to, this.#grip.far) }, STEP);
        } else if (this.#turning && e.buttons) {
            this.#view.round -= e.movementX / 200;
            this.#view.up = Math.min(1.4, Math.max(0.05, this.#view.up + e.movementY / 200));
        }
    }
    #release() {
        this.#grip?.hand.destroy(); // its joint goes with it
        this.#grip = null;
    }

    // ---- the view ----
    #resize() {
        this.renderer.setSize(innerWidth, innerHeight);
        this.camera.aspect = innerWidth / innerHeight, this.camera.updateProjectionMatrix();
    }
    #look() {
        const { round, up, far } = this.#view, { x, y, z } = this.target, level = far * Math.cos(up);
        this.camera.position.set(x + level * Math.sin(round), y + far * Math.sin(up), z + level * Math.cos(round));
        this.camera.lookAt(this.target);
        this.sun.position.set(x - 18, y + 30, z + 22), this.sun.target.position.copy(this.target);
    }

    // ---- frames: steps of equal length, and the last of them drawn as far as its time has come ----
    run() {
        globalThis.stage = this; // for the console
        const { world } = this, told = document.querySelector('#told');
        let last = performance.now(), owed = 0, spent = 0, steps = 0;
        const step = () => {
            this.onStep();
            const start = performance.now();
            world.step(STEP);
            const moved = world.getMoved();
            spent += performance.now() - start;
            if (this.#grip) this.#grip.hand.linearVelocity = [0, 0, 0]; // until the pointer moves again
            for (const each of this.#drawn) each.keep(moved);
            if (++steps % 30 !== 0) return;
            const { awakeBodies, contacts } = world.counters;
            told.textContent = `${(spent / 30).toFixed(2)} ms a step, ${awakeBodies} awake, ${contacts} contacts
hash ${world.hash} after ${steps} steps`;
            spent = 0;
        };
        const frame = (now) => {
            owed = Math.min(owed + (now - last) / 1000, 4 * STEP), last = now;
            for (; owed >= STEP; owed -= STEP) step();
            for (const each of this.#drawn) each.draw(owed / STEP);
            this.#look();
            this.renderer.render(this.scene, this.camera);
            requestAnimationFrame(frame);
        };
        requestAnimationFrame(frame);
    }
}
