// sleep.c - dense lists of the bodies, pairs and joints that are awake; islands that fall asleep and wake together.
//
// A pair or joint is in its list while one of its bodies is. Results do not depend on the order of the lists, because
// all that could show is sorted by creation.
#include "world/sleep.h"

#include "world/joint.h"
#include "world/contact.h"
#include "world/body.h"

int32_t fe__world_rests(const fe_world *w)
{
    return (w->awake_body_count | w->awake_pair_count | w->awake_joint_count | w->moved_count | w->owed_count |
            w->first_changed | w->disturbed_count | w->pair_event_count | w->body_event_count | w->hit_event_count |
            w->joint_event_count) == 0;
}

// Lists a body that woke or fell asleep since the last step's events: once, whatever happens in between.
static void list_disturbed(fe_world *world, int32_t index)
{
    if (world->bodies[index].flags & FE__BODY_DISTURBED) return;
    world->bodies[index].flags |= FE__BODY_DISTURBED;
    world->disturbed[world->disturbed_count++] = index;
}

void fe__body_awaken_alone(fe_world *world, int32_t index)
{
    fe__body *body = world->bodies + index;
    body->sleep_timer = 0.0f;
    if (body->awake_index >= 0) return;
    body->awake_index = world->awake_body_count;
    world->awake_bodies[world->awake_body_count++] = index;
    for (int32_t pair = body->first_contact; pair >= 0; pair = fe__next_pair(world, pair, index))
        fe__pair_awaken(world, pair);
    for (int32_t joint = body->first_joint; joint; joint = fe__next_joint(world, joint, index))
        fe__joint_awaken(world, joint);
    world->solver.graph_changed = 1;
    list_disturbed(world, index);
}

void fe__body_retire(fe_world *world, int32_t index)
{
    fe__body *body = world->bodies + index;
    int32_t place = body->awake_index, last = world->awake_bodies[--world->awake_body_count];
    world->awake_bodies[place] = last;
    world->bodies[last].awake_index = place;
    body->awake_index = body->line = body->island = -1;
    body->flags &= ~(uint32_t)FE__BODY_BURDENED; // the next step that it takes is not the one after this
    for (int32_t pair = body->first_contact; pair >= 0; pair = fe__next_pair(world, pair, index)) {
        const fe__pair *p = world->pairs + pair;
        int32_t other = p->body_a == index ? p->body_b : p->body_a;
        if (world->bodies[other].awake_index < 0) fe__pair_retire(world, pair);
    }
    for (int32_t joint = body->first_joint; joint; joint = fe__next_joint(world, joint, index))
        fe__joint_retire(world, joint);
    world->solver.graph_changed = 1;
    list_disturbed(world, index);
}

// The other body of a pair or joint in the constraint graph, if it is dynamic. -1: it is not, or not in the graph
static int32_t dynamic_neighbour(const fe_world *world, int32_t pair, int32_t body)
{
    const fe__pair *p = world->pairs + pair;
    int32_t other = p->body_a == body ? p->body_b : p->body_a;
    return p->flags & FE__PAIR_LINKED && world->bodies[other].type == FE_BODY_DYNAMIC ? other : -1;
}

static int32_t joined_dynamic(const fe_world *world, int32_t joint, int32_t body)
{
    int32_t other = fe__joint_other(world, joint, body);
    return world->joints.joints[joint].colour >= 0 && world->bodies[other].type == FE_BODY_DYNAMIC ? other : -1;
}

void fe__wake(fe_world *world, int32_t body)
{
    int32_t next = world->awake_body_count;
    if (world->bodies[body].type == FE_BODY_STATIC) return;
    fe__body_awaken_alone(world, body);
    // the list of awake bodies is the queue of the walk: bodies that wake are appended, and looked at in their turn
    for (; next < world->awake_body_count; ++next) {
        int32_t at = world->awake_bodies[next];
        for (int32_t pair = world->bodies[at].first_contact; pair >= 0; pair = fe__next_pair(world, pair, at)) {
            int32_t other = dynamic_neighbour(world, pair, at);
            if (other >= 0 && world->bodies[other].awake_index < 0) fe__body_awaken_alone(world, other);
        }
        for (int32_t joint = world->bodies[at].first_joint; joint; joint = fe__next_joint(world, joint, at)) {
            int32_t other = joined_dynamic(world, joint, at);
            if (other >= 0 && world->bodies[other].awake_index < 0) fe__body_awaken_alone(world, other);
        }
    }
}

void fe__wake_neighbours(fe_world *world, int32_t body)
{
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) {
        int32_t other = dynamic_neighbour(world, pair, body);
        if (other >= 0) fe__wake(world, other);
    }
    for (int32_t joint = world->bodies[body].first_joint; joint; joint = fe__next_joint(world, joint, body)) {
        int32_t other = joined_dynamic(world, joint, body);
        if (other >= 0) fe__wake(world, other);
    }
}

