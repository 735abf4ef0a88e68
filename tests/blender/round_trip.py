"""What must be the same in a file and in what Blender makes of it: import, then export."""

import numpy as np

import glb

# Blender keeps 1 - v, and so does its exporter: what is lost is a unit in the last place of 1 or of what is larger.
UV_ROUNDING = 2.0**-24
# The importer keeps colors as bytes in sRGB, which are farthest apart at white.
COLOR_ROUNDING = 0.006


def ulps(a, b):
    """How many floats lie between two, at most."""
    return np.abs(np.asarray(a, np.float32).view(np.int32).astype(np.int64) -
                  np.asarray(b, np.float32).view(np.int32).astype(np.int64))


class Faults:
    def __init__(self):
        self.lines = []
        self.worst = {}

    def expect(self, good, text):
        if not good:
            self.lines.append(text)

    def at_most(self, name, value, limit):
        self.worst[name] = max(self.worst.get(name, 0), value)
        self.expect(value <= limit, "%s: %g, more than %g" % (name, value, limit))


def compare_weights(before, after, faults):
    for rank, (old, new) in enumerate(zip(before.normalized_weights(), after.normalized_weights())):
        if set(old) != set(new):
            faults.expect(False, "vertex %d: joints %s became %s" % (rank, sorted(old.items()), sorted(new.items())))
            continue
        for joint, weight in old.items():
            faults.at_most("weights, ulp", int(ulps(weight, new[joint])), 1)


def compare_creases(before, after, faults):
    old, new = ({edge: s for edge, s in cage.creases.items() if s > 0} for cage in (before, after))
    faults.expect(set(old) == set(new), "other edges are creases")
    for edge in set(old) & set(new):
        faults.at_most("creases, ulp", int(ulps(old[edge], new[edge])), 1)


def compare_cage(before, after, faults):
    faults.expect(after.complete, "a primitive has no cage")
    faults.expect(len(before.numbers) == len(after.numbers),
                  "%d vertices became %d" % (len(before.numbers), len(after.numbers)))
    same = sorted(before.polygons()) == sorted(after.polygons())
    faults.expect(same, "polygons differ")
    compare_creases(before, after, faults)
    faults.expect(before.corners == after.corners, "sharp vertices differ")
    faults.expect(len(before.holes) == len(after.holes), "holes differ")
    if not same or len(before.numbers) != len(after.numbers):
        return
    faults.expect(before.polygons() == after.polygons(), "the order of the polygons differs")
    faults.expect(before.materials == after.materials, "materials differ")
    for key in ("TEXCOORD_0", "TEXCOORD_1"):
        old, new = before.corner_values(key), after.corner_values(key)
        faults.expect((old is None) == (new is None), key + " is there in one of them")
        if old is not None and new is not None:
            size = np.exp2(np.ceil(np.log2(np.maximum(1, 1 + np.abs(old)))))
            faults.at_most("texture coordinates", float((np.abs(old - new) / size).max()), UV_ROUNDING)
    old, new = before.corner_values("COLOR_0"), after.corner_values("COLOR_0")
    faults.expect((old is None) == (new is None), "COLOR_0 is there in one of them")
    if old is not None and new is not None:
        width = min(old.shape[1], new.shape[1])
        faults.at_most("colors", float(np.abs(old[:, :width] - new[:, :width]).max()), COLOR_ROUNDING)
    compare_weights(before, after, faults)


def compare(path_before, path_after):
    faults = Faults()
    before, after = glb.cages(path_before), glb.cages(path_after)
    faults.expect(len(before) == len(after), "%d meshes became %d" % (len(before), len(after)))
    for name, cage in before.items():
        other = after.get(name)
        if other is None and len(before) == len(after) == 1:
            other = next(iter(after.values()))
        if other is None:  # a bone has the name as well
            other = next((own for key, own in after.items() if key.rpartition(".")[0] == name), None)
        if other is None:
            faults.expect(False, "mesh %s is gone" % name)
            continue
        compare_cage(cage, other, faults)
    return faults
