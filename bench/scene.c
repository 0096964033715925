// Builds scenes from their names and adds bodies to them (scene.h). The table below is the list of all families.
#include "scene.h"

#include "memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const bench_family bench_families[] = {
    {"rest", "n boxes and spheres at rest, one layer", 1, 1000000, 500, 1, bench_build_rest},
    {"pyramid", "flat pyramid of n rows of boxes", 1, 1000, 100, 1, bench_build_pyramid},
    {"many", "n x n flat pyramids of 55 boxes", 2, 100, 14, 1, bench_build_many},
    {"wide", "square pyramid of n levels of boxes", 1, 100, 15, 1, bench_build_wide},
    {"raft", "n boxes on one body", 1, 100000, 2000, 1, bench_build_raft},
    {"joints", "cloth of n x n spheres on ball joints", 2, 1000, 100, 0, bench_build_joints},
    {"ragdolls", "n people of fourteen capsules fall on a heightfield", 1, 10000, 300, 0, bench_build_ragdolls},
    {"people", "n of those people on flat ground, for many worlds", 1, 1000, 1, 0, bench_build_people},
    {"hoppers", "n legs of four capsules in a plane, driven, for many worlds", 1, 1000, 1, 0, bench_build_hoppers},
    {"pushers", "n driven boxes that push nine boxes, for many worlds", 1, 1000, 1, 0, bench_build_pushers},
    {"bowl", "n boxes, spheres and capsules poured into a pit", 1, 1000000, 1500, 1, bench_build_bowl},
    {"debris", "n boxes of all sizes poured into a pit", 1, 1000000, 1000, 0, bench_build_debris},
    {"balls", "n spheres of all sizes poured into a pit", 1, 1000000, 1500, 0, bench_build_balls},
    {"capsulespit", "n capsules of all sizes poured into a pit", 1, 1000000, 1000, 0, bench_build_capsulespit},
    {"pile", "n boxes and spheres fall onto each other", 1, 1000000, 2000, 0, bench_build_pile},
    {"town", "n boxes, spheres and capsules fall among 25 600 static boxes", 1, 1000000, 1000, 0, bench_build_town},
    {"wall", "n brick walls, each hit by a heavy ball", 1, 1000, 10, 0, bench_build_wall},
    {"volley", "n boxes and spheres: two clouds fly at each other", 1, 1000000, 1000, 0, bench_build_volley},
    {"chains", "n chains of 30 spheres let go", 1, 10000, 50, 0, bench_build_chains},
    {"grid", "n x n x n cubes, 1 cm apart", 1, 100, 10, 0, bench_build_grid},
    {"dominoes", "rows of 50 dominoes, n in all, topple", 1, 1000000, 1000, 0, bench_build_dominoes},
    {"landslide", "n boxes, spheres and capsules slide down a slope to a wall", 1, 1000000, 1000, 0,
     bench_build_landslide},
    {"blast", "n cubes and spheres burst apart in a closed room and bounce", 1, 1000000, 1000, 0, bench_build_blast},
    {"hulls", "n convex hulls of 8 to 32 points poured into a pit", 1, 1000000, 1000, 1, bench_build_hulls},
    {"hullpyramid", "flat pyramid of n rows of boxes given as hulls", 1, 1000, 50, 1, bench_build_hullpyramid},
    {"rocks", "n convex hulls fall on a mesh of 131 072 triangles", 1, 20000, 2000, 1, bench_build_rocks},
    {"mixedmesh", "n boxes, spheres, capsules and hulls thrown across that mesh", 1, 20000, 500, 1,
     bench_build_mixedmesh},
    {"cylinders", "n cylinders poured into a pit", 1, 1000000, 500, 1, bench_build_cylinders},
    {"compounds", "n tables, chairs and Ts of boxes poured into a pit", 1, 1000000, 300, 1, bench_build_compounds},
    {"fall", "n boxes, spheres and capsules in the air", 1, 1000000, 500, 0, bench_build_fall},
    {"awake", "n of them tumbling on open ground", 1, 1000000, 2000, 0, bench_build_awake},
    {"level", "n static boxes, for queries", 1, 1000000, 100000, 0, bench_build_level},
    {"terrain", "a heightfield of n x n samples, for queries", 2, 4096, 1024, 0, bench_build_terrain},
    {"mesh", "hills of n x n cells, two triangles each, for queries", 1, 4096, 256, 0, bench_build_mesh},
    {"hullcloud", "n static hulls in the air, for queries", 1, 1000000, 2000, 0, bench_build_hullcloud},
};
const int32_t bench_family_count = (int32_t)(sizeof bench_families / sizeof bench_families[0]);

