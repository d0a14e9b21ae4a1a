# SPDX-License-Identifier: BSD-3-Clause
"""Files of at most 400 lines, functions of at most 60; a warning from 250 and 40 on."""
import ast

import cpp

FILE_LIMIT, FILE_WARNING = 400, 250
FUNCTION_LIMIT, FUNCTION_WARNING = 60, 40
SUFFIXES = (".h", ".cpp", ".py", "")


def functions(path, text):
    """(name, line, length) of each function; the length is that of the body with its braces."""
    if path.suffix == ".py":
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
                yield node.name, node.lineno, node.end_lineno - node.lineno + 1
    elif path.suffix in (".h", ".cpp"):
        for function in cpp.scan(text)[0]:
            yield function.name, function.line, function.last_line - function.line + 1


def check(path, text):
    lines = text.count("\n")
    if lines > FILE_WARNING:
        yield 1, f"{lines} lines", lines > FILE_LIMIT
    for name, line, length in functions(path, text):
        if length > FUNCTION_WARNING:
            yield line, f"{name} has {length} lines", length > FUNCTION_LIMIT
