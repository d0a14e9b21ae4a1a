# SPDX-License-Identifier: BSD-3-Clause
"""Tables of a campaign's results, in Markdown."""
from collections import defaultdict


def mean(values):
    """Mean of the values that are not None; None if there are none."""
    known = [v for v in values if v is not None]
    return sum(known) / len(known) if known else None


def text(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def row(name, results):
    robots = [r for result in results for r in result["robots"]]
    reached = [r for r in robots if r["reached"]]
    regrets = [r["length"] / r["shortest"] for r in reached if r["shortest"]]
    collisions = sum(sum(result["collisions"].values()) for result in results)
    speed = sum(r["length"] for r in reached) / max(1e-9, sum(r["time"] for r in reached))
    cells = [name, len(results), f"{sum(r['success'] for r in results)}", f"{len(reached)}/{len(robots)}", collisions,
             text(mean(r["time"] for r in reached), 1), text(mean(r["length"] for r in reached), 1),
             text(mean(regrets)), text(speed if reached else None),
             text(mean(r["stopped"] for r in reached), 1),
             text(mean(result["simulated"] / result["wall"] for result in results), 0)]
    return "| " + " | ".join(str(c) for c in cells) + " |"


def summary(results):
    """One row a world and label, and one for all."""
    head = ("| world | runs | success | reached | collisions | time [s] | length [m] | regret | speed [m/s] | stood [s] | x real time |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|")
    by_world = defaultdict(list)
    for result in results:
        plain = not result["label"] or result["label"].startswith("robot")
        label = "" if plain else f", {result['label']}"
        by_world[result["world"] + label].append(result)
    rows = [row(name, group) for name, group in by_world.items()]
    return "\n".join([head, *rows, row("all", results)])


def failures(results):
    """A line for each run that was no success."""
    lines = []
    for result in results:
        states = ", ".join(f"{r['name']} {r['final_state']}" for r in result["robots"] if not r["reached"])
        lines.append(f"not a success: {result['world']} {result['label']} seed {result['seed']}: "
                     f"collisions {result['collisions']}; {states}")
    return "\n".join(lines)
