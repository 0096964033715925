// Recordings, made and played: the same hashes, seeks, divergences, worlds that only read, worlds handed over.
import test from 'node:test';
import assert from 'node:assert/strict';
import feather, { file } from './package.mjs';
const { World, Store, Player, FeatherError } = feather;
const DT = 1 / 60;

function pile(options) {
    const world = new World(options);
    world.createBody({ type: 'static' }).addBox(50, 0.5, 50);
    for (let k = 0; k < 12; ++k) world.createBody({ position: [k % 4, 2 + k, k % 3] }).addBox(0.5, 0.5, 0.5);
    world.createBody({ position: [9, 3, 0] }).createShape(world.createHull([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]));
    return world;
}
const run = (world, steps) => Array.from({ length: steps }, () => (world.step(DT), world.hash));
function recorded(steps = 90, options) {
    const world = pile(), recorder = world.createRecorder(options), hashes = run(world, steps), bytes = recorder.read();
    recorder.destroy(), world.destroy();
    return { bytes, hashes };
}

test('a recording plays bit for bit, with its notes', () => {
    const world = pile(), recorder = world.createRecorder({ flags: ['assets', 'fine'], keyframeSteps: 20 }), [, body] = world.bodies, hashes = [];
    recorder.note('it begins');
    for (let i = 0; i < 90; ++i) {
        if (i === 30) world.body(body).addImpulse([0, 500, 0]);
        if (i === 70) recorder.note('a body: ä', body);
        world.step(DT), hashes.push(world.hash);
    }
    const player = new Player(recorder.read());
    assert.deepEqual(Array.from(player, (replay) => replay.hash), hashes);
    assert.equal(player.step(), false);
    assert.equal(player.divergence, null);
    assert.deepEqual(player.notes, [{ step: 0, about: 0, text: 'it begins' }, { step: 70, about: body, text: 'a body: ä' }]);
    const { info } = player;
    assert.deepEqual([info.flags, info.foreign, info.firstStep, info.step, info.notes, info.hasDiverged], [feather.RecordFlags.assets | feather.RecordFlags.fine, false, 0, 90, 2, false]);
    assert.ok(info.keyframes > 3 && info.calls > 90 && info.bytes > 1000);
    player.destroy(), recorder.destroy(), world.destroy();
});

test('it grows in pieces, and seeks go both ways', () => {
    const world = pile(), recorder = world.createRecorder({ keyframeSteps: 20 }), hashes = [], player = new Player();
    assert.throws(() => player.world, { code: 'FE_ERROR_STATE' });
    assert.equal(player.step(), false);
    assert.equal(player.seek(3), false);
    for (let piece = 0; piece < 9; ++piece) {
        hashes.push(...run(world, 10));
        const bytes = recorder.read(piece % 2 ? new Uint8Array(1 << 20) : undefined);
        assert.ok(bytes.length > 0);
        for (let at = 0; at < bytes.length; at += 333) player.feed(bytes.subarray(at, at + 333));
    }
    assert.equal(recorder.read().length, 0);
    for (const step of [90, 1, 45, 44, 20, 90]) {
        assert.equal(player.seek(step), true);
        assert.deepEqual([player.info.step, player.world.hash], [step, hashes[step - 1]]);
    }
    assert.equal(player.seek(91), false);
    assert.throws(() => player.seek(-1), { code: 'FE_ERROR_ARGUMENT' });
    assert.throws(() => player.seek(0.5), TypeError);
    world.destroy();
    assert.equal(recorder.read().length, 0);
    assert.throws(() => recorder.note('late'), { code: 'FE_ERROR_STATE' });
    recorder.destroy();
});

test('a world has one recorder, and a call that fails leaves it as it is', () => {
    const world = pile(), before = world.hash, recorder = world.createRecorder();
    assert.throws(() => world.createRecorder(), { code: 'FE_ERROR_STATE', message: /has a recorder/ });
    assert.throws(() => recorder.note('x'.repeat(4097)), { code: 'FE_ERROR_ARGUMENT' });
    assert.throws(() => recorder.note('a\0b'), TypeError);
    assert.throws(() => recorder.note(5), TypeError);
    assert.throws(() => recorder.read(new Uint8Array(10)), TypeError);
    assert.throws(() => recorder.read('text'), TypeError);
    recorder.destroy();
    assert.throws(() => recorder.read(), { code: 'FE_ERROR_STALE' });
    for (const wrong of [{ flags: 1 << 9 }, { flags: 'all' }, { keyframeSteps: -1 }, { bufferBytes: 5 }, { bufferBytes: -5 }, { buffer: 5 }]) {
        assert.throws(() => world.createRecorder(wrong), (e) => e instanceof FeatherError || e instanceof TypeError);
    }
    assert.equal(world.hash, before);
    world.createRecorder().destroy();
});

