// The laws of the C# layer, one public static method each. Run by xunit on .NET (Xunit.cs) and one by one on mono
// (Program.cs). Those of snapshots are in Snapshots.cs.
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
    public static partial class Laws
    {
        const float Dt = 1f / 60;
        const double Slop = 0.005; // m, how deep a contact rests

        /// The tree of the sources, from the environment.
        static string Root { get { return Environment.GetEnvironmentVariable("FEATHER_ROOT") ?? "."; } }
        static string Generated
        {
            get { return Environment.GetEnvironmentVariable("FEATHER_CSHARP") ?? Path.Combine(Root, "build/csharp"); }
        }

        static void Run(World world, int steps) { for (int i = 0; i < steps; ++i) world.Step(Dt); }

        static Body Ground(World world)
        {
            Body ground = world.CreateStatic(new DVec3(0, 0, 0));
            ground.AddPlane(0, 1, 0, 0);
            return ground;
        }

        // ---- drawing ----

        public static void A_world_is_drawn_into_spans()
        {
            using (World world = new World())
            {
                Body box = world.CreateDynamic(new DVec3(10, 2, 0));
                Shape shape = box.AddBox(0.5f, 1, 1.5f);
                DrawVertex[] vertices = new DrawVertex[40];
                Check.Same(world.DrawTriangles(default(Span<DrawVertex>)), 36, "counted");
                Check.Same(world.DrawTriangles(vertices), 36, "drawn");
                double volume = 0;
                for (int i = 0; i < 36; i += 3)
                {
                    DrawVertex a = vertices[i], b = vertices[i + 1], c = vertices[i + 2];
                    volume += ((double)a.X * ((double)b.Y * c.Z - (double)b.Z * c.Y) +
                        (double)a.Y * ((double)b.Z * c.X - (double)b.X * c.Z) +
                        (double)a.Z * ((double)b.X * c.Y - (double)b.Y * c.X)) / 6;
                    Check.Same(a.Owner, shape.Handle.Value, "owner");
                }
                Check.Near(volume, 6, 1e-3, "volume");
                DrawOptions options = new DrawOptions { Origin = new DVec3(10, 2, 0), Only = box.Handle };
                Check.Same(options.Segments, 16, "the library's defaults");
                DrawInstance[] instances = new DrawInstance[1];
                Check.Same(world.DrawInstances(instances, options), 1, "instances");
                Check.Same(instances[0].HalfExtents, new Vector3(0.5f, 1, 1.5f), "half extents");
                Check.Same(instances[0].Position, Vector3.Zero, "relative to the origin");
                options.Parts = DrawFlags.Shapes | DrawFlags.Bounds;
                Check.Same(world.DrawLines(vertices, options), 48, "edges and a box");
                options.Parts = DrawFlags.Centres;
                Check.Same(world.DrawPoints(vertices, options), 1, "a centre");
                options.Segments = 2;
                Check.Throws<FeatherException>(() => world.DrawLines(vertices, options), "segments");
            }
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
                Shape shape = body.AddBox(1, 1, 1, new ShapeDef { Density = 500, UserData = 77,
                    Frame = new Frame(new Vector3(0, 1, 0)) });
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
                Check.True(body.Bullet && !body.SleepAllowed && body.SleepThreshold == 0.125f && body.Enabled &&
                    body.Awake, "switches");
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
                shape.SetFilter(4, 0xff, -3);
                uint layer, mask;
                int group;
                shape.GetFilter(out layer, out mask, out group);
                Check.True(layer == 4 && mask == 0xff && group == -3, "filter");
                body.SetFilter(8, 0xf0, 7);
                body.GetFilter(out layer, out mask, out group);
                Check.True(layer == 8 && mask == 0xf0 && group == 7, "filter of the body");
                shape.Trigger = true;
                shape.Events = ShapeEvents.Hit;
                shape.SurfaceVelocity = new Vector3(1, 0, 0);
                Check.True(shape.Trigger && shape.Events == ShapeEvents.Hit && shape.SurfaceVelocity.X == 1,
                    "trigger, events, belt");
                shape.Frame = new Frame(new Vector3(0, 2, 0));
                Check.True(shape.Frame.Position.Y == 2 && shape.Frame.Rotation == Quaternion.Identity, "frame");
                shape.PairFilter = true;
                shape.SetOneWay(true, new Vector3(0, 0, 2));
                shape.OneWay = false;
                bool oneWay;
                Vector3 direction;
                shape.GetOneWay(out oneWay, out direction);
                Check.True(shape.PairFilter && !oneWay && !shape.OneWay && direction.Z == 2, "pair filter, one way");
                ShapeHandle[] shapes = new ShapeHandle[2];
                Check.Same(body.GetShapes(shapes), 1, "shapes");
                Check.Same(world[shapes[0]], shape, "the shape");
                shape.Destroy();
                Check.True(!shape.IsValid, "destroyed");

                world.Gravity = new Vector3(0, -1, 0);
                world.Substeps = 4;
                WorldTuning tuning = world.Tuning;
                tuning.ContactHertz = 20;
                tuning.SleepEnabled = tuning.ContinuousEnabled = tuning.WarmStartEnabled = false;
                world.Tuning = tuning;
                tuning = world.Tuning;
                Check.True(world.Gravity.Y == -1 && world.Substeps == 4 && tuning.ContactHertz == 20, "world");
                Check.True(!tuning.SleepEnabled && !tuning.ContinuousEnabled && !tuning.WarmStartEnabled,
                    "switches of the world");
                float contactHertz, jointHertz;
                world.GetHertz(Dt, out contactHertz, out jointHertz);
                Check.True(contactHertz == 20 && Math.Abs(jointHertz - 0.225 * 4 * 60) < 1e-4,
                    "hertz " + contactHertz + ", " + jointHertz);
                world.UserData = ulong.MaxValue;
                Check.Same(world.UserData, ulong.MaxValue, "user data of the world");
                Check.Same(world.Counters.Bodies, 1, "counters");
                world.Optimize();
                Check.True(world.Profile.Step >= 0 && World.Version >= 1 << 16, "profile, version");
            }
        }

        public static void Definitions_have_the_defaults_of_the_library()
        {
            BodyDef body = new BodyDef();
            Check.True(body.Type == BodyType.Dynamic && body.GravityScale == 1 && body.SleepThreshold == 0.05f &&
                body.Enabled && body.Awake && !body.Bullet, "body");
            Check.True(body.Rotation == Quaternion.Identity && body.UserData == 0, "pose");
            ShapeDef shape = new ShapeDef();
            Check.True(shape.Density == 1000 && shape.Material.StaticFriction == 0.6f && shape.Mask == uint.MaxValue &&
                shape.Events == ShapeEvents.Touch, "shape");
            WorldDef world = new WorldDef();
            Check.True(world.WorkerCount == 1 && world.Gravity == new Vector3(0, -9.81f, 0) && world.Substeps == 8,
                "world");
            Check.True(new HingeJointDef().SpringMax == 1e15f && new BallJointDef().SpringMax == 1e15f, "caps");
            Check.True(new DistanceJointDef().SpringMax == 1e15f && new DistanceJointDef().LimitEnabled, "caps");
            Check.True(new ConfigurableJointDef().AngularZ.SpringMax == 1e15f &&
                new FixedJointDef().AngularDampingRatio == 1, "axes");
            Check.True(new JointDef().Enabled && new JointDef().FrameA.Rotation == Quaternion.Identity,
                "what all joints have");
            Check.True(SurfaceMaterial.Default.StaticFriction == 0.6f &&
                SurfaceMaterial.Default.FrictionCombine == Combine.Default, "material");
            Check.True(new WorldTuning().SleepEnabled && new WorldTuning().ContinuousEnabled &&
                new WorldTuning().WarmStartEnabled, "tuning");
            Check.Same(new StoreDef().Number, 0u, "store");
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
                Joint ball = world.CreateBallJoint(post, arm[0], new DVec3(0, 0, 0), x);
                Joint hinge = world.CreateHingeJoint(post, arm[1], new DVec3(0, 0, 4), z,
                    new HingeJointDef { LimitEnabled = true, Lower = -0.5f, Upper = 0.5f });
                Joint rod = world.CreateDistanceJoint(post, arm[2], new DVec3(0, 0, 8), arm[2].Position);
                Joint rope = world.CreateRopeJoint(post, arm[3], new DVec3(0, 0, 12), arm[3].Position, 2);
                Joint weld = world.CreateFixedJoint(post, arm[4], new DVec3(0, 0, 16),
                    new FixedJointDef { BreakForce = 1, UserData = 9 });
                ConfigurableJointDef slider = world.MakeSliderJoint(post, arm[5], arm[5].Position, x);
                Joint slide = world.CreateJoint(slider);
                Joint wheel = world.CreateWheelJoint(post, arm[6], arm[6].Position, x, new Vector3(0, 1, 0), 5, 1,
                    0.1f);
                Joint motor = world.CreateMotorJoint(post, arm[7], 10, 1, 1e6f, 1e6f);
                int broken = 0;
                ulong reported = 0;
                for (int i = 0; i < 120; ++i)
                {
                    world.Step(Dt);
                    foreach (JointEvent e in world.JointEvents) { ++broken; reported = e.UserData; }
                }
                Check.Same(broken, 1, "broken");
                Check.Same(reported, 9ul, "which broke");
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
                Check.True(a == post && b == arm[6] && wheel.Type == JointType.Configurable &&
                    ball.Type == JointType.Ball, "bodies, types");
                HingeJointDef def = new HingeJointDef();
                hinge.Get(def);
                Check.True(def.LimitEnabled && def.Upper == 0.5f && def.BodyA == post.Handle &&
                    def.BodyB == arm[1].Handle, "read back");
                def.MotorSpeed = 1;
                def.MotorMax = 5000; // four times what its weight needs
                hinge.Set(def);
                Run(world, 120);
                Check.Near(hinge.State.Angle, 0.5, 0.05, "the motor rotates it to the other limit");
                hinge.SetMotorSpeed(Dof.AngularX, -1);
                Run(world, 120);
                Check.Near(hinge.State.Angle, -0.5, 0.05, "and back");
                Check.Throws<WrongStateException>(() => ball.SetMotorSpeed(Dof.LinearX, 1), "fe_joint_set_motor_speed");
                JointDef common = new JointDef();
                slide.Get(common);
                common.UserData = 3;
                slide.Set(common);
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

        public static void Joints_end_in_the_world()
        {
            using (World world = new World(Vector3.Zero))
            {
                Vector3 z = new Vector3(0, 0, 1);
                Body door = world.CreateDynamic(new DVec3(1e6 + 1, 0, 0));
                door.AddBox(0.5f, 0.5f, 0.5f);
                Joint hinge = world.CreateHingeJoint(default(Body), door, new DVec3(1e6, 0, 0), z,
                    new HingeJointDef { SpringHertz = 4, Target = 1 });
                Body a, b;
                hinge.GetBodies(out a, out b);
                Check.True(a == default(Body) && b == door, "its ends");
                Run(world, 180);
                Check.Near(hinge.State.Angle, 1, 0.01, "the spring reaches its target");
                Check.Near(door.Position.X, 1e6 + Math.Cos(hinge.State.Angle), Slop, "on its circle");
                hinge.SetTarget(Dof.AngularX, -1);
                Run(world, 180);
                Check.Near(hinge.State.Angle, -1, 0.01, "another target");
                hinge.Destroy();

                BallJointDef def = world.MakeBallJoint(door, default(Body), door.Centre, z);
                def.SpringHertz = 4;
                Joint ball = world.CreateJoint(def);
                ball.SetTarget(new Quaternion((float)Math.Sin(0.4), 0, 0, (float)Math.Cos(0.4)));
                Run(world, 180);
                Check.Near(ball.State.Angle, 0.8, 0.01, "the ball's target");
                Check.Throws<BadArgumentException>(() => world.CreateFixedJoint(default(Body), default(Body),
                    new DVec3()), "body");
                FixedJointDef byHand = new FixedJointDef { BodyA = door, FrameA = new Frame(new Vector3(1, 0, 0)),
                    WorldOrigin = door.Position };
                Check.True(world.CreateJoint(byHand).IsValid, "a definition by hand");
            }
        }

        public static void Terrain_carries()
        {
            using (World world = new World())
            {
                float[] heights = new float[25];
                for (int i = 0; i < heights.Length; ++i) heights[i] = 2;
                Heightfield field = world.CreateHeightfield(new HeightfieldDef { Rows = 5, Columns = 5, CellX = 2,
                    CellZ = 2, Heights = heights });
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
                Check.Throws<BadArgumentException>(() => world.CreateHeightfield(new HeightfieldDef { Rows = 5,
                    Columns = 5, Heights = read }), "Heights");
                Check.Throws<BadArgumentException>(() => world.CreateHeightfield(null), "null");
                field.Destroy();
                Check.True(!field.IsValid && ball.IsValid, "the handle dies");
            }
        }

        static readonly Vector3[] Cube =
        {
            new Vector3(-1, -1, -1), new Vector3(1, -1, -1), new Vector3(-1, 1, -1), new Vector3(1, 1, -1),
            new Vector3(-1, -1, 1), new Vector3(1, -1, 1), new Vector3(-1, 1, 1), new Vector3(1, 1, 1),
        };

        public static void Hulls_fall_and_rest()
        {
            using (World world = new World())
            {
                world.CreateStatic(new DVec3()).AddPlane(0, 1, 0, 0);
                ConvexHull hull = world.CreateHull(Cube);
                HullInfo info = hull.Info;
                Check.True(info.VertexCount == 8 && info.EdgeCount == 12 && info.FaceCount == 6, "a cube");
                Check.Near(info.Volume, 8, 1e-5, "volume");
                Vector3[] vertices = new Vector3[8];
                HullFace[] faces = new HullFace[6];
                int[] corners = new int[24];
                Check.Same(hull.GetVertices(vertices), 8, "vertices");
                Check.Same(hull.GetFaces(faces), 6, "faces");
                Check.Same(hull.GetCorners(corners), 24, "corners");
                Check.True(vertices[7] == Cube[7] && faces[5].First == 20 && faces[5].Count == 4, "what they are");
                Check.Near(faces[0].Distance, 1, 1e-6, "distance");
                Body body = world.CreateDynamic(new DVec3(0, 2, 0));
                body.AddHull(hull);
                Body wheel = world.CreateDynamic(new DVec3(4, 1, 0)), cone = world.CreateDynamic(new DVec3(8, 1, 0));
                wheel.AddCylinder(0.25f, 0.5f);
                cone.AddCone(0.5f, 0.5f);
                Run(world, 120);
                Check.Near(body.Position.Y, 1, Slop, "rests on a side");
                Check.Near(wheel.Position.Y, 0.25, Slop, "a cylinder");
                Check.Near(cone.Position.Y, 0.5, Slop, "a cone");
                Shape scaled = world.CreateDynamic(new DVec3(12, 1, 0)).Add(Geometry.Hull(hull).Scaled(-1, 0.25f, 0.5f));
                Check.Same(scaled.Geometry.Scale, new Vector3(-1, 0.25f, 0.5f), "scale");
                Check.Near(scaled.Body.Mass, 1000, 0.01, "of a scaled hull");
                Run(world, 120);
                Check.Near(scaled.Body.Position.Y, 0.25, Slop, "a scaled hull");
                scaled.Geometry = Geometry.Hull(hull);
                Check.Same(scaled.Geometry.Scale, new Vector3(1, 1, 1), "unscaled");
                Check.Throws<BadArgumentException>(() => body.Add(Geometry.Hull(hull).Scaled(0, 1, 1)), "scale.x");
                Check.Throws<BadArgumentException>(() => body.Add(Geometry.Hull(hull).Scaled(1, float.NaN, 1)), "scale.y");
                Check.Throws<BadArgumentException>(() => body.Add(Geometry.Sphere(1).Scaled(2, 2, 2)), "sphere");
                Check.Throws<DegenerateException>(() => world.CreateHull(new Vector3[5]), "one place");
                Check.Throws<BadArgumentException>(() => world.CreateHull(new Vector3[3]), "point_count");
                Check.Throws<BadArgumentException>(() => world.CreateHull(Cube, 3), "max_vertices");
                hull.Destroy();
                Check.True(!hull.IsValid && body.IsValid, "the handle dies");
                Check.Throws<StaleHandleException>(() => { info = hull.Info; }, "hull");
                Check.Throws<StaleHandleException>(() => { info = default(ConvexHull).Info; }, "ConvexHull");
            }
        }

        public static void Meshes_carry()
        {
            using (World world = new World())
            {
                Vector3[] vertices = { new Vector3(-4, 0, -4), new Vector3(4, 0, -4), new Vector3(-4, 0, 4),
                    new Vector3(4, 0, 4) };
                SurfaceMaterial[] materials = { SurfaceMaterial.Default, SurfaceMaterial.Default };
                materials[1].UserId = 6;
                TriangleMesh mesh = world.CreateMesh(new MeshDef { Vertices = vertices,
                    Indices = new[] { 0, 2, 3, 0, 3, 1, 0, 0, 1 }, TriangleMaterials = new byte[] { 0, 1, 0 },
                    Materials = materials, TriangleData = new uint[] { 7, 8, 9 } });
                MeshInfo info = mesh.Info;
                Check.True(info.TriangleCount == 2 && info.DegenerateTriangles == 1 && info.OpenEdges == 4, "counts");
                Check.Near(info.Area, 64, 1e-9, "area");
                MeshTriangle triangle = mesh.GetTriangle(1);
                Check.True(triangle.Kept && triangle.Corner1 == vertices[3] && triangle.Material == 1 &&
                    triangle.Data == 8, "a triangle");
                Check.Same(triangle.Edge1, MeshEdgeFlags.Felt | MeshEdgeFlags.Open, "an edge");
                Check.True(!mesh.GetTriangle(2).Kept, "it has no area");
                world.CreateStatic(new DVec3()).AddMesh(mesh);
                Body ball = world.CreateDynamic(new DVec3(0.3, 2, 0.1));
                ball.AddSphere(0.5f);
                Run(world, 120);
                Check.Near(ball.Position.Y, 0.5, Slop, "rests on it");
                Hit hit;
                Check.True(world.Raycast(new DVec3(3, 3, -3), new DVec3(0, -10, 0), out hit), "a ray");
                Check.True(hit.Triangle == 1 && hit.Material == 6, "its triangle");
                materials[1].UserId = 11;
                mesh.SetMaterials(materials);
                Check.True(world.Raycast(new DVec3(3, 3, -3), new DVec3(0, -10, 0), out hit), "a ray");
                Check.Same(hit.Material, 11UL, "its material");
                Shape mirrored = world.CreateStatic(new DVec3(20, 0, 0)).Add(Geometry.Mesh(mesh).Scaled(-0.5f, 1, 0.5f));
                Check.Same(mirrored.Geometry.Scale, new Vector3(-0.5f, 1, 0.5f), "a mesh's scale");
                Check.True(world.Raycast(new DVec3(18.5, 3, -1.5), new DVec3(0, -10, 0), out hit), "of a scaled mesh");
                Check.True(hit.Shape == mirrored && hit.Triangle == 1 && hit.Normal.Y > 0.999f, "mirrored");
                Check.True(!world.Raycast(new DVec3(23, 3, 0), new DVec3(0, -10, 0), out hit), "half as wide");
                Check.True(world.CreateMesh(vertices, new[] { 0, 2, 3 }).Info.TriangleCount == 1, "in short");
                Check.Throws<UnsupportedException>(() => ball.AddMesh(mesh), "dynamic");
                Check.Throws<BadArgumentException>(() => world.CreateMesh(vertices, new[] { 0, 2, 4 }), "triangle 0");
                Check.Throws<BadArgumentException>(() => world.CreateMesh(vertices, new[] { 0, 2 }), "Indices");
                Check.Throws<BadArgumentException>(() => world.CreateMesh(null), "null");
                Check.Throws<BadArgumentException>(() => world.CreateMesh(null, new[] { 0, 2, 3 }), "null");
                Check.Throws<BadArgumentException>(() => mesh.SetMaterials(new SurfaceMaterial[1]), "count");
                Check.Throws<DegenerateException>(() => world.CreateMesh(new MeshDef { Vertices = vertices,
                    Indices = new[] { 0, 2, 3, 0, 0, 1 }, TwoSided = true, Strict = true }), "triangle 1");
                mesh.Destroy();
                Check.True(!mesh.IsValid, "the handle dies");
                Check.Throws<StaleHandleException>(() => mesh.GetTriangle(0), "mesh");
            }
        }

        static bool Equal(byte[] a, byte[] b) { return a.AsSpan().SequenceEqual(b); }

        // Balls of 0.5 m at x = -1 and 1, the second of ice and heavy, and a rod between them
        static Compound Dumbbell(World world)
        {
            SurfaceMaterial ice = new SurfaceMaterial { UserId = 5 };
            return world.CreateCompound(
                new CompoundPart(Geometry.Sphere(0.5f), new Vector3(-1, 0, 0)),
                new CompoundPart(Geometry.Sphere(0.5f), new Vector3(1, 0, 0)) { Density = 3000, UserData = 77 }
                    .WithMaterial(ice),
                new CompoundPart(Geometry.Cylinder(0.5f, 0.1f), new Vector3(), new Quaternion(0, 0, 2, 2)));
        }

        public static void Compounds_are_what_their_parts_are()
        {
            using (World world = new World())
            {
                Compound compound = Dumbbell(world);
                CompoundInfo info = compound.Info;
                Check.True(info.PartCount == 3 && info.Bytes > 0 && compound.Store == world.Store, "three parts");
                Check.Near((info.Lower - new Vector3(-1.5f, -0.5f, -0.5f)).Length(), 0, 1e-6, "lower corner");
                Check.Near((info.Upper - new Vector3(1.5f, 0.5f, 0.5f)).Length(), 0, 1e-6, "upper corner");
                CompoundPart part = compound.GetPart(1);
                Check.True(part.Geometry.Type == GeometryType.Sphere && part.Geometry.Radius == 0.5f, "its form");
                Check.True(part.Frame.Position == new Vector3(1, 0, 0) && part.Density == 3000, "where and how heavy");
                Check.True(part.OwnMaterial && part.Material.UserId == 5 && part.UserData == 77, "its own material");
                part = compound.GetPart(2);
                Check.True(!part.OwnMaterial && part.Density == -1, "those of the shape");
                Check.Near(part.Frame.Rotation.W, Math.Sqrt(0.5), 1e-6, "a rotation of length 1");
                Body body = world.CreateDynamic(new DVec3());
                Shape shape = body.AddCompound(compound, new ShapeDef { Density = 2000 });
                double ball = Math.PI / 6, rod = Math.PI * 0.01;
                Check.Near(body.Mass, 2000 * (ball + rod) + 3000 * ball, 0.01, "mass");
                Check.Same(shape.Geometry.Type, GeometryType.Compound, "type");
                Check.Same(shape.Geometry.Asset, compound.Handle, "asset");
                Span<CompoundPart> two = stackalloc CompoundPart[2];
                two[0] = compound.GetPart(0);
                two[1] = new CompoundPart(Geometry.Hull(world.CreateHull(Cube)).Scaled(1, -2, 1));
                Compound second = world.CreateCompound(two);
                byte[] saved = second.Save();
                Check.True(Equal(world.Store.LoadCompound(saved).Save(), saved), "as bytes, with its hull");
                Check.Throws<WrongKindException>(() => world.Store.LoadHull(saved), "another kind");
                Check.Same(second.GetPart(1).Geometry.Scale, new Vector3(1, -2, 1), "a scaled part");
                shape.Geometry = Geometry.Compound(second);
                Check.Near(body.Mass, 2000 * (ball + 16), 0.05, "another compound");
                second.Destroy();
                Check.True(!second.IsValid && compound.IsValid && second != compound, "the handle dies");
                Check.True(shape.Raycast(new DVec3(0, 0, 9), new DVec3(0, 0, -20), out Hit hit) && hit.Part == 1,
                    "its parts live");
            }
        }

        public static void Results_tell_the_part()
        {
            using (World world = new World())
            {
                Shape floor = world.CreateStatic(new DVec3(0, -9, 0)).AddCompound(Dumbbell(world));
                for (int part = 0; part < 3; ++part)
                {
                    DVec3 above = new DVec3(part == 2 ? 0 : 2 * part - 1, -5, 0);
                    Hit hit;
                    ClosestPoint closest;
                    Check.True(world.Raycast(above, new DVec3(0, -9, 0), out hit), "a ray");
                    Check.True(hit.Part == part && hit.Shape == floor.Handle && hit.Triangle == -1, "its part");
                    Check.Same(hit.Material, part == 1 ? 5ul : 0ul, "material");
                    Check.True(world.Sweep(Geometry.Sphere(0.05f), new WorldTransform(above), new DVec3(0, -9, 0),
                        out hit) && hit.Part == part, "a sweep");
                    Check.True(world.GetClosestPoint(new DVec3(above.X, -8.2, 0), 5, out closest) &&
                        closest.Part == part, "closest");
                }
                ShapeOverlap[] overlaps = new ShapeOverlap[2];
                Check.Same(world.OverlapShapes(Geometry.Sphere(0.25f), new WorldTransform(new DVec3(1, -8.5, 0)),
                    overlaps), 1, "an overlap");
                Check.True(overlaps[0].Part == 1 && overlaps[0].Material == 5, "the part of an overlap");

                Body body = world.CreateDynamic(new DVec3(50, 0.51, 0));
                world.CreateStatic(new DVec3(50, -1, 0)).AddBox(9, 1, 9);
                Shape shape = body.AddCompound(Dumbbell(world), new ShapeDef { Density = 3000,
                    Events = ShapeEvents.Touch | ShapeEvents.Hit });
                body.LinearVelocity = new Vector3(0, -4, 0);
                int enters = 0, hits = 0;
                for (int i = 0; i < 30; ++i)
                {
                    world.Step(Dt);
                    foreach (PairEvent e in world.PairEvents)
                    {
                        ++enters;
                        Check.True(e.Kind == EventKind.Enter && (e.ShapeA == shape.Handle ? e.PartA >= 0 && e.PartB == -1
                            : e.PartB >= 0 && e.PartA == -1), "part of an enter");
                    }
                    foreach (HitEvent e in world.HitEvents)
                    {
                        ++hits;
                        Check.True(Math.Max(e.PartA, e.PartB) < 2 && Math.Min(e.PartA, e.PartB) == -1, "of a hit");
                    }
                }
                Check.True(enters == 1 && hits > 0, "one enter of the shape");
                Contact[] contacts = new Contact[8];
                Check.Same(shape.GetContacts(contacts), 2, "a contact for each ball");
                int parts = 0;
                for (int i = 0; i < 2; ++i)
                {
                    bool first = contacts[i].ShapeA == shape.Handle;
                    int part = first ? contacts[i].PartA : contacts[i].PartB;
                    parts |= 1 << part;
                    Check.Same(first ? contacts[i].MaterialA : contacts[i].MaterialB, part == 1 ? 5ul : 0ul, "material");
                }
                Check.Same(parts, 3, "both balls");
                body.Position = new DVec3(50, 9, 0);
                world.Step(Dt);
                PairEvent last = world.PairEvents[0];
                Check.True(last.Kind == EventKind.Exit && last.PartA == -1 && last.PartB == -1, "an exit has none");
            }
        }

        static WorldTransform[] Table(bool compound)
        {
            CompoundPart[] parts =
            {
                new CompoundPart(Geometry.Box(1, 0.05f, 0.6f), new Vector3(0, 0.4f, 0)),
                new CompoundPart(Geometry.Cylinder(0.35f, 0.05f), new Vector3(-0.9f, 0, -0.5f)),
                new CompoundPart(Geometry.Sphere(0.35f), new Vector3(0.9f, 0, 0)),
                new CompoundPart(Geometry.Box(0.2f, 0.2f, 0.2f), new Vector3(0.9f, 0, 0.5f), new Quaternion(0, 0.1f, 0, 1)),
            };
            using (World world = new World())
            {
                Ground(world);
                BodyHandle[] bodies = new BodyHandle[4];
                for (int i = 0; i < bodies.Length; ++i)
                {
                    Body body = world.CreateDynamic(new DVec3(0.1 * i, 1 + 2 * i, 0));
                    body.Rotation = new Quaternion(0.1f, 0.2f, 0.3f, 1);
                    if (compound) body.AddCompound(world.CreateCompound(parts));
                    else foreach (CompoundPart part in parts) body.Add(part.Geometry, new ShapeDef { Frame = part.Frame });
                    bodies[i] = body;
                }
                Run(world, 100);
                WorldTransform[] poses = new WorldTransform[4];
                world.GetTransforms(bodies, poses);
                return poses;
            }
        }

        public static void A_compound_moves_as_single_shapes_do()
        {
            WorldTransform[] one = Table(true), many = Table(false);
            for (int i = 0; i < one.Length; ++i)
                Check.True(one[i].Position == many[i].Position && one[i].Rotation == many[i].Rotation, "body " + i);
        }

        public static void Wrong_parts_are_named()
        {
            using (World world = new World())
            using (Store other = new Store())
            {
                CompoundPart ball = new CompoundPart(Geometry.Sphere(0.5f)), wrong = ball;
                Action make = () => world.CreateCompound(ball, wrong);
                wrong.Density = -2;
                Check.Throws<BadArgumentException>(make, "parts[1]: density");
                wrong = new CompoundPart(Geometry.Sphere(0.5f), new Vector3(0, float.NaN, 0));
                Check.Throws<BadArgumentException>(make, "position.y");
                wrong = new CompoundPart(Geometry.Sphere(0.5f), new Vector3(), new Quaternion());
                Check.Throws<BadArgumentException>(make, "rotation");
                wrong = ball.WithMaterial(new SurfaceMaterial { StaticFriction = -1 });
                Check.Throws<BadArgumentException>(make, "static_friction");
                wrong = new CompoundPart(Geometry.Sphere(-1));
                Check.Throws<BadArgumentException>(make, "radius");
                wrong = default(CompoundPart);
                Check.Throws<BadArgumentException>(make, "parts[1]");
                wrong = new CompoundPart(Geometry.Plane(0, 1, 0, 0));
                Check.Throws<UnsupportedException>(make, "plane");
                Compound compound = world.CreateCompound(ball);
                wrong = new CompoundPart(Geometry.Compound(compound));
                Check.Throws<UnsupportedException>(make, "compound");
                wrong = new CompoundPart(Geometry.Hull(other.CreateHull(Cube)));
                Check.Throws<StaleHandleException>(make, "parts[1]");
                Check.Throws<BadArgumentException>(() => world.CreateCompound(), "count");
                Check.Throws<BadArgumentException>(() => world.CreateCompound(ReadOnlySpan<CompoundPart>.Empty), "count");
                Check.Throws<BadArgumentException>(() => world.CreateCompound(new CompoundPart[65536]), "count");
                Check.Throws<BadArgumentException>(() => world.CreateCompound((CompoundPart[])null), "null");
                Check.Throws<BadArgumentException>(() => compound.GetPart(1), "part");
                Check.Throws<BadArgumentException>(() => compound.GetPart(-1), "part");
                Body body = world.CreateDynamic(new DVec3());
                Check.Throws<UnsupportedException>(() => body.Add(Geometry.Compound(compound).Scaled(2, 2, 2)), "compound");
                Vector3[] corners = { new Vector3(-4, 0, -4), new Vector3(4, 0, -4), new Vector3(-4, 0, 4) };
                TriangleMesh mesh = world.CreateMesh(corners, new[] { 0, 2, 1 });
                Compound with = world.CreateCompound(ball, new CompoundPart(Geometry.Mesh(mesh)));
                Check.Throws<UnsupportedException>(() => body.AddCompound(with), "mesh");
                world.CreateStatic(new DVec3()).AddCompound(with);
                compound.Destroy();
                Check.Throws<StaleHandleException>(() => { CompoundInfo info = compound.Info; }, "compound");
                Check.Throws<StaleHandleException>(() => body.AddCompound(compound), "asset");
                Check.Throws<StaleHandleException>(() => default(Compound).GetPart(0), "Compound");
            }
        }

        public static void Saved_assets_return()
        {
            using (World world = new World())
            using (Store store = new Store())
            {
                Vector3[] corners = { new Vector3(-4, 0, -4), new Vector3(4, 0, -4), new Vector3(-4, 0, 4) };
                ConvexHull hull = world.CreateHull(Cube);
                TriangleMesh mesh = world.CreateMesh(corners, new[] { 0, 2, 1 });
                Heightfield field = world.Store.CreateHeightfield(new HeightfieldDef { Rows = 2, Columns = 2,
                    Heights = new float[] { 0, 1, 2, 3 } });
                byte[] saved = hull.Save();
                ConvexHull loaded = store.LoadHull(saved);
                Check.True(loaded.Store == store && Equal(loaded.Save(), saved), "a hull");
                Check.True(Equal(store.LoadMesh(mesh.Save()).Save(), mesh.Save()), "a mesh");
                Check.True(Equal(store.LoadHeightfield(field.Save()).Save(), field.Save()), "a heightfield");
                long before = store.Bytes;
                Check.Throws<WrongKindException>(() => store.LoadMesh(saved), "another kind");
                Check.Throws<BadDataException>(() => store.LoadHull(new byte[0]), "at byte 0");
                Check.Throws<BadDataException>(() => store.LoadHull(null), "at byte 0");
                Check.Throws<BadDataException>(() => store.LoadHull(saved.AsSpan(0, saved.Length - 8)), "wrote");
                saved[60] ^= 1;
                Check.Throws<BadDataException>(() => store.LoadHull(saved), "hash");
                Check.Same(store.Bytes, before, "nothing is left");
                hull.Destroy();
                Check.Throws<StaleHandleException>(() => hull.Save(), "asset");
                Check.Throws<StaleHandleException>(() => default(ConvexHull).Save(), "ConvexHull");
            }
        }

        public static void Worlds_share_a_store()
        {
            Store store = new Store(new StoreDef { Number = 77 });
            Heightfield field = store.CreateHeightfield(new HeightfieldDef { Rows = 5, Columns = 5, CellX = 2,
                CellZ = 2, Heights = new float[25] });
            World[] world = { new World(null, null, store), new World(null, null, store) };
            Body[] ball = new Body[2];
            for (int i = 0; i < 2; ++i)
            {
                Check.Same(world[i].Store, store, "its store");
                world[i].CreateStatic(new DVec3()).AddTerrain(field);
                ball[i] = world[i].CreateDynamic(new DVec3(3.5, 1, 3.25));
                ball[i].AddSphere(0.5f);
                Run(world[i], 120);
            }
            float[] raised = new float[25];
            for (int i = 0; i < 25; ++i) raised[i] = -1;
            field.SetHeights(0, 0, 5, 5, raised);
            foreach (World each in world) Run(each, 120);
            foreach (Body each in ball) Check.Near(each.Position.Y, -0.5, Slop, "both follow");
            Check.True(store.Bytes > 25 * 4, "bytes");
            using (World other = new World())
            {
                Check.True(other.Store != store && other.Store == other.Store, "a store of its own");
                Check.Throws<StaleHandleException>(() => other.CreateStatic(new DVec3()).AddTerrain(field), "asset");
                Check.Throws<BadArgumentException>(() => new World(null, null, other.Store), "store");
            }
            store.Dispose();
            Check.True(!field.IsValid, "disposed");
            HeightfieldDef none = new HeightfieldDef { Heights = new float[0] };
            Check.Throws<ObjectDisposedException>(() => store.CreateHeightfield(none), "");
            foreach (World each in world) Run(each, 10);
            Check.Near(ball[1].Position.Y, -0.5, Slop, "its worlds keep it");
            foreach (World each in world) each.Dispose();
            Store gone;
            using (World other = new World()) gone = other.Store;
            Check.Throws<ObjectDisposedException>(() => { long bytes = gone.Bytes; }, "");
        }

        // ---- what a world reports of itself ----

        public static void A_free_flight_keeps_energy_and_momentum()
        {
            using (World world = new World())
            {
                Body ball = world.CreateDynamic(new DVec3(1, 5, 0));
                ball.AddSphere(0.5f);
                double m = ball.Mass;
                ball.LinearVelocity = new Vector3(0, 6, 3);
                WorldEnergy before = world.Energy;
                // half m v^2; the potential energy half a substep back, at 5 m - v h / 2
                double h = 1.0 / 60 / 8;
                Check.Near(before.Kinetic, m * (36 + 9) / 2, 1e-5 * m * 45, "kinetic");
                Check.Near(before.Potential, m * 9.81 * 5, m * 9.81 * 6 * h, "potential");
                DVec3 linear, angular;
                world.GetMomentum(new DVec3(0, 5, 0), out linear, out angular);
                Check.Near(linear.Y, 6 * m, 1e-5 * m, "momentum");
                Check.Near(angular.Z, 6 * m, 1e-5 * m, "angular momentum: x cross v");
                Run(world, 60);
                WorldEnergy after = world.Energy;
                Check.Near(after.Kinetic + after.Potential, before.Kinetic + before.Potential, m * 9.81 * 6 * h,
                    "kept");
            }
        }

        public static void Bounds_enclose_the_shapes()
        {
            using (World world = new World())
            {
                Check.Throws<WrongStateException>(() => { WorldBounds none = world.Bounds; }, "fe_world_get_bounds");
                Body body = world.CreateDynamic(new DVec3(1e6, 0, 0));
                Shape box = body.AddBox(1, 2, 3), ball = body.AddSphere(1,
                    new ShapeDef { Frame = new Frame(new Vector3(0, 5, 0)) });
                const double margin = 0.25; // boxes of a moving body are fattened
                Check.Near(box.Bounds.Lower.Z, -3, margin, "shape");
                Check.Near(body.Bounds.Upper.Y, 6, margin, "body");
                Check.Near(world.Bounds.Lower.X, 1e6 - 1, margin, "world");
                Check.True(body.Bounds.Upper.Y >= 6 && world.Bounds.Lower.X <= 1e6 - 1, "they enclose");
                ShapeHandle[] found = new ShapeHandle[4];
                WorldBounds above = new WorldBounds { Lower = new DVec3(1e6 - 1, 4.5, -1),
                    Upper = new DVec3(1e6 + 1, 7, 1) };
                Check.Same(world.OverlapBounds(above, found), 1, "overlap bounds");
                Check.Same(world[found[0]], ball, "the ball");
                ShapeOverlap[] overlaps = new ShapeOverlap[4];
                Check.Same(world.OverlapShapes(Geometry.Sphere(1), new WorldTransform(new DVec3(1e6, 6.5, 0)),
                    overlaps), 1, "overlap shapes");
                Check.True(overlaps[0].Body == body.Handle && overlaps[0].Shape == ball.Handle, "who");
                Check.Near(overlaps[0].Depth, 0.5, 1e-4, "depth");
                Check.Near(overlaps[0].Direction.Y, 1, 1e-4, "direction");
            }
        }

        public static void A_trigger_knows_who_is_inside()
        {
            using (World world = new World(Vector3.Zero))
            {
                Shape zone = world.CreateStatic(new DVec3()).AddBox(1, 1, 1, new ShapeDef { Trigger = true });
                Shape ball = world.CreateDynamic(new DVec3()).AddSphere(0.5f);
                world.CreateDynamic(new DVec3(9, 0, 0)).AddSphere(0.5f);
                world.Step(Dt);
                ShapeHandle[] inside = new ShapeHandle[4];
                Check.Same(zone.GetOverlaps(inside), 1, "how many");
                Check.Same(world[inside[0]], ball, "who");
            }
        }

        public static void Materials_mix_as_they_say_and_are_reported()
        {
            using (World world = new World())
            {
                SurfaceMaterial ice = SurfaceMaterial.Default, rock = SurfaceMaterial.Default;
                ice.StaticFriction = ice.DynamicFriction = 0;
                ice.FrictionCombine = Combine.Minimum;
                ice.UserId = ulong.MaxValue;
                rock.StaticFriction = rock.DynamicFriction = 1;
                world.CreateStatic(new DVec3()).AddPlane(0, 1, 0, 0, new ShapeDef { Material = rock });
                Body puck = world.CreateDynamic(new DVec3(0, 0.5, 0));
                puck.AddBox(0.5f, 0.5f, 0.5f, new ShapeDef { Material = ice });
                puck.LinearVelocity = new Vector3(2, 0, 0);
                Run(world, 60);
                Check.Near(puck.LinearVelocity.X, 2, 1e-3, "nothing slows it");
                Hit hit;
                Check.True(world.Raycast(new DVec3(puck.Position.X, 3, 0), new DVec3(0, -5, 0), out hit),
                    "a ray hits it");
                Check.Same(hit.Material, ulong.MaxValue, "its material");
                Contact[] contacts = new Contact[1];
                Check.True(puck.GetContacts(contacts) == 1 && contacts[0].MaterialB == ulong.MaxValue &&
                    contacts[0].MaterialA == 0, "in contacts");
            }
        }

        public static void A_world_has_a_number()
        {
            using (World world = new World(new WorldDef { Number = 99, UserData = 5 }),
                twin = new World(new WorldDef { Number = 99 }), other = new World())
            {
                Check.True(world.Number == 99 && other.Number != 99 && world.UserData == 5, "numbers");
                Body body = world.CreateBody(), same = twin.CreateBody();
                other.CreateBody();
                Check.Same(twin[body.Handle].IsValid && twin[body.Handle] == same, true,
                    "equal numbers, equal handles");
                Check.Throws<StaleHandleException>(() => { DVec3 p = other[body.Handle].Position; }, "world");
                Body second = world.CreateBody();
                Check.True(!world.IsIgnored(body, second), "not ignored");
                world.IgnoreCollision(body, second);
                Check.True(world.IsIgnored(body, second) && world.IsIgnored(second, body), "ignored");
            }
        }

        public static void Records_print_their_fields()
        {
            Hit hit = new Hit { Body = new BodyHandle(0x12), Fraction = 0.5 };
            string start = "Hit { Body = Body 0x12, Shape = Shape 0x0, Point = (0, 0, 0), Fraction = 0.5, ";
            Check.True(hit.ToString().StartsWith(start), hit.ToString());
            Check.True(new HingeJointDef().ToString().Contains("SpringMax = 1E+15"), new HingeJointDef().ToString());
            Check.Same(new WorldTransform(new DVec3(1, 2.5,
                3)).ToString().StartsWith("WorldTransform { Position = (1, 2.5, 3), "), true, "a pose");
        }

        // ---- the pair filter ----

        public static void A_pair_filter_judges_pairs_and_its_exceptions_reach_the_caller_of_Step()
        {
            using (World world = new World())
            {
                Shape floor = Ground(world).World[FirstShape(world)];
                floor.PairFilter = true;
                Body ghost = world.CreateDynamic(new DVec3(0, 0.6, 0)), ball = world.CreateDynamic(new DVec3(4, 0.6,
                    0));
                ghost.UserData = 7;
                ghost.AddSphere(0.5f);
                ball.AddSphere(0.5f);
                int asked = 0;
                world.SetPairFilter(pair => { ++asked; return pair.BodyUserDataA != 7 && pair.BodyUserDataB != 7; });
                Run(world, 60);
                Check.Same(asked, 2, "once for each pair");
                Check.True(ghost.Position.Y < 0, "one falls through");
                Check.Near(ball.Position.Y, 0.5, Slop, "the other rests");
                ghost.Destroy(); // another filter would judge it anew

                Exception first = null;
                int thrown = 0;
                world.SetPairFilter(pair =>
                {
                    ++thrown;
                    if (thrown == 1) { DVec3 p = ball.Position; } // a call with this world
                    throw new InvalidOperationException("second");
                });
                Body[] more = new Body[2];
                for (int i = 0; i < 2; ++i)
                {
                    more[i] = world.CreateDynamic(new DVec3(8 + 4 * i, 0.6, 0));
                    more[i].AddSphere(0.5f);
                }
                try { Run(world, 60); }
                catch (FeatherException e) { first = e; }
                Check.True(first is WorldSteppingException && first.StackTrace.Contains("A_pair_filter"),
                    "the first exception: " + first);
                Check.Same(thrown, 2, "both pairs were judged");
                Run(world, 60);
                Check.Near(more[1].Position.Y, 0.5, Slop, "as if it had said yes");

                world.SetPairFilter(pair => { world.Dispose(); return true; });
                world.CreateDynamic(new DVec3(16, 0.6, 0)).AddSphere(0.5f);
                Check.Throws<WorldSteppingException>(() => Run(world, 60), "Dispose");
                world.SetPairFilter(pair => ball.IsValid && floor.IsValid);
                Body last = world.CreateDynamic(new DVec3(20, 0.6, 0));
                last.AddSphere(0.5f);
                Run(world, 60);
                Check.Near(last.Position.Y, 0.5, Slop, "what is valid may be asked");
                world.SetPairFilter(null);
                Run(world, 1);
            }
        }

        static ShapeHandle FirstShape(World world)
        {
            BodyHandle[] bodies = new BodyHandle[1];
            ShapeHandle[] shapes = new ShapeHandle[1];
            world.GetBodies(bodies);
            world[bodies[0]].GetShapes(shapes);
            return shapes[0];
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        static WeakReference Filtered()
        {
            World world = new World();
            world.SetPairFilter(pair => world.Number == 0);
            return new WeakReference(world);
        }

        public static void A_pair_filter_does_not_keep_its_world()
        {
            WeakReference lost = Filtered();
            for (int i = 0; i < 10 && lost.IsAlive; ++i)
            {
                GC.Collect();
                GC.WaitForPendingFinalizers();
            }
            // mono scans stacks conservatively: there it may be found by chance
            Check.True(!lost.IsAlive || Type.GetType("Mono.Runtime") != null, "freed");
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
                Check.True(world.Raycast(from, way, out hit, filter) && world[hit.Body] == ball[1],
                    "the first but one");
                Check.True(world.RaycastAny(from, way) && !world.RaycastAny(from, new DVec3(0, 0, 1)), "any");
                Hit[] hits = new Hit[8];
                Check.Same(world.RaycastAll(from, way, hits), 3, "all");
                Check.True(hits[0].Fraction < hits[1].Fraction && hits[1].Fraction < hits[2].Fraction, "in order");
                Ray[] rays = { new Ray { Origin = from, Translation = way },
                    new Ray { Origin = from, Translation = new DVec3(0, 9, 0) } };
                Check.Same(world.RaycastMany(rays, hits, null, true), 1, "many");
                Check.True(hits[1].Body.Value == 0 && hits[1].Fraction == 1, "a miss");
                Geometry probe = Geometry.Sphere(0.5f);
                Check.True(world.Sweep(probe, new WorldTransform(from), way, out hit) && world[hit.Body] == ball[0],
                    "sweep");
                Check.Near(hit.Fraction, 3.5 / 20, 1e-6, "where the sweep stops");
                Check.Same(world.SweepAll(probe, new WorldTransform(from), way, hits), 3, "sweep all");
                Check.True(world.SweepAny(probe, new WorldTransform(from), way), "sweep any");
                SweepPath[] paths = { new SweepPath { Start = new WorldTransform(from), Translation = way } };
                Check.Same(world.SweepMany(probe, paths, hits), 1, "sweep many");
                Geometry rod = Geometry.Box(6, 0.1f, 0.1f);
                Vector3 turn = new Vector3(0, 6.2831853f, 0);
                WorldTransform beside = new WorldTransform(new DVec3(from.X, from.Y, from.Z));
                DVec3 nowhere = new DVec3(0, 0, 0);
                Check.True(!world.Sweep(rod, beside, nowhere, out hit), "a rod beside");
                Check.True(world.SweepTurning(rod, beside, nowhere, turn, out hit) && hit.Fraction > 0 &&
                    hit.Fraction < 0.5, "a rod turns");
                Check.True(world.SweepTurningAny(rod, beside, nowhere, turn), "any that a rod meets");
                Check.True(world.SweepTurningAll(rod, beside, nowhere, turn, hits) >= 1, "all that a rod meets");
                SweepPath[] turning = { new SweepPath { Start = beside, Turn = turn } };
                Hit[] same = new Hit[1];
                Check.Same(world.SweepMany(rod, turning, same), 1, "many that a rod meets");
                Check.Same(same[0].Fraction, hit.Fraction, "the same stop");
                BodyHandle[] inside = new BodyHandle[4];
                Check.Same(world.Overlap(Geometry.Box(5, 5, 5), new WorldTransform(new DVec3(0, 0, 0)), inside), 2,
                    "overlap");
                Check.True(inside[0] == ball[0].Handle && inside[1] == ball[1].Handle, "in the order of creation");
                Check.True(!world.OverlapAny(probe, new WorldTransform(new DVec3(9, 9, 9))), "overlap none");
                ClosestPoint closest;
                Check.True(world.GetClosestPoint(new DVec3(0, 3, 0), 5, out closest), "closest");
                Check.Near(closest.Distance, 2, 1e-6, "distance");
                Check.True(!world.GetClosestPoint(new DVec3(0, 30, 0), 5, out closest), "none near");
                Check.True(ball[2].Raycast(from, way, out hit) && !ball[2].Raycast(from, new DVec3(0, 9, 0), out hit),
                    "one body");
                Check.True(ball[2].GetClosestPoint(from, out closest), "closest of one");
                ShapeHandle[] shape = new ShapeHandle[1];
                ball[1].GetShapes(shape);
                Check.True(world[shape[0]].Raycast(from, way, out hit) &&
                    world[shape[0]].GetClosestPoint(from, out closest), "one shape");
            }
        }

        public static void Many_joints_at_once_are_as_one_by_one()
        {
            using (World world = new World(), other = new World())
            {
                JointHandle[] joints = ChainOfHinges(world), alone = ChainOfHinges(other);
                float[] speeds = { 1, -2, 3 }, targets = { 0.1f, 0.2f, -0.3f }, coordinates = new float[6];
                world.SetJointMotorSpeeds(joints, speeds);
                world.SetJointTargets(joints, targets);
                world.AddJointForces(joints, speeds);
                world.AddJointForces(joints, new float[3]);
                for (int i = 0; i < 3; ++i)
                {
                    other[alone[i]].SetMotorSpeed(Dof.AngularX, speeds[i]);
                    other[alone[i]].SetTarget(Dof.AngularX, targets[i]);
                }
                other.AddJointForces(alone, speeds);
                world.Step(Dt);
                other.Step(Dt);
                Check.Same(world.Hash, other.Hash, "hash");
                world.GetJointCoordinates(joints, coordinates);
                LinearAngular[] reactions = new LinearAngular[3];
                world.GetJointReactions(joints, reactions);
                for (int i = 0; i < 3; ++i)
                {
                    JointState state = world[joints[i]].State;
                    Check.Same(coordinates[2 * i], state.Angle, "angle");
                    Check.Same(coordinates[2 * i + 1], state.AngularVelocity.X, "rate");
                    Vector3 force, torque;
                    world[joints[i]].GetReaction(out force, out torque);
                    Check.Same(reactions[i].Linear, force, "force");
                    Check.Same(reactions[i].Angular, torque, "torque");
                }
                Check.Throws<BadArgumentException>(() => world.GetJointCoordinates(joints, new float[5]),
                    "coordinates has 5");
                Check.Throws<BadArgumentException>(() => world.SetJointTargets(joints, new float[2]), "targets has 2");
                targets[1] = float.NaN;
                Check.Throws<BadArgumentException>(() => world.SetJointTargets(joints, targets), "values[1]");
            }
        }

        private static JointHandle[] ChainOfHinges(World world)
        {
            JointHandle[] joints = new JointHandle[3];
            Body last = world.CreateBody(new BodyDef { Type = BodyType.Static });
            for (int i = 0; i < 3; ++i)
            {
                Body next = world.CreateBody(new BodyDef { Position = new DVec3(i + 1, 0, 0) });
                next.AddBox(0.4f, 0.1f, 0.1f);
                joints[i] = world.CreateHingeJoint(last, next, new DVec3(i + 0.5, 0, 0), Vector3.UnitZ,
                    new HingeJointDef { MotorMax = 50, SpringHertz = 2 });
                last = next;
            }
            return joints;
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
                for (int i = 0; i < 50; ++i) velocities[i] = new LinearAngular(new Vector3(0, i, 0),
                    new Vector3(i, 0, 0));
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
                Check.Throws<BadArgumentException>(() => world.GetTransforms(bodies, new WorldTransform[49]),
                    "transforms has 49");
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
            Check.Throws<ObjectDisposedException>(() => { Hit hit; world.Raycast(new DVec3(), new DVec3(), out hit); },
                "disposed");
            Check.Throws<ObjectDisposedException>(() => { int n = world.PairEvents.Length; }, "disposed");
        }

        // A thread may read the world's pointer and be halted there, another disposes, the first goes on. Here the
        // pointer is put back by reflection, and new worlds take whatever memory was freed.
        public static void A_call_that_begins_as_its_world_goes_is_refused()
        {
            FieldInfo field = typeof(World).GetField("pointer", BindingFlags.Instance | BindingFlags.NonPublic);
            World world = new World();
            Body body = world.CreateDynamic(new DVec3());
            object pointer = field.GetValue(world);
            world.Dispose();
            World[] others = new World[50];
            for (int i = 0; i < others.Length; ++i) others[i] = new World();
            field.SetValue(world, pointer);
            Check.Throws<WorldBusyException>(() => { Vector3 g = world.Gravity; }, "fe_world_get_gravity");
            Check.Throws<WorldBusyException>(() => world.Substeps = 4, "fe_world_set_substeps");
            Check.Throws<WorldBusyException>(() => { DVec3 p = body.Position; }, "fe_body_get_transform");
            Check.Throws<WorldBusyException>(() => world.Step(Dt), "fe_world_step");
            world.Dispose();
            foreach (World other in others) other.Dispose();
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
                BodyHandle wrong = new BodyHandle(shape.Handle.Value);
                Check.Throws<WrongKindException>(() => { DVec3 p = world[wrong].Position; }, "shape");
                Check.Throws<StaleHandleException>(() => { DVec3 p = default(Body).Position; }, "no world");
                Check.Throws<StaleHandleException>(() => default(Shape).Destroy(), "no world");
                Check.Throws<StaleHandleException>(() => default(Joint).Destroy(), "no world");
                Check.Throws<StaleHandleException>(() => world.IgnoreCollision(body, foreign), "another world");
                Check.Throws<StaleHandleException>(() => world.CreateHingeJoint(foreign, body, new DVec3(),
                    new Vector3(1, 0, 0)), "another world");
                Check.Throws<StaleHandleException>(() => world.CreateFixedJoint(body, gone, new DVec3()), "destroyed");
                Check.Throws<BadArgumentException>(() => world.Step(float.NaN), "dt");
                Check.Throws<BadArgumentException>(() => world.Step(2), "dt");
                Check.Throws<BadArgumentException>(() => body.Position = new DVec3(double.NaN, 0, 0), "transform");
                Check.Throws<BadArgumentException>(() => body.AddSphere(-1), "radius");
                Check.Throws<BadArgumentException>(() => body.LinearVelocity = new Vector3(0, float.PositiveInfinity,
                    0), "velocity");
                Check.Throws<BadArgumentException>(() => world.CreateBody(new BodyDef { Position = new DVec3(0,
                    double.NaN, 0) }), "transform");
                Check.Throws<BadArgumentException>(() => world.Tuning = null, "null");
                Check.Throws<BadArgumentException>(() => world.CreateJoint((HingeJointDef)null), "null");
                Check.Throws<UnsupportedException>(() => body.AddPlane(0, 1, 0, 0), "plane");
                Check.Throws<WrongStateException>(() => body.SetTarget(new WorldTransform(new DVec3()), 1),
                    "kinematic");
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
            Check.Throws<ObjectDisposedException>(() => new World(null, pool), "pool");
            a.CreateDynamic(new DVec3()).AddSphere(1);
            Run(a, 3);
            Check.Same(b.Counters.Workers, 3, "workers");
            a.Dispose();
            b.Step(Dt);
            b.Dispose();
        }

        public static void Positions_convert_where_you_say_so()
        {
            DVec3 far = new DVec3(1e8, 2, 3);
            Check.Same((Vector3)far, new Vector3(1e8f, 2, 3), "to float");
            Check.Same((DVec3)new Vector3(1, 2, 3), new DVec3(1, 2, 3), "to double");
            Check.Same(far.RelativeTo(new DVec3(1e8 - 0.25, 0, 0)).X, 0.25f, "from an origin");
            Check.True(far + new Vector3(1, 0, 0) - new Vector3(1, 0, 0) == far && far * 2 != far &&
                new DVec3(3, 4, 0).Length == 5, "sums");
            Check.True(far.Equals((object)far) && far.GetHashCode() == new DVec3(1e8, 2, 3).GetHashCode(), "equal");
        }

        // ---- the generated code ----

        static readonly Dictionary<string, string> Names = new Dictionary<string, string>
        {
            { "fe_material", "SurfaceMaterial" }, { "fe_bounds", "WorldBounds" }, { "fe_energy", "WorldEnergy" },
            { "fe_profile", "StepProfile" }, { "fe_counters", "WorldCounters" }, { "fe_path", "SweepPath" },
            { "fe_closest", "ClosestPoint" }, { "fe_overlap", "ShapeOverlap" }, { "fe_transform", "WorldTransform" },
            { "fe_dvec3", "DVec3" }, { "fe_query_filter", "NativeFilter" }, { "fe_heightfield_def",
                "NativeHeightfield" },
            { "fe_hull_def", "NativeHull" }, { "fe_mesh_def", "NativeMesh" },
            { "fe_save_options", "NativeSaveOptions" }, { "fe_restore_options", "NativeRestoreOptions" },
            { "fe_difference", "NativeDifference" }, { "fe_array", "NativeBatchArray" },
            { "fe_note", "NativeNote" }, { "fe_divergence", "NativeDivergence" },
        };

        static string Pascal(string name)
        {
            string made = "";
            foreach (string part in name.Split('_'))
                made += char.ToUpperInvariant(part[0]) + part.Substring(1).ToLowerInvariant();
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
            foreach (Match m in Regex.Matches(File.ReadAllText(Path.Combine(Root, "tests/abi/layout.h")),
                @"FE_(SIZE|OFFSET)\((\w+), (?:(\w+), )?(\d+)\)"))
            {
                string record = m.Groups[2].Value, field = m.Groups[3].Value;
                int value = int.Parse(m.Groups[4].Value);
                if (record == "fe_vec3" || record == "fe_quat" || record == "fe_allocator" ||
                    record == "fe_task_system") continue; // for hosts in C
                Type type = Find(record);
                Check.True(type != null, record + " has no type");
                if (m.Groups[1].Value == "SIZE")
                {
                    Check.Same(Marshal.SizeOf(type), value, "size of " + record);
                    ++sizes;
                    continue;
                }
                string name = field == "axes" ? "LinearX" : Pascal(field);
                if (type.GetField(name, any) == null) name = name.TrimEnd('s') + "0"; // of an array
                Check.True(type.GetField(name, any) != null, record + "." + field + " has no field");
                Check.Same((int)Marshal.OffsetOf(type, name), value, "offset of " + record + "." + field);
                ++fields;
            }
            Check.True(sizes >= 30 && fields >= 200, "all of the header: " + sizes + " records, " + fields + " fields");
        }

        public static void Every_function_is_in_the_flat_module()
        {
            string flat = File.ReadAllText(Path.Combine(Generated, "source/Native.cs"));
            string layer = "", shell = File.ReadAllText(Path.Combine(Root, "bindings/csharp/shell.h"));
            foreach (string file in Directory.GetFiles(Path.Combine(Generated, "source"), "*.cs"))
                if (!Path.GetFileName(file).StartsWith("Native")) layer += File.ReadAllText(file);
            int count = 0;
            foreach (Match m in Regex.Matches(File.ReadAllText(Path.Combine(Root, "include/feather.h")),
                @"^FE_API [^;]*?\bfe_(\w+)\(", RegexOptions.Multiline))
            {
                string name = m.Groups[1].Value;
                if (name == "allocator_init" || name == "task_system_init") continue; // for hosts in C
                Check.True(flat.Contains(" " + name + "("), "fe_" + name + " is missing");
                if (!Regex.IsMatch(layer, @"Native(PINVOKE)?\." + name + @"\(") && name != "result_name" &&
                    name != "player_release" && // a clone goes on
                    !shell.Contains(" fe_" + name + "(") && !name.EndsWith("_init")) Console.WriteLine("note: nothing above Native calls fe_" + name);
                ++count;
            }
            Check.True(count > 150, "functions: " + count);
        }

        public static void Native_calls_are_in_generated_code_only()
        {
            Regex native = new Regex(@"\[\s*(DllImport|LibraryImport)|GetDelegateForFunctionPointer|delegate\*");
            foreach (string file in Directory.GetFiles(Path.Combine(Root, "bindings/csharp/FeatherPhysics"), "*.cs"))
                Check.True(!native.IsMatch(File.ReadAllText(file)), file + " calls native code by itself");
            string generated = File.ReadAllText(Path.Combine(Generated, "source/NativePINVOKE.cs"));
            generated = generated.Replace("global::System.Runtime.InteropServices.", "");
            Check.True(native.IsMatch(generated), "the pattern finds them");
        }
    }
}
