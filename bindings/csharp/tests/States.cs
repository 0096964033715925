// The laws of clones and of states in memory.
using System;
using System.Numerics;

namespace FeatherPhysics.Tests
{
    public static partial class Laws
    {
        public static void A_clone_goes_on_as_the_world_does()
        {
            using (Store store = new Store())
            using (World world = Pile(store, 1))
            {
                Run(world, 20);
                using (World twin = world.Clone())
                using (Pool pool = new Pool(2))
                using (World other = world.Clone(new WorldDef { Simd = Simd.Plain }, pool))
                {
                    Check.True(twin.Hash == world.Hash && other.Hash == world.Hash, "alike at first");
                    Check.True(twin.Store == store && other.Counters.Workers == 2, "store and pool");
                    Check.True(Equal(twin.Save(), world.Save()), "handles and user data, too");
                    ulong expected = Play(world, 40);
                    Check.Same(Play(twin, 40), expected, "the twin");
                    Check.Same(Play(other, 40), expected, "the other");
                    twin.Gravity = new Vector3(1, 0, 0);
                    Check.True(Play(twin, 1) != Play(world, 1), "a world of its own");
                }
            }
        }

        public static void A_clone_outlives_the_world_and_the_store()
        {
            World twin, other;
            ulong expected;
            using (Store store = new Store())
            using (World world = Pile(store, 1))
            {
                twin = world.Clone();
                expected = Play(world, 30);
            }
            Check.Same(Play(twin, 30), expected, "without the world");
            twin.Dispose();
            using (World world = new World())
            {
                world.CreateDynamic(new DVec3(0, 9, 0)).AddHull(world.CreateHull(Cube));
                other = world.Clone();
                expected = Play(world, 30);
            }
            Check.Same(Play(other, 30), expected, "whose store was the world's own");
            ConvexHull made = other.CreateHull(Cube);
            Check.True(made.IsValid && made.Store == other.Store, "its store serves on");
            other.Dispose();
            Check.Throws<ObjectDisposedException>(() => other.Clone(), "disposed");
            Check.Throws<ObjectDisposedException>(() => other.GetState(), "disposed");
        }

        public static void A_clone_has_the_pair_filter()
        {
            World world = new World();
            world.CreateStatic(new DVec3()).AddPlane(0, 1, 0, 0);
            Body ball = world.CreateDynamic(new DVec3(0, 0.4, 0));
            ball.AddSphere(0.5f, new ShapeDef { PairFilter = true });
            int asked = 0;
            world.SetPairFilter(pair => { ++asked; return false; });
            State state = world.GetState();
            World twin = world.Clone();
            world.Dispose();
            Run(twin, 10);
            Check.True(asked > 0 && twin[ball.Handle].Position.Y < 0.4, "it falls through the ground");
            twin.SetState(state);
            twin.SetPairFilter(pair => { twin.SetState(state); return true; });
            Check.Throws<WorldSteppingException>(() => twin.Step(Dt), "fe_world_set_state");
            twin.SetState(state);
            twin.SetPairFilter(pair => { twin.Clone().Dispose(); return true; });
            Check.Throws<WorldSteppingException>(() => twin.Step(Dt), "fe_world_clone");
            twin.Dispose();
            state.Dispose();
        }

        public static void A_state_is_gone_back_to()
        {
            using (Store store = new Store())
            using (World world = Pile(store, 2))
            {
                Run(world, 10);
                State state = world.GetState();
                ulong first = world.Hash, expected = Play(world, 30);
                Body late = world.CreateBody();
                world.SetState(state);
                Check.True(world.Hash == first && !late.IsValid, "as it was");
                Check.Same(Play(world, 30), expected, "it goes on");
                using (World twin = world.Clone())
                {
                    twin.SetState(state);
                    Check.True(twin.Hash == first && Play(twin, 30) == expected, "a clone");
                }
                using (World other = new World(null, null, store))
                {
                    other.SetState(state);
                    Check.True(other.Hash == first && Play(other, 30) == expected, "another world of the store");
                }
                using (World stranger = new World())
                {
                    ulong before = stranger.Hash;
                    Check.Throws<WrongStateException>(() => stranger.SetState(state), "another store");
                    Check.Same(stranger.Hash, before, "nothing changed");
                }
                Check.Throws<BadArgumentException>(() => world.SetState(null), "null");
                Check.Throws<BadArgumentException>(() => new State(null), "null");
                state.Dispose();
                state.Dispose();
                Check.Throws<ObjectDisposedException>(() => world.SetState(state), "disposed");
            }
        }

        public static void A_state_keeps_its_store()
        {
            State state;
            using (Store store = new Store())
            using (World world = Pile(store, 1)) state = world.GetState();
            using (World stranger = new World())
                Check.Throws<WrongStateException>(() => stranger.SetState(state), "another store");
            state.Dispose();
            World gone = new World();
            gone.Dispose();
            Check.Throws<ObjectDisposedException>(() => gone.SetState(state), "disposed");
        }

        public static void Thousands_of_states_leave_nothing_behind()
        {
            using (Store store = new Store())
            using (World world = Pile(store, 1))
            {
                Run(world, 5);
                ulong then = world.Hash;
                for (int i = 0; i < 3000; ++i)
                {
                    State state = world.GetState();
                    world.Step(Dt);
                    world.SetState(state);
                    if (i % 2 == 0) state.Dispose();
                    if (i % 30 == 0) world.Clone(); // the collector's
                }
                GC.Collect();
                GC.WaitForPendingFinalizers();
                Check.Same(world.Hash, then, "hash");
            }
        }
    }
}
