// fuzz_calls.c - every function of the API with arguments from the stream. See fuzz.c.
#include "support/fuzz_state.h"

#include <string.h>

#define COUNT(array) ((int32_t)(sizeof(array) / sizeof *(array)))

// ---- definitions ---------------------------------------------------------------------------------------------------

typedef struct long_body_def {
    fe_body_def def;
    unsigned char tail[FUZZ_TAIL];
} long_body_def;

typedef struct long_shape_def {
    fe_shape_def def;
    unsigned char tail[FUZZ_TAIL];
} long_shape_def;

typedef struct long_geometry {
    fe_geometry geometry;
    unsigned char tail[FUZZ_TAIL];
} long_geometry;

static fe_body_def some_body(fuzz *f)
{
    fe_body_def d;
    fe_body_def_init(&d, sizeof d);
    uint8_t kind = fuzz_byte(f), more = fuzz_byte(f);
    d.type = kind < 40 ? FE_BODY_STATIC : kind < 60 ? FE_BODY_KINEMATIC : kind < 64 ? (int32_t)kind : FE_BODY_DYNAMIC;
    d.transform = fuzz_transform(f);
    if (more & 1) d.linear_velocity = fuzz_vec3(f);
    if (more & 2) d.angular_velocity = fuzz_vec3(f);
    if ((more & 12) == 12) d.linear_locks = fuzz_byte(f) % 9u, d.angular_locks = fuzz_byte(f) % 9u;
    if ((more & 48) == 48)
        d.linear_damping = fuzz_float(f), d.gravity_scale = fuzz_float(f), d.sleep_threshold = fuzz_float(f);
    if ((more & 80) == 80)
        d.awake = fuzz_byte(f) % 3, d.enabled = fuzz_byte(f) % 3, d.bullet = fuzz_byte(f) % 3,
        d.sleep_allowed = fuzz_byte(f) % 2;
    return d;
}

fe_geometry fuzz_geometry(fuzz *f)
{
    fe_geometry g;
    memset(&g, 0, sizeof g);
    g.struct_size = sizeof g;
    static const int32_t types[] = {FE_GEOMETRY_SPHERE,     FE_GEOMETRY_CAPSULE, FE_GEOMETRY_BOX,
                                    FE_GEOMETRY_SPHERE,     FE_GEOMETRY_CAPSULE, FE_GEOMETRY_BOX,
                                    FE_GEOMETRY_SPHERE,     FE_GEOMETRY_CAPSULE, FE_GEOMETRY_BOX,
                                    FE_GEOMETRY_CYLINDER,   FE_GEOMETRY_CONE,    FE_GEOMETRY_CYLINDER,
                                    FE_GEOMETRY_PLANE,      FE_GEOMETRY_NONE,    6,
                                    FE_GEOMETRY_HULL,       FE_GEOMETRY_HULL,    FE_GEOMETRY_HULL,
                                    FE_GEOMETRY_HEIGHTFIELD};
    g.type = types[fuzz_byte(f) % COUNT(types)];
    g.radius = fuzz_size(f);
    g.half_height = fuzz_size(f);
    g.half_extents.x = fuzz_size(f);
    g.half_extents.y = fuzz_size(f);
    g.half_extents.z = fuzz_size(f);
    if (g.type == FE_GEOMETRY_HULL) {
        g.asset = fuzz_asset(f);
        if (fe_asset_get_type(world_store(f->world), g.asset) == FE_GEOMETRY_COMPOUND) g.type = FE_GEOMETRY_COMPOUND;
        fuzz_scale(f, &g);
    }
    if (g.type == FE_GEOMETRY_PLANE) g.normal = fuzz_vec3(f), g.distance = fuzz_float(f);
    return g;
}

static fe_material some_material(fuzz *f)
{
    fe_material m = SURFACE(0.6f, 0.5f, 0.0f, 0.0f, 0.0f);
    uint8_t which = fuzz_byte(f);
    if (which & 1) m.static_friction = fuzz_size(f);
    if (which & 2) m.dynamic_friction = fuzz_size(f);
    if (which & 4) m.restitution = fuzz_size(f);
    if (which & 8) m.rolling_resistance = fuzz_size(f);
    if (which & 16) m.spinning_resistance = fuzz_size(f);
    return m;
}

static fe_shape_def some_shape(fuzz *f)
{
    fe_shape_def d;
    fe_shape_def_init(&d, sizeof d);
    uint8_t which = fuzz_byte(f);
    if (which & 1) d.material = some_material(f);
    if ((which & 6) == 6) d.frame.position = fuzz_vec3(f), d.frame.rotation = fuzz_quat(f);
    if ((which & 24) == 24) d.layer = fuzz_byte(f) % 5u, d.mask = fuzz_byte(f);
    if (which & 32) d.events = fuzz_byte(f) % 9u;
    if ((which & 36) == 36)
        d.pair_filter = fuzz_byte(f) % 3, d.one_way = fuzz_byte(f) % 3, d.one_way_direction = fuzz_vec3(f);
    if ((which & 192) == 192)
        d.trigger = fuzz_byte(f) % 3, d.density = fuzz_float(f), d.surface_velocity = fuzz_vec3(f);
    return d;
}

