// asset_bytes.h - assets as bytes: what collision/cooked writes of a form, behind a header and the asset's materials.
//
//   0  magic (8 bytes) | version | kind | features | number of materials (4 each) | size (8) | hash (8)
//  40  materials | the form | zeros up to a multiple of 8
//
// The hash, of all bytes but its own, is against accidents: who wants to deceive computes it anew. A kind, a version or
// a feature that is not known is of a newer library. An asset that is made of others would hold them one after another,
// each with its header: sizes are multiples of 8 for that.
#ifndef FE_STORE_ASSET_BYTES_H
#define FE_STORE_ASSET_BYTES_H
#include "collision/cooked/cooked.h"
#include "store/store.h"

int64_t fe__asset_bytes(const fe__asset *asset);                  // the size of what is written
void fe__asset_write(const fe__asset *asset, unsigned char *out); // under the lock; but for the hash
void fe__asset_seal(unsigned char *out, int64_t size);            // the hash, without the lock

// A copy of what is sound. cooked->result otherwise: FE_ERROR_DATA, FE_ERROR_VERSION, with a sentence; FE_ERROR_MEMORY,
// FE_ERROR_LIMIT without one. Then nothing changed. The store's lock is free while bytes are read.
fe_result fe__asset_read(fe_store *store, const void *bytes, int64_t size, fe__cooked *cooked, fe_asset *out_handle);

#endif
