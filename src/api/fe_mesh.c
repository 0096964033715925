// fe_mesh.c - the API of meshes: assets of a store. From any thread.
#include "api/fe_store.h"
#include "api/check.h"
#include "core/fp_state.h"
#include "store/asset.h"
#include "world/asset_users.h"

#define LEAST_WELD_DISTANCE 1e-6f // m
#define MOST_WELD_DISTANCE 1.0f
#define MOST_EDGE_ANGLE 1.57f // rad: at a right angle all edges of boxes would be lost
#define EDGE_ANGLE 0.035f

// ---- birth ---------------------------------------------------------------------------------------------------------

static fe_mesh_def default_mesh(void)
{
    return (fe_mesh_def){.struct_size = sizeof(fe_mesh_def), .edge_angle = EDGE_ANGLE};
}

void fe_mesh_def_init(fe_mesh_def *def, uint32_t struct_size)
{
    fe_mesh_def defaults = default_mesh();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

static fe_result check_count(const char *function, const char *name, int32_t count, int32_t most)
{
    if (count <= most) return FE_OK;
    return fe__fail(function, FE_ERROR_LIMIT, "%s is %d, must be at most %d", name, (int)count, (int)most);
}

static fe_result check_numbers(const char *function, fe_mesh_def *def)
{
    FE_CHECK_BITS(def->flags, FE_MESH_TWO_SIDED | FE_MESH_STRICT);
    FE_TRY(check_count(function, "vertex_count", def->vertex_count, FE__MESH_VERTICES));
    FE_TRY(check_count(function, "triangle_count", def->triangle_count, FE__MESH_TRIANGLES));
    FE_CHECK_INT(def->vertex_count, 3, FE__MESH_VERTICES);
    FE_CHECK_INT(def->triangle_count, 1, FE__MESH_TRIANGLES);
    FE_CHECK_INT(def->index_type, FE_INDEX_U32, FE_INDEX_U16);
    FE_CHECK_INT(def->reserved, 0, 0);
    if (def->weld_distance != 0.0f) FE_CHECK_FLOAT(def->weld_distance, LEAST_WELD_DISTANCE, MOST_WELD_DISTANCE);
    FE_CHECK_FLOAT(def->edge_angle, 0.0f, MOST_EDGE_ANGLE);
    uint32_t vertex = 3 * sizeof(float), indices = def->index_type == FE_INDEX_U16 ? 6 : 12;
    FE_CHECK_STRIDE(def->vertex_stride, vertex, vertex);
    FE_CHECK_STRIDE(def->index_stride, indices, indices);
    FE_CHECK_POINTER(def->vertices);
    FE_CHECK_POINTER(def->indices);
    return FE_OK;
}

static fe__mesh_source source_of(const fe_mesh_def *def)
{
    return (fe__mesh_source){.vertices = (const unsigned char *)def->vertices,
                             .indices = def->indices,
                             .vertex_stride = def->vertex_stride,
                             .index_stride = def->index_stride,
                             .is_short = def->index_type == FE_INDEX_U16,
                             .vertex_count = def->vertex_count,
                             .triangle_count = def->triangle_count,
                             .weld_distance = (double)def->weld_distance,
                             .edge_angle = (double)def->edge_angle,
                             .materials = def->triangle_materials,
                             .data = def->triangle_data,
                             .is_strict = (def->flags & FE_MESH_STRICT) != 0,
                             .is_two_sided = (def->flags & FE_MESH_TWO_SIDED) != 0};
}

static fe_result check_vertices(const char *function, const fe__mesh_source *s)
{
    for (int32_t i = 0; i < s->vertex_count; ++i) {
        float v[3];
        memcpy(v, fe__at_const(s->vertices, s->vertex_stride, i), sizeof v);
        for (int32_t k = 0; k < 3; ++k) {
            if (v[k] >= -FE_MAX_LENGTH && v[k] <= FE_MAX_LENGTH) continue;
            return fe__fail(function, FE_ERROR_ARGUMENT, "vertices[%d].%c is %.9g, must be in [%.9g, %.9g]", (int)i,
                            "xyz"[k], (double)v[k], (double)-FE_MAX_LENGTH, (double)FE_MAX_LENGTH);
        }
    }
    return FE_OK;
}

static fe_result check_indices(const char *function, const fe__mesh_source *s)
{
    for (int32_t i = 0; i < s->triangle_count; ++i) {
        for (int32_t k = 0; k < 3; ++k) {
            uint32_t index = fe__mesh_source_index(s, i, k);
            if (index < (uint32_t)s->vertex_count) continue;
            return fe__fail(function, FE_ERROR_ARGUMENT, "index %d of triangle %d is %lld, must be in [0, %d]", (int)k,
                            (int)i, (long long)index, (int)(s->vertex_count - 1));
        }
    }
    return FE_OK;
}

static fe_result check_materials(const char *function, fe_mesh_def *def)
{
    if (!def->triangle_materials) return FE_OK;
    FE_CHECK_INT(def->material_count, 1, FE__MESH_MATERIALS);
    FE_CHECK_ARRAY(def->materials, def->material_count);
    FE_CHECK_STRIDE(def->material_stride, sizeof *def->materials, sizeof *def->materials);
    for (int32_t i = 0; i < def->triangle_count; ++i) {
        if (def->triangle_materials[i] < def->material_count) continue;
        return fe__fail(function, FE_ERROR_ARGUMENT, "triangle_materials[%d] is %d, must be in [0, %d]", (int)i,
                        def->triangle_materials[i], (int)(def->material_count - 1));
    }
    return fe__check_materials(function, def->materials, def->material_stride, def->material_count);
}

static fe_result read_mesh(const char *function, const fe_mesh_def *def, fe_mesh_def *full, fe__mesh_source *source)
{
    *full = default_mesh();
    FE_READ_STRUCT(def, full);
    FE_TRY(check_numbers(function, full));
    FE_TRY(check_materials(function, full));
    *source = source_of(full);
    FE_TRY(check_vertices(function, source));
    return check_indices(function, source);
}

static fe_result tell_refusal(const char *function, const fe__mesh_refusal *r)
{
    if (r->triangle < 0)
        return fe__fail(function, FE_ERROR_DEGENERATE, "no triangle has an area: the mesh would be empty");
    const char *why = r->is_duplicate ? "repeats an earlier one" : "has no area";
    return fe__fail(function, FE_ERROR_DEGENERATE, "triangle %d %s, and FE_MESH_STRICT is set", (int)r->triangle, why);
}

fe_result fe_mesh_create(fe_store *store, const fe_mesh_def *def, fe_asset *out_asset)
{
    if (out_asset) *out_asset = 0;
    FE_BEGIN_STORE(store);
    FE_CHECK_POINTER(out_asset);
    fe_mesh_def full;
    fe__mesh_source source;
    FE_TRY(read_mesh(function, def, &full, &source));
    int32_t materials = full.triangle_materials ? full.material_count : 0;
    fe__mesh_refusal refusal;
    fe_asset asset;
    fe__fp_state fp = fe__fp_enter();
    fe_result result =
        fe__mesh_create(store, &source, full.materials, full.material_stride, materials, &refusal, &asset);
    fe__fp_leave(fp);
    if (result == FE_ERROR_DEGENERATE) return tell_refusal(function, &refusal);
    if (result != FE_OK) return fe__report(function, result);
    *out_asset = asset;
    return FE_OK;
}

// ---- reading and materials -----------------------------------------------------------------------------------------
// Under the store's lock: another thread may destroy the asset.

static fe_result find_mesh(const char *function, const fe_store *store, fe_asset mesh, fe__asset **out_asset)
{
    int32_t index;
    FE_TRY(fe__find_asset_of(function, "mesh", store, FE__ASSET_MESH, mesh, &index));
    *out_asset = fe__store_asset(store, index);
    return FE_OK;
}

static fe_mesh_info describe(const fe__asset *a)
{
    const fe__mesh *m = &a->mesh;
    return (fe_mesh_info){.triangle_count = m->triangle_count,
                          .degenerate_triangles = m->degenerate_count,
                          .duplicate_triangles = m->duplicate_count,
                          .vertex_count = m->welded_count,
                          .open_edges = m->open_count,
                          .crowded_edges = m->odd_count,
                          .flipped_edges = m->flipped_count,
                          .tree_height = m->depth,
                          .material_count = a->material_count,
                          .lower = m->low,
                          .upper = m->high,
                          .area = m->area,
                          .volume = m->volume,
                          .bytes = m->size + (int64_t)(sizeof *a + sizeof(fe_material) * (size_t)a->material_count)};
}

FE_DEFINE_EMPTY_INIT(fe_mesh_info_init, fe_mesh_info, info)

fe_result fe_mesh_get_info(const fe_store *store, fe_asset mesh, fe_mesh_info *out_info)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_STRUCT_SIZE(out_info);
    fe__asset *a;
    fe_mesh_info info;
    fe__store_lock(store);
    fe_result result = find_mesh(function, store, mesh, &a);
    if (result == FE_OK) info = describe(a);
    fe__store_unlock(store);
    if (result == FE_OK) fe__write_struct(out_info, &info, sizeof info);
    return result;
}

