// batch.h - many worlds that step together, for Python: batches as capsules, arrays as buffers of the caller's.
//
// The box of a batch holds the buffers that are bound, so that none is resized or freed meanwhile.
#ifndef PYTHON_BATCH_H
#define PYTHON_BATCH_H
#include "convert.h"

/// Two: inputs, outputs.
static void drop_bound(struct arrays *bound);

static void release_batch(PyObject *capsule)
{
    batch_box *box = PyCapsule_GetPointer(capsule, batch_name);
    if (!box) return;
    if (box->batch) (void)fe_batch_destroy(box->batch);
    drop_bound(box->bound);
    Py_XDECREF((PyObject *)PyCapsule_GetContext(capsule)); // its pool, its store
    free(box);
}

static batch_box *batch_of(PyObject *object)
{
    batch_box *box = box_of(object, batch_name, "batch");
    if (box && !box->batch) {
        (void)fails(FE_ERROR_STALE, "the batch is closed");
        return NULL;
    }
    return box;
}

/// (world, count, workers, block, simd, pool or None, what must outlive it)
static PyObject *flat_batch_create(PyObject *self, PyObject *arguments)
{
    PyObject *world, *pool, *kept;
    fe_batch_def def;
    fe_batch_def_init(&def, sizeof def);
    (void)self;
    if (!PyArg_ParseTuple(arguments, "OiiiiOO", &world, &def.world_count, &def.worker_count, &def.block, &def.simd,
                          &pool, &kept))
        return NULL;
    world_box *of_world = world_of(world);
    pool_box *of_pool = pool == Py_None ? NULL : pool_of(pool);
    if (!of_world || may_use(of_world, 0, "batch_create") || (pool != Py_None && !of_pool)) return NULL;
    if (of_pool) def.pool = of_pool->pool;
    batch_box *box = calloc(1, sizeof *box);
    PyObject *capsule = box ? PyCapsule_New(box, batch_name, release_batch) : PyErr_NoMemory();
    if (!capsule) {
        free(box);
        return NULL;
    }
    box->count = def.world_count;
    const fe_result result = fe_batch_create(of_world->world, &def, &box->batch);
    if (result == FE_OK && PyCapsule_SetContext(capsule, Py_NewRef(kept)) == 0) return capsule;
    if (result != FE_OK) raise_result(result);
    Py_DECREF(capsule);
    return NULL;
}

static PyObject *flat_batch_destroy(PyObject *self, PyObject *arguments)
{
    PyObject *batch;
    (void)self;
    if (!PyArg_ParseTuple(arguments, "O", &batch)) return NULL;
    batch_box *box = batch_of(batch);
    if (!box) return NULL;
    if (box->users) return fails(FE_ERROR_BUSY, "batch_destroy: another thread uses the batch"), NULL;
    const fe_result result = fe_batch_destroy(box->batch);
    if (result != FE_OK) return raise_result(result), NULL;
    struct arrays *bound = box->bound;
    box->batch = NULL;
    box->bound = NULL;
    drop_bound(bound);
    Py_RETURN_NONE;
}

/// (batch, index): the capsule of a world, which holds the batch
static PyObject *flat_batch_get_world(PyObject *self, PyObject *arguments)
{
    PyObject *batch;
    int index;
    (void)self;
    if (!PyArg_ParseTuple(arguments, "Oi", &batch, &index)) return NULL;
    batch_box *box = batch_of(batch);
    fe_world *world = NULL;
    const fe_result result = box ? fe_batch_get_world(box->batch, index, &world) : FE_OK;
    if (result != FE_OK) raise_result(result);
    if (!box || result != FE_OK) return NULL;
    world_box *made = calloc(1, sizeof *made);
    PyObject *capsule = made ? PyCapsule_New(made, world_name, release_world) : PyErr_NoMemory();
    if (!capsule) return free(made), NULL;
    *made = (world_box){.world = world, .batch = Py_NewRef(batch)};
    return capsule;
}

// ---- buffers --------------------------------------------------------------------------------------------------------
/// A buffer for the time of a call; None: there is none
static int take_buffer(PyObject *object, int flags, Py_buffer *out)
{
    *out = (Py_buffer){0};
    return object == Py_None ? 0 : PyObject_GetBuffer(object, out, flags);
}

static void drop_buffer(Py_buffer *buffer)
{
    if (buffer->obj) PyBuffer_Release(buffer);
}

static int has_size(const Py_buffer *buffer, Py_ssize_t bytes, const char *what)
{
    if (!buffer->obj || buffer->len == bytes) return 1;
    PyErr_Format(PyExc_ValueError, "%s: %zd bytes are needed, not %zd", what, bytes, buffer->len);
    return 0;
}

