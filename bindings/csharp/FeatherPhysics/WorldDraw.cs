// What a world looks like, into arrays of the caller's: nothing is allocated. An array that is too short gets the front.
using System;
using System.Runtime.InteropServices;

namespace FeatherPhysics
{
    public sealed unsafe partial class World
    {
        private static readonly DrawOptions drawDefaults = new DrawOptions(); // only read

        /// <summary>Two vertices a line. Returns how many there are.</summary>
        /// <param name="options">null: shapes in the colours of their islands</param>
        public int DrawLines(Span<DrawVertex> vertices, DrawOptions options = null)
        {
            fixed (DrawVertex* out_ = &MemoryMarshal.GetReference(vertices))
            fixed (uint* given = &(options ?? drawDefaults).StructSize)
            {
                int count = Native.world_draw_lines(P, given, out_, (uint)sizeof(DrawVertex), vertices.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>
        /// Three vertices a triangle, counterclockwise seen from outside. Returns how many vertices there are.
        /// </summary>
        public int DrawTriangles(Span<DrawVertex> vertices, DrawOptions options = null)
        {
            fixed (DrawVertex* out_ = &MemoryMarshal.GetReference(vertices))
            fixed (uint* given = &(options ?? drawDefaults).StructSize)
            {
                int count = Native.world_draw_triangles(P, given, out_, (uint)sizeof(DrawVertex), vertices.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>A vertex a point. Returns how many there are.</summary>
        public int DrawPoints(Span<DrawVertex> vertices, DrawOptions options = null)
        {
            fixed (DrawVertex* out_ = &MemoryMarshal.GetReference(vertices))
            fixed (uint* given = &(options ?? drawDefaults).StructSize)
            {
                int count = Native.world_draw_points(P, given, out_, (uint)sizeof(DrawVertex), vertices.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>Shapes as forms and poses, for renderers. Returns how many there are.</summary>
        public int DrawInstances(Span<DrawInstance> instances, DrawOptions options = null)
        {
            fixed (DrawInstance* out_ = &MemoryMarshal.GetReference(instances))
            fixed (uint* given = &(options ?? drawDefaults).StructSize)
            {
                int count = Native.world_draw_instances(P, given, out_, (uint)sizeof(DrawInstance), instances.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
    }
}
