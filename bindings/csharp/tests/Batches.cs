// The laws of batches.
using System;
using System.Numerics;

namespace FeatherPhysics.Tests
{
    public static partial class Laws
    {
        /// A ball that hangs on a hinge with a motor, one that is free, and the ground.
        static World Pendulum(out Body ball, out Body free, out Joint hinge)
        {
            World world = new World();
            world.CreateStatic(new DVec3()).AddPlane(0, 1, 0, 0);
            ball = world.CreateDynamic(new DVec3(1, 2, 0));
            ball.AddSphere(0.3f);
            free = world.CreateDynamic(new DVec3(0.9, 4, 0));
            free.AddBox(0.2f, 0.3f, 0.2f);
            hinge = world.CreateHingeJoint(default(Body), ball, new DVec3(0, 2, 0), new Vector3(0, 0, 1),
                new HingeJointDef());
            return world;
        }

        /// Forces of its own for each world.
        static void Choose(float[] force, int round)
        {
            for (int i = 0; i < force.Length; ++i) force[i] = i % 6 < 3 ? (i * 7 + round * 5) % 23 - 11 : 0;
        }

        public static void A_batch_is_what_a_loop_is()
        {
            const int count = 6;
            Body ball, free;
            Joint hinge;
            using (World world = Pendulum(out ball, out free, out hinge))
            using (Pool pool = new Pool(2))
            using (Batch batch = new Batch(world, new BatchDef { WorldCount = count }, pool))
            {
                World[] alone = new World[count];
                for (int i = 0; i < count; ++i) alone[i] = world.Clone();
                float[] force = new float[count * 2 * 6], angle = new float[count * 2];
                double[] pose = new double[count * 2 * 7];
                bool[] mask = new bool[count];
                Result[] results = new Result[count];
                ulong[] hashes = new ulong[count];
                batch.Bind(new[] { new BatchArray(BatchField.Force, force, ball.Handle, free.Handle) },
                    new[] { new BatchArray(BatchField.Transform, pose, ball.Handle, free.Handle),
                        new BatchArray(BatchField.Joint, angle, hinge.Handle) });
                GC.Collect();
                for (int round = 0; round < 30; ++round)
                {
                    Choose(force, round);
                    for (int i = 0; i < count; ++i) mask[i] = (i + round) % 3 != 0;
                    Check.Same(batch.Step(Dt, 2, mask, results), 0, "failed");
                    batch.GetHashes(hashes);
                    for (int i = 0; i < count; ++i)
                    {
                        for (int step = 0; mask[i] && step < 2; ++step)
                        {
                            for (int item = 0; item < 2; ++item)
                                alone[i][item == 0 ? ball.Handle : free.Handle].AddForce(
                                    new Vector3(force[i * 12 + item * 6], force[i * 12 + item * 6 + 1],
                                        force[i * 12 + item * 6 + 2]));
                            alone[i].Step(Dt);
                        }
                        string where = "world " + i + " in round " + round;
                        Check.Same(hashes[i], alone[i].Hash, where);
                        Check.Same(batch[i].Hash, hashes[i], where);
                        Check.Same(results[i], Result.Ok, where);
                        if (!mask[i]) continue;
                        Check.Same(pose[i * 14 + 1], alone[i][ball.Handle].Position.Y, where);
                        Check.Same(pose[i * 14 + 7], alone[i][free.Handle].Position.X, where);
                        Check.Same(angle[i * 2], alone[i][hinge.Handle].State.Angle, where);
                    }
                }
                Check.True(hashes[0] != hashes[1], "they differ from each other");
                foreach (World one in alone) one.Dispose();
            }
        }

        public static void A_batch_is_reset_to_the_template_or_to_states()
        {
            Body ball, free;
            Joint hinge;
            using (World world = Pendulum(out ball, out free, out hinge))
            using (Batch batch = new Batch(world, new BatchDef { WorldCount = 4 }))
            {
                ulong[] hashes = new ulong[4];
                ulong first = world.Hash;
                Run(world, 10);
                using (State state = world.GetState())
                {
                    batch.Step(Dt, 5);
                    Check.Same(batch.Reset(new[] { true, true, false, false }, new[] { state, null, state, null }), 0,
                        "failed");
                    ulong fifth = batch[2].Hash;
                    batch.GetHashes(hashes);
                    Check.True(hashes[0] == world.Hash && hashes[1] == first && hashes[2] == hashes[3] &&
                        fifth != first && fifth != world.Hash, "each as it is told");
                    Check.Same(batch.Reset(), 0, "failed");
                    batch.GetHashes(hashes);
                    Check.True(hashes[0] == first && hashes[3] == first, "all");
                    using (World stranger = new World())
                    using (State foreign = stranger.GetState())
                        Check.Throws<WrongStateException>(() => batch.Reset(default(ReadOnlySpan<bool>),
                            new[] { foreign, null, null, null }), "store");
                    state.Dispose();
                    Check.Throws<ObjectDisposedException>(() => batch.Reset(default(ReadOnlySpan<bool>),
                        new[] { null, state, null, null }), "disposed");
                    Check.Throws<BadArgumentException>(() => batch.Reset(default(ReadOnlySpan<bool>),
                        new State[3]), "3 elements");
                }
            }
        }

