// asset_key.c - see asset_key.h. Two hashes of the same numbers, which begin with another word each.
#include "store/asset_key.h"

#include "collision/form/form.h"
#include "core/bytes.h"

#include <string.h>

static void hash_bytes(fe__hash *h, const uint8_t *bytes, int64_t count)
{
    for (int64_t i = 0; i < count; i += 8) {
        uint64_t word = 0;
        for (int64_t k = 0; k < 8 && i + k < count; ++k) word |= (uint64_t)bytes[i + k] << 8 * k;
        fe__hash_u64(h, word);
    }
}

static void hash_floats(fe__hash *h, const float *numbers, int64_t count)
{
    for (int64_t i = 0; i < count; ++i) fe__hash_float(h, numbers[i]);
}

static void hash_quat(fe__hash *h, fe_quat q)
{
    fe__hash_floats2(h, q.x, q.y);
    fe__hash_floats2(h, q.z, q.w);
}

static void hash_material(fe__hash *h, const fe_material *m)
{
    fe__hash_floats2(h, m->static_friction, m->dynamic_friction);
    fe__hash_floats2(h, m->restitution, m->rolling_resistance);
    fe__hash_float(h, m->spinning_resistance);
    fe__hash_i32(h, m->friction_combine);
    fe__hash_i32(h, m->restitution_combine);
    fe__hash_u64(h, m->user_id);
}

static void hash_field(fe__hash *h, const fe__heightfield *f)
{
    fe__hash_i32(h, f->rows);
    fe__hash_i32(h, f->columns);
    fe__hash_double(h, f->cell_x);
    fe__hash_double(h, f->cell_z);
    hash_floats(h, f->heights, (int64_t)f->rows * f->columns);
    fe__hash_i32(h, f->cells != NULL);
    if (f->cells) hash_bytes(h, f->cells, (int64_t)(f->rows - 1) * (f->columns - 1));
}

static void hash_lanes(fe__hash *h, const fe__hull_lanes *lanes, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) fe__hash_vec3(h, fe__hull_lane(lanes, i));
}

static void hash_hull(fe__hash *h, const fe__hull *hull)
{
    fe__hash_i32(h, hull->vertex_count);
    fe__hash_i32(h, hull->face_count);
    fe__hash_i32(h, hull->direction_count);
    fe__hash_vec3(h, hull->origin);
    fe__hash_vec3(h, fe__vec3(hull->extent, hull->tolerance, hull->error));
    hash_lanes(h, &hull->vertices, hull->vertex_count);
    hash_lanes(h, &hull->normals, hull->face_count);
    hash_lanes(h, &hull->directions, hull->direction_count);
    for (int32_t i = 0; i < hull->face_count; ++i)
        fe__hash_u32(h, (uint32_t)hull->faces[i].count << 16 | hull->faces[i].edge);
    hash_bytes(h, hull->corners, 2 * (int64_t)hull->edge_count);
}

static void hash_mesh(fe__hash *h, const fe__mesh *m)
{
    fe__hash_i32(h, m->triangle_count);
    fe__hash_i32(h, m->given_count);
    fe__hash_i32(h, m->vertex_count);
    fe__hash_i32(h, m->node_count);
    fe__hash_i32(h, m->is_two_sided);
    fe__hash_double(h, m->area);
    hash_floats(h, m->vertices, 3 * (int64_t)m->vertex_count);
    for (int32_t i = 0; i < fe__mesh_leaf_count(m->triangle_count); ++i) {
        fe__hash_u32(h, m->leaves[i].first_vertex);
        hash_bytes(h, &m->leaves[i].corner[0][0], sizeof m->leaves[i].corner);
    }
    for (int32_t i = 0; i < m->given_count; ++i) fe__hash_u32(h, m->numbers[i] & ~FE__MESH_HAS_SHORTCUT);
    for (int32_t i = 0; m->data && i < m->triangle_count; ++i) fe__hash_u32(h, m->data[i]);
    hash_bytes(h, m->edges, m->triangle_count);
    if (m->materials) hash_bytes(h, m->materials, m->triangle_count);
}

static void hash_part(fe__hash *h, const fe_store *store, const fe__compound_part *part)
{
    const fe__form *form = &part->form;
    const fe__form_numbers n = fe__numbers_of_form(form);
    fe__hash_i32(h, n.kind);
    fe__hash_floats2(h, n.radius, n.half_height);
    fe__hash_float(h, n.distance);
    fe__hash_vec3(h, n.half);
    fe__hash_vec3(h, n.normal);
    if (fe__form_has_asset(form)) {
        fe__asset_key key = fe__asset_key_of(store, form->field);
        fe__hash_u64(h, key.words[0]);
        fe__hash_u64(h, key.words[1]);
        fe__hash_vec3(h, fe__store_asset(store, form->field)->scale);
    }
    fe__hash_vec3(h, part->position);
    hash_quat(h, part->rotation);
    fe__hash_float(h, part->density);
    fe__hash_i32(h, part->own_material);
    if (part->own_material) hash_material(h, &part->material);
    fe__hash_u64(h, part->user_data);
}

static void hash_asset(fe__hash *h, const fe_store *store, const fe__asset *a)
{
    fe__hash_i32(h, a->kind);
    fe__hash_i32(h, a->material_count);
    for (int32_t i = 0; i < a->material_count; ++i) hash_material(h, a->materials + i);
    switch (a->kind) {
    case FE__ASSET_HEIGHTFIELD:
        hash_field(h, &a->field);
        return;
    case FE__ASSET_HULL:
        hash_hull(h, &a->hull);
        return;
    case FE__ASSET_MESH:
        hash_mesh(h, &a->mesh);
        return;
    default:
        for (int32_t i = 0; i < a->compound.count; ++i) hash_part(h, store, a->compound.parts + i);
    }
}

fe__asset_key fe__asset_key_of(const fe_store *store, int32_t index)
{
    fe__asset *a = fe__store_asset(store, fe__store_parent(store, index)->index);
    for (uint64_t i = 0; i < 2 && !a->is_keyed; ++i) {
        fe__hash h = fe__hash_begin();
        fe__hash_u64(&h, i);
        hash_asset(&h, store, a);
        a->key[i] = fe__hash_end(&h);
    }
    a->is_keyed = a->kind != FE__ASSET_COMPOUND; // what its parts have may change
    return (fe__asset_key){{a->key[0], a->key[1]}};
}

static int32_t has_key(const fe_store *store, int32_t index, fe__asset_key key)
{
    return index >= 0 && fe__id_pool_is_alive(&store->ids, index) && !fe__store_asset(store, index)->parent &&
           fe__keys_are_same(fe__asset_key_of(store, index), key);
}

int32_t fe__store_find_key(const fe_store *store, fe__asset_key key, fe_asset handle)
{
    int32_t found = -1, same = fe__id_slot_of(handle);
    if (has_key(store, same, key) && store->ids.slots[same].generation == fe__id_generation_of(handle)) return same;
    for (int32_t i = 0; i < store->ids.slot_count; ++i) {
        if (!has_key(store, i, key)) continue;
        if (!fe__store_asset(store, i)->destroyed) return i;
        if (found < 0) found = i;
    }
    return found;
}
