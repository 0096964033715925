/// @file feather.h
/// Feather: 3D rigid-body physics with a C99 interface.
///
/// A **world** holds everything. Inside it, bodies, shapes and joints have **handles**: integers with a generation. The
/// handle of something destroyed, or a number made up, is an error and never a crash. A body has a pose, a mass and
/// velocities. Its shapes give it form, material and filters. `fe_world_step` moves the world on. After it, events and
/// poses are read as arrays.
///
/// **Units and frames.** Metres, kilograms, seconds, radians. Axes are right-handed; no axis is "up". Quaternions are
/// x, y, z, w. World positions are double, everything else is float. A contact's normal points from its body A to its
/// body B.
///
/// **Results.** A function that can fail returns an `fe_result` or a count. FE_OK is 0, positive results inform,
/// negative ones are errors. An error has changed nothing. Queries and arrays return a count: 0 when there is nothing,
/// negative for an error. Every function checks for these errors; its own comment names only what is special to it:
///
/// | result              | cause                                                                                  |
/// |---------------------|----------------------------------------------------------------------------------------|
/// | FE_ERROR_ARGUMENT   | a NULL pointer that is not documented as optional, NaN, infinity, a value out of range |
/// | FE_ERROR_STALE      | the handle of something destroyed, of another world, or of nothing                     |
/// | FE_ERROR_KIND       | a shape's handle where a body's is expected                                            |
/// | FE_ERROR_STEPPING   | any call but `_is_valid` while this world is in a step                                 |
/// | FE_ERROR_BUSY       | another thread is inside a call that this one excludes, see Threads                    |
/// | FE_ERROR_MEMORY     | the allocator returned NULL                                                            |
///
/// `fe_last_error` describes the calling thread's last failure in a sentence. Values come out through `out_` pointers.
/// They are written on success only.
///
/// **Ranges.** They hold wherever a function names no others:
///
/// | quantity                                    | range                                                        |
/// |---------------------------------------------|--------------------------------------------------------------|
/// | position, translation of a query            | within 1e9 m, within 1e10 m                                  |
/// | local position                              | within 1e6 m                                                 |
/// | speed, angular speed, gravity               | within 1e6                                                   |
/// | force, torque, impulse                      | within 1e15 a call; their sum accelerates by at most 1e9 m/s2 |
/// | density, mass, moment of inertia            | 0..1e7 kg/m3, 1e-9..1e18 kg, 1e-18..1e30 kg m2               |
/// | other values                                | within 1e6                                                   |
/// | switches (int32_t enabled, trigger...)      | 0 or 1                                                       |
/// | fields called `reserved`                    | 0                                                            |
///
/// **Arrays.** `int32_t fe_x_get_many(world, out, stride, capacity)` returns how many there are. It writes the first
/// `capacity` of them, `stride` bytes apart. NULL, 0, 0 asks for the number only. A record that may grow needs its
/// stride stated: `sizeof` of the caller's record. A shorter stride gets the record's front, at least 8 bytes. For
/// records that never grow 0 means packed: handles, floats, int32_t, fe_vec3, fe_dvec3, fe_quat, fe_transform,
/// fe_frame, fe_bounds, fe_material, fe_joint_axis.
///
/// **Growth.** A program built against this header runs with every later 1.x library. A struct that may grow begins
/// with `struct_size`; its `_init(&x, sizeof x)` sets that and every default, and does nothing with NULL. A shorter
/// struct of an older client is accepted, so is a longer one with a zero tail. A size that ends inside a field is
/// refused. Enumerators begin with FE_ and the enum's name without its closing _type, _kind or _flags; results are
/// FE_OK, others that inform, and FE_ERROR_ with a reason.
///
/// **Threads.** Different worlds are independent. Functions with a `const` world only read: any number of threads may
/// call them at once, while none writes. All others write and need the world to themselves. A second writer gets
/// FE_ERROR_BUSY, and so does a reader while another thread writes. While another thread reads, steps, destructions and
/// calls that make or remove something get it; other writes do not notice readers and must not meet them.
/// A call that begins after fe_world_destroy has returned is undefined, as after free.
///
/// **Determinism.** The same calls in the same order give the same bits, handles and events: on every machine, with
/// every number of workers and every SIMD width. Handles agree when the worlds have the same number, see fe_world_def.
/// `fe_world_hash` compares two runs.
#ifndef FEATHER_H
#define FEATHER_H

#include <stdint.h>

/// The version of this header. Programs of another major number do not run with it.
#define FE_VERSION_MAJOR 1
/// Grows with what is added.
#define FE_VERSION_MINOR 0
/// Grows with what is mended.
#define FE_VERSION_PATCH 0

#ifdef SWIG
#define FE_API
#elif defined(_WIN32) && defined(FE_SHARED)
#ifdef FE_BUILD
#define FE_API __declspec(dllexport)
#else
#define FE_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define FE_API __attribute__((visibility("default")))
#else
#define FE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

// ---- basics ---------------------------------------------------------------------------------------------------------

/// Names something inside a world or a store. 0 is nothing. Every other value is below 2^53 and survives a double.
typedef unsigned long long fe_handle;
typedef fe_handle fe_body;
typedef fe_handle fe_shape;
typedef fe_handle fe_joint;
typedef fe_handle fe_asset; ///< what shapes of many worlds share: a heightfield, a convex hull, a mesh, a compound

typedef struct fe_world fe_world;       ///< everything that can touch each other
typedef struct fe_pool fe_pool;         ///< worker threads that several worlds may share
typedef struct fe_store fe_store;       ///< assets that several worlds may share
typedef struct fe_recorder fe_recorder; ///< a recording of a world while it grows
typedef struct fe_player fe_player;     ///< a world that does what a recording says
typedef struct fe_history fe_history;   ///< the last frames of a world, to go back to
typedef struct fe_state fe_state;       ///< what a world was, for any world of the same store
typedef struct fe_batch fe_batch;       ///< many worlds, made from one, that step together

/// A vector: m, m/s, N... as its field says.
typedef struct fe_vec3 {
    float x, y, z;
} fe_vec3;

/// A world position, m, or a translation of a query.
typedef struct fe_dvec3 {
    double x, y, z;
} fe_dvec3;

/// A rotation. It is read as q/|q|: any length but zero will do.
typedef struct fe_quat {
    float x, y, z, w;
} fe_quat;

/// A pose in the world.
typedef struct fe_transform {
    fe_dvec3 position; ///< m
    fe_quat rotation;  ///< from its own axes to the world's
} fe_transform;

/// A frame in the space of a body.
typedef struct fe_frame {
    fe_vec3 position; ///< m
    fe_quat rotation; ///< from its own axes to the body's
} fe_frame;

/// An axis-aligned box in world space, m.
typedef struct fe_bounds {
    fe_dvec3 lower, upper; ///< its least and its greatest corner
} fe_bounds;

/// What a call came to. Below 0: an error, and nothing has changed.
typedef enum fe_result {
    FE_OK = 0,                 ///< done
    FE_FOREIGN = 2,            ///< done, from data of a library whose results differ
    FE_END = 3,                ///< done, and there is no more
    FE_ERROR_ARGUMENT = -1,    ///< NULL, NaN, infinity, out of range
    FE_ERROR_STALE = -2,       ///< the handle of something destroyed, of another world, or of nothing
    FE_ERROR_KIND = -3,        ///< a shape's handle where a body's is expected, a hull's where a mesh's is
    FE_ERROR_STEPPING = -4,    ///< the world is in a step
    FE_ERROR_MEMORY = -5,      ///< the allocator returned NULL
    FE_ERROR_LIMIT = -6,       ///< more than a world, a store, a mesh or a handle can hold
    FE_ERROR_UNSUPPORTED = -7, ///< this CPU, this kind of body or this geometry cannot
    FE_ERROR_STATE = -8,       ///< not now: the pool still has worlds, the body is not kinematic...
    FE_ERROR_BUSY = -9,        ///< another thread is inside the world
    FE_ERROR_DEGENERATE = -10, ///< flat or empty input of a builder
    FE_ERROR_DATA = -11,       ///< cut, altered or foreign bytes
    FE_ERROR_VERSION = -12,    ///< bytes of a newer format, or of one before 1.0
    FE_ERROR_DIVERGED = -13,   ///< a replay went another way than its recording
    FE_RESULT_FORCE32 = 0x7fffffff
} fe_result;

/// The library's version: major << 16 | minor << 8 | patch. Compare it with FE_VERSION_MAJOR and FE_VERSION_MINOR to
/// find a mismatch of header and binary.
FE_API uint32_t fe_version(void);
/// The last failure of the calling thread: function, argument, value, legal range. It is valid until that thread's next
/// failure; success does not clear it. Never NULL.
FE_API const char *fe_last_error(void);
/// "FE_ERROR_STALE" for FE_ERROR_STALE, and so on; "unknown" for what is no result.
FE_API const char *fe_result_name(int32_t result);

// ---- pools ----------------------------------------------------------------------------------------------------------

/// Starts a pool of workers that worlds can share (fe_world_def.pool). The thread that steps a world works too: a pool
/// of n workers starts n - 1 threads. They sleep while nothing steps.
/// @param worker_count  1..64
FE_API fe_result fe_pool_create(int32_t worker_count, fe_pool **out_pool);
/// Ends the threads. A definition that still names the pool is refused by fe_world_create with FE_ERROR_STALE.
/// @return FE_ERROR_STATE while a world uses the pool; FE_ERROR_STALE for a pool that is gone already
FE_API fe_result fe_pool_destroy(fe_pool *pool);

// ---- stores and assets ----------------------------------------------------------------------------------------------
//
// A store holds assets: heavy data that the shapes of many worlds share. Any thread may create, read and destroy assets
// of a store while worlds that use it step. A world without a store in its definition has one of its own. The handles
// of assets carry their store's number. Creation from several threads at once may change these handles, and nothing
// else.

/// The host's allocator. A world calls it from the thread that uses the world, never from workers. A store calls its
/// own from any thread, one call at a time. A world and its own store share one, and take turns.
typedef struct fe_allocator {
    uint32_t struct_size;
    uint32_t reserved;
    /// `size` bytes aligned to `alignment` (a power of two, at most 64), or NULL
    void *(*allocate)(void *user, uint64_t size, uint64_t alignment);
    /// gives back what `allocate` returned, with its size
    void (*release)(void *user, void *memory, uint64_t size);
    void *user; ///< handed to both
} fe_allocator;

FE_API void fe_allocator_init(fe_allocator *allocator, uint32_t struct_size);

/// How a store begins.
typedef struct fe_store_def {
    uint32_t struct_size;
    uint32_t number;               ///< 1..4095, part of its assets' handles; 0: the next free one. Default 0
    const fe_allocator *allocator; ///< copied; NULL: malloc
} fe_store_def;

FE_API void fe_store_def_init(fe_store_def *def, uint32_t struct_size);
/// @param def  NULL: the defaults
FE_API fe_result fe_store_create(const fe_store_def *def, fe_store **out_store);
/// Frees the store and all its assets.
/// @return FE_ERROR_STATE while a world uses the store, or for a world's own store; FE_ERROR_STALE for a store that is
///         gone already
FE_API fe_result fe_store_destroy(fe_store *store);
/// Memory of the store and its assets.
FE_API fe_result fe_store_get_bytes(const fe_store *store, int64_t *out_bytes);
/// The handle dies at once. The asset's data lives until the last shape that uses it is gone.
FE_API fe_result fe_asset_destroy(fe_store *store, fe_asset asset);
/// 1 for a living asset of this store, 0 for anything else.
FE_API int32_t fe_asset_is_valid(const fe_store *store, fe_asset asset);
/// What it is the form of: FE_GEOMETRY_HULL, FE_GEOMETRY_HEIGHTFIELD, FE_GEOMETRY_MESH or FE_GEOMETRY_COMPOUND.
/// @return a fe_geometry_type, or an error
FE_API int32_t fe_asset_get_type(const fe_store *store, fe_asset asset);

/// Writes an asset as bytes: cook hulls, meshes and heightfields when a game is built, load them when it starts. The
/// bytes are little-endian and hold no pointers. The same asset gives the same bytes on every machine, and a loaded one
/// the bytes that it was loaded from. They hold its materials, a heightfield's heights as they are now, a mesh's
/// triangle_data and numbers, and of a compound the assets of its parts; a scale is the shape's, and not among them.
/// Any later 1.x library loads them.
/// @param out       at any alignment; NULL, 0 asks for the size only
/// @param capacity  bytes; with less than the size nothing is written
/// @return the size in bytes, or an error
FE_API int64_t fe_asset_save(const fe_store *store, fe_asset asset, void *out, int64_t capacity);
/// Makes the asset that fe_asset_save wrote, in less time than it was built. It moves every world as the saved one
/// does, bit for bit. Bytes from anywhere may be given: each number in them is checked, and what is accepted is sound,
/// even if nobody saved it. Any thread may load while worlds that use the store step. The assets of a compound's parts
/// are loaded with it, and live as long as it does.
/// @param bytes  copied; at any alignment
/// @param size   of them, as fe_asset_save returned it
/// @return FE_ERROR_DATA for bytes that are cut, altered or of something else, fe_last_error tells what is wrong and at
///         which byte; FE_ERROR_VERSION for those of a newer library
FE_API fe_result fe_asset_load(fe_store *store, const void *bytes, int64_t size, fe_asset *out_asset);

// ---- materials ------------------------------------------------------------------------------------------------------

/// How the values of two materials mix. The pair uses the higher mode of the two: ice with FE_COMBINE_MINIMUM is
/// slippery on any floor whose mode is lower.
typedef enum fe_combine {
    FE_COMBINE_DEFAULT = 0,  ///< friction: geometric mean, sqrt(a b); restitution: maximum
    FE_COMBINE_AVERAGE = 1,  ///< (a + b) / 2
    FE_COMBINE_MINIMUM = 2,  ///< the smaller
    FE_COMBINE_MULTIPLY = 3, ///< a b
    FE_COMBINE_MAXIMUM = 4,  ///< the larger
    FE_COMBINE_FORCE32 = 0x7fffffff
} fe_combine;

/// A surface. Rolling and spinning resistance of a pair are the larger of the two, and so is its radius: of a cone that
/// of the base, of boxes and hulls 0. Never grows.
typedef struct fe_material {
    float static_friction;       ///< while the contact sticks, >= 0. Default 0.6
    float dynamic_friction;      ///< when it slides, >= 0. Default 0.5
    float restitution;           ///< 0..1. Default 0
    float rolling_resistance;    ///< no unit, >= 0: torque cap = it x radius x normal force. Default 0
    float spinning_resistance;   ///< m, >= 0: torque cap about the normal = it x normal force. Default 0
    int32_t friction_combine;    ///< fe_combine, of both frictions. Default FE_COMBINE_DEFAULT
    int32_t restitution_combine; ///< fe_combine. Default FE_COMBINE_DEFAULT
    uint32_t reserved[3];
    uint64_t user_id; ///< any number of yours: hits, contacts and hit events report it. Default 0
} fe_material;

/// The defaults. Never grows, hence without a size.
FE_API void fe_material_init(fe_material *material);

// ---- heightfields ---------------------------------------------------------------------------------------------------

/// A grid of heights: terrain. In the shape's frame, sample (row, column) stands at x = column * cell_x,
/// z = row * cell_z, its height along y. Cell row * (columns - 1) + column of the arrays below lies between samples
/// (row, column) and (row + 1, column + 1). The diagonal between these two cuts it into triangle 2 * cell (its z side)
/// and triangle 2 * cell + 1 (its x side). Hits and contacts report these numbers.
///
/// Only the upper side counts: rays from below pass. Edges between triangles are felt only where the surface is convex,
/// also across the border of two heightfields that meet. The rims of holes and of the whole carry like any edge. A body
/// pressed into the terrain is pushed out, unless its centre is deeper than the body's radius.
typedef struct fe_heightfield_def {
    uint32_t struct_size;
    int32_t rows;             ///< of samples, along z, 2..32768; rows * columns <= 2^28
    int32_t columns;          ///< of samples, along x, 2..32768
    int32_t material_count;   ///< 0..255
    float cell_x;             ///< from column to column, m, 0.001..100000; all columns within 1e6 m
    float cell_z;             ///< from row to row
    uint32_t material_stride; ///< bytes from one material to the next, 0: packed
    uint32_t reserved;
    const float *heights;          ///< rows x columns, row by row, m, within +-1e6. All arrays are copied
    const uint8_t *holes;          ///< a cell each: 1 is a hole, 0 is none; NULL: no holes
    const uint8_t *cell_materials; ///< a cell each: index into `materials`; NULL: every cell has the shape's material
    const fe_material *materials;  ///< replace the shape's material
} fe_heightfield_def;

FE_API void fe_heightfield_def_init(fe_heightfield_def *def, uint32_t struct_size);
/// Any number of shapes, in any world that uses the store, may share it (fe_geometry_heightfield).
/// @return FE_ERROR_ARGUMENT for a count, a height or a cell out of range, with its place
FE_API fe_result fe_heightfield_create(fe_store *store, const fe_heightfield_def *def, fe_asset *out_asset);
/// Changes the samples of a rectangle. Bodies near it wake in every world, and touch the new surface in the next step.
/// @param row, column    its first sample
/// @param rows, columns  its size, >= 1
/// @param heights        rows x columns, row by row, m
/// @return FE_ERROR_STEPPING while a world that uses it steps; FE_ERROR_BUSY while another thread is inside such a
///         world; FE_ERROR_KIND for an asset that is no heightfield
FE_API fe_result fe_heightfield_set_heights(fe_store *store, fe_asset asset, int32_t row, int32_t column, int32_t rows,
                                            int32_t columns, const float *heights);
/// @param out_heights  rows x columns, row by row, m
FE_API fe_result fe_heightfield_get_heights(const fe_store *store, fe_asset asset, int32_t row, int32_t column,
                                            int32_t rows, int32_t columns, float *out_heights);

// ---- convex hulls ---------------------------------------------------------------------------------------------------

/// The convex hull of points. No points but thin ones are refused. Where there are more vertices than `max_vertices`,
/// those that change the form least are left out, and fe_hull_info.error tells how far they lie outside.
typedef struct fe_hull_def {
    uint32_t struct_size;
    int32_t point_count;   ///< 4..1 000 000
    int32_t max_vertices;  ///< 4..255. Default 64
    uint32_t point_stride; ///< bytes from one point to the next, 0: packed
    /// Points nearer than this to the hull may be left out, and faces that bend less are merged, m, 0..100000. At
    /// least 5e-6 of the extent counts. 0: 1e-5 of the extent, the longest side of the points' bounds. Default 0
    float tolerance;
    uint32_t reserved;
    const float *points; ///< x y z each, m, within +-100000, in any order; inner points and duplicates are welcome
} fe_hull_def;

