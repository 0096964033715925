// As much of UnityEngine as the layer and the sample use, so that both are compiled the way Unity does. Holds a mesh, and runs nothing else.
namespace UnityEngine
{
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    }
    public struct Quaternion
    {
        public float x, y, z, w;
        public Quaternion(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
    }
    public struct Ray { }
    public class Joint { }
    public class Object { public static void Destroy(Object it) { } }
    public class Transform : Object { public void SetPositionAndRotation(Vector3 position, Quaternion rotation) { } }
    public class Collider : Object { }
    public enum MeshTopology { Triangles, Quads = 2, Lines, LineStrip, Points }
    public class Mesh : Object
    {
        public Vector3[] vertices;
        public int[][] submeshes;
        public int subMeshCount { get { return submeshes.Length; } }
        public MeshTopology GetTopology(int submesh) { return MeshTopology.Triangles; }
        public int[] GetTriangles(int submesh) { return submeshes[submesh]; }
        public int[] GetIndices(int submesh) { return submeshes[submesh]; }
    }
    public class MonoBehaviour : Object { }
    public enum PrimitiveType { Cube }
    public class GameObject : Object
    {
        public Transform transform;
        public static GameObject CreatePrimitive(PrimitiveType type) { return null; }
        public T GetComponent<T>() where T : Object { return null; }
    }
    public static class Time { public static float fixedDeltaTime; }
}
