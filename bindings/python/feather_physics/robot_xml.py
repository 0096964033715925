"""The XML of robots: elements with their lines, and what all readers of it do."""

from __future__ import annotations

import os
from typing import Any, Dict, List, Optional, Sequence, Set, Tuple, Union
from xml.parsers import expat

from .errors import InvalidArgumentError

MOST_BYTES, MOST_DEPTH = 16 << 20, 200  # of a file; of elements in one another


class Element:
    """A tag with its attributes and children, and the line where it stands."""

    def __init__(self, tag: str, attributes: Dict[str, str], line: int):
        self.tag, self.attributes, self.line = tag, attributes, line
        self.children: List[Element] = []

    def find(self, tag: str) -> Optional["Element"]:
        """The first child of a tag."""
        return next((child for child in self.children if child.tag == tag), None)


def parse(text: Union[str, bytes], file: str) -> Element:
    """The root. No document types, so no entities; no more bytes or depth than a robot needs."""
    data = text.encode() if isinstance(text, str) else text
    if len(data) > MOST_BYTES:
        raise InvalidArgumentError(f"{file}: {len(data)} bytes, {MOST_BYTES} are the most")
    parser, top = expat.ParserCreate(), Element("", {}, 0)
    stack = [top]

    def start(tag: str, attributes: Dict[str, str]) -> None:
        if len(stack) > MOST_DEPTH:
            raise InvalidArgumentError(f"{file}:{parser.CurrentLineNumber}: deeper than {MOST_DEPTH} elements")
        element = Element(tag, attributes, parser.CurrentLineNumber)
        stack[-1].children.append(element)
        stack.append(element)

    def refuse(*_: Any) -> None:
        raise InvalidArgumentError(f"{file}:{parser.CurrentLineNumber}: a document type is not taken")

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: stack.pop() and None
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise InvalidArgumentError(f"{file}:{error.lineno}: {expat.ErrorString(error.code)}") from None
    return top.children[0]


class Reader:
    """Reads one file: what is wrong is an error with file, line and element."""

    FIELDS: Dict[str, Set[str]] = {}  # the children of a tag
    LOST: Set[str] = set()  # what is left out with a warning

    def __init__(self, file: str, strict: bool):
        self.file, self.strict = file, strict
        self.warnings: List[str] = []

    def fail(self, element: Element, text: str) -> InvalidArgumentError:
        """The error."""
        return InvalidArgumentError(f"{self.file}:{element.line}: <{element.tag}>: {text}")

    def warn(self, element: Element, text: str) -> None:
        """What is not exact: an error when strict."""
        if self.strict:
            raise self.fail(element, text)
        self.warnings.append(f"{self.file}:{element.line}: <{element.tag}>: {text}")

    def known(self, element: Element) -> None:
        """Are all children known?"""
        for child in element.children:
            if child.tag in self.LOST:
                self.warn(child, "is left out")
            elif child.tag not in self.FIELDS[element.tag]:
                raise self.fail(child, f"is not known in <{element.tag}>")

    def need(self, element: Element, name: str) -> str:
        """An attribute."""
        if name not in element.attributes:
            raise self.fail(element, f"{name} is missing")
        return element.attributes[name]

    def numbers(self, element: Element, name: str, count: int, usual: Optional[Sequence[float]] = None) -> List[float]:
        """An attribute of so many numbers."""
        if name not in element.attributes and usual is not None:
            return list(usual)
        text = self.need(element, name)
        try:
            found = [float(word) for word in text.split()]
        except ValueError:
            found = []
        if len(found) != count or not all(abs(x) <= 1e15 for x in found):
            raise self.fail(element, f"{name}: {count} finite numbers are needed, not {text!r}")
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
    if isinstance(source, bytes) or (isinstance(source, str) and source.lstrip().startswith("<")):
        return source, name
    file = os.fspath(source)
    with open(file, "rb") as stream:
        return stream.read(MOST_BYTES + 1), file


def escaped(text: str) -> str:
    """As an attribute."""
    for mark, word in (("&", "&amp;"), ("<", "&lt;"), ('"', "&quot;")):
        text = text.replace(mark, word)
    return text


def row(values: Sequence[float]) -> str:
    """Numbers, exact."""
    return " ".join(repr(float(x)) for x in values)
