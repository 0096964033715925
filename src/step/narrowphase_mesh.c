// narrowphase_mesh.c - the narrow phase of a pair with a heightfield or a mesh: patches by direction, each a contact of
// its own.
//
// Called by the collide stage on any thread, for heads that cannot be recycled. Only the pair's own records are
// written. The frame has the ground's axes and its origin at the other shape; double positions are subtracted here.
#include "step/narrowphase.h"

#include "collision/form/hull.h"
#include "collision/manifold/collide.h"
#include "collision/manifold/terrain_course.h"
#include "step/load.h"
#include "world/contact.h"
#include "world/body.h"

#include <string.h>

// ---- patches at some poses ------------------------------------------------------------------------------------------

typedef struct look {
    fe__view v;
    fe__places at;
    fe__patch patches[FE__PATCHES];
    int32_t count;
} look;

// The data that all looks at a pair share
typedef struct field_pair {
    const fe_world *world;
    int32_t pair;          // the head
    const fe__body *a, *b; // the solver's
    const fe__shape *field, *other;
    fe_vec3 known[FE__PATCHES], known_face[FE__PATCHES]; // normals of what touches now, the field's frame
    fe_dvec3 known_at[FE__PATCHES];
    int32_t known_count;
    const fe__mesh_near *near; // triangles of all looks; NULL: not gathered
    float dt, speed_limit;     // s; m/s that no point of either body exceeds
    float step_fall, fall;     // m, within the step, and until the look: see fe__terrain
    int32_t is_last;           // 1: the look is at the end of the step
} field_pair;

static fe__terrain terrain_of(const field_pair *p, const fe__pose *pose_field, const fe__pose *pose_other,
                              const fe__surroundings *around)
{
    fe__ground ground = fe__store_ground(p->world->store, &p->field->form);
    ground.near = p->near;
    fe_dvec3 between = fe__dsub(pose_other->position, pose_field->position);
    return (fe__terrain){.ground = ground,
                         .origin = fe__drotate_back(pose_field->rotation, between),
                         .around = around,
                         .known = p->known,
                         .known_face = p->known_face,
                         .known_at = p->known_at,
                         .known_count = p->known_count,
                         .is_last = p->is_last,
                         .fall = p->fall};
}

static fe__mat3 relative_rotation(const fe__pose *pose_field, const fe__pose *pose_other)
{
    return fe__matrix(fe__product(fe__conjugate(pose_field->rotation), pose_other->rotation));
}

// Finds the other's course past a field that stands still. 0: the field moves, or the other turns too far for one
static int32_t find_course(const field_pair *p, fe__course *course)
{
    const fe__pose *field = &p->field->pose, *other = &p->other->pose;
    const fe__body *body = p->world->bodies + p->other->body;
    float angle = fe__length(fe__quad_vector(body->spin)) * p->dt;
    if (p->world->bodies[p->field->body].awake_index >= 0 || !(angle < FE__MOST_COURSE_ANGLE)) return 0;
    fe_dvec3 centre;
    fe_quat rotation;
    fe__advance(p->world, body, p->dt, &centre, &rotation);
    fe__pose end = fe__shape_pose_at(body, p->other, centre, rotation);
    fe_dvec3 way = fe__dsub(end.position, other->position), pivot = fe__dsub(fe__centre_of(body), other->position);
    *course = (fe__course){{relative_rotation(field, other), relative_rotation(field, &end)},
                           fe__narrow(fe__drotate_back(field->rotation, way)),
                           fe__narrow(fe__drotate_back(field->rotation, pivot)),
                           body->reach,
                           angle,
                           p->step_fall};
    return 1;
}

// Gathers the triangles for all looks, which begin where the bodies are and end no more than `reach` from there. NULL:
// none were gathered
static const fe__mesh_near *gather_triangles(const field_pair *p, float margin, float reach, fe__mesh_near *storage)
{
    const fe__pose *field = &p->field->pose, *other = &p->other->pose;
    fe__terrain terrain = terrain_of(p, field, other, NULL);
    fe__course course;
    if (terrain.ground.mesh && find_course(p, &course)) {
        fe__find_triangles_on_course(&terrain, &p->other->form, &course, margin, p->world->kernels->meet_course,
                                     storage);
        return storage;
    }
    fe__mat3 rotation = relative_rotation(field, other);
    float most = reach > margin ? reach + margin : margin;
    return fe__find_near_triangles(&terrain, &p->other->form, &rotation, most, storage) ? storage : NULL;
}

