"""What editors read of the Lua layer (LuaLS, EmmyLua): its classes and methods with their types, and the tables of
options with the fields of feather.h. Names are those of bindings/lua/feather; sentences are its comments, else the
header's. The page of Lua (lua.py) is made of the same.
"""

import re
from pathlib import Path

import header

ROOT = Path(__file__).resolve().parents[2]
HEADER = header.read()
FUNCTIONS = HEADER.functions
LAYER = ROOT / "bindings/lua/feather"
# Of fields that hold bits by axis, the layer takes letters: "xz"
AXIS_LETTERS = set(re.findall(r"(\w+) = AXIS_LETTERS", (LAYER / "options.lua").read_text()))
CLASSES = "World Body Shape Joint Store Pool Hull Mesh Heightfield Compound History".split()
CLASSES += "Recorder Recording Player State Batch".split()

# Lua's values for a value of C
SPREAD = {
    "fe_vec3": ["number"] * 3,
    "fe_dvec3": ["number"] * 3,
    "fe_quat": ["number"] * 4,
    "fe_transform": ["number"] * 7,
    "fe_bounds": ["number"] * 6,
}
LETTERS = {3: "xyz", 4: "xyzw"}
NUMBERS = {"float": "number", "double": "number"}
INTEGERS = {"int32_t", "uint32_t", "int64_t", "uint64_t", "uint8_t", "uint16_t"}
OBJECTS = {"fe_body": "Body", "fe_shape": "Shape", "fe_joint": "Joint"}
# The tables of options, by what takes them; more keys than the definition's, with their types
TRANSFORM = {"position": "number[]", "rotation": "number[]", "userData": "any"}
OPTIONS = {
    "WorldOptions": (
        "fe_world_def",
        {"workers": "integer", "pool": "feather.Pool", "store": "feather.Store", "userData": "any"},
    ),
    "BodyOptions": ("fe_body_def", {**TRANSFORM, "locks": "string[]"}),
    "ShapeOptions": ("fe_shape_def", {**TRANSFORM, "friction": "number", "restitution": "number"}),
    "QueryFilter": ("fe_query_filter", {"exclude": "feather.Body|feather.Body[]"}),
    "Tuning": ("fe_world_tuning", {}),
    "MassData": ("fe_mass_data", {}),
    "JointState": ("fe_joint_state", {}),
    "Counters": ("fe_counters", {}),
    "Profile": ("fe_profile", {}),
    "HullInfo": ("fe_hull_info", {}),
    "MeshInfo": ("fe_mesh_info", {}),
    "CompoundInfo": ("fe_compound_info", {}),
    "PlayerInfo": ("fe_player_info", {}),
}
GIVEN = {
    "newWorld": "WorldOptions",
    "clone": "WorldOptions",
    "loadWorld": "WorldOptions",
    "newBody": "BodyOptions",
    "setTuning": "Tuning",
}
QUERIES = "rayCast rayCastAny rayCastAll rayCastMany sweepMany overlap overlapAny overlapShapes overlapBounds".split()
GIVEN.update({name: "QueryFilter" for name in QUERIES + ["closestPoint"]})
SHAPES = "Shape Sphere Capsule Box Cylinder Cone Plane Hull Mesh Heightfield Compound".split()
RETURNS = {
    "getLocks": ["string", "string"],
    "getTuning": "feather.Tuning",
    "getMassData": "feather.MassData",
    "getCounters": "feather.Counters",
    "getProfile": "feather.Profile",
    "Joint:getState": "feather.JointState",
    "getShapes": "feather.Shape[]",
    "getJoints": "feather.Joint[]",
    "World:getBodies": "feather.Body[]",
    "Hull:getInfo": "feather.HullInfo",
    "Mesh:getInfo": "feather.MeshInfo",
    "Compound:getInfo": "feather.CompoundInfo",
    "Player:getInfo": "feather.PlayerInfo",
    "getWorld": "feather.World",
    "getStore": "feather.Store",
    "getHash": "string",
    "getEnergy": ["number", "number"],
    "getMoved": ["feather.Body[]", "number[]"],
    "World:getTransforms": "number[]",
    "getExactTransforms": "number[]",
    "getVelocities": "number[]",
    "getJointCoordinates": "number[]",
    "getJointReactions": "number[]",
    "getUserData": "any",
    "getBodyIds": "integer[]",
    "clone": "feather.World",
    "save": "string",
    "getType": "string",
    "World:load": "feather.Hull|feather.Mesh|feather.Heightfield|feather.Compound",
}


