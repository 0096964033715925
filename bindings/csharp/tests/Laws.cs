// The laws of the C# layer, one public static method each. Run by xunit on .NET (Xunit.cs) and one by one on mono (Program.cs).
using System;
using System.Collections.Generic;
using System.IO;
using System.Numerics;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Text.RegularExpressions;

namespace FeatherPhysics.Tests
{
    public static class Laws
    {
        const float Dt = 1f / 60;
        const double Slop = 0.005; // m, how deep a contact rests

        /// The tree of the sources, from the environment.
        static string Root { get { return Environment.GetEnvironmentVariable("FEATHER_ROOT") ?? "."; } }
        static string Generated { get { return Environment.GetEnvironmentVariable("FEATHER_CSHARP") ?? Path.Combine(Root, "build/csharp"); } }

        static void Run(World world, int steps) { for (int i = 0; i < steps; ++i) world.Step(Dt); }

        static Body Ground(World world)
        {
            Body ground = world.CreateStatic(new DVec3(0, 0, 0));
            ground.AddPlane(0, 1, 0, 0);
            return ground;
        }

        // ---- motion ----

        public static void A_body_falls_by_gravity()
        {
            using (World world = new World(new Vector3(0, -8, 0)))
            {
                Body ball = world.CreateDynamic(new DVec3(0, 100, 0));
                ball.AddSphere(0.5f);
                Run(world, 60);
                Check.Near(ball.LinearVelocity.Y, -8, 1e-4, "speed after a second");
                Check.Near(ball.Position.Y, 100 - 4, 8.0 / 2 / 60 + 1e-4, "height after a second");
                Check.Same(ball.Position.X, 0.0, "no other axis moves");
                Check.Near(ball.Mass, 1000 * 4.0 / 3 * Math.PI / 8, 0.01, "mass");
            }
        }

        public static void A_ball_rests_on_the_ground_and_sleeps()
        {
            using (World world = new World())
            {
                Ground(world);
                Body ball = world.CreateDynamic(new DVec3(0, 1, 0));
                Shape shape = ball.AddSphere(0.5f);
                int enter = 0, sleep = 0;
                for (int i = 0; i < 240; ++i)
                {
                    world.Step(Dt);
                    foreach (PairEvent e in world.PairEvents)
                        if (e.Kind == EventKind.Enter && world[e.BodyB] == ball) ++enter;
                    foreach (BodyEvent e in world.BodyEvents)
                        if (e.Kind == EventKind.Sleep && e.Body == ball.Handle) ++sleep;
                }
                Check.Near(ball.Position.Y, 0.5, Slop, "rests");
                Check.Same(enter, 1, "enters");
                Check.Same(sleep, 1, "falls asleep");
                Check.True(!ball.Awake, "asleep");
                Contact[] contacts = new Contact[4];
                Check.Same(ball.GetContacts(contacts), 1, "contacts");
                Check.Same(contacts[0].PointCount, 1, "points of a sphere");
                Check.Near(contacts[0][0].Point.Y, 0, Slop, "where it touches");
                Check.Near(contacts[0].Normal.Y, 1, 1e-6, "from A to B");
                Check.Same(shape.GetContacts(contacts), 1, "contacts of the shape");
                Check.Throws<ArgumentOutOfRangeException>(() => { ContactPoint p = contacts[0][1]; }, "index");
            }
        }

