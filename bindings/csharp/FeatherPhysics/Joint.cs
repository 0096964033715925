// A joint: a world and a handle, with fe_joint_* and the definitions of the five types as members.
using System;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    /// <summary>A joint between two bodies.</summary>
    public readonly unsafe struct Joint : IEquatable<Joint>
    {
        readonly World world;
        readonly ulong id;

        internal Joint(World world, ulong id) { this.world = world; this.id = id; }

        void* P { get { return World.PointerOf(world, "Joint"); } }

        public World World { get { return world; } }
        public JointHandle Handle { get { return new JointHandle(id); } }
        public bool IsValid
        {
            get
            {
                if (world == null || world.IsDisposed) return false;
                bool valid = Native.joint_is_valid(P, id) != 0;
                GC.KeepAlive(world);
                return valid;
            }
        }
        public void Destroy() { Native.joint_destroy(P, id); GC.KeepAlive(world); }
        public JointType Type { get { int value; Native.joint_get_type(P, id, &value); GC.KeepAlive(world); return (JointType)value; } }
        public void GetBodies(out Body bodyA, out Body bodyB)
        {
            ulong a, b;
            Native.joint_get_bodies(P, id, &a, &b);
            GC.KeepAlive(world);
            bodyA = new Body(world, a);
            bodyB = new Body(world, b);
        }
        public bool Enabled
        {
            get { int value; Native.joint_get_enabled(P, id, &value); GC.KeepAlive(world); return value != 0; }
            set { Native.joint_set_enabled(P, id, value ? 1 : 0); GC.KeepAlive(world); }
        }
        /// <summary>A number of yours.</summary>
        public ulong UserData
        {
            get { ulong value; Native.joint_get_user_data(P, id, &value); GC.KeepAlive(world); return value; }
            set { Native.joint_set_user_data(P, id, value); GC.KeepAlive(world); }
        }
        /// <summary>Where its frames are, world space.</summary>
        public void GetFrames(out WorldTransform frameA, out WorldTransform frameB)
        {
            WorldTransform a, b;
            Native.joint_get_frames(P, id, &a, &b);
            GC.KeepAlive(world);
            frameA = a;
            frameB = b;
        }
        /// <summary>How it stands now: angle, speeds, errors.</summary>
        public JointState State
        {
            get
            {
                JointState value = default(JointState);
                value.StructSize = (uint)sizeof(JointState);
                Native.joint_get_state(P, id, &value);
                GC.KeepAlive(world);
                return value;
            }
        }
        /// <summary>What it did to B in the last step, on average: N and N m, world axes.</summary>
        public void GetReaction(out Vector3 force, out Vector3 torque)
        {
            Vector3 f, t;
            Native.joint_get_reaction(P, id, &f, &t);
            GC.KeepAlive(world);
            force = f;
            torque = t;
        }

        /// <summary>What all types have: stiffness, breaking, user data.</summary>
        public JointDef Common
        {
            get
            {
                JointDef value = default(JointDef);
                value.StructSize = (uint)sizeof(JointDef);
                Native.joint_get(P, id, &value);
                GC.KeepAlive(world);
                return value;
            }
            set
            {
                value.StructSize = (uint)sizeof(JointDef);
                value.BodyA = value.BodyB = default(BodyHandle);
                Native.joint_set(P, id, &value);
                GC.KeepAlive(world);
            }
        }

        // A definition read back, changed and set again: all of it but the bodies. WrongStateException for a joint of another type.
        public void Get(DistanceDef def) { World.NotNull(def, "Joint.Get"); fixed (uint* start = &def.StructSize) Native.distance_get(P, id, start); GC.KeepAlive(world); }
        public void Set(DistanceDef def) { World.NotNull(def, "Joint.Set"); fixed (uint* start = &def.StructSize) Native.distance_set(P, id, start); GC.KeepAlive(world); }
        public void Get(BallDef def) { World.NotNull(def, "Joint.Get"); fixed (uint* start = &def.StructSize) Native.ball_get(P, id, start); GC.KeepAlive(world); }
        public void Set(BallDef def) { World.NotNull(def, "Joint.Set"); fixed (uint* start = &def.StructSize) Native.ball_set(P, id, start); GC.KeepAlive(world); }
        public void Get(HingeDef def) { World.NotNull(def, "Joint.Get"); fixed (uint* start = &def.StructSize) Native.hinge_get(P, id, start); GC.KeepAlive(world); }
        public void Set(HingeDef def) { World.NotNull(def, "Joint.Set"); fixed (uint* start = &def.StructSize) Native.hinge_set(P, id, start); GC.KeepAlive(world); }
        public void Get(FixedDef def) { World.NotNull(def, "Joint.Get"); fixed (uint* start = &def.StructSize) Native.fixed_get(P, id, start); GC.KeepAlive(world); }
        public void Set(FixedDef def) { World.NotNull(def, "Joint.Set"); fixed (uint* start = &def.StructSize) Native.fixed_set(P, id, start); GC.KeepAlive(world); }
        public void Get(ConfigurableDef def)
        {
            World.NotNull(def, "Joint.Get");
            fixed (uint* start = &def.StructSize) Native.configurable_get(P, id, start);
            GC.KeepAlive(world);
        }
        public void Set(ConfigurableDef def)
        {
            World.NotNull(def, "Joint.Set");
            fixed (uint* start = &def.StructSize) Native.configurable_set(P, id, start);
            GC.KeepAlive(world);
        }

        public bool Equals(Joint other) { return world == other.world && id == other.id; }
        public override bool Equals(object other) { return other is Joint && Equals((Joint)other); }
        public override int GetHashCode() { return id.GetHashCode(); }
        public static bool operator ==(Joint a, Joint b) { return a.Equals(b); }
        public static bool operator !=(Joint a, Joint b) { return !a.Equals(b); }
        public override string ToString() { return "Joint 0x" + id.ToString("x"); }
    }
}
