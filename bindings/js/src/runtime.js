// runtime.js - the module's memory, and how numbers, vectors, records and errors cross into it.
//
// One instance a thread of the program. Views on the memory are renewed after each call that made it grow: `ok` sees to
// that, through which every call goes.

import { host, textOf } from './host.js';

export let x; // the exports: functions of feather.h, malloc, free
let memory; // the module's own, or one that threads share
export let f32, f64, i32, u32, u64, u8;
export let scratch; // SCRATCH bytes for the small arguments of one call
const SCRATCH = 2048;
let block = 0, blockSize = 0, top = 0, spent = []; // what the arrays of one call lie in

export class FeatherError extends Error {
    /** @param {string} code  "FE_ERROR_STALE" and so on */
    constructor(code, message) {
        super(message);
        this.name = 'FeatherError';
        this.code = code;
    }
}

// Memory that grew: views on it are empty, or, where it is shared, too short. The module counts, see libc.c.
let growthsAt = 0, growths = 0;
const isFresh = () => u32[growthsAt] === growths;
function renew() {
    const b = memory.buffer;
    f32 = new Float32Array(b), f64 = new Float64Array(b), i32 = new Int32Array(b), u32 = new Uint32Array(b);
    u64 = new BigUint64Array(b), u8 = new Uint8Array(b);
    growths = u32[growthsAt];
}

export const text = (at) => textOf(u8, at);

const fresh = () => (isFresh() || renew(), u8);
const imports = { host: host(fresh) };
export function start(source) {
    if (!x) begin(new WebAssembly.Instance(source instanceof WebAssembly.Module ? source : new WebAssembly.Module(source), imports));
}
export async function startAsync(source) {
    if (x) return;
    // `Response` is named for nothing else: node loads its whole fetch, some 40 ms, when it is
    const isModule = ArrayBuffer.isView(source) || source instanceof ArrayBuffer || source instanceof WebAssembly.Module;
    const isResponse = !isModule && typeof Response !== 'undefined' && source instanceof Response;
    if (isResponse && WebAssembly.instantiateStreaming && /^application\/wasm/.test(source.headers.get('content-type'))) {
        const { instance } = await WebAssembly.instantiateStreaming(source, imports);
        return begin(instance);
    }
    const made = await WebAssembly.instantiate(isResponse ? await source.arrayBuffer() : source, imports);
    begin(made.instance || made);
}
export async function startShared(module, shared) {
    if (x) throw new Error('the module of one thread has started');
    const { exports } = await WebAssembly.instantiate(module, { env: { memory: shared }, ...imports });
    begin({ exports }, shared);
    return x;
}
function begin(instance, shared) {
    if (x) return;
    x = instance.exports;
    memory = shared ?? x.memory;
    growthsAt = x.memory_growths.value >> 2;
    renew();
    scratch = x.malloc(SCRATCH);
    grow(1 << 14);
    renew();
}

// What worlds are stepped by, 0: by who calls
export let pool = 0;
export function usePool(threads) {
    ok(x.fe_pool_create(threads, scratch));
    pool = u32[scratch >> 2];
}

// ---- errors ---------------------------------------------------------------------------------------------------------

export function ok(result) {
    if (!isFresh()) renew();
    if (result < 0) {
        throw new FeatherError(text(x.fe_result_name(result)), text(x.fe_last_error()));
    }
    return result;
}
export const yes = (n) => ok(n) !== 0;
const shown = (v) => (typeof v === 'string' ? JSON.stringify(v) : typeof v === 'object' && v ? v.constructor?.name ?? 'object' : String(v));
export function wrong(name, wanted, v) { throw new TypeError(`${name} must be ${wanted}, is ${shown(v)}`); }
export const lastError = () => text(x.fe_last_error());

// ---- ends of objects ------------------------------------------------------------------------------------------------

export const dead = (what) => { throw new FeatherError('FE_ERROR_STALE', `the ${what} is destroyed`); };
export const free = new FinalizationRegistry((end) => end());
export const dispose = Symbol.dispose ?? Symbol.for('Symbol.dispose');

// ---- memory for one call --------------------------------------------------------------------------------------------

