// Recordings, played: a world that does what a recording says.
using System;
using System.IO;
using System.Runtime.InteropServices;
using System.Text;

namespace FeatherPhysics
{
    /// <summary>Words that somebody left in a recording.</summary>
    public sealed class RecordedNote
    {
        /// <summary>Steps that there had been.</summary>
        public long Step { get; internal set; }
        /// <summary>The handle that they are about, or 0.</summary>
        public ulong About { get; internal set; }
        /// <summary>The words.</summary>
        public string Text { get; internal set; }
    }

    /// <summary>The first difference between a replay and its recording.</summary>
    public sealed class Divergence
    {
        /// <summary>A call, a step or a keyframe.</summary>
        public DivergenceType Type { get; internal set; }
        /// <summary>Of the recording.</summary>
        public long Step { get; internal set; }
        /// <summary>The first that differs, of those awake; 0: not known without RecordFlags.Fine.</summary>
        public BodyHandle Body { get; internal set; }
        /// <summary>Its field; "": not known.</summary>
        public string Field { get; internal set; }
        /// <summary>Of the field: 0 x, 1 y, 2 z, 3 w; -1: none.</summary>
        public int Component { get; internal set; }
        /// <summary>All of it in a sentence.</summary>
        public string Text { get; internal set; }
    }

    /// <summary>
    /// Makes the calls of a recording again, in a world of its own, on any machine, with any workers and SIMD set, and
    /// compares: handles at each call, hashes at each step, the whole state at each keyframe. One caller at a time.
    /// </summary>
    public sealed unsafe class Player : IDisposable
    {
        const int Piece = 1 << 20; // bytes of a file that are read at once

        /// Ends when the player is disposed or lost and its world cannot be reached.
        sealed class PlayerHandle : SafeHandle
        {
            public Pool.PoolHandle Pool; // held until the player is gone, as is the store
            public Store.StoreHandle Store;

            public PlayerHandle() : base(IntPtr.Zero, true) { }
            public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
            public void Set(IntPtr player) { SetHandle(player); }
            protected override bool ReleaseHandle()
            {
                bool ended = NativePINVOKE.player_destroy((void*)handle) == 0;
                Drop();
                return ended;
            }
            public void Drop()
            {
                if (Pool != null) Pool.DangerousRelease();
                if (Store != null) Store.DangerousRelease();
                Pool = null;
                Store = null;
            }
        }

        readonly PlayerHandle safe = new PlayerHandle();
        readonly object inside = new object(); // one caller at a time
        readonly Store store;
        World world;
        bool disposed;

        /// <summary>A player without a recording: <see cref="Feed"/> it.</summary>
        /// <param name="def">null: the defaults</param>
        /// <param name="pool">null: workers of its own</param>
        /// <param name="store">where assets are that the recording does not hold; null: one of its own</param>
        public Player(PlayerDef def = null, Pool pool = null, Store store = null)
        {
            if (store != null && store.Safe == null)
                throw new BadArgumentException("Player: the store belongs to a world; make one with new Store()");
            if (def == null) def = new PlayerDef();
            int length = (int)PlayerDef.Size;
            byte* copy = stackalloc byte[length];
            IntPtr made;
            bool poolHeld = false, storeHeld = false;
            try
            {
                if (pool != null) pool.Hold(ref poolHeld);
                if (poolHeld) safe.Pool = pool.Safe;
                if (store != null) store.Hold(ref storeHeld);
                if (storeHeld) safe.Store = store.Safe;
                fixed (uint* start = &def.StructSize)
                fixed (IntPtr* poolAt = &def.Pool, storeAt = &def.Store)
                {
                    Buffer.MemoryCopy(start, copy, length, length);
                    byte* first = (byte*)start;
                    if (poolHeld) *(IntPtr*)(copy + ((byte*)poolAt - first)) = pool.Safe.DangerousGetHandle();
                    if (storeHeld) *(IntPtr*)(copy + ((byte*)storeAt - first)) = store.Safe.DangerousGetHandle();
                }
                Native.player_create(copy, &made);
            }
            catch
            {
                safe.Drop();
                throw;
            }
            safe.Set(made);
            this.store = store;
        }

