"""Weights that the stock exporter drops: it leaves out what is at most 1e-4, but Blender deforms with it."""

import numpy as np

from . import gltf_io

DROPPED = 1e-4
SET = 4


class VertexWeights:
    """Of a mesh, while the exporter has it."""

    def __init__(self, mesh):
        self._groups = {}
        for vertex in mesh.vertices:
            own = [(g.group, g.weight) for g in vertex.groups if g.weight > 0]
            if any(weight <= DROPPED for _, weight in own):
                self._groups[vertex.index] = own

    def __bool__(self):
        return bool(self._groups)

    def influences(self, vertex, joints):
        """(joint, weight), the largest first, if the exporter has dropped some of them. `joints`: by group."""
        own = [(joints[g], w) for g, w in self._groups.get(vertex, ()) if g in joints]
        if not any(weight <= DROPPED for _, weight in own) or all(weight <= DROPPED for _, weight in own):
            return None
        return sorted(own, key=lambda influence: influence[1], reverse=True)


def _table(primitive, name, count):
    key = name + "_%d"
    sets = 0
    rows = []
    while key % sets in primitive.attributes:
        rows.append(gltf_io.written_values(primitive.attributes[key % sets]).reshape(count, SET))
        sets += 1
    return np.concatenate(rows, axis=1) if rows else None


def complete(primitive, cage_vertices, weights, joints, all_influences):
    """Writes the weights of the vertices whose influences are not all there. `cage_vertices`: per glTF vertex, the
    mesh's vertex."""
    count = len(cage_vertices)
    table = {name: _table(primitive, name, count) for name in ("JOINTS", "WEIGHTS")}
    if table["WEIGHTS"] is None:
        return
    found = {}
    for row, vertex in enumerate(cage_vertices):
        influences = weights.influences(int(vertex), joints)
        if influences:
            found[row] = influences if all_influences else influences[:SET]
    if not found:
        return
    width = max(table["WEIGHTS"].shape[1], max(len(i) for i in found.values()))
    width = -(-width // SET) * SET
    largest = max(int(table["JOINTS"].max()), max(j for i in found.values() for j, _ in i))
    numbers = np.zeros((count, width), np.uint8 if largest < 256 else np.uint16)
    shares = np.zeros((count, width), np.float32)
    numbers[:, :table["JOINTS"].shape[1]] = table["JOINTS"]
    shares[:, :table["WEIGHTS"].shape[1]] = table["WEIGHTS"]
    for row, influences in found.items():
        own = np.array([weight for _, weight in influences], np.float64)
        numbers[row], shares[row] = 0, 0
        numbers[row, :len(influences)] = [joint for joint, _ in influences]
        shares[row, :len(influences)] = own / own.sum()
    for first in range(0, width, SET):
        columns = slice(first, first + SET)
        attributes = {"JOINTS_%d": numbers[:, columns], "WEIGHTS_%d": shares[:, columns]}
        for key, values in attributes.items():
            primitive.attributes[key % (first // SET)] = gltf_io.vertex_accessor(values)
