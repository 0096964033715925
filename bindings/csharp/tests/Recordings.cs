// The laws of recorders and players.
using System;
using System.IO;
using System.Numerics;

namespace FeatherPhysics.Tests
{
    public static partial class Laws
    {
        static string TemporaryFile() { return Path.Combine(Path.GetTempPath(), Path.GetRandomFileName()); }

        // A stream whose disk is full after so many bytes
        sealed class FullStream : MemoryStream
        {
            readonly int room;
            public FullStream(int room) { this.room = room; }
            public override void Write(byte[] buffer, int offset, int count)
            {
                if (Length + count > room) throw new IOException("the disk is full");
                base.Write(buffer, offset, count);
            }
        }

        static World Boxes()
        {
            World world = new World();
            Ground(world);
            for (int i = 0; i < 20; ++i)
                world.CreateDynamic(new DVec3(i % 3 * 0.4, 1 + i * 0.7, 0)).AddBox(0.4f, 0.3f, 0.4f);
            return world;
        }

        // A ball falls on a plane for so many steps, and is pushed in the middle
        static byte[] RecordFall(int steps, RecorderDef def, out ulong hash, out Body ball)
        {
            using (World world = new World(new WorldDef { Number = 7 }))
            {
                Ground(world);
                using (Recorder recorder = new Recorder(world, def))
                {
                    ball = world.CreateDynamic(new DVec3(0, 1, 0));
                    ball.AddSphere(0.5f);
                    recorder.Note("the ball", ball);
                    Run(world, steps / 2);
                    ball.AddImpulse(new Vector3(100, 50, 0));
                    recorder.Note("é, pushed");
                    Run(world, steps - steps / 2);
                    hash = world.Hash;
                    byte[] bytes = recorder.Read();
                    Check.True(recorder.Waiting == 0 && recorder.Read().Length == 0, "nothing waits");
                    return bytes;
                }
            }
        }

        public static void A_recording_plays_to_the_same_world()
        {
            ulong hash;
            Body ball;
            byte[] bytes = RecordFall(60, null, out hash, out ball);
            using (Pool pool = new Pool(2))
            using (Player player = new Player(new PlayerDef { Simd = Simd.Plain }, pool))
            {
                for (int at = 0; at < bytes.Length; at += 100)
                    player.Feed(new ReadOnlySpan<byte>(bytes, at, Math.Min(100, bytes.Length - at)));
                Check.Throws<WrongStateException>(() => { World none = player.World; }, "step");
                int steps = 0;
                while (player.Step()) ++steps;
                Check.Same(steps, 60, "steps");
                Check.Same(player.World.Hash, hash, "hash");
                Check.True(player.Divergence == null && player.World.Counters.Workers == 2, "no divergence, the pool");
                PlayerInfo info = player.Info;
                Check.True(info.Step == 60 && info.FirstStep == 0 && info.Keyframes == 1 && info.Notes == 2 &&
                    !info.HasDiverged && !info.Foreign && info.Flags == RecordFlags.Assets &&
                    info.Bytes == bytes.Length, info.ToString());
                RecordedNote[] notes = player.GetNotes();
                Check.True(notes.Length == 2 && notes[0].About == ball.Handle.Value && notes[0].Step == 0 &&
                    notes[0].Text == "the ball" && notes[1].Text == "é, pushed" && notes[1].Step == 30, "notes");
                Check.True(player.Seek(10) && player.Info.Step == 10 && player.World.Hash != hash, "back");
                Check.True(player.Seek(60) && player.World.Hash == hash && !player.Seek(61), "to the end, no further");
                Check.Throws<BadArgumentException>(() => player.Seek(-1), "step");
            }
        }