void fe__body_disturb(fe_world *world, int32_t index)
{
    const fe__body *body = &world->bodies[index];
    if (!(body->flags & FE__BODY_ENABLED)) return;
    if (body->type == FE_BODY_STATIC)
        fe__wake_neighbours(world, index);
    else
        fe__wake(world, index);
}

static int32_t is_driving(const fe_world *world, int32_t body, int32_t low)
{
    const fe__body *b = world->bodies + body;
    return b->type == FE_BODY_KINEMATIC && b->awake_index >= 0 && b->awake_index < low;
}

// 1: a kinematic body that is awake pushes it or pulls at it, other than those from `low` on, which fall asleep with
// it.
static int32_t is_driven(const fe_world *world, int32_t body, int32_t low)
{
    for (int32_t pair = world->bodies[body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, body)) {
        const fe__pair *p = world->pairs + pair;
        if (p->flags & FE__PAIR_LINKED && is_driving(world, p->body_a == body ? p->body_b : p->body_a, low)) return 1;
    }
    for (int32_t joint = world->bodies[body].first_joint; joint; joint = fe__next_joint(world, joint, body))
        if (world->joints.joints[joint].colour >= 0 && is_driving(world, fe__joint_other(world, joint, body), low))
            return 1;
    return 0;
}

static void swap_places(fe_world *world, int32_t i, int32_t j)
{
    int32_t a = world->awake_bodies[i], b = world->awake_bodies[j];
    world->awake_bodies[i] = b, world->awake_bodies[j] = a;
    world->bodies[b].awake_index = i, world->bodies[a].awake_index = j;
}

void fe__body_fall_asleep(fe_world *world, int32_t index)
{
    fe__body *body = world->bodies + index;
    for (int k = 0; k < 3; ++k)
        body->velocity[k] = body->spin[k] = body->force[k] = body->torque[k] = body->relaxed[k] = 0.0f;
    fe__body_note_speed(world, body);
    fe__body_retire(world, index);
}

// Moves an awake body to the island that gathers. Its place until then is noted, so that fe__put_to_sleep can undo the
// exchange.
static void gather(fe_world *world, int32_t body, int32_t *low)
{
    if (body < 0 || world->bodies[body].awake_index < 0 || world->bodies[body].awake_index >= *low) return;
    world->bodies[body].place_before = world->bodies[body].awake_index;
    swap_places(world, world->bodies[body].awake_index, --*low);
}

// Gathers the island of an awake body at the end of the list, from *low on, which grows downwards as the queue of the
// walk. 0: one of the bodies gathered may not sleep
static int32_t gather_island(fe_world *world, int32_t body, int32_t *low)
{
    int32_t end = *low;
    gather(world, body, low);
    for (int32_t next = end - 1; next >= *low; --next) {
        int32_t at = world->awake_bodies[next];
        if (!(world->bodies[at].flags & FE__BODY_SLEEP_ALLOWED)) return 0;
        if (is_driven(world, at, *low)) return 0;
        for (int32_t pair = world->bodies[at].first_contact; pair >= 0; pair = fe__next_pair(world, pair, at))
            gather(world, dynamic_neighbour(world, pair, at), low);
        for (int32_t joint = world->bodies[at].first_joint; joint; joint = fe__next_joint(world, joint, at))
            gather(world, joined_dynamic(world, joint, at), low);
    }
    return 1;
}

fe_result fe__put_to_sleep(fe_world *world, int32_t body)
{
    int32_t low = world->awake_body_count;
    if (world->bodies[body].awake_index < 0) return FE_OK;
    int32_t may_sleep = gather_island(world, body, &low);
    // A snapshot shows the order of the list: if the island stays awake the exchanges are undone, the last one first.
    for (int32_t place = low; place < world->awake_body_count; ++place) {
        fe__body *gathered = world->bodies + world->awake_bodies[place];
        if (!may_sleep) swap_places(world, place, gathered->place_before);
        gathered->place_before = 0;
    }
    if (!may_sleep) return FE_ERROR_STATE;
    world->solver.graph_changed = 1;
    while (world->awake_body_count > low) fe__body_fall_asleep(world, world->awake_bodies[world->awake_body_count - 1]);
    return FE_OK;
}

void fe__world_wake_all(fe_world *world)
{
    for (int32_t body = world->first_body; body >= 0; body = world->bodies[body].order_next)
        if (world->bodies[body].type == FE_BODY_DYNAMIC) fe__body_disturb(world, body);
}

void fe__world_set_gravity(fe_world *world, fe_vec3 gravity)
{
    int32_t same = gravity.x == world->gravity.x && gravity.y == world->gravity.y && gravity.z == world->gravity.z;
    world->gravity = gravity;
    if (!same) fe__world_wake_all(world);
}
