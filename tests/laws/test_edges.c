// What touches along an edge: on any level ground at rest it has both ends of the line, and two boards that lean on
// each other edge on edge push across their edges.
#include "laws/law.h"

// A wedge of 6 points: its edge along x, `half` m to each side, is its lowest, the rectangle above it is wider or not
static fe_geometry wedge(scene *s, double half, double high, double top, double thick)
{
    float points[18];
    for (int i = 0; i < 6; ++i) {
        double x = i < 4 ? top : half;
        points[3 * i] = (float)(i & 1 ? x : -x);
        points[3 * i + 1] = (float)(i < 4 ? high : 0);
        points[3 * i + 2] = (float)(i >= 4 ? 0 : i & 2 ? thick : -thick);
    }
    return hull(s, points, 6);
}

typedef struct edged {
    fe_geometry form;
    double under; // how far the line is under the form's origin, m
    fe_quat turn;
    const char *name;
} edged;

static edged any_edged(scene *s, dice *d, double half)
{
    double high = half * uniform(d, 0.3, 1), top = half * uniform(d, 0.5, 2), thick = half * uniform(d, 0.1, 0.5);
    fe_quat on_edge = turned(v3(1, 0, 0), atan2(thick, high));
    double diagonal = sqrt(high * high + thick * thick);
    switch (pick(d, 4)) {
    case 0:
        return (edged){wedge(s, half, high, top, thick), 0, UNTURNED, "wedge"};
    case 1:
        return (edged){box(half, high, thick), diagonal, on_edge, "box"};
    case 2:
        return (edged){hull_box(s, half, high, thick), diagonal, on_edge, "hull of 8 points"};
    default:
        return (edged){cylinder(half, thick), thick, turned(v3(0, 0, 1), PI / 2), "cylinder"};
    }
}

// A body that stands on its line in balance, set down at touch, has two points or more there (a triangle's side may add
// some) and sinks by no more than on two: with m / m_n = 1 + half^2 / k^2, k the least radius of gyration,
// m g / (2 m_n w^2), w = 2 pi min(2 contact_hertz, a quarter of the rate of substeps). The balance on an edge is
// unstable: it is looked at within a time constant of its fall, and as soon as it has sunk.
static double a_line_along_a_ground_has_both_its_ends(dice *d, char *told)
{
    rate r = any_rate(d);
    ground_kind kind = any_ground(d);
    scene s = law_scene(r);
    double half = spread(d, 0.1, 1), heading = uniform(d, -PI, PI);
    add_level_ground(&s, kind, 8, friction(0.6));
    edged k = any_edged(&s, d, half);
    vec place = v3(uniform(d, -2, 2), k.under, uniform(d, -2, 2));
    fe_body body = add_dynamic(&s, k.form, place, compose(turned(v3(0, 1, 0), heading), k.turn), friction(0.6), WATER);
    fe_mass_data m = mass_data_of(&s, body);
    double inertia = fmin((double)m.inertia.x, fmin((double)m.inertia.y, (double)m.inertia.z));
    double w = 2 * PI * fmin(60, 0.25 * r.hertz * r.substeps), start = position(&s, body).y;
    double most = G * (1 + half * half * (double)m.mass / inertia) / (2 * w * w), way = 0;
    int32_t least = 99;
    law_run(&s, r, 0.25);
    for (int32_t i = 0; i < 8; ++i) {
        law_run(&s, r, 1.0 / r.hertz);
        fe_contact c[MOST_CONTACTS];
        int32_t n = fe_body_get_contacts(s.world, body, c, sizeof *c, MOST_CONTACTS), points = 0;
        for (int32_t j = 0; j < n; ++j) points += c[j].point_count;
        if (points < least) least = points;
        way = fmax(way, start - position(&s, body).y);
    }
    snprintf(told, LAW_TOLD, "%d Hz, %d substeps, a %s of %.3g m on a %s: %d points, %.4g mm, at most %.4g", r.hertz,
             r.substeps, k.name, half, ground_names[kind], (int)least, 1e3 * way, 1e3 * most);
    scene_end(&s);
    return least < 2 ? 2 : way / (1.05 * most);
}

// ---- boards --------------------------------------------------------------------------------------------------------
// A board, `length` long: its section is a trapezoid, `below` and `above` thick at its ends, or a triangle. It leans so
// that its top is ahead, along x
typedef struct board {
    double length, below, above, wide, angle; // m; from the vertical
    vec foot, top;                            // from the centre of mass, of the section
    double friction;                          // from which on two of them hold
} board;

