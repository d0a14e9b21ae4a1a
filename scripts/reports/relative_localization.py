#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures relative localization: the table over all worlds, the sweeps, and real logs where some are given.

PROGRAMS is the folder of encounter_study and log_study; results go to OUTPUT as text and JSON. PATHS are further worlds
(map_server's .yaml) and logs of the CARMEN toolkit (.log, .log.gz). Exits with 1 if any pose was confirmed wrong or a limit
of the table does not hold."""
import argparse
import json
import subprocess
import sys
from pathlib import Path

WORLDS = ["maps/scenario_a.yaml", "maps/scenario_b.yaml", "maps/scenario_c.yaml", "maps/campus.yaml", "mirrored", "periodic"]
SWEPT_WORLDS = ["maps/scenario_a.yaml", "maps/scenario_c.yaml", "mirrored"]
SWEEPS = {"as_it_is": [], "offset_0.1": ["--offset", "0.1"], "offset_0.2": ["--offset", "0.2"], "loss_0.5": ["--loss", "0.5"],
          "loss_0.9": ["--loss", "0.9"], "noise_0.05": ["--noise", "0.05"], "drift_5": ["--drift", "5"],
          "clutter_6": ["--clutter", "6"], "range_8": ["--range", "8"]}
REPLAYS = {"painted": (1, []), "surfaces_alone": (2, ["--unpainted"]), "scans_alone": (2, ["--scans-alone"])}
PERIODIC = "periodic"
TOGETHER = "all_but_periodic"


def limits_of(row):
    """What is promised of all worlds but the periodic one: (what, measured, limit, whether it holds)."""
    confirmed = max(row["confirmed"], 1)
    most = [("error, median [m]", row["translation_error"]["p50"], 0.02),
            ("error, 95th percentile [m]", row["translation_error"]["p95"], 0.07),
            ("error, median [degrees]", row["rotation_error_degrees"]["p50"], 0.25),
            ("error, 95th percentile [degrees]", row["rotation_error_degrees"]["p95"], 0.9),
            ("a match, 99th percentile [ms]", row["match_ms"]["p99"], 8.0),
            ("bytes an encounter, median", row["bytes"]["p50"], 800.0)]
    least = [("confirmed", row["confirmed"] / max(row["encounters"], 1), 0.6),
             ("of these within 2 m", row["within_two_metres"] / confirmed, 0.5)]
    return ([(*limit, limit[1] <= limit[2]) for limit in most] + [(*limit, limit[1] >= limit[2]) for limit in least])


def wrong_in(result):
    """Over the worlds of a result; its sum over several of them is left out."""
    return sum(row["wrong"] + row["wrong_elsewhere"] for name, row in result.items() if name not in (TOGETHER, "all"))


def run(program, arguments, output):
    """Prints and keeps what the program says; its JSON."""
    path = Path(f"{output}.json")
    path.unlink(missing_ok=True)
    command = [str(program), *map(str, arguments), "--json", str(path)]
    print(" ".join(command), flush=True)
    with open(f"{output}.log", "w", encoding="utf-8") as log:
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        for line in process.stdout:
            print(line, end="", flush=True)
            log.write(line)
        status = process.wait()
    if not path.exists():
        sys.exit(f"{program}: no result, status {status}")
    return json.loads(path.read_text(encoding="utf-8"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("paths", nargs="*", type=Path)
    parser.add_argument("--encounters", type=int, default=2000, help="in all worlds together, and as many robots elsewhere")
    parser.add_argument("--swept", type=int, default=60, help="encounters of each sweep, and half as many elsewhere")
    parser.add_argument("--replayed", type=int, default=200, help="encounters of each log, and three quarters as many elsewhere; half of both where bodies are not "
                             "painted or the log's scans are alone")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_intermixed_args()
    worlds = [path for path in given.paths if path.suffix == ".yaml"]
    logs = [path for path in given.paths if path.suffix in (".log", ".gz")]
    if unknown := set(given.paths) - set(worlds) - set(logs):
        parser.error(f"neither a world (.yaml) nor a log (.log, .log.gz): {', '.join(map(str, unknown))}")
    seed = ["--seed", given.seed]
    study, replay = given.programs / "encounter_study", given.programs / "log_study"

    counts = ["--encounters", given.encounters, "--elsewhere", given.encounters]
    results = {"table": run(study, [*WORLDS, *worlds, *counts, *seed], given.output / "encounters")}
    counts = ["--encounters", given.swept, "--elsewhere", given.swept // 2]
    for name, arguments in SWEEPS.items():
        results[name] = run(study, [*SWEPT_WORLDS, *counts, *seed, *arguments], given.output / f"encounters_{name}")
    for name, (part, arguments) in REPLAYS.items() if logs else ():
        counts = ["--encounters", given.replayed // part, "--elsewhere", 3 * given.replayed // (4 * part)]
        results[name] = run(replay, [*logs, *counts, *seed, *arguments], given.output / f"logs_{name}")
    if not logs:
        print("No log given: encounters in real scans are not measured. Logs are no part of this repository; give paths of "
              "CARMEN logs with corrected poses.")

    wrong = sum(map(wrong_in, results.values()))
    limits = limits_of(results["table"][TOGETHER])
    for what, measured, limit, holds in limits:
        print(f"{what:<36}{measured:>10.3f}  limit {limit:<8g}{'holds' if holds else 'DOES NOT HOLD'}")
    print(f"{'wrong poses confirmed':<36}{wrong:>10}  limit 0       {'holds' if wrong == 0 else 'DOES NOT HOLD'}")
    return 0 if wrong == 0 and all(limit[3] for limit in limits) else 1


if __name__ == "__main__":
    sys.exit(main())