SPOT = [("x", "number"), ("y", "number"), ("z", "number")]
RAY = SPOT + [("dx", "number"), ("dy", "number"), ("dz", "number")]
AT = SPOT + [("px?", "number"), ("py?", "number"), ("pz?", "number")]
# What the layer makes in other ways than by `function Class:method`: parameters, what comes back, a sentence
ALSO = {
    "Body": {
        "applyForce": (AT, [], "N, until the next step ends: at the centre of mass, or at a point of the world."),
        "applyImpulse": (AT, [], "N s: at the centre of mass, or at a point of the world."),
        "getPosition": ([], ["number"] * 3, "Of the body's origin, m."),
        "getRotation": ([], ["number"] * 4, "x, y, z, w."),
    }
}
for owner in ("Body", "Shape"):
    ALSO.setdefault(owner, {}).update(
        closestPoint=(SPOT, ["any"], "The point of its surface that is closest to a place."),
        rayCast=(RAY, ["any"], "Where a ray from a place along a vector meets it; nil where it does not."),
        getContacts=([], ["table[]"], "What touches it."),
    )
ALSO["World"] = {
    "drawArray": (
        [("kind", "string"), ("given?", "table"), ("array?", "any")],
        ["any", "integer"],
        "LuaJIT alone: what the other draw methods give, in an array of the ffi.",
    )
}
for owner in ("Hull", "Mesh", "Heightfield", "Compound"):
    ALSO[owner] = {
        "destroy": ([], [], "The handle dies at once, what it names with its last shape."),
        "getKey": ([], ["string"], "What it is known by outside its store: equal where the content is."),
        "getStore": ([], ["feather.Store"], "The store that it is in."),
        "isDestroyed": ([], ["boolean"], "True once it is destroyed, or its store."),
        "save": ([], ["string"], "As bytes, for store:load."),
    }
TOLD = {
    "World": "Everything that can touch each other.",
    "Body": "A rigid body. As an end of a joint nil is the world itself.",
    "Shape": "A form on a body, with material and filters.",
    "Joint": "A joint of two bodies, or of one and the world.",
    "Store": "Assets that several worlds may share.",
    "Pool": "Worker threads that several worlds may share.",
    "Hull": "A convex hull: an asset of a store.",
    "Mesh": "Triangles of any form: an asset of a store.",
    "Heightfield": "Terrain: an asset of a store.",
    "Compound": "A form of many parts: an asset of a store.",
    "History": "The last frames of a world, to go back to.",
    "Recorder": "A recording of a world while it grows, read as strings.",
    "Recording": "A recording of a world that goes to a file.",
    "Player": "A world that does what a recording says.",
    "State": "What a world was, for any world of the same store.",
    "Batch": "Many worlds, made from one, that step together.",
}
# What the module's functions return
BACK = {
    "newWorld": "feather.World",
    "newPool": "feather.Pool",
    "newStore": "feather.Store",
    "newPlayer": "feather.Player",
    "loadWorld": "feather.World",
    "checkSnapshot": "table",
    "getSnapshotAssets": "string[]",
    "compareSnapshots": "table|nil",
}
# Parameters, by what the layer calls them
NUMBER_NAMES = set("dt seconds mass speed distance fraction hertz".split())
INTEGER_NAMES = set("count steps step frame number layer mask group row column rows columns index".split())
# What objects.life makes; user data is Lua's own, the library's is the tag
LIFE = (
    ("isDestroyed", [], "True once it is destroyed, or its world."),
    ("destroy", [], ""),
    ("getWorld", [], "The world that it belongs to."),
    ("setUserData", ["value"], "Any value of yours; getUserData returns it."),
    ("getUserData", [], "What setUserData or the table of options gave; nil at first."),
)
# Joints: the definition that the options fill, and what they name besides
ENDS = {"bodyA": "feather.Body|nil", "bodyB": "feather.Body|nil", "userData": "any"}
PLACES = {name: "number[]" for name in ("pointA", "pointB", "point", "axis", "up")}


