// fe_hull.c - the API of convex hulls: assets of a store. From any thread.
#include "api/fe_store.h"
#include "core/fp_state.h"
#include "store/asset.h"

#include <string.h>

enum { MOST_POINTS = 1000000, DEFAULT_VERTICES = 64 };
enum { LEAST_FACE = 8 }; // bytes of a face's record that every client has

// ---- birth ---------------------------------------------------------------------------------------------------------

static fe_hull_def default_hull(void)
{
    return (fe_hull_def){.struct_size = sizeof(fe_hull_def), .max_vertices = DEFAULT_VERTICES};
}

void fe_hull_def_init(fe_hull_def *def, uint32_t struct_size)
{
    fe_hull_def defaults = default_hull();
    fe__init_struct(def, &defaults, sizeof defaults, struct_size);
}

static fe_result check_points(const char *function, const fe_hull_def *def)
{
    for (int32_t i = 0; i < def->point_count; ++i) {
        float p[3];
        memcpy(p, fe__at_const(def->points, def->point_stride, i), sizeof p);
        for (int32_t k = 0; k < 3; ++k) {
            if (p[k] >= -FE_MAX_LENGTH && p[k] <= FE_MAX_LENGTH) continue;
            return fe__fail(function, FE_ERROR_ARGUMENT, "points[%d].%c is %.9g, must be in [%.9g, %.9g]", (int)i,
                            "xyz"[k], (double)p[k], (double)-FE_MAX_LENGTH, (double)FE_MAX_LENGTH);
        }
    }
    return FE_OK;
}

static fe_result read_hull(const char *function, const fe_hull_def *def, fe_hull_def *full)
{
    *full = default_hull();
    FE_READ_STRUCT(def, full);
    FE_CHECK_INT(full->point_count, 4, MOST_POINTS);
    FE_CHECK_INT(full->max_vertices, 4, FE__HULL_VERTICES);
    FE_CHECK_FLOAT(full->tolerance, 0.0f, FE_MAX_LENGTH);
    FE_CHECK_STRIDE(full->point_stride, 3 * sizeof(float), 3 * sizeof(float));
    FE_CHECK_INT(full->reserved, 0, 0);
    FE_CHECK_POINTER(full->points);
    return check_points(function, full);
}

static fe_result tell_refusal(const char *function, const fe__hull_refusal *r)
{
    static const char *const bound = "must be at least";
    fe_dvec3 n = r->normal;
    if (fe__ddot(n, n) == 0.0)
        return fe__fail(function, FE_ERROR_DEGENERATE,
                        "the points are on a line, or in one place: %.6f m thick, %s %.6f m", r->thickness, bound,
                        r->least);
    return fe__fail(function, FE_ERROR_DEGENERATE,
                    "the points are flat: %.6f m thick along (%.4f, %.4f, %.4f), %s %.6f m", r->thickness, n.x, n.y,
                    n.z, bound, r->least);
}

fe_result fe_hull_create(fe_store *store, const fe_hull_def *def, fe_asset *out_asset)
{
    if (out_asset) *out_asset = 0;
    FE_BEGIN_STORE(store);
    FE_CHECK_POINTER(out_asset);
    fe_hull_def full;
    FE_TRY(read_hull(function, def, &full));
    fe__hull_points points = {full.points, full.point_stride, full.point_count, full.max_vertices,
                              (double)full.tolerance};
    fe__hull_refusal refusal;
    fe_asset asset;
    fe__fp_state fp = fe__fp_enter();
    fe_result result = fe__hull_create(store, &points, &refusal, &asset);
    fe__fp_leave(fp);
    if (result == FE_ERROR_DEGENERATE) return tell_refusal(function, &refusal);
    if (result != FE_OK) return fe__report(function, result);
    *out_asset = asset;
    return FE_OK;
}

// ---- reading -------------------------------------------------------------------------------------------------------
// Under the store's lock: another thread may destroy the asset.

static fe_result find_hull(const char *function, const fe_store *store, fe_asset hull, const fe__hull **out_hull)
{
    int32_t index;
    FE_TRY(fe__find_asset_of(function, "hull", store, FE__ASSET_HULL, hull, &index));
    *out_hull = &fe__store_asset(store, index)->hull;
    return FE_OK;
}

// Exact: see origin in form/hull.h
static fe_vec3 in_asset(const fe__hull *h, fe_vec3 v) { return fe__add(h->origin, v); }

