#!/usr/bin/env python3
"""Writes a round figure whose belly jiggles (docs/soft.md) as a GLB: belly.py OUT.glb [--without]

A body of quads that is rounder in front, and a head, each on a joint. The clip "walk" bobs and rolls as a walk does, "hop" jumps
and lands. The belly is painted smoothly: fully in front, not at all at the back and the ends. --without leaves the jiggle out.
"""
import json
import math
import struct
import sys

AROUND, ALONG = 16, 12
HIPS, CHEST, NECK = 0.35, 0.75, 1.05  # heights of the joints


def smooth(t):
    t = min(max(t, 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def quaternion(axis, degrees):
    half = math.radians(degrees) / 2.0
    return [a * math.sin(half) for a in axis] + [math.cos(half)]


def rings():
    """Rings upwards, +Z in front: (point, height)."""
    points = []
    for i in range(ALONG + 1):
        t = i / ALONG
        y = 0.15 + 1.2 * t
        body = 0.24 * math.sin(math.pi * min(t / 0.8, 1.0)) ** 0.6 + 0.05
        head = 0.17 * math.sin(math.pi * min(max((t - 0.72) / 0.28, 0.0), 1.0)) ** 0.5
        radius = max(body if t < 0.78 else 0.0, head, 0.06)
        for k in range(AROUND):
            angle = 2.0 * math.pi * k / AROUND
            front = (0.5 + 0.5 * math.cos(angle)) ** 2 * smooth((t - 0.05) / 0.3) * smooth((0.68 - t) / 0.35)
            points.append([radius * math.sin(angle), y, radius * math.cos(angle) + 0.13 * front])
    return points


def belly(p):
    front = smooth((p[2] + 0.05) / 0.28)
    return front * smooth((p[1] - 0.25) / 0.2) * smooth((0.95 - p[1]) / 0.25)


def joints(p):
    chest, head = smooth((p[1] - HIPS) / (CHEST - HIPS)), smooth((p[1] - NECK + 0.08) / 0.16)
    return [1.0 - chest, chest * (1.0 - head), chest * head]


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


def clips(buffer):
    def channel(name, keys_of, node, path, kind, seconds, count):
        times = [seconds * k / count for k in range(count + 1)]
        values = flat([keys_of(k / count) for k in range(count + 1)])
        return {"node": node, "path": path,
                "sampler": {"input": buffer.floats("SCALAR", times, min=[0.0], max=[seconds]),
                            "output": buffer.floats(kind, values)}}

    def clip(name, channels):
        return {"name": name, "samplers": [c["sampler"] for c in channels],
                "channels": [{"sampler": i, "target": {"node": c["node"], "path": c["path"]}}
                             for i, c in enumerate(channels)]}

    def bob(t):  # two steps a cycle
        return [0.02 * math.sin(2.0 * math.pi * t), HIPS + 0.045 * abs(math.sin(2.0 * math.pi * t)) - 0.02, 0.0]

    def roll(t):
        return quaternion((0.0, 0.0, 1.0), 7.0 * math.sin(2.0 * math.pi * t))

    def turn(t):
        return quaternion((0.0, 1.0, 0.0), 12.0 * math.sin(2.0 * math.pi * t + 0.4))

    def hop(t):
        up = 0.35 * 4.0 * (t / 0.5) * (1.0 - t / 0.5) if t < 0.5 else 0.0
        return [0.0, HIPS + up - 0.05 * math.exp(-((t - 0.56) / 0.05) ** 2), 0.0]

    return [clip("walk", [channel("walk", bob, 0, "translation", "VEC3", 1.0, 24),
                          channel("walk", roll, 0, "rotation", "VEC4", 1.0, 24),
                          channel("walk", turn, 1, "rotation", "VEC4", 1.0, 24)]),
            clip("hop", [channel("hop", hop, 0, "translation", "VEC3", 1.2, 48)])]


def main():
    at, buffer = rings(), Buffer()
    low, high = [min(p[k] for p in at) for k in range(3)], [max(p[k] for p in at) for k in range(3)]
    attributes = {
        "POSITION": buffer.floats("VEC3", flat(at), min=low, max=high),
        "JOINTS_0": buffer.add("B", "VEC4", 5121, flat([[0, 1, 2, 0] for _ in at])),
        "WEIGHTS_0": buffer.floats("VEC4", flat([joints(p) + [0.0] for p in at])),
    }
    mesh = {"name": "figure", "primitives": [
        {"attributes": attributes, "indices": buffer.add("H", "SCALAR", 5123, triangles()),
         "extensions": {"FB_ngon_encoding": {}}}]}
    used = ["FB_ngon_encoding"]
    if "--without" not in sys.argv:
        attributes["_SUPPLE_JIGGLE_0"] = buffer.floats("SCALAR", [belly(p) for p in at])
        mesh["extensions"] = {"SUPPLE_deformers": {"jiggle": [
            {"weights": "_SUPPLE_JIGGLE_0", "frequency": 2.5, "damping": 0.12, "limit": 0.12}]}}
        used.append("SUPPLE_deformers")
    binds = []
    for y in (HIPS, CHEST, NECK):
        binds += [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -y, 0, 1]
    root = {
        "asset": {"version": "2.0", "generator": "belly.py"}, "extensionsUsed": used,
        "scene": 0, "scenes": [{"nodes": [0, 3]}],
        "nodes": [{"name": "hips", "translation": [0, HIPS, 0], "children": [1]},
                  {"name": "chest", "translation": [0, CHEST - HIPS, 0], "children": [2]},
                  {"name": "head", "translation": [0, NECK - CHEST, 0]}, {"name": "figure", "mesh": 0, "skin": 0}],
        "skins": [{"joints": [0, 1, 2], "inverseBindMatrices": buffer.floats("MAT4", binds)}],
        "meshes": [mesh], "animations": clips(buffer),
    }
    root["buffers"] = [{"byteLength": len(buffer.bytes)}]
    root["bufferViews"], root["accessors"] = buffer.views, buffer.accessors
    text = json.dumps(root, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    with open(sys.argv[1], "wb") as file:
        file.write(struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + len(buffer.bytes)))
        file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", len(buffer.bytes), 0x004E4942) + buffer.bytes)


main()