static void init_scene(bench_scene *scene, const char *family, int32_t n)
{
    memset(scene, 0, sizeof *scene);
    snprintf(scene->name, sizeof scene->name, "%s-%d", family, n);
    scene->gravity[1] = -9.81;
    scene->dt = 1.0f / 60.0f;
    scene->warm_up_steps = 1;
    scene->timed_steps = 200;
    scene->query_radius = 0.4f;
}

int bench_scene_build(const char *name, bench_scene *out_scene)
{
    const char *dash = strrchr(name, '-');
    size_t length = dash != NULL ? (size_t)(dash - name) : strlen(name);
    for (int32_t i = 0; i < bench_family_count; i++) {
        const bench_family *family = &bench_families[i];
        if (strlen(family->name) != length || strncmp(family->name, name, length) != 0) continue;
        char *end = NULL;
        long n = dash != NULL ? strtol(dash + 1, &end, 10) : family->usual;
        if (end != NULL && (end == dash + 1 || *end != '\0')) return -1;
        if (n < family->smallest || n > family->largest) return -1;
        init_scene(out_scene, family->name, (int32_t)n);
        family->build(out_scene, (int32_t)n);
        return 0;
    }
    return -1;
}

void bench_scene_destroy(bench_scene *scene)
{
    for (int32_t i = 0; i < scene->shape_count; i++) {
        bench_solid_free(scene->shapes[i].solid);
        free(scene->shapes[i].parts);
    }
    free(scene->shapes);
    free(scene->bodies);
    free(scene->joints);
    memset(scene, 0, sizeof *scene);
}

static bench_shape make_shape(bench_form form)
{
    bench_shape shape;
    memset(&shape, 0, sizeof shape);
    shape.form = form;
    shape.density = 1000.0f;
    shape.friction = 0.6f;
    return shape;
}

bench_shape bench_make_box(float half_x, float half_y, float half_z)
{
    bench_shape shape = make_shape(BENCH_BOX);
    shape.half[0] = half_x, shape.half[1] = half_y, shape.half[2] = half_z;
    return shape;
}

bench_shape bench_make_sphere(float radius)
{
    bench_shape shape = make_shape(BENCH_SPHERE);
    shape.radius = radius;
    return shape;
}

bench_shape bench_make_capsule(float half_height, float radius)
{
    bench_shape shape = make_shape(BENCH_CAPSULE);
    shape.half_height = half_height, shape.radius = radius;
    return shape;
}

bench_shape bench_make_terrain(int32_t side, float cell)
{
    bench_shape shape = make_shape(BENCH_TERRAIN);
    shape.side = side, shape.cell = cell;
    return shape;
}

bench_shape bench_make_cylinder(float half_height, float radius)
{
    bench_shape shape = make_shape(BENCH_CYLINDER);
    shape.half_height = half_height, shape.radius = radius;
    return shape;
}

bench_shape bench_make_mesh(int32_t cells)
{
    bench_shape shape = make_shape(BENCH_MESH);
    shape.side = cells;
    return shape;
}

bench_shape bench_make_hull(bench_solid *solid)
{
    bench_shape shape = make_shape(BENCH_HULL);
    shape.solid = solid;
    return shape;
}

bench_shape bench_make_compound(bench_part *parts, int32_t part_count)
{
    bench_shape shape = make_shape(BENCH_COMPOUND);
    shape.parts = parts, shape.part_count = part_count;
    return shape;
}

static double part_volume(const bench_part *part)
{
    return 8.0 * (double)part->half[0] * (double)part->half[1] * (double)part->half[2];
}

double bench_shape_volume(const bench_shape *shape)
{
    double r = shape->radius;
    switch (shape->form) {
    case BENCH_BOX:
        return 8.0 * (double)shape->half[0] * (double)shape->half[1] * (double)shape->half[2];
    case BENCH_SPHERE:
        return 4.0 / 3.0 * BENCH_PI * r * r * r;
    case BENCH_CAPSULE:
        return BENCH_PI * r * r * (2.0 * (double)shape->half_height + 4.0 / 3.0 * r);
    case BENCH_CYLINDER:
        return BENCH_PI * r * r * 2.0 * (double)shape->half_height;
    case BENCH_HULL:
        return shape->solid->volume;
    case BENCH_COMPOUND: {
        double sum = 0.0;
        for (int32_t i = 0; i < shape->part_count; i++) sum += part_volume(&shape->parts[i]);
        return sum;
    }
    case BENCH_TERRAIN:
    case BENCH_MESH:
        break;
    }
    return 0.0;
}

