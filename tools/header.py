"""Reads include/feather.h for the tools that make something of it: its structs, enums and functions, each with the
comment that stands above it. It knows the header's own way to be written, not all of C.

Read by tools/annotate, tools/reference and tools/ops.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Dict, List

PATH = Path(__file__).resolve().parent.parent / "include/feather.h"
# Below it stand helpers for C alone
SUGAR = "// ---- sugar"


@dataclass
class Field:
    name: str
    kind: str  # its type, without const and stars
    count: int  # of an array's elements; 0: no array
    is_pointer: bool
    told: str  # its comment


@dataclass
class Struct:
    name: str
    told: str
    fields: List[Field]
    at: int  # in the header's text

    @property
    def is_sized(self):
        """May it grow?"""
        return bool(self.fields) and self.fields[0].name == "struct_size"


@dataclass
class Parameter:
    kind: str
    stars: str
    name: str
    is_const: bool

    @property
    def declared(self):
        """Its type as C has it: "const fe_body_def *"."""
        return ("const " if self.is_const else "") + self.kind + (" " + self.stars if self.stars else "")


@dataclass
class Function:
    name: str
    result: str
    parameters: List[Parameter]
    told: str
    leader: str  # the function above whose comment is of this one, too; "" where it has its own, or nobody has

    @property
    def changes_world(self):
        first = self.parameters[0] if self.parameters else None
        return bool(first) and first.declared == "fe_world *" and first.name == "world"


@dataclass
class Enumerator:
    name: str
    value: str
    told: str


@dataclass
class Enum:
    name: str
    told: str
    items: List[Enumerator]
    at: int


@dataclass
class Header:
    structs: Dict[str, Struct] = field(default_factory=dict)
    enums: Dict[str, Enum] = field(default_factory=dict)
    functions: Dict[str, Function] = field(default_factory=dict)

    @property
    def types(self):
        """Enums and structs, in the order of the header."""
        return sorted([*self.enums.values(), *self.structs.values()], key=lambda one: one.at)


def comment_above(text, at):
    """The lines of /// that end where something begins."""
    lines = []
    for line in reversed(text[:at].rstrip("\n").split("\n")):
        found = re.match(r"\s*///(?!<) ?(.*)", line)
        if not found:
            break
        lines.insert(0, found[1])
    return "\n".join(lines)


def read_fields(body):
    fields, pending, last = [], "", []
    for line in body.split("\n"):
        before = re.match(r"\s*///(?!<) ?(.*)", line)
        more = re.match(r"\s*///< ?(.*)", line)
        found = re.match(r"\s*(?:const )?(\w+) ([^;(]*);\s*(?:///< ?(.*))?", line)
        if before:
            pending = f"{pending} {before[1]}".strip()
        elif more:
            for one in last:
                one.told += " " + more[1]
        elif found:
            last = [read_declarator(one, found[1], found[3] or pending) for one in found[2].split(",")]
            fields += last
            pending = ""
    return fields


def read_declarator(text, kind, told):
    array = re.search(r"\[(\d+)\]", text)
    return Field(re.search(r"\w+", text)[0], kind, int(array[1]) if array else 0, "*" in text, told)


def read_enumerators(body):
    found = re.findall(r"^\s*(FE_\w+) = ([^,\n]+?),?[ ]*(?:///< (.*))?$", body, re.M)
    return [Enumerator(*one) for one in found if "FORCE32" not in one[0]]


def read_parameters(text):
    found = []
    for one in text.split(","):
        parts = re.match(r"(const )?(\w+) ?(\*{0,2})(?:const \*)? ?(\w+)$", re.sub(r"\s+", " ", one.strip()))
        if parts:
            found.append(Parameter(parts[2], parts[3], parts[4], bool(parts[1])))
    return found


def read_functions(text, functions):
    """A comment counts for all functions below it, up to an empty line or the next comment."""
    leader, end = "", 0
    for found in re.finditer(r"^FE_API ([\w ]+?[ *]+)(fe_\w+)\(([^)]*)\);", text, re.M):
        told, name = comment_above(text, found.start()), found[2]
        led = leader if not told and text[end : found.start()] == "\n" else ""
        functions[name] = Function(name, found[1].strip(), read_parameters(found[3]), told, led)
        leader, end = name if told else led, found.end()


def read(path=PATH):
    text = path.read_text(encoding="utf-8").split(SUGAR)[0]
    header = Header()
    for found in re.finditer(r"^typedef (struct|enum) (fe_\w+) \{(.*?)\n\} \2;", text, re.M | re.S):
        told = comment_above(text, found.start())
        if found[1] == "enum":
            header.enums[found[2]] = Enum(found[2], told, read_enumerators(found[3]), found.start())
        else:
            header.structs[found[2]] = Struct(found[2], told, read_fields(found[3]), found.start())
    read_functions(text, header.functions)
    return header
