// Types of feather.h in Python: small vectors are tuples with names, definitions and results objects with the header's
// fields, arrays anything with the buffer protocol (their strides and counts are found from it), errors exceptions;
// worlds, pools and stores are capsules.
%{
#include "rows.h"

#include "python/convert.h"
#include "python/found.h"
#include "python/batch.h"
#include "python/picture.h"
%}
%include "records.i"
%init %{
    if (add_types(m) || forget_ownership_methods(SwigPyObject_type())) return NULL;
%}
// a part keeps the object that it is of
%typemap(ret) fe_joint_axis *axis, fe_geometry *geometry %{
    if (resultobj && resultobj != Py_None) {
        ((SwigPyObject *)resultobj)->dict = Py_BuildValue("{sO}", "of", self);
        if (!((SwigPyObject *)resultobj)->dict) SWIG_fail;
    }
%}

%native(set_error_classes) PyObject *flat_set_error_classes(PyObject *self, PyObject *classes);
%native(set_classes) PyObject *flat_set_classes(PyObject *self, PyObject *classes);
%native(handle_of) PyObject *flat_handle_of(PyObject *self, PyObject *arguments);
%native(handles_of) PyObject *flat_handles_of(PyObject *self, PyObject *arguments);
%native(list_of) PyObject *flat_list_of(PyObject *self, PyObject *arguments);
%native(batch_get_world) PyObject *flat_batch_get_world(PyObject *self, PyObject *arguments);
%native(batch_create) PyObject *flat_batch_create(PyObject *self, PyObject *arguments);
%native(batch_destroy) PyObject *flat_batch_destroy(PyObject *self, PyObject *arguments);
%native(batch_bind) PyObject *flat_batch_bind(PyObject *self, PyObject *arguments);
%native(batch_step) PyObject *flat_batch_step(PyObject *self, PyObject *arguments);
%native(batch_reset) PyObject *flat_batch_reset(PyObject *self, PyObject *arguments);
%native(batch_read) PyObject *flat_batch_read(PyObject *self, PyObject *arguments);
%native(batch_write) PyObject *flat_batch_write(PyObject *self, PyObject *arguments);
%native(batch_hash) PyObject *flat_batch_hash(PyObject *self, PyObject *arguments);
%native(picture) PyObject *flat_picture(PyObject *self, PyObject *arguments);
%native(keep) PyObject *flat_keep(PyObject *self, PyObject *arguments);
%{
static PyObject *flat_set_error_classes(PyObject *self, PyObject *arguments)
{
    PyObject *classes;
    (void)self;
    return PyArg_ParseTuple(arguments, "O", &classes) ? set_error_classes(classes) : NULL;
}
static PyObject *flat_set_classes(PyObject *self, PyObject *arguments)
{
    PyObject *given;
    (void)self;
    return PyArg_ParseTuple(arguments, "O", &given) ? set_classes(given) : NULL;
}
static PyObject *flat_handle_of(PyObject *self, PyObject *arguments)
{
    (void)self;
    return handle_of(arguments);
}
static PyObject *flat_handles_of(PyObject *self, PyObject *arguments)
{
    (void)self;
    return handles_of(arguments);
}
static PyObject *flat_list_of(PyObject *self, PyObject *arguments)
{
    (void)self;
    return list_of(arguments);
}
static PyObject *flat_keep(PyObject *self, PyObject *arguments)
{
    PyObject *owner, *object;
    (void)self;
    return PyArg_ParseTuple(arguments, "OO", &owner, &object) ? keep(owner, object) : NULL;
}
%}

// ---- worlds, pools, stores: `call` keeps what the arguments borrow, so that it is released whatever fails -----------

%typemap(arginit) fe_world *, const fe_world *, fe_store *, const fe_store *, fe_history *, const fe_history *
    "begin_call(&call$argnum);"
%typemap(freearg) fe_world *, const fe_world *, fe_store *, const fe_store *, fe_history *, const fe_history *
    "end_call(&call$argnum);"