void bench_shape_inertia(const bench_shape *shape, double *out)
{
    memset(out, 0, 6 * sizeof *out);
    if (shape->form == BENCH_HULL) memcpy(out, shape->solid->inertia, 6 * sizeof *out);
    for (int32_t i = 0; i < shape->part_count; i++) {
        const bench_part *part = &shape->parts[i];
        const double volume = part_volume(part), *p = part->at;
        for (int k = 0; k < 3; k++) { // steps of axes from k: its own moment and Steiner's
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            const double half_a = (double)part->half[a], half_b = (double)part->half[b];
            out[k] += volume * ((half_a * half_a + half_b * half_b) / 3.0 + p[a] * p[a] + p[b] * p[b]);
            out[3 + k] -= volume * p[k] * p[a];
        }
    }
}

double bench_shape_area(const bench_shape *shape)
{
    double r = shape->radius;
    switch (shape->form) {
    case BENCH_BOX:
        return 4.0 * (double)shape->half[0] * (double)shape->half[1];
    case BENCH_SPHERE:
        return BENCH_PI * r * r;
    case BENCH_CAPSULE:
        return BENCH_PI * r * r + 4.0 * r * (double)shape->half_height;
    case BENCH_CYLINDER:
    case BENCH_HULL:
    case BENCH_COMPOUND:
    case BENCH_TERRAIN:
    case BENCH_MESH:
        break; // scenes in the plane have none
    }
    return 0.0;
}

void bench_make_planar(bench_scene *scene)
{
    for (int32_t i = 0; i < scene->shape_count; i++) {
        bench_shape *shape = &scene->shapes[i];
        if (shape->form == BENCH_BOX) {
            shape->half[2] = 0.5f;
        } else {
            shape->density *= (float)(bench_shape_area(shape) / bench_shape_volume(shape));
        }
    }
    for (int32_t i = 0; i < scene->body_count; i++) {
        if (!scene->bodies[i].dynamic) continue;
        scene->bodies[i].linear_locks |= 4;
        scene->bodies[i].angular_locks |= 3;
    }
    scene->planar = 1;
}

void bench_turn_z(bench_body *body, double angle)
{
    body->start.rotation[2] = sin(0.5 * angle);
    body->start.rotation[3] = cos(0.5 * angle);
}

double bench_scene_mass(const bench_scene *scene)
{
    double mass = 0.0;
    for (int32_t i = 0; i < scene->body_count; i++) {
        const bench_body *body = &scene->bodies[i];
        const bench_shape *shape = &scene->shapes[body->shape];
        if (body->dynamic) mass += (double)shape->density * bench_shape_volume(shape);
    }
    return mass;
}

// Room for one item more; the capacity doubles so that n additions copy no more than 2 n items.
static void *grow(void *items, int32_t count, int32_t *capacity, size_t size)
{
    if (count < *capacity) return items;
    *capacity = *capacity > 0 ? 2 * *capacity : 16;
    return bench_resize(items, (size_t)*capacity, size);
}

int32_t bench_add_shape(bench_scene *scene, bench_shape shape)
{
    scene->shapes = grow(scene->shapes, scene->shape_count, &scene->shape_capacity, sizeof *scene->shapes);
    scene->shapes[scene->shape_count] = shape;
    return scene->shape_count++;
}

static int32_t add_body(bench_scene *scene, int32_t shape, int32_t dynamic, double x, double y, double z)
{
    scene->bodies = grow(scene->bodies, scene->body_count, &scene->body_capacity, sizeof *scene->bodies);
    bench_body *body = &scene->bodies[scene->body_count];
    memset(body, 0, sizeof *body);
    body->start.position[0] = x, body->start.position[1] = y, body->start.position[2] = z;
    body->start.rotation[3] = 1.0;
    body->shape = shape;
    body->dynamic = dynamic;
    body->collides = 1;
    body->gravity_scale = 1.0f;
    return scene->body_count++;
}

int32_t bench_add_static(bench_scene *scene, int32_t shape, double x, double y, double z)
{
    return add_body(scene, shape, 0, x, y, z);
}

int32_t bench_add_dynamic(bench_scene *scene, int32_t shape, double x, double y, double z)
{
    return add_body(scene, shape, 1, x, y, z);
}

int32_t bench_add_joint(bench_scene *scene, int32_t body_a, int32_t body_b, double x, double y, double z)
{
    scene->joints = grow(scene->joints, scene->joint_count, &scene->joint_capacity, sizeof *scene->joints);
    bench_joint *joint = &scene->joints[scene->joint_count];
    memset(joint, 0, sizeof *joint);
    joint->body_a = body_a, joint->body_b = body_b;
    joint->anchor[0] = x, joint->anchor[1] = y, joint->anchor[2] = z;
    return scene->joint_count++;
}
