// What the layer promises beyond the calls themselves.
import test from 'node:test';
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import feather, { Feather, file } from './package.mjs';
const { World, Store, FeatherError } = feather;
const near = (a, b, by = 1e-6) => assert.ok(Math.abs(a - b) <= by, `${a} is not ${b}`);
const pile = (world, n = 40) => {
    world.createBody({ type: 'static' }).addBox(50, 0.5, 50);
    return Array.from({ length: n }, (_, k) => {
        const body = world.createBody({ position: [k % 4, 2 + k, k % 3] });
        body.addBox(0.5, 0.5, 0.5);
        return body;
    });
};

test('a second start gives the same, and so do names imported at once', async () => {
    assert.equal(await Feather(), feather);
    assert.equal(Feather.sync(new Uint8Array()), feather);
    const names = await import(file('index.js'));
    assert.equal(names.World, World);
});

test('/inline and /module start in a thread of their own', async () => {
    const { Worker } = await import('node:worker_threads');
    const run = (name, source) => new Promise((resolve, reject) => {
        const code = `const { default: Feather } = await import(${JSON.stringify(file(name).href)});
            const { readFileSync } = await import('node:fs');
            const { World } = ${source};
            const world = new World(); world.createBody().addSphere(1); world.step(1 / 60);
            (await import('node:worker_threads')).parentPort.postMessage(world.hash);`;
        const worker = new Worker(new URL(`data:text/javascript,${encodeURIComponent(code)}`));
        worker.once('message', resolve), worker.once('error', reject);
    });
    const world = new World();
    world.createBody().addSphere(1), world.step(1 / 60);
    const bytes = `readFileSync(new URL(${JSON.stringify(file('feather.wasm').href)}))`;
    assert.equal(await run('inline.js', 'await Feather()'), world.hash);
    assert.equal(await run('inline.js', 'Feather.sync()'), world.hash);
    assert.equal(await run('module.js', `await Feather(${bytes})`), world.hash);
    assert.equal(await run('module.js', `Feather.sync(new WebAssembly.Module(${bytes}))`), world.hash);
    assert.equal(await run('module.js', `await Feather(Promise.resolve(new Response(${bytes}, { headers: { 'content-type': 'application/wasm' } })))`), world.hash);
});

test('the module asks its host for three functions', async () => {
    const module = new WebAssembly.Module(await readFile(file('feather.wasm')));
    assert.deepEqual(WebAssembly.Module.imports(module).map((i) => `${i.module}.${i.name}`).sort(), ['host.clock', 'host.read', 'host.write']);
});

test('a falling box, as by hand', () => {
    const world = new World({ substeps: 1 });
    const box = world.createBody({ position: [1, 2, 3], rotation: [0, 0, 0, 2] });
    box.addBox(1, 1, 1);
    world.step(0.5);
    near(box.linearVelocity.y, -9.81 * 0.5);
    near(box.position.y, 2 - 9.81 * 0.25, 1e-5);
    near(box.mass, 8000, 1e-3);
    world.destroy();
});

test('vectors of other libraries, which have a length() of their own', () => {
    class Vector { constructor(...of) { [this.x, this.y, this.z, this.w] = of; } length() { return 1; } }
    const world = new World(), body = world.createBody({ position: new Vector(1, 2, 3), rotation: new Vector(0, 0, 1, 0) });
    body.addSphere(1);
    body.linearVelocity = new Vector(4, 5, 6);
    assert.deepEqual([body.position, body.linearVelocity], [{ x: 1, y: 2, z: 3 }, { x: 4, y: 5, z: 6 }]);
    assert.equal(body.rotation.z, 1);
    assert.equal(world.raycast(new Vector(1, 9, 3), new Vector(0, -9, 0)).body, body.id);
    world.destroy();
});

test('0 and -0 give the same bits', () => {
    const play = (zero) => {
        const world = new World(), body = world.createBody({ position: [zero, 1, zero], linearVelocity: [zero, zero, 1], userData: 0 });
        body.addBox(1, 1, 1, { friction: zero });
        body.addForce([zero, 1, zero]);
        world.raycast([zero, 5, zero], [zero, -9, zero]);
        world.list([body]).setVelocities([zero, zero, zero, zero, zero, 1]);
        world.step(1 / 60);
        assert.equal(Object.is(body.position.x, -0), false);
        return world.hash;
    };
    assert.equal(play(-0), play(0));
});