// ---- worlds --------------------------------------------------------------------------------------------------------

static int32_t step(fuzz *f)
{
    static const float lengths[] = {1.0f / 60.0f, 1.0f / 60.0f, 1.0f / 60.0f, 0.0f, 1.0f / 240.0f, 0.1f, 1.0f, 1e-6f};
    uint8_t kind = fuzz_byte(f);
    float dt = kind < 240 ? lengths[kind % 8] : fuzz_float(f);
    if (f->steps >= FUZZ_MOST_STEPS) return FE_OK;
    fe_result result = fuzz_step(f, dt);
    if (result == FE_OK) f->steps += 1;
    return result;
}

static int32_t step_some(fuzz *f)
{
    for (int32_t i = 0; i < 10 && f->steps < FUZZ_MOST_STEPS; ++i, ++f->steps) {
        fe_result result = fuzz_step(f, 1.0f / 60.0f);
        while (result == FE_ERROR_MEMORY) result = fuzz_step(f, 1.0f / 60.0f);
        if (result != FE_OK) fuzz_fail(f, "a step fails");
        fuzz_check(f);
    }
    return FE_OK;
}

static int32_t set_gravity(fuzz *f)
{
    fe_vec3 g = fuzz_vec3(f);
    return fe_world_set_gravity(f->world, or_null(f, &g));
}

static int32_t set_substeps(fuzz *f) { return fe_world_set_substeps(f->world, (int32_t)fuzz_byte(f) - 2); }

static int32_t set_tuning(fuzz *f)
{
    struct {
        fe_world_tuning tuning;
        unsigned char tail[FUZZ_TAIL];
    } t;
    memset(&t, 0, sizeof t);
    fe_world_tuning_init(&t.tuning, sizeof t.tuning);
    float *fields[] = {&t.tuning.contact_hertz,         &t.tuning.contact_damping_ratio, &t.tuning.contact_push_speed,
                       &t.tuning.restitution_threshold, &t.tuning.hit_event_threshold,   &t.tuning.sleep_time,
                       &t.tuning.speculative_distance,  &t.tuning.max_linear_speed};
    *fields[fuzz_byte(f) % COUNT(fields)] = fuzz_size(f);
    t.tuning.struct_size = fuzz_struct_size(f, sizeof t.tuning);
    return fe_world_set_tuning(f->world, or_null(f, &t));
}

static int32_t ignore(fuzz *f)
{
    fe_body a = fuzz_body(f), b = fuzz_body(f);
    return fe_world_ignore_collision(f->world, a, b, fuzz_byte(f) % 3);
}

static int32_t optimize(fuzz *f) { return fe_world_optimize(f->world); }

static int32_t raycast(fuzz *f)
{
    fe_query_filter filter;
    fe_hit hit;
    fe_query_filter_init(&filter, sizeof filter);
    filter.mask = fuzz_byte(f) * 3u;
    filter.flags = fuzz_byte(f) % 3u;
    filter.excluded = f->bodies;
    filter.excluded_count = fuzz_byte(f) % 8 - 1;
    filter.struct_size = fuzz_struct_size(f, sizeof filter);
    if (filter.struct_size > sizeof filter) filter.struct_size = sizeof filter;
    fe_dvec3 origin = fuzz_dvec3(f), along = fuzz_dvec3(f);
    int32_t result = fe_world_raycast(f->world, or_null(f, &origin), &along, or_null(f, &filter), &hit);
    if (result != 1) return result;
    if (!(hit.fraction >= 0.0 && hit.fraction <= 1.0) && !f->is_wild) fuzz_fail(f, "a fraction outside the segment");
    if (!fe_body_is_valid(f->world, hit.body) || !fe_shape_is_valid(f->world, hit.shape))
        fuzz_fail(f, "a hit on nothing");
    float square = hit.normal.x * hit.normal.x + hit.normal.y * hit.normal.y + hit.normal.z * hit.normal.z;
    int32_t no_direction = along.x == 0.0 && along.y == 0.0 && along.z == 0.0;
    if (!f->is_wild && !no_direction && !(square > 0.999f && square < 1.001f))
        fuzz_fail(f, "a normal that is no unit vector");
    fe__hash_double(&f->told, hit.fraction);
    return result;
}

static void check_fuzz_hit(fuzz *f, const fe_hit *hit)
{
    if (!fe_body_is_valid(f->world, hit->body) || !fe_shape_is_valid(f->world, hit->shape))
        fuzz_fail(f, "a hit on nothing");
    if (!(hit->fraction >= 0.0 && hit->fraction <= 1.0) && !f->is_wild) fuzz_fail(f, "a fraction outside the segment");
    fe__hash_double(&f->told, hit->fraction);
}