static fe_mesh_triangle describe_triangle(const fe__mesh *m, int32_t number)
{
    static const uint32_t flags[FE__MESH_EDGES] = {[FE__MESH_EDGE_BENT] = FE_MESH_EDGE_CONVEX,
                                                   [FE__MESH_EDGE_CONVEX] = FE_MESH_EDGE_CONVEX | FE_MESH_EDGE_FELT,
                                                   [FE__MESH_EDGE_OPEN] = FE_MESH_EDGE_OPEN | FE_MESH_EDGE_FELT,
                                                   [FE__MESH_EDGE_ODD] = FE_MESH_EDGE_FELT};
    fe_mesh_triangle t = {.kept = 1};
    int32_t slot = fe__mesh_slot(m, number);
    if (slot >= m->triangle_count) return (fe_mesh_triangle){0};
    for (int32_t k = 0; k < 3; ++k) {
        memcpy(t.corners + k, fe__mesh_vertex(m, slot, k), sizeof t.corners[k]);
        t.edges[k] = flags[fe__mesh_edge_of(m, slot, k)];
    }
    t.material = m->materials ? m->materials[slot] : -1;
    t.data = m->data ? m->data[slot] : 0;
    return t;
}

static fe_result read_triangle(const char *function, const fe_store *store, fe_asset mesh, int32_t triangle,
                               fe_mesh_triangle *out)
{
    fe__asset *a;
    FE_TRY(find_mesh(function, store, mesh, &a));
    FE_CHECK_INT(triangle, 0, a->mesh.given_count - 1);
    *out = describe_triangle(&a->mesh, triangle);
    return FE_OK;
}

