// The engines this program was built with (peer.h).
#include "peer.h"

const bench_engine_entry bench_engines[] = {
    {"feather", &bench_feather, ""},
#ifdef FE_BENCH_BULLET
    {"bullet", &bench_bullet, "libbullet-dev"},
#else
    {"bullet", NULL, "libbullet-dev"},
#endif
#ifdef FE_BENCH_ODE
    {"ode", &bench_ode, "libode-dev"},
#else
    {"ode", NULL, "libode-dev"},
#endif
#ifdef FE_BENCH_BOX2D
    {"box2d", &bench_box2d, "libbox2d-dev"},
#else
    {"box2d", NULL, "libbox2d-dev"},
#endif
};
const int32_t bench_engine_count = (int32_t)(sizeof bench_engines / sizeof bench_engines[0]);
