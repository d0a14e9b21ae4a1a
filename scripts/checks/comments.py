# SPDX-License-Identifier: BSD-3-Clause
"""Comments: the first lines of each source, no code commented out, nothing marked as unfinished."""
import ast
import re

import cpp

SUFFIXES = (".h", ".cpp", ".py", "")
LICENCE = "SPDX-License-Identifier: BSD-3-Clause"
UNFINISHED = re.compile(r"\b(" + "|".join(("TO" + "DO", "FIX" + "ME", "X" + "XX", "HA" + "CK")) + r")\b")
CPP_CODE = re.compile(r"^#\s*include\b|^}$|(?:[)\]\w]\s*;|[){]\s*{|->\w+\(.*|=.*;)$")
PYTHON_CODE = (ast.Assign, ast.AugAssign, ast.Import, ast.ImportFrom, ast.Return, ast.Raise, ast.Delete)


def _is_cpp_code(comment):
    if not CPP_CODE.search(comment):
        return False
    return not comment.endswith(";") or bool(re.search(r"=|\w\(|->|::|^(return|break|continue)\b|^\w+ \w+;$", comment))


def _is_python_code(comment):
    try:
        body = ast.parse(comment).body
    except (SyntaxError, ValueError):
        return False
    return any(isinstance(node, PYTHON_CODE) or isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)
               for node in body)


def check(path, text):
    head = "\n".join(text.split("\n")[:2])
    if text.strip() and LICENCE not in head:
        yield 1, f"no line '{LICENCE}' on top", True
    if re.match(r"#!.*\benv python", head):
        yield 1, "starts whichever Python is first on the PATH; only #!/usr/bin/python3 has ROS's modules", True
    for match in UNFINISHED.finditer(text):
        yield text.count("\n", 0, match.start()) + 1, f"unfinished: {match[0]}", True
    if path.suffix in (".h", ".cpp"):
        for line, comment in cpp.comments(text):
            if _is_cpp_code(comment):
                yield line, f"commented-out code: {comment[:60]}", True
    elif path.suffix == ".py":
        for number, line in enumerate(text.split("\n"), 1):
            if line.lstrip().startswith("# ") and _is_python_code(line.lstrip()[2:]):
                yield number, f"commented-out code: {line.strip()[:60]}", True