        /// <summary>A player of a file. BadDataException, as of Feed, when it holds no recording.</summary>
        public static Player Open(string path, PlayerDef def = null, Pool pool = null, Store store = null)
        {
            if (path == null) throw new BadArgumentException("Player.Open: the path is null");
            using (FileStream file = new FileStream(path, FileMode.Open, FileAccess.Read, FileShare.ReadWrite))
            {
                Player player = new Player(def, pool, store);
                try
                {
                    byte[] piece = new byte[Piece];
                    for (int size; (size = file.Read(piece, 0, piece.Length)) > 0;)
                        player.Feed(new ReadOnlySpan<byte>(piece, 0, size));
                    return player;
                }
                catch
                {
                    player.Dispose();
                    throw;
                }
            }
        }

        void* P
        {
            get
            {
                if (disposed) throw new ObjectDisposedException("Player", "Player: it is disposed");
                return (void*)safe.DangerousGetHandle();
            }
        }

        /// <summary>
        /// Adds bytes of a recording, in pieces of any size. One that was cut plays to its last whole chunk. Bytes from
        /// anywhere may be given: BadDataException for what is no recording or was altered, and what stood before it
        /// plays; NewerVersionException; UnsupportedException for packed ones, which tools/feather-rec unpacks.
        /// </summary>
        public void Feed(ReadOnlySpan<byte> bytes)
        {
            byte none = 0;
            lock (inside)
                fixed (byte* start = &MemoryMarshal.GetReference(bytes))
                    Native.player_feed(P, Snapshot.OrEmpty(start, &none), bytes.Length);
        }

        /// <summary>
        /// Makes the recorded calls up to the end of the next step. false: there is no more yet. DivergedException,
        /// once, when the world went another way: <see cref="Divergence"/> tells it, and the next call goes on.
        /// BadDataException for calls that nobody recorded so, WrongStateException when an asset is missing.
        /// </summary>
        public bool Step()
        {
            lock (inside) return Native.player_step(P) == (int)Result.Ok;
        }

        /// <summary>
        /// Goes to the end of a step, forwards or backwards, as <see cref="Info"/> counts them. false: the recording
        /// ends before it. What is not there at that step is not valid, or means something else.
        /// BadArgumentException for a step before the first one; else as Step.
        /// </summary>
        public bool Seek(long step)
        {
            lock (inside) return Native.player_seek(P, step) == (int)Result.Ok;
        }

        /// <summary>
        /// The world as it is now, to be read; what changes it is a WrongStateException, also here before the first
        /// step or seek. To go on with it by yourself, clone it: <c>player.World.Clone()</c>.
        /// </summary>
        public World World
        {
            get
            {
                lock (inside)
                {
                    IntPtr found;
                    Native.player_get_world(P, &found);
                    return world ?? (world = new World(safe, safe.Store, found, store));
                }
            }
        }

        /// <summary>Where it is, and what it has.</summary>
        public PlayerInfo Info
        {
            get
            {
                PlayerInfo info;
                Native.player_info_init(&info, (uint)sizeof(PlayerInfo));
                lock (inside) Native.player_get_info(P, &info);
                return info;
            }
        }

        static string Text(IntPtr first)
        {
            int length = 0;
            while (((byte*)first)[length] != 0) ++length;
            return Encoding.UTF8.GetString((byte*)first, length);
        }

        /// <summary>The words that were left in what it was fed, in their order.</summary>
        public RecordedNote[] GetNotes()
        {
            lock (inside)
            {
                int count = Native.player_get_notes(P, null, (uint)sizeof(NativeNote), 0);
                NativeNote[] found = new NativeNote[count];
                RecordedNote[] notes = new RecordedNote[count];
                fixed (NativeNote* start = found)
                    Native.player_get_notes(P, start, (uint)sizeof(NativeNote), count);
                for (int i = 0; i < count; ++i)
                    notes[i] = new RecordedNote
                    {
                        Step = found[i].Step, About = found[i].About, Text = Text(found[i].Text)
                    };
                return notes;
            }
        }

        /// <summary>The first difference between the replay and its recording; null: there was none.</summary>
        public Divergence Divergence
        {
            get
            {
                lock (inside)
                {
                    if (!Info.HasDiverged) return null;
                    NativeDivergence found;
                    Native.divergence_init(&found, (uint)sizeof(NativeDivergence));
                    Native.player_get_divergence(P, &found);
                    return new Divergence
                    {
                        Type = found.Type, Step = found.Step, Body = new BodyHandle(found.Body), Component = found.Component,
                        Field = Text(found.Field), Text = Text(found.Text)
                    };
                }
            }
        }

        /// <summary>Ends the player and its world, when the calls of other threads that are inside have ended.</summary>
        public void Dispose()
        {
            lock (inside)
            {
                disposed = true;
                if (world != null) world.End();
                world = null;
            }
            safe.Dispose();
        }
    }
}