%typemap(in) fe_world * (world_box *box = 0, call_state call) {
    box = world_of($input);
    if (!box) SWIG_fail;
    $1 = box->world;
}
%typemap(in) const fe_world * = fe_world *;
// when all arguments are converted: a number's __float__ may close the world, or let another thread step it
%typemap(check) fe_world * "if (may_use(box$argnum, 1, \"$symname\")) SWIG_fail;"
%typemap(check) const fe_world * "if (may_use(box$argnum, 0, \"$symname\")) SWIG_fail;"
%typemap(argout) fe_world *, const fe_world * ""
%typemap(argout) fe_world *world %{
    if (result == FE_OK && strcmp("$symname", "world_destroy") == 0) close_world(box$argnum);
%}
%typemap(in, numinputs=0) fe_world **out_world (fe_world *made = 0) "$1 = &made;"
%typemap(argout) fe_world **out_world %{ $result = new_world(*$1); %}

%typemap(in, numinputs=0) fe_pool **out_pool (fe_pool *made = 0) "$1 = &made;"
%typemap(argout) fe_pool **out_pool %{ $result = new_pool(*$1); %}
%typemap(in) fe_pool *pool (pool_box *given = 0) {
    if ($input != Py_None) {
        given = pool_of($input);
        if (!given) SWIG_fail;
        $1 = given->pool;
    }
}
%typemap(argout) fe_pool *pool %{
    if (strcmp("$symname", "pool_destroy") == 0 && given$argnum) given$argnum->pool = NULL;
%}
%typemap(out) fe_pool *, fe_store * "$result = SWIG_Py_Void();"

%typemap(in, numinputs=0) fe_store **out_store (fe_store *made = 0) "$1 = &made;"
// the store that a world has: it is of use while the world lives
%typemap(argout) fe_store **out_store %{
    $result = new_store(*$1, strcmp("$symname", "world_get_store") == 0 ? swig_obj[0] : NULL);
%}
%typemap(in) fe_store *store (store_box *given = 0, call_state call) {
    if ($input != Py_None) {
        given = store_of($input);
        if (!given) SWIG_fail;
        $1 = given->store;
    }
}
%typemap(in) const fe_store *store = fe_store *store;
// when all arguments are converted, as above
%typemap(check) fe_store *store, const fe_store *store "if (given$argnum && !store_lives(given$argnum)) SWIG_fail;"
%typemap(argout) fe_store *store %{
    if (strcmp("$symname", "store_destroy") == 0 && given$argnum) given$argnum->store = NULL;
%}

%typemap(in, numinputs=0) fe_history **out_history (fe_history *made = 0) "$1 = &made;"
%typemap(argout) fe_history **out_history %{ $result = new_history(*$1, swig_obj[0]); %}
%typemap(in) fe_history *history (history_box *given = 0, call_state call) {
    given = history_of($input);
    if (!given) SWIG_fail;
    $1 = given->history;
}
%typemap(in) const fe_history *history = fe_history *history;
// when all arguments are converted, as above
%typemap(check) fe_history *history, const fe_history *history "if (may_not_use(given$argnum)) SWIG_fail;"
%typemap(argout) fe_history *history %{
    if (strcmp("$symname", "history_destroy") == 0) given$argnum->history = NULL;
%}

%typemap(in, numinputs=0) const fe_allocator *allocator "$1 = NULL;"
%typemap(in, numinputs=0) fe_state **out_state (fe_state *made = 0) "$1 = &made;"
%typemap(argout) fe_state **out_state %{ $result = new_state(*$1); %}
%typemap(in) fe_state *state (state_box *given = 0) {
    given = state_of($input);
    if (!given) SWIG_fail;
    $1 = given->state;
}
%typemap(in) const fe_state *state = fe_state *state;
// when all arguments are converted, as above
%typemap(check) fe_state *state, const fe_state *state "if (state_is_closed(given$argnum)) SWIG_fail;"
%typemap(argout) fe_state *state %{
    if (strcmp("$symname", "state_destroy") == 0 && result == FE_OK) given$argnum->state = NULL;
%}
%typemap(argout) const fe_state *state ""

