// Fast bodies: nothing goes through anything, no time is lost that matters, and what only passes by is left alone.
//
// With an argument the full number of random cases is run.
#include "scenes/mechanics.h"
#include "scenes/terrain.h"

#include <stdlib.h>
#include <string.h>

static int full;
static int cases(int usual, int all) { return full ? all : SLOW_BUILD ? usual / 10 : usual; }

static fe_geometry fast_form(dice *d, int kind)
{
    if (kind == 0) return sphere(0.1);
    if (kind == 1) return capsule(uniform(d, 0.1, 0.5), 0.1);
    double x = uniform(d, 0.1, 0.4), y = uniform(d, 0.1, 0.4);
    return box(x, y, 0.1);
}

// ---- walls ---------------------------------------------------------------------------------------------------------

// The middle of a wall, its normal, and a body that comes from where the normal points. The wall may go towards it at
// some speed.
typedef struct shot {
    fe_body body, wall;
    vec centre, normal, velocity;
    double speed;
} shot;

// A wall of 60 x 60 m, 1 to 20 cm thick, in any attitude; the body flies at it up to 70 degrees off its normal
static shot add_shot(scene *s, dice *d, vec place, int kind, double speed, double wall_speed)
{
    fe_quat attitude = any_rotation(d);
    shot a = {.centre = place, .normal = rotate(attitude, v3(0, 0, 1)), .speed = speed + wall_speed};
    double half = uniform(d, 0.005, 0.1), restitution = uniform(d, 0, 1), mu = uniform(d, 0, 1);
    a.wall = add_body(s, wall_speed > 0 ? FE_BODY_KINEMATIC : FE_BODY_STATIC, box(30, 30, half), place, attitude,
                      bouncy(mu, restitution), WATER);
    double angle = uniform(d, 0, 70 * DEGREES), around = uniform(d, 0, 2 * PI),
           gone = uniform(d, 0, 1) * (speed + wall_speed) * STEP;
    vec way = rotate(attitude, v3(sin(angle) * cos(around), sin(angle) * sin(around), -cos(angle)));
    vec aim = plus(place, rotate(attitude, v3(uniform(d, -2, 2), uniform(d, -2, 2), 0)));
    vec from = minus(aim, times((0.8 + half) / cos(angle) + gone, way));
    a.body = add_dynamic(s, fast_form(d, kind), from, any_rotation(d), bouncy(mu, restitution), WATER);
    a.velocity = times(wall_speed, a.normal);
    set_velocity(s, a.body, times(speed, way), somewhere(d, 20));
    if (wall_speed > 0) set_velocity(s, a.wall, a.velocity, v3(0, 0, 0));
    return a;
}

// the body's centre is in front of the wall's middle, or went past its edge
static int is_in_front(const scene *s, const shot *a)
{
    vec from = minus(position(s, a->body), position(s, a->wall));
    double height = dot(from, a->normal);
    return height > 0 || length(minus(from, times(height, a->normal))) > 29;
}

static void shoot(void **state, int kind, int moving)
{
    enum { STEPS = 15 };
    int count = cases(250, 1000);
    dice d = {(uint64_t)(1 + kind + 3 * moving)};
    scene s = scene_begin(state);
    shot *shots = calloc((size_t)count, sizeof *shots);
    set_gravity(&s, v3(0, 0, 0));
    for (int i = 0; i < count; ++i) {
        double speed = pow(10, uniform(&d, 1, 3)), part = moving ? uniform(&d, 0.1, 1) : 0;
        shots[i] = add_shot(&s, &d, v3(1000.0 * i, 0, 0), kind, (1 - part) * speed, part * speed);
    }
    for (int step = 0; step < STEPS; ++step) {
        run(&s, 1);
        for (int i = 0; i < count; ++i) {
            if (!is_in_front(&s, shots + i)) print_error("shot %d at %g m/s, step %d\n", i, shots[i].speed, step);
            FE_TRUE(is_in_front(&s, shots + i));
        }
    }
    free(shots);
    scene_end(&s);
}

static void spheres_stay_before_walls(void **state) { shoot(state, 0, 0); }
static void capsules_stay_before_walls(void **state) { shoot(state, 1, 0); }
static void boxes_stay_before_walls(void **state) { shoot(state, 2, 0); }
static void spheres_stay_before_walls_that_move(void **state) { shoot(state, 0, 1); }
static void capsules_stay_before_walls_that_move(void **state) { shoot(state, 1, 1); }
static void boxes_stay_before_walls_that_move(void **state) { shoot(state, 2, 1); }

// A sphere, a capsule or a box of half a metre that comes down with 180 m/s on a wall 20 cm thick, spinning: three
// metres a step
static void a_thin_wall_stops_what_tumbles(void **state)
{
    for (int k = 0; k < 6; ++k) {
        const fe_geometry forms[3] = {sphere(0.1), capsule(0.3, 0.1), box(0.4, 0.1, 0.1)};
        scene s = scene_begin(state);
        add_static(&s, box(10, 10, 0.1), v3(0, 0, 0), UNTURNED, friction(0.6));
        fe_body body = add_dynamic(&s, forms[k % 3], v3(0, 0, 20), UNTURNED, friction(0.6), WATER);
        set_velocity(&s, body, v3(0, 0, -180), v3(20, k < 3 ? 5 : -5, 0));
        for (int step = 0; step < 30; ++step) {
            run(&s, 1);
            FE_WITHIN(position(&s, body).z, 0.1, 20);
        }
        scene_end(&s);
    }
}

