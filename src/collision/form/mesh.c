// mesh.c - what is read of a mesh by triangle; see mesh.h.
#include "collision/form/mesh.h"

// The shortcut of an element that has one
static int32_t shortcut_from(const fe__mesh *m, int32_t element)
{
    int32_t low = 0, high = m->shortcut_count - 1;
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        if (m->shortcuts[middle].from < element)
            low = middle + 1;
        else
            high = middle;
    }
    return m->shortcuts[low].to;
}

// The inverse of a permutation (Munro, Raman, Raman and Rao, Succinct Representations of Permutations, 2003): along the
// cycle of `number` to its end, which is its slot. The first shortcut that is met leads back to before `number`.
int32_t fe__mesh_slot(const fe__mesh *m, int32_t number)
{
    int32_t at = number, is_back = 0;
    while (fe__mesh_number(m, at) != number) {
        if (!is_back && (m->numbers[at] & FE__MESH_HAS_SHORTCUT)) {
            at = shortcut_from(m, at);
            is_back = 1;
        } else {
            at = fe__mesh_number(m, at);
        }
    }
    return at;
}

fe__mesh_edge fe__mesh_edge_of(const fe__mesh *m, int32_t slot, int32_t corner)
{
    static const int32_t digit[3] = {1, FE__MESH_EDGES, FE__MESH_EDGES * FE__MESH_EDGES};
    int32_t side = m->is_mirrored ? 2 - corner : corner;
    return (fe__mesh_edge)(m->edges[slot] / digit[side] % FE__MESH_EDGES);
}

void fe__mesh_corners(const fe__mesh *m, int32_t slot, fe_dvec3 corner[3])
{
    for (int32_t k = 0; k < 3; ++k) {
        const float *v = fe__mesh_vertex(m, slot, fe__mesh_own_corner(m, k));
        corner[k] = (fe_dvec3){m->scale[0] * (double)v[0], m->scale[1] * (double)v[1], m->scale[2] * (double)v[2]};
    }
}

// ---- the form ------------------------------------------------------------------------------------------------------
fe__form fe__mesh_form(const fe__mesh *m, int32_t index)
{
    return (fe__form){.type = FE__FORM_MESH, .field = index, .low = m->low, .high = m->high};
}

float fe__mesh_reach(const fe__form *form, fe_vec3 centre)
{
    fe_vec3 a = fe__sub(centre, form->low), b = fe__sub(form->high, centre);
    return fe__length(fe__vec3(fe__maxf(fe__absf(a.x), fe__absf(b.x)), fe__maxf(fe__absf(a.y), fe__absf(b.y)),
                               fe__maxf(fe__absf(a.z), fe__absf(b.z))));
}