test('numbers of 64 bits come back whole', () => {
    const world = new World(), body = world.createBody({ userData: 2n ** 64n - 1n });
    assert.equal(body.userData, 2n ** 64n - 1n);
    body.userData = 2 ** 53 - 1;
    assert.equal(body.userData, 2 ** 53 - 1);
    assert.throws(() => (body.userData = 2 ** 53), TypeError);
    assert.throws(() => (body.userData = -1), TypeError);
    assert.throws(() => (body.userData = 2n ** 64n), TypeError);
});

test('records name what they do not have, enumerators and sentences are those of C', () => {
    const world = new World();
    assert.throws(() => world.createBody({ positon: [0, 0, 0] }), /TypeError: options has no positon; it has type, transform/);
    assert.throws(() => world.createBody({ type: 'dynamc' }), /options.type must be one of static, kinematic, dynamic, is "dynamc"/);
    assert.throws(() => world.createBody({ position: [0, 0] }), /options.position must be a vector of 3 numbers/);
    assert.throws(() => world.createBody({ position: [0, '1', 0] }), /options.position\[1\] must be a number, is "1"/);
    assert.throws(() => world.step(-1.25e-7), { code: 'FE_ERROR_ARGUMENT', message: 'fe_world_step: dt is -1.25e-07, must be 0..1' });
    assert.throws(() => world.step(NaN), { message: 'fe_world_step: dt is NaN, must be 0..1' });
    assert.throws(() => world.createBody({ position: [3e9, 0, 0] }), { message: 'fe_body_create: transform.x is 3e+09, must be -1e+09..1e+09' });
    assert.throws(() => world.createBody({ gravityScale: 123456789 }), { message: /is 1.23457e\+08|is 123456792/ });
    assert.equal(feather.lastError().startsWith('fe_body_create: '), true);
});

test('an error has changed nothing', () => {
    const world = new World(), [body] = pile(world, 3), before = world.hash;
    assert.throws(() => world.createBodies([{}, { position: [NaN, 0, 0] }]), FeatherError);
    assert.throws(() => world.destroyBodies([body, body]), FeatherError);
    assert.throws(() => world.list([body, 12345]).poses(), { code: 'FE_ERROR_STALE' });
    assert.equal(world.hash, before);
    assert.equal(world.bodies.length, 4);
});

test('handles of another world are refused', () => {
    const a = new World(), b = new World(), body = a.createBody();
    assert.throws(() => b.body(body.id).position, { code: 'FE_ERROR_STALE' });
    assert.throws(() => b.ignoreCollision(body, b.createBody(), true), { code: 'FE_ERROR_STALE' });
    assert.throws(() => a.body(body.addSphere(1).id).position, { code: 'FE_ERROR_KIND' });
    assert.equal(a.body(body.id).isValid, true);
});

test('snapshots go on bit for bit, in place and anew, in a buffer of the caller, and refuse what is cut', () => {
    const world = new World();
    pile(world);
    const hull = world.createHull([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1]);
    world.createBody({ position: [0, 60, 0] }).createShape(hull);
    for (let i = 0; i < 60; ++i) world.step(1 / 60);
    const bytes = world.save({ flags: 'assets' }), at = world.hash;
    assert.ok(Buffer.from(world.save({ flags: ['assets'] }, new Uint8Array(1 << 20))).equals(Buffer.from(bytes)));
    assert.throws(() => world.save(null, new Uint8Array(10)), TypeError);
    const play = (w) => { for (let i = 0; i < 60; ++i) w.step(1 / 60); return w.hash; };
    const after = play(world), copy = World.load(bytes);
    assert.equal(copy.hash, at);
    assert.equal(play(copy), after);
    assert.equal(world.restore(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)), true);
    assert.equal(play(world), after);
    const lean = world.save(), stranger = new World();
    assert.throws(() => stranger.restore(lean), { code: 'FE_ERROR_STATE' });
    const there = stranger.store.load(hull.save());
    assert.deepEqual(there.key, hull.key);
    assert.deepEqual(feather.snapshotAssets(lean), [hull.key]);
    assert.equal(stranger.restore(lean, { assets: [there] }), true);
    assert.equal(stranger.hash, world.hash);
    assert.equal(feather.checkSnapshot(lean).bodies, 42);
    for (const cut of [0, 1, 100, bytes.length - 1]) assert.throws(() => world.restore(bytes.subarray(0, cut)), { code: /FE_ERROR_DATA|FE_ERROR_ARGUMENT/ });
    assert.throws(() => World.load('text'), TypeError);
    copy.destroy(), world.destroy(), stranger.destroy();
});

