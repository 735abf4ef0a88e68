#!/usr/bin/env python3
"""Hangs a cape (docs/cloth.md) on a figure: cape.py IN.glb OUT.glb [--top Y] [--without] ..

The figure has joints "hips" and "chest" and a skin. The cape is a sheet of quads behind it, whose first row hangs on the chest.
Its colliders are a capsule from the hips to the chest, a sphere round the hips and, if the figure has them, capsules along
thighs and shins. --without leaves the cloth out: the cape is skinned as everything else. The other options are sizes.
"""
import argparse
import json
import struct

COLUMNS, ROWS = 11, 13


def read(path):
    data = open(path, "rb").read()
    size = struct.unpack("<I", data[12:16])[0]
    root = json.loads(data[20:20 + size])
    return root, bytearray(data[28 + size:28 + size + root["buffers"][0]["byteLength"]])


def write(path, root, data):
    data += b"\0" * (-len(data) % 4)
    root["buffers"][0]["byteLength"] = len(data)
    text = json.dumps(root, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + len(data)))
        file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
        file.write(struct.pack("<II", len(data), 0x004E4942) + data)


class Appended:
    """Accessors behind those of a file."""

    def __init__(self, root, data):
        self.root, self.data = root, data

    def add(self, form, kind, component, values, **more):
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[kind]
        self.data += b"\0" * (-len(self.data) % 4)
        packed = struct.pack("<%d%s" % (len(values), form), *values)
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.data += packed
        self.root["accessors"].append({"bufferView": len(self.root["bufferViews"]) - 1, "componentType": component,
                                       "type": kind, "count": len(values) // width, **more})
        return len(self.root["accessors"]) - 1


def sheet(size):
    """Row after row downwards, around the back."""
    points = []
    for j in range(ROWS):
        for i in range(COLUMNS):
            s, t = i / (COLUMNS - 1) - 0.5, j / (ROWS - 1)
            wide = size.width * (1.0 + 0.25 * t)
            points.append([wide * s, size.top - size.length * t, -size.back + size.round * (2.0 * s) ** 2 - size.lean * t])
    return points


def triangles():
    """Quads by FB_ngon_encoding, seen from behind."""
    out = []
    for j in range(ROWS - 1):
        for i in range(COLUMNS - 1):
            k = j * COLUMNS + i
            out += [k, k + 1, k + COLUMNS + 1, k, k + COLUMNS + 1, k + COLUMNS]
    return out


def capsules(nodes, size):
    names = {node.get("name"): i for i, node in enumerate(nodes)}
    found = [("hips", "chest", size.body)]
    for side in (".L", ".R"):
        found += [("thigh" + side, "shin" + side, 0.085), ("shin" + side, "foot" + side, 0.07)]
    made = []
    for first, last, radius in found:
        if first in names and last in names:
            way, at = [0.0, 0.0, 0.0], names[last]
            while at != names[first]:
                way = [a + b for a, b in zip(way, nodes[at].get("translation", [0, 0, 0]))]
                at = next(i for i, node in enumerate(nodes) if at in node.get("children", []))
            made.append({"node": names[first],
                         "shape": {"capsule": {"offset": [0, 0, 0], "tail": way, "radius": radius}}})
    if "hips" in names:
        made.append({"node": names["hips"], "shape": {"sphere": {"offset": [0, -0.06, 0], "radius": size.seat}}})
    return made


def main():
    options = argparse.ArgumentParser()
    options.add_argument("source")
    options.add_argument("out")
    for name, usual in (("top", 1.27), ("back", 0.135), ("width", 0.30), ("length", 0.86), ("round", 0.045), ("body", 0.125), ("seat", 0.17), ("lean", 0.09)):
        options.add_argument("--" + name, type=float, default=usual)
    options.add_argument("--without", action="store_true")
    size = options.parse_args()
    root, data = read(size.source)
    buffer, points = Appended(root, data), sheet(size)
    joints = root["skins"][0]["joints"]
    chest = joints.index(next(i for i, node in enumerate(root["nodes"]) if node.get("name") == "chest"))
    low, high = [min(p[k] for p in points) for k in range(3)], [max(p[k] for p in points) for k in range(3)]
    attributes = {
        "POSITION": buffer.add("f", "VEC3", 5126, [x for p in points for x in p], min=low, max=high),
        "JOINTS_0": buffer.add("B", "VEC4", 5121, [chest, 0, 0, 0] * len(points)),
        "WEIGHTS_0": buffer.add("f", "VEC4", 5126, [1.0, 0.0, 0.0, 0.0] * len(points)),
    }
    root.setdefault("materials", []).append({
        "name": "cape", "doubleSided": True,
        "pbrMetallicRoughness": {"baseColorFactor": [0.45, 0.03, 0.04, 1], "metallicFactor": 0, "roughnessFactor": 0.8}})
    mesh = {"name": "cape", "primitives": [
        {"attributes": attributes, "indices": buffer.add("H", "SCALAR", 5123, triangles()),
         "material": len(root["materials"]) - 1, "extensions": {"FB_ngon_encoding": {}}}]}
    used = root.setdefault("extensionsUsed", [])
    if not size.without:
        attributes["_SUPPLE_CLOTH_0"] = buffer.add("f", "SCALAR", 5126, [0.0 if k < COLUMNS else 1.0 for k in range(len(points))])
        colliders = capsules(root["nodes"], size)
        mesh["extensions"] = {"SUPPLE_deformers": {"cloth": [
            {"weights": "_SUPPLE_CLOTH_0", "hitRadius": 0.015, "colliders": list(range(len(colliders)))}]}}
        root.setdefault("extensions", {})["VRMC_springBone"] = {"specVersion": "1.0", "colliders": colliders}
        used += [name for name in ("SUPPLE_deformers", "VRMC_springBone") if name not in used]
    if "FB_ngon_encoding" not in used:
        used.append("FB_ngon_encoding")
    root["meshes"].append(mesh)
    root["nodes"].append({"name": "cape", "mesh": len(root["meshes"]) - 1, "skin": 0})
    root["scenes"][root.get("scene", 0)]["nodes"].append(len(root["nodes"]) - 1)
    write(size.out, root, data)


main()
