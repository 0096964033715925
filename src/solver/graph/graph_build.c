// graph_build.c - see graph_build.h.
#include "solver/graph/graph_build.h"

int32_t fe__line_of(const fe__builder *b, int32_t body)
{
    const fe__body *a = b->in->bodies + body;
    if (a->type == FE_BODY_DYNAMIC) return a->line;
    return fe__is_kinematic(a) && a->awake_index >= 0 ? b->kinematic_line[a->awake_index] : FE__STATIC_LINE;
}

fe__group *fe__open_group(fe__builder *b, fe__batch *batch, fe__group like, int32_t lanes, int32_t row_size)
{
    fe__solver *s = b->s;
    fe__group *g = s->groups + s->group_count++;
    int32_t dummy = batch->first_line + (like.kind < FE__ROW_KINDS ? like.kind : FE__ROW_KINDS - 1 + like.sides);
    *g = like;
    g->lane = s->lane_count, g->offset = batch->row_bytes, g->rows = (lanes + like.width - 1) / like.width;
    for (int32_t i = 0; i < g->rows * g->width; ++i) s->lanes[s->lane_count + i] = (fe__lane){0, 0, dummy, dummy, 0};
    s->lane_count += g->rows * g->width;
    // a wide row may come after thin ones
    batch->row_bytes += g->rows * (g->width < b->width ? fe__whole_blocks(row_size) : row_size);
    ++batch->group_count;
    return g;
}
