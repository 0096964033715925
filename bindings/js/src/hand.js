// hand.js - worlds, bodies, shapes, joints and assets as objects; arrays that lie in the module's memory.
import { x, pool, f32, f64, i32, u32, u64, scratch, ok, reset, temp, allocate, num, int, handle, id, nameOf, dvec3, init, put, make, maybe, listIn, listOut, bytesIn, bytesOut, wrong, long, dead, free, dispose, FeatherError } from './runtime.js';
import { Recorder } from './recorder.js';
import { Batch, State } from './batch.js';
import { AT, AssetCalls, BodyCalls, CompoundCalls, GeometryType, HIT_BYTES, HeightfieldCalls, HullCalls, INSTANCE_BYTES, JointCalls, JointType, MeshCalls, ShapeCalls, StoreCalls, VERTEX_BYTES, WorldCalls, made, readDifference, readHistoryFrame, readHit, readSnapshotInfo, readTransform } from './api.js';
import { $world_def, $body_def, $shape_def, $geometry, $store_def, $heightfield_def, $hull_def, $mesh_def, $compound_part, $material, $transform, $query_filter, $save_options, $restore_options, $draw_options, $ray, $path, $snapshot_info, $history_def, $recorder_def, $batch_def, $difference } from './api.js';

// Stores that nobody holds any more but a world that nobody holds either, until that one is gone
const orphans = new Set();
const endWorld = (p) => {
    x.fe_world_destroy(p);
    endOrphans();
};
export const endOrphans = () => {
    for (const store of orphans) if (x.fe_store_destroy(store) >= 0) orphans.delete(store);
};

// ---- memory that a world, or a list of bodies, keeps for its arrays ---------------------------------------------------

class Area {
    at = 0;
    bytes = 0;
    need(bytes) {
        if (bytes <= this.bytes) return this.at;
        const size = Math.max(bytes, Math.min(2 * this.bytes, 2 ** 30), 1024), at = allocate(size);
        x.free(this.at);
        return this.bytes = size, this.at = at;
    }
    end() { x.free(this.at), this.at = 0, this.bytes = 0; }
}
// Array views that are made anew only when the memory, the place or the length is another
class View {
    constructor(type) { this.type = type, this.view = new type(0), this.at = -1; }
    get(at, length) {
        if (this.at !== at || this.view.length !== length || this.view.buffer !== f32.buffer) {
            this.view = new this.type(f32.buffer, at, length), this.at = at;
        }
        return this.view;
    }
}
const FLOATS_OF_POSE = 7, FLOATS_OF_MOTION = 6;

// ---- stores and assets ----------------------------------------------------------------------------------------------

export class Asset extends AssetCalls {
    constructor(store, id) {
        super();
        this.store = store, this.id = id, this._h = BigInt(id);
    }
    _s() { return this.store._s(); }
    get type() { return nameOf(GeometryType, ok(x.fe_asset_get_type(this._s(), this._h))); }
    get key() { ok(x.fe_asset_get_key(this._s(), this._h, scratch)); return [u64[scratch >> 3], u64[(scratch >> 3) + 1]]; }
    save(into) { reset(); return bytesOut((at, n) => x.fe_asset_save(this._s(), this._h, at, n), into, 'into'); }
}
const mixin = (into, from) => {
    for (const [name, what] of Object.entries(Object.getOwnPropertyDescriptors(from.prototype))) {
        if (name !== 'constructor') Object.defineProperty(into.prototype, name, what);
    }
};
export class Hull extends Asset {}
export class Heightfield extends Asset {
    setHeights(row, column, rows, columns, heights) {
        reset();
        const [at, n] = listIn('f', heights, 'heights'), [r, c] = [int(rows, 'rows'), int(columns, 'columns')];
        if (n !== r * c) wrong('heights', `an array of rows * columns, ${r * c}`, n);
        ok(x.fe_heightfield_set_heights(this._s(), this._h, int(row, 'row'), int(column, 'column'), r, c, at));
    }
    getHeights(row, column, rows, columns) {
        reset();
        const n = int(rows, 'rows') * int(columns, 'columns');
        const at = temp(n > 0 && n <= 2 ** 28 ? 4 * n : 4);
        ok(x.fe_heightfield_get_heights(this._s(), this._h, int(row, 'row'), int(column, 'column'), rows, columns, at));
        return new Float32Array(f32.buffer, at, n).slice();
    }
}
export class Mesh extends Asset {
    setMaterials(materials) {
        reset();
        const [at, n] = listIn($material, materials, 'materials');
        ok(x.fe_mesh_set_materials(this._s(), this._h, at, $material[0], n));
    }
}
export class Compound extends Asset {}
for (const [to, from] of [[Hull, HullCalls], [Heightfield, HeightfieldCalls], [Mesh, MeshCalls], [Compound, CompoundCalls]]) mixin(to, from);
const KINDS = { hull: Hull, heightfield: Heightfield, mesh: Mesh, compound: Compound };