        public static void Forces_and_impulses_change_velocities_by_the_mass()
        {
            using (World world = new World(Vector3.Zero))
            {
                Body box = world.CreateDynamic(new DVec3(0, 0, 0));
                box.AddBox(0.5f, 0.5f, 0.5f);
                box.Mass = 2;
                box.AddImpulse(new Vector3(4, 0, 0));
                Check.Near(box.LinearVelocity.X, 2, 1e-6, "impulse");
                box.AddForce(new Vector3(0, 120, 0));
                box.AddTorque(new Vector3(0, 0, 1));
                world.Step(Dt);
                Check.Near(box.LinearVelocity.Y, 1, 1e-4, "force");
                Check.Near(box.AngularVelocity.Z, 1 * Dt / (2.0 / 6), 1e-4, "torque");
                box.AddForce(new Vector3(0, 0, 1), box.Centre);
                box.AddImpulse(new Vector3(0, 0, 1), box.Centre);
                box.AddAngularImpulse(new Vector3(1, 0, 0));
                Check.Near(box.AngularVelocity.X, 3, 1e-3, "angular impulse");
                Check.Near(box.GetPointVelocity(box.Centre).X, box.LinearVelocity.X, 1e-6, "velocity of the centre");
            }
        }

        public static void What_is_set_is_read_back()
        {
            using (World world = new World())
            {
                Body body = world.CreateDynamic(new DVec3(1, 2, 3));
                Shape shape = body.AddBox(1, 1, 1, new ShapeDef { Density = 500, UserData = 77, LocalPosition = new Vector3(0, 1, 0) });
                body.UserData = 1ul << 63 | 5;
                Check.Same(body.UserData, 1ul << 63 | 5, "user data");
                body.GravityScale = 0.5f;
                Check.Same(body.GravityScale, 0.5f, "gravity scale");
                body.SetLocks(Axes.X | Axes.Z, Axes.All);
                Axes linear, angular;
                body.GetLocks(out linear, out angular);
                Check.Same(linear, Axes.X | Axes.Z, "linear locks");
                Check.Same(angular, Axes.All, "angular locks");
                body.SetDamping(0.25f, 0.5f);
                float l, a;
                body.GetDamping(out l, out a);
                Check.Same(l + a, 0.75f, "damping");
                body.Bullet = true;
                body.SleepAllowed = false;
                body.SleepThreshold = 0.125f;
                Check.True(body.Bullet && !body.SleepAllowed && body.SleepThreshold == 0.125f && body.Enabled && body.Awake, "switches");
                body.Enabled = false;
                Check.True(!body.Enabled, "disabled");
                body.Type = BodyType.Kinematic;
                Check.Same(body.Type, BodyType.Kinematic, "type");
                body.SetTarget(new WorldTransform(new DVec3(2, 2, 3)), 1);
                Check.Near(body.LinearVelocity.X, 0, 0, "a locked axis");
                body.Type = BodyType.Dynamic;
                MassData mass = body.MassData;
                mass.Mass = 3;
                body.MassData = mass;
                Check.Same(body.Mass, 3f, "mass");
                body.ResetMass();
                Check.Near(body.Mass, 4000, 0.1, "mass of the shape");
                body.Rotation = new Quaternion(0, 1, 0, 0);
                Check.Same(body.Rotation, new Quaternion(0, 1, 0, 0), "rotation");
                body.Position = new DVec3(1e7, 0.1, 0);
                Check.Same(body.Transform.Position, new DVec3(1e7, 0.1, 0), "position in double");
                Check.Same(body.PositionRelativeTo(new DVec3(1e7, 0, 0)).Y, 0.1f, "position from an origin");

                Check.Same(shape.Body, body, "body of the shape");
                Check.Same(shape.Density, 500f, "density");
                Check.Same(shape.UserData, 77ul, "user data of the shape");
                Check.Same(shape.Geometry.HalfExtents, new Vector3(1, 1, 1), "geometry");
                shape.Geometry = Geometry.Capsule(0.5f, 0.25f);
                Check.Same(shape.Geometry.Type, GeometryType.Capsule, "another geometry");
                SurfaceMaterial ice = shape.Material;
                ice.StaticFriction = ice.DynamicFriction = 0;
                shape.Material = ice;
                Check.Same(shape.Material.StaticFriction, 0f, "material");
                shape.SetFilter(4, 0xff);
                uint layer, mask;
                shape.GetFilter(out layer, out mask);
                Check.True(layer == 4 && mask == 0xff, "filter");
                shape.Trigger = true;
                shape.Events = ShapeEvents.Hit;
                shape.SurfaceVelocity = new Vector3(1, 0, 0);
                Check.True(shape.Trigger && shape.Events == ShapeEvents.Hit && shape.SurfaceVelocity.X == 1, "trigger, events, belt");
                shape.SetLocalPose(new Vector3(0, 2, 0), Quaternion.Identity);
                Vector3 at;
                Quaternion turned;
                shape.GetLocalPose(out at, out turned);
                Check.True(at.Y == 2 && turned == Quaternion.Identity, "local pose");
                ShapeHandle[] shapes = new ShapeHandle[2];
                Check.Same(body.GetShapes(shapes), 1, "shapes");
                Check.Same(world[shapes[0]], shape, "the shape");
                shape.Destroy();
                Check.True(!shape.IsValid, "destroyed");

                world.Gravity = new Vector3(0, -1, 0);
                world.Substeps = 4;
                WorldTuning tuning = world.Tuning;
                tuning.ContactHertz = 20;
                world.Tuning = tuning;
                Check.True(world.Gravity.Y == -1 && world.Substeps == 4 && world.Tuning.ContactHertz == 20, "world");
                Check.Same(world.Counters.Bodies, 1, "counters");
                world.SyncQueries();
                Check.True(world.Profile.Step >= 0 && World.Version >= 1 << 16, "profile, version");
            }
        }

