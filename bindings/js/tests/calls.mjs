// Every method and property of the layer, with arguments that are right: what test_calls.mjs makes wrong in turn.
// A property is read by [name] and written by [name, value]; a method has its arguments.
export function makeWorld(feather) {
    const world = new feather.World({ number: 7, gravity: [0, -10, 0] });
    const ground = world.createBody({ type: 'static' });
    const floor = ground.addBox(20, 0.5, 20, { events: ['touch', 'hit'] });
    const body = world.createBody({ position: [0, 2, 0] }), shape = body.addBox(0.5, 0.5, 0.5);
    const other = world.createBody({ position: [3, 2, 0] });
    other.addSphere(0.5);
    const kinematic = world.createBody({ type: 'kinematic', position: [0, 9, 0] });
    kinematic.addCapsule(0.5, 0.25);
    const joints = {
        hinge: world.addHingeJoint(body, other, [1.5, 2, 0], [0, 0, 1]), ball: world.addBallJoint(body, null, [0, 3, 0], [0, 1, 0]),
    };
    const hull = world.createHull([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
    const heightfield = world.createHeightfield({ rows: 3, columns: 3, cellX: 1, cellZ: 1, heights: new Float32Array(9) });
    const mesh = world.createMesh({ vertices: [0, 0, 0, 0, 0, 1, 1, 0, 0], indices: [0, 1, 2], materials: [{ friction: 0.25 }], triangleMaterials: [0] });
    const compound = world.createCompound([{ geometry: { type: 'sphere', radius: 1 } }, { geometry: { type: 'box', halfExtents: [1, 1, 1] }, position: [2, 0, 0] }]);
    const history = world.createHistory();
    history.keep(1);
    for (let i = 0; i < 30; ++i) world.step(1 / 60);
    const taped = new feather.World(), recorder = taped.createRecorder();
    taped.createBody().addSphere(1);
    for (let i = 0; i < 9; ++i) taped.step(1 / 60);
    const recording = recorder.read(), player = new feather.Player(recording);
    return { batch: world.createBatch(2), recorder, recording, player, history, world, ground, floor, body, shape, other, kinematic, joints, hull, heightfield, mesh, compound };
}
const RAY = [[0, 9, 0], [0, -20, 0]], BALL = { type: 'sphere', radius: 0.5 }, AT = { position: [0, 1, 0] }, TURN = [0, 1, 0];
const POINT = [0, 1, 0], AXIS = [0, 0, 1];
export const CALLS = {
    world: (s) => [
        ['step', 1 / 60], ['gravity', [0, -9, 0]], ['gravity'], ['substeps', 4], ['substeps'], ['userData', 12n], ['userData'], ['number'],
        ['tuning', { contactHertz: 20 }], ['tuning'], ['getHertz', 1 / 60], ['ignoreCollision', s.body, s.ground, true], ['getIgnored', s.body, s.ground],
        ['optimize'], ['profile'], ['counters'], ['bodies'], ['joints'], ['bounds'], ['energy'], ['getMomentum', [0, 0, 0]],
        ['addDistanceJoint', s.body, s.other, POINT, [1, 1, 0], { springHertz: 1 }], ['addBallJoint', s.body, null, POINT, AXIS, null],
        ['addHingeJoint', s.body, s.other, POINT, AXIS, undefined], ['addFixedJoint', s.body, s.other, POINT, { breakForce: 1e9 }],
        ['addConfigurableJoint', s.body, s.other, POINT, AXIS, { axes: Array(6).fill({ motion: 'free' }) }], ['addRopeJoint', s.body, s.other, POINT, [1, 1, 0], 5],
        ['addSliderJoint', s.body, s.other, POINT, AXIS], ['addWheelJoint', s.body, s.other, POINT, AXIS, [0, 1, 0], 2, 0.5, 0.25],
        ['addMotorJoint', s.body, s.other, 2, 1, 100, 100], ['createDistanceJoint', { bodyA: s.body, bodyB: s.other }], ['createBallJoint', { bodyA: s.body }],
        ['createHingeJoint', { bodyA: s.body }], ['createFixedJoint', { bodyA: s.body }], ['createConfigurableJoint', { bodyA: s.body }],
        ['raycast', ...RAY, { mask: 0xffffffff, excluded: [s.other] }], ['raycastAny', ...RAY], ['raycastAll', ...RAY, null], ['raycastMany', [0, 9, 0, 0, -20, 0, 50, 9, 0, 0, -20, 0]],
        ['raycastRaw', new Float64Array([0, 9, 0, 0, -20, 0])], ['sweep', BALL, AT, [1, 0, 0]], ['sweepAny', BALL, AT, [1, 0, 0]], ['sweepAll', BALL, AT, [1, 0, 0]],
        ['sweepTurning', BALL, AT, [1, 0, 0], TURN], ['sweepTurningAny', BALL, AT, [1, 0, 0], TURN], ['sweepTurningAll', BALL, AT, [1, 0, 0], TURN],
        ['sweepMany', BALL, [{ start: AT, translation: [1, 0, 0] }]], ['overlap', BALL, AT], ['overlapAny', BALL, AT], ['overlapShapes', BALL, AT],
        ['overlapBounds', { lower: [-1, -1, -1], upper: [1, 1, 1] }], ['closestPoint', [0, 5, 0], 9], ['pairEvents'], ['bodyEvents'], ['hitEvents'], ['jointEvents'],
        ['createBody', { type: 'dynamic', position: [9, 9, 9], linearLocks: ['x', 'y'] }], ['createBodies', [{}, { type: 'static' }]], ['destroyBodies', []],
        ['list', [s.body, s.other.id]], ['createHistory', { frames: 4, bytes: 1e6 }], ['clone'], ['createState'], ['setState', s.world.createState()], ['createBatch', 2, { block: 1 }], ['createRecorder', { flags: ['assets', 'fine'], keyframeSteps: 60 }], ['store'], ['createHull', { points: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1] }],
        ['createHeightfield', { rows: 2, columns: 2, cellX: 1, cellZ: 1, heights: [0, 0, 0, 0] }], ['createMesh', { vertices: [0, 0, 0, 0, 0, 1, 1, 0, 0], indices: [0, 1, 2] }],
        ['createCompound', [{ geometry: BALL, density: 5 }]], ['hash'], ['getMoved', [0, 0, 0]], ['save', { flags: 0 }], ['drawLines', { parts: ['shapes', 'bounds'] }],
        ['drawTriangles'], ['drawPoints', { parts: 'contacts' }], ['drawInstances', { only: s.body }], ['setGroup'],
    ].filter(([name]) => name !== 'setGroup'),
    body: (s) => [
        ['isValid'], ['type', 'kinematic'], ['type', 'dynamic'], ['type'], ['transform', { position: [0, 3, 0], rotation: [0, 0, 0, 1] }], ['transform'], ['centre'], ['position', [0, 2, 0]], ['position'],
        ['rotation', { x: 0, y: 0, z: 0, w: 1 }], ['rotation'], ['linearVelocity', [0, 1, 0]], ['linearVelocity'], ['angularVelocity', [0, 1, 0]], ['angularVelocity'],
        ['getPointVelocity', POINT], ['addForce', [1, 0, 0]], ['addForceAt', [1, 0, 0], POINT], ['addTorque', [1, 0, 0]], ['addImpulse', [1, 0, 0]], ['addImpulseAt', [1, 0, 0], POINT],
        ['addAngularImpulse', [1, 0, 0]], ['massData', { mass: 5 }], ['massData'], ['mass', 3], ['mass'], ['resetMass'], ['setLocks', 'x', ['y', 'z']], ['getLocks'], ['setDamping', 0.5, 0.5], ['getDamping'],
        ['gravityScale', 2], ['gravityScale'], ['awake', true], ['awake'], ['sleepAllowed', true], ['sleepAllowed'], ['sleepThreshold', 0.25], ['sleepThreshold'], ['enabled', true], ['enabled'],
        ['bullet', true], ['bullet'], ['userData', 7], ['userData'], ['setFilter', 1, 0xffffffff, 0], ['getFilter'], ['shapes'], ['bounds'], ['joints'], ['raycast', ...RAY], ['closestPoint', [0, 9, 0]],
        ['contacts'], ['createShape', { type: 'cone', halfHeight: 1, radius: 1 }, { density: 5, friction: 0.5, material: { restitution: 0.5 } }], ['addSphere', 0.25], ['addBox', 0.25, 0.25, 0.25, null],
        ['addCapsule', 0.25, 0.25], ['addCylinder', 0.25, 0.25], ['addCone', 0.25, 0.25],
    ],
    kinematic: () => [['setTarget', { position: [0, 9, 1] }, 0.5]],
    ground: () => [['addPlane', [0, 1, 0], -2]],
    shape: () => [
        ['isValid'], ['body'], ['geometry', { type: 'box', halfExtents: [0.5, 0.25, 0.5] }], ['geometry'], ['frame', { position: [0, 0.25, 0] }], ['frame'], ['density', 500], ['density'], ['material', { friction: 0.25, userId: 9 }], ['material'],
        ['setFilter', 2, 0xffffffff, 0], ['getFilter'], ['pairFilter', false], ['pairFilter'], ['setOneWay', true, [0, 1, 0]], ['setOneWay', false, null], ['getOneWay'], ['trigger', false], ['trigger'], ['events', ['touch', 'stay']], ['events'],
        ['surfaceVelocity', [1, 0, 0]], ['surfaceVelocity'], ['userData', 5], ['userData'], ['bounds'], ['overlaps'], ['raycast', ...RAY], ['closestPoint', [0, 9, 0]], ['contacts'],
    ],
    hinge: () => [
        ['isValid'], ['type'], ['getBodies'], ['get'], ['set', { breakForce: 1e12 }], ['enabled', true], ['enabled'], ['setMotorSpeed', 'angularX', 1], ['setTarget', 'angularX', 0.5], ['userData', 5], ['userData'], ['getFrames'], ['state'],
        ['getReaction'], ['hinge', { motorMax: 5 }], ['hinge'],
    ],
    ball: () => [['setBallTarget', [0, 0, 0, 1]], ['ball', { springHertz: 1 }], ['ball']],
    store: () => [
        ['bytes'], ['createHull', [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]], ['createHeightfield', { rows: 2, columns: 2, cellX: 1, cellZ: 1, heights: [0, 0, 0, 0], holes: [0] }],
        ['createMesh', { vertices: [0, 0, 0, 0, 0, 1, 1, 0, 0], indices: new Uint16Array([0, 1, 2]), flags: 'twoSided' }], ['createCompound', [{ geometry: BALL, density: 5 }]],
    ],
    recorder: (s) => [['note', 'here', s.body], ['read', new Uint8Array(4096)]],
    player: (s) => [['feed', s.recording.subarray(0, 0)], ['step'], ['seek', 3], ['info'], ['notes'], ['divergence'], ['release']],
    batch: () => [
        ['world', 1], ['step', 1 / 60, 2, [1, 0]], ['reset', [1, 0]], ['read', 'gravity'], ['write', 'gravity', null, [0, -9, 0, 0, -9, 0]], ['input', 'gravity'], ['output', 'gravity'], ['hashes'],
    ],
    history: () => [['keep', 7], ['frames']],
    hull: () => [['isValid'], ['type'], ['key'], ['save'], ['info'], ['vertices'], ['faces'], ['corners']],
    heightfield: () => [['setHeights', 0, 0, 1, 2, [1, 2]], ['getHeights', 0, 0, 2, 2]],
    mesh: () => [['info'], ['getTriangle', 0], ['setMaterials', [{ friction: 0.5 }]]],
    compound: () => [['info'], ['getPart', 1]],
};
// Ends or replaces what it is called on, or makes objects of any handle
export const APART = new Set(['constructor', 'destroy', 'restore', 'load', 'isDestroyed', 'world', 'body', 'shape', 'joint', 'asset', '_w', '_s', '_move', '_own', '_end', 'store']);
// Of joints of other types, see test_feather.mjs
export const ELSEWHERE = new Set(['distance', 'fixed', 'configurable']);
export const subject = (s, kind) => ({ hinge: s.joints.hinge, ball: s.joints.ball, store: s.world.store })[kind] ?? s[kind];
export const invoke = (on, [name, ...args]) => {
    if (typeof Object.getOwnPropertyDescriptor(owner(on, name), name).value === 'function') return on[name](...args);
    if (args.length === 0) return on[name];
    on[name] = args[0];
    return undefined;
};
export function owner(on, name) {
    let at = Object.getPrototypeOf(on);
    while (at && !Object.hasOwn(at, name)) at = Object.getPrototypeOf(at);
    if (!at) throw new Error(`there is no ${name}`);
    return at;
}
export const isMethod = (on, name) => typeof Object.getOwnPropertyDescriptor(owner(on, name), name).value === 'function';