// A stick of 4 m falls with 100 m/s, spinning, across a wall 25 cm thin and a metre high: its middle is never in the
// wall, and it does not change sides below the top.
static void a_spinning_stick_stays_above_a_wall(void **state)
{
    enum { WALL_STEPS = 60 };
    dice d = {46};
    for (int k = 0; k < cases(40, 100); ++k) {
        scene s = scene_begin(state);
        add_static(&s, box(0.125, 0.5, 10), v3(0, 0, 0), UNTURNED, friction(0.6));
        fe_body stick = add_dynamic(&s, box(2, 0.1, 0.1), v3(0, 20, 0), UNTURNED, friction(0.6), WATER);
        set_velocity(&s, stick, v3(0, -100, 0), somewhere(&d, 50));
        vec before = position(&s, stick);
        for (int step = 0; step < WALL_STEPS; ++step) {
            run(&s, 1);
            vec now = position(&s, stick);
            int beside = fabs(now.y) < 0.5 && fabs(now.z) < 10;
            if (beside && (fabs(now.x) < 0.125 || (fabs(before.y) < 0.5 && now.x * before.x < 0)))
                print_error("stick %d, step %d\n", k, step);
            FE_TRUE(!(beside && fabs(now.x) < 0.125));
            FE_TRUE(!(beside && fabs(before.y) < 0.5 && now.x * before.x < 0));
            before = now;
        }
        scene_end(&s);
    }
}

// Ten cubes before a wall and a ball of ten times their density at 500 m/s: bullet and cubes stay on their side.
static void a_bullet_hits_a_stack_and_all_stay_before_the_wall(void **state)
{
    enum { CUBES = 10 };
    scene s = scene_begin(state);
    fe_body bodies[CUBES + 1];
    add_ground(&s, friction(0.6));
    add_static(&s, box(0.1, 20, 20), v3(-1, 0, 0), UNTURNED, friction(0.6));
    for (int k = 0; k < CUBES; ++k)
        bodies[k] = add_dynamic(&s, box(0.5, 0.5, 0.5), v3(0, 0.55 + 1.1 * k, 0), UNTURNED, friction(0.6), WATER);
    run(&s, 60);
    bodies[CUBES] = add_dynamic(&s, sphere(0.25), v3(20, 4, 0), UNTURNED, friction(0.6), 10 * WATER);
    MUST(fe_body_set_bullet(s.world, bodies[CUBES], 1));
    set_velocity(&s, bodies[CUBES], v3(-500, 0, 0), v3(0, 0, 0));
    for (int step = 0; step < 60; ++step) {
        run(&s, 1);
        for (int k = 0; k <= CUBES; ++k) {
            vec p = position(&s, bodies[k]);
            FE_TRUE(p.x > -1 || p.y > 20 || fabs(p.z) > 20);
        }
    }
    scene_end(&s);
}

// A kinematic blade of 2 m turns by 80 degrees in a step and carries a resting ball before it. When the step begins,
// the nearest point of the blade is one by the hub, which hardly moves: the contact there holds nothing off.
static void a_blade_takes_along_what_rests(void **state)
{
    const double from = -1.1, to = 0.3;
    for (int k = 0; k < 4; ++k) {
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        fe_body blade = add_body(&s, FE_BODY_KINEMATIC, box(1, 0.02, 0.3), v3(0, 0, 0), turned(v3(0, 0, 1), from),
                                 friction(0), WATER);
        const fe_frame hub = {{1, 0, 0}, {0, 0, 0, 1}};
        fe_shape shape;
        MUST(fe_body_get_shapes(s.world, blade, &shape, 1));
        MUST(fe_shape_set_frame(s.world, shape, &hub));
        fe_body ball = add_dynamic(&s, sphere(0.1), v3(0.5 + 0.1 * k, 0, 0), UNTURNED, friction(0), WATER);
        set_velocity(&s, blade, v3(0, 0, 0), v3(0, 0, (to - from) / STEP));
        run(&s, 1);
        FE_TRUE(cross(axis_of(&s, blade, v3(1, 0, 0)), position(&s, ball)).z > 0);
        scene_end(&s);
    }
}

