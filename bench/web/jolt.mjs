// Jolt from npm, behind the face of engines.mjs. Its build has no SIMD.
import Start from 'jolt-physics/wasm';

const STANDS = 0, MOVES = 1, GHOST = 2, LAYERS = 3; // what touches what

function makeSystem(J) {
    const pairs = new J.ObjectLayerPairFilterTable(LAYERS), places = new J.BroadPhaseLayerInterfaceTable(LAYERS, 2), settings = new J.JoltSettings();
    pairs.EnableCollision(STANDS, MOVES), pairs.EnableCollision(MOVES, MOVES);
    for (const [layer, place] of [[STANDS, 0], [MOVES, 1], [GHOST, 1]]) places.MapObjectToBroadPhaseLayer(layer, new J.BroadPhaseLayer(place));
    settings.mObjectLayerPairFilter = pairs, settings.mBroadPhaseLayerInterface = places;
    settings.mObjectVsBroadPhaseLayerFilter = new J.ObjectVsBroadPhaseLayerFilterTable(places, 2, pairs, LAYERS);
    settings.mMaxBodies = 8192, settings.mMaxBodyPairs = 65536, settings.mMaxContactConstraints = 16384; // more do not fit its scratch of 10 MB
    return new J.JoltInterface(settings);
}

export async function jolt(step) {
    const J = await Start(), engine = makeSystem(J), system = engine.GetPhysicsSystem(), bodies = system.GetBodyInterface();
    const add = ({ fixed, density = 1000, friction = 0.6, ghost } = {}, p, form) => {
        form.mDensity = density; // of its settings
        const layer = ghost ? GHOST : fixed ? STANDS : MOVES, type = fixed ? J.EMotionType_Static : J.EMotionType_Dynamic;
        const settings = new J.BodyCreationSettings(form.Create().Get(), new J.RVec3(...p), new J.Quat(0, 0, 0, 1), type, layer);
        settings.mFriction = friction, settings.mAllowSleeping = false;
        const body = bodies.CreateBody(settings);
        bodies.AddBody(body.GetID(), J.EActivation_Activate);
        return body;
    };
    return {
        box: (p, h, o) => add(o, p, new J.BoxShapeSettings(new J.Vec3(...h))), sphere: (p, r, o) => add(o, p, new J.SphereShapeSettings(r)),
        capsule: (p, h, r, o) => add(o, p, new J.CapsuleShapeSettings(h, r)),
        joint: (a, b, point) => {
            const settings = new J.PointConstraintSettings();
            settings.mPoint1 = settings.mPoint2 = new J.RVec3(...point);
            system.AddConstraint(settings.Create(a, b));
        },
        step: () => engine.Step(step, 1), height: (body) => body.GetPosition().GetY(),
    };
}
