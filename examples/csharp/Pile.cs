// 300 boxes and balls fall on a heap; drawn from the side to pile.ppm, the nearer the brighter.
using FeatherPhysics;

static class Pile
{
    const int Width = 480, Height = 240, Count = 300;
    const double Scale = 24; // pixels a metre

    public static void Run()
    {
        using var world = new World(new WorldDef { WorkerCount = 2 });
        world.CreateStatic(new DVec3(0, 0, 0)).AddPlane(0, 1, 0, 0);
        for (int i = 0; i < Count; i++)
        {
            var body = world.CreateDynamic(new DVec3(i % 5 - 2 + 0.01 * i % 0.5, 1 + i / 25 * 1.1, i / 5 % 5 - 2));
            if (i % 2 == 0) body.AddBox(0.45f, 0.45f, 0.45f);
            else body.AddSphere(0.45f);
        }
        for (int i = 0; i < 300; i++) world.Step(1f / 60);
        Draw(world, "pile.ppm");
        Console.WriteLine($"{world.Counters.Contacts} contacts, {world.Counters.AwakeBodies} bodies awake: pile.ppm");
    }

    /// One ray a pixel, all in one call.
    static void Draw(World world, string file)
    {
        var rays = new Ray[Width * Height];
        var hits = new Hit[rays.Length];
        for (int i = 0; i < rays.Length; i++)
            rays[i] = new Ray
            {
                Origin = new DVec3((i % Width - Width / 2) / Scale, (Height - i / Width - 1) / Scale, 30),
                Translation = new DVec3(0, 0, -60),
            };
        world.RaycastMany(rays, hits, spread: true);
        using var image = File.Create(file);
        image.Write(System.Text.Encoding.ASCII.GetBytes($"P6 {Width} {Height} 255\n"));
        var pixels = new byte[3 * rays.Length];
        for (int i = 0; i < rays.Length; i++)
        {
            if (hits[i].Fraction == 1) continue;
            double light = 60 + 180 * Math.Max(0, 0.6 * hits[i].Normal.Z + 0.8 * hits[i].Normal.Y);
            pixels[3 * i] = (byte)Math.Min(255, light);
            pixels[3 * i + 1] = (byte)(0.8 * light);
            pixels[3 * i + 2] = (byte)(0.6 * light);
        }
        image.Write(pixels);
    }
}
