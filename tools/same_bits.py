#!/usr/bin/env python3
"""Tells whether two builds of supple compute the same surfaces, to the bit.

Each file is baked with every scheme, rate and mapping, in the first clip's pose where it has a clip, and drawn as a small crowd in a
view; the files that the two programs write must have the same bytes. Where both refuse with the same exit code and the same message
they agree as well. With --positions, OLD and NEW may run on two drivers: of what is baked, only positions must be the same, and a
driver may refuse what is too large for it; each scheme is baked at one rate, which on a slow driver saves most of the time. How far
normals are apart is printed. Prints a line for each difference and the counts at the end. Exit code: 0 no difference, 1 differences,
2 bad usage.
"""
import argparse
import array
import base64
import concurrent.futures
import hashlib
import itertools
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SCHEMES = ["auto", "prep", "pm", "fragments", "loop", "blend", "catmull-clark", "polygons", "cage"]
RATES = [3, 8]
RATE_ON_DRIVERS = 5
MAPPINGS = ["narrow", "wide"]
SUFFIXES = {".glb", ".gltf", ".obj"}
POSE_TIME = 0.4  # seconds into the clip
EXIT_CODES = {0, 1, 2, 3}  # everything else is a crash


def files_of(paths):
    """The files themselves, and those below folders."""
    for path in paths:
        if path.is_dir():
            yield from sorted(p for p in path.rglob("*") if p.suffix in SUFFIXES)
        else:
            yield path


def digest(content):
    return hashlib.sha256(content).hexdigest()


def positions_of(obj):
    return b"\n".join(line for line in obj.splitlines() if line.startswith(b"v "))


def normals_of(obj):
    """All numbers of the normals, as floats in base64."""
    numbers = [float(n) for line in obj.splitlines() if line.startswith(b"vn ") for n in line.split()[1:]]
    return base64.b64encode(array.array("f", numbers).tobytes()).decode()


def apart(old, new):
    """The largest difference of two such lists, component by component."""
    pairs = zip(*(array.array("f", base64.b64decode(normals)) for normals in (old, new)))
    return max((abs(a - b) for a, b in pairs), default=0.0)


def run(program, arguments, positions):
    """What came of one call: exit code, message, the hash of each file that it wrote, by name, and normals on request."""
    with tempfile.TemporaryDirectory(prefix="same_bits_") as folder:
        done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, check=False)
        contents = {p.name: p.read_bytes() for p in sorted(Path(folder).iterdir())} if done.returncode == 0 else {}
    normals = ""
    if positions:
        objs = {name: content for name, content in contents.items() if name.endswith(".obj")}
        normals = "".join(normals_of(obj) for obj in objs.values())
        contents = {name: positions_of(obj) for name, obj in objs.items()}
    written = {name: digest(content) for name, content in contents.items()}
    message = "" if done.returncode == 0 else done.stderr.decode(errors="replace").strip()
    return {"exit": done.returncode, "message": message, "files": written, "normals": normals}


def clip_of(program, path):
    """Arguments that pose the file by its first clip; none where it has no clip, or cannot be read."""
    done = subprocess.run([program, "inspect", path, "--json"], capture_output=True, check=False)
    if done.returncode == 0 and json.loads(done.stdout)["clips"]:
        return ["--clip", "0", "--time", str(POSE_TIME)]
    return []


def cases_of(path, clip, options):
    """The calls for one file, as (name, arguments)."""
    common = options.flags.split()
    schemes, rates = (SCHEMES[1:], [RATE_ON_DRIVERS]) if options.positions else (SCHEMES, RATES)
    for scheme, rate, mapping in itertools.product(schemes, rates, MAPPINGS):
        arguments = ["bake", path, "-o", "out.obj", "--scheme", scheme, "--rate", str(rate), "--mapping", mapping]
        if scheme == "auto":  # once with patches: that of the scheme by its name is without
            arguments += ["--patches", "patches.json"]
        yield f"{path} {scheme} rate {rate} {mapping}", arguments + clip + common
    if not options.no_views:
        for scheme, mapping in itertools.product([s for s in SCHEMES if s != "cage"], MAPPINGS):
            arguments = ["profile", path, "--view", "--scheme", scheme, "--mapping", mapping, "--instances", "5"]
            arguments += ["--frames", "1", "--budget", "200000", "--motion", "--hashes", "view.txt"]
            yield f"{path} {scheme} in a view {mapping}", arguments + common