FE_API void fe_hull_def_init(fe_hull_def *def, uint32_t struct_size);
/// Builds a hull. The same points in the same order give the same hull, bit for bit, on every machine. The points are
/// copied. fe_asset_destroy gives the hull back. Any thread may build while worlds that use the store step.
/// @return FE_ERROR_ARGUMENT for a count or a coordinate out of range, with its place; FE_ERROR_DEGENERATE for points
///         that are thinner, in some direction, than 0.5 mm or 1e-4 of the extent: flat, straight or in one place
FE_API fe_result fe_hull_create(fe_store *store, const fe_hull_def *def, fe_asset *out_asset);

/// What a hull is. Positions are in the frame of its points.
typedef struct fe_hull_info {
    uint32_t struct_size;
    int32_t vertex_count;     ///< 4..255
    int32_t edge_count;       ///< vertices - edges + faces = 2
    int32_t face_count;       ///< 4..506
    float volume;             ///< m3
    float area;               ///< of the surface, m2
    fe_vec3 centre;           ///< of mass, m
    fe_vec3 inertia;          ///< principal moments about the centre at a density of 1 kg/m3, kg m2
    fe_quat inertia_rotation; ///< from the principal axes to those of the points
    fe_vec3 lower, upper;     ///< least and greatest corner of the bounds of the vertices, m
    float thickness;          ///< the least distance between a face and the vertex farthest from it, m
    float inner_radius;       ///< of the largest ball about the centre that is inside, m
    float tolerance;          ///< what counted, m
    float error;              ///< how far the farthest point that was left out lies outside a face's plane, m, >= 0
    int64_t bytes;            ///< of memory
} fe_hull_info;

FE_API void fe_hull_info_init(fe_hull_info *info, uint32_t struct_size);
/// @param out_info  its struct_size must be set
/// @return FE_ERROR_KIND for an asset that is no hull
FE_API fe_result fe_hull_get_info(const fe_store *store, fe_asset hull, fe_hull_info *out_info);
/// Its vertices, m: points of its definition, bit for bit, in their order. @param stride  bytes, 0: packed
FE_API int32_t fe_hull_get_vertices(const fe_store *store, fe_asset hull, fe_vec3 *out_vertices, uint32_t stride,
                                    int32_t capacity);

/// A face of a hull: a convex polygon.
typedef struct fe_hull_face {
    int32_t first;  ///< of its corners in what fe_hull_get_corners writes
    int32_t count;  ///< of corners, >= 3
    fe_vec3 normal; ///< unit, outward
    float distance; ///< no point p of the hull is beyond it: normal . p <= distance, m, but for the rounding of floats
    uint32_t reserved[2];
} fe_hull_face;

/// Its faces. @param stride  bytes: sizeof of the caller's record
FE_API int32_t fe_hull_get_faces(const fe_store *store, fe_asset hull, fe_hull_face *out_faces, uint32_t stride,
                                 int32_t capacity);
/// The corners of all faces, face by face: indices of vertices, counterclockwise seen from outside. To draw a face,
/// make a fan of triangles from its first corner. @param stride  bytes, 0: packed
FE_API int32_t fe_hull_get_corners(const fe_store *store, fe_asset hull, int32_t *out_corners, uint32_t stride,
                                   int32_t capacity);

// ---- meshes ---------------------------------------------------------------------------------------------------------

/// What a mesh is built as.
typedef enum fe_mesh_flags {
    FE_MESH_TWO_SIDED = 1, ///< both sides of its triangles count; hits from behind are told apart by FE_HIT_BACK
    FE_MESH_STRICT = 2,    ///< a triangle that would be dropped is an error
    FE_MESH_FORCE32 = 0x7fffffff
} fe_mesh_flags;

/// The type of the indices of a mesh.
typedef enum fe_index_type {
    FE_INDEX_U32 = 0, ///< uint32_t
    FE_INDEX_U16 = 1, ///< uint16_t
    FE_INDEX_FORCE32 = 0x7fffffff
} fe_index_type;

/// Triangles of any form. Only the side from which the corners run counterclockwise counts, unless the mesh is
/// two-sided: a mesh that is wound the wrong way lets everything pass. fe_mesh_info.volume of a closed mesh is then
/// negative, and `flipped_edges` counts neighbours that disagree.
///
/// Vertices that are equal, or nearer than `weld_distance`, are one. Edges between triangles are felt where the surface
/// is convex and bends by more than `edge_angle`, and where they have no neighbour, more than one, or one of the
/// opposite winding. Triangles without area are dropped, and so are those that repeat an earlier one. The others keep
/// their numbers, which hits and contacts report.
///
/// A mesh is the form of static and kinematic bodies (fe_geometry_mesh). It has no inside: what is behind its triangles
/// is not pushed out. Two-sided triangles push a body to the side its centre is on. Meshes and heightfields never touch
/// each other, not even as triggers.
typedef struct fe_mesh_def {
    uint32_t struct_size;
    uint32_t flags;           ///< fe_mesh_flags. Default 0
    int32_t vertex_count;     ///< 3..2^28
    int32_t triangle_count;   ///< 1..2^27
    uint32_t vertex_stride;   ///< bytes from one vertex to the next, 0: packed
    uint32_t index_stride;    ///< bytes from the first index of a triangle to that of the next, 0: packed
    int32_t index_type;       ///< fe_index_type. Default FE_INDEX_U32
    float weld_distance;      ///< m, 0..1, from 0.000001 on if not 0. Default 0: equal vertices alone
    float edge_angle;         ///< rad, 0..1.57. Default 0.035, two degrees
    int32_t material_count;   ///< 0..255
    uint32_t material_stride; ///< bytes from one material to the next, 0: packed
    uint32_t reserved;
    const float *vertices;             ///< x y z each, m, within +-100000. All arrays are copied
    const void *indices;               ///< three vertices a triangle, counterclockwise seen from the side that counts
    const uint8_t *triangle_materials; ///< a triangle each: index into `materials`; NULL: all have the shape's material
    const fe_material *materials;      ///< replace the shape's material
    const uint32_t *triangle_data; ///< a triangle each: any number of yours, fe_mesh_get_triangle reads it; NULL: none
} fe_mesh_def;

FE_API void fe_mesh_def_init(fe_mesh_def *def, uint32_t struct_size);
/// Builds a mesh, in time that grows little more than the number of triangles. The same definition gives the same mesh,
/// bit for bit, on every machine. Beside the arrays of the definition it takes 50 bytes of memory a triangle, when
/// there are half as many vertices, of which 20 stay. Any thread may build while worlds that use the store step.
/// @return FE_ERROR_ARGUMENT for an index or a coordinate out of range, with its place; FE_ERROR_LIMIT for too many
///         triangles or vertices; FE_ERROR_DEGENERATE when no triangle has an area, or when a strict mesh has
///         one to drop: fe_last_error names it
FE_API fe_result fe_mesh_create(fe_store *store, const fe_mesh_def *def, fe_asset *out_asset);

/// What a mesh is.
typedef struct fe_mesh_info {
    uint32_t struct_size;
    int32_t triangle_count;       ///< that are kept
    int32_t degenerate_triangles; ///< dropped: no higher than 3e-8 of their largest coordinate
    int32_t duplicate_triangles;  ///< dropped: the same corners and winding as an earlier one
    int32_t vertex_count;         ///< places that differ
    int32_t open_edges;           ///< of one triangle
    int32_t crowded_edges;        ///< of more than two
    int32_t flipped_edges;        ///< of two with opposite windings
    int32_t tree_height;          ///< levels of nodes
    int32_t material_count;       ///< 0: its triangles have their shape's material
    fe_vec3 lower, upper;         ///< least and greatest corner of the bounds, m
    double area;                  ///< m2
    double volume;                ///< m3 of a closed mesh, negative when it is wound inside out; else 0
    int64_t bytes;                ///< of memory
} fe_mesh_info;

FE_API void fe_mesh_info_init(fe_mesh_info *info, uint32_t struct_size);
/// @param out_info  its struct_size must be set
/// @return FE_ERROR_KIND for an asset that is no mesh
FE_API fe_result fe_mesh_get_info(const fe_store *store, fe_asset mesh, fe_mesh_info *out_info);

/// What an edge of a triangle of a mesh is.
typedef enum fe_mesh_edge_flags {
    FE_MESH_EDGE_FELT = 1,   ///< bodies touch it
    FE_MESH_EDGE_CONVEX = 2, ///< the surface bends outwards there
    FE_MESH_EDGE_OPEN = 4,   ///< it has no neighbour
    FE_MESH_EDGE_FORCE32 = 0x7fffffff
} fe_mesh_edge_flags;

/// A triangle of a mesh.
typedef struct fe_mesh_triangle {
    uint32_t struct_size;
    int32_t material;   ///< index into the mesh's materials, -1: the shape's
    fe_vec3 corners[3]; ///< m, in the frame of the definition's vertices, after welding
    uint32_t edges[3];  ///< fe_mesh_edge_flags of the edges from corner 0 to 1, 1 to 2, 2 to 0
    uint32_t data;      ///< of the definition, else 0
    int32_t kept;       ///< 0: it was dropped, and all above is 0
} fe_mesh_triangle;

FE_API void fe_mesh_triangle_init(fe_mesh_triangle *triangle, uint32_t struct_size);
/// @param triangle      its number in the definition
/// @param out_triangle  its struct_size must be set
FE_API fe_result fe_mesh_get_triangle(const fe_store *store, fe_asset mesh, int32_t triangle,
                                      fe_mesh_triangle *out_triangle);
/// New materials of a mesh that has some, as many as before.
/// @param stride  bytes, 0: packed
/// @return FE_ERROR_STEPPING, FE_ERROR_BUSY while a world that uses the mesh steps or has another thread inside
FE_API fe_result fe_mesh_set_materials(fe_store *store, fe_asset mesh, const fe_material *materials, uint32_t stride,
                                       int32_t count);

// ---- worlds ---------------------------------------------------------------------------------------------------------

/// The sets of kernels. All give the same bits.
typedef enum fe_simd {
    FE_SIMD_AUTO = 0,  ///< the widest of this CPU; the environment variable FE_SIMD = plain, sse2, avx2... overrides it
    FE_SIMD_PLAIN = 1, ///< C without intrinsics
    FE_SIMD_SSE2 = 2,  ///< of x86, 4 floats
    FE_SIMD_AVX2 = 3,  ///< of x86, 8 floats
    FE_SIMD_AVX512 = 4, ///< of x86, 16 floats
    FE_SIMD_NEON = 5,   ///< of AArch64, 4 floats
    FE_SIMD_WASM = 6,   ///< of WebAssembly
    FE_SIMD_FORCE32 = 0x7fffffff
} fe_simd;

/// A part of a step, for the host's job system: `index` says which.
typedef void (*fe_task)(void *argument, int32_t index);

/// The host's job system, instead of a pool. `run` calls task(argument, i) once for each i in [0, count), on any
/// threads, in any order, and returns when all have returned. No task waits for one that has not started: one thread is
/// enough.
typedef struct fe_task_system {
    uint32_t struct_size;
    int32_t worker_count; ///< 1..64: the largest `count` of a call
    /// calls task(argument, 0) to task(argument, count - 1)
    void (*run)(void *user, fe_task task, void *argument, int32_t count);
    void *user; ///< handed to `run`
} fe_task_system;

FE_API void fe_task_system_init(fe_task_system *tasks, uint32_t struct_size);

/// How a world begins.
typedef struct fe_world_def {
    uint32_t struct_size;
    int32_t worker_count;          ///< 1..64 workers of its own, 1: none; ignored with a pool or tasks. Default 1
    fe_vec3 gravity;               ///< m/s2. Default 0, -9.81, 0
    int32_t substeps;              ///< 1..64. Default 8
    int32_t simd;                  ///< fe_simd. Default FE_SIMD_AUTO
    uint32_t number;               ///< 1..4095, part of its handles; 0: the next of a counter. Default 0
    fe_pool *pool;                 ///< or NULL
    fe_store *store;               ///< of its assets; NULL: one of its own, with the world's number and allocator
    const fe_allocator *allocator; ///< copied; NULL: malloc
    const fe_task_system *tasks;   ///< copied; NULL: the pool or the world's own workers
    uint64_t user_data;            ///< any number of yours. Default 0
} fe_world_def;

FE_API void fe_world_def_init(fe_world_def *def, uint32_t struct_size);
/// Worlds with different numbers refuse each other's handles. Those with the same number accept them: give the same
/// number to worlds of one history whose handles must agree.
/// @param def  NULL: the defaults
/// @return FE_ERROR_UNSUPPORTED when this CPU lacks the SIMD set; FE_ERROR_STALE for a pool or a store that is gone;
///         FE_ERROR_ARGUMENT for another world's own store
FE_API fe_result fe_world_create(const fe_world_def *def, fe_world **out_world);
/// Destroys the world and all in it. The pointer is dead afterwards.
/// @return FE_ERROR_BUSY while another thread is inside a call with this world
FE_API fe_result fe_world_destroy(fe_world *world);
/// Moves the world on by dt seconds. It takes less than 32 KB of the caller's stack.
///
/// FE_ERROR_MEMORY leaves the world as it was before the call. It can be stepped again, and then goes on with the same
/// bits as if memory had lasted.
///
/// Of bodies in one place, a thousand born in a point, each touches the 24 that are deepest in it: of two dynamic
/// bodies that both have more than 48 neighbours, a contact is left out when it is among the 24 deepest of neither,
/// by the overlap of their boxes. A body that meets more than 256 new ones at once looks at 48 of those beside it. In
/// the steps that follow they look for each other again. fe_counters.contacts_left_out counts what was left out; where
/// thousands are in one place it is a lower bound.
/// @param dt  0..1 s; 0 updates contacts and events and moves nothing. Less than 1e-5 s counts as 0
FE_API fe_result fe_world_step(fe_world *world, float dt);

/// m/s2. A change wakes all dynamic bodies.
FE_API fe_result fe_world_set_gravity(fe_world *world, const fe_vec3 *gravity);
FE_API fe_result fe_world_get_gravity(const fe_world *world, fe_vec3 *out_gravity);
/// @param substeps  1..64
FE_API fe_result fe_world_set_substeps(fe_world *world, int32_t substeps);
FE_API fe_result fe_world_get_substeps(const fe_world *world, int32_t *out_substeps);
FE_API fe_result fe_world_set_user_data(fe_world *world, uint64_t user_data);
FE_API fe_result fe_world_get_user_data(const fe_world *world, uint64_t *out_user_data);
/// The number in this world's handles, 1..4095.
FE_API fe_result fe_world_get_number(const fe_world *world, uint32_t *out_number);
/// The store of its assets: that of its definition, or its own.
FE_API fe_result fe_world_get_store(const fe_world *world, fe_store **out_store);

/// How the solver behaves. Each value may change between steps.
typedef struct fe_world_tuning {
    uint32_t struct_size;
    float contact_hertz;         ///< stiffness of contacts, 1/s, > 0; twice that against static bodies. Default 30
    float contact_damping_ratio; ///< >= 0; 1 is critical, higher pushes out more gently. Default 10
    float contact_push_speed;    ///< overlap is pushed out no faster, m/s, >= 0. Default 3
    float joint_hertz;           ///< stiffness of joints, 1/s, > 0. Default 60
    float joint_damping_ratio;   ///< >= 0. Default 2
    float restitution_threshold; ///< slower impacts do not bounce, m/s, >= 0. Default 1
    float hit_event_threshold;   ///< slower impacts make no hit event, m/s, >= 0. Default 1
    float sleep_time;            ///< how long a body must be slow before it may sleep, s, >= 0. Default 0.5
    float speculative_distance;  ///< contacts are made up to this gap, m, 0.001..0.1. Default 0.02
    float max_linear_speed;      ///< m/s, > 0. Default 4000
    int32_t sleep_enabled;       ///< 0: nobody falls asleep, and who sleeps wakes. Default 1
    int32_t continuous_enabled;  ///< 0: fast bodies may pass through thin ones. Default 1
    int32_t warm_start_enabled;  ///< 0: contacts begin each step without the impulses of the last one. Default 1
} fe_world_tuning;

FE_API void fe_world_tuning_init(fe_world_tuning *tuning, uint32_t struct_size);
/// Takes effect with the next step. It wakes nobody, unless sleep_enabled is 0.
FE_API fe_result fe_world_set_tuning(fe_world *world, const fe_world_tuning *tuning);
/// @param out_tuning  its struct_size must be set
FE_API fe_result fe_world_get_tuning(const fe_world *world, fe_world_tuning *out_tuning);
/// The stiffness that a step of dt seconds would really use: contact_hertz is limited to an eighth of the substep rate,
/// joint_hertz to 0.225 of it.
/// @param dt                 0..1 s; 0, and less than 1e-5 s: no limit
/// @param out_contact_hertz  1/s, between two dynamic bodies
/// @param out_joint_hertz    1/s
FE_API fe_result fe_world_get_hertz(const fe_world *world, float dt, float *out_contact_hertz, float *out_joint_hertz);

/// While ignored, two bodies never collide, whatever their layers and groups. Takes effect at the next step.
FE_API fe_result fe_world_ignore_collision(fe_world *world, fe_body a, fe_body b, int32_t ignore);
/// 1 while fe_world_ignore_collision keeps the two apart, else 0.
FE_API fe_result fe_world_get_ignored(const fe_world *world, fe_body a, fe_body b, int32_t *out_ignored);
/// Rebalances the trees that serve the queries. Worth a call after a level is loaded. Results never need it: queries
/// see new and moved bodies at once.
FE_API fe_result fe_world_optimize(fe_world *world);

/// Two shapes that a pair filter judges. A is the one created first.
typedef struct fe_filter_pair {
    fe_body body_a, body_b;                        ///< of the shapes
    fe_shape shape_a, shape_b;                     ///< A was created first
    uint64_t body_user_data_a, body_user_data_b;   ///< of the bodies
    uint64_t shape_user_data_a, shape_user_data_b; ///< of the shapes
    uint64_t reserved[2];
} fe_filter_pair;

/// Returns 1 when the two may collide, 0 when not. While it runs, every call with this world is FE_ERROR_STEPPING.
typedef int32_t (*fe_pair_filter)(void *user, const fe_filter_pair *pair);

/// Sets a function of yours that judges new pairs of shapes, when one of them asks for it (fe_shape_def.pair_filter).
/// fe_world_step calls it on its own thread, in a fixed order, once for each pair whose bounds begin to meet. Layers,
/// groups and ignored pairs are judged before it. Its answer holds until the bounds part. Setting the filter of a
/// shape, or another pair filter, lets what was refused be judged anew. Equal runs need equal answers.
/// @param filter  NULL: none
/// @param user    handed to it
FE_API fe_result fe_world_set_pair_filter(fe_world *world, fe_pair_filter filter, void *user);

/// Where the last step's time went, ms of the stepping thread's clock. A world of a batch has its share of `step`
/// alone: reading the clock between stages would take a twentieth of it.
typedef struct fe_profile {
    uint32_t struct_size;
    float step;       ///< all of it
    float pairs;      ///< tree queries, new pairs
    float collide;    ///< narrow phase, recycling
    float islands;    ///< islands, colours, batches
    float solve;      ///< all substeps
    float continuous; ///< bodies too fast for their size
    float finalize;   ///< poses, bounds, trees
    float events;     ///< touching begun and ended, impacts, broken joints
    float sleep;      ///< who falls asleep
} fe_profile;

