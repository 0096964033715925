// Joints of a world: from a point (and an axis), so that the present pose is the zero, with what else the definition says; or of a definition
// whose frames were set by hand.
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
        void Ends(Body a, Body b, string where)
        {
            Mine(a, where);
            Mine(b, where);
        }

        Joint Made(ulong id)
        {
            GC.KeepAlive(this);
            return new Joint(this, id);
        }

        Joint Make(DistanceDef def) { ulong made; fixed (uint* start = &def.StructSize) Native.distance_create(P, start, &made); return Made(made); }
        Joint Make(BallDef def) { ulong made; fixed (uint* start = &def.StructSize) Native.ball_create(P, start, &made); return Made(made); }
        Joint Make(HingeDef def) { ulong made; fixed (uint* start = &def.StructSize) Native.hinge_create(P, start, &made); return Made(made); }
        Joint Make(FixedDef def) { ulong made; fixed (uint* start = &def.StructSize) Native.fixed_create(P, start, &made); return Made(made); }
        Joint Make(ConfigurableDef def) { ulong made; fixed (uint* start = &def.StructSize) Native.configurable_create(P, start, &made); return Made(made); }

        /// <summary>A rod between two points, as long as they are apart now. What else `def` says holds.</summary>
        public Joint CreateDistance(Body a, Body b, DVec3 pointA, DVec3 pointB, DistanceDef def = null)
        {
            Ends(a, b, "World.CreateDistance");
            if (def == null) def = new DistanceDef();
            fixed (uint* start = &def.StructSize) Native.distance_def_at(P, start, a.Handle.Value, b.Handle.Value, &pointA, &pointB);
            return Make(def);
        }
        /// <summary>The points come no farther from each other than that, m.</summary>
        public Joint CreateRope(Body a, Body b, DVec3 pointA, DVec3 pointB, float maxLength)
        {
            Ends(a, b, "World.CreateRope");
            DistanceDef def = new DistanceDef();
            fixed (uint* start = &def.StructSize) Native.rope_def_at(P, start, a.Handle.Value, b.Handle.Value, &pointA, &pointB, maxLength);
            return Make(def);
        }
        /// <summary>Two points stay together.</summary>
        /// <param name="axis">X of both frames, world space: what swings and twists, along a limb for example</param>
        public Joint CreateBall(Body a, Body b, DVec3 point, Vector3 axis, BallDef def = null)
        {
            Ends(a, b, "World.CreateBall");
            if (def == null) def = new BallDef();
            fixed (uint* start = &def.StructSize) Native.ball_def_at(P, start, a.Handle.Value, b.Handle.Value, &point, &axis);
            return Make(def);
        }
        /// <summary>A door, an elbow, an axle: B turns against A counterclockwise about the axis.</summary>
        public Joint CreateHinge(Body a, Body b, DVec3 point, Vector3 axis, HingeDef def = null)
        {
            Ends(a, b, "World.CreateHinge");
            if (def == null) def = new HingeDef();
            fixed (uint* start = &def.StructSize) Native.hinge_def_at(P, start, a.Handle.Value, b.Handle.Value, &point, &axis);
            return Make(def);
        }
        /// <summary>Nothing moves.</summary>
        public Joint CreateFixed(Body a, Body b, DVec3 point, FixedDef def = null)
        {
            Ends(a, b, "World.CreateFixed");
            if (def == null) def = new FixedDef();
            fixed (uint* start = &def.StructSize) Native.fixed_def_at(P, start, a.Handle.Value, b.Handle.Value, &point);
            return Make(def);
        }
        /// <summary>Six axes, each locked, limited or free, with drives, as `def` says.</summary>
        public Joint CreateConfigurable(Body a, Body b, DVec3 point, Vector3 axis, ConfigurableDef def = null)
        {
            Ends(a, b, "World.CreateConfigurable");
            if (def == null) def = new ConfigurableDef();
            fixed (uint* start = &def.StructSize) Native.configurable_def_at(P, start, a.Handle.Value, b.Handle.Value, &point, &axis);
            return Make(def);
        }

        // Definitions that the library fills whole; change them and give them to CreateJoint.

        /// <summary>B slides along an axis and does not turn. Its range, spring and motor: AlongX.</summary>
        public ConfigurableDef MakeSlider(Body a, Body b, DVec3 point, Vector3 axis)
        {
            Ends(a, b, "World.MakeSlider");
            ConfigurableDef def = new ConfigurableDef();
            fixed (uint* start = &def.StructSize) Native.slider_def_at(P, start, a.Handle.Value, b.Handle.Value, &point, &axis);
            GC.KeepAlive(this);
            return def;
        }
        /// <summary>A wheel on a chassis. AboutX is its motor and brake, AlongZ the suspension, AboutZ steers.</summary>
        public ConfigurableDef MakeWheel(Body chassis, Body wheel, DVec3 point, Vector3 axle, Vector3 up, float hertz, float dampingRatio, float travel)
        {
            Ends(chassis, wheel, "World.MakeWheel");
            ConfigurableDef def = new ConfigurableDef();
            fixed (uint* start = &def.StructSize)
                Native.wheel_def_at(P, start, chassis.Handle.Value, wheel.Handle.Value, &point, &axle, &up, hertz, dampingRatio, travel);
            GC.KeepAlive(this);
            return def;
        }
        /// <summary>Pulls and turns B towards a pose relative to A, the targets of all six axes.</summary>
        public ConfigurableDef MakeMotor(Body a, Body b, float hertz, float dampingRatio, float maxForce, float maxTorque)
        {
            Ends(a, b, "World.MakeMotor");
            ConfigurableDef def = new ConfigurableDef();
            fixed (uint* start = &def.StructSize)
                Native.motor_def_at(P, start, a.Handle.Value, b.Handle.Value, hertz, dampingRatio, maxForce, maxTorque);
            GC.KeepAlive(this);
            return def;
        }

        // Of definitions with frames set by hand, or made above.

        public Joint CreateJoint(Body a, Body b, DistanceDef def)
        {
            Ready(a, b, def);
            def.BodyA = a;
            def.BodyB = b;
            return Make(def);
        }
        public Joint CreateJoint(Body a, Body b, BallDef def)
        {
            Ready(a, b, def);
            def.BodyA = a;
            def.BodyB = b;
            return Make(def);
        }
        public Joint CreateJoint(Body a, Body b, HingeDef def)
        {
            Ready(a, b, def);
            def.BodyA = a;
            def.BodyB = b;
            return Make(def);
        }
        public Joint CreateJoint(Body a, Body b, FixedDef def)
        {
            Ready(a, b, def);
            def.BodyA = a;
            def.BodyB = b;
            return Make(def);
        }
        public Joint CreateJoint(Body a, Body b, ConfigurableDef def)
        {
            Ready(a, b, def);
            def.BodyA = a;
            def.BodyB = b;
            return Make(def);
        }

        void Ready(Body a, Body b, object def)
        {
            NotNull(def, "World.CreateJoint");
            Ends(a, b, "World.CreateJoint");
        }
    }
}