// None, anything at all, or up to a turn
static fe_vec3 fuzz_turn(fuzz *f)
{
    const float scale = 0.05f;
    int32_t which = fuzz_byte(f) % 4;
    if (which == 0) return (fe_vec3){0.0f, 0.0f, 0.0f};
    if (which == 1) return fuzz_vec3(f);
    float x = (float)fuzz_byte(f) - 128.0f, y = (float)fuzz_byte(f) - 128.0f, z = (float)fuzz_byte(f) - 128.0f;
    return (fe_vec3){scale * x, scale * y, scale * z};
}

static int32_t query_many(fuzz *f)
{
    enum { MOST = 4 };
    fe_hit hits[MOST];
    fe_ray rays[MOST] = {{.reserved = {0}}};
    fe_path paths[MOST] = {{.reserved = {0}}};
    fe_geometry g = fuzz_geometry(f);
    for (int32_t i = 0; i < MOST; ++i) {
        rays[i].origin = fuzz_dvec3(f);
        rays[i].translation = paths[i].translation = fuzz_dvec3(f);
        paths[i].start = fuzz_transform(f);
        paths[i].turn = fuzz_turn(f);
    }
    int32_t spread = fuzz_byte(f) % 3, count = fuzz_byte(f) % (MOST + 1);
    int32_t found = fuzz_byte(f) & 1 ? fe_world_raycast_many(f->world, or_null(f, rays), sizeof *rays, count, NULL,
                                                             spread, hits, sizeof *hits)
                                     : fe_world_sweep_many(f->world, or_null(f, &g), paths, sizeof *paths, count, NULL,
                                                           spread, hits, sizeof *hits);
    for (int32_t i = 0; i < count && found >= 0; ++i) {
        if (hits[i].body) check_fuzz_hit(f, &hits[i]);
    }
    return found;
}

static int32_t query_forms(fuzz *f)
{
    enum { MOST = 4 };
    fe_hit hits[MOST];
    fe_body bodies[MOST];
    fe_geometry g = fuzz_geometry(f);
    if (fuzz_byte(f) % 8 == 0) g.type = FE_GEOMETRY_SPHERE, g.radius = 0.0f;
    fe_transform t = fuzz_transform(f);
    fe_dvec3 way = fuzz_dvec3(f);
    fe_query_filter filter;
    fe_query_filter_init(&filter, sizeof filter);
    filter.flags = fuzz_byte(f) % 3u;
    int32_t room = fuzz_byte(f) % (MOST + 1), overlap = fe_world_overlap(f->world, &g, &t, &filter, bodies, room);
    int32_t all = fe_world_sweep_all(f->world, or_null(f, &g), &t, &way, &filter, hits, sizeof *hits, room);
    int32_t first = fe_world_sweep(f->world, &g, &t, &way, or_null(f, &filter), hits);
    if (first == 1) check_fuzz_hit(f, hits);
    fe__hash_u64(&f->told, (uint64_t)(uint32_t)all);
    fe__hash_u64(&f->told, (uint64_t)(uint32_t)overlap);
    fe_vec3 turn = fuzz_turn(f);
    if (fe_world_sweep_turning(f->world, &g, &t, &way, &turn, &filter, hits) == 1) check_fuzz_hit(f, hits);
    all = fe_world_sweep_turning_all(f->world, &g, &t, &way, or_null(f, &turn), &filter, hits, sizeof *hits, room);
    fe__hash_u64(&f->told, (uint64_t)(uint32_t)all);
    (void)fe_world_sweep_turning_any(f->world, or_null(f, &g), &t, &way, &turn, NULL);
    return fe_world_sweep_any(f->world, &g, &t, or_null(f, &way), &filter);
}

static int32_t query_rays(fuzz *f)
{
    enum { MOST = 4, WIDEST = sizeof(fe_hit) };
    fe_hit hits[MOST + 1]; // so that MOST of the widest fit
    fe_dvec3 origin = fuzz_dvec3(f), way = fuzz_dvec3(f);
    int32_t room = fuzz_byte(f) % (MOST + 1);
    uint32_t stride = fuzz_byte(f) % (WIDEST + 1);
    int32_t all = fe_world_raycast_all(f->world, or_null(f, &origin), &way, NULL, hits,
                                       stride < WIDEST / 2 ? WIDEST : stride, room);
    fe__hash_u64(&f->told, (uint64_t)(uint32_t)all);
    if (fe_body_raycast(f->world, fuzz_body(f), &origin, &way, hits) == 1) check_fuzz_hit(f, hits);
    if (fe_shape_raycast(f->world, fuzz_shape(f), &origin, &way, hits) == 1) check_fuzz_hit(f, hits);
    return fe_world_raycast_any(f->world, &origin, or_null(f, &way), NULL);
}

static int32_t query_points(fuzz *f)
{
    fe_closest c;
    fe_dvec3 point = fuzz_dvec3(f);
    double most = (double)fuzz_size(f);
    int32_t result = fe_world_closest_point(f->world, or_null(f, &point), most, NULL, &c);
    if (result == 1 && !f->is_wild && !(c.distance <= most)) fuzz_fail(f, "a closest point too far off");
    (void)fe_body_closest_point(f->world, fuzz_body(f), &point, &c);
    return fe_shape_closest_point(f->world, fuzz_shape(f), &point, or_null(f, &c) ? &c : NULL);
}

