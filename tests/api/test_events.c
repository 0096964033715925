// Events and contacts as read after a step; enter and exit balance whatever ends a touch.
#include "api/api_test.h"

enum { MOST = 64 };

typedef struct touch {
    fe_world *world;
    fe_body ground, box;
    fe_shape ground_shape, box_shape;
} touch;

static fe_shape shape_of(const fe_world *world, fe_body body)
{
    fe_shape shape = 0;
    assert_true(fe_body_get_shapes(world, body, &shape, 1) >= 1);
    return shape;
}

// A box on the ground that has entered
static touch touching_box(void)
{
    touch t = {.world = new_world()};
    t.ground = new_ground(t.world);
    t.box = new_box(t.world, 0, 0.5, 0);
    t.ground_shape = shape_of(t.world, t.ground), t.box_shape = shape_of(t.world, t.box);
    fe_pair_event event;
    step(t.world, 1);
    assert_int_equal(fe_world_get_pair_events(t.world, &event, sizeof event, 1), 1);
    assert_int_equal(event.kind, FE_EVENT_ENTER);
    assert_true(event.body_a == t.ground && event.body_b == t.box && event.shape_a == t.ground_shape &&
                event.shape_b == t.box_shape);
    assert_int_equal(event.is_trigger, 0);
    return t;
}

static int32_t count_kind(const fe_world *world, int32_t kind)
{
    fe_pair_event events[MOST];
    int32_t count = fe_world_get_pair_events(world, events, sizeof *events, MOST), found = 0;
    for (int32_t i = 0; i < count && i < MOST; ++i) found += events[i].kind == kind;
    return found;
}

// ---- what ends a touch ---------------------------------------------------------------------------------------------

typedef void change(touch *t);

static void destroy_box(touch *t) { OK(fe_body_destroy(t->world, t->box)); }
static void destroy_ground(touch *t) { OK(fe_body_destroy(t->world, t->ground)); }
static void destroy_shape(touch *t) { OK(fe_shape_destroy(t->world, t->box_shape)); }
static void disable(touch *t) { OK(fe_body_set_enabled(t->world, t->box, 0)); }
static void refilter(touch *t) { OK(fe_shape_set_filter(t->world, t->box_shape, 2, 2, 0)); }
static void refilter_body(touch *t) { OK(fe_body_set_filter(t->world, t->ground, 1, 0, 0)); }
static void ignore(touch *t) { OK(fe_world_ignore_collision(t->world, t->box, t->ground, 1)); }
static void make_static(touch *t) { OK(fe_body_set_type(t->world, t->box, FE_BODY_STATIC)); }
static void teleport(touch *t)
{
    fe_transform there = fe_make_transform(0, 100, 0);
    OK(fe_body_set_transform(t->world, t->box, &there));
}
static void shrink(touch *t)
{
    fe_geometry geometry;
    fe_geometry_sphere(&geometry, 0.1f);
    OK(fe_shape_set_geometry(t->world, t->box_shape, &geometry));
}

static void whatever_ends_a_touch_sends_one_exit(void **state)
{
    (void)state;
    change *const changes[] = {destroy_box,   destroy_ground, destroy_shape, disable,  refilter,
                               refilter_body, ignore,         make_static,   teleport, shrink};
    for (size_t i = 0; i < sizeof changes / sizeof *changes; ++i) {
        for (int32_t asleep = 0; asleep < 2; ++asleep) {
            touch t = touching_box();
            if (asleep) {
                step(t.world, 120);
                assert_int_equal(is_awake(t.world, t.box), 0);
            }
            changes[i](&t);
            fe_pair_event event;
            OK(fe_world_step(t.world, 0.001f));
            assert_int_equal(fe_world_get_pair_events(t.world, &event, sizeof event, 1), 1);
            assert_int_equal(event.kind, FE_EVENT_EXIT);
            assert_true(event.body_a == t.ground && event.body_b == t.box && event.shape_a == t.ground_shape &&
                        event.shape_b == t.box_shape);
            step(t.world, 1);
            assert_int_equal(count_kind(t.world, FE_EVENT_EXIT) + count_kind(t.world, FE_EVENT_ENTER), 0);
            OK(fe_world_destroy(t.world));
        }
    }
}

