// Reads the options of `feather-bench speed` (options.h). Each option is a row of the table below.
#include "options.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int parse_number(const char *text, long least, long most, int32_t *out_number)
{
    char *end;
    long number = strtol(text, &end, 10);
    if (end == text || *end != '\0' || number < least || number > most) {
        fprintf(stderr, "feather-bench: \"%s\" is no number in [%ld, %ld]\n", text, least, most);
        return -1;
    }
    *out_number = (int32_t)number;
    return 0;
}

static int parse_numbers(char *list, int32_t *numbers, int32_t *count)
{
    const long most = 64; // workers and substeps of a world
    for (char *item = strtok(list, ","); item != NULL; item = strtok(NULL, ",")) {
        if (*count == BENCH_MAX_NUMBERS) {
            fprintf(stderr, "feather-bench: more than %d numbers in a list\n", BENCH_MAX_NUMBERS);
            return -1;
        }
        if (parse_number(item, 1, most, &numbers[*count]) != 0) return -1;
        (*count)++;
    }
    return 0;
}

static int parse_names(char *list, char **names, int32_t capacity, int32_t *count)
{
    for (char *item = strtok(list, ","); item != NULL; item = strtok(NULL, ",")) {
        if (*count == capacity) {
            fprintf(stderr, "feather-bench: more than %d names\n", capacity);
            return -1;
        }
        names[(*count)++] = item;
    }
    return 0;
}

static int read_scenes(bench_options *o, char *value)
{
    return parse_names(value, o->scenes, BENCH_MAX_SCENES, &o->scene_count);
}

static int read_peers(bench_options *o, char *value)
{
    o->no_peers = strcmp(value, "none") == 0;
    return o->no_peers ? 0 : parse_names(value, o->peers, BENCH_MAX_PEERS, &o->peer_count);
}

static int read_workers(bench_options *o, char *value) { return parse_numbers(value, o->workers, &o->worker_count); }

static int read_substeps(bench_options *o, char *value) { return parse_numbers(value, o->substeps, &o->substep_count); }

static int read_steps(bench_options *o, char *value) { return parse_number(value, 1, INT_MAX / 2, &o->steps); }

static int read_variants(bench_options *o, char *value) { return parse_number(value, 1, 1000, &o->variants); }

static int read_out(bench_options *o, char *value) { return o->out = value, o->out_given = 1, 0; }

static int set_rays(bench_options *o, char *value) { return (void)value, o->rays = 1, 0; }

static int set_profile(bench_options *o, char *value) { return (void)value, o->profile = 1, 0; }

static int set_only_peers(bench_options *o, char *value) { return (void)value, o->no_feather = 1, 0; }

static const struct option {
    const char *name;
    int has_value;
    int (*read)(bench_options *options, char *value);
} option_table[] = {
    {"--scene", 1, read_scenes},         {"--peers", 1, read_peers}, {"--workers", 1, read_workers},
    {"--steps", 1, read_steps},          {"--out", 1, read_out},     {"--substeps", 1, read_substeps},
    {"--variants", 1, read_variants},    {"--rays", 0, set_rays},    {"--profile", 0, set_profile},
    {"--only-peers", 0, set_only_peers},
};

static const struct option *find_option(const char *name)
{
    for (size_t i = 0; i < sizeof option_table / sizeof option_table[0]; i++) {
        if (strcmp(name, option_table[i].name) == 0) return &option_table[i];
    }
    return NULL;
}

int bench_options_parse(bench_options *out_options, int argc, char **argv)
{
    memset(out_options, 0, sizeof *out_options);
    out_options->out = "build/bench.csv";
    for (int i = 0; i < argc; i++) {
        const struct option *option = find_option(argv[i]);
        if (option == NULL || (option->has_value && i + 1 == argc)) {
            fprintf(stderr, option == NULL ? "feather-bench: no option \"%s\"\n" : "feather-bench: %s needs a value\n",
                    argv[i]);
            return -1;
        }
        char *value = option->has_value ? argv[++i] : NULL;
        if (option->read(out_options, value) != 0) return -1;
    }
    return 0;
}
