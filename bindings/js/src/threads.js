// feather-physics/threads: the module on shared memory, and workers of the host: one pool that all worlds step on. Where
// a host shares no memory, or starts no workers, the module of one thread: the same calls, the same bits.
import One from './index.js';
import { feather } from './module.js';
import { startShared, usePool } from './core.js';
export * from './module.js';

const MOST = 64; // threads of a pool
const USUAL = 8; // at most, when the number is not given
const FIRST_PAGES = 64, MOST_PAGES = 16384; // of 64 KB, as the module was linked: 4 MB at first, up to 1 GB

async function nodes(name) { return import(/* webpackIgnore: true */ /* @vite-ignore */ 'node:' + name); }

async function cores() {
    if (globalThis.navigator?.hardwareConcurrency) return navigator.hardwareConcurrency;
    const { availableParallelism, cpus } = await nodes('os');
    return availableParallelism?.() ?? cpus().length;
}
// A page's own thread may not.
function maySleep() {
    try {
        return Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 1) === 'not-equal';
    } catch {
        return false;
    }
}

async function compiled() {
    const url = new URL('./feather-threads.wasm', import.meta.url);
    if (url.protocol === 'file:') return WebAssembly.compile(await (await nodes('fs/promises')).readFile(url));
    const response = await fetch(url);
    return WebAssembly.compile(await response.arrayBuffer());
}
async function worker() {
    if (typeof Worker !== 'undefined') return new Worker(new URL('./thread.js', import.meta.url), { type: 'module' });
    const { Worker: Thread } = await nodes('worker_threads');
    return new Thread(new URL('./thread.js', import.meta.url), { execArgv: [] }); // --eval and its like are the program's
}
// Until the worker waits at its seat. It keeps no program alive.
function seated(made, message) {
    return new Promise((resolve, reject) => {
        const failed = (e) => reject(e instanceof Error ? e : new Error(e?.message || 'a worker did not start'));
        if (made.on) made.once('message', () => resolve(made.unref())), made.once('error', failed);
        else made.onmessage = () => resolve(made.unref?.()), made.onerror = failed;
        made.postMessage(message);
    });
}

async function start({ threads }) {
    const count = Math.min(threads ?? Math.min(await cores(), USUAL), MOST);
    if (globalThis.crossOriginIsolated === false) {
        throw new Error('the page is not isolated: serve it with Cross-Origin-Opener-Policy: same-origin and Cross-Origin-Embedder-Policy: require-corp');
    }
    const memory = new WebAssembly.Memory({ initial: FIRST_PAGES, maximum: MOST_PAGES, shared: true }), module = await compiled();
    const x = await startShared(module, memory);
    x.thread_begin(await cores(), maySleep());
    const made = [];
    let reason;
    for (let k = 1; k < count; ++k) {
        const seat = x.thread_seat();
        if (seat) made.push(worker().then((w) => seated(w, { module, memory, seat })).then(() => 1, (error) => (reason = error.message, 0)));
    }
    const ready = (await Promise.all(made)).reduce((sum, one) => sum + one, 1);
    usePool(ready);
    return Object.freeze({ ...feather, threads: ready, reason });
}

let started;
export default function Feather(options = {}) {
    const { threads } = options;
    if (threads !== undefined && !(Number.isInteger(threads) && threads >= 1 && threads <= MOST)) {
        throw new TypeError(`options.threads must be an integer of 1..${MOST}, is ${threads}`);
    }
    return (started ??= start(options).catch(async ({ message }) => Object.freeze({ ...(await One()), threads: 1, reason: message })));
}
