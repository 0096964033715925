// Scaled hulls and meshes are what they would be if they had been built so: they touch, stand, carry and answer queries
// alike, in mirrors too.
#include "scene.h"

#include "meshes.h"
#include "support/hull_clouds.h"

#include <stdlib.h>

typedef struct triple {
    double x, y, z;
} triple;

static const triple scales[] = {{-1, 1, 1}, {1.5, 0.5, 2}, {-1.5, 0.5, 2}, {0.75, -1.25, -1}, {-0.6, -1.1, -0.9}};
enum { SCALES = sizeof scales / sizeof *scales };

static fe_geometry under(fe_geometry form, triple s)
{
    fe_geometry_set_scale(&form, (float)s.x, (float)s.y, (float)s.z);
    return form;
}

static float scaled(double scale, float x) { return (float)((double)(float)scale * (double)x); }
static int is_mirror(triple s) { return s.x * s.y * s.z < 0; }

// ---- meshes and hulls, as they are and as built under a scale ------------------------------------------------------
static soup scaled_soup(const soup *m, triple s)
{
    soup out = {malloc(sizeof(float) * 3 * (size_t)m->vertex_count),
                malloc(sizeof(uint32_t) * 3 * (size_t)m->triangle_count), m->vertex_count, m->triangle_count};
    for (int i = 0; i < m->vertex_count; ++i) {
        const float *from = m->vertices + 3 * i;
        float *to = out.vertices + 3 * i;
        to[0] = scaled(s.x, from[0]), to[1] = scaled(s.y, from[1]), to[2] = scaled(s.z, from[2]);
    }
    for (int i = 0; i < m->triangle_count; ++i)
        for (int k = 0; k < 3; ++k) out.indices[3 * i + k] = m->indices[3 * i + (is_mirror(s) && k ? 3 - k : k)];
    return out;
}

