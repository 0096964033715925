// character.c - a character without a rigid body: a capsule that sweeps move.
//
//     cc character.c -lfeather -lm -o character && ./character
//
// It walks over a ramp and a kerb; then a block comes and pushes it backwards. Each step of the game:
//
//   1. the world steps
//   2. fe_world_overlap_shapes finds what moved into the character: it is moved out
//   3. it moves up by STEP_UP, forwards, and down again, each by sweeps that slide along what they meet
//   4. the sweep down finds the ground: it stands on what is walkable, else it falls
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>

#define DT (1.0f / 60)
#define SPEED 3.0      // m/s
#define GRAVITY 9.81   // m/s2
#define STEP_UP 0.3    // m, of a kerb that it climbs
#define WALKABLE 0.64f // cosine of the steepest slope that it stands on, 50 degrees

typedef struct character {
    fe_geometry form;
    fe_transform at; // of the capsule's centre
    double fall;     // m/s, downwards
    int on_ground;
} character;

static int32_t must(int32_t result)
{
    if (result >= 0) return result;
    printf("%s\n", fe_last_error());
    exit(1);
}

static fe_body add_box(fe_world *world, int32_t type, fe_transform at, float x, float y, float z)
{
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = type;
    def.transform = at;
    fe_geometry box;
    fe_geometry_box(&box, x, y, z);
    fe_body body;
    fe_shape shape;
    must(fe_body_create(world, &def, &body));
    must(fe_shape_create(world, body, NULL, &box, &shape));
    return body;
}

static void add(fe_dvec3 *a, double scale, fe_dvec3 b)
{
    a->x += scale * b.x, a->y += scale * b.y, a->z += scale * b.z;
}

static fe_dvec3 wide(fe_vec3 a) { return fe_make_dvec3((double)a.x, (double)a.y, (double)a.z); }

// Moves until something is in the way, then along its surface with what is left, four times at most.
static void slide(const fe_world *world, character *who, fe_dvec3 move)
{
    fe_hit hit;
    for (int i = 0; i < 4; ++i) {
        if (!must(fe_world_sweep(world, &who->form, &who->at, &move, NULL, &hit))) {
            add(&who->at.position, 1, move);
            return;
        }
        add(&who->at.position, hit.fraction, move);
        fe_dvec3 normal = wide(hit.normal), rest = fe_make_dvec3(0, 0, 0);
        add(&rest, 1 - hit.fraction, move);
        add(&rest, -(rest.x * normal.x + rest.y * normal.y + rest.z * normal.z), normal);
        move = rest;
    }
}

// A round foot on an edge has a steep normal. What counts there is the surface 2 cm behind the edge, which a ray finds.
static int walkable(const fe_world *world, const fe_hit *foot)
{
    if (foot->normal.y > WALKABLE) return 1;
    fe_hit surface;
    fe_dvec3 origin = {foot->point.x, foot->point.y + 0.05, foot->point.z}, down = {0, -0.1, 0};
    add(&origin, -0.02, wide(foot->normal));
    if (!must(fe_world_raycast(world, &origin, &down, NULL, &surface))) return 0;
    return !(surface.flags & FE_HIT_STARTED_INSIDE) && surface.normal.y > WALKABLE;
}

// Moves down by `depth`. Where the ground is too steep, it slides down along it.
static int drop(const fe_world *world, character *who, double depth)
{
    fe_hit hit;
    fe_dvec3 down = fe_make_dvec3(0, -depth, 0);
    if (!must(fe_world_sweep(world, &who->form, &who->at, &down, NULL, &hit)) || !walkable(world, &hit)) {
        slide(world, who, down);
        return 0;
    }
    add(&who->at.position, hit.fraction, down);
    return 1;
}

static void walk(const fe_world *world, character *who, double x, double z)
{
    double up = who->on_ground ? STEP_UP : 0;
    who->fall = who->on_ground ? 0 : who->fall + GRAVITY * (double)DT;
    slide(world, who, fe_make_dvec3(0, up, 0));
    slide(world, who, fe_make_dvec3(x * (double)DT, 0, z * (double)DT));
    // while it walks, it follows the ground down by as much as it may climb
    fe_transform raised = who->at;
    who->on_ground = drop(world, who, 2 * up + who->fall * (double)DT);
    if (!who->on_ground && up > 0) {
        who->at = raised;
        slide(world, who, fe_make_dvec3(0, -up, 0));
    }
}

// Moves it out of all that moved into it, and 0.1 mm on: what starts inside slides along nothing. Returns their number.
static int32_t push_out(const fe_world *world, character *who)
{
    fe_overlap found[8];
    int32_t count = must(fe_world_overlap_shapes(world, &who->form, &who->at, NULL, found, sizeof *found, 8));
    for (int32_t i = 0; i < count && i < 8; ++i)
        add(&who->at.position, (double)found[i].depth + 1e-4, wide(found[i].direction));
    return count;
}

int main(void)
{
    fe_world *world;
    must(fe_world_create(NULL, &world));
    add_box(world, FE_BODY_STATIC, fe_make_transform(0, -0.5, 0), 20, 0.5f, 20); // the ground: its top is y = 0
    add_box(world, FE_BODY_STATIC, fe_make_transform(6, 0.1, 0), 1, 0.1f, 5);    // a kerb of 20 cm
    fe_transform slope = fe_make_transform(1, -0.15, 0);
    slope.rotation.z = 0.17365f, slope.rotation.w = 0.98481f; // a ramp of 20 degrees
    add_box(world, FE_BODY_STATIC, slope, 2, 0.25f, 5);
    fe_body block = add_box(world, FE_BODY_KINEMATIC, fe_make_transform(19, 1.01, 0), 0.4f, 1, 2);
    fe_vec3 speed = {-2, 0, 0};
    must(fe_body_set_linear_velocity(world, block, &speed));

    character who = {.at = fe_make_transform(-6, 1.5, 0)};
    fe_geometry_capsule(&who.form, 0.6f, 0.3f);
    for (int step = 0; step <= 420; ++step) {
        must(fe_world_step(world, DT));
        int32_t inside = push_out(world, &who);
        walk(world, &who, SPEED, 0);
        fe_dvec3 p = who.at.position;
        if (step % 30 == 0)
            printf("%4.1f s  at %6.3f %6.3f %6.3f m  %s%s\n", step / 60.0, p.x, p.y, p.z,
                   who.on_ground ? "on the ground" : "falling", inside ? ", pushed" : "");
    }
    return fe_world_destroy(world) == FE_OK ? 0 : 1;
}
