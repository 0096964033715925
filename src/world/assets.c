// assets.c - the life of heightfields: what shapes share.
//
// Called by the API layer with checked arguments, between steps. A shape with a heightfield is a user of its asset; the narrow phase and
// the queries read the records. New heights reach the shapes' bounds and trees at once and the contacts in the next step.
#include "world/assets.h"

#include "world/pair_list.h"
#include "world/proxies.h"
#include "world/sleep.h"

#include <string.h>

// ---- birth ------------------------------------------------------------------------------------------------------------------------
static int64_t sample_count(const fe__heightfield *f) { return (int64_t)f->rows * f->columns; }
static int64_t cell_count(const fe__heightfield *f) { return (int64_t)(f->rows - 1) * (f->columns - 1); }
static size_t heights_size(const fe__heightfield *f) { return (size_t)sample_count(f) * sizeof *f->heights; }
static size_t ranges_size(const fe__heightfield *f) { return (size_t)f->rows * sizeof *f->ranges; }
static size_t materials_size(const fe__asset *a) { return (size_t)a->material_count * sizeof *a->materials; }

static void free_record(fe_world *world, int32_t index)
{
    fe__heightfield *f = world->fields + index;
    fe__asset *a = world->assets + index;
    fe__release(&world->memory, f->heights, heights_size(f));
    fe__release(&world->memory, f->ranges, ranges_size(f));
    fe__release(&world->memory, f->cells, (size_t)cell_count(f));
    fe__release(&world->memory, a->materials, materials_size(a));
    *f = (fe__heightfield){0};
    *a = (fe__asset){.first_user = -1};
}

static int32_t needs_special_rows(const fe_material *m)
{
    return m->restitution > 0.0f || m->rolling_resistance > 0.0f || m->spinning_resistance > 0.0f;
}

static void fill_cells(fe__heightfield *f, const fe_heightfield_def *def)
{
    for (int64_t i = 0; f->cells && i < cell_count(f); ++i) {
        int32_t hole = def->holes && def->holes[i];
        f->cells[i] = hole ? (uint8_t)FE__CELL_HOLE : def->cell_materials ? def->cell_materials[i] : (uint8_t)0;
    }
}

static void fill_materials(fe__asset *a, const fe_heightfield_def *def)
{
    uint32_t stride = def->material_stride ? def->material_stride : (uint32_t)sizeof(fe_material);
    for (int32_t i = 0; i < a->material_count; ++i) {
        memcpy(a->materials + i, (const unsigned char *)def->materials + (size_t)stride * (size_t)i, sizeof *a->materials);
        a->special |= needs_special_rows(a->materials + i);
    }
}

int32_t fe__heightfield_create(fe_world *world, const fe_heightfield_def *def)
{
    fe__memory *memory = &world->memory;
    fe_result ids = fe__id_pool_reserve(&world->asset_ids, memory, 1);
    if (ids != FE_OK) return ids;
    int64_t need = (int64_t)world->asset_ids.slot_count + (world->asset_ids.free_count ? 0 : 1);
    if (!FE_RESERVE(memory, world->fields, world->field_capacity, need) || !FE_RESERVE(memory, world->assets, world->asset_capacity, need))
        return FE_ERROR_MEMORY;

    int32_t index = fe__id_slot_of(fe__id_pool_allocate(&world->asset_ids));
    fe__heightfield *f = world->fields + index;
    fe__asset *a = world->assets + index;
    *f = (fe__heightfield){.rows = def->rows, .columns = def->columns, .cell_x = (double)def->cell_x, .cell_z = (double)def->cell_z};
    *a = (fe__asset){.first_user = -1, .material_count = def->cell_materials ? def->material_count : 0};
    f->heights = fe__allocate(memory, heights_size(f));
    f->ranges = fe__allocate(memory, ranges_size(f));
    if (def->holes || def->cell_materials) f->cells = fe__allocate(memory, (size_t)cell_count(f));
    if (a->material_count) a->materials = fe__allocate(memory, materials_size(a));
    int32_t no_cells = !f->cells && (def->holes || def->cell_materials);
    if (!f->heights || !f->ranges || no_cells || (a->material_count && !a->materials)) {
        free_record(world, index);
        fe__id_pool_release(&world->asset_ids, index);
        return FE_ERROR_MEMORY;
    }
    memcpy(f->heights, def->heights, heights_size(f));
    fe__heightfield_measure(f, 0, f->rows);
    fill_cells(f, def);
    fill_materials(a, def);
    return index;
}

