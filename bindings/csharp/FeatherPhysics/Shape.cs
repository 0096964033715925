// A shape: a world and a handle, with fe_shape_* as members.
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

        /// <summary>The world that it belongs to.</summary>
        public World World { get { return world; } }
        /// <summary>Its handle, as arrays, events and hits have it.</summary>
        public ShapeHandle Handle { get { return new ShapeHandle(id); } }
        /// <summary>False once it is destroyed, or its world disposed.</summary>
        public bool IsValid { get { return World.IsThere(world, World.Kind.Shape, id); } }
        /// <summary>Mass and inertia of the body follow, unless they were set. The body and what it touched wake.</summary>
        public void Destroy() { Native.shape_destroy(P, id); GC.KeepAlive(world); }

        /// <summary>The body that it belongs to.</summary>
        public Body Body
        {
            get
            {
                ulong value;
                Native.shape_get_body(P, id, &value);
                GC.KeepAlive(world);
                return new Body(world, value);
            }
        }
        /// <summary>Its form. Setting gives it another one in the same place.</summary>
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
        /// <summary>Where it is in the body's space.</summary>
        public Frame Frame
        {
            get { Frame value; Native.shape_get_frame(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.shape_set_frame(P, id, &value); GC.KeepAlive(world); }
        }
        /// <summary>The box around it. A plane has none.</summary>
        public WorldBounds Bounds
        {
            get { WorldBounds value; Native.shape_get_bounds(P, id, &value); GC.KeepAlive(world); return value; }
        }
        /// <summary>kg/m3.</summary>
        public float Density
        {
            get { float value; Native.shape_get_density(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.shape_set_density(P, id, value); GC.KeepAlive(world); }
        }
        /// <summary>Its surface.</summary>
        public SurfaceMaterial Material
        {
            get { SurfaceMaterial value; Native.shape_get_material(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.shape_set_material(P, id, &value); GC.KeepAlive(world); }
        }
        /// <summary>Takes effect at the next step.</summary>
        /// <param name="layer">exactly one bit</param>
        /// <param name="mask">the layers that it collides with</param>
        /// <param name="group">shapes of one group collide always (above 0) or never (below 0); 0: none</param>
        public void SetFilter(uint layer, uint mask, int group = 0)
        {
            Native.shape_set_filter(P, id, layer, mask, group);
            GC.KeepAlive(world);
        }
        /// <summary>As <see cref="SetFilter"/> set it.</summary>
        public void GetFilter(out uint layer, out uint mask, out int group)
        {
            uint l, m;
            int g;
            Native.shape_get_filter(P, id, &l, &m, &g);
            GC.KeepAlive(world);
            layer = l;
            mask = m;
            group = g;
        }
        /// <summary>Does the world's pair filter judge its new pairs? See <see cref="World.SetPairFilter"/>.</summary>
        public bool PairFilter
        {
            get { int value; Native.shape_get_pair_filter(P, id, &value); GC.KeepAlive(world); return value != 0; }
            set { Native.shape_set_pair_filter(P, id, value ? 1 : 0); GC.KeepAlive(world); }
        }
        /// <summary>Holds back only what comes against its direction: a floor to jump through.</summary>
        public bool OneWay
        {
            get { bool enabled; Vector3 direction; GetOneWay(out enabled, out direction); return enabled; }
            set { Native.shape_set_one_way(P, id, value ? 1 : 0, null); GC.KeepAlive(world); }
        }
        /// <param name="direction">shape frame, any length but zero: up, for a floor to jump through</param>
        public void SetOneWay(bool enabled, Vector3 direction)
        {
            Native.shape_set_one_way(P, id, enabled ? 1 : 0, &direction);
            GC.KeepAlive(world);
        }
        /// <summary>As <see cref="SetOneWay"/> set it.</summary>
        public void GetOneWay(out bool enabled, out Vector3 direction)
        {
            int on;
            Vector3 d;
            Native.shape_get_one_way(P, id, &on, &d);
            GC.KeepAlive(world);
            enabled = on != 0;
            direction = d;
        }
        /// <summary>Reports what it touches and pushes nothing.</summary>
        public bool Trigger
        {
            get { int value; Native.shape_get_trigger(P, id, &value); GC.KeepAlive(world); return value != 0; }
            set { Native.shape_set_trigger(P, id, value ? 1 : 0); GC.KeepAlive(world); }
        }
        /// <summary>What it reports; a pair has what either shape asks for.</summary>
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
        /// <summary>
        /// Writes the shapes that touched it at the end of the last step, in the order of creation, and returns how
        /// many there are: who is inside a trigger now.
        /// </summary>
        public int GetOverlaps(Span<ShapeHandle> shapes)
        {
            fixed (ShapeHandle* out_ = &MemoryMarshal.GetReference(shapes))
            {
                int count = Native.shape_get_overlaps(P, id, out_, shapes.Length);
                GC.KeepAlive(world);
                return count;
            }
        }
        /// <summary>Writes its contacts and returns how many there are.</summary>
        public int GetContacts(Span<Contact> contacts)
        {
            fixed (Contact* out_ = &MemoryMarshal.GetReference(contacts))
            {
                int count = Native.shape_get_contacts(P, id, out_, (uint)sizeof(Contact), contacts.Length);
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
            return result == 1;
        }
        /// <summary>The point of this shape that is closest to a point.</summary>
        public bool GetClosestPoint(DVec3 point, out ClosestPoint closest)
        {
            ClosestPoint found = default(ClosestPoint);
            int result = Native.shape_closest_point(P, id, &point, &found);
            GC.KeepAlive(world);
            closest = found;
            return result == 1;
        }

        /// <inheritdoc/>
        public bool Equals(Shape other) { return world == other.world && id == other.id; }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is Shape && Equals((Shape)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return id.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(Shape a, Shape b) { return a.Equals(b); }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(Shape a, Shape b) { return !a.Equals(b); }
        /// <inheritdoc/>
        public override string ToString() { return "Shape 0x" + id.ToString("x"); }
    }
}
