// Triangle meshes: fe_mesh_* as members.
using System;
using System.Runtime.InteropServices;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    public sealed unsafe partial class Store
    {
        /// <summary>
        /// Triangles for any number of static and kinematic bodies of the store's worlds: <c>body.AddMesh(mesh)</c>.
        /// </summary>
        /// <param name="vertices">m</param>
        /// <param name="indices">three a triangle, counterclockwise seen from the side that counts</param>
        public TriangleMesh CreateMesh(Vector3[] vertices, int[] indices)
        {
            return CreateMesh(new MeshDef { Vertices = vertices, Indices = indices });
        }

        /// <summary>Triangles of any form, for static and kinematic bodies.</summary>
        public TriangleMesh CreateMesh(MeshDef def)
        {
            const string where = "Store.CreateMesh";
            World.NotNull(def, where);
            // copies, so that what is checked is what is read, whatever another thread does to the definition
            Vector3[] vertices = def.Vertices;
            int[] indices = def.Indices;
            byte[] triangleMaterials = def.TriangleMaterials;
            SurfaceMaterial[] materials = def.Materials;
            uint[] triangleData = def.TriangleData;
            World.NotNull(vertices, where);
            World.NotNull(indices, where);
            int triangles = (indices.Length + 2) / 3; // a part of one is missing the rest
            World.CheckLength(3L * triangles, indices.Length, where, "Indices");
            if (triangleMaterials != null)
                World.CheckLength(triangles, triangleMaterials.Length, where, "TriangleMaterials");
            if (triangleData != null) World.CheckLength(triangles, triangleData.Length, where, "TriangleData");
            NativeMesh native;
            Native.mesh_def_init(&native, (uint)sizeof(NativeMesh));
            native.Flags = (def.TwoSided ? MeshFlags.TwoSided : 0) | (def.Strict ? MeshFlags.Strict : 0);
            native.VertexCount = vertices.Length;
            native.TriangleCount = triangles;
            native.WeldDistance = def.WeldDistance;
            native.EdgeAngle = def.EdgeAngle;
            native.MaterialCount = materials == null ? 0 : materials.Length;
            bool held = false;
            try
            {
                fixed (Vector3* verticesAt = vertices)
                fixed (int* indicesAt = indices)
                fixed (byte* kindsAt = triangleMaterials)
                fixed (SurfaceMaterial* materialsAt = materials)
                fixed (uint* dataAt = triangleData)
                {
                    native.Vertices = (IntPtr)verticesAt;
                    native.Indices = (IntPtr)indicesAt;
                    native.TriangleMaterials = (IntPtr)kindsAt;
                    native.Materials = (IntPtr)materialsAt;
                    native.TriangleData = (IntPtr)dataAt;
                    ulong made;
                    Native.mesh_create(Enter(ref held), &native, &made);
                    return new TriangleMesh(this, made);
                }
            }
            finally { Leave(held); }
        }

        /// <summary>
        /// The mesh of which Save() made the bytes. Bytes from anywhere may be given:
        /// BadDataException, NewerVersionException for what is not sound, WrongKindException for another asset's.
        /// </summary>
        public TriangleMesh LoadMesh(ReadOnlySpan<byte> bytes)
        {
            return new TriangleMesh(this, Load(bytes, GeometryType.Mesh, "Store.LoadMesh"));
        }
    }

    /// <summary>What a mesh is made of, see <see cref="Store.CreateMesh(MeshDef)"/>.</summary>
    public sealed class MeshDef
    {
        /// <summary>m. Equal ones are one.</summary>
        public Vector3[] Vertices;
        /// <summary>Three a triangle, counterclockwise seen from the side that counts.</summary>
        public int[] Indices;
        /// <summary>Both sides of its triangles count.</summary>
        public bool TwoSided;
        /// <summary>A triangle without area, or one that repeats another, is an error; else it is dropped.</summary>
        public bool Strict;
        /// <summary>Vertices nearer than this are one, m.</summary>
        public float WeldDistance;
        /// <summary>Edges that bend less are not felt, rad.</summary>
        public float EdgeAngle = 0.035f;
        /// <summary>A triangle each: index into <see cref="Materials"/>; null: the shape's.</summary>
        public byte[] TriangleMaterials;
        /// <summary>Replace the material of the shape, by triangle.</summary>
        public SurfaceMaterial[] Materials;
        /// <summary>A triangle each: any number of yours; null: none.</summary>
        public uint[] TriangleData;
    }

    /// <summary>Triangles that shapes of many worlds may share. A value that keeps its store alive.</summary>
    public readonly unsafe struct TriangleMesh : IEquatable<TriangleMesh>
    {
        readonly Asset asset;

        internal TriangleMesh(Store store, ulong id) { asset = new Asset(store, id); }

        /// <summary>The store that it is in.</summary>
        public Store Store { get { return asset.Store; } }
        /// <summary>Its handle, as geometries have it.</summary>
        public AssetHandle Handle { get { return new AssetHandle(asset.Id); } }
        /// <summary>False once it is destroyed, or its store disposed.</summary>
        public bool IsValid { get { return asset.IsAlive; } }
        /// <summary>The handle dies at once. The mesh lives until the last shape that has it is gone.</summary>
        public void Destroy() { asset.Destroy("TriangleMesh"); }
        /// <summary>What it is known by in snapshots.</summary>
        public AssetKey GetKey() { return asset.Key("TriangleMesh"); }
        /// <summary>As bytes, the same on every machine, for <see cref="Store.LoadMesh"/>.</summary>
        public byte[] Save() { return asset.Save("TriangleMesh"); }

        /// <summary>Area, volume, bounds, how many triangles, and what was wrong with them.</summary>
        public MeshInfo Info
        {
            get
            {
                bool held = false;
                try
                {
                    MeshInfo info;
                    Native.mesh_info_init(&info, (uint)sizeof(MeshInfo));
                    Native.mesh_get_info(Enter(ref held), asset.Id, &info);
                    return info;
                }
                finally { Leave(held); }
            }
        }
        /// <summary>A triangle by its number in what the mesh was made of.</summary>
        public MeshTriangle GetTriangle(int number)
        {
            bool held = false;
            try
            {
                MeshTriangle triangle;
                Native.mesh_triangle_init(&triangle, (uint)sizeof(MeshTriangle));
                Native.mesh_get_triangle(Enter(ref held), asset.Id, number, &triangle);
                return triangle;
            }
            finally { Leave(held); }
        }
        /// <summary>
        /// New materials of a mesh that has some, as many as before. What touches it wakes. WorldSteppingException
        /// while a world that uses it steps.
        /// </summary>
        public void SetMaterials(ReadOnlySpan<SurfaceMaterial> materials)
        {
            bool held = false;
            try
            {
                fixed (SurfaceMaterial* start = &MemoryMarshal.GetReference(materials))
                    Native.mesh_set_materials(Enter(ref held), asset.Id, start, 0, materials.Length);
            }
            finally { Leave(held); }
        }

        void* Enter(ref bool held) { return asset.Enter("TriangleMesh", ref held); }
        void Leave(bool held) { asset.Leave(held); }

        /// <inheritdoc/>
        public bool Equals(TriangleMesh other) { return asset.Equals(other.asset); }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is TriangleMesh && Equals((TriangleMesh)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return asset.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(TriangleMesh a, TriangleMesh b) { return a.Equals(b); }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(TriangleMesh a, TriangleMesh b) { return !a.Equals(b); }
        /// <inheritdoc/>
        public override string ToString() { return "TriangleMesh " + asset; }
    }
}