%typemap(in, numinputs=0) fe_recorder **out_recorder (fe_recorder *made = 0) "$1 = &made;"
%typemap(argout) fe_recorder **out_recorder %{ $result = new_recorder(*$1, swig_obj[0]); %}
%typemap(in) fe_recorder *recorder (recorder_box *given = 0) {
    given = recorder_of($input);
    if (!given) SWIG_fail;
    $1 = given->recorder;
}
// when all arguments are converted, as above
%typemap(check) fe_recorder *recorder %{
    if (recorder_is_closed(given$argnum)) SWIG_fail;
    if (strcmp("$symname", "recorder_destroy") == 0 && may_end(given$argnum)) SWIG_fail;
%}
%typemap(argout) fe_recorder *recorder %{
    if (strcmp("$symname", "recorder_destroy") == 0 && result == FE_OK) given$argnum->recorder = NULL;
%}
%typemap(in) const char *text {
    $1 = (char *)to_text($input, "$1_name");
    if (!$1) SWIG_fail;
}
%typemap(freearg) const char *text ""

%typemap(in, numinputs=0) fe_player **out_player (fe_player *made = 0) "$1 = &made;"
%typemap(argout) fe_player **out_player %{ $result = new_player(*$1); %}
%typemap(in) fe_player *player (player_box *given = 0, PyObject *view = 0) {
    given = player_of($input);
    if (!given) SWIG_fail;
    $1 = given->player;
}
%typemap(in) const fe_player *player = fe_player *player;
// when all arguments are converted, as above
%typemap(check) fe_player *player "if (may_use_player(given$argnum, 1, \"$symname\")) SWIG_fail;"
%typemap(check) const fe_player *player "if (may_use_player(given$argnum, 0, \"$symname\")) SWIG_fail;"
%typemap(argout) fe_player *player %{
    if (strcmp("$symname", "player_destroy") == 0 && result == FE_OK) {
        given$argnum->player = NULL;
        if (given$argnum->view) close_world(PyCapsule_GetPointer(given$argnum->view, world_name));
        Py_CLEAR(given$argnum->kept);
    }
%}
%typemap(argout) const fe_player *player ""
// True: the player is there. False: there is no more yet
%typemap(out) fe_result fe_player_step, fe_result fe_player_seek {
    if ($1 < 0) {
        raise_result($1);
        SWIG_fail;
    }
    $result = PyBool_FromLong($1 == FE_OK);
}
// texts of a divergence and of notes live as long as the player: they are copied at once
%typemap(in, numinputs=0) fe_divergence *out_divergence (fe_divergence made) %{
    memset(&made, 0, sizeof made);
    made.struct_size = (uint32_t)sizeof made;
    $1 = &made;
%}
%typemap(argout) fe_divergence *out_divergence %{ $result = from_divergence($1); %}
%ignore fe_divergence;
%ignore fe_divergence_init;
%ignore fe_note;
%ignore fe_player_def::allocator;
%define FE_OF_ONE(FUNCTION, MAKE)
%ignore fe_##FUNCTION;
%native(FUNCTION) PyObject *flat_##FUNCTION(PyObject *self, PyObject *arguments);
%{
static PyObject *flat_##FUNCTION(PyObject *self, PyObject *arguments)
{
    PyObject *capsule;
    (void)self;
    return PyArg_UnpackTuple(arguments, "FUNCTION", 1, 1, &capsule) ? MAKE(capsule) : NULL;
}
%}
%enddef
FE_OF_ONE(recorder_read, read_recorder)
FE_OF_ONE(player_get_world, world_of_player)
FE_OF_ONE(player_release, release_world_of_player)
FE_OF_ONE(player_get_notes, notes_of_player)

