// A cube of 10 x 10 x 10 cubes falls apart under a ball. Press on a cube and pull it; press elsewhere and turn the
// view. A key throws the ball again.
import * as THREE from 'three';
import Feather from 'feather-physics';
import { BodyInstances, rayOf } from 'feather-physics/three';

const STEP = 1 / 60, SIDE = 10, GAP = 1.02; // s, cubes, m from one cube's centre to the next
const { World } = await Feather();

// ---- the world ----
const world = new World({ substeps: 4 });
world.createBody({ type: 'static' }).addPlane([0, 1, 0], 0);
const cubes = [];
for (let i = 0; i < SIDE ** 3; ++i) {
    const at = [i % SIDE, Math.floor(i / SIDE) % SIDE, Math.floor(i / SIDE ** 2)];
    const cube = world.createBody({ position: [(at[0] - 4.5) * GAP, 0.5 + at[1] * GAP, (at[2] - 4.5) * GAP] });
    cube.addBox(0.5, 0.5, 0.5, { density: 400, friction: 0.5 });
    cubes.push(cube);
}
const ball = world.createBody({ position: [-22, 7, 3] });
ball.addSphere(1.5, { density: 2000 });
const shoot = () => {
    ball.position = [-22, 7, 3];
    ball.linearVelocity = [30, 2, -2];
};
shoot();

// ---- what is seen ----
const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);
const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(50, 1, 0.1, 500);
scene.background = new THREE.Color(0x20242b);
scene.add(new THREE.HemisphereLight(0xcfe2ff, 0x403830, 1.6));
const sun = new THREE.DirectionalLight(0xffffff, 2.2);
sun.position.set(-18, 30, 22), sun.castShadow = true;
sun.shadow.mapSize.set(2048, 2048);
Object.assign(sun.shadow.camera, { left: -25, right: 25, top: 25, bottom: -25, far: 90 });
scene.add(sun);
const ground = new THREE.Mesh(new THREE.PlaneGeometry(200, 200), new THREE.MeshStandardMaterial({ color: 0x4a5059 }));
ground.rotation.x = -Math.PI / 2, ground.receiveShadow = true;
scene.add(ground);

function instances(geometry, bodies, colour) {
    const mesh = new THREE.InstancedMesh(geometry, new THREE.MeshStandardMaterial({ roughness: 0.6 }), bodies.length);
    bodies.forEach((_, k) => mesh.setColorAt(k, colour(k)));
    mesh.castShadow = mesh.receiveShadow = true, mesh.frustumCulled = false;
    scene.add(mesh);
    return new BodyInstances(mesh, world, bodies);
}
const hues = (k) => new THREE.Color().setHSL((Math.floor(k / SIDE) % SIDE) / SIDE, 0.55, 0.55);
const drawn = [
    instances(new THREE.BoxGeometry(1, 1, 1), cubes, hues),
    instances(new THREE.SphereGeometry(1.5, 32, 16), [ball], () => new THREE.Color(0xe8e8ea)),
];
const view = { round: 0.7, up: 0.35, far: 27 };
function look() {
    const level = view.far * Math.cos(view.up);
    camera.position.set(level * Math.sin(view.round), 4 + view.far * Math.sin(view.up), level * Math.cos(view.round));
    camera.lookAt(0, 4, 0);
}
function resize() {
    renderer.setSize(innerWidth, innerHeight);
    camera.aspect = innerWidth / innerHeight, camera.updateProjectionMatrix();
}
addEventListener('resize', resize);
resize(), look();

// ---- the hand: a spring from a point of a body to the place under the pointer, as far away as it was gripped ----
let grip = null, turning = false;
const place = (e) => [(e.clientX / innerWidth) * 2 - 1, 1 - (e.clientY / innerHeight) * 2];
addEventListener('pointerdown', (e) => {
    const [from, to] = rayOf(camera, ...place(e)), hit = world.raycast(from, to);
    const body = hit && world.body(hit.body);
    turning = body?.type !== 'dynamic';
    if (turning) return;
    const hand = world.createBody({ type: 'kinematic', position: hit.point });
    const joint = world.addMotorJoint(hand, body, 4, 1, 400 * body.mass, 40 * body.mass);
    grip = { hand, joint, far: hit.fraction };
});
addEventListener('pointermove', (e) => {
    if (grip) {
        const [from, to] = rayOf(camera, ...place(e));
        grip.hand.setTarget({ position: from.addScaledVector(to, grip.far) }, STEP);
    } else if (turning && e.buttons) {
        view.round -= e.movementX / 200;
        view.up = Math.min(1.4, Math.max(0.05, view.up + e.movementY / 200));
        look();
    }
});
addEventListener('pointerup', () => {
    grip?.hand.destroy(); // its joint goes with it
    grip = null;
});
addEventListener('keydown', shoot);

// ---- frames: steps of equal length, and the last of them drawn as far as its time has come ----
let last = performance.now(), owed = 0, spent = 0, steps = 0;
const told = document.querySelector('#told');
function frame(now) {
    owed = Math.min(owed + (now - last) / 1000, 4 * STEP), last = now;
    for (; owed >= STEP; owed -= STEP) {
        const start = performance.now();
        world.step(STEP);
        const moved = world.getMoved();
        spent += performance.now() - start;
        if (grip) grip.hand.linearVelocity = [0, 0, 0]; // until the pointer moves again
        for (const each of drawn) each.keep(moved);
        if (++steps % 30 === 0) {
            const { awakeBodies, contacts } = world.counters;
            told.textContent = `${(spent / 30).toFixed(2)} ms a step, ${awakeBodies} awake, ${contacts} contacts
hash ${world.hash} after ${steps} steps`;
            spent = 0;
        }
    }
    for (const each of drawn) each.draw(owed / STEP);
    renderer.render(scene, camera);
    requestAnimationFrame(frame);
}
requestAnimationFrame(frame);