const MOST = 2 ** 31; // bytes of an array; beyond 2^32 the module would take a size for a smaller one
export function allocate(bytes) {
    const made = bytes < MOST ? x.malloc(bytes) : 0;
    if (!made) throw new FeatherError('FE_ERROR_MEMORY', `no memory for an array of ${bytes} bytes`);
    if (!isFresh()) renew();
    return made;
}
function grow(bytes) {
    const made = allocate(bytes);
    if (block) spent.push(block);
    block = made, blockSize = bytes, top = 0;
}
const KEPT = 2 ** 24; // bytes between calls: half a million poses. More would be missing elsewhere
// Begins a call: what the last one's arrays lay in is free again
export function reset() {
    top = 0;
    if (blockSize > KEPT) spent.push(block), block = blockSize = 0;
    while (spent.length) x.free(spent.pop());
}
export function temp(bytes) {
    if (top + bytes > blockSize) grow(Math.max(Math.min(2 * blockSize, MOST / 2), bytes + 64));
    const at = block + top;
    top = (top + bytes + 15) & ~15;
    return at;
}
export function room() { return { at: block + top, bytes: blockSize - top }; }

// ---- numbers --------------------------------------------------------------------------------------------------------
// + 0 makes 0 of -0, as an integer's minus sign does in C: equal calls give equal bits in every language.

export function num(v, name) { return typeof v === 'number' ? v + 0 : wrong(name, 'a number', v); }
export function int(v, name) {
    if (v === true || v === false) return +v;
    return Number.isInteger(v) && v >= -2147483648 && v <= 2147483647 ? v + 0 : wrong(name, 'an integer of 32 bits', v);
}
export function uint(v, name) {
    return Number.isInteger(v) && v >= 0 && v <= 4294967295 ? v + 0 : wrong(name, 'an integer of 0..4294967295', v);
}
export function big(v, name) {
    if (typeof v === 'bigint' && v >= 0n && v < 1n << 64n) return v;
    return Number.isSafeInteger(v) && v >= 0 ? BigInt(v) : wrong(name, 'an integer of 0..2^53 - 1 or a BigInt', v);
}
export function long(v, name) { return Number.isSafeInteger(v) ? BigInt(v) : wrong(name, 'an integer', v); }
export function handle(v, name) {
    if (v === null || v === undefined) return 0n;
    if (typeof v === 'object' && typeof v._h === 'bigint') return v._h;
    return Number.isSafeInteger(v) && v >= 0 ? BigInt(v) : wrong(name, 'a handle or what has one', v);
}
export const id = (at) => u32[at >> 2] + u32[(at >> 2) + 1] * 4294967296;
// A BigInt is an object, and made only for what no number holds, from 2^53
export const wide = (at) => (u32[(at >> 2) + 1] < 2 ** 21 ? id(at) : u64[at >> 3]);
export function word(words, v, name) {
    const n = words[v];
    if (n !== undefined && typeof v === 'string') return n;
    if (Number.isInteger(v)) return v; // the library names its range
    return wrong(name, 'one of ' + Object.keys(words).join(', '), v);
}
export function bits(words, v, name) {
    if (typeof v === 'string') return word(words, v, name);
    if (Array.isArray(v)) return v.reduce((sum, w) => (sum | word(words, w, name)) >>> 0, 0);
    return uint(v, name);
}
const reversed = new Map();
export function nameOf(words, value) {
    let names = reversed.get(words);
    if (!names) reversed.set(words, (names = new Map(Object.entries(words).map(([k, n]) => [n, k]))));
    return names.get(value) ?? value;
}

// ---- vectors: { x, y, z } or an array; vectors of three.js have a function called length ------------------------------

export function vec3(at, v, name) {
    if (v === null || typeof v !== 'object') wrong(name, 'a vector', v);
    const i = at >> 2;
    if (typeof v.length !== 'number') f32[i] = num(v.x, name + '.x'), f32[i + 1] = num(v.y, name + '.y'), f32[i + 2] = num(v.z, name + '.z');
    else if (v.length !== 3) wrong(name, 'a vector of 3 numbers', v);
    else f32[i] = num(v[0], name + '[0]'), f32[i + 1] = num(v[1], name + '[1]'), f32[i + 2] = num(v[2], name + '[2]');
    return at;
}
export function dvec3(at, v, name) {
    if (v === null || typeof v !== 'object') wrong(name, 'a vector', v);
    const i = at >> 3;
    if (typeof v.length !== 'number') f64[i] = num(v.x, name + '.x'), f64[i + 1] = num(v.y, name + '.y'), f64[i + 2] = num(v.z, name + '.z');
    else if (v.length !== 3) wrong(name, 'a vector of 3 numbers', v);
    else f64[i] = num(v[0], name + '[0]'), f64[i + 1] = num(v[1], name + '[1]'), f64[i + 2] = num(v[2], name + '[2]');
    return at;
}
export function quat(at, v, name) {
    if (v === null || typeof v !== 'object') wrong(name, 'a quaternion', v);
    const i = at >> 2;
    if (typeof v.length !== 'number') {
        f32[i] = num(v.x, name + '.x'), f32[i + 1] = num(v.y, name + '.y'), f32[i + 2] = num(v.z, name + '.z');
        f32[i + 3] = num(v.w, name + '.w');
    } else {
        if (v.length !== 4) wrong(name, 'a quaternion of 4 numbers', v);
        for (let k = 0; k < 4; ++k) f32[i + k] = num(v[k], `${name}[${k}]`);
    }
    return at;
}
export const getVec3 = (at) => ({ x: f32[at >> 2], y: f32[(at >> 2) + 1], z: f32[(at >> 2) + 2] });
export const getDvec3 = (at) => ({ x: f64[at >> 3], y: f64[(at >> 3) + 1], z: f64[(at >> 3) + 2] });
export const getQuat = (at) => ({ x: f32[at >> 2], y: f32[(at >> 2) + 1], z: f32[(at >> 2) + 2], w: f32[(at >> 2) + 3] });

