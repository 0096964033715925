// Conversions of Python objects for the library, and back. Worlds, pools and stores are capsules that own
// them: a body's object keeps its world alive, and a world that is closed is an error. Arrays are anything with the
// buffer protocol (array, bytes, memoryview, NumPy).
#ifndef FE_BINDINGS_PYTHON_CONVERT_H
#define FE_BINDINGS_PYTHON_CONVERT_H

#include "feather.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// ---- errors ---------------------------------------------------------------------------------------------------------

enum { ERROR_CLASSES = 14 }; // by -fe_result; 0: FeatherError itself
static PyObject *error_classes[ERROR_CLASSES];

static PyObject *error_class(int result)
{
    PyObject *found = result <= 0 && result > -ERROR_CLASSES ? error_classes[-result] : NULL;
    return found ? found : error_classes[0] ? error_classes[0] : PyExc_RuntimeError;
}

/// Takes the classes that failures raise from a sequence, ordered by -fe_result.
static PyObject *set_error_classes(PyObject *classes)
{
    for (Py_ssize_t i = 0; i < ERROR_CLASSES; ++i) {
        PyObject *item = PySequence_GetItem(classes, i);
        if (!item) return NULL;
        if (!PyExceptionClass_Check(item)) {
            Py_DECREF(item);
            PyErr_SetString(PyExc_TypeError, "exception classes are needed");
            return NULL;
        }
        Py_XSETREF(error_classes[i], item);
    }
    Py_RETURN_NONE;
}

static void raise_result(int result) { PyErr_SetString(error_class(result), fe_last_error()); }

static int fails(int result, const char *text)
{
    PyErr_SetString(error_class(result), text);
    return -1;
}

// ---- worlds, pools, stores ------------------------------------------------------------------------------------------

static const char world_name[] = "feather_physics.world";
static const char pool_name[] = "feather_physics.pool";
static const char history_name[] = "feather_physics.history";
static const char store_name[] = "feather_physics.store";
static const char state_name[] = "feather_physics.state";
static const char recorder_name[] = "feather_physics.recorder";
static const char player_name[] = "feather_physics.player";
static const char batch_name[] = "feather_physics.batch";

typedef struct world_box {
    fe_world *world;       ///< NULL: closed
    PyObject *kept;        ///< what must outlive the world: its pool, its store. Or NULL
    PyObject *filter;      ///< judges new pairs. Or NULL
    PyObject *failure[3];  ///< type, value, trace of the filter's first failure in this step; type NULL: none
    int readers;           ///< threads that read it without the GIL
    int steppers;          ///< 1 while a thread steps it without the GIL, more when its filter steps again
    unsigned long stepper; ///< that thread
    PyObject *player;      ///< the capsule of the player that the world belongs to; NULL: it belongs to the box
    PyObject *batch;       ///< the capsule of the batch that the world belongs to; NULL: it belongs to the box
    fe_recorder *orphan;   ///< nobody has it any more, and the world was in use when it was to end. Or NULL
} world_box;

typedef struct pool_box {
    fe_pool *pool; ///< NULL: closed
} pool_box;

typedef struct store_box {
    fe_store *store; ///< NULL: closed
    PyObject *world; ///< the capsule of the world that the store belongs to; NULL: it belongs to the box
} store_box;

typedef struct history_box {
    fe_history *history; ///< NULL: closed
    PyObject *world;     ///< the capsule of its world, with which it ends
} history_box;

typedef struct state_box {
    fe_state *state; ///< NULL: closed
} state_box;

typedef struct recorder_box {
    fe_recorder *recorder; ///< NULL: closed
    PyObject *world;       ///< the capsule of its world
    int readers;           ///< threads that read it without the GIL
} recorder_box;

typedef struct player_box {
    fe_player *player; ///< NULL: closed
    PyObject *kept;    ///< what must outlive it: its pool, its store. Or NULL
    PyObject *view;    ///< the capsule of its world while somebody has it, which holds this one; or NULL
    int busy;          ///< 1 while a thread uses it without the GIL
} player_box;

typedef struct batch_box {
    fe_batch *batch;      ///< NULL: closed
    int32_t count;        ///< of worlds
    int users;            ///< threads that use it or one of its worlds without the GIL
    struct arrays *bound; ///< inputs and outputs, whose buffers it holds; NULL: none
} batch_box;

/// The box of a world's batch; NULL: it is of none.
static batch_box *home_of(const world_box *box)
{
    return box->batch ? PyCapsule_GetPointer(box->batch, batch_name) : NULL;
}

/// A world ends with its batch, whoever has it.
static int world_lives(const world_box *box)
{
    const batch_box *batch = home_of(box);
    return box->world && (!batch || batch->batch);
}

static void drop_orphan(world_box *box)
{
    if (box->orphan && fe_recorder_destroy(box->orphan) == FE_OK) box->orphan = NULL;
}

static void close_world(world_box *box)
{
    box->world = NULL;
    drop_orphan(box);
    Py_CLEAR(box->filter);
    Py_CLEAR(box->kept);
}

static void release_world(PyObject *capsule)
{
    world_box *box = PyCapsule_GetPointer(capsule, world_name);
    if (!box) return;
    player_box *player = box->player ? PyCapsule_GetPointer(box->player, player_name) : NULL;
    if (player && player->view == capsule) player->view = NULL;
    if (box->world && !box->player && !box->batch) (void)fe_world_destroy(box->world);
    close_world(box);
    Py_XDECREF(box->player);
    Py_XDECREF(box->batch);
    free(box);
}

static void release_pool(PyObject *capsule)
{
    pool_box *box = PyCapsule_GetPointer(capsule, pool_name);
    if (!box) return;
    if (box->pool) (void)fe_pool_destroy(box->pool);
    free(box);
}