        public static void What_fails_in_a_batch_fails_alone()
        {
            Body ball, free;
            Joint hinge;
            using (World world = Pendulum(out ball, out free, out hinge))
            using (Batch batch = new Batch(world, new BatchDef { WorldCount = 3 }))
            {
                float[] force = new float[18];
                Result[] results = new Result[3];
                batch.Bind(new[] { new BatchArray(BatchField.Force, force, free.Handle) }, null);
                ulong first = world.Hash;
                force[7] = float.NaN;
                Check.Same(batch.Step(Dt, 1, default(ReadOnlySpan<bool>), results), 1, "failed");
                Check.True(results[0] == Result.Ok && results[1] == Result.ErrorArgument && results[2] == Result.Ok,
                    "which");
                Check.True(batch.Failure.Contains("world 1"), batch.Failure);
                Check.True(batch[1].Hash == first && batch[0].Hash != first, "the others go on");
                force[7] = 0;
                batch[2][free.Handle].Destroy();
                Check.Same(batch.Step(Dt, 1, default(ReadOnlySpan<bool>), results), 1, "failed");
                Check.Same(results[2], Result.ErrorStale, "an item that is gone");
                float[] awake = new float[3];
                Check.Same(batch.Read(new BatchArray(BatchField.Awake, awake, free.Handle), results), 1, "failed");
                Check.True(awake[0] == 1 && awake[1] == 1 && awake[2] == 0, "rows");
                Check.Same(batch.Write(new BatchArray(BatchField.Gravity, new float[] { 0, 0, 0, 1, 2, 3, 4, 5, 6 }),
                    new[] { false, true, true }), 0, "failed");
                Check.True(batch[0].Gravity == world.Gravity && batch[1].Gravity == new Vector3(1, 2, 3) &&
                    batch[2].Gravity == new Vector3(4, 5, 6), "written");
                ShapeHandle[] shapes = new ShapeHandle[1];
                world[ball.Handle].GetShapes(shapes);
                double[] friction = new double[6];
                batch.Write(new BatchArray(BatchField.Friction, new float[] { 0, 1, 2, 3, 4, 5 }, shapes));
                batch.Read(new BatchArray(BatchField.Friction, friction, shapes));
                Check.True(friction[0] == 0 && friction[3] == 3 && friction[5] == 5, "of shapes");
                float[] mass = new float[3];
                batch.Read(new BatchArray(BatchField.Mass, mass, ball.Handle));
                Check.True(mass[0] > 0 && mass[0] == mass[1], "mass");
                double[] at = new double[21];
                ball = batch[1][ball.Handle];
                BatchArray near = new BatchArray(BatchField.Transform, at, ball.Handle) { Origin = new DVec3(1, 0, 0) };
                batch.Read(near);
                Check.Same(at[7], ball.Position.X - 1, "from an origin");
                near.RelativeTo = ball.Handle;
                batch.Read(near);
                Check.True(Math.Abs(at[7]) < 1e-12 && Math.Abs(at[13] - 1) < 1e-6, "from itself");
            }
        }

        public static void What_a_batch_cannot_take_is_refused()
        {
            Body ball, free;
            Joint hinge;
            using (World world = Pendulum(out ball, out free, out hinge))
            using (Batch batch = new Batch(world, new BatchDef { WorldCount = 2 }))
            {
                Check.Same(batch.Count, 2, "worlds");
                Check.Throws<BadArgumentException>(() => new Batch(null), "null");
                Check.Throws<BadArgumentException>(() => new Batch(world, new BatchDef { WorldCount = 0 }),
                    "world_count");
                Check.Throws<BadArgumentException>(() => new Batch(world, new BatchDef { WorkerCount = 65 }),
                    "worker_count");
                Check.Throws<BadArgumentException>(() => { World none = batch[2]; }, "index");
                Check.Throws<BadArgumentException>(() => batch.Step(float.NaN), "dt");
                Check.Throws<BadArgumentException>(() => batch.Step(Dt, 0), "steps");
                Check.Throws<BadArgumentException>(() => batch.Step(Dt, 1001), "steps");
                Check.Throws<BadArgumentException>(() => batch.Step(Dt, 1, new bool[1]), "1 elements");
                Check.Throws<BadArgumentException>(() => batch.GetHashes(new ulong[1]), "1 elements");
                Check.Throws<BadArgumentException>(() => batch.Read(null), "null");
                Check.Throws<BadArgumentException>(() => batch.Write(null), "null");
                Check.Throws<BadArgumentException>(() => new BatchArray(BatchField.Gravity, (float[])null), "null");
                Action<BatchArray> give = array => batch.Bind(new[] { array }, null);
                Action<BatchArray> take = array => batch.Bind(null, new[] { array });
                Check.Throws<BadArgumentException>(() => give(null), "null");
                Check.Throws<BadArgumentException>(() => give(new BatchArray(BatchField.Gravity, new float[5])),
                    "bytes");
                Check.Throws<BadArgumentException>(() => give(new BatchArray(BatchField.Awake, new float[2],
                    ball.Handle)), "field");
                Check.Throws<BadArgumentException>(() => take(new BatchArray(BatchField.Force, new float[12],
                    ball.Handle)), "field");
                Check.Throws<WrongKindException>(() => take(new BatchArray(BatchField.Joint, new float[4],
                    ball.Handle)), "");
                free.Destroy(); // in the template alone
                take(new BatchArray(BatchField.Awake, new float[2], free.Handle));
                Check.Throws<StaleHandleException>(() => take(new BatchArray(BatchField.Awake, new float[2],
                    new BodyHandle(free.Handle.Value + 1000))), "");
                Check.Throws<WrongStateException>(() => batch[0].Dispose(), "batch");
                Check.True(!batch[0].IsDisposed && batch[0] == batch[0], "one object a world");
            }
        }

