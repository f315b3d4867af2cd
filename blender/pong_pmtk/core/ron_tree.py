# SPDX-License-Identifier: GPL-3.0-or-later
"""RON text -> a tree of values that remembers where each stands.

It takes what the engine takes (docs/model_format.md). Comments are blanked before anything is read, so positions stay
as they are. Long lists of number tuples are read at once into arrays: see ron_rows.py.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from .ron_rows import Rows, read_rows

DEPTH_LIMIT = 128
EXTENSIONS = ("implicit_some", "unwrap_newtypes", "unwrap_variant_newtypes", "explicit_struct_names")

_BLANK = re.compile("[ \t\n\r\x0b\x0c\x85\u200e\u200f\u2028\u2029]*")
_IDENTIFIER = re.compile(r"[^\W\d]\w*")
_RAW_IDENTIFIER = re.compile(r"r#([\w.+-]+)")
_FIELD_AHEAD = re.compile("(?:r#[\\w.+-]+|[^\\W\\d]\\w*)[ \t\n\r\x0b\x0c\x85\u200e\u200f\u2028\u2029]*:")
_NUMBER = re.compile(r"[+-]?(?:0x\w*|(?:[eE][+-]|[\w.])*)")
_PLAIN_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?(?![\w.])")
_SUFFIX = re.compile(r"(?:[iu](?:8|16|32|64|128)|f(?:32|64))$")
_RAW_STRING = re.compile(r'r(#*)"')
_WORDS = {"inf": float("inf"), "NaN": float("nan")}
_WORDS |= {word + suffix: value for word, value in _WORDS.items() for suffix in ("f32", "f64")}
_TRUTH = {"true": True, "false": False}


class RonError(ValueError):
    """The text is no RON; `at` is the index of the character."""

    def __init__(self, at: int, cause: str, rule: str = "syntax"):
        super().__init__(cause)
        self.at, self.cause, self.rule = at, cause, rule


@dataclass(slots=True)
class Node:
    """A value and the index of the character at which it begins.

    Values are bool, float, str (a text), `Name`, `Struct`, `Tuple`, `List`, `Map` and `Rows`.
    """

    at: int
    value: object


@dataclass(slots=True)
class Name:
    text: str


@dataclass(slots=True)
class Struct:
    name: str | None
    fields: list[tuple[str, int, Node]]


@dataclass(slots=True)
class Tuple:
    name: str | None
    items: list[Node]


@dataclass(slots=True)
class List:
    items: list[Node]


@dataclass(slots=True)
class Map:
    entries: list[tuple[Node, Node]]


def describe(value) -> str:
    """What a value is, for messages."""
    if isinstance(value, bool):
        return f"the truth value {str(value).lower()}"
    if isinstance(value, float):
        return f"the number {value!r}"
    if isinstance(value, str):
        return "a text"
    if isinstance(value, Name):
        return f"the name `{value.text}`"
    if isinstance(value, (Struct, Tuple)) and value.name:
        return f"`{value.name}(…)`"
    if isinstance(value, Struct):
        return "a group of named fields"
    if isinstance(value, Tuple):
        return f"a tuple of {len(value.items)}"
    if isinstance(value, Map):
        return "a map"
    return f"a list of {len(value.items) if isinstance(value, List) else len(value)}"


def parse(text: str) -> Node:
    """Reads one document; raises `RonError`."""
    parser = _Parser(without_comments(text) if "/" in text else text)
    parser.attributes()
    node = parser.value()
    parser.skip_blank()
    if parser.position < len(parser.text):
        raise RonError(parser.position, f"`{parser.text[parser.position]}` after the end of the model")
    return node


_COMMENT_OR_TEXT = re.compile(r'//|/\*|"|(?<!\w)r#*"|\'')
_BLOCK_MARK = re.compile(r"/\*|\*/")


def without_comments(text: str) -> str:
    """The text with every character of a comment but the line breaks made a space."""
    parts, done, here = [], 0, 0
    while match := _COMMENT_OR_TEXT.search(text, here):
        start, mark = match.span()[0], match.group()
        if mark == "//":
            here = _line_end(text, start)
        elif mark == "/*":
            here = _block_end(text, start)
        else:
            here = _text_end(text, start, mark)
            continue
        parts += [text[done:start], re.sub(r"[^\n]", " ", text[start:here])]
        done = here
    return "".join(parts) + text[done:]


def _line_end(text: str, start: int) -> int:
    end = text.find("\n", start)
    return len(text) if end < 0 else end


def _block_end(text: str, start: int) -> int:
    depth, here = 1, start + 2
    while depth:
        match = _BLOCK_MARK.search(text, here)
        if not match:
            raise RonError(start, "this comment is never closed")
        depth += 1 if match.group() == "/*" else -1
        here = match.end()
    return here


def _text_end(text: str, start: int, mark: str) -> int:
    """Behind a text that begins at `start`; an unclosed one is told by the parser."""
    if mark.startswith("r"):
        end = text.find('"' + mark[1:-1], start + len(mark))
        return len(text) if end < 0 else end + len(mark) - 1
    here = start + 1
    while here < len(text) and text[here] != mark:
        here += 2 if text[here] == "\\" else 1
    return here + 1


class _Parser:
    def __init__(self, text: str):
        self.text, self.position, self.depth = text, 0, 0
        self.skip_blank()

    def skip_blank(self) -> None:
        self.position = _BLANK.match(self.text, self.position).end()

    def peek(self) -> str:
        return self.text[self.position : self.position + 1]

    def take(self, what: str) -> bool:
        found = self.text.startswith(what, self.position)
        if found:
            self.position += len(what)
        return found

    def expect(self, what: str, purpose: str) -> None:
        if not self.take(what):
            raise RonError(self.position, f"expected `{what}` {purpose}, found {self.found()}")

    def found(self) -> str:
        if self.peek() == "/":
            return "a `/` that opens no comment"
        return f"`{self.peek()}`" if self.peek() else "the end of the file"

    def attributes(self) -> None:
        while self.take("#!["):
            self.skip_blank()
            self.expect("enable", "in the attribute")
            self.skip_blank()
            self.expect("(", "after `enable`")
            self.extensions()
            self.skip_blank()
            self.expect("]", "after `enable(…)`")
            self.skip_blank()

    def extensions(self) -> None:
        while True:
            self.skip_blank()
            if self.take(")"):
                return
            at, name = self.position, self.identifier()
            if name not in EXTENSIONS:
                raise RonError(at, f"unknown extension `{name}`")
            self.skip_blank()
            if not self.take(","):
                self.expect(")", "after the list of extensions")
                return

    def value(self) -> Node:
        at = self.position
        self.depth += 1
        if self.depth > DEPTH_LIMIT:
            raise RonError(at, f"values nest deeper than {DEPTH_LIMIT}", "too-deep")
        value = self.bare_value()
        self.depth -= 1
        return Node(at, value)

    def bare_value(self):
        first = self.peek()
        if first == "(":
            return self.parenthesised(None)
        if first == "[":
            return self.list()
        if first == "{":
            return self.map()
        if first == '"':
            return self.string()
        if first == "'":
            return self.character()
        if first and first in "0123456789+-.":
            return self.number()
        if first == "r" and _RAW_STRING.match(self.text, self.position):
            return self.raw_string()
        if first == "b" and re.compile(r"b\"|b'|br[\"#]").match(self.text, self.position):
            raise RonError(self.position, "byte strings have no meaning in a model file", "byte-string")
        if not first:
            raise RonError(self.position, "expected a value, found the end of the file")
        return self.named()

    def named(self):
        raw = self.text.startswith("r#", self.position)
        name = self.identifier()
        if not raw and name in _TRUTH:
            return _TRUTH[name]
        if not raw and name in _WORDS:
            return _WORDS[name]
        after = self.position
        self.skip_blank()
        if self.peek() == "(":
            return self.parenthesised(name)
        self.position = after
        return Name(name)

    def identifier(self) -> str:
        match = _RAW_IDENTIFIER.match(self.text, self.position) or _IDENTIFIER.match(self.text, self.position)
        if not match:
            raise RonError(self.position, f"expected a value or a name, found {self.found()}")
        self.position = match.end()
        return match.group(1) if match.re is _RAW_IDENTIFIER else match.group()

    def parenthesised(self, name: str | None):
        open_at = self.position
        self.position += 1
        self.skip_blank()
        if _FIELD_AHEAD.match(self.text, self.position):
            return Struct(name, self.fields(open_at))
        return Tuple(name, self.items(open_at, "(", ")"))

    def fields(self, open_at: int) -> list[tuple[str, int, Node]]:
        fields = []
        while not self.closed(open_at, "(", ")"):
            at = self.position
            name = self.identifier()
            self.skip_blank()
            self.expect(":", f"after the field name `{name}`")
            self.skip_blank()
            fields.append((name, at, self.value()))
            self.separator(")", "after the value of a field")
        return fields

    def items(self, open_at: int, opening: str, closing: str) -> list[Node]:
        items = []
        while not self.closed(open_at, opening, closing):
            items.append(self.value())
            self.separator(closing, "between items")
        return items

    def closed(self, open_at: int, opening: str, closing: str) -> bool:
        self.skip_blank()
        if self.take(closing):
            return True
        if self.position >= len(self.text):
            raise RonError(open_at, f"this `{opening}` is never closed")
        return False

    def separator(self, closing: str, purpose: str) -> None:
        self.skip_blank()
        if self.peek() != closing:
            self.expect(",", purpose)

    def map(self) -> Map:
        open_at = self.position
        self.position += 1
        entries = []
        while not self.closed(open_at, "{", "}"):
            key = self.value()
            self.skip_blank()
            self.expect(":", "after the key of a map")
            self.skip_blank()
            entries.append((key, self.value()))
            self.separator("}", "between the entries of a map")
        return Map(entries)

    def list(self) -> List | Rows:
        open_at = self.position
        self.position += 1
        self.skip_blank()
        rows = read_rows(self.text, self.position) if self.depth + 2 <= DEPTH_LIMIT else None
        if rows is not None:
            self.position = rows.end
            return rows
        return List(self.items(open_at, "[", "]"))

    def number(self) -> float:
        plain = _PLAIN_NUMBER.match(self.text, self.position)
        if plain:
            self.position = plain.end()
            return float(plain.group())
        token = _NUMBER.match(self.text, self.position).group()
        value = _meaning(token)
        if value is None:
            raise RonError(self.position, f"`{token}` is not a number")
        self.position += len(token)
        return value

    def raw_string(self) -> str:
        start = self.position
        match = _RAW_STRING.match(self.text, start)
        end = self.text.find('"' + match.group(1), match.end())
        if end < 0:
            raise RonError(start, "this raw text is never closed")
        self.position = end + 1 + len(match.group(1))
        return self.text[match.end() : end]

    def string(self) -> str:
        start, parts = self.position, []
        self.position += 1
        while True:
            match = re.compile(r'[^"\\]*').match(self.text, self.position)
            parts.append(match.group())
            self.position = match.end() + 1
            if match.end() >= len(self.text):
                raise RonError(start, "this text is never closed")
            if self.text[match.end()] == '"':
                return "".join(parts)
            parts.append(self.escape())

    def character(self) -> str:
        start = self.position
        self.position += 1
        if self.take("\\"):
            character = self.escape()
        else:
            character = self.peek().replace("'", "")
            self.position += 1
        if len(character) != 1 or not self.take("'"):
            raise RonError(start, "this is not one character between quotes")
        return character

    def escape(self) -> str:
        """What follows a backslash; a line break swallows the white space after it."""
        at, kind = self.position - 1, self.peek()
        if not kind:
            raise RonError(at, "the file ends within an escape")
        self.position += 1
        simple = {"\\": "\\", '"': '"', "'": "'", "n": "\n", "r": "\r", "t": "\t", "0": "\0"}
        if kind in simple:
            return simple[kind]
        if kind in "\n\r":
            self.position = re.compile(r"[ \t\n\r]*").match(self.text, self.position).end()
            return ""
        pattern = {"x": r"([0-9a-fA-F]{2})", "u": r"\{([0-9a-fA-F]{1,6})\}"}.get(kind)
        code = re.compile(pattern).match(self.text, self.position) if pattern else None
        if not code or int(code.group(1), 16) > 0x10FFFF or 0xD800 <= int(code.group(1), 16) < 0xE000:
            raise RonError(at, f"unknown escape `\\{kind}`" if not pattern else "not a character code")
        self.position = code.end()
        return chr(int(code.group(1), 16))


def _meaning(token: str) -> float | None:
    """Signs, underscores, prefixes of radix and suffixes of type, as the engine reads them."""
    sign = -1.0 if token.startswith("-") else 1.0
    digits = token[1:] if token[:1] in ("+", "-") else token
    if digits in ("inf", "NaN"):
        return sign * _WORDS[digits]
    for prefix, radix, valid in (("0x", 16, "[0-9a-fA-F]"), ("0b", 2, "[01]"), ("0o", 8, "[0-7]")):
        if digits.startswith(prefix):
            body = re.sub(r"[iu](?:8|16|32|64|128)$" if radix == 16 else _SUFFIX, "", digits[2:])
            if not re.fullmatch(f"{valid}(?:{valid}|_)*", body) or int(body.replace("_", ""), radix) >= 1 << 64:
                return None
            return sign * float(int(body.replace("_", ""), radix))
    body = _SUFFIX.sub("", digits)
    if re.search(r"(?:^|[.+-])_", body):
        return None
    plain = body.replace("_", "")
    return sign * float(plain) if re.fullmatch(r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", plain) else None
