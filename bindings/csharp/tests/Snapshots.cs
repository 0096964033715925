// The laws of snapshots: a world as bytes, and back. docs/SNAPSHOTS.md has what they are.
using System;
using System.Numerics;

namespace FeatherPhysics.Tests
{
    public static partial class Laws
    {
        /// A pile of four forms on a hull's floor, with six joints, a slider that moves it, and one body with 42.
        static World Pile(Store store, int workers)
        {
            World world = new World(new WorldDef { WorkerCount = workers }, null, store);
            ConvexHull slab = store.CreateHull(Cube);
            world.CreateStatic(new DVec3(0, -1, 0)).Add(Geometry.Hull(slab).Scaled(20, 1, 20));
            Body before = default(Body);
            for (int i = 0; i < 40; ++i)
            {
                Body body = world.CreateDynamic(new DVec3(i % 5 * 0.9, 0.6 + i / 5 * 0.9, i % 3 * 0.4));
                ShapeDef def = new ShapeDef { Events = ShapeEvents.Touch | ShapeEvents.Hit };
                if (i % 4 == 0) body.AddBox(0.4f, 0.3f, 0.4f, def);
                if (i % 4 == 1) body.AddSphere(0.4f, def);
                if (i % 4 == 2) body.AddCapsule(0.2f, 0.3f, def);
                if (i % 4 == 3) body.Add(Geometry.Hull(slab).Scaled(0.4f, 0.3f, 0.4f), def);
                if (i % 7 == 3) world.CreateBallJoint(before, body, body.Position, new Vector3(0, 1, 0));
                before = body;
            }
            before.UserData = 42;
            world.CreateBody(new BodyDef { Type = BodyType.Kinematic, Position = new DVec3(-4, 0.5, 0),
                LinearVelocity = new Vector3(1, 0, 0) }).AddBox(0.5f, 0.5f, 4);
            return world;
        }

        /// All that a step tells, too.
        static ulong Play(World world, int steps)
        {
            ulong told = 0;
            for (int i = 0; i < steps; ++i)
            {
                world.Step(Dt);
                foreach (PairEvent e in world.PairEvents) told = told * 31 + e.ShapeA.Value + 3 * e.ShapeB.Value;
                foreach (HitEvent e in world.HitEvents) told = told * 31 + e.ShapeA.Value + 3 * e.ShapeB.Value;
            }
            return told * 31 + world.Hash;
        }

        public static void A_history_goes_back_and_on()
        {
            using (Store store = new Store())
            using (World world = Pile(store, 2))
            {
                ulong[] hashes = new ulong[20];
                HistoryFrame[] frames = new HistoryFrame[20];
                History history = new History(world, new HistoryDef { Frames = 8 });
                for (int frame = 0; frame < 20; ++frame)
                {
                    history.Keep(frame);
                    hashes[frame] = world.Hash;
                    world.Step(Dt);
                }
                Check.Same(history.GetFrames(frames), 8, "frames");
                Check.True(frames[0].Frame == 12 && frames[7].Frame == 19 && frames[0].Bytes > 1000, "which");
                Body late = world.CreateDynamic(new DVec3(0, 50, 0));
                history.Restore(13);
                Check.True(!late.IsValid, "what was made since is gone");
                for (int frame = 14; frame < 20; ++frame)
                {
                    world.Step(Dt);
                    history.Keep(frame);
                    Check.Same(world.Hash, hashes[frame], "hash of frame " + frame);
                }
                Check.Throws<StaleHandleException>(() => history.Restore(11), "frame 11");
                Check.Throws<BadArgumentException>(() => history.Keep(19), "above 19");
                Check.Throws<BadArgumentException>(() => new History(world, new HistoryDef { Frames = 0 }), "frames");
                Check.Throws<BadArgumentException>(() => new History(null), "null");
                history.Dispose();
                history.Dispose();
                Check.Throws<ObjectDisposedException>(() => history.Keep(30), "disposed");
                history = new History(world);
                world.Dispose();
                Check.Throws<ObjectDisposedException>(() => history.Keep(1), "disposed");
                history.Dispose();
            }
        }