static void turn_kinematic_and_back(touch *t)
{
    OK(fe_body_set_type(t->world, t->box, FE_BODY_KINEMATIC));
    OK(fe_body_set_type(t->world, t->box, FE_BODY_DYNAMIC));
}
static void off_and_on(touch *t)
{
    OK(fe_body_set_enabled(t->world, t->box, 0));
    OK(fe_body_set_enabled(t->world, t->box, 1));
}
static void same_form(touch *t)
{
    fe_geometry geometry = {.struct_size = sizeof geometry};
    OK(fe_shape_get_geometry(t->world, t->box_shape, &geometry));
    OK(fe_shape_set_geometry(t->world, t->box_shape, &geometry));
}
static void become_trigger(touch *t) { OK(fe_shape_set_trigger(t->world, t->box_shape, 1)); }

static void what_ends_a_touch_and_leaves_it_there_enters_again(void **state)
{
    (void)state;
    change *const changes[] = {turn_kinematic_and_back, off_and_on, same_form, become_trigger};
    for (size_t i = 0; i < sizeof changes / sizeof *changes; ++i) {
        touch t = touching_box();
        changes[i](&t);
        OK(fe_world_step(t.world, 0.001f));
        assert_int_equal(count_kind(t.world, FE_EVENT_EXIT), 1);
        assert_int_equal(count_kind(t.world, FE_EVENT_ENTER), 1);
        OK(fe_world_destroy(t.world));
    }
}

// Random lives: at every moment the enters minus the exits of a pair of shapes are 0 or 1, and 0 in the end.
static void enter_and_exit_balance_in_a_crowd(void **state)
{
    (void)state;
    enum { BODIES = 24, STEPS = 300 };
    fe_world *world = new_world();
    new_ground(world);
    fe_body bodies[BODIES];
    int32_t balance = 0;
    uint32_t random = 99;
    for (int i = 0; i < BODIES; ++i) bodies[i] = new_box(world, i % 5 * 0.9, 0.5 + i / 5 * 1.1, 0);
    for (int s = 0; s < STEPS; ++s) {
        fe_pair_event events[512];
        step(world, 1);
        int32_t count = fe_world_get_pair_events(world, events, sizeof *events, 512);
        FE_WITHIN(count, 0, 512);
        for (int32_t i = 0; i < count; ++i)
            balance += events[i].kind == FE_EVENT_ENTER ? 1 : events[i].kind == FE_EVENT_EXIT ? -1 : 0;
        FE_TRUE(balance >= 0);
        random = random * 1664525u + 1013904223u;
        int k = (int)(random >> 20) % BODIES;
        switch (random >> 28) {
        case 0:
            OK(fe_body_destroy(world, bodies[k])), bodies[k] = new_box(world, k % 5 * 0.9, 6, 0);
            break;
        case 1:
            OK(fe_body_set_enabled(world, bodies[k], (int32_t)(random >> 8 & 1)));
            break;
        case 2:
            OK(fe_body_set_filter(world, bodies[k], 1u << (random >> 9 & 1), 0xFFFFFFFF, 0));
            break;
        case 3:
            OK(fe_body_set_type(world, bodies[k], (int32_t)(random >> 10 & 3) % 3));
            break;
        default:
            break;
        }
    }
    for (int i = 0; i < BODIES; ++i) OK(fe_body_destroy(world, bodies[i]));
    step(world, 1);
    balance += count_kind(world, FE_EVENT_ENTER) - count_kind(world, FE_EVENT_EXIT);
    assert_int_equal(balance, 0);
    OK(fe_world_destroy(world));
}

// ---- arrays of events ----------------------------------------------------------------------------------------------

