// What touches exactly is neither inside nor hit, unless it comes nearer: sweeps and overlaps of all pairs of forms.
#include "laws/law.h"

typedef enum top_kind {
    ON_PLANE,
    ON_BOX,
    ON_HULL,
    ON_CYLINDER,
    ON_CONE,
    ON_SPHERE,
    ON_CAPSULE,
    ON_MESH,
    ON_FIELD,
    TOPS
} top_kind;
static const char *const top_names[TOPS] = {"plane",  "box",     "hull", "cylinder",   "cone",
                                            "sphere", "capsule", "mesh", "heightfield"};
typedef enum mover_kind { SPHERE, CAPSULE, BOX, CYLINDER, CONE, HULL, MOVERS } mover_kind;
static const char *const mover_names[MOVERS] = {"sphere", "capsule", "box", "cylinder", "cone", "hull"};

// A form whose highest point is at (0, 0, 0), or whose top is there
static void add_top(scene *s, top_kind kind, double size, double heading)
{
    fe_geometry forms[] = {box(1, size, 1),      box(2 * size, size, size), hull_box(s, 2 * size, size, size),
                           cylinder(size, size), cone(size, size),          sphere(size),
                           capsule(size, size)};
    double height = kind == ON_CAPSULE ? 2 * (double)(float)size : (double)(float)size;
    if (kind == ON_PLANE) {
        add_ground(s, friction(0));
    } else if (kind == ON_MESH) {
        add_mesh(s, 8, 3 * size, -12 * size, -12 * size, 0.3, level, friction(0));
    } else if (kind == ON_FIELD) {
        add_field(s, 8, 3 * size, -12 * size, -12 * size, level, friction(0));
    } else {
        add_static(s, forms[kind], v3(0, -height, 0), turned(v3(0, 1, 0), heading), friction(0));
    }
}

typedef struct mover {
    fe_geometry form;
    double height; // of its origin over its lowest point, m
} mover;

static mover any_mover(scene *s, dice *d, mover_kind kind)
{
    double a = spread(d, 0.02, 2), b = spread(d, 0.02, 2), c = spread(d, 0.02, 2), h = (double)(float)b;
    double caps = (double)(float)a + h;
    switch (kind) {
    case SPHERE:
        return (mover){sphere(b), h};
    case CAPSULE:
        return (mover){capsule(a, b), caps};
    case BOX:
        return (mover){box(a, b, c), h};
    case CYLINDER:
        return (mover){cylinder(b, a), h};
    case CONE:
        return (mover){cone(b, a), h};
    default:
        return (mover){hull_box(s, a, b, c), h};
    }
}

// ---- the law -------------------------------------------------------------------------------------------------------
typedef enum way { LEAVES, ALONG, COMES, STANDS, WAYS } way;
static const char *const way_names[WAYS] = {"leaving", "along", "coming", "standing"};

static vec direction_of(dice *d, way w)
{
    double heading = uniform(d, -PI, PI),
           up = w == LEAVES  ? uniform(d, 0.1, 1)
                : w == COMES ? -uniform(d, 0.3, 1)
                             : 0,
           level = sqrt(1 - up * up), length = spread(d, 0.01, 10);
    if (w == STANDS) return v3(0, 0, 0);
    return times(length, v3(level * cos(heading), up, level * sin(heading)));
}

// 1e-9 m is what counts as a touch (FE_SWEEP_TOUCH): what overlaps by more starts inside, by its depth to a millionth
// of its size; what does not is hit only when it comes nearer, then at most a micrometre before the body (0.1 mm: a
// box) and with no depth. 0: it holds
static const char *what_fails(const scene *s, const mover *m, double gap, double size, way w, vec d, fe_quat turn)
{
    fe_transform at = {.position = v3(0, m->height + gap, 0), .rotation = turn};
    const double touch = 1e-9;
    fe_hit hit;
    fe_body body;
    int32_t met = fe_world_sweep(s->world, &m->form, &at, &d, NULL, &hit),
            overlaps = fe_world_overlap(s->world, &m->form, &at, NULL, &body, 1);
    if (met < 0 || overlaps < 0) return "an error";
    int inside = met && hit.flags & FE_HIT_STARTED_INSIDE;
    if (met && (hit.depth < 0 || signbit(hit.depth))) return "a depth below 0";
    if (gap >= 0 && inside) return "inside without an overlap";
    if (gap >= 0 && overlaps) return "an overlap without one";
    if (gap < -2 * touch - 1e-14 * size && !(inside && overlaps)) return "an overlap is not seen";
    if (inside) return fabs(hit.depth + gap) <= 1e-5 + 1e-6 * size ? NULL : "another depth";
    if (w != COMES) return met ? "a hit of what does not come nearer" : NULL;
    if (gap < 0) return NULL;
    if (-d.y < gap + 1e-8) return NULL; // it may end before the body
    if (!met) return "no hit";
    at.position = plus(at.position, times(hit.fraction, d));
    if (fe_world_overlap(s->world, &m->form, &at, NULL, &body, 1)) return "a stop inside";
    if (hit.fraction * -d.y < gap - 1e-4) return "a stop too early";
    if (hit.depth != 0) return "a depth";
    return dot(widen(hit.normal), d) < 0 ? NULL : "a normal along the way";
}

