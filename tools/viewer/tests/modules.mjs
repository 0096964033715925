// modules.mjs - what the page is made of, without a page: players, the worker, links, copied calls, in node.
import test from 'node:test';
import assert from 'node:assert/strict';
import { register } from 'node:module';
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

register('./resolve.mjs', import.meta.url);
const from = (name) => import(new URL(`../src/${name}`, import.meta.url));
const feather = pathToFileURL(`${process.env.FEATHER_PACKAGE}/module.js`).href;
const { default: Feather, World, Player } = await import(feather);
await Feather(readFileSync(`${process.env.FEATHER_PACKAGE}/feather.wasm`));
const { Playback } = await from('playback.js'), { Recording } = await from('recording.js');

const STEPS = 400, EVERY = 100; // steps of the recording, and between its keyframes
function make(first = 0) {
    const world = new World();
    world.createBody({ type: 'static' }).addPlane([0, 1, 0], 0);
    for (let k = 0; k < 5; ++k) world.createBody({ position: [0.1 * k, 1 + 1.1 * k, 0] }).addBox(0.5, 0.5, 0.5);
    const mill = world.createBody({ type: 'kinematic', position: [9, 9, 9], angularVelocity: [0, 1, 0] });
    mill.addBox(1, 1, 1); // so that the world never rests
    for (let k = 0; k < first; ++k) world.step(1 / 60);
    const recorder = world.createRecorder({ keyframeSteps: EVERY });
    for (let k = 0; k < STEPS; ++k) world.step(1 / 60);
    const bytes = recorder.read();
    recorder.destroy(), world.destroy();
    return bytes;
}
const whole = make();
// Where the chunks of a kind begin
function chunksOf(bytes, kind) {
    const view = new DataView(bytes.buffer, bytes.byteOffset), places = [];
    for (let at = 40; at < bytes.length; at += 32 + Math.ceil(Number(view.getBigUint64(at + 8, true)) / 8) * 8) {
        if (String.fromCharCode(...bytes.subarray(at, at + 4)) === kind) places.push(at);
    }
    return places;
}
async function played(bytes) {
    const recording = new Recording(), playback = new Playback(recording);
    playback.feed(await recording.push(bytes));
    return playback;
}

test('in an altered recording one goes wherever it plays, in as many slices as it takes', async () => {
    const bytes = whole.slice();
    bytes[chunksOf(bytes, 'KEYF')[3] + 40] ^= 1; // of step 3 EVERY
    const good = await played(whole), p = await played(bytes);
    assert.match(p.error, /altered/);
    for (const step of [99, 5, 230, 3, 101]) {
        good.knows(STEPS), good.goTo(step), p.knows(STEPS), p.seek(step);
        for (let slice = 0; slice < 1000 && p.goal !== null; ++slice) p.work(0.5);
        assert.equal(p.step, step);
        assert.equal(p.world.hash, good.world.hash);
    }
    p.knows(STEPS), p.goTo(STEPS);
    assert.equal(p.step, 3 * EVERY);
    p.goTo(7);
    assert.equal(p.step, 7);
});

test('a place that is no number is none', async () => {
    const p = await played(whole);
    p.goTo(5);
    for (const none of [NaN, undefined]) p.seek(none), assert.equal(p.goal, null);
    assert.equal(p.step, 5);
    p.knows(STEPS), p.goTo(Infinity);
    assert.equal(p.step, STEPS);
});

test('after a break a recording takes nothing more', async () => {
    const recording = new Recording(), bytes = whole.slice(), at = chunksOf(bytes, 'OPS ')[0];
    bytes.fill(255, at + 8, at + 12), bytes[at + 12] = 1; // a size of more than 4 GB
    assert.ok((await recording.push(bytes.subarray(0, at + 40))).length);
    assert.match(recording.broken, /is said to have/);
    assert.equal((await recording.push(whole.subarray(at))).length, 0);
    assert.match(recording.broken, /is said to have/);
});

test('a link opens what is open, at the step', async () => {
    const { linkOf, wishOf } = await from('share.js'), camera = [1, 2, 3, 4, 5, 6.5];
    const of = (place) => linkOf('https://x.example/viewer.html?demo=2&step=9#a', place, 57, camera);
    const places = [[{ demo: 1 }, 'demo=1'], [{ url: 'a b.feather' }, 'url=a+b.feather'], [null, 'demo=none']];
    const seen = 'camera=1.000_2.000_3.000_4.000_5.000_6.500';
    for (const [place, wanted] of places) {
        assert.equal(of(place), `https://x.example/viewer.html?${wanted}&step=57&${seen}`);
    }
    const wish = wishOf(new URL(of({ url: 'a b.feather' })).search, '');
    assert.deepEqual([wish.step, wish.url, wish.ws], [57, 'a b.feather', null]);
    for (const step of ['abc', 'Infinity', 'NaN']) assert.equal(wishOf(`?step=${step}`, '').step, undefined);
});