// Each of the two boards stands on its lowest edge, `foot`, and leans with its foremost, `top`, at the other's. By
// symmetry the force H between them is level; about the foot  H (top.y - foot.y) = m g (-foot.x), and the foot bears m
// g and H: they hold from  H / m g  on. The friction between them does not matter.
static void find_edges(board *b)
{
    double length = b->length, below = b->below, above = b->above, x[4] = {-below, below, above, -above},
           centre = length * (above - below) / (6 * (above + below));
    b->foot = v3(0, INFINITY, 0), b->top = v3(-INFINITY, 0, 0);
    for (int i = 0; i < 4; ++i) {
        vec p = rotate(turned(v3(0, 0, 1), -b->angle), v3(x[i] / 2, (i < 2 ? -length : length) / 2 - centre, 0));
        if (p.y < b->foot.y) b->foot = p;
        if (p.x > b->top.x) b->top = p;
    }
    b->friction = -b->foot.x / (b->top.y - b->foot.y);
}

enum { BOXES, HULL_AND_BOX, HULLS, TAPERS, WEDGES, BOARD_KINDS };
static const char *const board_names[BOARD_KINDS] = {"boxes", "hull and box", "hulls", "tapers", "wedges"};

// The inner side leans by 5 degrees or more, else the two would touch side on side; and the upper end by 6 more or less
// than the other's side, on which it would lie
static board any_board(dice *d, int kind)
{
    board b;
    double inner, taper;
    do {
        b.angle = uniform(d, 10, 40) * DEGREES, b.length = spread(d, 0.5, 3), b.wide = b.length * spread(d, 0.1, 1.5);
        double thick = fmax(0.01, b.length * spread(d, 0.01, 0.6 * tan(b.angle))), other = 1;
        if (kind == TAPERS) other = uniform(d, 0.2, 0.8);
        if (kind == WEDGES) other = 0;
        int up = chance(d, 0.5);
        b.below = up ? thick : other * thick, b.above = up ? other * thick : thick;
        find_edges(&b);
        taper = atan((b.above - b.below) / 2 / b.length), inner = b.angle + taper;
    } while (b.angle - fabs(taper) < 5 * DEGREES || fabs(PI / 2 - b.angle - inner) < 6 * DEGREES || b.friction < 0.03 ||
             b.top.y - b.foot.y < 0.5 * b.length);
    return b;
}

static fe_geometry board_form(scene *s, const board *b, int is_box)
{
    if (is_box) return box(b->below / 2, b->length / 2, b->wide / 2);
    float points[24];
    int32_t count = 0;
    for (int i = 0; i < 8; ++i) {
        double thick = i & 2 ? b->above : b->below, x = (i & 1 ? thick : -thick) / 2;
        if (thick == 0 && i & 1) continue;
        float *p = points + 3 * count++;
        p[0] = (float)x, p[1] = (float)((i & 2 ? b->length : -b->length) / 2);
        p[2] = (float)(i & 4 ? b->wide / 2 : -b->wide / 2);
    }
    return hull(s, points, count);
}

typedef struct frame {
    double fall;  // of a board's centre, m
    double close; // by which the soft contacts of the tops close, m
} frame;

// Each of the two points at the tops bears H / 2, and closes by  H / (2 m_n w^2), 1 / m_n the sum of both boards'
// 1 / m + (r x n) . I^-1 (r x n),  w = 2 pi min(contact_hertz, substep rate / 8) between two dynamic bodies.
static double closing(const scene *s, const board *b, fe_body body, rate r)
{
    fe_mass_data m = mass_data_of(s, body);
    fe_quat back = inverse(compose(turned(v3(0, 0, 1), -b->angle), m.inertia_rotation));
    vec lever = rotate(back, cross(plus(b->top, v3(0, 0, b->wide / 2)), v3(1, 0, 0)));
    double inverse_mass = 2 * (1 / (double)m.mass + lever.x * lever.x / (double)m.inertia.x +
                               lever.y * lever.y / (double)m.inertia.y + lever.z * lever.z / (double)m.inertia.z),
           w = 2 * PI * fmin(30, 0.125 * r.hertz * r.substeps);
    return b->friction * (double)m.mass * G * inverse_mass / (2 * w * w);
}

