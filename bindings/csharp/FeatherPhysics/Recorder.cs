// Recordings: what a world was, and each call that changed it since. Player.cs makes the same calls again.
using System;
using System.IO;
using System.Runtime.InteropServices;
using System.Text;
using System.Threading;

namespace FeatherPhysics
{
    /// <summary>
    /// A recording of a world while it grows: each call that changes the world is noted until Dispose. The bytes make a
    /// file of docs/RECORDING.md, for <see cref="Player"/>, tools/feather-rec and the viewer. They wait in memory until
    /// somebody reads them: <see cref="World.Record(string, RecorderDef)"/> writes a file by itself.
    /// </summary>
    public sealed unsafe class Recorder : IDisposable
    {
        /// Ends when the recorder is disposed or lost, and no read is under way.
        sealed class RecorderHandle : SafeHandle
        {
            public void* Shell; // of the world: its allocator gave the recorder's memory

            public RecorderHandle() : base(IntPtr.Zero, true) { }
            public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
            public void Set(IntPtr recorder) { SetHandle(recorder); }

            // A call that the world is in ends soon, and so does its own end.
            protected override bool ReleaseHandle()
            {
                SpinWait wait = new SpinWait();
                Result result;
                while ((result = (Result)NativePINVOKE.recorder_destroy((void*)handle)) == Result.ErrorBusy ||
                    result == Result.ErrorStepping || result == Result.ErrorStale) wait.SpinOnce();
                Leave();
                return result == Result.Ok;
            }
            public void Leave()
            {
                if (Shell != null) NativePINVOKE.shell_leave(Shell);
                Shell = null;
            }
        }

        readonly RecorderHandle safe = new RecorderHandle();
        readonly World world;
        volatile bool disposed;

        /// <summary>
        /// WrongStateException when the world has a recorder, or is one of a batch; LimitException when the first
        /// keyframe does not fit.
        /// </summary>
        /// <param name="world">may change before and after; between two of its calls now</param>
        /// <param name="def">null: the defaults</param>
        public Recorder(World world, RecorderDef def = null)
        {
            if (world == null) throw new BadArgumentException("Recorder: the world is null");
            IntPtr made;
            bool held = false;
            try
            {
                world.Hold(ref held);
                safe.Shell = world.EnterShell();
                fixed (uint* given = &(def ?? new RecorderDef()).StructSize)
                    Native.recorder_create(World.PointerOf(world, "Recorder"), given, &made);
            }
            catch
            {
                safe.Leave();
                throw;
            }
            finally { if (held) world.Release(); }
            this.world = world;
            safe.Set(made);
        }

        void* Enter(ref bool held)
        {
            if (disposed) throw new ObjectDisposedException("Recorder", "Recorder: it is disposed");
            safe.DangerousAddRef(ref held);
            return (void*)safe.DangerousGetHandle();
        }
        void Leave(bool held)
        {
            if (held) safe.DangerousRelease();
            GC.KeepAlive(this);
        }

        /// <summary>
        /// Bytes that wait to be read. What ended the recording is thrown when nothing waits, as by Read.
        /// </summary>
        public long Waiting { get { return Read(null, 0); } }

        long Read(byte* destination, long capacity)
        {
            long size;
            bool held = false;
            try { Native.recorder_read(Enter(ref held), destination, capacity, &size); }
            finally { Leave(held); }
            return size;
        }

        /// <summary>
        /// What was recorded since the last read, to be appended to a file: whole chunks, as many as fit; of a flight
        /// recorder (<see cref="RecordFlags.Last"/>) all that it keeps. Any thread may read, also during a step.
        /// Returns how many bytes there are; 0 when nothing waits, or the world is gone. LimitException when not even
        /// the next chunk fits, and, after all that was recorded, when the recording ended as nobody read it;
        /// NoMemoryException when it ended for lack of memory.
        /// </summary>
        /// <param name="destination">begins with them afterwards</param>
        public int Read(Span<byte> destination)
        {
            byte none = 0;
            fixed (byte* start = &MemoryMarshal.GetReference(destination))
                return (int)Read(Snapshot.OrEmpty(start, &none), destination.Length);
        }
        /// <summary>The same in an array of its own.</summary>
        public byte[] Read()
        {
            byte[] bytes = new byte[Waiting];
            int size = bytes.Length == 0 ? 0 : Read(bytes);
            if (size < bytes.Length) Array.Resize(ref bytes, size); // another thread has read
            return bytes;
        }

        /// <summary>
        /// Leaves words at this moment of the recording, at most 4096 bytes of UTF-8. WrongStateException when the
        /// recording has ended.
        /// </summary>
        public void Note(string text) { Note(text, 0); }
        /// <summary>The same about a body; the viewer calls it by these words.</summary>
        public void Note(string text, Body about) { NoteOf(text, about.World, "body", about.Handle.Value); }
        /// <summary>The same about a shape.</summary>
        public void Note(string text, Shape about) { NoteOf(text, about.World, "shape", about.Handle.Value); }
        /// <summary>The same about a joint.</summary>
        public void Note(string text, Joint about) { NoteOf(text, about.World, "joint", about.Handle.Value); }

