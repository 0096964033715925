// What /inline unpacks, against zlib: every kind of block, lengths and distances, nothing at all.
import test from 'node:test';
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { deflateRawSync, constants } from 'node:zlib';
import { file } from './package.mjs';
const { inflate } = await import(file('inflate.js'));

test('inflate gives back what zlib deflated', () => {
    let state = 1;
    const noise = Uint8Array.from({ length: 200000 }, () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) >>> 24);
    const contents = [readFileSync(file('feather.wasm')), new Uint8Array(0), Uint8Array.of(7), noise, new Uint8Array(100000), Buffer.from('abcabc'.repeat(3000))];
    const ways = [{ level: 9 }, { level: 1 }, { level: 0 }, { strategy: constants.Z_FIXED }, { strategy: constants.Z_HUFFMAN_ONLY }];
    for (const content of contents) for (const way of ways) assert.ok(Buffer.from(inflate(deflateRawSync(content, way), content.length)).equals(content));
});