test('copied calls hold what differs from the defaults, and nothing else', async () => {
    const { codeOf } = await from('code.js'), world = new World();
    const plain = world.createBody({ position: [1, 2, 3] });
    const other = world.createBody({ gravityScale: 0.5, bullet: true });
    plain.addSphere(0.5);
    other.setDamping(0.25, 0.125), other.setLocks(1, 6);
    const material = { restitution: 0.5 };
    other.addBox(0.5, 0.25, 1, { position: [0, 0.75, 0], trigger: true, group: -3, events: ['hit'], material });
    const [c, python] = ['c', 'python'].map((language) => codeOf(language, world, plain.id, 0));
    assert.doesNotMatch(c, /frame|damping|locks|layer|mask|group|material|velocity|awake/);
    const wanted = 'position=(1, 2, 3), rotation=(0, 0, 0, 1))\nbody.add_sphere(0.5, density=1000)\n';
    assert.ok(python.includes(wanted), python);
    const full = codeOf('c', world, other.id, 0);
    for (const line of [
        'def.linear_damping = 0.25f', 'def.angular_damping = 0.125f', 'def.linear_locks = 1', 'def.angular_locks = 6',
        'def.gravity_scale = 0.5f', 'def.bullet = 1', 'surface.frame.position = (fe_vec3){0.0f, 0.75f, 0.0f}',
        'surface.trigger = 1', 'surface.group = -3', 'surface.events = 4', 'surface.material.restitution = 0.5f',
    ]) assert.ok(full.includes(`${line};\n`), full);
    const text = codeOf('python', world, other.id, 0);
    for (const word of [
        'damping=(0.25, 0.125)', 'locks=("x", "yz")', 'gravity_scale=0.5', 'bullet=True', 'position=(0, 0.75, 0)',
        'trigger=True', 'group=-3', 'events=["hit"]', 'Material(restitution=0.5)',
    ]) assert.ok(text.includes(word), text);
    world.destroy();
});

test('the worker tells what it has found, what it cannot do, and of which recording', async () => {
    const told = [];
    globalThis.postMessage = (data) => told.push(data), globalThis.onmessage = null;
    await from('scan.js');
    const settled = async (what) => { while (!told.some(what)) await new Promise((go) => setTimeout(go, 5)); };
    const bytes = whole.slice();
    bytes[chunksOf(bytes, 'KEYF')[3] + 40] ^= 1;
    onmessage({ data: { clear: true, pins: [], generation: 7 } }), onmessage({ data: { feed: bytes } });
    await settled((m) => m.end !== undefined);
    assert.ok(told.every((m) => m.generation === 7));
    assert.equal(told.at(-1).end, 3 * EVERY);
    assert.equal(told.flatMap((m) => m.steps).length, 3 * EVERY + 1);
    told.length = 0;
    onmessage({ data: { pins: [], generation: 8 } });
    await settled((m) => m.end !== undefined);
    assert.ok(told.every((m) => m.generation === 8));
    const { step } = Player.prototype;
    const refused = Object.assign(new Error('nobody recorded that'), { code: 'FE_ERROR_DATA' });
    Player.prototype.step = function () {
        if (this.info.step === 150) throw refused;
        return step.call(this);
    };
    told.length = 0, onmessage({ data: { pins: [], generation: 10 } });
    await settled((m) => m.error);
    Player.prototype.step = step;
    assert.deepEqual([told.at(-1).error, told.at(-1).end, told.at(-1).generation], [refused.message, 150, 10]);
    assert.equal(told.flatMap((m) => m.steps ?? []).length, 151); // what stood before it is told too
    onmessage({ data: { clear: true, pins: [], generation: 11 } }), onmessage({ data: { feed: 'no bytes' } });
    await settled((m) => m.failed);
});

test('a worker that has failed is another one with the next recording, and old messages are none', async () => {
    const { Scanner } = await from('scanner.js'), workers = [], told = [];
    globalThis.Worker = class {
        constructor() { this.got = [], workers.push(this); }
        postMessage(data) { this.got.push(data); }
        terminate() { this.isGone = true; }
    };
    const app = { scanHeard() {}, scanEnded: (end, error) => told.push(error), diverged: () => told.push('diverged') };
    const scanner = new Scanner(app, 'the module', '');
    scanner.clear(), scanner.feed('a'), scanner.clear();
    const hears = (data) => workers.at(-1).onmessage({ data });
    hears({ generation: 1, divergence: {} }), hears({ generation: 1, error: 'of another recording', end: 3 });
    assert.deepEqual([told, scanner.ended], [[], false]);
    hears({ failed: 'no memory' });
    assert.match(told[0], /no memory/);
    assert.ok(workers.length === 2 && workers[0].isGone && scanner.ended);
    scanner.feed('b'), scanner.clear(), scanner.feed('c');
    const of = (name) => workers[1].got.filter((m) => m[name]).map((m) => m[name]);
    assert.deepEqual([of('module'), of('feed')], [['the module'], ['c']]);
});
