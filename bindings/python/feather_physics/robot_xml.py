"""The XML of robots: elements with their files and lines, and what all readers of it do."""

from __future__ import annotations

import os
import re
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Set, Tuple, Union
from xml.parsers import expat

from .errors import SceneError

MOST_BYTES, MOST_DEPTH = 16 << 20, 200  # of a file; of elements in one another
# Encodings of texts; Python knows others, which are none of texts, and which expat would ask it for
DECLARED = re.compile(rb"""<\?xml[^>]*?\sencoding\s*=\s*["']([^"'>]*)["']""")
ENCODINGS = re.compile(rb"utf-?8|utf-?16([lb]e)?|(us-)?ascii|iso-8859-\d+|latin-?1|windows-125\d|cp125\d|koi8-[ru]", re.I)
BYTE_ORDER = b"\xef\xbb\xbf"  # of UTF-8, which may stand before all
MOST = 1e18  # of a number's magnitude
MOST_ECHOED = 60  # characters of an attribute in a message


class SceneWarning(NamedTuple):
    """What a file has and the scene has not, or not exactly. Kinds: "element", "attribute" (left out), "mass"
    (replaced), "mesh" (left out), "hull", "size" (coarser), "joint" (coarser or not coupled), "limit"."""

    file: str
    line: int
    kind: str
    sentence: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.sentence}"


class Element:
    """A tag with its attributes and children, and the file and line where it stands."""

    def __init__(self, tag: str, attributes: Dict[str, str], line: int, file: str = ""):
        self.tag, self.attributes, self.line, self.file = tag, attributes, line, file
        self.children: List[Element] = []

    def find(self, tag: str) -> Optional["Element"]:
        """The first child of a tag."""
        return next((child for child in self.children if child.tag == tag), None)

    def copy(self) -> "Element":
        """With copies of all within it."""
        made = Element(self.tag, dict(self.attributes), self.line, self.file)
        made.children = [child.copy() for child in self.children]
        return made


def check_encoding(data: bytes, file: str) -> None:
    """Is it one that a text may have?"""
    declared = DECLARED.match(data[:1000])
    if declared and not ENCODINGS.fullmatch(declared[1]):
        raise SceneError(f"{file}: its encoding is not one of XML's")


def parse(text: Union[str, bytes], file: str) -> Element:
    """The root. No document types, so no entities; no more bytes or depth than a robot needs. Empty lines may stand
    before it."""
    try:
        data = text.encode() if isinstance(text, str) else text
    except UnicodeError:
        raise SceneError(f"{file}: half a character (a lone surrogate)") from None
    if len(data) > MOST_BYTES:
        raise SceneError(f"{file}: {len(data)} bytes, {MOST_BYTES} are the most")
    data, whole = data.lstrip(b" \t\r\n") if data[:3] != BYTE_ORDER else data[3:].lstrip(b" \t\r\n"), data
    skipped = whole[: len(whole) - len(data)].count(b"\n")
    if not isinstance(text, str):
        check_encoding(data, file)
    # a text is decoded already, whatever encoding it names
    parser, top = expat.ParserCreate("utf-8" if isinstance(text, str) else None), Element("", {}, 0, file)
    stack = [top]

    def start(tag: str, attributes: Dict[str, str]) -> None:
        line = parser.CurrentLineNumber + skipped
        if len(stack) > MOST_DEPTH:
            raise SceneError(f"{file}:{line}: deeper than {MOST_DEPTH} elements")
        element = Element(tag, attributes, line, file)
        stack[-1].children.append(element)
        stack.append(element)

    def refuse(*_: Any) -> None:
        raise SceneError(f"{file}:{parser.CurrentLineNumber + skipped}: a document type is not taken")

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: stack.pop() and None
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise SceneError(f"{file}:{error.lineno + skipped}: {expat.ErrorString(error.code)}") from None
    except SceneError:
        raise
    except (LookupError, ValueError):  # expat asks Python's codecs for an encoding that it does not know
        raise SceneError(f"{file}: its encoding is not one of XML's") from None
    return top.children[0]


