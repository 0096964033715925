// Bodies, shapes and what queries find, as objects of the package's own classes. They are made and read here because
// the interpreter takes ten times as long for a hit as the library for its ray.
#ifndef FE_BINDINGS_PYTHON_FOUND_H
#define FE_BINDINGS_PYTHON_FOUND_H

#include "convert.h"

#include <structmember.h>

enum { ENTITY, BODY, SHAPE, HIT, CLOSEST, OVERLAP, CLASSES };
static PyTypeObject *known_classes[CLASSES];
/// Where an entity has its attributes: _world, _capsule, _id.
enum { WORLD_SLOT, CAPSULE_SLOT, ID_SLOT, SLOTS };
static Py_ssize_t slots[SLOTS];

/// Of the class's own or a base's: another one's would lie beyond the object.
static int is_slot_of(PyTypeObject *type, PyObject *member)
{
    if (!Py_IS_TYPE(member, &PyMemberDescr_Type)) return 0;
    const PyMemberDef *def = ((PyMemberDescrObject *)member)->d_member;
    return def->type == T_OBJECT_EX && !(def->flags & READONLY) && PyType_IsSubtype(type, PyDescr_TYPE(member));
}

static int find_slot(PyTypeObject *type, const char *name, Py_ssize_t *out_slot)
{
    PyObject *member = PyObject_GetAttrString((PyObject *)type, name);
    if (!member) return -1;
    int is_slot = is_slot_of(type, member);
    if (is_slot) *out_slot = ((PyMemberDescrObject *)member)->d_member->offset;
    Py_DECREF(member);
    if (!is_slot) PyErr_Format(PyExc_TypeError, "%s is no slot", name);
    return is_slot ? 0 : -1;
}

/// Where objects of the class have their attributes: where those have them that there are already.
static int find_slots(PyTypeObject *type, Py_ssize_t out_slots[SLOTS])
{
    if (find_slot(type, "_world", &out_slots[WORLD_SLOT]) || find_slot(type, "_capsule", &out_slots[CAPSULE_SLOT]) ||
        find_slot(type, "_id", &out_slots[ID_SLOT]))
        return -1;
    if (!known_classes[ENTITY] || memcmp(out_slots, slots, sizeof slots) == 0) return 0;
    PyErr_SetString(PyExc_TypeError, "the slots are not where they were");
    return -1;
}

static int is_class(PyObject *object, PyTypeObject *base)
{
    if (!base) return PyErr_SetString(PyExc_RuntimeError, "set_classes() comes first"), 0;
    if (PyType_Check(object) && PyType_IsSubtype((PyTypeObject *)object, base)) return 1;
    PyErr_Format(PyExc_TypeError, "a class of %s is needed", base->tp_name);
    return 0;
}

/// Are objects of the class made by `base`'s own __new__? Those of dict or time.struct_time are more than is made here.
static int is_made_by(PyObject *class, PyTypeObject *base)
{
    PyObject *made = base == &PyTuple_Type ? PyObject_CallMethod((PyObject *)base, "__new__", "O()", class)
                                           : PyObject_CallMethod((PyObject *)base, "__new__", "O", class);
    Py_XDECREF(made);
    return made != NULL;
}

static int are_classes(PyObject *const given[CLASSES])
{
    for (int i = 0; i < CLASSES; ++i) {
        PyTypeObject *maker = i < HIT ? &PyBaseObject_Type : &PyTuple_Type;
        if (!is_class(given[i], i == BODY || i == SHAPE ? (PyTypeObject *)given[ENTITY] : maker)) return 0;
        if (!is_made_by(given[i], maker)) return 0;
    }
    return 1;
}

/// Takes the classes from a tuple, in the order of the enum: the entities, then the named tuples. All or none.
static PyObject *set_classes(PyObject *tuple)
{
    Py_ssize_t found[SLOTS];
    if (!PyTuple_Check(tuple) || PyTuple_GET_SIZE(tuple) != CLASSES)
        return PyErr_SetString(PyExc_TypeError, "a tuple of classes is needed"), NULL;
    PyObject **given = PySequence_Fast_ITEMS(tuple);
    if (!are_classes(given) || find_slots((PyTypeObject *)given[ENTITY], found)) return NULL;
    memcpy(slots, found, sizeof slots);
    for (int i = 0; i < CLASSES; ++i) {
        PyTypeObject *type = (PyTypeObject *)Py_NewRef(given[i]);
        Py_XSETREF(known_classes[i], type);
    }
    Py_RETURN_NONE;
}

// ---- bodies, shapes, joints -----------------------------------------------------------------------------------------

static PyObject **slot_of(PyObject *entity, int slot) { return (PyObject **)((char *)entity + slots[slot]); }

