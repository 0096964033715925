// The scene that every language plays, see tests/bindings/scenario.c: prints the same two lines.
using System;
using System.Numerics;

namespace FeatherPhysics.Tests
{
    static class Scenario
    {
        const int Bodies = 300, Steps = 600, Samples = 17;

        static DVec3 Place(int i) { return new DVec3(i % 10 * 1.5 - 6.75, 2.0 + i / 60 * 1.5,
            i / 10 % 6 * 1.5 - 3.75); }

        static Heightfield AddTerrain(World world)
        {
            float[] heights = new float[Samples * Samples];
            for (int row = 0; row < Samples; ++row)
                for (int column = 0; column < Samples; ++column)
                    heights[row * Samples + column] = (row * 7 + column * 3) % 5 * 0.125f;
            Heightfield terrain = world.CreateHeightfield(new HeightfieldDef { Rows = Samples, Columns = Samples,
                CellX = 2, CellZ = 2, Heights = heights });
            world.CreateStatic(new DVec3()).AddTerrain(terrain, new ShapeDef { Frame = new Frame(new Vector3(-16, 0,
                -16)) });
            return terrain;
        }

        static Body AddBody(World world, int i)
        {
            Body body = world.CreateDynamic(Place(i));
            ShapeDef def = new ShapeDef();
            if (i % 5 == 0) def.Events = ShapeEvents.Touch | ShapeEvents.Hit;
            if (i % 3 == 0) body.AddSphere(0.5f, def);
            if (i % 3 == 1) body.AddBox(0.5f, 0.375f, 0.5f, def);
            if (i % 3 == 2) body.AddCapsule(0.25f, 0.375f, def);
            return body;
        }

        static void AddJoint(World world, Body[] body, int i)
        {
            Body a = body[i], b = body[i + 1];
            DVec3 from = Place(i), middle = new DVec3(from.X + 0.75, from.Y, from.Z);
            if (i % 10 == 0) world.CreateBallJoint(a, b, middle, new Vector3(1, 0, 0));
            if (i % 10 == 4) world.CreateHingeJoint(a, b, middle, new Vector3(0, 0, 1),
                new HingeJointDef { LimitEnabled = true, Lower = -0.5f, Upper = 0.5f });
            if (i % 10 == 7) world.CreateDistanceJoint(a, b, from, Place(i + 1));
            if (i % 10 == 2) world.CreateFixedJoint(a, b, middle, new FixedJointDef { BreakForce = 8192 });
        }

        public static void Run(int workers)
        {
            int enter = 0, leave = 0, hits = 0, sleep = 0, wake = 0, broken = 0, rays = 0, overlaps = 0;
            using (World world = new World(new WorldDef { WorkerCount = workers }))
            {
                Heightfield terrain = AddTerrain(world);
                Body[] body = new Body[Bodies];
                for (int i = 0; i < Bodies; ++i) body[i] = AddBody(world, i);
                world.CreateBody(new BodyDef { Type = BodyType.Kinematic, Position = new DVec3(-10, 1, 0),
                    LinearVelocity = new Vector3(0.5f, 0, 0) })
                    .AddBox(0.5f, 1, 4);
                for (int i = 0; i + 1 < Bodies; ++i) AddJoint(world, body, i);
                Geometry ball = Geometry.Sphere(3);
                for (int step = 0; step < Steps; ++step)
                {
                    if (step % 10 == 0)
                    {
                        Hit hit;
                        if (world.Raycast(new DVec3(step / 10 % 16 - 7.5, 20, 0.25), new DVec3(0, -40, 0), out hit) &&
                            world[hit.Body].Type == BodyType.Dynamic)
                        {
                            ++rays;
                            world[hit.Body].AddImpulse(new Vector3(0, 512, 64), hit.Point);
                        }
                        overlaps += world.Overlap(ball, new WorldTransform(new DVec3(0, 1, 0)), Span<BodyHandle>.Empty);
                    }
                    if (step == 200) terrain.SetHeights(7, 7, 3, 3, new float[] { 1, 1, 1, 1, 2, 1, 1, 1, 1 });
                    if (step == 400)
                        for (int i = 60; i < 70; ++i) body[i].Destroy();
                    world.Step((float)(1.0 / 60));
                    foreach (PairEvent e in world.PairEvents)
                        if (e.Kind == EventKind.Enter) ++enter;
                        else ++leave;
                    foreach (BodyEvent e in world.BodyEvents)
                        if (e.Kind == EventKind.Sleep) ++sleep;
                        else ++wake;
                    hits += world.HitEvents.Length;
                    broken += world.JointEvents.Length;
                }
                Console.WriteLine("hash {0:x16}", world.Hash);
            }
            Console.WriteLine("enter {0} exit {1} hit {2} sleep {3} wake {4} break {5} rays {6} overlaps {7}", enter,
                leave, hits, sleep, wake, broken, rays, overlaps);
        }
    }
}
