// Many worlds, made from one, that step together. docs/MANY.md has what they are.
using System;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;
using System.Threading;

namespace FeatherPhysics
{
    /// <summary>
    /// Clones of a world that step together, each as it would alone, bit for bit. One caller at a time: a second one
    /// gets a WorldBusyException or a WorldSteppingException. No step, reset, read or write makes garbage.
    /// </summary>
    public sealed unsafe class Batch : IDisposable
    {
        /// Ends when the batch is disposed or lost and none of its worlds can be reached.
        internal sealed class BatchHandle : SafeHandle
        {
            public Pool.PoolHandle Pool; // held until the batch is gone, as is the store
            public Store.StoreHandle Store;
            public GCHandle[] Pins = new GCHandle[0]; // of the bound arrays

            public BatchHandle() : base(IntPtr.Zero, true) { }
            public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
            public void Set(IntPtr batch) { SetHandle(batch); }
            protected override bool ReleaseHandle()
            {
                bool ended = NativePINVOKE.batch_destroy((void*)handle) == 0;
                Drop();
                return ended;
            }
            public void Drop()
            {
                Free(Pins);
                if (Pool != null) Pool.DangerousRelease();
                if (Store != null) Store.DangerousRelease();
                Pool = null;
                Store = null;
            }
        }

        readonly BatchHandle safe = new BatchHandle();
        readonly World[] worlds;  // null: nobody asked for it
        readonly Store store;     // null: the template has its own
        IntPtr[] states;          // room for Reset
        volatile bool disposed;

        /// <summary>Clones of a world.</summary>
        /// <param name="template">stays yours; its handles name the same things in each world</param>
        /// <param name="def">null: the defaults, one world</param>
        /// <param name="pool">null: workers of its own</param>
        public Batch(World template, BatchDef def = null, Pool pool = null)
        {
            if (template == null) throw new BadArgumentException("Batch: the template is null");
            if (def == null) def = new BatchDef();
            int length = (int)BatchDef.Size;
            byte* copy = stackalloc byte[length];
            IntPtr made;
            bool held = false, poolHeld = false;
            try
            {
                template.Hold(ref held);
                if (pool != null) pool.Hold(ref poolHeld);
                if (poolHeld) safe.Pool = pool.Safe;
                safe.Store = template.HoldStore();
                fixed (uint* start = &def.StructSize)
                fixed (IntPtr* poolAt = &def.Pool)
                {
                    Buffer.MemoryCopy(start, copy, length, length);
                    if (pool != null)
                        *(IntPtr*)(copy + ((byte*)poolAt - (byte*)start)) = pool.Safe.DangerousGetHandle();
                }
                Native.batch_create(World.PointerOf(template, "Batch"), copy, &made);
                store = template.GivenStore;
            }
            catch
            {
                safe.Drop();
                throw;
            }
            finally { if (held) template.Release(); }
            safe.Set(made);
            BatchDef counted = new BatchDef();
            fixed (uint* to = &counted.StructSize) Buffer.MemoryCopy(copy, to, length, length);
            worlds = new World[counted.WorldCount];
            PairFilter filter = template.GivenFilter;
            for (int i = 0; i < worlds.Length && filter != null; ++i) this[i].SetPairFilter(filter);
        }

        /// <summary>How many worlds there are.</summary>
        public int Count { get { return worlds.Length; } }

        /// <summary>
        /// Of the last call in which worlds failed: the library's sentence on the first of them. null: none did.
        /// </summary>
        public string Failure { get; private set; }

        /// <summary>
        /// One of the worlds, for all other calls but Dispose (WrongStateException). Its calls throw when the batch is
        /// disposed. While it can be reached it keeps the batch's memory.
        /// </summary>
        public World this[int index]
        {
            get
            {
                bool held = false;
                try
                {
                    IntPtr world;
                    Native.batch_get_world(Enter(ref held), index, &world);
                    lock (worlds)
                    {
                        if (disposed) ThrowDisposed();
                        return worlds[index] ?? (worlds[index] = new World(safe, safe.Store, world, store));
                    }
                }
                finally { Leave(held); }
            }
        }

        static void ThrowDisposed() { throw new ObjectDisposedException("Batch", "Batch: it is disposed"); }

        void* Enter(ref bool held)
        {
            if (disposed) ThrowDisposed();
            safe.DangerousAddRef(ref held);
            return (void*)safe.DangerousGetHandle();
        }
        void Leave(bool held)
        {
            if (held) safe.DangerousRelease();
            GC.KeepAlive(this);
        }

