// Shots at a tower of boxes: each ray pushes what it hits; a box that is hit hard says so.
using System.Numerics;
using FeatherPhysics;

static class Gun
{
    public static void Run()
    {
        using var world = new World();
        world.CreateStatic(new DVec3(0, 0, 0)).AddPlane(0, 1, 0, 0);
        var names = new Dictionary<BodyHandle, string>();
        for (int i = 0; i < 8; i++)
        {
            var box = world.CreateDynamic(new DVec3(0, 0.5 + i, 0));
            var def = new ShapeDef { Density = 100, Events = ShapeEvents.Touch | ShapeEvents.Hit };
            box.AddBox(0.5f, 0.5f, 0.5f, def);
            names[box] = $"box {i}";
        }
        for (int step = 0; step < 240; step++)
        {
            if (step % 60 == 30) Shoot(world, names, new DVec3(-10, 1.5 + step / 60 * 1.5, 0.1));
            world.Step(1f / 60);
            foreach (ref readonly var e in world.HitEvents)
                if (e.Speed > 5)
                    Console.WriteLine($"  {names.GetValueOrDefault(e.BodyB, "something")} hits at {e.Speed:F1} m/s");
        }
    }

    static void Shoot(World world, Dictionary<BodyHandle, string> names, DVec3 from)
    {
        if (!world.Raycast(from, new DVec3(30, 0, 0), out Hit hit) || world[hit.Body].Type != BodyType.Dynamic)
        {
            Console.WriteLine("miss");
            return;
        }
        Console.WriteLine($"hit {names[hit.Body]} at {hit.Point.X:F2}, {hit.Point.Y:F2}");
        world[hit.Body].AddImpulse(new Vector3(400, 0, 0), hit.Point);
    }
}