        public static void A_disposed_batch_ends_its_worlds()
        {
            Body ball, free;
            Joint hinge;
            World world = Pendulum(out ball, out free, out hinge);
            Batch batch = new Batch(world, new BatchDef { WorldCount = 2, WorkerCount = 2 });
            world.Dispose(); // the batch does not need it
            Check.Same(batch.Step(Dt, 3), 0, "failed");
            World kept = batch[1], twin = kept.Clone();
            History history = new History(kept);
            State state = kept.GetState();
            batch.Dispose();
            batch.Dispose();
            Check.True(kept.IsDisposed, "its world");
            Check.Throws<ObjectDisposedException>(() => kept.Step(Dt), "disposed");
            Check.Throws<ObjectDisposedException>(() => { World gone = batch[0]; }, "disposed");
            Check.Throws<ObjectDisposedException>(() => batch.Step(Dt), "disposed");
            Check.Throws<ObjectDisposedException>(() => batch.Bind(null, null), "disposed");
            Check.Throws<ObjectDisposedException>(() => new Batch(world), "disposed");
            history.Dispose();
            twin.Step(Dt);
            twin.SetState(state);
            twin.Dispose();
            state.Dispose();
        }

        /// Nobody disposes of them, nor of the worlds.
        static World Lose(int i)
        {
            Body ball, free;
            Joint hinge;
            World world = Pendulum(out ball, out free, out hinge);
            Batch batch = new Batch(world, new BatchDef { WorldCount = 3 });
            batch.Bind(null, new[] { new BatchArray(BatchField.Awake, new float[3], ball.Handle) });
            batch.Step(Dt);
            return batch[i % 3];
        }

        public static void Lost_batches_live_as_long_as_their_worlds()
        {
            World last = null;
            for (int i = 0; i < 100; ++i) last = Lose(i);
            GC.Collect();
            GC.WaitForPendingFinalizers();
            GC.Collect();
            ulong before = last.Hash;
            last.Step(Dt);
            Check.True(last.Hash != before, "it goes on");
        }

        public static void Worlds_of_a_batch_ask_the_pair_filter()
        {
            using (World world = new World())
            {
                world.CreateStatic(new DVec3()).AddPlane(0, 1, 0, 0);
                Body ball = world.CreateDynamic(new DVec3(0, 0.4, 0));
                ball.AddSphere(0.5f, new ShapeDef { PairFilter = true });
                int asked = 0;
                world.SetPairFilter(pair => { ++asked; return false; });
                using (Batch batch = new Batch(world, new BatchDef { WorldCount = 8, WorkerCount = 2 }))
                {
                    batch.Step(Dt, 10);
                    Check.True(asked >= 8 && batch[7][ball.Handle].Position.Y < 0.4, "it falls through the ground");
                    batch.Reset();
                    batch[3].SetPairFilter(pair => { throw new LawBrokenException("mine"); });
                    Check.Throws<LawBrokenException>(() => batch.Step(Dt), "mine");
                    batch.Step(Dt);
                    batch.Reset();
                    string nothing = asked < 0 ? "" : null;
                    for (int i = 0; i < 8; ++i) batch[i].SetPairFilter(pair => nothing.Length > 0); // a fault
                    Check.Throws<NullReferenceException>(() => batch.Step(Dt), "");
                    batch.Reset();
                    for (int i = 0; i < 8; ++i) batch[i].SetPairFilter(pair => { GC.Collect(); return true; });
                    batch.Step(Dt);
                    batch.Reset();
                    batch[3].SetPairFilter(pair => { batch.Step(Dt); return true; });
                    Check.Throws<WorldSteppingException>(() => batch.Step(Dt), "step");
                }
            }
        }
    }
}
