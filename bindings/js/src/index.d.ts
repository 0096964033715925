import {
    WorldCalls, BodyCalls, ShapeCalls, JointCalls, StoreCalls, AssetCalls, HullCalls, HeightfieldCalls, MeshCalls, CompoundCalls,
    Vec3, Quat, Vec3Like, QuatLike, Handle, Hit, Transform, SnapshotInfo, GeometryType, JointType, BodyDefOptions, ShapeDefOptions,
    GeometryOptions, MaterialOptions, HullDefOptions, HeightfieldDefOptions, MeshDefOptions, CompoundPartOptions, TransformOptions,
    PathOptions, QueryFilterOptions, SaveOptionsOptions, RestoreOptionsOptions, StoreDefOptions, WorldDefOptions, DrawOptionsOptions, HistoryDefOptions, HistoryFrame, RecorderDefOptions,
    PlayerDefOptions, BatchDefOptions, Field, PlayerInfo, Note, Divergence, Difference,
} from './api.js';
export * from './api.js';

/** What the library refuses: its code, FE_ERROR_STALE and so on, and its sentence. Wrong types are TypeErrors. */
export class FeatherError extends Error {
    /** The library makes them. */
    constructor(code: string, message: string);
    /** FE_ERROR_STALE and so on. */
    readonly code: string;
}
/** A pair of numbers that is equal for equal content. */
export type AssetKey = [bigint, bigint];
/** Numbers in the module's memory: a view, good until the next call of the same method. `count` records of `stride` words. */
export interface Drawn { readonly count: number; readonly stride: number; readonly floats: Float32Array; readonly words: Uint32Array }
/** Hits as numbers, see HitLayout. */
export interface RawHits extends Drawn { readonly doubles: Float64Array }
/** `count` bodies; 7 floats each in `poses`: position, rotation. The arrays may be longer, and are good until the next call. */
export interface Moved { readonly count: number; readonly ids: Float64Array; readonly poses: Float32Array }

/** What shapes of many worlds share: a hull, a heightfield, a mesh or a compound. */
export class Asset extends AssetCalls {
    /** The store that it is in. */
    readonly store: Store;
    /** Its handle. */
    readonly id: number;
    /** 'hull', 'heightfield', 'mesh' or 'compound'. */
    readonly type: GeometryType;
    /** Equal for equal content, in every store, on every machine. */
    readonly key: AssetKey;
    /** As bytes, for Store.load. */
    save(into?: Uint8Array): Uint8Array;
}
/** A convex hull: see HullDefOptions. */
export interface Hull extends HullCalls {}
export class Hull extends Asset {}
/** Terrain: see HeightfieldDefOptions. */
export interface Heightfield extends HeightfieldCalls {}
export class Heightfield extends Asset {
    /** Changes the samples of a rectangle, row by row, m. Bodies near it wake in every world. */
    setHeights(row: number, column: number, rows: number, columns: number, heights: ArrayLike<number>): void;
    /** The samples of a rectangle, row by row, m. */
    getHeights(row: number, column: number, rows: number, columns: number): Float32Array;
}
/** Triangles: see MeshDefOptions. */
export interface Mesh extends MeshCalls {}
export class Mesh extends Asset {
    /** As many as it has: what touches it wakes. */
    setMaterials(materials: readonly MaterialOptions[]): void;
}
/** One form of many parts. */
export interface Compound extends CompoundCalls {}
export class Compound extends Asset {}

/** Assets that several worlds share. Each world has one of its own. */
export class Store extends StoreCalls {
    /** A store that several worlds may share: give it to their constructors. */
    constructor(options?: StoreDefOptions | null);
    /** Frees the store and all its assets. FE_ERROR_STATE while a world uses it. */
    destroy(): void;
    /** For `using`: destroy(), unless that is done. */
    [Symbol.dispose](): void;
    /** The convex hull of points, x, y, z each, or of options that have them. */
    createHull(options: HullDefOptions | ArrayLike<number>): Hull;
    /** Terrain: a grid of heights. */
    createHeightfield(options: HeightfieldDefOptions): Heightfield;
    /** Triangles of any form, for static and kinematic bodies. */
    createMesh(options: MeshDefOptions): Mesh;
    /** A form of many parts, each with its place. */
    createCompound(parts: readonly CompoundPartOptions[]): Compound;
    /** The asset of which save() made the bytes. Any bytes may be given: it is sound, or an error. */
    load(bytes: ArrayBuffer | ArrayBufferView): Asset;
    /** The object of a handle. */
    asset(handle: Handle<Asset>): Asset;
}

