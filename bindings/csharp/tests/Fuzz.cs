// Random calls with random values: each ends in a value or in one of the layer's exceptions. Members are found by
// reflection, so that new ones are called by themselves. Reflection cannot pass spans: members that take them are called
// by hand.
using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Numerics;
using System.Reflection;

namespace FeatherPhysics.Tests
{
    sealed class Fuzz
    {
        static readonly double[] Odd = { 0, -0.0, 1, -1, 0.5, 1e-3, 1e-30, 1e5, 1e9, 1e15, 1e300, double.NaN,
            double.PositiveInfinity, double.NegativeInfinity };
        static readonly Type[] Kinds = { typeof(World), typeof(Body), typeof(Shape), typeof(Joint), typeof(Heightfield),
            typeof(Compound), typeof(Store) };

        readonly Random random;
        readonly World[] worlds = new World[3];
        readonly Dictionary<Type, object[]> made = new Dictionary<Type, object[]>();
        readonly List<MethodInfo> methods = new List<MethodInfo>();
        byte[] saved = new byte[0];
        State state; // the last one made
        public long Calls, Refused;

        public Fuzz(int seed)
        {
            random = new Random(seed);
            foreach (Type kind in Kinds)
            {
                made[kind] = new object[24];
                const BindingFlags own = BindingFlags.Public | BindingFlags.Instance | BindingFlags.DeclaredOnly;
                foreach (MethodInfo method in kind.GetMethods(own))
                    if (Callable(method)) methods.Add(method);
            }
        }

        static bool Callable(MethodInfo method)
        {
            if (method.Name == "Dispose" || method.IsStatic || IsSpan(method.ReturnType)) return false;
            foreach (ParameterInfo p in method.GetParameters())
                if (IsSpan(p.ParameterType)) return false;
            return true;
        }
        static bool IsSpan(Type type) { return type.IsGenericType && type.Name.Contains("Span"); }

        double Number()
        {
            int kind = random.Next(4);
            return kind == 0 ? Odd[random.Next(Odd.Length)] : kind == 1 ? random.Next(-9,
                10) : random.NextDouble() * (kind == 2 ? 2 : 20) - 1;
        }

        object Record(Type type)
        {
            object value = Activator.CreateInstance(type, true);
            foreach (FieldInfo field in type.GetFields(BindingFlags.Public | BindingFlags.Instance))
                if (!field.IsInitOnly && (type.IsValueType || random.Next(6) == 0) &&
                    field.Name != "WorkerCount") field.SetValue(value, Value(field.FieldType));
            return value;
        }

        object Value(Type type)
        {
            if (type.IsByRef) type = type.GetElementType();
            if (type == typeof(float)) return (float)Number();
            if (type == typeof(double)) return Number();
            if (type == typeof(int)) return random.Next(5) == 0 ? random.Next(int.MinValue,
                int.MaxValue) : random.Next(-2, 12);
            if (type == typeof(uint)) return random.Next(3) == 0 ? (uint)random.Next() : 1u << random.Next(32);
            if (type == typeof(ulong)) return (ulong)random.Next() << random.Next(40);
            if (type == typeof(long)) return (long)random.Next();
            if (type == typeof(bool)) return random.Next(2) == 0;
            if (type == typeof(Switch)) return (Switch)(random.Next(2) == 0);
            if (type == typeof(object)) return random.Next(2) == 0 ? null : new object();
            if (type == typeof(Vector3)) return new Vector3((float)Number(), (float)Number(), (float)Number());
            if (type == typeof(Quaternion)) return new Quaternion((float)Number(), (float)Number(), (float)Number(),
                (float)Number());
            if (type == typeof(DVec3)) return new DVec3(Number(), Number(), Number());
            if (type.IsEnum) return Enum.ToObject(type, random.Next(-1, 8));
            if (type == typeof(World)) return worlds[random.Next(worlds.Length)];
            if (type == typeof(PairFilter)) return Filter();
            if (type == typeof(Pool)) return null;
            if (type == typeof(State)) return state;
            if (type == typeof(BodyHandle)) return new BodyHandle(Handle(typeof(Body)));
            if (type == typeof(ShapeHandle)) return new ShapeHandle(Handle(typeof(Shape)));
            if (type == typeof(JointHandle)) return new JointHandle(Handle(typeof(Joint)));
            if (type == typeof(Geometry) && random.Next(4) != 0) return Form();
            if (type == typeof(CompoundPart) && random.Next(8) != 0) return new CompoundPart(Form());
            if (made.ContainsKey(type)) return Object(type);
            if (type == typeof(HeightfieldDef) && random.Next(4) != 0) return Terrain();
            if (type.IsArray)
            {
                if (random.Next(3) == 0) return null;
                Array array = Array.CreateInstance(type.GetElementType(), random.Next(40));
                for (int i = 0; i < array.Length; ++i) array.SetValue(Value(type.GetElementType()), i);
                return array;
            }
            if (!type.IsValueType && random.Next(5) == 0) return null;
            if (type.Namespace == "FeatherPhysics") return Record(type);
            return type.IsValueType ? Activator.CreateInstance(type) : null;
        }

