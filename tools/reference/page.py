"""What a page of reference is made of, and how it is written as Markdown."""

import re
from dataclasses import dataclass, field
from typing import Dict, List

WIDTH = 118
GLUE = "\x00"  # a space where no line is broken
# A line that begins so would be read as a list, a heading, a quotation or a table
BEGINS_A_BLOCK = re.compile(r"^([-+*>|=]|#+|\d+[.)])$|^[|>#=]|^~~~|^```")


@dataclass
class Member:
    name: str
    signature: str
    told: str = ""  # its own sentences
    functions: List[str] = field(default_factory=list)  # of C, that it calls
    parameters: List[str] = field(default_factory=list)
    described: Dict[str, str] = field(default_factory=dict)  # parameter: its own sentences
    is_value: bool = False  # a field or a constant: a row of a table
    kind: str = ""  # of a value: its type


@dataclass
class Group:
    name: str  # of a class, a record, a set of functions
    told: str = ""
    head: str = ""  # its signature
    members: List[Member] = field(default_factory=list)


@dataclass
class Section:
    title: str
    groups: List[Group]


# What is a name of C, or of a field, in prose
NAMES = re.compile(
    r"\bfe_\w+ in feather\.h|fe_<type>\w+|\bFE_\w+_\*|\b\w+\[FE_\w+\](?:\.\w+)?|"
    r"\b(?:fe_|FE_)\w*\w(?:\.\w+)?|\bNULL\b|(?<!\w)[a-z]+(?:_[a-z0-9]+)+\b(?:\(\))?"
)

# ---- text -----------------------------------------------------------------------------------------------------------


def wrapped(text, indent="", first=None):
    """A paragraph in lines. None begins with what Markdown would take for more than a word."""
    words = []
    for word in text.split():
        if words and BEGINS_A_BLOCK.match(word):
            words[-1] += " " + word
        else:
            words.append(word)
    lines, line = [], indent if first is None else first
    empty = line
    for word in words:
        if len(line) + 1 + len(word) > WIDTH and line != empty:
            lines.append(line.rstrip())
            line = empty = indent
        line += (" " if line != empty else "") + word
    return lines + ([line.rstrip()] if line != empty else [])


def safe(text):
    """Prose that Markdown leaves as it is: what stands in code is kept, a < that opens a tag is not."""
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(p if i % 2 else re.sub(r"<(?=[A-Za-z/!])", r"\\<", p) for i, p in enumerate(parts))


def paragraphs(text):
    return [" ".join(p.split()) for p in re.split(r"\n\s*\n", text) if p.strip()]


def anchor(title):
    return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")


def cell(text):
    return safe(" ".join(text.split())).replace("|", "\\|") or " "


# ---- C's words in a language ----------------------------------------------------------------------------------------


class Words:
    """C's names in prose, as a language has them. A language names its own by the functions it is made with."""

    def __init__(self, header, null, error, enumerator, type_name, local):
        self.header, self.null, self.error, self.enumerator = header, null, error, enumerator
        self.type_name, self.local = type_name, local
        self.enum_of = {item: name for name, enum in header.enums.items() for item in (i.name for i in enum.items)}
        self.members = {}  # function of C: what calls it here

    def learn(self, sections):
        """Which member calls which function: the one that calls it alone, before one that calls others too."""
        found = [
            (len(m.functions), f, g, m) for s in sections for g in s.groups for m in g.members for f in m.functions
        ]
        for _, function, group, member in sorted(found, key=lambda one: one[0]):
            full = (
                f"{group.name}.{member.name}" if group.name and not member.name.startswith(group.name) else member.name
            )
            self.members.setdefault(function, full)

    def name(self, text):
        """Of a name of C, without backticks; the name itself where the language has none for it."""
        if text.startswith("FE_ERROR_"):
            return self.error(text)
        if text in self.enum_of:
            return self.enumerator(self.enum_of[text], text) or text
        if text.startswith("fe_"):
            return self.members.get(text) or self.type_name(text) or text
        return self.null if text == "NULL" else text

    def __call__(self, text):
        """Prose in the language's words; names become code."""
        parts = re.split(r"(`[^`]*`)", text)
        for i, part in enumerate(parts):
            if i % 2:
                parts[i] = "`" + self.in_code(part[1:-1]) + "`"
            else:
                parts[i] = NAMES.sub(self.named, part)
        return "".join(parts)

    def named(self, found):
        name, behind = found[0], " in feather.h"
        if name.endswith(behind):  # it is C's that is meant
            return f"`{name[: -len(behind)]}`{behind}"
        return f"`{self.in_code(name)}`"

    def in_code(self, text):
        indexed = re.fullmatch(r"(\w+)\[(FE_\w+)\](.*)", text)
        if indexed:
            return f"{self.local(indexed[1])}[{self.name(indexed[2])}]{indexed[3]}"
        head, dot, rest = text.partition(".")
        if dot and head.startswith("fe_") and re.fullmatch(r"\w+", rest):
            return f"{self.name(head)}.{self.local(rest)}"
        if re.fullmatch(r"(fe_|FE_)\w+|NULL", text):
            return self.name(text)
        return self.local(text) if re.fullmatch(r"[a-z]+(_[a-z0-9]+)+(\(\))?", text) else text


