"""The page of JavaScript: the types that feather-physics ships. Those of bindings/js/src are written by hand; those
that bindings/js/generate.mjs makes of the header are kept in bindings/js/library/api.d.ts: the page needs no node.
"""

import re
import shutil
import subprocess
from pathlib import Path

from .braces import statements
from .page import Group, Member, Section, Words, Writer, split_comment

ROOT = Path(__file__).resolve().parents[2]
LAYER = ROOT / "bindings/js"
TYPES = LAYER / "library/api.d.ts"
OBJECTS = "World Body Shape Joint Bodies Store Asset Hull Heightfield Mesh Compound State History Batch BatchArray"
OBJECTS += " Recorder Player"
OPENING = [
    "Every public name of `feather-physics`, with its signature and its sentences. [docs/javascript.md]"
    "(../javascript.md) is the guide; begin there. Units are metres, kilograms, seconds and radians. The package's "
    "types have the same sentences for your editor.",
    '"In C" names the functions of [include/feather.h](../../include/feather.h) that a member calls. A failed call '
    'throws a [FeatherError](#feathererror) with the library\'s sentence, and has changed nothing. "Errors" lists '
    "what is special to a member, by the error's `code`.",
    "Made by `tools/annotate` from `bindings/js` and the header.",
]
JOINTS = "distance ball hinge fixed configurable rope slider wheel motor".split()
ENTRIES = {"threads": "`feather-physics/threads`", "three": "`feather-physics/three`"}


def types_text():
    """What generate.mjs makes of the header: by node where it is there, else as it is kept."""
    node = shutil.which("node")
    if not node:
        return TYPES.read_text(encoding="utf-8")
    command = [node, str(LAYER / "generate.mjs"), str(ROOT / "include/feather.h"), "--types"]
    return subprocess.run(command, check=True, capture_output=True, text=True, encoding="utf-8").stdout


class Type:
    def __init__(self, name):
        self.name, self.head, self.told, self.bases, self.members, self.kind = name, "", "", [], [], ""


def snake(name):
    return re.sub(r"([A-Z])", r"_\1", name).lower().lstrip("_")


def camel(name):
    return re.sub(r"_([a-z0-9])", lambda m: m[1].upper(), name)


def has_body(head):
    return bool(re.match(r"(export )?(default )?(declare )?(abstract )?(class|interface) ", head.strip()))


