// Events: enter and exit balance whatever ends a touch, triggers see everything, nobody passes unseen, and the order is
// that of creation.
#include "scenes/mechanics.h"

#include <string.h>

enum { MOST = 256 };

typedef struct log_of_step {
    fe_pair_event pairs[MOST];
    int count;
} log_of_step;

static log_of_step events_of(const scene *s)
{
    log_of_step log;
    log.count = fe_world_get_pair_events(s->world, log.pairs, sizeof *log.pairs, MOST);
    FE_WITHIN(log.count, 0, MOST);
    return log;
}

// of one kind between two bodies in the last step
static int told(const scene *s, fe_body a, fe_body b, int kind)
{
    log_of_step log = events_of(s);
    int found = 0;
    for (int i = 0; i < log.count; ++i) {
        const fe_pair_event *e = log.pairs + i;
        found += e->kind == kind && ((e->body_a == a && e->body_b == b) || (e->body_a == b && e->body_b == a));
    }
    return found;
}

static fe_shape shape_of(const scene *s, fe_body body)
{
    fe_shape shape = 0;
    FE_TRUE(fe_body_get_shapes(s->world, body, &shape, 1) == 1);
    return shape;
}

static fe_body ask(scene *s, fe_body body, uint32_t events)
{
    MUST(fe_shape_set_events(s->world, shape_of(s, body), events));
    return body;
}

static fe_body make_trigger(scene *s, fe_body body)
{
    MUST(fe_shape_set_trigger(s->world, shape_of(s, body), 1));
    return body;
}

static void place(scene *s, fe_body body, vec at)
{
    fe_transform t = body_transform(s->world, body);
    t.position = to_world(s, at);
    MUST(fe_body_set_transform(s->world, body, &t));
}

static fe_geometry cube(void) { return box(0.5, 0.5, 0.5); }

// ---- balance -------------------------------------------------------------------------------------------------------

// one enter when it lands, stays only while it lies and only if asked for, one exit when it is gone
static void a_landing_enters_stays_and_exits(void **state)
{
    for (int wants_stay = 0; wants_stay < 2; ++wants_stay) {
        scene s = scene_begin(state);
        fe_body ground = add_ground(&s, friction(0.6)),
                body = add_dynamic(&s, cube(), v3(0, 1, 0), UNTURNED, friction(0.6), WATER);
        if (wants_stay) ask(&s, body, FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_STAY);
        int enters = 0, stays = 0, exits = 0, steps_after = 0;
        for (int i = 0; i < 120; ++i) {
            run(&s, 1);
            stays += told(&s, ground, body, FE_EVENT_STAY);
            steps_after += enters;
            enters += told(&s, ground, body, FE_EVENT_ENTER);
            exits += told(&s, ground, body, FE_EVENT_EXIT);
        }
        FE_TRUE(enters == 1 && exits == 0);
        FE_TRUE(stays == (wants_stay ? steps_after : 0));
        set_velocity(&s, body, v3(0, 5, 0), v3(0, 0, 0));
        for (int i = 0; i < 10; ++i) {
            run(&s, 1);
            exits += told(&s, ground, body, FE_EVENT_EXIT);
        }
        FE_TRUE(exits == 1);
        // far off there is no contact to read either
        FE_WITHIN(position(&s, body).y, 1, 2);
        FE_TRUE(fe_body_get_contacts(s.world, body, NULL, 0, 0) == 0);
        scene_end(&s);
    }
}

static void without_asking_nothing_is_told(void **state)
{
    scene s = scene_begin(state);
    ask(&s, add_ground(&s, friction(0.6)), FE_SHAPE_EVENTS_NONE);
    fe_body body =
        ask(&s, add_dynamic(&s, cube(), v3(0, 0.6, 0), UNTURNED, friction(0.6), WATER), FE_SHAPE_EVENTS_NONE);
    for (int i = 0; i < 60; ++i) {
        run(&s, 1);
        FE_TRUE(events_of(&s).count == 0);
    }
    MUST(fe_body_destroy(s.world, body));
    run(&s, 1);
    FE_TRUE(events_of(&s).count == 0);
    scene_end(&s);
}

typedef enum ending {
    DESTROY,
    DESTROY_SHAPE,
    DISABLE,
    REFILTER,
    IGNORE,
    TELEPORT,
    TYPE,
    MAKE_STATIC_BOTH,
    ENDINGS
} ending;

