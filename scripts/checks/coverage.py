#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Line coverage of each package's src/ and include/, from a build with clang's coverage: coverage.py BUILD_DIR PACKAGE...

Prints a table, names the files that lack most, and fails if a package is under the limit.
"""
import json
import subprocess
import sys
from pathlib import Path

LIMIT = 0.90  # of the lines [-]


def summaries(build):
    """(path, lines, lines covered) of each file that the build's libraries and tests hold."""
    profile = build / "coverage.profdata"
    raw = sorted(map(str, (build / "profiles").glob("*.profraw")))
    subprocess.run(["llvm-profdata", "merge", "-sparse", "-o", str(profile), *raw], check=True)
    objects = sorted(map(str, build.glob("devel/lib/*.so"))) + sorted(map(str, build.glob("devel/lib/*/*_test")))
    named = [word for name in objects for word in ("-object", name)][1:]
    report = subprocess.run(["llvm-cov", "export", "-summary-only", f"-instr-profile={profile}", *named],
                            check=True, capture_output=True, text=True).stdout
    for entry in json.loads(report)["data"][0]["files"]:
        lines = entry["summary"]["lines"]
        yield Path(entry["filename"]), lines["count"], lines["covered"]


def main():
    build, packages = Path(sys.argv[1]), sys.argv[2:]
    files = list(summaries(build))
    low = []
    print(f"{'package':<32}{'lines':>8}{'covered':>9}")
    for package in packages:
        own = [file for file in files if f"/src/{package}/src/" in str(file[0]) or f"/src/{package}/include/" in str(file[0])]
        total, covered = sum(file[1] for file in own), sum(file[2] for file in own)
        share = covered / total if total else 0.0
        print(f"{package:<32}{total:>8}{100 * share:>8.1f}%")
        if share < LIMIT:
            low.append(package)
            for path, count, hit in sorted(own, key=lambda file: file[2] - file[1])[:5]:
                print(f"    {path.name}: {count - hit} of {count} lines never ran")
    for package in low:
        print(f"{package}: under {100 * LIMIT:.0f} %")
    return 1 if low else 0


if __name__ == "__main__":
    sys.exit(main())