export class Store extends StoreCalls {
    constructor(options, world) {
        super();
        this.world = world;
        reset();
        if (world) {
            ok(x.fe_world_get_store(world._w(), scratch));
            this._p = u32[scratch >> 2];
            return;
        }
        ok(x.fe_store_create(maybe($store_def, scratch + 16, options, 'options'), scratch));
        this._p = u32[scratch >> 2];
        const p = this._p;
        free.register(this, () => { if (x.fe_store_destroy(p) < 0) orphans.add(p); }, this);
    }
    _s() {
        if (!this._p || (this.world && !this.world._p)) dead('store');
        return this._p;
    }
    destroy() {
        ok(x.fe_store_destroy(this._s()));
        free.unregister(this);
        this._p = 0;
    }
    [dispose]() { if (this._p && !this.world) this.destroy(); }
    createHull(options) {
        reset();
        ok(x.fe_hull_create(this._s(), make($hull_def, scratch + 16, Array.isArray(options) || ArrayBuffer.isView(options) ? { points: options } : options, 'options'), scratch));
        return new Hull(this, id(scratch));
    }
    createHeightfield(options) {
        reset();
        const def = make($heightfield_def, scratch + 16, options, 'options'), { rows = 0, columns = 0, heights, holes, cellMaterials } = options;
        const cells = (rows - 1) * (columns - 1), sizes = [['heights', heights, rows * columns], ['holes', holes, cells], ['cellMaterials', cellMaterials, cells]];
        for (const [name, given, n] of sizes) if (given && rows > 1 && columns > 1 && given.length !== n) wrong(name, `an array of ${n}`, given.length);
        ok(x.fe_heightfield_create(this._s(), def, scratch));
        return new Heightfield(this, id(scratch));
    }
    createMesh(options) {
        reset();
        const def = make($mesh_def, scratch + 16, options, 'options'), n = (options.indices?.length ?? 0) / 3;
        for (const name of ['triangleMaterials', 'triangleData']) if (options[name] && options[name].length !== n) wrong(name, `an array of ${n}`, options[name].length);
        ok(x.fe_mesh_create(this._s(), def, scratch));
        return new Mesh(this, id(scratch));
    }
    createCompound(parts) {
        reset();
        const [at, n] = listIn($compound_part, parts, 'parts');
        ok(x.fe_compound_create(this._s(), at, $compound_part[0], n, scratch));
        return new Compound(this, id(scratch));
    }
    load(bytes) {
        reset();
        ok(x.fe_asset_load(this._s(), ...bytesIn(bytes, 'bytes'), scratch));
        return this.asset(id(scratch));
    }
    // The object of a handle
    asset(handleOf) {
        const n = handle(handleOf, 'handle'), type = nameOf(GeometryType, ok(x.fe_asset_get_type(this._s(), n)));
        return new KINDS[type](this, Number(n));
    }
}

// ---- what is in a world ---------------------------------------------------------------------------------------------

