// inline.mjs - feather-physics/inline: the module, deflated, as text in a script, for hosts that serve no other files.
// 4 bytes are 5 digits of base 85, most significant first: a sixteenth shorter than base64.
//   node inline.mjs feather.wasm > inline.js
import { readFileSync } from 'node:fs';
import { deflateSync, constants } from 'node:zlib';

// Neither what ends a string or a script, nor what escapes
const digits = Array.from({ length: 126 - 35 }, (_, k) => String.fromCharCode(35 + k)).filter((c) => !'\'<\\`'.includes(c)).slice(0, 85).join('');
function encode(bytes) {
    const whole = Buffer.alloc(Math.ceil(bytes.length / 4) * 4);
    whole.set(bytes);
    let text = '';
    for (let at = 0; at < whole.length; at += 4) {
        const n = whole.readUInt32BE(at);
        for (let unit = 85 ** 4; unit >= 1; unit /= 85) text += digits[Math.floor(n / unit) % 85];
    }
    return text;
}
const bytes = readFileSync(process.argv[2]), deflated = deflateSync(bytes, { level: constants.Z_BEST_COMPRESSION });
console.log(`// Made from feather.wasm by bindings/js/inline.mjs
import Start from './module.js';
import { inflate } from './inflate.js';
export * from './module.js';
const text = '${encode(deflated)}', digits = '${digits}';
const SIZE = ${bytes.length}, DEFLATED = ${deflated.length}, HEADER = 2; // bytes; of zlib
function deflated() {
    const bytes = new Uint8Array(text.length / 5 * 4), view = new DataView(bytes.buffer), value = [];
    for (let k = 0; k < digits.length; ++k) value[digits.charCodeAt(k)] = k;
    for (let from = 0, to = 0; from < text.length; to += 4) {
        let n = 0;
        for (let k = 0; k < 5; ++k) n = n * 85 + value[text.charCodeAt(from++)];
        view.setUint32(to, n);
    }
    return bytes.subarray(0, DEFLATED);
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
