// Meshes of Godot 4 (C#) as Feather's: the triangles of a Mesh, or the convex hull of its vertices.
//
//     World.CreateStatic(new DVec3()).AddMesh(World.CreateMesh(level.Mesh));
//     World.CreateDynamic(new DVec3(0, 5, 0)).AddHull(World.CreateHull(rock.Mesh));
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

    static void AddVertices(List<System.Numerics.Vector3> to, Godot.Collections.Array arrays)
    {
        foreach (Vector3 v in arrays[(int)Mesh.ArrayType.Vertex].AsVector3Array())
            to.Add(new System.Numerics.Vector3(v.X, v.Y, v.Z));
    }
}
