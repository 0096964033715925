// Meshes of Godot 4 (C#) as Feather's: the triangles of a Mesh, the convex hull of its vertices, or a compound of the
// convex hulls of its surfaces.
//
//     World.CreateStatic(new DVec3()).AddMesh(World.CreateMesh(level.Mesh));
//     World.CreateDynamic(new DVec3(0, 5, 0)).AddHull(World.CreateHull(rock.Mesh));
//     World.CreateDynamic(new DVec3(5, 5, 0)).AddCompound(World.CreateCompound(chair.Mesh));
using System.Collections.Generic;
using FeatherPhysics;
using Godot;

public static class FeatherMeshes
{
    /// The triangles of all surfaces. The data of a triangle tells which surface it is of.
    public static TriangleMesh CreateMesh(this World world, Mesh mesh)
    {
        var vertices = new List<System.Numerics.Vector3>();
        var indices = new List<int>();
        var surfaces = new List<uint>();
        for (int surface = 0; surface < mesh.GetSurfaceCount(); ++surface)
        {
            if (mesh is ArrayMesh arrays && arrays.SurfaceGetPrimitiveType(surface) != Mesh.PrimitiveType.Triangles)
                continue;
            int first = vertices.Count;
            var data = mesh.SurfaceGetArrays(surface);
            AddVertices(vertices, data);
            int[] own = data[(int)Mesh.ArrayType.Index].AsInt32Array();
            int count = own.Length > 0 ? own.Length : vertices.Count - first;
            for (int i = 0; i + 2 < count; i += 3)
            {
                // the front of a triangle is clockwise in Godot, counterclockwise in Feather
                foreach (int corner in new[] { i, i + 2, i + 1 })
                    indices.Add(first + (own.Length > 0 ? own[corner] : corner));
                surfaces.Add((uint)surface);
            }
        }
        return world.CreateMesh(new MeshDef
        {
            Vertices = vertices.ToArray(), Indices = indices.ToArray(), TriangleData = surfaces.ToArray(),
        });
    }

    /// The convex hull of the vertices of all surfaces.
    public static ConvexHull CreateHull(this World world, Mesh mesh, int maxVertices = 64, float tolerance = 0)
    {
        var points = new List<System.Numerics.Vector3>();
        for (int surface = 0; surface < mesh.GetSurfaceCount(); ++surface)
            AddVertices(points, mesh.SurfaceGetArrays(surface));
        return world.CreateHull(points.ToArray(), maxVertices, tolerance);
    }

    /// The convex hulls of its surfaces, for bodies that move: hits and contacts tell the surface as their part.
    /// DegenerateException for a surface that is flat.
    public static Compound CreateCompound(this World world, Mesh mesh, int maxVertices = 64, float tolerance = 0)
    {
        var parts = new CompoundPart[mesh.GetSurfaceCount()];
        var hulls = new List<ConvexHull>();
        try
        {
            for (int surface = 0; surface < parts.Length; ++surface)
            {
                var points = new List<System.Numerics.Vector3>();
                AddVertices(points, mesh.SurfaceGetArrays(surface));
                hulls.Add(world.CreateHull(points.ToArray(), maxVertices, tolerance));
                parts[surface] = new CompoundPart(Geometry.Hull(hulls[surface]));
            }
            return world.CreateCompound(parts);
        }
        finally
        {
            foreach (ConvexHull hull in hulls) hull.Destroy(); // the compound keeps what they named
        }
    }

    static void AddVertices(List<System.Numerics.Vector3> to, Godot.Collections.Array arrays)
    {
        foreach (Vector3 v in arrays[(int)Mesh.ArrayType.Vertex].AsVector3Array())
            to.Add(new System.Numerics.Vector3(v.X, v.Y, v.Z));
    }
}
