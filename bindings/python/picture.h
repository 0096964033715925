// picture.h - a picture of a world for Python, by tools/picture.
#ifndef PYTHON_PICTURE_H
#define PYTHON_PICTURE_H
#include "convert.h"

#include "../../tools/picture/picture.h"

typedef struct picture_request {
    picture_view view;
    fe_vec3 toward_eye; ///< where the eye is not given
    int is_fitted;
    int32_t width, height;
} picture_request;

/// (world, width, height, parts, eye, target, direction): eye and target, or None and None
static int to_request(PyObject *arguments, PyObject **out_world, picture_request *out)
{
    PyObject *eye, *target, *direction;
    *out = (picture_request){.view = {.focal = 1.0, .sun = {-1.0f, 2.0f, 1.0f}, .scale = 1.0f}};
    if (!PyArg_ParseTuple(arguments, "OiiIOOO", out_world, &out->width, &out->height, &out->view.parts, &eye, &target,
                          &direction))
        return -1;
    const int w = out->width, h = out->height;
    if (w < PICTURE_LEAST || w > PICTURE_MOST || h < PICTURE_LEAST || h > PICTURE_MOST) {
        PyErr_Format(error_class(FE_ERROR_ARGUMENT), "width, height: a picture has %d to %d pixels a side, not %d x %d",
                     PICTURE_LEAST, PICTURE_MOST, w, h);
        return -1;
    }
    out->is_fitted = eye == Py_None;
    if (out->is_fitted) return to_vec3(direction, &out->toward_eye, "direction");
    if (to_dvec3(eye, &out->view.eye, "eye") || to_dvec3(target, &out->view.target, "target")) return -1;
    const fe_dvec3 e = out->view.eye, t = out->view.target;
    const double away = sqrt((e.x - t.x) * (e.x - t.x) + (e.y - t.y) * (e.y - t.y) + (e.z - t.z) * (e.z - t.z));
    out->view.radius = 2.0 * away; // shadows as far behind the target as the eye is before it, haze beyond
    return 0;
}

/// @param out_png  to be freed
static int32_t take_picture(const fe_world *world, picture_request *r, uint8_t **out_png, size_t *out_size)
{
    int32_t result = r->is_fitted ? picture_fit(world, r->toward_eye, r->width, r->height, &r->view) : FE_OK;
    if (result != FE_OK) return result;
    *out_png = picture_take(world, &r->view, r->width, r->height, out_size);
    return *out_png != NULL ? FE_OK : FE_ERROR_MEMORY;
}

static PyObject *flat_picture(PyObject *self, PyObject *arguments)
{
    PyObject *capsule, *picture = NULL;
    picture_request request;
    uint8_t *png = NULL;
    size_t size = 0;
    (void)self;
    if (to_request(arguments, &capsule, &request)) return NULL;
    world_box *box = world_of(capsule);
    if (!box || may_use(box, 0, "picture")) return NULL;
    Py_INCREF(capsule);
    enter_read(box);
    PyThreadState *others = PyEval_SaveThread();
    const int32_t result = take_picture(box->world, &request, &png, &size);
    PyEval_RestoreThread(others);
    leave_read(box);
    if (result == FE_OK)
        picture = PyBytes_FromStringAndSize((const char *)png, (Py_ssize_t)size);
    else
        PyErr_NoMemory();
    free(png);
    Py_DECREF(capsule);
    return picture;
}

#endif
