// hash.c - see hash.h.
#include "core/hash.h"

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

// shifts instead of a copy: the same on a big-endian machine, and one load on a little-endian one
static uint64_t little_endian_word(const unsigned char *bytes)
{
    return (uint64_t)bytes[0] | (uint64_t)bytes[1] << 8 | (uint64_t)bytes[2] << 16 | (uint64_t)bytes[3] << 24 | (uint64_t)bytes[4] << 32 |
           (uint64_t)bytes[5] << 40 | (uint64_t)bytes[6] << 48 | (uint64_t)bytes[7] << 56;
}

void fe__hash_bytes(fe__hash *hash, const void *bytes, size_t size)
{
    const unsigned char *next = bytes;
    size_t whole = size / 8, rest = size % 8;
    fe__hash_u64(hash, size);
    for (size_t i = 0; i < whole; ++i, next += 8) fe__hash_u64(hash, little_endian_word(next));
    if (rest == 0) return;
    unsigned char last[8] = {0};
    memcpy(last, next, rest);
    fe__hash_u64(hash, little_endian_word(last));
}

// The last word fed has been through one multiplication only. Two more of them, each followed by a shift that brings the high bits down,
// let every bit of it reach every bit of the result.
uint64_t fe__hash_end(const fe__hash *hash)
{
    fe__hash mixed = *hash;
    fe__hash_u64(&mixed, hash->word_count);
    fe__hash_u64(&mixed, 0);
    fe__hash_u64(&mixed, 0);
    return mixed.state;
}
