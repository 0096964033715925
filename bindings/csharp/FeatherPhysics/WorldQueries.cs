// Queries of a world: nothing is allocated, arrays are the caller's. A hit names its body by a handle: world[hit.Body].
using System;
using System.Runtime.InteropServices;

namespace FeatherPhysics
{
    public sealed unsafe partial class World
    {
        static NativeFilter Filter(QueryFilter filter, BodyHandle* excluded)
        {
            NativeFilter native = default(NativeFilter);
            native.StructSize = (uint)sizeof(NativeFilter);
            native.Mask = filter.Mask;
            native.Flags = filter.Triggers ? QueryFlags.Triggers : QueryFlags.Default;
            native.ExcludedCount = filter.Excluded == null ? 0 : filter.Excluded.Length;
            native.Excluded = (IntPtr)excluded;
            return native;
        }

        static readonly QueryFilter Everything = new QueryFilter();

        /// <summary>The first body on a segment.</summary>
        /// <param name="translation">from the start to the end, m</param>
        /// <param name="filter">null: every layer, no triggers</param>
        public bool Raycast(DVec3 origin, DVec3 translation, out Hit hit, QueryFilter filter = null)
        {
            Hit found = default(Hit);
            int result;
            if (filter == null) result = Native.world_raycast(P, &origin, &translation, null, &found);
            else fixed (BodyHandle* excluded = filter.Excluded)
            {
                NativeFilter native = Filter(filter, excluded);
                result = Native.world_raycast(P, &origin, &translation, &native, &found);
            }
            GC.KeepAlive(this);
            hit = found;
            return result == 0;
        }
        /// <summary>Is anything on the segment? Faster than the first.</summary>
        public bool RaycastAny(DVec3 origin, DVec3 translation, QueryFilter filter = null)
        {
            filter = filter ?? Everything;
            fixed (BodyHandle* excluded = filter.Excluded)
            {
                NativeFilter native = Filter(filter, excluded);
                int result = Native.world_raycast_any(P, &origin, &translation, &native);
                GC.KeepAlive(this);
                return result == 0;
            }
        }
        /// <summary>Every body on a segment at its first hit, nearest first; returns how many there are.</summary>
        public int RaycastAll(DVec3 origin, DVec3 translation, Span<Hit> hits, QueryFilter filter = null)
        {
            filter = filter ?? Everything;
            fixed (BodyHandle* excluded = filter.Excluded)
            fixed (Hit* out_ = &MemoryMarshal.GetReference(hits))
            {
                NativeFilter native = Filter(filter, excluded);
                int count = Native.world_raycast_all(P, &origin, &translation, &native, out_, 0, hits.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>A hit for each segment (of a miss the fraction is 1 and the body no body); returns how many hit.</summary>
        /// <param name="spread">over the workers of the world</param>
        public int RaycastMany(ReadOnlySpan<Ray> rays, Span<Hit> hits, QueryFilter filter = null, bool spread = false)
        {
            CheckLength(rays.Length, hits.Length, "World.RaycastMany", "hits");
            filter = filter ?? Everything;
            fixed (BodyHandle* excluded = filter.Excluded)
            fixed (Ray* start = &MemoryMarshal.GetReference(rays))
            fixed (Hit* out_ = &MemoryMarshal.GetReference(hits))
            {
                NativeFilter native = Filter(filter, excluded);
                int count = Native.world_raycast_many(P, start, 0, rays.Length, &native, spread ? 1 : 0, out_, 0);
                GC.KeepAlive(this);
                return count;
            }
        }

        /// <summary>What a sphere, capsule or box that moves without turning touches first.</summary>
        public bool Sweep(Geometry geometry, WorldTransform start, DVec3 translation, out Hit hit, QueryFilter filter = null)
        {
            filter = filter ?? Everything;
            Hit found = default(Hit);
            int result;
            fixed (BodyHandle* excluded = filter.Excluded)
            {
                NativeFilter native = Filter(filter, excluded);
                result = Native.world_sweep(P, &geometry, &start, &translation, &native, &found);
            }
            GC.KeepAlive(this);
            hit = found;
            return result == 0;
        }
        public bool SweepAny(Geometry geometry, WorldTransform start, DVec3 translation, QueryFilter filter = null)
        {
            filter = filter ?? Everything;
            fixed (BodyHandle* excluded = filter.Excluded)
            {
                NativeFilter native = Filter(filter, excluded);
                int result = Native.world_sweep_any(P, &geometry, &start, &translation, &native);
                GC.KeepAlive(this);
                return result == 0;
            }
        }
        /// <summary>Every body that it touches on its way, nearest first; returns how many there are.</summary>
        public int SweepAll(Geometry geometry, WorldTransform start, DVec3 translation, Span<Hit> hits, QueryFilter filter = null)
        {
            filter = filter ?? Everything;
            fixed (BodyHandle* excluded = filter.Excluded)
            fixed (Hit* out_ = &MemoryMarshal.GetReference(hits))
            {
                NativeFilter native = Filter(filter, excluded);
                int count = Native.world_sweep_all(P, &geometry, &start, &translation, &native, out_, 0, hits.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>One geometry along many paths; see <see cref="RaycastMany"/>.</summary>
        public int SweepMany(Geometry geometry, ReadOnlySpan<SweepPath> paths, Span<Hit> hits, QueryFilter filter = null, bool spread = false)
        {
            CheckLength(paths.Length, hits.Length, "World.SweepMany", "hits");
            filter = filter ?? Everything;
            fixed (BodyHandle* excluded = filter.Excluded)
            fixed (SweepPath* start = &MemoryMarshal.GetReference(paths))
            fixed (Hit* out_ = &MemoryMarshal.GetReference(hits))
            {
                NativeFilter native = Filter(filter, excluded);
                int count = Native.world_sweep_many(P, &geometry, start, 0, paths.Length, &native, spread ? 1 : 0, out_, 0);
                GC.KeepAlive(this);
                return count;
            }
        }

        /// <summary>The bodies that a sphere, capsule or box overlaps, in the order of creation; returns how many there are.</summary>
        public int Overlap(Geometry geometry, WorldTransform at, Span<BodyHandle> bodies, QueryFilter filter = null)
        {
            filter = filter ?? Everything;
            fixed (BodyHandle* excluded = filter.Excluded)
            fixed (BodyHandle* out_ = &MemoryMarshal.GetReference(bodies))
            {
                NativeFilter native = Filter(filter, excluded);
                int count = Native.world_overlap(P, &geometry, &at, &native, out_, bodies.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        public bool OverlapAny(Geometry geometry, WorldTransform at, QueryFilter filter = null)
        {
            filter = filter ?? Everything;
            fixed (BodyHandle* excluded = filter.Excluded)
            {
                NativeFilter native = Filter(filter, excluded);
                int result = Native.world_overlap_any(P, &geometry, &at, &native);
                GC.KeepAlive(this);
                return result == 0;
            }
        }
        /// <summary>The point of all surfaces that is closest to a point, none farther than maxDistance, m.</summary>
        public bool GetClosestPoint(DVec3 point, double maxDistance, out ClosestPoint closest, QueryFilter filter = null)
        {
            filter = filter ?? Everything;
            ClosestPoint found = default(ClosestPoint);
            int result;
            fixed (BodyHandle* excluded = filter.Excluded)
            {
                NativeFilter native = Filter(filter, excluded);
                result = Native.world_closest_point(P, &point, maxDistance, &native, &found);
            }
            GC.KeepAlive(this);
            closest = found;
            return result == 0;
        }
    }
}
