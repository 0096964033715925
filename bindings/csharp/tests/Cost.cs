// What calls cost: against a raw P/Invoke of the C function itself, in bulk, and in bytes of garbage.
using System;
using System.Diagnostics;
using System.Numerics;
using System.Runtime.InteropServices;

namespace FeatherPhysics.Tests
{
    static unsafe class Cost
    {
        // The same functions without the layer: what a call costs at least.
        [DllImport("feather_csharp", EntryPoint = "CSharp_FeatherPhysics_body_get_linear_velocity")]
        static extern int RawGetVelocity(void* world, ulong body, void* velocity);
        [DllImport("feather_csharp", EntryPoint = "CSharp_FeatherPhysics_body_get_position")]
        static extern int RawGetPosition(void* world, ulong body, void* position);
        [DllImport("feather_csharp", EntryPoint = "CSharp_FeatherPhysics_body_get_transform")]
        static extern int RawGetTransform(void* world, ulong body, void* transform);
        [DllImport("feather_csharp", EntryPoint = "CSharp_FeatherPhysics_body_set_linear_velocity")]
        static extern int RawSetVelocity(void* world, ulong body, void* velocity);
        [DllImport("feather_csharp", EntryPoint = "CSharp_FeatherPhysics_world_create")]
        static extern int RawCreate(void* def, void* world);
        [DllImport("feather_csharp", EntryPoint = "CSharp_FeatherPhysics_body_create")]
        static extern int RawCreateBody(void* world, void* def, void* body);

        const int Calls = 2000000, Rounds = 9;

        /// ns a call, the best of some rounds.
        static double Best(Action loop, int calls)
        {
            double best = double.MaxValue;
            for (int i = 0; i < Rounds; ++i)
            {
                Stopwatch clock = Stopwatch.StartNew();
                loop();
                best = Math.Min(best, clock.Elapsed.TotalMilliseconds * 1e6 / calls);
            }
            return best;
        }

        static void Row(string name, double layer,
            double raw) { Console.WriteLine("{0,-32} {1,6:F1} ns   raw P/Invoke {2,6:F1} ns   x {3:F2}", name, layer,
            raw, layer / raw); }

        public static void Print()
        {
            IntPtr rawWorld;
            ulong made;
            RawCreate(null, &rawWorld);
            RawCreateBody((void*)rawWorld, null, &made);
            ulong id = made;
            using (World world = new World())
            {
                Body body = world.CreateBody();
                float sum = 0;
                void* w = (void*)rawWorld;
                Row("body.LinearVelocity", Best(() => { for (int i = 0; i < Calls; ++i) sum += body.LinearVelocity.X; },
                    Calls),
                    Best(() => { Vector3 v; for (int i = 0; i < Calls; ++i) { RawGetVelocity(w, id,
                        &v); sum += v.X; } }, Calls));
                Row("body.LinearVelocity = v", Best(() => { Vector3 v = new Vector3(1, 0,
                    0); for (int i = 0; i < Calls; ++i) body.LinearVelocity = v; }, Calls),
                    Best(() => { Vector3 v = new Vector3(1, 0, 0); for (int i = 0; i < Calls; ++i) RawSetVelocity(w, id,
                        &v); }, Calls));
                Row("body.Position",
                    Best(() => { for (int i = 0; i < Calls; ++i) sum += (float)body.Position.X; }, Calls),
                    Best(() => { DVec3 at; for (int i = 0; i < Calls; ++i) { RawGetPosition(w, id,
                        &at); sum += (float)at.X; } }, Calls));
                Row("body.Transform",
                    Best(() => { for (int i = 0; i < Calls; ++i) sum += (float)body.Transform.Position.X; }, Calls),
                    Best(() => { WorldTransform t; for (int i = 0; i < Calls; ++i) { RawGetTransform(w, id,
                        &t); sum += (float)t.Position.X; } }, Calls));
                GC.KeepAlive(sum);
            }
            PrintBulk();
            Console.WriteLine("10000 steps with queries, events and snapshots allocate {0} bytes", BytesOfSteps(10000));
        }

        static void PrintBulk()
        {
            using (World world = new World())
            {
                WorldTransform[] at = new WorldTransform[10000];
                RelativeTransform[] near = new RelativeTransform[10000];
                for (int i = 0; i < at.Length; ++i) at[i] = new WorldTransform(new DVec3(i, 0, 0));
                BodyHandle[] bodies = new BodyHandle[10000];
                world.CreateBodies(new BodyDef(), at, bodies);
                Console.WriteLine("10000 transforms in double: {0:F1} ns a body",
                    Best(() => { for (int i = 0; i < 20; ++i) world.GetTransforms(bodies, at); }, 200000));
                Console.WriteLine("10000 transforms in float: {0:F1} ns a body",
                    Best(() => { for (int i = 0; i < 20; ++i) world.GetTransforms(bodies, new DVec3(), near); },
                    200000));
            }
        }

