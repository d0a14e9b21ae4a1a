#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Line coverage of each package's src/ and include/, from a build with clang's coverage: coverage.py BUILD_DIR PACKAGE...

Prints a table, names the files that lack most, and fails if a package is under the limit.
"""
import json
import os
import subprocess
import sys

LIMIT = 0.90  # of the lines [-]


def summaries(build):
    """(path, lines, lines that ran) of each of our files."""
    command = ["gcovr", "--root", ".", "--gcov-executable", "llvm-cov gcov", "--json-summary", "-", "-j",
               os.environ.get("PARLEY_JOBS", "2"), "--filter", r"src/parley_\w+/(src|include)/", build]
    report = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)
    return [(file["filename"], file["line_total"], file["line_covered"]) for file in report["files"]]


def main():
    build, packages = sys.argv[1], sys.argv[2:]
    files = summaries(build)
    if not any(ran for _, _, ran in files):
        sys.exit("No test ran.")
    low = []
    print(f"{'package':<32}{'lines':>8}{'covered':>9}")
    for package in packages:
        own = [file for file in files if file[0].startswith(f"src/{package}/")]
        total, covered = sum(file[1] for file in own), sum(file[2] for file in own)
        share = covered / total if total else 0.0
        print(f"{package:<32}{total:>8}{100 * share:>8.1f}%")
        if share < LIMIT:
            low.append(package)
            for path, lines, ran in sorted(own, key=lambda file: file[2] - file[1])[:5]:
                print(f"    {path}: {lines - ran} of {lines} lines never ran")
    for package in low:
        print(f"{package}: under {100 * LIMIT:.0f} %")
    return 1 if low else 0


if __name__ == "__main__":
    sys.exit(main())