        public static void A_restored_world_goes_on_bit_for_bit()
        {
            using (Store store = new Store())
            using (World world = Pile(store, 1))
            {
                Run(world, 30);
                ulong then = world.Hash;
                byte[] saved = world.Save();
                Check.Same(world.GetSnapshotSize(), (long)saved.Length, "the size");
                int events = world.PairEvents.Length + world.HitEvents.Length;
                ulong later = Play(world, 60);
                Check.True(world.Hash != then, "it moves");
                Check.True(world.Restore(saved), "of this library");
                Check.True(world.Hash == then && Equal(world.Save(), saved), "what it was");
                Check.Same(world.PairEvents.Length + world.HitEvents.Length, events, "what it told");
                Check.Same(Play(world, 60), later, "in place");
                using (World other = new World(new Vector3(0, 0, 1)))
                {
                    Check.Throws<WrongStateException>(() => other.Restore(saved), "key");
                    Check.True(other.Restore(world.Save(true)), "a world that was another");
                    Check.Same(Play(other, 60), Play(world, 60), "goes the same way");
                }
                for (int workers = 1; workers <= 3; workers += 2)
                    using (World loaded = World.Load(saved, new WorldDef { WorkerCount = workers }, null, store))
                    {
                        Check.True(loaded.Counters.Workers == workers && loaded.Store == store, "its own");
                        Check.True(loaded.Hash == then && Equal(loaded.Save(), saved), "loaded");
                        Check.Same(Play(loaded, 60), later, "loaded, with workers: " + workers);
                    }
                using (Pool pool = new Pool(2))
                using (World loaded = World.Load(saved, null, pool, store))
                    Check.True(loaded.Counters.Workers == 2 && Play(loaded, 60) == later, "with a pool");
            }
        }

        public static void Handles_are_those_of_the_saved_world()
        {
            using (World world = new World(new WorldDef { Number = 9 }))
            {
                Body first = world.CreateDynamic(new DVec3(1, 2, 3)), second = world.CreateBody();
                Shape shape = first.AddSphere(0.5f);
                first.UserData = 42;
                byte[] saved = world.Save();
                second.Destroy();
                first.UserData = 7;
                first.Position = new DVec3();
                Body late = world.CreateBody();
                Check.True(!second.IsValid && late.IsValid, "before");
                world.Restore(saved);
                Check.True(first.IsValid && second.IsValid && shape.Body == first, "there again");
                Check.True(first.UserData == 42 && first.Position == new DVec3(1, 2, 3), "as it was");
                Check.True(!late.IsValid, "made since");
                Check.Throws<StaleHandleException>(() => { DVec3 p = late.Position; }, "body");
                using (World twin = World.Load(saved))
                {
                    Check.Same(twin.Number, 9u, "the saved world's number");
                    Check.Same(twin[first.Handle].UserData, 42ul, "and its handles");
                    twin.Restore(saved, new RestoreOptions { NewNumber = true });
                    Check.Same(twin.Number, 9u, "its own number is that by now");
                }
                using (World twin = World.Load(saved, new WorldDef { Number = 11 }, null, null,
                    new RestoreOptions { NewNumber = true }))
                {
                    Check.True(twin.Number == 11 && twin.Counters.Bodies == 2, "a number of its own");
                    Check.Throws<StaleHandleException>(() => { DVec3 p = twin[first.Handle].Position; }, "world");
                }
            }
        }

        public static void A_difference_goes_with_its_base()
        {
            using (Store store = new Store())
            using (World world = Pile(store, 1))
            {
                Run(world, 30);
                byte[] first = world.Save();
                Run(world, 1);
                byte[] whole = world.Save(), diff = world.SaveDiff(first);
                Check.True(diff.Length < whole.Length, "it is smaller");
                Check.True(world.SaveDiff(whole).Length <= 64, "nothing changed");
                Run(world, 5);
                RestoreOptions options = new RestoreOptions { Base = first };
                Check.True(world.Restore(diff, options) && Equal(world.Save(), whole), "in place");
                using (World loaded = World.Load(diff, null, null, store, options))
                    Check.True(Equal(loaded.Save(), whole), "anew");
                Check.Throws<BadDataException>(() => world.Restore(diff), "base");
                Check.Throws<BadDataException>(() => world.Restore(diff, new RestoreOptions { Base = whole }),
                    "another base");
                Check.Throws<BadDataException>(() => Snapshot.Check(diff), "difference");
                Check.Throws<BadDataException>(() => world.SaveDiff(diff), "base");
                Check.Throws<BadDataException>(() => world.SaveDiff(ReadOnlySpan<byte>.Empty), "base");
                Check.Throws<BadArgumentException>(() => world.SaveDiff(new byte[8], first), "destination");
                Check.True(Equal(world.Save(), whole), "nothing has changed");
            }
        }

