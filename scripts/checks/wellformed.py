# SPDX-License-Identifier: BSD-3-Clause
"""YAML and XML that can be read, Python that compiles, and no path of one person's machine anywhere."""
import re
import xml.etree.ElementTree as ElementTree

import yaml

SUFFIXES = (".yaml", ".yml", ".rviz", ".xml", ".launch", ".test", ".py", ".h", ".cpp", ".md", ".txt", "")
ONE_MACHINE = re.compile(r"(?<![\w.])/(?:root|home/[a-z]\w*)/")


def _fault(path, text):
    try:
        if path.suffix in (".yaml", ".yml", ".rviz"):
            list(yaml.safe_load_all(text))
        elif path.suffix in (".xml", ".launch", ".test"):
            ElementTree.fromstring(text.encode())
        elif path.suffix == ".py":
            compile(text, str(path), "exec")
    except (yaml.YAMLError, ElementTree.ParseError, SyntaxError) as error:
        return " ".join(str(error).split())
    return ""


def check(path, text):
    fault = _fault(path, text)
    if fault:
        yield 1, fault, True
    if path.parts[0] != "docker":
        for match in ONE_MACHINE.finditer(text):
            yield text.count("\n", 0, match.start()) + 1, f"a path of one machine: {match[0]}", True