/// The world that is found in: its object, and its capsule.
typedef struct place {
    PyObject *world, *capsule;
} place;

/// The cycle collector may run, and a script in it that sets other classes.
static PyObject *allocate(PyTypeObject *type, Py_ssize_t count)
{
    Py_INCREF(type);
    PyObject *made = type->tp_alloc(type, count);
    Py_DECREF(type);
    return made;
}

static PyObject *new_entity(PyTypeObject *type, const place *in, fe_handle handle)
{
    if (!type) return PyErr_SetString(PyExc_RuntimeError, "set_classes() comes first"), NULL;
    PyObject *id = PyLong_FromUnsignedLongLong(handle);
    PyObject *made = id ? allocate(type, 0) : NULL;
    if (!made) {
        Py_XDECREF(id);
        return NULL;
    }
    *slot_of(made, WORLD_SLOT) = Py_NewRef(in->world);
    *slot_of(made, CAPSULE_SLOT) = Py_NewRef(in->capsule);
    *slot_of(made, ID_SLOT) = id;
    return made;
}

static int not_of_class(PyObject *object, PyTypeObject *type)
{
    PyObject *wanted = PyObject_GetAttrString((PyObject *)type, "__name__");
    PyObject *given = wanted ? PyObject_GetAttrString((PyObject *)Py_TYPE(object), "__name__") : NULL;
    if (given) PyErr_Format(PyExc_TypeError, "a %S is needed, not %R", wanted, given);
    Py_XDECREF(wanted);
    Py_XDECREF(given);
    return -1;
}

/// The handle of an object of a class of entities, if it is one of this world.
static int to_handle(PyObject *world, PyObject *object, PyTypeObject *type, fe_handle *out_handle)
{
    if (!PyObject_TypeCheck(object, type)) return not_of_class(object, type);
    PyObject *home = *slot_of(object, WORLD_SLOT), *id = *slot_of(object, ID_SLOT);
    if (!home || !id) return PyErr_SetString(PyExc_AttributeError, "an object of no world"), -1;
    if (home != world) {
        PyErr_Format(error_class(FE_ERROR_ARGUMENT), "%R belongs to another world", object);
        return -1;
    }
    if (!PyLong_Check(id)) return PyErr_SetString(PyExc_TypeError, "an object without a handle"), -1;
    int overflow; // by digits: PyLong_AsUnsignedLongLong() goes byte by byte
    const long long handle = PyLong_AsLongLongAndOverflow(id, &overflow);
    if (overflow || handle < 0) return PyErr_SetString(PyExc_OverflowError, "a handle is an integer below 2^53"), -1;
    *out_handle = (fe_handle)handle;
    return 0;
}

/// (world, object, class): the object's handle.
static PyObject *handle_of(PyObject *arguments)
{
    PyObject *world, *object, *type;
    fe_handle handle;
    if (!PyArg_UnpackTuple(arguments, "handle_of", 3, 3, &world, &object, &type)) return NULL;
    if (!is_class(type, known_classes[ENTITY]) || to_handle(world, object, (PyTypeObject *)type, &handle)) return NULL;
    return PyLong_FromUnsignedLongLong(handle);
}

/// (world, sequence of objects, class): the handles of all, as bytes.
static PyObject *handles_of(PyObject *arguments)
{
    PyObject *world, *given, *type;
    if (!PyArg_UnpackTuple(arguments, "handles_of", 3, 3, &world, &given, &type)) return NULL;
    if (!is_class(type, known_classes[ENTITY])) return NULL;
    PyObject *objects = PyList_Check(given) ? Py_NewRef(given) : PySequence_Tuple(given);
    if (!objects) return NULL;
    Py_ssize_t count = PySequence_Fast_GET_SIZE(objects);
    PyObject *bytes = PyBytes_FromStringAndSize(NULL, count * (Py_ssize_t)sizeof(fe_handle));
    fe_handle *handles = bytes ? (fe_handle *)(void *)PyBytes_AS_STRING(bytes) : NULL;
    for (Py_ssize_t i = 0; bytes && i < count; ++i)
        if (to_handle(world, PySequence_Fast_GET_ITEM(objects, i), (PyTypeObject *)type, &handles[i])) Py_CLEAR(bytes);
    Py_DECREF(objects);
    return bytes;
}

// ---- named tuples ---------------------------------------------------------------------------------------------------

/// Takes the references; the fields of what failed are NULL.
static PyObject *new_record(PyTypeObject *type, PyObject *const *fields, Py_ssize_t count)
{
    int whole = 1;
    for (Py_ssize_t i = 0; i < count; ++i) whole &= fields[i] != NULL;
    PyObject *made = whole ? allocate(type, count) : NULL;
    for (Py_ssize_t i = 0; i < count; ++i) {
        if (made)
            PyTuple_SET_ITEM(made, i, fields[i]);
        else
            Py_XDECREF(fields[i]);
    }
    return made;
}