// `gap`: NULL, or the distance where there are no patches
static void look_at(const field_pair *p, const fe__pose *pose_field, const fe__pose *pose_other, float margin,
                    float *gap, look *l)
{
    const fe_world *world = p->world;
    l->v = (fe__view){.a = p->field,
                      .b = p->other,
                      .origin = pose_other->position,
                      .rotation = fe__matrix(pose_field->rotation)};
    l->v.form_a = p->field->form;
    fe__surroundings around; // not zeroed: its counts say how many are written
    fe__mat3 rotation = relative_rotation(pose_field, pose_other);
    fe_vec3 centre = fe__mul(&rotation, fe__form_middle(&p->other->form));
    fe__find_surroundings(world, &l->v, p->field, p->other, centre, &around);
    fe__terrain terrain = terrain_of(p, pose_field, pose_other, &around);
    l->v.relative.rotation = rotation;
    const fe__pair_load load = {{fe__tell_pair_load}, world, p->pair, &l->at, &l->v};
    terrain.load = fe__load_chooses(&l->v) ? &load.asked : NULL;
    l->count = fe__collide_terrain(&terrain, &p->other->form, &rotation, margin, l->patches, gap);
}

static void look_after(field_pair *p, float time, float margin, look *l)
{
    float share = time / p->dt; // fe__advance falls as one step of that length does
    p->is_last = time == p->dt, p->fall = share * share * p->step_fall;
    fe__places *at = &l->at;
    fe__advance(p->world, p->a, time, &at->centre_a, &at->rotation_a);
    fe__advance(p->world, p->b, time, &at->centre_b, &at->rotation_b);
    int32_t field_is_a = p->world->bodies + p->field->body == p->a;
    fe__pose pose_a = fe__shape_pose_at(p->a, field_is_a ? p->field : p->other, at->centre_a, at->rotation_a);
    fe__pose pose_b = fe__shape_pose_at(p->b, field_is_a ? p->other : p->field, at->centre_b, at->rotation_b);
    look_at(p, field_is_a ? &pose_a : &pose_b, field_is_a ? &pose_b : &pose_a, margin, NULL, l);
}

static const fe__manifold_point *deepest_point(const fe__patch *patch)
{
    const fe__manifold_point *deepest = patch->points;
    for (int32_t i = 1; i < patch->count; ++i)
        if (patch->points[i].separation < deepest->separation) deepest = patch->points + i;
    return deepest;
}

static float least_separation(const look *l)
{
    float least = deepest_point(l->patches)->separation;
    for (int32_t i = 1; i < l->count; ++i) least = fe__minf(least, deepest_point(l->patches + i)->separation);
    return least;
}

// ---- speculative contacts -------------------------------------------------------------------------------------------
// As in narrowphase.c, but a surface has no inside that would show a crossing.

// From far off the pair is followed by steps in which it cannot close its gap (conservative advancement; Mirtich,
// 1996). 1: it touches within the step, in the poses of `touch`
static int32_t advance_to_touch(field_pair *p, const look *now, look *touch)
{
    enum { MOST_LOOKS = 16 };
    float speculative = p->world->tuning.speculative_distance, gap = least_separation(now), time = 0.0f;
    for (int32_t i = 0; i < MOST_LOOKS; ++i) {
        time += fe__maxf(gap, 0.5f * FE__TURNS_LITTLE) / p->speed_limit;
        if (time >= p->dt) break;
        look_after(p, time, fe__maxf(p->speed_limit * (p->dt - time), speculative), touch);
        if (!touch->count) return 0;
        gap = least_separation(touch);
        if (gap <= FE__TURNS_LITTLE) return 1;
    }
    look_after(p, fe__minf(time, p->dt), speculative, touch);
    return touch->count > 0;
}

// ---- records --------------------------------------------------------------------------------------------------------

// A record as it is to be
typedef struct plan {
    const look *from;
    const fe__patch *patch; // a patch of that look; NULL: none
    int32_t source;         // number of the record that its impulses come from, -1: none
} plan;

// The records of a pair as they were, by number: the head's is 0.
typedef struct old_records {
    fe__contact contacts[FE__PATCHES];
    fe__points points[FE__PATCHES];
    fe__features features[FE__PATCHES];
    float rolling[FE__PATCHES][3];
} old_records;

static fe_vec3 world_normal(const plan *x) { return fe__mul(&x->from->v.rotation, x->patch->normal); }