/** A rigid body. */
export class Body extends BodyCalls {
    /** The world that it is of. */
    readonly world: World;
    /** Its handle. */
    readonly id: number;
    /** Of the body's origin, m. Setting it moves the body at once, through whatever is between. */
    get position(): Vec3;
    set position(position: Vec3Like);
    /** Setting it turns the body at once; any length but zero. */
    get rotation(): Quat;
    set rotation(rotation: QuatLike);
    /** Destroys its shapes and joints too. */
    destroy(): void;
    /** Adds a shape of any form; mass and inertia follow. */
    createShape(geometry: GeometryOptions | Asset, options?: ShapeDefOptions | null): Shape;
    /** By its radius, m. */
    addSphere(radius: number, options?: ShapeDefOptions | null): Shape;
    /** Half the edges' lengths. */
    addBox(x: number, y: number, z: number, options?: ShapeDefOptions | null): Shape;
    /** A rod with round ends along local Y: half the height of its axis, and its radius, m. */
    addCapsule(halfHeight: number, radius: number, options?: ShapeDefOptions | null): Shape;
    /** Along local Y: half its height, and its radius, m. */
    addCylinder(halfHeight: number, radius: number, options?: ShapeDefOptions | null): Shape;
    /** Along local Y, its tip up: half its height, and the radius of its base, m. */
    addCone(halfHeight: number, radius: number, options?: ShapeDefOptions | null): Shape;
    /** The half space normal . p <= distance, on a static body. */
    addPlane(normal: Vec3Like, distance: number, options?: ShapeDefOptions | null): Shape;
}
/** A shape of a body: form, material, filters. */
export class Shape extends ShapeCalls {
    /** The world that it is of. */
    readonly world: World;
    /** Its handle. */
    readonly id: number;
}
/** A joint of two bodies, or of one and the world. */
export class Joint extends JointCalls {
    /** The world that it is of. */
    readonly world: World;
    /** Its handle. */
    readonly id: number;
    /** Which of the five it is. */
    readonly type: JointType;
}

/** Many bodies at once. Arrays are views of the module's memory, good until the next call of the list. */
export class Bodies {
    /** The world that it is of. */
    readonly world: World;
    /** How many there are. */
    readonly count: number;
    /** 7 floats a body: position relative to `origin`, rotation. */
    poses(origin?: Vec3Like): Float32Array;
    /** 6 floats a body: linear, then angular velocity. */
    velocities(): Float32Array;
    /** 6 floats a body, as velocities() has them: all or none. */
    setVelocities(values: ArrayLike<number>): void;
    /** Force at the centre, N, then torque, N m, 6 floats a body, during the next step. */
    addForces(values: ArrayLike<number>): void;
    /** Poses with positions in double. */
    transforms(): Transform[];
    /** Puts each where its transform says, at once: all or none. */
    setTransforms(transforms: readonly TransformOptions[]): void;
    /** Gives the memory of its arrays back; the bodies stay. */
    destroy(): void;
    /** For `using`: destroy(). */
    [Symbol.dispose](): void;
}

/** The last frames of a world, in memory, for rollback. It ends with destroy, or with its world. */
export class History {
    /** The world that it is of. */
    readonly world: World;
    /** Keeps the world as it is, before a step; numbers rise, the oldest frames go. */
    keep(frame: number): void;
    /** Puts the world back to a frame; those after it go. */
    restore(frame: number): void;
    /** The frames that it holds, the oldest first. */
    readonly frames: HistoryFrame[];
    /** Ends it and gives its memory back. */
    destroy(): void;
    /** For `using`: destroy(), unless that is done. */
    [Symbol.dispose](): void;
}

/** A recording of a world while it grows; World.createRecorder begins it. It ends with destroy, or when it is forgotten. */
export class Recorder {
    /** The world that it is of. */
    readonly world: World;
    /** What was recorded since the last read, to be appended to a file; of a flight recorder all that it keeps. */
    read(into?: Uint8Array): Uint8Array;
    /** Leaves words at this moment: at most 4096 bytes of UTF-8. */
    note(text: string, about?: Handle<Body | Shape | Joint | Asset> | null): void;
    /** Ends it and gives its memory back. */
    destroy(): void;
    /** For `using`: destroy(), unless that is done. */
    [Symbol.dispose](): void;
}
/** `store` is where assets are found that the recording does not hold. */
export interface PlayerOptions extends PlayerDefOptions { store?: Store }
/** A world that does what a recording says. */
export class Player {
    /** Plays the bytes of a recording, or what feed() gives it. */
    constructor(recording?: ArrayBuffer | ArrayBufferView | null, options?: PlayerOptions | null);
    /** Adds bytes of a recording, in pieces of any size. */
    feed(bytes: ArrayBuffer | ArrayBufferView): void;
    /** The recorded calls up to the end of the next step. False: there are no more yet. FE_ERROR_DIVERGED, once, when the
     * world went another way: `divergence` tells it, and the next call goes on. */
    step(): boolean;
    /** To the end of a step, forwards or backwards, as `info` counts them. False: the recording ends before it. */
    seek(step: number): boolean;
    /** Steps to the end, and gives the world after each. */
    [Symbol.iterator](): IterableIterator<World>;
    /** The world as it is now, to be read: what changes it is FE_ERROR_STATE, and so is this before the first step. */
    readonly world: World;
    /** Hands the world over: it may be changed, stepped and destroyed, and outlives the player. A seek makes another. */
    release(): World;
    /** How far it is, and what it was fed. */
    readonly info: PlayerInfo;
    /** The words that were left in what it was fed. */
    readonly notes: Note[];
    /** The first difference between the replay and its recording. */
    readonly divergence: Divergence | null;
    /** Its world ends with it, unless that was released. */
    destroy(): void;
    /** For `using`: destroy(), unless that is done. */
    [Symbol.dispose](): void;
}