// A resting ball before a thin wall is struck by a heavy one at 20 m/s: in the same step it goes more than three radii,
// and no contact with the wall was found for a ball at rest.
static void a_struck_ball_stays_before_the_wall(void **state)
{
    for (int k = 0; k < 8; ++k) {
        double x = 0.12 + 0.02 * k;
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        add_static(&s, box(0.01, 5, 5), v3(0, 0, 0), UNTURNED, friction(0));
        fe_body ball = add_dynamic(&s, sphere(0.1), v3(x, 0, 0), UNTURNED, friction(0), WATER);
        fe_body hammer = add_dynamic(&s, sphere(0.3), v3(x + 0.45, 0, 0), UNTURNED, friction(0), 10 * WATER);
        set_velocity(&s, hammer, v3(-20, 0, 0), v3(0, 0, 0));
        for (int step = 0; step < 4; ++step) {
            run(&s, 1);
            FE_WITHIN(position(&s, ball).x, 0.01, 1);
        }
        scene_end(&s);
    }
}

static double hills(double x, double z) { return 0.5 * sin(0.9 * x) * sin(0.7 * z); }

// Height of the surface: each cell's diagonal joins (row, column) and (row + 1, column + 1)
static double hills_below(double x, double z, double cell)
{
    double c = floor(x / cell), r = floor(z / cell), u = x / cell - c, v = z / cell - r;
    double h00 = hills(c * cell, r * cell), h11 = hills((c + 1) * cell, (r + 1) * cell);
    double other = v >= u ? hills(c * cell, (r + 1) * cell) : hills((c + 1) * cell, r * cell);
    return v >= u ? h00 + v * (other - h00) + u * (h11 - other) : h00 + u * (other - h00) + v * (h11 - other);
}

typedef struct fall {
    vec from, velocity; // m, m/s
} fall;

// The k-th field, 200 m from the last, and a fall on it: at 10 m/s to 10^fastest, up to 60 degrees off the vertical,
// from `clear` above the ground and up to a step's way more
static fall add_field_and_fall(scene *s, dice *d, int k, fe_asset asset, double mu, double fastest, double clear)
{
    vec place = v3(200.0 * k, 0, 0);
    place_field(s, asset, plus(place, v3(-50, 0, -50)), UNTURNED, friction(mu));
    double speed = pow(10, uniform(d, 1, fastest)), angle = uniform(d, 0, 60) * DEGREES, around = uniform(d, 0, 2 * PI);
    vec way = v3(sin(angle) * cos(around), -cos(angle), sin(angle) * sin(around));
    double back = (clear + uniform(d, 0, 1) * speed * STEP) / cos(angle);
    return (fall){minus(place, times(back, way)), times(speed, way)};
}

// Down on hills of 1 m cells, which have no thickness at all, at 10 to 1000 m/s and up to 60 degrees off the vertical
static void fast_bodies_stay_above_hills(void **state)
{
    int count = cases(150, 1000);
    dice d = {10};
    scene s = scene_begin(state);
    fe_body *bodies = calloc((size_t)count, sizeof *bodies);
    set_gravity(&s, v3(0, 0, 0));
    fe_asset asset = make_field(&s, 100, 1, -50, -50, hills);
    for (int k = 0; k < count; ++k) {
        fall f = add_field_and_fall(&s, &d, k, asset, 0.5, 3, 1.2);
        bodies[k] = add_dynamic(&s, fast_form(&d, k % 3), f.from, any_rotation(&d), friction(0.5), WATER);
        set_velocity(&s, bodies[k], f.velocity, somewhere(&d, 20));
    }
    for (int step = 0; step < 20; ++step) {
        run(&s, 1);
        for (int k = 0; k < count; ++k) {
            vec p = minus(position(&s, bodies[k]), v3(200.0 * k, 0, 0));
            if (fabs(p.x) > 49 || fabs(p.z) > 49) continue;
            if (!(p.y > hills_below(p.x, p.z, 1))) print_error("body %d, step %d\n", k, step);
            FE_TRUE(p.y > hills_below(p.x, p.z, 1));
        }
    }
    free(bodies);
    scene_end(&s);
}

// Bullets do not pass through thin moving plates; without gravity or walls nothing else happens to them.
static void bullets_stay_before_moving_bodies(void **state)
{
    int count = cases(200, 1000);
    dice d = {7};
    scene s = scene_begin(state);
    fe_body *bullets = calloc((size_t)count, sizeof *bullets), *plates = calloc((size_t)count, sizeof *plates);
    set_gravity(&s, v3(0, 0, 0));
    for (int k = 0; k < count; ++k) {
        double speed = pow(10, uniform(&d, 1, 3));
        plates[k] = add_dynamic(&s, box(0.05, 5, 5), v3(0, 100.0 * k, 0), UNTURNED, friction(0.5), WATER);
        vec from = v3(0.8 + uniform(&d, 0, 1) * speed * STEP, 100.0 * k, 0);
        bullets[k] = add_dynamic(&s, fast_form(&d, k % 3), from, any_rotation(&d), friction(0.5), WATER);
        MUST(fe_body_set_bullet(s.world, bullets[k], 1));
        set_velocity(&s, bullets[k], v3(-speed, 0, 0), somewhere(&d, 20));
    }
    for (int step = 0; step < 15; ++step) {
        run(&s, 1);
        for (int k = 0; k < count; ++k) {
            vec from = minus(position(&s, bullets[k]), position(&s, plates[k])),
                normal = axis_of(&s, plates[k], v3(1, 0, 0));
            double height = dot(from, normal);
            FE_TRUE(height > 0 || length(minus(from, times(height, normal))) > 5);
        }
    }
    free(bullets);
    free(plates);
    scene_end(&s);
}