test('a difference is smaller than a snapshot, and goes on bit for bit with its base alone', () => {
    const world = new World();
    pile(world);
    for (let i = 0; i < 120; ++i) world.step(1 / 60);
    const base = world.save();
    world.step(1 / 60);
    const difference = world.save({ base }), whole = world.save(), at = world.hash;
    assert.ok(difference.length < whole.length / 2, `${difference.length} of ${whole.length} bytes`);
    assert.ok(Buffer.from(world.save({ base: base.buffer, flags: 'diff' })).equals(Buffer.from(difference)));
    const copy = World.load(difference, { base });
    assert.ok(Buffer.from(copy.save()).equals(Buffer.from(whole)));
    world.step(1 / 60);
    assert.throws(() => world.restore(difference), { code: /FE_ERROR/ });
    assert.throws(() => world.restore(difference, { base: whole }), { code: 'FE_ERROR_DATA' });
    assert.throws(() => world.restore(difference, { base: 'text' }), TypeError);
    assert.throws(() => world.save({ base: 5 }), TypeError);
    assert.throws(() => world.save({ base: difference }), { code: 'FE_ERROR_DATA' });
    assert.equal(world.restore(difference, { base }), true);
    assert.equal(world.hash, at);
    copy.destroy(), world.destroy();
});

test('a history goes back bit for bit, and refuses frames that it has not', () => {
    const world = new World(), bodies = pile(world), history = world.createHistory({ frames: 4 }), hashes = [];
    for (let i = 0; i < 10; ++i) {
        history.keep(i);
        hashes[i] = world.hash;
        world.step(1 / 60);
    }
    assert.deepEqual(history.frames.map((f) => f.frame), [6, 7, 8, 9]);
    const end = world.hash;
    for (const again of [1, 2]) {
        bodies[0].addImpulse([0, 900 * again, 0]);
        history.restore(6);
        assert.equal(world.hash, hashes[6]);
        for (let i = 6; i < 10; ++i) world.step(1 / 60);
        assert.equal(world.hash, end);
    }
    assert.throws(() => history.restore(9), { code: 'FE_ERROR_STALE' });
    assert.throws(() => history.keep(3), { code: 'FE_ERROR_ARGUMENT' });
    assert.throws(() => history.keep(0.5), TypeError);
    history.destroy();
    assert.throws(() => history.keep(99), { code: 'FE_ERROR_STALE' });
    const other = world.createHistory();
    world.destroy();
    assert.throws(() => other.frames, { code: 'FE_ERROR_STALE' });
});

test('poses of moved bodies are views that no step makes anew, unless memory grows', () => {
    const world = new World(), bodies = pile(world, 100);
    world.step(1 / 60);
    const moved = world.getMoved(), { poses } = moved;
    assert.equal(moved.count, 100);
    world.step(1 / 60);
    assert.equal(world.getMoved(), moved);
    assert.equal(moved.poses, poses);
    const check = () => {
        for (let k = 0; k < moved.count; ++k) {
            const body = world.body(moved.ids[k]), p = body.position, q = body.rotation;
            assert.deepEqual([...moved.poses.subarray(7 * k, 7 * k + 7)], [p.x, p.y, p.z, q.x, q.y, q.z, q.w].map(Math.fround));
        }
    };
    check();
    near(world.getMoved([100, 0, 0]).poses[0], -100, 2);
    const list = world.list(bodies), before = list.poses();
    const worlds = Array.from({ length: 40 }, () => { const w = new World(); pile(w, 300); w.step(1 / 60); return w; });
    assert.equal(before.length, 0, 'memory has not grown: make more worlds');
    world.step(1 / 60), world.getMoved();
    check();
    assert.equal(list.poses().length, 700);
    worlds.forEach((w) => w.destroy());
    world.destroy();
});

test('lists of bodies read and write many at once', () => {
    const world = new World({ gravity: [0, 0, 0] }), bodies = pile(world, 10), list = world.list(bodies);
    const v = list.velocities();
    v[6] = 3;
    list.setVelocities(v); // its own view
    assert.equal(bodies[1].linearVelocity.x, 3);
    list.setVelocities(Array.from({ length: 60 }, (_, k) => k));
    assert.deepEqual(bodies[2].angularVelocity, { x: 15, y: 16, z: 17 });
    list.addForces(new Float32Array(60).fill(1));
    list.setTransforms(bodies.map((_, k) => ({ position: [5 * k, 9, 0] })));
    assert.equal(list.transforms()[3].position.x, 15);
    assert.throws(() => list.setVelocities([1]), TypeError);
    assert.throws(() => list.setTransforms([]), TypeError);
    list.destroy();
    world.destroy();
});

