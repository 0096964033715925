"""The page of Lua: classes, methods and tables of options, as annotations.py reads them."""

from . import annotations
from .annotations import ALSO, CLASSES, OPTIONS, camel, guessed, snake
from .page import Group, Member, Section, Words, Writer

OPENING = [
    "Every public name of the Lua layer, with its signature and its sentences. [docs/lua.md](../lua.md) is the guide; "
    "begin there. Units are metres, kilograms, seconds and radians. A `?` marks what may be left out; a parameter "
    "without a type is a number or says what it is by its name.",
    '"In C" names the functions of [include/feather.h](../../include/feather.h) that a method calls. A failed call '
    'raises an error with the library\'s sentence, and has changed nothing. "Errors" lists what is special to a '
    "method, by the names of C.",
    "Made by `tools/annotate` from `bindings/lua/feather` and the header. Editors read the same in "
    "[bindings/lua/library](../../bindings/lua/library/feather.lua).",
]
# Types that a signature need not say
PLAIN = {"number", "any", "table", "integer"}
WORDS = {"fe_body_type", "fe_joint_type", "fe_combine", "fe_motion", "fe_spring", "fe_dof", "fe_simd"}


def shown(kind):
    return kind.replace("feather.", "").replace("|nil", " or nil").replace("|", " or ")


def parameter(name, kind):
    return name if kind in PLAIN else f"{name}: {shown(kind)}"


def member(owner, method, parameters, back, told, functions):
    inside = ", ".join(parameter(name, kind) for name, kind in parameters)
    many = len(back) > 4 and len(set(back)) == 1
    returned = f"{len(back)} {shown(back[0])}s" if many else ", ".join(shown(kind) for kind in back)
    front = f"{owner.lower()}:" if owner != "feather" else "feather."
    signature = f"{front}{method}({inside})" + (f" -> {returned}" if returned and returned != "any" else "")
    return Member(method, signature, told, functions, [name.rstrip("?") for name, _ in parameters])


def class_group(owner, methods):
    made = {}
    for method, (parameters, back, told) in ALSO.get(owner, {}).items():
        made[method] = member(owner, method, parameters, back, told, guessed(owner, method))
    for method, (names, told, of, called) in methods[owner].items():
        parameters = annotations.parameters_of(owner, method, names, of)
        made[method] = member(owner, method, parameters, annotations.returns_of(owner, method, of), told, called)
    return Group(owner, annotations.TOLD[owner], "", [made[name] for name in sorted(made)])


def module_group():
    made = [Member("VERSION", "feather.VERSION", "The library's version, as text.")]
    made += [member("feather", name, *of) for name, of in annotations.read_module().items()]
    return Group("feather", 'What `require("feather")` returns.', "", made)


def options_group(name, struct, extra):
    made = []
    for key, kind in extra.items():
        made.append(Member(key, key, "", is_value=True, kind=shown(kind)))
    for one in annotations.fields_of(struct, extra):
        kind = annotations.field_type(one.name, one.kind, one.is_pointer or one.count > 0, one.told)
        made.append(Member(camel(one.name), camel(one.name), annotations.told_of(one), is_value=True, kind=shown(kind)))
    return Group(name, annotations.HEADER.structs[struct].told, "", made)


def words_of(header):
    def enumerator(kind, item):
        front = kind.rsplit("_", 1)[0] if kind.endswith("_type") else kind
        return f'"{camel(item[len(front) + 1:].lower())}"' if kind in WORDS else None

    known = {f"fe_{name.lower()}": name for name in CLASSES}
    known.update({struct: name for name, (struct, _) in OPTIONS.items()})
    return Words(header, "nil", lambda name: name, enumerator, known.get, camel)


def page(header):
    methods = annotations.read_methods()
    sections = [
        Section("Module", [module_group()]),
        Section("Classes", [class_group(owner, methods) for owner in CLASSES]),
        Section("Tables of options", [options_group(name, *of) for name, of in OPTIONS.items()]),
    ]
    words = words_of(header)
    words.learn(sections)
    text = Writer(words, snake).page("Lua: reference", OPENING, sections)
    return text