        PairFilter Filter()
        {
            World asked = worlds[random.Next(worlds.Length)];
            if (random.Next(3) == 0) return null;
            return pair =>
            {
                if (random.Next(4) == 0) asked.Gravity = new Vector3(0, -1, 0); // may be the world that steps
                return random.Next(2) == 0;
            };
        }

        Geometry Form()
        {
            float size = (float)random.NextDouble() + 0.1f;
            switch (random.Next(5))
            {
                case 4: return Geometry.Compound((Compound)Object(typeof(Compound)));
                case 0: return Geometry.Sphere(size);
                case 1: return Geometry.Box(size, 0.5f, 1);
                case 2: return Geometry.Capsule(size, 0.5f);
                default: return Geometry.Plane(0, 1, 0, 0);
            }
        }

        HeightfieldDef Terrain() { return new HeightfieldDef { Rows = 4, Columns = 5, CellX = 2, CellZ = 2,
            Heights = new float[20], Holes = new byte[12] }; }

        object Object(Type type)
        {
            if (type == typeof(World)) return worlds[random.Next(worlds.Length)];
            if (type == typeof(Store)) return worlds[random.Next(worlds.Length)].Store;
            return made[type][random.Next(24)] ?? Activator.CreateInstance(type);
        }

        ulong Handle(Type type)
        {
            if (random.Next(8) == 0) return (ulong)random.Next() << random.Next(40);
            object value = Object(type);
            return type == typeof(Body) ? ((Body)value).Handle.Value
                : type == typeof(Shape) ? ((Shape)value).Handle.Value : ((Joint)value).Handle.Value;
        }

        void Keep(object value)
        {
            if (value != null && made.ContainsKey(value.GetType()) && !(value is World) &&
                !(value is Store)) made[value.GetType()][random.Next(24)] = value;
        }

        void CallAny()
        {
            MethodInfo method = methods[random.Next(methods.Count)];
            if (method.Name.StartsWith("Destroy") && random.Next(4) != 0) return;
            ParameterInfo[] parameters = method.GetParameters();
            object[] arguments = new object[parameters.Length];
            for (int i = 0; i < arguments.Length; ++i) arguments[i] = Value(parameters[i].ParameterType);
            try
            {
                object value = method.Invoke(Object(method.DeclaringType), arguments);
                if (method.Name == "Clone") ((World)value).Dispose();
                if (value is State) state = (State)value;
                Keep(value);
            }
            catch (TargetInvocationException e)
            {
                if (!(e.InnerException is FeatherException) && !(e.InnerException is ObjectDisposedException))
                    throw new LawBrokenException(
                        method.DeclaringType.Name + "." + method.Name + " threw " + e.InnerException);
                ++Refused;
            }
            ++Calls;
        }

        T[] Some<T>()
        {
            T[] array = new T[random.Next(20)];
            for (int i = 0; i < array.Length; ++i) array[i] = (T)Value(typeof(T));
            return array;
        }

        void Save(World world)
        {
            bool withAssets = random.Next(2) == 0;
            byte[] room = new byte[world.GetSnapshotSize(withAssets) - random.Next(2)];
            if (world.Save(room, withAssets) != room.Length) throw new LawBrokenException("not as long as it said");
            saved = room;
        }

        /// In any world, and beside all: what was saved, or a byte of it altered.
        void Restore(World world)
        {
            byte[] bytes = (byte[])saved.Clone();
            if (bytes.Length > 0 && random.Next(2) == 0)
                bytes[random.Next(random.Next(2) == 0 ? Math.Min(48, bytes.Length) : bytes.Length)] ^= 4;
            world.Restore(bytes, (RestoreOptions)Value(typeof(RestoreOptions)));
            Snapshot.Check(bytes);
            Calls += Snapshot.GetAssets(bytes, Some<AssetKey>());
            World.Load(bytes, null, null, random.Next(2) == 0 ? world.Store : null).Dispose();
        }

