// The scene that every language plays, see tests/bindings/scenario.c: prints the same two lines.
import feather from './package.mjs';
const { World } = feather;
const BODIES = 300, STEPS = 600, SAMPLES = 17;
const FORMS = [{ type: 'sphere', radius: 0.5 }, { type: 'box', halfExtents: [0.5, 0.375, 0.5] }, { type: 'capsule', halfHeight: 0.25, radius: 0.375 }];
const place = (i) => [i % 10 * 1.5 - 6.75, 2 + Math.floor(i / 60) * 1.5, Math.floor(i / 10) % 6 * 1.5 - 3.75];
const told = { enter: 0, exit: 0, hit: 0, sleep: 0, wake: 0, break: 0, rays: 0, overlaps: 0 };

const world = new World();
const heights = [];
for (let row = 0; row < SAMPLES; ++row) for (let column = 0; column < SAMPLES; ++column) heights.push((row * 7 + column * 3) % 5 * 0.125);
const terrain = world.createHeightfield({ rows: SAMPLES, columns: SAMPLES, cellX: 2, cellZ: 2, heights });
world.createBody({ type: 'static' }).createShape(terrain, { position: [-16, 0, -16] });
const bodies = [];
for (let i = 0; i < BODIES; ++i) {
    bodies.push(world.createBody({ position: place(i) }));
    bodies[i].createShape(FORMS[i % 3], { events: i % 5 === 0 ? ['touch', 'hit'] : 'touch' });
}
world.createBody({ type: 'kinematic', position: [-10, 1, 0], linearVelocity: [0.5, 0, 0] }).addBox(0.5, 1, 4);
for (let i = 0; i < BODIES - 1; ++i) {
    const a = bodies[i], b = bodies[i + 1], from = place(i), to = place(i + 1), middle = [from[0] + 0.75, from[1], from[2]];
    if (i % 10 === 0) world.addBallJoint(a, b, middle, [1, 0, 0]);
    else if (i % 10 === 4) world.addHingeJoint(a, b, middle, [0, 0, 1], { limitEnabled: true, lower: -0.5, upper: 0.5 });
    else if (i % 10 === 7) world.addDistanceJoint(a, b, from, to);
    else if (i % 10 === 2) world.addFixedJoint(a, b, middle, { breakForce: 8192 });
}

function act(step) {
    if (step % 10 === 0) {
        const hit = world.raycast([Math.floor(step / 10) % 16 - 7.5, 20, 0.25], [-0, -40, 0]);
        const body = hit && world.body(hit.body);
        if (body?.type === 'dynamic') {
            ++told.rays;
            body.addImpulseAt([0, 512, 64], hit.point);
        }
        told.overlaps += world.overlap({ type: 'sphere', radius: 3 }, { position: [0, 1, 0] }).length;
    }
    if (step === 200) terrain.setHeights(7, 7, 3, 3, [1, 1, 1, 1, 2, 1, 1, 1, 1]);
    if (step === 400) for (let i = 60; i < 70; ++i) bodies[i].destroy();
}
for (let step = 0; step < STEPS; ++step) {
    act(step);
    world.step(1 / 60);
    for (const e of [...world.pairEvents, ...world.bodyEvents, ...world.jointEvents]) ++told[e.kind];
    told.hit += world.hitEvents.length;
}
console.log(`hash ${world.hash}`);
console.log(Object.entries(told).map(([name, n]) => `${name} ${n}`).join(' '));
