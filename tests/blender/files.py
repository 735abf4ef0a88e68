"""Inside Blender: files.py OUT FILE.glb.. imports each file and exports it again. The file that comes out must hold the same
cage. What Blender's armature and its limit surface make of it, at three times of each clip, goes to OUT/cases.json for
supple_blender_limit."""

import json
import math
import os
import sys

import bpy

import evaluated
import round_trip
import support


# Of the extent, where Blender's exporter itself is further off: it writes the rotation of a bone (eagle: Bone.004, pip_quads:
# middleB) 1e-5 to 3e-5 beside Blender's own pose.
LARGEST_DISTANCES = {"eagle": 4e-6, "pip_quads": 7e-6}


def frames_of(first, last):
    first, last = math.ceil(first), math.floor(last)
    return sorted({first + round((last - first) * share) for share in (0.25, 0.5, 0.9)})


def poses_of(folder, name, objects):
    poses = []
    for clip, (first, last) in sorted(support.clips().items()):
        support.play(clip)
        for frame in frames_of(first, last):
            bpy.context.scene.frame_set(frame)
            points = os.path.join(folder, "%s.%d.points" % (name, len(poses)))
            evaluated.write_points(objects, points)
            poses.append({"clip": clip, "time": frame / bpy.context.scene.render.fps, "points": points})
    return poses


def take(folder, path):
    """The case for the comparison, and what differs between the files."""
    support.start()
    support.import_glb(path)
    name = os.path.splitext(os.path.basename(path))[0]
    exported = os.path.join(folder, name + ".glb")
    support.export_glb(exported, export_all_influences=True)
    faults = round_trip.compare(path, exported)
    print("%-34s %s" % (name, ", ".join("%s at most %.2g" % item for item in faults.worst.items())))
    objects = support.meshes()
    if any(support.forget_exact_sharpness(o.data) for o in objects):
        support.export_glb(exported, export_all_influences=True)
    for blender_object in objects:
        evaluated.subdivide(blender_object)
    poses = poses_of(folder, name, objects)
    if not poses:
        points = os.path.join(folder, name + ".points")
        evaluated.write_points(objects, points)
        poses = [{"points": points}]
    case = {"name": name, "file": exported, "rate": 1 << evaluated.LEVELS, "poses": poses}
    if name in LARGEST_DISTANCES:
        case["limit"] = LARGEST_DISTANCES[name]
    return case, faults


def main():
    folder, *files = support.arguments()
    cases, failed = [], False
    for path in files:
        case, faults = take(folder, path)
        cases.append(case)
        for line in faults.lines[:8]:
            failed = True
            print("FAILED: %s: %s" % (case["name"], line))
    with open(os.path.join(folder, "cases.json"), "w") as stream:
        json.dump(cases, stream, indent=1)
    print("%d files there and back" % len(files))
    if failed or not files:
        sys.exit(1)


main()