// ---- records --------------------------------------------------------------------------------------------------------
// A table of a record: [size, init, fields, aliases]; both of these { name: [offset, writer, more] }; init is a function
// of the library, or what makes a record without one whole.

// Writes the fields that `given` has over what is there
export function put(table, at, given, name) {
    if (given === null || typeof given !== 'object') wrong(name, 'an object', given);
    for (const key in given) {
        const field = table[2][key] ?? table[3]?.[key];
        if (!field) throw new TypeError(`${name} has no ${key}; it has ${Object.keys({ ...table[2], ...table[3] }).join(', ')}`);
        if (given[key] !== undefined) field[1](at + field[0], given[key], name ? name + '.' + key : key, field[2], at);
    }
    return at;
}
export function init(table, at) {
    u8.fill(0, at, at + table[0]);
    if (table[1]) table[1](at, table[0]);
    return at;
}
export function make(table, at, given, name) { return put(table, init(table, at), given, name); }
// What a getter has just read, and `given` over it
export function over(table, done, at, given, name) { return put(table, at, given, name); }
// NULL for nothing: the defaults
export function maybe(table, at, given, name) { return given === undefined || given === null ? 0 : make(table, at, given, name); }

export const W = {
    f(at, v, name) { f32[at >> 2] = num(v, name); },
    d(at, v, name) { f64[at >> 3] = num(v, name); },
    i(at, v, name) { i32[at >> 2] = int(v, name); },
    flag(at, v, name) { i32[at >> 2] = int(v, name); }, // is read as true or false
    u(at, v, name) { u32[at >> 2] = uint(v, name); },
    q(at, v, name) { u64[at >> 3] = big(v, name); },
    h(at, v, name) { u64[at >> 3] = handle(v, name); },
    word(at, v, name, words) { i32[at >> 2] = word(words, v, name); },
    bits(at, v, name, words) { u32[at >> 2] = bits(words, v, name); },
    record(at, v, name, table) { put(table, at, v, name); },
    vec3, dvec3, quat,
    // fixed arrays: [writer, bytes, count, more]
    array(at, v, name, [writer, bytes, count, more]) {
        if (v?.length !== count) wrong(name, 'an array of ' + count, v);
        for (let k = 0; k < count; ++k) writer(at + k * bytes, v[k], `${name}[${k}]`, more);
    },
    // arrays behind a pointer, whose number lies at `counter` in the record, in units of `unit` elements
    list(at, v, name, [kind, counter, unit], record) {
        const n = v === null ? 0 : v.length;
        if (!Number.isInteger(n)) wrong(name, 'an array', v);
        if (counter >= 0 && n % unit !== 0) wrong(name, `an array of ${unit} numbers each`, v);
        const [start] = listIn(kind, v ?? [], name);
        u32[at >> 2] = n ? start : 0;
        if (counter >= 0) i32[(record + counter) >> 2] = n / unit;
    },
    frictions(at, v, name) { f32[at >> 2] = f32[(at >> 2) + 1] = num(v, name); },
};

