// Reads and writes bench/reference.json (reference.h): JSON, but of one fixed shape, which is all that is read back.
#include "reference.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { LINE = 2048 };

static int read_line(const char *line, bench_reference *out)
{
    int used = 0;
    memset(out, 0, sizeof *out);
    if (sscanf(line,
               " {\"scene\": \"%63[^\"]\", \"quick\": \"%" SCNx64 "\", \"full\": \"%" SCNx64 "\", \"passed\": %" SCNd32
               ", \"phases\": {%n",
               out->scene, &out->quick, &out->full, &out->passed, &used) != 4 ||
        used == 0)
        return -1;
    const char *at = line + used;
    while (out->phase_count < BENCH_REFERENCE_PHASES) {
        int next = 0;
        if (sscanf(at, "%*[ ,]%n", &next) == 0 && next > 0) at += next;
        next = 0;
        if (sscanf(at, "\"%*[^\"]\": %lf%n", &out->phases[out->phase_count], &next) != 1) break;
        at += next;
        out->phase_count++;
    }
    return 0;
}

int32_t bench_reference_read(const char *path, bench_reference *scenes)
{
    FILE *file = fopen(path, "r");
    char line[LINE];
    int32_t count = 0;
    if (file == NULL) {
        fprintf(stderr, "feather-bench: %s: %s\n", path, strerror(errno));
        return -1;
    }
    while (fgets(line, sizeof line, file) != NULL) {
        if (strstr(line, "\"scene\"") == NULL) continue;
        if (count == BENCH_REFERENCE_SCENES || read_line(line, &scenes[count]) != 0) {
            fprintf(stderr, "feather-bench: %s: not understood: %s", path, line);
            fclose(file);
            return -1;
        }
        count++;
    }
    fclose(file);
    return count;
}

int bench_reference_write(const char *path, const bench_reference *scenes, int32_t count,
                          const char *const *phase_names, const char *const *other_names, int32_t other_count)
{
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        fprintf(stderr, "feather-bench: %s: %s\n", path, strerror(errno));
        return -1;
    }
    fprintf(file, "[\n");
    for (int32_t i = 0; i < count; i++) {
        const bench_reference *r = &scenes[i];
        fprintf(file,
                "  {\"scene\": \"%s\", \"quick\": \"%016" PRIx64 "\", \"full\": \"%016" PRIx64
                "\", \"passed\": %d, \"phases\": {",
                r->scene, r->quick, r->full, r->passed);
        const char *const *names = i < count - other_count ? phase_names : other_names;
        for (int32_t p = 0; p < r->phase_count; p++)
            fprintf(file, "%s\"%s\": %.4f", p > 0 ? ", " : "", names[p], r->phases[p]);
        fprintf(file, "}}%s\n", i + 1 < count ? "," : "");
    }
    fprintf(file, "]\n");
    return fclose(file);
}
