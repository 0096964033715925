// file.c - see file.h. Memory is asked for as bytes come, whatever a header promises.
#include "replay/file.h"

#include "core/bytes.h"
#include "state/format.h"

#include <stdarg.h>
#include <stdio.h>

static fe_result refuse(fe__file *f, fe_result why, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(f->sentence, sizeof f->sentence, format, arguments);
    va_end(arguments);
    return f->refused = why;
}

// ---- the header of the file ----------------------------------------------------------------------------------------
static fe_result open_header(fe__file *f)
{
    const unsigned char *at = f->header, *sum = f->header + FE__RECORDING_SUM_AT;
    if (memcmp(at, fe__recording_magic, sizeof fe__recording_magic) != 0)
        return refuse(f, FE_ERROR_DATA, "these bytes are no recording");
    at += sizeof fe__recording_magic;
    uint32_t major = fe__take_u16(&at);
    fe__take_u16(&at); // what a minor version adds is passed over
    if (fe__take_u64(&sum) != fe__recording_sum(f->header))
        return refuse(f, FE_ERROR_DATA, "the header was altered: its sum is another");
    if (major != FE__RECORDING_MAJOR)
        return refuse(f, FE_ERROR_VERSION, "the recording has format %u, this library reads %d", (unsigned)major,
                      FE__RECORDING_MAJOR);
    f->results = fe__take_u32(&at);
    f->library = fe__take_u32(&at);
    f->flags = fe__take_u32(&at);
    f->bytes = FE__RECORDING_HEADER;
    f->header_size = 0;
    return FE_OK;
}

// ---- chunks --------------------------------------------------------------------------------------------------------
static int64_t promised_size(const fe__file *f)
{
    const unsigned char *at = f->header + 8;
    return (int64_t)fe__take_u64(&at);
}

static fe_result check_front(fe__file *f)
{
    int64_t size = promised_size(f);
    if (size < 0 || size >= INT32_MAX)
        return refuse(f, FE_ERROR_DATA, "the chunk at byte %lld has a size that none has", (long long)f->bytes);
    const unsigned char *at = f->header + 4;
    if (fe__take_u32(&at) & FE__CHUNK_DEFLATED)
        return refuse(f, FE_ERROR_UNSUPPORTED, "the chunk at byte %lld is packed: tools/feather-rec unpacks it",
                      (long long)f->bytes);
    return FE_OK;
}

static int32_t is_too_short(const fe__fed_chunk *c)
{
    switch (c->type) {
    case FE__CHUNK_KEYFRAME:
        return c->size < FE__KEYFRAME_FRONT;
    case FE__CHUNK_ASSET:
        return c->size < FE__ASSET_KEY;
    case FE__CHUNK_NOTE:
        return c->size < FE__NOTE_FRONT;
    default:
        return 0;
    }
}

// A text ends with 0: padding may be none
static fe_result end_text(fe__file *f, fe__fed_chunk *c)
{
    int32_t capacity = (int32_t)c->capacity;
    if (!fe__reserve(f->memory, &c->content, &capacity, c->size + 1, 1)) return FE_ERROR_MEMORY;
    c->capacity = capacity;
    c->content[c->size] = 0;
    return FE_OK;
}

static int32_t is_known(uint32_t type)
{
    return type == FE__CHUNK_KEYFRAME || type == FE__CHUNK_ASSET || type == FE__CHUNK_OPS || type == FE__CHUNK_NOTE;
}

static fe_result close_chunk(fe__file *f)
{
    const unsigned char *at = f->header;
    fe__fed_chunk c = {.type = fe__take_u32(&at), .flags = fe__take_u32(&at)};
    c.size = promised_size(f);
    at = f->header + 16;
    uint64_t sum = fe__take_u64(&at);
    c.step = (int64_t)fe__take_u64(&at);
    if (sum != fe__chunk_sum(f->header, f->content))
        return refuse(f, FE_ERROR_DATA, "the chunk at byte %lld was altered: its sum is another", (long long)f->bytes);
    if (is_too_short(&c) || c.step < 0)
        return refuse(f, FE_ERROR_DATA, "the chunk at byte %lld is no such chunk", (long long)f->bytes);
    if (!FE_RESERVE(f->memory, f->chunks, f->chunk_capacity, f->chunk_count + 1)) return FE_ERROR_MEMORY;
    c.content = f->content, c.capacity = f->content_capacity;
    if (c.type == FE__CHUNK_NOTE && end_text(f, &c) != FE_OK) return FE_ERROR_MEMORY;
    f->bytes += FE__CHUNK_HEADER + fe__padded(c.size);
    f->header_size = 0;
    f->content_size = 0;
    if (!is_known(c.type)) return FE_OK; // its room serves the next one
    f->content = NULL, f->content_capacity = 0;
    f->chunks[f->chunk_count++] = c;
    f->keyframes += c.type == FE__CHUNK_KEYFRAME;
    f->notes += c.type == FE__CHUNK_NOTE;
    return FE_OK;
}

