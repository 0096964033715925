// sum.js - the sum in a chunk's header, for chunks that were unpacked here: src/core/bytes.h, src/snapshot/format.c.
const FACTOR = 0x9e3779b97f4a7c15n, ALL = (1n << 64n) - 1n, LANES = 8;

function stirred(words) {
    let state = 0n;
    for (const word of words) state = ((state ^ word) * FACTOR) & ALL, state ^= state >> 32n;
    return state;
}
const hashed = (words) => stirred([...words, BigInt(words.length), 0n, 0n]);

// `view`: the whole chunk, its content padded
export function chunkSum(view, size) {
    const lanes = new Array(LANES).fill(0n);
    for (let at = 32, k = 0; at < view.byteLength; at += 8, ++k) {
        let state = ((lanes[k % LANES] ^ view.getBigUint64(at, true)) * FACTOR) & ALL;
        lanes[k % LANES] = state ^ (state >> 32n);
    }
    const content = hashed([...lanes, BigInt(view.byteLength - 32)]);
    return hashed([hashed([view.getBigUint64(0, true), BigInt(size)]), view.getBigUint64(24, true), content]);
}