FE_DEFINE_EMPTY_INIT(fe_mesh_triangle_init, fe_mesh_triangle, triangle)

fe_result fe_mesh_get_triangle(const fe_store *store, fe_asset mesh, int32_t triangle, fe_mesh_triangle *out_triangle)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_STRUCT_SIZE(out_triangle);
    fe_mesh_triangle full;
    fe__store_lock(store);
    fe_result result = read_triangle(function, store, mesh, triangle, &full);
    fe__store_unlock(store);
    if (result == FE_OK) fe__write_struct(out_triangle, &full, sizeof full);
    return result;
}

static fe_result set_materials(const char *function, fe_store *store, fe_asset mesh, const fe_material *materials,
                               uint32_t stride, int32_t count)
{
    int32_t index;
    FE_TRY(fe__find_asset_of(function, "mesh", store, FE__ASSET_MESH, mesh, &index));
    int32_t there = fe__store_asset(store, index)->material_count;
    FE_CHECK_INT(count, there, there);
    const fe__assets_entered users = {&index, 1, NULL};
    fe_result entered = fe__assets_enter_worlds(store, &users);
    if (entered != FE_OK) {
        const char *why = entered == FE_ERROR_STEPPING ? "is in a step" : "has another thread inside, or a player";
        return fe__fail(function, entered, "a world that uses mesh 0x%llx %s; nothing was changed", mesh, why);
    }
    fe__mesh_edit_materials(store, index, materials, stride);
    fe__record_materials(store, index);
    fe__assets_leave_worlds(store, &users);
    return FE_OK;
}

fe_result fe_mesh_set_materials(fe_store *store, fe_asset mesh, const fe_material *materials, uint32_t stride,
                                int32_t count)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_ARRAY(materials, count);
    FE_CHECK_STRIDE(stride, sizeof *materials, sizeof *materials);
    FE_TRY(fe__check_materials(function, materials, stride, count));
    fe__store_lock(store);
    fe_result result = set_materials(function, store, mesh, materials, stride, count);
    fe__store_unlock(store);
    return result;
}