FE_API void fe_profile_init(fe_profile *profile, uint32_t struct_size);
/// @param out_profile  its struct_size must be set
FE_API fe_result fe_world_get_profile(const fe_world *world, fe_profile *out_profile);

/// Sizes of a world now, and of what its last step did.
typedef struct fe_counters {
    uint32_t struct_size;
    int32_t bodies, shapes, joints; ///< alive
    int32_t awake_bodies;           ///< dynamic and kinematic ones
    int32_t pairs;                  ///< pairs of shapes whose bounds meet
    int32_t contacts;               ///< of these, touching, triggers not counted
    int32_t recycled;               ///< contacts that kept their manifold in the last step
    int32_t islands;                ///< awake
    int32_t colours;                ///< of the largest island
    int32_t rows;                   ///< of W contacts each, or of 4 where a colour has no more
    int32_t rows_whole;             ///< of these, in islands that one worker solved whole
    int32_t lanes;                  ///< contacts in all rows
    int32_t simd;                   ///< fe_simd in use
    int32_t simd_width;             ///< W, floats side by side
    int32_t workers;                ///< that a step is spread over
    int64_t bytes;                  ///< allocated now, without its store
    int64_t allocations;            ///< since the world was created
    int32_t trees;                  ///< awake sets of joints without a loop that the last step solved exactly
    int32_t reserved;
    int64_t contacts_left_out; ///< since the world was created: see fe_world_step
} fe_counters;

FE_API void fe_counters_init(fe_counters *counters, uint32_t struct_size);
/// @param out_counters  its struct_size must be set
FE_API fe_result fe_world_get_counters(const fe_world *world, fe_counters *out_counters);
/// 64 bits over poses, velocities, contacts, joints and events, low word first. Equal for equal runs, whatever the
/// workers, the SIMD set, the compiler and the world's number.
/// @param out_words  2 words
FE_API fe_result fe_world_hash(const fe_world *world, uint32_t *out_words);
/// All bodies, in the order of creation.
FE_API int32_t fe_world_get_bodies(const fe_world *world, fe_body *out_bodies, int32_t capacity);
/// The box around all shapes but planes. FE_ERROR_STATE when there is none.
FE_API fe_result fe_world_get_bounds(const fe_world *world, fe_bounds *out_bounds);

/// Energy of all enabled dynamic bodies, asleep or awake.
typedef struct fe_energy {
    uint32_t struct_size;
    uint32_t reserved;
    double kinetic;   ///< of translation and rotation, J
    double potential; ///< in the world's gravity, J; 0 at the world's origin
} fe_energy;

FE_API void fe_energy_init(fe_energy *energy, uint32_t struct_size);
/// Energy of the discrete flight, E = T(v) + V(x - h v / 2) with substeps of h seconds: what a free flight keeps to
/// rounding. The scheme holds positions half a substep ahead of velocities; T(v) + V(x) would swing by h/2 m g v.
/// @param out_energy  its struct_size must be set
FE_API fe_result fe_world_get_energy(const fe_world *world, fe_energy *out_energy);
/// Momentum of all enabled dynamic bodies.
/// @param about        the point that the angular momentum is taken about, m, world space
/// @param out_linear   N s
/// @param out_angular  N m s
FE_API fe_result fe_world_get_momentum(const fe_world *world, const fe_dvec3 *about, fe_dvec3 *out_linear,
                                       fe_dvec3 *out_angular);

// ---- bodies ---------------------------------------------------------------------------------------------------------

/// What moves a body.
typedef enum fe_body_type {
    FE_BODY_STATIC = 0,    ///< never moves by itself
    FE_BODY_KINEMATIC = 1, ///< moves by its velocities, which nothing else changes
    FE_BODY_DYNAMIC = 2,   ///< moves by forces and contacts
    FE_BODY_FORCE32 = 0x7fffffff
} fe_body_type;

/// World axes as bits.
typedef enum fe_axis {
    FE_AXIS_NONE = 0, ///< no axis
    FE_AXIS_X = 1,    ///< 1, 0, 0
    FE_AXIS_Y = 2,    ///< 0, 1, 0
    FE_AXIS_Z = 4,    ///< 0, 0, 1
    FE_AXIS_ALL = 7,  ///< all three
    FE_AXIS_FORCE32 = 0x7fffffff
} fe_axis;

/// How a body begins.
typedef struct fe_body_def {
    uint32_t struct_size;
    int32_t type;             ///< fe_body_type. Default FE_BODY_DYNAMIC
    fe_transform transform;   ///< of the body's origin
    fe_vec3 linear_velocity;  ///< of the centre of mass, m/s
    fe_vec3 angular_velocity; ///< rad/s, world axes
    float linear_damping;     ///< 1/s, >= 0: v /= 1 + h c in each substep of h seconds. Default 0
    float angular_damping;    ///< 1/s, >= 0. Default 0
    float gravity_scale;      ///< Default 1
    float sleep_threshold;    ///< may sleep when its fastest point is slower, m/s, >= 0. Default 0.05
    uint32_t linear_locks;    ///< FE_AXIS_X | ...: world axes along which it cannot move. Default none
    uint32_t angular_locks;   ///< world axes about which it cannot rotate. Default none
    int32_t awake;            ///< 0: starts asleep, at rest. Default 1
    int32_t sleep_allowed;    ///< Default 1
    int32_t enabled;          ///< 0: neither moves, nor collides, nor is seen by queries. Default 1
    int32_t bullet;           ///< 1: stopped by moving bodies too when it is fast. Default 0
    uint64_t user_data;       ///< any number of yours. Default 0
} fe_body_def;

FE_API void fe_body_def_init(fe_body_def *def, uint32_t struct_size);
/// A dynamic body whose shapes weigh less than 1e-9 kg together, or that has none, gets 1 kg and the inertia of a
/// sphere of 1 m, until it gets a shape or a mass.
/// @param def  NULL: the defaults
FE_API fe_result fe_body_create(fe_world *world, const fe_body_def *def, fe_body *out_body);
/// All or none.
/// @param stride  bytes from one definition to the next: sizeof(fe_body_def)
FE_API fe_result fe_body_create_many(fe_world *world, const fe_body_def *defs, uint32_t stride, int32_t count,
                                     fe_body *out_bodies);
/// Destroys its shapes and joints too. Pairs that touched send their exit with the next step's events.
FE_API fe_result fe_body_destroy(fe_world *world, fe_body body);
/// All or none: with one stale handle, or one given twice, none is destroyed.
FE_API fe_result fe_body_destroy_many(fe_world *world, const fe_body *bodies, int32_t count);
/// 1 for a living body of this world, 0 for anything else.
FE_API int32_t fe_body_is_valid(const fe_world *world, fe_body body);

/// Its touching pairs send their exit and are found anew. The body and what it touched wake. Forces not yet applied are
/// dropped. A body that becomes static loses its velocities; one that is no longer dynamic loses a mass that was set.
/// @param type  fe_body_type
/// @return FE_ERROR_UNSUPPORTED for a body with a plane or a heightfield, unless `type` is static, and for one with a
///         mesh that would be dynamic
FE_API fe_result fe_body_set_type(fe_world *world, fe_body body, int32_t type);
FE_API fe_result fe_body_get_type(const fe_world *world, fe_body body, int32_t *out_type);
/// Puts the body there at once, through whatever is between, and wakes it and what it touched.
FE_API fe_result fe_body_set_transform(fe_world *world, fe_body body, const fe_transform *transform);
FE_API fe_result fe_body_get_transform(const fe_world *world, fe_body body, fe_transform *out_transform);
/// Centre of mass, m, world space.
FE_API fe_result fe_body_get_centre(const fe_world *world, fe_body body, fe_dvec3 *out_centre);
/// Of the centre of mass, m/s. Setting a velocity wakes the body; locked components stay 0.
/// @return FE_ERROR_STATE on a static body
FE_API fe_result fe_body_set_linear_velocity(fe_world *world, fe_body body, const fe_vec3 *velocity);
FE_API fe_result fe_body_get_linear_velocity(const fe_world *world, fe_body body, fe_vec3 *out_velocity);
/// rad/s, world axes; otherwise as the linear velocity.
FE_API fe_result fe_body_set_angular_velocity(fe_world *world, fe_body body, const fe_vec3 *velocity);
FE_API fe_result fe_body_get_angular_velocity(const fe_world *world, fe_body body, fe_vec3 *out_velocity);
/// Of the material point that is now at `point`, m/s.
FE_API fe_result fe_body_get_point_velocity(const fe_world *world, fe_body body, const fe_dvec3 *point,
                                            fe_vec3 *out_velocity);
/// Gives a kinematic body the velocities that bring it to `target` in `seconds`. FE_ERROR_STATE on other types.
/// @param seconds  > 0
FE_API fe_result fe_body_set_target(fe_world *world, fe_body body, const fe_transform *target, float seconds);

/// Force at the centre of mass, N, world axes, during all of the next step only. Wakes the body. Nothing happens on a
/// body that is disabled or not dynamic.
FE_API fe_result fe_body_add_force(fe_world *world, fe_body body, const fe_vec3 *force);
/// Force at a point of the world, N. Its torque is the one that this point gives now.
FE_API fe_result fe_body_add_force_at(fe_world *world, fe_body body, const fe_vec3 *force, const fe_dvec3 *point);
/// N m, world axes, during all of the next step only.
FE_API fe_result fe_body_add_torque(fe_world *world, fe_body body, const fe_vec3 *torque);
/// Changes the velocity at once by impulse / mass. N s.
FE_API fe_result fe_body_add_impulse(fe_world *world, fe_body body, const fe_vec3 *impulse);
/// At a point of the world, m: changes the angular velocity too.
FE_API fe_result fe_body_add_impulse_at(fe_world *world, fe_body body, const fe_vec3 *impulse, const fe_dvec3 *point);
/// N m s.
FE_API fe_result fe_body_add_angular_impulse(fe_world *world, fe_body body, const fe_vec3 *impulse);

/// The mass of a body and how it is spread.
typedef struct fe_mass_data {
    uint32_t struct_size;
    float mass;               ///< kg, > 0
    fe_vec3 centre;           ///< of mass, m, body space
    fe_vec3 inertia;          ///< principal moments about the centre, kg m2, > 0, none above the sum of the other two
    fe_quat inertia_rotation; ///< principal axes in body space
} fe_mass_data;

FE_API void fe_mass_data_init(fe_mass_data *data, uint32_t struct_size);
/// Overrides what the shapes give, until fe_body_reset_mass or a change of type. FE_ERROR_STATE unless dynamic.
FE_API fe_result fe_body_set_mass_data(fe_world *world, fe_body body, const fe_mass_data *data);
/// What the solver uses. @param out_data  its struct_size must be set
FE_API fe_result fe_body_get_mass_data(const fe_world *world, fe_body body, fe_mass_data *out_data);
/// Sets the mass, kg, > 0, and scales the inertia with it. It overrides until fe_body_reset_mass.
FE_API fe_result fe_body_set_mass(fe_world *world, fe_body body, float mass);
/// kg; 0 for a body that is not dynamic.
FE_API fe_result fe_body_get_mass(const fe_world *world, fe_body body, float *out_mass);
/// Mass and inertia from the shapes and their densities again.
FE_API fe_result fe_body_reset_mass(fe_world *world, fe_body body);

/// World axes along and about which the body cannot move, FE_AXIS_*: these coordinates stay bit for bit.
FE_API fe_result fe_body_set_locks(fe_world *world, fe_body body, uint32_t linear_axes, uint32_t angular_axes);
FE_API fe_result fe_body_get_locks(const fe_world *world, fe_body body, uint32_t *out_linear_axes,
                                   uint32_t *out_angular_axes);
/// 1/s, >= 0.
FE_API fe_result fe_body_set_damping(fe_world *world, fe_body body, float linear, float angular);
FE_API fe_result fe_body_get_damping(const fe_world *world, fe_body body, float *out_linear, float *out_angular);
/// Factor of the world's gravity for this body; below 0 the body rises. A change wakes it.
FE_API fe_result fe_body_set_gravity_scale(fe_world *world, fe_body body, float scale);
FE_API fe_result fe_body_get_gravity_scale(const fe_world *world, fe_body body, float *out_scale);
/// Waking a body wakes all that it touches, through other dynamic bodies. Putting it to sleep stops it and all those.
/// @return FE_ERROR_STATE when one of them may not sleep: then nothing changes
FE_API fe_result fe_body_set_awake(fe_world *world, fe_body body, int32_t awake);
/// 1 awake, 0 asleep; static bodies are never awake.
FE_API fe_result fe_body_get_awake(const fe_world *world, fe_body body, int32_t *out_awake);
/// 0 wakes the body and keeps all that it touches awake.
FE_API fe_result fe_body_set_sleep_allowed(fe_world *world, fe_body body, int32_t allowed);
FE_API fe_result fe_body_get_sleep_allowed(const fe_world *world, fe_body body, int32_t *out_allowed);
/// m/s, >= 0.
FE_API fe_result fe_body_set_sleep_threshold(fe_world *world, fe_body body, float speed);
FE_API fe_result fe_body_get_sleep_threshold(const fe_world *world, fe_body body, float *out_speed);
/// A disabled body keeps its place but neither moves, nor collides, nor is seen by queries. Its touching pairs send
/// their exit.
FE_API fe_result fe_body_set_enabled(fe_world *world, fe_body body, int32_t enabled);
FE_API fe_result fe_body_get_enabled(const fe_world *world, fe_body body, int32_t *out_enabled);
/// See fe_body_def.
FE_API fe_result fe_body_set_bullet(fe_world *world, fe_body body, int32_t bullet);
FE_API fe_result fe_body_get_bullet(const fe_world *world, fe_body body, int32_t *out_bullet);
FE_API fe_result fe_body_set_user_data(fe_world *world, fe_body body, uint64_t user_data);
FE_API fe_result fe_body_get_user_data(const fe_world *world, fe_body body, uint64_t *out_user_data);
/// Layer, mask and group of all its shapes, see fe_shape_def. FE_ERROR_STATE when it has none.
FE_API fe_result fe_body_set_filter(fe_world *world, fe_body body, uint32_t layer, uint32_t mask, int32_t group);
/// @return FE_ERROR_STATE when it has no shapes, or when they have different filters
FE_API fe_result fe_body_get_filter(const fe_world *world, fe_body body, uint32_t *out_layer, uint32_t *out_mask,
                                    int32_t *out_group);
/// Its shapes in the order of creation.
FE_API int32_t fe_body_get_shapes(const fe_world *world, fe_body body, fe_shape *out_shapes, int32_t capacity);
/// The box around its shapes. FE_ERROR_STATE when it has none; FE_ERROR_UNSUPPORTED with a plane, which has no bounds.
FE_API fe_result fe_body_get_bounds(const fe_world *world, fe_body body, fe_bounds *out_bounds);

// ---- shapes ---------------------------------------------------------------------------------------------------------

/// The kinds of forms, and the fields of fe_geometry that each reads.
typedef enum fe_geometry_type {
    FE_GEOMETRY_NONE = 0,         ///< no form yet
    FE_GEOMETRY_SPHERE = 1,       ///< radius
    FE_GEOMETRY_CAPSULE = 2,      ///< half_height of the axis, along local Y, and radius
    FE_GEOMETRY_BOX = 3,          ///< half_extents
    FE_GEOMETRY_CYLINDER = 4,     ///< half_height along local Y, and radius: exact, no polygon
    FE_GEOMETRY_CONE = 5,         ///< half_height along local Y, and radius of the base; its tip is at +half_height
    FE_GEOMETRY_HULL = 32,        ///< asset: a convex hull, see fe_hull_create
    FE_GEOMETRY_PLANE = 64,       ///< the half space normal . p <= distance; static bodies only
    FE_GEOMETRY_HEIGHTFIELD = 96, ///< asset: a grid of heights; static bodies only
    FE_GEOMETRY_MESH = 97,        ///< asset: triangles; static and kinematic bodies only
    FE_GEOMETRY_COMPOUND = 98,    ///< asset: parts, see fe_compound_create; the bodies that each part may be on
    FE_GEOMETRY_FORCE32 = 0x7fffffff
} fe_geometry_type;

/// The form of a shape, in the shape's frame, m. Every length lies in [0.001, 100000].
typedef struct fe_geometry {
    uint32_t struct_size;
    int32_t type;         ///< fe_geometry_type
    float radius;         ///< m
    float half_height;    ///< of a capsule's axis, of a cylinder, of a cone, m
    fe_vec3 half_extents; ///< of a box, m
    fe_vec3 normal;       ///< of a plane, any length but zero
    float distance;       ///< of a plane from the origin along its normal, m
    /// Of a hull or a mesh, along the axes of its points: each 0.001..1000 in magnitude, a negative one mirrors.
    /// 0, 0, 0 counts as 1, 1, 1. All other forms have one of these two.
    fe_vec3 scale;
    uint32_t reserved[2];
    fe_asset asset; ///< of a hull, a heightfield, a mesh, a compound
    uint64_t reserved_end[2];
} fe_geometry;

/// FE_GEOMETRY_NONE. fe_geometry_sphere and its like at the end of this header fill a whole geometry.
FE_API void fe_geometry_init(fe_geometry *geometry, uint32_t struct_size);

/// The events that a shape asks for, as bits.
typedef enum fe_shape_events {
    FE_SHAPE_EVENTS_NONE = 0,  ///< no events
    FE_SHAPE_EVENTS_TOUCH = 1, ///< enter and exit
    FE_SHAPE_EVENTS_STAY = 2,  ///< every step while it lasts
    FE_SHAPE_EVENTS_HIT = 4,   ///< impacts above fe_world_tuning.hit_event_threshold
    FE_SHAPE_EVENTS_FORCE32 = 0x7fffffff
} fe_shape_events;

/// Two shapes collide when each one's layer is in the other's mask. A group decides before that, when both shapes have
/// the same one: above 0 they always collide, below 0 never.
typedef struct fe_shape_def {
    uint32_t struct_size;
    float density;        ///< kg/m3, >= 0; a trigger weighs too. Parts of a compound may have their own. Default 1000
    fe_frame frame;       ///< of the shape, in the body's space. Default the body's own
    int32_t trigger;      ///< 1: reports dynamic and kinematic bodies that touch it, pushes nothing. Default 0
    fe_material material; ///< its surface
    uint32_t layer;       ///< exactly one bit. Default 1
    uint32_t mask;        ///< the layers it collides with; 0: seen by queries only. Default all
    int32_t group;        ///< 0: none. Default 0
    uint32_t events;      ///< fe_shape_events; a pair has what either shape asks for. Default touch
    int32_t pair_filter;  ///< 1: the world's pair filter judges its new pairs. Default 0
    int32_t one_way;      ///< 1: holds only what comes against `one_way_direction`; convex forms. Default 0
    fe_vec3 one_way_direction; ///< shape frame, any length but zero: up, for a floor to jump through. Default 0, 1, 0
    fe_vec3 surface_velocity;  ///< of a conveyor belt, m/s, shape frame; only its part along the contact acts
    uint64_t user_data;        ///< any number of yours. Default 0
} fe_shape_def;