const part = (Calls) => class extends Calls {
    constructor(world, id) {
        super();
        this.world = world, this.id = id, this._h = BigInt(id);
    }
    _w(changes) { return this.world._w(changes); }
};
export class Body extends part(BodyCalls) {
    get position() { ok(x.fe_body_get_transform(this._w(), this._h, scratch)); return { x: f64[scratch >> 3], y: f64[(scratch >> 3) + 1], z: f64[(scratch >> 3) + 2] }; }
    set position(position) { this._move(position, undefined); }
    get rotation() {
        ok(x.fe_body_get_transform(this._w(), this._h, scratch));
        const i = (scratch + 24) >> 2;
        return { x: f32[i], y: f32[i + 1], z: f32[i + 2], w: f32[i + 3] };
    }
    set rotation(rotation) { this._move(undefined, rotation); }
    _move(position, rotation) {
        ok(x.fe_body_get_transform(this._w(), this._h, scratch));
        put($transform, scratch, position === undefined ? { rotation } : { position }, '');
        ok(x.fe_body_set_transform(this._w(1), this._h, scratch));
    }
    destroy() { ok(x.fe_body_destroy(this._w(1), this._h)); }
    // `geometry` is { type: 'box', halfExtents }, an asset, or what makes one
    createShape(geometry, options) {
        reset();
        const form = geometry instanceof Asset ? { type: geometry.type, asset: geometry } : geometry;
        const at = make($geometry, scratch + 16, form, 'geometry');
        ok(x.fe_shape_create(this._w(1), this._h, maybe($shape_def, scratch + 256, options, 'options'), at, scratch));
        return new Shape(this.world, id(scratch));
    }
    addSphere(radius, options) { return this.createShape({ type: 'sphere', radius }, options); }
    addBox(x, y, z, options) { return this.createShape({ type: 'box', halfExtents: [x, y, z] }, options); }
    addCapsule(halfHeight, radius, options) { return this.createShape({ type: 'capsule', halfHeight, radius }, options); }
    addCylinder(halfHeight, radius, options) { return this.createShape({ type: 'cylinder', halfHeight, radius }, options); }
    addCone(halfHeight, radius, options) { return this.createShape({ type: 'cone', halfHeight, radius }, options); }
    addPlane(normal, distance, options) { return this.createShape({ type: 'plane', normal, distance }, options); }
}
export class Shape extends part(ShapeCalls) {}
export class Joint extends part(JointCalls) {
    get type() { ok(x.fe_joint_get_type(this._w(), this._h, scratch)); return nameOf(JointType, i32[scratch >> 2]); }
}
made.joint = (world, result) => (ok(result), new Joint(world, id(scratch)));

// ---- many bodies at once --------------------------------------------------------------------------------------------
// Their handles lie in the module's memory; poses and motions are views of it, good until the next call of the list.