// ---- rooms ---------------------------------------------------------------------------------------------------------
static void add_room(scene *s, double half, double thick, fe_material material)
{
    for (int k = 0; k < 6; ++k) {
        double side = k % 2 ? 1 : -1, out = side * (half + thick), w = half + 2 * thick;
        if (k / 2 == 0) add_static(s, box(thick, w, w), v3(out, 0, 0), UNTURNED, material);
        if (k / 2 == 1) add_static(s, box(w, thick, w), v3(0, out, 0), UNTURNED, material);
        if (k / 2 == 2) add_static(s, box(w, w, thick), v3(0, 0, out), UNTURNED, material);
    }
}

static int is_inside(const scene *s, fe_body body, double half)
{
    vec p = position(s, body);
    return fabs(p.x) < half && fabs(p.y) < half && fabs(p.z) < half;
}

// Elastic balls fly through a room of 10 m at up to 300 m/s, half of it a step, into its edges and corners too: all
// stay in, and keep their energy within 2 %.
static void balls_in_a_room_keep_their_energy(void **state)
{
    enum { MOST = 200 };
    int count = cases(50, MOST);
    dice d = {44};
    for (int k = 0; k < count; ++k) {
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        add_room(&s, 5, 0.05, bouncy(0, 1));
        fe_body ball = add_dynamic(&s, sphere(0.2), somewhere(&d, 4), UNTURNED, bouncy(0, 1), WATER);
        vec v = somewhere(&d, 1);
        set_velocity(&s, ball, times(uniform(&d, 50, 300) / length(v), v), v3(0, 0, 0));
        double begin = totals_of(&s, &ball, 1).energy;
        for (int step = 0; step < 120; ++step) {
            run(&s, 1);
            FE_TRUE(is_inside(&s, ball, 5));
            FE_WITHIN(totals_of(&s, &ball, 1).energy / begin, 0.98, 1 + ENERGY_GAIN);
        }
        scene_end(&s);
    }
}

// At the floor of the room already, and on the way past its edge before the wall is reached: floor first, then wall,
// each turns the ball straight back.
static void one_wall_of_a_corner_follows_the_other(void **state)
{
    dice d = {12};
    for (int k = 0; k < cases(200, 1000); ++k) {
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        add_room(&s, 5, 0.05, bouncy(0, 1));
        vec v = v3(uniform(&d, -150, 150), uniform(&d, -150, -50), uniform(&d, 100, 200));
        fe_body ball = add_dynamic(&s, sphere(0.2), v3(0, -4.8 + uniform(&d, 0, 0.002), uniform(&d, 3.5, 4.5)),
                                   UNTURNED, bouncy(0, 1), WATER);
        set_velocity(&s, ball, v, v3(0, 0, 0));
        run(&s, 3);
        vec now = velocity(&s, ball);
        FE_NEAR(fabs(now.x), fabs(v.x), 0.01 * length(v));
        FE_NEAR(now.y, -v.y, 0.01 * length(v));
        FE_NEAR(fabs(now.z), v.z, 0.01 * length(v));
        scene_end(&s);
    }
}

// 60 bodies of every kind at 100 m/s in a room of thin walls: none gets out, and the energy is never above what it was.
static void a_crowd_at_high_speed_stays_in_its_room(void **state)
{
    enum { CROWD = 60 };
    dice d = {45};
    scene s = scene_begin(state);
    fe_body bodies[CROWD];
    add_room(&s, 6, 0.02, bouncy(0.3, 0.3));
    for (int k = 0; k < CROWD; ++k) {
        vec place = v3(-5 + 2.5 * (k % 5), -5 + 2.5 * (k / 5 % 5), -4 + 3 * (k / 25));
        bodies[k] = add_dynamic(&s, fast_form(&d, k % 3), place, any_rotation(&d), bouncy(0.3, 0.3), WATER);
        vec v = somewhere(&d, 1);
        set_velocity(&s, bodies[k], times(100 / length(v), v), somewhere(&d, 30));
    }
    totals begin = totals_of(&s, bodies, CROWD);
    for (int step = 0; step < cases(240, 600); ++step) {
        run(&s, 1);
        FE_WITHIN(totals_of(&s, bodies, CROWD).energy, -1e30, begin.energy + ENERGY_GAIN * begin.kinetic);
        for (int k = 0; k < CROWD; ++k) FE_TRUE(is_inside(&s, bodies[k], 6));
    }
    scene_end(&s);
}