static int32_t fail_memory(fuzz *f)
{
    int32_t which = 1 + fuzz_byte(f) % 8;
    if (!f->failures) f->fail_after = which;
    return FE_OK;
}

// ---- bodies --------------------------------------------------------------------------------------------------------

static void note_body(fuzz *f, fe_body body)
{
    f->bodies[f->body_count++ % FUZZ_HANDLES] = body;
    fe__hash_u64(&f->told, body);
}

// the ring's next place may hold a living body: it goes, so that a stream cannot fill the world
static int32_t create_body(fuzz *f)
{
    long_body_def d;
    fe_body body = 0;
    memset(&d, 0, sizeof d);
    d.def = some_body(f);
    d.def.struct_size = fuzz_struct_size(f, sizeof d.def);
    if (fuzz_byte(f) == 9) d.tail[0] = 1;
    fe_body oldest = f->bodies[f->body_count % FUZZ_HANDLES];
    if (fe_body_is_valid(f->world, oldest)) return fe_body_destroy(f->world, oldest);
    fe_result result = fe_body_create(f->world, or_null(f, &d), or_null(f, &body) ? &body : NULL);
    if (result == FE_OK) note_body(f, body);
    return result;
}

static void note_shape(fuzz *f, fe_shape shape)
{
    f->shapes[f->shape_count++ % FUZZ_HANDLES] = shape;
    fe__hash_u64(&f->told, shape);
}

static int32_t create_shape(fuzz *f)
{
    long_shape_def d;
    long_geometry g;
    fe_shape shape = 0;
    memset(&d, 0, sizeof d);
    memset(&g, 0, sizeof g);
    fe_body body = fuzz_body(f);
    d.def = some_shape(f);
    g.geometry = fuzz_geometry(f);
    d.def.struct_size = fuzz_struct_size(f, sizeof d.def);
    g.geometry.struct_size = fuzz_struct_size(f, sizeof g.geometry);
    fe_shape oldest = f->shapes[f->shape_count % FUZZ_HANDLES];
    if (fe_shape_is_valid(f->world, oldest)) return fe_shape_destroy(f->world, oldest);
    fe_result result = fe_shape_create(f->world, body, or_null(f, &d), or_null(f, &g), &shape);
    if (result == FE_OK) note_shape(f, shape);
    return result;
}

// a body that a game could have, on or above the ground: so that much happens
static int32_t create_whole(fuzz *f)
{
    fe_body_def d;
    fe_geometry g;
    fe_body body;
    fe_shape shape;
    fe_body_def_init(&d, sizeof d);
    uint8_t kind = fuzz_byte(f), x = fuzz_byte(f), y = fuzz_byte(f);
    float size = 0.1f + (float)(kind % 16) * 0.05f;
    d.transform = fe_make_transform((double)(x % 16) * 0.25 - 2.0, (double)y / 64.0, (double)(x / 16) * 0.25 - 2.0);
    d.type = kind > 250 ? FE_BODY_STATIC : FE_BODY_DYNAMIC;
    d.sleep_allowed = y % 8 != 0;
    fe_geometry_box(&g, size, 0.5f * size, 0.7f * size);
    if (kind & 16) fe_geometry_sphere(&g, size);
    if (kind & 32) fe_geometry_capsule(&g, size, 0.5f * size);
    if (kind > 253) fe_geometry_plane(&g, 0.0f, 1.0f, 0.0f, 0.0f);
    fe_body oldest = f->bodies[f->body_count % FUZZ_HANDLES];
    if (fe_body_is_valid(f->world, oldest)) return fe_body_destroy(f->world, oldest);
    fe_result result = fe_body_create(f->world, &d, &body);
    if (result != FE_OK) return result;
    note_body(f, body);
    do result = fe_shape_create(f->world, body, NULL, &g, &shape);
    while (result == FE_ERROR_MEMORY);
    if (result == FE_OK) note_shape(f, shape);
    return FE_OK;
}

static int32_t create_bodies(fuzz *f)
{
    enum { MOST = 6 };
    fe_body_def d[MOST];
    fe_body bodies[MOST] = {0};
    int32_t count = fuzz_byte(f) % 8 - 1;
    if (count > MOST) count = MOST;
    for (int32_t i = 0; i < MOST; ++i) d[i] = some_body(f);
    for (int32_t i = 0; i < count; ++i)
        if (fe_body_is_valid(f->world, f->bodies[(f->body_count + i) % FUZZ_HANDLES])) return FE_OK;
    fe_result result = fe_body_create_many(f->world, d, fuzz_byte(f) == 3 ? fuzz_byte(f) : 0, count, bodies);
    for (int32_t i = 0; i < count && result == FE_OK; ++i) note_body(f, bodies[i]);
    return result;
}

