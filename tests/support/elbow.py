#!/usr/bin/env python3
"""Writes an arm with pose drivers (docs/pose_drivers.md) as a GLB: elbow.py OUT.glb [--without]

Elbow and wrist are smooth blends of two joints each. Morph targets "bend 45", "bend 90" and "bend 135" hold what an artist
would sculpt at these poses: here, what keeps the limb as thick as it is, and a fold inside. "twist left" and "twist right"
do the same for a hand that is turned by a quarter. --without leaves the drivers out.
"""
import json
import math
import struct
import sys

AROUND, ALONG = 12, 24
LENGTH, RADIUS = 0.56, 0.045
ELBOW, WRIST, REACH = 0.28, 0.50, 0.06  # along x; how far to both sides two joints share


def smooth(t):
    t = min(max(t, 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def quaternion(axis, degrees):
    half = math.radians(degrees) / 2.0
    return [a * math.sin(half) for a in axis] + [math.cos(half)]


def times(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz]


def turned(q, v):
    back = [-q[0], -q[1], -q[2], q[3]]
    return times(times(q, list(v) + [0.0]), back)[:3]


def matrix(q):
    columns = [turned(q, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    return [[columns[c][r] for c in range(3)] for r in range(3)]


def inverse(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return [[(e * i - f * h) / det, (c * h - b * i) / det, (b * f - c * e) / det],
            [(f * g - d * i) / det, (a * i - c * g) / det, (c * d - a * f) / det],
            [(d * h - e * g) / det, (b * g - a * h) / det, (a * e - b * d) / det]]


def applied(m, v):
    return [sum(m[r][k] * v[k] for k in range(3)) for r in range(3)]


def points():
    """Rings along x, then the two ends' middles."""
    rings = []
    for i in range(ALONG + 1):
        x = LENGTH * i / ALONG
        for k in range(AROUND):
            angle = 2.0 * math.pi * (k + 0.5) / AROUND
            radius = RADIUS * (1.0 - 0.25 * x / LENGTH)
            rings.append([x, radius * math.cos(angle), radius * math.sin(angle)])
    return rings


def weights(x):
    fore, hand = smooth((x - ELBOW + REACH) / (2.0 * REACH)), smooth((x - WRIST + REACH) / (2.0 * REACH))
    return [1.0 - fore, fore * (1.0 - hand), fore * hand]


def correction(p, pivot, axis, degrees, share, fold):
    """From where two joints take a point, linearly, to where its share of the turn takes it: in the rest pose."""
    q = quaternion(axis, degrees)
    turn = matrix(q)
    blend = [[(1.0 - share) * (r == c) + share * turn[r][c] for c in range(3)] for r in range(3)]
    local = [p[0] - pivot, p[1], p[2]]
    part = quaternion(axis, degrees * share)
    wanted = turned(part, [0.0, local[1], local[2]])
    middle = applied(blend, [local[0], 0.0, 0.0])
    side = local[1] / RADIUS  # outside of the elbow is -y
    bulge = fold * 4.0 * share * (1.0 - share) * math.sin(math.radians(degrees) / 2.0) ** 2
    out = turned(part, [0.0, -1.0, 0.0])
    wanted = [middle[k] + wanted[k] + out[k] * bulge * (1.0 if side < 0.0 else -0.4) * abs(side) for k in range(3)]
    linear = applied(blend, local)
    return applied(inverse(blend), [wanted[k] - linear[k] for k in range(3)])


class Buffer:
    def __init__(self):
        self.bytes, self.views, self.accessors = b"", [], []

    def add(self, form, kind, component, values, **more):
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[kind]
        data = struct.pack("<%d%s" % (len(values), form), *values)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + b"\0" * (-len(data) % 4)
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component, "type": kind,
                               "count": len(values) // width, **more})
        return len(self.accessors) - 1

    def floats(self, kind, values, **more):
        return self.add("f", kind, 5126, values, **more)


def flat(lists):
    return [x for one in lists for x in one]


def triangles():
    """Quads by FB_ngon_encoding: the triangles of a face begin at one vertex, and the next face at another."""
    faces = []
    for i in range(ALONG):
        for k in range(AROUND):
            n = (k + 1) % AROUND
            faces.append([i * AROUND + k, i * AROUND + n, (i + 1) * AROUND + n, (i + 1) * AROUND + k])
    faces.append([k for k in range(AROUND - 1, -1, -1)])
    faces.append([ALONG * AROUND + k for k in range(AROUND)])
    out, first = [], -1
    for face in faces:
        if face[0] == first:
            face = face[1:] + face[:1]
        first = face[0]
        for k in range(1, len(face) - 1):
            out += [face[0], face[k], face[k + 1]]
    return out


def bends(degrees, at):
    return [correction(p, ELBOW, (0, 0, 1), degrees, smooth((p[0] - ELBOW + REACH) / (2.0 * REACH)), 0.012)
            if p[0] < WRIST - REACH else [0.0] * 3 for p in at]


def twists(degrees, at):
    return [correction(p, WRIST, (1, 0, 0), degrees, smooth((p[0] - WRIST + REACH) / (2.0 * REACH)), 0.0) for p in at]


def main():
    out = sys.argv[1]
    at, buffer = points(), Buffer()
    low, high = [min(p[k] for p in at) for k in range(3)], [max(p[k] for p in at) for k in range(3)]
    position = buffer.floats("VEC3", flat(at), min=low, max=high)
    joints = buffer.add("B", "VEC4", 5121, flat([[0, 1, 2, 0] for _ in at]))
    shares = buffer.floats("VEC4", flat([weights(p[0]) + [0.0] for p in at]))
    indices = buffer.add("H", "SCALAR", 5123, triangles())
    targets, names = [], []
    for name, deltas in [("bend 45", bends(45, at)), ("bend 90", bends(90, at)), ("bend 135", bends(135, at)),
                         ("twist left", twists(90, at)), ("twist right", twists(-90, at))]:
        bounds = {"min": [min(d[k] for d in deltas) for k in range(3)], "max": [max(d[k] for d in deltas) for k in range(3)]}
        targets.append({"POSITION": buffer.floats("VEC3", flat(deltas), **bounds)})
        names.append(name)

    binds = []
    for x in (0.0, ELBOW, WRIST):
        binds += [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, 0, 0, 1]
    skin = {"joints": [0, 1, 2], "inverseBindMatrices": buffer.floats("MAT4", binds)}

    def clip(name, node, keys):
        times_ = buffer.floats("SCALAR", [k[0] for k in keys], min=[keys[0][0]], max=[keys[-1][0]])
        values = buffer.floats("VEC4", flat([k[1] for k in keys]))
        return {"name": name, "channels": [{"sampler": 0, "target": {"node": node, "path": "rotation"}}],
                "samplers": [{"input": times_, "output": values}]}

    bend = [quaternion((0, 0, 1), a) for a in (45, 90, 135)]
    twist = [quaternion((1, 0, 0), a) for a in (90, -90)]
    root = {
        "asset": {"version": "2.0", "generator": "elbow.py"},
        "extensionsUsed": ["FB_ngon_encoding", "SUPPLE_deformers"],
        "scene": 0, "scenes": [{"nodes": [0, 3]}],
        "nodes": [{"name": "upper arm", "children": [1]}, {"name": "forearm", "translation": [ELBOW, 0, 0], "children": [2]},
                  {"name": "hand", "translation": [WRIST - ELBOW, 0, 0]}, {"name": "arm", "mesh": 0, "skin": 0}],
        "skins": [skin],
        "meshes": [{"name": "arm", "extras": {"targetNames": names}, "weights": [0.0] * len(names), "primitives": [
            {"attributes": {"POSITION": position, "JOINTS_0": joints, "WEIGHTS_0": shares}, "indices": indices,
             "targets": targets, "extensions": {"FB_ngon_encoding": {}}}]}],
        "animations": [
            clip("bend", 1, [(t, quaternion((0, 0, 1), a)) for t, a in ((0, 0), (0.5, 45), (1, 90), (1.5, 135), (2, 135))]),
            clip("twist", 2, [(t, quaternion((1, 0, 0), a)) for t, a in ((0, 0), (0.5, 90), (1, 0), (1.5, -90), (2, 0))])],
    }
    if "--without" not in sys.argv:
        identity = [[float(a == b) for b in range(3)] for a in range(3)]
        root["meshes"][0]["extensions"] = {"SUPPLE_deformers": {"drivers": [
            {"name": "elbow", "inputs": [{"node": 1, "part": "swing", "axis": [1, 0, 0]}], "targets": [0, 1, 2],
             "poses": buffer.floats("VEC4", flat(bend)), "values": buffer.floats("SCALAR", flat(identity))},
            {"name": "wrist", "inputs": [{"node": 2, "part": "twist", "axis": [1, 0, 0]}], "targets": [3, 4],
             "poses": buffer.floats("VEC4", flat(twist)), "values": buffer.floats("SCALAR", [1, 0, 0, 1])}]}}
    root["buffers"] = [{"byteLength": len(buffer.bytes)}]
    root["bufferViews"], root["accessors"] = buffer.views, buffer.accessors
    text = json.dumps(root, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    with open(out, "wb") as file:
        file.write(struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + len(buffer.bytes)))
        file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", len(buffer.bytes), 0x004E4942) + buffer.bytes)


main()