/** How a world begins. */
export interface WorldOptions extends WorldDefOptions { store?: Store }
/** `base`: a whole snapshot; what differs from it is saved, and whoever restores that has the base, too. */
export interface SaveOptions extends SaveOptionsOptions { base?: ArrayBuffer | ArrayBufferView | null }
export interface RestoreOptions extends RestoreOptionsOptions { assets?: readonly Asset[]; base?: ArrayBuffer | ArrayBufferView | null }

/** Everything that can touch each other. */
export class World extends WorldCalls {
    /** Without options: the defaults. */
    constructor(options?: WorldOptions | null);
    /** Frees the world and all in it. */
    destroy(): void;
    /** For `using`: destroy(), unless that is done. */
    [Symbol.dispose](): void;
    /** True after destroy(). */
    readonly isDestroyed: boolean;
    /** Without options: a dynamic body at the origin. */
    createBody(options?: BodyDefOptions | null): Body;
    /** All or none. */
    createBodies(many: readonly BodyDefOptions[]): Body[];
    /** All or none. */
    destroyBodies(bodies: ArrayLike<Handle<Body>>): void;
    /** The objects of handles, as records have them. */
    body(handle: Handle<Body>): Body;
    /** The object of a handle. */
    shape(handle: Handle<Shape>): Shape;
    /** The object of a handle. */
    joint(handle: Handle<Joint>): Joint;
    /** Bodies whose poses, velocities and forces are read and written together. */
    list(bodies: ArrayLike<Handle<Body>>): Bodies;
    /** The last frames of the world, to go back to. */
    createHistory(options?: HistoryDefOptions | null): History;
    /** Another world that is as this one is. */
    clone(options?: WorldDefOptions | null): World;
    /** What the world is now, in the time of a copy. */
    createState(): State;
    /** The world becomes what the state is of: this one, a clone, or any that uses the same store. */
    setState(state: State): void;
    /** So many clones of this world, which step together. */
    createBatch(count: number, options?: Omit<BatchDefOptions, 'worldCount'> | null): Batch;
    /** Begins a recording; a world has one at most. */
    createRecorder(options?: RecorderDefOptions | null): Recorder;
    /** The store of its assets: its own, or the one that it was given. */
    readonly store: Store;
    /** In its store, as Store.createHull. */
    createHull(options: HullDefOptions | ArrayLike<number>): Hull;
    /** In its store, as Store.createHeightfield. */
    createHeightfield(options: HeightfieldDefOptions): Heightfield;
    /** In its store, as Store.createMesh. */
    createMesh(options: MeshDefOptions): Mesh;
    /** In its store, as Store.createCompound. */
    createCompound(parts: readonly CompoundPartOptions[]): Compound;
    /** 64 bits over the state, 16 hexadecimal digits: equal for equal runs, in every language. */
    readonly hash: string;
    /** The bodies that the last step moved, in the same object each time. */
    getMoved(origin?: Vec3Like): Moved;
    /** 6 numbers a ray: origin, translation. */
    raycastMany(rays: ArrayLike<number>, filter?: QueryFilterOptions | null): (Hit | null)[];
    /** The same, as a view of the module's memory that makes no garbage: HitLayout says where what lies. */
    raycastRaw(rays: ArrayLike<number>, filter?: QueryFilterOptions | null): RawHits;
    /** The same form along many paths: for each the first hit, or null. */
    sweepMany(geometry: GeometryOptions, paths: readonly PathOptions[], filter?: QueryFilterOptions | null): (Hit | null)[];
    /** The whole world as bytes: the same on every machine. */
    save(options?: SaveOptions | null, into?: Uint8Array): Uint8Array;
    /** False when the bytes are of a library whose results differ. */
    restore(bytes: ArrayBuffer | ArrayBufferView, options?: RestoreOptions | null): boolean;
    /** A new world of the bytes that save() made. */
    static load(bytes: ArrayBuffer | ArrayBufferView, options?: RestoreOptions | null, def?: WorldOptions | null): World;
    /** 6 words a vertex: x, y, z, rgba, handle of what it belongs to. */
    drawLines(options?: DrawOptionsOptions | null): Drawn;
    /** Triangles, three vertices each, as drawLines has them. */
    drawTriangles(options?: DrawOptionsOptions | null): Drawn;
    /** Points, a vertex each, as drawLines has them. */
    drawPoints(options?: DrawOptionsOptions | null): Drawn;
    /** An instance a shape: its form, colour and pose. */
    drawInstances(options?: DrawOptionsOptions | null): Drawn;
}
/** The form of an instance that World.drawInstances wrote. */
export function instanceType(drawn: Drawn, index: number): GeometryType;
/** Every check of a restore, without a world. */
export function checkSnapshot(bytes: ArrayBuffer | ArrayBufferView): SnapshotInfo;
export function snapshotAssets(bytes: ArrayBuffer | ArrayBufferView): AssetKey[];
/** Where two snapshots differ first, or null. */
export function compareSnapshots(a: ArrayBuffer | ArrayBufferView, b: ArrayBuffer | ArrayBufferView): Difference | null;
/** The library's version: '1.0.0'. */
export function version(): string;
/** The last refusal, in a sentence. */
export function lastError(): string;