static void events_come_in_the_order_of_creation(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body boxes[8];
    for (int i = 0; i < 8; ++i) boxes[i] = new_box(world, 3.0 * (7 - i), 0.5, 0);
    OK(fe_body_destroy(world, boxes[2]));
    boxes[2] = new_box(world, 30, 0.5, 0); // an old slot, the newest body
    fe_body ground = new_ground(world);
    step(world, 1);
    struct {
        fe_pair_event event;
        int32_t mine;
    } rows[8];
    memset(rows, 0x44, sizeof rows);
    assert_int_equal(fe_world_get_pair_events(world, &rows[0].event, sizeof *rows, 8), 8);
    const int order[8] = {0, 1, 3, 4, 5, 6, 7, 2};
    for (int i = 0; i < 8; ++i) {
        assert_true(rows[i].event.body_a == boxes[order[i]] && rows[i].event.body_b == ground); // A was created first
        assert_int_equal(rows[i].mine, 0x44444444);
    }
    // a shorter array takes the first, an older client's stride the front of each
    fe_body pairs[4][2] = {{0}};
    assert_int_equal(fe_world_get_pair_events(world, (fe_pair_event *)(void *)pairs, sizeof *pairs, 3), 8);
    for (int i = 0; i < 3; ++i) assert_true(pairs[i][0] == boxes[order[i]] && pairs[i][1] == ground);
    assert_true(pairs[3][0] == 0);
    assert_int_equal(fe_world_get_pair_events(world, NULL, 0, 0), 8);
    OK(fe_world_destroy(world));
}

static void bad_arrays_are_refused(void **state)
{
    (void)state;
    touch t = touching_box();
    fe_pair_event pair[2];
    fe_body_event body[2];
    fe_hit_event hit[2];
    fe_contact contact[2];
    memset(contact, 0x66, sizeof contact);
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_world_get_pair_events(t.world, NULL, 0, 1));
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_world_get_pair_events(t.world, pair, sizeof *pair, -1));
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_world_get_pair_events(t.world, pair, 7, 1));
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_world_get_pair_events(t.world, pair, 4, 1));
    REFUSES(NULL, FE_ERROR_ARGUMENT, fe_world_get_pair_events(NULL, pair, sizeof *pair, 1));
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_world_get_body_events(t.world, NULL, 0, 1));
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_world_get_body_events(t.world, body, 3, 1));
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_world_get_hit_events(t.world, NULL, 0, 1));
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_world_get_hit_events(t.world, hit, sizeof *hit, -7));
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_body_get_contacts(t.world, t.box, NULL, 0, 1));
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_body_get_contacts(t.world, t.box, contact, 6, 1));
    REFUSES(t.world, FE_ERROR_KIND, fe_body_get_contacts(t.world, t.box_shape, contact, sizeof *contact, 1));
    REFUSES(t.world, FE_ERROR_STALE,
            fe_shape_get_contacts(t.world, t.box_shape + NEXT_GENERATION, contact, sizeof *contact, 1));
    REFUSES(t.world, FE_ERROR_ARGUMENT, fe_shape_get_contacts(t.world, t.box_shape, contact, sizeof *contact, -1));
    FE_TRUE(contact[0].point_count == 0x66666666);
    OK(fe_world_destroy(t.world));
}

static void stay_and_hit_are_sent_where_asked_for(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body ground = new_ground(world), quiet = new_box(world, 0, 0.5, 0), chatty = new_box(world, 5, 2, 0);
    OK(fe_shape_set_events(world, shape_of(world, chatty), FE_SHAPE_EVENTS_STAY | FE_SHAPE_EVENTS_HIT));
    OK(fe_shape_set_events(world, shape_of(world, ground), FE_SHAPE_EVENTS_NONE));
    int32_t stays = 0, hits = 0;
    fe_hit_event hit = {0};
    for (int i = 0; i < 60; ++i) {
        fe_pair_event events[MOST];
        step(world, 1);
        int32_t count = fe_world_get_pair_events(world, events, sizeof *events, MOST);
        for (int32_t k = 0; k < count; ++k) {
            stays += events[k].kind == FE_EVENT_STAY;
            FE_TRUE(events[k].kind != FE_EVENT_STAY || events[k].body_b == chatty);
        }
        if (fe_world_get_hit_events(world, &hit, sizeof hit, 1) == 1) hits += 1;
    }
    (void)quiet;
    FE_TRUE(stays > 10);
    assert_int_equal(hits, 1);
    assert_true(hit.body_a == ground && hit.body_b == chatty);
    FE_NEAR(hit.normal.y, 1, 1e-6);
    // it fell 1.5 m: sqrt(2 g h) = 5.42 m/s, to within a step's gravity; m v is what the ground gives, and the weight
    // of a step
    FE_NEAR(hit.speed, 5.42, 9.81 / 60);
    FE_NEAR(hit.impulse, 5420, 1000 * 9.81 / 60 * 2);
    FE_NEAR(hit.point.y, 0, 0.05);
    OK(fe_world_destroy(world));
}

