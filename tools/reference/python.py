"""The page of Python: the package feather_physics, read by `ast`, without importing it."""

import ast
import re
from pathlib import Path

from .page import Group, Member, Section, Words, Writer

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "bindings/python/feather_physics"
# Modules of their own that programs import, with their public names
MODULES = {
    "envs": "Draws Task VectorEnv",
    "tasks": "CartPole BallOnPlate Push Walker Ragdoll",
    "scene": "Scene SceneBody SceneShape SceneMesh SceneJoint SceneFreedom SceneActuator SceneFrame SceneWarning Built",
    "urdf": "load_urdf save_urdf",
    "mjcf": "load_mjcf save_mjcf",
}
OBJECTS = "World Body Shape Joint Pool Store Asset Heightfield Hull Mesh Compound State History Worlds"
OBJECTS += " Recorder Recording Player"
PROTOCOL = {
    "__len__": "len({})",
    "__getitem__": "{}[{}]",
    "__iter__": "iter({})",
    "__contains__": "{1} in {0}",
    "__call__": "{}(...)",
}
# Records that are not called as their structs are
STRUCTS = {"Tuning": "fe_world_tuning", "Part": "fe_compound_part"}
OPENING = [
    "Every public name of `feather_physics`, with its signature and its sentences. [docs/python.md](../python.md) is "
    "the guide; begin there. Units are metres, kilograms, seconds and radians.",
    '"In C" names the functions of [include/feather.h](../../include/feather.h) that a member calls. A failed call '
    'raises a [FeatherError](#feathererror) with the library\'s sentence, and has changed nothing. "Errors" lists what '
    "is special to a member.",
    "Made by `tools/annotate` from the package's sources and the header.",
]


class Package:
    """Every module of the package, and where each name of it is defined."""

    def __init__(self):
        files = [*sorted(PACKAGE.glob("*.py")), PACKAGE / "_flat.pyi"]
        self.modules = {f.stem: with_comments(f.read_text(encoding="utf-8")) for f in files}
        self.classes = {}
        for tree in self.modules.values():
            for node in tree.body:
                if isinstance(node, ast.ClassDef):
                    self.classes.setdefault(node.name, node)

    def exported(self):
        for node in self.modules["__init__"].body:
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
                return ast.literal_eval(node.value)
        return []

    def find(self, name, module=None):
        """Where a name is defined: (module's tree, index in its body)."""
        for tree in [self.modules[module]] if module else self.modules.values():
            for at, node in enumerate(tree.body):
                if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name == name:
                    return tree, at
                if isinstance(node, (ast.Assign, ast.AnnAssign)) and targets(node) == [name]:
                    return tree, at
        return self.find(name) if module else None


def snake(name):
    return re.sub(r"(?<=[a-z0-9])([A-Z])", r"_\1", name).lower()


def targets(node):
    found = node.targets if isinstance(node, ast.Assign) else [node.target]
    return [ast.unparse(one) for one in found]


def with_comments(text):
    """The tree of a source; each assignment has the comment of its last line, or of the line above it."""
    tree, lines = ast.parse(text), text.split("\n")
    for node in ast.walk(tree):
        if isinstance(node, (ast.Assign, ast.AnnAssign)):
            behind = lines[node.end_lineno - 1].encode()[node.end_col_offset :].decode()
            above = lines[node.lineno - 2].strip()
            comment = behind.strip() or (above if above.startswith("#") else "")
            node.comment = comment.lstrip("# ") if comment.startswith("#") and "----" not in comment else ""
    return tree


def text_after(body, at):
    """The string that stands below a field, or its comment."""
    if getattr(body[at], "comment", "").startswith("type:"):
        return ""
    following = body[at + 1] if at + 1 < len(body) else None
    if isinstance(following, ast.Expr) and isinstance(following.value, ast.Constant):
        return following.value.value if isinstance(following.value.value, str) else ""
    return getattr(body[at], "comment", "")


def calls(node, functions):
    """Functions of C that a piece of the layer calls, in order."""
    found = [f"fe_{m}" for m in re.findall(r"\b_flat\.(\w+)", ast.unparse(node))]
    return [name for name in dict.fromkeys(found) if name in functions]


def shown(annotation):
    """A type as a reader says it: without the quotes of a name that is defined later."""
    return re.sub(r"['\"](\w[\w\[\], ]*)['\"]", r"\1", ast.unparse(annotation)).replace("records.", "")


def parameter_text(argument, default):
    text = argument.arg
    if argument.annotation:
        text += f": {shown(argument.annotation)}"
    if default is not None:
        text += (" = " if argument.annotation else "=") + ast.unparse(default)
    return text


def several(node):
    """Fields of one line: `force, far = 10.0, 2.4`."""
    names = [ast.unparse(each) for each in node.targets[0].elts]
    values = node.value.elts if isinstance(node.value, ast.Tuple) else [None] * len(names)
    for name, value in zip(names, values):
        signature = f"{name} = {ast.unparse(value)}" if value is not None else name
        yield Member(name, signature, node.comment, is_value=True)


