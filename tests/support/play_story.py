#!/usr/bin/env python3
"""Lets the sample play tell its story, and looks at what it says.

play_story.py SUPPLE_PLAY FOLDER

The character comes to where it is sent, stands with its soles on the ground, falls when it is hit, lies on the ground, and gets
up. No bone changes its length, nothing jumps, and two runs have the same words.
"""

import pathlib
import subprocess
import sys

from png_rows import read_png

SIZE, PICTURES = (120, 120), 6


def run(program, folder, frames):
    """What the program prints: a word for each name."""
    strip = folder / f"story_{frames}.png"
    command = [program, "--script", "--fps", str(frames), "--rate", "1", "--size", f"{SIZE[0]}x{SIZE[1]}", "-o", str(strip)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    rows, step = read_png(strip)
    if len(rows) != SIZE[1] or len(rows[0]) != SIZE[0] * PICTURES * step:
        sys.exit(f"{strip}: not {PICTURES} pictures of {SIZE}")
    return dict(line.split() for line in done.stdout.splitlines())


def faults_of(facts):
    """What is wrong with one run."""
    number = {name: float(word) for name, word in facts.items() if name != "words"}
    limits = {  # in units: Wren is 1.76 tall
        "from-goal": 0.05,  # from where it was sent to, when it has stopped
        "sole": 0.01,       # of a standing ankle from its height above the ground
        "stretch": 0.005,   # of a bone, as a part of its length
        "fastest": 8.0,     # joint, a second: the back of a head that falls has 7
        "deepest": 0.2,     # vertex in the ground: skirt and hair, when it lies on them
        "in-ground": 0.03,  # vertex of a foot, when it walks
        "lying": 0.25,      # the lowest height of the hips
    }
    faults = [f"{name} {number[name]} is above {limit}" for name, limit in limits.items() if not number[name] <= limit]
    for name, wanted in (("arrivals", 1), ("falls", 1), ("rises", 1), ("finite", 1)):
        if number[name] != wanted:
            faults.append(f"{name} {number[name]}, not {wanted}")
    if number["standing"] == 0:
        faults.append("no foot was seen standing")
    return faults


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    faults = []
    for frames in (8, 30):
        facts = run(program, folder, frames)
        print(f"{frames} frames a second: {facts}")
        faults += [f"{frames} frames a second: {fault}" for fault in faults_of(facts)]
    again = run(program, folder, 8)
    if again["words"] != run(program, folder, 8)["words"]:
        faults.append("two runs have different words")
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