        public static void Definitions_have_the_defaults_of_the_library()
        {
            BodyDef body = new BodyDef();
            Check.True(body.Type == BodyType.Dynamic && body.GravityScale == 1 && body.SleepThreshold == 0.05f && body.Enabled && body.Awake && !body.Bullet, "body");
            Check.True(body.Rotation == Quaternion.Identity && body.UserData == 0, "pose");
            ShapeDef shape = new ShapeDef();
            Check.True(shape.Density == 1000 && shape.Material.StaticFriction == 0.6f && shape.Mask == uint.MaxValue && shape.Events == ShapeEvents.Touch, "shape");
            WorldDef world = new WorldDef();
            Check.True(world.WorkerCount == 1 && world.Gravity == new Vector3(0, -9.81f, 0) && world.Substeps == 8, "world");
            Check.True(new HingeDef().SpringTorque == 1e15f && new BallDef().DriveTorque == 1e15f && new DistanceDef().SpringForce == 1e15f, "caps");
            Check.True(new ConfigurableDef().AboutZ.DriveForce == 1e15f && new FixedDef().AngularDampingRatio == 1, "axes");
        }

        // ---- joints and terrain ----

        public static void Joints_hold_and_break()
        {
            using (World world = new World())
            {
                Body post = world.CreateStatic(new DVec3(0, 0, 0));
                Body[] arm = new Body[8];
                for (int i = 0; i < arm.Length; ++i)
                {
                    arm[i] = world.CreateDynamic(new DVec3(1, 0, 4 * i));
                    arm[i].AddBox(0.25f, 0.25f, 0.25f);
                }
                Vector3 x = new Vector3(1, 0, 0), z = new Vector3(0, 0, 1);
                Joint ball = world.CreateBall(post, arm[0], new DVec3(0, 0, 0), x);
                Joint hinge = world.CreateHinge(post, arm[1], new DVec3(0, 0, 4), z, new HingeDef { Limited = true, MinAngle = -0.5f, MaxAngle = 0.5f });
                Joint rod = world.CreateDistance(post, arm[2], new DVec3(0, 0, 8), arm[2].Position);
                Joint rope = world.CreateRope(post, arm[3], new DVec3(0, 0, 12), arm[3].Position, 2);
                Joint weld = world.CreateFixed(post, arm[4], new DVec3(0, 0, 16), new FixedDef { BreakForce = 1, UserData = 9 });
                ConfigurableDef slider = world.MakeSlider(post, arm[5], arm[5].Position, x);
                Joint slide = world.CreateJoint(post, arm[5], slider);
                Joint wheel = world.CreateJoint(post, arm[6], world.MakeWheel(post, arm[6], arm[6].Position, x, new Vector3(0, 1, 0), 5, 1, 0.1f));
                Joint motor = world.CreateJoint(post, arm[7], world.MakeMotor(post, arm[7], 10, 1, 1e6f, 1e6f));
                int broken = 0;
                ulong told = 0;
                for (int i = 0; i < 120; ++i)
                {
                    world.Step(Dt);
                    foreach (JointEvent e in world.JointEvents) { ++broken; told = e.UserData; }
                }
                Check.Same(broken, 1, "broken");
                Check.Same(told, 9ul, "which broke");
                Check.True(!weld.IsValid, "gone");
                Check.Near(arm[0].Position.Length, 1, Slop, "the ball's arm");
                Check.Near(hinge.State.Angle, -0.5, 0.02, "the hinge at its limit");
                Check.Near(rod.State.Length, 1, Slop, "the rod");
                Check.True(rope.State.Length <= 2 + Slop, "the rope");
                Check.Near(arm[5].Position.Y, 0, Slop, "the slider stays level");
                Check.Near(arm[7].Position.Y, 0, 0.02, "the motor holds");
                Vector3 force, torque;
                rod.GetReaction(out force, out torque);
                Check.True(force.Length() > 0, "reaction");
                Body a, b;
                wheel.GetBodies(out a, out b);
                Check.True(a == post && b == arm[6] && wheel.Type == JointType.Configurable && ball.Type == JointType.Ball, "bodies, types");
                HingeDef def = new HingeDef();
                hinge.Get(def);
                Check.True(def.Limited && def.MaxAngle == 0.5f, "read back");
                def.MotorSpeed = 1;
                def.MotorTorque = 1e6f;
                hinge.Set(def);
                Run(world, 60);
                Check.Near(hinge.State.Angle, 0.5, 0.05, "the motor turns it to the other limit");
                JointDef common = slide.Common;
                common.UserData = 3;
                slide.Common = common;
                Check.Same(slide.UserData, 3ul, "user data");
                slide.Enabled = false;
                Check.True(!slide.Enabled, "disabled");
                WorldTransform frameA, frameB;
                rod.GetFrames(out frameA, out frameB);
                Check.Near(frameA.Position.Z, 8, 1e-6, "frame");
                JointHandle[] joints = new JointHandle[16];
                Check.Same(world.GetJoints(joints), 7, "joints");
                Check.Same(arm[0].GetJoints(joints), 1, "joints of a body");
                Check.Throws<WrongStateException>(() => ball.Get(def), "fe_hinge_joint_get");
                motor.Destroy();
                Check.Throws<StaleHandleException>(() => { JointType type = motor.Type; }, "fe_joint_get_type");
            }
        }