def attributes(node):
    """What __init__ gives each object, with the string below it."""
    for at, one in enumerate(node.body):
        if not isinstance(one, (ast.Assign, ast.AnnAssign)):
            continue
        target = one.targets[0] if isinstance(one, ast.Assign) else one.target
        kind = shown(one.annotation) if isinstance(one, ast.AnnAssign) else ""
        for each in target.elts if isinstance(target, ast.Tuple) else [target]:
            found = re.fullmatch(r"self\.([a-z]\w*)", ast.unparse(each))
            if found:
                yield Member(found[1], found[1], text_after(node.body, at), is_value=True, kind=kind)


def arguments_of(node, skip_first):
    """(what stands between the brackets, the names of the parameters)"""
    given = node.args
    plain = [*given.posonlyargs, *given.args]
    defaults = [None] * (len(plain) - len(given.defaults)) + list(given.defaults)
    listed = list(zip(plain, defaults))[1 if skip_first else 0 :]
    parts = [parameter_text(a, d) for a, d in listed]
    if given.vararg:
        parts.append("*" + parameter_text(given.vararg, None))
    elif given.kwonlyargs:
        parts.append("*")
    parts += [parameter_text(a, d) for a, d in zip(given.kwonlyargs, given.kw_defaults)]
    if given.kwarg:
        parts.append("**" + parameter_text(given.kwarg, None))
    names = [a.arg for a, _ in listed] + [a.arg for a in given.kwonlyargs]
    return ", ".join(parts), names


def decorators(node):
    return [ast.unparse(one) for one in node.decorator_list]


class Reader:
    def __init__(self, header):
        self.package, self.functions, self.structs = Package(), header.functions, header.structs

    def function(self, node, owner=""):
        marks = decorators(node)
        inside, names = arguments_of(node, bool(owner) and "staticmethod" not in marks)
        head = "classmethod " if "classmethod" in marks else ""
        back = f" -> {shown(node.returns)}" if node.returns else ""
        signature = f"{head}{node.name}({inside}){back}"
        return Member(node.name, signature, ast.get_docstring(node) or "", calls(node, self.functions), names)

    def property(self, node, setters):
        setter = setters.get(node.name)
        back = f": {shown(node.returns)}" if node.returns else ""
        found = calls(node, self.functions) + (calls(setter, self.functions) if setter else [])
        note = "" if setter else " (read)"
        told = ast.get_docstring(node) or ""
        if not told and not found:  # of a tuple: its name says it
            return Member(node.name, node.name, is_value=True, kind=shown(node.returns))
        return Member(node.name, f"{node.name}{back}{note}", told, list(dict.fromkeys(found)))

    def attribute(self, name, node):
        """A property that a pair of functions reads and writes: Attribute or Switch, see objects.py."""
        texts = [a.value for a in node.value.args if isinstance(a, ast.Constant) and isinstance(a.value, str)]
        note = " (read)" if any(isinstance(a, ast.Constant) and a.value is None for a in node.value.args) else ""
        kind = "bool"
        if isinstance(node, ast.AnnAssign):
            kind = shown(node.annotation.slice.elts[0])
        return Member(name, f"{name}: {kind}{note}", " ".join(texts), calls(node.value, self.functions))

    def field(self, body, at):
        node = body[at]
        name = targets(node)[0]
        value = node.value
        if isinstance(value, ast.Call) and ast.unparse(value.func) in ("Attribute", "Switch"):
            return self.attribute(name, node)
        made_by = self.package.classes.get(ast.unparse(value.func)) if isinstance(value, ast.Call) else None
        if made_by and made_by.name.startswith("_"):
            return self.descriptor(name, made_by)
        signature = name + (
            f" = {ast.unparse(value)}" if value is not None and "field(" not in ast.unparse(value) else ""
        )
        kind = shown(node.annotation) if isinstance(node, ast.AnnAssign) else ""
        return Member(name, signature, text_after(body, at), is_value=True, kind=kind)

    def descriptor(self, name, node):
        """A property by a class of its own: its type is what reading it gives."""
        getters = [n for n in node.body if isinstance(n, ast.FunctionDef) and n.name == "__get__" and n.returns]
        kind = shown(getters[1 if len(getters) > 1 else 0].returns)
        return Member(name, f"{name}: {kind}", ast.get_docstring(node) or "", calls(node, self.functions))

    def protocol(self, node, owner):
        _, names = arguments_of(node, True)
        text = PROTOCOL[node.name].format(owner.lower(), *names)
        if node.returns:
            text += f" -> {shown(node.returns)}"
        return Member(node.name, text, ast.get_docstring(node) or "", calls(node, self.functions))

    def members(self, node, owner):
        made, body = {}, node.body
        setters = {n.name: n for n in body if isinstance(n, ast.FunctionDef) and f"{n.name}.setter" in decorators(n)}
        for at, one in enumerate(body):
            if isinstance(one, (ast.Assign, ast.AnnAssign)) and not targets(one)[0].startswith(("_", "(")):
                made[targets(one)[0]] = self.field(body, at)
            elif isinstance(one, ast.Assign) and isinstance(one.targets[0], ast.Tuple):
                made.update({each.name: each for each in several(one)})
            if isinstance(one, ast.FunctionDef) and one.name == "__init__":
                made.update({each.name: each for each in attributes(one) if each.name not in made})
            if not isinstance(one, ast.FunctionDef) or "overload" in decorators(one) or one in setters.values():
                continue
            if one.name in PROTOCOL:
                made[one.name] = self.protocol(one, owner)
            elif not one.name.startswith("_"):
                is_property = "property" in decorators(one)
                made[one.name] = self.property(one, setters) if is_property else self.function(one, owner)
        return made

    def family(self, node):
        """A class and those of the package that it is made from, the farthest first."""
        above = [self.package.classes[n] for n in map(ast.unparse, node.bases) if n in self.package.classes]
        return [one for base in above for one in self.family(base)] + [node]

    def group(self, name, module=None):
        tree, at = self.package.find(name, module)
        node = tree.body[at]
        told = ast.get_docstring(node) or "" if isinstance(node, (ast.ClassDef, ast.FunctionDef)) else ""
        if isinstance(node, ast.FunctionDef):
            made = self.function(node)
            return Group(name, members=[made])
        if not isinstance(node, ast.ClassDef):
            return Group(name, text_after(tree.body, at) or "An alias.", f"{name} = {shown(node.value)}")
        members = {}
        for one in self.family(node):
            for each, made in self.members(one, name).items():
                made.told = made.told or (members[each].told if each in members else "")  # as inspect.getdoc does
                members[each] = made
        struct = self.structs.get(STRUCTS.get(name) or f"fe_{snake(name)}")
        if struct and (not told or members and all(m.is_value for m in members.values())):
            self.from_struct(struct, members)
            told = told or struct.told
        return Group(name, told, self.head(node), list(members.values()))

    @staticmethod
    def from_struct(struct, members):
        """What the header says of fields of the same name."""
        said = {one.name: one.told for one in struct.fields}
        for member in members.values():
            member.told = member.told or said.get(member.name, "")

    def head(self, node):
        for one in reversed(self.family(node)):
            for inner in one.body:
                if isinstance(inner, ast.FunctionDef) and inner.name == "__init__":
                    inside, _ = arguments_of(inner, True)
                    return f"{node.name}({inside})"
        bases = [shown(b) for b in node.bases if ast.unparse(b) not in ("NamedTuple", "object")]
        return f"class {node.name}({', '.join(bases)})" if bases else ""


