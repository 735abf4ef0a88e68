#!/usr/bin/env python3
"""Reads every #include of the tree, C++ and GLSL, and refuses one that looks up or sideways.

FLOORS below is the rule; docs/architecture.md tells the same story in words. Prints each offender as FILE:LINE and
exits with 1 if there is one.

    floors.py [SOURCE_DIR]
"""

import os
import posixpath
import re
import sys

# Bottom up, one floor a line. A room is a folder, or the files whose paths begin as it says; a file belongs to the
# longest room that fits. It may include its own room and the floors below. Rooms of one floor never include each other.
FLOORS = [line.split() for line in """
    shaders/supple_patch_layout.h shaders/supple_patch_tiles.h
    base/ shaders/shared/ shaders/supple_surface.glsl shaders/trim.glsl shaders/supple_depth_pyramid.comp
    shaders/supple_patch.glsl
    shaders/supple_patch_tiles.glsl
    shaders/surface/ shaders/pose/ shaders/deform/
    shaders/lod/ shaders/soft/
    shaders/evaluate/ shaders/bounds/ shaders/bench/ shaders/draw/ shaders/recording/ shaders/points/ shaders/queries/
    shaders/prep/ shaders/pm/ shaders/subdivision/ shaders/blend/ shaders/polygons/
    shaders/chains/ shaders/fragments/
    shaders/catmull_clark/ shaders/loop/
    gpu/ cage/
    cage/gltf/ cage/obj/
    cage/formats/
    skinning/ surface/
    surface/lod/ surface/prep/ surface/pm/ surface/subdivision/ surface/blend/ surface/polygons/
    surface/chains/ surface/fragments/
    surface/catmull_clark/ surface/loop/
    surface/programs.
    surface/schemes.
    cpu/
    runtime/include/
    runtime/
    host/
    tools/common/ tools/gltf/ tools/reference/ tools/replay/
    samples/ tools/bench/ tools/creature/
    tools/supple/
    tests/
""".strip().splitlines()]

# What hosts get of Supple. These files include nothing else of the tree: they are installed without it.
PUBLIC = ["runtime/include/", "shaders/supple_surface.glsl", "shaders/supple_patch.glsl", "shaders/supple_patch_layout.h",
          "shaders/supple_patch_tiles.glsl", "shaders/supple_patch_tiles.h", "shaders/trim.glsl", "shaders/supple_depth_pyramid.comp"]

# Rooms that may include less than all floors below them: these rooms alone.
ONLY = {
    **{room: PUBLIC for room in PUBLIC},
    "host/": [*PUBLIC, "base/"],  # over the public API alone, as any host; errors as values besides
    "samples/": [*PUBLIC, "host/"],
    "tests/packaging/": PUBLIC,  # built against the installed library
}

# Headers from outside, by the beginning of their name, and the rooms of the library that may include them.
LIBRARY = ["base/", "shaders/", "gpu/", "cage/", "skinning/", "surface/", "cpu/", "runtime/"]
FOREIGN = {
    ("vulkan/",): ["gpu/", "skinning/", "surface/", "runtime/"],  # a character knows nothing of the GPU
    ("tiny_gltf", "nlohmann/", "meshoptimizer", "draco/"): ["cage/gltf/"],
    ("fstream", "filesystem", "iostream"): ["cage/gltf/", "cage/obj/", "base/utf8_path."],  # nothing else reads files or prints
    ("chrono", "ctime"): ["runtime/timings."],
    ("GLFW/", "SDL", "imgui", "backends/", "EGL/", "GL/", "unistd", "windows."): [],  # no windows, no system
}

# Includes that look up or sideways for a reason. One that is no longer needed is refused.
EXCEPTIONS = {
    ("shaders/lod/edge.comp", "shaders/blend/blend.glsl"): "levels of charts are measured on their own polynomials",
    ("shaders/lod/patch.comp", "shaders/blend/blend.glsl"): "levels of charts are measured on their own polynomials",
    ("shaders/lod/edge.comp", "shaders/catmull_clark/sample.glsl"): "levels of halves are measured on their own leaves",
    ("shaders/lod/edge.comp", "shaders/loop/sample.glsl"): "levels of halves are measured on their own leaves",
    ("shaders/lod/patch.comp", "shaders/loop/sample.glsl"): "levels of halves are measured on their own leaves",
    ("shaders/lod/patch.comp", "shaders/evaluate/frame.glsl"): "levels of halves are measured on their own leaves",
    ("shaders/lod/edge.comp", "shaders/evaluate/basis.glsl"): "levels of halves are measured on their own leaves",
    ("shaders/lod/edge.comp", "shaders/evaluate/frame.glsl"): "levels of halves are measured on their own leaves",
    ("shaders/lod/patch.comp", "shaders/chains/leaf.glsl"): "levels of halves are measured on their own leaves",
    ("shaders/lod/patch.comp", "shaders/pm/load.glsl"): "levels of sectors are measured on their own polynomials",
    ("shaders/evaluate/smooth_uvs.glsl", "shaders/pm/pm.glsl"): "smooth UVs are patches of the surface's own classes",
    ("shaders/evaluate/smooth_uvs.glsl", "shaders/pm/sector.glsl"): "smooth UVs are patches of the surface's own classes",
    ("shaders/evaluate/smooth_uvs.glsl", "shaders/pm/point.glsl"): "smooth UVs are patches of the surface's own classes",
    ("shaders/evaluate/smooth_uvs.glsl", "shaders/blend/sample.glsl"): "smooth UVs are charts of the surface's own kind",
    ("shaders/evaluate/smooth_uvs.glsl", "shaders/catmull_clark/sample.glsl"): "smooth UVs are quads of leaves, as irregular ones",
    ("shaders/evaluate/smooth_uvs.glsl", "shaders/loop/place.glsl"): "smooth UVs are triangles of leaves, too",
    ("shaders/evaluate/edge.comp", "shaders/pm/border.glsl"): "an edge of shared samples may border a sector",
}