        public static void Terrain_carries()
        {
            using (World world = new World())
            {
                float[] heights = new float[25];
                for (int i = 0; i < heights.Length; ++i) heights[i] = 2;
                Heightfield field = world.CreateHeightfield(new HeightfieldDef { Rows = 5, Columns = 5, CellX = 2, CellZ = 2, Heights = heights });
                Body ground = world.CreateStatic(new DVec3(0, 0, 0));
                ground.AddTerrain(field);
                Body ball = world.CreateDynamic(new DVec3(3.5, 3, 3.25));
                ball.AddSphere(0.5f);
                Run(world, 120);
                Check.Near(ball.Position.Y, 2.5, Slop, "rests on the terrain");
                field.SetHeights(0, 0, 5, 5, new float[25]);
                Run(world, 120);
                Check.Near(ball.Position.Y, 0.5, Slop, "follows a change");
                float[] read = new float[4];
                field.GetHeights(1, 1, 2, 2, read);
                Check.Same(read[3], 0f, "heights");
                Check.Throws<BadArgumentException>(() => field.GetHeights(0, 0, 3, 3, read), "heights");
                Check.Throws<BadArgumentException>(() => world.CreateHeightfield(new HeightfieldDef { Rows = 5, Columns = 5, Heights = read }), "Heights");
                Check.Throws<BadArgumentException>(() => world.CreateHeightfield(null), "null");
                field.Destroy();
                Check.True(!field.IsValid && ball.IsValid, "the handle dies");
            }
        }

