// Clones, states and batches: what a loop of single worlds does, bit for bit, and errors that change nothing.
import test from 'node:test';
import assert from 'node:assert/strict';
import feather, { file } from './package.mjs';
const runtime = await import(file('core.js'));
const { World, FeatherError } = feather;
const WORLDS = 7, DT = 1 / 60;

function swing() {
    const world = new World();
    world.createBody({ type: 'static' }).addPlane([0, 1, 0], 0);
    const bodies = Array.from({ length: 6 }, (_, k) => world.createBody({ position: [0.1 * k, 1 + 1.1 * k, 0] }));
    const shapes = bodies.map((body, k) => (k % 2 ? body.addSphere(0.4) : body.addBox(0.5, 0.5, 0.5)));
    const arm = world.createBody({ position: [4, 3, 0] });
    arm.addBox(1, 0.1, 0.1);
    const hinge = world.addHingeJoint(null, arm, [3, 3, 0], [0, 0, 1], { motorMax: 50 });
    return { world, bodies, shapes, arm, hinge };
}
const refused = (call, code) => assert.throws(call, (error) => error instanceof FeatherError && error.code === code);

test('a batch is a loop of clones, with masks', () => {
    const { world } = swing(), batch = world.createBatch(WORLDS), clones = Array.from({ length: WORLDS }, () => world.clone());
    let differed = 0;
    for (let k = 0; k < 60; ++k) {
        const mask = Array.from({ length: WORLDS }, (_, w) => (k * 7 + w * 3) % 5 !== 0);
        assert.equal(batch.step(DT, 1 + (k % 3), mask), 0);
        clones.forEach((clone, w) => { for (let n = 0; mask[w] && n <= k % 3; ++n) clone.step(DT); });
        assert.deepEqual(batch.hashes, clones.map((clone) => clone.hash));
        differed += new Set(batch.hashes).size > 1;
    }
    assert.ok(differed > 0);
    assert.deepEqual([...batch.results], Array(WORLDS).fill(0));
});

test('reset to the template, and to states', () => {
    const { world } = swing(), batch = world.createBatch(3), begun = batch.hashes;
    batch.step(DT, 20);
    const state = batch.world(1).createState(), later = batch.hashes;
    batch.step(DT, 20);
    assert.notDeepEqual(batch.hashes, later);
    assert.equal(batch.reset([1, 0, 0], null), 0);
    assert.equal(batch.reset([0, 1, 1], [null, state, null]), 0);
    assert.deepEqual(batch.hashes, [begun[0], later[1], begun[2]]);
    world.setState(state);
    assert.equal(world.hash, later[1]);
    state.destroy();
    assert.throws(() => world.setState(state), /the state is destroyed/);
    assert.throws(() => world.setState({}), TypeError);
    assert.throws(() => batch.reset(null, [{}, null, null]), TypeError);
    assert.throws(() => batch.reset(null, [null]), TypeError);
});

test('fields are what single calls read and write', () => {
    const { world, bodies, shapes, arm, hinge } = swing(), batch = world.createBatch(3);
    batch.step(DT, 30);
    const single = batch.world(2), poses = batch.read('transform', bodies), n = bodies.length;
    assert.equal(poses.length, 3 * n * 7);
    for (let b = 0; b < n; ++b) {
        const { position, rotation } = single.body(bodies[b]).transform, at = (2 * n + b) * 7;
        [position.x, position.y, position.z, rotation.x, rotation.y, rotation.z, rotation.w].forEach((v, k) => assert.equal(poses[at + k], Math.fround(v)));
    }
    const near = batch.read('transform', [arm], { relativeTo: arm });
    assert.deepEqual([...near].map((v) => Math.round(1e6 * v) + 0), [0, 1, 2].flatMap(() => [0, 0, 0, 0, 0, 0, 1e6]));
    assert.equal(batch.read('transform', [arm], { origin: [1, 0, 0] })[0], Math.fround(batch.world(0).body(arm).position.x - 1));
    assert.deepEqual([...batch.read('mass', [arm])], [0, 1, 2].map(() => Math.fround(arm.mass)));
    batch.write('mass', [arm], [1, 2, 3], [true, false, true]);
    assert.deepEqual([...batch.read('mass', [arm])], [1, Math.fround(arm.mass), 3]);
    batch.write('friction', [shapes[0]], [0.1, 0.1, 0.2, 0.2, 0.3, 0.3]);
    assert.equal(Math.fround(batch.world(1).shape(shapes[0]).material.dynamicFriction), Math.fround(0.2));
    batch.write('gravity', null, [0, -1, 0, 0, -2, 0, 0, -3, 0]);
    assert.deepEqual([...batch.read('gravity')], [0, -1, 0, 0, -2, 0, 0, -3, 0].map((v) => v + 0));
    assert.equal(batch.world(2).gravity.y, -3);
    assert.equal(batch.read('joint', [hinge]).length, 3 * 2);
    const into = new Float32Array(3);
    assert.equal(batch.read('awake', [arm], {}, into), into);
    assert.deepEqual([...into], [1, 1, 1]);
});

