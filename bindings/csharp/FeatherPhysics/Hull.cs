// Convex hulls: fe_hull_* as members.
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
        /// The convex hull of points in any order, for any number of shapes of the store's worlds:
        /// <c>body.AddHull(hull)</c>. DegenerateException for points that are flat.
        /// </summary>
        /// <param name="points">m; inner points and duplicates are welcome</param>
        /// <param name="maxVertices">4..255; with more, those that change the form least are left out</param>
        /// <param name="tolerance">points nearer to the hull may be left out, m; 0: 1e-5 of the extent</param>
        public ConvexHull CreateHull(ReadOnlySpan<Vector3> points, int maxVertices = 64, float tolerance = 0)
        {
            NativeHull native;
            Native.hull_def_init(&native, (uint)sizeof(NativeHull));
            native.PointCount = points.Length;
            native.MaxVertices = maxVertices;
            native.Tolerance = tolerance;
            bool held = false;
            try
            {
                fixed (Vector3* start = &MemoryMarshal.GetReference(points))
                {
                    native.Points = (IntPtr)start;
                    ulong made;
                    Native.hull_create(Enter(ref held), &native, &made);
                    return new ConvexHull(this, made);
                }
            }
            finally { Leave(held); }
        }

        /// <summary>
        /// The hull of which Save() made the bytes. Bytes from anywhere may be given:
        /// BadDataException, NewerVersionException for what is not sound, WrongKindException for another asset's.
        /// </summary>
        public ConvexHull LoadHull(ReadOnlySpan<byte> bytes)
        {
            return new ConvexHull(this, Load(bytes, GeometryType.Hull, "Store.LoadHull"));
        }
    }

    /// <summary>A convex hull that shapes of many worlds may share. A value that keeps its store alive.</summary>
    public readonly unsafe struct ConvexHull : IEquatable<ConvexHull>
    {
        readonly Asset asset;

        internal ConvexHull(Store store, ulong id) { asset = new Asset(store, id); }

        /// <summary>The store that it is in.</summary>
        public Store Store { get { return asset.Store; } }
        /// <summary>Its handle, as geometries have it.</summary>
        public AssetHandle Handle { get { return new AssetHandle(asset.Id); } }
        /// <summary>False once it is destroyed, or its store disposed.</summary>
        public bool IsValid { get { return asset.IsAlive; } }
        /// <summary>The handle dies at once. The hull lives until the last shape that has it is gone.</summary>
        public void Destroy() { asset.Destroy("ConvexHull"); }
        /// <summary>What it is known by in snapshots.</summary>
        public AssetKey GetKey() { return asset.Key("ConvexHull"); }
        /// <summary>As bytes, the same on every machine, for <see cref="Store.LoadHull"/>.</summary>
        public byte[] Save() { return asset.Save("ConvexHull"); }

        /// <summary>Volume, centre, inertia, bounds, how many vertices and faces.</summary>
        public HullInfo Info
        {
            get
            {
                bool held = false;
                try
                {
                    HullInfo info;
                    Native.hull_info_init(&info, (uint)sizeof(HullInfo));
                    Native.hull_get_info(Enter(ref held), asset.Id, &info);
                    return info;
                }
                finally { Leave(held); }
            }
        }
        /// <summary>Its vertices, m: points of those it was made of. Returns how many there are.</summary>
        public int GetVertices(Span<Vector3> vertices)
        {
            bool held = false;
            try
            {
                fixed (Vector3* start = &MemoryMarshal.GetReference(vertices))
                    return Native.hull_get_vertices(Enter(ref held), asset.Id, start, 0, vertices.Length);
            }
            finally { Leave(held); }
        }
        /// <summary>Its faces. Returns how many there are.</summary>
        public int GetFaces(Span<HullFace> faces)
        {
            bool held = false;
            try
            {
                fixed (HullFace* start = &MemoryMarshal.GetReference(faces))
                    return Native.hull_get_faces(Enter(ref held), asset.Id, start, (uint)sizeof(HullFace), faces.Length);
            }
            finally { Leave(held); }
        }
        /// <summary>
        /// Indices of vertices, face by face, counterclockwise seen from outside. Returns how many there are.
        /// </summary>
        public int GetCorners(Span<int> corners)
        {
            bool held = false;
            try
            {
                fixed (int* start = &MemoryMarshal.GetReference(corners))
                    return Native.hull_get_corners(Enter(ref held), asset.Id, start, 0, corners.Length);
            }
            finally { Leave(held); }
        }

        void* Enter(ref bool held) { return asset.Enter("ConvexHull", ref held); }
        void Leave(bool held) { asset.Leave(held); }

        /// <inheritdoc/>
        public bool Equals(ConvexHull other) { return asset.Equals(other.asset); }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is ConvexHull && Equals((ConvexHull)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return asset.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(ConvexHull a, ConvexHull b) { return a.Equals(b); }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(ConvexHull a, ConvexHull b) { return !a.Equals(b); }
        /// <inheritdoc/>
        public override string ToString() { return "ConvexHull " + asset; }
    }
}
