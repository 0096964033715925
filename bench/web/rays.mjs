// What calls across the border cost: rays in one and in many, poses of moved bodies, the start.  node rays.mjs
import { readFileSync } from 'node:fs';
const from = process.env.FEATHER_PACKAGE ?? new URL('../../build/js', import.meta.url).pathname;
const cpu = () => (process.cpuUsage().user + process.cpuUsage().system) / 1000; // ms
const best = (times, run) => Math.min(...Array.from({ length: times }, () => { const start = cpu(); run(); return cpu() - start; }));

const bytes = readFileSync(`${from}/feather.wasm`), begun = cpu();
const { default: Feather } = await import(`${from}/index.js`);
const { World } = await Feather(bytes), started = cpu() - begun, world = new World({ substeps: 4 });
world.tuning = { sleepEnabled: false };
world.createBody({ type: 'static' }).addBox(30, 1, 30);
for (let i = 0; i < 2000; ++i) world.createBody({ position: [(i % 20) * 1.5 - 15, 2 + Math.floor(i / 400) * 1.5, (Math.floor(i / 20) % 20) * 1.5 - 15] }).addBox(0.5, 0.5, 0.5);
for (let i = 0; i < 30; ++i) world.step(1 / 60);

const RAYS = 20000, rays = new Float64Array(6 * RAYS);
let seed = 1;
const u = () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32;
for (let k = 0; k < RAYS; ++k) rays.set([40 * u() - 20, 30 * u(), 40 * u() - 20, 5 * (u() - 0.5), -25, 5 * (u() - 0.5)], 6 * k);
const origin = [0, 0, 0], by = [0, 0, 0];
const one = best(8, () => {
    for (let k = 0; k < 6 * RAYS; k += 6) {
        origin[0] = rays[k], origin[1] = rays[k + 1], origin[2] = rays[k + 2], by[0] = rays[k + 3], by[1] = rays[k + 4], by[2] = rays[k + 5];
        world.raycast(origin, by);
    }
});
const many = best(8, () => world.raycastMany(rays)), raw = best(8, () => world.raycastRaw(rays));
const READS = 200, moved = world.getMoved().count, read = best(5, () => { for (let k = 0; k < READS; ++k) world.getMoved(); });
console.log(`start ${started.toFixed(1)} ms, memory ${(world.save().length / 1024).toFixed(0)} KB as a snapshot of ${moved} moved bodies`);
console.log(`rays a microsecond: ${(RAYS / one / 1000).toFixed(2)} in one, ${(RAYS / many / 1000).toFixed(2)} in many, ${(RAYS / raw / 1000).toFixed(2)} raw`);
console.log(`poses ${((read * 1e6) / READS / moved).toFixed(1)} ns a body`);
