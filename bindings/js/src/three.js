// feather-physics/three: bodies as the instances of an InstancedMesh, drawn between two steps. It needs nothing of three
// itself but the mesh it is handed.

// Bodies of one form. `mesh` is an InstancedMesh with room for them; `scales` has 3 numbers a body, or 3 for all.
export class BodyInstances {
    #before;
    #now;
    #moving = new Set(); // slots whose two poses differ, or did when they were drawn last
    #slots = new Map(); // slot of a body's handle
    constructor(mesh, world, bodies, scales = [1, 1, 1]) {
        const n = bodies.length;
        if (mesh.instanceMatrix.count < n) throw new RangeError(`the mesh has room for ${mesh.instanceMatrix.count} instances, not for ${n}`);
        if (scales.length !== 3 && scales.length !== 3 * n) throw new TypeError(`scales must be an array of 3 or ${3 * n}`);
        this.mesh = mesh, this.world = world, this.scales = scales, this.ids = bodies.map((b) => b.id ?? b);
        this.ids.forEach((id, slot) => this.#slots.set(id, slot));
        const list = world.list(bodies);
        this.#now = list.poses().slice();
        this.#before = this.#now.slice();
        list.destroy();
        mesh.count = n;
        for (let slot = 0; slot < n; ++slot) this.#moving.add(slot);
        this.draw(1);
    }
    // The handle of an instance's body, as three's raycaster numbers them
    bodyOf(instance) { return this.ids[instance]; }
    // Once after each step: what it moved
    keep(moved) {
        const { count, ids, poses } = moved, now = this.#now, before = this.#before;
        for (const slot of this.#moving) for (let k = 7 * slot; k < 7 * slot + 7; ++k) before[k] = now[k];
        for (let i = 0; i < count; ++i) {
            const slot = this.#slots.get(ids[i]);
            if (slot === undefined) continue;
            for (let k = 0; k < 7; ++k) now[7 * slot + k] = poses[7 * i + k];
            this.#moving.add(slot);
        }
    }
    // Once a frame: where the bodies are `part` of a step, 0..1, after the last but one
    draw(part = 1) {
        const now = this.#now, before = this.#before, matrix = this.mesh.instanceMatrix, out = matrix.array, scales = this.scales;
        for (const slot of this.#moving) {
            const i = 7 * slot, o = 16 * slot, s = scales.length === 3 ? 0 : 3 * slot;
            let same = true, dot = 0;
            for (let k = i; k < i + 7; ++k) same &&= before[k] === now[k];
            for (let k = i + 3; k < i + 7; ++k) dot += before[k] * now[k];
            const a = same ? 0 : 1 - part, b = same ? 1 : part, sign = dot < 0 ? -a : a; // the shorter way round
            let x = sign * before[i + 3] + b * now[i + 3], y = sign * before[i + 4] + b * now[i + 4];
            let z = sign * before[i + 5] + b * now[i + 5], w = sign * before[i + 6] + b * now[i + 6];
            const r = 1 / Math.hypot(x, y, z, w), [sx, sy, sz] = [scales[s], scales[s + 1], scales[s + 2]];
            x *= r, y *= r, z *= r, w *= r;
            out[o] = (1 - 2 * (y * y + z * z)) * sx, out[o + 1] = 2 * (x * y + z * w) * sx, out[o + 2] = 2 * (x * z - y * w) * sx, out[o + 3] = 0;
            out[o + 4] = 2 * (x * y - z * w) * sy, out[o + 5] = (1 - 2 * (x * x + z * z)) * sy, out[o + 6] = 2 * (y * z + x * w) * sy, out[o + 7] = 0;
            out[o + 8] = 2 * (x * z + y * w) * sz, out[o + 9] = 2 * (y * z - x * w) * sz, out[o + 10] = (1 - 2 * (x * x + y * y)) * sz, out[o + 11] = 0;
            for (let k = 0; k < 3; ++k) out[o + 12 + k] = a * before[i + k] + b * now[i + k];
            out[o + 15] = 1;
            if (same) this.#moving.delete(slot);
        }
        matrix.needsUpdate = true;
    }
}

// The ray under a place of the screen, x and y from -1 to 1, for World.raycast
export function rayOf(camera, x, y, length = 1000) {
    const Vector = camera.position.constructor, from = new Vector().setFromMatrixPosition(camera.matrixWorld);
    const to = new Vector(x, y, 0.5).unproject(camera).sub(from).setLength(length);
    return [from, to];
}
