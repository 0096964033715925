// ground.h - what is touched by triangles: a heightfield or a mesh, in its own frame.
//
// A triangle is named by its index: a heightfield's is its number, a mesh's its slot.
#ifndef FE_COLLISION_FORM_GROUND_H
#define FE_COLLISION_FORM_GROUND_H
#include "collision/form/heightfield.h"
#include "collision/form/mesh.h"

typedef struct fe__mesh_casts fe__mesh_casts; // collision/cast/mesh_ray.h

typedef struct fe__ground {
    const fe__heightfield *field; // one of the two, the other is NULL
    const fe__mesh *mesh;
    const fe__mesh_casts *casts; // of a SIMD set, NULL: of plain C
    const fe__mesh_near *near;   // of the mesh, or NULL
} fe__ground;

// The number by which the caller knows the triangle
static inline int32_t fe__ground_number(const fe__ground *s, int32_t index)
{
    return s->mesh ? fe__mesh_number(s->mesh, index) : index;
}
static inline int32_t fe__ground_is_two_sided(const fe__ground *s) { return s->mesh && s->mesh->is_two_sided; }

void fe__ground_corners(const fe__ground *s, int32_t index, fe_dvec3 corner[3]);
fe_dvec3 fe__ground_normal(const fe__ground *s, int32_t index); // unit, of the side that counts
// Is there nothing beyond side k of the triangle, from corner k to the next?
int32_t fe__ground_is_rim(const fe__ground *s, int32_t index, int32_t side);
fe__bounds fe__ground_bounds(const fe__ground *s);
// Widths of a box that holds few triangles, m; infinite along an axis that has no share in it
fe_dvec3 fe__ground_cell(const fe__ground *s);
// fe_hit.barycentric of a point of the triangle
void fe__ground_weights(const fe__ground *s, int32_t index, fe_dvec3 point, float *out_weights);

// The triangles near a box: of a heightfield by row, column, half; of a mesh by slot. The box may reach anywhere.
//
//   fe__ground_walk walk;
//   fe__ground_begin(&walk, surface, &box, origin);
//   for (int32_t i; (i = fe__ground_next(&walk, &triangle)) >= 0;) ...
typedef struct fe__ground_walk {
    int32_t is_mesh;
    union {
        fe__triangle_walk field;
        fe__mesh_walk mesh;
    };
} fe__ground_walk;

static inline void fe__ground_begin(fe__ground_walk *walk, const fe__ground *s, const fe__bounds *box, fe_dvec3 origin)
{
    walk->is_mesh = s->mesh != NULL;
    if (walk->is_mesh)
        fe__mesh_walk_begin(&walk->mesh, s->mesh, s->near, box, origin);
    else
        walk->field = fe__heightfield_walk(s->field, box, origin);
}
// Index of the next triangle, its vertices relative to the walk's origin; -1: no more.
static inline int32_t fe__ground_next(fe__ground_walk *walk, fe__form *triangle)
{
    return walk->is_mesh ? fe__mesh_walk_next(&walk->mesh, triangle) : fe__next_triangle(&walk->field, triangle);
}
// Its index alone
static inline int32_t fe__ground_next_index(fe__ground_walk *walk)
{
    fe__form unused;
    return walk->is_mesh ? fe__mesh_walk_next_slot(&walk->mesh) : fe__next_triangle(&walk->field, &unused);
}

// Does the surface go on at p and rise along the unit m from there? A triangle nearer to p than `near`, m, counts.
int32_t fe__ground_rises(const fe__ground *s, fe_dvec3 p, fe_dvec3 m, double near);

// Has it a triangle with the normal f that is level with one of the points (FE__LEVEL), and that this point lies over
// or under? One walk for all of them, 1 or more
int32_t fe__ground_is_level_at_any(const fe__ground *s, const fe_dvec3 *p, int32_t count, fe_dvec3 f);
// The same of a point, over or under by at most `level`, and beside the triangle by at most `beside`, m
int32_t fe__ground_is_level_about(const fe__ground *s, fe_dvec3 p, fe_dvec3 f, double level, double beside);

// A face of a solid that ends at p and lies along `inward` from there, touched by what is at `from`
typedef struct fe__solid_rim {
    fe_dvec3 p, inward, from;
} fe__solid_rim;
// The same at the rim of a face with the normal m. A triangle does not count when the face rises over it: the two make
// an inner corner there.
int32_t fe__ground_rises_at(const fe__ground *s, const fe__solid_rim *rim, fe_dvec3 m, double near);

#endif
