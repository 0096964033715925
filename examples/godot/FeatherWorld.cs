// A node of Godot 4 (C#) that plays a world of Feather. Add the package to the project (dotnet add package
// FeatherPhysics, see docs/csharp.md), put this script on a Node3D, and call Follow for each body that a node shows.
using System;
using System.Collections.Generic;
using FeatherPhysics;
using Godot;

public partial class FeatherWorld : Node3D
{
    [Export] public int Workers { get; set; } = 1;

    public World World { get; private set; } = null!;

    readonly List<Node3D> nodes = new();
    BodyHandle[] bodies = new BodyHandle[16];
    RelativeTransform[] poses = new RelativeTransform[16];

    public override void _EnterTree() => World = new World(new WorldDef { WorkerCount = Workers });

    public override void _ExitTree() => World.Dispose();

    /// The node goes where the body goes. Positions are relative to this node, which may stand anywhere.
    public void Follow(Body body, Node3D node)
    {
        if (nodes.Count == bodies.Length)
        {
            Array.Resize(ref bodies, 2 * bodies.Length);
            Array.Resize(ref poses, 2 * poses.Length);
        }
        bodies[nodes.Count] = body;
        nodes.Add(node);
    }

    /// A box that falls, with a mesh.
    public Body AddBox(Vector3 position, Vector3 halfSize)
    {
        Body body = World.CreateDynamic(new DVec3(position.X, position.Y, position.Z));
        body.AddBox(halfSize.X, halfSize.Y, halfSize.Z);
        var mesh = new MeshInstance3D { Mesh = new BoxMesh { Size = 2 * halfSize } };
        AddChild(mesh);
        Follow(body, mesh);
        return body;
    }

    /// The world becomes the saved one (World.Save). Nodes of bodies that it has not got go.
    public bool Restore(ReadOnlySpan<byte> snapshot)
    {
        bool exact = World.Restore(snapshot);
        int kept = 0;
        for (int i = 0; i < nodes.Count; ++i)
        {
            if (World[bodies[i]].IsValid)
            {
                bodies[kept] = bodies[i];
                nodes[kept++] = nodes[i];
            }
            else nodes[i].QueueFree();
        }
        nodes.RemoveRange(kept, nodes.Count - kept);
        return exact;
    }

    public override void _PhysicsProcess(double delta)
    {
        World.Step((float)delta);
        World.GetTransforms(bodies.AsSpan(0, nodes.Count), new DVec3(), poses);
        for (int i = 0; i < nodes.Count; ++i)
        {
            var (p, q) = (poses[i].Position, poses[i].Rotation);
            nodes[i].Position = new Vector3(p.X, p.Y, p.Z);
            nodes[i].Quaternion = new Quaternion(q.X, q.Y, q.Z, q.W);
        }
    }
}
