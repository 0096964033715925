// demo.js - worlds made in the page. Each is recorded while it is made, and then played like any recording.
import { World } from 'feather-physics/module';

const STEP = 1 / 60; // s
const random = (seed) => () => ((seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648);

function ground(world) {
    const body = world.createBody({ type: 'static' });
    body.addPlane([0, 1, 0], 0, { friction: 0.7 });
    return body;
}
// The hue of an island is that of its oldest body, by its number: `n` numbers are used up
function skip(world, n) { for (let k = 0; k < n; ++k) world.createBody().destroy(); }
function pyramid(world) {
    ground(world), skip(world, 1);
    const side = 12, size = 0.5;
    for (let level = 0; level < side; ++level) {
        const n = side - level;
        for (let i = 0; i < n * n; ++i) {
            const at = (k) => (k - (n - 1) / 2) * 2.04 * size;
            const box = world.createBody({ position: [at(i % n), size + level * 2 * size, at(Math.floor(i / n))] });
            box.addBox(size, size, size, { density: 300, friction: 0.55 });
        }
    }
    const ball = world.createBody({ position: [-26, 5, 4] });
    ball.addSphere(1.4, { density: 1100, events: ['hit'] });
    ball.linearVelocity = [25, 3, -3.4];
    return [[ball.id, 'the ball']];
}
function machines(world) {
    ground(world);
    const names = [], arch = [];
    const anchor = (x, z, name) => {
        const post = world.createBody({ type: 'static', position: [x, 2.2, z] });
        post.addBox(0.35, 2.2, 1.6);
        names.push([post.id, name]);
        return post;
    };
    const west = anchor(-7, 0, 'west pier'), east = anchor(7, 0, 'east pier'), planks = 18, width = 13.2 / planks;
    let before = west;
    for (let k = 0; k < planks; ++k) {
        const x = -6.6 + (k + 0.5) * width, plank = world.createBody({ position: [x, 4.3, 0] });
        plank.addBox(width / 2 - 0.02, 0.06, 1.4, { density: 500, friction: 0.7 });
        for (const z of [-1.2, 1.2]) world.addBallJoint(before, plank, [x - width / 2, 4.3, z], [1, 0, 0]);
        before = plank, arch.push(plank);
    }
    for (const z of [-1.2, 1.2]) world.addBallJoint(before, east, [6.6, 4.3, z], [1, 0, 0]);
    const next = random(5);
    for (let k = 0; k < 14; ++k) {
        const position = [-5 + 10 * next(), 6.5 + 1.1 * k, 2 * next() - 1];
        const body = world.createBody({ position, linearVelocity: [0, -2, 0] });
        if (k % 3 === 0) body.addCylinder(0.3, 0.35, { density: 300 });
        else if (k % 3 === 1) body.addCapsule(0.3, 0.25, { density: 300 });
        else body.addBox(0.35, 0.3, 0.3, { density: 300 });
    }
    // a mill that sweeps what lies before it
    const hub = world.createBody({ type: 'static', position: [0, 1.2, 9] });
    hub.addCylinder(0.5, 0.3);
    const mill = world.createBody({ position: [0, 1.9, 9] });
    mill.addBox(3.6, 0.25, 0.18, { density: 250 }), mill.addBox(0.18, 0.25, 3.6, { density: 250 });
    const hinge = world.addHingeJoint(hub, mill, [0, 1.9, 9], [0, 1, 0], { motorSpeed: 2.2, motorMax: 9000 });
    names.push([mill.id, 'the mill'], [hinge.id, 'its motor']);
    for (let k = 0; k < 40; ++k) {
        const body = world.createBody({ position: [-3 + 6 * next(), 4 + 0.45 * k, 7 + 4 * next()] });
        if (k % 2) body.addSphere(0.3, { density: 200 });
        else body.addBox(0.3, 0.3, 0.3, { density: 200 });
    }
    // a chain with a weight
    let link = null, top = [-12, 9, 2];
    for (let k = 0; k < 12; ++k) {
        const position = [top[0] + 0.3 + 0.6 * k, top[1], top[2]], rotation = [0, 0, Math.SQRT1_2, Math.SQRT1_2];
        const body = world.createBody({ position, rotation });
        body.addCapsule(0.2, 0.09, { density: 2000 });
        world.addBallJoint(link, body, [top[0] + 0.6 * k, top[1], top[2]], [1, 0, 0]);
        link = body;
    }
    const weight = world.createBody({ position: [top[0] + 7.8, top[1], top[2]] });
    weight.addSphere(0.65, { density: 1500, events: ['hit'] });
    world.addBallJoint(link, weight, [top[0] + 7.2, top[1], top[2]], [1, 0, 0]);
    names.push([weight.id, 'the weight']);
    return names;
}
function heap(world) {
    const next = random(11), n = 41, heights = new Float32Array(n * n);
    for (let k = 0; k < n * n; ++k) {
        const x = (k % n) - 20, z = Math.floor(k / n) - 20, r = Math.hypot(x, z);
        heights[k] = 0.012 * Math.min(r, 19) ** 2 + 0.25 * Math.sin(x * 0.9) * Math.cos(z * 0.7);
    }
    const land = world.createBody({ type: 'static', position: [-20, 0, -20] });
    skip(world, 8);
    land.createShape(world.createHeightfield({ rows: n, columns: n, heights, cellX: 1, cellZ: 1 }), { friction: 0.7 });
    const hulls = [0, 1, 2].map((k) => {
        const points = [], r = random(k + 3);
        for (let i = 0; i < 18; ++i) points.push(0.9 * (r() - 0.5), 0.8 * (r() - 0.5), 0.7 * (r() - 0.5));
        return world.createHull(points);
    });
    for (let k = 0; k < 420; ++k) {
        const a = 2.4 * k, r = 1.2 + 3.2 * Math.sqrt(next());
        const position = [r * Math.cos(a), 5 + 0.075 * k + next(), r * Math.sin(a)];
        const body = world.createBody({ position, angularVelocity: [next(), next(), next()] });
        const kind = k % 7, options = { density: 600, friction: 0.6 };
        if (kind === 0) body.addBox(0.42, 0.3, 0.36, options);
        else if (kind === 1) body.addSphere(0.36, { ...options, material: { rollingResistance: 0.05 } });
        else if (kind === 2) body.addCapsule(0.3, 0.25, options);
        else if (kind === 3) body.addCylinder(0.32, 0.32, options);
        else if (kind === 4) body.addCone(0.42, 0.4, options);
        else body.createShape(hulls[k % 3], options);
    }
    return [[land.id, 'the valley']];
}
export const DEMOS = [
    { name: 'Pyramid', told: '650 boxes and a ball', make: pyramid, steps: 600, from: [-1, 0.5, 1.25] },
    { name: 'Machines', told: 'bridge, mill, chain: joints at work', make: machines, steps: 900, from: [-0.5, 0.5, 1.1] },
    { name: 'Valley', told: 'every form poured on a heightfield', make: heap, steps: 780, from: [0.8, 0.75, 1] },
];

// Gives the recording's bytes piece by piece, as `work` has time for
export class Maker {
    constructor(demo) {
        this.left = demo.steps, this.world = new World();
        const names = demo.make(this.world);
        this.recorder = this.world.createRecorder({ keyframeSteps: 120 });
        for (const [id, text] of names) this.recorder.note(text, id);
    }
    work(ms) {
        const until = performance.now() + ms;
        while (this.left > 0 && performance.now() < until) this.world.step(STEP), --this.left;
        if (!this.left) return this.end();
        return this.recorder.read();
    }
    // Also before all steps are made
    end() {
        if (this.world.isDestroyed) return new Uint8Array(0);
        const bytes = this.recorder.read();
        this.recorder.destroy(), this.world.destroy(), this.left = 0;
        return bytes;
    }
}