        int Told(int failed)
        {
            if (failed > 0) Failure = FeatherException.LastError();
            return failed;
        }
        void CheckSpan(int length, string where, string what)
        {
            if (length > 0) World.CheckLength(worlds.Length, length, where, what);
        }

        static void Free(GCHandle[] pins)
        {
            foreach (GCHandle pin in pins)
                if (pin.IsAllocated) pin.Free();
        }
        static IntPtr Pin(object array, out GCHandle pin)
        {
            pin = default(GCHandle);
            if (array == null) return IntPtr.Zero;
            pin = GCHandle.Alloc(array, GCHandleType.Pinned);
            return pin.AddrOfPinnedObject();
        }

        /// <summary>
        /// The arrays that each Step reads before its first step and fills after its last. They replace those bound
        /// before, and are pinned until others do, or the batch ends. StaleHandleException for an item that no world
        /// has, BadArgumentException for sizes that do not fit and for fields that are not read, or not written.
        /// </summary>
        /// <param name="inputs">null: none</param>
        /// <param name="outputs">null: none</param>
        public void Bind(BatchArray[] inputs, BatchArray[] outputs)
        {
            int read = inputs == null ? 0 : inputs.Length, written = outputs == null ? 0 : outputs.Length;
            NativeBatchArray[] arrays = new NativeBatchArray[read + written];
            GCHandle[] pins = new GCHandle[arrays.Length], items = new GCHandle[arrays.Length];
            bool held = false;
            try
            {
                void* batch = Enter(ref held);
                for (int i = 0; i < arrays.Length; ++i)
                {
                    BatchArray array = i < read ? inputs[i] : outputs[i - read];
                    if (array == null) throw new BadArgumentException("Batch.Bind: an array is null");
                    IntPtr data = Pin(array.Data, out pins[i]);
                    arrays[i] = array.Describe(data, Pin(array.Items, out items[i]));
                }
                fixed (NativeBatchArray* start = arrays) Native.batch_bind(batch, start, read, start + read, written);
                pins = Interlocked.Exchange(ref safe.Pins, pins);
            }
            finally
            {
                Free(pins); // those bound before, or of a call that failed
                Free(items);
                Leave(held);
            }
        }

        /// <summary>
        /// Steps each world as <see cref="World.Step"/> does. A world that fails stands after its last whole step,
        /// and the others go on. Returns how many failed; <see cref="Failure"/> says why the first did. Exceptions of
        /// pair filters are thrown as World.Step throws them: that of the lowest world. Worlds with a filter are stepped
        /// by this thread, in their order, after the others.
        /// </summary>
        /// <param name="dt">s</param>
        /// <param name="steps">1..1000; the inputs hold in all of them</param>
        /// <param name="mask">false: left alone; empty: all step</param>
        /// <param name="results">of each world, Ok for those left alone; or empty</param>
        public int Step(float dt, int steps = 1, ReadOnlySpan<bool> mask = default(ReadOnlySpan<bool>),
            Span<Result> results = default(Span<Result>))
        {
            CheckSpan(mask.Length, "Batch.Step", "mask");
            CheckSpan(results.Length, "Batch.Step", "results");
            bool held = false;
            int failed;
            try
            {
                fixed (bool* maskAt = &MemoryMarshal.GetReference(mask))
                fixed (Result* resultsAt = &MemoryMarshal.GetReference(results))
                    failed = Told(Native.batch_step(Enter(ref held), dt, steps, maskAt, resultsAt));
            }
            finally { Leave(held); }
            ExceptionDispatchInfo first = null; // of the lowest world; those of the others end with this step
            foreach (World world in worlds)
            {
                ExceptionDispatchInfo thrown = world == null ? null : world.TakeThrown();
                first = first ?? thrown;
            }
            if (first != null) first.Throw();
            return failed;
        }