static soup box_soup(void)
{
    static const uint32_t sides[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                          {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    soup m = {malloc(sizeof(float) * 24), malloc(sizeof sides), 8, 12};
    for (int i = 0; i < 24; ++i) m.vertices[i] = i / 3 >> i % 3 & 1 ? 1.0f : -1.0f;
    memcpy(m.indices, sides, sizeof sides);
    return m;
}

enum { ROCK_POINTS = 24 };
static void rock_points(uint64_t seed, float (*points)[3])
{
    for (int i = 0; i < ROCK_POINTS; ++i) {
        vec d = cloud_direction(&seed);
        points[i][0] = (float)(0.6 * d.x), points[i][1] = (float)(0.5 * d.y), points[i][2] = (float)(0.4 * d.z);
    }
}

static fe_geometry hull(const scene *s, const float (*points)[3], int count)
{
    fe_hull_def def;
    fe_asset asset = 0;
    fe_hull_def_init(&def, sizeof def);
    def.points = points[0], def.point_count = count;
    MUST(fe_hull_create(world_store(s->world), &def, &asset));
    fe_geometry form;
    fe_geometry_hull(&form, asset);
    return form;
}

// is_built: the hull of the scaled points, else the hull under the scale
static fe_geometry hull_under(const scene *s, const float (*points)[3], int count, triple by, int is_built)
{
    float at[64][3];
    for (int i = 0; i < count; ++i) {
        at[i][0] = scaled(by.x, points[i][0]), at[i][1] = scaled(by.y, points[i][1]);
        at[i][2] = scaled(by.z, points[i][2]);
    }
    return is_built ? hull(s, (const float(*)[3])at, count) : under(hull(s, points, count), by);
}

static fe_geometry mesh_under(scene *s, const soup *m, triple by, int is_built, uint32_t flags)
{
    fe_geometry form;
    if (!is_built) {
        fe_geometry_mesh(&form, make_mesh(s, m, flags));
        return under(form, by);
    }
    soup own = scaled_soup(m, by);
    fe_geometry_mesh(&form, make_mesh(s, &own, flags));
    soup_free(&own);
    return form;
}

static fe_geometry any_form(const scene *s, int kind)
{
    fe_geometry form;
    float points[ROCK_POINTS][3];
    switch (kind % 6) {
    case 0:
        return sphere(0.5);
    case 1:
        return capsule(0.4, 0.3);
    case 2:
        return box(0.5, 0.3, 0.4);
    case 3:
        fe_geometry_cylinder(&form, 0.3f, 0.4f);
        return form;
    case 4:
        fe_geometry_cone(&form, 0.4f, 0.4f);
        return form;
    default:
        rock_points(99, points);
        return hull(s, (const float(*)[3])points, ROCK_POINTS);
    }
}

// ---- contacts ------------------------------------------------------------------------------------------------------
enum { MOST_TOUCHES = 16 };
typedef struct touch {
    int count;
    fe_contact contacts[MOST_TOUCHES];
} touch;

static touch touch_of(const scene *s, fe_body body)
{
    touch t = {0};
    t.count = fe_body_get_contacts(s->world, body, t.contacts, sizeof *t.contacts, MOST_TOUCHES);
    FE_WITHIN(t.count, 0, MOST_TOUCHES);
    return t;
}

static int has_point(const fe_contact *c, const fe_contact_point *p, double near)
{
    for (int i = 0; i < c->point_count; ++i)
        if (length(minus(c->points[i].point, p->point)) < near &&
            fabs((double)c->points[i].separation - (double)p->separation) < near)
            return 1;
    return 0;
}

// Each contact of one is found in the other: normal, points, depths
static int is_within(const touch *a, const touch *b, double near)
{
    for (int i = 0; i < a->count; ++i) {
        int found = 0;
        for (int k = 0; k < b->count; ++k) {
            const fe_contact *c = a->contacts + i, *d = b->contacts + k;
            int same = length(minus(widen(c->normal), widen(d->normal))) < near && c->point_count == d->point_count;
            for (int p = 0; same && p < c->point_count; ++p) same = has_point(d, c->points + p, near);
            found |= same;
        }
        if (!found) return 0;
    }
    return 1;
}

typedef fe_geometry ground_form(scene *s, triple by, int is_built);
static fe_geometry box_mesh(scene *s, triple by, int is_built)
{
    soup m = box_soup();
    fe_geometry form = mesh_under(s, &m, by, is_built, 0);
    soup_free(&m);
    return form;
}
static double hills(double x, double z) { return 0.6 * sin(1.3 * x + 0.2) * cos(1.7 * z); }
static fe_geometry hill_mesh(scene *s, triple by, int is_built)
{
    soup m = make_soup(8, 0.5, -2, -2, 0.4, hills);
    fe_geometry form = mesh_under(s, &m, by, is_built, by.y < 0 ? FE_MESH_TWO_SIDED : 0);
    soup_free(&m);
    return form;
}
static fe_geometry rock_hull(scene *s, triple by, int is_built)
{
    float points[ROCK_POINTS][3];
    rock_points(7, points);
    return hull_under(s, (const float(*)[3])points, ROCK_POINTS, by, is_built);
}

static double noise_of(uint32_t i, uint32_t k) { return noise(17 * i + k); }

// One step of no time of bodies of every form at the surface, here and there: the share of contacts that differ. Few
// may: of two ways to choose four points, or of two directions, that are as good, each takes what comes first.
static void touches_alike(ground_form *ground, int tries, vec size)
{
    int touched = 0, differ = 0;
    for (int by = 0; by < SCALES; ++by) {
        for (int i = 0; i < tries; ++i) {
            touch t[2];
            for (int is_built = 0; is_built < 2; ++is_built) {
                scene s = scene_begin(NULL);
                uint32_t n = (uint32_t)(by * tries + i);
                fe_quat turn = turned(v3(noise_of(n, 0), noise_of(n, 1), noise_of(n, 2)), 3 * noise_of(n, 3)),
                        own = turned(v3(noise_of(n, 4), noise_of(n, 5), noise_of(n, 6)), 3 * noise_of(n, 7));
                add_static(&s, ground(&s, scales[by], is_built), v3(3, 1, 2), turn, friction(0.5));
                vec at = v3(fabs(scales[by].x) * size.x * noise_of(n, 8), fabs(scales[by].y) * size.y * noise_of(n, 9),
                            fabs(scales[by].z) * size.z * noise_of(n, 10));
                fe_body body =
                    add_dynamic(&s, any_form(&s, i), plus(v3(3, 1, 2), rotate(turn, at)), own, friction(0.5), WATER);
                MUST(fe_world_step(s.world, 0));
                t[is_built] = touch_of(&s, body);
                scene_end(&s);
            }
            touched += t[1].count > 0;
            differ += t[0].count != t[1].count || !is_within(&t[0], &t[1], 1e-5) || !is_within(&t[1], &t[0], 1e-5);
        }
    }
    FE_WITHIN(touched, 0.2 * SCALES * tries, SCALES * tries);
    FE_WITHIN(differ, 0, 0.04 * touched);
}

static void a_scaled_box_mesh_is_touched_as_built(void **state)
{
    (void)state;
    touches_alike(box_mesh, 150, v3(1.4, 1.4, 1.4));
}
static void scaled_hills_are_touched_as_built(void **state)
{
    (void)state;
    touches_alike(hill_mesh, 150, v3(1.8, 0.8, 1.8));
}
static void a_scaled_hull_is_touched_as_built(void **state)
{
    (void)state;
    touches_alike(rock_hull, 150, v3(0.9, 0.9, 0.9));
}

// ---- standing ------------------------------------------------------------------------------------------------------
// Ten prisms of 15 sides, radius 0.5, height 1, one above the other with a tenth between them
static void stacks_of_scaled_prisms_stand(void **state)
{
    enum { SIDES = 15, HIGH = 10 };
    static const triple by[] = {{-0.75, 1, 1}, {1.2, 1, -0.9}, {0.9, 0.9, 0.9}, {1, -1, 1}};
    float points[2 * SIDES][3];
    for (int i = 0; i < 2 * SIDES; ++i) {
        double angle = 2 * PI * (i / 2) / SIDES;
        points[i][0] = (float)(0.5 * cos(angle)), points[i][1] = i % 2 ? 0.5f : -0.5f;
        points[i][2] = (float)(0.5 * sin(angle));
    }
    for (int k = 0; k < 4; ++k) {
        scene s = scene_begin(state);
        add_ground(&s, friction(0.6));
        fe_geometry form = under(hull(&s, (const float(*)[3])points, 2 * SIDES), by[k]);
        fe_body body[HIGH];
        double half = 0.5 * fabs(by[k].y);
        for (int i = 0; i < HIGH; ++i)
            body[i] = add_dynamic(&s, form, v3(0, half + 2.2 * half * i, 0), UNTURNED, friction(0.6), WATER);
        run(&s, 20 * 60);
        for (int i = 0; i < HIGH; ++i) {
            vec off = minus(position(&s, body[i]), v3(0, half + 2 * half * i, 0));
            FE_WITHIN(off.y, -LINEAR_SLOP * (i + 1), 1e-3); // each gives a little
            off.y = 0;
            FE_WITHIN(length(off), 0, 0.1); // the upper ones fall up to a metre
            FE_WITHIN(tilt(&s, body[i]), 0, 1 * DEGREES);
        }
        scene_end(&s);
    }
}

// One tile of a jittered floor, and its three mirror images around the corner: what slides over it knows no seam
static void mirrored_tiles_are_one_floor(void **state)
{
    static const triple around[4] = {{1, 1, 1}, {-1, 1, 1}, {1, 1, -1}, {-1, 1, -1}};
    for (int heading = 0; heading < 6; ++heading) {
        scene s = scene_begin(state);
        soup m = make_soup(12, 1, 0, 0, 0.3, level);
        fe_geometry tile;
        fe_geometry_mesh(&tile, make_mesh(&s, &m, 0));
        soup_free(&m);
        for (int i = 0; i < 4; ++i) add_static(&s, under(tile, around[i]), v3(0, 0, 0), UNTURNED, friction(0));
        double angle = 0.3 + PI / 3 * heading;
        vec way = v3(cos(angle), 0, sin(angle)), start = plus(times(-5, way), v3(0.1, 0.25, -0.15));
        fe_geometry form = heading % 2 ? box(0.4, 0.25, 0.3) : sphere(0.25);
        fe_body body = add_dynamic(&s, form, start, turned(v3(0, 1, 0), -angle), friction(0), WATER);
        set_velocity(&s, body, times(5, way), v3(0, 0, 0));
        double fastest = 0;
        for (int i = 0; i < 120; ++i) {
            run(&s, 1);
            fastest = fmax(fastest, fabs(velocity(&s, body).y));
        }
        FE_NEAR(length(minus(position(&s, body), plus(start, times(10, way)))), 0, 0.01);
        FE_WITHIN(fastest, 0, 0.005);
        scene_end(&s);
    }
}

// Kinematic bodies carry scaled meshes; the mirrored outside holds, the inside lets out
static void a_mirrored_mesh_carries(void **state)
{
    scene s = scene_begin(state);
    soup m = box_soup();
    fe_geometry slab;
    fe_geometry_mesh(&slab, make_mesh(&s, &m, 0));
    soup_free(&m);
    fe_body lift =
        add_body(&s, FE_BODY_KINEMATIC, under(slab, (triple){-5, 0.5, 5}), v3(0, 0, 0), UNTURNED, friction(0.6), WATER);
    fe_body rider = add_dynamic(&s, box(0.5, 0.5, 0.5), v3(1, 1, 1), UNTURNED, friction(0.6), WATER);
    set_velocity(&s, lift, v3(0.5, 0.25, 0), v3(0, 0, 0));
    run(&s, 240);
    FE_NEAR(length(minus(position(&s, rider), v3(3, 2, 1))), 0, 0.05); // half a metre per second is soon its own
    scene_end(&s);
}

// ---- queries -------------------------------------------------------------------------------------------------------
static void same_hit(int32_t found, const fe_hit *a, int32_t other, const fe_hit *b)
{
    assert_int_equal(found, other);
    if (!found) return;
    FE_NEAR(a->fraction, b->fraction, 1e-6);
    FE_NEAR(length(minus(a->point, b->point)), 0, 2e-5);
    if (length(minus(widen(a->normal), widen(b->normal))) > 1e-3) FE_NEAR(a->fraction, b->fraction, 1e-9); // an edge
}

static void queries_see_what_was_built(void **state)
{
    enum { TRIES = 300 };
    ground_form *forms[3] = {hill_mesh, box_mesh, rock_hull};
    int hits = 0;
    for (int round = 0; round < 3 * SCALES; ++round) {
        scene s[2] = {scene_begin(state), scene_begin(state)};
        fe_quat turn = turned(v3(1, 2, 3), 0.4);
        triple by = scales[round / 3];
        for (int k = 0; k < 2; ++k) {
            add_static(&s[k], forms[round % 3](&s[k], by, k), v3(0.5, 0, 0), turn, friction(0.5));
            run(&s[k], 1);
        }
        for (uint32_t i = 0; i < TRIES; ++i) {
            uint32_t n = 1000 * (uint32_t)round + i;
            vec from = v3(3 * noise_of(n, 0), 2.5 * noise_of(n, 1), 3 * noise_of(n, 2)),
                way = minus(v3(2 * noise_of(n, 3), noise_of(n, 4), 2 * noise_of(n, 5)), from);
            fe_transform pose = {from, turned(v3(1, noise_of(n, 6), 0), 2 * noise_of(n, 7))};
            fe_hit hit[2];
            fe_closest closest[2];
            int32_t found[2];
            for (int k = 0; k < 2; ++k) found[k] = fe_world_raycast(s[k].world, &from, &way, NULL, &hit[k]);
            same_hit(found[0], &hit[0], found[1], &hit[1]);
            if (found[0] && round % 3 != 2) assert_int_equal(hit[0].triangle, hit[1].triangle);
            hits += found[0];
            for (int k = 0; k < 2; ++k) found[k] = fe_world_closest_point(s[k].world, &from, 10, NULL, &closest[k]);
            assert_int_equal(found[0], found[1]);
            if (found[0]) FE_NEAR(closest[0].distance, closest[1].distance, 1e-6);
            for (int k = 0; k < 2; ++k) {
                fe_geometry form = any_form(&s[k], (int)i);
                found[k] = fe_world_overlap_any(s[k].world, &form, &pose, NULL);
            }
            assert_int_equal(found[0], found[1]);
            if (found[0]) continue;
            for (int k = 0; k < 2; ++k) {
                fe_geometry form = any_form(&s[k], (int)i);
                found[k] = fe_world_sweep(s[k].world, &form, &pose, &way, NULL, &hit[k]);
            }
            same_hit(found[0], &hit[0], found[1], &hit[1]);
            hits += found[0];
        }
        scene_end(&s[0]), scene_end(&s[1]);
    }
    FE_WITHIN(hits, TRIES, 6 * SCALES * TRIES);
}

// And what is moved may have a scale
static void a_scaled_hull_sweeps_as_built(void **state)
{
    scene s = scene_begin(state);
    add_static(&s, box(1, 1, 1), v3(0, 0, 0), UNTURNED, friction(0.5));
    soup m = make_soup(8, 0.5, -2, -2, 0.4, hills);
    place_mesh(&s, FE_BODY_STATIC, make_mesh(&s, &m, 0), v3(0, -3, 0), UNTURNED, friction(0.5));
    soup_free(&m);
    run(&s, 1);
    for (uint32_t i = 0; i < 200; ++i) {
        triple by = scales[i % SCALES];
        fe_geometry form[2] = {rock_hull(&s, by, 0), rock_hull(&s, by, 1)};
        vec from = v3(4 * noise_of(i, 0), 4, 4 * noise_of(i, 1)),
            way = minus(v3(2 * noise_of(i, 2), -3, 2 * noise_of(i, 3)), from);
        fe_transform pose = {from, turned(v3(1, noise_of(i, 4), 0), 2 * noise_of(i, 5))};
        fe_hit hit[2];
        int32_t found[2];
        for (int k = 0; k < 2; ++k) found[k] = fe_world_sweep(s.world, &form[k], &pose, &way, NULL, &hit[k]);
        same_hit(found[0], &hit[0], found[1], &hit[1]);
        for (int k = 0; k < 2; ++k) MUST(fe_asset_destroy(world_store(s.world), form[k].asset));
    }
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_scaled_box_mesh_is_touched_as_built),
        TEST(scaled_hills_are_touched_as_built),
        TEST(a_scaled_hull_is_touched_as_built),
        TEST(stacks_of_scaled_prisms_stand),
        WITH_4_SUBSTEPS(stacks_of_scaled_prisms_stand),
        TEST(mirrored_tiles_are_one_floor),
        TEST(a_mirrored_mesh_carries),
        TEST(queries_see_what_was_built),
        TEST(a_scaled_hull_sweeps_as_built),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
