// What the types accept, and what they refuse.
import Feather, { type Body, type Hit, type World } from 'feather-physics';
import FromModule from 'feather-physics/module';
import WithThreads from 'feather-physics/threads';
import { BodyInstances, rayOf } from 'feather-physics/three';

async function play(): Promise<number> {
    const { World, Player, FeatherError, Axis } = await Feather();
    const world: World = new World({ gravity: [0, -9.81, 0], substeps: 4, simd: 'auto' });
    const body: Body = world.createBody({ type: 'dynamic', position: { x: 0, y: 1, z: 0 }, linearLocks: ['x', 'y'], userData: 5n });
    body.addBox(1, 1, 1, { friction: 0.5, material: { restitution: 0.25, frictionCombine: 'minimum' } });
    const joint = world.addHingeJoint(body, null, [0, 0, 0], new Float32Array(3), { limitEnabled: true });
    joint.hinge = { motorMax: 5 };
    const angle: number = joint.hinge.upper + joint.state.angle;
    const hit: Hit | null = world.raycast([0, 0, 0], body.position, { mask: Axis.all });
    body.position = [0, 1, 0];
    const poses: Float32Array = world.getMoved().poses;
    world.restore(world.save({ flags: 'assets' }));
    try { world.step(1 / 60); } catch (error) { if (error instanceof FeatherError && error.code === 'FE_ERROR_STALE') return 0; }
    // @ts-expect-error: no such type of body
    world.createBody({ type: 'dynamc' });
    // @ts-expect-error: no such option
    world.createBody({ positon: [0, 0, 0] });
    // @ts-expect-error: two numbers are no vector
    body.linearVelocity = [1, 2];
    // @ts-expect-error: read only
    body.isValid = true;
    // @ts-expect-error: a hit may be none
    hit.fraction;
    const drawn = new BodyInstances({ count: 1, instanceMatrix: { count: 1, array: new Float32Array(16), needsUpdate: false } }, world, [body]);
    drawn.keep(world.getMoved());
    world.raycast(...rayOf({}, 0, 0));
    const recorder = world.createRecorder({ flags: ['assets', 'last'] });
    recorder.note('here', body);
    const player = new Player(recorder.read(), { simd: 'auto' });
    for (const replay of player) replay.raycast([0, 0, 0], [0, 1, 0]);
    const text: string = player.divergence?.text ?? player.notes[0]!.text;
    // @ts-expect-error: a player reads bytes, not files
    player.feed(text);
    await FromModule(new Uint8Array());
    const batch = world.createBatch(8, { block: 2 }), drive = batch.input('jointSpeed', [joint]), state = world.clone().createState();
    drive.values[0] = batch.read('transform', [body], { origin: [0, 0, 0] })[0]! + batch.step(1 / 60, 2, [true, false]);
    batch.reset(null, [state]), world.setState(state);
    // @ts-expect-error: no such field
    batch.read('pose', [body]);
    const { threads, reason, Store } = await WithThreads({ threads: 4 });
    new Store();
    // @ts-expect-error: no reason is no string
    reason.length;
    // @ts-expect-error: no such option
    await WithThreads({ workers: 4 });
    return threads + angle + poses[0]! + (hit?.fraction ?? 0);
}
void play;
