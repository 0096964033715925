"""The flat module has every function and constant of feather.h, with the arguments that Python gives it."""

import re

import numpy as np
import pytest
from conftest import ROOT, Function, header_functions

import feather_physics
from feather_physics import _flat, records

# reached otherwise, and why
ELSEWHERE = {
    "fe_allocator_init": "allocators and task systems are functions of a host in C",
    "fe_task_system_init": "allocators and task systems are functions of a host in C",
    "fe_heightfield_def_init": "fe_heightfield_create takes a tuple, whose arrays live as long as the call",
    "fe_hull_def_init": "fe_hull_create takes a tuple, whose arrays live as long as the call",
    "fe_mesh_def_init": "fe_mesh_create takes a tuple, whose arrays live as long as the call",
    "fe_divergence_init": "divergences are tuples: their texts live as long as the player",
    "fe_query_filter_init": "filters are tuples of mask, flags and excluded bodies, for the same reason",
}
# arrays: a buffer goes in, though the name begins with out_
BUFFERS = re.compile(r"out_(bodies|shapes|joints|transforms|hits|overlaps|events|contacts|floats|heights|vertices|faces|corners|instances|keys|frames)$")
# the World goes in, whose hit it is
HITS = ("out_hit", "out_closest")
# an object with the bytes goes in, or comes out
BYTES = {"fe_asset_save": 2, "fe_asset_load": 2, "fe_world_save": 2, "fe_world_restore": 3, "fe_world_load": 3, "fe_snapshot_check": 1, "fe_snapshot_get_assets": 2, "fe_snapshot_compare": 2, "fe_recorder_read": 1, "fe_player_feed": 2}
FOUND_FROM_BUFFERS = ("allocator", "stride", "ray_stride", "path_stride", "count", "capacity", "struct_size", "user")


def python_arguments(function: Function) -> int:
    count = 0
    if function.name in BYTES:
        return BYTES[function.name]
    for parameter in function.parameters:
        if parameter.name in FOUND_FROM_BUFFERS:
            continue
        if parameter.name.startswith("out_") and "*" in parameter.type:
            scalar_pair = function.name in ("fe_joint_get_bodies", "fe_shape_get_events")
            if scalar_pair or not (BUFFERS.match(parameter.name) or parameter.name in HITS):
                continue
        count += 1
    return count


def test_the_header_is_read() -> None:
    assert len(header_functions()) >= 170


@pytest.mark.parametrize("function", header_functions(), ids=lambda f: f.name)
def test_function_is_there_with_the_arguments_that_go_in(function: Function) -> None:
    if function.name in ELSEWHERE:
        assert not hasattr(_flat, function.name[3:])
        return
    flat = getattr(_flat, function.name[3:])
    expected = python_arguments(function)
    with pytest.raises(TypeError) as error:
        flat(*[None] * (expected + 1))
    text = str(error.value)
    told = re.search(r"expected (?:at most )?(\d+)|(takes no)|(takes exactly one)", text)
    assert told, text
    assert (int(told.group(1)) if told.group(1) else 0 if told.group(2) else 1) == expected, text


def test_each_function_is_used_by_the_layer_above() -> None:
    text = "".join(path.read_text() for path in (ROOT / "bindings/python/feather_physics").glob("*.py"))
    kinds = ("distance", "ball", "hinge", "fixed", "configurable")
    built = {f"fe_{kind}_joint_{verb}" for kind in kinds for verb in ("create", "get", "set")}
    made_by_objects = {f.name for f in header_functions() if f.name.endswith("_init")}
    names = {
        "fe_last_error": "the text of the exceptions",
        "fe_result_name": "the classes of the exceptions",
        "fe_joint_get": "Joint.definition reads the whole definition",
        "fe_joint_set": "Joint.set writes the whole definition",
    }
    missing = [
        f.name
        for f in header_functions()
        if f.name not in built | made_by_objects
        and f.name not in names
        and not re.search(rf"_flat\.{f.name[3:]}\b", text)
    ]
    assert missing == []


