// Samples of Box3D with spinning and fast bodies, as data (E. Catto, Box3D, 2025, samples).
#include "cases.h"

#include "../random.h"

#include <math.h>

// ---- spinning books: free turning about three axes -----------------------------------------------------------------

enum { BOOKS = 3, ABOUT_MIDDLE = 1 };

static void build_books(bench_scene *s)
{
    static const float spin[BOOKS][3] = {{5.0f, 0.01f, 0.01f}, {0.01f, 5.0f, 0.01f}, {0.01f, 0.01f, -5.0f}};
    const int32_t book = bench_box(s, 0.35, 0.08, 0.5, 1000.0, 0.6);
    bench_add_ground(s, 10.0, 0.6);
    for (int32_t i = 0; i < BOOKS; i++) {
        const int32_t body = bench_add_dynamic(s, book, 3.0 * i, 5.0, 0.0);
        for (int k = 0; k < 3; k++) s->bodies[body].angular_velocity[k] = spin[i][k];
    }
    s->gravity[1] = 0.0;
}

// The axis that a book turns about, in the book's own frame, must stay where it was; notes: what it strayed, rad
static void watch_books(bench_trial *t)
{
    for (int32_t i = ABOUT_MIDDLE + 1; i <= BOOKS; i++) {
        const double *w = t->motions[i].angular, *q = t->poses[i].rotation;
        const int axis = i == 2 ? 1 : 2;
        // the body's axis in the world is a column of its rotation
        const double column[3] = {2.0 * (q[axis] * q[0] + (axis == 1 ? -1.0 : 1.0) * q[3] * q[axis == 1 ? 2 : 1]),
                                  axis == 1 ? 1.0 - 2.0 * (q[0] * q[0] + q[2] * q[2])
                                            : 2.0 * (q[1] * q[2] - q[3] * q[0]),
                                  axis == 1 ? 2.0 * (q[1] * q[2] + q[3] * q[0])
                                            : 1.0 - 2.0 * (q[0] * q[0] + q[1] * q[1])};
        const double dot = column[0] * w[0] + column[1] * w[1] + column[2] * w[2],
                     length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        t->notes[i] = fmax(t->notes[i], acos(fmin(1.0, fabs(dot) / length)));
    }
}

static void judge_books(bench_trial *t)
{
    const double degree = BENCH_PI / 180.0;
    bench_expect(t, "energy at the end / start", t->energy[t->step] / t->energy[0], 0.99, 1.00001);
    bench_expect(t, "largest energy / start", bench_highest(t->energy, 0, t->step) / t->energy[0], 0.0, 1.00001);
    bench_expect(t, "about the longest moment: wobble, rad", t->notes[2], 0.0, degree);
    bench_expect(t, "about the shortest: wobble, rad", t->notes[3], 0.0, degree);
}

// ---- thin wall -----------------------------------------------------------------------------------------------------

enum { SHOTS = 3 };

static void build_thin_wall(bench_scene *s)
{
    const int32_t forms[SHOTS] = {bench_sphere(s, 0.1, 1000.0, 0.6), bench_capsule(s, 0.3, 0.1, 1000.0, 0.6),
                                  bench_box(s, 0.4, 0.1, 0.1, 1000.0, 0.6)};
    bench_add_static(s, bench_box(s, 10.0, 10.0, 0.1, 1.0, 0.6), 0.0, 10.0, 0.0);
    for (int32_t i = 0; i < SHOTS; i++) {
        for (int32_t side = -1; side <= 1; side += 2) {
            const int32_t body =
                bench_add_dynamic(s, forms[i], -6.0 + 3.0 * (2 * i + (side + 1) / 2) - 1.5, 10.0, 20.0);
            s->bodies[body].linear_velocity[2] = -180.0f;
            s->bodies[body].angular_velocity[0] = 20.0f, s->bodies[body].angular_velocity[1] = 5.0f * (float)side;
        }
    }
}

static void watch_beyond_wall(bench_trial *t)
{
    for (int32_t i = 1; i < t->scene.body_count; i++) t->notes[0] += t->poses[i].position[2] < 0.0;
}

