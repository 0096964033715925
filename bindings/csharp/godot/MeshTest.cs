// A stand-in's mesh of Godot becomes a floor of two surfaces and a hull: the same sides count as in Godot. A node's world
// is restored.
using System;
using FeatherPhysics;
using Godot;

static void Must(bool held, string what) { if (!held) throw new Exception(what); }

// seen from above, in axes where x goes right, z towards the eye and y up (right-handed), all triangles run clockwise
var near = new Godot.Collections.Array();
near[(int)Mesh.ArrayType.Vertex] = new Variant { Value = new Vector3[] { new(0, 0, 0), new(1, 0, 0), new(0, 0, 1) } };
near[(int)Mesh.ArrayType.Index] = new Variant { Value = new[] { 0, 1, 2 } };
var far = new Godot.Collections.Array(); // without indices: three vertices a triangle
far[(int)Mesh.ArrayType.Vertex] = new Variant { Value = new Vector3[] { new(1, 0, 0), new(1, 0, 1), new(0, 0, 1) } };
var floor = new ArrayMesh();
floor.AddSurfaceFromArrays(Mesh.PrimitiveType.Triangles, near);
floor.AddSurfaceFromArrays(Mesh.PrimitiveType.Triangles, far);

using var world = new World();
TriangleMesh mesh = world.CreateMesh(floor);
world.CreateStatic(new DVec3()).AddMesh(mesh);
Must(world.Raycast(new DVec3(0.9, 1, 0.9), new DVec3(0, -2, 0), out Hit hit), "a ray from above meets it");
Must(hit.Triangle == 1 && mesh.GetTriangle(1).Data == 1, "the second triangle is of the second surface");
Must(!world.Raycast(new DVec3(0.9, -1, 0.9), new DVec3(0, 2, 0), out hit), "its back does not count");

var corners = new Vector3[8];
for (int i = 0; i < 8; ++i) corners[i] = new Vector3(i & 1, i >> 1 & 1, i >> 2);
var cube = new Godot.Collections.Array();
cube[(int)Mesh.ArrayType.Vertex] = new Variant { Value = corners };
var crate = new ArrayMesh();
crate.AddSurfaceFromArrays(Mesh.PrimitiveType.Triangles, cube);
Must(Math.Abs(world.CreateHull(crate).Info.Volume - 1) < 1e-5, "a cube of a cubic metre");

// the cube, and a pyramid of a sixth of a cubic metre above one corner of it
var pyramid = new Godot.Collections.Array();
pyramid[(int)Mesh.ArrayType.Vertex] =
    new Variant { Value = new Vector3[] { new(0, 1, 0), new(1, 1, 0), new(0, 2, 0), new(0, 1, 1) } };
crate.AddSurfaceFromArrays(Mesh.PrimitiveType.Triangles, pyramid);
Body body = world.CreateDynamic(new DVec3(10, 0, 0));
body.AddCompound(world.CreateCompound(crate));
Must(Math.Abs(body.Mass - 1000 * (1 + 1.0 / 6)) < 0.1, "each surface is a part");
Must(world.Raycast(new DVec3(10.9, 5, 0.9), new DVec3(0, -9, 0), out hit) && hit.Part == 0, "the cube");
Must(world.Raycast(new DVec3(10.1, 5, 0.1), new DVec3(0, -9, 0), out hit) && hit.Part == 1, "the pyramid");

// a body that the restored world has not got takes its node with it
var scene = new FeatherWorld();
scene._EnterTree();
Node3D first = new(), late = new();
scene.Follow(scene.World.CreateDynamic(new DVec3(1, 0, 0)), first);
byte[] saved = scene.World.Save();
scene.Follow(scene.World.CreateDynamic(new DVec3(2, 0, 0)), late);
Must(scene.Restore(saved) && late.IsFreed && !first.IsFreed, "one node goes");
scene._PhysicsProcess(0);
Must(first.Position.X == 1, "the other follows its body");
scene._ExitTree();
