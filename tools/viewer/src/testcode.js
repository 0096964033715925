// testcode.js - a step as a test in C: a program that plays the recording to it and asks for what is seen here.
const number = (v) => `${Object.is(v, -0) ? '-0.0' : Number.isInteger(v) ? v.toFixed(1) : v}`;
const of = (v) => ['x', 'y', 'z', 'w'].filter((k) => k in v).map((k) => v[k]);
const quoted = (s) => JSON.stringify(s).replace(/[^\x20-\x7e]/g, '?').replace(/\?\?/g, '?'); // no trigraphs

function rowsOf(body) {
    const { position, rotation } = body.transform;
    return [
        ['position', 'double', 'at.position', position], ['rotation', 'float', 'at.rotation', rotation],
        ['linear velocity', 'float', 'linear', body.linearVelocity],
        ['angular velocity', 'float', 'angular', body.angularVelocity],
    ];
}
function checksOf(body, name) {
    const rows = rowsOf(body).flatMap(([what, , from, value]) => of(value).map((v, k) =>
        `        {${quoted(`${what}.${'xyzw'[k]}`)}, (double)${from}.${'xyzw'[k]}, ${number(v)}},\n`));
    return `
    // ${quoted(name).slice(1, -1)}
    const fe_body body = UINT64_C(0x${body.id.toString(16)});
    fe_transform at;
    fe_vec3 linear, angular;
    if (fe_body_get_transform(world, body, &at) != FE_OK || fe_body_get_linear_velocity(world, body, &linear) != FE_OK ||
        fe_body_get_angular_velocity(world, body, &angular) != FE_OK)
        return fail();
    const struct { const char *name; double found, wanted; } values[] = {
${rows.join('')}    };
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i) {
        if (values[i].found == values[i].wanted) continue;
        printf("%s is %.17g, not %.17g\\n", values[i].name, values[i].found, values[i].wanted);
        failed = 1;
    }
`;
}

// `body`: what is picked, or null
export function testOf(world, file, step, body, name) {
    const hash = BigInt(`0x${world.hash}`), word = (shift) => `0x${((hash >> shift) & 0xffffffffn).toString(16)}u`;
    return `// Plays ${quoted(file).slice(1, -1)} to step ${step} and compares the world with what the viewer showed.
//   cc test.c -lfeather -o test && ./test ${quoted(file)}
#include <feather.h>
#include <inttypes.h>
#include <stdio.h>

static int fail(void)
{
    printf("%s\\n", fe_last_error());
    return 1;
}

int main(int count, char **arguments)
{
    static unsigned char piece[65536];
    const char *path = count > 1 ? arguments[1] : ${quoted(file)};
    const fe_world *world;
    fe_player *player;
    int failed = 0;
    FILE *file = fopen(path, "rb");
    if (!file) return perror(path), 1;
    if (fe_player_create(NULL, &player) != FE_OK) return fail();
    for (size_t size; (size = fread(piece, 1, sizeof piece, file)) > 0;)
        if (fe_player_feed(player, piece, (int64_t)size) != FE_OK) return fail();
    fclose(file);

    fe_result result;
    while ((result = fe_player_seek(player, ${step})) == FE_ERROR_DIVERGED) printf("%s\\n", fe_last_error());
    if (result == FE_END) return printf("the recording ends before step ${step}\\n"), 1;
    if (result != FE_OK || fe_player_get_world(player, &world) != FE_OK) return fail();
${body ? checksOf(body, name) : ''}
    uint32_t words[2];
    if (fe_world_hash(world, words) != FE_OK) return fail();
    if (words[0] != ${word(0n)} || words[1] != ${word(32n)}) {
        printf("the world's hash is 0x%08" PRIx32 "%08" PRIx32 ", not 0x${world.hash}\\n", words[1], words[0]);
        failed = 1;
    }
    fe_player_destroy(player);
    printf(failed ? "differs\\n" : "as in the viewer\\n");
    return failed;
}
`;
}