static int32_t destroy_body(fuzz *f) { return fe_body_destroy(f->world, fuzz_body(f)); }

static int32_t destroy_bodies(fuzz *f)
{
    fe_body bodies[4];
    for (int32_t i = 0; i < 4; ++i) bodies[i] = fuzz_body(f);
    return fe_body_destroy_many(f->world, or_null(f, bodies), fuzz_byte(f) % 6 - 1);
}

static int32_t set_type(fuzz *f)
{
    fe_body body = fuzz_body(f);
    return fe_body_set_type(f->world, body, fuzz_byte(f) % 5 - 1);
}

static int32_t set_transform(fuzz *f)
{
    fe_body body = fuzz_body(f);
    fe_transform t = fuzz_transform(f);
    return fe_body_set_transform(f->world, body, or_null(f, &t));
}

static int32_t set_target(fuzz *f)
{
    fe_body body = fuzz_body(f);
    fe_transform t = fuzz_transform(f);
    return fe_body_set_target(f->world, body, &t, fuzz_size(f));
}

static int32_t set_mass_data(fuzz *f)
{
    struct {
        fe_mass_data data;
        unsigned char tail[FUZZ_TAIL];
    } m;
    memset(&m, 0, sizeof m);
    fe_body body = fuzz_body(f);
    m.data.mass = fuzz_size(f);
    if (fuzz_byte(f) % 4 == 0) m.data.centre = fuzz_vec3(f);
    m.data.inertia.x = fuzz_size(f);
    m.data.inertia.y = fuzz_size(f);
    m.data.inertia.z = fuzz_size(f);
    m.data.inertia_rotation = fuzz_quat(f);
    m.data.struct_size = fuzz_struct_size(f, sizeof m.data);
    return fe_body_set_mass_data(f->world, body, or_null(f, &m));
}

static int32_t set_mass(fuzz *f)
{
    fe_body body = fuzz_body(f);
    return fe_body_set_mass(f->world, body, fuzz_size(f));
}

static int32_t reset_mass(fuzz *f) { return fe_body_reset_mass(f->world, fuzz_body(f)); }

static int32_t set_locks(fuzz *f)
{
    fe_body body = fuzz_body(f);
    uint32_t linear = fuzz_byte(f) % 9u;
    return fe_body_set_locks(f->world, body, linear, fuzz_byte(f) % 9u);
}

static int32_t set_damping(fuzz *f)
{
    fe_body body = fuzz_body(f);
    float linear = fuzz_size(f);
    return fe_body_set_damping(f->world, body, linear, fuzz_size(f));
}

static int32_t set_gravity_scale(fuzz *f)
{
    fe_body body = fuzz_body(f);
    return fe_body_set_gravity_scale(f->world, body, fuzz_float(f));
}

static int32_t set_switch(fuzz *f)
{
    static fe_result (*const switches[])(fe_world *, fe_body, int32_t) = {fe_body_set_awake, fe_body_set_sleep_allowed,
                                                                          fe_body_set_enabled, fe_body_set_bullet};
    fe_body body = fuzz_body(f);
    int32_t which = fuzz_byte(f) % COUNT(switches);
    return switches[which](f->world, body, fuzz_byte(f) % 3);
}

// Most are awake, and some touch one that may not sleep
static int32_t put_to_sleep(fuzz *f) { return fe_body_set_awake(f->world, f->bodies[fuzz_byte(f) % FUZZ_HANDLES], 0); }

static int32_t push(fuzz *f)
{
    static fe_result (*const pushes[])(fe_world *, fe_body,
                                       const fe_vec3 *) = {fe_body_set_linear_velocity, fe_body_set_angular_velocity,
                                                           fe_body_add_force,           fe_body_add_torque,
                                                           fe_body_add_impulse,         fe_body_add_angular_impulse};
    fe_body body = fuzz_body(f);
    fe_vec3 v = fuzz_vec3(f);
    int32_t which = fuzz_byte(f) % COUNT(pushes);
    return pushes[which](f->world, body, or_null(f, &v));
}

static int32_t push_at(fuzz *f)
{
    fe_body body = fuzz_body(f);
    fe_vec3 v = fuzz_vec3(f);
    fe_dvec3 point = fuzz_dvec3(f);
    if (fuzz_byte(f) % 2) return fe_body_add_force_at(f->world, body, &v, or_null(f, &point));
    return fe_body_add_impulse_at(f->world, body, &v, &point);
}

static int32_t set_body_filter(fuzz *f)
{
    fe_body body = fuzz_body(f);
    uint32_t layer = fuzz_byte(f) % 5u;
    const uint32_t mask = fuzz_byte(f);
    return fe_body_set_filter(f->world, body, layer, mask, fuzz_byte(f) % 5 - 2);
}

static int32_t set_sleep_threshold(fuzz *f)
{
    fe_body body = fuzz_body(f);
    return fe_body_set_sleep_threshold(f->world, body, fuzz_float(f));
}