static void release_store(PyObject *capsule)
{
    store_box *box = PyCapsule_GetPointer(capsule, store_name);
    if (!box) return;
    if (box->store && !box->world) (void)fe_store_destroy(box->store);
    Py_XDECREF(box->world);
    free(box);
}

static int history_lives(const history_box *box)
{
    const world_box *world = PyCapsule_GetPointer(box->world, world_name);
    return box->history && world && world_lives(world);
}

static void release_history(PyObject *capsule)
{
    history_box *box = PyCapsule_GetPointer(capsule, history_name);
    if (!box) return;
    if (history_lives(box)) (void)fe_history_destroy(box->history);
    Py_DECREF(box->world);
    free(box);
}

static void release_state(PyObject *capsule)
{
    state_box *box = PyCapsule_GetPointer(capsule, state_name);
    if (!box) return;
    if (box->state) (void)fe_state_destroy(box->state);
    free(box);
}

static void release_recorder(PyObject *capsule)
{
    recorder_box *box = PyCapsule_GetPointer(capsule, recorder_name);
    if (!box) return;
    world_box *world = PyCapsule_GetPointer(box->world, world_name);
    if (box->recorder && fe_recorder_destroy(box->recorder) != FE_OK && world) world->orphan = box->recorder;
    Py_DECREF(box->world);
    free(box);
}

static void release_player(PyObject *capsule)
{
    player_box *box = PyCapsule_GetPointer(capsule, player_name);
    if (!box) return;
    if (box->player) (void)fe_player_destroy(box->player);
    Py_XDECREF(box->kept);
    free(box);
}

static PyObject *new_world(fe_world *world)
{
    world_box *box = calloc(1, sizeof *box);
    PyObject *capsule = box ? PyCapsule_New(box, world_name, release_world) : PyErr_NoMemory();
    if (capsule) {
        box->world = world;
    } else {
        (void)fe_world_destroy(world);
        free(box);
    }
    return capsule;
}

static PyObject *new_pool(fe_pool *pool)
{
    pool_box *box = calloc(1, sizeof *box);
    PyObject *capsule = box ? PyCapsule_New(box, pool_name, release_pool) : PyErr_NoMemory();
    if (capsule) {
        box->pool = pool;
    } else {
        (void)fe_pool_destroy(pool);
        free(box);
    }
    return capsule;
}

/// @param world  capsule of the world that the store belongs to, or NULL
static PyObject *new_store(fe_store *store, PyObject *world)
{
    store_box *box = calloc(1, sizeof *box);
    PyObject *capsule = box ? PyCapsule_New(box, store_name, release_store) : PyErr_NoMemory();
    if (capsule) {
        box->store = store;
        box->world = Py_XNewRef(world);
    } else {
        if (!world) (void)fe_store_destroy(store);
        free(box);
    }
    return capsule;
}

static PyObject *new_history(fe_history *history, PyObject *world)
{
    history_box *box = calloc(1, sizeof *box);
    PyObject *capsule = box ? PyCapsule_New(box, history_name, release_history) : PyErr_NoMemory();
    if (capsule) {
        box->history = history;
        box->world = Py_NewRef(world);
    } else {
        (void)fe_history_destroy(history);
        free(box);
    }
    return capsule;
}

static PyObject *new_state(fe_state *state)
{
    state_box *box = calloc(1, sizeof *box);
    PyObject *capsule = box ? PyCapsule_New(box, state_name, release_state) : PyErr_NoMemory();
    if (capsule) {
        box->state = state;
    } else {
        (void)fe_state_destroy(state);
        free(box);
    }
    return capsule;
}

static PyObject *new_recorder(fe_recorder *recorder, PyObject *world)
{
    recorder_box *box = calloc(1, sizeof *box);
    PyObject *capsule = box ? PyCapsule_New(box, recorder_name, release_recorder) : PyErr_NoMemory();
    if (capsule) {
        box->recorder = recorder;
        box->world = Py_NewRef(world);
    } else {
        (void)fe_recorder_destroy(recorder);
        free(box);
    }
    return capsule;
}

static PyObject *new_player(fe_player *player)
{
    player_box *box = calloc(1, sizeof *box);
    PyObject *capsule = box ? PyCapsule_New(box, player_name, release_player) : PyErr_NoMemory();
    if (capsule) {
        box->player = player;
    } else {
        (void)fe_player_destroy(player);
        free(box);
    }
    return capsule;
}

static void *box_of(PyObject *object, const char *name, const char *what)
{
    if (PyCapsule_IsValid(object, name)) return PyCapsule_GetPointer(object, name);
    PyErr_Format(PyExc_TypeError, "a %s is needed, not '%s'", what, Py_TYPE(object)->tp_name);
    return NULL;
}

static world_box *world_of(PyObject *object)
{
    world_box *box = box_of(object, world_name, "world");
    if (box && !world_lives(box)) {
        (void)fails(FE_ERROR_STALE, "the world is closed");
        return NULL;
    }
    return box;
}

static pool_box *pool_of(PyObject *object)
{
    pool_box *box = box_of(object, pool_name, "pool");
    if (box && !box->pool) {
        (void)fails(FE_ERROR_STALE, "the pool is closed");
        return NULL;
    }
    return box;
}

static int store_lives(const store_box *box)
{
    const world_box *world = box->world ? PyCapsule_GetPointer(box->world, world_name) : NULL;
    if (box->store && (!box->world || (world && world_lives(world)))) return 1;
    (void)fails(FE_ERROR_STALE, "the store is closed");
    return 0;
}

static store_box *store_of(PyObject *object)
{
    store_box *box = box_of(object, store_name, "store");
    return box && store_lives(box) ? box : NULL;
}

static int may_not_use(const history_box *box)
{
    if (history_lives(box)) return 0;
    (void)fails(FE_ERROR_STALE, "the history is closed, or its world is");
    return 1;
}