class Reader:
    """Reads one file: what is wrong is an error with file, line and element."""

    def __init__(self, file: str, strict: bool, warnings: Optional[List[SceneWarning]] = None):
        self.file, self.strict = file, strict
        self.warnings: List[SceneWarning] = [] if warnings is None else warnings
        self.told: Set[str] = set()

    def fail(self, element: Element, text: str, kind: Any = SceneError) -> SceneError:
        """The error."""
        made: SceneError = kind(f"{element.file or self.file}:{element.line}: <{element.tag}>: {text}")
        return made

    def warn(self, element: Element, kind: str, text: str) -> None:
        """What is not exact: an error when strict."""
        if self.strict:
            raise self.fail(element, text)
        self.warnings.append(
            SceneWarning(element.file or self.file, element.line, kind, f"<{element.tag}>: {text}")
        )

    def tell_once(self, element: Element, kind: str, text: str) -> None:
        """What many elements have: the first one is named."""
        key = f"{element.tag} {text}" if kind == "element" else text
        if key not in self.told:
            self.told.add(key)
            self.warn(element, kind, text)

    def known(self, element: Element, known: Set[str], silent: Set[str]) -> List[Element]:
        """The children that are read; of each other kind that counts there is one warning."""
        for child in element.children:
            if child.tag not in known and child.tag not in silent:
                self.tell_once(child, "element", "is left out")
        return [child for child in element.children if child.tag in known]

    def need(self, element: Element, name: str) -> str:
        """An attribute."""
        if name not in element.attributes:
            raise self.fail(element, f"{name} is missing")
        return element.attributes[name]

    def choice(self, element: Element, name: str, choices: Sequence[str], usual: str) -> str:
        """One of several words."""
        found = element.attributes.get(name, usual)
        if found not in choices:
            raise self.fail(element, f"{name}: one of {', '.join(choices)} is needed, not {found[:MOST_ECHOED]!r}")
        return found

    def numbers(self, element: Element, name: str, count: int, usual: Optional[Sequence[float]] = None) -> List[float]:
        """An attribute of so many numbers."""
        if name not in element.attributes and usual is not None:
            return list(usual)
        text = self.need(element, name)
        try:
            found = [float(word) for word in text.split(None, count)] if count else []
        except ValueError:
            found = []
        if len(found) != count or not all(abs(x) <= MOST for x in found):
            raise self.fail(element, f"{name}: {count} finite numbers are needed, not {text[:MOST_ECHOED]!r}")
        return found

    def number(self, element: Element, name: str, usual: Optional[float] = None) -> float:
        """An attribute of one number."""
        return self.numbers(element, name, 1, None if usual is None else [usual])[0]

    def positive(self, element: Element, name: str) -> float:
        """A size."""
        value = self.number(element, name)
        if value <= 0:
            raise self.fail(element, f"{name}: more than 0 is needed, not {value}")
        return value


def read_source(source: Any, name: str) -> Tuple[Union[str, bytes], str]:
    """The text, and what messages call it: of a path, or of the text itself (str that begins with "<", or bytes)."""
    if isinstance(source, bytes) or (isinstance(source, str) and source.lstrip("\ufeff \t\r\n").startswith("<")):
        return source, name
    file = os.fspath(source)
    return read_file(file), file


def read_file(file: str, most: int = MOST_BYTES) -> bytes:
    """What it holds, and one byte more than a reader takes where it holds more."""
    with open(file, "rb") as stream:
        return stream.read(min(os.fstat(stream.fileno()).st_size or most, most) + 1)


def escaped(text: str) -> str:
    """As an attribute."""
    for mark, word in (("&", "&amp;"), ("<", "&lt;"), ('"', "&quot;"), ("\n", "&#10;"), ("\t", "&#9;"), ("\r", "&#13;")):
        text = text.replace(mark, word)
    return text


def row(values: Sequence[float]) -> str:
    """Numbers, exact."""
    return " ".join(repr(float(x)) for x in values)
