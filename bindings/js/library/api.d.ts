// Made from include/feather.h by bindings/js/generate.mjs
import type { Body, Shape, Joint, Asset } from './index.js';
/** Read. */
export interface Vec3 { x: number; y: number; z: number }
/** A rotation, read: of length 1. */
export interface Quat { x: number; y: number; z: number; w: number }
/** Given: an object with x, y, z or an array of 3. */
export type Vec3Like = Readonly<Vec3> | readonly [number, number, number] | Float32Array | Float64Array;
/** Given: an object with x, y, z, w or an array of 4. */
export type QuatLike = Readonly<Quat> | readonly [number, number, number, number] | Float32Array | Float64Array;
/** A handle, or the object that has it. */
export type Handle<T> = number | T;
/** Where what lies in a record of World.raycastRaw: indices of `doubles` for point and fraction, else of `words` and `floats`. */
export const HitLayout: { readonly body: 0; readonly shape: 2; readonly point: 2; readonly fraction: 5; readonly material: 12; readonly normal: 14; readonly depth: 17; readonly part: 18; readonly triangle: 19; readonly barycentric: 20; readonly flags: 22 };
export type Result = 'ok' | 'foreign' | 'end' | 'errorArgument' | 'errorStale' | 'errorKind' | 'errorStepping' | 'errorMemory' | 'errorLimit' | 'errorUnsupported' | 'errorState' | 'errorBusy' | 'errorDegenerate' | 'errorData' | 'errorVersion' | 'errorDiverged';
export type Combine = 'default' | 'average' | 'minimum' | 'multiply' | 'maximum';
export type MeshFlags = 'twoSided' | 'strict';
export const MeshFlags: { readonly twoSided: 1; readonly strict: 2 };
export type IndexType = 'u32' | 'u16';
export type MeshEdgeFlags = 'felt' | 'convex' | 'open';
export const MeshEdgeFlags: { readonly felt: 1; readonly convex: 2; readonly open: 4 };
export type Simd = 'auto' | 'plain' | 'sse2' | 'avx2' | 'avx512' | 'neon' | 'wasm';
export type BodyType = 'static' | 'kinematic' | 'dynamic';
export type Axis = 'none' | 'x' | 'y' | 'z' | 'all';
export const Axis: { readonly none: 0; readonly x: 1; readonly y: 2; readonly z: 4; readonly all: 7 };
export type GeometryType = 'none' | 'sphere' | 'capsule' | 'box' | 'cylinder' | 'cone' | 'hull' | 'plane' | 'heightfield' | 'mesh' | 'compound';
export type ShapeEvents = 'none' | 'touch' | 'stay' | 'hit';
export const ShapeEvents: { readonly none: 0; readonly touch: 1; readonly stay: 2; readonly hit: 4 };
export type JointType = 'distance' | 'ball' | 'hinge' | 'fixed' | 'configurable';
export type Motion = 'locked' | 'limited' | 'free';
export type Spring = 'none' | 'hertz' | 'stiffness';
export type Dof = 'linearX' | 'linearY' | 'linearZ' | 'angularX' | 'angularY' | 'angularZ';
export const Dof: { readonly linearX: 0; readonly linearY: 1; readonly linearZ: 2; readonly angularX: 3; readonly angularY: 4; readonly angularZ: 5 };
export type QueryFlags = 'default' | 'triggers';
export const QueryFlags: { readonly default: 0; readonly triggers: 1 };
export type HitFlags = 'default' | 'startedInside' | 'back';
export const HitFlags: { readonly default: 0; readonly startedInside: 1; readonly back: 2 };
export type EventKind = 'enter' | 'stay' | 'exit' | 'sleep' | 'wake' | 'break';
export type Save = 'assets' | 'diff';
export const Save: { readonly assets: 1; readonly diff: 2 };
export type Field = 'none' | 'transform' | 'velocity' | 'force' | 'awake' | 'joint' | 'jointForce' | 'jointSpeed' | 'jointTarget' | 'reaction' | 'gravity' | 'contactForce' | 'mass' | 'friction';
export type RecordFlags = 'none' | 'assets' | 'fine' | 'last';
export const RecordFlags: { readonly none: 0; readonly assets: 1; readonly fine: 2; readonly last: 4 };
export type DivergenceType = 'call' | 'step' | 'keyframe';
export type DrawFlags = 'none' | 'shapes' | 'contacts' | 'forces' | 'joints' | 'limits' | 'islands' | 'sleep' | 'bounds' | 'centres' | 'trees';
export const DrawFlags: { readonly none: 0; readonly shapes: 1; readonly contacts: 2; readonly forces: 4; readonly joints: 8; readonly limits: 16; readonly islands: 32; readonly sleep: 64; readonly bounds: 128; readonly centres: 256; readonly trees: 512 };
/** What a hull is. Positions are in the frame of its points. */
export interface HullInfo {
    /** 4..255 */
    vertexCount: number;
    /** vertices - edges + faces = 2 */
    edgeCount: number;
    /** 4..506 */
    faceCount: number;
    /** m3 */
    volume: number;
    /** of the surface, m2 */
    area: number;
    /** of mass, m */
    centre: Vec3;
    /** principal moments about the centre at a density of 1 kg/m3, kg m2 */
    inertia: Vec3;
    /** from the principal axes to those of the points */
    inertiaRotation: Quat;
    /** least and greatest corner of the bounds of the vertices, m */
    lower: Vec3;
    /** least and greatest corner of the bounds of the vertices, m */
    upper: Vec3;
    /** the least distance between a face and the vertex farthest from it, m */
    thickness: number;
    /** of the largest ball about the centre that is inside, m */
    innerRadius: number;
    /** what counted, m */
    tolerance: number;
    /** how far the farthest point that was left out lies outside a face's plane, m, >= 0 */
    error: number;
    /** of memory */
    bytes: number;
}
/** A face of a hull: a convex polygon. */
export interface HullFace {
    /** of its corners in what fe_hull_get_corners writes */
    first: number;
    /** of corners, >= 3 */
    count: number;
    /** unit, outward */
    normal: Vec3;
    /** no point p of the hull is beyond it: normal . p <= distance, m, but for the rounding of floats */
    distance: number;
}
/** What a mesh is. */
export interface MeshInfo {
    /** that are kept */
    triangleCount: number;
    /** dropped: no higher than 3e-8 of their largest coordinate */
    degenerateTriangles: number;
    /** dropped: the same corners and winding as an earlier one */
    duplicateTriangles: number;
    /** places that differ */
    vertexCount: number;
    /** of one triangle */
    openEdges: number;
    /** of more than two */
    crowdedEdges: number;
    /** of two with opposite windings */
    flippedEdges: number;
    /** levels of nodes */
    treeHeight: number;
    /** 0: its triangles have their shape's material */
    materialCount: number;
    /** least and greatest corner of the bounds, m */
    lower: Vec3;
    /** least and greatest corner of the bounds, m */
    upper: Vec3;
    /** m2 */
    area: number;
    /** m3 of a closed mesh, negative when it is wound inside out; else 0 */
    volume: number;
    /** of memory */
    bytes: number;
}
/** A triangle of a mesh. */
export interface MeshTriangle {
    /** index into the mesh's materials, -1: the shape's */
    material: number;
    /** m, in the frame of the definition's vertices, after welding */
    corners: [Vec3, Vec3, Vec3];
    /** fe_mesh_edge_flags of the edges from corner 0 to 1, 1 to 2, 2 to 0 */
    edges: [number, number, number];
    /** of the definition, else 0 */
    data: number;
    /** 0: it was dropped, and all above is 0 */
    kept: boolean;
}
/** How the solver behaves. Each value may change between steps. */
export interface WorldTuning {
    /** stiffness of contacts, 1/s, > 0; twice that against static bodies. Default 30 */
    contactHertz: number;
    /** >= 0; 1 is critical, higher pushes out more gently. Default 10 */
    contactDampingRatio: number;
    /** overlap is pushed out no faster, m/s, >= 0. Default 3 */
    contactPushSpeed: number;
    /** stiffness of joints, 1/s, > 0. Default 60 */
    jointHertz: number;
    /** >= 0. Default 2 */
    jointDampingRatio: number;
    /** slower impacts do not bounce, m/s, >= 0. Default 1 */
    restitutionThreshold: number;
    /** slower impacts make no hit event, m/s, >= 0. Default 1 */
    hitEventThreshold: number;
    /** how long a body must be slow before it may sleep, s, >= 0. Default 0.5 */
    sleepTime: number;
    /** contacts are made up to this gap, m, 0.001..0.1. Default 0.02 */
    speculativeDistance: number;
    /** m/s, > 0. Default 4000 */
    maxLinearSpeed: number;
    /** 0: nobody falls asleep, and who sleeps wakes. Default 1 */
    sleepEnabled: boolean;
    /** 0: fast bodies may pass through thin ones. Default 1 */
    continuousEnabled: boolean;
    /** 0: contacts begin each step without the impulses of the last one. Default 1 */
    warmStartEnabled: boolean;
}
/** Where the last step's time went, ms of the stepping thread's clock. A world of a batch has its share of `step`
 * alone: reading the clock between stages would take a twentieth of it. */
export interface Profile {
    /** all of it */
    step: number;
    /** tree queries, new pairs */
    pairs: number;
    /** narrow phase, recycling */
    collide: number;
    /** islands, colours, batches */
    islands: number;
    /** all substeps */
    solve: number;
    /** bodies too fast for their size */
    continuous: number;
    /** poses, bounds, trees */
    finalize: number;
    /** touching begun and ended, impacts, broken joints */
    events: number;
    /** who falls asleep */
    sleep: number;
}
/** Sizes of a world now, and of what its last step did. */
export interface Counters {
    /** alive */
    bodies: number;
    /** alive */
    shapes: number;
    /** alive */
    joints: number;
    /** dynamic and kinematic ones */
    awakeBodies: number;
    /** pairs of shapes whose bounds meet */
    pairs: number;
    /** of these, touching, triggers not counted */
    contacts: number;
    /** contacts that kept their manifold in the last step */
    recycled: number;
    /** awake */
    islands: number;
    /** of the largest island */
    colours: number;
    /** of W contacts each, or of 4 where a colour has no more */
    rows: number;
    /** of these, in islands that one worker solved whole */
    rowsWhole: number;
    /** contacts in all rows */
    lanes: number;
    /** fe_simd in use */
    simd: Simd;
    /** W, floats side by side */
    simdWidth: number;
    /** that a step is spread over */
    workers: number;
    /** allocated now, without its store */
    bytes: number;
    /** since the world was created */
    allocations: number;
    /** awake sets of joints without a loop that the last step solved exactly */
    trees: number;
    /** since the world was created: see fe_world_step */
    contactsLeftOut: number;
}
/** An axis-aligned box in world space, m. */
export interface Bounds {
    /** its least and its greatest corner */
    lower: Vec3;
    /** its least and its greatest corner */
    upper: Vec3;
}
/** Energy of all enabled dynamic bodies, asleep or awake. */
export interface Energy {
    /** of translation and rotation, J */
    kinetic: number;
    /** in the world's gravity, J; 0 at the world's origin */
    potential: number;
}
/** A pose in the world. */
export interface Transform {
    /** m */
    position: Vec3;
    /** from its own axes to the world's */
    rotation: Quat;
}
/** The mass of a body and how it is spread. */
export interface MassData {
    /** kg, > 0 */
    mass: number;
    /** of mass, m, body space */
    centre: Vec3;
    /** principal moments about the centre, kg m2, > 0, none above the sum of the other two */
    inertia: Vec3;
    /** principal axes in body space */
    inertiaRotation: Quat;
}
/** The form of a shape, in the shape's frame, m. Every length lies in [0.001, 100000]. */
export interface Geometry {
    /** fe_geometry_type */
    type: GeometryType;
    /** m */
    radius: number;
    /** of a capsule's axis, of a cylinder, of a cone, m */
    halfHeight: number;
    /** of a box, m */
    halfExtents: Vec3;
    /** of a plane, any length but zero */
    normal: Vec3;
    /** of a plane from the origin along its normal, m */
    distance: number;
    /** Of a hull or a mesh, along the axes of its points: each 0.001..1000 in magnitude, a negative one mirrors. 0, 0, 0 counts as 1, 1, 1. All other forms have one of these two. */
    scale: Vec3;
    /** of a hull, a heightfield, a mesh, a compound */
    asset: number;
}
/** A frame in the space of a body. */
export interface Frame {
    /** m */
    position: Vec3;
    /** from its own axes to the body's */
    rotation: Quat;
}
/** A surface. Rolling and spinning resistance of a pair are the larger of the two, and so is its radius: of a cone that
 * of the base, of boxes and hulls 0. Never grows. */
