"""Reads the PNG files that samples write, for the scripts beside this one."""

import struct
import sys
import zlib


def read_png(path):
    """Rows of bytes, and bytes a pixel. 8 bits, RGB or RGBA, not interlaced."""
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
