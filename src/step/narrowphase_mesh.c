// narrowphase_mesh.c - the narrow phase of a pair with a heightfield or a mesh: patches by direction, each a contact of
// its own.
//
// Called by the collide stage on any thread, for heads that cannot be recycled. Only the pair's own records are
// written. The frame has the ground's axes and its origin at the other shape; double positions are subtracted
// here.
#include "step/narrowphase.h"

#include "collision/form/hull.h"
#include "collision/manifold/collide.h"
#include "collision/manifold/terrain_course.h"
#include "step/load.h"
#include "world/contact.h"
#include "world/body.h"

#include <string.h>

// A look at the pair at some poses.
typedef struct look {
    fe__view v;
    fe__places at;
    fe__patch patches[FE__PATCHES];
    int32_t count;
} look;

typedef struct pair_view {
    const fe_world *world;
    int32_t pair;          // the head
    const fe__body *a, *b; // the solver's
    const fe__shape *field, *other;
    fe_vec3 known[FE__PATCHES], known_face[FE__PATCHES]; // normals of what touches now, the field's frame
    fe_dvec3 known_at[FE__PATCHES];
    int32_t known_count;
    const fe__mesh_near *near; // triangles of all looks, or NULL
    float dt, speed_limit;     // s; m/s that no point of either body exceeds
    float step_fall, fall;     // m, within the step, and until the look: see fe__terrain
    int32_t is_last;           // the look is at the end of the step
} pair_view;

// ---- one look ------------------------------------------------------------------------------------------------------
static fe__terrain terrain_of(const pair_view *p, const fe__pose *pose_field, const fe__pose *pose_other,
                              const fe__surroundings *around)
{
    fe__ground ground = fe__store_ground(p->world->store, &p->field->form);
    ground.near = p->near;
    return (fe__terrain){.ground = ground,
                         .origin = fe__drotate_back(pose_field->rotation,
                                                    fe__dsub(pose_other->position, pose_field->position)),
                         .around = around,
                         .known = p->known,
                         .known_face = p->known_face,
                         .known_at = p->known_at,
                         .known_count = p->known_count,
                         .is_last = p->is_last,
                         .fall = p->fall};
}

static fe__mat3 rotation_of(const fe__pose *pose_field, const fe__pose *pose_other)
{
    return fe__matrix(fe__product(fe__conjugate(pose_field->rotation), pose_other->rotation));
}

static fe_vec3 in_field(const pair_view *p, fe_dvec3 point)
{
    return fe__narrow(fe__drotate_back(p->field->pose.rotation, fe__dsub(point, p->other->pose.position)));
}

// The way of the other past a field that stands still. 0: there is none that says much
static int32_t find_course(const pair_view *p, float fall, fe__course *course)
{
    const fe__pose *field = &p->field->pose;
    const fe__body *body = p->world->bodies + p->other->body;
    float angle = fe__length(fe__quad_vector(body->spin)) * p->dt;
    if (p->world->bodies[p->field->body].awake_index >= 0 || !(angle < FE__MOST_COURSE_ANGLE)) return 0;
    fe_dvec3 centre;
    fe_quat rotation;
    fe__advance(p->world, body, p->dt, &centre, &rotation);
    fe__pose end = fe__shape_pose_at(body, p->other, centre, rotation);
    *course = (fe__course){{rotation_of(field, &p->other->pose), rotation_of(field, &end)},
                           in_field(p, end.position),
                           in_field(p, fe__centre_of(body)),
                           body->reach,
                           angle,
                           fall};
    return 1;
}

// Those that a look may ask for, which begins where the bodies are and ends no more than `reach` from there
static const fe__mesh_near *find_near(const pair_view *p, float margin, float reach, float fall, fe__mesh_near *room)
{
    const fe__pose *field = &p->field->pose, *other = &p->other->pose;
    fe__terrain terrain = terrain_of(p, field, other, NULL);
    fe__course course;
    if (terrain.ground.mesh && find_course(p, fall, &course)) {
        fe__find_triangles_on_course(&terrain, &p->other->form, &course, margin, p->world->kernels->meet_course, room);
        return room;
    }
    fe__mat3 rotation = rotation_of(field, other);
    float most = reach > margin ? reach + margin : margin;
    return fe__find_near_triangles(&terrain, &p->other->form, &rotation, most, room) ? room : NULL;
}

static void look_at(const pair_view *p, const fe__pose *pose_field, const fe__pose *pose_other, float margin,
                    float *gap, look *l)
{
    const fe_world *w = p->world;
    l->v = (fe__view){.a = p->field,
                      .b = p->other,
                      .origin = pose_other->position,
                      .rotation = fe__matrix(pose_field->rotation)};
    l->v.form_a = p->field->form;
    fe__surroundings around; // their numbers say how many are written
    fe__mat3 rotation = rotation_of(pose_field, pose_other);
    fe__find_surroundings(w, &l->v, p->field, p->other, fe__mul(&rotation, fe__form_middle(&p->other->form)), &around);
    fe__terrain terrain = terrain_of(p, pose_field, pose_other, &around);
    l->v.relative.rotation = rotation;
    const fe__pair_load load = {{fe__tell_pair_load}, w, p->pair, &l->at, &l->v};
    terrain.load = fe__load_chooses(&l->v) ? &load.asked : NULL;
    l->count = fe__collide_terrain(&terrain, &p->other->form, &rotation, margin, l->patches, gap);
}