static void end_touch(scene *s, ending how, fe_body body, fe_body other)
{
    switch (how) {
    case DESTROY:
        MUST(fe_body_destroy(s->world, body));
        break;
    case DESTROY_SHAPE:
        MUST(fe_shape_destroy(s->world, shape_of(s, body)));
        break;
    case DISABLE:
        MUST(fe_body_set_enabled(s->world, body, 0));
        break;
    case REFILTER:
        MUST(fe_body_set_filter(s->world, body, 2, 2, 0));
        break;
    case IGNORE:
        MUST(fe_world_ignore_collision(s->world, body, other, 1));
        break;
    case TELEPORT:
        place(s, body, v3(50, 50, 50));
        break;
    case TYPE:
        MUST(fe_body_set_type(s->world, body, FE_BODY_STATIC));
        break; // on a static ground: no pair any more
    case MAKE_STATIC_BOTH:
        MUST(fe_body_set_type(s->world, body, FE_BODY_KINEMATIC));
        break;
    case ENDINGS:
        break;
    }
}

// Awake or asleep, whatever ends it: exactly one exit, in the next step, with the handles it entered with.
static void every_end_of_a_touch_sends_one_exit(void **state)
{
    for (int asleep = 0; asleep < 2; ++asleep)
        for (int trigger = 0; trigger < 2; ++trigger)
            for (int how = 0; how < ENDINGS; ++how) {
                scene s = scene_begin(state);
                fe_body ground = add_static(&s, box(5, 0.5, 5), v3(0, -0.5, 0), UNTURNED, friction(0.6));
                fe_body zone = make_trigger(&s, add_static(&s, box(2, 2, 2), v3(0, 1, 0), UNTURNED, friction(0.6)));
                fe_body body = add_dynamic(&s, cube(), v3(0, 0.5, 0), UNTURNED, friction(0.6), WATER),
                        other = trigger ? zone : ground;
                MUST(fe_body_set_sleep_allowed(s.world, body, 1));
                int balance = 0;
                for (int i = 0; i < (asleep ? 120 : 10); ++i) {
                    run(&s, 1);
                    balance += told(&s, other, body, FE_EVENT_ENTER) - told(&s, other, body, FE_EVENT_EXIT);
                }
                FE_TRUE(balance == 1);
                if (trigger && how == MAKE_STATIC_BOTH) { // a trigger still sees a kinematic body
                    end_touch(&s, (ending)how, body, other);
                    run(&s, 2);
                    FE_TRUE(told(&s, other, body, FE_EVENT_EXIT) == 0);
                    scene_end(&s);
                    continue;
                }
                end_touch(&s, (ending)how, body, other);
                run(&s, 1);
                if (told(&s, other, body, FE_EVENT_EXIT) != 1)
                    print_error("ending %d, asleep %d, trigger %d\n", how, asleep, trigger);
                FE_TRUE(told(&s, other, body, FE_EVENT_EXIT) == 1);
                for (int i = 0; i < 5; ++i) {
                    run(&s, 1);
                    FE_TRUE(told(&s, other, body, FE_EVENT_EXIT) == 0);
                }
                scene_end(&s);
            }
}

// what was ended may begin again: the filter back, enabled again, no longer ignored
static void what_ended_can_enter_again(void **state)
{
    for (int how = DISABLE; how <= IGNORE; ++how) {
        scene s = scene_begin(state);
        fe_body ground = add_static(&s, box(5, 0.5, 5), v3(0, -0.5, 0), UNTURNED, friction(0.6));
        fe_body body = add_dynamic(&s, cube(), v3(0, 0.5, 0), UNTURNED, friction(0.6), WATER);
        run(&s, 5);
        end_touch(&s, (ending)how, body, ground);
        run(&s, 2);
        if (how == DISABLE) MUST(fe_body_set_enabled(s.world, body, 1));
        if (how == REFILTER) MUST(fe_body_set_filter(s.world, body, 1, 0xffffffffu, 0));
        if (how == IGNORE) MUST(fe_world_ignore_collision(s.world, ground, body, 0));
        run(&s, 1);
        FE_TRUE(told(&s, ground, body, FE_EVENT_ENTER) == 1);
        run(&s, 60);
        FE_NEAR(position(&s, body).y, 0.5, LINEAR_SLOP);
        scene_end(&s);
    }
}

