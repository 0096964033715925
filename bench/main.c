// feather-bench: measures Feather beside the engines that anyone can install. This file finds the command and runs it.
#include "bench.h"

#include "peers/peer.h"
#include "scene.h"
#include "trial.h"

#include <stdio.h>
#include <string.h>

typedef struct command {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *about;
} command;

static const command commands[] = {
    {"speed", bench_command_speed, "time per step of all engines, interleaved"},
    {"queries", bench_command_queries, "rays, sweeps, overlaps, and building meshes and hulls, beside Bullet's"},
    {"draw", bench_command_draw, "time of the calls that draw: draw [BODIES]"},
    {"state", bench_command_state, "time and size of snapshots, in a pile and at rest"},
    {"history", bench_command_history, "keeping frames and going back to them, beside a plain copy of as many bytes"},
    {"many", bench_command_many, "many small worlds, one by one and as a batch, beside MuJoCo's: many [WORLDS]"},
    {"record", bench_command_record, "what recording costs, and how fast it plays: record [BODIES [SLEEPING]]"},
    {"replay", bench_command_replay,
     "every case, recorded and played again: replay [--quick] [--keep FOLDER] [CASE...]"},
    {"play", bench_command_play, "a recording: play FILE, exit 1 when it goes another way"},
    {"scenes", bench_command_scenes, "every case in Feather, judged"},
    {"run", bench_command_run, "one case: run NAME, with every measure"},
    {"compare", bench_command_compare,
     "cases in all engines, side by side: exit 1 where Feather does worse than Box2D or ODE"},
    {"tasks", bench_command_tasks, "the runs that compare makes, one a line: about how long, case, engine, substeps"},
    {"worse", bench_command_worse, "that judgement alone, of tables that compare wrote: worse FILE.csv..."},
    {"profile", bench_command_profile, "where the time of a step goes: profile SCENE"},
    {"scaling", bench_command_scaling, "time and memory of 100 to 100 000 bodies, 1 and 2 workers"},
    {"table", bench_command_table, "a table as Markdown: table FILE.csv [COLUMN]..."},
    {"peers", bench_command_peers,
     "are all engines built from the same data? Bodies, mass and places before the first step"},
    {"check", bench_command_check, "the regression set against bench/reference.json: exit 1 on a regression"},
    {"update", bench_command_update, "accepts the present results as the reference"},
    {"list", bench_command_list, "the scenes, the cases and the engines"},
    {"help", bench_command_help, "this text"},
};
static const size_t command_count = sizeof commands / sizeof commands[0];

int bench_command_list(int argc, char **argv)
{
    (void)argc, (void)argv;
    printf("scenes (a number after the name sets n):\n");
    for (int32_t i = 0; i < bench_family_count; i++) {
        const bench_family *family = &bench_families[i];
        char name[32];
        snprintf(name, sizeof name, "%s-%d", family->name, family->usual);
        printf("  %-12s %s%s\n", name, family->about, family->is_default ? "" : " (only when named)");
    }
    printf("cases (name-2d: in the plane, where * stands):\n");
    for (int32_t i = 0; i < bench_case_count(); i++) {
        const bench_case *rule = bench_case_at(i);
        printf("  %-22s %s %s (%s)\n", rule->name, rule->planar ? "*" : " ", rule->about, rule->source);
    }
    printf("engines:\n");
    for (int32_t i = 0; i < bench_engine_count; i++) {
        const bench_engine_entry *entry = &bench_engines[i];
        if (entry->engine != NULL) {
            printf("  %s\n", entry->name);
        } else {
            printf("  %-8s missing: install %s and build again\n", entry->name, entry->package);
        }
    }
    return 0;
}

int bench_command_help(int argc, char **argv)
{
    (void)argc, (void)argv;
    printf("usage: feather-bench COMMAND [OPTION]...\n");
    for (size_t i = 0; i < command_count; i++) printf("  %-8s %s\n", commands[i].name, commands[i].about);
    printf("options of scenes, run, compare and tasks: --scene, --peers, --only-peers, --workers, --substeps (default: "
           "4 and 8), --out,\n"
           "  --variants N          of cases whose measures rounding decides, judged by their medians; a quarter with "
           "many bodies "
           "(default: 32, 1)\n"
           "options of speed:\n"
           "  --scene NAME[,NAME]   scenes to run (default: those of the list); may be given several times\n"
           "  --peers bullet,ode    engines beside Feather, or none (default: all that were built in)\n"
           "  --workers N[,N]       Feather's workers (default: 1, and 2 at 4 substeps)\n"
           "  --substeps N[,N]      Feather's substeps (default: 4 and 8); every number of workers runs with every one "
           "of substeps\n"
           "  --steps N             timed steps, instead of the scene's own\n"
           "  --rays                times 20 000 raycasts after the steps\n"
           "  --profile             Feather's phases and counters\n"
           "  --only-peers          leaves Feather out\n"
           "  --out FILE            where the figures go as CSV (default: build/bench.csv)\n");
    return 0;
}

int main(int argc, char **argv)
{
    if (argc < 2) return bench_command_help(argc, argv);
    for (size_t i = 0; i < command_count; i++) {
        if (strcmp(argv[1], commands[i].name) == 0) return commands[i].run(argc - 2, argv + 2);
    }
    fprintf(stderr, "feather-bench: no command \"%s\"; try: feather-bench help\n", argv[1]);
    return 2;
}
