// A body: a world and a handle, with fe_body_* as members.
using System;
using System.Runtime.InteropServices;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    /// <summary>
    /// A body of a world. A value: copy it freely. It keeps its world alive. Calls with a destroyed body throw. As an
    /// end of a joint <c>default</c> is the world itself.
    /// </summary>
    public readonly unsafe struct Body : IEquatable<Body>
    {
        readonly World world;
        readonly ulong id;

        internal Body(World world, ulong id) { this.world = world; this.id = id; }

        void* P { get { return World.PointerOf(world, "Body"); } }

        /// <summary>The world that it belongs to.</summary>
        public World World { get { return world; } }
        /// <summary>Its handle, as arrays, events and hits have it.</summary>
        public BodyHandle Handle { get { return new BodyHandle(id); } }
        /// <summary>False once it is destroyed, or its world disposed.</summary>
        public bool IsValid { get { return World.IsThere(world, World.Kind.Body, id); } }

        /// <summary>
        /// Destroys its shapes and joints too; pairs that touched send their exit with the next step's events.
        /// </summary>
        public void Destroy() { Native.body_destroy(P, id); GC.KeepAlive(world); }

        // ---- shapes ----

        /// <summary>Adds a shape; mass and inertia follow.</summary>
        /// <param name="geometry">see <see cref="Geometry.Sphere"/> and its like</param>
        /// <param name="def">null: the defaults</param>
        public Shape Add(Geometry geometry, ShapeDef def = null)
        {
            ulong made;
            if (def == null) Native.shape_create(P, id, null, &geometry, &made);
            else fixed (uint* start = &def.StructSize) Native.shape_create(P, id, start, &geometry, &made);
            GC.KeepAlive(world);
            return new Shape(world, made);
        }
        /// <summary>A ball, by its radius, m.</summary>
        public Shape AddSphere(float radius, ShapeDef def = null) { return Add(Geometry.Sphere(radius), def); }
        /// <summary>A rod with round ends along local Y: half the height of its axis, and its radius, m.</summary>
        public Shape AddCapsule(float halfHeight, float radius, ShapeDef def = null)
        {
            return Add(Geometry.Capsule(halfHeight, radius), def);
        }
        /// <summary>A box, by half its edges, m.</summary>
        public Shape AddBox(float halfX, float halfY, float halfZ, ShapeDef def = null)
        {
            return Add(Geometry.Box(halfX, halfY, halfZ), def);
        }
        /// <summary>The half space normal . p &lt;= distance, of a static body.</summary>
        public Shape AddPlane(float normalX, float normalY, float normalZ, float distance, ShapeDef def = null)
        {
            return Add(Geometry.Plane(normalX, normalY, normalZ, distance), def);
        }
        /// <summary>A cylinder along local Y: half its height, and its radius, m.</summary>
        public Shape AddCylinder(float halfHeight, float radius, ShapeDef def = null)
        {
            return Add(Geometry.Cylinder(halfHeight, radius), def);
        }
        /// <summary>A cone along local Y, its tip up: half its height, and the radius of its base, m.</summary>
        public Shape AddCone(float halfHeight, float radius, ShapeDef def = null)
        {
            return Add(Geometry.Cone(halfHeight, radius), def);
        }
        /// <summary>A convex hull; its points are in the shape's frame.</summary>
        public Shape AddHull(ConvexHull hull, ShapeDef def = null) { return Add(Geometry.Hull(hull), def); }
        /// <summary>Of a static or kinematic body.</summary>
        public Shape AddMesh(TriangleMesh mesh, ShapeDef def = null) { return Add(Geometry.Mesh(mesh), def); }
        /// <summary>A compound; its parts are in the shape's frame.</summary>
        public Shape AddCompound(Compound compound, ShapeDef def = null)
        {
            return Add(Geometry.Compound(compound), def);
        }
        /// <summary>A heightfield, of a static body.</summary>
        public Shape AddTerrain(Heightfield field, ShapeDef def = null)
        {
            return Add(Geometry.Terrain(field), def);
        }
        /// <summary>Writes its shapes in the order of creation and returns how many there are.</summary>
        public int GetShapes(Span<ShapeHandle> shapes)
        {
            fixed (ShapeHandle* out_ = &MemoryMarshal.GetReference(shapes))
            {
                int count = Native.body_get_shapes(P, id, out_, shapes.Length);
                GC.KeepAlive(world);
                return count;
            }
        }
        /// <summary>Writes its joints in the order of creation and returns how many there are.</summary>
        public int GetJoints(Span<JointHandle> joints)
        {
            fixed (JointHandle* out_ = &MemoryMarshal.GetReference(joints))
            {
                int count = Native.body_get_joints(P, id, out_, joints.Length);
                GC.KeepAlive(world);
                return count;
            }
        }
        /// <summary>Writes its contacts and returns how many there are.</summary>
        public int GetContacts(Span<Contact> contacts)
        {
            fixed (Contact* out_ = &MemoryMarshal.GetReference(contacts))
            {
                int count = Native.body_get_contacts(P, id, out_, (uint)sizeof(Contact), contacts.Length);
                GC.KeepAlive(world);
                return count;
            }
        }

        // ---- where and how fast ----

        /// <summary>A change wakes it. Planes and terrain are on static bodies alone, meshes not on dynamic ones.</summary>
        public BodyType Type
        {
            get { int value; Native.body_get_type(P, id, &value); GC.KeepAlive(world); return (BodyType)value; }
            set { Native.body_set_type(P, id, (int)value); GC.KeepAlive(world); }
        }
        /// <summary>Setting puts the body there at once, through whatever is between, and wakes it.</summary>
        public WorldTransform Transform
        {
            get { WorldTransform value; Native.body_get_transform(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.body_set_transform(P, id, &value); GC.KeepAlive(world); }
        }
        /// <summary>Of its origin, m.</summary>
        public DVec3 Position
        {
            get { DVec3 value; Native.body_get_position(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.body_set_position(P, id, &value); GC.KeepAlive(world); }
        }
        /// <summary>From its own axes to the world's; any length but zero. Setting turns it at once and wakes it.</summary>
        public Quaternion Rotation
        {
            get { Quaternion value; Native.body_get_rotation(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.body_set_rotation(P, id, &value); GC.KeepAlive(world); }
        }
        /// <summary>Its position seen from an origin, in float: what a renderer wants.</summary>
        public Vector3 PositionRelativeTo(DVec3 origin) { return Position.RelativeTo(origin); }
        /// <summary>Centre of mass, m.</summary>
        public DVec3 Centre
        {
            get { DVec3 value; Native.body_get_centre(P, id, &value); GC.KeepAlive(world); return value; }
        }
        /// <summary>Of the centre of mass, m/s. Setting wakes the body.</summary>
        public Vector3 LinearVelocity
        {
            get { Vector3 value; Native.body_get_linear_velocity(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.body_set_linear_velocity(P, id, &value); GC.KeepAlive(world); }
        }
        /// <summary>rad/s, world axes.</summary>
        public Vector3 AngularVelocity
        {
            get { Vector3 value; Native.body_get_angular_velocity(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.body_set_angular_velocity(P, id, &value); GC.KeepAlive(world); }
        }
        /// <summary>Of the material point now at a point of the world, m/s.</summary>
        public Vector3 GetPointVelocity(DVec3 point)
        {
            Vector3 value;
            Native.body_get_point_velocity(P, id, &point, &value);
            GC.KeepAlive(world);
            return value;
        }
        /// <summary>Gives a kinematic body the velocities that bring it to a pose in some seconds.</summary>
        public void SetTarget(WorldTransform target, float seconds)
        {
            Native.body_set_target(P, id, &target, seconds);
            GC.KeepAlive(world);
        }

        // ---- forces ----

        /// <summary>At the centre of mass, N, during all of the next step.</summary>
        public void AddForce(Vector3 force) { Native.body_add_force(P, id, &force); GC.KeepAlive(world); }
        /// <summary>At a point of the world, N. Its torque is the one that this point gives now.</summary>
        public void AddForce(Vector3 force, DVec3 point)
        {
            Native.body_add_force_at(P, id, &force, &point);
            GC.KeepAlive(world);
        }
        /// <summary>N m, during all of the next step.</summary>
        public void AddTorque(Vector3 torque) { Native.body_add_torque(P, id, &torque); GC.KeepAlive(world); }
        /// <summary>Changes the velocity at once by impulse / mass. N s.</summary>
        public void AddImpulse(Vector3 impulse) { Native.body_add_impulse(P, id, &impulse); GC.KeepAlive(world); }
        /// <summary>At a point of the world: changes the angular velocity too.</summary>
        public void AddImpulse(Vector3 impulse, DVec3 point)
        {
            Native.body_add_impulse_at(P, id, &impulse, &point);
            GC.KeepAlive(world);
        }
        /// <summary>N m s.</summary>
        public void AddAngularImpulse(Vector3 impulse)
        {
            Native.body_add_angular_impulse(P, id, &impulse);
            GC.KeepAlive(world);
        }

        // ---- mass ----

        /// <summary>kg; 0 of a body that is not dynamic. Setting scales the inertia with it.</summary>
        public float Mass
        {
            get { float value; Native.body_get_mass(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.body_set_mass(P, id, value); GC.KeepAlive(world); }
        }
        /// <summary>
        /// What the solver uses; setting overrides what the shapes give, until <see cref="ResetMass"/>.
        /// </summary>
        public MassData MassData
        {
            get
            {
                MassData value = default(MassData);
                value.StructSize = (uint)sizeof(MassData);
                Native.body_get_mass_data(P, id, &value);
                GC.KeepAlive(world);
                return value;
            }
            set
            {
                value.StructSize = (uint)sizeof(MassData);
                Native.body_set_mass_data(P, id, &value);
                GC.KeepAlive(world);
            }
        }
        /// <summary>Mass and inertia from the shapes and their densities again.</summary>
        public void ResetMass() { Native.body_reset_mass(P, id); GC.KeepAlive(world); }

        // ---- settings ----

        /// <summary>World axes along and about which it cannot move.</summary>
        public void SetLocks(Axes linear, Axes angular)
        {
            Native.body_set_locks(P, id, (uint)linear, (uint)angular);
            GC.KeepAlive(world);
        }
        /// <summary>World axes along which it cannot move, and about which it cannot rotate.</summary>
        public void GetLocks(out Axes linear, out Axes angular)
        {
            uint l, a;
            Native.body_get_locks(P, id, &l, &a);
            GC.KeepAlive(world);
            linear = (Axes)l;
            angular = (Axes)a;
        }
        /// <summary>1/s.</summary>
        public void SetDamping(float linear, float angular)
        {
            Native.body_set_damping(P, id, linear, angular);
            GC.KeepAlive(world);
        }
        /// <summary>1/s: v /= 1 + h c in each substep of h seconds.</summary>
        public void GetDamping(out float linear, out float angular)
        {
            float l, a;
            Native.body_get_damping(P, id, &l, &a);
            GC.KeepAlive(world);
            linear = l;
            angular = a;
        }
        /// <summary>Factor of the world's gravity.</summary>
        public float GravityScale
        {
            get { float value; Native.body_get_gravity_scale(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.body_set_gravity_scale(P, id, value); GC.KeepAlive(world); }
        }
        /// <summary>Waking wakes all it touches; putting to sleep stops it and all those.</summary>
        public bool Awake
        {
            get { int value; Native.body_get_awake(P, id, &value); GC.KeepAlive(world); return value != 0; }
            set { Native.body_set_awake(P, id, value ? 1 : 0); GC.KeepAlive(world); }
        }
        /// <summary>May it sleep? false wakes it.</summary>
        public bool SleepAllowed
        {
            get { int value; Native.body_get_sleep_allowed(P, id, &value); GC.KeepAlive(world); return value != 0; }
            set { Native.body_set_sleep_allowed(P, id, value ? 1 : 0); GC.KeepAlive(world); }
        }
        /// <summary>m/s.</summary>
        public float SleepThreshold
        {
            get { float value; Native.body_get_sleep_threshold(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.body_set_sleep_threshold(P, id, value); GC.KeepAlive(world); }
        }
        /// <summary>A disabled body keeps its place but neither moves, nor collides, nor is seen by queries.</summary>
        public bool Enabled
        {
            get { int value; Native.body_get_enabled(P, id, &value); GC.KeepAlive(world); return value != 0; }
            set { Native.body_set_enabled(P, id, value ? 1 : 0); GC.KeepAlive(world); }
        }
        /// <summary>Stopped by moving bodies too when it is fast.</summary>
        public bool Bullet
        {
            get { int value; Native.body_get_bullet(P, id, &value); GC.KeepAlive(world); return value != 0; }
            set { Native.body_set_bullet(P, id, value ? 1 : 0); GC.KeepAlive(world); }
        }
        /// <summary>A number of yours.</summary>
        public ulong UserData
        {
            get { ulong value; Native.body_get_user_data(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.body_set_user_data(P, id, value); GC.KeepAlive(world); }
        }
        /// <summary>Layer, mask and group of all its shapes, see <see cref="ShapeDef"/>.</summary>
        public void SetFilter(uint layer, uint mask, int group = 0)
        {
            Native.body_set_filter(P, id, layer, mask, group);
            GC.KeepAlive(world);
        }
        /// <summary>WrongStateException when it has no shapes, or when they have different filters.</summary>
        public void GetFilter(out uint layer, out uint mask, out int group)
        {
            uint l, m;
            int g;
            Native.body_get_filter(P, id, &l, &m, &g);
            GC.KeepAlive(world);
            layer = l;
            mask = m;
            group = g;
        }
        /// <summary>The box around its shapes. It must have some, and none of them a plane.</summary>
        public WorldBounds Bounds
        {
            get { WorldBounds value; Native.body_get_bounds(P, id, &value); GC.KeepAlive(world); return value; }
        }

        // ---- queries ----

        /// <summary>A segment against this body only.</summary>
        public bool Raycast(DVec3 origin, DVec3 translation, out Hit hit)
        {
            Hit found = default(Hit);
            int result = Native.body_raycast(P, id, &origin, &translation, &found);
            GC.KeepAlive(world);
            hit = found;
            return result == 1;
        }
        /// <summary>The point of this body that is closest to a point.</summary>
        public bool GetClosestPoint(DVec3 point, out ClosestPoint closest)
        {
            ClosestPoint found = default(ClosestPoint);
            int result = Native.body_closest_point(P, id, &point, &found);
            GC.KeepAlive(world);
            closest = found;
            return result == 1;
        }

        /// <inheritdoc/>
        public bool Equals(Body other) { return world == other.world && id == other.id; }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is Body && Equals((Body)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return id.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(Body a, Body b) { return a.Equals(b); }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(Body a, Body b) { return !a.Equals(b); }
        /// <inheritdoc/>
        public override string ToString() { return "Body 0x" + id.ToString("x"); }
    }
}