// Random life: at any time, for every pair, enters less exits is 0 or 1; when all is gone it is 0.
static void enters_and_exits_balance_through_a_random_life(void **state)
{
    enum { COUNT = 24, STEPS = SLOW_BUILD ? 200 : 900 };
    dice d = {42};
    scene s = scene_begin(state);
    fe_body bodies[COUNT];
    signed char touching[COUNT + 1][COUNT + 1];
    memset(touching, 0, sizeof touching);
    fe_body ground = add_static(&s, box(6, 0.5, 6), v3(0, -0.5, 0), UNTURNED, friction(0.6));
    MUST(fe_body_set_user_data(s.world, ground, COUNT));
    for (int i = 0; i < COUNT; ++i) bodies[i] = 0;
    for (int step = 0; step < STEPS; ++step) {
        // handles of the destroyed are stale in the events: their numbers are kept here
        int i = pick(&d, COUNT), what = pick(&d, 8), last = step >= STEPS - 2;
        if (last && step == STEPS - 2)
            for (int k = 0; k < COUNT; ++k)
                if (bodies[k]) MUST(fe_body_set_enabled(s.world, bodies[k], 0));
        if (!last && !bodies[i]) {
            vec at = plus(v3(0, 3, 0), somewhere(&d, 2));
            bodies[i] = add_dynamic(&s, any_form(&d, 1), at, any_rotation(&d), friction(0.5), WATER);
            MUST(fe_body_set_sleep_allowed(s.world, bodies[i], 1));
            if (i % 5 == 0) make_trigger(&s, bodies[i]);
            if (i % 5 == 0) MUST(fe_body_set_gravity_scale(s.world, bodies[i], 0));
        } else if (!last && what == 0) {
            MUST(fe_body_set_enabled(s.world, bodies[i], 0));
        } else if (!last && what == 1) {
            MUST(fe_body_set_enabled(s.world, bodies[i], 1));
        } else if (!last && what == 2) {
            MUST(fe_body_set_filter(s.world, bodies[i], 1u << pick(&d, 2), pick(&d, 2) ? 0xffffffffu : 1u, 0));
        } else if (!last && what == 3) {
            place(&s, bodies[i], plus(v3(0, 3, 0), somewhere(&d, 2)));
        } else if (!last && what == 4) {
            set_velocity(&s, bodies[i], somewhere(&d, 5), somewhere(&d, 5));
        }
        run(&s, 1);
        log_of_step log = events_of(&s);
        for (int k = 0; k < log.count; ++k) {
            const fe_pair_event *e = log.pairs + k;
            int a = -1, b = -1;
            for (int n = 0; n <= COUNT; ++n) {
                fe_body body = n < COUNT ? bodies[n] : ground;
                if (body == e->body_a) a = n;
                if (body == e->body_b) b = n;
            }
            FE_TRUE(a >= 0 && b >= 0 && a != b);
            int low = a < b ? a : b, high = a < b ? b : a;
            FE_TRUE(e->kind == FE_EVENT_ENTER || e->kind == FE_EVENT_EXIT);
            touching[low][high] = (signed char)(touching[low][high] + (e->kind == FE_EVENT_ENTER ? 1 : -1));
            FE_WITHIN(touching[low][high], 0, 1);
        }
    }
    for (int a = 0; a <= COUNT; ++a)
        for (int b = 0; b <= COUNT; ++b) FE_TRUE(touching[a][b] == 0);
    scene_end(&s);
}

// ---- within one step -----------------------------------------------------------------------------------------------

// A ball that hits and leaves within one step had an impulse in it: it enters, and exits in the next.
static void a_bounce_within_one_step_enters_and_exits(void **state)
{
    for (int i = 0; i < 20; ++i) {
        scene s = scene_begin(state);
        fe_body ground = add_ground(&s, bouncy(0, 1));
        fe_body ball = add_dynamic(&s, sphere(0.2), v3(0, 0.25 + 0.01 * i, 0), UNTURNED, bouncy(0, 1), WATER);
        set_velocity(&s, ball, v3(0, -12, 0), v3(0, 0, 0));
        int enters = 0, exits = 0, entered_at = -1, exited_at = -1;
        for (int k = 0; k < 12; ++k) {
            run(&s, 1);
            if (told(&s, ground, ball, FE_EVENT_ENTER)) ++enters, entered_at = k;
            if (told(&s, ground, ball, FE_EVENT_EXIT)) ++exits, exited_at = k;
        }
        FE_TRUE(enters == 1 && exits == 1);
        // it leaves at 12 m/s: 0.2 m in a step
        FE_TRUE(exited_at == entered_at + 1);
        scene_end(&s);
    }
}

