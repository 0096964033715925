// modules.mjs - what the page is made of, without a page: players, the worker, links, copied calls, in node.
import test from 'node:test';
import assert from 'node:assert/strict';
import { register } from 'node:module';
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

register('./resolve.mjs', import.meta.url);
const from = (name) => import(new URL(`../src/${name}`, import.meta.url));
const { default: Feather, World } = await import(`${pathToFileURL(process.env.FEATHER_PACKAGE).href}/module.js`);
await Feather(readFileSync(`${process.env.FEATHER_PACKAGE}/feather.wasm`));
const { Playback } = await from('playback.js'), { Recording } = await from('recording.js');

const STEPS = 400, EVERY = 100; // steps of the recording, and between its keyframes
function make(first = 0) {
    const world = new World();
    world.createBody({ type: 'static' }).addPlane([0, 1, 0], 0);
    for (let k = 0; k < 5; ++k) world.createBody({ position: [0.1 * k, 1 + 1.1 * k, 0] }).addBox(0.5, 0.5, 0.5);
    world.createBody({ type: 'kinematic', position: [9, 9, 9], angularVelocity: [0, 1, 0] }).addBox(1, 1, 1); // never rests
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
    assert.equal((await recording.push(whole)).length, 0);
    assert.match(recording.broken, /is said to have/);
});