        // ---- queries, many at once ----

        public static void Queries_find_what_is_there()
        {
            using (World world = new World())
            {
                Body[] ball = new Body[3];
                for (int i = 0; i < ball.Length; ++i)
                {
                    ball[i] = world.CreateStatic(new DVec3(0, 0, 4 * i));
                    ball[i].AddSphere(1);
                }
                DVec3 from = new DVec3(0, 0, -5), way = new DVec3(0, 0, 20);
                Hit hit;
                Check.True(world.Raycast(from, way, out hit), "hits");
                Check.Same(world[hit.Body], ball[0], "the first");
                Check.Near(hit.Fraction, 4.0 / 20, 1e-9, "where");
                Check.Near(hit.Normal.Z, -1, 1e-6, "normal");
                QueryFilter filter = new QueryFilter { Excluded = new BodyHandle[] { ball[0] } };
                Check.True(world.Raycast(from, way, out hit, filter) && world[hit.Body] == ball[1], "the first but one");
                Check.True(world.RaycastAny(from, way) && !world.RaycastAny(from, new DVec3(0, 0, 1)), "any");
                Hit[] hits = new Hit[8];
                Check.Same(world.RaycastAll(from, way, hits), 3, "all");
                Check.True(hits[0].Fraction < hits[1].Fraction && hits[1].Fraction < hits[2].Fraction, "in order");
                Ray[] rays = { new Ray { Origin = from, Translation = way }, new Ray { Origin = from, Translation = new DVec3(0, 9, 0) } };
                Check.Same(world.RaycastMany(rays, hits, null, true), 1, "many");
                Check.True(hits[1].Body.Value == 0 && hits[1].Fraction == 1, "a miss");
                Geometry probe = Geometry.Sphere(0.5f);
                Check.True(world.Sweep(probe, new WorldTransform(from), way, out hit) && world[hit.Body] == ball[0], "sweep");
                Check.Near(hit.Fraction, 3.5 / 20, 1e-6, "where the sweep stops");
                Check.Same(world.SweepAll(probe, new WorldTransform(from), way, hits), 3, "sweep all");
                Check.True(world.SweepAny(probe, new WorldTransform(from), way), "sweep any");
                SweepPath[] paths = { new SweepPath { Start = new WorldTransform(from), Translation = way } };
                Check.Same(world.SweepMany(probe, paths, hits), 1, "sweep many");
                BodyHandle[] inside = new BodyHandle[4];
                Check.Same(world.Overlap(Geometry.Box(5, 5, 5), new WorldTransform(new DVec3(0, 0, 0)), inside), 2, "overlap");
                Check.True(inside[0] == ball[0].Handle && inside[1] == ball[1].Handle, "in the order of creation");
                Check.True(!world.OverlapAny(probe, new WorldTransform(new DVec3(9, 9, 9))), "overlap none");
                ClosestPoint closest;
                Check.True(world.GetClosestPoint(new DVec3(0, 3, 0), 5, out closest), "closest");
                Check.Near(closest.Distance, 2, 1e-6, "distance");
                Check.True(!world.GetClosestPoint(new DVec3(0, 30, 0), 5, out closest), "none near");
                Check.True(ball[2].Raycast(from, way, out hit) && !ball[2].Raycast(from, new DVec3(0, 9, 0), out hit), "one body");
                Check.True(ball[2].GetClosestPoint(from, out closest), "closest of one");
                ShapeHandle[] shape = new ShapeHandle[1];
                ball[1].GetShapes(shape);
                Check.True(world[shape[0]].Raycast(from, way, out hit) && world[shape[0]].GetClosestPoint(from, out closest), "one shape");
            }
        }

