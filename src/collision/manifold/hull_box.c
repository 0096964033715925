// hull_box.c - see hull_box.h.
//
// Vertex i is at + along x, y, z where bit 0, 1, 2 of i is set. Faces: -x, +x, -y, +y, -z, +z.
#include "collision/manifold/hull_box.h"

#include "core/lanes.h"

enum { VERTICES = 8, FACES = 6, EDGES = 12 };

// a face's corners turn left around its normal
static const uint8_t corners[2 * EDGES] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
static const fe__hull_face faces[FACES] = {{0, 4, 0, 0},  {4, 4, 0, 0},  {8, 4, 0, 0},
                                           {12, 4, 0, 0}, {16, 4, 0, 0}, {20, 4, 0, 0}};

// In half widths: the vertices; of each edge the vertex with the lower number, and the way from there to the other
_Alignas(64) static const
    float signs[3][FE__HULL_LANES] = {{-1, 1, -1, 1, -1, 1, -1, 1, -1, -1, -1, -1, -1, -1, -1, -1},
                                      {-1, -1, 1, 1, -1, -1, 1, 1, -1, -1, -1, -1, -1, -1, -1, -1},
                                      {-1, -1, -1, -1, 1, 1, 1, 1, -1, -1, -1, -1, -1, -1, -1, -1}};
_Alignas(64) static const
    float tails[3][FE__HULL_LANES] = {{-1, -1, -1, -1, 1, 1, 1, 1, -1, -1, -1, -1, -1, -1, -1, -1},
                                      {-1, -1, 1, -1, -1, 1, -1, -1, -1, -1, 1, 1, -1, -1, -1, -1},
                                      {-1, 1, -1, -1, -1, -1, 1, -1, -1, 1, 1, -1, -1, -1, -1, -1}};
_Alignas(64) static const float vectors[3][FE__HULL_LANES] = {{0, 0, 0, 0, 0, 0, 0, 0, 2, 2, 2, 2},
                                                              {0, 2, 0, 2, 2, 0, 2},
                                                              {2, 0, 2, 0, 0, 2, 0, 2, 0, 0, 0, 0, 2, 2, 2, 2}};

// unit normals, of the faces, and of those left and right of each edge; lanes past the count repeat the first
_Alignas(64) static const
    float normals[3][FE__HULL_LANES] = {{-1, 1, 0, 0, 0, 0, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1},
                                        {0, 0, -1, 1, 0, 0},
                                        {0, 0, 0, 0, -1, 1}};
_Alignas(64) static const float left[3][FE__HULL_LANES] = {{-1, -1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, -1, -1, -1, -1},
                                                           {0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 1, 0},
                                                           {0, 0, 0, -1, 0, 0, 1, 0, 0, 1, 0, -1}};
_Alignas(64) static const float right[3][FE__HULL_LANES] = {{0, 0, -1, -1, 0, 0, 1, 1, 0, 0, 0, 0},
                                                            {-1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 0, 1, -1, -1, -1, -1},
                                                            {0, 1, 0, 0, -1, 0, 0, 0, -1, 0, 1, 0}};

const fe__hull fe__unit_box = {.vertex_count = VERTICES,
                               .face_count = FACES,
                               .edge_count = EDGES,
                               .thickness = 2.0f,
                               .inner_radius = 1.0f,
                               .extent = 2.0f,
                               .vertices = {signs[0], signs[1], signs[2]},
                               .normals = {normals[0], normals[1], normals[2]},
                               .tails = {tails[0], tails[1], tails[2]},
                               .vectors = {vectors[0], vectors[1], vectors[2]},
                               .left = {left[0], left[1], left[2]},
                               .right = {right[0], right[1], right[2]},
                               .faces = faces,
                               .corners = corners};

static void scale(float half, const float from[FE__HULL_LANES], float to[FE__HULL_LANES])
{
    for (int32_t i = 0; i < FE__HULL_LANES; i += 4) *(fe__quad *)(to + i) = half * *(const fe__quad *)(from + i);
}

void fe__box_as_hull(const fe__form *box, fe__box_hull *out)
{
    const float half[3] = {box->half.x, box->half.y, box->half.z};
    float least = fe__minf(half[0], fe__minf(half[1], half[2])), most = fe__maxf(half[0], fe__maxf(half[1], half[2]));
    for (int32_t k = 0; k < 3; ++k) {
        scale(half[k], signs[k], out->vertices[k]);
        scale(half[k], tails[k], out->tails[k]);
        scale(half[k], vectors[k], out->vectors[k]);
    }
    const fe__quad x_y = {half[0], half[0], half[1], half[1]}, z = {half[2], half[2], half[0], half[0]},
                   x = fe__quad_set(half[0]); // lanes past the count repeat the first
    fe__quad *distances = (fe__quad *)out->distances;
    distances[0] = x_y, distances[1] = z, distances[2] = distances[3] = x;
    out->hull = (fe__hull){.vertex_count = VERTICES,
                           .face_count = FACES,
                           .edge_count = EDGES,
                           .low = fe__neg(box->half),
                           .high = box->half,
                           .thickness = 2.0f * least,
                           .inner_radius = least,
                           .extent = 2.0f * most,
                           .vertices = {out->vertices[0], out->vertices[1], out->vertices[2]},
                           .normals = {normals[0], normals[1], normals[2]},
                           .distances = out->distances,
                           .tails = {out->tails[0], out->tails[1], out->tails[2]},
                           .vectors = {out->vectors[0], out->vectors[1], out->vectors[2]},
                           .left = {left[0], left[1], left[2]},
                           .right = {right[0], right[1], right[2]},
                           .faces = faces,
                           .corners = corners};
}
