#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs one check, or all, over the files that git knows or would add: house_style.py [sizes|comments|...]."""
import subprocess
import sys
from pathlib import Path

import comments
import mutable_state
import ros_free
import sizes
import topics
import wellformed

CHECKS = {module.__name__: module for module in (sizes, mutable_state, ros_free, topics, comments, wellformed)}


def files():
    """All text files of the repository but documents of a licence."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            check=True, capture_output=True, text=True).stdout
    return sorted(path for path in map(Path, filter(None, listed.split("\0"))) if path.is_file())


def is_checked(path, module):
    """By suffix; a file without one counts where it is a script."""
    if path.suffix not in module.SUFFIXES:
        return False
    return path.suffix != "" or path.open("rb").read(2) == b"#!"


def run(module, paths):
    """(path, line, message, whether it is an error) of one check."""
    for path in paths:
        if is_checked(path, module):
            text = path.read_text(encoding="utf-8")
            named = path.with_suffix(".py") if text.startswith("#!/usr/bin/python3") else path
            for line, message, error in module.check(named, text):
                yield path, line, message, error


def main():
    errors = 0
    paths = files()
    for name in sys.argv[1:] or CHECKS:
        for path, line, message, error in run(CHECKS[name], paths):
            print(f"{path}:{line}: {'error' if error else 'warning'}: {message} [{name}]")
            errors += error
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
