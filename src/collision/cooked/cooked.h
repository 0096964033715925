// cooked.h - the forms of assets as bytes, and back; store/asset_bytes.c adds the header and the memory.
//
// The bytes are little-endian, without padding and pointers: the same on every machine. Numbers that follow from others
// are not written: bounds, the boxes of a tree, planes' distances, masses and shortcuts are computed when the form is
// read, by the code that its builder uses, so that they hold whatever the bytes are. All that is written is checked,
// each index, count and float, before anything rests on it, in a time that grows with the number of bytes.
#ifndef FE_COLLISION_COOKED_COOKED_H
#define FE_COLLISION_COOKED_COOKED_H
#include "collision/form/heightfield.h"
#include "collision/form/hull.h"
#include "collision/form/mesh.h"
#include "core/bytes.h"

// Reading begins with the counts, which tell how many bytes the form has and what memory it needs. The caller compares
// that number with the bytes that are there. Then the arrays are read and checked.
//
//   heightfield   rows, columns, cell_x, cell_z | heights | cells
//   hull          vertices, faces, directions (counts) | origin, thickness, extent, tolerance, error | vertices |
//                 normals | directions | half-edge of each corner | corners of each face (counts) | corners
//   mesh          counts | vertices | leaves | numbers | data | edges | tree | materials of triangles
//
// The tree of a mesh has a byte for each node, the children's in a row behind their parent's. The byte is the number of
// children, and FE__COOKED_BOTTOM if they are leaves.
enum { FE__COOKED_BOTTOM = 128 };

// The bytes that are read, and the reason for refusing them.
enum { FE__COOKED_SENTENCE = 160 };
typedef struct fe__cooked {
    const unsigned char *begin, *at;
    fe_result result;
    char sentence[FE__COOKED_SENTENCE]; // names the byte's place
} fe__cooked;

// Keeps the sentence, about the bytes at `at`; returns 0.
int32_t fe__cooked_refuse(fe__cooked *cooked, const unsigned char *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// These read a number. 0: it is out of range and refused by its name
int32_t fe__cooked_int(fe__cooked *cooked, const char *name, int32_t low, int32_t high, int32_t *out);
int32_t fe__cooked_float(fe__cooked *cooked, const char *name, float low, float high, float *out);

// ---- heightfields --------------------------------------------------------------------------------------------------
int64_t fe__cooked_field_size(const fe__heightfield *field); // bytes
unsigned char *fe__cooked_field_write(const fe__heightfield *field, unsigned char *out);
enum { FE__COOKED_FIELD_COUNTS = 16 }; // bytes; they must be there before counts are read
int32_t fe__cooked_field_counts(fe__cooked *cooked, fe__heightfield *out);
// The field's arrays have memory; cells is NULL if it has none. material_count is the asset's.
int32_t fe__cooked_field_read(fe__cooked *cooked, fe__heightfield *field, int32_t material_count);

// ---- hulls ---------------------------------------------------------------------------------------------------------
int64_t fe__cooked_hull_size(const fe__hull *hull);
unsigned char *fe__cooked_hull_write(const fe__hull *hull, unsigned char *out);
enum { FE__COOKED_HULL_COUNTS = 12 };
int32_t fe__cooked_hull_counts(fe__cooked *cooked, fe__hull *out);
int64_t fe__cooked_hull_block(const fe__hull *hull); // size of the hull's block, bytes
int32_t fe__cooked_hull_read(fe__cooked *cooked, fe__hull *hull, void *block);

// ---- meshes --------------------------------------------------------------------------------------------------------
int64_t fe__cooked_mesh_size(const fe__mesh *mesh);
unsigned char *fe__cooked_mesh_write(const fe__mesh *mesh, unsigned char *out);
enum { FE__COOKED_MESH_COUNTS = 36 };
// The asset's header says this of a mesh.
typedef struct fe__cooked_mesh {
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
