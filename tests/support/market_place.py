#!/usr/bin/env python3
"""Runs the market place and looks at what it says and shows.

market_place.py SUPPLE_SCENE FOLDER

With room for all vertices, levels are not scaled, and every figure is drawn. With nine tenths of what they want, no more than
that is written, still everybody is there, and the picture is nearly the same. Without them it is another picture.
"""

import pathlib
import subprocess
import sys

from png_rows import read_png

FIGURES, ROOM, SIZE = 4, 600000, "800x450"


def run(program, picture, figures, budget):
    """The numbers that the program prints."""
    command = [program, "--offscreen", "--frames", "3", "--size", SIZE, "--figures", str(figures), "--budget", str(budget),
               "--screenshot", str(picture)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    lines = [line.split() for line in done.stdout.splitlines()]
    return {words[0]: float(words[1]) for words in lines if len(words) == 2}


def difference(a, b):
    """The share of pixels that differ by more than an eye forgives."""
    (rows, step), (others, _) = read_png(a), read_png(b)
    left, right = b"".join(rows), b"".join(others)
    count = len(left) // step
    unlike = sum(any(abs(left[i + c] - right[i + c]) > 40 for c in range(3)) for i in range(0, len(left), step))
    return unlike / count


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    whole, scarce, empty = (folder / f"scene_{name}.png" for name in ("whole", "scarce", "empty"))
    room = run(program, whole, FIGURES, ROOM)
    budget = int(0.9 * room["vertices"])
    little = run(program, scarce, FIGURES, budget)
    run(program, empty, 1, ROOM)
    faults = []

    def expect(holds, what):
        if not holds:
            faults.append(what)

    for name, facts in (("with room", room), ("scarce", little)):
        expect(facts["figures"] == FIGURES and facts["drawn"] == FIGURES and facts["dropped"] == 0, f"{name}: figures {facts}")
        expect(0 < facts["vertices"] <= facts["budget"], f"{name}: vertices {facts}")
    expect(room["scale"] == 1, f"with room levels are scaled: {room}")
    expect(little["scale"] < 1 and little["vertices"] < room["vertices"], f"levels are not scaled: {little}")
    coarser, without = difference(whole, scarce), difference(whole, empty)
    print(f"{room['vertices']:.0f} vertices, then {little['vertices']:.0f}: {coarser:.4f} of the picture differs; "
          f"without figures {without:.4f}")
    expect(coarser < 0.004, "fewer vertices show too much")
    expect(without > 0.02, "nobody is to be seen")
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
