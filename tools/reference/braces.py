"""Statements of a language with braces: C#, the types of JavaScript. It knows comments, strings and pairs; no more."""

import re

QUOTES = "\"'`"


def skip(text, at):
    """Behind the comment or the string that begins here; the same place where none does."""
    if text.startswith("//", at):
        end = text.find("\n", at)
        return len(text) if end < 0 else end
    if text.startswith("/*", at):
        return text.index("*/", at) + 2
    if text[at] in QUOTES:
        end = at + 1
        while text[end] != text[at]:
            end += 2 if text[end] == "\\" else 1
        return end + 1
    return at


def closing(text, at):
    """Where the brace that opens here is closed."""
    depth = 0
    while at < len(text):
        behind = skip(text, at)
        if behind != at:
            at = behind
            continue
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return at
        at += 1
    raise ValueError("a brace is not closed")


def statements(text, has_body):
    """(comment, head, body) of each statement at the outer level. The body is None where a semicolon ends it. A brace
    belongs to the head where has_body says so of what stands before it."""
    at, head, comment = 0, "", []
    while at < len(text):
        behind = skip(text, at)
        if behind != at and text[at] == "/":
            if not head.strip():
                comment += doc_lines(text[at:behind])
        elif behind != at:
            head += text[at:behind]
        elif text[at] == ";" or text[at] == "{" and has_body(head):
            body = None if text[at] == ";" else text[at + 1 : closing(text, at)]
            behind = at + 1 if body is None else at + len(body) + 2
            yield "\n".join(comment), " ".join(head.split()), body
            head, comment = "", []
        elif text[at] == "{":
            behind = closing(text, at) + 1
            head += text[at:behind]
        else:
            head += text[at]
            if not head.strip() and re.match(r"\n\s*\n", text[at:]) and comment:
                comment = []
        at = max(behind, at + 1)


def doc_lines(text):
    """Of a comment that documents: /// or /** */; none of another."""
    if text.startswith("///"):
        return [text[3:].strip()]
    if not text.startswith("/**"):
        return []
    return [re.sub(r"^\s*\* ?", "", line).rstrip() for line in text[3:-2].strip().split("\n")]