def split_comment(text):
    """A comment of the header: (prose, {parameter: sentence}, what it returns)."""
    parts = re.split(r"@(param|return)\b", text)
    # how a struct's size is stated concerns C alone
    prose, parameters, returned = re.sub(r"[^.]*\bstruct_size\b[^.]*\.\s*", " ", parts[0]).strip(), {}, ""
    for kind, rest in zip(parts[1::2], parts[2::2]):
        if kind == "return":
            returned = " ".join(rest.split())
            continue
        names, _, sentence = rest.strip().partition("  ")
        for name in re.split(r",\s*", names):
            parameters[name.strip()] = " ".join(sentence.split())
    return prose, parameters, returned


def errors_of(returned):
    """The parts of a @return that name errors, but for those about pointers of C."""
    parts = [part.strip() for part in returned.split(";") if "out_" not in part]
    return [part for part in parts if re.match(r"(the errors of )?(FE_ERROR|for assets)|the errors of", part)]


def speaking(member):
    """The functions whose comments are the member's: those that it calls first, not what clears up behind it."""
    ends = re.search(r"(?i)close|destroy|dispose|end", member.name)
    return [f for f in member.functions if ends or not f.endswith("_destroy")][:2]


# ---- a page ---------------------------------------------------------------------------------------------------------


class Writer:
    def __init__(self, words, snake):
        self.words, self.snake, self.lines = words, snake, []

    def page(self, title, opening, sections):
        self.lines = [f"# {title}", "", *self.opening(opening), "## Contents", ""]
        for section in sections:
            links = ", ".join(f"[{g.name.replace(' ', GLUE)}](#{anchor(g.name)})" for g in section.groups)
            self.lines += [line.replace(GLUE, " ") for line in wrapped(links, "  ", f"- {section.title}: ")]
        self.lines.append("")
        for section in sections:
            for group in section.groups:
                self.group(group)
        return "\n".join(self.lines).rstrip("\n") + "\n"

    def opening(self, paragraphs):
        lines = []
        for text in paragraphs:
            lines += [*wrapped(text), ""]
        return lines

    def group(self, group):
        self.lines += [f"## {group.name}", ""]
        if group.head:
            self.signature(group.head)
        self.prose(self.words(group.told))
        values = [m for m in group.members if m.is_value]
        if values:
            self.table(values)
        for member in group.members:
            if not member.is_value:
                self.member(member)

    def table(self, values):
        typed = any(v.kind for v in values)
        self.lines += ["| name | type | what |", "|---|---|---|"] if typed else ["| name | what |", "|---|---|"]
        for value in values:
            kind = f" {self.code_cell(value.kind)} |" if typed else ""
            self.lines.append(f"| {self.code_cell(value.signature)} |{kind} {cell(self.words(value.told))} |")
        self.lines.append("")

    @staticmethod
    def code_cell(text):
        return f"`{text}`".replace("|", "\\|") if text else ""

    def signature(self, text):
        self.lines += [*wrapped(f"**`{text}`**"), ""]

    def prose(self, text):
        for one in paragraphs(text):
            end = "." if one[-1].isalnum() else ""
            self.lines += [*wrapped(safe(one) + end), ""]

    def member(self, member):
        self.signature(member.signature)
        told = [self.comment_of(f) for f in speaking(member)]
        own = member.told.strip()
        self.prose(self.words(own or next((prose for prose, _, _ in told if prose), "")))
        listed = self.parameter_lines(member, told)
        self.lines += [*listed, ""] if listed else []
        self.closing(member, told)

    def comment_of(self, function):
        """What a function says, else what the header says of it elsewhere."""
        header = self.words.header
        prose, parameters, returned = split_comment(header.functions[function].told)
        return prose or self.said_elsewhere(header, function), parameters, returned

    @staticmethod
    def said_elsewhere(header, function):
        """What the function above says for several, else what a definition says of its field, else a record's struct: a
        sentence. Of a getter its setter says it."""
        one, setter = header.functions[function], function.replace("_get_", "_set_")
        above = [name for name in (setter, one.leader) if name in header.functions and name != function]
        tried = [header.functions[name].told for name in above[:1] if name == setter]
        found = re.match(r"fe_(\w+?)_(?:get|set)_(\w+)$", function)
        fields = header.structs[f"fe_{found[1]}_def"].fields if found and f"fe_{found[1]}_def" in header.structs else []
        outs = [p.kind for p in one.parameters if p.name.startswith("out_")]
        tried += [f.told for f in fields if f.name == found[2]]
        tried += [header.functions[name].told for name in above]
        tried += [header.structs[kind].told for kind in outs if kind in header.structs and len(outs) == 1]
        prose = next((one for one in (split_comment(text)[0] for text in tried) if one), "")
        return re.split(r"(?<=\w)\.\s", prose + " ")[0].rstrip(". \n") + "." if prose else ""

    def parameter_lines(self, member, told):
        lines = []
        for name in member.parameters:
            sentence = member.described.get(name, "")
            for _, parameters, _ in told:
                sentence = sentence or parameters.get(self.snake(name), "")
            if sentence:
                lines += wrapped(safe(self.words(sentence)), "  ", f"- `{name}`: ")
        return lines

    def closing(self, member, told):
        """What goes wrong, and the functions of C."""
        returned = "; ".join(back.replace("fe_last_error", "the message") for _, _, back in told)
        failures = [self.words(part) for part in errors_of(returned)]
        if failures:
            self.lines += [*wrapped("Errors: " + safe("; ".join(dict.fromkeys(failures))) + "."), ""]
        if member.functions:
            names = ", ".join(f"`{name}`" for name in member.functions)
            self.lines += [*wrapped(f"In C: {names}."), ""]