static int32_t read_body(fuzz *f)
{
    fe_body body = fuzz_body(f);
    fe_dvec3 point = fuzz_dvec3(f);
    fe_vec3 velocity;
    float a, b;
    fe_result result = fe_body_get_point_velocity(f->world, body, &point, &velocity);
    if (result != FE_OK) return result;
    if (fe_body_get_damping(f->world, body, &a, &b) != FE_OK || fe_body_get_mass(f->world, body, &a) != FE_OK)
        fuzz_fail(f, "a living body cannot be read");
    return FE_OK;
}

// ---- shapes --------------------------------------------------------------------------------------------------------

static int32_t destroy_shape(fuzz *f) { return fe_shape_destroy(f->world, fuzz_shape(f)); }

static int32_t set_geometry(fuzz *f)
{
    long_geometry g;
    memset(&g, 0, sizeof g);
    fe_shape shape = fuzz_shape(f);
    g.geometry = fuzz_geometry(f);
    g.geometry.struct_size = fuzz_struct_size(f, sizeof g.geometry);
    return fe_shape_set_geometry(f->world, shape, or_null(f, &g));
}

static int32_t set_frame(fuzz *f)
{
    fe_shape shape = fuzz_shape(f);
    fe_frame frame;
    frame.position = fuzz_vec3(f), frame.rotation = fuzz_quat(f);
    return fe_shape_set_frame(f->world, shape, or_null(f, &frame));
}

static int32_t set_density(fuzz *f)
{
    fe_shape shape = fuzz_shape(f);
    return fe_shape_set_density(f->world, shape, fuzz_float(f));
}

static int32_t set_material(fuzz *f)
{
    fe_shape shape = fuzz_shape(f);
    fe_material m = some_material(f);
    return fe_shape_set_material(f->world, shape, or_null(f, &m));
}

static int32_t set_shape_filter(fuzz *f)
{
    fe_shape shape = fuzz_shape(f);
    uint32_t layer = fuzz_byte(f) % 5u;
    const uint32_t mask = fuzz_byte(f);
    return fe_shape_set_filter(f->world, shape, layer, mask, fuzz_byte(f) % 5 - 2);
}

static int32_t set_trigger(fuzz *f)
{
    fe_shape shape = fuzz_shape(f);
    return fe_shape_set_trigger(f->world, shape, fuzz_byte(f) % 3);
}

static int32_t set_events(fuzz *f)
{
    fe_shape shape = fuzz_shape(f);
    return fe_shape_set_events(f->world, shape, fuzz_byte(f) % 9u);
}

static int32_t set_surface_velocity(fuzz *f)
{
    fe_shape shape = fuzz_shape(f);
    fe_vec3 v = fuzz_vec3(f);
    return fe_shape_set_surface_velocity(f->world, shape, or_null(f, &v));
}

static int32_t read_shape(fuzz *f)
{
    fe_shape shape = fuzz_shape(f);
    long_geometry g;
    memset(&g, 0, sizeof g);
    g.geometry.struct_size = fuzz_struct_size(f, sizeof g.geometry);
    if (g.geometry.struct_size > sizeof g) g.geometry.struct_size = sizeof g;
    fe_body body;
    fe_material m;
    fe_result result = fe_shape_get_geometry(f->world, shape, &g.geometry);
    if (result != FE_OK) return result;
    if (fe_shape_get_body(f->world, shape, &body) != FE_OK || fe_shape_get_material(f->world, shape, &m) != FE_OK)
        fuzz_fail(f, "a living shape cannot be read");
    return FE_OK;
}

// ---- arrays --------------------------------------------------------------------------------------------------------

static int32_t read_events(fuzz *f)
{
    fuzz_span a;
    switch (fuzz_byte(f) % 6) {
    case 0:
        fuzz_array(f, sizeof(fe_pair_event), &a);
        return fe_world_get_pair_events(f->world, a.data, a.stride, a.count);
    case 1:
        fuzz_array(f, sizeof(fe_body_event), &a);
        return fe_world_get_body_events(f->world, a.data, a.stride, a.count);
    case 2:
        fuzz_array(f, sizeof(fe_hit_event), &a);
        return fe_world_get_hit_events(f->world, a.data, a.stride, a.count);
    case 3:
        fuzz_array(f, sizeof(fe_contact), &a);
        return fe_body_get_contacts(f->world, fuzz_body(f), a.data, a.stride, a.count);
    case 4:
        fuzz_array(f, sizeof(fe_contact), &a);
        return fe_shape_get_contacts(f->world, fuzz_shape(f), a.data, a.stride, a.count);
    default:
        break;
    }
    fe_body bodies[64];
    fuzz_array(f, sizeof(fe_transform), &a);
    return fe_world_get_moved(f->world, bodies, a.data, a.stride, a.count);
}

static int32_t read_lists(fuzz *f)
{
    fe_handle handles[64];
    int32_t capacity = fuzz_byte(f) % 66 - 1;
    if (capacity > 64) capacity = 64;
    if (fuzz_byte(f) % 2) return fe_world_get_bodies(f->world, or_null(f, handles) ? handles : NULL, capacity);
    return fe_body_get_shapes(f->world, fuzz_body(f), handles, capacity);
}

