// Definitions of assets: tables with arrays of samples, points, triangles and materials.
#ifndef FE_BINDINGS_LUA_ASSETS_H
#define FE_BINDINGS_LUA_ASSETS_H

#include "feather.h"
#include "lua/arrays.h"

static const uint8_t *to_cells(lua_State *L, int index, int cells, const char *what)
{
    if (lua_isnil(L, index)) return NULL;
    if (length_of(L, index, what) != cells) fail(L, "feather: %s: %d numbers are needed", what, cells);
    uint8_t *bytes = new_array(L, cells, 1);
    for (int i = 0; i < cells; ++i) {
        lua_rawgeti(L, index, i + 1);
        bytes[i] = (uint8_t)to_integer(L, -1, 0, UINT8_MAX, what);
        lua_pop(L, 1);
    }
    return bytes;
}

/// A table of at most 255 materials; nil is none.
static const fe_material *to_materials(lua_State *L, int index, int32_t *out_count)
{
    if (lua_isnil(L, index)) return NULL;
    int count = length_of(L, index, "materials");
    if (count > 255) fail(L, "feather: materials: at most 255");
    fe_material *materials = new_array(L, count, sizeof *materials);
    for (int i = 0; i < count; ++i) {
        lua_rawgeti(L, index, i + 1);
        to_material(L, lua_gettop(L), &materials[i], "materials");
        lua_pop(L, 1);
    }
    *out_count = count;
    return materials;
}

/// {rows=, columns=, cell_x=, cell_z=, heights={...}, holes=, cell_materials=, materials={{...}}}. The last three are
/// optional.
static void to_heightfield(lua_State *L, int index, fe_heightfield_def *def)
{
    enum { MOST = 32768 };
    check_table(L, index, "heightfield");
    fe_heightfield_def_init(def, (uint32_t)sizeof *def);
    def->rows = (int32_t)to_integer(L, field(L, index, "rows"), 2, MOST, "rows");
    def->columns = (int32_t)to_integer(L, field(L, index, "columns"), 2, MOST, "columns");
    def->cell_x = (float)to_number(L, field(L, index, "cell_x"), "cell_x");
    def->cell_z = (float)to_number(L, field(L, index, "cell_z"), "cell_z");
    call_state call = {0};
    def->heights = to_floats(L, field(L, index, "heights"), 1, &call, "heights");
    heights_fit(L, call.count, def->rows, def->columns);
    int cells = (def->rows - 1) * (def->columns - 1);
    def->holes = to_cells(L, field(L, index, "holes"), cells, "holes");
    def->cell_materials = to_cells(L, field(L, index, "cell_materials"), cells, "cell_materials");
    def->materials = to_materials(L, field(L, index, "materials"), &def->material_count);
}

// ---- hulls and meshes -----------------------------------------------------------------------------------------------

static uint32_t *to_words(lua_State *L, int index, int width, call_state *call, const char *what)
{
    int count = records_in(L, index, width, call, what) * width;
    uint32_t *words = new_array(L, count, sizeof *words);
    for (int i = 0; i < count; ++i) {
        lua_rawgeti(L, index, i + 1);
        words[i] = (uint32_t)to_integer(L, -1, 0, UINT32_MAX, what);
        lua_pop(L, 1);
    }
    return words;
}

/// {points={x, y, z...}, max_vertices=, tolerance=}
static void to_hull(lua_State *L, int index, fe_hull_def *def)
{
    check_table(L, index, "hull");
    fe_hull_def_init(def, (uint32_t)sizeof *def);
    call_state call = {0};
    def->points = to_floats(L, field(L, index, "points"), 3, &call, "points");
    def->point_count = call.count;
    def->max_vertices =
        (int32_t)to_integer(L, field(L, index, "max_vertices"), INT32_MIN, INT32_MAX, "max_vertices");
    def->tolerance = (float)to_number(L, field(L, index, "tolerance"), "tolerance");
}

/// {vertices={x, y, z...}, triangles={a, b, c...}, flags=, weld_distance=, edge_angle=, triangle_materials=,
/// materials={{...}}, triangle_data=}. The last three are optional. The first vertex is 0.
static void to_mesh(lua_State *L, int index, fe_mesh_def *def)
{
    check_table(L, index, "mesh");
    fe_mesh_def_init(def, (uint32_t)sizeof *def);
    call_state vertices = {0}, triangles = {0};
    def->vertices = to_floats(L, field(L, index, "vertices"), 3, &vertices, "vertices");
    def->indices = to_words(L, field(L, index, "triangles"), 3, &triangles, "triangles");
    def->vertex_count = vertices.count, def->triangle_count = triangles.count;
    def->flags = (uint32_t)to_integer(L, field(L, index, "flags"), 0, UINT32_MAX, "flags");
    def->weld_distance = (float)to_number(L, field(L, index, "weld_distance"), "weld_distance");
    def->edge_angle = (float)to_number(L, field(L, index, "edge_angle"), "edge_angle");
    def->triangle_materials =
        to_cells(L, field(L, index, "triangle_materials"), triangles.count, "triangle_materials");
    def->materials = to_materials(L, field(L, index, "materials"), &def->material_count);
    int data = field(L, index, "triangle_data");
    if (!lua_isnil(L, data)) def->triangle_data = to_words(L, data, 1, &triangles, "triangle_data");
}

#endif
