// facets.h - the faces of the hull: triangles of the surface that lie in one plane, up to a slab.
//
// The largest triangle that has no face yet is the seed of one. Neighbours join while all their vertices lie in the
// slab under the seed's plane, which supports the surface: so a face never drifts away from its plane, as it would if
// the plane were fitted anew. A face that would not be convex, or whose neighbours would not turn away from it, is made
// again with a thinner slab; the thinnest is none at all. Triangles that lie in one plane exactly always make a convex
// face, so that this ends well for any points.
#ifndef FE_COLLISION_HULL_BUILD_FACETS_H
#define FE_COLLISION_HULL_BUILD_FACETS_H
#include "collision/hull_build/hull_surface.h"
#include "core/sort.h"

// The loop of a facet turns left around its normal.
typedef struct fe__facet {
    int32_t seed; // triangle, whose plane is the facet's
    int32_t first, count;
} fe__facet;

typedef struct fe__facets {
    const fe__hull_surface *surface;
    double slab; // steps of the grid
    int32_t count, corner_count;
    fe__facet facets[FE__SURFACE_TRIANGLES];
    int32_t corner[3 * FE__SURFACE_TRIANGLES];    // vertices, of all loops
    int32_t across[3 * FE__SURFACE_TRIANGLES];    // the facet beyond the side from this corner to the next
    int32_t facet_of[FE__SURFACE_TRIANGLES];      // of a triangle; -1: none yet
    int32_t thinness[FE__SURFACE_TRIANGLES];      // of the slab when this triangle is a seed, see facets.c
    int32_t order[FE__SURFACE_TRIANGLES], living; // triangles, the largest first
    int32_t valence[FE__SURFACE_VERTICES];        // of a vertex: facets around it
    int32_t again;                                // a slab became thinner: all facets are to be made anew
    // scratch: the rim of the facet that grows, a ring of vertices; edge: of the facet's triangle, to the next vertex
    int32_t next[FE__SURFACE_VERTICES], previous[FE__SURFACE_VERTICES], edge[FE__SURFACE_VERTICES];
    int32_t in_ring[FE__SURFACE_VERTICES], ring; // of a vertex: the number of the ring that it is in
    int32_t ring_start;                          // one of its vertices
    int32_t members[FE__SURFACE_TRIANGLES], member_count;
    int32_t to_try[3 * FE__SURFACE_TRIANGLES], try_count;
    fe__sort_item items[FE__SURFACE_TRIANGLES], sorting[FE__SURFACE_TRIANGLES];
} fe__facets;

static inline const fe__grid_plane *fe__facet_plane(const fe__facets *f, int32_t facet)
{
    return &f->surface->triangles[f->facets[facet].seed].plane;
}

void fe__facets_find(fe__facets *facets, const fe__hull_surface *surface, double slab);
// Corners between two facets that lie within the slab of the line past them go (corners.c).
void fe__facets_drop_corners(fe__facets *facets);

#endif
