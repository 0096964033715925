// names.js - all that the package gives, once the module has started.
import * as hand from './hand.js';
import * as api from './api.js';
import { Recorder } from './recorder.js';
import { Player } from './player.js';
import { Batch, State } from './batch.js';
import { FeatherError, lastError } from './runtime.js';
const { World, Body, Shape, Joint, Store, Asset, Hull, Heightfield, Mesh, Compound, Bodies, History, checkSnapshot, snapshotAssets, compareSnapshots, instanceType, version } = hand;
export const feather = Object.freeze({
    World, Body, Shape, Joint, Store, Asset, Hull, Heightfield, Mesh, Compound, Bodies, History, Recorder, Player, Batch, State, FeatherError, checkSnapshot,
    snapshotAssets, compareSnapshots, instanceType, version, lastError, HitLayout: api.HitLayout, Axis: api.Axis, ShapeEvents: api.ShapeEvents,
    MeshFlags: api.MeshFlags, MeshEdgeFlags: api.MeshEdgeFlags, DrawFlags: api.DrawFlags, QueryFlags: api.QueryFlags,
    HitFlags: api.HitFlags, RecordFlags: api.RecordFlags, Save: api.Save, Dof: api.Dof,
});
export { World, Body, Shape, Joint, Store, Asset, Hull, Heightfield, Mesh, Compound, Bodies, History, Recorder, Player, Batch, State, FeatherError, checkSnapshot, snapshotAssets, compareSnapshots, instanceType, version, lastError };
export const { HitLayout, Axis, ShapeEvents, MeshFlags, MeshEdgeFlags, DrawFlags, QueryFlags, HitFlags, RecordFlags, Save, Dof } = api;
