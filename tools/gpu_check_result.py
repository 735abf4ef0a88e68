#!/usr/bin/env python3
"""Puts what tools/gpu_check.sh has left in a folder so far into one result.json: gpu_check_result.py FOLDER."""
import csv
import json
import re
import statistics
import sys
import xml.etree.ElementTree
from pathlib import Path

TIMED_OUT = 124  # exit code of timeout(1)


def read_json(path):
    """None where there is none, or where its writer was ended while it wrote."""
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return None


def read_steps(path):
    with path.open() as file:
        return [
            {"step": step, "seconds": int(seconds), "exitCode": int(code), "timedOut": int(code) == TIMED_OUT}
            for step, seconds, code in csv.reader(file)
        ]


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
    folder = Path(sys.argv[1])
    bench = read_json(folder / "bench.json")
    device = read_json(folder / "device.json")
    text = folder / "machine.txt"
    result = {
        "machine": device["machine"] if device else None,
        "system": text.read_text().splitlines() if text.exists() else [],
        "clocks": read_clocks(folder / "clocks.csv"),
        "steps": read_steps(folder / "steps.csv"),
        "tests": read_tests(folder / "tests.xml"),
        "crowd": bench.pop("crowd", None) if bench else None,
        "bench": bench,
        "profile": read_json(folder / "profile.json"),
        "view": read_json(folder / "view.json"),
    }
    whole = folder / "result.json.new"
    whole.write_text(json.dumps(result, indent=2) + "\n")
    whole.replace(folder / "result.json")  # never half a file


if __name__ == "__main__":
    main()
