#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a JSON file of Google Benchmark as a table of medians and, where a benchmark counts them, p50 and p99."""
import json
import sys

MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
STANDARD = {"name", "run_name", "run_type", "aggregate_name", "aggregate_unit", "label", "time_unit", "iterations",
            "repetitions", "repetition_index", "family_index", "per_family_instance_index", "threads",
            "real_time", "cpu_time"}


def medians(entries):
    """One entry for each benchmark: the median of its repetitions, or its only run."""
    chosen = {}
    for entry in entries:
        if entry.get("aggregate_name", "median") == "median":
            chosen[entry["run_name"]] = entry
    return chosen.values()


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        entries = json.load(file)["benchmarks"]
    print(f"{'benchmark':<48}{'median [ms]':>12}  counters")
    for entry in medians(entries):
        time = entry["cpu_time"] * MILLISECONDS[entry["time_unit"]]
        counters = "  ".join(f"{key} {value:.4g}" for key, value in entry.items() if key not in STANDARD)
        print(f"{entry['run_name']:<48}{time:>12.4f}  {counters}")


if __name__ == "__main__":
    main()
