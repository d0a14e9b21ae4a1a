# SPDX-License-Identifier: BSD-3-Clause
"""No variable outlives a call: no mutable global, no mutable static member, no static or thread_local in a function."""
import re

import cpp

SUFFIXES = (".h", ".cpp")
CONSTANT = re.compile(r"\b(const|constexpr)\b")
NOT_A_VARIABLE = re.compile(
    r"(inline\s+)?(using|typedef|template|friend|static_assert|namespace|class|struct|enum|union|extern\s+template)\b")


def _is_variable(text):
    """Whether a statement outside functions declares a variable rather than a function or a type."""
    if NOT_A_VARIABLE.match(text) or "operator" in text:
        return False
    head = re.split(r"[={]", text, maxsplit=1)[0]
    return "(" not in head and len(re.findall(r"\w+", head)) > 1


def check(_path, text):
    functions, declarations = cpp.scan(text)
    for scope, line, statement in declarations:
        head = re.split(r"[={]", statement, maxsplit=1)[0]
        owned = scope == "namespace" or re.search(r"\b(static|thread_local)\b", head)
        if owned and _is_variable(statement) and not CONSTANT.search(head):
            yield line, f"mutable {'global' if scope == 'namespace' else 'static member'}: {statement[:60]}", True
    for function in functions:
        for match in re.finditer(r"\b(?:static|thread_local)\b[^;{(=]*", function.body):
            if not CONSTANT.search(match[0]):
                line = function.line + function.body.count("\n", 0, match.start())
                yield line, f"mutable static in {function.name}", True