export interface Material {
    /** while the contact sticks, >= 0. Default 0.6 */
    staticFriction: number;
    /** when it slides, >= 0. Default 0.5 */
    dynamicFriction: number;
    /** 0..1. Default 0 */
    restitution: number;
    /** no unit, >= 0: torque cap = it x radius x normal force. Default 0 */
    rollingResistance: number;
    /** m, >= 0: torque cap about the normal = it x normal force. Default 0 */
    spinningResistance: number;
    /** fe_combine, of both frictions. Default FE_COMBINE_DEFAULT */
    frictionCombine: Combine;
    /** fe_combine. Default FE_COMBINE_DEFAULT */
    restitutionCombine: Combine;
    /** any number of yours: hits, contacts and hit events report it. Default 0 */
    userId: number | bigint;
}
/** What a compound is. */
export interface CompoundInfo {
    /** how many parts it has */
    partCount: number;
    /** least and greatest corner of the bounds of its parts, m, in the compound's space */
    lower: Vec3;
    /** least and greatest corner of the bounds of its parts, m, in the compound's space */
    upper: Vec3;
    /** of memory, without the assets of its parts */
    bytes: number;
}
/** A part of a compound. */
export interface CompoundPart {
    /** kg/m3, >= 0; -1: that of the shape (fe_shape_def). Default -1 */
    density: number;
    /** of the part, in the compound's space. Default the compound's own */
    frame: Frame;
    /** 1: it has `material`; 0: that of the shape. Default 0 */
    ownMaterial: boolean;
    /** any but a plane and a compound. Default FE_GEOMETRY_NONE */
    geometry: Geometry;
    /** counts with own_material */
    material: Material;
    /** any number of yours: fe_compound_get_part reads it. Default 0 */
    userData: number | bigint;
}
/** Two points keep their distance within [lower, upper] (equal: a rod; from 0: a rope). A spring pulls it to `target`,
 * a motor changes it. Only the positions of the frames count. The first fields are those of fe_joint_def, here and
 * below. */
export interface DistanceJointDef {
    enabled: boolean;
    bodyA: number;
    bodyB: number;
    userData: number | bigint;
    worldOrigin: Vec3;
    frameA: Frame;
    frameB: Frame;
    collideConnected: boolean;
    /** of both ends of the range */
    hertz: number;
    /** of both ends of the range */
    dampingRatio: number;
    breakForce: number;
    breakTorque: number;
    /** 1: lower <= distance <= upper. Default 1 */
    limitEnabled: boolean;
    /** m, >= 0, at most upper. Default 1 */
    lower: number;
    /** m, >= 0.001. Default 1 */
    upper: number;
    /** 1/s, >= 0; 0: no spring. Default 0 */
    springHertz: number;
    /** >= 0. Default 1 */
    springDampingRatio: number;
    /** cap of the spring, N, >= 0. Default 1e15 */
    springMax: number;
    /** distance that the spring pulls to, m, >= 0. Default 1 */
    target: number;
    /** at which the motor lengthens it, m/s. Default 0 */
    motorSpeed: number;
    /** cap, N, >= 0; with speed 0 a friction; 0: no motor. Default 0 */
    motorMax: number;
}
/** Two points stay together. An elliptic cone may bound the swing of axis X, limits the twist about it. A spring
 * rotates B to a target. */
export interface BallJointDef {
    enabled: boolean;
    bodyA: number;
    bodyB: number;
    userData: number | bigint;
    worldOrigin: Vec3;
    frameA: Frame;
    frameB: Frame;
    collideConnected: boolean;
    /** of the points */
    hertz: number;
    /** of the points */
    dampingRatio: number;
    breakForce: number;
    breakTorque: number;
    /** 1: (swing_y / cone_y)^2 + (swing_z / cone_z)^2 <= 1. Default 0 */
    coneEnabled: boolean;
    /** half angles, rad, 0.01..pi. Default pi */
    coneY: number;
    /** half angles, rad, 0.01..pi. Default pi */
    coneZ: number;
    /** 1: lower <= twist <= upper. Default 0 */
    limitEnabled: boolean;
    /** rad, -pi..pi. Default -pi, pi */
    lower: number;
    /** rad, -pi..pi. Default -pi, pi */
    upper: number;
    /** of cone and limits, 1/s, >= 0; 0: rigid. Default 0 */
    limitHertz: number;
    /** >= 0. Default 1 */
    limitDampingRatio: number;
    /** of the spring that rotates B to `target`, 1/s, >= 0; 0: none. Default 0 */
    springHertz: number;
    /** >= 0. Default 1 */
    springDampingRatio: number;
    /** its cap, N m, >= 0. Default 1e15 */
    springMax: number;
    /** q to reach. Default none */
    target: Quat;
    /** of B against A, rad/s, frame A. Default 0 */
    motorVelocity: Vec3;
    /** cap, N m, >= 0; with velocity 0 a friction; 0: no motor. Default 0 */
    motorMax: number;
}
/** Two points and their axes X stay together: a door, an elbow, an axle. The angle is the twist. */
export interface HingeJointDef {
    enabled: boolean;
    bodyA: number;
    bodyB: number;
    userData: number | bigint;
    worldOrigin: Vec3;
    frameA: Frame;
    frameB: Frame;
    collideConnected: boolean;
    /** of points and axes */
    hertz: number;
    /** of points and axes */
    dampingRatio: number;
    breakForce: number;
    breakTorque: number;
    /** 1: lower <= angle <= upper. Default 0 */
    limitEnabled: boolean;
    /** rad, -pi..pi. Default -pi, pi */
    lower: number;
    /** rad, -pi..pi. Default -pi, pi */
    upper: number;
    /** 1/s, >= 0; 0: rigid. Default 0 */
    limitHertz: number;
    /** >= 0. Default 1 */
    limitDampingRatio: number;
    /** of the spring that rotates it to `target`, 1/s, >= 0; 0: none. Default 0 */
    springHertz: number;
    /** >= 0. Default 1 */
    springDampingRatio: number;
    /** its cap, N m, >= 0. Default 1e15 */
    springMax: number;
    /** rad, -pi..pi. Default 0 */
    target: number;
    /** rad/s. Default 0 */
    motorSpeed: number;
    /** cap, N m, >= 0; with speed 0 a friction; 0: no motor. Default 0 */
    motorMax: number;
}
/** The two frames stay one. */
export interface FixedJointDef {
    enabled: boolean;
    bodyA: number;
    bodyB: number;
    userData: number | bigint;
    worldOrigin: Vec3;
    frameA: Frame;
    frameB: Frame;
    collideConnected: boolean;
    /** of the points */
    hertz: number;
    /** of the points */
    dampingRatio: number;
    breakForce: number;
    breakTorque: number;
    /** of the rotation, 1/s, >= 0; 0: rigid. Default 0 */
    angularHertz: number;
    /** >= 0. Default 1 */
    angularDampingRatio: number;
}
/** Six axes, each locked, limited or free, with springs and motors: sliders, wheels, actuators and whatever else. With
 * two rotations locked the third rotates freely. With one locked, swing stops at 170 degrees, or at 137 when the twist
 * is the locked one, as in a cardan joint. */
export interface ConfigurableJointDef {
    enabled: boolean;
    bodyA: number;
    bodyB: number;
    userData: number | bigint;
    worldOrigin: Vec3;
    frameA: Frame;
    frameB: Frame;
    collideConnected: boolean;
    /** of the locked axes */
    hertz: number;
    /** of the locked axes */
    dampingRatio: number;
    breakForce: number;
    breakTorque: number;
    /** by fe_dof. Default: all locked */
    axes: [JointAxis, JointAxis, JointAxis, JointAxis, JointAxis, JointAxis];
}
/** All definitions of joints begin with the fields of this one. fe_joint_get and fe_joint_set read and write them on
 * joints of any type. */
