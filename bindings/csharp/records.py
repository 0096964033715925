#!/usr/bin/env python3
"""Writes the enums and records of include/feather.h as C#, with the header's comments as XML documentation.

    records.py include/feather.h Records.cs

A definition (a struct with an `_init`) becomes a class that its constructor fills by that; every other struct a struct. Both have C's layout.
"""
import re
import sys
from xml.sax.saxutils import escape

BY_HAND = {"fe_vec3": "Vector3", "fe_quat": "Quaternion", "fe_dvec3": "DVec3", "fe_transform": "WorldTransform"}
NAMES = {"fe_frame": "JointFrame", "fe_material": "SurfaceMaterial", "fe_profile": "StepProfile", "fe_counters": "WorldCounters",
         "fe_path": "SweepPath", "fe_axis": "Axes", "fe_closest": "ClosestPoint", "fe_motion": "AxisMotion", "fe_spring": "AxisDrive"}
PRIVATE = {"fe_query_filter": "NativeFilter", "fe_heightfield_def": "NativeHeightfield"}  # classes around these are written by hand
FOR_C = {"fe_allocator", "fe_task_system"}
HANDLES = {"fe_body": "BodyHandle", "fe_shape": "ShapeHandle", "fe_joint": "JointHandle", "fe_asset": "AssetHandle"}
PLAIN = {"int32_t": "int", "uint32_t": "uint", "int64_t": "long", "float": "float", "double": "double", "fe_handle": "ulong"}
SWITCHES = {"awake", "sleep_allowed", "enabled", "bullet", "trigger", "is_trigger", "collide_connected", "limited", "swing_limited", "twist_limited"}
ENUM_FIELDS = {"linear_locks": "fe_axis", "angular_locks": "fe_axis", "kind": "fe_event_kind", "mode": "fe_motion"}
FLAGS = {"fe_axis", "fe_shape_events", "fe_query_flags", "fe_hit_flags"}
AXES = ["AlongX", "AlongY", "AlongZ", "AboutX", "AboutY", "AboutZ"]  # of a configurable joint, by fe_dof


def pascal(name):
    return "".join(part[:1].upper() + part[1:].lower() for part in name.split("_"))


def type_name(name):
    return NAMES.get(name) or PRIVATE.get(name) or pascal(name.removeprefix("fe_"))


def summary(text, indent=""):
    text = escape(" ".join(text.split()))
    return f"{indent}/// <summary>{text}</summary>\n" if text else ""


def enum(name, body, doc):
    items = [(m[1], m[2], m[3] or "") for m in re.finditer(r"^\s*(FE_\w+) = ([^,\n]+),?[ ]*(?:///< (.*))?$", body, re.M) if "FORCE32" not in m[1]]
    words = [item[0].split("_") for item in items]
    shared = 0
    while all(len(w) > shared + 1 and w[shared] == words[0][shared] for w in words):
        shared += 1
    lines = "".join(summary(text, "        ") + f"        {pascal('_'.join(w[shared:]))} = {value},\n" for w, (_, value, text) in zip(words, items))
    flags = "    [System.Flags]\n" if name in FLAGS else ""
    return f"{summary(doc, '    ')}{flags}    public enum {type_name(name)}\n    {{\n{lines}    }}\n"


def field_type(base, name, doc, enums):
    told = re.match(r"(fe_\w+)", doc)
    if base in ("int32_t", "uint32_t"):
        if name in SWITCHES:
            return "Switch"
        if name in ENUM_FIELDS:
            return type_name(ENUM_FIELDS[name])
        if told and told[1] in enums:
            return type_name(told[1])
    return BY_HAND.get(base) or HANDLES.get(base) or PLAIN.get(base) or type_name(base)


def fields(struct, body, enums):
    """(type, name, visibility, documentation) of each field, arrays spread out; continued comments joined."""
    body = re.sub(r"\n\s*///< ?", " ", re.sub(r"\n\s*///(?!<).*", "", body))
    for m in re.finditer(r"^\s*(const )?(\w+) ([^;]+);[ ]*(?:///< (.*))?$", body, re.M):
        base, declarators, doc = m[2], m[3], m[4] or ""
        for declarator in declarators.split(","):
            declarator = declarator.strip()
            name = declarator.lstrip("*").split("[")[0]
            hidden = name == "struct_size" or name.startswith("reserved") or "*" in declarator
            hidden = hidden or struct.endswith("_def") and name in ("body_a", "body_b")  # World sees to it that they are of one world
            kind = "System.IntPtr" if "*" in declarator else field_type(base, name, doc, enums)
            array = re.search(r"\[(\d+)\]", declarator)
            names = [pascal(name)]
            if array:
                names = AXES if name == "axes" else [f"{pascal(name).removesuffix('s')}{i}" for i in range(int(array[1]))]
            for each in names:
                yield kind, each, "internal" if hidden else "public", doc


def record(name, body, doc, enums, inits):
    made = name in inits and name not in PRIVATE
    kind = "sealed unsafe partial class" if made else "partial struct"
    access = "internal" if name in PRIVATE else "public"
    text = summary(doc, "    ") + f"    [StructLayout(LayoutKind.Sequential)]\n    {access} {kind} {type_name(name)}\n    {{\n"
    for field, each, visibility, told in fields(name, body, enums):
        text += summary(told if visibility == "public" else "", "        ") + f"        {visibility} {field} {each};\n"
    if made:
        text += f"\n        internal static readonly uint Size = (uint)Marshal.SizeOf(typeof({type_name(name)}));\n"
        text += "        /// <summary>The library's defaults.</summary>\n"
        text += f"        public {type_name(name)}() {{ fixed (uint* start = &StructSize) Native.{name.removeprefix('fe_')}_init(start, Size); }}\n"
    return text + "    }\n"


def main():
    header = open(sys.argv[1], encoding="utf-8").read()
    types = [(m[2], m[4], m[3], re.sub(r"^///", "", m[1] or "", flags=re.M))
             for m in re.finditer(r"((?:^///[^\n]*\n)*)^typedef (struct|enum) (\w+) \{\n(.*?)^\} \3;", header, re.M | re.S)
             for m in [{1: m[1], 2: m[2], 3: m[3], 4: m[4]}]]
    inits = set(re.findall(r"void (fe_\w+)_init\(", header))
    enums = {name for kind, _, name, _ in types if kind == "enum"}
    parts = [enum(name, body, doc) if kind == "enum" else record(name, body, doc, enums, inits)
             for kind, body, name, doc in types if name not in BY_HAND and name not in FOR_C]
    with open(sys.argv[2], "w", encoding="utf-8") as out:
        out.write("// Made from feather.h by bindings/csharp/records.py.\n#pragma warning disable 169, 414, 649, 1591\n"
                  "using System.Runtime.InteropServices;\n"
                  "#if UNITY_5_3_OR_NEWER\nusing UnityEngine;\n#else\nusing System.Numerics;\n#endif\n\n"
                  "namespace FeatherPhysics\n{\n" + "\n".join(parts) + "}\n")


main()