static void look_after(pair_view *p, float time, float margin, look *l)
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

static float deepest_of(const look *l)
{
    float deepest = l->patches[0].points[0].separation;
    for (int32_t i = 0; i < l->count; ++i)
        for (int32_t k = 0; k < l->patches[i].count; ++k)
            deepest = fe__minf(deepest, l->patches[i].points[k].separation);
    return deepest;
}

// ---- ahead of time -------------------------------------------------------------------------------------------------
// As narrowphase.c, but a surface has no inside that would show a crossing: from far off the pair is followed by steps
// in which it cannot close its gap (conservative advancement; Mirtich, 1996). 1: it touches within the step, at the
// poses looked at.
static int32_t look_ahead(pair_view *p, const look *now, look *then)
{
    enum { MOST_LOOKS = 16 };
    float speculative = p->world->tuning.speculative_distance, gap = deepest_of(now), time = 0.0f;
    for (int32_t i = 0; i < MOST_LOOKS; ++i) {
        time += fe__maxf(gap, 0.5f * FE__TURNS_LITTLE) / p->speed_limit;
        if (time >= p->dt) break;
        look_after(p, time, fe__maxf(p->speed_limit * (p->dt - time), speculative), then);
        if (!then->count) return 0;
        gap = deepest_of(then);
        if (gap <= FE__TURNS_LITTLE) return 1;
    }
    look_after(p, fe__minf(time, p->dt), speculative, then);
    return then->count > 0;
}

// ---- records -------------------------------------------------------------------------------------------------------
// What a record will hold: a patch of a look, and from which record its impulses come.
typedef struct plan {
    const look *from;
    const fe__patch *patch;
    int32_t source; // record's number, -1: none
} plan;

typedef struct memory {
    fe__contact contacts[FE__PATCHES];
    fe__points points[FE__PATCHES];
    fe__features features[FE__PATCHES];
    float rolling[FE__PATCHES][3];
} memory;

static fe_vec3 world_normal(const plan *x) { return fe__mul(&x->from->v.rotation, x->patch->normal); }

// A patch goes to the record whose normal is nearest to its own, so that impulses and colours stay. The head always has
// one.
static void assign(plan *plans, int32_t count, const memory *old, int32_t flipped, plan *slots)
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

static void copy_impulses(const plan *x, const memory *old, fe__points *q, fe__features *f, fe__extra *e)
{
    fe__points_forget_impulses(q);
    for (int32_t k = 0; k < 3 && e; ++k) e->rolling_impulse[k] = 0.0f;
    for (int32_t i = 0; i < x->patch->count; ++i) f->ids[i] = x->patch->points[i].id;
    if (x->source < 0) return;
    const fe__points *from = old->points + x->source;
    memcpy(q->friction_impulse, from->friction_impulse, sizeof q->friction_impulse);
    q->twist_impulse = from->twist_impulse;
    for (int32_t k = 0; k < 3 && e; ++k) e->rolling_impulse[k] = old->rolling[x->source][k];
    for (int32_t i = 0; i < x->patch->count; ++i)
        for (int32_t j = 0; j < (int32_t)old->contacts[x->source].point_count; ++j)
            if (old->features[x->source].ids[j] == f->ids[i]) q->normal_impulse[i] = from->normal_impulse[j];
}

static fe__manifold manifold_of(const fe__patch *patch)
{
    fe__manifold found = {.normal = patch->normal, .count = patch->count};
    for (int32_t i = 0; i < patch->count; ++i) found.points[i] = patch->points[i];
    return found;
}

static void write_record(fe_world *world, int32_t record, const plan *x, const look *now, const memory *old,
                         float tolerance)
{
    fe__pair *p = world->pairs + record;
    fe__contact *m = world->contacts + record;
    const look *l = x->patch ? x->from : now;
    fe__manifold found = x->patch ? manifold_of(x->patch) : (fe__manifold){.count = 0};
    if (x->patch) {
        if (!m->points) fe__points_take(world, record);
        copy_impulses(x, old, fe__points_of(world, m), world->features + m->points, fe__extra_of(world, m));
    }
    p->left_out = x->patch ? (uint8_t)x->patch->left_out : 0;
    fe__write_manifold(world, m, &l->v, &l->at, &found, l != now);
    m->surface.tolerance = p->flags & FE__PAIR_PATCH ? FE__FOLLOWS : tolerance;
    if (l != now) m->surface.tolerance = FE__AHEAD; // the head's tolerance is 0 then
    if (x->patch && p->triangle != x->patch->triangle) {
        p->triangle = x->patch->triangle;
        fe__pair_mix_surface(world, record);
    }
}

