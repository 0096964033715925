// An array that a batch reads or fills: for each world, for each item, the numbers of a row.
using System;

namespace FeatherPhysics
{
    /// <summary>
    /// Numbers of all worlds of a batch: for each world, for each item, a row as <see cref="BatchField"/> says. Items
    /// are handles of the batch's template.
    /// </summary>
    public sealed unsafe class BatchArray
    {
        /// <summary>What it holds.</summary>
        public readonly BatchField Field;
        /// <summary>Read in this body's frame: poses relative to it, vectors along its axes. default: the world's.</summary>
        public BodyHandle RelativeTo;
        /// <summary>m, of the world's frame, that positions are read from.</summary>
        public DVec3 Origin;
        internal readonly float[] Floats;   // one of the two
        internal readonly double[] Doubles;
        internal readonly ulong[] Items;    // null: the world itself

        BatchArray(BatchField field, float[] floats, double[] doubles, ulong[] items)
        {
            if (floats == null && doubles == null) throw new BadArgumentException("BatchArray: the data are null");
            Field = field;
            Floats = floats;
            Doubles = doubles;
            Items = items;
        }

        /// <summary>Of the world itself.</summary>
        /// <param name="data">as many numbers as worlds x the row: exactly these</param>
        public BatchArray(BatchField field, float[] data) : this(field, data, null, (ulong[])null) { }
        /// <summary>The same in double.</summary>
        public BatchArray(BatchField field, double[] data) : this(field, null, data, (ulong[])null) { }
        /// <summary>Of bodies.</summary>
        /// <param name="data">as many numbers as worlds x items x the row: exactly these</param>
        public BatchArray(BatchField field, float[] data, params BodyHandle[] bodies)
            : this(field, data, null, Ids(bodies)) { }
        /// <summary>The same in double.</summary>
        public BatchArray(BatchField field, double[] data, params BodyHandle[] bodies)
            : this(field, null, data, Ids(bodies)) { }
        /// <summary>Of joints.</summary>
        public BatchArray(BatchField field, float[] data, params JointHandle[] joints)
            : this(field, data, null, Ids(joints)) { }
        /// <summary>The same in double.</summary>
        public BatchArray(BatchField field, double[] data, params JointHandle[] joints)
            : this(field, null, data, Ids(joints)) { }
        /// <summary>Of shapes.</summary>
        /// <param name="data">as many numbers as worlds x items x the row: exactly these</param>
        public BatchArray(BatchField field, float[] data, params ShapeHandle[] shapes)
            : this(field, data, null, Ids(shapes)) { }
        /// <summary>The same in double.</summary>
        public BatchArray(BatchField field, double[] data, params ShapeHandle[] shapes)
            : this(field, null, data, Ids(shapes)) { }

        static ulong[] Ids(BodyHandle[] bodies)
        {
            return bodies == null ? null : Array.ConvertAll(bodies, body => body.Value);
        }
        static ulong[] Ids(ShapeHandle[] shapes)
        {
            return shapes == null ? null : Array.ConvertAll(shapes, shape => shape.Value);
        }
        static ulong[] Ids(JointHandle[] joints)
        {
            return joints == null ? null : Array.ConvertAll(joints, joint => joint.Value);
        }

        internal object Data { get { return (object)Floats ?? Doubles; } }

        /// What the library takes, with arrays that the caller pins.
        internal NativeBatchArray Describe(IntPtr data, IntPtr items)
        {
            NativeBatchArray native;
            Native.array_init(&native, (uint)sizeof(NativeBatchArray));
            native.Field = Field;
            native.ItemCount = Items == null ? 1 : Items.Length;
            native.IsDouble = Doubles == null ? 0 : 1;
            native.RelativeTo = RelativeTo;
            native.Origin = Origin;
            native.Items = items;
            native.Data = data;
            native.Bytes = Doubles == null ? 4L * Floats.Length : 8L * Doubles.Length;
            return native;
        }
    }
}
