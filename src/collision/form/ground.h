// ground.h - a heightfield or a mesh, as the narrow phase, the casts and the queries see it: triangles in its own
// frame.
//
// A triangle is named by its index. The index is the triangle's number in a heightfield, its slot in a mesh.
#ifndef FE_COLLISION_FORM_GROUND_H
#define FE_COLLISION_FORM_GROUND_H
#include "collision/form/heightfield.h"
#include "collision/form/mesh.h"

typedef struct fe__mesh_casts fe__mesh_casts; // collision/cast/mesh_ray.h

typedef struct fe__ground {
    const fe__heightfield *field; // One of field and mesh is NULL.
    const fe__mesh *mesh;
    const fe__mesh_casts *casts; // The kernels of a SIMD set; NULL: those of plain C.
    const fe__mesh_near *near;   // Triangles of the mesh that were found before, or NULL.
} fe__ground;

// The number by which the caller knows the triangle.
static inline int32_t fe__ground_number(const fe__ground *s, int32_t index)
{
    return s->mesh ? fe__mesh_number(s->mesh, index) : index;
}
static inline int32_t fe__ground_is_two_sided(const fe__ground *s) { return s->mesh && s->mesh->is_two_sided; }

void fe__ground_corners(const fe__ground *s, int32_t index, fe_dvec3 corner[3]);
// The unit normal of the side that counts.
fe_dvec3 fe__ground_normal(const fe__ground *s, int32_t index);
// Is there nothing beyond this side of the triangle? Side k runs from corner k to the next.
int32_t fe__ground_is_rim(const fe__ground *s, int32_t index, int32_t side);
fe__bounds fe__ground_bounds(const fe__ground *s);
// The widths of a box that holds few triangles, m; infinite along y for a heightfield.
fe_dvec3 fe__ground_cell(const fe__ground *s);
// fe_hit.barycentric of a point of the triangle: the weights of its second and third corner.
void fe__ground_weights(const fe__ground *s, int32_t index, fe_dvec3 point, float *out_weights);

// Walks over the triangles near a box: by row, column and half in a heightfield, by slot in a mesh. The box may reach
// anywhere.
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
// Returns the index of the next triangle, whose vertices are relative to the walk's origin; -1: no more
static inline int32_t fe__ground_next(fe__ground_walk *walk, fe__form *triangle)
{
    return walk->is_mesh ? fe__mesh_walk_next(&walk->mesh, triangle) : fe__next_triangle(&walk->field, triangle);
}
// Returns the index of the next triangle; -1: no more
static inline int32_t fe__ground_next_index(fe__ground_walk *walk)
{
    fe__form unused;
    return walk->is_mesh ? fe__mesh_walk_next_slot(&walk->mesh) : fe__next_triangle(&walk->field, &unused);
}

// Does the surface go on at p and rise along the unit vector m from there? Triangles nearer to p than `near`, m, count.
int32_t fe__ground_rises(const fe__ground *s, fe_dvec3 p, fe_dvec3 m, double near);

// Is there a triangle with the normal f that is level with one of the points (FE__LEVEL), and that this point lies over
// or under? One walk asks for all points; there is one at least.
int32_t fe__ground_is_level_at_any(const fe__ground *s, const fe_dvec3 *p, int32_t count, fe_dvec3 f);
// The same for one point, over or under by at most `level`, and beside the triangle by at most `beside`, m.
int32_t fe__ground_is_level_about(const fe__ground *s, fe_dvec3 p, fe_dvec3 f, double level, double beside);

// The rim of a solid's face: the face ends at p and goes on along `inward` from there. The other body is at `from`.
typedef struct fe__solid_rim {
    fe_dvec3 p, inward, from;
} fe__solid_rim;
// fe__ground_rises at the rim of a face with the normal m. A triangle does not count when the face rises over it: the
// two make an inner corner there.
int32_t fe__ground_rises_at(const fe__ground *s, const fe__solid_rim *rim, fe_dvec3 m, double near);

#endif