class Kept:
    """Results of OLD, kept in a file between calls; of another program they are not believed."""

    def __init__(self, path, program, positions):
        self.path = path
        self.positions = positions
        self.program = digest(Path(program).read_bytes())
        self.results = {}
        if path and path.exists():
            stored = json.loads(path.read_text())
            if stored["program"] == self.program:
                self.results = stored["results"]

    def result(self, program, arguments, content):
        key = " ".join([content, *arguments, *(["positions"] if self.positions else [])])
        if key not in self.results:
            self.results[key] = run(program, arguments, self.positions)
        return self.results[key]

    def write(self):
        if self.path:
            self.path.write_text(json.dumps({"program": self.program, "results": dict(self.results)}, indent=0))


def is_refused(result):
    return result["exit"] in EXIT_CODES - {0}


def difference(old, new):
    """In words; empty where there is none."""
    for name, result in (("OLD", old), ("NEW", new)):
        if result["exit"] not in EXIT_CODES:
            return f"{name} ended with {result['exit']}: {result['message'][-200:]}"
    if old["exit"] != new["exit"] or old["message"] != new["message"]:
        told = [f"exit code {r['exit']}" + (f" ({r['message']})" if r["message"] else "") for r in (old, new)]
        return f"OLD {told[0]}, NEW {told[1]}"
    names = sorted(set(old["files"]) | set(new["files"]))
    return ", ".join(f"{n} differs" for n in names if old["files"].get(n) != new["files"].get(n))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", metavar="OLD", help="the supple command of the build before")
    parser.add_argument("new", metavar="NEW", help="that of the build after")
    parser.add_argument("files", metavar="FILE", nargs="+", type=Path, help="glTF, GLB and OBJ files, or folders of them")
    parser.add_argument("--jobs", type=int, default=2, help="calls at a time (2)")
    parser.add_argument("--flags", default="", help="more flags of every call, such as --flags='--skinning dual-quaternion'")
    parser.add_argument("--positions", action="store_true",
                        help="only these, at one rate and without views: OLD and NEW run on two drivers")
    parser.add_argument("--no-views", action="store_true", help="without views, for builds whose profile has no --hashes")
    parser.add_argument("--keep", type=Path, help="JSON that keeps OLD's results, so that the next call takes half the time")
    options = parser.parse_args()
    old, new = (os.path.abspath(p) for p in (options.old, options.new))
    for program in (old, new):
        if not os.access(program, os.X_OK):
            parser.error(f"{program} cannot be run")
    for path in options.files:
        if not path.exists():
            parser.error(f"{path} is not there")
    kept = Kept(options.keep, old, options.positions)
    options.no_views = options.no_views or options.positions
    distances = []  # of normals
    counts = {"same": 0, "refused alike": 0, "different": 0, "refused by one": 0}

    def compare(case):
        name, arguments, content = case
        results = (kept.result(old, arguments, content), run(new, arguments, options.positions))
        return name, *results

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        paths = [os.path.abspath(p) for p in files_of(options.files)]
        clips = pool.map(lambda path: clip_of(old, path), paths)
        cases = [(name, arguments, digest(Path(path).read_bytes()))
                 for path, clip in zip(paths, clips) for name, arguments in cases_of(path, clip, options)]
        for number, (name, before, after) in enumerate(pool.map(compare, cases), 1):
            if options.positions and is_refused(before) != is_refused(after) and {before["exit"], after["exit"]} <= EXIT_CODES:
                counts["refused by one"] += 1
                continue
            what = difference(before, after)
            if options.positions and not what and before["exit"] == 0:
                distances.append(apart(before["normals"], after["normals"]))
            counts["different" if what else "refused alike" if before["exit"] else "same"] += 1
            if what:
                print(f"DIFFERENT {name}: {what}", flush=True)
            if number % 500 == 0:
                print(f"{number} of {len(cases)}", file=sys.stderr, flush=True)
                kept.write()
    kept.write()
    print(f"{len(paths)} files, {len(cases)} cases: {counts['same']} with the same {'positions' if options.positions else 'bytes'}, "
          f"{counts['refused alike']} refused alike, {counts['different']} different"
          + (f", {counts['refused by one']} refused by one driver" if options.positions else ""))
    if distances:
        print(f"normals: the same in {sum(d == 0 for d in distances)} of {len(distances)}, at most {max(distances):.1e} apart")
    return 1 if counts["different"] or not counts["same"] and options.positions or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
