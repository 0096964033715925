"""The page of C#: FeatherPhysics, from its sources and from what bindings/csharp/records.py makes of the header."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from .braces import statements
from .page import Group, Member, Section, Words, Writer

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "bindings/csharp/FeatherPhysics"
RECORDS = ROOT / "bindings/csharp/records.py"
HEADER = ROOT / "include/feather.h"
OBJECTS = "World Body Shape Joint Geometry Pool Store Asset Heightfield ConvexHull TriangleMesh Compound State History"
OBJECTS += " Batch BatchArray Recorder Recording Player Snapshot"
MODIFIERS = (
    "static readonly sealed override virtual abstract unsafe const partial new extern implicit explicit ref".split()
)
# What every value has: named in a line of their own
COMMON = {"Equals", "GetHashCode", "ToString", "operator ==", "operator !="}
OPENING = [
    "Every public name of `FeatherPhysics`, with its signature and its sentences. [docs/csharp.md](../csharp.md) is "
    "the guide; begin there. Units are metres, kilograms, seconds and radians. The package's XML file has the same "
    "sentences for your editor.",
    '"In C" names the functions of [include/feather.h](../../include/feather.h) that a member calls. A failed call '
    'throws a [FeatherException](#featherexception) with the library\'s sentence, and has changed nothing. "Errors" '
    "lists what is special to a member.",
    "Made by `tools/annotate` from the sources and the header.",
]


def without_unity(text):
    """What .NET compiles of #if ... #else ... #endif: no condition of these sources holds there."""
    text = re.sub(
        r"^\s*#if .*?\n(.*?)^\s*#endif",
        lambda m: re.split(r"^\s*#else.*\n", m[1], flags=re.M)[-1] if "#else" in m[1] else "",
        text,
        flags=re.M | re.S,
    )
    return re.sub(r"^\s*#.*\n", "", text, flags=re.M)


def has_body(head):
    while re.search(r"\([^()]*\)", head):
        head = re.sub(r"\([^()]*\)", "", head)
    return "operator" in head or not re.search(r"(?<![=!<>])=(?!=)", head)


def without_attributes(head):
    while head.startswith("["):
        depth = 0
        for at, letter in enumerate(head):
            depth += {"[": 1, "]": -1}.get(letter, 0)
            if depth == 0:
                break
        head = head[at + 1 :].strip()
    return head


def told_of(comment):
    """(summary, {parameter: sentence})"""
    text = " ".join(comment.split())
    text = re.sub(
        r'<(?:see|seealso|paramref|typeparamref) (?:cref|name|langword) ?= ?"(?:\w:)?([^"]*)" ?/>', r"`\1`", text
    )
    text = re.sub(r"<c>(.*?)</c>", r"`\1`", text)
    summary = re.search(r"<summary>(.*?)</summary>", text)
    parameters = dict(re.findall(r'<param name="(\w+)">(.*?)</param>', text))
    extra = re.findall(r"<(?:returns|remarks|value|exception[^>]*)>(.*?)</", text)
    told = " ".join([summary[1].strip() if summary else "", *extra]).strip()
    return unescaped(told), {name: unescaped(one) for name, one in parameters.items()}


def unescaped(text):
    return text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&").strip()


class Type:
    def __init__(self, name, kind):
        self.name, self.kind, self.head, self.told, self.described, self.members = name, kind, "", "", {}, []
        self.parameters = []


class Reader:
    def __init__(self, header):
        self.functions, self.types = header.functions, {}

    def read(self, text):
        for _, head, body in statements(without_unity(text), has_body):
            if head.startswith("namespace") or "namespace " in head:
                for one in statements(body, has_body):
                    self.type(*one, "")

    def type(self, comment, head, body, outer):
        head = without_attributes(head)
        found = re.match(r"((?:\w+ )*?)(class|struct|enum|interface|delegate) (.*)", head)
        if not found or "public" not in found[1].split():
            return
        name = re.match(r"\w+", found[3])[0] if found[2] != "delegate" else re.search(r"(\w+)(?=[<(])", found[3])[0]
        kind = self.types.setdefault(outer + name, Type(outer + name, found[2]))
        told, described = told_of(comment)
        kind.told, kind.described = kind.told or told, described
        if found[2] == "delegate":
            kind.head, kind.parameters = signature_of(head), names_of(head)
        elif found[2] == "enum":
            kind.members += enumerators(body)
        else:
            heads = [w for w in found[1].split() if w in ("static", "readonly", "sealed", "abstract")]
            kind.head = max(kind.head, " ".join([*heads, found[2], found[3]]), key=len)
            for one in statements(body, has_body):
                self.member(kind, *one)

    def member(self, kind, comment, head, body):
        head = without_attributes(head)
        if re.search(r"^(?:\w+ )*(class|struct|enum|interface|delegate) ", head):
            return self.type(comment, head, body, kind.name + ".")
        if not (head.startswith("public ") or kind.kind == "interface"):
            return None
        told, described = told_of(comment)
        calls = [f"fe_{n}" for n in re.findall(r"\bNative(?:PINVOKE)?\.(\w+)\(", body or "")]
        calls = [n for n in dict.fromkeys(calls) if n in self.functions]
        for name, signature, value in self.named(kind, head, body):
            made = Member(name, signature, told, calls, names_of(head), described, bool(value), value)
            kind.members.append(made)
        return None

    @staticmethod
    def named(kind, head, body):
        """(name, signature, type of a field or "") of what a declaration makes"""
        plain = signature_of(head)
        if "operator" in plain:
            name = "operator " + re.search(r"operator ([^\s(]+)", plain)[1]
            return [(name, plain, "")]
        if "this[" in plain:
            return [("this[]", plain + accessors(body), "")]
        if "(" in plain:
            return [(re.search(r"(\w+)(?:<[^>]*>)?\(", plain)[1], plain, "")]
        if body is not None:
            return [(plain.split()[-1], plain + accessors(body), "")]
        what, names = re.match(r"((?:(?:%s) )*[\w.<>\[\]?]+) (.*)" % "|".join(MODIFIERS), plain).groups()
        each = names.split(", ") if "(" not in names else [names]
        return [(one.partition(" = ")[0], one, what.replace("readonly ", "")) for one in each]


