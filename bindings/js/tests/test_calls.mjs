// Every call: right, on what is gone, with each argument of a wrong type, with NaN in each number, with another world's
// handle. What is refused changes nothing.
import test from 'node:test';
import assert from 'node:assert/strict';
import feather from './package.mjs';
import { CALLS, APART, ELSEWHERE, makeWorld, subject, invoke, owner, isMethod } from './calls.mjs';
const { World, FeatherError } = feather;
const kinds = Object.keys(CALLS);

function members(on) {
    const names = new Set();
    for (let at = Object.getPrototypeOf(on); at !== Object.prototype; at = Object.getPrototypeOf(at)) {
        for (const name of Object.getOwnPropertyNames(at)) names.add(name);
    }
    return [...names].filter((name) => !APART.has(name) && !ELSEWHERE.has(name));
}

test('the table has every method, and every property as often as it can be read and written', () => {
    const s = makeWorld(feather), by = new Map();
    for (const kind of kinds) {
        const on = subject(s, kind), Class = on.constructor;
        const seen = by.get(Class) ?? { on, names: new Set() };
        for (const [name, ...args] of CALLS[kind](s)) seen.names.add(isMethod(on, name) || args.length ? `${name}=` : name);
        by.set(Class, seen);
    }
    for (const [Class, { on, names }] of by) {
        for (const name of members(on)) {
            const d = Object.getOwnPropertyDescriptor(owner(on, name), name);
            if (!['hull', 'heightfield', 'mesh', 'compound'].includes(on.type) || Class.prototype.hasOwnProperty(name)) {
                if (d.get) assert.ok(names.has(name), `${Class.name}.${name} is not read`);
                if (d.set || d.value) assert.ok(names.has(`${name}=`), `${Class.name}.${name} is not called`);
            }
        }
    }
    s.world.destroy();
});

for (const kind of kinds) {
    test(`${kind}: right`, () => {
        const s = makeWorld(feather), on = subject(s, kind);
        for (const call of CALLS[kind](s)) {
            const result = invoke(on, call);
            if (call.length === 1 && !isMethod(on, call[0])) assert.notEqual(result, undefined, call[0]);
            if (call.length === 2 && !isMethod(on, call[0]) && typeof call[1] !== 'object' && typeof call[1] !== 'bigint') assert.equal(on[call[0]], call[1], call[0]);
        }
        s.world.step(1 / 60);
        s.world.destroy();
    });

    test(`${kind}: on what is destroyed, and in a world that is`, () => {
        const s = makeWorld(feather), on = subject(s, kind), refusal = { name: 'FeatherError', code: 'FE_ERROR_STALE' };
        const calls = CALLS[kind](s);
        if (kind !== 'world' && kind !== 'store') {
            on.destroy();
            for (const call of calls) {
                if (call[0] === 'isValid') assert.equal(on.isValid, false);
                else assert.throws(() => invoke(on, call), refusal, call[0]);
            }
            assert.throws(() => on.destroy(), refusal);
        }
        s.world.destroy();
        for (const call of calls) if (call[0] !== 'list') assert.throws(() => invoke(on, call), refusal, call[0]);
        assert.throws(() => s.world.destroy(), refusal);
    });

    test(`${kind}: wrong arguments`, () => {
        const s = makeWorld(feather), stranger = makeWorld(feather).body, foreign = new World({ number: 9 }).createBody();
        const on = subject(s, kind);
        let refused = 0;
        for (const call of CALLS[kind](s)) {
            for (let i = 1; i < call.length; ++i) {
                const wrongs = [Symbol('s'), () => 1, 'nonsense', NaN, { no: 1 }, [NaN, 0, 0], [1, 2], -1, 1e300, 2 ** 40, foreign, stranger.world];
                for (const value of wrongs) {
                    const before = s.world.hash, bad = [...call];
                    bad[i] = value;
                    try {
                        invoke(on, bad); // some are right: a number for another
                    } catch (error) {
                        assert.ok(error instanceof FeatherError || error instanceof TypeError, `${call[0]}: ${error.stack}`);
                        assert.ok(error.message.length > 10, error.message);
                        assert.equal(s.world.hash, before, `${call[0]} of ${String(value)} changed the world`);
                        ++refused;
                    }
                }
                const missing = call.slice(0, i);
                if (isMethod(on, call[0])) try { invoke(on, missing); } catch (error) { assert.ok(error instanceof FeatherError || error instanceof TypeError, error.stack); }
            }
        }
        if (CALLS[kind](s).some((c) => c.length > 1)) assert.ok(refused > 5);
        s.world.destroy();
    });
}