// ---- users and death ----------------------------------------------------------------------------------------------------------------
void fe__asset_destroy(fe_world *world, int32_t index)
{
    world->assets[index].destroyed = 1;
    if (world->assets[index].first_user >= 0) return;
    free_record(world, index);
    fe__id_pool_release(&world->asset_ids, index);
}

void fe__shape_take_asset(fe_world *world, int32_t index)
{
    fe__shape *shape = world->shapes + index;
    shape->next_user = -1;
    if (!fe__form_has_asset(&shape->form)) return;
    fe__asset *a = world->assets + shape->form.field;
    shape->next_user = a->first_user;
    a->first_user = index;
}

void fe__shape_release_asset(fe_world *world, int32_t index)
{
    const fe__shape *shape = world->shapes + index;
    if (!fe__form_has_asset(&shape->form)) return;
    fe__asset *a = world->assets + shape->form.field;
    int32_t *at = &a->first_user;
    while (*at != index) at = &world->shapes[*at].next_user;
    *at = shape->next_user;
    if (a->destroyed && a->first_user < 0) fe__asset_destroy(world, shape->form.field);
}

void fe__assets_free(fe_world *world)
{
    for (int32_t i = 0; i < world->asset_ids.slot_count; ++i)
        if (fe__id_pool_is_alive(&world->asset_ids, i)) free_record(world, i);
    fe__id_pool_free(&world->asset_ids, &world->memory);
    FE_FREE(&world->memory, world->fields, world->field_capacity);
    FE_FREE(&world->memory, world->assets, world->asset_capacity);
}

// ---- new heights --------------------------------------------------------------------------------------------------------------------
// The part of a heightfield that new samples change, in its frame: a cell beyond them on each side.
static fe__bounds changed_part(const fe__heightfield *f, int32_t row, int32_t column, int32_t rows, int32_t columns)
{
    double far = (double)INFINITY;
    fe__bounds b = {{(double)(column - 1) * f->cell_x, -far, (double)(row - 1) * f->cell_z},
                    {(double)(column + columns) * f->cell_x, far, (double)(row + rows) * f->cell_z}};
    return b;
}

static int32_t is_over(const fe_world *world, const fe__shape *field, int32_t other, const fe__bounds *part)
{
    const fe__shape *shape = world->shapes + other;
    fe__pose local = {fe__drotate_back(field->pose.rotation, fe__dsub(shape->pose.position, field->pose.position)),
                      fe__product(fe__conjugate(field->pose.rotation), shape->pose.rotation)};
    fe__bounds b = fe__form_bounds(&shape->form, &local);
    double margin = (double)world->tuning.speculative_distance;
    return b.low.x - margin <= part->high.x && b.high.x + margin >= part->low.x && b.low.z - margin <= part->high.z &&
           b.high.z + margin >= part->low.z;
}

// What touches that part, or is near it, wakes and looks anew.
static void renew_pairs(fe_world *world, int32_t index, const fe__bounds *part)
{
    const fe__shape *field = world->shapes + index;
    for (int32_t pair = world->bodies[field->body].first_contact; pair >= 0; pair = fe__next_pair(world, pair, field->body)) {
        const fe__pair *p = world->pairs + pair;
        if (p->flags & FE__PAIR_PATCH || (p->shape_a != index && p->shape_b != index)) continue;
        int32_t other = p->shape_a == index ? p->shape_b : p->shape_a;
        if (!is_over(world, field, other, part)) continue;
        world->contacts[pair].surface.tolerance = 0.0f; // what moved by nothing has moved too far
        if (p->flags & FE__PAIR_LINKED) fe__wake(world, world->shapes[other].body);
        fe__pair_look_once(world, pair);
    }
}

void fe__heightfield_set_heights(fe_world *world, int32_t index, int32_t row, int32_t column, int32_t rows, int32_t columns,
                                 const float *heights)
{
    fe__heightfield *f = world->fields + index;
    for (int32_t r = 0; r < rows; ++r)
        memcpy(f->heights + (int64_t)(row + r) * f->columns + column, heights + (int64_t)r * columns, (size_t)columns * sizeof *heights);
    fe__heightfield_measure(f, row, rows);
    fe__form form = fe__heightfield_form(f, index);
    fe__bounds part = changed_part(f, row, column, rows, columns);
    for (int32_t shape = world->assets[index].first_user; shape >= 0; shape = world->shapes[shape].next_user) {
        world->shapes[shape].form = form;
        renew_pairs(world, shape, &part);
        fe__shape_touch(world, shape);
    }
}