static double an_exact_touch_is_no_overlap(dice *d, char *told)
{
    scene s = scene_begin(NULL);
    top_kind top = (top_kind)pick(d, TOPS);
    mover_kind kind = (mover_kind)pick(d, MOVERS);
    double size = spread(d, 0.02, 2), heading = uniform(d, -PI, PI),
           gap = chance(d, 0.3) ? 0 : (chance(d, 0.5) ? 1 : -1) * spread(d, 1e-12, 1e-4);
    add_top(&s, top, size, heading);
    mover m = any_mover(&s, d, kind);
    fe_quat turn = turned(v3(0, 1, 0), uniform(d, -PI, PI));
    const char *fails = NULL;
    int w;
    vec way_of = v3(0, 0, 0);
    for (w = LEAVES; w < WAYS && !fails; ++w) {
        way_of = direction_of(d, (way)w);
        fails = what_fails(&s, &m, gap, size + m.height, (way)w, way_of, turn);
    }
    snprintf(told, LAW_TOLD, "%s (height %.3g m) on %s (%.3g m), gap %.3g m, %s by %.3g %.3g %.3g: %s",
             mover_names[kind], m.height, top_names[top], size, gap, way_names[w - 1], way_of.x, way_of.y, way_of.z,
             fails ? fails : "holds");
    scene_end(&s);
    return fails ? 2 : 0;
}

// Turns about the common normal by up to ten rad, as it goes
static const char *what_fails_turning(const scene *s, const mover *m, double gap, way w, vec d, double yaw,
                                      double heading)
{
    const vec up = v3(0, 1, 0);
    fe_transform start = {.position = v3(0, m->height + gap, 0), .rotation = turned(up, heading)}, stop = start;
    fe_vec3 turn = {0, (float)yaw, 0};
    fe_hit hit;
    fe_body body;
    int32_t met = fe_world_sweep_turning(s->world, &m->form, &start, &d, &turn, NULL, &hit);
    if (met < 0) return "an error";
    if (met && hit.flags & FE_HIT_STARTED_INSIDE) return "inside without an overlap";
    if (w != COMES) return met ? "a hit of what does not come nearer" : NULL;
    double stops_before = 1e-6 + 3e-7 * 4 * m->height;
    if (-d.y < gap + stops_before) return NULL; // it may end before the body
    if (!met) return "no hit";
    stop.position = plus(stop.position, times(hit.fraction, d));
    stop.rotation = turned(up, heading + hit.fraction * (double)turn.y);
    if (fe_world_overlap(s->world, &m->form, &stop, NULL, &body, 1)) return "a stop inside";
    return dot(widen(hit.normal), d) < 0 ? NULL : "a normal along the way";
}

static double what_turns_where_it_touches_is_not_hit(dice *d, char *told)
{
    scene s = scene_begin(NULL);
    top_kind top = (top_kind)pick(d, TOPS);
    mover_kind kind = (mover_kind)pick(d, MOVERS);
    double size = spread(d, 0.02, 2), yaw = uniform(d, -10, 10), gap = chance(d, 0.6) ? 0 : spread(d, 1e-12, 1e-4);
    add_top(&s, top, size, uniform(d, -PI, PI));
    mover m = any_mover(&s, d, kind);
    double heading = uniform(d, -PI, PI);
    const char *fails = NULL;
    int w;
    for (w = LEAVES; w < WAYS && !fails; ++w)
        fails = what_fails_turning(&s, &m, gap, (way)w, direction_of(d, (way)w), yaw, heading);
    snprintf(told, LAW_TOLD, "%s (height %.3g m) on %s (%.3g m), gap %.3g m, %s, turns by %.3g rad: %s",
             mover_names[kind], m.height, top_names[top], size, gap, way_names[w - 1], yaw, fails ? fails : "holds");
    scene_end(&s);
    return fails ? 2 : 0;
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(an_exact_touch_is_no_overlap), 2000},
                               {LAW(what_turns_where_it_touches_is_not_hit), 2000}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