FE_API void fe_shape_def_init(fe_shape_def *def, uint32_t struct_size);
/// Mass and inertia of the body follow; it is not woken.
/// @param def  NULL: the defaults
/// @return FE_ERROR_UNSUPPORTED for a plane or a heightfield on a body that is not static, for a mesh on a dynamic one,
///         for each of the three one-way, and likewise for a compound with such a part; FE_ERROR_STALE for an asset
///         that is gone, or of another store than the world's; FE_ERROR_KIND for one that is not what the type says;
///         for scales see fe_geometry_set_scale; FE_ERROR_LIMIT for more shapes and parts than a world can hold
FE_API fe_result fe_shape_create(fe_world *world, fe_body body, const fe_shape_def *def, const fe_geometry *geometry,
                                 fe_shape *out_shape);
/// Its touching pairs send their exit. Mass and inertia of the body follow, unless they were set. The body and what it
/// touched wake.
FE_API fe_result fe_shape_destroy(fe_world *world, fe_shape shape);
/// 1 for a living shape of this world, 0 for anything else.
FE_API int32_t fe_shape_is_valid(const fe_world *world, fe_shape shape);
/// The body that it belongs to.
FE_API fe_result fe_shape_get_body(const fe_world *world, fe_shape shape, fe_body *out_body);
/// Another form in the same place. Pairs, mass and sleep follow as for fe_shape_destroy.
/// @return the errors of fe_shape_create
FE_API fe_result fe_shape_set_geometry(fe_world *world, fe_shape shape, const fe_geometry *geometry);
/// @param out_geometry  its struct_size must be set
FE_API fe_result fe_shape_get_geometry(const fe_world *world, fe_shape shape, fe_geometry *out_geometry);
/// In the body's space. Pairs, mass and sleep follow as for fe_shape_destroy.
FE_API fe_result fe_shape_set_frame(fe_world *world, fe_shape shape, const fe_frame *frame);
FE_API fe_result fe_shape_get_frame(const fe_world *world, fe_shape shape, fe_frame *out_frame);
/// kg/m3, >= 0. Mass and inertia of the body follow, unless they were set. A change wakes it. Parts of a compound with
/// a density of their own keep it.
FE_API fe_result fe_shape_set_density(fe_world *world, fe_shape shape, float density);
FE_API fe_result fe_shape_get_density(const fe_world *world, fe_shape shape, float *out_density);
/// Takes effect at the next step, also where the shape touches already. The body and what it touches wake. Cells of a
/// heightfield, triangles of a mesh and parts of a compound with materials of their own keep them.
FE_API fe_result fe_shape_set_material(fe_world *world, fe_shape shape, const fe_material *material);
FE_API fe_result fe_shape_get_material(const fe_world *world, fe_shape shape, fe_material *out_material);
/// Takes effect at the next step. The pair filter judges anew the pairs that it refused.
/// @param layer  exactly one bit
FE_API fe_result fe_shape_set_filter(fe_world *world, fe_shape shape, uint32_t layer, uint32_t mask, int32_t group);
FE_API fe_result fe_shape_get_filter(const fe_world *world, fe_shape shape, uint32_t *out_layer, uint32_t *out_mask,
                                     int32_t *out_group);
/// Does the world's pair filter judge its pairs? Takes effect at the next step; its pairs are judged anew.
FE_API fe_result fe_shape_set_pair_filter(fe_world *world, fe_shape shape, int32_t enabled);
FE_API fe_result fe_shape_get_pair_filter(const fe_world *world, fe_shape shape, int32_t *out_enabled);
/// See fe_shape_def. A body that comes from behind or from a side passes, until the two are apart. A change wakes the
/// body and what it touches; what is inside the shape then passes.
/// @param direction  shape frame, any length but zero; NULL: as it is
/// @return FE_ERROR_UNSUPPORTED for planes, heightfields, meshes and compounds with such a part, unless `enabled` is 0
FE_API fe_result fe_shape_set_one_way(fe_world *world, fe_shape shape, int32_t enabled, const fe_vec3 *direction);
/// @param out_direction  as it was set
FE_API fe_result fe_shape_get_one_way(const fe_world *world, fe_shape shape, int32_t *out_enabled,
                                      fe_vec3 *out_direction);
/// A change ends its touching pairs, with their exit, and wakes the body.
FE_API fe_result fe_shape_set_trigger(fe_world *world, fe_shape shape, int32_t trigger);
FE_API fe_result fe_shape_get_trigger(const fe_world *world, fe_shape shape, int32_t *out_trigger);
/// fe_shape_events, from the next step on.
FE_API fe_result fe_shape_set_events(fe_world *world, fe_shape shape, uint32_t events);
FE_API fe_result fe_shape_get_events(const fe_world *world, fe_shape shape, uint32_t *out_events);
/// m/s, shape frame, see fe_shape_def. Wakes what lies on it.
FE_API fe_result fe_shape_set_surface_velocity(fe_world *world, fe_shape shape, const fe_vec3 *velocity);
FE_API fe_result fe_shape_get_surface_velocity(const fe_world *world, fe_shape shape, fe_vec3 *out_velocity);
FE_API fe_result fe_shape_set_user_data(fe_world *world, fe_shape shape, uint64_t user_data);
FE_API fe_result fe_shape_get_user_data(const fe_world *world, fe_shape shape, uint64_t *out_user_data);
/// The box around it. FE_ERROR_UNSUPPORTED for a plane, which has no bounds.
FE_API fe_result fe_shape_get_bounds(const fe_world *world, fe_shape shape, fe_bounds *out_bounds);
/// Shapes that touched it at the end of the last step, in the order of creation: who is inside a trigger now.
FE_API int32_t fe_shape_get_overlaps(const fe_world *world, fe_shape shape, fe_shape *out_shapes, int32_t capacity);

// ---- compounds ------------------------------------------------------------------------------------------------------

/// A part of a compound.
typedef struct fe_compound_part {
    uint32_t struct_size;
    float density;        ///< kg/m3, >= 0; -1: that of the shape (fe_shape_def). Default -1
    fe_frame frame;       ///< of the part, in the compound's space. Default the compound's own
    int32_t own_material; ///< 1: it has `material`; 0: that of the shape. Default 0
    fe_geometry geometry; ///< any but a plane and a compound. Default FE_GEOMETRY_NONE
    fe_material material; ///< counts with own_material
    uint64_t user_data;   ///< any number of yours: fe_compound_get_part reads it. Default 0
} fe_compound_part;

FE_API void fe_compound_part_init(fe_compound_part *part, uint32_t struct_size);
/// Makes one form of several: a table, a tree, a tiled floor. Its shape (fe_geometry_compound) has one handle, filter
/// and user data; mass, centre and inertia are those of its parts together. Hits, contacts and events name the shape,
/// and the number of the part: its place in `parts`. A pair of shapes begins to touch with the first two of their parts
/// that do, and ends with the last two. Parts may overlap; each weighs what it weighs alone. What
/// passes a part of a one-way compound passes all parts, until it is apart from them. Parts move, touch and answer
/// queries as single shapes of the body do. To change one, make another compound and give it to the shape
/// (fe_shape_set_geometry). Parts of a body that need their own filter, events or handle are better single shapes.
///
/// The parts are copied. Their assets live as long as the compound does, whoever destroys their handles. Any number of
/// shapes, in any world that uses the store, may share it; fe_asset_destroy gives it back. A compound has no scale:
/// hulls and meshes among its parts have. Any thread may make one while worlds that use the store step.
/// @param stride  bytes from one part to the next: sizeof(fe_compound_part)
/// @param count   1..65535
/// @return FE_ERROR_ARGUMENT for a part out of range, fe_last_error names it; FE_ERROR_UNSUPPORTED for a plane or a
///         compound among the parts; FE_ERROR_STALE, FE_ERROR_KIND for the asset of a part, as in fe_shape_create
FE_API fe_result fe_compound_create(fe_store *store, const fe_compound_part *parts, uint32_t stride, int32_t count,
                                    fe_asset *out_asset);

/// What a compound is.
typedef struct fe_compound_info {
    uint32_t struct_size;
    int32_t part_count;   ///< how many parts it has
    fe_vec3 lower, upper; ///< least and greatest corner of the bounds of its parts, m, in the compound's space
    int64_t bytes;        ///< of memory, without the assets of its parts
} fe_compound_info;

FE_API void fe_compound_info_init(fe_compound_info *info, uint32_t struct_size);
/// @param out_info  its struct_size must be set
/// @return FE_ERROR_KIND for an asset that is no compound
FE_API fe_result fe_compound_get_info(const fe_store *store, fe_asset compound, fe_compound_info *out_info);
/// A part as it was given; a rotation comes back with length 1, a scale of 0, 0, 0 as 1, 1, 1.
/// @param part      its number, 0..part_count - 1
/// @param out_part  its struct_size must be set
FE_API fe_result fe_compound_get_part(const fe_store *store, fe_asset compound, int32_t part,
                                      fe_compound_part *out_part);

// ---- joints ---------------------------------------------------------------------------------------------------------
//
// A joint ties body B to body A. Each has a frame on it, in body space, and the joint compares the two. With p, q the
// position and rotation of a body, f and r those of its frame in it:
//
//   d = (qA rA)^-1 (pB + qB fB - pA - qA fA)      translation, m, along the axes of frame A
//   q = (qA rA)^-1 (qB rB) = swing twist          rotation; the twist is about X, and comes first
//   twist = 2 atan2(q.x, q.w);   swing: rotation vector (0, swing_y, swing_z), rad, at most pi long
//
// All limits, targets, speeds and readings are these numbers. The angle of a hinge is the twist. q and -q are one
// rotation: the one with q.w >= 0 counts. A twist with limits is followed beyond pi, so that a limit at pi holds there.
// A target beyond a limit counts as the limit.
//
// **Frames.** `fe_hinge_joint_def_at` and its like make them from a point (and an axis) of the world: the present pose
// becomes the zero. Or set both frames by hand. Body 0 is the world: a frame that never moves. Its position is
// world_origin, in double, plus its frame's own position. Both ends cannot be the world.
//
// **Words.** All types share one vocabulary: `limit_enabled`, `lower`, `upper`; `spring_hertz`, `spring_damping_ratio`,
// `spring_max`, `target`; `motor_speed`, `motor_max`. A `_max` is a cap, N or N m.
//
// **Stiffness.** Springs, limits and locked axes are springs and dampers given by hertz, 1/s, and damping ratio
// (1: critical). They act on the masses that move, so they do not depend on them. 0 Hz switches an optional spring off.
// For a limit or a locked axis it means rigid: the world's joint_hertz and joint_damping_ratio, without oscillation.
// All are limited to 0.225 of the substep rate. Limits and locked axes are damped more from half of that on.
//
// **Heavy loads.** A rigid joint of this kind gives under a load of many times the bodies' own masses. Joints that
// close no loop (chains, cranes, arms, telescopes) are solved exactly instead, all at once: then they do not give,
// whatever hangs on them. At most one joint may hold such a tree to the rest of the world. Its bodies have no locks, or
// all those of a plane, or all rotations. The exact solver begins at a load of 32 effective masses on a joint (a chain
// of 16 equal links), of 4 on one that locks rotations. A mechanism of 2 to 32 bodies without locks, held by nothing
// but such joints (a linkage, a rope), uses it whatever it bears. Other lighter trees, with limits, springs, motors or
// friction, use it in steps in which a blow or a pinch would open a joint by more than 4 mm. A joint that is open by
// more than 4 mm when the step begins is closed gradually, by springs. fe_counters.trees counts such trees. Limits
// and springs of their bodies stay what they are; contacts of light links of a heavy tree push the mass of the tree.
//
// **Springs and motors** push no harder than their cap. A motor drives to its speed; with speed 0 it is friction. A cap
// of 0 switches it off.
//
// A joint acts while it and both bodies are enabled and at least one of them is dynamic. Changing a joint wakes its
// bodies.

/// The kinds of joints.
typedef enum fe_joint_type {
    FE_JOINT_DISTANCE = 1,     ///< two points keep a distance or a range of it
    FE_JOINT_BALL = 2,         ///< two points stay together
    FE_JOINT_HINGE = 3,        ///< two points and their axes X stay together
    FE_JOINT_FIXED = 4,        ///< nothing moves
    FE_JOINT_CONFIGURABLE = 5, ///< each of three translations and three rotations as you say
    FE_JOINT_FORCE32 = 0x7fffffff
} fe_joint_type;

/// All definitions of joints begin with the fields of this one. fe_joint_get and fe_joint_set read and write them on
/// joints of any type.
typedef struct fe_joint_def {
    uint32_t struct_size;
    int32_t enabled;           ///< 0: as if it were not there. Default 1
    fe_body body_a, body_b;    ///< two different ones; 0 is the world; in a _set: they stay as they are
    uint64_t user_data;        ///< any number of yours. Default 0
    fe_dvec3 world_origin;     ///< m, world space: where the frame of body 0 is measured from. Default 0
    fe_frame frame_a, frame_b; ///< in body space. Default: the bodies' own
    int32_t collide_connected; ///< 1: its two bodies may touch. Default 0: they never do
    float hertz;               ///< stiffness of what is locked, 1/s, >= 0; 0: rigid. Default 0
    float damping_ratio;       ///< of what is locked, >= 0; counts when hertz > 0. Default 1
    float break_force;         ///< it breaks when its reaction exceeds this, N, >= 0; 0: never. Default 0
    float break_torque;        ///< N m, >= 0; 0: never. Default 0
    uint32_t reserved;
} fe_joint_def;

FE_API void fe_joint_def_init(fe_joint_def *def, uint32_t struct_size);

/// Two points keep their distance within [lower, upper] (equal: a rod; from 0: a rope). A spring pulls it to `target`,
/// a motor changes it. Only the positions of the frames count. The first fields are those of fe_joint_def, here and
/// below.
typedef struct fe_distance_joint_def {
    uint32_t struct_size;
    int32_t enabled;
    fe_body body_a, body_b;
    uint64_t user_data;
    fe_dvec3 world_origin;
    fe_frame frame_a, frame_b;
    int32_t collide_connected;
    float hertz, damping_ratio; ///< of both ends of the range
    float break_force, break_torque;
    uint32_t reserved;

    int32_t limit_enabled;      ///< 1: lower <= distance <= upper. Default 1
    float lower;                ///< m, >= 0, at most upper. Default 1
    float upper;                ///< m, >= 0.001. Default 1
    float spring_hertz;         ///< 1/s, >= 0; 0: no spring. Default 0
    float spring_damping_ratio; ///< >= 0. Default 1
    float spring_max;           ///< cap of the spring, N, >= 0. Default 1e15
    float target;               ///< distance that the spring pulls to, m, >= 0. Default 1
    float motor_speed;          ///< at which the motor lengthens it, m/s. Default 0
    float motor_max;            ///< cap, N, >= 0; with speed 0 a friction; 0: no motor. Default 0
    uint32_t reserved_end;
} fe_distance_joint_def;

/// Two points stay together. An elliptic cone may bound the swing of axis X, limits the twist about it. A spring
/// rotates B to a target.
typedef struct fe_ball_joint_def {
    uint32_t struct_size;
    int32_t enabled;
    fe_body body_a, body_b;
    uint64_t user_data;
    fe_dvec3 world_origin;
    fe_frame frame_a, frame_b;
    int32_t collide_connected;
    float hertz, damping_ratio; ///< of the points
    float break_force, break_torque;
    uint32_t reserved;

    int32_t cone_enabled;       ///< 1: (swing_y / cone_y)^2 + (swing_z / cone_z)^2 <= 1. Default 0
    float cone_y, cone_z;       ///< half angles, rad, 0.01..pi. Default pi
    int32_t limit_enabled;      ///< 1: lower <= twist <= upper. Default 0
    float lower, upper;         ///< rad, -pi..pi. Default -pi, pi
    float limit_hertz;          ///< of cone and limits, 1/s, >= 0; 0: rigid. Default 0
    float limit_damping_ratio;  ///< >= 0. Default 1
    float spring_hertz;         ///< of the spring that rotates B to `target`, 1/s, >= 0; 0: none. Default 0
    float spring_damping_ratio; ///< >= 0. Default 1
    float spring_max;           ///< its cap, N m, >= 0. Default 1e15
    fe_quat target;             ///< q to reach. Default none
    fe_vec3 motor_velocity;     ///< of B against A, rad/s, frame A. Default 0
    float motor_max;            ///< cap, N m, >= 0; with velocity 0 a friction; 0: no motor. Default 0
    uint32_t reserved_end;
} fe_ball_joint_def;

/// Two points and their axes X stay together: a door, an elbow, an axle. The angle is the twist.
typedef struct fe_hinge_joint_def {
    uint32_t struct_size;
    int32_t enabled;
    fe_body body_a, body_b;
    uint64_t user_data;
    fe_dvec3 world_origin;
    fe_frame frame_a, frame_b;
    int32_t collide_connected;
    float hertz, damping_ratio; ///< of points and axes
    float break_force, break_torque;
    uint32_t reserved;

    int32_t limit_enabled;      ///< 1: lower <= angle <= upper. Default 0
    float lower, upper;         ///< rad, -pi..pi. Default -pi, pi
    float limit_hertz;          ///< 1/s, >= 0; 0: rigid. Default 0
    float limit_damping_ratio;  ///< >= 0. Default 1
    float spring_hertz;         ///< of the spring that rotates it to `target`, 1/s, >= 0; 0: none. Default 0
    float spring_damping_ratio; ///< >= 0. Default 1
    float spring_max;           ///< its cap, N m, >= 0. Default 1e15
    float target;               ///< rad, -pi..pi. Default 0
    float motor_speed;          ///< rad/s. Default 0
    float motor_max;            ///< cap, N m, >= 0; with speed 0 a friction; 0: no motor. Default 0
    uint32_t reserved_end;
} fe_hinge_joint_def;

/// The two frames stay one.
typedef struct fe_fixed_joint_def {
    uint32_t struct_size;
    int32_t enabled;
    fe_body body_a, body_b;
    uint64_t user_data;
    fe_dvec3 world_origin;
    fe_frame frame_a, frame_b;
    int32_t collide_connected;
    float hertz, damping_ratio; ///< of the points
    float break_force, break_torque;
    uint32_t reserved;

    float angular_hertz;         ///< of the rotation, 1/s, >= 0; 0: rigid. Default 0
    float angular_damping_ratio; ///< >= 0. Default 1
} fe_fixed_joint_def;

/// What one axis of a configurable joint may do.
typedef enum fe_motion {
    FE_MOTION_LOCKED = 0,  ///< stays 0
    FE_MOTION_LIMITED = 1, ///< within lower..upper
    FE_MOTION_FREE = 2,    ///< without limits
    FE_MOTION_FORCE32 = 0x7fffffff
} fe_motion;