static history_box *history_of(PyObject *object)
{
    history_box *box = box_of(object, history_name, "history");
    return box && !may_not_use(box) ? box : NULL;
}

static int state_is_closed(const state_box *box)
{
    return box->state ? 0 : fails(FE_ERROR_STALE, "the state is closed");
}

static state_box *state_of(PyObject *object) { return box_of(object, state_name, "state"); }

static int recorder_is_closed(const recorder_box *box)
{
    return box->recorder ? 0 : fails(FE_ERROR_STALE, "the recorder is closed");
}

static recorder_box *recorder_of(PyObject *object)
{
    recorder_box *box = box_of(object, recorder_name, "recorder");
    return box && !recorder_is_closed(box) ? box : NULL;
}

/// -1 where a player may not be used now: it is closed, or another thread uses it or, where it would change, its world.
static int may_use_player(const player_box *box, int writes, const char *function)
{
    if (!box->player) return fails(FE_ERROR_STALE, "the player is closed");
    const world_box *view = box->view ? PyCapsule_GetPointer(box->view, world_name) : NULL;
    if (!box->busy && !(writes && view && view->readers)) return 0;
    PyErr_Format(error_class(FE_ERROR_BUSY), "%s: another thread %s", function,
                 box->busy ? "uses the player" : "reads its world");
    return -1;
}

static player_box *player_of(PyObject *object)
{
    player_box *box = box_of(object, player_name, "player");
    if (box && !box->player) {
        (void)fails(FE_ERROR_STALE, "the player is closed");
        return NULL;
    }
    return box;
}

/// Makes a world or a player hold a reference to what must not go before it.
static PyObject *keep(PyObject *owner, PyObject *object)
{
    PyObject **kept;
    if (PyCapsule_IsValid(owner, player_name)) {
        player_box *box = player_of(owner);
        if (!box) return NULL;
        kept = &box->kept;
    } else {
        world_box *box = world_of(owner);
        if (!box) return NULL;
        kept = &box->kept;
    }
    Py_INCREF(object);
    Py_XSETREF(*kept, object);
    Py_RETURN_NONE;
}

// ---- threads and the pair filter ------------------------------------------------------------------------------------

/// -1 where a world may not be read, or written, now: it is closed, or another thread uses it without the GIL. What a
/// pair filter may not do in its own thread is the library's to refuse.
static int may_use(const world_box *box, int writes, const char *function)
{
    if (!world_lives(box)) return fails(FE_ERROR_STALE, "the world is closed");
    if (writes && box->player) {
        PyErr_Format(error_class(FE_ERROR_STATE), "%s: the world is a player's, to be read: release() hands it over",
                     function);
        return -1;
    }
    int steps = box->steppers && box->stepper != PyThread_get_thread_ident();
    if (!steps && !(writes && box->readers)) return 0;
    PyErr_Format(error_class(FE_ERROR_BUSY), "%s: another thread %s the world", function, steps ? "steps" : "reads");
    return -1;
}

/// A batch does not end while a thread uses one of its worlds.
static void count_user(const world_box *box, int change)
{
    batch_box *batch = home_of(box);
    if (batch) batch->users += change;
}

static void enter_read(world_box *box)
{
    count_user(box, 1);
    ++box->readers;
}

static int leave_read(world_box *box)
{
    count_user(box, -1);
    if (--box->readers == 0) drop_orphan(box);
    return 0;
}

static void enter_step(world_box *box)
{
    count_user(box, 1);
    if (box->steppers++ == 0) box->stepper = PyThread_get_thread_ident();
}

/// Raises what the filter raised during the step.
static int leave_step(world_box *box)
{
    count_user(box, -1);
    if (--box->steppers > 0) return 0;
    drop_orphan(box);
    if (!box->failure[0]) return 0;
    PyErr_Restore(box->failure[0], box->failure[1], box->failure[2]);
    box->failure[0] = box->failure[1] = box->failure[2] = NULL;
    return -1;
}

/// -1 where a recorder may not end now.
static int may_end(const recorder_box *box)
{
    if (box->readers) return fails(FE_ERROR_BUSY, "recorder_destroy: another thread reads the recorder");
    const world_box *world = PyCapsule_GetPointer(box->world, world_name);
    return world && world_lives(world) ? may_use(world, 1, "recorder_destroy") : 0;
}

/// @return its world's capsule, held until leave_player; or NULL
static PyObject *enter_player(player_box *box)
{
    box->busy = 1;
    if (box->view) enter_step(PyCapsule_GetPointer(box->view, world_name));
    return Py_XNewRef(box->view);
}

static void leave_player(player_box *box, PyObject *view)
{
    box->busy = 0;
    if (view) (void)leave_step(PyCapsule_GetPointer(view, world_name));
    Py_XDECREF(view);
}

static PyObject *pair_record(const fe_filter_pair *pair);

/// Called by the library for a new pair, on the thread that steps. After a failure the rest of the step goes on with 1.
static int32_t judge_pair(void *user, const fe_filter_pair *pair)
{
    world_box *box = user;
    if (box->failure[0]) return 1;
    PyGILState_STATE state = PyGILState_Ensure();
    PyObject *record = pair_record(pair);
    PyObject *filter = Py_NewRef(box->filter);
    PyObject *answer = record ? PyObject_CallOneArg(filter, record) : NULL;
    int32_t allowed = answer ? PyObject_IsTrue(answer) : -1;
    if (allowed < 0) {
        PyErr_Fetch(&box->failure[0], &box->failure[1], &box->failure[2]);
        allowed = 1;
    }
    Py_XDECREF(answer);
    Py_DECREF(filter);
    Py_XDECREF(record);
    PyGILState_Release(state);
    return allowed;
}

