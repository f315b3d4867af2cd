"""Parser of RON model and scene files to dictionaries and lists: only the syntax needed here, without error messages."""

import re

TOKEN = re.compile(r'\s*(?://[^\n]*\n\s*)*("(?:[^"\\]|\\.)*"|[-+]?[\d.][\d.eE+-]*|[A-Za-z_]\w*|[()\[\]{},:])')


def read(text):
    tokens = TOKEN.findall(text)
    value, end = _value(tokens, 0)
    assert end == len(tokens), f"text goes on after the value: {tokens[end:end + 5]}"
    return value


def _value(tokens, at):
    token = tokens[at]
    if token[0] == '"':
        return token[1:-1], at + 1
    if token[0] in "([{":
        return _items(tokens, at)
    if token[0].isdigit() or token[0] in "+-.":
        return float(token), at + 1
    # A bare word, or one with its content: Sphere(…).
    if at + 1 < len(tokens) and tokens[at + 1] == "(":
        inside, end = _items(tokens, at + 1)
        return {"is": token, **(inside if isinstance(inside, dict) else {"of": inside})}, end
    return {"true": True, "false": False}.get(token, token), at + 1


def _items(tokens, at):
    """Content of brackets: a dictionary if its items have names, else a list."""
    closing = {"(": ")", "[": "]", "{": "}"}[tokens[at]]
    at += 1
    named, plain = {}, []
    while tokens[at] != closing:
        if tokens[at + 1] == ":":
            named[tokens[at].strip('"')], at = _value(tokens, at + 2)
        else:
            item, at = _value(tokens, at)
            plain.append(item)
        if tokens[at] == ",":
            at += 1
    return (named or plain), at + 1