test('rays in many agree with rays in one', () => {
    const world = new World();
    pile(world);
    for (let i = 0; i < 30; ++i) world.step(1 / 60);
    const rays = Float64Array.from({ length: 600 }, (_, k) => [(k % 7) - 1, 50, (k % 5) - 1, 0.25, -100, 0][k % 6]);
    const many = world.raycastMany(rays), raw = world.raycastRaw(rays), { HitLayout } = feather;
    for (let k = 0; k < 100; ++k) {
        const one = world.raycast([...rays.subarray(6 * k, 6 * k + 3)], [...rays.subarray(6 * k + 3, 6 * k + 6)]);
        assert.deepEqual(many[k], one);
        if (one) {
            assert.equal(raw.doubles[(raw.stride >> 1) * k + HitLayout.fraction], one.fraction);
            assert.equal(raw.words[raw.stride * k + HitLayout.body + 1] * 2 ** 32 + raw.words[raw.stride * k + HitLayout.body], one.body);
            assert.equal(raw.floats[raw.stride * k + HitLayout.normal + 1], one.normal.y);
        }
    }
    assert.ok(many.some((h) => h) && world.raycastMany([99, 9, 99, 0, 1, 0])[0] === null);
    world.destroy();
});

test('what is drawn are views: as many instances as shapes, triangles that enclose a volume', () => {
    const world = new World(), bodies = pile(world, 20);
    const drawn = world.drawInstances();
    assert.equal(drawn.count, 21);
    assert.equal(feather.instanceType(drawn, 1), 'box');
    const { count, stride, floats } = world.drawTriangles({ only: bodies[0] });
    let volume = 0;
    for (let k = 0; k < count; k += 3) {
        const [a, b, c] = [0, 1, 2].map((j) => floats.subarray((k + j) * stride, (k + j) * stride + 3));
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
    }
    near(volume, 1, 1e-5);
    for (let i = 0; i < 120; ++i) world.step(1 / 60);
    assert.ok(world.drawPoints({ parts: 'contacts' }).count > 0);
    assert.equal(world.drawLines({ parts: ['bounds'] }).count % 2, 0);
    world.destroy();
});

test('events and contacts', () => {
    const world = new World(), [body] = pile(world, 1), seen = {};
    world.shape(body.shapes[0]).events = ['touch', 'hit'];
    let speed = 0;
    for (let i = 0; i < 200; ++i) {
        world.step(1 / 60);
        for (const e of world.pairEvents) seen[e.kind] = e;
        for (const e of world.hitEvents) speed = e.speed;
        for (const e of world.bodyEvents) seen[e.kind] = e;
    }
    assert.equal(seen.enter.bodyB, body.id);
    assert.equal(seen.sleep.body, body.id);
    near(speed, Math.sqrt(2 * 9.81 * 1), 0.3);
    assert.equal(body.contacts[0].pointCount, 4);
    world.destroy();
});

test('joints of every type read what was written', () => {
    const world = new World(), [a, b] = pile(world, 2);
    const rod = world.addDistanceJoint(a, b, a.position, b.position, { springHertz: 2 });
    rod.distance = { upper: 9, lower: 1 };
    assert.equal(rod.distance.upper, 9);
    assert.equal(rod.distance.springHertz, 2);
    const fixed = world.addFixedJoint(a, b, [0, 2, 0]);
    fixed.fixed = { angularHertz: 4 };
    assert.equal(fixed.fixed.angularHertz, 4);
    const slider = world.addSliderJoint(a, b, [0, 2, 0], [0, 1, 0]), axes = slider.configurable.axes;
    assert.deepEqual(axes.map((x) => x.motion), ['free', 'locked', 'locked', 'locked', 'locked', 'locked']);
    axes[0] = { motion: 'limited', lower: -1, upper: 1 };
    slider.configurable = { axes };
    assert.equal(slider.configurable.axes[0].lower, -1);
    assert.deepEqual(fixed.getBodies(), { bodyA: a.id, bodyB: b.id });
    assert.throws(() => fixed.hinge, { code: 'FE_ERROR_STATE' });
    for (const joint of [rod, fixed, slider]) {
        joint.destroy();
        assert.equal(joint.isValid, false);
        for (const type of ['distance', 'fixed', 'configurable']) {
            assert.throws(() => joint[type], { code: 'FE_ERROR_STALE' });
            assert.throws(() => (joint[type] = {}), { code: 'FE_ERROR_STALE' });
        }
    }
    world.destroy();
});

