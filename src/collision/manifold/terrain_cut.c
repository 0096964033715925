// terrain_cut.c - a face of a body and a triangle of a heightfield, one cut by the other.
#include "collision/form/clip.h"
#include "collision/form/hull.h"
#include "collision/form/form.h"
#include "collision/manifold/terrain_kernels.h"

static void project(const fe_vec3 *points, int32_t count, fe_vec3 origin, const fe__mat3 *frame, fe__clip_vertex *out)
{
    for (int32_t i = 0; i < count; ++i) {
        fe_vec3 p = fe__mul_transposed(frame, fe__sub(points[i], origin));
        out[i] = (fe__clip_vertex){p.x, p.y, p.z, fe__clip_id(i > 0 ? i - 1 : count - 1, i)};
    }
}

void fe__tile_body_face(const fe__form *form, const fe__mat3 *rotation, fe_vec3 direction, int32_t vertex,
                        const fe_vec3 *foot, fe__face *face)
{
    fe_vec3 local = fe__mul_transposed(rotation, direction), under;
    if (foot) under = fe__mul_transposed(rotation, *foot), foot = &under;
    face->foot = foot;
    if (vertex >= 0)
        fe__hull_form_face_at(form, vertex, local, face);
    else
        fe__form_face_under(form, local, foot, face);
    face->foot = NULL;
    for (int32_t i = 0; i < face->count; ++i) face->vertex[i] = fe__mul(rotation, face->vertex[i]);
}

static int32_t is_vertex(uint32_t id) { return (id & 0xff) < FE_CLIP_SIDE && id >> 8 < FE_CLIP_SIDE; }

void fe__tile_cut_piece(const fe__tile *tile, const fe__cut *cut, fe__cut_piece *piece)
{
    const fe_vec3 *reference = cut->reference;
    fe_vec3 edge = fe__sub(reference[1], reference[0]), u = fe__scale(1.0f / fe__length(edge), edge);
    piece->origin = reference[0], piece->frame = (fe__mat3){u, fe__cross(cut->out, u), cut->out};
    fe__clip_vertex side[FE_FACE_VERTICES];
    project(reference, cut->reference_count, reference[0], &piece->frame, side);
    project(cut->incident, cut->incident_count, reference[0], &piece->frame, piece->vertex);
    float slack = 0.1f * cut->tie + 1e-6f * tile->size;
    piece->count = fe__clip_polygon(side, cut->reference_count, piece->vertex, cut->incident_count, slack);
}

void fe__tile_gather_piece(fe__gathering *g, const fe__tile *tile, const fe__cut *cut, const fe__cut_piece *piece)
{
    const fe__mat3 *frame = &piece->frame;
    for (int32_t i = 0; i < piece->count; ++i) {
        const fe__clip_vertex *v = piece->vertex + i;
        if (v->height > g->margin || !fe__tile_feels(g, tile, v->height)) continue;
        fe_vec3 p = fe__add_scaled(piece->origin, v->u, frame->x);
        p = fe__add_scaled(fe__add_scaled(p, v->v, frame->y), 0.5f * v->height, frame->z);
        uint32_t feature = cut->body_id << 16 | v->id;
        int32_t is_corner = cut->body_id && is_vertex(v->id);
        fe__gather(g, tile, cut->normal, p, v->height, is_corner ? feature : fe__tile_id(tile, feature));
    }
}

void fe__tile_cut_faces(fe__gathering *g, const fe__tile *tile, const fe__cut *cut)
{
    fe__cut_piece piece;
    fe__tile_cut_piece(tile, cut, &piece);
    fe__tile_gather_piece(g, tile, cut, &piece);
}

int32_t fe__tile_settles(const fe__cut *cut, const fe__cut_piece *piece, float lowest)
{
    if (!(lowest >= -cut->tie)) return 0;
    for (int32_t i = 0; i < piece->count; ++i)
        if (piece->vertex[i].height <= lowest + cut->tie) return 1;
    return 0;
}
