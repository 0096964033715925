// hull_box.c - see hull_box.h.
//
// Vertex i is at + along x, y, z where bit 0, 1, 2 of i is set. Faces: -x, +x, -y, +y, -z, +z.
#include "collision/manifold/hull_box.h"

#include <string.h>

enum { VERTICES = 8, FACES = 6, EDGES = 12 };

// a face's corners turn left around its normal
static const uint8_t corners[2 * EDGES] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
static const fe__hull_face faces[FACES] = {{0, 4, 0, 0},  {4, 4, 0, 0},  {8, 4, 0, 0},
                                           {12, 4, 0, 0}, {16, 4, 0, 0}, {20, 4, 0, 0}};

// from the vertex with the lower number: its ends, and the faces on its left and right
static const uint8_t edges[EDGES][4] = {{0, 4, 0, 2}, {4, 6, 0, 5}, {2, 6, 3, 0}, {0, 2, 4, 0},
                                        {1, 3, 1, 4}, {3, 7, 1, 3}, {5, 7, 5, 1}, {1, 5, 2, 1},
                                        {0, 1, 2, 4}, {4, 5, 5, 2}, {6, 7, 3, 5}, {2, 3, 4, 3}};

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

static float along(float half, int32_t vertex, int32_t axis) { return vertex >> axis & 1 ? half : -half; }

void fe__box_as_hull(const fe__form *box, fe__box_hull *out)
{
    const float half[3] = {box->half.x, box->half.y, box->half.z};
    float least = fe__minf(half[0], fe__minf(half[1], half[2])), most = fe__maxf(half[0], fe__maxf(half[1], half[2]));
    for (int32_t k = 0; k < 3; ++k) {
        for (int32_t i = 0; i < FE__HULL_LANES; ++i) {
            const uint8_t *edge = edges[i < EDGES ? i : 0];
            out->vertices[k][i] = along(half[k], i < VERTICES ? i : 0, k);
            out->tails[k][i] = along(half[k], edge[0], k);
            out->vectors[k][i] = along(half[k], edge[1], k) - out->tails[k][i];
        }
    }
    for (int32_t i = 0; i < FE__HULL_LANES; ++i) out->distances[i] = half[i < FACES ? i / 2 : 0];
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