// ---- bytes ---------------------------------------------------------------------------------------------------------
static int64_t fill_header(fe__file *f, const unsigned char *bytes, int64_t size)
{
    int64_t whole = f->library ? FE__CHUNK_HEADER : FE__RECORDING_HEADER, lacks = whole - f->header_size;
    int64_t taken = size < lacks ? size : lacks;
    memcpy(f->header + f->header_size, bytes, (size_t)taken);
    f->header_size += (int32_t)taken;
    return taken;
}

// -1: no memory
static int64_t fill_content(fe__file *f, const unsigned char *bytes, int64_t size)
{
    int64_t lacks = fe__padded(promised_size(f)) - f->content_size, taken = size < lacks ? size : lacks;
    if (f->content_size == 0 && taken == lacks)
        FE_FREE(f->memory, f->content, f->content_capacity); // it is all here: room for just that
    if (!FE_RESERVE(f->memory, f->content, f->content_capacity, f->content_size + taken + 8)) return -1;
    if (taken) memcpy(f->content + f->content_size, bytes, (size_t)taken);
    f->content_size += taken;
    return taken;
}

static fe_result feed_some(fe__file *f, const unsigned char *bytes, int64_t size, int64_t *out_taken)
{
    int32_t whole = f->library ? FE__CHUNK_HEADER : FE__RECORDING_HEADER;
    *out_taken = 0;
    if (f->header_size < whole) {
        *out_taken = fill_header(f, bytes, size);
        if (f->header_size < whole) return FE_OK;
        return f->library ? check_front(f) : open_header(f);
    }
    int64_t taken = fill_content(f, bytes, size);
    if (taken < 0) return FE_ERROR_MEMORY;
    *out_taken = taken;
    return f->content_size == fe__padded(promised_size(f)) ? close_chunk(f) : FE_OK;
}

// A chunk without content is, with its header
static int32_t is_whole(const fe__file *f)
{
    return f->library && f->header_size == FE__CHUNK_HEADER && f->content_size == fe__padded(promised_size(f));
}

fe_result fe__file_feed(fe__file *f, const unsigned char *bytes, int64_t size)
{
    int64_t at = f->owed;
    f->owed = 0;
    while (f->refused == FE_OK && (at < size || is_whole(f))) {
        int64_t taken;
        fe_result result = feed_some(f, bytes + at, size - at, &taken);
        at += taken;
        if (result == FE_ERROR_MEMORY) f->owed = at;
        if (result != FE_OK) return result;
    }
    return f->refused;
}

void fe__file_free(fe__file *f)
{
    for (int32_t i = 0; i < f->chunk_count; ++i)
        fe__release(f->memory, f->chunks[i].content, (size_t)f->chunks[i].capacity);
    FE_FREE(f->memory, f->chunks, f->chunk_capacity);
    FE_FREE(f->memory, f->content, f->content_capacity);
}

// The last one: an asset's content does not change with its key
const unsigned char *fe__file_find_asset(const fe__file *f, const uint64_t *key, int64_t *out_size)
{
    for (int32_t i = f->chunk_count - 1; i >= 0; --i) {
        const fe__fed_chunk *c = f->chunks + i;
        const unsigned char *at = c->content;
        if (c->type != FE__CHUNK_ASSET) continue;
        if (fe__take_u64(&at) != key[0] || fe__take_u64(&at) != key[1]) continue;
        *out_size = c->size - FE__ASSET_KEY;
        return at;
    }
    return NULL;
}
