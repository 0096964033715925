// Queries of a world: nothing is allocated, arrays are the caller's. A hit names its body by a handle: world[hit.Body].
using System;
using System.Runtime.InteropServices;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    public sealed unsafe partial class World
    {
        // The list is read once from the filter, so that its length is that of what is pinned.
        static BodyHandle[] Excluded(QueryFilter filter) { return filter == null ? null : filter.Excluded; }

        /// The filter as the library reads it: null for none.
        static NativeFilter* Given(QueryFilter filter, BodyHandle[] excluded, BodyHandle* first, NativeFilter* into)
        {
            if (filter == null) return null;
            *into = default(NativeFilter);
            into->StructSize = (uint)sizeof(NativeFilter);
            into->Mask = filter.Mask;
            into->Flags = filter.Triggers ? QueryFlags.Triggers : QueryFlags.Default;
            into->ExcludedCount = excluded == null ? 0 : excluded.Length;
            into->Excluded = (IntPtr)first;
            return into;
        }

        /// <summary>The first body on a segment.</summary>
        /// <param name="translation">from the start to the end, m</param>
        /// <param name="filter">null: every layer, no triggers</param>
        public bool Raycast(DVec3 origin, DVec3 translation, out Hit hit, QueryFilter filter = null)
        {
            Hit found = default(Hit);
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            int count;
            fixed (BodyHandle* first = excluded)
                count = Native.world_raycast(P, &origin, &translation, Given(filter, excluded, first, &own), &found);
            GC.KeepAlive(this);
            hit = found;
            return count == 1;
        }
        /// <summary>Is anything on the segment? Faster than the first.</summary>
        public bool RaycastAny(DVec3 origin, DVec3 translation, QueryFilter filter = null)
        {
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            int count;
            fixed (BodyHandle* first = excluded)
                count = Native.world_raycast_any(P, &origin, &translation, Given(filter, excluded, first, &own));
            GC.KeepAlive(this);
            return count == 1;
        }
        /// <summary>Every body on a segment at its first hit, nearest first. Returns how many there are.</summary>
        public int RaycastAll(DVec3 origin, DVec3 translation, Span<Hit> hits, QueryFilter filter = null)
        {
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            fixed (BodyHandle* first = excluded)
            fixed (Hit* out_ = &MemoryMarshal.GetReference(hits))
            {
                int count = Native.world_raycast_all(P, &origin, &translation, Given(filter, excluded, first, &own),
                    out_, (uint)sizeof(Hit), hits.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>A hit for each segment: of a miss the body is none, the fraction 1. Returns how many hit.</summary>
        /// <param name="spread">over the workers of the world</param>
        public int RaycastMany(ReadOnlySpan<Ray> rays, Span<Hit> hits, QueryFilter filter = null,
            bool spread = false)
        {
            CheckLength(rays.Length, hits.Length, "World.RaycastMany", "hits");
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            fixed (BodyHandle* first = excluded)
            fixed (Ray* start = &MemoryMarshal.GetReference(rays))
            fixed (Hit* out_ = &MemoryMarshal.GetReference(hits))
            {
                int count = Native.world_raycast_many(P, start, (uint)sizeof(Ray), rays.Length,
                    Given(filter, excluded, first, &own), spread ? 1 : 0, out_, (uint)sizeof(Hit));
                GC.KeepAlive(this);
                return count;
            }
        }

        /// <summary>What a form that moves without rotating touches first.</summary>
        public bool Sweep(Geometry geometry, WorldTransform start, DVec3 translation, out Hit hit,
            QueryFilter filter = null)
        {
            Hit found = default(Hit);
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            int count;
            fixed (BodyHandle* first = excluded)
                count = Native.world_sweep(P, &geometry, &start, &translation,
                    Given(filter, excluded, first, &own), &found);
            GC.KeepAlive(this);
            hit = found;
            return count == 1;
        }
        /// <summary>Does it touch anything? Faster than the first.</summary>
        public bool SweepAny(Geometry geometry, WorldTransform start, DVec3 translation, QueryFilter filter = null)
        {
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            int count;
            fixed (BodyHandle* first = excluded)
                count = Native.world_sweep_any(P, &geometry, &start, &translation,
                    Given(filter, excluded, first, &own));
            GC.KeepAlive(this);
            return count == 1;
        }
        /// <summary>Every body that it touches on its motion, nearest first. Returns how many there are.</summary>
        public int SweepAll(Geometry geometry, WorldTransform start, DVec3 translation, Span<Hit> hits,
            QueryFilter filter = null)
        {
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            fixed (BodyHandle* first = excluded)
            fixed (Hit* out_ = &MemoryMarshal.GetReference(hits))
            {
                int count = Native.world_sweep_all(P, &geometry, &start, &translation,
                    Given(filter, excluded, first, &own), out_, (uint)sizeof(Hit), hits.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>
        /// What a form touches first that turns on its way by the length of <paramref name="turn"/>, rad, about its
        /// direction, at a constant rate.
        /// </summary>
        public bool SweepTurning(Geometry geometry, WorldTransform start, DVec3 translation, Vector3 turn, out Hit hit,
            QueryFilter filter = null)
        {
            Hit found = default(Hit);
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            int count;
            fixed (BodyHandle* first = excluded)
                count = Native.world_sweep_turning(P, &geometry, &start, &translation, &turn,
                    Given(filter, excluded, first, &own), &found);
            GC.KeepAlive(this);
            hit = found;
            return count == 1;
        }
        /// <summary>Does it touch anything while it moves and turns? Faster than the first.</summary>
        public bool SweepTurningAny(Geometry geometry, WorldTransform start, DVec3 translation, Vector3 turn,
            QueryFilter filter = null)
        {
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            int count;
            fixed (BodyHandle* first = excluded)
                count = Native.world_sweep_turning_any(P, &geometry, &start, &translation, &turn,
                    Given(filter, excluded, first, &own));
            GC.KeepAlive(this);
            return count == 1;
        }
        /// <summary>
        /// Every body that it touches while it moves and turns, nearest first. Returns how many there are.
        /// </summary>
        public int SweepTurningAll(Geometry geometry, WorldTransform start, DVec3 translation, Vector3 turn,
            Span<Hit> hits, QueryFilter filter = null)
        {
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            fixed (BodyHandle* first = excluded)
            fixed (Hit* out_ = &MemoryMarshal.GetReference(hits))
            {
                int count = Native.world_sweep_turning_all(P, &geometry, &start, &translation, &turn,
                    Given(filter, excluded, first, &own), out_, (uint)sizeof(Hit), hits.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>One geometry along many paths; see <see cref="RaycastMany"/>.</summary>
        public int SweepMany(Geometry geometry, ReadOnlySpan<SweepPath> paths, Span<Hit> hits,
            QueryFilter filter = null,
            bool spread = false)
        {
            CheckLength(paths.Length, hits.Length, "World.SweepMany", "hits");
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            fixed (BodyHandle* first = excluded)
            fixed (SweepPath* start = &MemoryMarshal.GetReference(paths))
            fixed (Hit* out_ = &MemoryMarshal.GetReference(hits))
            {
                int count = Native.world_sweep_many(P, &geometry, start, (uint)sizeof(SweepPath), paths.Length,
                    Given(filter, excluded, first, &own), spread ? 1 : 0, out_, (uint)sizeof(Hit));
                GC.KeepAlive(this);
                return count;
            }
        }

        /// <summary>
        /// The bodies that a form overlaps, in the order of creation. Returns how many there are.
        /// </summary>
        public int Overlap(Geometry geometry, WorldTransform at, Span<BodyHandle> bodies, QueryFilter filter = null)
        {
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            fixed (BodyHandle* first = excluded)
            fixed (BodyHandle* out_ = &MemoryMarshal.GetReference(bodies))
            {
                int count = Native.world_overlap(P, &geometry, &at, Given(filter, excluded, first, &own),
                    out_, bodies.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>Does it overlap anything?</summary>
        public bool OverlapAny(Geometry geometry, WorldTransform at, QueryFilter filter = null)
        {
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            int count;
            fixed (BodyHandle* first = excluded)
                count = Native.world_overlap_any(P, &geometry, &at, Given(filter, excluded, first, &own));
            GC.KeepAlive(this);
            return count == 1;
        }
        /// <summary>The shapes that it overlaps, in the order of creation, with direction and depth: to move a
        /// character out. Returns how many there are.</summary>
        public int OverlapShapes(Geometry geometry, WorldTransform at, Span<ShapeOverlap> overlaps,
            QueryFilter filter = null)
        {
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            fixed (BodyHandle* first = excluded)
            fixed (ShapeOverlap* out_ = &MemoryMarshal.GetReference(overlaps))
            {
                int count = Native.world_overlap_shapes(P, &geometry, &at, Given(filter, excluded, first, &own),
                    out_, (uint)sizeof(ShapeOverlap), overlaps.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>
        /// The shapes whose bounds meet an axis-aligned box, in the order of creation. Returns how many there are.
        /// </summary>
        public int OverlapBounds(WorldBounds bounds, Span<ShapeHandle> shapes, QueryFilter filter = null)
        {
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            fixed (BodyHandle* first = excluded)
            fixed (ShapeHandle* out_ = &MemoryMarshal.GetReference(shapes))
            {
                int count = Native.world_overlap_bounds(P, &bounds, Given(filter, excluded, first, &own),
                    out_, shapes.Length);
                GC.KeepAlive(this);
                return count;
            }
        }
        /// <summary>The point of all surfaces that is closest to a point, none farther than maxDistance, m.</summary>
        public bool GetClosestPoint(DVec3 point, double maxDistance, out ClosestPoint closest,
            QueryFilter filter = null)
        {
            ClosestPoint found = default(ClosestPoint);
            BodyHandle[] excluded = Excluded(filter);
            NativeFilter own;
            int count;
            fixed (BodyHandle* first = excluded)
                count = Native.world_closest_point(P, &point, maxDistance,
                    Given(filter, excluded, first, &own), &found);
            GC.KeepAlive(this);
            closest = found;
            return count == 1;
        }
    }
}