class Reader:
    def __init__(self, header):
        self.functions, self.types = header.functions, {}
        self.by_hand = hand_calls(self.functions)

    def read(self, text):
        for comment, head, body in statements(text, has_body):
            found = re.match(
                r"(?:export )?(?:default )?(?:declare )?(class|interface|type|const|function) (\w+)(.*)", head
            )
            if found and "export" in head:
                self.declaration(comment, found[1], found[2], head, found[3], body)

    def declaration(self, comment, kind, name, head, rest, body):
        made = self.types.setdefault(name, Type(name))
        made.told = made.told or split_comment(comment)[0]
        made.kind = "class" if "class" in (kind, made.kind) else kind
        if kind in ("class", "interface"):
            bases = re.search(r"extends (.*)", rest)
            made.bases += re.findall(r"\b[A-Z]\w+", re.sub(r"<.*>", "", bases[1])) if bases else []
            for one in statements(body, lambda head: False):
                self.member(made, *one[:2])
        elif not made.head:
            made.head = re.sub(r"^export (default |declare )*", "", head)
            made.members = [] if kind != "function" else made.members
        else:
            made.head += f"`** and **`{re.sub(r'^export ', '', head)}" if kind != "function" else ""

    def member(self, made, comment, head):
        if not head or head.startswith("private "):
            return
        told, described, _ = split_comment(comment)
        found = re.match(r"(?:static |readonly |get |set |abstract )*(?:\[Symbol\.(\w+)\]|(\w+))", head)
        if not found:
            return
        name = found[2] or f"[Symbol.{found[1]}]"
        calls = self.calls(made.name, name)
        is_field = not re.match(r"(static |get |set )*[\w.\[\]]+\??(<.*>)?\(", head)
        head = head.replace("constructor(", f"new {made.name}(") if name == "constructor" else head
        accessor = re.match(r"(get|set) \w+\((.*?)\)(?:: (.*))?$", head)
        if accessor:
            self.accessor(made, name, accessor, told, calls)
            return
        value = is_field and made.kind == "interface"
        signature, kind = re.sub(r"^readonly ", "", head), ""
        if is_field:
            label, _, kind = signature.partition(": ")
            signature = label if value else f"{signature} (read)" if head.startswith("readonly") else signature
        names = re.findall(r"(\w+)\??: ", head.partition("(")[2])
        made.members.append(Member(name, signature, told, calls, names, described, value, kind if value else ""))

    @staticmethod
    def accessor(made, name, accessor, told, calls):
        """A property: its getter and its setter stand one behind the other."""
        way, given, back = accessor.groups()
        old = next((m for m in made.members if m.name == name), None)
        if old is None:
            kind = back if way == "get" else given.partition(": ")[2]
            made.members.append(Member(name, f"{name}: {kind} ({'read' if way == 'get' else 'set'})", told, calls))
            return
        kind = old.signature.partition(": ")[2].rsplit(" (", 1)[0]
        kind, given = (back, kind) if way == "get" else (kind, given.partition(": ")[2])
        old.signature = f"{name}: {kind}" + (f" (set: {given})" if given and given != kind else "")
        old.told = old.told or told

    def calls(self, owner, name):
        """Functions of C: those of the code that is written by hand, else by the rule of generate.mjs."""
        if (owner, name) in self.by_hand:
            return self.by_hand[owner, name]
        kind, method = snake(owner.replace("Calls", "")), snake(name)
        joint = re.fullmatch(r"(add|create|set|get)_(%s)(?:_joint)?(_target)?" % "|".join(JOINTS), method)
        tried = [f"fe_{kind}_{method}", f"fe_{kind}_get_{method}", f"fe_{kind}_set_{method}"]
        if joint and kind in ("world", "joint"):
            front = f"fe_{joint[2]}_joint_"
            tried = [front + "def_at", front + "create"] if joint[1] == "add" else [front + joint[1] + (joint[3] or "")]
        if kind == "joint" and method in JOINTS:
            tried = [f"fe_{method}_joint_get", f"fe_{method}_joint_set"]
        return [one for one in tried if one in self.functions]


def hand_calls(functions):
    """(class, method): functions of C that the sources written by hand call, also by a private method."""
    found, private = {}, {}
    for file in sorted((LAYER / "src").glob("*.js")):
        owner = name = ""
        for line in file.read_text(encoding="utf-8").split("\n"):
            opened = re.match(r"export class (\w+)", line)
            method = re.match(r"    (?:static |get |set )?(#?\w+|\[dispose\])\(.*\{", line)
            outside = re.match(r"export (?:function|const) (\w+)", line)
            owner = opened[1] if opened else "" if outside else owner
            name = outside[1] if outside else method[1] if method else name
            calls = [
                one for one in re.findall(r"\bx\.(fe_\w+)", line) if one in functions and not one.endswith("_init")
            ]
            for called in re.findall(r"\bthis\.(#\w+)\(", line):
                private.setdefault((owner, name), set()).add((owner, called))
            if calls:
                listed = found.setdefault((owner, name), [])
                listed += [one for one in dict.fromkeys(calls) if one not in listed]
    for method, helpers in private.items():
        behind = [one for helper in sorted(helpers) for one in found.get(helper, [])]
        found[method] = list(dict.fromkeys(found.get(method, []) + behind))
    return found


# ---- the page -------------------------------------------------------------------------------------------------------


def family(types, name):
    one = types.get(name)
    return [base for above in one.bases for base in family(types, above)] + [one] if one else []