// A ball at 100 m/s against a wall: elastic, it is on its way back in the same or the next step with 98 % of its energy
// and more.
static void an_elastic_impact_loses_no_time(void **state)
{
    dice d = {3};
    for (int k = 0; k < cases(50, 400); ++k) {
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        add_static(&s, box(0.05, 10, 10), v3(0, 0, 0), UNTURNED, bouncy(0, 1));
        double way = uniform(&d, 0, 1) * 100 * STEP;
        fe_body ball = add_dynamic(&s, sphere(0.1), v3(0.15 + way, 0, 0), UNTURNED, bouncy(0, 1), WATER);
        set_velocity(&s, ball, v3(-100, 0, 0), v3(0, 0, 0));
        run(&s, 2);
        FE_WITHIN(velocity(&s, ball).x, 99, 100 * (1 + ENERGY_GAIN));
        // it turns within a substep of the wall; of the first two steps' way no more than the rest of one is lost
        double most = 2 * 100 * STEP - way, turn = 2 * 100 * s.h;
        FE_WITHIN(position(&s, ball).x, 0.15, 0.15 + most + turn);
        run(&s, 1);
        FE_WITHIN(position(&s, ball).x, 0.15 + 100 * STEP, 0.15 + most + 100 * STEP + turn);
        scene_end(&s);
    }
}

// A ball falls with 150 m/s on a thin floor: height and speed together never have more energy than before.
static void gravity_gives_no_more_than_the_way_gone(void **state)
{
    dice d = {9};
    for (int k = 0; k < cases(50, 400); ++k) {
        scene s = scene_begin(state);
        add_static(&s, box(10, 0.02, 10), v3(0, -0.02, 0), UNTURNED, bouncy(0, 1));
        fe_body ball = add_dynamic(&s, k % 2 ? box(0.1, 0.1, 0.1) : sphere(0.1), v3(0, 6 + uniform(&d, 0, 3), 0),
                                   UNTURNED, bouncy(0, 1), WATER);
        set_velocity(&s, ball, v3(0, -150, 0), v3(0, 0, 0));
        double begin = totals_of(&s, &ball, 1).energy;
        for (int step = 0; step < 20; ++step) {
            run(&s, 1);
            FE_WITHIN(totals_of(&s, &ball, 1).energy / begin, 0.98, 1 + ENERGY_GAIN);
        }
        scene_end(&s);
    }
}

// Bodies that tumble into a wall off its normal, with any friction and restitution: what hits something that stands has
// no more energy after it. Free flight of what spins by a radian a substep may gain a thousandth.
static void a_wall_gives_no_energy(void **state)
{
    dice d = {13};
    for (int k = 0; k < cases(150, 1000); ++k) {
        scene s = scene_begin(state);
        double speed = pow(10, uniform(&d, 1.5, 3)), mu = uniform(&d, 0, 1), e = uniform(&d, 0, 1);
        set_gravity(&s, v3(0, 0, 0));
        add_static(&s, box(0.02, 100, 100), v3(0, 0, 0), UNTURNED, bouncy(mu, e));
        vec from = v3(0.8 + uniform(&d, 0, 1) * speed * STEP, 0, 0);
        fe_body body = add_dynamic(&s, fast_form(&d, k % 3), from, any_rotation(&d), bouncy(mu, e), WATER);
        set_velocity(&s, body, v3(-speed, uniform(&d, -1, 1) * speed, 0), somewhere(&d, 30));
        double begin = totals_of(&s, &body, 1).kinetic;
        for (int step = 0; step < 12; ++step) {
            run(&s, 1);
            FE_WITHIN(totals_of(&s, &body, 1).kinetic / begin, 0, 1.001);
        }
        scene_end(&s);
    }
}

static double ridges(double x, double z)
{
    (void)z;
    return fabs(x - 2 * floor(x / 2) - 1);
}

// Rough sticks without bounce fall across ridges of 45 degrees at 10 to 300 m/s: what meets the ground at both ends at
// once has no more energy after any step, as before a wall.
static void ridges_give_no_energy(void **state)
{
    enum { STICKS = 20 };
    dice d = {10};
    scene s = scene_begin(state);
    fe_body sticks[STICKS];
    double before[STICKS];
    set_gravity(&s, v3(0, 0, 0));
    fe_asset asset = make_field(&s, 100, 1, -50, -50, ridges);
    for (int k = 0; k < STICKS; ++k) {
        fall f = add_field_and_fall(&s, &d, k, asset, 0.8, 2.5, 1.5);
        sticks[k] = add_dynamic(&s, box(1, 0.1, 0.1), f.from, any_rotation(&d), friction(0.8), WATER);
        set_velocity(&s, sticks[k], f.velocity, somewhere(&d, 5));
        before[k] = totals_of(&s, sticks + k, 1).kinetic;
    }
    for (int step = 0; step < 20; ++step) {
        run(&s, 1);
        for (int k = 0; k < STICKS; ++k) {
            double now = totals_of(&s, sticks + k, 1).kinetic;
            FE_WITHIN(now / before[k], 0, 1.001);
            before[k] = now;
        }
    }
    scene_end(&s);
}

