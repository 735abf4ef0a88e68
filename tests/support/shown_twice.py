#!/usr/bin/env python3
"""Runs a sample twice, under each of Qt's two render loops, and looks at the pictures that it writes.

    shown_twice.py FOLDER PROGRAM ARGUMENTS...

Both must have the same pixels, and the left half must show the character: at least a twentieth of it is his skin.
"""

import os
import struct
import subprocess
import sys
import zlib


def read_png(path):
    """Rows of bytes, and bytes a pixel. What Qt writes: 8 bits, RGB or RGBA, not interlaced."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed, step, stride = 8, b"", 0, 0
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        chunk = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, _, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", chunk)
            if depth != 8 or interlaced != 0:
                sys.exit(f"{path}: another PNG than expected")
            step = {2: 3, 6: 4}[color]
            stride = width * step
        elif kind == b"IDAT":
            packed += chunk
        at += 12 + size
    raw, rows, above = zlib.decompress(packed), [], bytearray(stride)
    for start in range(0, len(raw), stride + 1):
        above = unfilter(raw[start], bytearray(raw[start + 1:start + 1 + stride]), above, step)
        rows.append(above)
    return rows, step


def unfilter(method, row, above, step):
    """A row without PNG's filter."""
    for i, value in enumerate(row):
        left = row[i - step] if i >= step else 0
        up, corner = above[i], above[i - step] if i >= step else 0
        if method == 4:
            guess = left + up - corner
            left = min((left, up, corner), key=lambda near: abs(guess - near))
        row[i] = (value + (0, left, up, (left + up) // 2, left)[method]) & 255
    return row


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
