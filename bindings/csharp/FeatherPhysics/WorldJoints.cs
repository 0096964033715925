// Joints of a world. MakeHingeJoint and its like make a definition from a point (and an axis) of the world: the present
// pose is the zero. CreateJoint makes a joint of a definition, CreateHingeJoint and its like do both. A definition
// whose bodies and frames are set by hand goes to CreateJoint too. As an end `default` is the world.
using System;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    public sealed unsafe partial class World
    {
        /// The handle of a joint's end: 0 for the world.
        ulong End(Body body, string where)
        {
            if (body.World != null) Mine(body, where);
            return body.Handle.Value;
        }

        Joint Made(ulong id)
        {
            GC.KeepAlive(this);
            return new Joint(this, id);
        }

        // ---- distance ----

        /// <summary>Makes a joint of a definition whose bodies and frames are set.</summary>
        public Joint CreateJoint(DistanceJointDef def)
        {
            NotNull(def, "World.CreateJoint");
            ulong made;
            fixed (uint* start = &def.StructSize) Native.distance_joint_create(P, start, &made);
            return Made(made);
        }
        /// <summary>A rod between two points, as long as they are apart now. What else `def` says holds.</summary>
        public DistanceJointDef MakeDistanceJoint(Body a, Body b, DVec3 pointA, DVec3 pointB)
        {
            DistanceJointDef def = new DistanceJointDef();
            Place(def, a, b, pointA, pointB, "World.MakeDistanceJoint");
            return def;
        }
        /// <summary>A rod between two points, as long as they are apart now. What else `def` says holds.</summary>
        /// <param name="def">what else holds; its bodies and frames are set; null: the defaults</param>
        public Joint CreateDistanceJoint(Body a, Body b, DVec3 pointA, DVec3 pointB, DistanceJointDef def = null)
        {
            def = def ?? new DistanceJointDef();
            Place(def, a, b, pointA, pointB, "World.CreateDistanceJoint");
            return CreateJoint(def);
        }
        void Place(DistanceJointDef def, Body a, Body b, DVec3 pointA, DVec3 pointB, string where)
        {
            ulong endA = End(a, where), endB = End(b, where);
            fixed (uint* start = &def.StructSize)
                Native.distance_joint_def_at(P, start, endA, endB, &pointA, &pointB);
            GC.KeepAlive(this);
        }

        // ---- ball ----

        /// <summary>Makes a joint of a definition whose bodies and frames are set.</summary>
        public Joint CreateJoint(BallJointDef def)
        {
            NotNull(def, "World.CreateJoint");
            ulong made;
            fixed (uint* start = &def.StructSize) Native.ball_joint_create(P, start, &made);
            return Made(made);
        }
        /// <summary>Two points stay together.</summary>
        /// <param name="axis">X of both frames, world space: what swings and twists, along a limb for example</param>
        public BallJointDef MakeBallJoint(Body a, Body b, DVec3 point, Vector3 axis)
        {
            BallJointDef def = new BallJointDef();
            Place(def, a, b, point, axis, "World.MakeBallJoint");
            return def;
        }
        /// <summary>Two points stay together.</summary>
        /// <param name="def">what else holds; its bodies and frames are set; null: the defaults</param>
        public Joint CreateBallJoint(Body a, Body b, DVec3 point, Vector3 axis, BallJointDef def = null)
        {
            def = def ?? new BallJointDef();
            Place(def, a, b, point, axis, "World.CreateBallJoint");
            return CreateJoint(def);
        }
        void Place(BallJointDef def, Body a, Body b, DVec3 point, Vector3 axis, string where)
        {
            ulong endA = End(a, where), endB = End(b, where);
            fixed (uint* start = &def.StructSize)
                Native.ball_joint_def_at(P, start, endA, endB, &point, &axis);
            GC.KeepAlive(this);
        }

        // ---- hinge ----

        /// <summary>Makes a joint of a definition whose bodies and frames are set.</summary>
        public Joint CreateJoint(HingeJointDef def)
        {
            NotNull(def, "World.CreateJoint");
            ulong made;
            fixed (uint* start = &def.StructSize) Native.hinge_joint_create(P, start, &made);
            return Made(made);
        }
        /// <summary>A door, an elbow, an axle: B rotates against A counterclockwise about the axis.</summary>
        public HingeJointDef MakeHingeJoint(Body a, Body b, DVec3 point, Vector3 axis)
        {
            HingeJointDef def = new HingeJointDef();
            Place(def, a, b, point, axis, "World.MakeHingeJoint");
            return def;
        }
        /// <summary>A door, an elbow, an axle: B rotates against A counterclockwise about the axis.</summary>
        /// <param name="def">what else holds; its bodies and frames are set; null: the defaults</param>
        public Joint CreateHingeJoint(Body a, Body b, DVec3 point, Vector3 axis, HingeJointDef def = null)
        {
            def = def ?? new HingeJointDef();
            Place(def, a, b, point, axis, "World.CreateHingeJoint");
            return CreateJoint(def);
        }
        void Place(HingeJointDef def, Body a, Body b, DVec3 point, Vector3 axis, string where)
        {
            ulong endA = End(a, where), endB = End(b, where);
            fixed (uint* start = &def.StructSize)
                Native.hinge_joint_def_at(P, start, endA, endB, &point, &axis);
            GC.KeepAlive(this);
        }

        // ---- fixed ----

        /// <summary>Makes a joint of a definition whose bodies and frames are set.</summary>
        public Joint CreateJoint(FixedJointDef def)
        {
            NotNull(def, "World.CreateJoint");
            ulong made;
            fixed (uint* start = &def.StructSize) Native.fixed_joint_create(P, start, &made);
            return Made(made);
        }
        /// <summary>Nothing moves.</summary>
        public FixedJointDef MakeFixedJoint(Body a, Body b, DVec3 point)
        {
            FixedJointDef def = new FixedJointDef();
            Place(def, a, b, point, "World.MakeFixedJoint");
            return def;
        }
        /// <summary>Nothing moves.</summary>
        /// <param name="def">what else holds; its bodies and frames are set; null: the defaults</param>
        public Joint CreateFixedJoint(Body a, Body b, DVec3 point, FixedJointDef def = null)
        {
            def = def ?? new FixedJointDef();
            Place(def, a, b, point, "World.CreateFixedJoint");
            return CreateJoint(def);
        }
        void Place(FixedJointDef def, Body a, Body b, DVec3 point, string where)
        {
            ulong endA = End(a, where), endB = End(b, where);
            fixed (uint* start = &def.StructSize)
                Native.fixed_joint_def_at(P, start, endA, endB, &point);
            GC.KeepAlive(this);
        }

        // ---- configurable ----

        /// <summary>Makes a joint of a definition whose bodies and frames are set.</summary>
        public Joint CreateJoint(ConfigurableJointDef def)
        {
            NotNull(def, "World.CreateJoint");
            ulong made;
            fixed (uint* start = &def.StructSize) Native.configurable_joint_create(P, start, &made);
            return Made(made);
        }
        /// <summary>Six axes, each locked, limited or free, with springs and motors.</summary>
        public ConfigurableJointDef MakeConfigurableJoint(Body a, Body b, DVec3 point, Vector3 axis)
        {
            ConfigurableJointDef def = new ConfigurableJointDef();
            Place(def, a, b, point, axis, "World.MakeConfigurableJoint");
            return def;
        }
        /// <summary>Six axes, each locked, limited or free, with springs and motors.</summary>
        /// <param name="def">what else holds; its bodies and frames are set; null: the defaults</param>
        public Joint CreateConfigurableJoint(Body a, Body b, DVec3 point, Vector3 axis, ConfigurableJointDef def = null)
        {
            def = def ?? new ConfigurableJointDef();
            Place(def, a, b, point, axis, "World.CreateConfigurableJoint");
            return CreateJoint(def);
        }
        void Place(ConfigurableJointDef def, Body a, Body b, DVec3 point, Vector3 axis, string where)
        {
            ulong endA = End(a, where), endB = End(b, where);
            fixed (uint* start = &def.StructSize)
                Native.configurable_joint_def_at(P, start, endA, endB, &point, &axis);
            GC.KeepAlive(this);
        }

        // ---- whole definitions: a rope, a slider, a wheel, a motor ----

        /// <summary>The points come no farther from each other than maxLength, m.</summary>
        public DistanceJointDef MakeRopeJoint(Body a, Body b, DVec3 pointA, DVec3 pointB, float maxLength)
        {
            const string where = "World.MakeRopeJoint";
            DistanceJointDef def = new DistanceJointDef();
            ulong endA = End(a, where), endB = End(b, where);
            fixed (uint* start = &def.StructSize)
                Native.rope_joint_def_at(P, start, endA, endB, &pointA, &pointB, maxLength);
            GC.KeepAlive(this);
            return def;
        }
        /// <summary>The points come no farther from each other than maxLength, m.</summary>
        public Joint CreateRopeJoint(Body a, Body b, DVec3 pointA, DVec3 pointB, float maxLength)
        {
            return CreateJoint(MakeRopeJoint(a, b, pointA, pointB, maxLength));
        }
        /// <summary>B slides along an axis and does not rotate. LinearX has its limits, spring and motor.</summary>
        public ConfigurableJointDef MakeSliderJoint(Body a, Body b, DVec3 point, Vector3 axis)
        {
            const string where = "World.MakeSliderJoint";
            ConfigurableJointDef def = new ConfigurableJointDef();
            ulong endA = End(a, where), endB = End(b, where);
            fixed (uint* start = &def.StructSize)
                Native.slider_joint_def_at(P, start, endA, endB, &point, &axis);
            GC.KeepAlive(this);
            return def;
        }
        /// <summary>B slides along an axis and does not rotate. LinearX has its limits, spring and motor.</summary>
        public Joint CreateSliderJoint(Body a, Body b, DVec3 point, Vector3 axis)
        {
            return CreateJoint(MakeSliderJoint(a, b, point, axis));
        }
        /// <summary>
        /// A wheel on a chassis. AngularX is its motor and brake, LinearZ the suspension, AngularZ steers.
        /// </summary>
        public ConfigurableJointDef MakeWheelJoint(Body chassis, Body wheel, DVec3 point, Vector3 axle, Vector3 up,
            float hertz, float dampingRatio, float travel)
        {
            const string where = "World.MakeWheelJoint";
            ConfigurableJointDef def = new ConfigurableJointDef();
            ulong endA = End(chassis, where), endB = End(wheel, where);
            fixed (uint* start = &def.StructSize)
                Native.wheel_joint_def_at(P, start, endA, endB, &point, &axle, &up, hertz, dampingRatio, travel);
            GC.KeepAlive(this);
            return def;
        }
        /// <summary>
        /// A wheel on a chassis. AngularX is its motor and brake, LinearZ the suspension, AngularZ steers.
        /// </summary>
        public Joint CreateWheelJoint(Body chassis, Body wheel, DVec3 point, Vector3 axle, Vector3 up,
            float hertz, float dampingRatio, float travel)
        {
            return CreateJoint(MakeWheelJoint(chassis, wheel, point, axle, up, hertz, dampingRatio, travel));
        }
        /// <summary>
        /// Pulls and rotates B towards a pose relative to A: the targets of all six axes, at first where it is.
        /// </summary>
        public ConfigurableJointDef MakeMotorJoint(Body a, Body b, float hertz, float dampingRatio, float maxForce,
            float maxTorque)
        {
            const string where = "World.MakeMotorJoint";
            ConfigurableJointDef def = new ConfigurableJointDef();
            ulong endA = End(a, where), endB = End(b, where);
            fixed (uint* start = &def.StructSize)
                Native.motor_joint_def_at(P, start, endA, endB, hertz, dampingRatio, maxForce, maxTorque);
            GC.KeepAlive(this);
            return def;
        }
        /// <summary>
        /// Pulls and rotates B towards a pose relative to A: the targets of all six axes, at first where it is.
        /// </summary>
        public Joint CreateMotorJoint(Body a, Body b, float hertz, float dampingRatio, float maxForce, float maxTorque)
        {
            return CreateJoint(MakeMotorJoint(a, b, hertz, dampingRatio, maxForce, maxTorque));
        }
    }
}
