// Speed in node beside other engines: ms of processor time a step, 10th percentile, and how many times Feather's.
//   make js; cd bench/web; npm ci; node index.mjs [engine,...] [scene,...]
import { execFileSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { engines } from './engines.mjs';
import { scenes } from './scenes.mjs';

const cpu = () => process.cpuUsage().user + process.cpuUsage().system; // us
async function measure(name, scene) {
    const engine = await engines[name](), [build, before, timed] = scenes[scene], bodies = [], keep = (make) => (...a) => { const b = make(...a); if (!a.at(-1)?.fixed) bodies.push(b); return b; };
    build({ ...engine, box: keep(engine.box), sphere: keep(engine.sphere), capsule: keep(engine.capsule) });
    for (let i = 0; i < before; ++i) engine.step();
    const times = [];
    for (let i = 0; i < timed; ++i) {
        const start = cpu();
        engine.step();
        times.push(cpu() - start);
    }
    times.sort((a, b) => a - b);
    return { ms: times[Math.floor(timed / 10)] / 1000, height: bodies.reduce((sum, b) => sum + engine.height(b), 0) / bodies.length };
}

if (process.argv[2] === '--one') {
    console.log(JSON.stringify(await measure(process.argv[3], process.argv[4])));
} else {
    const names = process.argv[2]?.split(',') ?? Object.keys(engines), chosen = process.argv[3]?.split(',') ?? Object.keys(scenes), rows = {};
    for (const name of names) {
        for (const scene of chosen) {
            const told = JSON.parse(execFileSync(process.execPath, [fileURLToPath(import.meta.url), '--one', name, scene], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }).trim().split('\n').at(-1));
            (rows[name] ??= {})[scene] = told;
            console.error(`${name} ${scene} ${told.ms.toFixed(2)} ms, mean height ${told.height.toFixed(3)}`);
        }
    }
    console.log(`| ms | ${chosen.join(' | ')} | mean |\n|---|${'---|'.repeat(chosen.length + 1)}`);
    for (const name of names) {
        const ratios = chosen.map((s) => rows[name][s].ms / (rows.feather ?? rows[names[0]])[s].ms);
        console.log(`| ${name} | ${chosen.map((s, k) => `${rows[name][s].ms.toFixed(2)} (${ratios[k].toFixed(2)})`).join(' | ')} | ${Math.exp(ratios.reduce((sum, r) => sum + Math.log(r), 0) / ratios.length).toFixed(2)} |`);
    }
}