export interface JointDef {
    /** 0: as if it were not there. Default 1 */
    enabled: boolean;
    /** two different ones; 0 is the world; in a _set: they stay as they are */
    bodyA: number;
    /** two different ones; 0 is the world; in a _set: they stay as they are */
    bodyB: number;
    /** any number of yours. Default 0 */
    userData: number | bigint;
    /** m, world space: where the frame of body 0 is measured from. Default 0 */
    worldOrigin: Vec3;
    /** in body space. Default: the bodies' own */
    frameA: Frame;
    /** in body space. Default: the bodies' own */
    frameB: Frame;
    /** 1: its two bodies may touch. Default 0: they never do */
    collideConnected: boolean;
    /** stiffness of what is locked, 1/s, >= 0; 0: rigid. Default 0 */
    hertz: number;
    /** of what is locked, >= 0; counts when hertz > 0. Default 1 */
    dampingRatio: number;
    /** it breaks when its reaction exceeds this, N, >= 0; 0: never. Default 0 */
    breakForce: number;
    /** N m, >= 0; 0: never. Default 0 */
    breakTorque: number;
}
/** How a joint stands now: what its limits and springs act on. */
export interface JointState {
    /** the twist; of a hinge the angle, rad */
    angle: number;
    /** rad */
    swingY: number;
    /** rad */
    swingZ: number;
    /** of B against A, rad/s, axes of frame A */
    angularVelocity: Vec3;
    /** of frame B's point in frame A, m */
    translation: Vec3;
    /** its rate of change, m/s */
    linearVelocity: Vec3;
    /** between the two points, m */
    length: number;
    /** its rate of change, m/s */
    speed: number;
    /** distance of the points from where they are held, or beyond a limit, m */
    linearError: number;
    /** likewise, rad */
    angularError: number;
}
/** Where a ray or a moving form met a body. */
export interface Hit {
    /** that was hit */
    body: number;
    /** of the body */
    shape: number;
    /** on the body's surface, m, world space; started inside: where the centre started */
    point: Vec3;
    /** 0..1 of the translation */
    fraction: number;
    /** fe_material.user_id of what was hit */
    material: number | bigint;
    /** unit, out of the body; started inside: against the translation, or the shortest way out when that is zero */
    normal: Vec3;
    /** started inside: length of the shortest way out, m; else 0 */
    depth: number;
    /** of a compound, else -1 */
    part: number;
    /** of a heightfield or a mesh, or the face of a hull, else -1 */
    triangle: number;
    /** weights of the triangle's second and third vertex at `point`; else 0, 0 */
    barycentric: [number, number];
    /** fe_hit_flags */
    flags: number;
}
/** A shape that a geometry overlaps, and the shortest translation that parts the two. */
export interface Overlap {
    /** that overlaps */
    body: number;
    /** of the body */
    shape: number;
    /** fe_material.user_id where it is deepest */
    material: number | bigint;
    /** unit, out of the shape: a translation of the geometry by `depth` along it parts the two */
    direction: Vec3;
    /** m, >= 0 */
    depth: number;
    /** of a compound, where it is deepest; else -1 */
    part: number;
    /** of a heightfield or a mesh, where it is deepest; the face of a hull on that way; else -1 */
    triangle: number;
}
/** The point of a surface that is closest to a point. */
export interface Closest {
    /** that is closest */
    body: number;
    /** of the body */
    shape: number;
    /** of the shape's surface, m, world space */
    point: Vec3;
    /** to the surface, m; below 0 inside */
    distance: number;
    /** fe_material.user_id there */
    material: number | bigint;
    /** unit, out of the body; of a mesh towards the side that the point is on */
    normal: Vec3;
    /** of a compound, else -1 */
    part: number;
    /** of a heightfield or a mesh, or the face of a hull, else -1 */
    triangle: number;
    /** weights of the triangle's second and third vertex at `point`; else 0, 0 */
    barycentric: [number, number];
}
/** Two shapes began to touch, went on, or ceased: a point had an impulse, or a gap of 0 or less, during the step. A is
 * the body created first. After the exit caused by a destruction, the handles of what was destroyed are stale. */
export interface PairEvent {
    /** the two that met */
    bodyA: number;
    /** the two that met */
    bodyB: number;
    /** of these bodies */
    shapeA: number;
    /** of these bodies */
    shapeB: number;
    /** FE_EVENT_ENTER, FE_EVENT_STAY, FE_EVENT_EXIT */
    kind: EventKind;
    /** 1 when either is a trigger */
    isTrigger: boolean;
    /** of compounds: those of the deepest point; -1 at an exit, and of others */
    partA: number;
    /** of compounds: those of the deepest point; -1 at an exit, and of others */
    partB: number;
    /** of a heightfield or a mesh, under the deepest point, else -1 */
    triangleA: number;
    /** of a heightfield or a mesh, under the deepest point, else -1 */
    triangleB: number;
}
/** A body fell asleep or woke. */
export interface BodyEvent {
    /** that fell asleep or woke */
    body: number;
    /** FE_EVENT_SLEEP, FE_EVENT_WAKE */
    kind: EventKind;
}
/** An impact. */
export interface HitEvent {
    /** the two that met */
    bodyA: number;
    /** the two that met */
    bodyB: number;
    /** of these bodies */
    shapeA: number;
    /** of these bodies */
    shapeB: number;
    /** fe_material.user_id where they met */
    materialA: number | bigint;
    /** fe_material.user_id where they met */
    materialB: number | bigint;
    /** m, world space */
    point: Vec3;
    /** from A to B */
    normal: Vec3;
    /** of approach, m/s */
    speed: number;
    /** of the step, along the normal, N s */
    impulse: number;
    /** of compounds: where the impulse was largest, else -1 */
    partA: number;
    /** of compounds: where the impulse was largest, else -1 */
    partB: number;
    /** of a heightfield or a mesh, else -1 */
    triangleA: number;
    /** of a heightfield or a mesh, else -1 */
    triangleB: number;
}
/** A joint's reaction exceeded its break_force or break_torque in the last step: it is gone, its handle stale. */
export interface JointEvent {
    /** that broke */
    joint: number;
    /** 0: the world */
    bodyA: number;
    /** 0: the world */
    bodyB: number;
    /** of the joint */
    userData: number | bigint;
    /** FE_EVENT_BREAK */
    kind: EventKind;
    /** fe_joint_type */
    type: JointType;
    /** reaction that broke it, see fe_joint_get_reaction */
    force: Vec3;
    /** likewise, N m */
    torque: Vec3;
}
/** A pair of shapes has one, with compounds each pair of parts; with a heightfield or a mesh one for each direction in
 * which it is touched, at most 6. */
export interface Contact {
    /** the two that met */
    bodyA: number;
    /** the two that met */
    bodyB: number;
    /** of these bodies */
    shapeA: number;
    /** of these bodies */
    shapeB: number;
    /** fe_material.user_id under the deepest point */
    materialA: number | bigint;
    /** fe_material.user_id under the deepest point */
    materialB: number | bigint;
    /** unit, from A to B */
    normal: Vec3;
    /** 1..4 */
    pointCount: number;
    /** the first point_count of them */
    points: [ContactPoint, ContactPoint, ContactPoint, ContactPoint];
    /** on B, of the last substep, N s */
    frictionImpulse: Vec3;
    /** on B, about the normal, N m s */
    twistImpulse: number;
    /** of compounds, else -1 */
    partA: number;
    /** of compounds, else -1 */
    partB: number;
    /** of a heightfield or a mesh, under the deepest point, else -1 */
    triangleA: number;
    /** of a heightfield or a mesh, under the deepest point, else -1 */
    triangleB: number;
}
/** What a snapshot says of itself. */
export interface SnapshotInfo {
    /** fe_version of the library that saved it */
    library: number;
    /** 1: its results differ from this library's */
    foreign: boolean;
    /** of the world */
    number: number;
    /** how many steps there had been */
    step: number;
    /** how many */
    bodies: number;
    /** how many */
    shapes: number;
    /** how many */
    joints: number;
    /** that shapes have */
    assets: number;
    /** of them, those whose contents are in the bytes */
    inside: number;
    /** 1: the world had a pair filter */
    filter: boolean;
}
/** A corner of a triangle, an end of a line, or a point. */
export interface DrawVertex {
    /** relative to fe_draw_options.origin, m, world axes */
    x: number;
    /** relative to fe_draw_options.origin, m, world axes */
    y: number;
    /** relative to fe_draw_options.origin, m, world axes */
    z: number;
    /** red | green << 8 | blue << 16 | alpha << 24: in memory of most machines red comes first */
    rgba: number;
    /** the shape or the joint that it is of, A of a contact, the body of a centre; 0: an inner box */
    owner: number;
}
/** A shape, for renderers that have a mesh for each form and draw all of a form at once. */
export interface DrawInstance {
    /** fe_geometry_type */
    type: GeometryType;
    /** as in fe_draw_vertex */
    rgba: number;
    /** that it shows */
    shape: number;
    /** of the shape */
    body: number;
    /** of a hull, a heightfield, a mesh; else 0 */
    asset: number;
    /** relative to fe_draw_options.origin, m */
    position: Vec3;
    /** to the world's axes */
    rotation: Quat;
    /** of a box; of what is round: radius, half height (of a capsule without its caps), radius; of a hull, a mesh, a heightfield: its scale; of a plane: x and z of a piece of it, whose outside is along Y */
    halfExtents: Vec3;
    /** of a shape made of parts, else -1 */
    part: number;
}
/** A frame of a history. */
export interface HistoryFrame {
    /** its number */
    frame: number;
    /** what it holds, without what the frame before it has, too */
    bytes: number;
}
/** Where a player is, and what it has. */
export interface PlayerInfo {
    /** fe_version of the library that recorded; 0: no header yet */
    library: number;
    /** fe_record_flags of the recording */
    flags: number;
    /** 1: the results of that library differ from this one's */
    foreign: boolean;
    /** where the first keyframe stands */
    firstStep: number;
    /** where the last whole chunk begins, at least: what it holds shows as it is played */
    lastStep: number;
    /** where the player is: steps of the recording, from the world's step number at its start on */
    step: number;
    /** that were made since the player's creation, steps among them */
    calls: number;
    /** fed, of whole chunks */
    bytes: number;
    /** in these */
    keyframes: number;
    /** likewise */
    notes: number;
    /** 1: there is a divergence to be told */
    hasDiverged: boolean;
}
/** Words that somebody left in a recording. */
export interface Note {
    /** steps that there had been */
    step: number;
    /** as it was given */
    about: number;
    /** valid as long as the player */
    text: string;
}
/** The first difference between a replay and its recording. */
export interface Divergence {
    /** fe_divergence_type */
    type: DivergenceType;
    /** of the recording */
    step: number;
    /** the first that differs, of those awake; 0: not known without FE_RECORD_FINE */
    body: number;
    /** of the field: 0 x, 1 y, 2 z, 3 w; -1: none */
    component: number;
    /** "linear velocity"...; "" when it is not known. Valid as long as the library */
    field: string;
    /** all of it in a sentence; valid as long as the player, until the next divergence */
    text: string;
}
/** Where two snapshots differ. */
export interface Difference {
    /** of a list's entry or an event, from 0. Else 0 */
    index: number;
    /** of a field of several numbers, from 0: 1 is y of a velocity */
    element: number;
    /** the body, shape or joint; of a pair the first shape; 0: it has none */
    handle: number;
    /** of a pair the second shape. Else 0 */
    other: number;
    /** what differs: "body", "shape", "joint", "pair", "world", or a list by its name */
    kind: string;
    /** which number of it; "there": one of the two does not have it */
    field: string;
    /** the value in the first snapshot, as text */
    a: string;
    /** the value in the second one */
    b: string;
}
/** One axis of a configurable joint. A locked axis has neither spring nor motor. Never grows. */
export interface JointAxis {
    /** fe_motion. Default FE_MOTION_LOCKED */
    motion: Motion;
    /** limits, m or rad (-pi..pi), lower <= upper. Default 0 */
    lower: number;
    /** limits, m or rad (-pi..pi), lower <= upper. Default 0 */
    upper: number;
    /** of the limits, 1/s, >= 0; 0: rigid. Default 0 */
    limitHertz: number;
    /** >= 0. Default 1 */
    limitDampingRatio: number;
    /** fe_spring: pulls to `target`. Default FE_SPRING_NONE */
    spring: Spring;
    /** 1/s, >= 0, of FE_SPRING_HERTZ. Default 0 */
    springHertz: number;
    /** >= 0, of FE_SPRING_HERTZ. Default 0 */
    springDampingRatio: number;
    /** N/m or N m/rad, >= 0, of FE_SPRING_STIFFNESS. Default 0 */
    springStiffness: number;
    /** N s/m or N m s/rad, >= 0, of FE_SPRING_STIFFNESS. Default 0 */
    springDamping: number;
    /** cap of the spring, N or N m, >= 0. Default 1e15 */
    springMax: number;
    /** m or rad. Default 0 */
    target: number;
    /** m/s or rad/s. Default 0 */
    motorSpeed: number;
    /** cap, N or N m, >= 0; with speed 0 a friction; 0: no motor. Default 0 */
    motorMax: number;
}
/** Where two shapes touch, or are about to. */
export interface ContactPoint {
    /** between the surfaces, m, world space */
    point: Vec3;
    /** m, negative when they overlap */
    separation: number;
    /** of the last step's end, per substep, N s */
    normalImpulse: number;
    /** along the normal, over the whole last step, bounces included, N s */
    totalImpulse: number;
    /** of the features that meet; stays while they do */
    id: number;
}
/** How the solver behaves. Each value may change between steps. */
export interface WorldTuningOptions {
    /** stiffness of contacts, 1/s, > 0; twice that against static bodies. Default 30 */
    contactHertz?: number;
    /** >= 0; 1 is critical, higher pushes out more gently. Default 10 */
    contactDampingRatio?: number;
    /** overlap is pushed out no faster, m/s, >= 0. Default 3 */
    contactPushSpeed?: number;
    /** stiffness of joints, 1/s, > 0. Default 60 */
    jointHertz?: number;
    /** >= 0. Default 2 */
    jointDampingRatio?: number;
    /** slower impacts do not bounce, m/s, >= 0. Default 1 */
    restitutionThreshold?: number;
    /** slower impacts make no hit event, m/s, >= 0. Default 1 */
    hitEventThreshold?: number;
    /** how long a body must be slow before it may sleep, s, >= 0. Default 0.5 */
    sleepTime?: number;
    /** contacts are made up to this gap, m, 0.001..0.1. Default 0.02 */
    speculativeDistance?: number;
    /** m/s, > 0. Default 4000 */
    maxLinearSpeed?: number;
    /** 0: nobody falls asleep, and who sleeps wakes. Default 1 */
    sleepEnabled?: boolean | 0 | 1;
    /** 0: fast bodies may pass through thin ones. Default 1 */
    continuousEnabled?: boolean | 0 | 1;
    /** 0: contacts begin each step without the impulses of the last one. Default 1 */
    warmStartEnabled?: boolean | 0 | 1;
}
/** A pose in the world. */
export interface TransformOptions {
    /** m */
    position?: Vec3Like;
    /** from its own axes to the world's */
    rotation?: QuatLike;
}
/** The mass of a body and how it is spread. */
export interface MassDataOptions {
    /** kg, > 0 */
    mass?: number;
    /** of mass, m, body space */
    centre?: Vec3Like;
    /** principal moments about the centre, kg m2, > 0, none above the sum of the other two */
    inertia?: Vec3Like;
    /** principal axes in body space */
    inertiaRotation?: QuatLike;
}
/** The form of a shape, in the shape's frame, m. Every length lies in [0.001, 100000]. */
export interface GeometryOptions {
    /** fe_geometry_type */
    type?: GeometryType;
    /** m */
    radius?: number;
    /** of a capsule's axis, of a cylinder, of a cone, m */
    halfHeight?: number;
    /** of a box, m */
    halfExtents?: Vec3Like;
    /** of a plane, any length but zero */
    normal?: Vec3Like;
    /** of a plane from the origin along its normal, m */
    distance?: number;
    /** Of a hull or a mesh, along the axes of its points: each 0.001..1000 in magnitude, a negative one mirrors. 0, 0, 0 counts as 1, 1, 1. All other forms have one of these two. */
    scale?: Vec3Like;
    /** of a hull, a heightfield, a mesh, a compound */
    asset?: Handle<Asset> | null;
}
/** A frame in the space of a body. */
export interface FrameOptions {
    /** m */
    position?: Vec3Like;
    /** from its own axes to the body's */
    rotation?: QuatLike;
}
/** A surface. Rolling and spinning resistance of a pair are the larger of the two, and so is its radius: of a cone that
 * of the base, of boxes and hulls 0. Never grows. */
