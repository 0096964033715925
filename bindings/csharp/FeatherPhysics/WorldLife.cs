// How a world begins and ends, and how threads that use it beside its end are turned away.
//
// A call reads `pointer` and then enters the library. Between the two another thread may dispose of the world. The
// library refuses a call with a closed world, and the shell (shell.h) keeps the world's own memory, in which it reads
// that, until this object cannot be reached any more. Every call ends with GC.KeepAlive: the world is reachable while
// one is under way. So such a call ends in an exception, at no cost for all others.
using System;
using System.Runtime.ConstrainedExecution;
using System.Runtime.InteropServices;
using System.Threading;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    public sealed unsafe partial class World : IDisposable
    {
        /// The memory of the world itself: goes when the world is destroyed and its managed object is unreachable.
        sealed class Shell : CriticalFinalizerObject
        {
            public void* Pointer;
            ~Shell() { NativePINVOKE.shell_leave(Pointer); }
        }

        /// The world's life. Whoever holds it (Store.Enter) delays the destruction.
        sealed class WorldHandle : SafeHandle
        {
            public Pool.PoolHandle Pool;    // held until the world is gone, as is the store
            public Store.StoreHandle Store;
            public SafeHandle Owner;        // of a batch's or a player's world, which goes with that
            public GCHandle Judge;          // names the world in calls of its pair filter

            public WorldHandle() : base(IntPtr.Zero, true) { }
            public void Set(IntPtr world) { SetHandle(world); }
            public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

            // Calls that are inside end soon: no new ones begin.
            protected override bool ReleaseHandle()
            {
                if (Owner != null)
                {
                    Drop();
                    return true;
                }
                SpinWait wait = new SpinWait();
                Result result;
                do
                {
                    result = (Result)NativePINVOKE.world_destroy((void*)handle);
                    if (result == Result.ErrorBusy || result == Result.ErrorStepping) wait.SpinOnce();
                }
                while (result == Result.ErrorBusy || result == Result.ErrorStepping);
                Drop();
                return result == Result.Ok;
            }
            public void Drop()
            {
                if (Pool != null) Pool.DangerousRelease();
                if (Store != null) Store.DangerousRelease();
                if (Judge.IsAllocated) Judge.Free();
                if (Owner != null) Owner.DangerousRelease();
                Owner = null;
                Pool = null;
                Store = null;
            }
        }

        readonly WorldHandle safe = new WorldHandle();
        readonly Shell shell = new Shell();
        volatile IntPtr pointer; // 0 when disposed

        /// <summary>A world, with a store of its own unless one is given.</summary>
        /// <param name="def">null: the defaults</param>
        /// <param name="pool">null: workers of its own</param>
        /// <param name="store">of its heightfields; null: one of its own</param>
        public World(WorldDef def = null, Pool pool = null, Store store = null)
            : this(def, pool, store, null, null, 0) { }

        /// <summary>A world of defaults but for its gravity, m/s2.</summary>
        public World(Vector3 gravity) : this(new WorldDef { Gravity = gravity }) { }

        /// The world that the bytes are of; null: an empty one.
        World(WorldDef def, Pool pool, Store store, NativeRestoreOptions* options, byte* bytes, long size)
        {
            if (def == null) def = new WorldDef();
            if (store != null && store.Safe == null)
                throw new BadArgumentException("World: the store belongs to another world; make one with new Store()");
            Hold(pool, store);
            Begin(null, def, pool, store, options, bytes, size);
            this.store = store;
        }

        /// A clone.
        World(World source, WorldDef def, Pool pool)
        {
            bool held = false;
            try
            {
                source.Hold(ref held);
                Hold(pool, null);
                safe.Store = source.HoldStore();
                Begin(source, def ?? new WorldDef(), pool, null, null, null, 0);
                store = source.GivenStore;
            }
            catch
            {
                safe.Drop();
                throw;
            }
            finally { if (held) source.Release(); }
        }

        /// One of a batch's worlds, or a player's. It keeps the owner's memory as long as it can be reached.
        internal World(SafeHandle owner, Store.StoreHandle ofStore, IntPtr world, Store store)
        {
            bool held = false;
            owner.DangerousAddRef(ref held);
            safe.Owner = owner;
            if (ofStore != null)
            {
                held = false;
                ofStore.DangerousAddRef(ref held);
                safe.Store = ofStore;
                this.store = store;
            }
            safe.Set(world);
            pointer = world;
        }

        /// Its batch or player is disposed: later calls throw.
        internal void End() { pointer = IntPtr.Zero; }

        /// The store that it was made with; null: it has its own.
        internal Store GivenStore { get { return safe.Store == null ? null : store; } }
        internal PairFilter GivenFilter { get { return pairFilter; } }

        /// Makes what the constructors hold a pool and a store for.
        void Begin(World source, WorldDef def, Pool pool, Store store, NativeRestoreOptions* options, byte* bytes,
            long size)
        {
            int length = (int)WorldDef.Size;
            byte* copy = stackalloc byte[length];
            IntPtr made = IntPtr.Zero, memory = IntPtr.Zero;
            fixed (uint* start = &def.StructSize)
            fixed (IntPtr* poolAt = &def.Pool, storeAt = &def.Store)
            {
                Buffer.MemoryCopy(start, copy, length, length);
                if (pool != null) *(IntPtr*)(copy + ((byte*)poolAt - (byte*)start)) = pool.Safe.DangerousGetHandle();
                if (store != null) *(IntPtr*)(copy + ((byte*)storeAt - (byte*)start)) = store.Safe.DangerousGetHandle();
            }
            try
            {
                if (source != null) Native.shell_clone_world(source.P, copy, &made, &memory);
                else if (bytes == null) Native.shell_create_world(copy, &made, &memory);
                else Native.shell_load_world(copy, options, bytes, size, &made, &memory);
            }
            catch
            {
                safe.Drop();
                throw;
            }
            shell.Pointer = (void*)memory;
            safe.Set(made);
            pointer = made;
        }

        /// The store that the world was made with, for one more user; null: it has its own.
        internal Store.StoreHandle HoldStore()
        {
            Store.StoreHandle kept = safe.Store;
            bool held = false;
            if (kept != null) kept.DangerousAddRef(ref held);
            return kept;
        }

        void Hold(Pool pool, Store store)
        {
            bool held = false;
            if (pool != null) pool.Hold(ref held);
            if (held) safe.Pool = pool.Safe;
            held = false;
            try { if (store != null) store.Hold(ref held); }
            finally
            {
                if (held) safe.Store = store.Safe;
                else if (store != null) safe.Drop();
            }
        }

        /// <summary>
        /// Destroys the world and all in it. Calls of other threads that are inside end first; those that begin later
        /// throw. WorldSteppingException inside the world's own pair filter, WrongStateException for a world of a batch or
        /// a player.
        /// </summary>
        public void Dispose()
        {
            if (safe.Owner != null)
                throw new WrongStateException("World.Dispose: the world goes with its batch or player");
            if (IsJudging) throw new WorldSteppingException("World.Dispose: called by the world's own pair filter");
            pointer = IntPtr.Zero;
            safe.Dispose();
        }

        /// <summary>True after Dispose.</summary>
        public bool IsDisposed { get { return pointer == IntPtr.Zero; } }

        void* P
        {
            get
            {
                void* world = (void*)pointer;
                if (world == null) ThrowDisposed();
                return world;
            }
        }

        static void ThrowDisposed() { throw new ObjectDisposedException("World", "World: the world is disposed"); }

        internal static void* PointerOf(World world, string what)
        {
            if (world == null) throw new StaleHandleException(what + ": a default value, of no world");
            return world.P;
        }

        /// Delays the world's destruction until Release, or throws ObjectDisposedException. This thread's own pair
        /// filter delays it already.
        internal void Hold(ref bool held)
        {
            if (IsDisposed) ThrowDisposed();
            if (!IsJudging) safe.DangerousAddRef(ref held);
        }
        internal void Release() { safe.DangerousRelease(); }

        /// The memory of the world itself, for one more user, until it calls shell_leave. null: its owner has it.
        internal void* EnterShell()
        {
            if (shell.Pointer != null) Native.shell_enter(shell.Pointer);
            return shell.Pointer;
        }

        internal enum Kind { Body, Shape, Joint }

        /// <returns>false for a disposed world and for what is destroyed</returns>
        internal static bool IsThere(World world, Kind kind, ulong id)
        {
            if (world == null) return false;
            void* at = (void*)world.pointer;
            if (at == null) return false;
            ulong data;
            int result = kind == Kind.Body ? NativePINVOKE.body_get_user_data(at, id, &data)
                : kind == Kind.Shape ? NativePINVOKE.shape_get_user_data(at, id, &data)
                : NativePINVOKE.joint_get_user_data(at, id, &data);
            if (result == (int)Result.ErrorStepping) result = world.IsThereInStep(kind,
                id) ? 0 : (int)Result.ErrorStale;
            if (result == (int)Result.ErrorBusy && !world.IsDisposed) FeatherException.Throw(result);
            GC.KeepAlive(world);
            return result >= 0;
        }

        bool IsThereInStep(Kind kind, ulong id)
        {
            bool held = false;
            try
            {
                Hold(ref held);
                void* at = (void*)pointer;
                if (at == null) return false;
                return (kind == Kind.Body ? Native.body_is_valid(at, id)
                    : kind == Kind.Shape ? Native.shape_is_valid(at, id)
                    : Native.joint_is_valid(at, id)) != 0;
            }
            catch (ObjectDisposedException) { return false; }
            finally { if (held) Release(); }
        }

        internal static void CheckMine(World mine, World other, string where, string what, ulong id)
        {
            if (mine == other) return;
            throw new StaleHandleException(where + ": " + what + " 0x" + id.ToString("x") +
                (other == null ? " is of no world" : " is of another world"));
        }

        internal static void CheckLength(long needed, int length, string where, string what)
        {
            if (needed <= length) return;
            throw new BadArgumentException(
                where + ": " + what + " has " + length + " elements, " + needed + " are needed");
        }

        internal static void NotNull(object value, string where)
        {
            if (value == null) throw new BadArgumentException(where + ": the definition is null");
        }

        void Mine(Body body, string where) { CheckMine(this, body.World, where, "body", body.Handle.Value); }
    }
}
