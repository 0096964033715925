// Hulls beside those of libqhull (Barber, Dobkin, Huhdanpaa), on the random clouds of support/hull_clouds.h.
//
//     build/tests/unit/test_hull_qhull 1000000            that many clouds
//
// The library is loaded while the test runs: without it (Debian: libqhull-dev) the test says so and passes.
#include "fe_test.h"
#include "support/hull_clouds.h"
#include "support/hull_judge.h"
#include "support/hull_make.h"

#if defined(__has_include)
#if __has_include(<libqhull_r/libqhull_r.h>) && defined(__linux__) && !defined(FE_SANITIZED)
#define HAS_QHULL 1
#endif
#endif

#ifdef HAS_QHULL
#include <dlfcn.h>
#include <libqhull_r/libqhull_r.h>

static int32_t clouds = 2000;

// ---- the library ---------------------------------------------------------------------------------------------------

static struct {
    void (*zero)(qhT *, FILE *);
    int (*build)(qhT *, int, int, coordT *, boolT, char *, FILE *, FILE *);
    void (*measure)(qhT *, facetT *);
    void (*free_hull)(qhT *, boolT);
    void (*free_memory)(qhT *, int *, int *);
} qhull;

static int32_t load_qhull(void)
{
    void *library = dlopen("libqhull_r.so", RTLD_NOW);
    if (!library) library = dlopen("libqhull_r.so.8.0", RTLD_NOW);
    if (!library) return 0;
    *(void **)&qhull.zero = dlsym(library, "qh_zero");
    *(void **)&qhull.build = dlsym(library, "qh_new_qhull");
    *(void **)&qhull.measure = dlsym(library, "qh_getarea");
    *(void **)&qhull.free_hull = dlsym(library, "qh_freeqhull");
    *(void **)&qhull.free_memory = dlsym(library, "qh_memfreeshort");
    return qhull.zero && qhull.build && qhull.measure && qhull.free_hull && qhull.free_memory;
}

typedef struct other_hull {
    int32_t vertices;
    double volume, area;
} other_hull;

// 0: it fails. Its points are relative to the middle, which changes no volume: it computes in doubles.
static int32_t ask_qhull(const cloud *c, other_hull *out)
{
    static coordT moved[CLOUD_MOST][3];
    for (int32_t i = 0; i < c->count; ++i)
        for (int32_t k = 0; k < 3; ++k) moved[i][k] = (double)c->points[i][k] - (double)c->points[0][k];
    static qhT q;
    char command[] = "qhull Pp";
    int long_memory, blocks;
    FILE *nowhere = fopen("/dev/null", "w");
    qhull.zero(&q, nowhere);
    int32_t is_made = qhull.build(&q, 3, c->count, &moved[0][0], False, command, NULL, nowhere) == 0;
    if (is_made) {
        qhull.measure(&q, q.facet_list);
        *out = (other_hull){q.num_vertices, q.totvol, q.totarea};
    }
    qhull.free_hull(&q, !qh_ALL);
    qhull.free_memory(&q, &long_memory, &blocks);
    fclose(nowhere);
    return is_made;
}

// ---- the comparison ------------------------------------------------------------------------------------------------

typedef struct tally {
    int32_t compared, larger, refused, failed; // larger: more vertices than a hull may have here
    double worst;                              // difference of volumes, in shares of what is allowed
} tally;

// Where the whole hull has room: every point within the tolerance, and the volume within that of a layer so thick.
// Else every point within what was told, and no larger volume. Qhull's own facets are merged within some roundings.
static int32_t agrees(const cloud *c, const fe__hull *h, const other_hull *other, tally *t)
{
    double extent = (double)h->extent, slack = 1e-6 * extent, difference = h->mass.volume - other->volume;
    if (!judge_points(h, &c->points[0][0], c->count, extent)) return 0;
    if (other->vertices > FE__HULL_VERTICES) {
        t->larger += 1;
        return difference <= slack * other->area;
    }
    double allowed = ((double)h->tolerance + slack) * other->area;
    t->worst = fe__maxd(t->worst, fe__absd(difference) / allowed);
    return (double)h->error <= (double)h->tolerance + JUDGE_ROUNDING * extent && fe__absd(difference) <= allowed;
}

static void hulls_agree_with_those_of_qhull(void **state)
{
    (void)state;
    tally t = {0};
    int32_t bad = 0;
    for (int32_t i = 0; i < clouds; ++i) {
        static cloud c;
        made_hull made;
        other_hull other;
        cloud_make(&c, UINT64_C(1000000007) + (uint64_t)i);
        if (!make_hull(&c.points[0][0], c.count, FE__HULL_VERTICES, 0.0, &made)) {
            t.refused += 1;
            continue;
        }
        if (!ask_qhull(&c, &other)) {
            t.failed += 1;
        } else if (!agrees(&c, &made.hull, &other, &t)) {
            print_error("cloud %d of kind %d, %d points: %d vertices, %.17g m3, error %g; qhull has %d, %.17g\n",
                        (int)i, (int)c.kind, (int)c.count, (int)made.hull.vertex_count, made.hull.mass.volume,
                        (double)made.hull.error, (int)other.vertices, other.volume);
            bad += 1;
        } else {
            t.compared += 1;
        }
        free_hull(&made);
    }
    print_message("%d hulls agree, %d of them with more than 255 vertices; %d refused as thin, %d that qhull refuses; "
                  "volumes within %.3f of what is allowed\n",
                  (int)t.compared, (int)t.larger, (int)t.refused, (int)t.failed, t.worst);
    assert_int_equal(bad, 0);
    FE_TRUE(t.compared > clouds / 2);
}

int main(int argc, char **argv)
{
    if (argc > 1) clouds = atoi(argv[1]);
    if (!load_qhull()) {
        print_message("*** NO COMPARISON WITH QHULL: libqhull_r could not be loaded (make deps) ***\n");
        return 0;
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(hulls_agree_with_those_of_qhull)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#else
int main(void)
{
    print_message("*** NO COMPARISON WITH QHULL: libqhull-dev is not installed (make deps), or this is no build for it "
                  "***\n");
    return 0;
}
#endif