// Without friction a ball that grazes a thin wall at 5 degrees and 200 m/s goes on along it at the same speed: of the
// way along the wall nothing is lost, in no step.
static void a_glancing_ball_goes_on_along_the_wall(void **state)
{
    dice d = {5};
    for (int k = 0; k < cases(50, 400); ++k) {
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        add_static(&s, box(100, 0.02, 10), v3(0, -0.02, 0), UNTURNED, friction(0));
        fe_body ball =
            add_dynamic(&s, sphere(0.1), v3(-90, 0.1 + uniform(&d, 0, 0.5), 0), UNTURNED, friction(0), WATER);
        double vx = 200 * cos(5 * DEGREES), vy = -200 * sin(5 * DEGREES);
        set_velocity(&s, ball, v3(vx, vy, 0), v3(0, 0, 0));
        double x = -90;
        for (int step = 1; step <= 30; ++step) {
            run(&s, 1);
            FE_NEAR(position(&s, ball).x, x += vx * STEP, 1e-3 * vx * STEP);
            FE_WITHIN(position(&s, ball).y, 0.1 - LINEAR_SLOP, 1);
        }
        scene_end(&s);
    }
}

// Into the wedge of two walls at any speed, and into a corner of three: it comes to rest or back, never out.
static void wedges_hold(void **state)
{
    dice d = {6};
    for (int k = 0; k < cases(100, 1000); ++k) {
        scene s = scene_begin(state);
        double angle = uniform(&d, 20, 80) * DEGREES, speed = pow(10, uniform(&d, 1, 3));
        set_gravity(&s, v3(0, 0, 0));
        for (int side = -1; side <= 1; side += 2) {
            vec along = v3(cos(angle), side * sin(angle), 0), out = v3(sin(angle), -side * cos(angle), 0);
            add_static(&s, box(30, 0.02, 30), minus(times(30, along), times(0.02, out)),
                       turned(v3(0, 0, 1), side * angle), bouncy(0.3, 0.3));
        }
        fe_body body = add_dynamic(&s, fast_form(&d, k % 3), v3(8, 0, 0), any_rotation(&d), bouncy(0.3, 0.3), WATER);
        set_velocity(&s, body, times(speed, v3(-1, uniform(&d, -0.2, 0.2), uniform(&d, -0.1, 0.1))), somewhere(&d, 10));
        for (int step = 0; step < 30; ++step) {
            run(&s, 1);
            vec p = position(&s, body);
            if (p.x > 25 || fabs(p.z) > 28) break;
            if (!(p.x > 0 && fabs(p.y) < p.x * tan(angle))) print_error("case %d, step %d, %g m/s\n", k, step, speed);
            FE_TRUE(p.x > 0 && fabs(p.y) < p.x * tan(angle));
        }
        scene_end(&s);
    }
}

// ---- what only passes by -------------------------------------------------------------------------------------------

static void pass_by(const scene *s, const scene *bare, fe_body body, fe_body same)
{
    fe_transform a = body_transform(s->world, body), b = body_transform(bare->world, same);
    fe_vec3 v = body_linear_velocity(s->world, body), w = body_linear_velocity(bare->world, same);
    FE_TRUE(memcmp(&a, &b, sizeof a) == 0 && memcmp(&v, &w, sizeof v) == 0);
}

// Sticks that spin as fast as 100 rad/s past a wall, their tips 1 cm and more before it, and bodies that fly along it:
// bit for bit as if there were none.
static void what_passes_by_is_left_alone(void **state)
{
    dice d = {8};
    for (int k = 0; k < cases(60, 400); ++k) {
        scene s = scene_begin(state), bare = scene_begin(state);
        fe_geometry form = k % 2 ? box(1, 0.05, 0.05) : capsule(0.9, 0.05);
        double reach = k % 2 ? sqrt(1 + 2 * 0.05 * 0.05) : 0.95, speed = uniform(&d, 0, 200),
               spinning = uniform(&d, 10, 100);
        fe_quat attitude = any_rotation(&d);
        vec w = somewhere(&d, 1), place = v3(-50, reach + 0.06 + uniform(&d, 0, 0.1), 0);
        fe_body bodies[2];
        scene *scenes[2] = {&s, &bare};
        for (int i = 0; i < 2; ++i) {
            set_gravity(scenes[i], v3(0, 0, 0));
            if (i == 0) add_static(&s, box(100, 0.02, 100), v3(0, -0.02, 0), UNTURNED, friction(0.5));
            bodies[i] = add_dynamic(scenes[i], form, place, attitude, friction(0.5), WATER);
            set_velocity(scenes[i], bodies[i], v3(speed, 0, 0), times(spinning / length(w), w));
        }
        for (int step = 0; step < 25; ++step) {
            run(&s, 1);
            run(&bare, 1);
            pass_by(&s, &bare, bodies[0], bodies[1]);
        }
        scene_end(&s);
        scene_end(&bare);
    }
}

