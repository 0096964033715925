// cooked.h - the forms of assets as bytes, and back.
//
// Little-endian, without padding and pointers: the same bytes on every machine. What follows from the rest is not
// written. Bounds, the boxes of a tree, planes' distances, masses and shortcuts are computed when the form is read, by
// the code that its builder uses, so that they hold whatever the bytes are. What is written is checked, each index,
// count and float, in a time that grows with the number of bytes, before anything rests on it.
//
// Reading takes three steps: counts, which tell how many bytes the form has and what memory it needs; arrays, for which
// the caller has compared that number with what is there; checks on the way.
//
//   heightfield   rows, columns, cell_x, cell_z | heights | cells
//   hull          vertices, faces, directions (counts) | origin, thickness, extent, tolerance, error | vertices |
//                 normals | directions | half-edge of each corner | corners of each face (counts) | corners
//   mesh          counts | vertices | leaves | numbers | data | edges | tree | materials of triangles
//
// The tree of a mesh: a byte for each node, children in a row behind their parent's: how many there are, and
// FE__COOKED_BOTTOM when they are leaves.
#ifndef FE_COLLISION_COOKED_COOKED_H
#define FE_COLLISION_COOKED_COOKED_H
#include "collision/form/heightfield.h"
#include "collision/form/hull.h"
#include "collision/form/mesh.h"
#include "core/bytes.h"

enum { FE__COOKED_BOTTOM = 128 };

// What is to be read, and why it was refused
enum { FE__COOKED_SENTENCE = 160 };
typedef struct fe__cooked {
    const unsigned char *begin, *at;
    fe_result result;
    char sentence[FE__COOKED_SENTENCE]; // with the byte's place
} fe__cooked;

// Keeps the sentence, about the bytes at `at`; returns 0.
int32_t fe__cooked_refuse(fe__cooked *cooked, const unsigned char *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// 0: refused, by its name
int32_t fe__cooked_int(fe__cooked *cooked, const char *name, int32_t low, int32_t high, int32_t *out);
int32_t fe__cooked_float(fe__cooked *cooked, const char *name, float low, float high, float *out);

// ---- heightfields --------------------------------------------------------------------------------------------------
int64_t fe__cooked_field_size(const fe__heightfield *field); // bytes
unsigned char *fe__cooked_field_write(const fe__heightfield *field, unsigned char *out);
enum { FE__COOKED_FIELD_COUNTS = 16 }; // bytes, that must be there before counts are read
int32_t fe__cooked_field_counts(fe__cooked *cooked, fe__heightfield *out);
// Its arrays are there; `cells` too if it has them. material_count: of the asset
int32_t fe__cooked_field_read(fe__cooked *cooked, fe__heightfield *field, int32_t material_count);

// ---- hulls ---------------------------------------------------------------------------------------------------------
int64_t fe__cooked_hull_size(const fe__hull *hull);
unsigned char *fe__cooked_hull_write(const fe__hull *hull, unsigned char *out);
enum { FE__COOKED_HULL_COUNTS = 12 };
int32_t fe__cooked_hull_counts(fe__cooked *cooked, fe__hull *out);
int64_t fe__cooked_hull_block(const fe__hull *hull); // its size, bytes
int32_t fe__cooked_hull_read(fe__cooked *cooked, fe__hull *hull, void *block);

// ---- meshes --------------------------------------------------------------------------------------------------------
int64_t fe__cooked_mesh_size(const fe__mesh *mesh);
unsigned char *fe__cooked_mesh_write(const fe__mesh *mesh, unsigned char *out);
enum { FE__COOKED_MESH_COUNTS = 36 };
typedef struct fe__cooked_mesh { // what the header says of it
    int32_t is_two_sided, has_data, material_count;
} fe__cooked_mesh;
int32_t fe__cooked_mesh_counts(fe__cooked *cooked, fe__mesh *out);
int64_t fe__cooked_mesh_arrays(const fe__mesh *mesh, const fe__cooked_mesh *header); // bytes after the counts
int64_t fe__cooked_mesh_block(const fe__mesh *mesh, const fe__cooked_mesh *header);
int64_t fe__cooked_mesh_scratch(const fe__mesh *mesh);
// Block and scratch are aligned to 64, the block is zeroed.
int32_t fe__cooked_mesh_read(fe__cooked *cooked, const fe__cooked_mesh *header, fe__mesh *mesh, void *block,
                             void *scratch);

// ---- materials -----------------------------------------------------------------------------------------------------
enum { FE__COOKED_MATERIAL = 48 }; // bytes
unsigned char *fe__cooked_material_write(const fe_material *material, unsigned char *out);
int32_t fe__cooked_material_read(fe__cooked *cooked, int32_t index, fe_material *out);

#endif