def words_group(one, enum, told):
    """Words that stand for the enumerators of C."""
    front = re.sub(r"_(type|kind|flags)$", "", enum.name).upper() + "_"
    rows = []
    for item in enum.items:
        short = item.name[len(front) :] if item.name.startswith(front) else item.name[3:]
        rows.append(Member(item.name, f"'{camel(short.lower())}'", item.told, is_value=True))
    return Group(one.name, told or enum.told or "Words for what C has as numbers.", one.head, rows)


def group_of(types, name, functions, enums):
    one, members = types[name], {}
    for each in family(types, name):
        for member in each.members:
            members[member.name] = member
    told = one.told or next((each.told for each in reversed(family(types, name)) if each.told), "")
    head = one.head
    if enums.get(f"fe_{snake(name)}") and one.kind in ("type", "const"):
        return words_group(one, enums[f"fe_{snake(name)}"], told)
    if head.startswith("function "):
        called = functions.get(("", name), [])
        return Group(name, members=[Member(name, re.sub(r"^function ", "", head), told, called)])
    if not head and one.bases and one.kind == "class":
        shown = [base for base in one.bases if not base.endswith("Calls")]
        head = f"class {name} extends {', '.join(shown)}" if shown else ""
    first = [m for m in members.values() if m.name == "constructor"]
    return Group(name, told, head, first + [m for m in members.values() if m not in first])


def enums_of(header):
    """By the name that generate.mjs gives them."""
    return {f"fe_{snake(camel('_' + name[3:]))}": enum for name, enum in header.enums.items()}


def sections_of(header, text):
    reader = Reader(header)
    reader.read(text)
    reader.read((LAYER / "src/index.d.ts").read_text(encoding="utf-8"))
    types = reader.types
    names = [n for n in types if not n.endswith("Calls") and n not in ("Feather",)]
    objects = [n for n in OBJECTS.split() if n in names]
    rest = [n for n in names if n not in objects and n != "FeatherError"]
    functions = sorted(n for n in rest if types[n].head.startswith("function "))
    options = sorted(n for n in rest if n.endswith("Options"))
    words = sorted(n for n in rest if types[n].kind in ("type", "const"))
    records = sorted(n for n in rest if n not in functions and n not in options and n not in words)
    found = [
        ("Objects", objects),
        ("Functions", functions),
        ("Options", options),
        ("Records", records),
        ("Words and types", words),
        ("Errors", ["FeatherError"]),
    ]
    sections = [
        Section(title, [group_of(types, n, reader.by_hand, enums_of(header)) for n in listed])
        for title, listed in found
    ]
    sections.insert(0, Section("Module", [module_group()]))
    return sections + [entry_section(header, entry, title) for entry, title in ENTRIES.items()]


def module_group():
    told = (
        '`import Feather from "feather-physics"`, then `const { World } = await Feather()`: what is below is in the '
        "module that it gives."
    )
    made = [
        Member("Feather", "Feather(source?): Promise<FeatherModule>", "Loads the module, once."),
        Member("Feather.sync", "Feather.sync(source?): FeatherModule", "The same at once, from bytes or a module."),
    ]
    return Group("Feather", told, "", made)


def entry_section(header, entry, title):
    reader = Reader(header)
    reader.read((LAYER / f"src/{entry}.d.ts").read_text(encoding="utf-8"))
    groups = [group_of(reader.types, name, reader.by_hand, {}) for name in reader.types]
    for group in groups:
        if group.name == "Feather":
            group.name = "Feather of threads"
    return Section(title, groups)


def words_of(header):
    def enumerator(kind, item):
        front = re.sub(r"_(type|kind|flags)$", "", kind).upper() + "_"
        short = item[len(front) :] if item.startswith(front) else item[3:]
        return f"'{camel(short.lower())}'" if kind != "fe_result" else None

    def type_name(name):
        return name[3:4].upper() + camel(name[4:]) if name in header.structs or name in header.enums else None

    return Words(header, "null", lambda name: name, enumerator, type_name, camel)


def page(header, text):
    sections = sections_of(header, text)
    words = words_of(header)
    words.learn(sections)
    return Writer(words, snake).page("JavaScript: reference", OPENING, sections)
