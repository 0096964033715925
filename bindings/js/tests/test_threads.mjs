// feather-physics/threads: the same bits with any number of threads, and where a host gives none.
import test from 'node:test';
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { file } from './package.mjs';

const LIMIT = 120e3; // ms; a program whose threads do not sleep, or keep it alive, is ended
const play = (env) => execFileSync(process.execPath, [fileURLToPath(new URL('scenario.mjs', import.meta.url))], { encoding: 'utf8', timeout: LIMIT, env: { ...process.env, ...env } });
// What a program prints that has Feather from /threads
const run = (program) => execFileSync(process.execPath, ['--input-type=module', '--eval', program.replaceAll('PACKAGE', file('threads.js').href)], { encoding: 'utf8', timeout: LIMIT }).trim();
const one = play({ FEATHER_THREADS: '' });

for (const threads of [1, 2, 3, 8, 64]) {
    test(`${threads} threads: the bits of one`, () => assert.equal(play({ FEATHER_THREADS: String(threads) }), one));
}

const heap = `const world = new World();
    world.createBody({ type: 'static' }).addPlane([0, 1, 0], 0);
    for (let k = 0; k < 8000; ++k) world.createBody({ position: [k % 20 * 1.01, 0.5 + Math.floor(k / 400) * 1.01, Math.floor(k / 20) % 20 * 1.01] }).addBox(0.5, 0.5, 0.5);
    for (let k = 0; k < 20; ++k) world.step(1 / 60);
    const poses = world.getMoved().poses.slice(0, 7 * 8000);`;
test('memory that grows while threads share it', () => {
    const told = (start) => run(`${start} ${heap} console.log(world.hash, world.counters.workers, poses.length === 7 * 8000 && poses.every(Number.isFinite));`);
    const [hash] = told(`const { World } = (await import('${file('index.js')}')).default.sync((await import('node:fs')).readFileSync(new URL('${file('feather.wasm')}')));`).split(' ');
    assert.equal(told("const { World } = await (await import('PACKAGE')).default({ threads: 3 });"), `${hash} 3 true`);
});

test('snapshots and players have the threads too', () => {
    const told = run(`const { World, Player } = await (await import('PACKAGE')).default({ threads: 3 });
        const first = new World();
        first.createBody().addBox(1, 1, 1);
        const recorder = first.createRecorder();
        first.step(1 / 60);
        const second = World.load(first.save()), player = new Player(recorder.read());
        while (player.step());
        first.step(1 / 60), second.step(1 / 60), player.release().step(1 / 60);
        console.log(first.counters.workers, second.counters.workers, first.hash === second.hash);`);
    assert.equal(told, '3 3 true');
});

test('a page that is not isolated: one thread, and why', () => {
    const told = run(`globalThis.crossOriginIsolated = false;
        const feather = await (await import('PACKAGE')).default({ threads: 4 });
        const world = new feather.World();
        world.createBody().addBox(1, 1, 1), world.step(1 / 60);
        console.log(feather.threads, /Cross-Origin-Opener-Policy/.test(feather.reason));`);
    assert.equal(told, '1 true');
});

test('workers that do not start: one thread, and why', () => {
    const told = run(`globalThis.Worker = class { constructor() { throw new Error('no workers here'); } };
        const feather = await (await import('PACKAGE')).default({ threads: 4 });
        const world = new feather.World();
        world.createBody().addBox(1, 1, 1), world.step(1 / 60);
        console.log(feather.threads, feather.reason);`);
    assert.equal(told, '1 no workers here');
});

test('threads out of range', async () => {
    const { default: Feather } = await import(file('threads.js'));
    for (const threads of [0, -1, 65, 1.5, NaN, '2', null]) assert.throws(() => Feather({ threads }), TypeError);
});

test('a second start gives the first one', () => {
    assert.equal(run(`const { default: Feather } = await import('PACKAGE'); console.log(await Feather({ threads: 2 }) === await Feather());`), 'true');
});
