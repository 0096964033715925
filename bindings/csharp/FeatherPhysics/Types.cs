// Values that go in and out: positions in double, handles, switches. Vectors and quaternions are those of
// System.Numerics, in Unity those of UnityEngine. All have the layout of feather.h's records.
using System;
using System.Runtime.InteropServices;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    /// <summary>A world position, m, or a translation of a query, in double.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct DVec3 : IEquatable<DVec3>
    {
        /// <summary>m, or as its field says.</summary>
        public double X, Y, Z;

        /// <summary>Of its three numbers.</summary>
        public DVec3(double x, double y, double z) { X = x; Y = y; Z = z; }

        /// <summary>Rounds to float: near the origin only. <see cref="RelativeTo"/> serves far away.</summary>
        public static explicit operator Vector3(DVec3 a) { return new Vector3((float)a.X, (float)a.Y, (float)a.Z); }

        /// <summary>The same in double.</summary>
        public static explicit operator DVec3(Vector3 a)
        {
#if UNITY_5_3_OR_NEWER
            return new DVec3(a.x, a.y, a.z);
#else
            return new DVec3(a.X, a.Y, a.Z);
#endif
        }

        /// <summary>The position seen from an origin, as of a floating-origin game or a camera.</summary>
        public Vector3 RelativeTo(DVec3 origin) { return (Vector3)(this - origin); }

        /// <summary>Each number by itself.</summary>
        public static DVec3 operator +(DVec3 a, DVec3 b) { return new DVec3(a.X + b.X, a.Y + b.Y, a.Z + b.Z); }
        /// <summary>Each number by itself.</summary>
        public static DVec3 operator -(DVec3 a, DVec3 b) { return new DVec3(a.X - b.X, a.Y - b.Y, a.Z - b.Z); }
        /// <summary>Each number by itself.</summary>
        public static DVec3 operator +(DVec3 a, Vector3 b) { return a + (DVec3)b; }
        /// <summary>Each number by itself.</summary>
        public static DVec3 operator -(DVec3 a, Vector3 b) { return a - (DVec3)b; }
        /// <summary>Each number by itself.</summary>
        public static DVec3 operator *(DVec3 a, double factor)
        {
            return new DVec3(a.X * factor, a.Y * factor, a.Z * factor);
        }
        /// <summary>Are all numbers equal?</summary>
        public static bool operator ==(DVec3 a, DVec3 b) { return a.X == b.X && a.Y == b.Y && a.Z == b.Z; }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(DVec3 a, DVec3 b) { return !(a == b); }
        /// <summary>sqrt(X X + Y Y + Z Z).</summary>
        public double Length { get { return Math.Sqrt(X * X + Y * Y + Z * Z); } }
        /// <inheritdoc/>
        public bool Equals(DVec3 other) { return X.Equals(other.X) && Y.Equals(other.Y) && Z.Equals(other.Z); }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is DVec3 && Equals((DVec3)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return (X.GetHashCode() * 397 ^ Y.GetHashCode()) * 397 ^ Z.GetHashCode(); }
        /// <inheritdoc/>
        public override string ToString() { return FormattableString.Invariant($"({X}, {Y}, {Z})"); }
    }

    /// <summary>A pose in the world.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct WorldTransform
    {
        /// <summary>m.</summary>
        public DVec3 Position;
        /// <summary>From its own axes to the world's.</summary>
        public Quaternion Rotation;

        /// <summary>Without a rotation.</summary>
        public WorldTransform(DVec3 position) { Position = position; Rotation = new Quaternion(0, 0, 0, 1); }
        /// <summary>m, and any rotation but zero.</summary>
        public WorldTransform(DVec3 position, Quaternion rotation) { Position = position; Rotation = rotation; }
        /// <inheritdoc/>
        public override string ToString()
        {
            return FormattableString.Invariant($"WorldTransform {{ Position = {Position}, Rotation = {Rotation} }}");
        }
    }

    /// <summary>A pose relative to an origin, for drawing.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct RelativeTransform
    {
        /// <summary>m, from the origin.</summary>
        public Vector3 Position;
        /// <summary>From its own axes to the world's.</summary>
        public Quaternion Rotation;
        /// <inheritdoc/>
        public override string ToString()
        {
            return FormattableString.Invariant($"RelativeTransform {{ Position = {Position}, Rotation = {Rotation} }}");
        }
    }

    /// <summary>Velocities of a body (m/s, rad/s), or a force and a torque on it (N, N m).</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct LinearAngular
    {
        /// <summary>m/s or N; rad/s or N m.</summary>
        public Vector3 Linear, Angular;

        /// <summary>Of its two vectors.</summary>
        public LinearAngular(Vector3 linear, Vector3 angular) { Linear = linear; Angular = angular; }
        /// <inheritdoc/>
        public override string ToString()
        {
            return FormattableString.Invariant($"LinearAngular {{ Linear = {Linear}, Angular = {Angular} }}");
        }
    }

    /// <summary>A bool of four bytes, as the library has it.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public readonly struct Switch
    {
        readonly int on;

        Switch(bool value) { on = value ? 1 : 0; }
        /// <summary>Is it on?</summary>
        public static implicit operator bool(Switch value) { return value.on != 0; }
        /// <summary>On for true.</summary>
        public static implicit operator Switch(bool value) { return new Switch(value); }
        /// <inheritdoc/>
        public override string ToString() { return (on != 0).ToString(); }
    }

    /// <summary>
    /// Names a body in arrays, events and hits; <c>world[handle]</c> makes a <see cref="Body"/> of it.
    /// </summary>
    public readonly struct BodyHandle : IEquatable<BodyHandle>
    {
        /// <summary>The number that the library has for it.</summary>
        public readonly ulong Value;
        /// <summary>Of the number that the library has for it.</summary>
        public BodyHandle(ulong value) { Value = value; }
        /// <summary>Of what it names.</summary>
        public static implicit operator BodyHandle(Body body) { return body.Handle; }
        /// <inheritdoc/>
        public bool Equals(BodyHandle other) { return Value == other.Value; }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is BodyHandle && Equals((BodyHandle)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return Value.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(BodyHandle a, BodyHandle b) { return a.Value == b.Value; }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(BodyHandle a, BodyHandle b) { return a.Value != b.Value; }
        /// <inheritdoc/>
        public override string ToString() { return "Body 0x" + Value.ToString("x"); }
    }

    /// <summary>Names a shape; see <see cref="BodyHandle"/>.</summary>
    public readonly struct ShapeHandle : IEquatable<ShapeHandle>
    {
        /// <summary>The number that the library has for it.</summary>
        public readonly ulong Value;
        /// <summary>Of the number that the library has for it.</summary>
        public ShapeHandle(ulong value) { Value = value; }
        /// <summary>Of what it names.</summary>
        public static implicit operator ShapeHandle(Shape shape) { return shape.Handle; }
        /// <inheritdoc/>
        public bool Equals(ShapeHandle other) { return Value == other.Value; }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is ShapeHandle && Equals((ShapeHandle)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return Value.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(ShapeHandle a, ShapeHandle b) { return a.Value == b.Value; }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(ShapeHandle a, ShapeHandle b) { return a.Value != b.Value; }
        /// <inheritdoc/>
        public override string ToString() { return "Shape 0x" + Value.ToString("x"); }
    }

    /// <summary>Names a joint; see <see cref="BodyHandle"/>.</summary>
    public readonly struct JointHandle : IEquatable<JointHandle>
    {
        /// <summary>The number that the library has for it.</summary>
        public readonly ulong Value;
        /// <summary>Of the number that the library has for it.</summary>
        public JointHandle(ulong value) { Value = value; }
        /// <summary>Of what it names.</summary>
        public static implicit operator JointHandle(Joint joint) { return joint.Handle; }
        /// <inheritdoc/>
        public bool Equals(JointHandle other) { return Value == other.Value; }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is JointHandle && Equals((JointHandle)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return Value.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(JointHandle a, JointHandle b) { return a.Value == b.Value; }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(JointHandle a, JointHandle b) { return a.Value != b.Value; }
        /// <inheritdoc/>
        public override string ToString() { return "Joint 0x" + Value.ToString("x"); }
    }

    /// <summary>Names what shapes share: a heightfield, a hull, a mesh or a compound.</summary>
    public readonly struct AssetHandle : IEquatable<AssetHandle>
    {
        /// <summary>The number that the library has for it.</summary>
        public readonly ulong Value;
        /// <summary>Of the number that the library has for it.</summary>
        public AssetHandle(ulong value) { Value = value; }
        /// <inheritdoc/>
        public bool Equals(AssetHandle other) { return Value == other.Value; }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is AssetHandle && Equals((AssetHandle)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return Value.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(AssetHandle a, AssetHandle b) { return a.Value == b.Value; }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(AssetHandle a, AssetHandle b) { return a.Value != b.Value; }
        /// <inheritdoc/>
        public override string ToString() { return "Asset 0x" + Value.ToString("x"); }
    }

    /// <summary>
    /// What an asset is known by outside its store: a fingerprint of its content. Equal content has equal keys, on
    /// every machine.
    /// </summary>
    [StructLayout(LayoutKind.Sequential)]
    public readonly struct AssetKey : IEquatable<AssetKey>
    {
        /// <summary>Nothing but equal or not.</summary>
        public readonly ulong Word0, Word1;
        /// <summary>Of its two words.</summary>
        public AssetKey(ulong word0, ulong word1) { Word0 = word0; Word1 = word1; }
        /// <inheritdoc/>
        public bool Equals(AssetKey other) { return Word0 == other.Word0 && Word1 == other.Word1; }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is AssetKey && Equals((AssetKey)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return (Word0 ^ Word1).GetHashCode(); }
        /// <summary>Are all numbers equal?</summary>
        public static bool operator ==(AssetKey a, AssetKey b) { return a.Equals(b); }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(AssetKey a, AssetKey b) { return !a.Equals(b); }
        /// <summary>32 hexadecimal digits.</summary>
        public override string ToString() { return Word0.ToString("x16") + Word1.ToString("x16"); }
    }

    public partial struct Frame
    {
        /// <summary>Without a rotation.</summary>
        public Frame(Vector3 position) { Position = position; Rotation = new Quaternion(0, 0, 0, 1); }
        /// <summary>m, and any rotation but zero.</summary>
        public Frame(Vector3 position, Quaternion rotation) { Position = position; Rotation = rotation; }
    }

    public unsafe partial struct SurfaceMaterial
    {
        /// <summary>The library's defaults: begin with them, a bare <c>new SurfaceMaterial()</c> is all 0.</summary>
        public static SurfaceMaterial Default
        {
            get { SurfaceMaterial made; Native.material_init(&made); return made; }
        }
    }

    public partial class BodyDef
    {
        /// <summary>Of the body's origin, m.</summary>
        public DVec3 Position { get { return Transform.Position; } set { Transform.Position = value; } }
        /// <summary>From its own axes to the world's.</summary>
        public Quaternion Rotation { get { return Transform.Rotation; } set { Transform.Rotation = value; } }
    }

    public unsafe partial struct Geometry
    {
        internal static readonly uint Size = (uint)sizeof(Geometry);

        /// <summary>A ball.</summary>
        /// <param name="radius">m</param>
        public static Geometry Sphere(float radius)
        {
            Geometry made;
            Native.geometry_sphere(&made, radius);
            return made;
        }
        /// <summary>Along local Y.</summary>
        /// <param name="halfHeight">of the axis, without the caps, m</param>
        /// <param name="radius">m</param>
        public static Geometry Capsule(float halfHeight, float radius)
        {
            Geometry made;
            Native.geometry_capsule(&made, halfHeight, radius);
            return made;
        }
        /// <summary>Half its edges, m.</summary>
        public static Geometry Box(float halfX, float halfY, float halfZ)
        {
            Geometry made;
            Native.geometry_box(&made, halfX, halfY, halfZ);
            return made;
        }
        /// <summary>The half space normal . p &lt;= distance, of static bodies only.</summary>
        public static Geometry Plane(float normalX, float normalY, float normalZ, float distance)
        {
            Geometry made;
            Native.geometry_plane(&made, normalX, normalY, normalZ, distance);
            return made;
        }
        /// <summary>Along local Y: exact, no polygon.</summary>
        /// <param name="halfHeight">m</param>
        /// <param name="radius">m</param>
        public static Geometry Cylinder(float halfHeight, float radius)
        {
            Geometry made;
            Native.geometry_cylinder(&made, halfHeight, radius);
            return made;
        }
        /// <summary>Along local Y, its tip at +halfHeight: exact.</summary>
        /// <param name="halfHeight">m</param>
        /// <param name="radius">of the base, m</param>
        public static Geometry Cone(float halfHeight, float radius)
        {
            Geometry made;
            Native.geometry_cone(&made, halfHeight, radius);
            return made;
        }
        /// <summary>A hull or a mesh under another scale, along the axes of its points.</summary>
        /// <param name="x">0.001 to 1000 in magnitude, as y and z; a negative one mirrors</param>
        public Geometry Scaled(float x, float y, float z)
        {
            Geometry made = this;
            Native.geometry_set_scale(&made, x, y, z);
            return made;
        }
        /// <summary>A convex hull; its points are in the shape's frame.</summary>
        public static Geometry Hull(ConvexHull hull)
        {
            Geometry made;
            Native.geometry_hull(&made, hull.Handle.Value);
            return made;
        }
        /// <summary>Triangles, of static and kinematic bodies only.</summary>
        public static Geometry Mesh(TriangleMesh mesh)
        {
            Geometry made;
            Native.geometry_mesh(&made, mesh.Handle.Value);
            return made;
        }
        /// <summary>Several parts, for the bodies that each of them may be on.</summary>
        public static Geometry Compound(Compound compound)
        {
            Geometry made;
            Native.geometry_compound(&made, compound.Handle.Value);
            return made;
        }
        /// <summary>Terrain, of static bodies only.</summary>
        public static Geometry Terrain(Heightfield field)
        {
            Geometry made;
            Native.geometry_heightfield(&made, field.Handle.Value);
            return made;
        }
    }

    public partial struct Contact
    {
        /// <summary>Its points: 0..PointCount - 1.</summary>
        public ContactPoint this[int index]
        {
            get
            {
                if ((uint)index >= (uint)PointCount) throw new ArgumentOutOfRangeException(nameof(index));
                return index == 0 ? Point0 : index == 1 ? Point1 : index == 2 ? Point2 : Point3;
            }
        }
    }

    /// <summary>Judges two shapes that come near each other, see <see cref="World.SetPairFilter"/>.</summary>
    /// <returns>may the two collide?</returns>
    public delegate bool PairFilter(FilterPair pair);

    /// <summary>Who counts in a query. Make it once and keep it: queries with it allocate nothing.</summary>
    public sealed class QueryFilter
    {
        /// <summary>Layers that count.</summary>
        public uint Mask = uint.MaxValue;
        /// <summary>Triggers count too.</summary>
        public bool Triggers;
        /// <summary>Bodies that do not count; null: none.</summary>
        public BodyHandle[] Excluded;
    }
}