// The GIL is given back in the step, and where a call may take long and only reads. What the other threads must not do
// meanwhile is checked while the GIL is held: the library's own check comes too late for a thread that closes the world
// just before the step begins.
%define FE_WITHOUT_GIL(NAME, ENTER, LEAVE)
%exception NAME {
    ENTER(box1);
    Py_BEGIN_ALLOW_THREADS
    $action
    Py_END_ALLOW_THREADS
    if (LEAVE(box1)) SWIG_fail;
}
%enddef
FE_WITHOUT_GIL(fe_world_step, enter_step, leave_step)
FE_WITHOUT_GIL(fe_world_raycast_many, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_sweep_many, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_get_moved, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_get_transforms, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_get_transforms_f32, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_get_velocities, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_get_joint_coordinates, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_get_joint_reactions, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_draw_lines, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_draw_triangles, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_draw_points, enter_read, leave_read)
FE_WITHOUT_GIL(fe_world_draw_instances, enter_read, leave_read)

%define FE_PLAYER_WITHOUT_GIL(NAME)
%exception NAME {
    view1 = enter_player(given1);
    Py_BEGIN_ALLOW_THREADS
    $action
    Py_END_ALLOW_THREADS
    leave_player(given1, view1);
}
%enddef
FE_PLAYER_WITHOUT_GIL(fe_player_feed)
FE_PLAYER_WITHOUT_GIL(fe_player_step)
FE_PLAYER_WITHOUT_GIL(fe_player_seek)

// A callable that takes a filter_pair and returns whether the two may collide, or None. The world keeps it.
%typemap(in) (fe_pair_filter filter, void *user) {
    if ($input != Py_None && !PyCallable_Check($input)) {
        PyErr_Format(PyExc_TypeError, "filter: a callable is needed, not '%s'", Py_TYPE($input)->tp_name);
        SWIG_fail;
    }
    $1 = $input == Py_None ? NULL : judge_pair;
    $2 = box1;
}
%typemap(argout) (fe_pair_filter filter, void *user) "keep_filter(box1, $input);"
%{
static PyObject *pair_record(const fe_filter_pair *pair)
{
    fe_filter_pair *copy = malloc(sizeof *copy);
    if (!copy) return PyErr_NoMemory();
    *copy = *pair;
    return SWIG_Python_NewPointerObj(NULL, copy, SWIGTYPE_p_fe_filter_pair, SWIG_POINTER_OWN);
}
%}

// ---- results --------------------------------------------------------------------------------------------------------

%typemap(out) fe_result, FE_FOUND {
    if ($1 < 0) {
        raise_result($1);
        SWIG_fail;
    }
    $result = SWIG_Py_Void();
}
%typemap(out) FE_ANY {
    if ($1 < 0) {
        raise_result($1);
        SWIG_fail;
    }
    $result = PyBool_FromLong($1);
}
// counts; a field that is read may be negative
%typemap(out) int32_t {
    if ($1 < 0 && !ends_with("$symname", "_get")) {
        raise_result($1);
        SWIG_fail;
    }
    $result = PyLong_FromLong($1);
}

// ---- numbers that go in ---------------------------------------------------------------------------------------------

%typemap(in) float, double {
    double value;
    if (to_double($input, &value, "$1_name")) SWIG_fail;
    $1 = ($1_ltype)value;
}
%define FE_INTEGER(TYPE, LOW, HIGH)
%typemap(in) TYPE {
    unsigned long long value;
    if (to_integer($input, LOW, HIGH, &value, "$1_name")) SWIG_fail;
    $1 = ($1_ltype)value;
}
%enddef
FE_INTEGER(int32_t, INT32_MIN, INT32_MAX)
FE_INTEGER(uint32_t, 0, UINT32_MAX)
FE_INTEGER(uint64_t, 0, UINT64_MAX)
FE_INTEGER(int64_t, INT64_MIN, INT64_MAX)
FE_INTEGER(fe_handle, 0, UINT64_MAX)