/// The world holds its filter; None is no filter.
static void keep_filter(world_box *box, PyObject *filter)
{
    Py_XSETREF(box->filter, filter == Py_None ? NULL : Py_NewRef(filter));
}

// ---- lists ----------------------------------------------------------------------------------------------------------

/// A list to be filled. The cycle collector may run while its items are made, and a script in it that looks at all
/// lists: it does not see this one.
static PyObject *begin_list(Py_ssize_t count)
{
    PyObject *list = PyList_New(count);
    if (list) PyObject_GC_UnTrack(list);
    return list;
}

/// The list, when it is full; or NULL.
static PyObject *end_list(PyObject *list)
{
    if (list) PyObject_GC_Track(list);
    return list;
}

// ---- recordings -----------------------------------------------------------------------------------------------------

/// All that waits, as bytes; none when nothing waits, or when the recording ended with its world and all was read.
static PyObject *read_recorder(PyObject *capsule)
{
    recorder_box *box = recorder_of(capsule);
    if (!box) return NULL;
    for (;;) {
        int64_t size = 0;
        int result = fe_recorder_read(box->recorder, NULL, 0, &size);
        if (result < 0) return raise_result(result), NULL;
        PyObject *bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)size);
        if (!bytes || size == 0) return bytes;
        ++box->readers;
        Py_BEGIN_ALLOW_THREADS result = fe_recorder_read(box->recorder, PyBytes_AS_STRING(bytes), size, &size);
        Py_END_ALLOW_THREADS-- box->readers;
        if (result >= 0) return _PyBytes_Resize(&bytes, (Py_ssize_t)size) ? NULL : bytes;
        Py_DECREF(bytes);
        if (result != FE_ERROR_LIMIT || size == 0) return raise_result(result), NULL;
        // a flight recorder grew meanwhile
    }
}

/// The capsule of a player's world: the same one as long as somebody has it.
static PyObject *world_of_player(PyObject *capsule)
{
    player_box *box = player_of(capsule);
    const fe_world *world = NULL;
    if (!box || may_use_player(box, 0, "player_get_world")) return NULL;
    int result = fe_player_get_world(box->player, &world);
    if (result < 0) return raise_result(result), NULL;
    if (box->view) return Py_NewRef(box->view);
    world_box *made = calloc(1, sizeof *made);
    PyObject *view = made ? PyCapsule_New(made, world_name, release_world) : PyErr_NoMemory();
    if (!view) return free(made), NULL;
    made->world = (fe_world *)world; // may_use refuses all that writes
    made->player = Py_NewRef(capsule);
    box->view = view;
    return view;
}

/// The same capsule, which owns the world from here on.
static PyObject *release_world_of_player(PyObject *capsule)
{
    PyObject *view = world_of_player(capsule);
    if (!view) return NULL;
    player_box *box = player_of(capsule);
    world_box *world = PyCapsule_GetPointer(view, world_name);
    fe_world *released = NULL;
    int result = may_use_player(box, 1, "player_release") ? 1 : fe_player_release(box->player, &released);
    if (result != FE_OK) {
        if (result < 0) raise_result(result);
        Py_DECREF(view);
        return NULL;
    }
    box->view = NULL;
    Py_XSETREF(world->kept, Py_XNewRef(box->kept));
    Py_CLEAR(world->player);
    return view;
}

static PyObject *notes_of_player(PyObject *capsule)
{
    player_box *box = player_of(capsule);
    if (!box || may_use_player(box, 0, "player_get_notes")) return NULL;
    int32_t count = fe_player_get_notes(box->player, NULL, sizeof(fe_note), 0);
    if (count < 0) return raise_result(count), NULL;
    fe_note *notes = calloc((size_t)count + 1, sizeof *notes);
    PyObject *list = notes ? begin_list(count) : PyErr_NoMemory();
    if (list) (void)fe_player_get_notes(box->player, notes, sizeof *notes, count);
    for (int32_t i = 0; list && i < count; ++i) {
        PyObject *text = PyUnicode_DecodeUTF8(notes[i].text, (Py_ssize_t)strlen(notes[i].text), "replace");
        PyObject *note =
            text ? Py_BuildValue("(LKN)", (long long)notes[i].step, (unsigned long long)notes[i].about, text) : NULL;
        if (note)
            PyList_SET_ITEM(list, i, note);
        else
            Py_CLEAR(list);
    }
    free(notes);
    return end_list(list);
}

static PyObject *from_divergence(const fe_divergence *d)
{
    return Py_BuildValue("(iLKiss)", (int)d->type, (long long)d->step, (unsigned long long)d->body, (int)d->component,
                         d->field, d->text);
}

/// UTF-8 that ends with 0.
static const char *to_text(PyObject *object, const char *what)
{
    Py_ssize_t size;
    if (!PyUnicode_Check(object)) {
        PyErr_Format(PyExc_TypeError, "%s: a str is needed, not '%s'", what, Py_TYPE(object)->tp_name);
        return NULL;
    }
    const char *text = PyUnicode_AsUTF8AndSize(object, &size);
    if (!text || strlen(text) == (size_t)size) return text;
    PyErr_Format(PyExc_ValueError, "%s: a null character is in it", what);
    return NULL;
}

// ---- small values ---------------------------------------------------------------------------------------------------

static PyTypeObject *vec3_type, *quat_type, *transform_type, *bounds_type;

static PyStructSequence_Field vec3_fields[] = {{"x", NULL}, {"y", NULL}, {"z", NULL}, {NULL, NULL}};
static PyStructSequence_Field quat_fields[] = {{"x", NULL}, {"y", NULL}, {"z", NULL}, {"w", NULL}, {NULL, NULL}};
static PyStructSequence_Field transform_fields[] = {{"position", "m"}, {"rotation", "x, y, z, w"}, {NULL, NULL}};
static PyStructSequence_Field bounds_fields[] = {{"lower", "m"}, {"upper", "m"}, {NULL, NULL}};
static PyStructSequence_Desc vec3_desc = {"feather_physics.Vec3", "A vector: a tuple with the names x, y, z.",
                                          vec3_fields, 3};