        public static void A_snapshot_tells_what_is_in_it()
        {
            using (Store store = new Store())
            using (World world = Pile(store, 1))
            {
                Run(world, 12);
                SnapshotInfo info = Snapshot.Check(world.Save());
                Check.True(info.Step == 12 && info.Number == world.Number && info.Library == World.Version, "whose");
                Check.True(info.Bodies == 42 && info.Shapes == 42 && info.Joints == world.Counters.Joints, "how many");
                Check.True(!info.Foreign && !info.Filter, "switches");
                Check.True(info.Assets == 2 && info.Inside == 0, "one hull under two scales, by its key");
                Check.Same(Snapshot.Check(world.Save(true)).Inside, 1, "its content, once");
                AssetKey[] keys = new AssetKey[3];
                AssetKey key = store.CreateHull(Cube).GetKey();
                Check.Same(Snapshot.GetAssets(world.Save(), default(Span<AssetKey>)), 2, "counted");
                Check.Same(Snapshot.GetAssets(world.Save(), keys), 2, "told");
                Check.True(keys[0] == key && keys[1] == key && keys[2] == default(AssetKey), "which");
                Check.Throws<BadDataException>(() => Snapshot.GetAssets(null, keys), "there are 0 bytes");
            }
        }

        public static void The_first_difference_is_named()
        {
            using (Store store = new Store())
            using (World world = Pile(store, 1))
            {
                Run(world, 12);
                byte[] saved = world.Save();
                Check.True(Snapshot.Compare(saved, world.Save()) == null, "none");
                world.Gravity = new Vector3(0, -2.5f, 0);
                Difference found = Snapshot.Compare(saved, world.Save());
                Check.True(found.Kind == "world" && found.Field == "gravity" && found.Element == 1, "where");
                Check.True(found.B == "-2.5" && found.A != found.B && found.Handle == 0, "values");
                Check.Throws<BadDataException>(() => Snapshot.Compare(saved, null), "b: there are 0 bytes");
            }
        }

        public static void Assets_have_keys_of_their_content()
        {
            using (World world = new World(), other = new World())
            {
                Heightfield field = world.CreateHeightfield(new HeightfieldDef { Rows = 2, Columns = 2,
                    Heights = new float[] { 0, 1, 2, 3 } });
                AssetKey flat = field.GetKey();
                Check.Same(other.Store.LoadHeightfield(field.Save()).GetKey(), flat, "equal content");
                field.SetHeights(0, 0, 1, 1, new float[] { 5 });
                Check.True(field.GetKey() != flat, "an edited heightfield");
                TriangleMesh mesh = world.CreateMesh(Cube, new[] { 0, 1, 2 });
                Check.True(mesh.GetKey() == other.CreateMesh(Cube, new[] { 0, 1, 2 }).GetKey() &&
                    mesh.GetKey() != other.CreateMesh(Cube, new[] { 0, 1, 3 }).GetKey(), "meshes");
                Compound compound = world.CreateCompound(new CompoundPart(Geometry.Sphere(1)));
                Check.True(compound.GetKey() != world.CreateCompound(new CompoundPart(Geometry.Sphere(2))).GetKey(),
                    "compounds");
                AssetKey key = new AssetKey(0x12, ulong.MaxValue - 1);
                Check.Same(key.ToString(), "0000000000000012fffffffffffffffe", "32 digits");
                Check.True(key.Equals((object)new AssetKey(0x12, ulong.MaxValue - 1)) && !key.Equals(null) &&
                    key != new AssetKey(0x12, 0) && key != new AssetKey(0, ulong.MaxValue - 1), "equality");
                compound.Destroy();
                Check.Throws<StaleHandleException>(() => compound.GetKey(), "asset");
                Check.Throws<StaleHandleException>(() => default(Heightfield).GetKey(), "Heightfield");
            }
        }