test('assets: materials of meshes, heights, parts, a store that worlds share', () => {
    const store = new Store(), one = new World({ store }), two = new World({ store });
    const ground = store.createMesh({ vertices: new Float32Array([-9, 0, -9, -9, 0, 9, 9, 0, 9, 9, 0, -9]), indices: new Uint16Array([0, 1, 2, 0, 2, 3]), materials: [{ userId: 5 }, { userId: 6 }], triangleMaterials: [0, 1], triangleData: [7, 8] });
    assert.deepEqual(ground.getTriangle(1).data, 8);
    for (const w of [one, two]) w.createBody({ type: 'static' }).createShape(ground);
    assert.equal(one.raycast([5, 1, -5], [0, -2, 0]).material, 6);
    ground.setMaterials([{ userId: 1 }, { userId: 2 }]);
    assert.equal(two.raycast([5, 1, -5], [0, -2, 0]).material, 2);
    assert.throws(() => store.destroy(), { code: 'FE_ERROR_STATE' });
    one.destroy(), two.destroy();
    store.destroy();
    assert.throws(() => ground.info, { code: 'FE_ERROR_STALE' });
    const world = new World();
    assert.throws(() => world.createHeightfield({ rows: 3, columns: 3, cellX: 1, cellZ: 1, heights: [1] }), TypeError);
    assert.throws(() => world.createHeightfield({ rows: 3, columns: 3, cellX: 1, cellZ: 1 }), { code: 'FE_ERROR_ARGUMENT' });
    assert.throws(() => world.createMesh({ vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0], indices: [0, 1, 2], triangleData: [] }), TypeError);
    assert.throws(() => world.createMesh({ vertices: [0, 0], indices: [0, 1, 2] }), TypeError);
    assert.throws(() => world.createMesh({ vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0], indices: [0, 1, 3] }), { code: 'FE_ERROR_ARGUMENT' });
    assert.throws(() => world.createHull([0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3]), { code: 'FE_ERROR_DEGENERATE' });
    assert.equal(world.createCompound([{ geometry: { type: 'sphere', radius: 2 }, density: 7 }]).getPart(0).geometry.radius, 2);
    world.destroy();
});

test('worlds end by using, twice is no harm, and leave no memory behind', async () => {
    const { x } = await import(file('core.js'));
    let pages = 0;
    for (let i = 0; i < 300; ++i) {
        const world = new World();
        pile(world, 60);
        world.step(1 / 60), world.getMoved(), world.drawTriangles(), world.save(), world.list(world.bodies).destroy();
        world[Symbol.dispose ?? Symbol.for('Symbol.dispose')]();
        world[Symbol.dispose ?? Symbol.for('Symbol.dispose')]();
        if (i === 50) pages = x.memory.buffer.byteLength;
    }
    assert.equal(x.memory.buffer.byteLength, pages);
});

test('an array that no memory holds is an error, and the world lives on', () => {
    const world = new World(), refusal = { code: 'FE_ERROR_MEMORY' };
    pile(world, 3);
    for (const length of [2 ** 29, 2 ** 30, 2 ** 40]) { // beyond 2^32 bytes, where a size of 32 bits begins anew
        const ending = (n) => ({ length: n, [n - 1]: 0 });
        assert.throws(() => world.list(ending(length)), refusal);
        assert.throws(() => world.destroyBodies(ending(length)), refusal);
        assert.throws(() => world.createHull({ points: ending(3 * length) }), refusal);
    }
    world.step(1 / 60);
    assert.equal(world.bodies.length, 4);
    assert.equal(world.list(world.bodies).poses().length, 28);
});

test('an array of nothing takes no memory, and a large one gives it back', async () => {
    const { room } = await import(file('core.js')), world = new World(), large = 2 ** 26;
    const level = { rows: 2, columns: 2, cellX: 1, cellZ: 1, heights: [0, 0, 0, 0] };
    world.list(world.bodies);
    const first = room().bytes;
    assert.throws(() => world.createHeightfield({ ...level, holes: { length: 1e9 } }), TypeError);
    assert.ok(room().bytes > first - 100, 'all but the heights is free');
    assert.throws(() => world.createHeightfield({ ...level, holes: new Uint8Array(large) }), TypeError);
    world.list(world.bodies);
    assert.ok(room().bytes < large);
    world.destroy();
});