// Within one step a ball comes down at 45 degrees beside a small roof, bounces on the ground under it, and comes up on
// its other side. The straight line from where the step begins to where it ends cuts the roof; the way does not.
static void a_bounce_below_a_roof_is_no_hit(void **state)
{
    scene s = scene_begin(state), bare = scene_begin(state);
    scene *scenes[2] = {&s, &bare};
    fe_body balls[2];
    double v = 240, leg = v * STEP / 2 / sqrt(2); // m, along x and y until the bounce
    for (int i = 0; i < 2; ++i) {
        set_gravity(scenes[i], v3(0, 0, 0));
        add_ground(scenes[i], bouncy(0, 1));
        if (i == 0) add_static(scenes[i], box(0.3, 0.01, 5), v3(0, leg + 0.4, 0), UNTURNED, bouncy(0, 1));
        balls[i] = add_dynamic(scenes[i], sphere(0.1), v3(-leg, 0.1 + leg, 0), UNTURNED, bouncy(0, 1), WATER);
        set_velocity(scenes[i], balls[i], v3(v * sqrt(0.5), -v * sqrt(0.5), 0), v3(0, 0, 0));
        run(scenes[i], 1);
    }
    vec end = position(&s, balls[0]);
    double height = 0.1 + leg + (end.y - 0.1 - leg) * leg / (end.x + leg); // of the straight line at the roof's middle
    FE_NEAR(height, leg + 0.4, 0.1);
    pass_by(&s, &bare, balls[0], balls[1]);
    scene_end(&s);
    scene_end(&bare);
}

// ---- triggers and events -------------------------------------------------------------------------------------------
static int told(const scene *s, fe_body a, fe_body b, int kind)
{
    fe_pair_event events[64];
    int32_t count = fe_world_get_pair_events(s->world, events, sizeof *events, 64), found = 0;
    FE_WITHIN(count, 0, 64);
    for (int32_t i = 0; i < count; ++i) {
        int both = (events[i].body_a == a && events[i].body_b == b) || (events[i].body_a == b && events[i].body_b == a);
        found += both && events[i].kind == kind;
    }
    return found;
}

// A ball at 10 to 300 m/s through a trigger 5 cm thin, standing or moving, or a trigger that flies over a resting ball:
// one enter, then one exit.
static void thin_triggers_tell_who_went_through(void **state)
{
    dice d = {53};
    for (int k = 0; k < cases(60, 300); ++k) {
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        double speed = uniform(&d, 10, 300), part = k % 3 == 0 ? 0 : k % 3 == 1 ? 1 : 0.5;
        fe_body zone = add_body(&s, part > 0 ? FE_BODY_KINEMATIC : FE_BODY_STATIC, box(0.025, 5, 5), v3(0, 0, 0),
                                UNTURNED, friction(0), WATER);
        fe_shape shape;
        MUST(fe_body_get_shapes(s.world, zone, &shape, 1));
        MUST(fe_shape_set_trigger(s.world, shape, 1));
        MUST(fe_shape_set_events(s.world, shape, FE_SHAPE_EVENTS_TOUCH));
        fe_body ball =
            add_dynamic(&s, sphere(0.25), v3(2 + uniform(&d, 0, 1) * speed * STEP, 0, 0), UNTURNED, friction(0), WATER);
        set_velocity(&s, ball, v3(-(1 - part) * speed, 0, 0), v3(0, 0, 0));
        if (part > 0) set_velocity(&s, zone, v3(part * speed, 0, 0), v3(0, 0, 0));
        int enters = 0, exits = 0;
        for (int step = 0; step < 60; ++step) {
            run(&s, 1);
            enters += told(&s, zone, ball, FE_EVENT_ENTER);
            FE_TRUE(exits <= enters);
            exits += told(&s, zone, ball, FE_EVENT_EXIT);
        }
        if (enters != 1 || exits != 1) print_error("case %d at %g m/s: %d enters, %d exits\n", k, speed, enters, exits);
        FE_TRUE(enters == 1 && exits == 1);
        scene_end(&s);
    }
}

static fe_body add_trigger(scene *s, fe_geometry form, vec at, fe_quat rotation)
{
    fe_body zone = add_static(s, form, at, rotation, friction(0));
    fe_shape shape;
    MUST(fe_body_get_shapes(s->world, zone, &shape, 1));
    MUST(fe_shape_set_trigger(s->world, shape, 1));
    MUST(fe_shape_set_events(s->world, shape, FE_SHAPE_EVENTS_TOUCH));
    return zone;
}

// Six radii a step through a thin trigger that stands askew: 0.3 m before it, then 0.3 m behind. The ball stays in the
// trigger's bounds for long after: the exit comes in the next step all the same.
static void what_was_crossed_is_left_in_the_next_step(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    fe_body zone = add_trigger(&s, box(0.01, 5, 5), v3(0, 0, 0), turned(v3(0, 0, 1), 45 * DEGREES));
    fe_body ball = add_dynamic(&s, sphere(0.1), v3(1.5, 0, 0), UNTURNED, friction(0), WATER);
    set_velocity(&s, ball, v3(-0.6 / STEP, 0, 0), v3(0, 0, 0));
    for (int step = 0; step < 12; ++step) {
        run(&s, 1);
        FE_NEAR(told(&s, zone, ball, FE_EVENT_ENTER), step == 2, 0);
        FE_NEAR(told(&s, zone, ball, FE_EVENT_EXIT), step == 3, 0);
    }
    scene_end(&s);
}