static void sleep_and_wake_are_told(void **state)
{
    (void)state;
    touch t = touching_box();
    fe_body_event event = {0};
    int32_t told = 0;
    for (int i = 0; i < 120; ++i) {
        step(t.world, 1);
        if (fe_world_get_body_events(t.world, &event, sizeof event, 1) == 0) continue;
        told += 1;
        assert_true(event.body == t.box && event.kind == FE_EVENT_SLEEP);
    }
    assert_int_equal(told, 1);
    OK(fe_body_set_awake(t.world, t.box, 1));
    step(t.world, 1);
    assert_int_equal(fe_world_get_body_events(t.world, &event, sizeof event, 1), 1);
    assert_true(event.body == t.box && event.kind == FE_EVENT_WAKE);
    OK(fe_world_destroy(t.world));
}

// ---- triggers ------------------------------------------------------------------------------------------------------

static void a_trigger_reports_and_pushes_nothing(void **state)
{
    (void)state;
    fe_world *world = new_world();
    fe_body gate = new_body(world, FE_BODY_STATIC, 0, 5, 0), ball = new_body(world, FE_BODY_DYNAMIC, 0, 8, 0),
            lift = new_body(world, FE_BODY_KINEMATIC, 0, 2, 0);
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    def.trigger = 1;
    fe_geometry box;
    fe_geometry_box(&box, 1, 1, 1);
    fe_shape trigger;
    OK(fe_shape_create(world, gate, &def, &box, &trigger));
    add_sphere(world, ball, 0.25f);
    add_sphere(world, lift, 0.25f);
    fe_vec3 up = {0, 2, 0};
    OK(fe_body_set_linear_velocity(world, lift, &up));
    int32_t ball_enters = 0, ball_exits = 0, lift_enters = 0;
    for (int i = 0; i < 120; ++i) {
        fe_pair_event events[MOST];
        step(world, 1);
        assert_int_equal(fe_body_get_contacts(world, gate, NULL, 0, 0), 0);
        int32_t count = fe_world_get_pair_events(world, events, sizeof *events, MOST);
        for (int32_t k = 0; k < count; ++k) {
            if (events[k].body_a != gate) continue;
            assert_int_equal(events[k].is_trigger, 1);
            ball_enters += events[k].body_b == ball && events[k].kind == FE_EVENT_ENTER;
            ball_exits += events[k].body_b == ball && events[k].kind == FE_EVENT_EXIT;
            lift_enters += events[k].body_b == lift && events[k].kind == FE_EVENT_ENTER;
        }
    }
    assert_true(ball_enters == 1 && ball_exits == 1);
    assert_int_equal(lift_enters, 1);
    OK(fe_world_destroy(world));
}

// ---- contacts ------------------------------------------------------------------------------------------------------

// A cube of 1000 kg at rest on the ground, held by 4 points: normal impulses of a substep sum to m g h, over the step
// to m g dt. The normal points from the body created first.
static void contacts_carry_the_weight(void **state)
{
    (void)state;
    for (int32_t ground_first = 0; ground_first < 2; ++ground_first) {
        fe_world *world = new_world();
        fe_body ground = ground_first ? new_ground(world) : 0, box = new_box(world, 1e6, 0.5, -3);
        if (!ground_first) ground = new_ground(world);
        step(world, 40);
        fe_contact contact, same;
        assert_int_equal(fe_body_get_contacts(world, box, &contact, sizeof contact, 1), 1);
        assert_int_equal(fe_body_get_contacts(world, ground, &same, sizeof same, 1), 1);
        assert_memory_equal(&contact, &same, sizeof contact);
        assert_true(contact.body_a == (ground_first ? ground : box) && contact.body_b == (ground_first ? box : ground));
        assert_true(contact.shape_a == shape_of(world, contact.body_a) &&
                    contact.shape_b == shape_of(world, contact.body_b));
        FE_NEAR(contact.normal.y, ground_first ? 1 : -1, 1e-6);
        assert_int_equal(contact.point_count, 4);
        double per_substep = 0, total = 0;
        for (int i = 0; i < 4; ++i) {
            per_substep += (double)contact.points[i].normal_impulse;
            total += (double)contact.points[i].total_impulse;
            FE_NEAR(fabs(contact.points[i].point.x - 1e6), 0.5, 0.01);
            FE_NEAR(fabs(contact.points[i].point.z + 3), 0.5, 0.01);
            FE_NEAR(contact.points[i].point.y, 0, 0.001);
            FE_WITHIN(contact.points[i].separation, -0.005, 0.0001);
            for (int k = 0; k < i; ++k) FE_TRUE(contact.points[i].id != contact.points[k].id);
        }
        FE_NEAR(per_substep, 1000 * 9.81 / 480, 0.5);
        FE_NEAR(total, 1000 * 9.81 / 60, 4);
        assert_int_equal(fe_shape_get_contacts(world, contact.shape_b, &same, sizeof same, 1), 1);
        assert_memory_equal(&contact, &same, sizeof contact);
        OK(fe_world_destroy(world));
    }
}

