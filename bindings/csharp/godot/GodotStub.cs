// As much of Godot as the examples use, so that they are compiled. Holds a mesh, and runs nothing else.
using System;

namespace Godot
{
    public struct Vector3
    {
        public float X, Y, Z;
        public Vector3(float x, float y, float z) { X = x; Y = y; Z = z; }
        public static Vector3 operator *(int scale, Vector3 v) => new Vector3(scale * v.X, scale * v.Y, scale * v.Z);
    }
    public struct Quaternion { public Quaternion(float x, float y, float z, float w) { } }
    public struct Variant
    {
        public object Value;
        public Vector3[] AsVector3Array() => Value as Vector3[] ?? new Vector3[0];
        public int[] AsInt32Array() => Value as int[] ?? new int[0];
    }
    namespace Collections
    {
        public class Array
        {
            readonly Variant[] all = new Variant[13];
            public Variant this[int index] { get => all[index]; set => all[index] = value; }
        }
    }
    public class Mesh
    {
        public enum ArrayType { Vertex, Normal, Tangent, Index = 12 }
        public enum PrimitiveType { Points, Lines, LineStrip, Triangles, TriangleStrip }
        public virtual int GetSurfaceCount() => 0;
        public virtual Collections.Array SurfaceGetArrays(int surface) => new Collections.Array();
    }
    public class ArrayMesh : Mesh
    {
        readonly System.Collections.Generic.List<Collections.Array> surfaces = new();
        public void AddSurfaceFromArrays(PrimitiveType kind, Collections.Array arrays) => surfaces.Add(arrays);
        public PrimitiveType SurfaceGetPrimitiveType(int surface) => PrimitiveType.Triangles;
        public override int GetSurfaceCount() => surfaces.Count;
        public override Collections.Array SurfaceGetArrays(int surface) => surfaces[surface];
    }
    public class BoxMesh : Mesh { public Vector3 Size { get; set; } }
    public class Node
    {
        public virtual void _EnterTree() { }
        public virtual void _ExitTree() { }
        public virtual void _PhysicsProcess(double delta) { }
        public void AddChild(Node child) { }
        public bool IsFreed { get; private set; }
        public void QueueFree() => IsFreed = true;
    }
    public class Node3D : Node
    {
        public Vector3 Position { get; set; }
        public Quaternion Quaternion { get; set; }
    }
    public class MeshInstance3D : Node3D { public Mesh Mesh { get; set; } = new(); }
    [AttributeUsage(AttributeTargets.Property)]
    public sealed class ExportAttribute : Attribute { }
}