        public static void Assets_are_found_in_the_store_the_bytes_or_the_options()
        {
            using (World world = new World(), other = new World())
            {
                ConvexHull hull = world.CreateHull(Cube);
                world.CreateDynamic(new DVec3(0, 5, 0)).AddHull(hull);
                byte[] saved = world.Save();
                Check.Throws<WrongStateException>(() => World.Load(saved), hull.GetKey().ToString().Substring(16));
                using (World loaded = World.Load(world.Save(true)))
                    Check.Same(Play(loaded, 9), Play(world, 9), "inside");
                other.CreateHull(Cube);
                Check.True(other.Restore(saved), "in its store");
                Vector3[] points = (Vector3[])Cube.Clone();
                points[7] = new Vector3(2, 1, 1);
                ConvexHull longer = other.CreateHull(points);
                RestoreOptions options = new RestoreOptions { Keys = new[] { hull.GetKey() },
                    Assets = new[] { longer.Handle } };
                Check.True(other.Restore(saved, options), "in the options");
                BodyHandle[] bodies = new BodyHandle[1];
                ShapeHandle[] shapes = new ShapeHandle[1];
                other.GetBodies(bodies);
                other[bodies[0]].GetShapes(shapes);
                Check.Same(other[shapes[0]].Geometry.Asset, longer.Handle, "it stands for the other");
                ulong hash = other.Hash;
                options.Assets = new[] { hull.Handle };
                Check.Throws<StaleHandleException>(() => other.Restore(saved, options), "assets");
                options.Assets = null;
                Check.Throws<BadArgumentException>(() => other.Restore(saved, options), "Assets has 0");
                options.Assets = new AssetHandle[2];
                Check.Throws<BadArgumentException>(() => World.Load(saved, null, null, null, options), "Keys has 1");
                Check.Same(other.Hash, hash, "nothing has changed");
                world.CreateDynamic(new DVec3(0, 9, 0))
                    .AddCompound(world.CreateCompound(new CompoundPart(Geometry.Sphere(1))));
                Check.True(world.Restore(world.Save()), "by its key");
                using (World elsewhere = World.Load(world.Save(true)))
                    Check.Same(elsewhere.Hash, world.Hash, "with its contents");
            }
        }

        public static void Wrong_bytes_are_named_and_change_nothing()
        {
            using (Store store = new Store())
            using (World world = Pile(store, 1))
            {
                Run(world, 20);
                byte[] saved = world.Save(), before = world.Save(), newer = world.Save();
                byte[] asset = store.CreateHull(Cube).Save();
                long kept = store.Bytes;
                Action<byte[], string> refuse = (bytes, named) =>
                {
                    Check.Throws<BadDataException>(() => world.Restore(bytes), named);
                    Check.Throws<BadDataException>(() => World.Load(bytes, null, null, store), named);
                    Check.Throws<BadDataException>(() => Snapshot.Check(bytes), named);
                };
                refuse(null, "there are 0 bytes");
                refuse(new byte[0], "there are 0 bytes");
                refuse(new byte[4096], "no bytes of fe_world_save");
                refuse(asset, "no bytes of fe_world_save");
                refuse(saved.AsSpan(0, saved.Length - 8).ToArray(), "byte 24");
                for (int i = 0; i < 64; ++i)
                {
                    int at = 24 + (int)(i * (saved.Length - 24L) / 64); // behind the version
                    saved[at] ^= 1;
                    refuse(saved, "byte");
                    saved[at] ^= 1;
                }
                newer[8] = 9; // the major number
                Check.Throws<NewerVersionException>(() => world.Restore(newer), "newer library");
                Check.Throws<NewerVersionException>(() => World.Load(newer, null, null, store), "newer library");
                Check.Throws<NewerVersionException>(() => Snapshot.Check(newer), "newer library");
                Check.True(Equal(world.Save(), before), "nothing has changed");
                Check.Throws<BadArgumentException>(() => world.Save(saved.AsSpan(1)),
                    "destination has " + (saved.Length - 1) + " elements, " + saved.Length);
                Check.Throws<BadArgumentException>(() => world.Save(Span<byte>.Empty), "destination has 0");
                byte[] longer = new byte[saved.Length + 3];
                longer[saved.Length] = 7;
                Check.Same(world.Save(longer), saved.Length, "into a longer array");
                Check.True(Equal(longer.AsSpan(0, saved.Length).ToArray(), saved) && longer[saved.Length] == 7,
                    "the rest stays");
                Check.Same(store.Bytes, kept, "nothing is left");
            }
        }

        // ---- of another library ----

        const ulong Factor = 0x9E3779B97F4A7C15; // src/core/bytes.h