def snake(name):
    return re.sub(r"(?<=[a-z0-9])([A-Z])", r"_\1", name).lower()


def camel(name):
    return re.sub(r"_([a-z0-9])", lambda m: m[1].upper(), name)


def told_of(one):
    """A field's sentences, for a layer that takes letters where C takes bits."""
    return 'letters of "xyz": ' + re.sub(r"^FE_AXIS_X \| \.\.\.: ", "", one.told) if one.name in AXIS_LETTERS else one.told


def field_type(name, kind, is_list, told):
    if is_list or kind in SPREAD:
        return "number[]"
    if kind in NUMBERS:
        return "number"
    if kind in ("fe_handle", "fe_asset") or kind in OBJECTS:
        return "integer"
    if kind in INTEGERS:
        if name in AXIS_LETTERS:
            return "string"
        if re.search(r"enabled$|^(awake|trigger|bullet|sleep_allowed|pair_filter|collide_connected|one_way)$", name):
            return "boolean"
        return "integer|string|string[]" if re.search(r"\bfe_\w+\b|\bFE_[A-Z]", told) else "integer"
    return "table"


def sentence(text):
    """The first sentence, without what only C has."""
    text = re.sub(r"\s+", " ", re.split(r"@(?:param|return)", text)[0]).strip()
    end = re.search(r"(?<=[^.])\.(?= [A-Z]|$)", text)
    return text[: end.end()] if end else text


# ---- the layer


def comment_before(lines, at):
    told = []
    for above in reversed(lines[:at]):
        if not above.startswith("-- ") or above.startswith("-- ----"):
            break
        told.insert(0, above[3:])
    return " ".join(told)


def core_calls(lines, at):
    """Functions of C that the function which begins at a line calls, in order."""
    end = at
    while not re.search(r"\bend$", lines[at] if end == at else "") and not re.match(r"end\b", lines[end]):
        end += 1
    found = [f"fe_{name}" for name in re.findall(r"\bcore\.(\w+)", "\n".join(lines[at : end + 1]))]
    return [name for name in dict.fromkeys(found) if name in FUNCTIONS]


def guessed(owner, method):
    """The functions of C that a method calls which is made in another way: by its name."""
    name = snake(method).replace("ray_cast", "raycast").replace("apply_", "add_")
    joint = re.fullmatch(r"new_(\w+)_joint", name)
    if joint:
        kind = {"rope": "distance", "slider": "configurable", "wheel": "configurable", "motor": "configurable"}
        return [f"fe_{kind.get(joint[1], joint[1])}_joint_create"]
    tried = [f"fe_{owner.lower()}_{name}", f"fe_{owner.lower()}_{name}_at"]
    if owner in ("Hull", "Mesh", "Heightfield", "Compound"):
        tried.append(f"fe_asset_{name}")
    return [name for name in tried if name in FUNCTIONS]


def life_calls(owner, method):
    called = {"destroy": "destroy", "isDestroyed": "is_valid"}.get(method)
    return [f"fe_{owner.lower()}_{called}"] if called else []


def read_methods():
    """class -> method -> (parameters, sentence, its namesake of C or None, all functions of C that it calls)"""
    methods = {name: {} for name in CLASSES}
    for file in sorted(LAYER.glob("*.lua")):
        if file.name.startswith("ffi") or file.name in ("objects.lua", "options.lua"):
            continue
        text = file.read_text()
        read_accessors(text, methods)
        for name in re.findall(r"objects\.life\((\w+)", text):
            for method, names, told in LIFE:
                methods[name].setdefault(method, (names, told, None, life_calls(name, method)))
        read_written(text.split("\n"), methods)
        read_constructors(text)
    return methods


def read_accessors(text, methods):
    """Getters and setters that objects.lua makes of the names of functions."""
    for kind, name, names in re.findall(r"objects\.(accessors|switches)\((\w+), \"\w+\", \{(.*?)\}\)", text, re.S):
        for method, of in re.findall(r"(\w+) = \"(\w+)\"", names):
            get, put = f"fe_{name.lower()}_get_{of}", f"fe_{name.lower()}_set_{of}"
            if kind == "switches":
                methods[name]["is" + method] = ([], "", get, [get])
                methods[name]["set" + method] = (["value"], "", put, [put])
                continue
            if get in FUNCTIONS:
                methods[name]["get" + method] = ([], "", get, [get])
            if put in FUNCTIONS:
                methods[name]["set" + method] = (None, "", put, [put])