export interface MaterialOptions {
    /** while the contact sticks, >= 0. Default 0.6 */
    staticFriction?: number;
    /** when it slides, >= 0. Default 0.5 */
    dynamicFriction?: number;
    /** 0..1. Default 0 */
    restitution?: number;
    /** no unit, >= 0: torque cap = it x radius x normal force. Default 0 */
    rollingResistance?: number;
    /** m, >= 0: torque cap about the normal = it x normal force. Default 0 */
    spinningResistance?: number;
    /** fe_combine, of both frictions. Default FE_COMBINE_DEFAULT */
    frictionCombine?: Combine;
    /** fe_combine. Default FE_COMBINE_DEFAULT */
    restitutionCombine?: Combine;
    /** any number of yours: hits, contacts and hit events report it. Default 0 */
    userId?: number | bigint;
    /** staticFriction, and dynamicFriction */
    friction?: number;
}
/** Two points keep their distance within [lower, upper] (equal: a rod; from 0: a rope). A spring pulls it to `target`,
 * a motor changes it. Only the positions of the frames count. The first fields are those of fe_joint_def, here and
 * below. */
export interface DistanceJointDefOptions {
    enabled?: boolean | 0 | 1;
    bodyA?: Handle<Body> | null;
    bodyB?: Handle<Body> | null;
    userData?: number | bigint;
    worldOrigin?: Vec3Like;
    frameA?: FrameOptions;
    frameB?: FrameOptions;
    collideConnected?: boolean | 0 | 1;
    /** of both ends of the range */
    hertz?: number;
    /** of both ends of the range */
    dampingRatio?: number;
    breakForce?: number;
    breakTorque?: number;
    /** 1: lower <= distance <= upper. Default 1 */
    limitEnabled?: boolean | 0 | 1;
    /** m, >= 0, at most upper. Default 1 */
    lower?: number;
    /** m, >= 0.001. Default 1 */
    upper?: number;
    /** 1/s, >= 0; 0: no spring. Default 0 */
    springHertz?: number;
    /** >= 0. Default 1 */
    springDampingRatio?: number;
    /** cap of the spring, N, >= 0. Default 1e15 */
    springMax?: number;
    /** distance that the spring pulls to, m, >= 0. Default 1 */
    target?: number;
    /** at which the motor lengthens it, m/s. Default 0 */
    motorSpeed?: number;
    /** cap, N, >= 0; with speed 0 a friction; 0: no motor. Default 0 */
    motorMax?: number;
}
/** Two points stay together. An elliptic cone may bound the swing of axis X, limits the twist about it. A spring
 * rotates B to a target. */
export interface BallJointDefOptions {
    enabled?: boolean | 0 | 1;
    bodyA?: Handle<Body> | null;
    bodyB?: Handle<Body> | null;
    userData?: number | bigint;
    worldOrigin?: Vec3Like;
    frameA?: FrameOptions;
    frameB?: FrameOptions;
    collideConnected?: boolean | 0 | 1;
    /** of the points */
    hertz?: number;
    /** of the points */
    dampingRatio?: number;
    breakForce?: number;
    breakTorque?: number;
    /** 1: (swing_y / cone_y)^2 + (swing_z / cone_z)^2 <= 1. Default 0 */
    coneEnabled?: boolean | 0 | 1;
    /** half angles, rad, 0.01..pi. Default pi */
    coneY?: number;
    /** half angles, rad, 0.01..pi. Default pi */
    coneZ?: number;
    /** 1: lower <= twist <= upper. Default 0 */
    limitEnabled?: boolean | 0 | 1;
    /** rad, -pi..pi. Default -pi, pi */
    lower?: number;
    /** rad, -pi..pi. Default -pi, pi */
    upper?: number;
    /** of cone and limits, 1/s, >= 0; 0: rigid. Default 0 */
    limitHertz?: number;
    /** >= 0. Default 1 */
    limitDampingRatio?: number;
    /** of the spring that rotates B to `target`, 1/s, >= 0; 0: none. Default 0 */
    springHertz?: number;
    /** >= 0. Default 1 */
    springDampingRatio?: number;
    /** its cap, N m, >= 0. Default 1e15 */
    springMax?: number;
    /** q to reach. Default none */
    target?: QuatLike;
    /** of B against A, rad/s, frame A. Default 0 */
    motorVelocity?: Vec3Like;
    /** cap, N m, >= 0; with velocity 0 a friction; 0: no motor. Default 0 */
    motorMax?: number;
}
/** Two points and their axes X stay together: a door, an elbow, an axle. The angle is the twist. */
export interface HingeJointDefOptions {
    enabled?: boolean | 0 | 1;
    bodyA?: Handle<Body> | null;
    bodyB?: Handle<Body> | null;
    userData?: number | bigint;
    worldOrigin?: Vec3Like;
    frameA?: FrameOptions;
    frameB?: FrameOptions;
    collideConnected?: boolean | 0 | 1;
    /** of points and axes */
    hertz?: number;
    /** of points and axes */
    dampingRatio?: number;
    breakForce?: number;
    breakTorque?: number;
    /** 1: lower <= angle <= upper. Default 0 */
    limitEnabled?: boolean | 0 | 1;
    /** rad, -pi..pi. Default -pi, pi */
    lower?: number;
    /** rad, -pi..pi. Default -pi, pi */
    upper?: number;
    /** 1/s, >= 0; 0: rigid. Default 0 */
    limitHertz?: number;
    /** >= 0. Default 1 */
    limitDampingRatio?: number;
    /** of the spring that rotates it to `target`, 1/s, >= 0; 0: none. Default 0 */
    springHertz?: number;
    /** >= 0. Default 1 */
    springDampingRatio?: number;
    /** its cap, N m, >= 0. Default 1e15 */
    springMax?: number;
    /** rad, -pi..pi. Default 0 */
    target?: number;
    /** rad/s. Default 0 */
    motorSpeed?: number;
    /** cap, N m, >= 0; with speed 0 a friction; 0: no motor. Default 0 */
    motorMax?: number;
}
/** The two frames stay one. */
export interface FixedJointDefOptions {
    enabled?: boolean | 0 | 1;
    bodyA?: Handle<Body> | null;
    bodyB?: Handle<Body> | null;
    userData?: number | bigint;
    worldOrigin?: Vec3Like;
    frameA?: FrameOptions;
    frameB?: FrameOptions;
    collideConnected?: boolean | 0 | 1;
    /** of the points */
    hertz?: number;
    /** of the points */
    dampingRatio?: number;
    breakForce?: number;
    breakTorque?: number;
    /** of the rotation, 1/s, >= 0; 0: rigid. Default 0 */
    angularHertz?: number;
    /** >= 0. Default 1 */
    angularDampingRatio?: number;
}
/** Six axes, each locked, limited or free, with springs and motors: sliders, wheels, actuators and whatever else. With
 * two rotations locked the third rotates freely. With one locked, swing stops at 170 degrees, or at 137 when the twist
 * is the locked one, as in a cardan joint. */