static int32_t read_bulk(fuzz *f)
{
    fuzz_span a;
    uint8_t which = fuzz_byte(f) % 3;
    fe_dvec3 origin = fuzz_dvec3(f);
    fuzz_array(f, which == 0 ? sizeof(fe_transform) : which == 1 ? 28 : 24, &a);
    if (which == 0) return fe_world_get_transforms(f->world, f->bodies, a.data, a.stride, a.count);
    if (which == 1)
        return fe_world_get_transforms_f32(f->world, f->bodies, or_null(f, &origin), a.data, a.stride, a.count);
    return fe_world_get_velocities(f->world, f->bodies, a.data, a.stride, a.count);
}

// good floats first, so that some are accepted
void fuzz_fill_room(fuzz *f)
{
    float numbers[64];
    for (int32_t i = 0; i < COUNT(numbers); ++i) numbers[i] = (float)(i % 7) * 0.25f;
    numbers[fuzz_byte(f) % COUNT(numbers)] = fuzz_float(f);
    for (size_t at = 0; at + sizeof numbers <= sizeof f->room; at += sizeof numbers)
        memcpy(f->room + at, numbers, sizeof numbers);
}

static int32_t write_bulk(fuzz *f)
{
    fuzz_span a;
    fe_body bodies[40];
    uint8_t which = fuzz_byte(f) % 3;
    fuzz_fill_room(f);
    fuzz_array(f, which == 0 ? sizeof(fe_transform) : 24, &a);
    for (int32_t i = 0; i < COUNT(bodies); ++i) bodies[i] = i < 3 ? fuzz_body(f) : f->bodies[i % FUZZ_HANDLES];
    if (which == 0) {
        const fe_transform good[2] = {fe_make_transform(1.0, 2.0, 0.5), fe_make_transform(-1.0, 1.0, 0.0)};
        if (fuzz_byte(f) % 2) memcpy(f->room, good, sizeof good);
        return fe_world_set_transforms(f->world, bodies, a.data, a.stride, a.count);
    }
    if (which == 1) return fe_world_set_velocities(f->world, bodies, a.data, a.stride, a.count);
    return fe_world_add_forces(f->world, bodies, a.data, a.stride, a.count);
}

static int32_t read_measures(fuzz *f)
{
    struct {
        fe_counters counters;
        unsigned char tail[FUZZ_TAIL];
    } c;
    memset(&c, 0, sizeof c);
    c.counters.struct_size = fuzz_struct_size(f, sizeof c.counters);
    if (c.counters.struct_size > sizeof c) c.counters.struct_size = sizeof c;
    return fe_world_get_counters(f->world, &c.counters) < 0 ? FE_ERROR_ARGUMENT : FE_OK;
}

