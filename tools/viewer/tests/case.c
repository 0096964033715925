// case.c - recordings for the viewer's test, and what the library says of them, as JSON.
//   feather-viewer-case FOLDER        writes a.feather, b.feather, empty.feather
// b is a, but for one velocity that is changed before step NUDGED. empty begins with an empty world, to which each step
// adds a body.
#include "feather.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DT (1.0f / 120.0f)
enum { STEPS = 400, NUDGED = 150, BOXES = 6, MOST = 1 << 24, KEYFRAMES = 100, ASKED = 5, ADDED = 7 };
static const int asked[ASKED] = {0, 1, 57, 200, STEPS};

static void must(fe_result result)
{
    if (result >= 0) return;
    fprintf(stderr, "%s\n", fe_last_error());
    exit(1);
}

typedef struct run {
    fe_world *world;
    fe_body ground, boxes[BOXES], pendulum;
    fe_joint hinge;
    uint32_t hashes[STEPS + 1][2];
} run;

static fe_body add(fe_world *world, fe_body_type type, fe_transform at, const fe_geometry *form)
{
    fe_body_def def;
    fe_body body;
    fe_shape shape;
    fe_body_def_init(&def, sizeof def);
    def.type = (int32_t)type;
    def.transform = at;
    must(fe_body_create(world, &def, &body));
    must(fe_shape_create(world, body, NULL, form, &shape));
    return body;
}

// A tower, and a pendulum that swings into it
static void build(run *r)
{
    fe_geometry form;
    fe_hinge_joint_def hinge;
    must(fe_world_create(NULL, &r->world));
    fe_geometry_plane(&form, 0, 1, 0, 0);
    r->ground = add(r->world, FE_BODY_STATIC, fe_make_transform(0, 0, 0), &form);
    fe_geometry_box(&form, 0.4f, 0.4f, 0.4f);
    for (int i = 0; i < BOXES; ++i)
        r->boxes[i] = add(r->world, FE_BODY_DYNAMIC, fe_make_transform(0, 0.4 + 0.8 * i, 0), &form);
    fe_geometry_capsule(&form, 0.6f, 0.35f);
    r->pendulum = add(r->world, FE_BODY_DYNAMIC, fe_make_transform(-4.5, 6, 0), &form);
    fe_hinge_joint_def_init(&hinge, sizeof hinge);
    must(fe_hinge_joint_def_at(r->world, &hinge, 0, r->pendulum, &(fe_dvec3){-1.2, 6, 0}, &(fe_vec3){0, 0, 1}));
    must(fe_hinge_joint_create(r->world, &hinge, &r->hinge));
}

static void print_pose(const char *name, const fe_world *world, fe_body body)
{
    fe_transform t;
    fe_vec3 v;
    must(fe_body_get_transform(world, body, &t));
    must(fe_body_get_linear_velocity(world, body, &v));
    printf("\"%s\": [%.17g, %.17g, %.17g, %.9g, %.9g, %.9g, %.9g, %.9g, %.9g, %.9g]", name, t.position.x, t.position.y,
           t.position.z, (double)t.rotation.x, (double)t.rotation.y, (double)t.rotation.z, (double)t.rotation.w,
           (double)v.x, (double)v.y, (double)v.z);
}

static void print_step(const run *r, int step)
{
    fe_energy e;
    fe_joint_state s;
    uint32_t hash[2];
    must(fe_world_get_energy(r->world, &e));
    must(fe_world_hash(r->world, hash));
    s.struct_size = sizeof s;
    must(fe_joint_get_state(r->world, r->hinge, &s));
    printf("{\"step\": %d, \"hash\": \"%08x%08x\", \"kinetic\": %.17g, \"angle\": %.9g, \"contacts\": %d, ", step,
           hash[1], hash[0], e.kinetic, (double)s.angle, fe_body_get_contacts(r->world, r->boxes[0], NULL, 0, 0));
    print_pose("box", r->world, r->boxes[BOXES - 1]);
    printf(", ");
    print_pose("pendulum", r->world, r->pendulum);
    printf("}");
}

