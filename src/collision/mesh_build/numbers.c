// numbers.c - shortcuts through the cycles of the triangles' numbers, see fe__mesh_slot.
#include "collision/mesh_build/build.h"

static int32_t is_seen(const uint8_t *seen, int32_t i) { return seen[i >> 3] >> (i & 7) & 1; }

// From `start` around its cycle. Every FE__MESH_SHORTCUT-th element gets a shortcut to the one so many before it; the
// first one's leads to the last but one that has any.
static int32_t walk_cycle(uint32_t *numbers, int32_t start, uint8_t *seen, int32_t count, fe__mesh_shortcut *out)
{
    int32_t length = 0, at = start, last = start, first_count = count;
    do {
        seen[at >> 3] |= (uint8_t)(1 << (at & 7));
        if (length > 0 && length % FE__MESH_SHORTCUT == 0) {
            out[count] = (fe__mesh_shortcut){at, last};
            numbers[at] |= FE__MESH_HAS_SHORTCUT;
            last = at;
            count += 1;
        }
        at = (int32_t)(numbers[at] & ~FE__MESH_HAS_SHORTCUT);
        length += 1;
    } while (at != start);
    if (count == first_count) return count;
    out[count] = (fe__mesh_shortcut){start, last}; // over the end of the cycle
    numbers[start] |= FE__MESH_HAS_SHORTCUT;
    return count + 1;
}

static void sift(fe__mesh_shortcut *heap, int32_t at, int32_t count)
{
    fe__mesh_shortcut moved = heap[at];
    for (int32_t child; (child = 2 * at + 1) < count; at = child) {
        if (child + 1 < count && heap[child].from < heap[child + 1].from) child += 1;
        if (heap[child].from <= moved.from) break;
        heap[at] = heap[child];
    }
    heap[at] = moved;
}

static void sort(fe__mesh_shortcut *shortcuts, int32_t count)
{
    for (int32_t i = count / 2; i-- > 0;) sift(shortcuts, i, count);
    for (int32_t end = count - 1; end > 0; --end) {
        fe__mesh_shortcut largest = shortcuts[0];
        shortcuts[0] = shortcuts[end], shortcuts[end] = largest;
        sift(shortcuts, 0, end);
    }
}

int32_t fe__mesh_shortcuts(uint32_t *numbers, int32_t count, uint8_t *seen, fe__mesh_shortcut *out)
{
    int32_t made = 0;
    memset(seen, 0, (size_t)count / 8 + 1);
    for (int32_t i = 0; i < count; ++i)
        if (!is_seen(seen, i)) made = walk_cycle(numbers, i, seen, made, out);
    sort(out, made);
    return made;
}
