// docs/reference/javascript.md has every public name of the module, and no other; the types it is made of are those that
// the package ships.
import test from 'node:test';
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { file } from './package.mjs';
const { default: Feather } = await import(file('index.js'));
const module = await Feather();
const page = readFileSync(new URL('../../../docs/reference/javascript.md', import.meta.url), 'utf8');

// group -> names of its members
const groups = new Map();
for (const part of page.split(/^## /m).slice(2)) {
    const title = part.slice(0, part.indexOf('\n'));
    const names = new Set();
    for (const [, name] of part.matchAll(/^\*\*`(?:static )?(\[Symbol\.dispose\]|\w+)/gm)) names.add(name);
    groups.set(title, names);
}
// of a class, with what it inherits in the module; what begins with _ is private
const membersOf = (kind) => {
    const found = new Set();
    const above = kind.prototype instanceof Error ? Error.prototype : Object.prototype;
    for (let p = kind.prototype; p !== above; p = Object.getPrototypeOf(p)) {
        for (const name of Object.getOwnPropertyNames(p)) if (!(name in above) && !name.startsWith('_')) found.add(name);
    }
    for (const name of Object.getOwnPropertyNames(kind)) if (typeof kind[name] === 'function' && !name.startsWith('_')) found.add(name);
    return found;
};
const isClass = (value) => typeof value === 'function' && /^class/.test(value.toString());

test('every name of the module stands in the page', () => {
    for (const [name, value] of Object.entries(module)) {
        const names = groups.get(name);
        assert.ok(names, name);
        if (!isClass(value)) continue;
        for (const member of membersOf(value)) assert.ok(names.has(member), `${name}.${member}`);
    }
});

test('what the page says of a class is there', () => {
    const world = new module.World(), body = world.createBody(), shape = body.addSphere(1);
    const made = { World: world, Body: body, Shape: shape, Bodies: world.list([body]), Store: world.store, Hull: world.createHull([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]) };
    for (const [name, object] of Object.entries(made)) {
        for (const member of groups.get(name)) {
            if (member === 'new' || member === 'class' || member.startsWith('[') || member in module[name]) continue;
            assert.ok(member in object, `${name}.${member}`);
        }
    }
    world.destroy();
});

test('the types that are kept are those that are shipped', () => {
    const kept = readFileSync(new URL('../library/api.d.ts', import.meta.url), 'utf8');
    assert.equal(readFileSync(file('api.d.ts'), 'utf8'), kept);
});
