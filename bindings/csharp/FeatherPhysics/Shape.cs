// A shape, and a heightfield that shapes share: a world and a handle, with fe_shape_*, fe_heightfield_* as members.
using System;
using System.Runtime.InteropServices;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    /// <summary>A shape of a body: its form, material and filters.</summary>
    public readonly unsafe struct Shape : IEquatable<Shape>
    {
        readonly World world;
        readonly ulong id;

        internal Shape(World world, ulong id) { this.world = world; this.id = id; }

        void* P { get { return World.PointerOf(world, "Shape"); } }

        public World World { get { return world; } }
        public ShapeHandle Handle { get { return new ShapeHandle(id); } }
        public bool IsValid
        {
            get
            {
                if (world == null || world.IsDisposed) return false;
                bool valid = Native.shape_is_valid(P, id) != 0;
                GC.KeepAlive(world);
                return valid;
            }
        }
        public void Destroy() { Native.shape_destroy(P, id); GC.KeepAlive(world); }

        public Body Body { get { ulong value; Native.shape_get_body(P, id, &value); GC.KeepAlive(world); return new Body(world, value); } }
        public Geometry Geometry
        {
            get
            {
                Geometry value = default(Geometry);
                value.StructSize = Geometry.Size;
                Native.shape_get_geometry(P, id, &value);
                GC.KeepAlive(world);
                return value;
            }
            set { Native.shape_set_geometry(P, id, &value); GC.KeepAlive(world); }
        }
        /// <summary>In the body's frame, m.</summary>
        public void SetLocalPose(Vector3 position, Quaternion rotation)
        {
            Native.shape_set_local_pose(P, id, &position, &rotation);
            GC.KeepAlive(world);
        }
        public void GetLocalPose(out Vector3 position, out Quaternion rotation)
        {
            Vector3 p;
            Quaternion r;
            Native.shape_get_local_pose(P, id, &p, &r);
            GC.KeepAlive(world);
            position = p;
            rotation = r;
        }
        /// <summary>kg/m3.</summary>
        public float Density
        {
            get { float value; Native.shape_get_density(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.shape_set_density(P, id, value); GC.KeepAlive(world); }
        }
        public SurfaceMaterial Material
        {
            get { SurfaceMaterial value; Native.shape_get_material(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.shape_set_material(P, id, &value); GC.KeepAlive(world); }
        }
        /// <summary>Its layer, exactly one bit, and the layers it collides with.</summary>
        public void SetFilter(uint layer, uint mask) { Native.shape_set_filter(P, id, layer, mask); GC.KeepAlive(world); }
        public void GetFilter(out uint layer, out uint mask)
        {
            uint l, m;
            Native.shape_get_filter(P, id, &l, &m);
            GC.KeepAlive(world);
            layer = l;
            mask = m;
        }
        /// <summary>Reports what it touches and pushes nothing.</summary>
        public bool Trigger
        {
            get { int value; Native.shape_get_trigger(P, id, &value); GC.KeepAlive(world); return value != 0; }
            set { Native.shape_set_trigger(P, id, value ? 1 : 0); GC.KeepAlive(world); }
        }
        public ShapeEvents Events
        {
            get { uint value; Native.shape_get_events(P, id, &value); GC.KeepAlive(world); return (ShapeEvents)value; }
            set { Native.shape_set_events(P, id, (uint)value); GC.KeepAlive(world); }
        }
        /// <summary>Of a conveyor belt, m/s, shape frame.</summary>
        public Vector3 SurfaceVelocity
        {
            get { Vector3 value; Native.shape_get_surface_velocity(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.shape_set_surface_velocity(P, id, &value); GC.KeepAlive(world); }
        }
        /// <summary>A number of yours.</summary>
        public ulong UserData
        {
            get { ulong value; Native.shape_get_user_data(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.shape_set_user_data(P, id, value); GC.KeepAlive(world); }
        }
        /// <summary>Writes its contacts and returns how many there are.</summary>
        public int GetContacts(Span<Contact> contacts)
        {
            fixed (Contact* out_ = &MemoryMarshal.GetReference(contacts))
            {
                int count = Native.shape_get_contacts(P, id, out_, 0, contacts.Length);
                GC.KeepAlive(world);
                return count;
            }
        }
        /// <summary>A segment against this shape only.</summary>
        public bool Raycast(DVec3 origin, DVec3 translation, out Hit hit)
        {
            Hit found = default(Hit);
            int result = Native.shape_raycast(P, id, &origin, &translation, &found);
            GC.KeepAlive(world);
            hit = found;
            return result == 0;
        }
        /// <summary>The point of this shape that is closest to a point.</summary>
        public bool GetClosestPoint(DVec3 point, out ClosestPoint closest)
        {
            ClosestPoint found = default(ClosestPoint);
            int result = Native.shape_closest_point(P, id, &point, &found);
            GC.KeepAlive(world);
            closest = found;
            return result == 0;
        }

        public bool Equals(Shape other) { return world == other.world && id == other.id; }
        public override bool Equals(object other) { return other is Shape && Equals((Shape)other); }
        public override int GetHashCode() { return id.GetHashCode(); }
        public static bool operator ==(Shape a, Shape b) { return a.Equals(b); }
        public static bool operator !=(Shape a, Shape b) { return !a.Equals(b); }
        public override string ToString() { return "Shape 0x" + id.ToString("x"); }
    }

    /// <summary>A grid of heights, see <see cref="World.CreateHeightfield"/>: sample (row, column) stands at x = column CellX, z = row CellZ.</summary>
    public sealed class HeightfieldDef
    {
        /// <summary>Samples along z and along x.</summary>
        public int Rows, Columns;
        /// <summary>m from column to column and from row to row.</summary>
        public float CellX = 1, CellZ = 1;
        /// <summary>Rows x Columns, row by row, m.</summary>
        public float[] Heights;
        /// <summary>(Rows - 1) x (Columns - 1), 1: a hole; null: none.</summary>
        public byte[] Holes;
        /// <summary>A cell each: index into <see cref="Materials"/>; null: the shape's.</summary>
        public byte[] CellMaterials;
        public SurfaceMaterial[] Materials;
    }

    /// <summary>Terrain that shapes may share.</summary>
    public readonly unsafe struct Heightfield
    {
        readonly World world;
        readonly ulong id;

        internal Heightfield(World world, ulong id) { this.world = world; this.id = id; }

        void* P { get { return World.PointerOf(world, "Heightfield"); } }

        public World World { get { return world; } }
        public AssetHandle Handle { get { return new AssetHandle(id); } }
        public bool IsValid
        {
            get
            {
                if (world == null || world.IsDisposed) return false;
                bool valid = Native.asset_is_valid(P, id) != 0;
                GC.KeepAlive(world);
                return valid;
            }
        }
        /// <summary>Its heights live until the last shape that has them is gone.</summary>
        public void Destroy() { Native.asset_destroy(P, id); GC.KeepAlive(world); }
        /// <summary>Changes the samples of a rectangle; bodies near it wake.</summary>
        public void SetHeights(int row, int column, int rows, int columns, ReadOnlySpan<float> heights)
        {
            World.CheckLength((long)rows * columns, heights.Length, "Heightfield.SetHeights", "heights");
            fixed (float* start = &MemoryMarshal.GetReference(heights)) Native.heightfield_set_heights(P, id, row, column, rows, columns, start);
            GC.KeepAlive(world);
        }
        public void GetHeights(int row, int column, int rows, int columns, Span<float> heights)
        {
            World.CheckLength((long)rows * columns, heights.Length, "Heightfield.GetHeights", "heights");
            fixed (float* start = &MemoryMarshal.GetReference(heights)) Native.heightfield_get_heights(P, id, row, column, rows, columns, start);
            GC.KeepAlive(world);
        }
    }
}
