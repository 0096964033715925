// play.c - see play.h. Without cmocka, so that a program for another machine can be made of it.
#include "support/play.h"

#include "core/id_pool.h"

#include <inttypes.h>
#include <stdlib.h>

enum { ERRORS_TOLD = 5 }; // of a play

void play_begin(play *p, fe_world *world)
{
    *p = (play){.world = world, .seed = 1, .dt = 1.0f / 60.0f, .told = fe__hash_begin()};
}

void play_before(play *p)
{
    if (p->before) p->before(p);
}

int32_t play_after(play *p, fe_result result, const char *text)
{
    if (p->after) return p->after(p, result);
    if (result >= 0) return 0;
    if (p->errors++ < ERRORS_TOLD) fprintf(stderr, "step %d: %s: %s\n", (int)p->step, text, fe_last_error());
    return 0;
}

uint64_t play_hash(const play *p)
{
    uint32_t words[2] = {0, 0};
    if (fe_world_hash(p->world, words) != FE_OK) fprintf(stderr, "no hash: %s\n", fe_last_error());
    return words[0] | (uint64_t)words[1] << 32;
}

uint64_t play_told(const play *p) { return fe__hash_end(&p->told); }

// A handle without the world's number, kind, generation and slot in 3, 24 and 24 bits: as the hashes of golden.txt hold
// it
static uint64_t told_handle(fe_handle handle)
{
    if (handle == 0) return 0;
    const uint64_t kind = (uint64_t)fe__id_kind_of(handle), generation = (uint64_t)fe__id_generation_of(handle);
    return kind << 48 | generation << 24 | (uint64_t)(fe__id_slot_of(handle) + 1);
}

// ---- what the world tells after each step --------------------------------------------------------------------------

static void hear_pairs(play *p)
{
    int32_t count = fe_world_get_pair_events(p->world, NULL, 0, 0);
    fe_pair_event *events = calloc((size_t)count + 1, sizeof *events);
    fe_world_get_pair_events(p->world, events, sizeof *events, count);
    fe__hash_i32(&p->told, count);
    for (int32_t i = 0; i < count; ++i) {
        const fe_pair_event *e = events + i;
        const uint64_t words[4] = {told_handle(e->body_a), told_handle(e->body_b), told_handle(e->shape_a),
                                   told_handle(e->shape_b)};
        fe__hash_u64_array(&p->told, words, 4);
        fe__hash_i32(&p->told, e->kind * 2 + e->is_trigger);
    }
    free(events);
}

static void hear_bodies(play *p)
{
    int32_t count = fe_world_get_body_events(p->world, NULL, 0, 0);
    fe_body_event *events = calloc((size_t)count + 1, sizeof *events);
    fe_world_get_body_events(p->world, events, sizeof *events, count);
    fe__hash_i32(&p->told, count);
    for (int32_t i = 0; i < count; ++i) {
        fe__hash_u64(&p->told, told_handle(events[i].body));
        fe__hash_i32(&p->told, events[i].kind);
    }
    free(events);
}

static void hear_hits(play *p)
{
    int32_t count = fe_world_get_hit_events(p->world, NULL, 0, 0);
    fe_hit_event *events = calloc((size_t)count + 1, sizeof *events);
    fe_world_get_hit_events(p->world, events, sizeof *events, count);
    fe__hash_i32(&p->told, count);
    for (int32_t i = 0; i < count; ++i) {
        const fe_hit_event *e = events + i;
        const uint64_t words[4] = {told_handle(e->body_a), told_handle(e->body_b), told_handle(e->shape_a),
                                   told_handle(e->shape_b)};
        fe__hash_u64_array(&p->told, words, 4);
        fe__hash_dvec3(&p->told, e->point);
        fe__hash_vec3(&p->told, e->normal);
        fe__hash_floats2(&p->told, e->speed, e->impulse);
    }
    free(events);
}

// nothing to tell is not told: most scripts have no joints
static void hear_joints(play *p)
{
    int32_t count = fe_world_get_joint_events(p->world, NULL, 0, 0);
    fe_joint_event *events = calloc((size_t)count + 1, sizeof *events);
    fe_world_get_joint_events(p->world, events, sizeof *events, count);
    for (int32_t i = 0; i < count; ++i) {
        const fe_joint_event *e = events + i;
        const uint64_t words[3] = {told_handle(e->joint), told_handle(e->body_a), told_handle(e->body_b)};
        fe__hash_u64_array(&p->told, words, 3);
        fe__hash_i32(&p->told, e->kind * 8 + e->type);
        fe__hash_vec3(&p->told, e->force);
        fe__hash_vec3(&p->told, e->torque);
    }
    free(events);
}

static void hear_moved(play *p)
{
    int32_t count = fe_world_get_moved(p->world, NULL, NULL, 0, 0);
    fe_body *bodies = calloc((size_t)count + 1, sizeof *bodies);
    fe_world_get_moved(p->world, bodies, NULL, 0, count);
    fe__hash_i32(&p->told, count);
    for (int32_t i = 0; i < count; ++i) fe__hash_u64(&p->told, told_handle(bodies[i]));
    free(bodies);
}

