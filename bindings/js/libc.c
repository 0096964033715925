// libc.c - what the library asks of the C library, for WebAssembly without WASI: three functions of the host instead of
// files, environment and a printf of its own. Only error sentences are formatted; the host knows how to write a number.
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define HOST(name) __attribute__((import_module("host"), import_name(name)))
HOST("clock") double host_clock(void); // ms, since any moment
// `value` as printf's %.*g, or as its %.*f when `fixed`; at most 31 characters and their number
HOST("write") int32_t host_write(double value, int32_t digits, int32_t fixed, char *out);
HOST("read") double host_read(const char *text);

_Static_assert(sizeof(long) == 4 && sizeof(void *) == 4, "wasm32");
const struct __clockid {
    int none;
} _CLOCK_MONOTONIC = {0};

int clock_gettime(clockid_t clock, struct timespec *out)
{
    double now = host_clock();
    (void)clock;
    out->tv_sec = (time_t)(now / 1e3);
    out->tv_nsec = (long)((now - (double)out->tv_sec * 1e3) * 1e6);
    return 0;
}

char *getenv(const char *name)
{
    (void)name;
    return NULL;
}

// How often the memory grew, exported by its address: the host then renews its views. A shared memory that grew leaves
// them as they were, and too short.
_Atomic uint32_t memory_growths = 0;

// Called by malloc, always with whole pages. Nobody reads errno.
void *sbrk(intptr_t increment)
{
    enum { PAGE = 65536 };
    if (increment == 0) return (void *)(__builtin_wasm_memory_size(0) * PAGE);
    size_t pages = increment > 0 ? __builtin_wasm_memory_grow(0, (size_t)increment / PAGE) : SIZE_MAX;
    if (pages == SIZE_MAX) return (void *)-1;
    ++memory_growths;
    return (void *)(pages * PAGE);
}

int sched_yield(void) { return 0; }

double strtod(const char *text, char **end)
{
    (void)end;
    return host_read(text);
}

// ---- printf: %s %c %d %u %x %f %g with widths, precisions, 0, l and ll
// ------------------------------------------------

typedef struct writer {
    char *out;
    size_t size, used;
} writer;

static void put(writer *w, char c)
{
    if (w->used + 1 < w->size) w->out[w->used] = c;
    ++w->used;
}

static void put_text(writer *w, const char *text, int length, int width, char fill)
{
    for (int i = length; i < width; ++i) put(w, fill);
    for (int i = 0; i < length; ++i) put(w, text[i]);
}

static void put_integer(writer *w, uint64_t value, int negative, unsigned base, int width, char fill)
{
    char text[24];
    int at = sizeof text;
    do text[--at] = "0123456789abcdef"[value % base];
    while ((value /= base) != 0);
    if (negative) text[--at] = '-';
    put_text(w, text + at, (int)sizeof text - at, width, fill);
}

static int number(const char **at)
{
    int n = 0;
    while (**at >= '0' && **at <= '9') n = n * 10 + *(*at)++ - '0';
    return n;
}

int vsnprintf(char *restrict out, size_t size, const char *restrict format, va_list arguments)
{
    writer w = {out, size, 0};
    for (const char *at = format; *at; ++at) {
        if (*at != '%') {
            put(&w, *at);
            continue;
        }
        ++at;
        char fill = *at == '0' ? '0' : ' ', text[32];
        int width = number(&at), precision = -1, is_long = 0;
        if (*at == '.') {
            ++at;
            if (*at == '*')
                precision = va_arg(arguments, int), ++at;
            else
                precision = number(&at);
        }
        for (; *at == 'l'; ++at) ++is_long;
        if (*at == 's') {
            const char *s = va_arg(arguments, const char *);
            put_text(&w, s, (int)(precision < 0 ? strlen(s) : strnlen(s, (size_t)precision)), width, ' ');
        } else if (*at == 'c') {
            put(&w, (char)va_arg(arguments, int));
        } else if (*at == 'd') {
            int64_t value = is_long > 1 ? va_arg(arguments, int64_t) : va_arg(arguments, int);
            put_integer(&w, value < 0 ? 0 - (uint64_t)value : (uint64_t)value, value < 0, 10, width, fill);
        } else if (*at == 'u' || *at == 'x') {
            uint64_t value = is_long > 1 ? va_arg(arguments, uint64_t) : va_arg(arguments, unsigned);
            put_integer(&w, value, 0, *at == 'u' ? 10 : 16, width, fill);
        } else if (*at == 'g' || *at == 'f') {
            double value = va_arg(arguments, double);
            put_text(&w, text, host_write(value, precision < 0 ? 6 : precision, *at == 'f', text), width, fill);
        } else {
            put(&w, *at);
        }
    }
    if (size > 0) w.out[w.used < size ? w.used : size - 1] = 0;
    return (int)w.used;
}

int snprintf(char *restrict out, size_t size, const char *restrict format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(out, size, format, arguments);
    va_end(arguments);
    return length;
}
