// inline.mjs - feather-physics/inline: the module, deflated, as base64 in a script, for hosts that serve no other files.
//   node inline.mjs feather.wasm > inline.js
import { readFileSync } from 'node:fs';
import { deflateSync, constants } from 'node:zlib';

const bytes = readFileSync(process.argv[2]), deflated = deflateSync(bytes, { level: constants.Z_BEST_COMPRESSION });
console.log(`// Made from feather.wasm by bindings/js/inline.mjs
import Start from './module.js';
import { inflate } from './inflate.js';
export * from './module.js';
const text = '${deflated.toString('base64')}';
const SIZE = ${bytes.length}, HEADER = 2; // bytes; of zlib
function deflated() {
    const binary = atob(text), bytes = new Uint8Array(binary.length);
    for (let k = 0; k < bytes.length; ++k) bytes[k] = binary.charCodeAt(k);
    return bytes;
}
const sync = () => inflate(deflated().subarray(HEADER), SIZE);
async function bytes() {
    if (typeof DecompressionStream === 'undefined') return sync();
    const out = new Uint8Array(SIZE), reader = new Blob([deflated()]).stream().pipeThrough(new DecompressionStream('deflate')).getReader();
    for (let at = 0; at < SIZE;) {
        const { value } = await reader.read();
        out.set(value, at), at += value.length;
    }
    return out;
}
export default function Feather() { return Start(bytes()); }
Feather.sync = () => Start.sync(sync());`);