// ---- values that come out -------------------------------------------------------------------------------------------

%define FE_OUT(TYPE, MAKE)
%typemap(in, numinputs=0) TYPE ($*1_ltype value) "$1 = &value;"
%typemap(argout) TYPE { $result = SWIG_Python_AppendOutput($result, MAKE); }
%enddef
FE_OUT(fe_handle *, PyLong_FromUnsignedLongLong(*$1))
FE_OUT(uint64_t *, PyLong_FromUnsignedLongLong(*$1))
FE_OUT(int32_t *, PyLong_FromLong(*$1))
FE_OUT(int64_t *, PyLong_FromLongLong(*$1))
FE_OUT(uint32_t *, PyLong_FromUnsignedLong(*$1))
FE_OUT(float *, PyFloat_FromDouble((double)*$1))
%typemap(in, numinputs=0) uint32_t *out_words (uint32_t words[2]) "$1 = words;"
%typemap(argout) uint32_t *out_words %{
    $result = PyLong_FromUnsignedLongLong((unsigned long long)$1[1] << 32 | $1[0]);
%}

%typemap(out) float barycentric[2] %{ $result = Py_BuildValue("(dd)", (double)$1[0], (double)$1[1]); %}

// of a triangle of a mesh
%typemap(out) fe_vec3 corners[3] %{ $result = from_corners($1); %}
%typemap(out) uint32_t edges[3] %{ $result = Py_BuildValue("(III)", $1[0], $1[1], $1[2]); %}

