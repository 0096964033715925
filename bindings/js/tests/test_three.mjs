// feather-physics/three on a mesh that has what three's has; examples/web is the same with three itself.
import test from 'node:test';
import assert from 'node:assert/strict';
import feather, { file } from './package.mjs';
const { World } = feather;
const { BodyInstances } = await import(file('three.js'));
const fake = (n) => ({ count: 0, instanceMatrix: { count: n, array: new Float32Array(16 * n), needsUpdate: false } });
// column-major 4 x 4, and a point
const times = (m, o, [x, y, z]) => [0, 1, 2].map((k) => m[o + k] * x + m[o + 4 + k] * y + m[o + 8 + k] * z + m[o + 12 + k]);
const near = (a, b) => a.forEach((v, k) => assert.ok(Math.abs(v - b[k]) < 1e-5, `${a} is not ${b}`));

test('instances stand where the bodies do, between two steps, and turn with them', () => {
    const world = new World({ gravity: [0, 0, 0] }), mesh = fake(3);
    const turning = world.createBody({ position: [1, 2, 3], angularVelocity: [0, 0, 6], linearVelocity: [6, 0, 0] });
    turning.addBox(1, 1, 1);
    const still = world.createBody({ type: 'static', position: [9, 0, 0] });
    still.addBox(1, 1, 1);
    const drawn = new BodyInstances(mesh, world, [turning, still], [1, 1, 1, 2, 2, 2]), m = mesh.instanceMatrix.array;
    assert.equal(mesh.count, 2);
    near(times(m, 0, [1, 0, 0]), [2, 2, 3]);
    near(times(m, 16, [1, 0, 0]), [11, 0, 0]);
    world.step(1 / 60);
    drawn.keep(world.getMoved());
    drawn.draw(0);
    near(times(m, 0, [1, 0, 0]), [2, 2, 3]);
    drawn.draw(0.5); // half way in both
    near(times(m, 0, [1, 0, 0]), [1.05 + Math.cos(0.05), 2 + Math.sin(0.05), 3]);
    drawn.draw(1);
    near(times(m, 0, [1, 0, 0]), [1.1 + Math.cos(0.1), 2 + Math.sin(0.1), 3]);
    turning.linearVelocity = [0, 0, 0], turning.angularVelocity = [0, 0, 0];
    for (let i = 0; i < 3; ++i) world.step(1 / 60), drawn.keep(world.getMoved()), drawn.draw(0.3);
    near(times(m, 0, [0, 0, 0]), [1.1, 2, 3]);
    assert.equal(mesh.instanceMatrix.needsUpdate, true);
    assert.equal(drawn.bodyOf(1), still.id);
    assert.throws(() => new BodyInstances(fake(1), world, [turning, still]), RangeError);
    assert.throws(() => new BodyInstances(mesh, world, [turning, still], [1]), TypeError);
    world.destroy();
});
