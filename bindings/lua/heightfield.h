// Definitions of heightfields: tables with arrays of samples, holes and materials.
#ifndef FE_BINDINGS_LUA_HEIGHTFIELD_H
#define FE_BINDINGS_LUA_HEIGHTFIELD_H

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

static void to_materials(lua_State *L, int index, fe_heightfield_def *def)
{
    if (lua_isnil(L, index)) return;
    int count = length_of(L, index, "materials");
    if (count > 255) fail(L, "feather: materials: at most 255");
    fe_material *materials = new_array(L, count, sizeof *materials);
    for (int i = 0; i < count; ++i) {
        lua_rawgeti(L, index, i + 1);
        to_material(L, lua_gettop(L), &materials[i], "materials");
        lua_pop(L, 1);
    }
    def->materials = materials;
    def->material_count = count;
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
    to_materials(L, field(L, index, "materials"), def);
}

#endif
