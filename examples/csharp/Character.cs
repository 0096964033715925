// A character walks over hills: a capsule that sweeps, slides along what it meets and steps down to the ground. It is
// no body, only queries.
using System.Numerics;
using FeatherPhysics;

static class Character
{
    const float Dt = 1f / 60, Speed = 2, StepDown = 0.3f, Skin = 0.01f;
    static readonly Geometry Form = Geometry.Capsule(0.5f, 0.3f);

    public static void Run()
    {
        using var world = new World();
        world.CreateStatic(new DVec3(-16, 0, -16)).AddTerrain(Hills(world));
        var at = new DVec3(-10, 4, 0);
        at = Fall(world, at, 10);
        for (int i = 0; i < 600; i++)
        {
            at = Slide(world, at, new DVec3(Speed * Dt, 0, 0));
            at = Fall(world, at, StepDown);
            if (i % 100 == 0) Console.WriteLine($"x {at.X,6:F2}   height {at.Y:F2}");
        }
    }

    static Heightfield Hills(World world)
    {
        const int n = 65;
        var heights = new float[n * n];
        for (int row = 0; row < n; row++)
            for (int column = 0; column < n; column++)
                heights[row * n + column] = MathF.Sin(column * 0.2f) * MathF.Cos(row * 0.2f);
        var def = new HeightfieldDef { Rows = n, Columns = n, CellX = 0.5f, CellZ = 0.5f, Heights = heights };
        return world.CreateHeightfield(def);
    }

    /// Moves until something stops it, then along that, at most three times.
    static DVec3 Slide(World world, DVec3 at, DVec3 motion)
    {
        for (int i = 0; i < 3 && motion.Length > 1e-6; i++)
        {
            if (!world.Sweep(Form, new WorldTransform(at), motion, out Hit hit)) return at + motion;
            at = at + motion * hit.Fraction + hit.Normal * Skin;
            var rest = motion * (1 - hit.Fraction);
            var normal = (DVec3)hit.Normal;
            motion = rest - normal * (rest.X * normal.X + rest.Y * normal.Y + rest.Z * normal.Z);
        }
        return at;
    }

    static DVec3 Fall(World world, DVec3 at, double depth)
    {
        var down = new DVec3(0, -depth, 0);
        if (!world.Sweep(Form, new WorldTransform(at), down, out Hit hit)) return at + down;
        return at + down * hit.Fraction + new Vector3(0, Skin, 0);
    }
}
