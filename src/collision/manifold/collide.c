// collide.c - which kernel a pair of forms belongs to.
//
// A form without kernels of its own needs a support function and faces only (form.h): whatever the table leaves
// empty goes the general convex way (convex.c).
#include "collision/manifold/collide.h"

#include "collision/form/hull.h"
#include "collision/manifold/pair_kernels.h"

#include <assert.h>
#include <stddef.h>

// [type of A][type of B]
static fe__kernel *const kernels[FE__FORM_TYPES][FE__FORM_TYPES] = {
    [FE__FORM_SPHERE] = {[FE__FORM_SPHERE] = fe__collide_sphere_sphere},
    [FE__FORM_CAPSULE] =
        {[FE__FORM_SPHERE] = fe__collide_capsule_sphere, [FE__FORM_CAPSULE] = fe__collide_capsule_capsule},
    [FE__FORM_BOX] = {[FE__FORM_SPHERE] = fe__collide_box_sphere,
                      [FE__FORM_CAPSULE] = fe__collide_box_capsule,
                      [FE__FORM_BOX] = fe__collide_box_box,
                      [FE__FORM_HULL] = fe__collide_hulls},
    [FE__FORM_HULL] = {[FE__FORM_BOX] = fe__collide_hulls, [FE__FORM_HULL] = fe__collide_hulls},
    [FE__FORM_PLANE] = {[FE__FORM_SPHERE] = fe__collide_plane_sphere,
                        [FE__FORM_CAPSULE] = fe__collide_plane_capsule,
                        [FE__FORM_BOX] = fe__collide_plane_box,
                        [FE__FORM_CYLINDER] = fe__collide_plane_curved,
                        [FE__FORM_CONE] = fe__collide_plane_curved,
                        [FE__FORM_HULL] = fe__collide_plane_hull},
};

static float half_size(const fe__form *form)
{
    if (fe__form_is_hull(form)) return 0.5f * form->scale * form->hull->extent;
    return fe__maxf(fe__maxf(form->half.x, form->half.y), form->half.z);
}

// boxes and hulls
static int32_t has_size(const fe__form *form) { return form->type == FE__FORM_BOX || fe__form_is_hull(form); }

int32_t fe__collide_swaps(const fe__form *a, const fe__form *b)
{
    if (a->type == b->type || (has_size(a) && has_size(b))) return half_size(a) < half_size(b);
    return a->type < b->type;
}

void fe__collide(const fe__form *a, const fe__form *b, const fe__relative *b_in_a, float margin, fe__manifold *manifold)
{
    assert(b->type != FE__FORM_PLANE && (a->type >= b->type || (has_size(a) && has_size(b))));
    manifold->normal = fe__vec3(0.0f, 0.0f, 0.0f);
    manifold->count = manifold->round = manifold->left_out = 0;
    fe__kernel *kernel = kernels[a->type][b->type];
    if (kernel == NULL) kernel = fe__collide_convex;
    kernel(a, b, b_in_a, margin, manifold);
}
