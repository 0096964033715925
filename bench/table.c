// `feather-bench table FILE.csv [COLUMN]...`: a table of any command as Markdown, all columns or those named, for pages
// and reports.
#include "bench.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { MOST_COLUMNS = 64, MOST_TEXT = 4096 };

// Splits a line at its commas, but not within quotes, which it takes off. The number of fields.
static int split(char *line, char *fields[MOST_COLUMNS])
{
    int count = 0;
    line[strcspn(line, "\r\n")] = '\0';
    for (char *at = line; count < MOST_COLUMNS; at++) {
        const int quoted = *at == '"';
        fields[count++] = at += quoted;
        at += strcspn(at, quoted ? "\"" : ",");
        if (quoted && *at != '\0') *at++ = '\0';
        if (*at == '\0') return count;
        *at = '\0';
    }
    return count;
}

static void print_row(char *const *fields, int count, const int *chosen, int chosen_count)
{
    printf("|");
    for (int i = 0; i < chosen_count; i++) printf(" %s |", chosen[i] < count ? fields[chosen[i]] : "");
    printf("\n");
}

// -1: a column is not there
static int choose(char *const *fields, int count, int argc, char **argv, int *chosen)
{
    for (int i = 0; i < argc; i++) {
        int k = 0;
        while (k < count && strcmp(fields[k], argv[i]) != 0) k++;
        if (k == count) {
            fprintf(stderr, "feather-bench: no column \"%s\"\n", argv[i]);
            return -1;
        }
        chosen[i] = k;
    }
    for (int k = 0; argc == 0 && k < count; k++) chosen[k] = k;
    return argc > 0 ? argc : count;
}

int bench_command_table(int argc, char **argv)
{
    char line[MOST_TEXT], *fields[MOST_COLUMNS];
    int chosen[MOST_COLUMNS], chosen_count = 0;
    FILE *file = argc > 0 && argc <= MOST_COLUMNS ? fopen(argv[0], "r") : NULL;
    if (file == NULL) {
        fprintf(stderr, "feather-bench: table FILE.csv [COLUMN]...: %s\n", argc > 0 ? strerror(errno) : "which file?");
        return 2;
    }
    for (int row = 0; fgets(line, sizeof line, file) != NULL && chosen_count >= 0; row++) {
        const int count = split(line, fields);
        if (row == 0) chosen_count = choose(fields, count, argc - 1, argv + 1, chosen);
        if (chosen_count < 0) break;
        print_row(fields, count, chosen, chosen_count);
        if (row > 0) continue;
        printf("|");
        for (int i = 0; i < chosen_count; i++) printf("---|");
        printf("\n");
    }
    fclose(file);
    return chosen_count < 0 ? 2 : 0;
}
