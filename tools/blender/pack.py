#!/usr/bin/env python3
"""Packs the add-on: pack.py OUT.zip. One file for Blender 3.4 and later, and for the extensions of 4.2 and later. The same
sources give the same bytes."""

import pathlib
import sys
import zipfile

FOLDER = pathlib.Path(__file__).resolve().parent / "supple"


def pack(output):
    with zipfile.ZipFile(output, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(FOLDER.rglob("*")):
            if path.suffix in (".py", ".toml"):
                entry = zipfile.ZipInfo("supple/" + path.relative_to(FOLDER).as_posix(), (2020, 1, 1, 0, 0, 0))
                entry.external_attr = 0o644 << 16
                entry.compress_type = zipfile.ZIP_DEFLATED
                archive.writestr(entry, path.read_bytes())


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: pack.py OUT.zip")
    pack(sys.argv[1])
