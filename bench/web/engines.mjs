// The engines behind one face, each as its own page tells to start it. All without sleep, 60 Hz.
import { readFile } from 'node:fs/promises';
import { jolt } from './jolt.mjs';
import { physx } from './physx.mjs';

const STEP = 1 / 60;
export const engines = {
    async feather(substeps = 4) {
        const { default: Feather } = await import(process.env.FEATHER_PACKAGE ? `${process.env.FEATHER_PACKAGE}/index.js` : '../../build/js/index.js');
        const { World } = await Feather(), world = new World({ substeps });
        world.tuning = { sleepEnabled: false };
        const add = ({ fixed, density = 1000, friction = 0.6, ghost } = {}, position, geometry) => {
            const body = world.createBody({ type: fixed ? 'static' : 'dynamic', position });
            body.createShape(geometry, { density, friction, mask: ghost ? 0 : 0xffffffff });
            return body;
        };
        return {
            box: (p, halfExtents, o) => add(o, p, { type: 'box', halfExtents }), sphere: (p, radius, o) => add(o, p, { type: 'sphere', radius }),
            capsule: (p, halfHeight, radius, o) => add(o, p, { type: 'capsule', halfHeight, radius }),
            joint: (a, b, point) => world.addBallJoint(a, b, point, [1, 0, 0]), step: () => world.step(STEP), height: (body) => body.position.y,
            raycast: (from, by) => world.raycast(from, by) !== null, read: () => world.getMoved().count,
        };
    },
    feather8: () => engines.feather(8),
    async rapier() {
        const { default: R } = await import('@dimforge/rapier3d-simd-compat');
        await R.init();
        const world = new R.World({ x: 0, y: -9.81, z: 0 });
        world.timestep = STEP;
        const add = ({ fixed, density = 1000, friction = 0.6, ghost } = {}, [x, y, z], shape) => {
            const body = world.createRigidBody((fixed ? R.RigidBodyDesc.fixed() : R.RigidBodyDesc.dynamic()).setTranslation(x, y, z).setCanSleep(false));
            shape.setDensity(density).setFriction(friction).setRestitution(0);
            if (ghost) shape.setCollisionGroups(0);
            world.createCollider(shape, body);
            return body;
        };
        const less = (a, b) => ({ x: a[0] - b[0], y: a[1] - b[1], z: a[2] - b[2] });
        return {
            box: (p, h, o) => add(o, p, R.ColliderDesc.cuboid(...h)), sphere: (p, r, o) => add(o, p, R.ColliderDesc.ball(r)), capsule: (p, h, r, o) => add(o, p, R.ColliderDesc.capsule(h, r)),
            joint: (a, b, point, pa, pb) => world.createImpulseJoint(R.JointData.spherical(less(point, pa), less(point, pb)), a, b, true), step: () => world.step(), height: (body) => body.translation().y,
        };
    },
    async havok() {
        const { default: Start } = await import('@babylonjs/havok'), wasmBinary = await readFile(new URL('node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm', import.meta.url));
        const H = await Start({ wasmBinary }), world = H.HP_World_Create()[1], ID = [0, 0, 0, 1];
        H.HP_World_SetGravity(world, [0, -9.81, 0]);
        H.HP_World_SetIdealStepTime(world, STEP);
        const add = ({ fixed, density = 1000, friction = 0.6, ghost } = {}, p, [, shape]) => {
            const body = H.HP_Body_Create()[1];
            H.HP_Shape_SetDensity(shape, density);
            H.HP_Shape_SetMaterial(shape, [friction, friction, 0, H.MaterialCombine.MULTIPLY, H.MaterialCombine.MAXIMUM].map((v, k) => (k < 2 ? Math.sqrt(friction) : v)));
            if (ghost) H.HP_Shape_SetFilterInfo(shape, [0, 0]);
            H.HP_Body_SetShape(body, shape);
            H.HP_Body_SetMotionType(body, fixed ? H.MotionType.STATIC : H.MotionType.DYNAMIC);
            if (!fixed) H.HP_Body_SetMassProperties(body, H.HP_Shape_BuildMassProperties(shape)[1]);
            H.HP_Body_SetQTransform(body, [p, ID]);
            H.HP_World_AddBody(world, body, false);
            H.HP_Body_SetActivationControl(body, H.ActivationControl.ALWAYS_ACTIVE);
            return body;
        };
        const less = (a, b) => a.map((v, k) => v - b[k]);
        return {
            box: (p, h, o) => add(o, p, H.HP_Shape_CreateBox([0, 0, 0], ID, h.map((v) => 2 * v))), sphere: (p, r, o) => add(o, p, H.HP_Shape_CreateSphere([0, 0, 0], r)),
            capsule: (p, h, r, o) => add(o, p, H.HP_Shape_CreateCapsule([0, -h, 0], [0, h, 0], r)),
            joint: (a, b, point, pa, pb) => {
                const joint = H.HP_Constraint_Create()[1];
                H.HP_Constraint_SetParentBody(joint, a), H.HP_Constraint_SetChildBody(joint, b);
                H.HP_Constraint_SetAnchorInParent(joint, less(point, pa), [1, 0, 0], [0, 1, 0]), H.HP_Constraint_SetAnchorInChild(joint, less(point, pb), [1, 0, 0], [0, 1, 0]);
                for (const axis of [H.ConstraintAxis.LINEAR_X, H.ConstraintAxis.LINEAR_Y, H.ConstraintAxis.LINEAR_Z]) H.HP_Constraint_SetAxisMode(joint, axis, H.ConstraintAxisLimitMode.LOCKED);
                H.HP_Constraint_SetEnabled(joint, 1);
            },
            step: () => H.HP_World_Step(world, STEP), height: (body) => H.HP_Body_GetPosition(body)[1][1],
        };
    },
    jolt: () => jolt(STEP),
    physx: () => physx(STEP),
};