// ---- triggers ------------------------------------------------------------------------------------------------------

// a trigger box 4 m high over y = 0..4, a body thrown or carried through it: one enter, one exit, no push
static void a_trigger_sees_dynamic_and_kinematic_bodies_and_pushes_nothing(void **state)
{
    static const int types[] = {FE_BODY_DYNAMIC, FE_BODY_KINEMATIC};
    for (int trigger_type = FE_BODY_STATIC; trigger_type <= FE_BODY_DYNAMIC; ++trigger_type)
        for (int i = 0; i < 2; ++i) {
            scene s = scene_begin(state);
            set_gravity(&s, v3(0, 0, 0));
            fe_body zone =
                make_trigger(&s, add_body(&s, trigger_type, box(1, 1, 1), v3(0, 0, 0), UNTURNED, friction(0.6), WATER));
            fe_body body = add_body(&s, types[i], sphere(0.25), v3(-3, 0.3, 0), UNTURNED, friction(0.6), WATER);
            set_velocity(&s, body, v3(4, 0, 0), v3(0, 0, 0));
            int enters = 0, exits = 0;
            for (int k = 0; k < 90; ++k) {
                run(&s, 1);
                log_of_step log = events_of(&s);
                for (int n = 0; n < log.count; ++n) FE_TRUE(log.pairs[n].is_trigger == 1);
                if (told(&s, zone, body, FE_EVENT_ENTER)) {
                    ++enters;
                    // its surface reaches the zone's within a step
                    FE_WITHIN(position(&s, body).x, -1.25 - 4 * STEP, -1.25 + 2 * 4 * STEP);
                }
                if (told(&s, zone, body, FE_EVENT_EXIT)) {
                    ++exits;
                    FE_WITHIN(position(&s, body).x, 1.25 - 4 * STEP, 1.25 + 2 * 4 * STEP);
                }
            }
            FE_TRUE(enters == 1 && exits == 1);
            FE_NEAR(position(&s, body).x, -3 + 4 * 90 * STEP, 1e-4);
            FE_NEAR(length(velocity(&s, zone)), 0, 0);
            FE_TRUE(fe_body_get_contacts(s.world, body, NULL, 0, 0) == 0);
            scene_end(&s);
        }
}

// A trigger that is moved over a sleeper, or made around it, reports it and does not wake it.
static void a_trigger_sees_sleepers_and_lets_them_sleep(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    fe_body sleeper = add_dynamic(&s, cube(), v3(0, 0.5, 0), UNTURNED, friction(0.6), WATER);
    MUST(fe_body_set_sleep_allowed(s.world, sleeper, 1));
    run(&s, 120);
    int32_t awake = 1;
    MUST(fe_body_get_awake(s.world, sleeper, &awake));
    FE_TRUE(!awake);
    fe_body zone = make_trigger(&s, add_static(&s, box(1, 1, 1), v3(0, 0.5, 0), UNTURNED, friction(0.6)));
    int enters = 0;
    for (int i = 0; i < 3; ++i) {
        run(&s, 1);
        enters += told(&s, zone, sleeper, FE_EVENT_ENTER);
    }
    FE_TRUE(enters == 1);
    fe_body probe =
        make_trigger(&s, add_body(&s, FE_BODY_KINEMATIC, sphere(0.5), v3(-4, 0.5, 0), UNTURNED, friction(0.6), WATER));
    set_velocity(&s, probe, v3(4, 0, 0), v3(0, 0, 0));
    int probed = 0, left = 0;
    for (int i = 0; i < 120; ++i) {
        run(&s, 1);
        probed += told(&s, probe, sleeper, FE_EVENT_ENTER);
        left += told(&s, probe, sleeper, FE_EVENT_EXIT);
    }
    FE_TRUE(probed == 1 && left == 1);
    MUST(fe_body_get_awake(s.world, sleeper, &awake));
    FE_TRUE(!awake);
    place(&s, zone, v3(20, 0, 0));
    int exits = 0;
    for (int i = 0; i < 3; ++i) {
        run(&s, 1);
        exits += told(&s, zone, sleeper, FE_EVENT_EXIT);
    }
    FE_TRUE(exits == 1);
    scene_end(&s);
}