static int64_t record(run *r, int is_nudged, int is_told, unsigned char *bytes)
{
    fe_recorder *recorder;
    fe_recorder_def def;
    int64_t size;
    build(r);
    fe_recorder_def_init(&def, sizeof def);
    def.keyframe_steps = KEYFRAMES;
    must(fe_recorder_create(r->world, &def, &recorder));
    must(fe_recorder_note(recorder, r->pendulum, "the pendulum"));
    for (int step = 0, k = 0; step <= STEPS; ++step) {
        must(fe_world_hash(r->world, r->hashes[step]));
        if (is_told && k < ASKED && asked[k] == step) {
            print_step(r, step);
            if (++k < ASKED) printf(",\n    ");
        }
        if (step == STEPS) break;
        if (is_nudged && step == NUDGED - 1)
            must(fe_body_set_linear_velocity(r->world, r->boxes[2], &(fe_vec3){0, 0.25f, 0}));
        must(fe_world_step(r->world, DT));
    }
    must(fe_recorder_read(recorder, bytes, MOST, &size));
    must(fe_recorder_destroy(recorder));
    return size;
}

static int64_t record_from_nothing(unsigned char *bytes)
{
    fe_world *world;
    fe_recorder *recorder;
    fe_geometry ball;
    int64_t size;
    must(fe_world_create(NULL, &world));
    must(fe_recorder_create(world, NULL, &recorder));
    fe_geometry_sphere(&ball, 0.5f);
    for (int step = 0; step < ADDED; ++step) {
        add(world, FE_BODY_DYNAMIC, fe_make_transform(2.0 * step, 0, 0), &ball);
        must(fe_world_step(world, DT));
    }
    must(fe_recorder_read(recorder, bytes, MOST, &size));
    must(fe_recorder_destroy(recorder));
    must(fe_world_destroy(world));
    return size;
}

static void write_file(const char *folder, const char *name, const unsigned char *bytes, int64_t size)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(bytes, 1, (size_t)size, file) != (size_t)size || fclose(file)) {
        perror(path);
        exit(1);
    }
}

// To which step the first `size` bytes play
static int64_t played(const unsigned char *bytes, int64_t size)
{
    fe_player *player;
    fe_player_info info;
    fe_player_info_init(&info, sizeof info);
    must(fe_player_create(NULL, &player));
    must(fe_player_feed(player, bytes, size));
    while (fe_player_step(player) == FE_OK) {}
    must(fe_player_get_info(player, &info));
    must(fe_player_destroy(player));
    return info.step;
}

int main(int count, char **arguments)
{
    static run a, b;
    unsigned char *bytes = malloc(MOST);
    if (count != 2 || !bytes) return 1;
    printf("{\"steps\": [\n    ");
    int64_t size = record(&a, 0, 1, bytes), cut = size * 7 / 10;
    write_file(arguments[1], "a.feather", bytes, size);
    printf("],\n\"cut\": %lld, \"cutStep\": %lld, \"size\": %lld,\n", (long long)cut, (long long)played(bytes, cut),
           (long long)size);
    size = record(&b, 1, 0, bytes);
    write_file(arguments[1], "b.feather", bytes, size);
    write_file(arguments[1], "empty.feather", bytes, record_from_nothing(bytes));
    int first = 0;
    while (first < STEPS && memcmp(a.hashes[first], b.hashes[first], sizeof a.hashes[first]) == 0) ++first;
    printf("\"added\": %d,\n", ADDED);
    printf("\"first\": %d, \"nudged\": \"%llu\", \"last\": %d, \"pendulum\": \"%llu\", \"top\": \"%llu\", \"hinge\": "
           "\"%llu\"}\n",
           first, (unsigned long long)a.boxes[2], STEPS, (unsigned long long)a.pendulum,
           (unsigned long long)a.boxes[BOXES - 1], (unsigned long long)a.hinge);
    free(bytes);
    return 0;
}