        void CallWithSpans()
        {
            World world = worlds[random.Next(worlds.Length)];
            Body body = (Body)Object(typeof(Body));
            Heightfield field = (Heightfield)Object(typeof(Heightfield));
            QueryFilter filter = (QueryFilter)Value(typeof(QueryFilter));
            DVec3 a = (DVec3)Value(typeof(DVec3)), b = (DVec3)Value(typeof(DVec3));
            Geometry form = (Geometry)Value(typeof(Geometry));
            WorldTransform at = (WorldTransform)Value(typeof(WorldTransform));
            int n = random.Next(-1, 6);
            try
            {
                switch (random.Next(22))
                {
                    case 0: world.RaycastAll(a, b, Some<Hit>(), filter); break;
                    case 1: world.RaycastMany(Some<Ray>(), Some<Hit>(), filter, n > 2); break;
                    case 2: world.SweepAll(form, at, b, Some<Hit>(), filter); break;
                    case 3: world.SweepMany(form, Some<SweepPath>(), Some<Hit>(), filter, n > 2); break;
                    case 4:
                        world.Overlap(form, at, Some<BodyHandle>(), filter);
                        world.OverlapShapes(form, at, Some<ShapeOverlap>(), filter);
                        world.OverlapBounds((WorldBounds)Value(typeof(WorldBounds)), Some<ShapeHandle>(), filter);
                        break;
                    case 5: world.GetMoved(Some<BodyHandle>(), Some<WorldTransform>()); break;
                    case 6: world.GetTransforms(Some<BodyHandle>(), Some<WorldTransform>()); break;
                    case 7: world.GetTransforms(Some<BodyHandle>(), a, Some<RelativeTransform>()); break;
                    case 8: world.SetTransforms(Some<BodyHandle>(), Some<WorldTransform>()); break;
                    case 9: world.GetVelocities(Some<BodyHandle>(), Some<LinearAngular>()); break;
                    case 10: world.SetVelocities(Some<BodyHandle>(), Some<LinearAngular>()); break;
                    case 11: world.AddForces(Some<BodyHandle>(), Some<LinearAngular>()); break;
                    case 12: world.CreateBodies((BodyDef)Value(typeof(BodyDef)), Some<WorldTransform>(),
                        Some<BodyHandle>()); break;
                    case 13: world.DestroyBodies(Some<BodyHandle>()); break;
                    case 14: body.GetContacts(Some<Contact>()); break;
                    case 15: body.GetShapes(Some<ShapeHandle>()); body.GetJoints(Some<JointHandle>()); break;
                    case 16: field.SetHeights(n, n, random.Next(9), n, Some<float>()); break;
                    case 17: field.GetHeights(n, random.Next(9), n, n, Some<float>()); break;
                    case 20: Save(world); break;
                    case 21: Restore(world); break;
                    case 18: world.GetBodies(Some<BodyHandle>()); world.GetJoints(Some<JointHandle>()); break;
                    default:
                        Calls += world.PairEvents.Length + world.BodyEvents.Length;
                        Calls += world.HitEvents.Length + world.JointEvents.Length;
                        break;
                }
            }
            catch (FeatherException) { ++Refused; }
            catch (ObjectDisposedException) { ++Refused; }
            ++Calls;
        }

        /// A world now and then disposed, never one with more than a few hundred bodies.
        void Renew(int i)
        {
            if (worlds[i] != null && random.Next(2) == 0) worlds[i].Dispose();
            worlds[i] = new World(new WorldDef { WorkerCount = random.Next(1, 4) });
            for (int k = 0; k < 6; ++k)
            {
                Body body = worlds[i].CreateDynamic(new DVec3(0, k, 0));
                Keep(body);
                Keep(body.Add(Geometry.Sphere(0.5f)));
            }
        }

        public static void Run(double seconds, int seed)
        {
            Fuzz fuzz = new Fuzz(seed);
            Stopwatch clock = Stopwatch.StartNew();
            long early = 0;
            for (int i = 0; i < fuzz.worlds.Length; ++i) fuzz.Renew(i);
            for (int round = 0; clock.Elapsed.TotalSeconds < seconds; ++round)
            {
                if (round % 400 == 0) fuzz.Renew(round / 400 % fuzz.worlds.Length);
                if (fuzz.random.Next(4) == 0) fuzz.CallWithSpans();
                else fuzz.CallAny();
                if (early == 0 && clock.Elapsed.TotalSeconds > seconds / 2) early = Resident();
            }
            long late = Resident();
            Console.WriteLine("fuzz: seed {0}, {1} calls, {2} refused, {3} MB at half time, {4} MB at the end", seed,
                fuzz.Calls, fuzz.Refused, early >> 20, late >> 20);
            Check.True(late - early < 200L << 20, "memory grows");
            Check.True(fuzz.Calls - fuzz.Refused > fuzz.Calls / 20, "hardly a call is answered");
        }

        static long Resident()
        {
            GC.Collect();
            GC.WaitForPendingFinalizers();
            using (Process self = Process.GetCurrentProcess()) return self.WorkingSet64;
        }
    }
}
