// The last frames of a world, in memory, for rollback.
using System;
using System.Runtime.InteropServices;

namespace FeatherPhysics
{
    /// <summary>
    /// The last frames of a world, to go back to: keep each before its step. It ends with Dispose or with its world;
    /// calls throw StaleHandleException then. While frames are kept there is no garbage.
    /// </summary>
    public sealed unsafe class History : IDisposable
    {
        readonly World world;
        IntPtr pointer; // 0 when disposed

        /// <summary>Keeps the last frames of a world, from now on.</summary>
        /// <param name="world">whose frames it keeps</param>
        /// <param name="def">null: the defaults</param>
        public History(World world, HistoryDef def = null)
        {
            if (world == null) throw new BadArgumentException("History: the world is null");
            IntPtr made;
            fixed (uint* given = &(def ?? new HistoryDef()).StructSize)
                Native.history_create(World.PointerOf(world, "History"), given, &made);
            GC.KeepAlive(world);
            this.world = world;
            pointer = made;
        }

        void* P
        {
            get
            {
                World.PointerOf(world, "History");
                if (pointer == IntPtr.Zero) throw new ObjectDisposedException("History", "History: it is disposed");
                return (void*)pointer;
            }
        }

        /// <summary>
        /// Keeps the world as it is. When there are too many frames, or bytes, the oldest go. LimitException when the
        /// frame alone needs more than the definition's bytes.
        /// </summary>
        /// <param name="frame">a number of yours, above that of the last frame kept</param>
        public void Keep(long frame)
        {
            Native.history_keep(P, frame);
            GC.KeepAlive(world);
        }

        /// <summary>
        /// Puts the world back to a frame; those after it go. What was made since is not valid, and its handles may be
        /// given again to something else. StaleHandleException when the frame is not kept, or no longer.
        /// </summary>
        public void Restore(long frame)
        {
            Native.history_restore(P, frame);
            GC.KeepAlive(world);
        }

        /// <summary>Which frames there are, the oldest first. Returns how many.</summary>
        /// <param name="frames">too short: it gets the front</param>
        public int GetFrames(Span<HistoryFrame> frames)
        {
            fixed (HistoryFrame* out_ = &MemoryMarshal.GetReference(frames))
            {
                int count = Native.history_get_frames(P, out_, (uint)sizeof(HistoryFrame), frames.Length);
                GC.KeepAlive(world);
                return count;
            }
        }

        /// <summary>Gives its memory back.</summary>
        public void Dispose()
        {
            if (pointer == IntPtr.Zero) return;
            if (!world.IsDisposed) Native.history_destroy((void*)pointer);
            pointer = IntPtr.Zero;
            GC.KeepAlive(world);
        }
    }
}