static PyStructSequence_Desc quat_desc = {"feather_physics.Quat", "A rotation: a tuple with the names x, y, z, w.",
                                          quat_fields, 4};
static PyStructSequence_Desc transform_desc = {"feather_physics.Transform", "Position (Vec3, m) and rotation (Quat).",
                                               transform_fields, 2};
static PyStructSequence_Desc bounds_desc = {"feather_physics.Bounds", "Two corners of a box (Vec3, m): lower, upper.",
                                            bounds_fields, 2};

static int add_types(PyObject *module)
{
    vec3_type = PyStructSequence_NewType(&vec3_desc);
    quat_type = PyStructSequence_NewType(&quat_desc);
    transform_type = PyStructSequence_NewType(&transform_desc);
    bounds_type = PyStructSequence_NewType(&bounds_desc);
    return !vec3_type || !quat_type || !transform_type || !bounds_type || PyModule_AddType(module, vec3_type) ||
           PyModule_AddType(module, quat_type) || PyModule_AddType(module, transform_type) ||
           PyModule_AddType(module, bounds_type);
}

static PyObject *numbers(PyTypeObject *type, const double *values, Py_ssize_t count)
{
    PyObject *made = PyStructSequence_New(type);
    if (!made) return NULL;
    for (Py_ssize_t i = 0; i < count; ++i) {
        PyObject *value = PyFloat_FromDouble(values[i]);
        if (!value) {
            Py_DECREF(made);
            return NULL;
        }
        PyStructSequence_SET_ITEM(made, i, value);
    }
    return made;
}

static PyObject *from_vec3(const fe_vec3 *v)
{
    return numbers(vec3_type, (double[]){(double)v->x, (double)v->y, (double)v->z}, 3);
}

static PyObject *from_corners(const fe_vec3 corners[3])
{
    return Py_BuildValue("(NNN)", from_vec3(&corners[0]), from_vec3(&corners[1]), from_vec3(&corners[2]));
}

static PyObject *from_dvec3(const fe_dvec3 *v) { return numbers(vec3_type, (double[]){v->x, v->y, v->z}, 3); }

static PyObject *from_quat(const fe_quat *q)
{
    return numbers(quat_type, (double[]){(double)q->x, (double)q->y, (double)q->z, (double)q->w}, 4);
}

static PyObject *pair_of(PyTypeObject *type, PyObject *first, PyObject *second)
{
    PyObject *made = first && second ? PyStructSequence_New(type) : NULL;
    if (!made) {
        Py_XDECREF(first);
        Py_XDECREF(second);
        return NULL;
    }
    PyStructSequence_SET_ITEM(made, 0, first);
    PyStructSequence_SET_ITEM(made, 1, second);
    return made;
}

static PyObject *from_transform(const fe_transform *t)
{
    return pair_of(transform_type, from_dvec3(&t->position), from_quat(&t->rotation));
}

static PyObject *from_frame(const fe_frame *f)
{
    return pair_of(transform_type, from_vec3(&f->position), from_quat(&f->rotation));
}

static PyObject *from_bounds(const fe_bounds *b)
{
    return pair_of(bounds_type, from_dvec3(&b->lower), from_dvec3(&b->upper));
}

/// Reads `count` numbers from any sequence. `what` names the argument in the error.
static int to_numbers(PyObject *object, double *values, Py_ssize_t count, const char *what)
{
    PyObject *fast = PyTuple_Check(object) || PyList_Check(object) ? Py_NewRef(object) : PySequence_Tuple(object);
    if (!fast) {
        if (PyErr_ExceptionMatches(PyExc_TypeError))
            PyErr_Format(PyExc_TypeError, "%s: %zd numbers are needed, not '%s'", what, count,
                         Py_TYPE(object)->tp_name);
        return -1;
    }
    Py_ssize_t length = PySequence_Fast_GET_SIZE(fast);
    if (length != count) PyErr_Format(PyExc_ValueError, "%s: %zd numbers are needed, not %zd", what, count, length);
    // a list may change under a number's __float__
    for (Py_ssize_t i = 0; length == count && i < count && i < PySequence_Fast_GET_SIZE(fast); ++i) {
        PyObject *item = PySequence_Fast_GET_ITEM(fast, i);
        Py_INCREF(item);
        values[i] = PyFloat_AsDouble(item);
        Py_DECREF(item);
        if (values[i] == -1.0 && PyErr_Occurred()) break;
    }
    Py_DECREF(fast);
    return PyErr_Occurred() ? -1 : 0;
}

static int to_vec3(PyObject *object, fe_vec3 *v, const char *what)
{
    double n[3] = {0};
    if (to_numbers(object, n, 3, what)) return -1;
    v->x = (float)n[0], v->y = (float)n[1], v->z = (float)n[2];
    return 0;
}

static int to_dvec3(PyObject *object, fe_dvec3 *v, const char *what)
{
    double n[3] = {0};
    if (to_numbers(object, n, 3, what)) return -1;
    v->x = n[0], v->y = n[1], v->z = n[2];
    return 0;
}

static int to_quat(PyObject *object, fe_quat *q, const char *what)
{
    double n[4] = {0};
    if (to_numbers(object, n, 4, what)) return -1;
    q->x = (float)n[0], q->y = (float)n[1], q->z = (float)n[2], q->w = (float)n[3];
    return 0;
}