        public static void Many_bodies_at_once_are_as_one_by_one()
        {
            using (World world = new World())
            {
                WorldTransform[] at = new WorldTransform[50];
                for (int i = 0; i < at.Length; ++i) at[i] = new WorldTransform(new DVec3(1e6 + i, 10, 0));
                BodyHandle[] bodies = new BodyHandle[at.Length], all = new BodyHandle[at.Length];
                world.CreateBodies(new BodyDef { GravityScale = 0.5f }, at, bodies);
                Check.Same(world.GetBodies(all), 50, "how many");
                Check.Same(all[49], bodies[49], "which");
                LinearAngular[] velocities = new LinearAngular[50];
                for (int i = 0; i < 50; ++i) velocities[i] = new LinearAngular(new Vector3(0, i, 0), new Vector3(i, 0, 0));
                world.SetVelocities(bodies, velocities);
                world.AddForces(bodies, velocities);
                world.Step(Dt);
                WorldTransform[] now = new WorldTransform[50];
                RelativeTransform[] near = new RelativeTransform[50];
                world.GetTransforms(bodies, now);
                world.GetTransforms(bodies, new DVec3(1e6, 0, 0), near);
                world.GetVelocities(bodies, velocities);
                for (int i = 0; i < 50; ++i)
                {
                    Check.Same(now[i].Position, world[bodies[i]].Position, "position");
                    Check.Same(near[i].Position.X, (float)i, "from an origin");
                    Check.Same(velocities[i].Linear, world[bodies[i]].LinearVelocity, "velocity");
                }
                Check.Same(world.GetMoved(all, now), 50, "moved");
                world.SetTransforms(bodies, at);
                Check.Same(world[bodies[7]].Position.X, 1e6 + 7, "put back");
                Check.Throws<BadArgumentException>(() => world.GetTransforms(bodies, new WorldTransform[49]), "transforms has 49");
                world.DestroyBodies(bodies);
                Check.Same(world.Counters.Bodies, 0, "destroyed");
                Check.Throws<StaleHandleException>(() => world.GetTransforms(bodies, now), "fe_world_get_transforms");
            }
        }

        // ---- misuse ----

        public static void A_disposed_world_says_so()
        {
            World world = new World();
            Body body = world.CreateBody();
            Shape shape = body.AddSphere(1);
            world.Dispose();
            world.Dispose();
            Check.True(world.IsDisposed && !body.IsValid && !shape.IsValid, "not valid");
            Check.Throws<ObjectDisposedException>(() => world.Step(Dt), "disposed");
            Check.Throws<ObjectDisposedException>(() => { DVec3 p = body.Position; }, "disposed");
            Check.Throws<ObjectDisposedException>(() => shape.Density = 1, "disposed");
            Check.Throws<ObjectDisposedException>(() => { Hit hit; world.Raycast(new DVec3(), new DVec3(), out hit); }, "disposed");
            Check.Throws<ObjectDisposedException>(() => { int n = world.PairEvents.Length; }, "disposed");
        }