export class Bodies {
    #handles = new Area();
    #values = new Area();
    #floats = new View(Float32Array);
    constructor(world, bodies) {
        this.world = world;
        reset();
        const n = bodies?.length;
        if (!Number.isInteger(n)) wrong('bodies', 'an array', bodies);
        this.count = n;
        const areas = [this.#handles, this.#values];
        free.register(this, () => areas.forEach((a) => a.end()), this);
        const at = this.#handles.need(8 * n) >> 3;
        for (let k = 0; k < n; ++k) u64[at + k] = handle(bodies[k], `bodies[${k}]`);
    }
    destroy() { free.unregister(this), this.#handles.end(), this.#values.end(), this.count = 0; }
    [dispose]() { this.destroy(); }
    #room(floats) { return this.#values.need(4 * floats * this.count); }
    // 7 floats a body: position relative to `origin`, rotation
    poses(origin) {
        const at = this.#room(FLOATS_OF_POSE), from = dvec3(scratch, origin ?? [0, 0, 0], 'origin');
        ok(x.fe_world_get_transforms_f32(this.world._w(), this.#handles.at, from, at, 0, this.count));
        return this.#floats.get(at, FLOATS_OF_POSE * this.count);
    }
    // 6 floats a body: linear, angular velocity
    velocities() {
        const at = this.#room(FLOATS_OF_MOTION);
        ok(x.fe_world_get_velocities(this.world._w(), this.#handles.at, at, 0, this.count));
        return this.#floats.get(at, FLOATS_OF_MOTION * this.count);
    }
    #given(values, each, name) {
        const own = values === this.#floats.view, [at, n] = own ? [values.byteOffset, values.length] : (reset(), listIn('f', values, name));
        if (n !== each * this.count) wrong(name, `an array of ${each * this.count}`, n);
        return at;
    }
    setVelocities(values) { const at = this.#given(values, FLOATS_OF_MOTION, 'values'); ok(x.fe_world_set_velocities(this.world._w(1), this.#handles.at, at, 0, this.count)); }
    addForces(values) { const at = this.#given(values, FLOATS_OF_MOTION, 'values'); ok(x.fe_world_add_forces(this.world._w(1), this.#handles.at, at, 0, this.count)); }
    transforms() {
        reset();
        const at = temp(40 * this.count);
        ok(x.fe_world_get_transforms(this.world._w(), this.#handles.at, at, 0, this.count));
        return Array.from({ length: this.count }, (_, k) => readTransform(at + 40 * k));
    }
    setTransforms(transforms) {
        reset();
        const [at, n] = listIn($transform, transforms, 'transforms');
        if (n !== this.count) wrong('transforms', `an array of ${this.count}`, n);
        ok(x.fe_world_set_transforms(this.world._w(1), this.#handles.at, at, 0, n));
    }
}

// ---- histories ------------------------------------------------------------------------------------------------------

export class History {
    constructor(world, p) { this.world = world, this._p = p; }
    #at() {
        this.world._w();
        return this._p || dead('history');
    }
    keep(frame) { ok(x.fe_history_keep(this.#at(), long(frame, 'frame'))); }
    restore(frame) { ok(x.fe_history_restore(this.#at(), long(frame, 'frame'))); }
    get frames() { reset(); return listOut(16, readHistoryFrame, (a, n) => x.fe_history_get_frames(this.#at(), a, 16, n)); }
    destroy() {
        ok(x.fe_history_destroy(this.#at()));
        this._p = 0;
    }
    [dispose]() { if (this._p && this.world._p) this.destroy(); }
}

// ---- worlds ---------------------------------------------------------------------------------------------------------

const worldDef = (at, options) => {
    if ((options === undefined || options === null) && !pool) return 0;
    const { store, ...rest } = options ?? {};
    make($world_def, at, rest, 'options');
    u32[(at + AT.pool) >> 2] = pool;
    if (store !== undefined) u32[(at + AT.store) >> 2] = store instanceof Store ? store._s() : wrong('options.store', 'a Store', store);
    return at;
};
// The snapshot that bytes are the difference to
const setBase = (at, [base, size], bytes) => {
    if (bytes === undefined || bytes === null) return;
    const [from, length] = bytesIn(bytes, 'options.base');
    u32[(at + base) >> 2] = from, u64[(at + size) >> 3] = length;
};
const saveOptions = (at, options) => {
    if (options === undefined || options === null) return 0;
    const { base, ...rest } = options;
    if (base !== undefined && base !== null) rest.flags = ['diff', ...(rest.flags === undefined ? [] : [rest.flags].flat())];
    make($save_options, at, rest, 'options');
    setBase(at, AT.saveBase, base);
    return at;
};
const restoreOptions = (at, options) => {
    if (options === undefined || options === null) return 0;
    const { assets = [], base, ...rest } = options;
    if (!Array.isArray(assets)) wrong('options.assets', 'an array of assets', assets);
    const found = assets.map((a, k) => (a instanceof Asset ? a.key : wrong(`options.assets[${k}]`, 'an asset', a)));
    const keys = temp(16 * assets.length), [handles, n] = listIn('h', assets, 'options.assets');
    u64.set(found.flat(), keys >> 3);
    make($restore_options, at, rest, 'options');
    i32[(at + AT.assetCount) >> 2] = n;
    u32[(at + AT.keys) >> 2] = n ? keys : 0, u32[(at + AT.assets) >> 2] = n ? handles : 0;
    setBase(at, AT.restoreBase, base);
    return at;
};

// What World.getMoved gives: handles become numbers when they are asked for
class Moved {
    #area;
    #ids = new Float64Array(64);
    #read = true;
    count = 0;
    poses = new Float32Array(0);
    constructor(area) { this.#area = area; }
    renew(count, poses) { return this.count = count, this.poses = poses, this.#read = false, this; }
    get ids() {
        if (this.#read) return this.#ids;
        const n = this.count;
        if (this.#ids.length < n) this.#ids = new Float64Array(2 * n);
        for (let k = 0, i = this.#area.at >> 2; k < n; ++k, i += 2) this.#ids[k] = u32[i] + u32[i + 1] * 4294967296;
        this.#read = true;
        return this.#ids;
    }
}

const HIT = HIT_BYTES, VERTEX = VERTEX_BYTES, INSTANCE = INSTANCE_BYTES;

export class World extends WorldCalls {
    #areas = { moved: new Area(), poses: new Area(), hits: new Area(), lines: new Area(), triangles: new Area(), points: new Area(), instances: new Area() };
    #views = {};
    #moved = new Moved(this.#areas.moved);
    constructor(options) {
        super();
        reset();
        if (options?._p) this._p = options._p, this._player = options._player, this._batch = options._batch; // World.load...
        else {
            ok(x.fe_world_create(worldDef(scratch + 16, options), scratch));
            this._shared = options?.store; // lives as long
            this._p = u32[scratch >> 2];
        }
        this._own(this._player);
    }
    // From here on the world is the player's, its batch's, or nobody's but this object's
    _own(player) {
        const p = this._p, areas = Object.values(this.#areas), isOwn = !player && !this._batch;
        this._player = player;
        free.unregister(this);
        free.register(this, () => { if (isOwn) endWorld(p); areas.forEach((a) => a.end()); }, this);
    }
    _w(changes) {
        if (changes && this._player && this._p) throw new FeatherError('FE_ERROR_STATE', 'the world is a player\'s, to be read: release() hands it over');
        if (this._batch && !this._batch._p) dead('batch');
        return this._p || dead('world');
    }
    destroy() {
        ok(x.fe_world_destroy(this._w(1)));
        this._end();
    }
    _end() {
        free.unregister(this);
        Object.values(this.#areas).forEach((a) => a.end());
        this._p = 0;
    }
    [dispose]() { if (this._p) this.destroy(); }
    get isDestroyed() { return !this._p; }

    createBody(options) {
        reset();
        ok(x.fe_body_create(this._w(1), maybe($body_def, scratch + 16, options, 'options'), scratch));
        return new Body(this, id(scratch));
    }
    createBodies(many) {
        reset();
        const [defs, n] = listIn($body_def, many, 'many'), at = temp(8 * n);
        ok(x.fe_body_create_many(this._w(1), defs, $body_def[0], n, at));
        return Array.from({ length: n }, (_, k) => new Body(this, id(at + 8 * k)));
    }
    destroyBodies(bodies) {
        reset();
        const [at, n] = listIn('h', bodies, 'bodies');
        ok(x.fe_body_destroy_many(this._w(1), at, n));
    }
    // The objects of handles; whether something lives there their isValid tells
    body(of) { return new Body(this, Number(handle(of, 'handle'))); }
    shape(of) { return new Shape(this, Number(handle(of, 'handle'))); }
    joint(of) { return new Joint(this, Number(handle(of, 'handle'))); }
    list(bodies) { return new Bodies(this, bodies); }
    createHistory(options) {
        reset();
        ok(x.fe_history_create(this._w(1), maybe($history_def, scratch + 16, options, 'options'), scratch));
        return new History(this, u32[scratch >> 2]);
    }
    createRecorder(options) {
        reset();
        ok(x.fe_recorder_create(this._w(1), maybe($recorder_def, scratch + 16, options, 'options'), scratch));
        return new Recorder(this, u32[scratch >> 2]);
    }
    // Another world that is as this one is; what it is stepped by the options say
    clone(options) {
        reset();
        ok(x.fe_world_clone(this._w(), worldDef(scratch + 16, options), scratch));
        return new World({ _p: u32[scratch >> 2] });
    }
    createState() {
        ok(x.fe_state_create(this._w(), 0, scratch));
        return new State(u32[scratch >> 2]);
    }
    setState(state) { ok(x.fe_world_set_state(this._w(1), state instanceof State ? state._at() : wrong('state', 'a State', state))); }
    createBatch(count, options) {
        reset();
        const def = make($batch_def, scratch + 16, { ...options, worldCount: int(count, 'count') }, 'options');
        u32[(def + AT.batchPool) >> 2] = pool;
        ok(x.fe_batch_create(this._w(), def, scratch));
        return new Batch(this, u32[scratch >> 2], count);
    }
    get store() { return new Store(undefined, this); }
    createHull(options) { return this.store.createHull(options); }
    createHeightfield(options) { return this.store.createHeightfield(options); }
    createMesh(options) { return this.store.createMesh(options); }
    createCompound(parts) { return this.store.createCompound(parts); }

    // 64 bits as 16 hexadecimal digits
    get hash() {
        ok(x.fe_world_hash(this._w(), scratch));
        return u64[scratch >> 3].toString(16).padStart(16, '0');
    }

    // The bodies that the last step moved: `count`, their `ids`, and 7 floats each in `poses`, position relative to
    // `origin` and rotation. The same object each time, its arrays views, good until the next call.
    getMoved(origin) {
        const w = this._w(), { moved, poses } = this.#areas;
        let n = ok(x.fe_world_get_moved(w, moved.at, 0, 0, moved.bytes >> 3));
        if (8 * n > moved.bytes) moved.need(8 * n), ok(x.fe_world_get_moved(w, moved.at, 0, 0, n));
        if (n > 0) {
            const at = poses.need(4 * FLOATS_OF_POSE * n);
            ok(x.fe_world_get_transforms_f32(w, moved.at, dvec3(scratch, origin ?? ZERO, 'origin'), at, 0, n));
        }
        return this.#moved.renew(n, this.#view('moved', Float32Array, poses.at, poses.bytes >> 2));
    }
    #view(name, type, at, length) { return (this.#views[name] ??= new View(type)).get(at, length); }

    // Many rays: 6 numbers each, origin and translation. Of each a hit or null
    raycastMany(rays, filter) { const { at, n } = this.#castRays(rays, filter); return this.#hits(at, n); }
    // The same as records of `stride` words, without an object: HitLayout says where what lies
    raycastRaw(rays, filter) {
        const { at, n } = this.#castRays(rays, filter), words = (HIT * n) >> 2;
        return { count: n, stride: HIT >> 2, doubles: this.#view('hit doubles', Float64Array, at, words >> 1), floats: this.#view('hit floats', Float32Array, at, words), words: this.#view('hit words', Uint32Array, at, words) };
    }
    #castRays(rays, filter) {
        reset();
        if (!Number.isInteger(rays?.length) || rays.length % 6) wrong('rays', 'an array of 6 numbers a ray', rays);
        const n = rays.length / 6, from = temp(8 * rays.length), start = from >> 3;
        if (rays instanceof Float64Array) f64.set(rays, start);
        else for (let k = 0; k < rays.length; ++k) f64[start + k] = num(rays[k], `rays[${k}]`);
        const f = maybe($query_filter, scratch, filter, 'filter'), at = this.#areas.hits.need(HIT * n);
        ok(x.fe_world_raycast_many(this._w(), from, 48, n, f, 0, at, HIT));
        return { at, n };
    }
    sweepMany(geometry, paths, filter) {
        reset();
        const [from, n] = listIn($path, paths, 'paths'), g = make($geometry, scratch, geometry, 'geometry');
        const f = maybe($query_filter, scratch + 256, filter, 'filter'), at = this.#areas.hits.need(HIT * n);
        ok(x.fe_world_sweep_many(this._w(), g, from, $path[0], n, f, 0, at, HIT));
        return this.#hits(at, n);
    }
    #hits(at, n) {
        const hits = new Array(n);
        for (let k = 0; k < n; ++k) hits[k] = id(at + HIT * k) ? readHit(at + HIT * k) : null;
        return hits;
    }

    // ---- snapshots ----
    save(options, into) {
        reset();
        const o = saveOptions(scratch, options);
        return bytesOut((at, n) => x.fe_world_save(this._w(), o, at, n), into, 'into');
    }
    // False when the bytes are of a library whose results differ: it goes on, not bit for bit
    restore(bytes, options) {
        reset();
        const o = restoreOptions(scratch, options);
        return ok(x.fe_world_restore(this._w(1), o, ...bytesIn(bytes, 'bytes'))) === 0;
    }
    static load(bytes, options, def) {
        reset();
        const d = worldDef(scratch + 512, def), o = restoreOptions(scratch + 64, options);
        ok(x.fe_world_load(d, o, ...bytesIn(bytes, 'bytes'), scratch));
        return new World({ _p: u32[scratch >> 2] });
    }

    // ---- drawing: views of the module's memory, good until the next call of the same name ----
    drawLines(options) { return this.#draw('lines', VERTEX, options, (...a) => x.fe_world_draw_lines(...a)); }
    drawTriangles(options) { return this.#draw('triangles', VERTEX, options, (...a) => x.fe_world_draw_triangles(...a)); }
    drawPoints(options) { return this.#draw('points', VERTEX, options, (...a) => x.fe_world_draw_points(...a)); }
    drawInstances(options) { return this.#draw('instances', INSTANCE, options, (...a) => x.fe_world_draw_instances(...a)); }
    #draw(name, bytes, options, call) {
        reset();
        const o = maybe($draw_options, scratch, options, 'options'), area = this.#areas[name];
        let n = ok(call(this._w(), o, area.at, bytes, Math.floor(area.bytes / bytes)));
        if (n * bytes > area.bytes) area.need(n * bytes), n = ok(call(this._w(), o, area.at, bytes, n));
        const words = (n * bytes) >> 2;
        return { count: n, stride: bytes >> 2, floats: this.#view(name, Float32Array, area.at, words), words: this.#view(name + ' words', Uint32Array, area.at, words) };
    }
}
const ZERO = [0, 0, 0];

export const instanceType = (drawn, k) => nameOf(GeometryType, drawn.words[k * drawn.stride]);
export function checkSnapshot(bytes) {
    reset();
    const info = init($snapshot_info, scratch);
    ok(x.fe_snapshot_check(...bytesIn(bytes, 'bytes'), info));
    return readSnapshotInfo(info);
}
export function snapshotAssets(bytes) {
    reset();
    const [from, size] = bytesIn(bytes, 'bytes');
    return listOut(16, (at) => [u64[at >> 3], u64[(at >> 3) + 1]], (at, n) => x.fe_snapshot_get_assets(from, size, at, 16, n));
}
// The first difference between two worlds, or null
export function compareSnapshots(a, b) {
    reset();
    const found = init($difference, scratch);
    return ok(x.fe_snapshot_compare(...bytesIn(a, 'a'), ...bytesIn(b, 'b'), found)) ? readDifference(found) : null;
}
export const version = () => { const v = x.fe_version(); return `${v >> 16}.${(v >> 8) & 255}.${v & 255}`; };