/** A world as it was, to go back to in the time of a copy: world.setState(state). It belongs to no world. */
export class State {
    private constructor();
    /** Gives its memory back. */
    destroy(): void;
    /** For `using`: destroy(), unless that is done. */
    [Symbol.dispose](): void;
}
/** Numbers that each step of a batch reads or fills: world by world, item by item. */
export interface BatchArray {
    /** A view of the module's memory, good until it grows: ask for it after each step. */
    readonly values: Float32Array;
    /** Worlds, items, numbers of one. */
    readonly shape: readonly [number, number, number];
    readonly length: number;
}
/** What a batch knows of its worlds; see fe_field in feather.h. */
export type BatchField = Exclude<Field, 'none'>;
/** What a field of a batch is read or written of. */
export type Item = Handle<Body> | Handle<Shape> | Handle<Joint>;
/** Where the numbers of an array are read from. */
export interface BatchArrayOptions {
    /** Poses relative to this body, vectors along its axes. */
    relativeTo?: Handle<Body>;
    /** Of the world's frame, m: positions are read from there. */
    origin?: Vec3Like;
}
/** Many clones of a world that step together. Its bodies, shapes and joints name those of each of them. */
export class Batch {
    private constructor();
    /** Worlds. */
    readonly length: number;
    /** Of the last call: 0 for each world that it went well with, else the negative code. */
    readonly results: Int32Array;
    /** World.hash of each. */
    readonly hashes: string[];
    /** One of the worlds, for all other calls but destroy(). */
    world(index: number): World;
    /** @param mask  which worlds; left out: all. @return how many failed; the others went on */
    step(dt: number, steps?: number, mask?: ArrayLike<number | boolean> | null): number;
    /** Back to what the world was when the batch was made, or to a state of each. */
    reset(mask?: ArrayLike<number | boolean> | null, states?: ArrayLike<State | null | undefined> | null): number;
    /** A value of each item, world by world. */
    read(field: BatchField, items?: ArrayLike<Item> | null, options?: BatchArrayOptions, into?: Float32Array): Float32Array;
    /** Writes a value of each item, world by world. Returns how many worlds refused. */
    write(field: BatchField, items: ArrayLike<Item> | null, numbers: ArrayLike<number>, mask?: ArrayLike<number | boolean> | null): number;
    /** What you write into its values acts in each step; poses, velocities, masses, frictions and gravity begin as they are. */
    input(field: BatchField, items?: ArrayLike<Item> | null): BatchArray;
    /** What each step fills. */
    output(field: BatchField, items?: ArrayLike<Item> | null, options?: BatchArrayOptions): BatchArray;
    /** Ends it and gives its memory back. */
    destroy(): void;
    /** For `using`: destroy(), unless that is done. */
    [Symbol.dispose](): void;
}
/** What `await Feather()` gives. */
export type FeatherModule = Omit<typeof import('./index.js'), 'default'>;
interface Feather {
    (source?: BufferSource | WebAssembly.Module | Response | Promise<BufferSource | WebAssembly.Module | Response>): Promise<FeatherModule>;
    sync(source?: BufferSource | WebAssembly.Module): FeatherModule;
}
declare const Feather: Feather;
export default Feather;
