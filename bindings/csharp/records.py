#!/usr/bin/env python3
"""Writes the enums and records of include/feather.h as C#, with the header's comments as XML documentation.

    records.py include/feather.h Records.cs

A definition (fe_..._def, fe_world_tuning, fe_draw_options) becomes a class whose constructor fills it by its `_init`. Every other struct
becomes a struct. Both have C's layout. Names of C in the comments become those of C#.
"""
import re
import sys
from pathlib import Path
from xml.sax.saxutils import escape

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
import header  # noqa: E402

BY_HAND = {"fe_vec3": "Vector3", "fe_quat": "Quaternion", "fe_dvec3": "DVec3", "fe_transform": "WorldTransform",
           "fe_asset_key": "AssetKey"}
# Some words belong to every program of Unity already: Transform, Bounds, Material, Motion.
NAMES = {"fe_material": "SurfaceMaterial", "fe_bounds": "WorldBounds", "fe_energy": "WorldEnergy",
         "fe_profile": "StepProfile", "fe_counters": "WorldCounters", "fe_path": "SweepPath", "fe_axis": "Axes",
         "fe_closest": "ClosestPoint", "fe_motion": "AxisMotion", "fe_spring": "AxisSpring",
         "fe_overlap": "ShapeOverlap", "fe_field": "BatchField"}
PRIVATE = {"fe_query_filter": "NativeFilter",  # what serves instead is written by hand
           "fe_heightfield_def": "NativeHeightfield", "fe_hull_def": "NativeHull", "fe_mesh_def": "NativeMesh",
           "fe_save": "NativeSave", "fe_save_options": "NativeSaveOptions",
           "fe_restore_options": "NativeRestoreOptions", "fe_difference": "NativeDifference",
           "fe_array": "NativeBatchArray", "fe_note": "NativeNote", "fe_divergence": "NativeDivergence"}
FOR_C = {"fe_allocator", "fe_task_system"}
HANDLES = {"fe_body": "BodyHandle", "fe_shape": "ShapeHandle", "fe_joint": "JointHandle", "fe_asset": "AssetHandle"}
PLAIN = {"int32_t": "int", "uint32_t": "uint", "int64_t": "long", "uint64_t": "ulong", "float": "float",
         "double": "double", "fe_handle": "ulong", "char": "byte"}
SWITCHES = {"awake", "sleep_allowed", "bullet", "trigger", "is_trigger", "collide_connected", "pair_filter", "one_way",
            "kept", "own_material", "foreign", "filter", "has_diverged"}
ENUM_FIELDS = {"linear_locks": "fe_axis", "angular_locks": "fe_axis", "kind": "fe_event_kind"}
FLAGS = {"fe_axis", "fe_shape_events", "fe_query_flags", "fe_hit_flags", "fe_mesh_flags", "fe_mesh_edge_flags",
         "fe_draw_flags", "fe_record_flags"}
AXES = ["LinearX", "LinearY", "LinearZ", "AngularX", "AngularY", "AngularZ"]  # of a configurable joint, by fe_dof


def pascal(name):
    return "".join(part[:1].upper() + part[1:].lower() for part in name.split("_"))


def type_name(name):
    return BY_HAND.get(name) or NAMES.get(name) or PRIVATE.get(name) or HANDLES.get(name) or pascal(name[3:])


def is_definition(name):
    return (name.endswith("_def") or name in ("fe_world_tuning", "fe_draw_options")) and name not in PRIVATE


def prefix_words(items):
    """How many words all enumerators begin with."""
    words = [item.split("_") for item in items]
    shared = 0
    while all(len(w) > shared + 1 and w[shared] == words[0][shared] for w in words):
        shared += 1
    return shared


class Words:
    """C's names in a comment, as C# has them."""

    def __init__(self, declared):
        self.enumerators = {}
        for name, enum in declared.enums.items():
            items = [item.name for item in enum.items]
            shared = prefix_words(items)
            for item in items:
                self.enumerators[item] = f"{type_name(name)}.{pascal('_'.join(item.split('_')[shared:]))}"
        self.types = {*declared.enums, *declared.structs}

    def lower_case(self, match):
        name, field = match[1], match[2]
        if name in self.types or name in HANDLES:
            return type_name(name) + (f".{pascal(field)}" if field else "")
        owner, _, rest = name[3:].partition("_")
        return f"{pascal(owner)}.{pascal(rest)}" if rest else pascal(owner)

    def __call__(self, text):
        text = re.sub(r"FE_[A-Z0-9_]*[A-Z0-9]", lambda m: self.enumerators.get(m[0], m[0]), text)
        text = re.sub(r"\b(fe_[a-z0-9_]+)(?:\.([a-z_]+))?\b", self.lower_case, text)
        text = re.sub(r"`([a-z0-9]+(?:_[a-z0-9]+)+|[a-z]+)`", lambda m: pascal(m[1]), text)
        return re.sub(r"\b[a-z]+(?:_[a-z]+)+\b", lambda m: pascal(m[0]), text).replace("NULL", "null")