// a ray a step, from everywhere to everywhere
static void hear_ray(play *p)
{
    const double reach = 12.0; // m, about the scenes' size
    double at = (double)(p->step % 16) / 8.0 - 1.0;
    fe_dvec3 origin = {reach * at, 0.5 * reach, -reach}, translation = {-reach * at, -0.5 * reach, 2.0 * reach};
    fe_hit hit = {0};
    const int32_t count = fe_world_raycast(p->world, &origin, &translation, NULL, &hit);
    fe__hash_i32(&p->told, 1 - count); // as golden.txt holds it: 0 for a hit, 1 for a miss
    if (count != 1) return;
    fe__hash_u64(&p->told, told_handle(hit.shape));
    fe__hash_double(&p->told, hit.fraction);
    fe__hash_dvec3(&p->told, hit.point);
    fe__hash_vec3(&p->told, hit.normal);
}

void play_until(play *p, const script *s, int32_t step)
{
    if (p->step == 0 && p->actor_count == 0) s->build(p);
    while (p->step < step) {
        s->act(p);
        PLAY(p, fe_world_step(p->world, p->dt));
        p->step += 1;
        hear_pairs(p);
        hear_bodies(p);
        hear_hits(p);
        hear_joints(p);
        hear_moved(p);
        hear_ray(p);
    }
}

void play_print(FILE *out, const script *s, fe_world *world, int32_t steps)
{
    play p;
    play_begin(&p, world);
    while (p.step < steps && p.step < s->steps) {
        play_until(&p, s, p.step + PLAY_CHECK_STEPS);
        fprintf(out, "%s %d %016" PRIx64 " %016" PRIx64 "\n", s->name, (int)p.step, play_hash(&p), play_told(&p));
    }
}

// ---- what scripts are written with ---------------------------------------------------------------------------------

// Knuth's line of numbers modulo 2^32; its high bits are the random ones
uint32_t play_draw(play *p)
{
    p->seed = p->seed * UINT32_C(1664525) + UINT32_C(1013904223);
    return p->seed >> 8;
}

float play_between(play *p, float low, float high) { return low + (high - low) * ((float)play_draw(p) / 16777216.0f); }

static part new_part(double x, double y, double z)
{
    part a;
    fe_body_def_init(&a.body, sizeof a.body);
    fe_shape_def_init(&a.shape, sizeof a.shape);
    a.body.transform = fe_make_transform(x, y, z);
    return a;
}

part part_sphere(float radius, double x, double y, double z)
{
    part a = new_part(x, y, z);
    fe_geometry_sphere(&a.geometry, radius);
    return a;
}

part part_capsule(float half_height, float radius, double x, double y, double z)
{
    part a = new_part(x, y, z);
    fe_geometry_capsule(&a.geometry, half_height, radius);
    return a;
}

part part_box(float half_x, float half_y, float half_z, double x, double y, double z)
{
    part a = new_part(x, y, z);
    fe_geometry_box(&a.geometry, half_x, half_y, half_z);
    return a;
}

part part_static_box(float half_x, float half_y, float half_z, double x, double y, double z)
{
    part a = part_box(half_x, half_y, half_z, x, y, z);
    a.body.type = FE_BODY_STATIC;
    return a;
}

part part_plane(float x, float y, float z)
{
    part a = new_part(0.0, 0.0, 0.0);
    a.body.type = FE_BODY_STATIC;
    fe_geometry_plane(&a.geometry, x, y, z, 0.0f);
    return a;
}

float play_wave(int32_t column, int32_t row)
{
    int32_t x = (column * 5) % 20, z = (row * 7) % 24, a = x < 10 ? x : 20 - x, b = z < 12 ? z : 24 - z;
    return 0.06f * (float)a + 0.05f * (float)b;
}

void play_tumble(play *p, int32_t i, float fall, part *out_part)
{
    part *a = out_part;
    a->body.transform.rotation.x = play_between(p, -1.0f, 1.0f);
    a->body.transform.rotation.z = play_between(p, -1.0f, 1.0f);
    a->shape.material.rolling_resistance = 0.2f;
    a->shape.material.spinning_resistance = 0.02f;
    if (i % 5 == 0) a->shape.events = FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT;
    if (i % 17 == 3) a->shape.trigger = 1, a->body.gravity_scale = 0.2f;
    if (i % 9 == 4) a->body.linear_velocity.x = 30.0f, a->body.linear_velocity.y = fall;
}

void play_put(play *p, int32_t actor, const part *part)
{
    PLAY(p, fe_body_create(p->world, &part->body, p->actors + actor));
    PLAY(p, fe_shape_create(p->world, p->actors[actor], &part->shape, &part->geometry, p->shapes + actor));
}

int32_t play_add(play *p, const part *part)
{
    if (p->actor_count == PLAY_MOST_ACTORS) abort();
    play_put(p, p->actor_count, part);
    return p->actor_count++;
}

void play_remove(play *p, int32_t actor)
{
    if (!p->actors[actor]) return;
    PLAY(p, fe_body_destroy(p->world, p->actors[actor]));
    p->actors[actor] = p->shapes[actor] = 0;
}