const READ = new Map([
    [W.f, (at) => f32[at >> 2]], [W.d, (at) => f64[at >> 3]], [W.i, (at) => i32[at >> 2]], [W.flag, (at) => i32[at >> 2] !== 0],
    [W.u, (at) => u32[at >> 2]], [W.bits, (at) => u32[at >> 2]], [W.q, wide], [W.h, id], [W.word, (at, words) => nameOf(words, i32[at >> 2])],
    [vec3, getVec3], [dvec3, getDvec3], [quat, getQuat], [W.record, (at, table) => get(table, at)],
    [W.array, (at, [writer, bytes, count, more]) => Array.from({ length: count }, (_, k) => READ.get(writer)(at + k * bytes, more))],
]);
// The fields of a record; lists behind pointers are not read
export function get(table, at) {
    const found = {};
    for (const name in table[2]) {
        const [offset, writer, more] = table[2][name], read = READ.get(writer);
        if (read) found[name] = read(at + offset, more);
    }
    return found;
}

// ---- arrays ---------------------------------------------------------------------------------------------------------

const BYTES = { f: 4, u: 4, i: 4, b: 1, h: 8 };
// Copies numbers, handles or records in; returns address and number. A kind is a letter of BYTES or a record's table.
export function listIn(kind, v, name) {
    const n = v?.length;
    // what has a length of a billion, and nothing there, shall not take a billion bytes first
    if (!Number.isInteger(n) || typeof v === 'string' || (n > 0 && !(n - 1 in v))) wrong(name, 'an array', v);
    if (typeof kind !== 'string') {
        const at = temp(kind[0] * n);
        for (let k = 0; k < n; ++k) make(kind, at + k * kind[0], v[k], `${name}[${k}]`);
        return [at, n];
    }
    const at = temp(BYTES[kind] * n);
    if (kind === 'f') {
        const view = new Float32Array(f32.buffer, at, n);
        for (let k = 0; k < n; ++k) view[k] = num(v[k], `${name}[${k}]`);
    } else if (kind === 'h') {
        for (let k = 0; k < n; ++k) u64[(at >> 3) + k] = handle(v[k], `${name}[${k}]`);
    } else if (kind === 'b') {
        for (let k = 0; k < n; ++k) u8[at + k] = uint(v[k], `${name}[${k}]`) < 256 ? v[k] : wrong(`${name}[${k}]`, 'a byte', v[k]);
    } else {
        for (let k = 0; k < n; ++k) u32[(at >> 2) + k] = kind === 'u' ? uint(v[k], `${name}[${k}]`) : int(v[k], `${name}[${k}]`);
    }
    return [at, n];
}
// Asks `call(at, capacity)` for records of `bytes`, with the room there is first, and reads them
export function listOut(bytes, read, call) {
    let { at, bytes: free } = room(), capacity = Math.floor(free / bytes), n = ok(call(at, capacity));
    if (n > capacity) {
        at = temp(n * bytes);
        n = Math.min(ok(call(at, n)), n);
    }
    const found = new Array(n);
    for (let k = 0; k < n; ++k) found[k] = read(at + k * bytes);
    return found;
}
export function bytesIn(v, name) {
    const view = v instanceof ArrayBuffer || (typeof SharedArrayBuffer !== 'undefined' && v instanceof SharedArrayBuffer)
        ? new Uint8Array(v) : ArrayBuffer.isView(v) ? new Uint8Array(v.buffer, v.byteOffset, v.byteLength)
        : wrong(name, 'an ArrayBuffer or a view of one', v);
    const at = temp(view.length);
    u8.set(view, at);
    return [at, BigInt(view.length)];
}
// Text as UTF-8 that a 0 ends
export function textIn(v, name) {
    if (typeof v !== 'string' || v.includes('\0')) wrong(name, 'a string without zeros', v);
    const bytes = new TextEncoder().encode(v), at = temp(bytes.length + 1);
    u8.set(bytes, at), u8[at + bytes.length] = 0;
    return at;
}
// Asks `call(at, capacity)` for bytes; into `into` if that is given
export function bytesOut(call, into, name) {
    const size = Number(call(0, 0n));
    ok(size < 0 ? size : 0);
    const at = temp(size), written = Number(call(at, BigInt(size))); // a difference is asked for more than it takes
    ok(Math.min(written, 0));
    return bytesWritten(at, written, into, name);
}
// A copy of bytes of the module, or into `into`
export function bytesWritten(at, size, into, name) {
    if (into === undefined) return u8.slice(at, at + size);
    if (!(into instanceof Uint8Array)) wrong(name, 'a Uint8Array', into);
    if (into.length < size) wrong(name, `a Uint8Array of at least ${size} bytes`, into);
    into.set(u8.subarray(at, at + size));
    return into.subarray(0, size);
}
