// names.js - all that the package gives, once the module has started.
import * as hand from './hand.js';
import * as api from './api.js';
import { FeatherError, lastError } from './runtime.js';
const { World, Body, Shape, Joint, Store, Asset, Hull, Heightfield, Mesh, Compound, Bodies, History, checkSnapshot, snapshotAssets, instanceType, version } = hand;
export const feather = Object.freeze({
    World, Body, Shape, Joint, Store, Asset, Hull, Heightfield, Mesh, Compound, Bodies, History, FeatherError, checkSnapshot,
    snapshotAssets, instanceType, version, lastError, HitLayout: api.HitLayout, Axis: api.Axis, ShapeEvents: api.ShapeEvents,
    MeshFlags: api.MeshFlags, MeshEdgeFlags: api.MeshEdgeFlags, DrawFlags: api.DrawFlags, QueryFlags: api.QueryFlags,
    HitFlags: api.HitFlags, Save: api.Save, Dof: api.Dof,
});
export { World, Body, Shape, Joint, Store, Asset, Hull, Heightfield, Mesh, Compound, Bodies, History, FeatherError, checkSnapshot, snapshotAssets, instanceType, version, lastError };
export const { HitLayout, Axis, ShapeEvents, MeshFlags, MeshEdgeFlags, DrawFlags, QueryFlags, HitFlags, Save, Dof } = api;