test('what nobody reads ends the recording, which then says so', () => {
    const world = pile(), recorder = world.createRecorder({ keyframeSteps: 2, bufferBytes: 65536 });
    run(world, 800);
    const player = new Player(recorder.read()), played = [...player].length;
    assert.ok(played > 0 && played < 800);
    assert.throws(() => recorder.read(), { code: 'FE_ERROR_LIMIT', message: /nobody read/ });
});

test('a flight recorder keeps the last steps', () => {
    const world = pile(), recorder = world.createRecorder({ flags: ['assets', 'fine', 'last'], bufferBytes: 65536, keyframeSteps: 20 }), hashes = run(world, 400);
    const kept = recorder.read();
    assert.deepEqual(recorder.read(), kept);
    const player = new Player(kept), played = Array.from(player, (replay) => replay.hash);
    assert.ok(played.length >= 20 && played.length < 400);
    assert.deepEqual(played, hashes.slice(-played.length));
    assert.equal(player.info.firstStep, 400 - played.length);
});

test('the world of a player is there to be read', () => {
    const { bytes } = recorded(), player = new Player(bytes);
    player.seek(20);
    const { world } = player, body = world.body(world.bodies[1]), shape = world.shape(body.shapes[0]), list = world.list([body]), where = body.position;
    assert.equal(player.world, world);
    const changes = [
        () => world.step(DT), () => world.createBody(), () => world.createBodies([{}]), () => world.destroyBodies([body]), () => world.restore(world.save()), () => world.destroy(),
        () => world.createRecorder(), () => world.createHistory(), () => (world.gravity = [0, 0, 0]), () => (world.tuning = {}), () => world.addBallJoint(body, null, [0, 0, 0], [0, 1, 0]),
        () => (body.position = [0, 0, 0]), () => body.destroy(), () => body.addSphere(1), () => body.addForce([1, 0, 0]), () => shape.destroy(), () => (shape.density = 5),
        () => list.setVelocities(list.velocities()), () => list.addForces(new Float32Array(6)), () => list.setTransforms(list.transforms()),
    ];
    for (const change of changes) assert.throws(change, { code: 'FE_ERROR_STATE', message: /player's/ }, String(change));
    assert.deepEqual(body.position, where);
    assert.ok(world.raycast([0, 50, 0], [0, -60, 0]));
    assert.ok(world.drawInstances().count > 10);
    assert.equal(World.load(world.save({ flags: 'assets' })).hash, world.hash);
    assert.equal(player.step(), true);
    assert.equal(world.getMoved().count, 13);
    assert.notDeepEqual(body.position, where);
    player.destroy();
    assert.equal(world.isDestroyed, true);
    for (const call of [() => body.position, () => world.step(DT), () => player.step(), () => player.world, () => player.release(), () => player.info, () => player.destroy()]) {
        assert.throws(call, { code: 'FE_ERROR_STALE' });
    }
});

test('a released world goes on, and a seek makes the player another one', () => {
    const { bytes, hashes } = recorded(), player = new Player(bytes);
    assert.throws(() => player.release(), { code: 'FE_ERROR_STATE' });
    player.seek(20);
    const seen = player.world, world = player.release();
    assert.equal(seen, world);
    assert.throws(() => player.world, { code: 'FE_ERROR_STATE' });
    world.step(DT);
    assert.equal(world.hash, hashes[20]);
    player.seek(10);
    assert.notEqual(player.world, world);
    assert.equal(player.world.hash, hashes[9]);
    player.destroy();
    world.createBody();
    world.destroy();
});

test('assets that a recording does not hold come from a store', () => {
    const { bytes, hashes } = recorded(30, { flags: 0 }), store = new Store();
    assert.throws(() => new Player(bytes).step(), { code: 'FE_ERROR_STATE', message: /nowhere/ });
    store.createHull([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
    const player = new Player(bytes, { store });
    assert.equal(player.seek(30), true);
    assert.equal(player.world.hash, hashes[29]);
    assert.throws(() => new Player(bytes, { store: 5 }), TypeError);
    player.destroy(), store.destroy();
    assert.throws(() => new Player(bytes, { store }), { code: 'FE_ERROR_STALE' });
});

test('what is no recording, or was altered, is refused; what stands before it plays', () => {
    const { bytes } = recorded(90, { keyframeSteps: 20 }), altered = bytes.slice();
    altered[bytes.length - 20] ^= 1;
    const player = new Player();
    assert.throws(() => player.feed(altered), { code: 'FE_ERROR_DATA' });
    const played = [...player].length;
    assert.ok(played > 0 && played < 90);
    assert.throws(() => new Player(new Uint8Array(64)), { code: 'FE_ERROR_DATA' });
    assert.throws(() => new Player('run.feather'), TypeError);
    assert.throws(() => new Player(null, { worker: 1 }), TypeError);
    assert.throws(() => new Player(null, { simd: 'avx2' }), { code: 'FE_ERROR_UNSUPPORTED' });
});

// The chunks of a recording, by src/recording/recorder.h: a header of 40 bytes, then 32 of each chunk, the third number its size
function chunks(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset), found = [bytes.subarray(0, 40)];
    for (let at = 40; at < bytes.length;) {
        const end = at + 32 + Math.ceil(Number(view.getBigUint64(at + 8, true)) / 8) * 8;
        found.push(bytes.subarray(at, end));
        at = end;
    }
    return found;
}
test('a replay that goes another way is told once, and goes on', () => {
    // the keyframe of one run before the calls of another, in which a body began faster
    const record = (speed) => {
        const world = pile({ number: 5 });
        world.body(world.bodies[3]).linearVelocity = [0, 0, speed];
        const recorder = world.createRecorder({ flags: ['assets', 'fine'], keyframeSteps: 0 });
        run(world, 30);
        return { ...world.bodies, chunks: chunks(recorder.read()) };
    };
    const one = record(0), other = record(0.25), isKeyframe = (c) => String.fromCharCode(...c.subarray(0, 4)) === 'KEYF', player = new Player();
    for (const [k, chunk] of other.chunks.entries()) player.feed(isKeyframe(chunk) ? one.chunks[k] : chunk);
    let told = 0, steps = 0;
    for (;;) {
        try {
            if (!player.step()) break;
        } catch (error) {
            assert.equal(error.code, 'FE_ERROR_DIVERGED');
            const { divergence } = player;
            assert.deepEqual([divergence.type, divergence.step, divergence.body, player.info.hasDiverged], ['step', 1, other[3], true]);
            assert.match(divergence.text, /[a-z]/);
            assert.ok(divergence.field.length > 0);
            ++told;
        }
        ++steps;
    }
    assert.deepEqual([told, steps], [1, 30]);
});

test('snapshots tell where they differ', () => {
    const a = pile(), b = pile(), { compareSnapshots } = feather;
    assert.equal(compareSnapshots(a.save(), b.save()), null);
    a.body(a.bodies[3]).gravityScale = 5;
    const found = compareSnapshots(a.save(), b.save());
    assert.equal(found.handle, a.bodies[3]);
    assert.deepEqual([found.kind, found.field, found.element, found.a, found.b], ['body', 'gravity_scale', 0, '5', '1']);
    assert.throws(() => compareSnapshots(a.save(), new Uint8Array(100)), { code: 'FE_ERROR_DATA' });
    assert.throws(() => compareSnapshots(a.save()), TypeError);
});

test('recorders and players leave no memory behind', async () => {
    const { x } = await import(file('core.js'));
    let pages = 0;
    for (let i = 0; i < 60; ++i) {
        const { bytes } = recorded(20, { bufferBytes: 1 << 20 }), player = new Player(bytes);
        player.seek(20), player.world.getMoved(), player.seek(5), player.release().destroy(), player.seek(9), player.destroy();
        if (i === 20) pages = x.memory.buffer.byteLength;
    }
    assert.equal(x.memory.buffer.byteLength, pages);
});