def read_written(lines, methods):
    """Methods that are written out."""
    for i, line in enumerate(lines):
        found = re.match(r"function (\w+):(\w+)\(([^)]*)\)", line)
        if not found or found[1] not in methods:
            continue
        of = f"fe_{found[1].lower()}_{snake(found[2])}"
        names = [name.strip() for name in found[3].split(",") if name.strip()]
        called = sorted(core_calls(lines, i), key=lambda one: one != of)  # its namesake speaks first
        made = (names, comment_before(lines, i), of if of in FUNCTIONS else None, called)
        methods[found[1]][found[2]] = made


def read_constructors(text):
    """Those of joints, and the tables that they take."""
    for name, kind, places in re.findall(r"World\.new(\w+)Joint = constructor\(\"(\w+)\", \"([\w ]+)\"", text):
        extra = {**ENDS, **{place: PLACES.get(place, "number") for place in places.split()}}
        OPTIONS[f"{name}JointOptions"] = (f"fe_{kind}_joint_def", extra)
        given = [("given", f"feather.{name}JointOptions")]
        ALSO.setdefault("World", {})[f"new{name}Joint"] = (given, ["feather.Joint"], "")


def read_module():
    """name -> (parameters, what comes back, sentence, functions of C) of the functions that the module has."""
    texts, made = [f.read_text(encoding="utf-8") for f in sorted(LAYER.glob("*.lua"))], {}
    for name, local, function in re.findall(r"^    (\w+) = (\w+)\.(\w+),$", (LAYER / "init.lua").read_text(), re.M):
        for lines in (text.split("\n") for text in texts):
            for i, line in enumerate(lines):
                found = re.match(rf"function {local}\.{function}\((.*?)\)", line)
                if found:
                    given = [module_parameter(name, one.strip()) for one in found[1].split(",") if one.strip()]
                    made[name] = (given, [BACK[name]], comment_before(lines, i), core_calls(lines, i))
    return made


def module_parameter(function, name):
    if name == "given":
        return ("given?", "feather.WorldOptions" if "World" in function else "table")
    return (name, {"bytes": "string", "workers": "integer"}.get(name, "string" if "Snapshots" in function else "any"))


def c_values(kind, name):
    """What a parameter of C is in Lua: names and types."""
    if kind in SPREAD:
        types = SPREAD[kind]
        letters = LETTERS.get(len(types))
        return [(letters[k] if letters else f"{name}{k + 1}", t) for k, t in enumerate(types)]
    if kind in NUMBERS:
        return [(name, "number")]
    if kind in OBJECTS:
        return [(name, f"feather.{OBJECTS[kind]}")]
    return [(name, "integer" if kind in INTEGERS else "table")]


def parameters_of(owner, method, names, of):
    if names is None:  # handed through
        result = []
        for one in FUNCTIONS[of].parameters:
            if one.kind not in ("fe_world", "fe_" + owner.lower(), "fe_store") and not one.name.startswith("out_"):
                result += c_values(one.kind, camel(one.name))
        return result
    return [parameter_of(owner, method, name) for name in names]


def parameter_of(owner, method, name):
    """(name, type), by what the layer calls it"""
    if name == "given":
        options = GIVEN.get(method) or ("ShapeOptions" if owner == "Body" and method[3:] in SHAPES else None)
        return ("given?", f"feather.{options}" if options else "table")
    if re.match(r"^([xyzw]|[dpn][xyz]|\w*_[xyz]|q[xyzw])$", name) or name in NUMBER_NAMES:
        return (name, "number")
    if name in INTEGER_NAMES:
        may_lack = method in ("step", "setFilter") and name in ("steps", "group", "mask") and owner != "Shape"
        return (name + "?" * may_lack, "any" if owner == "Batch" and name == "mask" else "integer")
    if name in ("bytes", "path", "text", "name"):
        return (name, "string")
    if name in ("bodies", "joints"):
        return (name, f"feather.{'Body' if name == 'bodies' else 'Joint'}[]")
    if name in ("bodyA", "bodyB", "body", "a", "b") and owner == "World":
        return (name, "feather.Body|nil")
    if name in ("state", "hull", "mesh", "compound", "heightfield"):
        return (name, f"feather.{name.capitalize()}")
    return (name, "any")