// `fe_vec3 *` without a name is a value that goes in, as a member's setter has it.
%define FE_SMALL(TYPE, NAME)
%typemap(in) TYPE * (TYPE value) {
    if (to_##NAME($input, &value, "$1_name")) SWIG_fail;
    $1 = &value;
}
%typemap(in) const TYPE * = TYPE *;
%typemap(out) TYPE * { $result = from_##NAME($1); }
%ignore TYPE;
%enddef
%define FE_OUT_SMALL(TYPE, NAME, PARAMETER)
FE_OUT(TYPE *PARAMETER, from_##NAME($1))
%enddef
FE_SMALL(fe_vec3, vec3)
FE_SMALL(fe_dvec3, dvec3)
FE_SMALL(fe_quat, quat)
FE_SMALL(fe_transform, transform)
FE_SMALL(fe_frame, frame)
FE_SMALL(fe_bounds, bounds)
FE_SMALL(fe_material, material)
// one that may be NULL
%typemap(in) const fe_vec3 *direction (fe_vec3 value) {
    if ($input != Py_None) {
        if (to_vec3($input, &value, "$1_name")) SWIG_fail;
        $1 = &value;
    }
}
FE_OUT_SMALL(fe_vec3, vec3, out_gravity)
FE_OUT_SMALL(fe_vec3, vec3, out_velocity)
FE_OUT_SMALL(fe_vec3, vec3, out_force)
FE_OUT_SMALL(fe_vec3, vec3, out_torque)
FE_OUT_SMALL(fe_vec3, vec3, out_direction)
FE_OUT_SMALL(fe_dvec3, dvec3, out_position)
FE_OUT_SMALL(fe_dvec3, dvec3, out_centre)
FE_OUT_SMALL(fe_dvec3, dvec3, out_linear)
FE_OUT_SMALL(fe_dvec3, dvec3, out_angular)
FE_OUT_SMALL(fe_quat, quat, out_rotation)
FE_OUT_SMALL(fe_transform, transform, out_transform)
FE_OUT_SMALL(fe_transform, transform, out_frame_a)
FE_OUT_SMALL(fe_transform, transform, out_frame_b)
FE_OUT_SMALL(fe_frame, frame, out_frame)
FE_OUT_SMALL(fe_bounds, bounds, out_bounds)
FE_OUT_SMALL(fe_material, material, out_material)

// ---- records: objects with the fields of the struct -----------------------------------------------------------------

// The first word is struct_size where there is one, and is written over where there is none.
%typemap(in, numinputs=0) SWIGTYPE *OUT_RECORD {
    $1 = ($1_ltype)calloc(1, sizeof *$1);
    if (!$1) {
        PyErr_NoMemory();
        SWIG_fail;
    }
    *(uint32_t *)(void *)$1 = (uint32_t)sizeof *$1;
}
%typemap(in, numinputs=0) SWIGTYPE *OUT_HIT = SWIGTYPE *OUT_RECORD;
%define FE_GIVE_RECORD(RECORD, FILLED)
%typemap(argout) SWIGTYPE *RECORD %{
    if (FILLED) {
        $result = SWIG_Python_AppendOutput($result, SWIG_NewPointerObj($1, $1_descriptor, SWIG_POINTER_OWN));
        $1 = NULL;
    }
%}
%typemap(freearg) SWIGTYPE *RECORD "free($1);"
%enddef
FE_GIVE_RECORD(OUT_RECORD, result == FE_OK)
// that of a library whose results differ, too
%typemap(in, numinputs=0) SWIGTYPE *OUT_INFO = SWIGTYPE *OUT_RECORD;
FE_GIVE_RECORD(OUT_INFO, result >= 0)
%apply SWIGTYPE *OUT_INFO { fe_snapshot_info *out_info };
FE_GIVE_RECORD(OUT_HIT, result > 0)
FE_OUT_RECORDS
FE_OUT_HITS
// What a query finds is an object of the package's own. The World that it is found in goes in, to be its body's.
%define FE_FINDS(TYPE, PARAMETER, MAKE)
%typemap(in) TYPE *PARAMETER (TYPE found) "$1 = &found;"
%typemap(argout) TYPE *PARAMETER %{
    if (result > 0) {
        Py_SETREF($result, MAKE(&(place){$input, swig_obj[0]}, $1));
        if (!$result) SWIG_fail;
    }
%}
%typemap(freearg) TYPE *PARAMETER ""
%ignore TYPE;
%enddef
FE_FINDS(fe_hit, out_hit, from_hit)
FE_FINDS(fe_closest, out_closest, from_closest)
// fe_geometry_box and its like return nothing that could fail
%typemap(argout) fe_geometry *out_geometry %{
    $result = SWIG_Python_AppendOutput($result, SWIG_NewPointerObj($1, $1_descriptor, SWIG_POINTER_OWN));
    $1 = NULL;
%}

// ---- arrays ---------------------------------------------------------------------------------------------------------

%define FE_INPUT(TYPE, RECORD, CODES)
%typemap(in) TYPE {
    const void *array;
    if (to_input(&call1, $input, RECORD, CODES, "$1_name", &array)) SWIG_fail;
    $1 = ($1_ltype)array;
}
%enddef
%define FE_OUTPUT(TYPE, RECORD, CODES)
%typemap(in) TYPE {
    void *array;
    if (to_output(&call1, $input, RECORD, CODES, "$1_name", &array)) SWIG_fail;
    $1 = ($1_ltype)array;
}
%typemap(argout) TYPE ""
%enddef
FE_INPUT(const fe_handle *, sizeof *$1, "QqLl")
FE_INPUT(const fe_transform *transforms, sizeof *$1, "")
// the front of fe_ray, without what is reserved, and of fe_path, without the turn
FE_INPUT(const fe_ray *rays, RAY_SIZE, "")
FE_INPUT(const fe_path *paths, PATH_SIZE, "")
FE_INPUT(const float *floats, 6 * sizeof *$1, "f")
FE_INPUT(const float *values, sizeof *$1, "f")
FE_INPUT(const float *heights, sizeof *$1, "f")
%typemap(argout) const fe_handle *, const float * ""
FE_OUTPUT(fe_handle *out_bodies, sizeof *$1, "QqLl")
FE_OUTPUT(fe_handle *out_shapes, sizeof *$1, "QqLl")
FE_OUTPUT(fe_handle *out_joints, sizeof *$1, "QqLl")
FE_OUTPUT(fe_transform *out_transforms, sizeof *$1, "")
FE_OUTPUT(fe_overlap *out_overlaps, sizeof *$1, "")
FE_OUTPUT(fe_hit *out_hits, sizeof *$1, "")
FE_OUTPUT(fe_pair_event *out_events, sizeof *$1, "")
FE_OUTPUT(fe_body_event *out_events, sizeof *$1, "")
FE_OUTPUT(fe_hit_event *out_events, sizeof *$1, "")
FE_OUTPUT(fe_joint_event *out_events, sizeof *$1, "")
FE_OUTPUT(fe_contact *out_contacts, sizeof *$1, "")
FE_OUTPUT(fe_draw_vertex *out_vertices, sizeof *$1, "")
FE_OUTPUT(fe_draw_instance *out_instances, sizeof *$1, "")
FE_OUTPUT(float *out_floats, (size_t)floats_of("$symname") * sizeof *$1, "f")
FE_OUTPUT(float *out_heights, sizeof *$1, "f")
FE_OUTPUT(fe_vec3 *out_vertices, sizeof *$1, "f")
FE_OUTPUT(fe_hull_face *out_faces, sizeof *$1, "")
FE_OUTPUT(fe_history_frame *out_frames, sizeof *$1, "")
FE_OUTPUT(int32_t *out_corners, sizeof *$1, "Iil")
%typemap(check) const float *heights "if (heights_fit(call1.count, arg5, arg6)) SWIG_fail;"
%typemap(check) float *out_heights "if (heights_fit(call1.capacity, arg5, arg6)) SWIG_fail;"

%typemap(in, numinputs=0) int32_t count, int32_t capacity, uint32_t stride "$1 = 0;"
%typemap(in, numinputs=0) uint32_t ray_stride "$1 = RAY_SIZE;"
%typemap(in, numinputs=0) uint32_t path_stride "$1 = PATH_SIZE;"
%typemap(check) uint32_t stride "$1 = call1.stride;"
%typemap(check) int32_t count "if (array_count(&call1, &$1)) SWIG_fail;"
%typemap(check) int32_t capacity "$1 = array_capacity(&call1);"

// a sequence of records, whose copies go in
%define FE_RECORDS(TYPE, WHAT)
%typemap(in) TYPE {
    Py_ssize_t length = PySequence_Size($input);
    if (length < 0) SWIG_fail;
    $*1_ltype *copies = calloc((size_t)length + 1, sizeof *copies);
    if (!copies) {
        PyErr_NoMemory();
        SWIG_fail;
    }
    call1.memory = copies;
    for (Py_ssize_t i = 0; i < length; ++i) {
        PyObject *item = PySequence_GetItem($input, i);
        void *record = NULL;
        int converted = item ? SWIG_ConvertPtr(item, &record, $1_descriptor, 0) : SWIG_ERROR;
        if (SWIG_IsOK(converted) && record) copies[i] = *($1_ltype)record;
        Py_XDECREF(item);
        if (!SWIG_IsOK(converted) || !record) {
            if (!PyErr_Occurred()) PyErr_SetString(PyExc_TypeError, WHAT " are needed");
            SWIG_fail;
        }
    }
    call1.count = length;
    call1.stride = (uint32_t)sizeof *copies;
    $1 = copies;
}
%enddef
FE_RECORDS(const fe_body_def *defs, "definitions: definitions of bodies")
FE_RECORDS(const fe_compound_part *parts, "parts: parts of a compound")

%typemap(in) const fe_query_filter *filter (fe_query_filter value) {
    const fe_query_filter *found;
    if (to_filter(&call1, $input, &value, &found)) SWIG_fail;
    $1 = ($1_ltype)found;
}
%ignore fe_query_filter;
%ignore fe_query_filter_init;
%typemap(in) const fe_heightfield_def *def (fe_heightfield_def value) {
    if (to_heightfield(&call1, $input, &value)) SWIG_fail;
    $1 = &value;
}
%ignore fe_heightfield_def;
%ignore fe_heightfield_def_init;
%typemap(in) const fe_hull_def *def (fe_hull_def value) {
    if (to_hull(&call1, $input, &value)) SWIG_fail;
    $1 = &value;
}
%ignore fe_hull_def;
%ignore fe_hull_def_init;
%typemap(in) const fe_mesh_def *def (fe_mesh_def value) {
    if (to_mesh(&call1, $input, &value)) SWIG_fail;
    $1 = &value;
}
%ignore fe_mesh_def;
%ignore fe_mesh_def_init;
%typemap(in) const fe_material *materials {
    int32_t length = 0;
    if ($input == Py_None) {
        PyErr_SetString(PyExc_TypeError, "materials: a sequence is needed");
        SWIG_fail;
    }
    if (to_materials(&call1, $input, (const fe_material **)&$1, &length)) SWIG_fail;
    call1.count = length;
}

// bytes of an asset or a world: written into an object of Python's, whose size is asked for first
%typemap(in, numinputs=0) (void *out, int64_t capacity) (PyObject *saved = NULL) "$1 = NULL; $2 = 0;"
%typemap(argout) (void *out, int64_t capacity) %{
    $result = saved$argnum;
    saved$argnum = NULL;
%}
%typemap(freearg) (void *out, int64_t capacity) "Py_XDECREF(saved$argnum);"
%define FE_SAVES(NAME)
%typemap(out) int64_t NAME {
    if ($1 < 0) {
        raise_result((int32_t)$1);
        SWIG_fail;
    }
}
%exception NAME {
    $action
    if (result > 0) {
        saved3 = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)result);
        if (!saved3) SWIG_fail;
        arg3 = PyBytes_AS_STRING(saved3);
        arg4 = result;
        $action
        // a difference is smaller than its bound
        if (result > 0 && result < arg4 && _PyBytes_Resize(&saved3, (Py_ssize_t)result)) SWIG_fail;
    }
}
%enddef
FE_SAVES(fe_asset_save)
FE_SAVES(fe_world_save)
%typemap(arginit) (const void *bytes, int64_t size) "begin_call(&call$argnum);"
%typemap(freearg) (const void *bytes, int64_t size) "end_call(&call$argnum);"
%typemap(in) (const void *bytes, int64_t size) (call_state call) {
    const void *array;
    if (to_input(&call, $input, 1, "", "$1_name", &array)) SWIG_fail;
    $1 = ($1_ltype)array;
    $2 = call.count;
}
%apply (const void *bytes, int64_t size) { (const void *a, int64_t a_size), (const void *b, int64_t b_size) };
// True: it goes on bit for bit
%typemap(out) fe_result fe_world_restore {
    if ($1 < 0) {
        raise_result($1);
        SWIG_fail;
    }
    $result = PyBool_FromLong($1 == FE_OK);
}
// keys are strings of 32 hexadecimal digits; an asset of the store is found by its key without being named
%ignore fe_restore_options::keys;
%ignore fe_restore_options::assets;
%ignore fe_restore_options::asset_count;
%ignore fe_asset_key;
FE_OUT(fe_asset_key *out_key, from_key($1))
FE_OUTPUT(fe_asset_key *out_keys, sizeof *$1, "")

// read from packed buffers, see records.py
%ignore fe_ray;
%ignore fe_path;
%ignore fe_history_frame;
%ignore fe_hull_face;
%ignore fe_pair_event;
%ignore fe_body_event;
%ignore fe_hit_event;
%ignore fe_joint_event;
%ignore fe_contact;
%ignore fe_contact_point;
%ignore fe_draw_vertex;
%ignore fe_draw_instance;
%ignore fe_overlap;