static void write_records(fe_world *world, int32_t head, plan *plans, int32_t count, const look *now, float tolerance)
{
    memory old;
    plan slots[FE__PATCHES];
    int32_t records[FE__PATCHES], n = 0;
    for (int32_t r = head; r >= 0; r = world->pairs[r].next_patch) {
        records[n++] = r;
        old.contacts[n - 1].point_count = 0.0f;
        if (!(world->contacts[r].point_count > 0.0f)) continue;
        old.contacts[n - 1] = world->contacts[r];
        old.points[n - 1] = *fe__points_of(world, world->contacts + r);
        old.features[n - 1] = world->features[world->contacts[r].points];
        const fe__extra *e = fe__extra_of(world, world->contacts + r);
        for (int32_t k = 0; k < 3; ++k) old.rolling[n - 1][k] = e ? e->rolling_impulse[k] : 0.0f;
    }
    int32_t flipped = world->contacts[head].body_a != now->v.a->body;
    assign(plans, count, &old, flipped, slots);
    for (int32_t i = 0; i < FE__PATCHES; ++i) {
        int32_t was_empty = !(old.contacts[i].point_count > 0.0f);
        if (i == 0 || slots[i].patch || !was_empty) write_record(world, records[i], slots + i, now, &old, tolerance);
    }
}

// ---- the pair ------------------------------------------------------------------------------------------------------
// Patches with a normal that `now` does not have
static int32_t add_new_directions(plan *plans, int32_t count, const look *then)
{
    int32_t old = count;
    for (int32_t i = 0; i < then->count && count < FE__PATCHES; ++i) {
        plan x = {.from = then, .patch = then->patches + i};
        int32_t known = 0;
        for (int32_t k = 0; k < old; ++k) known |= fe__dot(world_normal(plans + k), world_normal(&x)) > FE__SAME_NORMAL;
        if (!known) plans[count++] = x;
    }
    return count;
}

static const fe__manifold_point *deepest_point(const fe__patch *patch)
{
    const fe__manifold_point *deepest = patch->points;
    for (int32_t i = 1; i < patch->count; ++i)
        if (patch->points[i].separation < deepest->separation) deepest = patch->points + i;
    return deepest;
}

static void remember_faces(pair_view *p, const plan *plans, int32_t count)
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

static int32_t has_near(const fe__patch *patch, float distance)
{
    for (int32_t i = 0; i < patch->count; ++i)
        if (patch->points[i].separation <= distance) return 1;
    return 0;
}

void fe__collide_field_pair(const fe__step *step, int32_t head)
{
    fe_world *world = step->world;
    const fe__pair *p = world->pairs + head;
    const fe__contact *m = world->contacts + head;
    const fe__shape *x = world->shapes + p->shape_a, *y = world->shapes + p->shape_b;
    int32_t swapped = !fe__form_is_field(&x->form), sensor = (p->flags & FE__PAIR_SENSOR) != 0;
    pair_view view = {.world = world,
                      .pair = head,
                      .a = world->bodies + m->body_a,
                      .b = world->bodies + m->body_b,
                      .field = swapped ? y : x,
                      .other = swapped ? x : y,
                      .dt = step->dt,
                      .step_fall = step->fall};
    float dt = step->dt, margin = world->tuning.speculative_distance, reach = fe__reach_in_step(step, view.a, view.b);
    view.speed_limit = dt > 0.0f ? reach / dt : 0.0f;
    fe__mesh_near room;
    view.near = find_near(&view, margin, reach, step->fall, &room);
    look now, then;
    float gap; // without patches
    now.at =
        (fe__places){fe__centre_of(view.a), fe__centre_of(view.b), fe__rotation_of(view.a), fe__rotation_of(view.b)};
    look_at(&view, &view.field->pose, &view.other->pose, fe__maxf(margin, reach), &gap, &now);

    plan plans[FE__PATCHES];
    int32_t count = 0, ahead = 0;
    for (int32_t i = 0; i < now.count; ++i)
        if (has_near(now.patches + i, margin)) plans[count++] = (plan){.from = &now, .patch = now.patches + i};
    if (now.count && !sensor) {
        if (deepest_of(&now) > FE__TURNS_LITTLE) {
            ahead = look_ahead(&view, &now, &then);
            if (ahead) count = add_new_directions(plans, 0, &then);
        } else if (reach > margin) { // it rolls or slides: into what rises before it
            remember_faces(&view, plans, count);
            look_after(&view, dt, margin, &then);
            ahead = 1;
            count = add_new_directions(plans, count, &then);
        }
    }
    float tolerance = ahead ? 0.0f
                      : now.count
                          ? fe__recycle_tolerance(&now.v, now.count == 1 ? now.patches[0].left_out : FE_LEFT_NONE)
                          : fe__slack(gap, margin);
    if (!count && now.count) tolerance = 0.0f;
    write_records(world, head, plans, count, &now, tolerance);
}
