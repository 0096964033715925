// bytes.c - see bytes.h.
#include "core/bytes.h"

void fe__hash_u32_array(fe__hash *hash, const uint32_t *words, size_t count)
{
    fe__hash_u64(hash, count);
    for (size_t i = 0; i + 1 < count; i += 2) fe__hash_u64(hash, words[i] | (uint64_t)words[i + 1] << 32);
    if (count % 2) fe__hash_u64(hash, words[count - 1]);
}

void fe__hash_u64_array(fe__hash *hash, const uint64_t *words, size_t count)
{
    fe__hash_u64(hash, count);
    for (size_t i = 0; i < count; ++i) fe__hash_u64(hash, words[i]);
}

void fe__hash_struct(fe__hash *hash, const void *words, size_t size)
{
    const unsigned char *next = words;
    fe__hash_u64(hash, size);
    for (size_t i = 0; i < size / 8; ++i, next += 8) {
        uint32_t pair[2];
        memcpy(pair, next, sizeof pair);
        fe__hash_u64(hash, pair[0] | (uint64_t)pair[1] << 32);
    }
    if (size % 8 == 0) return;
    uint32_t last;
    memcpy(&last, next, sizeof last);
    fe__hash_u64(hash, last);
}

// The last word fed has been through one multiplication only. Two more of them, each followed by a shift that brings
// the high bits down, let every bit of it reach every bit of the result.
uint64_t fe__hash_end(const fe__hash *hash)
{
    fe__hash mixed = *hash;
    fe__hash_u64(&mixed, hash->word_count);
    fe__hash_u64(&mixed, 0);
    fe__hash_u64(&mixed, 0);
    return mixed.state;
}
