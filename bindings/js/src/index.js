// feather-physics: loads feather.wasm from beside this file, in browsers, node, Deno, Bun and what bundlers make.
import Start from './module.js';
export * from './module.js';

async function bytes() {
    const url = new URL('./feather.wasm', import.meta.url);
    if (url.protocol !== 'file:') return fetch(url);
    const files = 'node:fs/promises'; // by a name that no bundler follows: it is node's alone
    const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ files);
    return readFile(url);
}
let started;
export default function Feather(source) {
    return (started ??= Start(source ?? bytes()).catch((error) => {
        started = undefined;
        throw error;
    }));
}
Feather.sync = Start.sync;
