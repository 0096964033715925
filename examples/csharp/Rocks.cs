// Rocks, which are convex hulls, roll down a valley, which is a mesh of triangles.
using System.Numerics;
using FeatherPhysics;

static class Rocks
{
    const int Cells = 16, Samples = Cells + 1;

    public static void Run()
    {
        using var world = new World();
        world.CreateStatic(new DVec3(0, 0, 0)).AddMesh(Valley(world));
        var random = new Random(1);
        var kinds = new ConvexHull[3];
        for (int i = 0; i < kinds.Length; i++)
        {
            var points = new Vector3[24];
            for (int k = 0; k < points.Length; k++)
                points[k] = new Vector3(Draw(random, 0.6f), Draw(random, 0.4f), Draw(random, 0.5f));
            kinds[i] = world.CreateHull(points);
            HullInfo info = kinds[i].Info;
            Console.WriteLine($"a rock of {info.VertexCount} vertices, {info.FaceCount} faces, {info.Volume:F3} m3");
        }
        double lowest = double.MaxValue;
        var rocks = new List<Body>();
        for (int i = 0; i < 24; i++)
        {
            var rock = world.CreateDynamic(new DVec3(5 - 2 * (i % 6), 8 + 0.5 * i, 4 - 2.5 * (i / 6)));
            rock.AddHull(kinds[i % kinds.Length]);
            rocks.Add(rock);
        }
        for (int i = 0; i < 360; i++) world.Step(1f / 60);
        if (world.Raycast(new DVec3(7.25, 20, 0.5), new DVec3(0, -30, 0), out Hit hit))
            Console.WriteLine($"triangle {hit.Triangle} of the valley at {hit.Point.Y:F3} m");
        foreach (Body rock in rocks) lowest = Math.Min(lowest, rock.Position.Y);
        Console.WriteLine($"the lowest rock lies at {lowest:F2} m");
    }

    static float Draw(Random random, float half) { return (2 * random.NextSingle() - 1) * half; }

    // A bowl with bumps. Triangles run counterclockwise seen from above: only that side counts.
    static TriangleMesh Valley(World world)
    {
        var vertices = new Vector3[Samples * Samples];
        var indices = new List<int>();
        for (int i = 0; i < vertices.Length; i++)
        {
            int x = i % Samples - Cells / 2, z = i / Samples - Cells / 2;
            vertices[i] = new Vector3(x, (x * x + z * z) / 16f + (x + z + 64) % 4 / 8f, z);
        }
        for (int i = 0; i < Cells * Cells; i++)
        {
            int a = i / Cells * Samples + i % Cells, b = a + 1, c = a + Samples, d = c + 1;
            indices.AddRange(new[] { a, c, d, a, d, b });
        }
        return world.CreateMesh(vertices, indices.ToArray());
    }
}