// Triggers among themselves: a moving one sees another, two static ones see nothing.
static void triggers_see_triggers_that_move(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body zone = make_trigger(&s, add_static(&s, box(1, 1, 1), v3(0, 0, 0), UNTURNED, friction(0.6)));
    make_trigger(&s, add_static(&s, box(1, 1, 1), v3(1, 0, 0), UNTURNED, friction(0.6)));
    run(&s, 2);
    FE_TRUE(events_of(&s).count == 0);
    fe_body probe =
        make_trigger(&s, add_body(&s, FE_BODY_KINEMATIC, sphere(0.2), v3(0, 0, 0), UNTURNED, friction(0.6), WATER));
    int enters = 0;
    for (int i = 0; i < 2; ++i) {
        run(&s, 1);
        enters += told(&s, zone, probe, FE_EVENT_ENTER);
    }
    FE_TRUE(enters == 1);
    scene_end(&s);
}

// ---- order and hits ------------------------------------------------------------------------------------------------

// Bodies are created, some destroyed, and their slots used again: events come in the order of creation all the same.
static void events_come_in_the_order_of_creation(void **state)
{
    enum { COUNT = 20 };
    scene s = scene_begin(state);
    fe_body bodies[COUNT], ground = add_ground(&s, friction(0.6));
    int rank_of[COUNT];
    for (int i = 0; i < COUNT; ++i)
        bodies[i] = add_dynamic(&s, cube(), v3(2.0 * i, 0.5, 0), UNTURNED, friction(0.6), WATER);
    run(&s, 2);
    for (int i = 0; i < COUNT; i += 3) MUST(fe_body_destroy(s.world, bodies[i]));
    for (int i = COUNT - 1; i >= 0; --i)
        if (i % 3 == 0) bodies[i] = add_dynamic(&s, cube(), v3(2.0 * i, 0.5, 0), UNTURNED, friction(0.6), WATER);
    // created in this order: those that stayed, then the new ones from the last to the first
    int rank = 0;
    for (int i = 0; i < COUNT; ++i)
        if (i % 3) rank_of[i] = rank++;
    for (int i = COUNT - 1; i >= 0; --i)
        if (i % 3 == 0) rank_of[i] = rank++;
    for (int i = 0; i < COUNT; ++i)
        set_velocity(&s, bodies[i], v3(0, 3, 0), v3(0, 0, 0)); // all leave and land together
    int seen = 0;
    for (int k = 0; k < 60; ++k) {
        run(&s, 1);
        log_of_step log = events_of(&s);
        int last = -1;
        for (int n = 0; n < log.count; ++n) {
            FE_TRUE(log.pairs[n].body_a == ground); // A was created first
            int now = -1;
            for (int i = 0; i < COUNT; ++i)
                if (bodies[i] == log.pairs[n].body_b) now = rank_of[i];
            if (now < 0) continue; // the exit of one that was destroyed
            FE_TRUE(now > last);
            last = now;
            ++seen;
        }
    }
    FE_TRUE(seen >= COUNT);
    scene_end(&s);
}

// Speed of approach g t to within a step of falling, impulse m v (1 + e), the point where it hit, the normal from A to
// B.
static void a_hit_is_told_with_its_speed_impulse_and_point(void **state)
{
    static const double restitutions[] = {0, 0.5};
    for (int i = 0; i < 2; ++i) {
        double e = restitutions[i], height = 2, speed = sqrt(2 * G * height);
        scene s = scene_begin(state);
        fe_body ground = add_ground(&s, bouncy(0.6, e));
        fe_body ball = ask(&s, add_dynamic(&s, sphere(0.25), v3(3, 0.25 + height, -2), UNTURNED, bouncy(0.6, e), WATER),
                           FE_SHAPE_EVENTS_HIT);
        double mass = mass_of(&s, ball);
        int hits = 0;
        for (int k = 0; k < 50 && !hits; ++k) {
            run(&s, 1);
            fe_hit_event hit;
            hits = fe_world_get_hit_events(s.world, &hit, sizeof hit, 1);
            if (!hits) continue;
            FE_TRUE(hit.body_a == ground && hit.body_b == ball);
            FE_NEAR(hit.speed, speed, G * STEP);
            FE_NEAR(hit.impulse, mass * speed * (1 + e), 0.02 * mass * speed + mass * G * STEP);
            vec point = from_world(&s, hit.point), normal = from_world(&s, widen(hit.normal));
            FE_NEAR(length(minus(point, v3(3, 0, -2))), 0, 0.1);
            FE_NEAR(length(minus(normal, v3(0, 1, 0))), 0, 1e-6);
        }
        FE_TRUE(hits == 1);
        scene_end(&s);
    }
}

