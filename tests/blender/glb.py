"""Reads GLB files for comparison: accessors, and control cages of SUPPLE_mesh_cage."""

import json
import struct

import numpy as np

WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
KINDS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}


class Glb:
    def __init__(self, path):
        with open(path, "rb") as stream:
            data = stream.read()
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20:20 + length])
        self.bytes = data[28 + length:]

    def values(self, index):
        """One row per element; normalized integers as floats."""
        accessor = self.json["accessors"][index]
        width, kind = WIDTHS[accessor["type"]], np.dtype(KINDS[accessor["componentType"]])
        if "bufferView" in accessor:
            view = self.json["bufferViews"][accessor["bufferView"]]
            start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
            stride = view.get("byteStride", width * kind.itemsize)
            rows = np.lib.stride_tricks.as_strided(
                np.frombuffer(self.bytes, np.uint8, offset=start), (accessor["count"], width * kind.itemsize), (stride, 1))
            array = np.ascontiguousarray(rows).view(kind).reshape(accessor["count"], width)
        else:
            array = np.zeros((accessor["count"], width), kind)
        if "sparse" in accessor:
            array = array.copy()
            sparse = accessor["sparse"]
            array[self._sparse(sparse, "indices", "SCALAR").ravel()] = self._sparse(
                sparse, "values", accessor["type"], accessor["componentType"])
        if accessor.get("normalized"):
            array = array.astype(np.float32) / np.float32(np.iinfo(kind).max)
        return array

    def _sparse(self, sparse, member, kind, component=None):
        part = sparse[member]
        view = self.json["bufferViews"][part["bufferView"]]
        dtype = np.dtype(KINDS[component or part["componentType"]])
        start = view.get("byteOffset", 0) + part.get("byteOffset", 0)
        count = sparse["count"] * WIDTHS[kind]
        return np.frombuffer(self.bytes, dtype, count, start).reshape(sparse["count"], -1)

    def write(self, path):
        """What is in `json` now, over the same buffer."""
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(self.bytes), 0x004E4942) + self.bytes
        with open(path, "wb") as stream:
            stream.write(struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks)

    def mesh_nodes(self):
        return [node for node in self.json["nodes"] if "mesh" in node]


class Cage:
    """Of one mesh node, all primitives together. Vertices are ranks of the cage's numbers."""

    def __init__(self, glb, node):
        self._glb = glb
        mesh = glb.json["meshes"][node["mesh"]]
        joints = glb.json["skins"][node["skin"]]["joints"] if "skin" in node else []
        self.joint_names = [glb.json["nodes"][j].get("name", str(j)) for j in joints]
        primitives = [p for p in mesh["primitives"] if "SUPPLE_mesh_cage" in p.get("extensions", {})]
        self.complete = len(primitives) == len(mesh["primitives"])
        self.intent = {k: v for k, v in primitives[0]["extensions"]["SUPPLE_mesh_cage"].items() if not isinstance(v, (int, list)) or
                       k in ("levels", "limitSurface")} if primitives else {}
        numbers = [glb.values(p["extensions"]["SUPPLE_mesh_cage"]["cageVertices"]).ravel() for p in primitives]
        self.numbers = np.unique(np.concatenate(numbers))
        self.counts, self.vertices, self.materials, self.holes = [], [], [], []
        self.attributes = {}
        self.weights = [{} for _ in self.numbers]
        self.targets = [np.zeros((len(self.numbers), 3), np.float32) for _ in primitives[0].get("targets", [])]
        self.creases, self.corners, self.sharp_edges = {}, {}, set()
        self.crease_sets, self.scalars = {}, {}
        for primitive, own in zip(primitives, numbers):
            self._add(primitive, np.searchsorted(self.numbers, own))

    def _add(self, primitive, ranks):
        members = primitive["extensions"]["SUPPLE_mesh_cage"]
        values = self._glb.values
        corners = values(members["faceVertexIndices"]).ravel()
        counts = values(members["faceVertexCounts"]).ravel()
        if "holeIndices" in members:
            self.holes += (values(members["holeIndices"]).ravel().astype(int) + len(self.counts)).tolist()
        self.counts += counts.tolist()
        self.vertices += ranks[corners].tolist()
        material = primitive.get("material")
        name = self._glb.json["materials"][material].get("name") if material is not None else None
        self.materials += [name] * len(counts)
        for key, accessor in primitive["attributes"].items():
            data = values(accessor)
            if key.startswith(("TEXCOORD", "COLOR", "NORMAL")):
                self.attributes.setdefault(key, []).append(data[corners])
        self._add_skin(primitive, ranks)
        for target, own in zip(self.targets, primitive.get("targets", [])):
            target[ranks] = values(own["POSITION"])
        for key, into in (("crease", self.creases), ("corner", self.corners)):
            if key + "Indices" in members:
                ends = self._ranks(members[key + "Indices"], 2 if key == "crease" else 1)
                for pair, sharpness in zip(ends, values(members[key + "Sharpnesses"]).ravel()):
                    into[pair] = max(into.get(pair, 0), float(sharpness))
        for crease_set in members.get("creaseSets", []):
            ends = self._ranks(members["creaseIndices"], 2)
            chosen = values(crease_set["creases"]).ravel().astype(int)
            self.crease_sets.setdefault(crease_set["name"], set()).update(ends[c] for c in chosen)
        if "creaseScalarIndices" in members:
            ends = np.searchsorted(self.numbers, values(members["creaseScalarIndices"]).ravel()).reshape(-1, 2)
            for pair, alpha in zip(ends.tolist(), values(members["creaseScalars"]).ravel()):
                self.scalars[tuple(pair)] = float(alpha)
        if "sharpEdgeIndices" in members:
            self.sharp_edges |= set(self._ranks(members["sharpEdgeIndices"], 2))

    def _ranks(self, accessor, width):
        ranks = np.searchsorted(self.numbers, self._glb.values(accessor).ravel()).reshape(-1, width)
        return [tuple(sorted(row)) for row in ranks.tolist()]

    def _add_skin(self, primitive, ranks):
        for i in range(16):
            if "JOINTS_%d" % i not in primitive["attributes"]:
                break
            joints = self._glb.values(primitive["attributes"]["JOINTS_%d" % i])
            weights = self._glb.values(primitive["attributes"]["WEIGHTS_%d" % i])
            for rank, js, ws in zip(ranks.tolist(), joints.tolist(), weights):
                for j, w in zip(js, ws):
                    if w != 0:
                        self.weights[rank][self.joint_names[j]] = w

    def polygons(self):
        starts = np.concatenate([[0], np.cumsum(self.counts)])
        return [tuple(self.vertices[a:b]) for a, b in zip(starts[:-1], starts[1:])]

    def corner_values(self, key):
        return np.concatenate(self.attributes[key]) if key in self.attributes else None

    def normalized_weights(self):
        """As readers take them: of sum one."""
        for own in self.weights:
            total = sum(np.float64(w) for w in own.values())
            yield {joint: np.float32(w / total) for joint, w in own.items()}


def cages(path):
    glb = Glb(path)
    return {node.get("name", str(i)): Cage(glb, node) for i, node in enumerate(glb.mesh_nodes())}