// Three and a half radii a step: within one the ball comes down through a thin trigger, bounces on the ground, and is
// up again. It ends as high as it began, 5 cm clear of the trigger, which only its path has met.
static void a_bounce_through_a_trigger_is_seen(void **state)
{
    scene s = scene_begin(state);
    set_gravity(&s, v3(0, 0, 0));
    add_ground(&s, bouncy(0, 1));
    fe_body zone = add_trigger(&s, box(5, 0.005, 5), v3(0, 0.095, 0), UNTURNED);
    fe_body ball = add_dynamic(&s, sphere(0.1), v3(0, 0.25, 0), UNTURNED, bouncy(0, 1), WATER);
    set_velocity(&s, ball, v3(0.19 / STEP, -0.3 / STEP, 0), v3(0, 0, 0));
    run(&s, 1);
    FE_WITHIN(position(&s, ball).y, 0.21, 0.3);
    FE_NEAR(told(&s, zone, ball, FE_EVENT_ENTER), 1, 0);
    scene_end(&s);
}

// What continuous collision stops, tells its impact: an enter, and a first hit with the speed of what touches. A ball
// does not turn: with the speed it came with.
static void a_stopped_body_tells_its_impact(void **state)
{
    dice d = {60};
    for (int k = 0; k < cases(60, 300); ++k) {
        scene s = scene_begin(state);
        set_gravity(&s, v3(0, 0, 0));
        double speed = pow(10, uniform(&d, 1.5, 3));
        fe_body wall = add_static(&s, box(0.02, 10, 10), v3(0, 0, 0), UNTURNED, friction(0.3));
        fe_body ball = add_dynamic(&s, fast_form(&d, k % 3), v3(0.8 + uniform(&d, 0, 1) * speed * STEP, 0, 0),
                                   any_rotation(&d), friction(0.3), WATER);
        fe_shape shape;
        MUST(fe_body_get_shapes(s.world, ball, &shape, 1));
        MUST(fe_shape_set_events(s.world, shape, FE_SHAPE_EVENTS_TOUCH | FE_SHAPE_EVENTS_HIT));
        set_velocity(&s, ball, v3(-speed, 0, 0), v3(0, 0, 0));
        int enters = 0;
        double first = 0;
        for (int step = 0; step < 10; ++step) {
            fe_hit_event hits[8];
            run(&s, 1);
            enters += told(&s, wall, ball, FE_EVENT_ENTER);
            int32_t count = fe_world_get_hit_events(s.world, hits, sizeof *hits, 8);
            if (count > 0 && first == 0) first = (double)hits[0].speed;
        }
        FE_WITHIN(enters, 1, 10);
        FE_WITHIN(first / speed, 1 - 1e-5, 1 + 1e-5);
        scene_end(&s);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        TEST(spheres_stay_before_walls),
        WITH_4_SUBSTEPS(spheres_stay_before_walls),
        TEST(capsules_stay_before_walls),
        WITH_4_SUBSTEPS(capsules_stay_before_walls),
        TEST(boxes_stay_before_walls),
        WITH_4_SUBSTEPS(boxes_stay_before_walls),
        TEST(spheres_stay_before_walls_that_move),
        TEST(capsules_stay_before_walls_that_move),
        TEST(boxes_stay_before_walls_that_move),
        EVERY_WAY_UP(a_thin_wall_stops_what_tumbles),
        TEST(a_spinning_stick_stays_above_a_wall),
        WITH_4_SUBSTEPS(a_spinning_stick_stays_above_a_wall),
        TEST(a_bullet_hits_a_stack_and_all_stay_before_the_wall),
        WITH_4_SUBSTEPS(a_bullet_hits_a_stack_and_all_stay_before_the_wall),
        TEST(bullets_stay_before_moving_bodies),
        EVERY_WAY_UP(a_blade_takes_along_what_rests),
        EVERY_WAY_UP(a_struck_ball_stays_before_the_wall),
        TEST(fast_bodies_stay_above_hills),
        WITH_4_SUBSTEPS(fast_bodies_stay_above_hills),
        TEST(balls_in_a_room_keep_their_energy),
        TEST(one_wall_of_a_corner_follows_the_other),
        TEST(a_crowd_at_high_speed_stays_in_its_room),
        TEST(an_elastic_impact_loses_no_time),
        TEST(gravity_gives_no_more_than_the_way_gone),
        TEST(a_wall_gives_no_energy),
        TEST(ridges_give_no_energy),
        TEST(a_glancing_ball_goes_on_along_the_wall),
        TEST(wedges_hold),
        TEST(what_passes_by_is_left_alone),
        TEST(a_bounce_below_a_roof_is_no_hit),
        TEST(thin_triggers_tell_who_went_through),
        EVERY_WAY_UP(what_was_crossed_is_left_in_the_next_step),
        EVERY_WAY_UP(a_bounce_through_a_trigger_is_seen),
        TEST(a_stopped_body_tells_its_impact),
    };
    (void)argv;
    full = argc > 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
