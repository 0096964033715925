/// @file trial.h
/// A case is a scene with a script and a criterion; a trial is one engine's run of it. The script pushes and takes
/// bodies away, the watcher looks on after each step, the judge states at the end what must hold: measures with their
/// bounds, which come from physics or from the engine's own constants (linear slop, the overlap and the gap of soft
/// constraints). scenes.c runs the cases of cases/, compare.c puts the engines side by side.
#ifndef BENCH_TRIAL_H
#define BENCH_TRIAL_H

#include "peers/peer.h"
#include "scene.h"

typedef struct bench_trial bench_trial;

enum bench_planar {
    BENCH_NOT_PLANAR,
    BENCH_PLANAR_TOO, ///< has a twin in the plane, "name-2d", beside which Box2D can stand
    BENCH_PLANAR_ONLY ///< is in the plane alone, as "name-2d": a ball of a disc's size would be another scene
};

/// Does rounding decide a case's measures? Then they are judged by their medians over variants.
enum bench_chaos {
    BENCH_CALM,
    BENCH_CHAOTIC,
    BENCH_CHAOTIC_LONG ///< too many bodies for variants in every run: only with --variants, a quarter as many
};

typedef struct bench_case {
    const char *name;
    const char *source; ///< where the scene comes from
    const char *about;
    double seconds; ///< simulated
    int32_t planar; ///< bench_planar
    void (*build)(bench_scene *scene);
    void (*act)(bench_trial *trial);   ///< before each step, may be NULL
    void (*watch)(bench_trial *trial); ///< after each step, may be NULL
    void (*judge)(bench_trial *trial);
    int32_t is_chaotic; ///< bench_chaos
} bench_case;

int32_t bench_case_count(void);
const bench_case *bench_case_at(int32_t index);

/// What a body did since the start, or since the last bench_trial_forget.
typedef struct bench_track {
    double lowest, highest; ///< y of its centre, m
    double drift;           ///< largest horizontal distance from its start, m
    double tilt;            ///< largest angle of its y axis to where it pointed at the start, rad
    double speed;           ///< largest, m/s
} bench_track;

/// What a check is of. `own` bounds are predictors of Feather's soft constraints, which say nothing of other engines.
typedef enum bench_kind {
    BENCH_LAW,     ///< whoever misses it fell
    BENCH_OWN,     ///< a height, an overlap
    BENCH_STRAY,   ///< a law on how far something moved that should stay: less is better
    BENCH_OPEN,    ///< a law on a joint's gap: less is better
    BENCH_OWN_OPEN ///< a joint's gap by its predictor
} bench_kind;
extern const char *const bench_kind_names[];

typedef struct bench_check {
    const char *what; ///< with its unit
    double value, low, high;
    bench_kind kind;
    double from, to; ///< of the variants' values
} bench_check;

/// What every run tells, whatever its case asks; NaN where there is nothing to tell (measures.c).
enum bench_measure {
    BENCH_M_DRIFT,   ///< largest horizontal distance from the start at the end, m
    BENCH_M_TILT,    ///< largest angle of a y axis to where it pointed at the start, rad
    BENCH_M_SETTLED, ///< nobody was faster than 5 cm/s from then on, s; NaN: somebody was at the end
    BENCH_M_ENERGY,  ///< gained beyond what forces, motors and springs gave, as a share of what was turned over
    BENCH_M_GAP,     ///< largest joint gap in the last second, m
    BENCH_M_DEEPEST, ///< overlap at the end, by Feather's narrow phase, m
    BENCH_MEASURES
};
extern const char *const bench_measure_names[BENCH_MEASURES];

#define BENCH_TOO_LONG "steps of a body that the case takes"

enum { BENCH_MAX_CHECKS = 24, BENCH_NOTES = 64 };

struct bench_trial {
    const bench_case *rule;
    bench_scene scene;
    const bench_engine *engine;
    bench_world *world;
    int32_t workers, substeps, variants; ///< variants: how many runs the checks' values are of
    int32_t step, step_count;            ///< steps made, to be made
    double time;                         ///< s

    bench_pose *poses;     ///< now, by body
    bench_motion *motions; ///< likewise
    bench_track *tracks;   ///< likewise
    int32_t *away;         ///< 1: was taken away
    double *masses;        ///< kg, 0 for static bodies
    double (*arms)[2][3];  ///< of a joint's anchor in body A and in body B, m

    double *energy;  ///< after each step, kinetic and potential, J; [0] is the start
    double *kinetic; ///< likewise, J
    double *
        held; ///< likewise, what open joints and overlaps hold as springs, J; infinite where overlaps were not measured
    double *gap;               ///< likewise, largest distance of a joint's two anchors, m
    double *gaps;              ///< likewise, sum of these distances, m
    double *fastest;           ///< likewise, speed of the fastest body, m/s
    double notes[BENCH_NOTES]; ///< the case's own, 0 at the start