// below the threshold, resting, or without asking: no hits
static void soft_touches_are_no_hits(void **state)
{
    scene s = scene_begin(state);
    add_ground(&s, friction(0.6));
    double speed = 0.9; // the threshold is 1 m/s
    ask(&s, add_dynamic(&s, sphere(0.25), v3(0, 0.25 + speed * speed / (2 * G), 0), UNTURNED, friction(0.6), WATER),
        FE_SHAPE_EVENTS_HIT);
    add_dynamic(&s, sphere(0.25), v3(3, 2, 0), UNTURNED, friction(0.6), WATER);
    for (int k = 0; k < 120; ++k) {
        run(&s, 1);
        FE_TRUE(fe_world_get_hit_events(s.world, NULL, 0, 0) == 0);
    }
    scene_end(&s);
}

// A fast ball that only passes by, closer than the speculative distance, hits nothing and touches nothing.
static void passing_by_is_no_event(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body block = add_static(&s, box(1, 1, 1), v3(0, 0, 0), UNTURNED, friction(0.6));
    fe_body ball = ask(&s, add_dynamic(&s, sphere(0.25), v3(-5, 1.26, 0), UNTURNED, friction(0.6), WATER),
                       FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_HIT);
    set_velocity(&s, ball, v3(20, 0, 0), v3(0, 0, 0));
    for (int k = 0; k < 60; ++k) {
        run(&s, 1);
        FE_TRUE(told(&s, block, ball, FE_EVENT_ENTER) == 0);
        FE_TRUE(fe_world_get_hit_events(s.world, NULL, 0, 0) == 0);
    }
    FE_NEAR(position(&s, ball).y, 1.26, 1e-5);
    FE_NEAR(velocity(&s, ball).x, 20, 20 * rounding(0));
    scene_end(&s);
}

// dt = 0 tells what touches, and moves nothing.
static void a_step_of_zero_time_updates_events(void **state)
{
    scene s = scene_begin(state);
    fe_body ground = add_ground(&s, friction(0.6)),
            body = add_dynamic(&s, cube(), v3(0, 0.499, 0), UNTURNED, friction(0.6), WATER);
    MUST(fe_world_step(s.world, 0));
    FE_TRUE(told(&s, ground, body, FE_EVENT_ENTER) == 1);
    FE_NEAR(position(&s, body).y, 0.499, 0);
    MUST(fe_world_step(s.world, 0));
    FE_TRUE(events_of(&s).count == 0);
    place(&s, body, v3(0, 5, 0));
    MUST(fe_world_step(s.world, 0));
    FE_TRUE(told(&s, ground, body, FE_EVENT_EXIT) == 1);
    FE_NEAR(length(velocity(&s, body)), 0, 0);
    scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        EVERY_WAY_UP(a_landing_enters_stays_and_exits),
        TEST(without_asking_nothing_is_told),
        TEST(every_end_of_a_touch_sends_one_exit),
        TEST(what_ended_can_enter_again),
        TEST(enters_and_exits_balance_through_a_random_life),
        TEST(a_bounce_within_one_step_enters_and_exits),
        WITH_4_SUBSTEPS(a_bounce_within_one_step_enters_and_exits),
        TEST(a_trigger_sees_dynamic_and_kinematic_bodies_and_pushes_nothing),
        TEST(a_trigger_sees_sleepers_and_lets_them_sleep),
        TEST(triggers_see_triggers_that_move),
        TEST(events_come_in_the_order_of_creation),
        TEST(a_hit_is_told_with_its_speed_impulse_and_point),
        TEST(soft_touches_are_no_hits),
        TEST(passing_by_is_no_event),
        TEST(a_step_of_zero_time_updates_events),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