/// How the spring of one axis of a configurable joint is given.
typedef enum fe_spring {
    FE_SPRING_NONE = 0,      ///< no spring
    FE_SPRING_HERTZ = 1,     ///< by spring_hertz and spring_damping_ratio, on the masses that move
    FE_SPRING_STIFFNESS = 2, ///< by spring_stiffness and spring_damping
    FE_SPRING_FORCE32 = 0x7fffffff
} fe_spring;

/// One axis of a configurable joint. A locked axis has neither spring nor motor. Never grows.
typedef struct fe_joint_axis {
    int32_t motion;             ///< fe_motion. Default FE_MOTION_LOCKED
    float lower, upper;         ///< limits, m or rad (-pi..pi), lower <= upper. Default 0
    float limit_hertz;          ///< of the limits, 1/s, >= 0; 0: rigid. Default 0
    float limit_damping_ratio;  ///< >= 0. Default 1
    int32_t spring;             ///< fe_spring: pulls to `target`. Default FE_SPRING_NONE
    float spring_hertz;         ///< 1/s, >= 0, of FE_SPRING_HERTZ. Default 0
    float spring_damping_ratio; ///< >= 0, of FE_SPRING_HERTZ. Default 0
    float spring_stiffness;     ///< N/m or N m/rad, >= 0, of FE_SPRING_STIFFNESS. Default 0
    float spring_damping;       ///< N s/m or N m s/rad, >= 0, of FE_SPRING_STIFFNESS. Default 0
    float spring_max;           ///< cap of the spring, N or N m, >= 0. Default 1e15
    float target;               ///< m or rad. Default 0
    float motor_speed;          ///< m/s or rad/s. Default 0
    float motor_max;            ///< cap, N or N m, >= 0; with speed 0 a friction; 0: no motor. Default 0
    uint32_t reserved[2];
} fe_joint_axis;

/// Degrees of freedom: indices of fe_configurable_joint_def.axes.
typedef enum fe_dof {
    FE_DOF_LINEAR_X = 0,  ///< translation
    FE_DOF_LINEAR_Y = 1,  ///< translation
    FE_DOF_LINEAR_Z = 2,  ///< translation
    FE_DOF_ANGULAR_X = 3, ///< twist
    FE_DOF_ANGULAR_Y = 4, ///< swing_y
    FE_DOF_ANGULAR_Z = 5, ///< swing_z
    FE_DOF_FORCE32 = 0x7fffffff
} fe_dof;

/// Six axes, each locked, limited or free, with springs and motors: sliders, wheels, actuators and whatever else. With
/// two rotations locked the third rotates freely. With one locked, swing stops at 170 degrees, or at 137 when the twist
/// is the locked one, as in a cardan joint.
typedef struct fe_configurable_joint_def {
    uint32_t struct_size;
    int32_t enabled;
    fe_body body_a, body_b;
    uint64_t user_data;
    fe_dvec3 world_origin;
    fe_frame frame_a, frame_b;
    int32_t collide_connected;
    float hertz, damping_ratio; ///< of the locked axes
    float break_force, break_torque;
    uint32_t reserved;

    fe_joint_axis axes[6]; ///< by fe_dof. Default: all locked
} fe_configurable_joint_def;

FE_API void fe_distance_joint_def_init(fe_distance_joint_def *def, uint32_t struct_size);
FE_API void fe_ball_joint_def_init(fe_ball_joint_def *def, uint32_t struct_size);
FE_API void fe_hinge_joint_def_init(fe_hinge_joint_def *def, uint32_t struct_size);
FE_API void fe_fixed_joint_def_init(fe_fixed_joint_def *def, uint32_t struct_size);
FE_API void fe_configurable_joint_def_init(fe_configurable_joint_def *def, uint32_t struct_size);

/// Sets bodies and frames of a definition that is initialised already; the present pose becomes the zero. Nothing else
/// changes, here and in the four functions below, but for the length of a rod: it becomes the present distance of the
/// two points. A body of 0 is the world.
/// @param point_a, point_b  m, world space
FE_API fe_result fe_distance_joint_def_at(const fe_world *world, fe_distance_joint_def *def, fe_body body_a,
                                          fe_body body_b, const fe_dvec3 *point_a, const fe_dvec3 *point_b);
/// @param point  m, world space
/// @param axis   X of both frames, world space, any length but zero: what swings and twists, along a limb for example
FE_API fe_result fe_ball_joint_def_at(const fe_world *world, fe_ball_joint_def *def, fe_body body_a, fe_body body_b,
                                      const fe_dvec3 *point, const fe_vec3 *axis);
/// @param axis  of the hinge, world space, any length but zero; B rotates against A counterclockwise about it
FE_API fe_result fe_hinge_joint_def_at(const fe_world *world, fe_hinge_joint_def *def, fe_body body_a, fe_body body_b,
                                       const fe_dvec3 *point, const fe_vec3 *axis);
/// @param point  of both frames, m, world space
FE_API fe_result fe_fixed_joint_def_at(const fe_world *world, fe_fixed_joint_def *def, fe_body body_a, fe_body body_b,
                                       const fe_dvec3 *point);
/// @param axis  X of both frames, world space, any length but zero
FE_API fe_result fe_configurable_joint_def_at(const fe_world *world, fe_configurable_joint_def *def, fe_body body_a,
                                              fe_body body_b, const fe_dvec3 *point, const fe_vec3 *axis);

/// Makes a whole definition, defaults and all, ready for fe_distance_joint_create or for changes before it. Only
/// struct_size of the given one counts, here and in the three functions below. A rope: the points come no farther from
/// each other than `max_length`.
FE_API fe_result fe_rope_joint_def_at(const fe_world *world, fe_distance_joint_def *def, fe_body body_a, fe_body body_b,
                                      const fe_dvec3 *point_a, const fe_dvec3 *point_b, float max_length);
/// B slides along an axis and does not rotate. axes[FE_DOF_LINEAR_X] has its limits, spring and motor.
FE_API fe_result fe_slider_joint_def_at(const fe_world *world, fe_configurable_joint_def *def, fe_body body_a,
                                        fe_body body_b, const fe_dvec3 *point, const fe_vec3 *axis);
/// A wheel B on a chassis A rolls freely about the axle. axes[FE_DOF_ANGULAR_X] is its motor and brake.
/// axes[FE_DOF_ANGULAR_Z] steers about `up`: it is locked; give it limits and a spring to steer by its target.
/// axes[FE_DOF_LINEAR_Z] is the suspension along `up`, within +-travel: while the wheel stands, that corner of the
/// chassis, as heavy as it is now, swings at `hertz` with `damping_ratio`; the car rests some g / (2 pi hertz)^2 lower.
/// On a chassis that is not dynamic the wheel swings so.
/// @param axle  of the wheel, world space; with `up` upwards and both horizontal wheels, positive speed rolls towards
///              axle x up
FE_API fe_result fe_wheel_joint_def_at(const fe_world *world, fe_configurable_joint_def *def, fe_body chassis,
                                       fe_body wheel, const fe_dvec3 *point, const fe_vec3 *axle, const fe_vec3 *up,
                                       float hertz, float damping_ratio, float travel);
/// Pulls and rotates B towards a pose relative to A: the targets of all six axes, at first where it is.
/// @param max_force, max_torque  caps, N, N m
FE_API fe_result fe_motor_joint_def_at(const fe_world *world, fe_configurable_joint_def *def, fe_body body_a,
                                       fe_body body_b, float hertz, float damping_ratio, float max_force,
                                       float max_torque);

/// Each makes a joint from its definition. @return FE_ERROR_ARGUMENT also when both ends are one body, or the world
FE_API fe_result fe_distance_joint_create(fe_world *world, const fe_distance_joint_def *def, fe_joint *out_joint);
FE_API fe_result fe_ball_joint_create(fe_world *world, const fe_ball_joint_def *def, fe_joint *out_joint);
FE_API fe_result fe_hinge_joint_create(fe_world *world, const fe_hinge_joint_def *def, fe_joint *out_joint);
FE_API fe_result fe_fixed_joint_create(fe_world *world, const fe_fixed_joint_def *def, fe_joint *out_joint);
FE_API fe_result fe_configurable_joint_create(fe_world *world, const fe_configurable_joint_def *def,
                                              fe_joint *out_joint);
/// Each changes all of a joint of its type but the bodies, and keeps what an older client's shorter definition lacks.
/// @return FE_ERROR_STATE for a joint of another type
FE_API fe_result fe_distance_joint_set(fe_world *world, fe_joint joint, const fe_distance_joint_def *def);
FE_API fe_result fe_ball_joint_set(fe_world *world, fe_joint joint, const fe_ball_joint_def *def);
FE_API fe_result fe_hinge_joint_set(fe_world *world, fe_joint joint, const fe_hinge_joint_def *def);
FE_API fe_result fe_fixed_joint_set(fe_world *world, fe_joint joint, const fe_fixed_joint_def *def);
FE_API fe_result fe_configurable_joint_set(fe_world *world, fe_joint joint, const fe_configurable_joint_def *def);
/// Each reads what was set. @param out_def  its struct_size must be set
/// @return FE_ERROR_STATE for a joint of another type
FE_API fe_result fe_distance_joint_get(const fe_world *world, fe_joint joint, fe_distance_joint_def *out_def);
FE_API fe_result fe_ball_joint_get(const fe_world *world, fe_joint joint, fe_ball_joint_def *out_def);
FE_API fe_result fe_hinge_joint_get(const fe_world *world, fe_joint joint, fe_hinge_joint_def *out_def);
FE_API fe_result fe_fixed_joint_get(const fe_world *world, fe_joint joint, fe_fixed_joint_def *out_def);
FE_API fe_result fe_configurable_joint_get(const fe_world *world, fe_joint joint, fe_configurable_joint_def *out_def);

/// Its bodies wake. They may collide again from the next step on.
FE_API fe_result fe_joint_destroy(fe_world *world, fe_joint joint);
/// 1 for a living joint of this world, 0 for anything else.
FE_API int32_t fe_joint_is_valid(const fe_world *world, fe_joint joint);
/// fe_joint_type
FE_API fe_result fe_joint_get_type(const fe_world *world, fe_joint joint, int32_t *out_type);
/// 0 for the end that is the world.
FE_API fe_result fe_joint_get_bodies(const fe_world *world, fe_joint joint, fe_body *out_body_a, fe_body *out_body_b);
/// What all types have, see fe_joint_def. Sets all of it but the bodies.
FE_API fe_result fe_joint_set(fe_world *world, fe_joint joint, const fe_joint_def *def);
/// @param out_def  its struct_size must be set
FE_API fe_result fe_joint_get(const fe_world *world, fe_joint joint, fe_joint_def *out_def);
/// A disabled joint holds nothing, and its bodies may collide. A change wakes them.
FE_API fe_result fe_joint_set_enabled(fe_world *world, fe_joint joint, int32_t enabled);
FE_API fe_result fe_joint_get_enabled(const fe_world *world, fe_joint joint, int32_t *out_enabled);
/// Speed of the motor alone; its cap stays. A change wakes its bodies.
/// @param dof    fe_dof: FE_DOF_LINEAR_X for a distance joint, FE_DOF_ANGULAR_X for a hinge, an angular one for a ball
///               joint, any for a configurable joint
/// @param speed  m/s or rad/s
/// @return FE_ERROR_STATE for a type of joint that has no such motor
FE_API fe_result fe_joint_set_motor_speed(fe_world *world, fe_joint joint, int32_t dof, float speed);
/// Target of the spring alone. A change wakes its bodies.
/// @param dof     as above
/// @param target  m or rad
/// @return FE_ERROR_STATE for a type of joint that has no such spring, and for a ball joint
FE_API fe_result fe_joint_set_target(fe_world *world, fe_joint joint, int32_t dof, float target);
/// Target rotation of a ball joint's spring alone. A change wakes its bodies.
FE_API fe_result fe_ball_joint_set_target(fe_world *world, fe_joint joint, const fe_quat *target);
FE_API fe_result fe_joint_set_user_data(fe_world *world, fe_joint joint, uint64_t user_data);
FE_API fe_result fe_joint_get_user_data(const fe_world *world, fe_joint joint, uint64_t *out_user_data);
/// Where its frames are, world space.
FE_API fe_result fe_joint_get_frames(const fe_world *world, fe_joint joint, fe_transform *out_frame_a,
                                     fe_transform *out_frame_b);

/// How a joint stands now: what its limits and springs act on.
typedef struct fe_joint_state {
    uint32_t struct_size;
    float angle;              ///< the twist; of a hinge the angle, rad
    float swing_y, swing_z;   ///< rad
    fe_vec3 angular_velocity; ///< of B against A, rad/s, axes of frame A
    fe_vec3 translation;      ///< of frame B's point in frame A, m
    fe_vec3 linear_velocity;  ///< its rate of change, m/s
    float length;             ///< between the two points, m
    float speed;              ///< its rate of change, m/s
    float linear_error;       ///< distance of the points from where they are held, or beyond a limit, m
    float angular_error;      ///< likewise, rad
} fe_joint_state;

FE_API void fe_joint_state_init(fe_joint_state *state, uint32_t struct_size);
/// @param out_state  its struct_size must be set
FE_API fe_result fe_joint_get_state(const fe_world *world, fe_joint joint, fe_joint_state *out_state);
/// What the joint did to B in the last step, on average: force at frame B's point, N, and torque about it, N m, world
/// axes. A feels the opposite at the same point.
FE_API fe_result fe_joint_get_reaction(const fe_world *world, fe_joint joint, fe_vec3 *out_force, fe_vec3 *out_torque);
/// All joints, in the order of creation.
FE_API int32_t fe_world_get_joints(const fe_world *world, fe_joint *out_joints, int32_t capacity);
/// Those of a body, in the order of creation.
FE_API int32_t fe_body_get_joints(const fe_world *world, fe_body body, fe_joint *out_joints, int32_t capacity);

// ---- queries --------------------------------------------------------------------------------------------------------
//
// All of them return a count: 1 or 0 for the first hit, for the closest point and for `_any`, n for `_all`. Negative is
// an error. They see new and moved bodies at once.

/// What a query sees besides bodies, as bits.
typedef enum fe_query_flags {
    FE_QUERY_DEFAULT = 0,  ///< no triggers
    FE_QUERY_TRIGGERS = 1, ///< triggers count too
    FE_QUERY_FORCE32 = 0x7fffffff
} fe_query_flags;

/// Who counts. NULL for every layer, without triggers.
typedef struct fe_query_filter {
    uint32_t struct_size;
    uint32_t mask;           ///< layers that count. Default all
    uint32_t flags;          ///< fe_query_flags. Default FE_QUERY_DEFAULT
    int32_t excluded_count;  ///< Default 0
    const fe_body *excluded; ///< bodies that do not count; stale ones are ignored
} fe_query_filter;

FE_API void fe_query_filter_init(fe_query_filter *filter, uint32_t struct_size);

/// What a hit is besides, as bits.
typedef enum fe_hit_flags {
    FE_HIT_DEFAULT = 0,        ///< from outside, on the front
    FE_HIT_STARTED_INSIDE = 1, ///< overlaps at the start: fraction 0
    FE_HIT_BACK = 2,           ///< met a triangle of a two-sided mesh from behind
    FE_HIT_FORCE32 = 0x7fffffff
} fe_hit_flags;

/// Where a ray or a moving form met a body.
typedef struct fe_hit {
    fe_body body;         ///< that was hit
    fe_shape shape;       ///< of the body
    fe_dvec3 point;       ///< on the body's surface, m, world space; started inside: where the centre started
    double fraction;      ///< 0..1 of the translation
    uint64_t material;    ///< fe_material.user_id of what was hit
    fe_vec3 normal;       ///< unit, out of the body; started inside: against the translation, or the shortest way out
                          ///< when that is zero
    float depth;          ///< started inside: length of the shortest way out, m; else 0
    int32_t part;         ///< of a compound, else -1
    int32_t triangle;     ///< of a heightfield or a mesh, or the face of a hull, else -1
    float barycentric[2]; ///< weights of the triangle's second and third vertex at `point`; else 0, 0
    uint32_t flags;       ///< fe_hit_flags
    uint32_t reserved[5];
} fe_hit;

/// A segment of fe_world_raycast_many. The first 48 bytes will do.
typedef struct fe_ray {
    fe_dvec3 origin;      ///< m, world space
    fe_dvec3 translation; ///< to the end, m
    uint32_t reserved[4];
} fe_ray;

/// A motion of fe_world_sweep_many. The first 64 bytes will do for one without a turn.
typedef struct fe_path {
    fe_transform start;   ///< pose of the geometry there
    fe_dvec3 translation; ///< m
    fe_vec3 turn;         ///< rad, as for fe_world_sweep_turning; 0: it does not turn
    uint32_t reserved[5];
} fe_path;

/// The first body on a segment.
///
/// Exact on every shape. Heightfields are passed from below, one-sided meshes from behind. At equal fractions what the
/// ray starts in comes first, then the body created first, whatever the number of workers.
/// @param origin       start, m, world space
/// @param translation  from the start to the end, m; zero asks whether the start is inside a shape; heightfields and
///                     meshes have no inside
/// @param filter       who counts; NULL: every layer, no triggers
/// @param out_hit      written only on a hit
/// @return 1 on a hit, 0 on a miss
FE_API int32_t fe_world_raycast(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation,
                                const fe_query_filter *filter, fe_hit *out_hit);
/// Is anything on the segment? Faster than the first hit: it stops at whatever it finds.
/// @return 1 or 0
FE_API int32_t fe_world_raycast_any(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation,
                                    const fe_query_filter *filter);
/// Every body on a segment, each once, at its first hit, ordered by fraction, then by creation.
/// @param stride  sizeof(fe_hit); at least 92, the hits are ordered where they lie
/// @return how many bodies are hit; when they are more than `capacity` the nearest are written
FE_API int32_t fe_world_raycast_all(const fe_world *world, const fe_dvec3 *origin, const fe_dvec3 *translation,
                                    const fe_query_filter *filter, fe_hit *out_hits, uint32_t stride, int32_t capacity);
/// fe_world_raycast for many segments with one filter. The hits do not depend on `spread`.
/// @param ray_stride  bytes from one ray to the next: sizeof(fe_ray), or 48
/// @param spread      1: over the workers of the world, 0: on the calling thread
/// @param out_hits    one a ray, `stride` bytes apart; of a miss body and shape are 0, the fraction is 1, the point is
///                    the end
/// @return how many hit
FE_API int32_t fe_world_raycast_many(const fe_world *world, const fe_ray *rays, uint32_t ray_stride, int32_t count,
                                     const fe_query_filter *filter, int32_t spread, fe_hit *out_hits, uint32_t stride);

