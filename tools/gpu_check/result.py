#!/usr/bin/env python3
"""Puts what tools/gpu_check.sh has left in a folder so far into one file: result.py FOLDER RESULT.json."""
import csv
import json
import re
import statistics
import sys
import xml.etree.ElementTree
from pathlib import Path

TIMED_OUT = (124, 137)  # exit codes of timeout(1)
# What lies beside the keys of old: measurements of gpu_check.sh by their names there.
MEASUREMENTS = {"profile": "profile", "view": "view", "scene": "scene", "sceneGrouped": "scene_grouped", "levels": "levels",
                "loopLevels": "loop_levels", "triangles": "triangles", "kernels": "kernels"}


def read_json(path):
    """None where there is none, or where its writer was ended while it wrote."""
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return None


def read_steps(path):
    with path.open() as file:
        return [read_step(*row) for row in csv.reader(file)]


def read_step(step, seconds, code, left_out):
    if left_out:
        return {"step": step, "seconds": 0, "exitCode": None, "timedOut": False, "leftOut": left_out}
    return {"step": step, "seconds": int(seconds), "exitCode": int(code), "timedOut": int(code) in TIMED_OUT}


def read_tests(path):
    """ctest writes its JUnit file at its end: None where it did not come to that."""
    try:
        cases = xml.etree.ElementTree.parse(path).getroot().findall("testcase")
    except (OSError, xml.etree.ElementTree.ParseError):
        return None
    names = {"run": [], "fail": [], "notrun": [], "disabled": []}
    for case in cases:
        names.setdefault(case.get("status"), []).append(case.get("name"))
    return {
        "passed": len(names["run"]),
        "failed": len(names["fail"]),
        "skipped": len(names["notrun"]) + len(names["disabled"]),
        "failedNames": names["fail"],
        "skippedNames": names["notrun"] + names["disabled"],
    }


def read_suites(path):
    """From what several processes of GoogleTest print, each line behind the number of its process; they may have been ended."""
    try:
        lines = path.read_text(errors="replace").splitlines()
    except OSError:
        return None
    selected, started, passed, failed, skipped = 0, {}, [], [], []
    for line in lines:
        process, _, text = line.partition(": ")
        if found := re.match(r"\[=+\] Running (\d+) tests? from", text):
            selected += int(found[1])
        elif found := re.match(r"\[ RUN      \] (\S+)", text):
            started[process] = found[1]
        elif (found := re.match(r"\[(       OK |  FAILED  |  SKIPPED )\] ([^ ,]+)", text)) and started.get(process) == found[2]:
            del started[process]
            {"OK": passed, "FAILED": failed, "SKIPPED": skipped}[found[1].strip()].append(found[2])
    ended = sorted(started.values())  # while they ran: by time, or because they crashed
    return {
        "passed": len(passed),
        "failed": len(failed),
        "skipped": len(skipped),
        "notRun": selected - len(passed) - len(failed) - len(skipped) - len(ended),
        "failedNames": sorted(failed),
        "skippedNames": sorted(skipped),
        "endedNames": ended,
    }


def read_clocks(path):
    """Least, median and largest of every column of nvidia-smi that is numbers; None without nvidia-smi."""
    if not path.exists():
        return None
    with path.open() as file:
        rows = list(csv.reader(file, skipinitialspace=True))
    summary = {"samples": max(len(rows) - 1, 0)}
    for column, name in enumerate(rows[0] if rows else []):
        values = [float(row[column]) for row in rows[1:]
                  if len(row) > column and re.fullmatch(r"-?\d+(\.\d+)?", row[column])]
        if values:
            summary[name] = {"least": min(values), "median": statistics.median(values), "largest": max(values)}
    return summary


def main():
    folder, target = Path(sys.argv[1]), Path(sys.argv[2])
    bench = read_json(folder / "bench.json")
    device = read_json(folder / "device.json")
    text = folder / "machine.txt"
    result = {
        "machine": device["machine"] if device else None,
        "system": text.read_text().splitlines() if text.exists() else [],
        "clocks": read_clocks(folder / "clocks.csv"),
        "steps": read_steps(folder / "steps.csv"),
        "tests": read_tests(folder / "tests.xml"),
        "suites": read_suites(folder / "suites.txt"),
        "patchSuites": read_suites(folder / "patch_suites.txt"),
        "crowd": bench.pop("crowd", None) if bench else None,
        "bench": bench,
    }
    result.update({key: read_json(folder / f"{name}.json") for key, name in MEASUREMENTS.items()})
    whole = target.with_suffix(".json.new")
    whole.write_text(json.dumps(result, indent=2) + "\n")
    whole.replace(target)  # never half a file


if __name__ == "__main__":
    main()
