#!/usr/bin/env python3
"""Runs a sample twice, under each of Qt's two render loops, and looks at the pictures that it writes.

    shown_twice.py FOLDER PROGRAM ARGUMENTS...

Both must have the same pixels, and the left half must show the character: at least a twentieth of it is his skin.
"""

import os
import subprocess
import sys

from png_rows import read_png


def skin(rows, step):
    """The share of the left half that is teal. Nothing else in the picture is."""
    half = len(rows[0]) // step // 2
    pixels = [row[x * step:x * step + 3] for row in rows for x in range(half)]
    return sum(1 for red, green, blue in pixels if min(green, blue) > red + 40) / len(pixels)


def main():
    folder, command = sys.argv[1], sys.argv[2:]
    pictures = []
    for loop in ("threaded", "basic"):
        path = os.path.join(folder, f"{loop}.png")
        if os.path.exists(path):
            os.remove(path)
        done = subprocess.run([*command, "--picture", path], env={**os.environ, "QSG_RENDER_LOOP": loop}, check=False)
        if done.returncode != 0:
            sys.exit(f"{loop}: exit code {done.returncode}")
        pictures.append(read_png(path))
    if pictures[0] != pictures[1]:
        differing = sum(a != b for a, b in zip(pictures[0][0], pictures[1][0]))
        sys.exit(f"the two pictures differ in {differing} rows")
    share = skin(*pictures[0])
    print(f"{share:.1%} of the left half is the character's skin")
    if share < 0.05:
        sys.exit("the character is not to be seen")


if __name__ == "__main__":
    main()