// The feet's friction is the geometric mean of the boards' and the ground's.
static fe_material of_ground(double of_tops, double of_feet) { return friction(of_feet * of_feet / of_tops); }

static frame lean(rate r, ground_kind ground, int kind, const board *b, double heading, double of_tops, double of_feet)
{
    scene s = law_scene(r);
    fe_body boards[2], under = add_level_ground(&s, ground, 8, of_ground(of_tops, 1.5 * b->friction));
    fe_quat way = turned(v3(0, 1, 0), heading);
    for (int i = 0; i < 2; ++i) {
        fe_quat facing = compose(way, turned(v3(0, 1, 0), i ? PI : 0));
        fe_geometry form = board_form(&s, b, kind == BOXES || (kind == HULL_AND_BOX && i));
        double off = b->length * (b->above - b->below) / (6 * (b->above + b->below)); // of the centre of mass
        fe_quat rotation = compose(facing, turned(v3(0, 0, 1), -b->angle));
        vec centre = rotate(facing, v3(-b->top.x, -b->foot.y, 0));
        boards[i] =
            add_dynamic(&s, form, minus(centre, rotate(rotation, v3(0, off, 0))), rotation, friction(of_tops), WATER);
    }
    frame f = {.close = closing(&s, b, boards[0], r)};
    double start = position(&s, boards[0]).y;
    law_run(&s, r, 1);
    fe_shape shape;
    assert_int_equal(fe_body_get_shapes(s.world, under, &shape, 1), 1);
    fe_material feet = of_ground(of_tops, of_feet);
    MUST(fe_shape_set_material(s.world, shape, &feet));
    law_run(&s, r, 6);
    f.fall = start - position(&s, boards[0]).y;
    scene_end(&s);
    return f;
}

// They settle in 1 s with 1.5 of that friction. Then they hold with 1.02 of it for 6 s, and fall with 0.98. Allowed
// beside the 2 %: as the tops close by d the boards turn by d / 2 / height, which changes the friction; levers are
// those of rigid boards but for d; and the feet's friction acts where their points are, each counted by 1 - s / slop, s
// its height: of an edge and another this is s (1 - s / slop) / (2 - s / slop), at most 0.172 slop. A foot that slides
// begins with 0.02 of mu g, and its way grows as cosh(t sqrt(g / 2 L)): in 6 s it is far beyond 2 % of the height.
static double boards_hold_from_the_exact_friction_on(dice *d, char *told)
{
    rate r = any_rate(d);
    int kind = pick(d, BOARD_KINDS);
    ground_kind ground = any_ground(d);
    board b = any_board(d, kind), more = b, less = b;
    double heading = uniform(d, -PI, PI), of_tops = uniform(d, 0.1, 1), height = b.top.y - b.foot.y, turn = 1e-3;
    more.angle += turn, less.angle -= turn, find_edges(&more), find_edges(&less);
    double by_angle = (more.friction - less.friction) / (2 * turn);
    double close = lean(r, ground, kind, &b, heading, of_tops, 2 * b.friction).close,
           change = by_angle * close / 2 / height / b.friction, lever = (close + 0.172 * LINEAR_SLOP) / height,
           holds = 1.02 + fmax(change, 0) + lever, slides = 0.98 + fmin(change, 0) - lever,
           least = 0.02 * height + close, held = lean(r, ground, kind, &b, heading, of_tops, holds * b.friction).fall,
           fell = lean(r, ground, kind, &b, heading, of_tops, slides * b.friction).fall;
    snprintf(
        told, LAW_TOLD,
        "%d Hz, %d substeps, %s of %.3g m, %.3g m below and %.3g above, %.3g wide, at %.2f degrees on a %s, turned "
        "%.3g, %.2f at the tops: sinks %.3g m with %.3f of %.4f, %.3g with %.3f",
        r.hertz, r.substeps, board_names[kind], b.length, b.below, b.above, b.wide, b.angle / DEGREES,
        ground_names[ground], heading, of_tops, held, holds, b.friction, fell, slides);
    return fmax(held / least, fell > 0 ? least / fell : 2);
}

int main(int argc, char **argv)
{
    static const law laws[] = {{LAW(a_line_along_a_ground_has_both_its_ends), 300},
                               {LAW(boards_hold_from_the_exact_friction_on), 300}};
    return law_main(argc, argv, laws, sizeof laws / sizeof *laws);
}