// On a 20 degree slope friction on the box points up the slope, whoever was created first.
static void friction_is_told_as_it_acts_on_b(void **state)
{
    (void)state;
    for (int32_t ground_first = 0; ground_first < 2; ++ground_first) {
        fe_world *world = new_world();
        fe_vec3 gravity = {9.81f * 0.34202014f, -9.81f * 0.93969262f, 0};
        OK(fe_world_set_gravity(world, &gravity));
        if (ground_first) new_ground(world);
        fe_body box = new_box(world, 0, 0.5, 0);
        if (!ground_first) new_ground(world);
        step(world, 25);
        fe_contact contact;
        assert_int_equal(fe_body_get_contacts(world, box, &contact, sizeof contact, 1), 1);
        double on_box = ground_first ? (double)contact.friction_impulse.x : -(double)contact.friction_impulse.x;
        FE_NEAR(on_box, -1000 * 9.81 * 0.34202014 / 480, 0.2);
        OK(fe_world_destroy(world));
    }
}

// A plate on four balls: the contacts of a body are all of them, those of a shape its own.
static void contacts_of_a_shape_are_a_part_of_the_body_s(void **state)
{
    (void)state;
    fe_world *world = new_world();
    new_ground(world);
    fe_body body = new_body(world, FE_BODY_DYNAMIC, 0, 0.5, 0);
    fe_shape feet[4];
    fe_shape_def def;
    fe_shape_def_init(&def, sizeof def);
    fe_geometry sphere;
    fe_geometry_sphere(&sphere, 0.5f);
    for (int i = 0; i < 4; ++i) {
        def.frame.position = fe_make_vec3(i & 1 ? 1.0f : -1.0f, 0, i & 2 ? 1.0f : -1.0f);
        OK(fe_shape_create(world, body, &def, &sphere, &feet[i]));
    }
    step(world, 10);
    fe_contact contacts[4];
    assert_int_equal(fe_body_get_contacts(world, body, contacts, sizeof *contacts, 4), 4);
    for (int i = 0; i < 4; ++i) {
        fe_contact one;
        assert_int_equal(fe_shape_get_contacts(world, feet[i], &one, sizeof one, 1), 1);
        assert_true(one.shape_b == feet[i]);
        FE_NEAR(one.points[0].point.x, i & 1 ? 1 : -1, 0.01);
        FE_NEAR(one.points[0].point.z, i & 2 ? 1 : -1, 0.01);
    }
    OK(fe_world_destroy(world));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whatever_ends_a_touch_sends_one_exit),
        cmocka_unit_test(what_ends_a_touch_and_leaves_it_there_enters_again),
        cmocka_unit_test(enter_and_exit_balance_in_a_crowd),
        cmocka_unit_test(events_come_in_the_order_of_creation),
        cmocka_unit_test(bad_arrays_are_refused),
        cmocka_unit_test(stay_and_hit_are_sent_where_asked_for),
        cmocka_unit_test(sleep_and_wake_are_told),
        cmocka_unit_test(a_trigger_reports_and_pushes_nothing),
        cmocka_unit_test(contacts_carry_the_weight),
        cmocka_unit_test(friction_is_told_as_it_acts_on_b),
        cmocka_unit_test(contacts_of_a_shape_are_a_part_of_the_body_s),
    };
    return cmocka_run_group_tests_name("events", tests, NULL, NULL);
}
