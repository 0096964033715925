// feather-physics/module: the caller brings the module: bytes, a WebAssembly.Module, a Response, or a promise of one.
import { start, startAsync, World, Body, Shape, Joint, Store, Asset, Hull, Heightfield, Mesh, Compound, Bodies, History, Recorder, Player, Batch, State, FeatherError, checkSnapshot, snapshotAssets, compareSnapshots, instanceType, version, lastError, HitLayout, Axis, ShapeEvents, MeshFlags, MeshEdgeFlags, DrawFlags, QueryFlags, HitFlags, RecordFlags, Save, Dof } from './core.js';

// All that the package gives, once the module has started
export const feather = Object.freeze({
    World, Body, Shape, Joint, Store, Asset, Hull, Heightfield, Mesh, Compound, Bodies, History, Recorder, Player,
    Batch, State, FeatherError, checkSnapshot, snapshotAssets, compareSnapshots, instanceType, version, lastError,
    HitLayout, Axis, ShapeEvents, MeshFlags, MeshEdgeFlags, DrawFlags, QueryFlags, HitFlags, RecordFlags, Save,
    Dof,
});
export {
    World, Body, Shape, Joint, Store, Asset, Hull, Heightfield, Mesh, Compound, Bodies, History, Recorder, Player,
    Batch, State, FeatherError, checkSnapshot, snapshotAssets, compareSnapshots, instanceType, version, lastError,
    HitLayout, Axis, ShapeEvents, MeshFlags, MeshEdgeFlags, DrawFlags, QueryFlags, HitFlags, RecordFlags, Save,
    Dof,
};

export default async function Feather(source) {
    await startAsync(await source);
    return feather;
}
Feather.sync = (source) => {
    start(source);
    return feather;
};
