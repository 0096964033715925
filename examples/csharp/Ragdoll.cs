// A ragdoll of capsules: ball joints with cones at neck, shoulders and hips, hinges at elbows and knees. It falls on
// its back.
using System.Numerics;
using FeatherPhysics;

static class Ragdoll
{
    static readonly Vector3 Up = new(0, 1, 0), Side = new(1, 0, 0);

    public static void Run()
    {
        using var world = new World();
        world.CreateStatic(new DVec3(0, 0, 0)).AddPlane(0, 1, 0, 0);
        var trunk = Limb(world, 0, 1.3, 0.2f, 0.16f);
        var head = Limb(world, 0, 1.85, 0.04f, 0.11f);
        world.CreateBallJoint(trunk, head, new DVec3(0, 1.68, 0), Up, Cone(0.4f, 0.5f));
        foreach (int side in new[] { -1, 1 })
        {
            var arm = Limb(world, side * 0.26, 1.38, 0.1f, 0.05f);
            var forearm = Limb(world, side * 0.26, 1.08, 0.1f, 0.045f);
            world.CreateBallJoint(trunk, arm, new DVec3(side * 0.26, 1.53, 0), Up, Cone(1.3f, 0.8f));
            world.CreateHingeJoint(arm, forearm, new DVec3(side * 0.26, 1.23, 0), Side, Bend(-2.2f, 0));
            var thigh = Limb(world, side * 0.1, 0.78, 0.14f, 0.075f);
            var shin = Limb(world, side * 0.1, 0.33, 0.14f, 0.06f);
            world.CreateBallJoint(trunk, thigh, new DVec3(side * 0.1, 1.0, 0), Up, Cone(1.0f, 0.5f));
            world.CreateHingeJoint(thigh, shin, new DVec3(side * 0.1, 0.56, 0), Side, Bend(0, 2.2f));
        }
        trunk.AddImpulse(new Vector3(0, 0, -60), head.Position);
        for (int i = 0; i <= 180; i++)
        {
            if (i % 45 == 0)
                Console.WriteLine(
                    $"{i / 60.0:F2} s   head {head.Position.Y:F2} m, {head.LinearVelocity.Length():F2} m/s");
            world.Step(1f / 60);
        }
    }

    static Body Limb(World world, double x, double y, float half, float radius)
    {
        var body = world.CreateDynamic(new DVec3(x, y, 0));
        body.AddCapsule(half, radius);
        return body;
    }

    static BallJointDef Cone(float swing, float twist) =>
        new() { ConeEnabled = true, ConeY = swing, ConeZ = swing, LimitEnabled = true, Lower = -twist, Upper = twist };

    static HingeJointDef Bend(float from, float to) => new() { LimitEnabled = true, Lower = from, Upper = to };
}
