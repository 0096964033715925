// A ball falls on the ground.
using FeatherPhysics;

static class Hello
{
    public static void Run()
    {
        using var world = new World();
        world.CreateStatic(new DVec3(0, 0, 0)).AddPlane(0, 1, 0, 0);
        var ball = world.CreateDynamic(new DVec3(0, 3, 0));
        ball.AddSphere(0.5f);
        for (int i = 0; i <= 60; i++)
        {
            if (i % 15 == 0) Console.WriteLine($"{i / 60.0:F2} s   {ball.Position.Y:F3} m");
            world.Step(1f / 60);
        }
    }
}
