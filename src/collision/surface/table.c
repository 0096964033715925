// table.c - which file draws which form; see surface.h.
#include "collision/surface/kinds.h"

typedef struct draw_traits {
    void (*triangles)(const fe__drawn *s, fe__pen *pen);
    void (*lines)(const fe__drawn *s, fe__pen *pen);
} draw_traits;

static const draw_traits traits[FE__FORM_TYPES] = {
    [FE__FORM_SPHERE] = {fe__draw_round, fe__draw_round_lines},
    [FE__FORM_CAPSULE] = {fe__draw_round, fe__draw_round_lines},
    [FE__FORM_BOX] = {fe__draw_box, fe__draw_box_lines},
    [FE__FORM_CYLINDER] = {fe__draw_round, fe__draw_round_lines},
    [FE__FORM_CONE] = {fe__draw_round, fe__draw_round_lines},
    [FE__FORM_HULL] = {fe__draw_hull, fe__draw_hull_lines},
    [FE__FORM_PLANE] = {fe__draw_plane, fe__draw_plane_lines},
    [FE__FORM_HEIGHTFIELD] = {fe__draw_field, fe__draw_field_lines},
    [FE__FORM_MESH] = {fe__draw_field, fe__draw_field_lines},
};

void fe__surface_triangles(const fe__drawn *s, fe__pen *pen) { traits[s->form->type].triangles(s, pen); }
void fe__surface_lines(const fe__drawn *s, fe__pen *pen) { traits[s->form->type].lines(s, pen); }

fe_vec3 fe__surface_half_extents(const fe__form *form)
{
    switch (form->type) {
    case FE__FORM_SPHERE:
        return fe__vec3(form->radius, form->radius, form->radius);
    case FE__FORM_CAPSULE:
        return fe__vec3(form->radius, form->half_height, form->radius);
    case FE__FORM_BOX:
    case FE__FORM_CYLINDER:
    case FE__FORM_CONE:
        return form->half;
    default:
        return fe__vec3(1.0f, 1.0f, 1.0f);
    }
}
