// A joint: a world and a handle, with fe_joint_* and the definitions of the five types as members.
using System;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    /// <summary>A joint between two bodies, or between a body and the world.</summary>
    public readonly unsafe struct Joint : IEquatable<Joint>
    {
        readonly World world;
        readonly ulong id;

        internal Joint(World world, ulong id) { this.world = world; this.id = id; }

        void* P { get { return World.PointerOf(world, "Joint"); } }

        /// <summary>The world that it belongs to.</summary>
        public World World { get { return world; } }
        /// <summary>Its handle, as arrays and events have it.</summary>
        public JointHandle Handle { get { return new JointHandle(id); } }
        /// <summary>False once it is destroyed or has broken, or its world is disposed.</summary>
        public bool IsValid { get { return World.IsThere(world, World.Kind.Joint, id); } }
        /// <summary>Its bodies wake. They may collide again from the next step on.</summary>
        public void Destroy() { Native.joint_destroy(P, id); GC.KeepAlive(world); }
        /// <summary>Which of the five it is.</summary>
        public JointType Type
        {
            get { int value; Native.joint_get_type(P, id, &value); GC.KeepAlive(world); return (JointType)value; }
        }
        /// <summary><c>default</c> for the end that is the world.</summary>
        public void GetBodies(out Body bodyA, out Body bodyB)
        {
            ulong a, b;
            Native.joint_get_bodies(P, id, &a, &b);
            GC.KeepAlive(world);
            bodyA = a == 0 ? default(Body) : new Body(world, a);
            bodyB = b == 0 ? default(Body) : new Body(world, b);
        }
        /// <summary>False: it does nothing. A change wakes its bodies.</summary>
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

        /// <summary>Speed of the motor alone: its cap stays. A change wakes its bodies.</summary>
        /// <param name="dof">LinearX of a distance joint, AngularX of a hinge, an angular one of a ball joint, any of a
        /// configurable joint</param>
        /// <param name="speed">m/s or rad/s</param>
        public void SetMotorSpeed(Dof dof, float speed)
        {
            Native.joint_set_motor_speed(P, id, (int)dof, speed);
            GC.KeepAlive(world);
        }
        /// <summary>Target of the spring alone. A change wakes its bodies.</summary>
        /// <param name="dof">LinearX of a distance joint, AngularX of a hinge, any of a configurable joint</param>
        /// <param name="target">m or rad</param>
        public void SetTarget(Dof dof, float target)
        {
            Native.joint_set_target(P, id, (int)dof, target);
            GC.KeepAlive(world);
        }
        /// <summary>Target rotation of a ball joint's spring alone. A change wakes its bodies.</summary>
        public void SetTarget(Quaternion target)
        {
            Native.ball_joint_set_target(P, id, &target);
            GC.KeepAlive(world);
        }

        // A definition is read, changed and set again: all of it but the bodies. WrongStateException for a joint of
        // another type. JointDef is what all types have.

        /// <summary>Reads what all types have.</summary>
        public void Get(JointDef def)
        {
            World.NotNull(def, "Joint.Get");
            fixed (uint* start = &def.StructSize) Native.joint_get(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Sets what all types have, but the bodies.</summary>
        public void Set(JointDef def)
        {
            World.NotNull(def, "Joint.Set");
            fixed (uint* start = &def.StructSize) Native.joint_set(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Reads what was set. WrongStateException for a joint of another type.</summary>
        public void Get(DistanceJointDef def)
        {
            World.NotNull(def, "Joint.Get");
            fixed (uint* start = &def.StructSize) Native.distance_joint_get(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Sets all but the bodies. WrongStateException for a joint of another type.</summary>
        public void Set(DistanceJointDef def)
        {
            World.NotNull(def, "Joint.Set");
            fixed (uint* start = &def.StructSize) Native.distance_joint_set(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Reads what was set. WrongStateException for a joint of another type.</summary>
        public void Get(BallJointDef def)
        {
            World.NotNull(def, "Joint.Get");
            fixed (uint* start = &def.StructSize) Native.ball_joint_get(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Sets all but the bodies. WrongStateException for a joint of another type.</summary>
        public void Set(BallJointDef def)
        {
            World.NotNull(def, "Joint.Set");
            fixed (uint* start = &def.StructSize) Native.ball_joint_set(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Reads what was set. WrongStateException for a joint of another type.</summary>
        public void Get(HingeJointDef def)
        {
            World.NotNull(def, "Joint.Get");
            fixed (uint* start = &def.StructSize) Native.hinge_joint_get(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Sets all but the bodies. WrongStateException for a joint of another type.</summary>
        public void Set(HingeJointDef def)
        {
            World.NotNull(def, "Joint.Set");
            fixed (uint* start = &def.StructSize) Native.hinge_joint_set(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Reads what was set. WrongStateException for a joint of another type.</summary>
        public void Get(FixedJointDef def)
        {
            World.NotNull(def, "Joint.Get");
            fixed (uint* start = &def.StructSize) Native.fixed_joint_get(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Sets all but the bodies. WrongStateException for a joint of another type.</summary>
        public void Set(FixedJointDef def)
        {
            World.NotNull(def, "Joint.Set");
            fixed (uint* start = &def.StructSize) Native.fixed_joint_set(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Reads what was set. WrongStateException for a joint of another type.</summary>
        public void Get(ConfigurableJointDef def)
        {
            World.NotNull(def, "Joint.Get");
            fixed (uint* start = &def.StructSize) Native.configurable_joint_get(P, id, start);
            GC.KeepAlive(world);
        }
        /// <summary>Sets all but the bodies. WrongStateException for a joint of another type.</summary>
        public void Set(ConfigurableJointDef def)
        {
            World.NotNull(def, "Joint.Set");
            fixed (uint* start = &def.StructSize) Native.configurable_joint_set(P, id, start);
            GC.KeepAlive(world);
        }

        /// <inheritdoc/>
        public bool Equals(Joint other) { return world == other.world && id == other.id; }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is Joint && Equals((Joint)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return id.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(Joint a, Joint b) { return a.Equals(b); }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(Joint a, Joint b) { return !a.Equals(b); }
        /// <inheritdoc/>
        public override string ToString() { return "Joint 0x" + id.ToString("x"); }
    }
}
