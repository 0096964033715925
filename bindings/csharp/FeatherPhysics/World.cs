// A world, its pool, its life: bodies, joints, heightfields, the step, what is read after it. Queries are in WorldQueries.cs.
using System;
using System.Runtime.InteropServices;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    /// <summary>Worker threads that several worlds may share. Lives at least as long as its worlds.</summary>
    public sealed unsafe class Pool : IDisposable
    {
        internal sealed class PoolHandle : SafeHandle
        {
            public PoolHandle() : base(IntPtr.Zero, true) { }
            public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
            public void Set(IntPtr pool) { SetHandle(pool); }
            protected override bool ReleaseHandle() { return NativePINVOKE.pool_destroy((void*)handle) == 0; }
        }

        internal readonly PoolHandle Safe = new PoolHandle();

        /// <param name="workers">1..64, the thread that steps among them</param>
        public Pool(int workers)
        {
            IntPtr made;
            Native.pool_create(workers, &made);
            Safe.Set(made);
        }

        /// <summary>The threads end with the last world that uses them.</summary>
        public void Dispose() { Safe.Dispose(); }
    }

    /// <summary>Everything that can touch each other. One thread at a time writes; <see cref="Dispose"/> is a write.</summary>
    public sealed unsafe partial class World : IDisposable
    {
        sealed class WorldHandle : SafeHandle
        {
            readonly Pool.PoolHandle pool; // kept until the world is gone

            public WorldHandle(IntPtr world, Pool.PoolHandle pool) : base(IntPtr.Zero, true)
            {
                this.pool = pool;
                SetHandle(world);
            }
            public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
            /// What can fail, so that it can be told.
            public void Destroy()
            {
                Native.world_destroy((void*)handle);
                SetHandleAsInvalid();
                if (pool != null) pool.DangerousRelease();
            }
            protected override bool ReleaseHandle()
            {
                bool done = NativePINVOKE.world_destroy((void*)handle) == 0;
                if (done && pool != null) pool.DangerousRelease();
                return done;
            }
        }

        readonly WorldHandle safe;
        void* pointer; // null when disposed

        /// <param name="def">null: the defaults</param>
        /// <param name="pool">null: workers of its own</param>
        public World(WorldDef def = null, Pool pool = null)
        {
            if (def == null) def = new WorldDef();
            bool held = false;
            if (pool != null) pool.Safe.DangerousAddRef(ref held);
            IntPtr made = IntPtr.Zero;
            try
            {
                def.Pool = pool != null ? pool.Safe.DangerousGetHandle() : IntPtr.Zero;
                fixed (uint* start = &def.StructSize) Native.world_create(start, &made);
            }
            catch
            {
                if (held) pool.Safe.DangerousRelease();
                throw;
            }
            safe = new WorldHandle(made, pool != null ? pool.Safe : null);
            pointer = (void*)made;
        }

        public World(Vector3 gravity) : this(new WorldDef { Gravity = gravity }) { }

        /// <summary>Destroys the world and all in it. WorldSteppingException while another thread steps it.</summary>
        public void Dispose()
        {
            if (pointer == null) return;
            safe.Destroy();
            pointer = null;
            safe.Dispose();
        }

        public bool IsDisposed { get { return pointer == null; } }

        void* P
        {
            get
            {
                if (pointer == null) ThrowDisposed();
                return pointer;
            }
        }

        static void ThrowDisposed() { throw new ObjectDisposedException("World", "World: the world is disposed"); }

        internal static void* PointerOf(World world, string what)
        {
            if (world == null) throw new StaleHandleException(what + ": a default value, of no world");
            return world.P;
        }

        internal static void CheckMine(World mine, World other, string where, string what, ulong id)
        {
            if (mine == null || mine == other) return;
            throw new StaleHandleException(where + ": " + what + " 0x" + id.ToString("x") + (other == null ? " is of no world" : " is of another world"));
        }

        internal static void CheckLength(long needed, int length, string where, string what)
        {
            if (needed > length) throw new BadArgumentException(where + ": " + what + " has " + length + " elements, " + needed + " are needed");
        }

        internal static void NotNull(object value, string where)
        {
            if (value == null) throw new BadArgumentException(where + ": the definition is null");
        }

        void Mine(Body body, string where) { CheckMine(this, body.World, where, "body", body.Handle.Value); }

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
        public ulong UserData { get { ulong value; Native.world_get_user_data(P, &value); GC.KeepAlive(this); return value; } }
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
        /// <summary>While ignored, two bodies never collide.</summary>
        public void IgnoreCollision(Body a, Body b, bool ignore = true)
        {
            Mine(a, "World.IgnoreCollision");
            Mine(b, "World.IgnoreCollision");
            Native.world_ignore_collision(P, a.Handle.Value, b.Handle.Value, ignore ? 1 : 0);
            GC.KeepAlive(this);
        }
        /// <summary>Rebalances the trees that serve the queries; worth a call after a level is loaded.</summary>
        public void SyncQueries() { Native.world_sync_queries(P); GC.KeepAlive(this); }

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
        public Body CreateStatic(DVec3 position) { return CreateBody(new BodyDef { Type = BodyType.Static, Position = position }); }
        public Body CreateDynamic(DVec3 position) { return CreateBody(new BodyDef { Position = position }); }
        public Body CreateKinematic(DVec3 position) { return CreateBody(new BodyDef { Type = BodyType.Kinematic, Position = position }); }

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
                fixed (BodyHandle* out_ = &MemoryMarshal.GetReference(made)) Native.body_create_many(P, copies, (uint)size, at.Length, out_);
            }
            finally { Marshal.FreeHGlobal((IntPtr)copies); }
            GC.KeepAlive(this);
        }
        /// <summary>All or none.</summary>
        public void DestroyBodies(ReadOnlySpan<BodyHandle> bodies)
        {
            fixed (BodyHandle* start = &MemoryMarshal.GetReference(bodies)) Native.body_destroy_many(P, start, bodies.Length);
            GC.KeepAlive(this);
        }

        /// <summary>The body of a handle, as events and hits have it.</summary>
        public Body this[BodyHandle handle] { get { return new Body(this, handle.Value); } }
        public Shape this[ShapeHandle handle] { get { return new Shape(this, handle.Value); } }
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

        /// <summary>Terrain for any number of shapes of this world: <c>body.AddTerrain(field)</c>.</summary>
        public Heightfield CreateHeightfield(HeightfieldDef def)
        {
            NotNull(def, "World.CreateHeightfield");
            CheckLength((long)def.Rows * def.Columns, def.Heights == null ? 0 : def.Heights.Length, "World.CreateHeightfield", "Heights");
            long cells = Math.Max(0, (long)def.Rows - 1) * Math.Max(0, (long)def.Columns - 1);
            if (def.Holes != null) CheckLength(cells, def.Holes.Length, "World.CreateHeightfield", "Holes");
            if (def.CellMaterials != null) CheckLength(cells, def.CellMaterials.Length, "World.CreateHeightfield", "CellMaterials");
            NativeHeightfield native;
            Native.heightfield_def_init(&native, (uint)sizeof(NativeHeightfield));
            native.Rows = def.Rows;
            native.Columns = def.Columns;
            native.CellX = def.CellX;
            native.CellZ = def.CellZ;
            native.MaterialCount = def.Materials == null ? 0 : def.Materials.Length;
            ulong made;
            fixed (float* heights = def.Heights)
            fixed (byte* holes = def.Holes)
            fixed (byte* cellMaterials = def.CellMaterials)
            fixed (SurfaceMaterial* materials = def.Materials)
            {
                native.Heights = (IntPtr)heights;
                native.Holes = (IntPtr)holes;
                native.CellMaterials = (IntPtr)cellMaterials;
                native.Materials = (IntPtr)materials;
                Native.heightfield_create(P, &native, &made);
            }
            GC.KeepAlive(this);
            return new Heightfield(this, made);
        }

        // ---- the step, and what is read after it ----

        /// <summary>Moves the world on by dt seconds, 0..1.</summary>
        public void Step(float dt) { Native.world_step(P, dt); GC.KeepAlive(this); }

        PairEvent[] pairEvents = new PairEvent[64];
        BodyEvent[] bodyEvents = new BodyEvent[64];
        HitEvent[] hitEvents = new HitEvent[64];
        JointEvent[] jointEvents = new JointEvent[16];

        /// Makes room where so many did not fit; they are then read again.
        static bool Grows<T>(ref T[] events, int count)
        {
            if (count <= events.Length) return false;
            events = new T[count + count / 2];
            return true;
        }
        ReadOnlySpan<T> Told<T>(T[] events, int count)
        {
            GC.KeepAlive(this);
            return new ReadOnlySpan<T>(events, 0, count);
        }

        /// <summary>Shapes that began or ceased to touch in the last step. Valid until the next call of this.</summary>
        public ReadOnlySpan<PairEvent> PairEvents
        {
            get
            {
                int count;
                do fixed (PairEvent* start = pairEvents) count = Native.world_get_pair_events(P, start, 0, pairEvents.Length);
                while (Grows(ref pairEvents, count));
                return Told(pairEvents, count);
            }
        }
        /// <summary>Bodies that fell asleep or woke in the last step.</summary>
        public ReadOnlySpan<BodyEvent> BodyEvents
        {
            get
            {
                int count;
                do fixed (BodyEvent* start = bodyEvents) count = Native.world_get_body_events(P, start, 0, bodyEvents.Length);
                while (Grows(ref bodyEvents, count));
                return Told(bodyEvents, count);
            }
        }
        /// <summary>Impacts of the last step, of shapes that ask for them.</summary>
        public ReadOnlySpan<HitEvent> HitEvents
        {
            get
            {
                int count;
                do fixed (HitEvent* start = hitEvents) count = Native.world_get_hit_events(P, start, 0, hitEvents.Length);
                while (Grows(ref hitEvents, count));
                return Told(hitEvents, count);
            }
        }
        /// <summary>Joints that broke in the last step.</summary>
        public ReadOnlySpan<JointEvent> JointEvents
        {
            get
            {
                int count;
                do fixed (JointEvent* start = jointEvents) count = Native.world_get_joint_events(P, start, 0, jointEvents.Length);
                while (Grows(ref jointEvents, count));
                return Told(jointEvents, count);
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
        public void GetTransforms(ReadOnlySpan<BodyHandle> bodies, Span<WorldTransform> transforms)
        {
            CheckLength(bodies.Length, transforms.Length, "World.GetTransforms", "transforms");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (WorldTransform* t = &MemoryMarshal.GetReference(transforms)) Native.world_get_transforms(P, b, t, 0, bodies.Length);
            GC.KeepAlive(this);
        }
        /// <summary>In float, relative to an origin: what a renderer wants.</summary>
        public void GetTransforms(ReadOnlySpan<BodyHandle> bodies, DVec3 origin, Span<RelativeTransform> transforms)
        {
            CheckLength(bodies.Length, transforms.Length, "World.GetTransforms", "transforms");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (RelativeTransform* t = &MemoryMarshal.GetReference(transforms)) Native.world_get_transforms_f32(P, b, &origin, t, 0, bodies.Length);
            GC.KeepAlive(this);
        }
        public void SetTransforms(ReadOnlySpan<BodyHandle> bodies, ReadOnlySpan<WorldTransform> transforms)
        {
            CheckLength(bodies.Length, transforms.Length, "World.SetTransforms", "transforms");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (WorldTransform* t = &MemoryMarshal.GetReference(transforms)) Native.world_set_transforms(P, b, t, 0, bodies.Length);
            GC.KeepAlive(this);
        }
        public void GetVelocities(ReadOnlySpan<BodyHandle> bodies, Span<LinearAngular> velocities)
        {
            CheckLength(bodies.Length, velocities.Length, "World.GetVelocities", "velocities");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (LinearAngular* v = &MemoryMarshal.GetReference(velocities)) Native.world_get_velocities(P, b, v, 0, bodies.Length);
            GC.KeepAlive(this);
        }
        public void SetVelocities(ReadOnlySpan<BodyHandle> bodies, ReadOnlySpan<LinearAngular> velocities)
        {
            CheckLength(bodies.Length, velocities.Length, "World.SetVelocities", "velocities");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (LinearAngular* v = &MemoryMarshal.GetReference(velocities)) Native.world_set_velocities(P, b, v, 0, bodies.Length);
            GC.KeepAlive(this);
        }
        /// <summary>Force at the centre, N, and torque, N m, of each, during the next step.</summary>
        public void AddForces(ReadOnlySpan<BodyHandle> bodies, ReadOnlySpan<LinearAngular> forces)
        {
            CheckLength(bodies.Length, forces.Length, "World.AddForces", "forces");
            fixed (BodyHandle* b = &MemoryMarshal.GetReference(bodies))
            fixed (LinearAngular* f = &MemoryMarshal.GetReference(forces)) Native.world_add_forces(P, b, f, 0, bodies.Length);
            GC.KeepAlive(this);
        }
    }
}