static void judge_thin_wall(bench_trial *t)
{
    bench_expect(t, "bodies beyond the wall x steps", t->notes[0], 0.0, 0.0);
}

// ---- spinning stick: 100 sticks fall on a narrow beam --------------------------------------------------------------

enum { STICKS = 100 };

static void build_spinning_sticks(bench_scene *s)
{
    uint64_t state = 0x9e3779b97f4a7c15u;
    const int32_t stick = bench_box(s, 2.0, 0.1, 0.1, 1000.0, 0.6), beam = bench_box(s, 0.125, 0.5, 10.0, 1.0, 0.6);
    for (int32_t i = 0; i < STICKS; i++) bench_add_static(s, beam, 10.0 * (i % 10), 0.0, 25.0 * (i / 10));
    for (int32_t i = 0; i < STICKS; i++) {
        const int32_t body = bench_add_dynamic(s, stick, 10.0 * (i % 10), 20.0, 25.0 * (i / 10));
        s->bodies[body].linear_velocity[1] = -100.0f;
        for (int k = 0; k < 3; k++) s->bodies[body].angular_velocity[k] = (float)(100.0 * bench_random(&state) - 50.0);
    }
}

// A stick whose middle comes down within the beam's width went through. (It may slide off a side later; notes: was it
// stopped once?)
static void watch_spinning_sticks(bench_trial *t)
{
    for (int32_t i = STICKS; i < 2 * STICKS; i++) {
        const double *p = t->poses[i].position, *start = t->scene.bodies[i].start.position;
        if (t->time < 0.35 && p[1] < -0.5 && fabs(p[0] - start[0]) < 0.125) t->notes[0] += 1.0;
    }
}

static void judge_spinning_sticks(bench_trial *t)
{
    bench_expect(t, "sticks through the beam x steps", t->notes[0], 0.0, 0.0);
}

// ---- bullet against a stack ----------------------------------------------------------------------------------------

enum { STACKED = 10 };

static void build_bullet(bench_scene *s)
{
    const int32_t box = bench_box(s, 0.5, 0.5, 0.5, 1000.0, 0.6);
    bench_add_ground(s, 50.0, 0.6);
    bench_add_static(s, bench_box(s, 0.1, 10.0, 10.0, 1.0, 0.6), -1.0, 10.0, 0.0);
    for (int32_t i = 0; i < STACKED; i++) bench_add_dynamic(s, box, 0.0, 0.5 + 1.1 * i, 0.0);
    const int32_t bullet = bench_add_dynamic(s, bench_sphere(s, 0.25, 10000.0, 0.6), 20.0, 5.0, 0.0);
    s->bodies[bullet].linear_velocity[0] = -500.0f;
}

static void watch_bullet(bench_trial *t)
{
    for (int32_t i = 2; i < t->scene.body_count; i++) t->notes[0] += t->poses[i].position[0] < -1.0;
}

static void judge_bullet(bench_trial *t) { bench_expect(t, "bodies beyond the wall x steps", t->notes[0], 0.0, 0.0); }

const bench_case bench_box3d_motion[] = {
    {"spinning-books", "Box3D", "free turning about three axes", 60.0, 0, build_books, NULL, watch_books, judge_books,
     BENCH_CALM},
    {"thin-wall", "Box3D", "spinning bodies at 180 m/s against 0.2 m", 1.0, 0, build_thin_wall, NULL, watch_beyond_wall,
     judge_thin_wall, BENCH_CALM},
    {"spinning-sticks", "Box3D", "100 sticks at 100 m/s on a beam", 1.0, 0, build_spinning_sticks, NULL,
     watch_spinning_sticks, judge_spinning_sticks, BENCH_CALM},
    {"bullet", "Box3D", "500 m/s against a stack before a wall", 2.0, 0, build_bullet, NULL, watch_bullet, judge_bullet,
     BENCH_CALM},
};
const int32_t bench_box3d_motion_count = (int32_t)(sizeof bench_box3d_motion / sizeof bench_box3d_motion[0]);
