// Colours of a body: as many as it has bits.
#include "fe_test.h"

#include "solver/graph/graph.h"

static int32_t count_one_by_one(const fe__body *body)
{
    int32_t count = 0;
    for (int32_t colour = 0; colour < 128; ++colour) count += (int32_t)(body->colours[colour / 64] >> colour % 64 & 1);
    return count;
}

// From none to all, and a hundred thousand sets between
static void colours_are_counted(void **state)
{
    (void)state;
    static fe__body body;
    for (int32_t bits = 0; bits <= 128; ++bits) {
        body.colours[0] = bits >= 64 ? UINT64_MAX : (UINT64_C(1) << bits) - 1;
        body.colours[1] = bits == 128 ? UINT64_MAX : bits > 64 ? (UINT64_C(1) << (bits - 64)) - 1 : 0;
        assert_int_equal(fe__colours_of(&body), bits);
    }
    uint64_t noise = 1;
    for (int32_t i = 0; i < 100000; ++i) {
        body.colours[0] = noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        body.colours[1] = noise = noise * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        assert_int_equal(fe__colours_of(&body), count_one_by_one(&body));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(colours_are_counted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