export interface ConfigurableJointDefOptions {
    enabled?: boolean | 0 | 1;
    bodyA?: Handle<Body> | null;
    bodyB?: Handle<Body> | null;
    userData?: number | bigint;
    worldOrigin?: Vec3Like;
    frameA?: FrameOptions;
    frameB?: FrameOptions;
    collideConnected?: boolean | 0 | 1;
    /** of the locked axes */
    hertz?: number;
    /** of the locked axes */
    dampingRatio?: number;
    breakForce?: number;
    breakTorque?: number;
    /** by fe_dof. Default: all locked */
    axes?: readonly (JointAxisOptions)[];
}
/** All definitions of joints begin with the fields of this one. fe_joint_get and fe_joint_set read and write them on
 * joints of any type. */
export interface JointDefOptions {
    /** 0: as if it were not there. Default 1 */
    enabled?: boolean | 0 | 1;
    /** two different ones; 0 is the world; in a _set: they stay as they are */
    bodyA?: Handle<Body> | null;
    /** two different ones; 0 is the world; in a _set: they stay as they are */
    bodyB?: Handle<Body> | null;
    /** any number of yours. Default 0 */
    userData?: number | bigint;
    /** m, world space: where the frame of body 0 is measured from. Default 0 */
    worldOrigin?: Vec3Like;
    /** in body space. Default: the bodies' own */
    frameA?: FrameOptions;
    /** in body space. Default: the bodies' own */
    frameB?: FrameOptions;
    /** 1: its two bodies may touch. Default 0: they never do */
    collideConnected?: boolean | 0 | 1;
    /** stiffness of what is locked, 1/s, >= 0; 0: rigid. Default 0 */
    hertz?: number;
    /** of what is locked, >= 0; counts when hertz > 0. Default 1 */
    dampingRatio?: number;
    /** it breaks when its reaction exceeds this, N, >= 0; 0: never. Default 0 */
    breakForce?: number;
    /** N m, >= 0; 0: never. Default 0 */
    breakTorque?: number;
}
/** Who counts. NULL for every layer, without triggers. */
export interface QueryFilterOptions {
    /** layers that count. Default all */
    mask?: number;
    /** fe_query_flags. Default FE_QUERY_DEFAULT */
    flags?: QueryFlags | readonly QueryFlags[] | number;
    /** bodies that do not count; stale ones are ignored */
    excluded?: ArrayLike<number | Body>;
}
/** An axis-aligned box in world space, m. */
export interface BoundsOptions {
    /** its least and its greatest corner */
    lower?: Vec3Like;
    /** its least and its greatest corner */
    upper?: Vec3Like;
}
/** How a world begins. */
export interface WorldDefOptions {
    /** 1..64 workers of its own, 1: none; ignored with a pool or tasks. Default 1 */
    workerCount?: number;
    /** m/s2. Default 0, -9.81, 0 */
    gravity?: Vec3Like;
    /** 1..64. Default 8 */
    substeps?: number;
    /** fe_simd. Default FE_SIMD_AUTO */
    simd?: Simd;
    /** 1..4095, part of its handles; 0: the next of a counter. Default 0 */
    number?: number;
    /** any number of yours. Default 0 */
    userData?: number | bigint;
}
/** How a body begins. */
export interface BodyDefOptions {
    /** fe_body_type. Default FE_BODY_DYNAMIC */
    type?: BodyType;
    /** of the body's origin */
    transform?: TransformOptions;
    /** of the centre of mass, m/s */
    linearVelocity?: Vec3Like;
    /** rad/s, world axes */
    angularVelocity?: Vec3Like;
    /** 1/s, >= 0: v /= 1 + h c in each substep of h seconds. Default 0 */
    linearDamping?: number;
    /** 1/s, >= 0. Default 0 */
    angularDamping?: number;
    /** Default 1 */
    gravityScale?: number;
    /** may sleep when its fastest point is slower, m/s, >= 0. Default 0.05 */
    sleepThreshold?: number;
    /** FE_AXIS_X | ...: world axes along which it cannot move. Default none */
    linearLocks?: Axis | readonly Axis[] | number;
    /** world axes about which it cannot rotate. Default none */
    angularLocks?: Axis | readonly Axis[] | number;
    /** 0: starts asleep, at rest. Default 1 */
    awake?: boolean | 0 | 1;
    /** Default 1 */
    sleepAllowed?: boolean | 0 | 1;
    /** 0: neither moves, nor collides, nor is seen by queries. Default 1 */
    enabled?: boolean | 0 | 1;
    /** 1: stopped by moving bodies too when it is fast. Default 0 */
    bullet?: boolean | 0 | 1;
    /** any number of yours. Default 0 */
    userData?: number | bigint;
    /** transform.position */
    position?: Vec3Like;
    /** transform.rotation */
    rotation?: QuatLike;
}
/** Two shapes collide when each one's layer is in the other's mask. A group decides before that, when both shapes have
 * the same one: above 0 they always collide, below 0 never. */
export interface ShapeDefOptions {
    /** kg/m3, >= 0; a trigger weighs too. Parts of a compound may have their own. Default 1000 */
    density?: number;
    /** of the shape, in the body's space. Default the body's own */
    frame?: FrameOptions;
    /** 1: reports dynamic and kinematic bodies that touch it, pushes nothing. Default 0 */
    trigger?: boolean | 0 | 1;
    /** its surface */
    material?: MaterialOptions;
    /** exactly one bit. Default 1 */
    layer?: number;
    /** the layers it collides with; 0: seen by queries only. Default all */
    mask?: number;
    /** 0: none. Default 0 */
    group?: number;
    /** fe_shape_events; a pair has what either shape asks for. Default touch */
    events?: ShapeEvents | readonly ShapeEvents[] | number;
    /** 1: the world's pair filter judges its new pairs. Default 0 */
    pairFilter?: boolean | 0 | 1;
    /** 1: holds only what comes against `one_way_direction`; convex forms. Default 0 */
    oneWay?: boolean | 0 | 1;
    /** shape frame, any length but zero: up, for a floor to jump through. Default 0, 1, 0 */
    oneWayDirection?: Vec3Like;
    /** of a conveyor belt, m/s, shape frame; only its part along the contact acts */
    surfaceVelocity?: Vec3Like;
    /** any number of yours. Default 0 */
    userData?: number | bigint;
    /** frame.position */
    position?: Vec3Like;
    /** frame.rotation */
    rotation?: QuatLike;
    /** material.staticFriction, and dynamicFriction */
    friction?: number;
    /** material.restitution */
    restitution?: number;
}
/** How a store begins. */
export interface StoreDefOptions {
    /** 1..4095, part of its assets' handles; 0: the next free one. Default 0 */
    number?: number;
}
/** A grid of heights: terrain. In the shape's frame, sample (row, column) stands at x = column * cell_x,
 * z = row * cell_z, its height along y. Cell row * (columns - 1) + column of the arrays below lies between samples
 * (row, column) and (row + 1, column + 1). The diagonal between these two cuts it into triangle 2 * cell (its z side)
 * and triangle 2 * cell + 1 (its x side). Hits and contacts report these numbers.
 * 
 * Only the upper side counts: rays from below pass. Edges between triangles are felt only where the surface is convex,
 * also across the border of two heightfields that meet. The rims of holes and of the whole carry like any edge. A body
 * pressed into the terrain is pushed out, unless its centre is deeper than the body's radius. */
export interface HeightfieldDefOptions {
    /** of samples, along z, 2..32768; rows * columns <= 2^28 */
    rows?: number;
    /** of samples, along x, 2..32768 */
    columns?: number;
    /** from column to column, m, 0.001..100000; all columns within 1e6 m */
    cellX?: number;
    /** from row to row */
    cellZ?: number;
    /** rows x columns, row by row, m, within +-1e6. All arrays are copied */
    heights?: ArrayLike<number>;
    /** a cell each: 1 is a hole, 0 is none; NULL: no holes */
    holes?: ArrayLike<number>;
    /** a cell each: index into `materials`; NULL: every cell has the shape's material */
    cellMaterials?: ArrayLike<number>;
    /** replace the shape's material */
    materials?: readonly MaterialOptions[];
}
/** The convex hull of points. No points but thin ones are refused. Where there are more vertices than `max_vertices`,
 * those that change the form least are left out, and fe_hull_info.error tells how far they lie outside. */
export interface HullDefOptions {
    /** 4..255. Default 64 */
    maxVertices?: number;
    /** Points nearer than this to the hull may be left out, and faces that bend less are merged, m, 0..100000. At least 5e-6 of the extent counts. 0: 1e-5 of the extent, the longest side of the points' bounds. Default 0 */
    tolerance?: number;
    /** x y z each, m, within +-100000, in any order; inner points and duplicates are welcome */
    points?: ArrayLike<number>;
}
/** Triangles of any form. Only the side from which the corners run counterclockwise counts, unless the mesh is
 * two-sided: a mesh that is wound the wrong way lets everything pass. fe_mesh_info.volume of a closed mesh is then
 * negative, and `flipped_edges` counts neighbours that disagree.
 * 
 * Vertices that are equal, or nearer than `weld_distance`, are one. Edges between triangles are felt where the surface
 * is convex and bends by more than `edge_angle`, and where they have no neighbour, more than one, or one of the
 * opposite winding. Triangles without area are dropped, and so are those that repeat an earlier one. The others keep
 * their numbers, which hits and contacts report.
 * 
 * A mesh is the form of static and kinematic bodies (fe_geometry_mesh). It has no inside: what is behind its triangles
 * is not pushed out. Two-sided triangles push a body to the side its centre is on. Meshes and heightfields never touch
 * each other, not even as triggers. */