    double measures[BENCH_MEASURES];
    int32_t ruler_every;  ///< steps from one measure of all overlaps to the next; 0: none
    int32_t driven_until; ///< step after which nothing from outside gave energy
    bench_check checks[BENCH_MAX_CHECKS];
    int32_t check_count;
    int32_t is_too_long; ///< 1: more than the engine's `body_steps`: not run, with one check that tells so
    int32_t finite;      ///< 0: some pose was NaN or infinite, and the run ended there; a check that fails tells so
    double ms;           ///< of all steps, and of all variants, on average
    uint64_t hash;       ///< at the end, where the engine tells
};

/// The case called `name`, or "name-2d" for its planar twin. NULL: none.
const bench_case *bench_case_find(const char *name, int32_t *out_planar);

/// The scene of a case, or of its planar twin.
void bench_trial_build(bench_scene *scene, const bench_case *rule, int32_t planar);
/// A case in an engine. Variants of a scene differ from it by a micrometre in the places of the dynamic bodies.
typedef struct bench_setup {
    const bench_case *rule;
    const bench_engine *engine;
    int32_t planar, workers, substeps;
    int32_t variant;  ///< 0: the scene itself
    int32_t measured; ///< 1: fills the measures, which takes some time
} bench_setup;

/// Runs a case. 0: done (the checks tell how); -1: the engine cannot, and has said why on stderr.
int bench_trial_run(bench_trial *trial, const bench_setup *setup);
/// Runs the scene and its variants, `count` in all. `trial` ends as the scene itself, with the medians of all checks;
/// of a check that leaves no room, the worst value. (variants.c)
int bench_trial_run_variants(bench_trial *trial, const bench_setup *setup, int32_t count);
enum { BENCH_VARIANTS = 32 };
void bench_trial_free(bench_trial *trial);
/// 1: every check within its bounds. For other engines those of Feather's predictors do not count.
int32_t bench_trial_passed(const bench_trial *trial);
int32_t bench_check_passed(const bench_trial *trial, const bench_check *check);
/// Fills `measures` of a run that ended.
void bench_measure(bench_trial *trial);

/// Why Feather does not hold this check yet; NULL when it should (cases/known.c).
const char *bench_known_cause(const bench_trial *trial, const bench_check *check);

// ---- for judges ----------------------------------------------------------------------------------------------------

void bench_expect(bench_trial *trial, const char *what, double value, double low, double high);
void bench_expect_own(bench_trial *trial, const char *what, double value, double low, double high);
void bench_expect_stray(bench_trial *trial, const char *what, double value, double most);
void bench_expect_open(bench_trial *trial, const char *what, double value, double most);
void bench_expect_own_open(bench_trial *trial, const char *what, double value, double most);
void bench_trial_forget(bench_trial *trial); ///< tracks start anew
void bench_trial_take_away(bench_trial *trial, int32_t body);
void bench_trial_bring_back(bench_trial *trial, int32_t body);                ///< to its start, at rest
void bench_trial_push(bench_trial *trial, int32_t body, const double *force); ///< N, in the next step
void bench_trial_hit(bench_trial *trial, int32_t body, const double *impulse, const double *point);
void bench_trial_set_gravity(bench_trial *trial, const double *gravity);

double bench_tilt(const bench_trial *trial, int32_t body);  ///< now, rad
double bench_drift(const bench_trial *trial, int32_t body); ///< now, m
double bench_speed(const bench_trial *trial, int32_t body); ///< now, of the centre, m/s
double bench_largest_tilt(const bench_trial *trial);        ///< now, of all dynamic bodies
double bench_largest_drift(const bench_trial *trial);
double bench_largest_speed(const bench_trial *trial);
double bench_highest(const double *series, int32_t from, int32_t to); ///< of series[from..to]
double bench_rms(const double *series, int32_t from, int32_t to);
double bench_rise(const double *series, int32_t from, int32_t to); ///< largest rise above an earlier value
int32_t bench_step_at(const bench_trial *trial, double seconds);
double bench_joint_gap(const bench_scene *scene, const bench_pose *poses, int32_t joint); ///< of its two points, m
void bench_measure_contacts(const bench_trial *trial, bench_contacts *out_contacts);
double bench_deepest(const bench_trial *trial); ///< overlap, by Feather's narrow phase whoever made the poses, m

/// Bounds of the soft constraints. A loaded point rests at an overlap of force / (effective mass w2), w = 2 pi hertz; a
/// cube on its face, four corner points, at g / w2 times a factor that a lock to the plane changes (its corners lose
/// one of their two levers).
double bench_contact_stiffness(const bench_trial *trial, int32_t against_static); ///< w2, 1/s2
double bench_joint_stiffness(const bench_trial *trial);                           ///< likewise
double bench_face_factor(const bench_trial *trial);                               ///< 1, in the plane 0.625

#define BENCH_LINEAR_SLOP 0.005 ///< m

#endif