static fe_hull_info describe(const fe__hull *h)
{
    return (fe_hull_info){.vertex_count = h->vertex_count,
                          .edge_count = h->edge_count,
                          .face_count = h->face_count,
                          .volume = (float)h->mass.volume,
                          .area = (float)h->mass.area,
                          .centre = fe__narrow(fe__dadd(fe__widen(h->origin), h->mass.centre)),
                          .inertia = h->mass.inertia,
                          .inertia_rotation = h->mass.axes,
                          .lower = in_asset(h, h->low),
                          .upper = in_asset(h, h->high),
                          .thickness = h->thickness,
                          .inner_radius = h->inner_radius,
                          .tolerance = h->tolerance,
                          .error = h->error,
                          .bytes = h->size + (int64_t)sizeof(fe__asset)};
}

FE_DEFINE_EMPTY_INIT(fe_hull_info_init, fe_hull_info, info)

fe_result fe_hull_get_info(const fe_store *store, fe_asset hull, fe_hull_info *out_info)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_STRUCT_SIZE(out_info);
    const fe__hull *h;
    fe_hull_info info;
    fe__fp_state fp = fe__fp_enter();
    fe__store_lock(store);
    fe_result result = find_hull(function, store, hull, &h);
    if (result == FE_OK) info = describe(h);
    fe__store_unlock(store);
    fe__fp_leave(fp);
    if (result == FE_OK) fe__write_struct(out_info, &info, sizeof info);
    return result;
}

static int32_t write_vertices(const fe__hull *h, void *out, uint32_t stride, int32_t capacity)
{
    for (int32_t i = 0; i < fe__mini(h->vertex_count, capacity); ++i) {
        fe_vec3 vertex = in_asset(h, fe__hull_vertex(h, i));
        memcpy(fe__at(out, stride, i), &vertex, sizeof vertex);
    }
    return h->vertex_count;
}

// The plane, moved from the hull's frame to the asset's
static fe_hull_face describe_face(const fe__hull *h, int32_t i)
{
    fe_vec3 normal = fe__hull_normal(h, i);
    double distance = (double)h->distances[i] + fe__ddot(fe__widen(normal), fe__widen(h->origin));
    return (fe_hull_face){.first = h->faces[i].first,
                          .count = h->faces[i].count,
                          .normal = normal,
                          .distance = (float)distance};
}

static int32_t write_faces(const fe__hull *h, void *out, uint32_t stride, int32_t capacity)
{
    for (int32_t i = 0; i < fe__mini(h->face_count, capacity); ++i) {
        fe_hull_face face = describe_face(h, i);
        memcpy(fe__at(out, stride, i), &face, stride < sizeof face ? stride : sizeof face);
    }
    return h->face_count;
}

static int32_t write_corners(const fe__hull *h, void *out, uint32_t stride, int32_t capacity)
{
    for (int32_t i = 0; i < fe__mini(2 * h->edge_count, capacity); ++i) {
        int32_t corner = h->corners[i];
        memcpy(fe__at(out, stride, i), &corner, sizeof corner);
    }
    return 2 * h->edge_count;
}

static int32_t write_part(const char *function, const fe_store *store, fe_asset hull, void *out, uint32_t stride,
                          int32_t capacity, int32_t (*write)(const fe__hull *, void *, uint32_t, int32_t))
{
    const fe__hull *h;
    fe__fp_state fp = fe__fp_enter();
    fe__store_lock(store);
    fe_result result = find_hull(function, store, hull, &h);
    int32_t count = result == FE_OK ? write(h, out, stride, capacity) : (int32_t)result;
    fe__store_unlock(store);
    fe__fp_leave(fp);
    return count;
}

int32_t fe_hull_get_vertices(const fe_store *store, fe_asset hull, fe_vec3 *out_vertices, uint32_t stride,
                             int32_t capacity)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_ARRAY(out_vertices, capacity);
    FE_CHECK_STRIDE(stride, sizeof *out_vertices, sizeof *out_vertices);
    return write_part(function, store, hull, out_vertices, stride, capacity, write_vertices);
}

int32_t fe_hull_get_faces(const fe_store *store, fe_asset hull, fe_hull_face *out_faces, uint32_t stride,
                          int32_t capacity)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_ARRAY(out_faces, capacity);
    FE_CHECK_RECORD_STRIDE(stride, LEAST_FACE, capacity);
    return write_part(function, store, hull, out_faces, stride, capacity, write_faces);
}

int32_t fe_hull_get_corners(const fe_store *store, fe_asset hull, int32_t *out_corners, uint32_t stride,
                            int32_t capacity)
{
    FE_BEGIN_STORE(store);
    FE_CHECK_ARRAY(out_corners, capacity);
    FE_CHECK_STRIDE(stride, sizeof *out_corners, sizeof *out_corners);
    return write_part(function, store, hull, out_corners, stride, capacity, write_corners);
}