/// @param names  what the two are, for the error
static int to_pair(PyObject *object, PyObject **first, PyObject **second, const char *what, const char *names)
{
    PyObject *tuple = PySequence_Tuple(object);
    if (tuple && PyTuple_GET_SIZE(tuple) == 2) {
        *first = Py_NewRef(PyTuple_GET_ITEM(tuple, 0));
        *second = Py_NewRef(PyTuple_GET_ITEM(tuple, 1));
        Py_DECREF(tuple);
        return 0;
    }
    Py_XDECREF(tuple);
    PyErr_Format(PyExc_TypeError, "%s: %s are needed", what, names);
    return -1;
}

static const char a_pose[] = "a position and a rotation";

static int to_transform(PyObject *object, fe_transform *t, const char *what)
{
    PyObject *position, *rotation;
    if (to_pair(object, &position, &rotation, what, a_pose)) return -1;
    int failed = to_dvec3(position, &t->position, what) || to_quat(rotation, &t->rotation, what);
    Py_DECREF(position);
    Py_DECREF(rotation);
    return failed ? -1 : 0;
}

static int to_frame(PyObject *object, fe_frame *f, const char *what)
{
    PyObject *position, *rotation;
    if (to_pair(object, &position, &rotation, what, a_pose)) return -1;
    int failed = to_vec3(position, &f->position, what) || to_quat(rotation, &f->rotation, what);
    Py_DECREF(position);
    Py_DECREF(rotation);
    return failed ? -1 : 0;
}

static int to_bounds(PyObject *object, fe_bounds *b, const char *what)
{
    PyObject *lower, *upper;
    if (to_pair(object, &lower, &upper, what, "a lower and an upper corner")) return -1;
    int failed = to_dvec3(lower, &b->lower, what) || to_dvec3(upper, &b->upper, what);
    Py_DECREF(lower);
    Py_DECREF(upper);
    return failed ? -1 : 0;
}

static PyObject *from_material(const fe_material *m)
{
    return Py_BuildValue("(dddddiiK)", (double)m->static_friction, (double)m->dynamic_friction, (double)m->restitution,
                         (double)m->rolling_resistance, (double)m->spinning_resistance, (int)m->friction_combine,
                         (int)m->restitution_combine, (unsigned long long)m->user_id);
}

/// A float of anything that has one; what is beyond its range becomes infinite, which the library refuses.
static int to_double(PyObject *object, double *value, const char *what)
{
    *value = PyFloat_AsDouble(object);
    if (*value != -1.0 || !PyErr_Occurred()) return 0;
    if (PyErr_ExceptionMatches(PyExc_TypeError))
        PyErr_Format(PyExc_TypeError, "%s: a number is needed, not '%s'", what, Py_TYPE(object)->tp_name);
    return -1;
}

/// An integer within [low, high].
static int to_integer(PyObject *object, long long low, unsigned long long high, unsigned long long *value,
                      const char *what)
{
    int negative = 0;
    PyObject *number = PyLong_Check(object) ? Py_NewRef(object) : PyNumber_Index(object);
    if (!number) {
        if (PyErr_ExceptionMatches(PyExc_TypeError))
            PyErr_Format(PyExc_TypeError, "%s: an integer is needed, not '%s'", what, Py_TYPE(object)->tp_name);
        return -1;
    }
    long long small = PyLong_AsLongLongAndOverflow(number, &negative);
    *value = negative > 0 ? PyLong_AsUnsignedLongLong(number) : (unsigned long long)small;
    Py_DECREF(number);
    if (!PyErr_Occurred() && negative >= 0 && (negative > 0 || small >= low) && (small < 0 || *value <= high)) return 0;
    PyErr_Clear();
    PyErr_Format(PyExc_OverflowError, "%s: the integer lies beyond %lld..%llu", what, low, high);
    return -1;
}

/// In the order of fe_material's fields: five numbers, then, if you like, two combine modes and the user's number.
static int to_material(PyObject *object, fe_material *material, const char *what)
{
    fe_material m = {0};
    PyObject *id = NULL;
    unsigned long long number = 0;
    PyObject *tuple = PySequence_Tuple(object);
    if (!tuple) return -1;
    int read = PyArg_ParseTuple(tuple, "fffff|iiO", &m.static_friction, &m.dynamic_friction, &m.restitution,
                                &m.rolling_resistance, &m.spinning_resistance, &m.friction_combine,
                                &m.restitution_combine, &id);
    if (!read) {
        PyErr_Clear();
        PyErr_Format(PyExc_TypeError, "%s: five numbers, two combine modes and an integer are needed", what);
    } else if (id && to_integer(id, 0, UINT64_MAX, &number, "user_id")) {
        read = 0;
    }
    Py_DECREF(tuple);
    if (!read) return -1;
    m.user_id = number;
    *material = m;
    return 0;
}

// ---- arrays ---------------------------------------------------------------------------------------------------------

enum { MAX_VIEWS = 6 };
enum { RAY_SIZE = offsetof(fe_ray, reserved), PATH_SIZE = offsetof(fe_path, turn) };

static PyObject *from_key(const fe_asset_key *key)
{
    char text[33];
    snprintf(text, sizeof text, "%016llx%016llx", (unsigned long long)key->words[0], (unsigned long long)key->words[1]);
    return PyUnicode_FromString(text);
}

/// The buffers that a call borrows, and how many records each has room for.
typedef struct call_state {
    int views;
    Py_buffer view[MAX_VIEWS];
    void *memory;     ///< copies of records, or NULL
    int64_t count;    ///< of the input arrays; -1: none yet
    int64_t capacity; ///< of the output arrays; -1: none yet
    uint32_t stride;  ///< size of a record of the array, where the array is one of records; else 0: packed
} call_state;

static void begin_call(call_state *call)
{
    call->views = 0;
    call->memory = NULL;
    call->count = call->capacity = -1;
    call->stride = 0;
}