export interface MeshDefOptions {
    /** fe_mesh_flags. Default 0 */
    flags?: MeshFlags | readonly MeshFlags[] | number;
    /** m, 0..1, from 0.000001 on if not 0. Default 0: equal vertices alone */
    weldDistance?: number;
    /** rad, 0..1.57. Default 0.035, two degrees */
    edgeAngle?: number;
    /** x y z each, m, within +-100000. All arrays are copied */
    vertices?: ArrayLike<number>;
    /** three vertices a triangle, counterclockwise seen from the side that counts */
    indices?: ArrayLike<number>;
    /** a triangle each: index into `materials`; NULL: all have the shape's material */
    triangleMaterials?: ArrayLike<number>;
    /** replace the shape's material */
    materials?: readonly MaterialOptions[];
    /** a triangle each: any number of yours, fe_mesh_get_triangle reads it; NULL: none */
    triangleData?: ArrayLike<number>;
}
/** A part of a compound. */
export interface CompoundPartOptions {
    /** kg/m3, >= 0; -1: that of the shape (fe_shape_def). Default -1 */
    density?: number;
    /** of the part, in the compound's space. Default the compound's own */
    frame?: FrameOptions;
    /** 1: it has `material`; 0: that of the shape. Default 0 */
    ownMaterial?: boolean | 0 | 1;
    /** any but a plane and a compound. Default FE_GEOMETRY_NONE */
    geometry?: GeometryOptions;
    /** counts with own_material */
    material?: MaterialOptions;
    /** any number of yours: fe_compound_get_part reads it. Default 0 */
    userData?: number | bigint;
    /** frame.position */
    position?: Vec3Like;
    /** frame.rotation */
    rotation?: QuatLike;
}
/** What is saved. */
export interface SaveOptionsOptions {
    /** fe_save. Default 0: assets go by their keys */
    flags?: Save | readonly Save[] | number;
}
/** What a restore may be told. */
export interface RestoreOptionsOptions {
    /** 1: handles have the world's own number, not that of the saved one. Default 0 */
    newNumber?: boolean | 0 | 1;
}
/** What to draw, and how. */
export interface DrawOptionsOptions {
    /** fe_draw_flags. Default FE_DRAW_SHAPES | FE_DRAW_ISLANDS | FE_DRAW_SLEEP */
    parts?: DrawFlags | readonly DrawFlags[] | number;
    /** what is drawn is relative to it: the camera, for worlds that are large, m. Default 0 */
    origin?: Vec3Like;
    /** only what meets this box; of heightfields and meshes triangles near it. Default all */
    lower?: Vec3Like;
    /** only what meets this box; of heightfields and meshes triangles near it. Default all */
    upper?: Vec3Like;
    /** only this body, its contacts and its joints; 0: all. Default 0 */
    only?: Handle<Body> | null;
    /** of a normal, and of a force that would carry the lighter body, m, > 0. Default 0.5 */
    scale?: number;
    /** of a circle, 3..128. Default 16 */
    segments?: number;
}
/** A segment of fe_world_raycast_many. The first 48 bytes will do. */
export interface RayOptions {
    /** m, world space */
    origin?: Vec3Like;
    /** to the end, m */
    translation?: Vec3Like;
}
/** A motion of fe_world_sweep_many. The first 64 bytes will do for one without a turn. */
export interface PathOptions {
    /** pose of the geometry there */
    start?: TransformOptions;
    /** m */
    translation?: Vec3Like;
    /** rad, as for fe_world_sweep_turning; 0: it does not turn */
    turn?: Vec3Like;
}
/** How much a history keeps. */
export interface HistoryDefOptions {
    /** how many are kept, 1 to 65536. Default 16 */
    frames?: number;
    /** what all frames may hold together, 0: as much as they need. Default 0 */
    bytes?: number;
}
/** How a world is recorded. */
export interface RecorderDefOptions {
    /** fe_record_flags. Default FE_RECORD_ASSETS */
    flags?: RecordFlags | readonly RecordFlags[] | number;
    /** a snapshot each time that so many steps moved something; 0: one, at first. Default 600 */
    keyframeSteps?: number;
    /** that may wait to be read, or with FE_RECORD_LAST are kept, from 65536 on. Default 64 MB */
    bufferBytes?: number;
}
/** How a recording is played. */
export interface PlayerDefOptions {
    /** 1..64. Default 1 */
    workerCount?: number;
    /** fe_simd. Default FE_SIMD_AUTO */
    simd?: Simd;
}
/** How many worlds, and who steps them. */
export interface BatchDefOptions {
    /** 1..1048576. Default 1 */
    worldCount?: number;
    /** 1..64; without a pool or tasks. Default 1 */
    workerCount?: number;
    /** worlds that a worker takes at once, 0: chosen. Never shows in results. Default 0 */
    block?: number;
    /** fe_simd. Default FE_SIMD_AUTO */
    simd?: Simd;
}
/** One axis of a configurable joint. A locked axis has neither spring nor motor. Never grows. */
export interface JointAxisOptions {
    /** fe_motion. Default FE_MOTION_LOCKED */
    motion?: Motion;
    /** limits, m or rad (-pi..pi), lower <= upper. Default 0 */
    lower?: number;
    /** limits, m or rad (-pi..pi), lower <= upper. Default 0 */
    upper?: number;
    /** of the limits, 1/s, >= 0; 0: rigid. Default 0 */
    limitHertz?: number;
    /** >= 0. Default 1 */
    limitDampingRatio?: number;
    /** fe_spring: pulls to `target`. Default FE_SPRING_NONE */
    spring?: Spring;
    /** 1/s, >= 0, of FE_SPRING_HERTZ. Default 0 */
    springHertz?: number;
    /** >= 0, of FE_SPRING_HERTZ. Default 0 */
    springDampingRatio?: number;
    /** N/m or N m/rad, >= 0, of FE_SPRING_STIFFNESS. Default 0 */
    springStiffness?: number;
    /** N s/m or N m s/rad, >= 0, of FE_SPRING_STIFFNESS. Default 0 */
    springDamping?: number;
    /** cap of the spring, N or N m, >= 0. Default 1e15 */
    springMax?: number;
    /** m or rad. Default 0 */
    target?: number;
    /** m/s or rad/s. Default 0 */
    motorSpeed?: number;
    /** cap, N or N m, >= 0; with speed 0 a friction; 0: no motor. Default 0 */
    motorMax?: number;
}
export class WorldCalls {
    /** Moves the world on by dt seconds. It takes less than 32 KB of the caller's stack.
     * 
     * FE_ERROR_MEMORY leaves the world as it was before the call. It can be stepped again, and then goes on with the same
     * bits as if memory had lasted.
     * 
     * Of bodies in one place, a thousand born in a point, each touches the 24 that are deepest in it: of two dynamic
     * bodies that both have more than 48 neighbours, a contact is left out when it is among the 24 deepest of neither,
     * by the overlap of their boxes. A body that meets more than 256 new ones at once looks at 48 of those beside it. In
     * the steps that follow they look for each other again. fe_counters.contacts_left_out counts what was left out; where
     * thousands are in one place it is a lower bound.
     * @param dt  0..1 s; 0 updates contacts and events and moves nothing. Less than 1e-5 s counts as 0 */
    step(dt: number): void;
    /** m/s2. A change wakes all dynamic bodies. */
    set gravity(gravity: Vec3Like);
    get gravity(): Vec3;
    /** @param substeps  1..64 */
    set substeps(substeps: number);
    get substeps(): number;
    set userData(userData: number | bigint);
    get userData(): number | bigint;
    /** The number in this world's handles, 1..4095. */
    get number(): number;
    /** Takes effect with the next step. It wakes nobody, unless sleep_enabled is 0. */
    set tuning(tuning: WorldTuningOptions);
    /** @param out_tuning  its struct_size must be set */
    get tuning(): WorldTuning;
    /** The stiffness that a step of dt seconds would really use: contact_hertz is limited to an eighth of the substep rate,
     * joint_hertz to 0.225 of it.
     * @param dt                 0..1 s; 0, and less than 1e-5 s: no limit
     * @param out_contact_hertz  1/s, between two dynamic bodies
     * @param out_joint_hertz    1/s */
    getHertz(dt: number): { contactHertz: number; jointHertz: number };
    /** While ignored, two bodies never collide, whatever their layers and groups. Takes effect at the next step. */
    ignoreCollision(a: Handle<Body> | null, b: Handle<Body> | null, ignore: boolean | 0 | 1): void;
    /** 1 while fe_world_ignore_collision keeps the two apart, else 0. */
    getIgnored(a: Handle<Body> | null, b: Handle<Body> | null): boolean;
    /** Rebalances the trees that serve the queries. Worth a call after a level is loaded. Results never need it: queries
     * see new and moved bodies at once. */
    optimize(): void;
    /** @param out_profile  its struct_size must be set */
    get profile(): Profile;
    /** @param out_counters  its struct_size must be set */
    get counters(): Counters;
    /** All bodies, in the order of creation. */
    get bodies(): number[];
    /** The box around all shapes but planes. FE_ERROR_STATE when there is none. */
    get bounds(): Bounds;
    /** Energy of the discrete flight, E = T(v) + V(x - h v / 2) with substeps of h seconds: what a free flight keeps to
     * rounding. The scheme holds positions half a substep ahead of velocities; T(v) + V(x) would swing by h/2 m g v.
     * @param out_energy  its struct_size must be set */
    get energy(): Energy;
    /** Momentum of all enabled dynamic bodies.
     * @param about        the point that the angular momentum is taken about, m, world space
     * @param out_linear   N s
     * @param out_angular  N m s */
    getMomentum(about: Vec3Like): { linear: Vec3; angular: Vec3 };
    /** Sets bodies and frames of a definition that is initialised already; the present pose becomes the zero. Nothing else
     * changes, here and in the four functions below, but for the length of a rod: it becomes the present distance of the
     * two points. A body of 0 is the world.
     * @param point_a, point_b  m, world space */
    addDistanceJoint(bodyA: Handle<Body> | null, bodyB: Handle<Body> | null, pointA: Vec3Like, pointB: Vec3Like, options?: DistanceJointDefOptions | null): Joint;
    /** @param point  m, world space
     * @param axis   X of both frames, world space, any length but zero: what swings and twists, along a limb for example */
    addBallJoint(bodyA: Handle<Body> | null, bodyB: Handle<Body> | null, point: Vec3Like, axis: Vec3Like, options?: BallJointDefOptions | null): Joint;
    /** @param axis  of the hinge, world space, any length but zero; B rotates against A counterclockwise about it */
    addHingeJoint(bodyA: Handle<Body> | null, bodyB: Handle<Body> | null, point: Vec3Like, axis: Vec3Like, options?: HingeJointDefOptions | null): Joint;
    /** @param point  of both frames, m, world space */
    addFixedJoint(bodyA: Handle<Body> | null, bodyB: Handle<Body> | null, point: Vec3Like, options?: FixedJointDefOptions | null): Joint;
    /** @param axis  X of both frames, world space, any length but zero */
    addConfigurableJoint(bodyA: Handle<Body> | null, bodyB: Handle<Body> | null, point: Vec3Like, axis: Vec3Like, options?: ConfigurableJointDefOptions | null): Joint;
    /** Makes a whole definition, defaults and all, ready for fe_distance_joint_create or for changes before it. Only
     * struct_size of the given one counts, here and in the three functions below. A rope: the points come no farther from
     * each other than `max_length`. */
    addRopeJoint(bodyA: Handle<Body> | null, bodyB: Handle<Body> | null, pointA: Vec3Like, pointB: Vec3Like, maxLength: number, options?: DistanceJointDefOptions | null): Joint;
    /** B slides along an axis and does not rotate. axes[FE_DOF_LINEAR_X] has its limits, spring and motor. */
    addSliderJoint(bodyA: Handle<Body> | null, bodyB: Handle<Body> | null, point: Vec3Like, axis: Vec3Like, options?: ConfigurableJointDefOptions | null): Joint;
    /** A wheel B on a chassis A rolls freely about the axle. axes[FE_DOF_ANGULAR_X] is its motor and brake.
     * axes[FE_DOF_ANGULAR_Z] steers about `up`: it is locked; give it limits and a spring to steer by its target.
     * axes[FE_DOF_LINEAR_Z] is the suspension along `up`, within +-travel: while the wheel stands, that corner of the
     * chassis, as heavy as it is now, swings at `hertz` with `damping_ratio`; the car rests some g / (2 pi hertz)^2 lower.
     * On a chassis that is not dynamic the wheel swings so.
     * @param axle  of the wheel, world space; with `up` upwards and both horizontal wheels, positive speed rolls towards
     *              axle x up */
    addWheelJoint(chassis: Handle<Body> | null, wheel: Handle<Body> | null, point: Vec3Like, axle: Vec3Like, up: Vec3Like, hertz: number, dampingRatio: number, travel: number, options?: ConfigurableJointDefOptions | null): Joint;
    /** Pulls and rotates B towards a pose relative to A: the targets of all six axes, at first where it is.
     * @param max_force, max_torque  caps, N, N m */
    addMotorJoint(bodyA: Handle<Body> | null, bodyB: Handle<Body> | null, hertz: number, dampingRatio: number, maxForce: number, maxTorque: number, options?: ConfigurableJointDefOptions | null): Joint;
    /** Each makes a joint from its definition. @return FE_ERROR_ARGUMENT also when both ends are one body, or the world */
    createDistanceJoint(def?: DistanceJointDefOptions | null): Joint;
    createBallJoint(def?: BallJointDefOptions | null): Joint;
    createHingeJoint(def?: HingeJointDefOptions | null): Joint;
    createFixedJoint(def?: FixedJointDefOptions | null): Joint;
    createConfigurableJoint(def?: ConfigurableJointDefOptions | null): Joint;
    /** All joints, in the order of creation. */
    get joints(): number[];
    /** The first body on a segment.
     * 
     * Exact on every shape. Heightfields are passed from below, one-sided meshes from behind. At equal fractions what the
     * ray starts in comes first, then the body created first, whatever the number of workers.
     * @param origin       start, m, world space
     * @param translation  from the start to the end, m; zero asks whether the start is inside a shape; heightfields and
     *                     meshes have no inside
     * @param filter       who counts; NULL: every layer, no triggers
     * @param out_hit      written only on a hit
     * @return 1 on a hit, 0 on a miss */
    raycast(origin: Vec3Like, translation: Vec3Like, filter?: QueryFilterOptions | null): Hit | null;
    /** Is anything on the segment? Faster than the first hit: it stops at whatever it finds.
     * @return 1 or 0 */
    raycastAny(origin: Vec3Like, translation: Vec3Like, filter?: QueryFilterOptions | null): boolean;
    /** Every body on a segment, each once, at its first hit, ordered by fraction, then by creation.
     * @param stride  sizeof(fe_hit); at least 92, the hits are ordered where they lie
     * @return how many bodies are hit; when they are more than `capacity` the nearest are written */
    raycastAll(origin: Vec3Like, translation: Vec3Like, filter?: QueryFilterOptions | null): Hit[];
    /** The first body that a moving sphere, capsule, box, cylinder, cone or hull touches. It does not turn.
     * 
     * It stops at most 1 micrometre before the body (0.1 mm: a box before a box), never in it. A body that it overlaps at
     * the start is a hit at fraction 0, flagged FE_HIT_STARTED_INSIDE. One that it starts to touch is a hit at fraction 0
     * without the flag; one that it leaves or slides along is no hit. An overlap of up to a nanometre is a touch: rounding
     * leaves as much of an exact one. Heightfields are passed from below, one-sided meshes from behind; what cuts their
     * surface overlaps them. At equal fractions what overlaps comes first, then the body created first.
     * @param geometry     sphere, capsule, box, cylinder, cone or hull; a sphere of radius 0 sweeps as a ray
     * @param start        pose of the geometry at the start
     * @param translation  m; zero asks what overlaps
     * @param filter       who counts; NULL: every layer, no triggers
     * @param out_hit      written only on a hit
     * @return 1 on a hit, 0 on a miss; FE_ERROR_UNSUPPORTED for other geometries; for assets and scales the errors of
     *         fe_shape_create */
    sweep(geometry: GeometryOptions, start: TransformOptions, translation: Vec3Like, filter?: QueryFilterOptions | null): Hit | null;
    /** Does it touch anything? Faster than the first hit: it stops at whatever it finds.
     * @return 1 or 0 */
    sweepAny(geometry: GeometryOptions, start: TransformOptions, translation: Vec3Like, filter?: QueryFilterOptions | null): boolean;
    /** Every body that it touches on its motion, as if the others were not there; see fe_world_raycast_all. */
    sweepAll(geometry: GeometryOptions, start: TransformOptions, translation: Vec3Like, filter?: QueryFilterOptions | null): Hit[];
    /** The first body that a geometry touches while it moves and turns, both at a constant rate.
     * 
     * After a part s of the motion its origin is at start + s * translation, and it has turned from the start's rotation
     * by s * |turn| rad about the direction of `turn`, a right-handed turn about an axis through its origin. The pose at
     * the stop is that at s = fraction. It stops before the body as fe_world_sweep does, and up to 3e-7 of its largest
     * distance from its origin farther off: rounding its rotation to a fe_quat does not carry it in. However thin a body
     * is, none is missed. The normal points out of the body, and may lean along the translation. A triangle with one side
     * is passed from below, and stops the geometry when the turn brings it back from above. What shows no turn (a sphere,
     * or what is round about the axis) sweeps as without it. The rest is as for fe_world_sweep.
     * @param turn  rad, world axes; each part in [-64, 64]: ten turns about an axis. Zero: fe_world_sweep
     * @return 1 on a hit, 0 on a miss; FE_ERROR_UNSUPPORTED for other geometries */
    sweepTurning(geometry: GeometryOptions, start: TransformOptions, translation: Vec3Like, turn: Vec3Like, filter?: QueryFilterOptions | null): Hit | null;
    /** Does it touch anything while it moves and turns? Faster than the first hit: it stops at whatever it finds.
     * @return 1 or 0 */
    sweepTurningAny(geometry: GeometryOptions, start: TransformOptions, translation: Vec3Like, turn: Vec3Like, filter?: QueryFilterOptions | null): boolean;
    /** Every body that it touches while it moves and turns, as if the others were not there; see fe_world_raycast_all. */
    sweepTurningAll(geometry: GeometryOptions, start: TransformOptions, translation: Vec3Like, turn: Vec3Like, filter?: QueryFilterOptions | null): Hit[];
    /** The bodies that a sphere, capsule, box, cylinder, cone or hull overlaps, in the order of creation: exactly those
     * that a sweep from there would start inside of.
     * @param geometry  as for fe_world_sweep; a sphere of radius 0 is a point
     * @param at        pose of the geometry
     * @return how many there are; when they are more than `capacity` those created first are written */
    overlap(geometry: GeometryOptions, at: TransformOptions, filter?: QueryFilterOptions | null): number[];
    /** Does it overlap anything?
     * @return 1 or 0 */
    overlapAny(geometry: GeometryOptions, at: TransformOptions, filter?: QueryFilterOptions | null): boolean;
    /** The shapes that a geometry overlaps, in the order of creation, with direction and depth: to move a character out.
     * A compound counts once, with the part that is overlapped deepest: it is that part which the translation parts.
     * @param stride  sizeof(fe_overlap), at least 16
     * @return how many there are; when they are more than `capacity` those created first are written */
    overlapShapes(geometry: GeometryOptions, at: TransformOptions, filter?: QueryFilterOptions | null): Overlap[];
    /** The shapes whose bounds meet an axis-aligned box, in the order of creation. Faster than an exact overlap. A plane
     * counts when its half space meets the box.
     * @return how many there are; when they are more than `capacity` those created first are written */
    overlapBounds(bounds: BoundsOptions, filter?: QueryFilterOptions | null): number[];
    /** The point of all surfaces that is closest to a point. Inside a body its distance is below 0. The smallest distance
     * wins, then the body created first. Heightfields and meshes have no inside. A heightfield is not seen from below;
     * both sides of a mesh count.
     * @param max_distance  farther ones do not count, m, >= 0
     * @param out_closest   written only when there is one
     * @return 1, or 0 when there is none */
    closestPoint(point: Vec3Like, maxDistance: number, filter?: QueryFilterOptions | null): Closest | null;
    /** Events of the last step, ordered by the creation of A, then B. @param stride  sizeof(fe_pair_event) */
    get pairEvents(): PairEvent[];
    /** Who fell asleep and who woke, in the last step and by calls before it, in the order of creation.
     * @param stride  sizeof(fe_body_event) */
    get bodyEvents(): BodyEvent[];
    /** Impacts of the last step on shapes that ask for FE_SHAPE_EVENTS_HIT, faster than
     * fe_world_tuning.hit_event_threshold.
     * @param stride  sizeof(fe_hit_event) */
    get hitEvents(): HitEvent[];
    /** Events of the last step, in the order of the joints' creation. @param stride  sizeof(fe_joint_event) */
    get jointEvents(): JointEvent[];
}
export class BodyCalls {
    /** 1 for a living body of this world, 0 for anything else. */
    get isValid(): boolean;
    /** Its touching pairs send their exit and are found anew. The body and what it touched wake. Forces not yet applied are
     * dropped. A body that becomes static loses its velocities; one that is no longer dynamic loses a mass that was set.
     * @param type  fe_body_type
     * @return FE_ERROR_UNSUPPORTED for a body with a plane or a heightfield, unless `type` is static, and for one with a
     *         mesh that would be dynamic */
    set type(type: BodyType);
    get type(): BodyType;
    /** Puts the body there at once, through whatever is between, and wakes it and what it touched. */
    set transform(transform: TransformOptions);
    get transform(): Transform;
    /** Centre of mass, m, world space. */
    get centre(): Vec3;
    /** Of the centre of mass, m/s. Setting a velocity wakes the body; locked components stay 0.
     * @return FE_ERROR_STATE on a static body */
    set linearVelocity(velocity: Vec3Like);
    get linearVelocity(): Vec3;
    /** rad/s, world axes; otherwise as the linear velocity. */
    set angularVelocity(velocity: Vec3Like);
    get angularVelocity(): Vec3;
    /** Of the material point that is now at `point`, m/s. */
    getPointVelocity(point: Vec3Like): Vec3;
    /** Gives a kinematic body the velocities that bring it to `target` in `seconds`. FE_ERROR_STATE on other types.
     * @param seconds  > 0 */
    setTarget(target: TransformOptions, seconds: number): void;
    /** Force at the centre of mass, N, world axes, during all of the next step only. Wakes the body. Nothing happens on a
     * body that is disabled or not dynamic. */
    addForce(force: Vec3Like): void;
    /** Force at a point of the world, N. Its torque is the one that this point gives now. */
    addForceAt(force: Vec3Like, point: Vec3Like): void;
    /** N m, world axes, during all of the next step only. */
    addTorque(torque: Vec3Like): void;
    /** Changes the velocity at once by impulse / mass. N s. */
    addImpulse(impulse: Vec3Like): void;
    /** At a point of the world, m: changes the angular velocity too. */
    addImpulseAt(impulse: Vec3Like, point: Vec3Like): void;
    /** N m s. */
    addAngularImpulse(impulse: Vec3Like): void;
    /** Overrides what the shapes give, until fe_body_reset_mass or a change of type. FE_ERROR_STATE unless dynamic. */
    set massData(data: MassDataOptions);
    /** What the solver uses. @param out_data  its struct_size must be set */
    get massData(): MassData;
    /** Sets the mass, kg, > 0, and scales the inertia with it. It overrides until fe_body_reset_mass. */
    set mass(mass: number);
    /** kg; 0 for a body that is not dynamic. */
    get mass(): number;
    /** Mass and inertia from the shapes and their densities again. */
    resetMass(): void;
    /** World axes along and about which the body cannot move, FE_AXIS_*: these coordinates stay bit for bit. */
    setLocks(linearAxes: Axis | readonly Axis[] | number, angularAxes: Axis | readonly Axis[] | number): void;
    getLocks(): { linearAxes: number; angularAxes: number };
    /** 1/s, >= 0. */
    setDamping(linear: number, angular: number): void;
    getDamping(): { linear: number; angular: number };
    /** Factor of the world's gravity for this body; below 0 the body rises. A change wakes it. */
    set gravityScale(scale: number);
    get gravityScale(): number;
    /** Waking a body wakes all that it touches, through other dynamic bodies. Putting it to sleep stops it and all those.
     * @return FE_ERROR_STATE when one of them may not sleep: then nothing changes */
    set awake(awake: boolean | 0 | 1);
    /** 1 awake, 0 asleep; static bodies are never awake. */
    get awake(): boolean;
    /** 0 wakes the body and keeps all that it touches awake. */
    set sleepAllowed(allowed: boolean | 0 | 1);
    get sleepAllowed(): boolean;
    /** m/s, >= 0. */
    set sleepThreshold(speed: number);
    get sleepThreshold(): number;
    /** A disabled body keeps its place but neither moves, nor collides, nor is seen by queries. Its touching pairs send
     * their exit. */
    set enabled(enabled: boolean | 0 | 1);
    get enabled(): boolean;
    /** See fe_body_def. */
    set bullet(bullet: boolean | 0 | 1);
    get bullet(): boolean;
    set userData(userData: number | bigint);
    get userData(): number | bigint;
    /** Layer, mask and group of all its shapes, see fe_shape_def. FE_ERROR_STATE when it has none. */
    setFilter(layer: number, mask: number, group: number): void;
    /** @return FE_ERROR_STATE when it has no shapes, or when they have different filters */
    getFilter(): { layer: number; mask: number; group: number };
    /** Its shapes in the order of creation. */
    get shapes(): number[];
    /** The box around its shapes. FE_ERROR_STATE when it has none; FE_ERROR_UNSUPPORTED with a plane, which has no bounds. */
    get bounds(): Bounds;
    /** Those of a body, in the order of creation. */
    get joints(): number[];
    /** @return 1 on a hit, 0 on a miss */
    raycast(origin: Vec3Like, translation: Vec3Like): Hit | null;
    /** The closest point of one body, however far.
     * @return 1; 0 for a body none of whose shapes has one */
    closestPoint(point: Vec3Like): Closest | null;
    /** The contacts of a body: pairs with at least one point within the speculative distance. Triggers have none.
     * @param stride  sizeof(fe_contact) */
    get contacts(): Contact[];
}
export class ShapeCalls {
    /** Its touching pairs send their exit. Mass and inertia of the body follow, unless they were set. The body and what it
     * touched wake. */
    destroy(): void;
    /** 1 for a living shape of this world, 0 for anything else. */
    get isValid(): boolean;
    /** The body that it belongs to. */
    get body(): number;
    /** Another form in the same place. Pairs, mass and sleep follow as for fe_shape_destroy.
     * @return the errors of fe_shape_create */
    set geometry(geometry: GeometryOptions);
    /** @param out_geometry  its struct_size must be set */
    get geometry(): Geometry;
    /** In the body's space. Pairs, mass and sleep follow as for fe_shape_destroy. */
    set frame(frame: FrameOptions);
    get frame(): Frame;
    /** kg/m3, >= 0. Mass and inertia of the body follow, unless they were set. A change wakes it. Parts of a compound with
     * a density of their own keep it. */
    set density(density: number);
    get density(): number;
    /** Takes effect at the next step, also where the shape touches already. The body and what it touches wake. Cells of a
     * heightfield, triangles of a mesh and parts of a compound with materials of their own keep them. */
    set material(material: MaterialOptions);
    get material(): Material;
    /** Takes effect at the next step. The pair filter judges anew the pairs that it refused.
     * @param layer  exactly one bit */
    setFilter(layer: number, mask: number, group: number): void;
    getFilter(): { layer: number; mask: number; group: number };
    /** Does the world's pair filter judge its pairs? Takes effect at the next step; its pairs are judged anew. */
    set pairFilter(enabled: boolean | 0 | 1);
    get pairFilter(): boolean;
    /** See fe_shape_def. A body that comes from behind or from a side passes, until the two are apart. A change wakes the
     * body and what it touches; what is inside the shape then passes.
     * @param direction  shape frame, any length but zero; NULL: as it is
     * @return FE_ERROR_UNSUPPORTED for planes, heightfields, meshes and compounds with such a part, unless `enabled` is 0 */
    setOneWay(enabled: boolean | 0 | 1, direction?: Vec3Like | null): void;
    /** @param out_direction  as it was set */
    getOneWay(): { enabled: boolean; direction: Vec3 };
    /** A change ends its touching pairs, with their exit, and wakes the body. */
    set trigger(trigger: boolean | 0 | 1);
    get trigger(): boolean;
    /** fe_shape_events, from the next step on. */
    set events(events: ShapeEvents | readonly ShapeEvents[] | number);
    get events(): number;
    /** m/s, shape frame, see fe_shape_def. Wakes what lies on it. */
    set surfaceVelocity(velocity: Vec3Like);
    get surfaceVelocity(): Vec3;
    set userData(userData: number | bigint);
    get userData(): number | bigint;
    /** The box around it. FE_ERROR_UNSUPPORTED for a plane, which has no bounds. */
    get bounds(): Bounds;
    /** Shapes that touched it at the end of the last step, in the order of creation: who is inside a trigger now. */
    get overlaps(): number[];
    /** fe_world_raycast against one shape or one body only, whatever its layers, a trigger or not, enabled or not.
     * @return 1 on a hit, 0 on a miss */
    raycast(origin: Vec3Like, translation: Vec3Like): Hit | null;
    /** The closest point of one shape, however far.
     * @return 1; 0 from below a heightfield, and for one whose cells are all holes. Of a mesh both sides count */
    closestPoint(point: Vec3Like): Closest | null;
    /** The contacts of a shape. @param stride  sizeof(fe_contact) */
    get contacts(): Contact[];
}
export class JointCalls {
    /** Each changes all of a joint of its type but the bodies, and keeps what an older client's shorter definition lacks.
     * @return FE_ERROR_STATE for a joint of another type */
    set distance(def: DistanceJointDefOptions | null);
    /** Each reads what was set. @param out_def  its struct_size must be set
     * @return FE_ERROR_STATE for a joint of another type */
    get distance(): DistanceJointDef;
    set ball(def: BallJointDefOptions | null);
    get ball(): BallJointDef;
    set hinge(def: HingeJointDefOptions | null);
    get hinge(): HingeJointDef;
    set fixed(def: FixedJointDefOptions | null);
    get fixed(): FixedJointDef;
    set configurable(def: ConfigurableJointDefOptions | null);
    get configurable(): ConfigurableJointDef;
    /** Its bodies wake. They may collide again from the next step on. */
    destroy(): void;
    /** 1 for a living joint of this world, 0 for anything else. */
    get isValid(): boolean;
    /** 0 for the end that is the world. */
    getBodies(): { bodyA: number; bodyB: number };
    /** What all types have, see fe_joint_def. Sets all of it but the bodies. */
    set(def?: JointDefOptions | null): void;
    /** @param out_def  its struct_size must be set */
    get(): JointDef;
    /** A disabled joint holds nothing, and its bodies may collide. A change wakes them. */
    set enabled(enabled: boolean | 0 | 1);
    get enabled(): boolean;
    /** Speed of the motor alone; its cap stays. A change wakes its bodies.
     * @param dof    fe_dof: FE_DOF_LINEAR_X for a distance joint, FE_DOF_ANGULAR_X for a hinge, an angular one for a ball
     *               joint, any for a configurable joint
     * @param speed  m/s or rad/s
     * @return FE_ERROR_STATE for a type of joint that has no such motor */
    setMotorSpeed(dof: Dof, speed: number): void;
    /** Target of the spring alone. A change wakes its bodies.
     * @param dof     as above
     * @param target  m or rad
     * @return FE_ERROR_STATE for a type of joint that has no such spring, and for a ball joint */
    setTarget(dof: Dof, target: number): void;
    /** Target rotation of a ball joint's spring alone. A change wakes its bodies. */
    setBallTarget(target: QuatLike): void;
    set userData(userData: number | bigint);
    get userData(): number | bigint;
    /** Where its frames are, world space. */
    getFrames(): { frameA: Transform; frameB: Transform };
    /** @param out_state  its struct_size must be set */
    get state(): JointState;
    /** What the joint did to B in the last step, on average: force at frame B's point, N, and torque about it, N m, world
     * axes. A feels the opposite at the same point. */
    getReaction(): { force: Vec3; torque: Vec3 };
}
export class StoreCalls {
    /** Memory of the store and its assets. */
    get bytes(): number;
}
export class AssetCalls {
    /** The handle dies at once. The asset's data lives until the last shape that uses it is gone. */
    destroy(): void;
    /** 1 for a living asset of this store, 0 for anything else. */
    get isValid(): boolean;
}
export class HullCalls {
    /** @param out_info  its struct_size must be set
     * @return FE_ERROR_KIND for an asset that is no hull */
    get info(): HullInfo;
    /** Its vertices, m: points of its definition, bit for bit, in their order. @param stride  bytes, 0: packed */
    get vertices(): Vec3[];
    /** Its faces. @param stride  bytes: sizeof of the caller's record */
    get faces(): HullFace[];
    /** The corners of all faces, face by face: indices of vertices, counterclockwise seen from outside. To draw a face,
     * make a fan of triangles from its first corner. @param stride  bytes, 0: packed */
    get corners(): number[];
}
export class HeightfieldCalls {
}
export class MeshCalls {
    /** @param out_info  its struct_size must be set
     * @return FE_ERROR_KIND for an asset that is no mesh */
    get info(): MeshInfo;
    /** @param triangle      its number in the definition
     * @param out_triangle  its struct_size must be set */
    getTriangle(triangle: number): MeshTriangle;
}
export class CompoundCalls {
    /** @param out_info  its struct_size must be set
     * @return FE_ERROR_KIND for an asset that is no compound */
    get info(): CompoundInfo;
    /** A part as it was given; a rotation comes back with length 1, a scale of 0, 0, 0 as 1, 1, 1.
     * @param part      its number, 0..part_count - 1
     * @param out_part  its struct_size must be set */
    getPart(part: number): CompoundPart;
}