        /// <summary>Sets worlds back to what the template was, or to states of theirs. Returns how many failed.</summary>
        /// <param name="mask">false: left alone; empty: all</param>
        /// <param name="to">one a world, null: the template's; empty: all of them</param>
        /// <param name="results">of each world; or empty</param>
        public int Reset(ReadOnlySpan<bool> mask = default(ReadOnlySpan<bool>),
            ReadOnlySpan<State> to = default(ReadOnlySpan<State>), Span<Result> results = default(Span<Result>))
        {
            CheckSpan(mask.Length, "Batch.Reset", "mask");
            CheckSpan(to.Length, "Batch.Reset", "to");
            CheckSpan(results.Length, "Batch.Reset", "results");
            IntPtr[] room = to.Length == 0 ? null : Interlocked.Exchange(ref states, null) ?? new IntPtr[worlds.Length];
            bool held = false;
            int entered = 0;
            try
            {
                void* batch = Enter(ref held);
                for (; room != null && entered < room.Length; ++entered)
                {
                    bool kept = false;
                    room[entered] = to[entered] == null ? IntPtr.Zero : (IntPtr)to[entered].Enter(ref kept);
                }
                fixed (bool* maskAt = &MemoryMarshal.GetReference(mask))
                fixed (IntPtr* statesAt = room)
                fixed (Result* resultsAt = &MemoryMarshal.GetReference(results))
                    return Told(Native.batch_reset(batch, maskAt, statesAt, resultsAt));
            }
            finally
            {
                for (int i = 0; i < entered; ++i)
                    if (room[i] != IntPtr.Zero) to[i].Leave(true);
                if (room != null) states = room;
                Leave(held);
            }
        }

        /// <summary>
        /// Reads a field of every world into an array. Returns how many worlds lack an item: their rows are 0.
        /// </summary>
        public int Read(BatchArray array, Span<Result> results = default(Span<Result>))
        {
            if (array == null) throw new BadArgumentException("Batch.Read: the array is null");
            CheckSpan(results.Length, "Batch.Read", "results");
            bool held = false;
            try
            {
                fixed (float* floats = array.Floats)
                fixed (double* doubles = array.Doubles)
                fixed (ulong* items = array.Items)
                fixed (Result* resultsAt = &MemoryMarshal.GetReference(results))
                {
                    IntPtr data = floats == null ? (IntPtr)doubles : (IntPtr)floats;
                    NativeBatchArray native = array.Describe(data, (IntPtr)items);
                    return Told(Native.batch_read(Enter(ref held), &native, resultsAt));
                }
            }
            finally { Leave(held); }
        }

        /// <summary>
        /// Writes a field of worlds from an array, for each world all rows or none. Returns how many failed.
        /// </summary>
        public int Write(BatchArray array, ReadOnlySpan<bool> mask = default(ReadOnlySpan<bool>),
            Span<Result> results = default(Span<Result>))
        {
            if (array == null) throw new BadArgumentException("Batch.Write: the array is null");
            CheckSpan(mask.Length, "Batch.Write", "mask");
            CheckSpan(results.Length, "Batch.Write", "results");
            bool held = false;
            try
            {
                fixed (float* floats = array.Floats)
                fixed (double* doubles = array.Doubles)
                fixed (ulong* items = array.Items)
                fixed (bool* maskAt = &MemoryMarshal.GetReference(mask))
                fixed (Result* resultsAt = &MemoryMarshal.GetReference(results))
                {
                    IntPtr data = floats == null ? (IntPtr)doubles : (IntPtr)floats;
                    NativeBatchArray native = array.Describe(data, (IntPtr)items);
                    return Told(Native.batch_write(Enter(ref held), &native, maskAt, resultsAt));
                }
            }
            finally { Leave(held); }
        }

        /// <summary><see cref="World.Hash"/> of each world.</summary>
        public void GetHashes(Span<ulong> hashes)
        {
            World.CheckLength(worlds.Length, hashes.Length, "Batch.GetHashes", "hashes");
            bool held = false;
            try
            {
                fixed (ulong* start = &MemoryMarshal.GetReference(hashes))
                {
                    Native.batch_hash(Enter(ref held), start);
                    for (int i = 0; i < worlds.Length; ++i)
                    {
                        uint* words = (uint*)(start + i);
                        hashes[i] = (ulong)words[1] << 32 | words[0];
                    }
                }
            }
            finally { Leave(held); }
        }

        /// <summary>
        /// Ends the batch and its worlds; calls of other threads that are inside end first. Its memory goes at once, or
        /// with the last of its worlds that the program has asked for and still holds.
        /// </summary>
        public void Dispose()
        {
            lock (worlds)
            {
                disposed = true;
                for (int i = 0; i < worlds.Length; ++i)
                {
                    if (worlds[i] != null) worlds[i].End();
                    worlds[i] = null;
                }
            }
            safe.Dispose();
        }
    }
}
