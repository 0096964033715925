// A world: settings, bodies, the step, what is read after it. WorldLife.cs has its life, WorldFilter.cs its pair
// filter, WorldJoints.cs its joints, WorldQueries.cs its queries, WorldSnapshot.cs its snapshots.
using System;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    /// <summary>
    /// Everything that can touch each other. One thread at a time writes, any number read while none does.
    /// </summary>
    public sealed unsafe partial class World
    {
        /// <summary>The library's version, major &lt;&lt; 16 | minor &lt;&lt; 8 | patch.</summary>
        public static uint Version { get { return Native.version(); } }

        // ---- settings ----

        /// <summary>m/s2. A change wakes all dynamic bodies.</summary>
        public Vector3 Gravity
        {
            get { Vector3 value; Native.world_get_gravity(P, &value); GC.KeepAlive(this); return value; }
            set { Native.world_set_gravity(P, &value); GC.KeepAlive(this); }
        }
        /// <summary>1..64.</summary>
        public int Substeps
        {
            get { int value; Native.world_get_substeps(P, &value); GC.KeepAlive(this); return value; }
            set { Native.world_set_substeps(P, value); GC.KeepAlive(this); }
        }
        /// <summary>A number of yours.</summary>
        public ulong UserData
        {
            get { ulong value; Native.world_get_user_data(P, &value); GC.KeepAlive(this); return value; }
            set { Native.world_set_user_data(P, value); GC.KeepAlive(this); }
        }
        /// <summary>The number in this world's handles, 1..4095; see <see cref="WorldDef.Number"/>.</summary>
        public uint Number
        {
            get { uint value; Native.world_get_number(P, &value); GC.KeepAlive(this); return value; }
        }
        /// <summary>How the solver behaves: a copy; set it to change it.</summary>
        public WorldTuning Tuning
        {
            get
            {
                WorldTuning value = new WorldTuning();
                fixed (uint* start = &value.StructSize) Native.world_get_tuning(P, start);
                GC.KeepAlive(this);
                return value;
            }
            set
            {
                NotNull(value, "World.Tuning");
                fixed (uint* start = &value.StructSize) Native.world_set_tuning(P, start);
                GC.KeepAlive(this);
            }
        }
        /// <summary>The stiffness that a step of dt seconds would really use, 1/s.</summary>
        /// <param name="dt">0..1 s; 0, and less than 1e-5 s: no limit</param>
        public void GetHertz(float dt, out float contactHertz, out float jointHertz)
        {
            float c, j;
            Native.world_get_hertz(P, dt, &c, &j);
            GC.KeepAlive(this);
            contactHertz = c;
            jointHertz = j;
        }
        /// <summary>While ignored, two bodies never collide, whatever their layers and groups.</summary>
        public void IgnoreCollision(Body a, Body b, bool ignore = true)
        {
            Mine(a, "World.IgnoreCollision");
            Mine(b, "World.IgnoreCollision");
            Native.world_ignore_collision(P, a.Handle.Value, b.Handle.Value, ignore ? 1 : 0);
            GC.KeepAlive(this);
        }
        /// <summary>Does <see cref="IgnoreCollision"/> keep the two apart?</summary>
        public bool IsIgnored(Body a, Body b)
        {
            Mine(a, "World.IsIgnored");
            Mine(b, "World.IsIgnored");
            int value;
            Native.world_get_ignored(P, a.Handle.Value, b.Handle.Value, &value);
            GC.KeepAlive(this);
            return value != 0;
        }
        /// <summary>
        /// Rebalances the trees that serve the queries. Worth a call after a level is loaded. Results never need it.
        /// </summary>
        public void Optimize() { Native.world_optimize(P); GC.KeepAlive(this); }

        // ---- bodies ----

        /// <param name="def">null: a dynamic body at the origin</param>
        public Body CreateBody(BodyDef def = null)
        {
            ulong made;
            if (def == null) Native.body_create(P, null, &made);
            else fixed (uint* start = &def.StructSize) Native.body_create(P, start, &made);
            GC.KeepAlive(this);
            return new Body(this, made);
        }
        /// <summary>A body that never moves by itself.</summary>
        public Body CreateStatic(DVec3 position)
        {
            return CreateBody(new BodyDef { Type = BodyType.Static, Position = position });
        }
        /// <summary>A body that moves by forces and contacts.</summary>
        public Body CreateDynamic(DVec3 position) { return CreateBody(new BodyDef { Position = position }); }
        /// <summary>A body that moves by its velocities, which nothing else changes.</summary>
        public Body CreateKinematic(DVec3 position)
        {
            return CreateBody(new BodyDef { Type = BodyType.Kinematic, Position = position });
        }

        /// <summary>A body of one definition at each place: all or none.</summary>
        public void CreateBodies(BodyDef def, ReadOnlySpan<WorldTransform> at, Span<BodyHandle> made)
        {
            NotNull(def, "World.CreateBodies");
            CheckLength(at.Length, made.Length, "World.CreateBodies", "made");
            long size = BodyDef.Size;
            byte* copies = (byte*)Marshal.AllocHGlobal(new IntPtr(Math.Max(1, at.Length) * size));
            try
            {
                fixed (uint* start = &def.StructSize)
                fixed (WorldTransform* place = &def.Transform)
                {
                    long offset = (byte*)place - (byte*)start;
                    for (int i = 0; i < at.Length; ++i)
                    {
                        Buffer.MemoryCopy(start, copies + i * size, size, size);
                        *(WorldTransform*)(copies + i * size + offset) = at[i];
                    }
                }
                fixed (BodyHandle* out_ = &MemoryMarshal.GetReference(made))
                    Native.body_create_many(P, copies, (uint)size, at.Length, out_);
            }
            finally { Marshal.FreeHGlobal((IntPtr)copies); }
            GC.KeepAlive(this);
        }
        /// <summary>All or none.</summary>
        public void DestroyBodies(ReadOnlySpan<BodyHandle> bodies)
        {
            fixed (BodyHandle* start = &MemoryMarshal.GetReference(bodies))
                Native.body_destroy_many(P, start, bodies.Length);
            GC.KeepAlive(this);
        }

        /// <summary>The body of a handle, as events and hits have it.</summary>
        public Body this[BodyHandle handle] { get { return new Body(this, handle.Value); } }
        /// <summary>The shape of a handle.</summary>
        public Shape this[ShapeHandle handle] { get { return new Shape(this, handle.Value); } }
        /// <summary>The joint of a handle.</summary>
        public Joint this[JointHandle handle] { get { return new Joint(this, handle.Value); } }

        /// <summary>Writes all bodies in the order of creation and returns how many there are.</summary>
        public int GetBodies(Span<BodyHandle> bodies)
        {
            fixed (BodyHandle* out_ = &MemoryMarshal.GetReference(bodies))
            {
                int count = Native.world_get_bodies(P, out_, bodies.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>Writes all joints in the order of creation and returns how many there are.</summary>
        public int GetJoints(Span<JointHandle> joints)
        {
            fixed (JointHandle* out_ = &MemoryMarshal.GetReference(joints))
            {
                int count = Native.world_get_joints(P, out_, joints.Length);
                GC.KeepAlive(this);
                return count;
            }
        }

        // ---- heightfields ----

        Store store; // null until somebody asks for the world's own

        /// <summary>
        /// The store of its assets: the one that it was made with, or its own, which goes with the world.
        /// </summary>
        public Store Store
        {
            get
            {
                if (store != null)
                {
                    if (IsDisposed) ThrowDisposed();
                    return store;
                }
                IntPtr own;
                Native.world_get_store(P, &own);
                GC.KeepAlive(this);
                System.Threading.Interlocked.CompareExchange(ref store, new Store(this, own), null);
                return store;
            }
        }
        /// <summary>Terrain in <see cref="Store"/>: <c>body.AddTerrain(field)</c>.</summary>
        public Heightfield CreateHeightfield(HeightfieldDef def) { return Store.CreateHeightfield(def); }
        /// <summary>In this world's store, see <see cref="FeatherPhysics.Store.CreateHull"/>.</summary>
        public ConvexHull CreateHull(ReadOnlySpan<Vector3> points, int maxVertices = 64, float tolerance = 0)
        {
            return Store.CreateHull(points, maxVertices, tolerance);
        }
        /// <summary>In this world's store, see <see cref="FeatherPhysics.Store.CreateMesh(MeshDef)"/>.</summary>
        public TriangleMesh CreateMesh(MeshDef def) { return Store.CreateMesh(def); }
        /// <summary>Three indices a triangle; all else as <see cref="MeshDef"/> begins.</summary>
        public TriangleMesh CreateMesh(Vector3[] vertices, int[] indices)
        {
            return Store.CreateMesh(vertices, indices);
        }
        /// <summary>
        /// In this world's store, see <see cref="FeatherPhysics.Store.CreateCompound(ReadOnlySpan{CompoundPart})"/>.
        /// </summary>
        public Compound CreateCompound(ReadOnlySpan<CompoundPart> parts) { return Store.CreateCompound(parts); }
        /// <summary>The same of parts one by one.</summary>
        public Compound CreateCompound(params CompoundPart[] parts) { return Store.CreateCompound(parts); }

        // ---- the step, and what is read after it ----

        /// <summary>Moves the world on by dt seconds, 0..1. 0 updates contacts and events and moves nothing;
        /// less than 1e-5 counts as 0.</summary>
        public void Step(float dt)
        {
            Native.world_step(P, dt);
            Recording current = recording;
            if (current != null) current.AfterStep();
            GC.KeepAlive(this);
            ExceptionDispatchInfo first = TakeThrown();
            if (first != null) first.Throw();
        }

        PairEvent[] pairEvents = new PairEvent[64];
        BodyEvent[] bodyEvents = new BodyEvent[64];
        HitEvent[] hitEvents = new HitEvent[64];
        JointEvent[] jointEvents = new JointEvent[16];

        // The getters read the field once: another thread may make a longer array of it at any time.

        /// A longer array when so many did not fit; they are then read again.
        static bool Grows<T>(ref T[] events, T[] read, int count)
        {
            if (count <= read.Length) return false;
            events = new T[count + count / 2];
            return true;
        }
        ReadOnlySpan<T> Events<T>(T[] events, int count)
        {
            GC.KeepAlive(this);
            return new ReadOnlySpan<T>(events, 0, count);
        }

        /// <summary>
        /// Shapes that began or ceased to touch in the last step. Valid until the next read of this property.
        /// </summary>
        public ReadOnlySpan<PairEvent> PairEvents
        {
            get
            {
                int count;
                PairEvent[] into;
                do
                {
                    into = pairEvents;
                    fixed (PairEvent* start = into)
                        count = Native.world_get_pair_events(P, start, (uint)sizeof(PairEvent), into.Length);
                }
                while (Grows(ref pairEvents, into, count));
                return Events(into, count);
            }
        }
        /// <summary>Bodies that fell asleep or woke in the last step, and by calls before it.</summary>
        public ReadOnlySpan<BodyEvent> BodyEvents
        {
            get
            {
                int count;
                BodyEvent[] into;
                do
                {
                    into = bodyEvents;
                    fixed (BodyEvent* start = into)
                        count = Native.world_get_body_events(P, start, (uint)sizeof(BodyEvent), into.Length);
                }
                while (Grows(ref bodyEvents, into, count));
                return Events(into, count);
            }
        }
        /// <summary>Impacts of the last step on shapes that ask for them.</summary>
        public ReadOnlySpan<HitEvent> HitEvents
        {
            get
            {
                int count;
                HitEvent[] into;
                do
                {
                    into = hitEvents;
                    fixed (HitEvent* start = into)
                        count = Native.world_get_hit_events(P, start, (uint)sizeof(HitEvent), into.Length);
                }
                while (Grows(ref hitEvents, into, count));
                return Events(into, count);
            }
        }
        /// <summary>Joints that broke in the last step.</summary>
        public ReadOnlySpan<JointEvent> JointEvents
        {
            get
            {
                int count;
                JointEvent[] into;
                do
                {
                    into = jointEvents;
                    fixed (JointEvent* start = into)
                        count = Native.world_get_joint_events(P, start, (uint)sizeof(JointEvent), into.Length);
                }
                while (Grows(ref jointEvents, into, count));
                return Events(into, count);
            }
        }

        /// <summary>Where the last step's time went, ms.</summary>
        public StepProfile Profile
        {
            get
            {
                StepProfile value = default(StepProfile);
                value.StructSize = (uint)sizeof(StepProfile);
                Native.world_get_profile(P, &value);
                GC.KeepAlive(this);
                return value;
            }
        }
        /// <summary>Sizes of the world now, and of what its last step did.</summary>
        public WorldCounters Counters
        {
            get
            {
                WorldCounters value = default(WorldCounters);
                value.StructSize = (uint)sizeof(WorldCounters);
                Native.world_get_counters(P, &value);
                GC.KeepAlive(this);
                return value;
            }
        }
        /// <summary>64 bits over everything: equal for equal runs, on every machine.</summary>
        public ulong Hash
        {
            get
            {
                uint* words = stackalloc uint[2];
                Native.world_hash(P, words);
                GC.KeepAlive(this);
                return (ulong)words[1] << 32 | words[0];
            }
        }

        /// <summary>The box around all shapes but planes. WrongStateException when there is none.</summary>
        public WorldBounds Bounds
        {
            get { WorldBounds value; Native.world_get_bounds(P, &value); GC.KeepAlive(this); return value; }
        }
        /// <summary>
        /// Of all enabled dynamic bodies, in the discrete flight: what a free flight keeps to rounding.
        /// </summary>
        public WorldEnergy Energy
        {
            get
            {
                WorldEnergy value = default(WorldEnergy);
                value.StructSize = (uint)sizeof(WorldEnergy);
                Native.world_get_energy(P, &value);
                GC.KeepAlive(this);
                return value;
            }
        }
        /// <summary>Of all enabled dynamic bodies.</summary>
        /// <param name="about">the point that the angular momentum is taken about, m</param>
        /// <param name="linear">N s</param>
        /// <param name="angular">N m s</param>
        public void GetMomentum(DVec3 about, out DVec3 linear, out DVec3 angular)
        {
            DVec3 l, a;
            Native.world_get_momentum(P, &about, &l, &a);
            GC.KeepAlive(this);
            linear = l;
            angular = a;
        }

        // ---- many bodies at once ----

        /// <summary>The bodies that the last step moved and where they are now; returns how many.</summary>
        public int GetMoved(Span<BodyHandle> bodies, Span<WorldTransform> transforms)
        {
            CheckLength(bodies.Length, transforms.Length, "World.GetMoved", "transforms");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (WorldTransform* t = &MemoryMarshal.GetReference(transforms))
            {
                int count = Native.world_get_moved(P, b, t, 0, bodies.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>All or none, as all the calls below.</summary>
        public void GetTransforms(ReadOnlySpan<BodyHandle> bodies, Span<WorldTransform> transforms)
        {
            CheckLength(bodies.Length, transforms.Length, "World.GetTransforms", "transforms");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (WorldTransform* t = &MemoryMarshal.GetReference(transforms))
                Native.world_get_transforms(P, b, t, 0, bodies.Length);
            GC.KeepAlive(this);
        }
        /// <summary>In float, relative to an origin: what a renderer wants.</summary>
        public void GetTransforms(ReadOnlySpan<BodyHandle> bodies, DVec3 origin, Span<RelativeTransform> transforms)
        {
            CheckLength(bodies.Length, transforms.Length, "World.GetTransforms", "transforms");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (RelativeTransform* t = &MemoryMarshal.GetReference(transforms))
                Native.world_get_transforms_f32(P, b, &origin, t, 0, bodies.Length);
            GC.KeepAlive(this);
        }
        /// <summary>Puts each where its transform says, at once: all or none.</summary>
        public void SetTransforms(ReadOnlySpan<BodyHandle> bodies, ReadOnlySpan<WorldTransform> transforms)
        {
            CheckLength(bodies.Length, transforms.Length, "World.SetTransforms", "transforms");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (WorldTransform* t = &MemoryMarshal.GetReference(transforms))
                Native.world_set_transforms(P, b, t, 0, bodies.Length);
            GC.KeepAlive(this);
        }
        /// <summary>Velocities of each, m/s and rad/s: all or none.</summary>
        public void GetVelocities(ReadOnlySpan<BodyHandle> bodies, Span<LinearAngular> velocities)
        {
            CheckLength(bodies.Length, velocities.Length, "World.GetVelocities", "velocities");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (LinearAngular* v = &MemoryMarshal.GetReference(velocities))
                Native.world_get_velocities(P, b, v, 0, bodies.Length);
            GC.KeepAlive(this);
        }
        /// <summary>Sets velocities of each, m/s and rad/s: all or none.</summary>
        public void SetVelocities(ReadOnlySpan<BodyHandle> bodies, ReadOnlySpan<LinearAngular> velocities)
        {
            CheckLength(bodies.Length, velocities.Length, "World.SetVelocities", "velocities");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (LinearAngular* v = &MemoryMarshal.GetReference(velocities))
                Native.world_set_velocities(P, b, v, 0, bodies.Length);
            GC.KeepAlive(this);
        }
        /// <summary>Force at the centre, N, and torque, N m, of each, during the next step.</summary>
        public void AddForces(ReadOnlySpan<BodyHandle> bodies, ReadOnlySpan<LinearAngular> forces)
        {
            CheckLength(bodies.Length, forces.Length, "World.AddForces", "forces");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (LinearAngular* f = &MemoryMarshal.GetReference(forces))
                Native.world_add_forces(P, b, f, 0, bodies.Length);
            GC.KeepAlive(this);
        }

        /// <summary>Angle, translation or length along the free axis of each joint, rad or m, then its rate: 2 floats a
        /// joint. A ball or fixed joint has no free axis: 0, 0.</summary>
        public void GetJointCoordinates(ReadOnlySpan<JointHandle> joints, Span<float> coordinates)
        {
            CheckLength(2 * joints.Length, coordinates.Length, "World.GetJointCoordinates", "coordinates");
            fixed (JointHandle* j = &MemoryMarshal.GetReference(joints))
            fixed (float* c = &MemoryMarshal.GetReference(coordinates))
                Native.world_get_joint_coordinates(P, j, c, 0, joints.Length);
            GC.KeepAlive(this);
        }
        /// <summary>Force, N, and torque, N m, that hold each joint.</summary>
        public void GetJointReactions(ReadOnlySpan<JointHandle> joints, Span<LinearAngular> reactions)
        {
            CheckLength(joints.Length, reactions.Length, "World.GetJointReactions", "reactions");
            fixed (JointHandle* j = &MemoryMarshal.GetReference(joints))
            fixed (LinearAngular* r = &MemoryMarshal.GetReference(reactions))
                Native.world_get_joint_reactions(P, j, r, 0, joints.Length);
            GC.KeepAlive(this);
        }
        /// <summary>Targets of the springs, rad or m. All or none.</summary>
        public void SetJointTargets(ReadOnlySpan<JointHandle> joints, ReadOnlySpan<float> targets)
        {
            CheckLength(joints.Length, targets.Length, "World.SetJointTargets", "targets");
            fixed (JointHandle* j = &MemoryMarshal.GetReference(joints))
            fixed (float* t = &MemoryMarshal.GetReference(targets))
                Native.world_set_joint_targets(P, j, t, 0, joints.Length);
            GC.KeepAlive(this);
        }
        /// <summary>Speeds of the motors, rad/s or m/s. All or none.</summary>
        public void SetJointMotorSpeeds(ReadOnlySpan<JointHandle> joints, ReadOnlySpan<float> speeds)
        {
            CheckLength(joints.Length, speeds.Length, "World.SetJointMotorSpeeds", "speeds");
            fixed (JointHandle* j = &MemoryMarshal.GetReference(joints))
            fixed (float* s = &MemoryMarshal.GetReference(speeds))
                Native.world_set_joint_motor_speeds(P, j, s, 0, joints.Length);
            GC.KeepAlive(this);
        }
        /// <summary>A torque about the axis on B, N m, or a force along it, N, and the opposite on A, during the next
        /// step. All or none.</summary>
        public void AddJointForces(ReadOnlySpan<JointHandle> joints, ReadOnlySpan<float> forces)
        {
            CheckLength(joints.Length, forces.Length, "World.AddJointForces", "forces");
            fixed (JointHandle* j = &MemoryMarshal.GetReference(joints))
            fixed (float* f = &MemoryMarshal.GetReference(forces))
                Native.world_add_joint_forces(P, j, f, 0, joints.Length);
            GC.KeepAlive(this);
        }
    }
}
