// Random calls with random arguments of every type: each returns, or throws a TypeError or a FeatherError. Nothing traps.
//   FUZZ_ROUNDS of 300 calls, FUZZ_SEED
import test from 'node:test';
import assert from 'node:assert/strict';
import feather from './package.mjs';
import { CALLS, makeWorld, subject, invoke, isMethod } from './calls.mjs';
const { FeatherError } = feather;

test('fuzz', () => {
    let state = Number(process.env.FUZZ_SEED ?? 1) >>> 0;
    const below = (n) => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return Math.floor((state / 2 ** 32) * n);
    };
    const odd = [undefined, null, true, NaN, Infinity, -0, 0, 1, -1, 0.5, 1e30, 2 ** 31, 2 ** 32, 2 ** 53, 5n, -5n, 'x', 'dynamic', '', [], [1], [1, 2, 3], [1, 2, 3, 4], [NaN, 0, 0], {}, { x: 1, y: 2, z: 3 }, { length: 3 },
        { length: -1 }, { length: 1e9 }, new Float32Array(3), new Uint8Array(7), new ArrayBuffer(8), () => 0, Symbol('s'), new Date(), new Map(), Object.create(null), new Proxy({}, {}), /x/];
    const kinds = Object.keys(CALLS), rounds = Number(process.env.FUZZ_ROUNDS ?? 30);
    let calls = 0, refused = 0;
    for (let round = 0; round < rounds; ++round) {
        const s = makeWorld(feather), tables = Object.fromEntries(kinds.map((k) => [k, CALLS[k](s)]));
        const mutate = (v, depth = 0) => {
            if (below(3) === 0 || depth > 2 || v === null || typeof v !== 'object') return odd[below(odd.length)];
            if (Array.isArray(v) && v.length) { const c = [...v], i = below(v.length); c[i] = mutate(c[i], depth + 1); return c; }
            const keys = Object.keys(v);
            if (!keys.length || v._h !== undefined || v._p !== undefined) return odd[below(odd.length)];
            const key = keys[below(keys.length)];
            return { ...v, [key]: mutate(v[key], depth + 1) };
        };
        for (let i = 0; i < 300; ++i) {
            const kind = kinds[below(kinds.length)], on = subject(s, kind), call = [...tables[kind][below(tables[kind].length)]];
            if (call.length > 1 && below(4)) { const at = 1 + below(call.length - 1); call[at] = mutate(call[at]); }
            if (isMethod(on, call[0]) && below(20) === 0) call.length = 1 + below(call.length);
            try {
                invoke(on, call);
            } catch (error) {
                assert.ok(error instanceof FeatherError || error instanceof TypeError || (error instanceof RangeError && /length|allocation/i.test(error.message)), `${kind}.${call[0]}: ${error.stack}`);
                ++refused;
            }
            ++calls;
        }
        s.world.step(1 / 60);
        s.world.destroy();
    }
    assert.ok(refused > calls / 10 && refused < calls * 0.9, `${calls} calls, ${refused} refused`);
});