# Headers that the build writes: of shaders, and by rooms for themselves.
GENERATED = re.compile(r"surface/kernels\.h$|shaders/\w+_(comp|vert|frag|mesh)\w*\.h$|bench_characters\.h$")

# An include is looked up from the root, from these, and from the folder of the file that includes.
INCLUDE_FOLDERS = ["", "runtime/include", "shaders"]

SOURCES = (".h", ".hpp", ".c", ".cpp", ".glsl", ".comp", ".vert", ".frag", ".mesh")
SKIPPED_FOLDERS = re.compile(r"\.|build|cmake-build|_|out$|docs$|cmake$")
INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^">]+)[">]')


def source_files(root):
    """Every source file of the tree, as a path below the root with forward slashes."""
    found = []
    for folder, folders, files in os.walk(root):
        if folder == root:
            folders[:] = [name for name in folders if not SKIPPED_FOLDERS.match(name)]
        below = os.path.relpath(folder, root).replace(os.sep, "/")
        found += [posixpath.normpath(posixpath.join(below, name)) for name in files if name.endswith(SOURCES)]
    return sorted(found)


def longest(path, rooms):
    """The longest of the rooms that the path is in, or None."""
    return max((room for room in rooms if path.startswith(room)), key=len, default=None)


ROOMS = {room: number for number, floor in enumerate(FLOORS) for room in floor}


def find(name, includer, files):
    """The file of the tree that an include means, or None."""
    for folder in [posixpath.dirname(includer), *INCLUDE_FOLDERS]:
        path = posixpath.normpath(posixpath.join(folder, name))
        if path in files:
            return path
    return None


def fault_of_foreign(path, name):
    """Why a file may not include a header from outside, or None."""
    if longest(path, LIBRARY) is None:
        return None
    for beginnings, rooms in FOREIGN.items():
        if name.startswith(beginnings) and longest(path, rooms) is None:
            return f"<{name}> is only for {', '.join(rooms) if rooms else 'hosts'}"
    return None


def fault_of_rooms(path, included):
    """Why a file may not include another one of the tree, or None."""
    room, other = longest(path, ROOMS), longest(included, ROOMS)
    if other == room:
        return None
    if ROOMS[other] > ROOMS[room]:
        return f'"{included}" looks up, from {room} to {other}'
    if ROOMS[other] == ROOMS[room]:
        return f'"{included}" looks sideways, from {room} to {other}'
    only = longest(path, ONLY)
    if only is not None and longest(included, ONLY[only]) is None:
        return f'"{included}": {only} may include only {", ".join(ONLY[only])}'
    return None


def offences(root, exceptions=None):
    """One line for each include that is refused, and for each exception that is not needed."""
    exceptions = EXCEPTIONS if exceptions is None else exceptions
    files = source_files(root)
    known = set(files)
    used = set()
    lines = []
    for path in files:
        if longest(path, ROOMS) is None:
            lines.append(f"{path}:1: the folder has no floor (tests/floors/floors.py)")
            continue
        with open(os.path.join(root, path), encoding="utf-8") as text:
            includes = [(number, match) for number, line in enumerate(text, 1) if (match := INCLUDE.match(line))]
        for number, match in includes:
            quote, name = match.groups()
            included = find(name, path, known)
            if included is not None:
                fault = fault_of_rooms(path, included)
            elif quote == "<":
                fault = fault_of_foreign(path, name)
            else:
                fault = None if GENERATED.match(name) else f'"{name}" is no file of the tree'
            if fault is not None and (path, included) in exceptions:
                used.add((path, included))
            elif fault is not None:
                lines.append(f"{path}:{number}: {fault}")
    for path, included in sorted(set(exceptions) - used):
        lines.append(f'{path}:1: "{included}" needs no exception (tests/floors/floors.py)')
    return lines


def main():
    root = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "..", ".."))
    lines = offences(root)
    print("\n".join(lines) if lines else f"{len(source_files(root))} files: every include looks down")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
