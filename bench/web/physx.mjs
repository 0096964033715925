// PhysX 5 from npm, behind the face of engines.mjs, with its TGS solver.
import { readFile } from 'node:fs/promises';

const ALL = 1, NONE = 0; // groups of its own filter shader

// It is made for pages alone, and refuses node by its version
async function start() {
    const versions = Object.getOwnPropertyDescriptor(process, 'versions');
    Object.defineProperty(process, 'versions', { value: {}, configurable: true });
    globalThis.window ??= globalThis;
    const { default: Start } = await import('physx-js-webidl'), wasmBinary = await readFile(new URL('node_modules/physx-js-webidl/physx-js-webidl.wasm', import.meta.url)), P = await Start({ wasmBinary });
    Object.defineProperty(process, 'versions', versions);
    return P;
}

export async function physx(step) {
    const P = await start(), vec = (p) => new P.PxVec3(...p), at = (p, q = [0, 0, 0, 1]) => new P.PxTransform(vec(p), new P.PxQuat(...q));
    const foundation = P.CreateFoundation(P.PHYSICS_VERSION, new P.PxDefaultAllocator(), new P.PxDefaultErrorCallback()), scale = new P.PxTolerancesScale();
    const physics = P.CreatePhysics(P.PHYSICS_VERSION, foundation, scale), desc = new P.PxSceneDesc(scale);
    desc.gravity = vec([0, -9.81, 0]), desc.cpuDispatcher = P.DefaultCpuDispatcherCreate(0), desc.filterShader = P.DefaultFilterShader(), desc.solverType = P.PxSolverTypeEnum.eTGS;
    const scene = physics.createScene(desc), flags = new P.PxShapeFlags(P.PxShapeFlagEnum.eSIMULATION_SHAPE);
    const add = ({ fixed, density = 1000, friction = 0.6, ghost } = {}, p, form, turn) => {
        const shape = physics.createShape(form, physics.createMaterial(friction, friction, 0), true, ghost ? new P.PxShapeFlags(0) : flags), group = ghost ? NONE : ALL;
        shape.setSimulationFilterData(new P.PxFilterData(group, group, 0, 0));
        if (turn) shape.setLocalPose(at([0, 0, 0], turn));
        const body = fixed ? physics.createRigidStatic(at(p)) : physics.createRigidDynamic(at(p));
        body.attachShape(shape);
        if (!fixed) P.PxRigidBodyExt.prototype.updateMassAndInertia(body, density), body.setSleepThreshold(0);
        scene.addActor(body);
        return body;
    };
    const less = (a, b) => a.map((v, k) => v - b[k]), UPRIGHT = [0, 0, Math.SQRT1_2, Math.SQRT1_2]; // its capsules lie along x
    return {
        box: (p, h, o) => add(o, p, new P.PxBoxGeometry(...h)), sphere: (p, r, o) => add(o, p, new P.PxSphereGeometry(r)), capsule: (p, h, r, o) => add(o, p, new P.PxCapsuleGeometry(r, h), UPRIGHT),
        joint: (a, b, point, pa, pb) => P.PxTopLevelFunctions.prototype.SphericalJointCreate(physics, a, at(less(point, pa)), b, at(less(point, pb))),
        step: () => (scene.simulate(step), scene.fetchResults(true)), height: (body) => body.getGlobalPose().p.y,
    };
}