/// The first body that a moving sphere, capsule, box, cylinder, cone or hull touches. It does not turn.
///
/// It stops at most 1 micrometre before the body (0.1 mm: a box before a box), never in it. A body that it overlaps at
/// the start is a hit at fraction 0, flagged FE_HIT_STARTED_INSIDE. One that it starts to touch is a hit at fraction 0
/// without the flag; one that it leaves or slides along is no hit. An overlap of up to a nanometre is a touch: rounding
/// leaves as much of an exact one. Heightfields are passed from below, one-sided meshes from behind; what cuts their
/// surface overlaps them. At equal fractions what overlaps comes first, then the body created first.
/// @param geometry     sphere, capsule, box, cylinder, cone or hull; a sphere of radius 0 sweeps as a ray
/// @param start        pose of the geometry at the start
/// @param translation  m; zero asks what overlaps
/// @param filter       who counts; NULL: every layer, no triggers
/// @param out_hit      written only on a hit
/// @return 1 on a hit, 0 on a miss; FE_ERROR_UNSUPPORTED for other geometries; for assets and scales the errors of
///         fe_shape_create
FE_API int32_t fe_world_sweep(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                              const fe_dvec3 *translation, const fe_query_filter *filter, fe_hit *out_hit);
/// Does it touch anything? Faster than the first hit: it stops at whatever it finds.
/// @return 1 or 0
FE_API int32_t fe_world_sweep_any(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                                  const fe_dvec3 *translation, const fe_query_filter *filter);
/// Every body that it touches on its motion, as if the others were not there; see fe_world_raycast_all.
FE_API int32_t fe_world_sweep_all(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                                  const fe_dvec3 *translation, const fe_query_filter *filter, fe_hit *out_hits,
                                  uint32_t stride, int32_t capacity);
/// The first body that a geometry touches while it moves and turns, both at a constant rate.
///
/// After a part s of the motion its origin is at start + s * translation, and it has turned from the start's rotation
/// by s * |turn| rad about the direction of `turn`, a right-handed turn about an axis through its origin. The pose at
/// the stop is that at s = fraction. It stops before the body as fe_world_sweep does, and up to 3e-7 of its largest
/// distance from its origin farther off: rounding its rotation to a fe_quat does not carry it in. However thin a body
/// is, none is missed. The normal points out of the body, and may lean along the translation. A triangle with one side
/// is passed from below, and stops the geometry when the turn brings it back from above. What shows no turn (a sphere,
/// or what is round about the axis) sweeps as without it. The rest is as for fe_world_sweep.
/// @param turn  rad, world axes; each part in [-64, 64]: ten turns about an axis. Zero: fe_world_sweep
/// @return 1 on a hit, 0 on a miss; FE_ERROR_UNSUPPORTED for other geometries
FE_API int32_t fe_world_sweep_turning(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                                      const fe_dvec3 *translation, const fe_vec3 *turn, const fe_query_filter *filter,
                                      fe_hit *out_hit);
/// Does it touch anything while it moves and turns? Faster than the first hit: it stops at whatever it finds.
/// @return 1 or 0
FE_API int32_t fe_world_sweep_turning_any(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                                          const fe_dvec3 *translation, const fe_vec3 *turn,
                                          const fe_query_filter *filter);
/// Every body that it touches while it moves and turns, as if the others were not there; see fe_world_raycast_all.
FE_API int32_t fe_world_sweep_turning_all(const fe_world *world, const fe_geometry *geometry, const fe_transform *start,
                                          const fe_dvec3 *translation, const fe_vec3 *turn,
                                          const fe_query_filter *filter, fe_hit *out_hits, uint32_t stride,
                                          int32_t capacity);
/// fe_world_sweep, or fe_world_sweep_turning, of one geometry along many paths; see fe_world_raycast_many. Of a miss
/// the point is the end of the centre's motion.
/// @param path_stride  bytes from one path to the next: sizeof(fe_path); 64 for paths without a turn
FE_API int32_t fe_world_sweep_many(const fe_world *world, const fe_geometry *geometry, const fe_path *paths,
                                   uint32_t path_stride, int32_t count, const fe_query_filter *filter, int32_t spread,
                                   fe_hit *out_hits, uint32_t stride);

/// The bodies that a sphere, capsule, box, cylinder, cone or hull overlaps, in the order of creation: exactly those
/// that a sweep from there would start inside of.
/// @param geometry  as for fe_world_sweep; a sphere of radius 0 is a point
/// @param at        pose of the geometry
/// @return how many there are; when they are more than `capacity` those created first are written
FE_API int32_t fe_world_overlap(const fe_world *world, const fe_geometry *geometry, const fe_transform *at,
                                const fe_query_filter *filter, fe_body *out_bodies, int32_t capacity);
/// Does it overlap anything?
/// @return 1 or 0
FE_API int32_t fe_world_overlap_any(const fe_world *world, const fe_geometry *geometry, const fe_transform *at,
                                    const fe_query_filter *filter);

/// A shape that a geometry overlaps, and the shortest translation that parts the two.
typedef struct fe_overlap {
    fe_body body;      ///< that overlaps
    fe_shape shape;    ///< of the body
    uint64_t material; ///< fe_material.user_id where it is deepest
    fe_vec3 direction; ///< unit, out of the shape: a translation of the geometry by `depth` along it parts the two
    float depth;       ///< m, >= 0
    int32_t part;      ///< of a compound, where it is deepest; else -1
    int32_t triangle;  ///< of a heightfield or a mesh, where it is deepest; the face of a hull on that way; else -1
    uint32_t reserved[4];
} fe_overlap;

/// The shapes that a geometry overlaps, in the order of creation, with direction and depth: to move a character out.
/// A compound counts once, with the part that is overlapped deepest: it is that part which the translation parts.
/// @param stride  sizeof(fe_overlap), at least 16
/// @return how many there are; when they are more than `capacity` those created first are written
FE_API int32_t fe_world_overlap_shapes(const fe_world *world, const fe_geometry *geometry, const fe_transform *at,
                                       const fe_query_filter *filter, fe_overlap *out_overlaps, uint32_t stride,
                                       int32_t capacity);
/// The shapes whose bounds meet an axis-aligned box, in the order of creation. Faster than an exact overlap. A plane
/// counts when its half space meets the box.
/// @return how many there are; when they are more than `capacity` those created first are written
FE_API int32_t fe_world_overlap_bounds(const fe_world *world, const fe_bounds *bounds, const fe_query_filter *filter,
                                       fe_shape *out_shapes, int32_t capacity);

/// The point of a surface that is closest to a point.
typedef struct fe_closest {
    fe_body body;         ///< that is closest
    fe_shape shape;       ///< of the body
    fe_dvec3 point;       ///< of the shape's surface, m, world space
    double distance;      ///< to the surface, m; below 0 inside
    uint64_t material;    ///< fe_material.user_id there
    fe_vec3 normal;       ///< unit, out of the body; of a mesh towards the side that the point is on
    int32_t part;         ///< of a compound, else -1
    int32_t triangle;     ///< of a heightfield or a mesh, or the face of a hull, else -1
    float barycentric[2]; ///< weights of the triangle's second and third vertex at `point`; else 0, 0
    uint32_t reserved[5];
} fe_closest;

/// The point of all surfaces that is closest to a point. Inside a body its distance is below 0. The smallest distance
/// wins, then the body created first. Heightfields and meshes have no inside. A heightfield is not seen from below;
/// both sides of a mesh count.
/// @param max_distance  farther ones do not count, m, >= 0
/// @param out_closest   written only when there is one
/// @return 1, or 0 when there is none
FE_API int32_t fe_world_closest_point(const fe_world *world, const fe_dvec3 *point, double max_distance,
                                      const fe_query_filter *filter, fe_closest *out_closest);

/// fe_world_raycast against one shape or one body only, whatever its layers, a trigger or not, enabled or not.
/// @return 1 on a hit, 0 on a miss
FE_API int32_t fe_shape_raycast(const fe_world *world, fe_shape shape, const fe_dvec3 *origin,
                                const fe_dvec3 *translation, fe_hit *out_hit);
/// @return 1 on a hit, 0 on a miss
FE_API int32_t fe_body_raycast(const fe_world *world, fe_body body, const fe_dvec3 *origin, const fe_dvec3 *translation,
                               fe_hit *out_hit);
/// The closest point of one shape, however far.
/// @return 1; 0 from below a heightfield, and for one whose cells are all holes. Of a mesh both sides count
FE_API int32_t fe_shape_closest_point(const fe_world *world, fe_shape shape, const fe_dvec3 *point,
                                      fe_closest *out_closest);
/// The closest point of one body, however far.
/// @return 1; 0 for a body none of whose shapes has one
FE_API int32_t fe_body_closest_point(const fe_world *world, fe_body body, const fe_dvec3 *point,
                                     fe_closest *out_closest);

// ---- after the step: events, contacts, bulk reads -------------------------------------------------------------------

/// What an event tells of.
typedef enum fe_event_kind {
    FE_EVENT_ENTER = 1, ///< two shapes began to touch
    FE_EVENT_STAY = 2,  ///< they still touch
    FE_EVENT_EXIT = 3,  ///< they ceased to touch
    FE_EVENT_SLEEP = 4, ///< a body fell asleep
    FE_EVENT_WAKE = 5,  ///< a body woke
    FE_EVENT_BREAK = 6, ///< a joint broke
    FE_EVENT_FORCE32 = 0x7fffffff
} fe_event_kind;

/// Two shapes began to touch, went on, or ceased: a point had an impulse, or a gap of 0 or less, during the step. A is
/// the body created first. After the exit caused by a destruction, the handles of what was destroyed are stale.
typedef struct fe_pair_event {
    fe_body body_a, body_b;         ///< the two that met
    fe_shape shape_a, shape_b;      ///< of these bodies
    int32_t kind;                   ///< FE_EVENT_ENTER, FE_EVENT_STAY, FE_EVENT_EXIT
    int32_t is_trigger;             ///< 1 when either is a trigger
    int32_t part_a, part_b;         ///< of compounds: those of the deepest point; -1 at an exit, and of others
    int32_t triangle_a, triangle_b; ///< of a heightfield or a mesh, under the deepest point, else -1
    uint32_t reserved[4];
} fe_pair_event;

/// Events of the last step, ordered by the creation of A, then B. @param stride  sizeof(fe_pair_event)
FE_API int32_t fe_world_get_pair_events(const fe_world *world, fe_pair_event *out_events, uint32_t stride,
                                        int32_t capacity);

/// A body fell asleep or woke.
typedef struct fe_body_event {
    fe_body body; ///< that fell asleep or woke
    int32_t kind; ///< FE_EVENT_SLEEP, FE_EVENT_WAKE
    uint32_t reserved;
} fe_body_event;

/// Who fell asleep and who woke, in the last step and by calls before it, in the order of creation.
/// @param stride  sizeof(fe_body_event)
FE_API int32_t fe_world_get_body_events(const fe_world *world, fe_body_event *out_events, uint32_t stride,
                                        int32_t capacity);

/// An impact.
typedef struct fe_hit_event {
    fe_body body_a, body_b;          ///< the two that met
    fe_shape shape_a, shape_b;       ///< of these bodies
    uint64_t material_a, material_b; ///< fe_material.user_id where they met
    fe_dvec3 point;                  ///< m, world space
    fe_vec3 normal;                  ///< from A to B
    float speed;                     ///< of approach, m/s
    float impulse;                   ///< of the step, along the normal, N s
    int32_t part_a, part_b;          ///< of compounds: where the impulse was largest, else -1
    int32_t triangle_a, triangle_b;  ///< of a heightfield or a mesh, else -1
    uint32_t reserved[5];
} fe_hit_event;

/// Impacts of the last step on shapes that ask for FE_SHAPE_EVENTS_HIT, faster than
/// fe_world_tuning.hit_event_threshold.
/// @param stride  sizeof(fe_hit_event)
FE_API int32_t fe_world_get_hit_events(const fe_world *world, fe_hit_event *out_events, uint32_t stride,
                                       int32_t capacity);

/// A joint's reaction exceeded its break_force or break_torque in the last step: it is gone, its handle stale.
typedef struct fe_joint_event {
    fe_joint joint;         ///< that broke
    fe_body body_a, body_b; ///< 0: the world
    uint64_t user_data;     ///< of the joint
    int32_t kind;           ///< FE_EVENT_BREAK
    int32_t type;           ///< fe_joint_type
    fe_vec3 force;          ///< reaction that broke it, see fe_joint_get_reaction
    fe_vec3 torque;         ///< likewise, N m
} fe_joint_event;

/// Events of the last step, in the order of the joints' creation. @param stride  sizeof(fe_joint_event)
FE_API int32_t fe_world_get_joint_events(const fe_world *world, fe_joint_event *out_events, uint32_t stride,
                                         int32_t capacity);

/// Where two shapes touch, or are about to.
typedef struct fe_contact_point {
    fe_dvec3 point;       ///< between the surfaces, m, world space
    float separation;     ///< m, negative when they overlap
    float normal_impulse; ///< of the last step's end, per substep, N s
    float total_impulse;  ///< along the normal, over the whole last step, bounces included, N s
    uint32_t id;          ///< of the features that meet; stays while they do
} fe_contact_point;

/// A pair of shapes has one, with compounds each pair of parts; with a heightfield or a mesh one for each direction in
/// which it is touched, at most 6.
typedef struct fe_contact {
    fe_body body_a, body_b;          ///< the two that met
    fe_shape shape_a, shape_b;       ///< of these bodies
    uint64_t material_a, material_b; ///< fe_material.user_id under the deepest point
    fe_vec3 normal;                  ///< unit, from A to B
    int32_t point_count;             ///< 1..4
    fe_contact_point points[4];      ///< the first point_count of them
    fe_vec3 friction_impulse;        ///< on B, of the last substep, N s
    float twist_impulse;             ///< on B, about the normal, N m s
    int32_t part_a, part_b;          ///< of compounds, else -1
    int32_t triangle_a, triangle_b;  ///< of a heightfield or a mesh, under the deepest point, else -1
    uint32_t reserved[4];
} fe_contact;

/// The contacts of a body: pairs with at least one point within the speculative distance. Triggers have none.
/// @param stride  sizeof(fe_contact)
FE_API int32_t fe_body_get_contacts(const fe_world *world, fe_body body, fe_contact *out_contacts, uint32_t stride,
                                    int32_t capacity);
/// The contacts of a shape. @param stride  sizeof(fe_contact)
FE_API int32_t fe_shape_get_contacts(const fe_world *world, fe_shape shape, fe_contact *out_contacts, uint32_t stride,
                                     int32_t capacity);

/// The bodies that the last step moved, in the order of creation, and where they are now.
/// @param out_transforms  or NULL; `stride` bytes apart (0: packed)
FE_API int32_t fe_world_get_moved(const fe_world *world, fe_body *out_bodies, fe_transform *out_transforms,
                                  uint32_t stride, int32_t capacity);
/// All or none. @param stride  bytes from one transform to the next, 0: packed
FE_API fe_result fe_world_get_transforms(const fe_world *world, const fe_body *bodies, fe_transform *out_transforms,
                                         uint32_t stride, int32_t count);
/// fe_body_set_transform for many, all or none. @param stride  bytes from one transform to the next, 0: packed
FE_API fe_result fe_world_set_transforms(fe_world *world, const fe_body *bodies, const fe_transform *transforms,
                                         uint32_t stride, int32_t count);
/// Position relative to `origin`, m, and rotation, 7 floats a body: x y z, x y z w. @param stride  bytes, 0: packed
FE_API fe_result fe_world_get_transforms_f32(const fe_world *world, const fe_body *bodies, const fe_dvec3 *origin,
                                             float *out_floats, uint32_t stride, int32_t count);
/// Linear, then angular velocity, m/s, rad/s, 6 floats a body. @param stride  bytes, 0: packed
FE_API fe_result fe_world_get_velocities(const fe_world *world, const fe_body *bodies, float *out_floats,
                                         uint32_t stride, int32_t count);
/// Likewise. All or none: FE_ERROR_STATE with a static body. @param stride  bytes, 0: packed
FE_API fe_result fe_world_set_velocities(fe_world *world, const fe_body *bodies, const float *floats, uint32_t stride,
                                         int32_t count);
/// Force at the centre, N, then torque, N m, 6 floats a body, during the next step. @param stride  bytes, 0: packed
FE_API fe_result fe_world_add_forces(fe_world *world, const fe_body *bodies, const float *floats, uint32_t stride,
                                     int32_t count);

// Many joints with one call, all or none, along the free axis of each: the hinge's, the distance, or the first axis of
// a configurable joint that is not locked. A ball or fixed joint has none: it reads 0, and takes nothing
// (FE_ERROR_STATE). A joint may be named twice: its last value stands, forces add up.

/// Angle, translation or length, rad or m, then its rate, 2 floats a joint. @param stride  bytes, 0: packed
FE_API fe_result fe_world_get_joint_coordinates(const fe_world *world, const fe_joint *joints, float *out_floats,
                                                uint32_t stride, int32_t count);
/// Force, N, then torque, N m, as fe_joint_get_reaction: 6 floats a joint. @param stride  bytes, 0: packed
FE_API fe_result fe_world_get_joint_reactions(const fe_world *world, const fe_joint *joints, float *out_floats,
                                              uint32_t stride, int32_t count);
/// fe_joint_set_target for many, rad or m: a float a joint. @param stride  bytes, 0: packed
FE_API fe_result fe_world_set_joint_targets(fe_world *world, const fe_joint *joints, const float *values,
                                            uint32_t stride, int32_t count);
/// fe_joint_set_motor_speed for many, rad/s or m/s: a float a joint. @param stride  bytes, 0: packed
FE_API fe_result fe_world_set_joint_motor_speeds(fe_world *world, const fe_joint *joints, const float *values,
                                                 uint32_t stride, int32_t count);
/// A torque about the axis on B, N m, or a force along it, N, and the opposite on A, during the next step: a float a
/// joint. Sleeping bodies wake. @param stride  bytes, 0: packed
FE_API fe_result fe_world_add_joint_forces(fe_world *world, const fe_joint *joints, const float *values,
                                           uint32_t stride, int32_t count);

// ---- snapshots ------------------------------------------------------------------------------------------------------
// A world as bytes, between two calls: all that decides how it goes on, and what the calls say of the last step. A
// world made from them answers and moves as the saved one does, bit for bit, on every machine, with any workers and
// SIMD set. docs/SNAPSHOTS.md has the details.

/// What an asset is known by outside its store: a fingerprint of its content. Equal content has equal keys, on every
/// machine. An edited heightfield has another key.
typedef struct fe_asset_key {
    uint64_t words[2]; ///< nothing but equal or not
} fe_asset_key;

/// @return FE_ERROR_STALE, FE_ERROR_KIND as for any asset
FE_API fe_result fe_asset_get_key(const fe_store *store, fe_asset asset, fe_asset_key *out_key);

/// Bits of fe_save_options.flags.
typedef enum fe_save {
    FE_SAVE_ASSETS = 1, ///< the contents of its assets, too, by fe_asset_save: where it is loaded, none need be there
    FE_SAVE_DIFF = 2,   ///< only what differs from the snapshot `base`: whoever restores it has that, too
    FE_SAVE_FORCE32 = 0x7fffffff
} fe_save;

