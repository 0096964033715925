// batch.js - what a world was, to go back to, and worlds that step together.
import { x, f32, f64, i32, u32, u64, u8, scratch, ok, reset, temp, allocate, num, int, handle, listIn, dvec3, word, wrong, dead, free, dispose } from './runtime.js';
import { AT, Field } from './api.js';

// A world as it was: of no world, for many. It never changes.
export class State {
    constructor(p) {
        this._p = p;
        free.register(this, () => x.fe_state_destroy(p), this);
    }
    _at() { return this._p || dead('state'); }
    destroy() {
        ok(x.fe_state_destroy(this._at()));
        free.unregister(this);
        this._p = 0;
    }
    [dispose]() { if (this._p) this.destroy(); }
}

const ROW = { transform: 7, velocity: 6, force: 6, awake: 1, joint: 2, jointForce: 1, jointSpeed: 1, jointTarget: 1, reaction: 6, gravity: 3, contactForce: 3, mass: 1, friction: 2 };
const KEEPS = new Set(['transform', 'velocity', 'gravity', 'mass', 'friction']); // what can be read and written

// Numbers in the module's memory that each step of a batch reads or fills: world, item, number
class BatchArray {
    #view = new Float32Array(0);
    constructor(at, shape) { this._at = at, this.shape = Object.freeze(shape), this.length = shape[0] * shape[1] * shape[2]; }
    // A view, good until the memory grows: ask anew after calls
    get values() {
        if (!this._at) dead('batch');
        if (this.#view.buffer !== f32.buffer) this.#view = new Float32Array(f32.buffer, this._at, this.length);
        return this.#view;
    }
}

// So many clones of a world. Its bodies, shapes and joints name those of each of them.
export class Batch {
    #inputs = [];
    #outputs = [];
    #held; // the memory of the arrays, by its address
    constructor(world, p, count) {
        this._p = p, this.length = count, this.results = new Int32Array(count);
        this._shared = world; // its store lives as long
        const held = this.#held = [];
        free.register(this, () => { x.fe_batch_destroy(p); held.forEach((at) => x.free(at)); }, this);
    }
    #at() { return this._p || dead('batch'); }
    // One of the worlds, for all other calls but destroy
    world(index) {
        ok(x.fe_batch_get_world(this.#at(), int(index, 'index'), scratch));
        return new this._shared.constructor({ _p: u32[scratch >> 2], _batch: this });
    }

    // ---- calls: how many worlds failed; `results` has what became of each ----
    #mask(mask) {
        if (mask === undefined || mask === null) return 0;
        if (mask.length !== this.length) wrong('mask', `an array of ${this.length}`, mask);
        const at = temp(this.length);
        for (let k = 0; k < this.length; ++k) u8[at + k] = mask[k] ? 1 : 0;
        return at;
    }
    #told(call) {
        const at = temp(4 * this.length), failed = ok(call(at));
        this.results.set(i32.subarray(at >> 2, (at >> 2) + this.length));
        return failed;
    }
    step(dt, steps = 1, mask) {
        reset();
        const p = this.#at(), m = this.#mask(mask);
        return this.#told((at) => x.fe_batch_step(p, num(dt, 'dt'), int(steps, 'steps'), m, at));
    }
    // Back to what the world was when the batch was made, or to states[k]
    reset(mask, states) {
        reset();
        const p = this.#at(), m = this.#mask(mask);
        let list = 0;
        if (states !== undefined && states !== null) {
            if (states.length !== this.length) wrong('states', `an array of ${this.length}`, states);
            list = temp(4 * this.length);
            for (let k = 0; k < this.length; ++k) {
                const state = states[k];
                u32[(list >> 2) + k] = state === undefined || state === null ? 0
                    : state instanceof State ? state._at() : wrong(`states[${k}]`, 'a State', state);
            }
        }
        return this.#told((at) => x.fe_batch_reset(p, m, list, at));
    }
    get hashes() {
        reset();
        const at = temp(8 * this.length);
        ok(x.fe_batch_hash(this.#at(), at));
        const hex = (k) => u32[(at >> 2) + k].toString(16).padStart(8, '0');
        return Array.from({ length: this.length }, (_, k) => hex(2 * k + 1) + hex(2 * k));
    }

    // ---- fields ----
    // A fe_array at `at`; its data lie at `data`, or in new room of this call
    #array(at, field, items, data, { relativeTo, origin } = {}) {
        const number = word(Field, field, 'field'), row = ROW[field] ?? wrong('field', `one of ${Object.keys(ROW).join(', ')}`, field);
        if (field === 'gravity' && items !== undefined && items !== null) wrong('items', 'nothing: the field is the world\'s', items);
        const [list, n] = field === 'gravity' ? [0, 1] : listIn('h', items, 'items');
        const length = this.length * n * row, a = AT.array;
        x.fe_array_init(at, a.bytes);
        i32[(at + a.field) >> 2] = number, i32[(at + a.itemCount) >> 2] = n, i32[(at + a.isDouble) >> 2] = 0;
        u64[(at + a.relativeTo) >> 3] = handle(relativeTo, 'relativeTo');
        if (origin !== undefined) dvec3(at + a.origin, origin, 'origin');
        u32[(at + a.items) >> 2] = list;
        const where = data ?? temp(4 * length);
        u32[(at + a.data) >> 2] = where;
        u64[(at + a.size) >> 3] = BigInt(4 * length);
        return { where, length, shape: [this.length, n, row] };
    }
    // A Float32Array of all worlds' numbers; into `into` if that is given
    read(field, items, options, into) {
        reset();
        const p = this.#at(), array = temp(AT.array.bytes), { where, length } = this.#array(array, field, items, undefined, options);
        const out = into ?? new Float32Array(length);
        if (!(out instanceof Float32Array) || out.length !== length) wrong('into', `a Float32Array of ${length}`, out);
        this.#told((at) => x.fe_batch_read(p, array, at));
        out.set(f32.subarray(where >> 2, (where >> 2) + length));
        return out;
    }
    write(field, items, numbers, mask) {
        reset();
        const p = this.#at(), array = temp(AT.array.bytes), { where, length } = this.#array(array, field, items);
        if (numbers?.length !== length) wrong('numbers', `an array of ${length}`, numbers);
        for (let k = 0; k < length; ++k) f32[(where >> 2) + k] = num(numbers[k], `numbers[${k}]`);
        const m = this.#mask(mask);
        return this.#told((at) => x.fe_batch_write(p, array, m, at));
    }

    // ---- arrays that each step reads before it, or fills after it ----
    input(field, items) { return this.#bind(this.#inputs, field, items, {}); }
    output(field, items, options) { return this.#bind(this.#outputs, field, items, options); }
    #bind(list, field, items, options) {
        reset();
        const p = this.#at(), probe = this.#array(temp(AT.array.bytes), field, items, 0, options);
        const at = allocate(Math.max(4 * probe.length, 4));
        u8.fill(0, at, at + 4 * probe.length);
        const entry = { field, items: items && Array.from(items, (item) => handle(item, 'items')).map(Number), options, at };
        list.push(entry);
        try {
            if (list === this.#inputs && KEEPS.has(field)) this.#fill(p, entry);
            this.#rebind(p);
        } catch (error) {
            list.pop();
            x.free(at);
            throw error;
        }
        this.#held.push(at);
        return (entry.array = new BatchArray(at, probe.shape));
    }
    // What is to be kept begins as it is
    #fill(p, { field, items, at }) {
        reset();
        const array = temp(AT.array.bytes);
        this.#array(array, field, items, at);
        this.#told((told) => x.fe_batch_read(p, array, told));
    }
    #rebind(p) {
        reset();
        const bytes = AT.array.bytes, place = (list) => {
            const at = temp(Math.max(1, bytes * list.length));
            list.forEach(({ field, items, options, at: data }, k) => this.#array(at + k * bytes, field, items, data, options));
            return at;
        };
        const inputs = place(this.#inputs), outputs = place(this.#outputs);
        ok(x.fe_batch_bind(p, inputs, this.#inputs.length, outputs, this.#outputs.length));
    }
    destroy() {
        ok(x.fe_batch_destroy(this.#at()));
        free.unregister(this);
        for (const { array } of [...this.#inputs, ...this.#outputs]) array._at = 0;
        this.#held.forEach((at) => x.free(at));
        this._p = 0;
    }
    [dispose]() { if (this._p) this.destroy(); }
}
