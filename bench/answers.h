/// @file answers.h
/// Queries as a part of the regression set: a fingerprint of their answers, and their times. check.c compares with
/// bench/reference.json.
#ifndef BENCH_ANSWERS_H
#define BENCH_ANSWERS_H

#include "reference.h"

/// Scenes whose queries are checked: "queries:bowl-300" and so on.
enum { BENCH_ANSWER_SETS = 2 };
extern const char *const bench_answer_names[BENCH_ANSWER_SETS];
/// ray, sweep, overlap, NULL
extern const char *const bench_answer_phases[];

/// Fills all of a reference, its times in units of `calibrate` (NULL: no times). 0, or -1.
int bench_answers(int32_t set, double (*calibrate)(void), bench_reference *out);

#endif