enum { MOST_BOUND = 64 };

typedef struct arrays {
    fe_array of[MOST_BOUND];
    Py_buffer items[MOST_BOUND], data[MOST_BOUND];
    int32_t count;
} arrays;

static void drop_arrays(arrays *a)
{
    for (int32_t i = 0; i < a->count; ++i) drop_buffer(a->items + i), drop_buffer(a->data + i);
}

static void drop_bound(arrays *bound)
{
    if (bound) drop_arrays(bound), drop_arrays(bound + 1);
    free(bound);
}

/// (field, items or None, relative_to, origin, data): floats or doubles, by the format of the data
static int take_array(PyObject *given, int writable, arrays *out)
{
    PyObject *items, *origin, *data;
    unsigned long long relative_to;
    fe_array *a = out->of + out->count;
    Py_buffer *of_items = out->items + out->count, *of_data = out->data + out->count;
    fe_array_init(a, sizeof *a);
    *of_items = *of_data = (Py_buffer){0};
    ++out->count;
    if (!PyArg_ParseTuple(given, "iOKOO", &a->field, &items, &relative_to, &origin, &data)) return -1;
    if (to_dvec3(origin, &a->origin, "origin")) return -1;
    if (take_buffer(items, PyBUF_C_CONTIGUOUS, of_items)) return -1;
    if (take_buffer(data, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT | (writable ? PyBUF_WRITABLE : 0), of_data)) return -1;
    const char *format = of_data->format ? of_data->format : "B";
    if (strcmp(format, "f") != 0 && strcmp(format, "d") != 0) {
        PyErr_Format(PyExc_TypeError, "array: float32 or float64 is needed, not format '%s'", format);
        return -1;
    }
    a->is_double = *format == 'd', a->relative_to = relative_to;
    a->items = of_items->obj ? of_items->buf : NULL;
    a->item_count = of_items->obj ? (int32_t)(of_items->len / (Py_ssize_t)sizeof(fe_handle)) : 1;
    a->data = of_data->buf, a->bytes = of_data->len;
    return 0;
}

static int take_arrays(PyObject *list, int writable, arrays *out)
{
    PyObject *fast = PySequence_Fast(list, "arrays: a sequence is needed");
    if (!fast) return -1;
    const Py_ssize_t count = PySequence_Fast_GET_SIZE(fast);
    int status = count > MOST_BOUND ? (PyErr_SetString(PyExc_ValueError, "arrays: 64 at most"), -1) : 0;
    for (Py_ssize_t i = 0; i < count && status == 0; ++i)
        status = take_array(PySequence_Fast_GET_ITEM(fast, i), writable, out);
    Py_DECREF(fast);
    return status;
}

/// (batch, inputs, outputs)
static PyObject *flat_batch_bind(PyObject *self, PyObject *arguments)
{
    PyObject *batch, *inputs, *outputs;
    (void)self;
    if (!PyArg_ParseTuple(arguments, "OOO", &batch, &inputs, &outputs)) return NULL;
    arrays *in = calloc(2, sizeof *in), *out = in ? in + 1 : NULL;
    if (!in) return PyErr_NoMemory();
    batch_box *box = NULL;
    if (!take_arrays(inputs, 0, in) && !take_arrays(outputs, 1, out)) box = batch_of(batch);
    const fe_result result = box ? fe_batch_bind(box->batch, in->of, in->count, out->of, out->count) : FE_OK;
    if (result != FE_OK) raise_result(result);
    arrays *unused = in;
    if (box && result == FE_OK) unused = box->bound, box->bound = in;
    drop_bound(unused);
    if (!box || result != FE_OK) return NULL;
    Py_RETURN_NONE;
}

// ---- all worlds
// ------------------------------------------------------------------------------------------------------
typedef struct batch_call {
    PyObject *batch;
    batch_box *box;
    Py_buffer mask, results;
} batch_call;

static int begin_batch_call(batch_call *c, PyObject *batch, PyObject *mask, PyObject *results)
{
    *c = (batch_call){.batch = batch};
    batch_box *box = batch_of(batch);
    if (!box) return -1;
    if (take_buffer(mask, PyBUF_C_CONTIGUOUS, &c->mask)) return -1;
    if (take_buffer(results, PyBUF_C_CONTIGUOUS | PyBUF_WRITABLE, &c->results)) return -1;
    const Py_ssize_t count = box->count;
    if (!has_size(&c->mask, count, "mask") || !has_size(&c->results, 4 * count, "results")) return -1;
    c->box = box;
    Py_INCREF(batch);
    return 0;
}