        static World Busy(Body[] body)
        {
            World world = new World(new WorldDef { WorkerCount = 2 });
            world.CreateStatic(new DVec3()).AddPlane(0, 1, 0, 0);
            for (int i = 0; i < body.Length; ++i)
            {
                body[i] = world.CreateDynamic(new DVec3(i % 3, 1 + i / 3, 0.1 * i));
                body[i].AddSphere(0.5f,
                    new ShapeDef { Events = ShapeEvents.Touch | ShapeEvents.Stay | ShapeEvents.Hit });
            }
            body[1].AddCompound(world.CreateCompound(new CompoundPart(Geometry.Box(0.4f, 0.4f, 0.4f)),
                new CompoundPart(Geometry.Sphere(0.3f), new Vector3(0, 0.5f, 0))));
            return world;
        }

        /// Bytes that this thread allocates while a world steps, is asked everything, saved and restored.
        public static long BytesOfSteps(int steps)
        {
            Body[] body = new Body[12];
            Hit[] hits = new Hit[16];
            BodyHandle[] bodies = new BodyHandle[16];
            WorldTransform[] at = new WorldTransform[16];
            Contact[] contacts = new Contact[16];
            QueryFilter filter = new QueryFilter { Excluded = new BodyHandle[1] };
            Span<CompoundPart> parts = stackalloc CompoundPart[2];
            parts[0] = parts[1] = new CompoundPart(Geometry.Sphere(1));
            long told = 0, before = 0;
            using (World world = Busy(body))
            using (State state = world.GetState())
            {
                byte[] saved = new byte[2 * world.GetSnapshotSize() + 65536]; // contacts come
                for (int i = -200; i < steps; ++i)
                {
                    if (i == 0) before = GC.GetAllocatedBytesForCurrentThread();
                    if (i % 50 == 0) body[(i & 0xff) % 12].AddImpulse(new Vector3(0, 2000, 300));
                    world.Step(1f / 60);
                    Hit hit;
                    ClosestPoint closest;
                    if (world.Raycast(new DVec3(0, 9, 0), new DVec3(0, -20, 0), out hit, filter)) told += hit.Triangle;
                    told += world.RaycastAll(new DVec3(0, 9, 0), new DVec3(0, -20, 0), hits, filter);
                    if (world.Sweep(Geometry.Sphere(0.5f), new WorldTransform(new DVec3(0, 9, 0)), new DVec3(0, -20, 0),
                        out hit)) ++told;
                    told += world.Overlap(Geometry.Sphere(2), new WorldTransform(new DVec3()), bodies);
                    if (world.GetClosestPoint(new DVec3(0, 5, 0), 10, out closest)) ++told;
                    foreach (PairEvent e in world.PairEvents) told += (int)e.Kind + e.PartA;
                    if (i % 100 == 0)
                    {
                        Compound made = world.CreateCompound(parts);
                        told += made.Info.PartCount + (int)made.GetPart(1).UserData;
                        made.Destroy();
                        int size = world.Save(saved);
                        if (world.Restore(saved.AsSpan(0, size))) told += size;
                        world.SetState(state);
                    }
                    told += world.BodyEvents.Length + world.HitEvents.Length + world.JointEvents.Length;
                    told += world.GetMoved(bodies, at) + body[0].GetContacts(contacts);
                    if (body[0].Position.Y < -100) ++told;
                    told += world.Counters.Contacts;
                }
                long used = GC.GetAllocatedBytesForCurrentThread() - before;
                GC.KeepAlive(told);
                return used;
            }
        }

        /// The same of a batch that is stepped, read, written, hashed and reset.
        public static long BytesOfBatch(int steps)
        {
            Body[] body = new Body[6];
            float[] awake = new float[8];
            BatchArray gravity = new BatchArray(BatchField.Gravity, new float[24]);
            bool[] mask = new bool[8];
            Result[] results = new Result[8];
            ulong[] hashes = new ulong[8];
            State[] states = new State[8];
            long told = 0, before = 0;
            using (World world = Busy(body))
            using (State state = world.GetState())
            using (Batch batch = new Batch(world, new BatchDef { WorldCount = 8, WorkerCount = 2 }))
            {
                states[3] = state;
                batch.Bind(null, new[] { new BatchArray(BatchField.Awake, awake, body[0].Handle) });
                for (int i = -20; i < steps; ++i)
                {
                    if (i == 0) before = GC.GetAllocatedBytesForCurrentThread();
                    mask[i & 7] = !mask[i & 7];
                    told += batch.Step(1f / 60, 2, mask, results) + batch.Read(gravity) + batch.Write(gravity, mask);
                    batch.GetHashes(hashes);
                    if (i % 10 == 0) told += batch.Reset(mask, states, results);
                }
                long used = GC.GetAllocatedBytesForCurrentThread() - before;
                GC.KeepAlive(told);
                return used;
            }
        }
    }
}