// A patch goes to the record whose normal is nearest to its own, so that impulses and colours stay. The head always has
// one.
static void assign_records(plan *plans, int32_t count, const old_records *old, int32_t flipped, plan *slots)
{
    const float alike = 0.9f; // cosine: 26 degrees
    for (int32_t i = 0; i < count; ++i) plans[i].source = -1;
    for (int32_t s = 0; s < FE__PATCHES; ++s) {
        slots[s] = (plan){.source = -1};
        int32_t best = -1;
        float most = alike;
        if (!(old->contacts[s].point_count > 0.0f)) continue;
        fe_vec3 n = fe__quad_vector(old->contacts[s].normal);
        for (int32_t i = 0; i < count; ++i) {
            float cosine = (flipped ? -1.0f : 1.0f) * fe__dot(n, world_normal(plans + i));
            if (plans[i].source < 0 && cosine > most) most = cosine, best = i;
        }
        if (best >= 0) plans[best].source = s, slots[s] = plans[best];
    }
    int32_t free = 0;
    for (int32_t i = 0; i < count; ++i) {
        if (plans[i].source >= 0) continue;
        while (slots[free].patch) ++free;
        slots[free] = plans[i];
    }
    for (int32_t s = FE__PATCHES - 1; s > 0 && count && !slots[0].patch; --s)
        if (slots[s].patch) slots[0] = slots[s], slots[s] = (plan){.source = -1};
}

static void copy_impulses(const plan *x, const old_records *old, fe__points *points, fe__features *features,
                          fe__extra *extra)
{
    fe__points_forget_impulses(points);
    for (int32_t k = 0; k < 3 && extra; ++k) extra->rolling_impulse[k] = 0.0f;
    for (int32_t i = 0; i < x->patch->count; ++i) features->ids[i] = x->patch->points[i].id;
    if (x->source < 0) return;
    const fe__points *from = old->points + x->source;
    memcpy(points->friction_impulse, from->friction_impulse, sizeof points->friction_impulse);
    points->twist_impulse = from->twist_impulse;
    for (int32_t k = 0; k < 3 && extra; ++k) extra->rolling_impulse[k] = old->rolling[x->source][k];
    for (int32_t i = 0; i < x->patch->count; ++i)
        for (int32_t j = 0; j < (int32_t)old->contacts[x->source].point_count; ++j)
            if (old->features[x->source].ids[j] == features->ids[i])
                points->normal_impulse[i] = from->normal_impulse[j];
}

static void write_record(fe_world *world, int32_t record, const plan *x, const look *now, const old_records *old,
                         float tolerance)
{
    fe__pair *p = world->pairs + record;
    fe__contact *contact = world->contacts + record;
    const fe__patch *patch = x->patch;
    const look *l = patch ? x->from : now;
    fe__manifold found = {.count = 0};
    if (patch) {
        found = (fe__manifold){.normal = patch->normal, .count = patch->count};
        for (int32_t i = 0; i < patch->count; ++i) found.points[i] = patch->points[i];
        if (!contact->points) fe__points_take(world, record);
        copy_impulses(x, old, fe__points_of(world, contact), world->features + contact->points,
                      fe__extra_of(world, contact));
    }
    p->left_out = patch ? (uint8_t)patch->left_out : 0;
    fe__write_manifold(world, contact, &l->v, &l->at, &found, l != now);
    contact->surface.tolerance = p->flags & FE__PAIR_PATCH ? FE__FOLLOWS : tolerance;
    if (l != now) contact->surface.tolerance = FE__AHEAD; // the head's tolerance is 0 then
    if (patch && p->triangle != patch->triangle) {
        p->triangle = patch->triangle;
        fe__pair_mix_surface(world, record);
    }
}

static void write_records(fe_world *world, int32_t head, plan *plans, int32_t count, const look *now, float tolerance)
{
    old_records old;
    plan slots[FE__PATCHES];
    int32_t records[FE__PATCHES], n = 0;
    for (int32_t record = head; record >= 0; record = world->pairs[record].next_patch, ++n) {
        const fe__contact *contact = world->contacts + record;
        records[n] = record;
        old.contacts[n].point_count = 0.0f;
        if (!(contact->point_count > 0.0f)) continue;
        old.contacts[n] = *contact;
        old.points[n] = *fe__points_of(world, contact);
        old.features[n] = world->features[contact->points];
        const fe__extra *extra = fe__extra_of(world, contact);
        for (int32_t k = 0; k < 3; ++k) old.rolling[n][k] = extra ? extra->rolling_impulse[k] : 0.0f;
    }
    int32_t flipped = world->contacts[head].body_a != now->v.a->body;
    assign_records(plans, count, &old, flipped, slots);
    for (int32_t i = 0; i < FE__PATCHES; ++i) {
        int32_t was_empty = !(old.contacts[i].point_count > 0.0f);
        if (i == 0 || slots[i].patch || !was_empty) write_record(world, records[i], slots + i, now, &old, tolerance);
    }
}

