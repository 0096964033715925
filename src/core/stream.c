// stream.c - see stream.h.
#include "core/stream.h"

#include <string.h>

#ifdef __SSE2__
#include <emmintrin.h>

enum { LINE = 64 };    // bytes
enum { AHEAD = 1024 }; // bytes that are asked for early: stores that pass the caches do not make the CPU do it

void fe__stream(void *to, const void *from, size_t size)
{
    unsigned char *t = to;
    const unsigned char *f = from;
    size_t lines = size / LINE * LINE;
    for (size_t at = 0; at < lines; at += LINE) {
        if (at + AHEAD < size) __builtin_prefetch(f + at + AHEAD);
        for (size_t part = at; part < at + LINE; part += sizeof(__m128i))
            _mm_stream_si128((__m128i *)(void *)(t + part), _mm_loadu_si128((const __m128i *)(const void *)(f + part)));
    }
    _mm_sfence(); // before another thread reads it
    if (size > lines) memcpy(t + lines, f + lines, size - lines);
}
#else
void fe__stream(void *to, const void *from, size_t size) { memcpy(to, from, size); }
#endif
