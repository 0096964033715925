// Thirty people fall down a flight of stairs. A key drops them again.
import Feather from 'feather-physics';
import { Stage, THREE } from './stage.mjs';

const PEOPLE = 30, STAIRS = 14, RISE = 0.45, GOING = 0.8, HEAD = 0.11; // m
const UP = [0, 1, 0], DOWN = [0, -1, 0], ASIDE = [1, 0, 0];
const { World } = await Feather();
const world = new World({ substeps: 4 });
world.createBody({ type: 'static' }).addPlane(UP, 0);
const stairs = [];
for (let k = 0; k < STAIRS; ++k) {
    const height = ((STAIRS - k) * RISE) / 2, position = [0, height, (k - STAIRS / 2) * GOING];
    const stair = world.createBody({ type: 'static', position });
    stair.addBox(6, height, GOING / 2);
    stairs.push(stair);
}

// A person of eleven capsules stands at a place: x, y, z of the hips' centre
const limbs = new Map(), everybody = []; // bodies by half height and radius; each with its place
function limb(at, x, y, halfHeight, radius) {
    const position = [at[0] + x, at[1] + y, at[2]];
    const body = world.createBody({ position, angularDamping: 0.1 });
    body.addCapsule(halfHeight, radius, { friction: 0.6 });
    const key = `${halfHeight} ${radius}`;
    limbs.set(key, [...(limbs.get(key) ?? []), body]);
    everybody.push([body, position]);
    return body;
}
function person(at) {
    const point = (x, y) => [at[0] + x, at[1] + y, at[2]];
    const stiff = { motorMax: 2 }; // N m of friction
    const ball = (a, b, x, y, axis, cone) =>
        world.addBallJoint(a, b, point(x, y), axis, { coneEnabled: true, coneY: cone, coneZ: cone, ...stiff });
    const hinge = (a, b, x, y, lower, upper) =>
        world.addHingeJoint(a, b, point(x, y), ASIDE, { limitEnabled: true, lower, upper, ...stiff });
    const hips = limb(at, 0, 0, 0.05, 0.15), chest = limb(at, 0, 0.4, 0.12, 0.17), head = limb(at, 0, 0.8, 0.04, HEAD);
    ball(hips, chest, 0, 0.2, UP, 0.4), ball(chest, head, 0, 0.65, UP, 0.6);
    for (const side of [-1, 1]) {
        const arm = 0.26 * side, leg = 0.1 * side;
        const upperArm = limb(at, arm, 0.35, 0.12, 0.05), foreArm = limb(at, arm, -0.02, 0.12, 0.045);
        const thigh = limb(at, leg, -0.35, 0.16, 0.07), shin = limb(at, leg, -0.8, 0.16, 0.06);
        ball(chest, upperArm, arm, 0.52, DOWN, 1.5), hinge(upperArm, foreArm, arm, 0.17, -2.4, 0);
        ball(hips, thigh, leg, -0.12, DOWN, 0.9), hinge(thigh, shin, leg, -0.58, 0, 2.4);
    }
}
const TOP = STAIRS * RISE + 1.1, BACK = (-STAIRS / 2) * GOING; // m; feet above the highest stair
for (let k = 0; k < PEOPLE; ++k) person([(k % 10) * 1.1 - 5, TOP + 2.2 * Math.floor(k / 10), BACK + 0.1 * (k % 3)]);
function drop() {
    for (const [body, position] of everybody) {
        body.transform = { position, rotation: [0, 0, 0, 1] };
        body.linearVelocity = [0, 0, 3];
        body.angularVelocity = [0, 0, 0];
    }
}
drop();
addEventListener('keydown', drop);

const stage = new Stage(world, { height: 3, far: 20 });
const sizes = stairs.flatMap((_, k) => [6, ((STAIRS - k) * RISE) / 2, GOING / 2]);
stage.add(new THREE.BoxGeometry(2, 2, 2), stairs, () => new THREE.Color(0x7a828c), sizes);
for (const [key, bodies] of limbs) {
    const [halfHeight, radius] = key.split(' ').map(Number);
    const skin = () => new THREE.Color(0xe0b090), cloth = (k) => new THREE.Color().setHSL((k * 0.618) % 1, 0.5, 0.55);
    const isHead = radius === HEAD;
    stage.add(new THREE.CapsuleGeometry(radius, 2 * halfHeight, 8, 16), bodies, isHead ? skin : cloth);
}
stage.run();
