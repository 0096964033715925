// asset_bytes.h - assets as bytes: what collision/cooked writes of a form, behind a header and the asset's materials.
//
//   0  magic (8 bytes) | version | kind | features | number of materials (4 each) | size (8) | hash (8)
//  40  materials | the form | zeros up to a multiple of 8
//
// The hash, of all bytes but its own, is against accidents: who wants to deceive computes it anew. A kind, a version or
// a feature that is not known is of a newer library. A compound holds the assets of its parts one after another, each
// with its header (asset_bytes.h).
#ifndef FE_STORE_ASSET_BYTES_H
#define FE_STORE_ASSET_BYTES_H
#include "collision/cooked/cooked.h"
#include "store/store.h"

enum { FE__ASSET_HEADER = 40 }; // bytes

// ---- under the lock ------------------------------------------------------------------------------------------------
int64_t fe__asset_bytes(const fe_store *store, const fe__asset *asset);                  // the size of what is written
void fe__asset_write(const fe_store *store, const fe__asset *asset, unsigned char *out); // but for the hash

// ---- without the lock ----------------------------------------------------------------------------------------------
void fe__asset_seal(unsigned char *out, int64_t size); // the hash

// A copy of what is sound. cooked->result otherwise: FE_ERROR_DATA, FE_ERROR_VERSION, with a sentence; FE_ERROR_MEMORY,
// FE_ERROR_LIMIT without one. Then nothing changed. The store's lock is free while bytes are read.
fe_result fe__asset_read(fe_store *store, const void *bytes, int64_t size, fe__cooked *cooked, fe_asset *out_handle);
// The same of an asset within the bytes of another, which begins at cooked->at and moves it on
fe_result fe__asset_read_part(fe_store *store, fe__cooked *cooked, const unsigned char *end, fe_asset *out_handle);

#endif
