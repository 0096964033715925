// op_in.c - see op_in.h.
#include "replay/op_in.h"

const unsigned char *fe__in_bytes(fe__op_in *in, int64_t size)
{
    if (in->result != FE_OK) return NULL;
    if (size < 0 || size > in->end - in->at) {
        in->result = FE_ERROR_DATA;
        return NULL;
    }
    const unsigned char *at = in->at;
    in->at += size;
    return at;
}

uint8_t fe__in_u8(fe__op_in *in)
{
    const unsigned char *at = fe__in_bytes(in, 1);
    return at ? *at : 0;
}
uint32_t fe__in_u32(fe__op_in *in)
{
    const unsigned char *at = fe__in_bytes(in, sizeof(uint32_t));
    return at ? fe__take_u32(&at) : 0;
}
uint64_t fe__in_u64(fe__op_in *in)
{
    const unsigned char *at = fe__in_bytes(in, sizeof(uint64_t));
    return at ? fe__take_u64(&at) : 0;
}

uint64_t fe__in_varint(fe__op_in *in)
{
    uint64_t x = 0;
    for (int32_t shift = 0; shift < 64; shift += 7) {
        uint8_t byte = fe__in_u8(in);
        x |= (uint64_t)(byte & 0x7f) << shift;
        if (byte < 0x80) return x;
    }
    in->result = in->result == FE_OK ? FE_ERROR_DATA : in->result;
    return 0;
}

int64_t fe__in_signed(fe__op_in *in)
{
    uint64_t x = fe__in_varint(in);
    return (int64_t)(x >> 1 ^ (~(x & 1) + 1));
}

int32_t fe__in_count(fe__op_in *in)
{
    int32_t count = fe__in_i32(in);
    if (count >= 0) return count;
    in->result = FE_ERROR_DATA;
    return 0;
}

// ---- structs -------------------------------------------------------------------------------------------------------
int32_t fe__in_plain(fe__op_in *in, void *out, size_t size, const fe__words *words)
{
    memset(out, 0, size);
    if (!fe__in_u8(in)) return 0;
    const unsigned char *at = fe__in_bytes(in, (int64_t)size);
    if (at) fe__move_words(out, at, (int64_t)size, words);
    return 1;
}

static void take_sized(fe__op_in *in, void *out, size_t size, const fe__words *words)
{
    memset(out, 0, size);
    const unsigned char *front = in->at;
    uint32_t own = fe__in_u32(in);
    if (in->result != FE_OK) return;
    if (own < sizeof own || own > size) {
        in->result = FE_ERROR_DATA;
        return;
    }
    if (fe__in_bytes(in, (int64_t)own - (int64_t)sizeof own)) fe__move_words(out, front, own, words);
}

int32_t fe__in_sized(fe__op_in *in, void *out, size_t size, const fe__words *words)
{
    if (!fe__in_u8(in)) {
        memset(out, 0, size);
        return 0;
    }
    take_sized(in, out, size, words);
    return 1;
}

// ---- arrays --------------------------------------------------------------------------------------------------------
static void *room_for(fe__op_in *in, int32_t place, int64_t bytes)
{
    if (in->result != FE_OK) return NULL;
    fe__room *room = in->rooms + place;
    if (bytes >= INT32_MAX) {
        in->result = FE_ERROR_DATA;
        return NULL;
    }
    if (fe__renew(in->memory, &room->bytes, &room->capacity, bytes + 1, 1)) return room->bytes;
    in->result = FE_ERROR_MEMORY;
    return NULL;
}

// Counted before memory is asked for: each takes `least` bytes at least
static int32_t has_as_many(fe__op_in *in, int32_t count, size_t least)
{
    if (in->result == FE_OK && (int64_t)count * (int64_t)least > in->end - in->at) in->result = FE_ERROR_DATA;
    return in->result == FE_OK;
}

void *fe__in_array(fe__op_in *in, int32_t place, int32_t count, size_t size, const fe__words *words)
{
    if (!has_as_many(in, count, size)) return NULL;
    unsigned char *out = room_for(in, place, (int64_t)size * count);
    const unsigned char *at = fe__in_bytes(in, (int64_t)size * count);
    for (int32_t i = 0; out && i < count; ++i)
        fe__move_words(out + size * (size_t)i, at + size * (size_t)i, (int64_t)size, words);
    return out;
}

void *fe__in_sized_array(fe__op_in *in, int32_t place, int32_t count, size_t size, const fe__words *words)
{
    if (!has_as_many(in, count, sizeof(uint32_t))) return NULL;
    unsigned char *out = room_for(in, place, (int64_t)size * count);
    for (int32_t i = 0; out && i < count; ++i) take_sized(in, out + size * (size_t)i, size, words);
    return out;
}

void *fe__in_room(fe__op_in *in, int32_t place, int32_t count)
{
    if (!has_as_many(in, 0, 0)) return NULL;
    fe_handle *out = room_for(in, place, (int64_t)sizeof *out * count);
    if (out && count) memset(out, 0, sizeof *out * (size_t)count);
    return out;
}

void fe__in_free(fe__op_in *in)
{
    for (int32_t i = 0; i < FE__IN_ROOMS; ++i) FE_FREE(in->memory, in->rooms[i].bytes, in->rooms[i].capacity);
}

// ---- assets, and what a call came to -------------------------------------------------------------------------------
void fe__in_asset(fe__op_in *in, fe_asset *asset)
{
    for (int32_t i = 0; *asset && i < in->asset_count; ++i) {
        if (in->assets[i].recorded != *asset) continue;
        *asset = in->assets[i].own;
        return;
    }
}

fe_result fe__in_compare(fe__op_in *in, fe_result result, const fe_handle *now, const fe_handle *then, int32_t count)
{
    if (result == FE_ERROR_MEMORY) return result;
    in->failed = result;
    if (result < 0) return FE_ERROR_DIVERGED;
    for (int32_t i = 0; i < count; ++i) {
        if (now[i] == then[i]) continue;
        in->handle = now[i];
        return FE_ERROR_DIVERGED;
    }
    return FE_OK;
}