static void end_call(call_state *call)
{
    while (call->views > 0) PyBuffer_Release(&call->view[--call->views]);
    free(call->memory);
    call->memory = NULL;
}

/// Borrows a buffer of whole records. None is NULL where `optional`.
static int borrow(call_state *call, PyObject *object, size_t record, int flags, const char *what, Py_buffer **out_view)
{
    *out_view = NULL;
    Py_buffer *view = &call->view[call->views];
    if (call->views == MAX_VIEWS) return fails(0, "too many arrays");
    if (PyObject_GetBuffer(object, view, flags)) return -1;
    ++call->views;
    if ((size_t)view->len % record) {
        PyErr_Format(PyExc_ValueError, "%s: %zd bytes are not whole records of %zd", what, view->len,
                     (Py_ssize_t)record);
        return -1;
    }
    // one byte items may be packed records; others must be items of these
    if (view->itemsize > 1 && record % (size_t)view->itemsize) {
        PyErr_Format(PyExc_TypeError, "%s: items of %zd bytes are not what is asked for", what, view->itemsize);
        return -1;
    }
    *out_view = view;
    return 0;
}

static int format_is(const Py_buffer *view, const char *codes)
{
    const char *format = view->format ? view->format : "B";
    while (*format == '<' || *format == '=' || *format == '@') ++format;
    return view->itemsize == 1 || strchr(codes, *format) != NULL;
}

/// An array to read. `codes`: the item formats allowed ("" for records).
static int to_input(call_state *call, PyObject *object, size_t record, const char *codes, const char *what,
                    const void **out_array)
{
    Py_buffer *view;
    if (borrow(call, object, record, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT, what, &view)) return -1;
    if (*codes && !format_is(view, codes)) {
        PyErr_Format(PyExc_TypeError, "%s: items of format '%s' are not what is asked for", what, view->format);
        return -1;
    }
    int64_t count = (int64_t)((size_t)view->len / record);
    if (call->count >= 0 && call->count != count) {
        PyErr_Format(PyExc_ValueError, "%s: %lld records where the other array has %lld", what, (long long)count,
                     (long long)call->count);
        return -1;
    }
    call->count = count;
    *out_array = view->buf;
    return 0;
}

/// An array to fill; None is NULL.
static int to_output(call_state *call, PyObject *object, size_t record, const char *codes, const char *what,
                     void **out_array)
{
    *out_array = NULL;
    if (object == Py_None) return 0;
    Py_buffer *view;
    if (borrow(call, object, record, PyBUF_C_CONTIGUOUS | PyBUF_WRITABLE | PyBUF_FORMAT, what, &view)) return -1;
    if (*codes && !format_is(view, codes)) {
        PyErr_Format(PyExc_TypeError, "%s: items of format '%s' are not what is asked for", what, view->format);
        return -1;
    }
    int64_t capacity = (int64_t)((size_t)view->len / record);
    if (call->capacity < 0 || capacity < call->capacity) call->capacity = capacity;
    if (!*codes) call->stride = (uint32_t)record;
    *out_array = view->buf;
    return 0;
}

/// The `count` of a call: that of its input arrays, for which its outputs must have room.
static int array_count(const call_state *call, int32_t *out_count)
{
    int64_t count = call->count < 0 ? 0 : call->count;
    if (count > INT32_MAX) return fails(FE_ERROR_LIMIT, "an array has more than 2^31 - 1 records");
    if (call->capacity >= 0 && call->capacity < count) {
        PyErr_Format(PyExc_ValueError, "room for %lld records where %lld are needed", (long long)call->capacity,
                     (long long)count);
        return -1;
    }
    *out_count = (int32_t)count;
    return 0;
}

static int32_t array_capacity(const call_state *call)
{
    return call->capacity < 0 ? 0 : call->capacity > INT32_MAX ? INT32_MAX : (int32_t)call->capacity;
}

/// (mask, flags, bodies not to count or None); None is no filter.
static int to_filter(call_state *call, PyObject *object, fe_query_filter *filter, const fe_query_filter **out_filter)
{
    *out_filter = NULL;
    if (object == Py_None) return 0;
    unsigned int mask, flags;
    PyObject *excluded;
    if (!PyTuple_Check(object))
        return PyErr_SetString(PyExc_TypeError, "filter: a tuple of mask, flags, excluded bodies is needed"), -1;
    if (!PyArg_ParseTuple(object, "IIO;filter: mask, flags, excluded", &mask, &flags, &excluded)) return -1;
    fe_query_filter_init(filter, (uint32_t)sizeof *filter);
    filter->mask = mask;
    filter->flags = flags;
    if (excluded != Py_None) {
        Py_buffer *view;
        if (borrow(call, excluded, sizeof(fe_body), PyBUF_C_CONTIGUOUS, "excluded", &view)) return -1;
        if ((size_t)view->len / sizeof(fe_body) > INT32_MAX) return fails(FE_ERROR_LIMIT, "too many excluded bodies");
        filter->excluded = view->buf;
        filter->excluded_count = (int32_t)((size_t)view->len / sizeof(fe_body));
    }
    *out_filter = filter;
    return 0;
}

static int to_bytes(call_state *call, PyObject *object, size_t count, const char *what, const uint8_t **out_bytes)
{
    *out_bytes = NULL;
    if (object == Py_None) return 0;
    Py_buffer *view;
    if (borrow(call, object, 1, PyBUF_C_CONTIGUOUS, what, &view)) return -1;
    if ((size_t)view->len != count)
        return PyErr_Format(PyExc_ValueError, "%s: %zu bytes are needed, not %zd", what, count, view->len), -1;
    *out_bytes = view->buf;
    return 0;
}