        void NoteOf(string text, World of, string what, ulong about)
        {
            World.CheckMine(world, of, "Recorder.Note", what, about);
            Note(text, about);
        }
        void Note(string text, ulong about)
        {
            if (text == null) throw new BadArgumentException("Recorder.Note: the text is null");
            if (text.IndexOf('\0') >= 0) throw new BadArgumentException("Recorder.Note: the text has a zero in it");
            byte[] bytes = Encoding.UTF8.GetBytes(text + "\0");
            bool held = false;
            try
            {
                fixed (byte* start = bytes) Native.recorder_note(Enter(ref held), about, start);
            }
            finally { Leave(held); }
        }

        /// <summary>Ends the recording. What nobody read is lost.</summary>
        public void Dispose()
        {
            disposed = true;
            safe.Dispose();
        }
    }

    /// <summary>
    /// A recording that goes to a stream while the world steps, each 15 steps, with RecordFlags.Fine each step, and at
    /// Dispose. No step fails because somebody records: <see cref="Flush"/> and Dispose throw what went wrong.
    /// </summary>
    public sealed class Recording : IDisposable
    {
        const int DrainSteps = 15; // a quarter of a second is lost by a crash

        readonly World world;
        readonly Recorder recorder;
        readonly Stream stream;
        readonly bool ownsStream;
        readonly int interval;
        readonly object inside = new object(); // who reads first writes first
        byte[] buffer = new byte[0];
        Exception failure;
        int steps;
        bool ended;

        internal Recording(World world, RecorderDef def, Func<Stream> open, bool ownsStream)
        {
            if ((def.Flags & RecordFlags.Last) != 0)
                throw new BadArgumentException("World.Record: a flight recorder is read as a whole; make a Recorder");
            recorder = new Recorder(world, def);
            try { stream = open(); } // a file that was there stays, when the world cannot be recorded
            catch
            {
                recorder.Dispose();
                throw;
            }
            this.world = world;
            this.ownsStream = ownsStream;
            interval = (def.Flags & RecordFlags.Fine) != 0 ? 1 : DrainSteps;
        }

        internal void AfterStep()
        {
            if (++steps < interval) return;
            steps = 0;
            Drain();
        }

        // Nothing is written behind a gap.
        void Drain()
        {
            lock (inside)
            {
                if (failure != null || ended) return;
                try
                {
                    long waiting = recorder.Waiting;
                    if (waiting > buffer.Length) buffer = new byte[waiting + waiting / 2];
                    int size = waiting == 0 ? 0 : recorder.Read(buffer);
                    if (size > 0) stream.Write(buffer, 0, size);
                }
                catch (Exception e) { failure = e; }
            }
        }

        void ThrowFailure()
        {
            if (failure != null) throw new IOException("Recording: " + failure.Message, failure);
        }

        /// <summary>As <see cref="Recorder.Note(string)"/>.</summary>
        public void Note(string text) { recorder.Note(text); }
        /// <summary>As <see cref="Recorder.Note(string, Body)"/>.</summary>
        public void Note(string text, Body about) { recorder.Note(text, about); }
        /// <summary>As <see cref="Recorder.Note(string, Shape)"/>.</summary>
        public void Note(string text, Shape about) { recorder.Note(text, about); }
        /// <summary>As <see cref="Recorder.Note(string, Joint)"/>.</summary>
        public void Note(string text, Joint about) { recorder.Note(text, about); }

        /// <summary>
        /// Writes all that was recorded until now. IOException for what went wrong since the recording began.
        /// </summary>
        public void Flush()
        {
            Drain();
            lock (inside)
            {
                ThrowFailure();
                if (!ended) stream.Flush();
            }
        }

        /// <summary>
        /// Writes the rest, ends the recording, and closes the file that it opened. Throws what Flush would.
        /// </summary>
        public void Dispose()
        {
            Drain();
            lock (inside)
            {
                if (ended) return;
                ended = true;
                world.EndRecording(this);
                recorder.Dispose();
                try
                {
                    if (ownsStream) stream.Dispose();
                    else if (failure == null) stream.Flush();
                }
                catch (Exception e) { failure = failure ?? e; }
                ThrowFailure();
            }
        }
    }

    public sealed unsafe partial class World
    {
        volatile Recording recording;

        /// <summary>
        /// Records this world to a file, from now on: <c>using (world.Record("run.feather"))</c>. The file grows with
        /// the steps, and has all of it at the end, whatever is thrown. Exceptions as of a <see cref="Recorder"/>, and
        /// of the file.
        /// </summary>
        /// <param name="path">a file that is there is replaced, once the world can be recorded</param>
        /// <param name="def">null: the defaults; not with RecordFlags.Last, which is for a Recorder</param>
        public Recording Record(string path, RecorderDef def = null)
        {
            if (path == null) throw new BadArgumentException("World.Record: the path is null");
            Func<Stream> open = () => new FileStream(path, FileMode.Create, FileAccess.Write, FileShare.Read);
            return recording = new Recording(this, def ?? new RecorderDef(), open, true);
        }
        /// <summary>The same to a stream, which stays open.</summary>
        public Recording Record(Stream stream, RecorderDef def = null)
        {
            if (stream == null) throw new BadArgumentException("World.Record: the stream is null");
            return recording = new Recording(this, def ?? new RecorderDef(), () => stream, false);
        }
        internal void EndRecording(Recording ended) { if (recording == ended) recording = null; }
    }
}
