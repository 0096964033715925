// referee.c - what MuJoCo makes of files of robots, to be compared: of each its bodies and joints at rest, as JSON.
// With a number of seconds before the files: and where the joints are after falling so long, in steps of 0.1 ms.
//   referee [seconds] robot.urdf ...
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>

static void print_numbers(const char *name, const mjtNum *values, int count)
{
    printf("\"%s\": [", name);
    for (int i = 0; i < count; ++i) printf("%s%.17g", i ? ", " : "", values[i]);
    printf("]");
}

static void print_body(const mjModel *m, const mjData *d, int i)
{
    printf("{\"name\": \"%s\", \"mass\": %.17g, ", mj_id2name(m, mjOBJ_BODY, i), m->body_mass[i]);
    print_numbers("position", d->xpos + 3 * i, 3), printf(", ");
    print_numbers("rotation", d->xquat + 4 * i, 4), printf(", ");
    print_numbers("centre", d->xipos + 3 * i, 3), printf(", ");
    print_numbers("axes", d->ximat + 9 * i, 9), printf(", ");
    print_numbers("inertia", m->body_inertia + 3 * i, 3), printf("}");
}

static void print_joint(const mjModel *m, const mjData *d, int i)
{
    printf("{\"name\": \"%s\", \"type\": %d, ", mj_id2name(m, mjOBJ_JOINT, i), m->jnt_type[i]);
    print_numbers("position", d->xanchor + 3 * i, 3), printf(", ");
    print_numbers("axis", d->xaxis + 3 * i, 3), printf(", ");
    print_numbers("range", m->jnt_range + 2 * i, 2);
    const int dof = m->jnt_dofadr[i];
    printf(", \"limited\": %d, \"damping\": %.17g, \"friction\": %.17g, \"stiffness\": %.17g, \"armature\": %.17g, ",
           (int)m->jnt_limited[i], m->dof_damping[dof], m->dof_frictionloss[dof], m->jnt_stiffness[i], m->dof_armature[dof]);
    printf("\"rest\": %.17g, \"start\": %.17g}", m->qpos_spring[m->jnt_qposadr[i]], m->qpos0[m->jnt_qposadr[i]]);
}

static int print_file(const char *path, double seconds)
{
    char error[1000] = "";
    mjModel *m = mj_loadXML(path, NULL, error, sizeof error);
    if (!m) {
        fprintf(stderr, "%s: %s\n", path, error);
        return 1;
    }
    m->opt.disableflags |= mjDSBL_CONTACT; // random bodies stand in one another
    mjData *d = mj_makeData(m);
    mj_forward(m, d);
    printf("{\"bodies\": [");
    for (int i = 1; i < m->nbody; ++i) {
        if (i > 1) printf(",\n");
        print_body(m, d, i);
    }
    printf("], \"joints\": [");
    for (int i = 0; i < m->njnt; ++i) {
        if (i) printf(",\n");
        print_joint(m, d, i);
    }
    printf("], ");
    print_numbers("gravity", m->opt.gravity, 3), printf(", ");
    m->opt.timestep = 1e-4;
    while (d->time < seconds - 5e-5) mj_step(m, d);
    print_numbers("after", d->qpos, m->nq);
    printf("}");
    mj_deleteData(d);
    mj_deleteModel(m);
    return 0;
}

int main(int count, char **files)
{
    int failed = 0, first = 1;
    double seconds = count > 1 ? atof(files[1]) : 0.0;
    if (seconds > 0.0) first = 2;
    printf("[");
    for (int i = first; i < count; ++i) {
        if (i > first) printf(",\n");
        failed |= print_file(files[i], seconds);
    }
    printf("]\n");
    return failed;
}