static PyObject *from_weights(const float barycentric[2])
{
    PyObject *second = PyFloat_FromDouble((double)barycentric[0]), *third = PyFloat_FromDouble((double)barycentric[1]);
    PyObject *weights = second && third ? PyTuple_Pack(2, second, third) : NULL;
    Py_XDECREF(second);
    Py_XDECREF(third);
    return weights;
}

static PyObject *from_hit(const place *in, const fe_hit *hit)
{
    PyObject *const fields[] = {
        new_entity(known_classes[BODY], in, hit->body),
        new_entity(known_classes[SHAPE], in, hit->shape),
        from_dvec3(&hit->point),
        PyFloat_FromDouble(hit->fraction),
        from_vec3(&hit->normal),
        PyLong_FromLong(hit->triangle),
        PyFloat_FromDouble((double)hit->depth),
        PyBool_FromLong((hit->flags & FE_HIT_STARTED_INSIDE) != 0),
        PyLong_FromLong(hit->part),
        from_weights(hit->barycentric),
        PyLong_FromUnsignedLongLong(hit->material),
        PyBool_FromLong((hit->flags & FE_HIT_BACK) != 0),
    };
    return new_record(known_classes[HIT], fields, sizeof fields / sizeof *fields);
}

static PyObject *from_closest(const place *in, const fe_closest *closest)
{
    PyObject *const fields[] = {
        new_entity(known_classes[BODY], in, closest->body),
        new_entity(known_classes[SHAPE], in, closest->shape),
        from_dvec3(&closest->point),
        PyFloat_FromDouble(closest->distance),
        from_vec3(&closest->normal),
        PyLong_FromLong(closest->triangle),
        PyLong_FromLong(closest->part),
        from_weights(closest->barycentric),
        PyLong_FromUnsignedLongLong(closest->material),
    };
    return new_record(known_classes[CLOSEST], fields, sizeof fields / sizeof *fields);
}

static PyObject *from_overlap(const place *in, const fe_overlap *overlap)
{
    PyObject *const fields[] = {
        new_entity(known_classes[BODY], in, overlap->body),
        new_entity(known_classes[SHAPE], in, overlap->shape),
        from_vec3(&overlap->direction),
        PyFloat_FromDouble((double)overlap->depth),
        PyLong_FromLong(overlap->part),
        PyLong_FromLong(overlap->triangle),
        PyLong_FromUnsignedLongLong(overlap->material),
    };
    return new_record(known_classes[OVERLAP], fields, sizeof fields / sizeof *fields);
}

/// What the records of a list are: HIT, OVERLAP, or handles of an ENTITY; -1: nothing that is known.
static int kind_of_records(PyTypeObject *type)
{
    if (known_classes[HIT] && type == known_classes[HIT]) return HIT;
    if (known_classes[OVERLAP] && type == known_classes[OVERLAP]) return OVERLAP;
    return is_class((PyObject *)type, known_classes[ENTITY]) ? ENTITY : -1;
}

static PyObject *from_record(int kind, PyTypeObject *type, const place *in, const void *record)
{
    return kind == HIT       ? from_hit(in, record)
           : kind == OVERLAP ? from_overlap(in, record)
                             : new_entity(type, in, *(const fe_handle *)record);
}

/// (class, world, its capsule, a buffer of records or handles): a list of what they say.
static PyObject *list_of(PyObject *arguments)
{
    PyObject *class, *buffer, *list = NULL;
    place in;
    Py_buffer *view;
    call_state call;
    if (!PyArg_UnpackTuple(arguments, "list_of", 4, 4, &class, &in.world, &in.capsule, &buffer)) return NULL;
    PyTypeObject *type = (PyTypeObject *)class;
    const int kind = kind_of_records(type);
    if (kind < 0) return NULL;
    const size_t size = kind == HIT ? sizeof(fe_hit) : kind == OVERLAP ? sizeof(fe_overlap) : sizeof(fe_handle);
    begin_call(&call);
    if (!borrow(&call, buffer, size, PyBUF_C_CONTIGUOUS, "records", &view)) {
        Py_ssize_t count = view->len / (Py_ssize_t)size;
        list = begin_list(count);
        for (Py_ssize_t i = 0; list && i < count; ++i) {
            PyObject *item = from_record(kind, type, &in, (const char *)view->buf + (size_t)i * size);
            if (item)
                PyList_SET_ITEM(list, i, item);
            else
                Py_CLEAR(list);
        }
    }
    end_call(&call);
    return end_list(list);
}

#endif