/// What is saved.
typedef struct fe_save_options {
    uint32_t struct_size;
    uint32_t flags;    ///< fe_save. Default 0: assets go by their keys
    const void *base;  ///< with FE_SAVE_DIFF: a whole snapshot, of any world; it pays for one of a few steps before
    int64_t base_size; ///< bytes
} fe_save_options;

FE_API void fe_save_options_init(fe_save_options *options, uint32_t struct_size);

/// Writes the world as bytes, little-endian, without pointers. The same state gives the same bytes, whatever the
/// machine, the workers, the SIMD set, and the allocator. Allocates nothing. In it are settings, tuning, bodies,
/// shapes, joints, contacts, who is awake, pending forces, the events of the last step, user data, and which handles
/// come next. Not in it are workers, pool, allocator, SIMD set, profile, counters, and the pair filter, which is yours.
/// @param options   NULL: the defaults
///
/// With FE_SAVE_DIFF it writes the difference to `base`, much smaller from one step to the next. How small it becomes
/// shows when it is written: NULL, 0 returns an upper bound, a quarter above the size of a whole snapshot. `out` needs
/// as much, and what it holds behind the size that is returned means nothing. It must not overlap `base`.
/// @param out       at any alignment; NULL, 0 asks for the size only, in the time of a walk over the awake pairs
/// @param capacity  bytes; with less than the size nothing is written
/// @return the size in bytes, or an error; FE_ERROR_DATA for a `base` that is no whole snapshot
FE_API int64_t fe_world_save(const fe_world *world, const fe_save_options *options, void *out, int64_t capacity);

/// What a restore may be told.
typedef struct fe_restore_options {
    uint32_t struct_size;
    int32_t new_number;  ///< 1: handles have the world's own number, not that of the saved one. Default 0
    int32_t asset_count; ///< of the two arrays. Default 0
    uint32_t reserved;
    const fe_asset_key *keys; ///< assets that stand for these keys, before those of the store
    const fe_asset *assets;   ///< of the world's store
    const void *base;         ///< for bytes that were saved with FE_SAVE_DIFF: the base they were saved against
    int64_t base_size;        ///< bytes
} fe_restore_options;

FE_API void fe_restore_options_init(fe_restore_options *options, uint32_t struct_size);

/// Makes the world the saved one: any bytes fit any world. Handles of what was made since are stale, and may be given
/// again to something else. The store, the workers, the SIMD set and the pair filter stay the world's own. An error
/// changes nothing. Bytes from anywhere may be given: what is accepted is sound, even if nobody saved it.
///
/// Assets are found by their keys in the world's store, or in the bytes, or in `options`; those from the bytes stay in
/// the store. A heightfield or a mesh of `options` may hold something else than its key says: what is on it wakes, as
/// after an edit. It takes memory for a second world while it runs.
/// @param options  NULL: the defaults
/// @param bytes    of fe_world_save, at any alignment; nothing keeps them
/// @return FE_FOREIGN: done, from a library whose results differ: it goes on, not bit for bit. FE_ERROR_DATA for bytes
///         that are cut, altered or of something else, or whose base is another; fe_last_error tells what is wrong.
///         FE_ERROR_VERSION for those of another format; FE_ERROR_STATE when an asset is missing, or when the saved
///         world had a pair filter and this one has none
FE_API fe_result fe_world_restore(fe_world *world, const fe_restore_options *options, const void *bytes, int64_t size);
/// A new world from the bytes: as fe_world_create and fe_world_restore. Of the definition count workers, pool, store,
/// allocator, tasks, SIMD set, and with new_number its number; all else is the saved world's.
/// @param def  NULL: the defaults
/// @return as those two
FE_API fe_result fe_world_load(const fe_world_def *def, const fe_restore_options *options, const void *bytes,
                               int64_t size, fe_world **out_world);

/// What a snapshot says of itself.
typedef struct fe_snapshot_info {
    uint32_t struct_size;
    uint32_t library; ///< fe_version of the library that saved it
    int32_t foreign;  ///< 1: its results differ from this library's
    uint32_t number;  ///< of the world
    int64_t step;     ///< how many steps there had been
    int32_t bodies;   ///< how many
    int32_t shapes;   ///< how many
    int32_t joints;   ///< how many
    int32_t assets;   ///< that shapes have
    int32_t inside;   ///< of them, those whose contents are in the bytes
    int32_t filter;   ///< 1: the world had a pair filter
} fe_snapshot_info;

FE_API void fe_snapshot_info_init(fe_snapshot_info *info, uint32_t struct_size);
/// Every check of a restore but for assets that are not in the bytes, without a world.
/// @param out_info  its struct_size must be set; or NULL
/// @return FE_OK, FE_FOREIGN, FE_ERROR_DATA, FE_ERROR_VERSION, FE_ERROR_MEMORY
FE_API fe_result fe_snapshot_check(const void *bytes, int64_t size, fe_snapshot_info *out_info);
/// The keys of the assets that a snapshot needs, each once for each scale that it is used with.
/// @param stride  sizeof(fe_asset_key)
/// @return how many there are, or an error
FE_API int32_t fe_snapshot_get_assets(const void *bytes, int64_t size, fe_asset_key *out_keys, uint32_t stride,
                                      int32_t capacity);

/// Where two snapshots differ.
typedef struct fe_difference {
    uint32_t struct_size;
    int32_t index;   ///< of a list's entry or an event, from 0. Else 0
    int32_t element; ///< of a field of several numbers, from 0: 1 is y of a velocity
    uint32_t reserved;
    fe_handle handle; ///< the body, shape or joint; of a pair the first shape; 0: it has none
    fe_handle other;  ///< of a pair the second shape. Else 0
    char kind[32];    ///< what differs: "body", "shape", "joint", "pair", "world", or a list by its name
    char field[32];   ///< which number of it; "there": one of the two does not have it
    char a[32];       ///< the value in the first snapshot, as text
    char b[32];       ///< the value in the second one
} fe_difference;

FE_API void fe_difference_init(fe_difference *difference, uint32_t struct_size);
/// Finds the first difference between two worlds, from their bytes alone: of the world's settings, then of bodies,
/// shapes, joints and pairs, of each kind in the order of creation, then of lists and events. Where things lie in
/// memory comes last. The boxes of the broad phase, the contents of assets and the number in the handles do not count:
/// handles are told with that of the first world.
/// @param out_difference  its struct_size must be set; stays as it is when there is none; or NULL
/// @return 1: they differ; 0: they do not; FE_ERROR_DATA or FE_ERROR_VERSION for bytes that are no snapshot,
///         FE_ERROR_MEMORY
FE_API int32_t fe_snapshot_compare(const void *a, int64_t a_size, const void *b, int64_t b_size,
                                   fe_difference *out_difference);

// ---- histories ------------------------------------------------------------------------------------------------------
// The last frames of a world, in memory, for rollback: keep each frame before its step, and when an input of the past
// turns out to be another one, go back to that frame and step again. A world that was put back answers and moves as it
// did then, bit for bit. docs/SNAPSHOTS.md shows the loop.
//
// A history is of one world, which may have several, and ends with fe_history_destroy or with the world. Calls of one
// that is gone are FE_ERROR_STALE.

/// How much a history keeps.
typedef struct fe_history_def {
    uint32_t struct_size;
    int32_t frames; ///< how many are kept, 1 to 65536. Default 16
    int64_t bytes;  ///< what all frames may hold together, 0: as much as they need. Default 0
} fe_history_def;

FE_API void fe_history_def_init(fe_history_def *def, uint32_t struct_size);

/// @param def  NULL: the defaults
FE_API fe_result fe_history_create(fe_world *world, const fe_history_def *def, fe_history **out_history);
FE_API fe_result fe_history_destroy(fe_history *history);

/// Keeps the world as it is: all that a snapshot holds, and the heights and materials of its assets. Beside queries,
/// never beside a step. When there are too many frames, or bytes, the oldest go. While a world sleeps and is left
/// alone, its frames share what they hold. The memory is the world's; in a history that is full it is used again.
/// @param frame  a number of yours, above that of the last frame kept
/// @return FE_ERROR_LIMIT when the frame alone needs more than `bytes`; FE_ERROR_MEMORY. Nothing changed then
FE_API fe_result fe_history_keep(fe_history *history, int64_t frame);

/// Puts the world back to a frame; those after it go, it stays. Handles of what was made since are stale, and may be
/// given again to something else. The pair filter stays as it is. Heights and materials that were edited since are put
/// back, for every world that has them.
/// @return FE_ERROR_STALE when there is no such frame; FE_ERROR_MEMORY; FE_ERROR_STEPPING, FE_ERROR_BUSY also when
///         another world with an edited asset is. Nothing changed then
FE_API fe_result fe_history_restore(fe_history *history, int64_t frame);

/// A frame of a history.
typedef struct fe_history_frame {
    int64_t frame; ///< its number
    int64_t bytes; ///< what it holds, without what the frame before it has, too
} fe_history_frame;

/// Which frames there are, the oldest first.
/// @param stride  bytes: sizeof of the caller's record
/// @return how many, or an error
FE_API int32_t fe_history_get_frames(const fe_history *history, fe_history_frame *out_frames, uint32_t stride,
                                     int32_t capacity);

// ---- many worlds ----------------------------------------------------------------------------------------------------
//
// For learning, sweeps and servers: clones of a world, states to set it back to, and batches, which step thousands of
// worlds with one call. docs/MANY.md has an example and what it costs.

/// A world like another one: poses, contacts, impulses, sleep, events, handles, the pair filter. Both go on bit for
/// bit. It shares the store of the source; a store that was the source's own then lives as long as any of its clones.
/// Not cloned are recorders and histories. User data are the source's, the world's own too.
/// @param def  as of fe_world_load: of it count workers, pool, allocator, tasks, SIMD set. NULL: the defaults
/// @return FE_ERROR_ARGUMENT when the definition has another store than the source's
FE_API fe_result fe_world_clone(const fe_world *source, const fe_world_def *def, fe_world **out_world);

/// What the world is now, to set it back to. Never changes, belongs to no world, and keeps the store.
/// @param allocator  of its memory, NULL: malloc. It is called when the state is destroyed, too
FE_API fe_result fe_state_create(const fe_world *world, const fe_allocator *allocator, fe_state **out_state);
/// @return FE_ERROR_STALE for one that is gone
FE_API fe_result fe_state_destroy(fe_state *state);
/// The world becomes what the state is of, in the time of a copy: that world, a clone of it, or any that uses the same
/// store. Handles are those of the state. Heights and materials that were edited since are put back, for every world
/// that has them. Many threads may use one state at once.
/// @return FE_ERROR_STATE when the state is of another store; FE_ERROR_STALE; FE_ERROR_MEMORY; FE_ERROR_STEPPING,
///         FE_ERROR_BUSY also when another world with an edited asset is. Nothing changed then
FE_API fe_result fe_world_set_state(fe_world *world, const fe_state *state);

/// How many worlds, and who steps them.
typedef struct fe_batch_def {
    uint32_t struct_size;
    int32_t world_count;  ///< 1..1048576. Default 1
    int32_t worker_count; ///< 1..64; without a pool or tasks. Default 1
    int32_t block;        ///< worlds that a worker takes at once, 0: chosen. Never shows in results. Default 0
    int32_t simd;         ///< fe_simd. Default FE_SIMD_AUTO
    uint32_t reserved;
    fe_pool *pool;                 ///< NULL: none
    const fe_task_system *tasks;   ///< NULL: none
    const fe_allocator *allocator; ///< of all memory, called by any worker at any time. NULL: malloc
} fe_batch_def;

FE_API void fe_batch_def_init(fe_batch_def *def, uint32_t struct_size);
/// So many clones of a world, which stays the caller's. A handle of it names the same thing in each of them. Each is
/// stepped by one worker.
FE_API fe_result fe_batch_create(const fe_world *source, const fe_batch_def *def, fe_batch **out_batch);
/// Its worlds go with it.
/// @return FE_ERROR_STALE for one that is gone; FE_ERROR_BUSY while one of its worlds is in a call
FE_API fe_result fe_batch_destroy(fe_batch *batch);
/// One of the worlds, for all other calls but fe_world_destroy and fe_recorder_create (FE_ERROR_STATE).
FE_API fe_result fe_batch_get_world(const fe_batch *batch, int32_t index, fe_world **out_world);

/// A row of numbers of a body, a joint or a world. A joint's row is of its free axis: the hinge's, the distance, or the
/// first axis of a configurable joint that is not locked; a ball or fixed joint has none (it reads 0, and takes
/// nothing: FE_ERROR_STATE).
typedef enum fe_field {
    FE_FIELD_NONE = 0,         ///< no field yet
    FE_FIELD_TRANSFORM = 1,    ///< body, 7, read and written: position, rotation x y z w
    FE_FIELD_VELOCITY = 2,     ///< body, 6, read and written: linear, angular, as fe_world_set_velocities
    FE_FIELD_FORCE = 3,        ///< body, 6, written: force, torque, as fe_world_add_forces
    FE_FIELD_AWAKE = 4,        ///< body, 1, read: 1 or 0
    FE_FIELD_JOINT = 5,        ///< joint, 2, read: angle, translation or length, rad or m, and its rate
    FE_FIELD_JOINT_FORCE = 6,  ///< joint, 1, written: N or N m on B along or about the axis, the opposite on A
    FE_FIELD_JOINT_SPEED = 7,  ///< joint, 1, written: fe_joint_set_motor_speed
    FE_FIELD_JOINT_TARGET = 8, ///< joint, 1, written: fe_joint_set_target
    FE_FIELD_REACTION = 9,     ///< joint, 6, read: force, torque, as fe_joint_get_reaction
    FE_FIELD_GRAVITY = 10,     ///< the world, 3, read and written
    /// body, 3, read: what its contacts push it with, N: along normals the mean of the last step, friction that of its
    /// last substep. Of a body at rest as long as it sleeps
    FE_FIELD_CONTACT_FORCE = 11,
    FE_FIELD_MASS = 12,     ///< dynamic body, 1, read and written: fe_body_set_mass, which scales the inertia too
    FE_FIELD_FRICTION = 13, ///< shape, 2, read and written: static, dynamic friction of its material
    FE_FIELD_FORCE32 = 0x7fffffff
} fe_field;

/// A packed array of the caller's: for each world, for each item, the numbers of a row.
typedef struct fe_array {
    uint32_t struct_size;
    int32_t field;          ///< fe_field
    int32_t item_count;     ///< >= 1; 1 for the world itself
    int32_t is_double;      ///< 1: double, 0: float. Default 0
    fe_body relative_to;    ///< read in this body's frame: poses relative to it, vectors along its axes. 0: the world's
    fe_dvec3 origin;        ///< m, of the world's frame, that positions are read from
    const fe_handle *items; ///< of the template; copied. NULL for the world itself
    void *data;             ///< world_count x item_count x the row
    int64_t bytes;          ///< of `data`: exactly these
} fe_array;

FE_API void fe_array_init(fe_array *array, uint32_t struct_size);
/// The arrays that each fe_batch_step reads before its first step and fills after its last, while a world is in its
/// worker's cache. They replace those bound before, and must live until then, or until the batch ends.
/// @return FE_ERROR_ARGUMENT for a field that is not read or not written, sizes that do not fit, or a written one with
///         a frame; FE_ERROR_STALE for an item that no world has; FE_ERROR_KIND; FE_ERROR_BUSY when a world is in a
///         call. Nothing changed then
FE_API fe_result fe_batch_bind(fe_batch *batch, const fe_array *inputs, int32_t input_count, const fe_array *outputs,
                               int32_t output_count);
/// Steps each world as fe_world_step does, bit for bit, whatever the workers, the block and the mask. A world that
/// fails stands after its last whole step, without the forces of the step that failed, and the others go on. An input
/// that a world cannot take fails that world: nothing of its row is taken. So does an item that is gone: its outputs
/// are 0 (FE_ERROR_STALE). fe_last_error names the first. Worlds with a pair filter are stepped by the thread that
/// calls, in their order, after the others.
/// @param dt           s, as fe_world_step
/// @param steps        1..1000; the inputs hold in all of them
/// @param mask         a byte a world, 0: left alone; NULL: all
/// @param out_results  fe_result of each world, FE_OK of those left alone; or NULL
/// @return how many worlds failed; negative: an error, and nothing changed: FE_ERROR_BUSY when a world is in a call
FE_API int32_t fe_batch_step(fe_batch *batch, float dt, int32_t steps, const uint8_t *mask, int32_t *out_results);
/// Sets worlds back to what the template was, or to states of theirs.
/// @param states  one a world, NULL: the template's; NULL: all of them
/// @return as fe_batch_step; FE_ERROR_STALE, FE_ERROR_STATE for a state that is gone, or of another store
FE_API int32_t fe_batch_reset(fe_batch *batch, const uint8_t *mask, const fe_state *const *states,
                              int32_t *out_results);
/// Reads a field of every world into an array.
/// @return as fe_batch_step: how many worlds lack an item; FE_ERROR_STALE for one that no world has
FE_API int32_t fe_batch_read(fe_batch *batch, const fe_array *array, int32_t *out_results);
/// Writes a field of worlds from an array, for each world all rows or none.
FE_API int32_t fe_batch_write(fe_batch *batch, const fe_array *array, const uint8_t *mask, int32_t *out_results);
/// fe_world_hash of each world.
/// @param out_words  two a world
FE_API fe_result fe_batch_hash(fe_batch *batch, uint32_t *out_words);

// ---- recordings -----------------------------------------------------------------------------------------------------
//
// A recording holds what a world was when it began, and each call that changed it since. A player makes the same calls
// in a world of its own, on any machine, with any workers and SIMD set, and compares: handles at each call, hashes at
// each step, the whole state at each keyframe. docs/RECORDING.md has the details and the bytes.

/// Bits of fe_recorder_def.flags.
typedef enum fe_record_flags {
    FE_RECORD_NONE = 0,   ///< calls, hashes and keyframes; of assets their keys
    FE_RECORD_ASSETS = 1, ///< contents of assets, by fe_asset_save: where it is played, none need be there
    FE_RECORD_FINE = 2,   ///< 17 bytes for each awake body and step: who diverges is named at once
    FE_RECORD_LAST = 4,   ///< a flight recorder: what no longer fits goes, oldest first
    FE_RECORD_FORCE32 = 0x7fffffff
} fe_record_flags;

/// How a world is recorded.
typedef struct fe_recorder_def {
    uint32_t struct_size;
    uint32_t flags;         ///< fe_record_flags. Default FE_RECORD_ASSETS
    int32_t keyframe_steps; ///< a snapshot each time that so many steps moved something; 0: one, at first. Default 600
    uint32_t reserved;
    int64_t buffer_bytes; ///< that may wait to be read, or with FE_RECORD_LAST are kept, from 65536 on. Default 64 MB
} fe_recorder_def;