def signature_of(head):
    head = re.sub(r"^public ", "", head)
    head = re.sub(r"\b(unsafe|override|virtual|sealed|partial|extern|new) (?!\w+\()", "", head)
    return re.sub(r"(\)) : (base|this)\(.*", r"\1", head)


def accessors(body):
    found = re.findall(r"((?:private |internal |protected )?)\b(get|set)\b", re.sub(r"\{[^{}]*\}", "{}", flat(body)))
    shown = [word for access, word in found if not access]
    return " { " + " ".join(f"{word};" for word in dict.fromkeys(shown)) + " }"


def flat(body):
    """A body without what is in its inner braces."""
    depth, out = 0, []
    for letter in body:
        depth -= letter == "}"
        if depth == 0:
            out.append(letter)
        depth += letter == "{"
    return "".join(out)


def names_of(head):
    head = re.sub(r"\) : (?:this|base)\(.*", ")", head)  # what another constructor is given names nothing
    inside = re.search(r"[(\[](.*)[)\]]", head)
    parts = re.split(r",(?![^<]*>)", inside[1]) if inside else []
    return [found[1] for found in (re.search(r"(\w+)(?: = .*)?$", part.strip()) for part in parts) if found]


def enumerators(body):
    made = []
    for comment, head, _ in statements(re.sub(r",", ";", without_comments_commas(body)) + ";", lambda head: True):
        if head:
            name, _, value = head.partition(" = ")
            made.append(
                Member(
                    name,
                    f"{name} = {value}" if value else name,
                    told_of(comment.replace("\x00", ","))[0],
                    is_value=True,
                )
            )
    return made


def without_comments_commas(body):
    """Commas and semicolons of comments, out of the way."""
    return re.sub(r"//[^\n]*", lambda m: m[0].replace(",", "\x00"), body)


# ---- the page -------------------------------------------------------------------------------------------------------


def made_records():
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "Records.cs"
        subprocess.run([sys.executable, str(RECORDS), str(HEADER), str(out)], check=True)
        return out.read_text(encoding="utf-8")


def group_of(kind):
    members = [m for m in kind.members if m.name not in COMMON]
    members.sort(key=lambda m: m.name != kind.name)  # constructors first
    common = [m.name for m in kind.members if m.name in COMMON]
    told = kind.told
    if kind.parameters:
        listed = [f"`{n}`: {kind.described[n]}" for n in kind.parameters if n in kind.described]
        told += " " + "; ".join(listed)
    if common:
        told += "\n\nAlso: " + ", ".join(f"`{name}`" for name in dict.fromkeys(common)) + "."
    head = kind.head or f"{kind.kind} {kind.name}"
    return Group(kind.name, told, head, members)


def sections_of(header):
    reader = Reader(header)
    for file in sorted(SOURCES.glob("*.cs"), key=lambda f: (f.stem != "World", not f.stem.startswith("World"), f.stem)):
        reader.read(file.read_text(encoding="utf-8"))
    reader.read(made_records())
    types = reader.types
    objects = [n for n in OBJECTS.split() if n in types]
    rest = sorted(n for n in types if n not in objects)
    errors = [n for n in rest if n.endswith("Exception")]
    enums = [n for n in rest if types[n].kind == "enum"]
    definitions = [n for n in rest if n.endswith("Def") or n in ("WorldTuning", "DrawOptions")]
    records = [n for n in rest if n not in errors and n not in enums and n not in definitions]
    found = [
        ("Objects", objects),
        ("Definitions", definitions),
        ("Records and values", records),
        ("Enumerations", enums),
        ("Errors", errors),
    ]
    return [Section(title, [group_of(types[n]) for n in names]) for title, names in found]


def pascal(name):
    return "".join(part[:1].upper() + part[1:] for part in name.split("_"))


def words_of(header):
    source = (SOURCES / "Errors.cs").read_text(encoding="utf-8")
    errors = {
        pascal(f"error_{c.lower()}"): kind for c, kind in re.findall(r"Result\.Error(\w+): return new (\w+)", source)
    }
    made = made_records()
    known = dict(re.findall(r'"(fe_\w+)": "(\w+)"', RECORDS.read_text(encoding="utf-8")))
    types = set(re.findall(r"^    (?:public|internal) [\w ]*?(?:class|struct|enum) (\w+)", made, re.M))

    def type_name(name):
        found = known.get(name) or pascal(name[3:])
        return found if name in known or found in types else None

    def enumerator(kind, item):
        items = [one.name for one in header.enums[kind].items]
        shared = 0
        words = [one.split("_") for one in items]
        while all(len(w) > shared + 1 and w[shared] == words[0][shared] for w in words):
            shared += 1
        return f"{type_name(kind)}.{pascal('_'.join(item.split('_')[shared:]).lower())}" if type_name(kind) else None

    return Words(header, "null", lambda n: errors.get(pascal(n[3:].lower()), n), enumerator, type_name, pascal)


def snake(name):
    return re.sub(r"(?<=[a-z0-9])([A-Z])", r"_\1", name).lower()


def page(header):
    sections = sections_of(header)
    words = words_of(header)
    words.learn(sections)
    return Writer(words, snake).page("C#: reference", OPENING, sections)
