// A pile of boxes in a world of Feather; game objects follow it. Put this on an empty game object.
using FeatherPhysics;
using UnityEngine;

public sealed class FeatherScene : MonoBehaviour
{
    const int Count = 100;

    World world;
    BodyHandle[] bodies;
    RelativeTransform[] poses;
    Transform[] followers;

    void Start()
    {
        world = new World();
        world.CreateStatic(new DVec3(0, 0, 0)).AddPlane(0, 1, 0, 0);
        bodies = new BodyHandle[Count];
        poses = new RelativeTransform[Count];
        followers = new Transform[Count];
        for (int i = 0; i < Count; ++i)
        {
            Body body = world.CreateDynamic(new DVec3(i % 5 * 1.1, 1 + i / 25 * 1.2, i / 5 % 5 * 1.1));
            body.AddBox(0.5f, 0.5f, 0.5f);
            bodies[i] = body;
            GameObject cube = GameObject.CreatePrimitive(PrimitiveType.Cube);
            Destroy(cube.GetComponent<Collider>());
            followers[i] = cube.transform;
        }
    }

    void FixedUpdate() { world.Step(Time.fixedDeltaTime); }

    void LateUpdate()
    {
        world.GetTransforms(bodies, new DVec3(0, 0, 0), poses);
        for (int i = 0; i < Count; ++i) followers[i].SetPositionAndRotation(poses[i].Position, poses[i].Rotation);
    }

    void OnDestroy() { if (world != null) world.Dispose(); }
}