def test_constants_are_there() -> None:
    header = (ROOT / "include/feather.h").read_text()
    for name, value in re.findall(r"^\s+(FE_\w+) = (-?\d+),", header, re.M):
        assert getattr(_flat, name) == int(value)


@pytest.mark.parametrize("name", [n for n in dir(records) if n.isupper() and hasattr(getattr(records, n), "size")])
def test_packed_record_has_the_size_of_the_struct(name: str) -> None:
    header = (ROOT / "include/feather.h").read_text()
    body = re.search(rf"typedef struct fe_{name.lower()} {{(.*?)}} fe_{name.lower()};", header, re.S)
    assert body
    record = getattr(records, name)
    kept = re.sub(r"uint32_t reserved\[\d+\];", "", body.group(1)) if name in ("RAY", "PATH") else body.group(1)
    if name == "PATH":
        kept = re.sub(r"fe_vec3 turn;", "", kept)  # paths of sweep_many have no turn
    assert record.size == struct_size(kept, header) == np.dtype(record.dtype).itemsize
    fields = [n.split("[")[0].strip() for names in re.findall(r"^\s*\w+ ([\w\[\], ]+);", body.group(1), re.M) for n in names.split(",")]
    expected = ["position", "rotation", "translation"] if name == "PATH" else [f for f in fields if f != "reserved"]
    assert record.dtype["names"] == expected


def struct_size(body: str, header: str) -> int:
    """The size of a struct of the header, by C's rules for 64-bit machines."""
    sizes = {"float": 4, "double": 8, "int32_t": 4, "uint32_t": 4, "fe_vec3": 12, "fe_dvec3": 24, "fe_quat": 16, "fe_transform": 40}
    total, align = 0, 4
    for kind, names in re.findall(r"^\s*(\w+) ([\w\[\], ]+);", body, re.M):
        for name in names.split(","):
            if kind in ("fe_contact_point",):
                inner = re.search(rf"typedef struct {kind} {{(.*?)}} {kind};", header, re.S)
                assert inner
                size = struct_size(inner.group(1), header)
            else:
                size = sizes.get(kind, 8)
            own = 8 if kind in ("double", "fe_dvec3", "fe_transform", "fe_contact_point") or kind not in sizes else 4
            total = (total + own - 1) // own * own
            repeat = re.search(r"\[(\d+)\]", name)
            total += size * (int(repeat.group(1)) if repeat else 1)
            align = max(align, own)
    return (total + align - 1) // align * align


@pytest.mark.parametrize("name", ["Tuning", "Profile", "Counters", "Energy", "HullInfo", "MeshInfo", "JointState", "MassData"])
def test_record_has_the_fields_of_the_struct(name: str) -> None:
    structs = {"Tuning": "world_tuning", "JointState": "joint_state", "MassData": "mass_data", "HullInfo": "hull_info", "MeshInfo": "mesh_info"}
    struct = "fe_" + structs.get(name, name.lower())
    header = (ROOT / "include/feather.h").read_text()
    body = re.search(rf"typedef struct {struct} {{(.*?)}} {struct};", header, re.S)
    assert body
    fields = [n.strip() for names in re.findall(r"^\s*\w+ ([\w, ]+);", body.group(1), re.M) for n in names.split(",")]
    assert list(getattr(feather_physics, name)._fields) == [f for f in fields if f not in ("struct_size", "reserved")]


def test_no_native_call_goes_past_the_flat_module() -> None:
    for path in (ROOT / "bindings/python/feather_physics").glob("*.py"):
        text = path.read_text()
        assert not re.search(r"\b(ctypes|cffi|dlopen|LoadLibrary|CDLL)\b", text), path


def test_fields_of_definitions_can_be_read_and_written_back() -> None:
    for name in dir(_flat):
        if not name.endswith("_def") or name.startswith("_"):
            continue
        definition = getattr(_flat, name)()
        for field in (f for f in dir(definition) if not f.startswith("_") and f not in ("this", "thisown", "struct_size", "axis", "axes", "pool", "store")):
            value = getattr(definition, field)
            if callable(value):
                continue
            setattr(definition, field, value)
            assert getattr(definition, field) == value, (name, field)
        with pytest.raises(AttributeError):
            definition.struct_size = 5