def summary(text, words, indent):
    text = escape(" ".join(words(text).split()))
    return f"{indent}/// <summary>{text}</summary>\n" if text else ""


def enum_text(one, words):
    front = type_name(one.name) + "."
    lines = "".join(summary(item.told or item.name, words, "        ") +
                    f"        {words.enumerators[item.name][len(front):]} = {item.value},\n" for item in one.items)
    flags = "    [System.Flags]\n" if one.name in FLAGS else ""
    access = "internal" if one.name in PRIVATE else "public"
    told = summary(one.told, words, "    ")
    return f"{told}{flags}    {access} enum {type_name(one.name)}\n    {{\n{lines}    }}\n"


def field_type(base, name, doc, enums):
    stated = re.match(r"(fe_\w+)", doc)
    if base in ("int32_t", "uint32_t"):
        if name in SWITCHES or name.endswith("enabled"):
            return "Switch"
        if name in ENUM_FIELDS:
            return type_name(ENUM_FIELDS[name])
        if stated and stated[1] in enums:
            return type_name(stated[1])
    return PLAIN.get(base) or type_name(base)


def fields(struct, enums):
    """(type, name, visibility, documentation) of each field, arrays spread out."""
    for one in struct.fields:
        hidden = one.name == "struct_size" or one.name.startswith("reserved") or one.is_pointer
        kind = "System.IntPtr" if one.is_pointer else field_type(one.kind, one.name, one.told, enums)
        names = [pascal(one.name)]
        if one.count:
            names = [f"{re.sub('s$', '', names[0])}{i}" for i in range(one.count)] if one.name != "axes" else AXES
        for each in names:
            yield kind, each, "internal" if hidden else "public", one.told


def to_string(name, members):
    parts = ", ".join(f"{member} = {{{member}}}" for member in members)
    return ("        /// <inheritdoc/>\n        public override string ToString()\n        {\n"
            f"            return System.FormattableString.Invariant(\n                $\"{name} {{{{ {parts} }}}}\");\n"
            "        }\n")


def record(struct, enums, words, shared_docs):
    name = struct.name
    definition = is_definition(name)
    kind = "sealed unsafe partial class" if definition else "partial struct"
    access = "internal" if name in PRIVATE else "public"
    own = type_name(name)
    text = summary(struct.told, words, "    ")
    text += f"    [StructLayout(LayoutKind.Sequential)]\n    {access} {kind} {own}\n    {{\n"
    members = []
    for field, each, visibility, comment in fields(struct, enums):
        comment = comment or name.endswith("_joint_def") and shared_docs.get(each) or ""
        text += summary(comment if visibility == "public" else "", words, "        ")
        text += f"        {visibility} {field} {each};\n"
        if visibility == "public":
            members.append(each)
    if definition:
        text += f"\n        internal static readonly uint Size = (uint)Marshal.SizeOf(typeof({own}));\n"
        text += "        /// <summary>The library's defaults.</summary>\n        public " + own
        text += f"() {{ fixed (uint* start = &StructSize) Native.{name[3:]}_init(start, Size); }}\n"
    if access == "public":
        text += to_string(own, members)
    return text + "    }\n"


def main():
    declared = header.read(Path(sys.argv[1]))
    words, enums = Words(declared), set(declared.enums)
    shared_docs = {member: doc for _, member, _, doc in fields(declared.structs["fe_joint_def"], enums)}
    shown = [one for one in declared.types if one.name not in BY_HAND and one.name not in FOR_C]
    parts = [enum_text(one, words) if one.name in enums else record(one, enums, words, shared_docs) for one in shown]
    with open(sys.argv[2], "w", encoding="utf-8") as out:
        out.write("// Made from feather.h by bindings/csharp/records.py.\n#pragma warning disable 169, 414, 649\n"
                  "using System.Runtime.InteropServices;\n"
                  "#if UNITY_5_3_OR_NEWER\nusing UnityEngine;\n#else\nusing System.Numerics;\n#endif\n\n"
                  "namespace FeatherPhysics\n{\n" + "\n".join(parts) + "}\n")


main()
