// A car on hills, with boxes to run into. Arrow keys or WASD drive, space brakes, R sets it back on its wheels.
import Feather from 'feather-physics';
import { Stage, THREE } from './stage.mjs';

const SAMPLES = 97, CELL = 2, RADIUS = 0.4, SPEED = 18, TORQUE = 900; // m, m, m, m/s, N m of a wheel
const SPIN = 3, STEER = 5; // axes of a configurable joint: angular X, angular Z
const { World } = await Feather();
const world = new World({ substeps: 4 });

// ---- hills ----
const half = ((SAMPLES - 1) * CELL) / 2;
const height = (x, z) => {
    const far = Math.max(0, Math.hypot(x, z) - 12); // flat where it starts
    return Math.min(1, far / 30) * (2.2 * Math.sin(x / 9) * Math.cos(z / 11) + 0.8 * Math.sin(x / 4 + z / 5));
};
const heights = new Float32Array(SAMPLES * SAMPLES);
for (let k = 0; k < heights.length; ++k) {
    heights[k] = height((k % SAMPLES) * CELL - half, Math.floor(k / SAMPLES) * CELL - half); // row by row
}
const field = world.createHeightfield({ rows: SAMPLES, columns: SAMPLES, cellX: CELL, cellZ: CELL, heights });
world.createBody({ type: 'static' }).createShape(field, { position: [-half, 0, -half], friction: 0.9 });

// ---- boxes ----
const boxes = [];
for (let k = 0; k < 60; ++k) {
    const at = [k % 4, Math.floor(k / 20), (Math.floor(k / 4) % 5) - 2];
    const box = world.createBody({ position: [14 + 0.82 * at[0], 0.45 + 0.82 * at[1], 0.82 * at[2]] });
    box.addBox(0.4, 0.4, 0.4, { density: 60 });
    boxes.push(box);
}

// ---- the car: it drives towards x ----
const START = [0, 1.1, 0];
const chassis = world.createBody({ position: START, sleepThreshold: 0 }), wheels = [], axles = [];
chassis.addBox(1.8, 0.3, 0.8, { density: 350 });
for (const [along, aside] of [[1.3, -0.9], [1.3, 0.9], [-1.3, -0.9], [-1.3, 0.9]]) {
    const at = [START[0] + along, START[1] - 0.3, START[2] + aside], wheel = world.createBody({ position: at });
    wheel.addSphere(RADIUS, { density: 75, friction: 1.5 });
    const axle = world.addWheelJoint(chassis, wheel, at, [0, 0, -1], [0, 1, 0], 2, 0.7, 0.25); // axle x up is x
    if (along > 0) {
        const { axes } = axle.configurable;
        Object.assign(axes[STEER], { motion: 'limited', lower: -0.6, upper: 0.6 });
        Object.assign(axes[STEER], { spring: 'hertz', springHertz: 10, springDampingRatio: 1 });
        axle.configurable = { axes };
    }
    wheels.push(wheel), axles.push(axle);
}
const keys = new Set(), held = (...names) => names.some((name) => keys.has(name));
addEventListener('keydown', (e) => {
    keys.add(e.code);
    if (e.code === 'KeyR') setBack();
    if (/Arrow|Space/.test(e.code)) e.preventDefault();
});
addEventListener('keyup', (e) => keys.delete(e.code));
function setBack() {
    const { x, z } = chassis.position, y = height(x, z) + 1.2;
    const moved = [[chassis, [0, 0, 0]], ...wheels.map((w, k) => [w, [k < 2 ? 1.3 : -1.3, -0.3, k % 2 ? 0.9 : -0.9]])];
    for (const [body, by] of moved) {
        body.transform = { position: [x + by[0], y + by[1], z + by[2]], rotation: [0, 0, 0, 1] };
        body.linearVelocity = body.angularVelocity = [0, 0, 0];
    }
}
let steer = 0;
function drive() {
    const forward = held('ArrowUp', 'KeyW') - held('ArrowDown', 'KeyS');
    const turn = held('ArrowLeft', 'KeyA') - held('ArrowRight', 'KeyD');
    const brakes = held('Space');
    steer += (0.5 * turn - steer) * 0.12;
    axles.forEach((axle, k) => {
        const { axes } = axle.configurable, drives = forward !== 0 && k >= 2;
        axes[SPIN].motorSpeed = brakes ? 0 : (forward * SPEED) / RADIUS;
        axes[SPIN].motorMax = brakes ? 1500 : drives ? TORQUE : 20; // N m; what rolls is slowed by 20
        if (!brakes && !drives) axes[SPIN].motorSpeed = 0;
        if (k < 2) axes[STEER].target = steer;
        axle.configurable = { axes };
    });
}

// ---- what is seen ----
const stage = new Stage(world, { far: 14, round: -1.1 });
stage.ground.visible = false;
const land = new THREE.PlaneGeometry(2 * half, 2 * half, SAMPLES - 1, SAMPLES - 1);
land.rotateX(-Math.PI / 2);
const places = land.attributes.position;
for (let k = 0; k < places.count; ++k) places.setY(k, height(places.getX(k), places.getZ(k)));
land.computeVertexNormals();
const hills = new THREE.Mesh(land, new THREE.MeshStandardMaterial({ color: 0x5b6b52, flatShading: true }));
hills.receiveShadow = true;
stage.scene.add(hills);
stage.add(new THREE.BoxGeometry(3.6, 0.6, 1.6), [chassis], () => new THREE.Color(0xc0392b));
const tyre = new THREE.CylinderGeometry(RADIUS, RADIUS, 0.3, 24);
tyre.rotateX(Math.PI / 2);
stage.add(tyre, wheels, () => new THREE.Color(0x24262a));
const wood = (k) => new THREE.Color().setHSL(0.09 + 0.02 * (k % 4), 0.5, 0.5);
stage.add(new THREE.BoxGeometry(0.8, 0.8, 0.8), boxes, wood);
stage.onStep = () => {
    drive();
    const { x, y, z } = chassis.position;
    stage.target.set(x, y, z);
};
stage.run();