FE_API void fe_recorder_def_init(fe_recorder_def *def, uint32_t struct_size);
/// Begins a recording, between any two calls. Each call that changes the world is noted from here on, until the
/// recorder or the world is destroyed. Calls that fail changed nothing and are left out. The world has one recorder at
/// most. What goes wrong in a recording ends it, and never a call of the world: see fe_recorder_read.
/// @param def  NULL: the defaults
/// @return FE_ERROR_STATE when the world has a recorder; FE_ERROR_LIMIT when the first keyframe does not fit
FE_API fe_result fe_recorder_create(fe_world *world, const fe_recorder_def *def, fe_recorder **out_recorder);
/// What was recorded since the last read, as bytes to be appended to a file: whole chunks, as many as fit. With
/// FE_RECORD_LAST the whole recording as it is kept, each time, or nothing when it does not fit. Any thread may read,
/// also during a step.
/// @param out       NULL, 0 asks for the size of what waits
/// @param capacity  bytes
/// @param out_size  bytes that were written
/// @return FE_ERROR_LIMIT when not even the next chunk fits: *out_size is what it takes. When nothing waits, why the
///         recording ended: FE_END with its world, FE_ERROR_MEMORY, FE_ERROR_LIMIT as nobody read and the buffer was
///         full
FE_API fe_result fe_recorder_read(fe_recorder *recorder, void *out, int64_t capacity, int64_t *out_size);
/// Leaves words at this moment of the recording.
/// @param about  any handle, or 0
/// @param text   UTF-8, ends with 0; at most 4096 bytes
/// @return FE_ERROR_STATE when the recording has ended
FE_API fe_result fe_recorder_note(fe_recorder *recorder, fe_handle about, const char *text);
/// Ends the recording. What nobody read is lost. The pointer is dead afterwards. From the thread that uses the world.
/// @return FE_ERROR_STEPPING, FE_ERROR_BUSY as for a call of the world
FE_API fe_result fe_recorder_destroy(fe_recorder *recorder);

/// How a recording is played.
typedef struct fe_player_def {
    uint32_t struct_size;
    int32_t worker_count; ///< 1..64. Default 1
    int32_t simd;         ///< fe_simd. Default FE_SIMD_AUTO
    uint32_t reserved;
    fe_pool *pool;                 ///< or NULL
    fe_store *store;               ///< where assets are found that the recording does not hold; NULL: one of its own
    const fe_allocator *allocator; ///< copied; of player and world. NULL: malloc
} fe_player_def;

FE_API void fe_player_def_init(fe_player_def *def, uint32_t struct_size);
/// @param def  NULL: the defaults
/// @return FE_ERROR_STALE for a pool or a store that is gone
FE_API fe_result fe_player_create(const fe_player_def *def, fe_player **out_player);
/// Adds bytes of a recording, in pieces of any size. They are copied. A recording that was cut plays to its last whole
/// chunk. Bytes from anywhere may be given: they are refused or played.
/// @return FE_ERROR_DATA for what is no recording or was altered: what stood before it plays; FE_ERROR_VERSION for a
///         newer format; FE_ERROR_UNSUPPORTED for packed chunks: unpack them with tools/feather-rec
FE_API fe_result fe_player_feed(fe_player *player, const void *bytes, int64_t size);
/// Makes the recorded calls up to the end of the next step.
/// @return FE_END: no more yet. FE_ERROR_DIVERGED, once: the world went another way in this step, see
///         fe_player_get_divergence; it goes on with the next call. FE_ERROR_DATA for calls that nobody recorded so;
///         FE_ERROR_MEMORY: call it again when there is some; FE_ERROR_STATE when an asset is missing
FE_API fe_result fe_player_step(fe_player *player);
/// Goes to the end of a step, forwards or backwards, from the nearest keyframe before it.
/// @param step  as fe_player_info counts
/// @return FE_ERROR_ARGUMENT for a step before the first one; else as fe_player_step
FE_API fe_result fe_player_seek(fe_player *player, int64_t step);
/// The world as it is now, for all calls that read. It is the player's: what writes it is FE_ERROR_STATE. Its clones
/// and the batches made of it are the caller's; their pair filter, where it has one, lets all pairs collide.
/// @return FE_ERROR_STATE before the first step or seek, and after fe_player_release
FE_API fe_result fe_player_get_world(const fe_player *player, const fe_world **out_world);
/// Hands the world over: it is the caller's from here on, to be changed, stepped, destroyed. Its pair filter, where the
/// recorded world had one, lets all pairs collide: set another. A seek makes the player another world.
/// @return FE_ERROR_STATE as for fe_player_get_world
FE_API fe_result fe_player_release(fe_player *player, fe_world **out_world);

/// Where a player is, and what it has.
typedef struct fe_player_info {
    uint32_t struct_size;
    uint32_t library;     ///< fe_version of the library that recorded; 0: no header yet
    uint32_t flags;       ///< fe_record_flags of the recording
    int32_t foreign;      ///< 1: the results of that library differ from this one's
    int64_t first_step;   ///< where the first keyframe stands
    int64_t last_step;    ///< where the last whole chunk begins, at least: what it holds shows as it is played
    int64_t step;         ///< where the player is: steps of the recording, from the world's step number at its start on
    int64_t calls;        ///< that were made since the player's creation, steps among them
    int64_t bytes;        ///< fed, of whole chunks
    int32_t keyframes;    ///< in these
    int32_t notes;        ///< likewise
    int32_t has_diverged; ///< 1: there is a divergence to be told
    uint32_t reserved;
} fe_player_info;

FE_API void fe_player_info_init(fe_player_info *info, uint32_t struct_size);
/// @param out_info  its struct_size must be set
FE_API fe_result fe_player_get_info(const fe_player *player, fe_player_info *out_info);

/// Words that somebody left in a recording.
typedef struct fe_note {
    int64_t step;     ///< steps that there had been
    fe_handle about;  ///< as it was given
    const char *text; ///< valid as long as the player
} fe_note;

/// The notes of what was fed, in their order.
/// @param stride  sizeof(fe_note), at least 16
FE_API int32_t fe_player_get_notes(const fe_player *player, fe_note *out_notes, uint32_t stride, int32_t capacity);

/// What differs where a replay goes another way.
typedef enum fe_divergence_type {
    FE_DIVERGENCE_CALL = 1,     ///< a call failed, or returned another handle
    FE_DIVERGENCE_STEP = 2,     ///< the bodies after a step, or how many of them are awake, pairs or contacts
    FE_DIVERGENCE_KEYFRAME = 3, ///< the whole state
    FE_DIVERGENCE_FORCE32 = 0x7fffffff
} fe_divergence_type;

/// The first difference between a replay and its recording.
typedef struct fe_divergence {
    uint32_t struct_size;
    int32_t type;      ///< fe_divergence_type
    int64_t step;      ///< of the recording
    fe_handle body;    ///< the first that differs, of those awake; 0: not known without FE_RECORD_FINE
    int32_t component; ///< of the field: 0 x, 1 y, 2 z, 3 w; -1: none
    uint32_t reserved;
    const char *field; ///< "linear velocity"...; "" when it is not known. Valid as long as the library
    const char *text;  ///< all of it in a sentence; valid as long as the player, until the next divergence
} fe_divergence;

FE_API void fe_divergence_init(fe_divergence *divergence, uint32_t struct_size);
/// @param out_divergence  its struct_size must be set
/// @return FE_ERROR_STATE when there was none
FE_API fe_result fe_player_get_divergence(const fe_player *player, fe_divergence *out_divergence);
/// The pointer is dead afterwards.
FE_API fe_result fe_player_destroy(fe_player *player);

// ---- drawing --------------------------------------------------------------------------------------------------------
//
// What the world looks like from inside, as arrays for whoever draws: a debug view, a picture, a renderer's first day.
// Nothing is called back and nothing is allocated. Any thread may draw while others read. Ask for the number first, or
// draw into a buffer that grew in the frame before; with less room the first ones are written. Shapes come in the
// order in which their bodies were created, then the other parts in the order of fe_draw_flags.
//
// **Colours** are safe for the colour-blind. Static bodies are grey, kinematic ones blue. Awake dynamic bodies have one
// of eight hues, that of their island's oldest body; sleeping ones are dim. Triggers and disabled bodies are see-
// through. Contact points and forces go from pale to dark with what they carry. Limits go from green to red as they are
// used.

/// What is drawn, as bits.
typedef enum fe_draw_flags {
    FE_DRAW_NONE = 0,      ///< nothing
    FE_DRAW_SHAPES = 1,    ///< triangles: surfaces; lines: edges; instances
    FE_DRAW_CONTACTS = 2,  ///< points: where shapes touch; lines: their normals, `scale` long
    FE_DRAW_FORCES = 4,    ///< lines: forces of contacts and joints in the last step, and those added for the next one
    FE_DRAW_JOINTS = 8,    ///< points: where joints are fixed; lines: from there to the bodies' centres, axes of frames
    FE_DRAW_LIMITS = 16,   ///< lines: the ranges of joints, and where they are now
    FE_DRAW_ISLANDS = 32,  ///< each island has a hue, that of its body created first; else all have one
    FE_DRAW_SLEEP = 64,    ///< who sleeps is dim
    FE_DRAW_BOUNDS = 128,  ///< lines: the box around each shape, of a compound around each part
    FE_DRAW_CENTRES = 256, ///< points: centres of mass; lines: principal axes
    FE_DRAW_TREES = 512,   ///< lines: the boxes of the trees that serve pairs and queries
    FE_DRAW_FORCE32 = 0x7fffffff
} fe_draw_flags;

/// What to draw, and how.
typedef struct fe_draw_options {
    uint32_t struct_size;
    uint32_t parts;        ///< fe_draw_flags. Default FE_DRAW_SHAPES | FE_DRAW_ISLANDS | FE_DRAW_SLEEP
    fe_dvec3 origin;       ///< what is drawn is relative to it: the camera, for worlds that are large, m. Default 0
    fe_dvec3 lower, upper; ///< only what meets this box; of heightfields and meshes triangles near it. Default all
    fe_body only;          ///< only this body, its contacts and its joints; 0: all. Default 0
    float scale;           ///< of a normal, and of a force that would carry the lighter body, m, > 0. Default 0.5
    int32_t segments;      ///< of a circle, 3..128. Default 16
} fe_draw_options;

FE_API void fe_draw_options_init(fe_draw_options *options, uint32_t struct_size);

/// A corner of a triangle, an end of a line, or a point.
typedef struct fe_draw_vertex {
    float x, y, z;   ///< relative to fe_draw_options.origin, m, world axes
    uint32_t rgba;   ///< red | green << 8 | blue << 16 | alpha << 24: in memory of most machines red comes first
    fe_handle owner; ///< the shape or the joint that it is of, A of a contact, the body of a centre; 0: an inner box
} fe_draw_vertex;

/// A shape, for renderers that have a mesh for each form and draw all of a form at once.
typedef struct fe_draw_instance {
    int32_t type;         ///< fe_geometry_type
    uint32_t rgba;        ///< as in fe_draw_vertex
    fe_shape shape;       ///< that it shows
    fe_body body;         ///< of the shape
    fe_asset asset;       ///< of a hull, a heightfield, a mesh; else 0
    fe_vec3 position;     ///< relative to fe_draw_options.origin, m
    fe_quat rotation;     ///< to the world's axes
    fe_vec3 half_extents; ///< of a box; of what is round: radius, half height (of a capsule without its caps), radius;
                          ///< of a hull, a mesh, a heightfield: its scale; of a plane: x and z of a piece of it, whose
                          ///< outside is along Y
    int32_t part;         ///< of a shape made of parts, else -1
    uint32_t reserved[3];
} fe_draw_instance;

/// Lines: two vertices each. Edges of meshes and heightfields come once. A plane is a grid, as far as 100 m around the
/// point of it that is nearest to the origin.
/// @param options       NULL: the defaults
/// @param out_vertices  `stride` bytes apart
/// @param stride        sizeof(fe_draw_vertex), at least 16
/// @return how many vertices there are; FE_ERROR_STALE for a body that is gone; FE_ERROR_LIMIT for more than 2^31 - 1
FE_API int32_t fe_world_draw_lines(const fe_world *world, const fe_draw_options *options, fe_draw_vertex *out_vertices,
                                   uint32_t stride, int32_t capacity);
/// Triangles: three vertices each, counterclockwise seen from outside. Those of a closed form are a closed surface.
/// Both sides of a two-sided mesh are one triangle. The rest is as for fe_world_draw_lines.
FE_API int32_t fe_world_draw_triangles(const fe_world *world, const fe_draw_options *options,
                                       fe_draw_vertex *out_vertices, uint32_t stride, int32_t capacity);
/// Points: a vertex each. The rest is as for fe_world_draw_lines.
FE_API int32_t fe_world_draw_points(const fe_world *world, const fe_draw_options *options, fe_draw_vertex *out_vertices,
                                    uint32_t stride, int32_t capacity);
/// Shapes as forms and poses. Of the parts only FE_DRAW_SHAPES and its colours count.
/// @param options        NULL: the defaults
/// @param out_instances  `stride` bytes apart
/// @param stride         sizeof(fe_draw_instance), at least 16
/// @return how many there are; FE_ERROR_STALE for a body that is gone
FE_API int32_t fe_world_draw_instances(const fe_world *world, const fe_draw_options *options,
                                       fe_draw_instance *out_instances, uint32_t stride, int32_t capacity);

// ---- sugar, compiled by the caller: no part of the ABI --------------------------------------------------------------

/// Each fills a geometry. What is out of range is found where the geometry is used.
static inline void fe_geometry_sphere(fe_geometry *out_geometry, float radius)
{
    fe_geometry_init(out_geometry, (uint32_t)sizeof *out_geometry);
    out_geometry->type = FE_GEOMETRY_SPHERE;
    out_geometry->radius = radius;
}

/// @param half_height  of the axis, along local Y, without the caps
static inline void fe_geometry_capsule(fe_geometry *out_geometry, float half_height, float radius)
{
    fe_geometry_init(out_geometry, (uint32_t)sizeof *out_geometry);
    out_geometry->type = FE_GEOMETRY_CAPSULE;
    out_geometry->half_height = half_height;
    out_geometry->radius = radius;
}

/// Half the edges' lengths.
static inline void fe_geometry_box(fe_geometry *out_geometry, float half_x, float half_y, float half_z)
{
    fe_geometry_init(out_geometry, (uint32_t)sizeof *out_geometry);
    out_geometry->type = FE_GEOMETRY_BOX;
    out_geometry->half_extents.x = half_x;
    out_geometry->half_extents.y = half_y;
    out_geometry->half_extents.z = half_z;
}

/// @param half_height  along local Y
static inline void fe_geometry_cylinder(fe_geometry *out_geometry, float half_height, float radius)
{
    fe_geometry_init(out_geometry, (uint32_t)sizeof *out_geometry);
    out_geometry->type = FE_GEOMETRY_CYLINDER;
    out_geometry->half_height = half_height;
    out_geometry->radius = radius;
}

/// Its tip is at +half_height along local Y, its base at -half_height, its centre of mass halfway between the shape's
/// origin and the base.
/// @param radius  of the base
static inline void fe_geometry_cone(fe_geometry *out_geometry, float half_height, float radius)
{
    fe_geometry_init(out_geometry, (uint32_t)sizeof *out_geometry);
    out_geometry->type = FE_GEOMETRY_CONE;
    out_geometry->half_height = half_height;
    out_geometry->radius = radius;
}

/// The half space normal . p <= distance.
static inline void fe_geometry_plane(fe_geometry *out_geometry, float normal_x, float normal_y, float normal_z,
                                     float distance)
{
    fe_geometry_init(out_geometry, (uint32_t)sizeof *out_geometry);
    out_geometry->type = FE_GEOMETRY_PLANE;
    out_geometry->normal.x = normal_x;
    out_geometry->normal.y = normal_y;
    out_geometry->normal.z = normal_z;
    out_geometry->distance = distance;
}

/// The hull's points are in the shape's frame as they were given. Its asset lives as long as the shape does.
static inline void fe_geometry_hull(fe_geometry *out_geometry, fe_asset hull)
{
    fe_geometry_init(out_geometry, (uint32_t)sizeof *out_geometry);
    out_geometry->type = FE_GEOMETRY_HULL;
    out_geometry->asset = hull;
}

/// See fe_heightfield_def for its frame. Its asset lives as long as the shape does.
static inline void fe_geometry_heightfield(fe_geometry *out_geometry, fe_asset heightfield)
{
    fe_geometry_init(out_geometry, (uint32_t)sizeof *out_geometry);
    out_geometry->type = FE_GEOMETRY_HEIGHTFIELD;
    out_geometry->asset = heightfield;
}

/// The mesh's vertices are in the shape's frame as they were given. Its asset lives as long as the shape does.
static inline void fe_geometry_mesh(fe_geometry *out_geometry, fe_asset mesh)
{
    fe_geometry_init(out_geometry, (uint32_t)sizeof *out_geometry);
    out_geometry->type = FE_GEOMETRY_MESH;
    out_geometry->asset = mesh;
}

/// The compound's parts are in the shape's frame as they were given. Its asset lives as long as the shape does.
static inline void fe_geometry_compound(fe_geometry *out_geometry, fe_asset compound)
{
    fe_geometry_init(out_geometry, (uint32_t)sizeof *out_geometry);
    out_geometry->type = FE_GEOMETRY_COMPOUND;
    out_geometry->asset = compound;
}

/// The scale of a hull or a mesh that the geometry was filled with. The asset stays as it is: shapes of one asset may
/// each have another scale, and shapes of equal scale share what it takes. What is mirrored keeps its outside.
///
/// A scale that cannot be is found where the geometry is used. FE_ERROR_ARGUMENT: it is out of range, takes a point
/// beyond 100000 m, or is that of another form. FE_ERROR_UNSUPPORTED: it is that of a heightfield or a compound.
/// FE_ERROR_DEGENERATE: a hull would be thinner, or a triangle of a mesh smaller, than fe_hull_create and
/// fe_mesh_create allow.
static inline void fe_geometry_set_scale(fe_geometry *geometry, float x, float y, float z)
{
    if (!geometry) return;
    geometry->scale.x = x;
    geometry->scale.y = y;
    geometry->scale.z = z;
}

#ifndef SWIG

static inline fe_vec3 fe_make_vec3(float x, float y, float z)
{
    fe_vec3 a;
    a.x = x, a.y = y, a.z = z;
    return a;
}

static inline fe_dvec3 fe_make_dvec3(double x, double y, double z)
{
    fe_dvec3 a;
    a.x = x, a.y = y, a.z = z;
    return a;
}

/// No rotation, at a position.
static inline fe_transform fe_make_transform(double x, double y, double z)
{
    fe_transform t;
    t.position = fe_make_dvec3(x, y, z);
    t.rotation.x = t.rotation.y = t.rotation.z = 0.0f, t.rotation.w = 1.0f;
    return t;
}

#endif

#ifdef __cplusplus
}
#endif

#endif
