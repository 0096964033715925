// What threads may do to a world against all rules, and never kill the process with: two writers, and Dispose beside
// readers. Every call ends in a value or in an exception of the layer.
using System;
using System.Diagnostics;
using System.Numerics;
using System.Threading;

namespace FeatherPhysics.Tests
{
    static class Threads
    {
        /// What a call may end in beside a value.
        static bool IsExpected(Exception e)
        {
            return e is FeatherException || e is ObjectDisposedException;
        }

        sealed class Count { public long Calls, Refused; }

        /// Starts a thread that calls until `until` says so; an exception that is not the layer's ends in `failure`.
        static Thread Start(Action call, Func<bool> until, Count count, Exception[] failure)
        {
            Thread thread = new Thread(() =>
            {
                while (!until())
                    try
                    {
                        Interlocked.Increment(ref count.Calls);
                        call();
                    }
                    catch (Exception e) when (IsExpected(e)) { Interlocked.Increment(ref count.Refused); }
                    catch (Exception e) { failure[0] = e; return; }
            });
            thread.Start();
            return thread;
        }

        static void CreateAndDestroy(World world, Body ground, int which)
        {
            Body body = world.CreateDynamic(new DVec3(which, 1, 0));
            Shape shape = default(Shape);
            Joint joint = default(Joint);
            try
            {
                shape = body.AddSphere(0.4f);
                joint = world.CreateBallJoint(ground, body, new DVec3(which, 1, 0), new Vector3(1, 0, 0));
                body.LinearVelocity = new Vector3(0, 1, 0);
                world.Step(1f / 60);
                joint.Destroy();
                shape.Destroy();
            }
            finally
            {
                // a refused destruction is tried again: the world must not fill
                for (bool done = false; !done;)
                    try
                    {
                        body.Destroy();
                        done = true;
                    }
                    catch (WorldBusyException) { }
                    catch (WorldSteppingException) { }
            }
        }

        /// Two threads create, step and destroy in one world.
        public static void TwoWriters(double seconds)
        {
            Count count = new Count();
            Exception[] failure = new Exception[1];
            using (World world = new World())
            {
                Body ground = world.CreateStatic(new DVec3());
                ground.AddPlane(0, 1, 0, 0);
                Stopwatch clock = Stopwatch.StartNew();
                Func<bool> until = () => clock.Elapsed.TotalSeconds > seconds;
                Thread[] thread = new Thread[2];
                for (int i = 0; i < 2; ++i)
                {
                    int which = i;
                    thread[i] = Start(() => CreateAndDestroy(world, ground, which), until, count, failure);
                }
                foreach (Thread each in thread) each.Join();
                Check.True(failure[0] == null, "" + failure[0]);
                Check.Same(world.Counters.Bodies, 1, "every body is gone");
                world.Step(1f / 60);
            }
            Console.WriteLine("note: two writers: {0} rounds, {1} ended in an exception", count.Calls, count.Refused);
        }

        sealed class Scene
        {
            public World World;
            public Body[] Bodies = new Body[300];
            public Joint Joint;
            public Heightfield Field;

            public Scene()
            {
                World = new World();
                Field = World.CreateHeightfield(new HeightfieldDef { Rows = 40, Columns = 40,
                    Heights = new float[1600] });
                World.CreateStatic(new DVec3()).AddTerrain(Field);
                for (int i = 0; i < Bodies.Length; ++i)
                {
                    Bodies[i] = World.CreateDynamic(new DVec3(i % 20 + 1, 0.5 + i / 20, 1));
                    Bodies[i].AddSphere(0.5f);
                }
                Joint = World.CreateBallJoint(Bodies[0], Bodies[1], Bodies[0].Position, new Vector3(1, 0, 0));
                World.Step(1f / 60);
                Saved = World.Save();
            }

            public byte[] Saved;

            /// Refused beside readers, or the world is as it was.
            public void StepAndRestore()
            {
                World.Step(1f / 60);
                World.Restore(Saved);
            }

            public double Read()
            {
                Hit hit;
                double sum = Bodies[7].Position.Y;
                if (World.Raycast(new DVec3(3, 40, 1), new DVec3(0, -50, 0), out hit)) sum += hit.Fraction;
                sum += World.PairEvents.Length + Joint.State.Angle + World.Counters.Bodies;
                float[] height = new float[1];
                Field.GetHeights(3, 3, 1, 1, height);
                sum += World.Save(new byte[World.GetSnapshotSize()]);
                if (Bodies[9].IsValid && Joint.IsValid && Field.IsValid) ++sum;
                return sum + height[0];
            }
        }

        /// Worlds are disposed of while threads read them, step them, and restore them.
        public static void DisposeUnderReaders(double seconds)
        {
            Count count = new Count();
            Exception[] failure = new Exception[1];
            Stopwatch clock = Stopwatch.StartNew();
            int worlds = 0;
            for (; clock.Elapsed.TotalSeconds < seconds; ++worlds)
            {
                Scene scene = new Scene();
                Func<bool> until = () => scene.World.IsDisposed;
                Thread[] thread = new Thread[worlds % 3 + 1];
                for (int i = 0; i < thread.Length; ++i)
                    thread[i] = Start(() => scene.Read(), until, count, failure);
                Thread stepper = worlds % 4 == 3 ? Start(scene.StepAndRestore, until, count, failure) : null;
                if (worlds % 2 == 0) Thread.Sleep(1);
                scene.World.Dispose();
                foreach (Thread each in thread) each.Join();
                if (stepper != null) stepper.Join();
                Check.True(failure[0] == null, "" + failure[0]);
                Check.Throws<ObjectDisposedException>(() => scene.Read(), "disposed");
            }
            Console.WriteLine("note: dispose under readers: {0} worlds, {1} calls, {2} ended in an exception",
                worlds, count.Calls, count.Refused);
        }

        public static void Run(double seconds, int rounds)
        {
            for (int i = 0; i < rounds; ++i)
            {
                TwoWriters(seconds);
                DisposeUnderReaders(seconds);
            }
        }
    }
}