        public static void A_played_world_is_read_and_cloned()
        {
            ulong hash;
            Body ball;
            byte[] bytes = RecordFall(60, null, out hash, out ball);
            World clone, world;
            using (Player player = new Player())
            {
                player.Feed(bytes);
                player.Seek(40);
                world = player.World;
                Check.True(world == player.World, "the same object");
                Check.Throws<WrongStateException>(() => world.Step(Dt), "player");
                Check.Throws<WrongStateException>(() => world.CreateDynamic(new DVec3()), "player");
                Check.Throws<WrongStateException>(() => world[ball.Handle].Destroy(), "player");
                Check.Throws<WrongStateException>(() => world.SetPairFilter(pair => true), "player");
                Check.Throws<WrongStateException>(() => world.Dispose(), "player");
                Check.Throws<WrongStateException>(() => new Recorder(world), "player");
                Check.True(world[ball.Handle].Position.X > 0, "it was pushed");
                clone = world.Clone();
            }
            Check.Throws<ObjectDisposedException>(() => world.Step(Dt), "World");
            Check.True(world.IsDisposed, "it went with its player");
            using (clone)
            {
                Run(clone, 20);
                Check.Same(clone.Hash, hash, "the clone goes on");
            }
        }

        // The first keyframe of a ball that flies at that speed, then its steps
        static byte[][] RecordFlight(float speed, int steps, out Body ball)
        {
            using (World world = new World(new WorldDef { Number = 7 }))
            {
                ball = world.CreateDynamic(new DVec3());
                ball.AddSphere(0.5f);
                ball.LinearVelocity = new Vector3(0, 0, speed);
                using (Recorder recorder = new Recorder(world, new RecorderDef { Flags = RecordFlags.Fine }))
                {
                    byte[] first = recorder.Read();
                    Run(world, steps);
                    return new[] { first, recorder.Read() };
                }
            }
        }

        public static void A_divergence_is_named()
        {
            Body ball;
            byte[][] slow = RecordFlight(1, 20, out ball), fast = RecordFlight(2, 20, out ball);
            using (Player player = new Player())
            {
                player.Feed(slow[0]);
                player.Feed(fast[1]);
                Check.Throws<DivergedException>(() => player.Step(), "velocity");
                Divergence found = player.Divergence;
                Check.True(found.Type == DivergenceType.Step && found.Step == 1 && found.Body == ball.Handle &&
                    found.Component == 2, found.Text);
                Check.True(player.Info.HasDiverged && found.Text.Contains(found.Field), found.Text);
                while (player.Step()) { }
                Check.Same(player.Info.Step, 20L, "it goes on");
            }
        }

        public static void Broken_bytes_are_refused()
        {
            Body ball;
            byte[][] bytes = RecordFlight(1, 20, out ball);
            using (Player player = new Player())
            {
                player.Feed(bytes[0]);
                bytes[1][bytes[1].Length - 1] ^= 1;
                Check.Throws<BadDataException>(() => player.Feed(bytes[1]), "");
                Check.True(player.Seek(0) && player.World[ball.Handle].Position == new DVec3(), "what stood before it");
            }
            using (Player player = new Player())
            {
                player.Feed(default(ReadOnlySpan<byte>));
                Check.Throws<BadDataException>(() => player.Feed(new byte[100]), "");
            }
            Check.Throws<FileNotFoundException>(() => Player.Open(TemporaryFile()), "");
            Check.Throws<BadArgumentException>(() => Player.Open(null), "null");
        }

        public static void A_world_records_to_a_file()
        {
            string path = TemporaryFile();
            ulong hash;
            using (World world = Boxes())
            {
                using (Recording recording = world.Record(path))
                {
                    Check.Throws<WrongStateException>(() => world.Record(path + "2"), "recorder");
                    Check.True(!File.Exists(path + "2"), "no file for nothing");
                    recording.Note("begun");
                    Run(world, 50);
                    Check.True(new FileInfo(path).Length > 0, "it grows with the steps");
                    recording.Flush();
                    using (Player early = Player.Open(path))
                    {
                        while (early.Step()) { }
                        Check.Same(early.World.Hash, world.Hash, "while it is written");
                    }
                    Run(world, 10);
                    hash = world.Hash;
                }
                Run(world, 10);
            }
            using (Player player = Player.Open(path))
            {
                while (player.Step()) { }
                Check.Same(player.World.Hash, hash, "to its end");
            }
            File.Delete(path);
        }

