// triangles.h - what there is to see: the triangles of a world in the camera's space, with normals.
#ifndef PICTURE_TRIANGLES_H
#define PICTURE_TRIANGLES_H
#include "picture.h"
#include "vec.h"

/// The camera's space: x to the right, y upwards, z forwards, the eye at 0. Left-handed
typedef struct camera {
    vec right, up, forward; ///< in the world
} camera;

typedef struct triangle {
    vec corners[3], normals[3]; ///< normals are those of the form where it is round, else that of the face
    vec normal;                 ///< of the face, unit, outwards
    uint32_t rgba;
    vec own;                 ///< what of white light it gives back, see light_own
    int32_t body;            ///< counted from 0
    int32_t two_sided, flat; ///< flat: its normals are that of the face
} triangle;

/// @return how many there are, to be freed; or an error
int32_t gather_triangles(const fe_world *world, const picture_view *view, const camera *camera, triangle **out);

camera make_camera(const picture_view *view);
vec into_camera(const camera *camera, vec world);

/// Vertices of a draw call, to be freed. @return how many, or an error
typedef int32_t draw_call(const fe_world *, const fe_draw_options *, fe_draw_vertex *, uint32_t, int32_t);
int32_t draw_all(draw_call *call, const fe_world *world, const picture_view *view, uint32_t parts,
                 fe_draw_vertex **out);

#endif