/// A sequence of at most 255 materials; None is none.
static int to_materials(call_state *call, PyObject *object, const fe_material **out_materials, int32_t *out_count)
{
    if (object == Py_None) return 0;
    Py_ssize_t count = PySequence_Size(object);
    if (count < 0) return -1;
    if (count > 255) return PyErr_SetString(PyExc_ValueError, "materials: at most 255"), -1;
    fe_material *materials = calloc((size_t)count + 1, sizeof *materials);
    if (!materials) return PyErr_NoMemory(), -1;
    call->memory = materials;
    for (Py_ssize_t i = 0; i < count; ++i) {
        PyObject *item = PySequence_GetItem(object, i);
        int failed = !item || to_material(item, &materials[i], "materials");
        Py_XDECREF(item);
        if (failed) return -1;
    }
    *out_materials = materials;
    *out_count = (int32_t)count;
    return 0;
}

/// (rows, columns, cell_x, cell_z, heights, holes, cell_materials, materials); the last three may be None.
static int to_heightfield(call_state *call, PyObject *object, fe_heightfield_def *def)
{
    PyObject *heights, *holes, *cells, *materials;
    fe_heightfield_def_init(def, (uint32_t)sizeof *def);
    if (!PyTuple_Check(object)) return PyErr_SetString(PyExc_TypeError, "heightfield: a tuple is needed"), -1;
    if (!PyArg_ParseTuple(object, "iiffOOOO;heightfield", &def->rows, &def->columns, &def->cell_x, &def->cell_z,
                          &heights, &holes, &cells, &materials))
        return -1;
    if (def->rows < 2 || def->columns < 2)
        return PyErr_SetString(error_class(FE_ERROR_ARGUMENT), "heightfield: 2 rows and 2 columns at least"), -1;
    const void *samples;
    size_t count = (size_t)def->rows * (size_t)def->columns,
           cell_count = (size_t)(def->rows - 1) * (size_t)(def->columns - 1);
    if (to_input(call, heights, sizeof(float), "f", "heights", &samples)) return -1;
    if ((size_t)call->count != count) {
        PyErr_Format(PyExc_ValueError, "heights: %zu floats are needed, not %lld", count, (long long)call->count);
        return -1;
    }
    def->heights = samples;
    return to_bytes(call, holes, cell_count, "holes", &def->holes) ||
                   to_bytes(call, cells, cell_count, "cell_materials", &def->cell_materials) ||
                   to_materials(call, materials, &def->materials, &def->material_count)
               ? -1
               : 0;
}

/// An array that has nothing to do with the others of the call, and how many records it has.
static int to_own_input(call_state *call, PyObject *object, size_t record, const char *codes, const char *what,
                        const void **out_array, int32_t *out_count)
{
    call->count = -1;
    if (to_input(call, object, record, codes, what, out_array)) return -1;
    return array_count(call, out_count);
}

/// (points, max_vertices, tolerance)
static int to_hull(call_state *call, PyObject *object, fe_hull_def *def)
{
    PyObject *points;
    const void *array;
    fe_hull_def_init(def, (uint32_t)sizeof *def);
    if (!PyTuple_Check(object)) return PyErr_SetString(PyExc_TypeError, "hull: a tuple is needed"), -1;
    if (!PyArg_ParseTuple(object, "Oif;hull", &points, &def->max_vertices, &def->tolerance)) return -1;
    if (to_own_input(call, points, 3 * sizeof(float), "f", "points", &array, &def->point_count)) return -1;
    def->points = array;
    return 0;
}

/// (vertices, triangles, index_type, flags, weld_distance, edge_angle, triangle_materials, materials, triangle_data);
/// the last three may be None.
static int to_mesh(call_state *call, PyObject *object, fe_mesh_def *def)
{
    PyObject *vertices, *triangles, *kinds, *materials, *data;
    const void *array;
    fe_mesh_def_init(def, (uint32_t)sizeof *def);
    if (!PyTuple_Check(object)) return PyErr_SetString(PyExc_TypeError, "mesh: a tuple is needed"), -1;
    if (!PyArg_ParseTuple(object, "OOiIffOOO;mesh", &vertices, &triangles, &def->index_type, &def->flags,
                          &def->weld_distance, &def->edge_angle, &kinds, &materials, &data))
        return -1;
    if (to_own_input(call, vertices, 3 * sizeof(float), "f", "vertices", &array, &def->vertex_count)) return -1;
    def->vertices = array;
    int is_short = def->index_type == FE_INDEX_U16;
    if (to_own_input(call, triangles, is_short ? 6 : 12, is_short ? "Hh" : "IiLl", "triangles", &def->indices,
                     &def->triangle_count))
        return -1;
    if (to_bytes(call, kinds, (size_t)def->triangle_count, "triangle_materials", &def->triangle_materials) ||
        to_materials(call, materials, &def->materials, &def->material_count))
        return -1;
    if (data == Py_None) return 0;
    if (to_input(call, data, sizeof(uint32_t), "IiLl", "triangle_data", &array)) return -1; // one a triangle
    def->triangle_data = array;
    return 0;
}

/// Are there rows x columns floats? What is negative is left to the library.
static int heights_fit(int64_t have, int32_t rows, int32_t columns)
{
    if (rows <= 0 || columns <= 0 || (int64_t)rows * columns <= have) return 0;
    PyErr_Format(PyExc_ValueError, "heights: %lld floats where %lld are needed", (long long)have,
                 (long long)rows * columns);
    return -1;
}

/// SWIG's own methods on every object, with which a script could free what it does not own.
static int forget_ownership_methods(PyTypeObject *type)
{
    static const char *const names[] = {"acquire", "disown", "own", "append", "next"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (PyDict_DelItemString(type->tp_dict, names[i])) PyErr_Clear();
    PyType_Modified(type);
    return 0;
}

static int ends_with(const char *text, const char *end)
{
    size_t a = strlen(text), b = strlen(end);
    return a >= b && strcmp(text + a - b, end) == 0;
}

#endif
