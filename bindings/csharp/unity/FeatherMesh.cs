// Unity's meshes as Feather's: the triangles of a Mesh, or the convex hull of its vertices.
using System.Collections.Generic;
using UnityEngine;

namespace FeatherPhysics
{
    /// <summary>Meshes of Unity in a store. They must be readable (Read/Write in their import settings).</summary>
    /// <remarks>Vertices and triangles go over as they are: the front of a triangle is clockwise in Unity's axes and
    /// counterclockwise in right-handed ones, which is the same side.</remarks>
    public static class UnityMeshes
    {
        /// <summary>The triangles of all submeshes; <see cref="MeshTriangle.Data"/> tells which submesh one is of.
        /// </summary>
        public static TriangleMesh CreateMesh(this Store store, Mesh mesh)
        {
            return store.CreateMesh(DefinitionOf(mesh));
        }
        /// <summary>In this world's store.</summary>
        public static TriangleMesh CreateMesh(this World world, Mesh mesh) { return world.Store.CreateMesh(mesh); }

        /// <summary>Feather's definition of a mesh, to be given materials or a weld distance before it is built.
        /// </summary>
        public static MeshDef DefinitionOf(Mesh mesh)
        {
            int count = 0;
            for (int part = 0; part < mesh.subMeshCount; ++part)
                if (mesh.GetTopology(part) == MeshTopology.Triangles) count += mesh.GetTriangles(part).Length;
            var indices = new int[count];
            var parts = new uint[count / 3];
            count = 0;
            for (int part = 0; part < mesh.subMeshCount; ++part)
            {
                if (mesh.GetTopology(part) != MeshTopology.Triangles) continue;
                int[] triangles = mesh.GetTriangles(part);
                triangles.CopyTo(indices, count);
                for (int i = 0; i < triangles.Length / 3; ++i) parts[count / 3 + i] = (uint)part;
                count += triangles.Length;
            }
            return new MeshDef { Vertices = mesh.vertices, Indices = indices, TriangleData = parts };
        }

        /// <summary>The convex hull of a mesh's vertices.</summary>
        public static ConvexHull CreateHull(this Store store, Mesh mesh, int maxVertices = 64, float tolerance = 0)
        {
            return store.CreateHull(mesh.vertices, maxVertices, tolerance);
        }
        /// <summary>In this world's store.</summary>
        public static ConvexHull CreateHull(this World world, Mesh mesh, int maxVertices = 64, float tolerance = 0)
        {
            return world.Store.CreateHull(mesh, maxVertices, tolerance);
        }

        /// <summary>The convex hulls of its submeshes, for bodies that move: hits and contacts tell the submesh as
        /// their part. DegenerateException for a submesh that is flat.</summary>
        public static Compound CreateCompound(this Store store, Mesh mesh, int maxVertices = 64, float tolerance = 0)
        {
            Vector3[] vertices = mesh.vertices;
            var parts = new CompoundPart[mesh.subMeshCount];
            var hulls = new List<ConvexHull>();
            try
            {
                for (int part = 0; part < parts.Length; ++part)
                {
                    Vector3[] points = System.Array.ConvertAll(mesh.GetIndices(part), i => vertices[i]);
                    hulls.Add(store.CreateHull(points, maxVertices, tolerance));
                    parts[part] = new CompoundPart(Geometry.Hull(hulls[part]));
                }
                return store.CreateCompound(parts);
            }
            finally
            {
                foreach (ConvexHull hull in hulls) hull.Destroy(); // the compound keeps what they named
            }
        }
        /// <summary>In this world's store.</summary>
        public static Compound CreateCompound(this World world, Mesh mesh, int maxVertices = 64, float tolerance = 0)
        {
            return world.Store.CreateCompound(mesh, maxVertices, tolerance);
        }
    }
}