        public static void A_step_does_not_fail_because_somebody_records()
        {
            using (World world = Boxes())
            {
                Recording recording = world.Record(new FullStream(3000));
                Run(world, 100);
                Check.Throws<IOException>(() => recording.Flush(), "disk");
                Check.Throws<IOException>(() => recording.Dispose(), "disk");
                recording.Dispose();
                Check.Throws<ObjectDisposedException>(() => recording.Note("late"), "Recorder");
                Check.Throws<DirectoryNotFoundException>(() => world.Record("/no/such/folder/run.feather"), "");
                using (MemoryStream stream = new MemoryStream())
                {
                    using (world.Record(stream)) Run(world, 20);
                    using (Player player = new Player())
                    {
                        player.Feed(stream.ToArray());
                        while (player.Step()) { }
                        Check.Same(player.World.Hash, world.Hash, "another begins, and its stream stays open");
                    }
                }
            }
        }

        public static void A_flight_recorder_keeps_the_last_seconds()
        {
            using (World world = Boxes())
            using (Recorder recorder = new Recorder(world, new RecorderDef {
                Flags = RecordFlags.Last | RecordFlags.Assets, KeyframeSteps = 20, BufferBytes = 1 << 18 }))
            {
                Run(world, 300);
                byte[] bytes = recorder.Read();
                Check.True(bytes.Length > 0 && bytes.Length <= 1 << 18 && recorder.Read().Length == bytes.Length, "all");
                using (Player player = new Player())
                {
                    player.Feed(bytes);
                    while (player.Step()) { }
                    Check.True(player.Info.FirstStep > 0 && player.World.Hash == world.Hash, "from a keyframe on");
                }
                Check.Throws<BadArgumentException>(() => world.Record(new MemoryStream(),
                    new RecorderDef { Flags = RecordFlags.Last }), "Recorder");
            }
        }

        public static void A_recorder_outlives_its_world()
        {
            World world = new World();
            Recorder recorder = new Recorder(world);
            world.CreateDynamic(new DVec3()).AddSphere(1);
            Run(world, 10);
            world.Dispose();
            byte[] bytes = recorder.Read();
            Check.True(bytes.Length > 0 && recorder.Read().Length == 0, "what was recorded, then nothing");
            Check.Throws<WrongStateException>(() => recorder.Note("late"), "ended");
            recorder.Dispose();
            recorder.Dispose();
            Check.Throws<ObjectDisposedException>(() => recorder.Read(), "Recorder");
            Check.Throws<ObjectDisposedException>(() => new Recorder(world), "World");
            Check.Throws<BadArgumentException>(() => new Recorder(null), "null");
        }

        static void LoseRecorders(World world)
        {
            new Recorder(new World());
            new Recorder(world);
            Player player = new Player();
            ulong hash;
            Body ball;
            player.Feed(RecordFall(10, null, out hash, out ball));
            player.Step();
        }

        public static void Lost_recorders_and_players_end()
        {
            using (World world = new World())
            {
                for (int i = 0; i < 20; ++i)
                {
                    LoseRecorders(world);
                    for (int wait = 0; ; ++wait)
                        try
                        {
                            GC.Collect();
                            GC.WaitForPendingFinalizers();
                            new Recorder(world).Dispose();
                            break;
                        }
                        catch (WrongStateException) when (wait < 200) { System.Threading.Thread.Sleep(5); }
                        // mono scans stacks by guess: what looks like the recorder may lie there a while
                }
            }
        }

        public static void Notes_are_checked()
        {
            using (World world = new World())
            using (World other = new World())
            using (Recorder recorder = new Recorder(world))
            {
                Body mine = world.CreateDynamic(new DVec3()), foreign = other.CreateDynamic(new DVec3());
                Check.Throws<BadArgumentException>(() => recorder.Note(null), "null");
                Check.Throws<BadArgumentException>(() => recorder.Note("a\0b"), "zero");
                Check.Throws<BadArgumentException>(() => recorder.Note(new string('x', 4097)), "length");
                Check.Throws<StaleHandleException>(() => recorder.Note("x", foreign), "another world");
                Check.Throws<StaleHandleException>(() => recorder.Note("x", default(Body)), "no world");
                recorder.Note(new string('x', 4096));
                recorder.Note("a sphere", mine.AddSphere(1));
            }
        }
    }
}
