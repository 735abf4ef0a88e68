#!/usr/bin/env python3
"""Puts a run's tables into docs/benchmarks.md, and its plots into docs/images.

supple bench --rounds 7 --json result.json --plots plots > tables.txt; tools/bench_docs.py tables.txt plots

Each table under "### Results: lavapipe" is replaced by the one of the same cage and the same first cell. The text
between them is about the run before: read it again. "How old the figures are" at the top of the page, too.
"""

import pathlib
import re
import shutil
import sys

DOCS = pathlib.Path(__file__).parent.parent / "docs"
PLOTS = ("bench_sphere_points.svg", "bench_pip_points.svg", "bench_pip_frame.svg")
BEGIN, END = "### Results: lavapipe on two cores", "#### The same on two cores"


def blocks(text):
    """(key, lines) of what stands in text, in order; the key of a table is (cage or "", first cell), of others None."""
    cage, block = "", []
    for line in text.split("\n") + [""]:
        if line.startswith("|"):
            block.append(line)
            continue
        if block:
            yield (cage, block[0].split("|")[1].strip()), block
            block = []
        heading = re.match(r"#+ (\w+), [\d,]+ faces", line)
        if heading or line.startswith("#"):
            cage = heading[1] if heading else ""
        yield None, [line]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    new = {key: lines for key, lines in blocks(pathlib.Path(sys.argv[1]).read_text()) if key}
    page = DOCS / "benchmarks.md"
    before, rest = page.read_text().split(BEGIN)
    results, after = rest.split(END)
    lines = []
    for key, block in blocks(results):
        if key and key not in new:
            sys.exit(f"the run has no table {key}")
        lines += new[key] if key else block
    page.write_text(before + BEGIN + "\n".join(lines[:-1]) + END + after)
    for plot in PLOTS:
        shutil.copy(pathlib.Path(sys.argv[2]) / plot, DOCS / "images" / plot)


if __name__ == "__main__":
    main()