def returns_of(owner, method, of):
    known = RETURNS.get(f"{owner}:{method}") or RETURNS.get(method)
    if known:
        return known if isinstance(known, list) else [known]
    if method.startswith("is"):
        return ["boolean"]
    if method.startswith("new"):
        what = method[3:]
        if owner == "Body" and what in SHAPES:
            return ["feather.Shape"]
        return (
            [f"feather.{'Joint' if what.endswith('Joint') else what}"]
            if what in CLASSES or what.endswith("Joint")
            else ["any"]
        )
    if method.startswith(("set", "apply", "destroy", "close", "ignore", "optimize")):
        return []
    if of and of.startswith(("fe_body_get", "fe_shape_get", "fe_joint_get", "fe_world_get")):
        types = [
            t
            for one in FUNCTIONS[of].parameters
            if one.name.startswith("out_")
            for _, t in c_values(one.kind, one.name)
        ]
        return types or ["any"]
    return ["any"]


def wrapped(text, indent="---"):
    lines, line = [], indent
    for word in text.split():
        if len(line) + 1 + len(word) > 118 and line != indent:
            lines.append(line)
            line = indent
        line += (" " if line != indent else "") + word
    return lines + [line] if line != indent else lines


def method_text(owner, method, parameters, back, told):
    lines = wrapped(told)
    for name, kind in parameters:
        lines.append(f"---@param {name} {kind}")
    for kind in back:
        lines.append(f"---@return {kind}")
    inner = ", ".join(name.rstrip("?") for name, _ in parameters)
    return lines + [f"function {owner}{':' if owner != 'feather' else '.'}{method}({inner}) end", ""]


def is_definition(struct):
    return struct.endswith(("_def", "_filter"))


def fields_of(struct, extra):
    """The fields that a table of options may have, but for those that are named otherwise."""
    for one in HEADER.structs[struct].fields:
        hidden = one.name in ("struct_size", "worker_count", "body_a", "body_b") or one.name.startswith("reserved")
        counts = one.name.endswith("_count") and is_definition(struct)
        if not hidden and not counts and camel(one.name) not in extra:
            if not one.kind.startswith("fe_") or one.kind in SPREAD:
                yield one


def options_text(name, struct, extra):
    lines = [f"---@class feather.{name}"] + [f"---@field {key}? {kind}" for key, kind in extra.items()]
    for one in fields_of(struct, extra):
        kind = field_type(one.name, one.kind, one.is_pointer or one.count > 0, one.told)
        head, short = f"---@field {camel(one.name)}? {kind}", sentence(told_of(one))
        lines.append(f"{head} {short}" if short and len(head) + len(short) < 118 else head)
    return lines + [""]


def said(told, called):
    """The layer's sentence, else the first that C has."""
    return told or next(filter(None, (sentence(FUNCTIONS[one].told) for one in called)), "")


def class_text(owner, methods):
    made = dict(ALSO.get(owner, {}))
    for method, (names, told, of, called) in methods.items():
        parameters, back = parameters_of(owner, method, names, of), returns_of(owner, method, of)
        made[method] = (parameters, back, said(told, called))
    lines = [f"---{TOLD[owner]}", f"---@class feather.{owner}", f"local {owner} = {{}}", ""]
    return lines + [line for method in sorted(made) for line in method_text(owner, method, *made[method])]


def text():
    methods = read_methods()
    lines = [
        "---@meta feather",
        "-- Made from bindings/lua/feather and include/feather.h by tools/annotate. No program loads it.",
        "",
    ]
    for name, of in OPTIONS.items():
        lines += options_text(name, *of)
    for owner in CLASSES:
        lines += class_text(owner, methods[owner])
    lines += ["---@class feather", "---@field VERSION string", "local feather = {}", ""]
    for name, (parameters, back, told, called) in read_module().items():
        lines += method_text("feather", name, parameters, back, said(told, called))
    return "\n".join(lines + ["return feather", ""])
