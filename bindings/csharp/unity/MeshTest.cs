// A stand-in's mesh of Unity becomes a floor of two submeshes and a hull: the same sides count as in Unity.
using FeatherPhysics;
using UnityEngine;

static class MeshTest
{
    static void Must(bool held, string what) { if (!held) throw new System.Exception(what); }

    static int Main()
    {
        // seen from above, in axes where x goes right, z away and y up (left-handed), both triangles run clockwise
        var floor = new Mesh
        {
            vertices = new[]
            {
                new Vector3(0, 0, 0), new Vector3(0, 0, 1), new Vector3(1, 0, 0), new Vector3(1, 0, 1),
            },
            submeshes = new[] { new[] { 0, 1, 2 }, new[] { 1, 3, 2 } },
        };
        using (var world = new World())
        {
            TriangleMesh mesh = world.CreateMesh(floor);
            world.CreateStatic(new DVec3(0, 0, 0)).AddMesh(mesh);
            Hit hit;
            Must(world.Raycast(new DVec3(0.9, 1, 0.9), new DVec3(0, -2, 0), out hit), "a ray from above meets it");
            Must(hit.Triangle == 1 && mesh.GetTriangle(1).Data == 1, "the second triangle is of the second submesh");
            Must(!world.Raycast(new DVec3(0.9, -1, 0.9), new DVec3(0, 2, 0), out hit), "its back does not count");
            var corners = new Mesh { vertices = new Vector3[8], submeshes = new int[0][] };
            for (int i = 0; i < 8; ++i) corners.vertices[i] = new Vector3(i & 1, i >> 1 & 1, i >> 2);
            Must(System.Math.Abs(world.CreateHull(corners).Info.Volume - 1) < 1e-5, "a cube of a cubic metre");

            // the cube, and a pyramid of a sixth of a cubic metre above one corner of it
            corners.submeshes = new[] { new[] { 0, 1, 2, 3, 4, 5, 6, 7 }, new[] { 8, 9, 10, 11, 8, 9 } };
            System.Array.Resize(ref corners.vertices, 12);
            for (int i = 8; i < 12; ++i)
                corners.vertices[i] = new Vector3(i == 9 ? 1 : 0, i == 10 ? 2 : 1, i == 11 ? 1 : 0);
            Body body = world.CreateDynamic(new DVec3(10, 0, 0));
            body.AddCompound(world.CreateCompound(corners));
            Must(System.Math.Abs(body.Mass - 1000 * (1 + 1.0 / 6)) < 0.1, "each submesh is a part");
            Must(world.Raycast(new DVec3(10.9, 5, 0.9), new DVec3(0, -9, 0), out hit) && hit.Part == 0, "the cube");
            Must(world.Raycast(new DVec3(10.1, 5, 0.1), new DVec3(0, -9, 0), out hit) && hit.Part == 1, "the pyramid");
            long bytes = world.Store.Bytes;
            corners.submeshes[1] = new[] { 0, 1, 2, 3 };
            try { world.CreateCompound(corners); Must(false, "a flat submesh"); }
            catch (DegenerateException) { }
            Must(world.Store.Bytes == bytes, "nothing is left of it");
        }
        return 0;
    }
}