// what makes a scene comes more than once
const fuzz_call fuzz_calls[] = {
    {"fe_world_step", step, FUZZ_MOVES},
    {"fe_world_step", step, FUZZ_MOVES},
    {"ten steps", step_some, FUZZ_MOVES},
    {"ten steps", step_some, FUZZ_MOVES},
    {"a whole body", create_whole, FUZZ_WRITES},
    {"a whole body", create_whole, FUZZ_WRITES},
    {"a whole body", create_whole, FUZZ_WRITES},
    {"a whole body", create_whole, FUZZ_WRITES},
    {"fe_body_create", create_body, FUZZ_MOVES},
    {"fe_shape_create", create_shape, FUZZ_MOVES},
    {"fe_shape_create", create_shape, FUZZ_MOVES},
    {"fe_body_create_many", create_bodies, FUZZ_MOVES},
    {"fe_body_destroy", destroy_body, FUZZ_WRITES},
    {"fe_body_destroy_many", destroy_bodies, FUZZ_WRITES},
    {"fe_shape_destroy", destroy_shape, FUZZ_MOVES},
    {"fe_heightfield_create", fuzz_create_field, FUZZ_READS},
    {"fe_geometry_heightfield", fuzz_place_field, FUZZ_SEVERAL},
    {"fe_geometry_heightfield", fuzz_place_field, FUZZ_SEVERAL},
    {"fe_heightfield_set_heights", fuzz_edit_field, FUZZ_MOVES},
    {"fe_asset_destroy", fuzz_destroy_asset, FUZZ_WRITES},
    {"fe_world_set_gravity", set_gravity, FUZZ_WRITES},
    {"fe_world_set_substeps", set_substeps, FUZZ_WRITES},
    {"fe_world_set_tuning", set_tuning, FUZZ_WRITES},
    {"fe_world_ignore_collision", ignore, FUZZ_WRITES},
    {"fe_world_optimize", optimize, FUZZ_WRITES},
    {"fe_world_raycast", raycast, FUZZ_READS},
    {"fe_world_raycast_all, _any, fe_body_raycast, fe_shape_raycast", query_rays, FUZZ_READS},
    {"fe_world_sweep, _all, _any, fe_world_overlap", query_forms, FUZZ_READS},
    {"fe_world_raycast_many, fe_world_sweep_many", query_many, FUZZ_READS},
    {"fe_world_closest_point, fe_body_closest_point, fe_shape_closest_point", query_points, FUZZ_READS},
    {"no memory", fail_memory, FUZZ_READS},
    {"fe_body_set_type", set_type, FUZZ_MOVES},
    {"fe_body_set_transform", set_transform, FUZZ_MOVES},
    {"fe_body_set_target", set_target, FUZZ_MOVES},
    {"fe_body_set_mass_data", set_mass_data, FUZZ_MOVES},
    {"fe_body_set_mass", set_mass, FUZZ_MOVES},
    {"fe_body_reset_mass", reset_mass, FUZZ_MOVES},
    {"fe_body_set_locks", set_locks, FUZZ_MOVES},
    {"fe_body_set_damping", set_damping, FUZZ_WRITES},
    {"fe_body_set_gravity_scale", set_gravity_scale, FUZZ_WRITES},
    {"fe_body_set_awake and such", set_switch, FUZZ_MOVES},
    {"fe_body_set_awake", put_to_sleep, FUZZ_WRITES},
    {"fe_body_set_awake", put_to_sleep, FUZZ_WRITES},
    {"fe_body_add_impulse and such", push, FUZZ_MOVES},
    {"fe_body_add_force_at, impulse_at", push_at, FUZZ_MOVES},
    {"fe_body_set_filter", set_body_filter, FUZZ_WRITES},
    {"fe_body_set_sleep_threshold", set_sleep_threshold, FUZZ_WRITES},
    {"fe_body_get_point_velocity", read_body, FUZZ_READS},
    {"fe_shape_set_geometry", set_geometry, FUZZ_MOVES},
    {"fe_shape_set_frame", set_frame, FUZZ_MOVES},
    {"fe_shape_set_density", set_density, FUZZ_MOVES},
    {"fe_shape_set_material", set_material, FUZZ_WRITES},
    {"fe_shape_set_filter", set_shape_filter, FUZZ_WRITES},
    {"fe_shape_set_trigger", set_trigger, FUZZ_WRITES},
    {"fe_shape_set_events", set_events, FUZZ_WRITES},
    {"fe_shape_set_surface_velocity", set_surface_velocity, FUZZ_WRITES},
    {"fe_shape_get_geometry", read_shape, FUZZ_READS},
    {"events and contacts", read_events, FUZZ_READS},
    {"lists", read_lists, FUZZ_READS},
    {"bulk reads", read_bulk, FUZZ_READS},
    {"bulk writes", write_bulk, FUZZ_MOVES},
    {"fe_world_get_counters", read_measures, FUZZ_READS},
    {"drawings", fuzz_draw, FUZZ_READS},
    {"fe_world_clone", fuzz_clone, FUZZ_READS},
    {"fe_world_save, fe_world_load", fuzz_load, FUZZ_READS},
    {"fe_state_create", fuzz_hold, FUZZ_READS},
    {"fe_history_keep", fuzz_keep, FUZZ_READS},
    {"fe_world_set_pair_filter", fuzz_set_filter, FUZZ_WRITES},
    {"fe_shape_set_pair_filter", fuzz_judge_shape, FUZZ_WRITES},
    {"fe_shape_set_one_way", fuzz_set_one_way, FUZZ_MOVES},
    {"fe_world_get_bounds, fe_body_get_bounds, fe_shape_get_bounds", fuzz_read_bounds, FUZZ_READS},
    {"fe_world_overlap_shapes", fuzz_overlap_shapes, FUZZ_READS},
    {"fe_world_overlap_bounds", fuzz_overlap_bounds, FUZZ_READS},
    {"fe_shape_get_overlaps", fuzz_read_overlaps, FUZZ_READS},
    {"fe_hinge_joint_create and such", fuzz_create_joint, FUZZ_MOVES},
    {"a whole joint", fuzz_join, FUZZ_MOVES},
    {"a whole joint", fuzz_join, FUZZ_MOVES},
    {"fe_hinge_joint_set and such", fuzz_set_joint, FUZZ_MOVES},
    {"fe_joint_set, set_enabled", fuzz_set_joint_front, FUZZ_MOVES},
    {"fe_joint_destroy", fuzz_destroy_joint, FUZZ_WRITES},
    {"sliders, wheels, motors, rods", fuzz_make_joint, FUZZ_MOVES},
    {"fe_joint_set_user_data", fuzz_name_joint, FUZZ_WRITES},
    {"fe_joint_get_state and such", fuzz_read_joint, FUZZ_READS},
    {"lists and events of joints", fuzz_list_joints, FUZZ_READS},
    {"bulk reads of joints", fuzz_read_joints, FUZZ_READS},
    {"bulk writes of joints", fuzz_write_joints, FUZZ_MOVES},
};
const int32_t fuzz_call_count = COUNT(fuzz_calls);