        static ulong SumOfHeader(byte[] bytes)
        {
            ulong[] words = // src/snapshot/format.h: not the number, nor the sum; their count, and two to mix
            {
                BitConverter.ToUInt64(bytes, 0), BitConverter.ToUInt64(bytes, 8), BitConverter.ToUInt32(bytes, 16),
                BitConverter.ToUInt64(bytes, 24), BitConverter.ToUInt64(bytes, 40), 5, 0, 0,
            };
            ulong state = 0;
            foreach (ulong word in words)
            {
                state = (state ^ word) * Factor;
                state ^= state >> 32;
            }
            return state;
        }

        /// The same snapshot from a library whose results have another number.
        static byte[] OfAnotherLibrary(byte[] saved)
        {
            byte[] made = (byte[])saved.Clone();
            ulong inverse = 1; // of the factor, modulo 2^64: each round doubles the right bits
            for (int i = 0; i < 6; ++i) inverse *= 2 - Factor * inverse;
            ulong sections = (BitConverter.ToUInt64(saved, 32) - 1) * inverse ^ SumOfHeader(saved);
            made[12] ^= 0x40;
            BitConverter.GetBytes((sections ^ SumOfHeader(made)) * Factor + 1).CopyTo(made, 32);
            return made;
        }

        public static void A_snapshot_of_a_library_with_other_results_is_taken_and_told()
        {
            using (World world = new World())
            {
                Ground(world);
                world.CreateDynamic(new DVec3(0, 1, 0)).AddSphere(0.5f);
                Run(world, 10);
                byte[] saved = world.Save(), foreign = OfAnotherLibrary(saved);
                Check.True(Snapshot.Check(foreign).Foreign && !Snapshot.Check(saved).Foreign, "told before");
                Run(world, 10);
                Check.True(!world.Restore(foreign), "told by the restore");
                Check.True(Equal(world.Save(), saved), "taken");
                using (World loaded = World.Load(foreign)) Check.True(Equal(loaded.Save(), saved), "loaded");
            }
        }

        // ---- who may call ----

        public static void A_world_with_a_pair_filter_is_restored_in_one_that_has_one()
        {
            using (World world = new World(), other = new World())
            {
                Ground(world);
                Shape ball = world.CreateDynamic(new DVec3(0, 3, 0)).AddSphere(0.5f);
                ball.PairFilter = true;
                int asked = 0;
                world.SetPairFilter(pair => { ++asked; return false; });
                byte[] saved = world.Save();
                Check.True(Snapshot.Check(saved).Filter, "told");
                Check.Throws<WrongStateException>(() => World.Load(saved), "pair filter");
                Check.Throws<WrongStateException>(() => other.Restore(saved), "pair filter");
                Run(world, 60);
                Check.Same(asked, 1, "falls through");
                world.Restore(saved);
                Run(world, 60);
                Check.Same(asked, 2, "the filter stays");
                int others = 0;
                other.SetPairFilter(pair => { ++others; return true; });
                other.Restore(saved);
                Run(other, 120);
                Check.True(others == 1 && asked == 2, "another world has its own");
                Check.Near(other[ball.Body.Handle].Position.Y, 0.5, Slop, "which lets it rest");

                world.Restore(saved);
                byte[] room = new byte[saved.Length];
                Exception[] thrown = new Exception[2];
                world.SetPairFilter(pair =>
                {
                    try { world.Restore(saved); }
                    catch (FeatherException e) { thrown[0] = e; }
                    try { world.Save(room); }
                    catch (FeatherException e) { thrown[1] = e; }
                    return true;
                });
                Run(world, 60);
                foreach (Exception each in thrown)
                    Check.True(each is WorldSteppingException, "inside a step: " + each);
            }
        }

        public static void A_disposed_world_is_not_saved()
        {
            World world = new World();
            byte[] saved = world.Save();
            world.Dispose();
            Check.Throws<ObjectDisposedException>(() => world.Save(), "disposed");
            Check.Throws<ObjectDisposedException>(() => world.Save(saved), "disposed");
            Check.Throws<ObjectDisposedException>(() => world.GetSnapshotSize(), "disposed");
            Check.Throws<ObjectDisposedException>(() => world.Restore(saved), "disposed");
            Pool pool = new Pool(2);
            pool.Dispose();
            Check.Throws<ObjectDisposedException>(() => World.Load(saved, null, pool), "pool");
            using (World loaded = World.Load(saved))
                Check.Throws<BadArgumentException>(() => World.Load(saved, null, null, loaded.Store), "store");
        }
    }
}
