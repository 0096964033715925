"""Every public name has a docstring, and stands in docs/reference/python.md, which has no other."""

import importlib
import inspect
import pkgutil
import re
from typing import Any, Dict, Iterator, List, Set, Tuple

import feather_physics
from conftest import ROOT

PAGE = ROOT / "docs/reference/python.md"
# Modules whose public names the page has, besides those of the package
PAGED = ("envs", "tasks", "scene", "urdf", "mjcf")
# What the C tuples have of Python's own
TUPLES = {"n_fields", "n_sequence_fields", "n_unnamed_fields"}


def modules() -> List[Any]:
    names = [m.name for m in pkgutil.iter_modules(feather_physics.__path__) if not m.name.startswith("_")]
    return [importlib.import_module(f"feather_physics.{name}") for name in names]


def own(module: Any) -> Iterator[Tuple[str, Any]]:
    """Public classes and functions that a module defines."""
    for name, value in vars(module).items():
        if not name.startswith("_") and getattr(value, "__module__", "") == module.__name__:
            if inspect.isclass(value) or inspect.isfunction(value):
                yield name, value


def members(kind: Any) -> Dict[str, Any]:
    """Public methods and properties of a class, with those of its bases in the package."""
    found: Dict[str, Any] = {}
    for base in reversed(kind.__mro__):
        if base.__module__.startswith("feather_physics"):
            found.update({name: value for name, value in vars(base).items() if not name.startswith("_")})
    return found


def is_told(kind: Any, name: str, value: Any) -> bool:
    """Has it words of its own, or of what it overrides? Fields are told by their class."""
    if isinstance(value, (property, classmethod, staticmethod)) or inspect.isfunction(value):
        return bool(inspect.getdoc(getattr(kind, name)))
    has_getter = hasattr(type(value), "__get__") and type(value).__module__.startswith("feather_physics")
    return bool(value.__doc__) if has_getter else True


def test_every_public_name_has_a_docstring() -> None:
    missing: List[str] = []
    for module in modules():
        missing += [] if module.__doc__ else [module.__name__]
        for name, value in own(module):
            missing += [] if inspect.getdoc(value) else [f"{module.__name__}.{name}"]
            if inspect.isclass(value):
                untold = [each for each, one in members(value).items() if not is_told(value, each, one)]
                missing += [f"{module.__name__}.{name}.{each}" for each in untold]
    assert not missing, missing


def paged() -> Dict[str, Set[str]]:
    """group: names of its members, as the page has them"""
    groups: Dict[str, Set[str]] = {}
    for part in re.split(r"^## ", PAGE.read_text(), flags=re.M)[2:]:
        title, _, text = part.partition("\n")
        names = re.findall(r"^\*\*`(?:classmethod )?(\w+)", text, re.M) + re.findall(r"^\| `(\w+)", text, re.M)
        groups[title] = {name for name in names if name != "class"} - {title}
    return groups


def public_things() -> Dict[str, Any]:
    found = {name: getattr(feather_physics, name) for name in feather_physics.__all__}
    for name in PAGED:
        module = importlib.import_module(f"feather_physics.{name}")
        found.update({each: value for each, value in vars(module).items() if each in paged()})
    return found


def test_the_page_has_every_public_name_and_no_other() -> None:
    groups, things = paged(), public_things()
    assert set(groups) == set(things)
    for name, value in things.items():
        if not inspect.isclass(value) or value.__module__ == "typing":
            continue
        there = (set(members(value)) | fields(value)) - TUPLES
        made = set(re.findall(r"self\.([a-z]\w*)", inspect.getsource(value.__init__))) if is_ours(value) else set()
        protocol = {"len", "iter", name.lower()}  # as in len(worlds), worlds[index]
        assert there - groups[name] == set(), name
        assert groups[name] - there - made - protocol == set(), name


def is_ours(kind: Any) -> bool:
    """Has it an __init__ that somebody wrote?"""
    written = inspect.isfunction(kind.__init__) and not hasattr(kind, "__dataclass_fields__")
    return written and kind.__init__.__qualname__ == f"{kind.__name__}.__init__"


def fields(kind: Any) -> Set[str]:
    """Of a NamedTuple, a data class, or what the package's own tuples have."""
    names = set(getattr(kind, "_fields", ())) | set(getattr(kind, "__dataclass_fields__", ()))
    for base in kind.__mro__:
        if base.__module__.startswith("feather_physics"):
            names |= {name for name in vars(base).get("__annotations__", {}) if not name.startswith("_")}
    return names