def sections_of(reader):
    names = reader.package.exported()
    objects = [n for n in OBJECTS.split() if n in names]
    trees = {n: reader.package.find(n) for n in names}
    nodes = {n: tree.body[at] for n, (tree, at) in trees.items()}
    rest = [n for n in names if n not in objects]
    errors = [n for n in rest if n.endswith("Error")]
    functions = [n for n in rest if isinstance(nodes[n], ast.FunctionDef)]
    records = [n for n in rest if n not in errors and n not in functions]
    found = [("Objects", objects), ("Functions", functions), ("Records and values", records), ("Errors", errors)]
    sections = [Section(title, [reader.group(n) for n in listed]) for title, listed in found]
    for module, listed in MODULES.items():
        groups = [reader.group(n, module) for n in listed.split()]
        sections.append(Section(f"`feather_physics.{module}`", groups))
    return sections


def words_of(header):
    errors = (PACKAGE / "errors.py").read_text(encoding="utf-8")
    classes = dict(re.findall(r'class (\w+)\([^)]*\):\n    """[^"]*\((FE_ERROR_\w+)\)', errors))
    by_code = {code: name for name, code in classes.items()}
    texts = {
        "fe_body_type",
        "fe_joint_type",
        "fe_combine",
        "fe_motion",
        "fe_spring",
        "fe_dof",
        "fe_simd",
        "fe_event_kind",
    }

    def enumerator(kind, item):
        front = kind.rsplit("_", 1)[0] if kind.endswith(("_type", "_kind")) else kind
        return f'"{item[len(front) + 1:].lower()}"' if kind in texts else None

    known = {f"fe_{name.lower()}": name for name in OBJECTS.split()}
    return Words(header, "None", lambda n: by_code.get(n, n), enumerator, known.get, lambda name: name)


def page(header):
    reader = Reader(header)
    sections = sections_of(reader)
    words = words_of(header)
    words.learn(sections)
    return Writer(words, lambda name: name).page("Python: reference", OPENING, sections)
