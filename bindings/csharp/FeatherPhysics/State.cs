// What a world was, in memory, and the clones of a world.
using System;
using System.Runtime.InteropServices;

namespace FeatherPhysics
{
    /// <summary>
    /// What a world was, to set worlds back to: <see cref="World.SetState"/>. It never changes and belongs to no world.
    /// Many threads may use one at once. The collector frees it, Dispose does so at once.
    /// </summary>
    public sealed unsafe class State : IDisposable
    {
        sealed class StateHandle : SafeHandle
        {
            public Store.StoreHandle Store; // held until the state is gone

            public StateHandle() : base(IntPtr.Zero, true) { }
            public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
            public void Set(IntPtr state) { SetHandle(state); }
            protected override bool ReleaseHandle()
            {
                bool ended = NativePINVOKE.state_destroy((void*)handle) == 0;
                Drop();
                return ended;
            }
            public void Drop()
            {
                if (Store != null) Store.DangerousRelease();
                Store = null;
            }
        }

        readonly StateHandle safe = new StateHandle();
        volatile bool disposed;

        /// <param name="world">as it is now</param>
        public State(World world)
        {
            if (world == null) throw new BadArgumentException("State: the world is null");
            IntPtr made;
            bool held = false;
            try
            {
                world.Hold(ref held);
                safe.Store = world.HoldStore();
                Native.state_create(World.PointerOf(world, "State"), null, &made);
            }
            catch
            {
                safe.Drop();
                throw;
            }
            finally { if (held) world.Release(); }
            safe.Set(made);
        }

        /// Keeps it until Leave, or throws ObjectDisposedException.
        internal void* Enter(ref bool held)
        {
            if (disposed) throw new ObjectDisposedException("State", "State: it is disposed");
            safe.DangerousAddRef(ref held);
            return (void*)safe.DangerousGetHandle();
        }
        internal void Leave(bool held) { if (held) safe.DangerousRelease(); }

        /// <summary>Gives its memory back, after the calls of other threads that use it.</summary>
        public void Dispose()
        {
            disposed = true;
            safe.Dispose();
        }
    }

    public sealed unsafe partial class World
    {
        /// <summary>
        /// A second world like this one: both go on bit for bit. It has this world's pair filter, and shares its store,
        /// which lives as long as one of them. Handles name the same things in both. Histories are not cloned.
        /// </summary>
        /// <param name="def">its workers and SIMD set count; null: the defaults</param>
        /// <param name="pool">null: workers of its own</param>
        public World Clone(WorldDef def = null, Pool pool = null)
        {
            PairFilter filter = pairFilter;
            World clone = new World(this, def, pool);
            clone.SetPairFilter(filter);
            GC.KeepAlive(this);
            return clone;
        }

        /// <summary>What the world is now, in the time of a copy.</summary>
        public State GetState() { return new State(this); }

        /// <summary>
        /// The world becomes what the state is of: this world, a clone, or any that uses the same store. Handles are
        /// those of the state; what was made since is not valid, and its handles may be given again to something else.
        /// Heights and materials that were edited since are put back, for every world that has them. It makes no
        /// garbage. WrongStateException when the state is of another store; nothing changed then.
        /// </summary>
        public void SetState(State state)
        {
            if (state == null) throw new BadArgumentException("World.SetState: the state is null");
            bool held = false;
            try { Native.world_set_state(P, state.Enter(ref held)); }
            finally { state.Leave(held); }
            GC.KeepAlive(this);
        }
    }
}