// ---- narrow phase of a pair -----------------------------------------------------------------------------------------

// Adds the patches of a look whose normal no plan has yet. Returns the number of plans.
static int32_t add_new_directions(plan *plans, int32_t count, const look *l)
{
    int32_t old = count;
    for (int32_t i = 0; i < l->count && count < FE__PATCHES; ++i) {
        plan x = {.from = l, .patch = l->patches + i};
        int32_t known = 0;
        for (int32_t k = 0; k < old; ++k) known |= fe__dot(world_normal(plans + k), world_normal(&x)) > FE__SAME_NORMAL;
        if (!known) plans[count++] = x;
    }
    return count;
}

// Tells later looks the faces that the other lies on now.
static void remember_faces(field_pair *p, const plan *plans, int32_t count)
{
    const fe__pose *field = &p->field->pose;
    fe_dvec3 origin = fe__drotate_back(field->rotation, fe__dsub(p->other->pose.position, field->position));
    for (int32_t i = 0; i < count; ++i) {
        const fe__manifold_point *point = deepest_point(plans[i].patch);
        fe_vec3 n = plans[i].patch->normal, on_face = fe__add_scaled(point->point, -0.5f * point->separation, n);
        p->known[i] = n, p->known_face[i] = plans[i].patch->face, p->known_at[i] = fe__dadd(origin, fe__widen(on_face));
    }
    p->known_count = count;
}

void fe__collide_field_pair(const fe__step *step, int32_t head)
{
    fe_world *world = step->world;
    const fe__pair *p = world->pairs + head;
    const fe__contact *contact = world->contacts + head;
    const fe__shape *shape_a = world->shapes + p->shape_a, *shape_b = world->shapes + p->shape_b;
    int32_t b_is_field = !fe__form_is_field(&shape_a->form), is_sensor = (p->flags & FE__PAIR_SENSOR) != 0;
    field_pair pair = {.world = world,
                       .pair = head,
                       .a = world->bodies + contact->body_a,
                       .b = world->bodies + contact->body_b,
                       .field = b_is_field ? shape_b : shape_a,
                       .other = b_is_field ? shape_a : shape_b,
                       .dt = step->dt,
                       .step_fall = step->fall};
    float dt = step->dt, margin = world->tuning.speculative_distance, reach = fe__reach_in_step(step, pair.a, pair.b);
    pair.speed_limit = dt > 0.0f ? reach / dt : 0.0f;
    fe__mesh_near storage;
    pair.near = gather_triangles(&pair, margin, reach, &storage);
    look now, later;
    float gap; // set if there are no patches
    now.at =
        (fe__places){fe__centre_of(pair.a), fe__centre_of(pair.b), fe__rotation_of(pair.a), fe__rotation_of(pair.b)};
    look_at(&pair, &pair.field->pose, &pair.other->pose, fe__maxf(margin, reach), &gap, &now);

    plan plans[FE__PATCHES];
    int32_t count = 0, ahead = 0;
    for (int32_t i = 0; i < now.count; ++i)
        if (deepest_point(now.patches + i)->separation <= margin)
            plans[count++] = (plan){.from = &now, .patch = now.patches + i};
    if (now.count && !is_sensor) {
        if (least_separation(&now) > FE__TURNS_LITTLE) {
            ahead = advance_to_touch(&pair, &now, &later);
            if (ahead) count = add_new_directions(plans, 0, &later);
        } else if (reach > margin) { // it rolls or slides: into what rises before it
            remember_faces(&pair, plans, count);
            look_after(&pair, dt, margin, &later);
            ahead = 1;
            count = add_new_directions(plans, count, &later);
        }
    }
    float tolerance = 0.0f; // the next step looks again
    if (!now.count && !ahead)
        tolerance = fe__slack(gap, margin);
    else if (count && !ahead)
        tolerance = fe__recycle_tolerance(&now.v, now.count == 1 ? now.patches[0].left_out : FE_LEFT_NONE);
    write_records(world, head, plans, count, &now, tolerance);
}
