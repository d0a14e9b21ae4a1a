#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a result of fleet_run as a table, a row for each robot: results.py RESULT.json."""
import json
import sys

COLUMNS = (("robot", "<12"), ("reached", ">9"), ("time [s]", ">10"), ("length [m]", ">12"), ("shortest [m]", ">14"),
           ("regret", ">8"), ("speed [m/s]", ">13"), ("clearance [m]", ">15"))


def number(value, digits):
    """What has no value is a dash."""
    return "-" if value is None else f"{value:.{digits}f}"


def row(robot):
    """The cells of a robot's row; regret is its length over the shortest that there is."""
    length, shortest = robot["length"], robot["shortest"]
    regret = length / shortest if robot["reached"] and length and shortest else None
    return (robot["name"], "yes" if robot["reached"] else robot["final_state"], number(robot["time"], 1),
            number(length, 1), number(shortest, 1), number(regret, 2), number(robot["mean_speed"], 2),
            number(robot["min_clearance"], 2))


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        result = json.load(file)
    print("".join(f"{title:{width}}" for title, width in COLUMNS))
    for robot in result["robots"]:
        print("".join(f"{cell:{width}}" for cell, (_, width) in zip(row(robot), COLUMNS)))
    collisions = result["collisions"]
    print(f"\ncollisions: {collisions['static']} with walls, {collisions['robot']} between robots, "
          f"{collisions['moving']} with moving obstacles")
    print(f"{'success' if result['success'] else 'no success'}: {result['simulated']:.1f} s simulated in {result['wall']:.1f} s")


if __name__ == "__main__":
    main()