        public static void Bad_arguments_are_named()
        {
            using (World world = new World())
            using (World other = new World())
            {
                Body body = world.CreateBody(), foreign = other.CreateBody(), gone = world.CreateBody();
                Shape shape = body.AddSphere(1);
                gone.Destroy();
                gone = world[gone.Handle];
                Check.Throws<StaleHandleException>(() => { DVec3 p = gone.Position; }, "was destroyed");
                Check.Throws<WrongKindException>(() => { DVec3 p = world[new BodyHandle(shape.Handle.Value)].Position; }, "shape");
                Check.Throws<StaleHandleException>(() => { DVec3 p = default(Body).Position; }, "no world");
                Check.Throws<StaleHandleException>(() => default(Shape).Destroy(), "no world");
                Check.Throws<StaleHandleException>(() => default(Joint).Destroy(), "no world");
                Check.Throws<StaleHandleException>(() => world.IgnoreCollision(body, foreign), "another world");
                Check.Throws<StaleHandleException>(() => world.CreateHinge(foreign, body, new DVec3(), new Vector3(1, 0, 0)), "another world");
                Check.Throws<StaleHandleException>(() => world.CreateFixed(body, default(Body), new DVec3()), "no world");
                Check.Throws<BadArgumentException>(() => world.Step(float.NaN), "dt");
                Check.Throws<BadArgumentException>(() => world.Step(2), "dt");
                Check.Throws<BadArgumentException>(() => body.Position = new DVec3(double.NaN, 0, 0), "transform");
                Check.Throws<BadArgumentException>(() => body.AddSphere(-1), "radius");
                Check.Throws<BadArgumentException>(() => body.LinearVelocity = new Vector3(0, float.PositiveInfinity, 0), "velocity");
                Check.Throws<BadArgumentException>(() => world.CreateBody(new BodyDef { Position = new DVec3(0, double.NaN, 0) }), "transform");
                Check.Throws<BadArgumentException>(() => world.Tuning = null, "null");
                Check.Throws<BadArgumentException>(() => world.CreateJoint(body, gone, (HingeDef)null), "null");
                Check.Throws<UnsupportedException>(() => body.AddPlane(0, 1, 0, 0), "plane");
                Check.Throws<WrongStateException>(() => body.SetTarget(new WorldTransform(new DVec3()), 1), "kinematic");
                Check.Throws<BadArgumentException>(() => new Pool(65), "worker_count");
                Check.Throws<BadArgumentException>(() => new World(new WorldDef { Substeps = 0 }), "substeps");
                Check.Same(world.Counters.Bodies, 1, "nothing has changed");
            }
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        static Body Lost(int i)
        {
            World world = new World(null, new Pool(2));
            Body body = world.CreateDynamic(new DVec3(i, 0, 0));
            for (int k = 0; k < 40; ++k) world.CreateDynamic(new DVec3(i, k, 0)).AddSphere(0.5f);
            world.Step(Dt);
            return body;
        }

        public static void Bodies_keep_their_world_alive_and_lost_worlds_are_freed()
        {
            List<Body> kept = new List<Body>();
            for (int i = 0; i < 100; ++i)
            {
                Body body = Lost(i);
                if (i % 10 == 0) kept.Add(body);
                if (i % 20 == 0)
                {
                    GC.Collect();
                    GC.WaitForPendingFinalizers();
                }
            }
            for (int i = 0; i < kept.Count; ++i) Check.Near(kept[i].Position.X, 10 * i, 0, "still there");
        }

        public static void A_pool_lives_as_long_as_its_worlds()
        {
            Pool pool = new Pool(3);
            World a = new World(null, pool), b = new World(null, pool);
            pool.Dispose();
            a.CreateDynamic(new DVec3()).AddSphere(1);
            Run(a, 3);
            Check.Same(b.Counters.Workers, 3, "workers");
            a.Dispose();
            b.Step(Dt);
            b.Dispose();
            Check.Throws<ObjectDisposedException>(() => new World(null, pool), "");
        }

        public static void Positions_convert_where_you_say_so()
        {
            DVec3 far = new DVec3(1e8, 2, 3);
            Check.Same((Vector3)far, new Vector3(1e8f, 2, 3), "to float");
            Check.Same((DVec3)new Vector3(1, 2, 3), new DVec3(1, 2, 3), "to double");
            Check.Same(far.RelativeTo(new DVec3(1e8 - 0.25, 0, 0)).X, 0.25f, "from an origin");
            Check.True(far + new Vector3(1, 0, 0) - new Vector3(1, 0, 0) == far && far * 2 != far && new DVec3(3, 4, 0).Length == 5, "sums");
            Check.True(far.Equals((object)far) && far.GetHashCode() == new DVec3(1e8, 2, 3).GetHashCode(), "equal");
        }

        // ---- the generated code ----

        static readonly Dictionary<string, string> Names = new Dictionary<string, string>
        {
            { "fe_frame", "JointFrame" }, { "fe_material", "SurfaceMaterial" }, { "fe_profile", "StepProfile" }, { "fe_counters", "WorldCounters" },
            { "fe_path", "SweepPath" }, { "fe_closest", "ClosestPoint" }, { "fe_transform", "WorldTransform" }, { "fe_dvec3", "DVec3" },
            { "fe_query_filter", "NativeFilter" }, { "fe_heightfield_def", "NativeHeightfield" },
        };

        static string Pascal(string name)
        {
            string made = "";
            foreach (string part in name.Split('_')) made += char.ToUpperInvariant(part[0]) + part.Substring(1).ToLowerInvariant();
            return made;
        }

        static Type Find(string c)
        {
            string name;
            if (!Names.TryGetValue(c, out name)) name = Pascal(c.Substring(3));
            return typeof(World).Assembly.GetType("FeatherPhysics." + name);
        }

        public static void Records_have_the_layout_of_the_header()
        {
            int fields = 0, sizes = 0;
            const BindingFlags any = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic;
            foreach (Match m in Regex.Matches(File.ReadAllText(Path.Combine(Root, "tests/abi/layout.h")), @"FE_(SIZE|OFFSET)\((\w+), (?:(\w+), )?(\d+)\)"))
            {
                string record = m.Groups[2].Value, field = m.Groups[3].Value;
                int value = int.Parse(m.Groups[4].Value);
                if (record == "fe_vec3" || record == "fe_quat" || record == "fe_allocator" || record == "fe_task_system") continue;
                Type type = Find(record);
                Check.True(type != null, record + " has no type");
                if (m.Groups[1].Value == "SIZE")
                {
                    Check.Same(Marshal.SizeOf(type), value, "size of " + record);
                    ++sizes;
                    continue;
                }
                string name = field == "points" ? "Point0" : field == "axes" ? "AlongX" : Pascal(field);
                Check.True(type.GetField(name, any) != null, record + "." + field + " has no field");
                Check.Same((int)Marshal.OffsetOf(type, name), value, "offset of " + record + "." + field);
                ++fields;
            }
            Check.True(sizes >= 30 && fields >= 200, "all of the header: " + sizes + " records, " + fields + " fields");
        }

        public static void Every_function_is_in_the_flat_module()
        {
            string flat = File.ReadAllText(Path.Combine(Generated, "source/Native.cs"));
            string layer = "";
            foreach (string file in Directory.GetFiles(Path.Combine(Generated, "source"), "*.cs"))
                if (!Path.GetFileName(file).StartsWith("Native")) layer += File.ReadAllText(file);
            int count = 0;
            foreach (Match m in Regex.Matches(File.ReadAllText(Path.Combine(Root, "include/feather.h")), @"^FE_API [^;]*?\bfe_(\w+)\(", RegexOptions.Multiline))
            {
                string name = m.Groups[1].Value;
                Check.True(flat.Contains(" " + name + "("), "fe_" + name + " is missing");
                if (!Regex.IsMatch(layer, @"Native(PINVOKE)?\." + name + @"\(") && name != "result_name" && name != "query_filter_init") Console.WriteLine("note: nothing above Native calls fe_" + name);
                ++count;
            }
            Check.True(count > 150, "functions: " + count);
        }

        public static void Native_calls_are_in_generated_code_only()
        {
            Regex native = new Regex(@"\[\s*(DllImport|LibraryImport)|GetDelegateForFunctionPointer|delegate\*");
            foreach (string file in Directory.GetFiles(Path.Combine(Root, "bindings/csharp/FeatherPhysics"), "*.cs"))
                Check.True(!native.IsMatch(File.ReadAllText(file)), file + " calls native code by itself");
            Check.True(native.IsMatch(File.ReadAllText(Path.Combine(Generated, "source/NativePINVOKE.cs")).Replace("global::System.Runtime.InteropServices.", "")), "the pattern finds them");
        }
    }
}