/// What a call of all worlds returned: how many failed, or an error
static PyObject *end_batch_call(batch_call *c, int32_t failed)
{
    drop_buffer(&c->mask), drop_buffer(&c->results);
    if (!c->box) return NULL;
    if (failed < 0) raise_result(failed);
    Py_DECREF(c->batch);
    return failed < 0 ? NULL : PyLong_FromLong(failed);
}

/// (batch, dt, steps, mask, results)
static PyObject *flat_batch_step(PyObject *self, PyObject *arguments)
{
    PyObject *batch, *mask, *results;
    float dt;
    int steps, failed = 0;
    batch_call c = {0};
    (void)self;
    if (!PyArg_ParseTuple(arguments, "OfiOO", &batch, &dt, &steps, &mask, &results)) return NULL;
    if (begin_batch_call(&c, batch, mask, results) == 0) {
        ++c.box->users;
        PyThreadState *others = PyEval_SaveThread();
        failed = fe_batch_step(c.box->batch, dt, steps, c.mask.buf, c.results.buf);
        PyEval_RestoreThread(others);
        --c.box->users;
    }
    return end_batch_call(&c, failed);
}

/// (batch, mask, states or None, results): a state a world, None: the beginning
static PyObject *flat_batch_reset(PyObject *self, PyObject *arguments)
{
    PyObject *batch, *mask, *states, *results;
    int failed = 0;
    batch_call c = {0};
    (void)self;
    if (!PyArg_ParseTuple(arguments, "OOOO", &batch, &mask, &states, &results)) return NULL;
    const batch_box *box = batch_of(batch);
    if (!box) return NULL;
    const int32_t count = box->count;
    if (states != Py_None && (!PyList_Check(states) || PyList_GET_SIZE(states) != count)) {
        PyErr_Format(PyExc_ValueError, "states: a list of %d is needed", (int)count);
        return NULL;
    }
    const fe_state **given = states == Py_None ? NULL : calloc((size_t)count + 1, sizeof *given);
    if (states != Py_None && !given) return PyErr_NoMemory();
    int status = 0;
    for (int32_t i = 0; i < count && given && status == 0; ++i) {
        PyObject *one = PyList_GET_ITEM(states, i);
        state_box *state = one == Py_None ? NULL : state_of(one);
        status = one == Py_None ? 0 : !state || state_is_closed(state) ? -1 : 0;
        if (status == 0 && state) given[i] = state->state;
    }
    if (status == 0 && begin_batch_call(&c, batch, mask, results) == 0)
        failed = fe_batch_reset(c.box->batch, c.mask.buf, given, c.results.buf);
    free(given);
    return end_batch_call(&c, failed);
}

/// (batch, array, results)
static PyObject *flat_batch_read(PyObject *self, PyObject *arguments)
{
    PyObject *batch, *array, *results;
    int failed = 0;
    batch_call c = {0};
    arrays a = {.count = 0};
    (void)self;
    if (!PyArg_ParseTuple(arguments, "OOO", &batch, &array, &results)) return NULL;
    if (take_array(array, 1, &a) == 0 && begin_batch_call(&c, batch, Py_None, results) == 0)
        failed = fe_batch_read(c.box->batch, a.of, c.results.buf);
    drop_arrays(&a);
    return end_batch_call(&c, failed);
}

/// (batch, array, mask, results)
static PyObject *flat_batch_write(PyObject *self, PyObject *arguments)
{
    PyObject *batch, *array, *mask, *results;
    int failed = 0;
    batch_call c = {0};
    arrays a = {.count = 0};
    (void)self;
    if (!PyArg_ParseTuple(arguments, "OOOO", &batch, &array, &mask, &results)) return NULL;
    if (take_array(array, 0, &a) == 0 && begin_batch_call(&c, batch, mask, results) == 0)
        failed = fe_batch_write(c.box->batch, a.of, c.mask.buf, c.results.buf);
    drop_arrays(&a);
    return end_batch_call(&c, failed);
}

/// (batch, out): 8 bytes a world
static PyObject *flat_batch_hash(PyObject *self, PyObject *arguments)
{
    PyObject *batch, *out;
    Py_buffer buffer;
    (void)self;
    if (!PyArg_ParseTuple(arguments, "OO", &batch, &out)) return NULL;
    batch_box *box = batch_of(batch);
    if (!box || take_buffer(out, PyBUF_C_CONTIGUOUS | PyBUF_WRITABLE, &buffer)) return NULL;
    fe_result result = FE_OK;
    const int fits = has_size(&buffer, 8 * (Py_ssize_t)box->count, "out");
    if (fits) result = fe_batch_hash(box->batch, buffer.buf);
    drop_buffer(&buffer);
    if (result != FE_OK) raise_result(result);
    if (!fits || result != FE_OK) return NULL;
    Py_RETURN_NONE;
}

#endif
