# SPDX-License-Identifier: BSD-3-Clause
"""Reads C++ as far as the checks need it: text without comments and strings, functions, declarations."""
import re
from bisect import bisect_left
from collections import namedtuple

Function = namedtuple("Function", "name line last_line body")
Declaration = namedtuple("Declaration", "scope line text")

COMMENT = r"//(?:\\\n|[^\n])*|/\*.*?\*/"
STRING = r'R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"' + r"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'"
TOKENS = re.compile(f"(?P<comment>{COMMENT})|(?P<string>{STRING})", re.S)
DIRECTIVE = re.compile(r"^[ \t]*#(?:\\\n|[^\n])*", re.M)


def _blank(text):
    return re.sub(r"[^\n]", " ", text)


def without_comments(text):
    """Comments become blanks; every offset and line stays what it was."""
    return TOKENS.sub(lambda m: _blank(m[0]) if m["comment"] else m[0], text)


def bare(text):
    """Comments, strings and preprocessor lines become blanks."""
    return DIRECTIVE.sub(lambda m: _blank(m[0]), TOKENS.sub(lambda m: _blank(m[0]), text))


def comments(text):
    """(line, text) of every line of comment, without the comment's marks."""
    for match in TOKENS.finditer(text):
        if match["comment"]:
            first = text.count("\n", 0, match.start()) + 1
            for offset, line in enumerate(match[0].split("\n")):
                yield first + offset, re.sub(r"^\s*(?://[/!<]*|/\*+[!<]?|\*(?!/))|\*+/\s*$", "", line).strip()


def _without_parentheses(text):
    inner = re.compile(r"\([^()]*\)")
    while inner.search(text):
        text = inner.sub(" @ ", text)
    return text


def _without_template(header):
    while re.match(r"template\s*<", header):
        depth = 0
        for i, letter in enumerate(header):
            depth += {"<": 1, ">": -1}.get(letter, 0)
            if letter == ">" and depth == 0:
                header = header[i + 1:].strip()
                break
        else:
            return header
    return header


def _kind(header):
    """What the brace after this header opens: namespace, class, function or initializer."""
    flat = _without_template(re.sub(r"operator\s*[^\s\w(]+", "operator", header).strip())
    flat = re.sub(r"\[\[.*?\]\]", " ", _without_parentheses(flat)).strip()
    if re.match(r"(inline\s+)?namespace\b|extern\s*$", flat):
        return "namespace"
    if re.match(r"(typedef\s+)?enum\b", flat):
        return "initializer"
    record = re.match(r"(public:|private:|protected:|typedef|\s)*(class|struct|union)\b", flat)
    if record and "=" not in flat and ("@" not in flat or "alignas" in flat):
        return "class"
    if "@" not in flat or "=" in flat:
        return "initializer"
    constructs = re.search(r"@[^:]*(?<!:):(?!:)", flat)
    return "initializer" if constructs and re.search(r"[\w>]$", flat) else "function"


def scan(text):
    """The functions of a file, and the declarations (statements up to ';') outside functions."""
    text = bare(text)
    functions, declarations = [], []
    stack, begin, depth = [("namespace", 0, 0)], 0, 0
    breaks = [m.start() for m in re.finditer("\n", text)]

    def line_of(offset):
        return bisect_left(breaks, offset) + 1

    for match in re.finditer(r"[(){};]", text):
        mark, at = match[0], match.start()
        scope = stack[-1][0]
        outside = scope in ("namespace", "class")
        if mark in "()":
            depth += (1 if mark == "(" else -1) if outside else 0
        elif mark == "{":
            header = text[begin:at].strip()
            kind = "block" if not outside else "initializer" if depth else _kind(header)
            stack.append((kind, at, begin))
            if kind in ("namespace", "class"):
                begin = at + 1
        elif mark == "}" and len(stack) > 1:
            kind, opened, since = stack.pop()
            if kind == "function":
                name = re.search(r"([\w:~]+|operator\s*\S+)\s*\(", text[since:opened])
                functions.append(Function(name[1] if name else "", line_of(opened), line_of(at), text[opened:at]))
            if kind in ("namespace", "class", "function"):
                begin = at + 1
        elif mark == ";" and outside and not depth:
            statement = text[begin:at]
            first = begin + len(statement) - len(statement.lstrip())
            declarations.append(Declaration(scope, line_of(first), " ".join(statement.split())))
            begin = at + 1
    return functions, declarations