test('arrays are read before each step and filled after it', () => {
    const { world, arm, hinge } = swing(), batch = world.createBatch(4), clones = Array.from({ length: 4 }, () => world.clone());
    const pull = batch.input('force', [arm]), speed = batch.input('jointSpeed', [hinge]), angle = batch.output('joint', [hinge]), pose = batch.output('transform', [arm]);
    assert.deepEqual([pull.shape, speed.shape, angle.shape], [[4, 1, 6], [4, 1, 1], [4, 1, 2]]);
    for (let k = 0; k < 40; ++k) {
        for (let w = 0; w < 4; ++w) {
            pull.values[6 * w + 1] = 10 * w + k, speed.values[w] = 0.25 * w;
            clones[w].body(arm).addForce([0, 10 * w + k, 0]);
            clones[w].joint(hinge).setMotorSpeed('angularX', 0.25 * w);
            clones[w].step(DT);
        }
        assert.equal(batch.step(DT), 0);
        assert.deepEqual(batch.hashes, clones.map((clone) => clone.hash));
        for (let w = 0; w < 4; ++w) {
            assert.equal(angle.values[2 * w], Math.fround(clones[w].joint(hinge).state.angle));
            assert.equal(pose.values[7 * w + 1], Math.fround(clones[w].body(arm).position.y));
        }
    }
    // what is kept begins as it is
    const gravity = batch.input('gravity');
    assert.deepEqual([...gravity.values.subarray(0, 3)], [0, Math.fround(-9.81), 0].map((v) => v + 0));
    batch.step(DT), clones.forEach((clone, w) => {
        clone.body(arm).addForce([0, pull.values[6 * w + 1], 0]), clone.step(DT);
    });
    assert.deepEqual(batch.hashes, clones.map((clone) => clone.hash));
});

test('what fails fails alone', () => {
    const { world, arm, bodies } = swing(), batch = world.createBatch(3), pull = batch.input('force', [arm]);
    pull.values[6] = NaN;
    const before = batch.hashes;
    assert.equal(batch.step(DT), 1);
    assert.deepEqual([...batch.results].map(Math.sign), [0, -1, 0]);
    assert.equal(batch.hashes[1], before[1]);
    assert.notEqual(batch.hashes[0], before[0]);
    pull.values[6] = 0;
    batch.world(0).body(bodies[0]).destroy();
    batch.read('transform', [bodies[0]]);
    assert.deepEqual([...batch.results].map(Math.sign), [-1, 0, 0]);
});

test('wrong arguments change nothing', () => {
    const { world, bodies, arm, hinge } = swing(), batch = world.createBatch(2), before = batch.hashes;
    refused(() => world.createBatch(0), 'FE_ERROR_ARGUMENT');
    for (const count of [1.5, '2', null]) assert.throws(() => world.createBatch(count), TypeError);
    assert.throws(() => world.createBatch(2, { worlds: 3 }), TypeError);
    refused(() => batch.step(NaN), 'FE_ERROR_ARGUMENT');
    refused(() => batch.step(DT, 0), 'FE_ERROR_ARGUMENT');
    assert.throws(() => batch.step(DT, 1, [1]), TypeError);
    assert.throws(() => batch.read('pose', bodies), TypeError);
    assert.throws(() => batch.read('none', bodies), TypeError);
    assert.throws(() => batch.read('transform'), TypeError);
    assert.throws(() => batch.read('gravity', bodies), TypeError);
    assert.throws(() => batch.read('transform', bodies, {}, new Float32Array(3)), TypeError);
    refused(() => batch.read('transform', [hinge]), 'FE_ERROR_KIND');
    refused(() => batch.read('force', bodies), 'FE_ERROR_ARGUMENT');
    refused(() => batch.output('force', bodies), 'FE_ERROR_ARGUMENT');
    refused(() => batch.input('joint', [hinge]), 'FE_ERROR_ARGUMENT');
    assert.throws(() => batch.write('mass', [arm], [1]), TypeError);
    assert.throws(() => batch.write('mass', [arm], [1, 'two']), TypeError);
    refused(() => batch.world(2), 'FE_ERROR_ARGUMENT');
    refused(() => batch.world(0).destroy(), 'FE_ERROR_STATE');
    assert.deepEqual(batch.hashes, before);
});

test('a batch that is gone, and what it leaves', () => {
    const { world, arm } = swing(), batch = world.createBatch(2), one = batch.world(0), angle = batch.output('transform', [arm]);
    batch.destroy();
    for (const call of [() => batch.step(DT), () => batch.hashes, () => batch.world(0), () => one.step(DT), () => one.body(arm).position, () => angle.values, () => batch.destroy()]) assert.throws(call, /the batch is destroyed/);
    world.step(DT);
    const grown = () => {
        for (let k = 0; k < 50; ++k) {
            const b = world.createBatch(20), state = world.createState(), twin = world.clone();
            b.output('transform', [arm]), b.input('gravity'), b.step(DT), b.destroy(), state.destroy(), twin.destroy();
        }
        return runtime.f32.buffer.byteLength;
    };
    // With threads one round may find a fuller moment than those before it: which thread takes which memory is chance.
    const sizes = Array.from({ length: 5 }, grown), fuller = sizes.filter((size, k) => k && size !== sizes[k - 1]).length;
    assert.ok(fuller <= (process.env.FEATHER_THREADS > 1 ? 1 : 0), `bytes after each round: ${sizes}`);
});

test('a great many worlds, while the memory grows', () => {
    const { world, bodies } = swing(), small = world.createBatch(2), pose = small.output('transform', bodies), batch = world.createBatch(3000);
    assert.equal(batch.step(DT, 2), 0), small.step(DT, 2);
    const all = batch.read('transform', bodies), n = 7 * bodies.length;
    for (const w of [0, 1500, 2999]) assert.deepEqual(all.slice(w * n, (w + 1) * n), pose.values.slice(0, n));
    assert.equal(new Set(batch.hashes).size, 1);
    batch.destroy(), small.destroy();
});
