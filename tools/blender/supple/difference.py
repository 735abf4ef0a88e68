"""How far Supple's surface is from Blender's own subdivision, drawn on a mesh."""

import os
import tempfile

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from . import cage, character, command

SUFFIX = " difference"
ATTRIBUTE = "Supple difference"
LEVELS = 3

# The color scale ends at the largest distance, but never below what float rounding makes of any surface.
SMALLEST_SCALE = 1e-6


class Difference:
    """Distances of Supple's vertices from Blender's surface, as fractions of the extent."""

    def __init__(self, largest, mean, extent, blender_object):
        self.largest = largest
        self.mean = mean
        self.extent = extent
        self.blender_object = blender_object

    def text(self):
        return "largest %.1e of the extent (%.3g), mean %.1e" % (self.largest, self.largest * self.extent, self.mean)


def read_ply(path):
    """Vertices and faces of what supple bake writes: little-endian, x y z first, counts in a byte."""
    kinds = {"float": "<f4", "uchar": "u1", "int": "<i4", "uint": "<u4", "ushort": "<u2"}
    with open(path, "rb") as stream:
        counts, fields, element = {}, [], None
        while True:
            words = stream.readline().decode("ascii").split()
            if words[0] == "end_header":
                break
            if words[0] == "element":
                element = words[1]
                counts[element] = int(words[2])
            elif words[0] == "property" and element == "vertex":
                fields.append((words[2], kinds[words[1]]))
            elif words[0] == "property" and words[1] == "list":
                size, index = kinds[words[2]], kinds[words[3]]
        vertices = np.frombuffer(stream.read(counts["vertex"] * np.dtype(fields).itemsize), dtype=fields)
        positions = np.stack([vertices["x"], vertices["y"], vertices["z"]], axis=1)
        faces = []
        for _ in range(counts["face"]):
            count = int(np.frombuffer(stream.read(np.dtype(size).itemsize), dtype=size)[0])
            faces.append(np.frombuffer(stream.read(count * np.dtype(index).itemsize), dtype=index).tolist())
    return positions, faces


def blender_surface(context, blender_object):
    """Blender's limit surface in the pose of the current frame, in world space, and the levels it was made with."""
    modifier = cage.subdivision_of(blender_object)
    if modifier is None:
        raise command.CommandError("%s has no Subdivision Surface modifier to compare with" % blender_object.name)
    kept = (modifier.levels, modifier.use_limit_surface, modifier.show_viewport, modifier.quality)
    try:
        modifier.levels, modifier.use_limit_surface, modifier.show_viewport = LEVELS, True, True
        # Blender is exact where its patches have their corners. Isolated less deep, smooth corners are 1e-5 off.
        modifier.quality = 8
        graph = context.evaluated_depsgraph_get()
        evaluated = blender_object.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        points = cage.column(mesh.vertices, "co", 3, np.float32)
        faces = [list(p.vertices) for p in mesh.polygons]
        evaluated.to_mesh_clear()
    finally:
        modifier.levels, modifier.use_limit_surface, modifier.show_viewport, modifier.quality = kept
    matrix = np.array(blender_object.matrix_world)
    return points @ matrix[:3, :3].T + matrix[:3, 3], faces


def supple_surface(context, blender_object, scheme):
    with tempfile.TemporaryDirectory() as folder:
        glb, ply = os.path.join(folder, "cage.glb"), os.path.join(folder, "surface.ply")
        character.write(context, [blender_object], glb)
        command.run(["bake", glb, "-o", ply, "--rest-pose", "--scheme", scheme, "--rate", str(1 << LEVELS)])
        positions, faces = read_ply(ply)
    return np.stack([positions[:, 0], -positions[:, 2], positions[:, 1]], axis=1), faces


def colors_of(distances, scale):
    """Blue, green, red: none, half of the scale, all of it."""
    share = np.clip(distances / scale, 0, 1)
    ramp = np.stack([np.clip(2 * share - 1, 0, 1), 1 - np.abs(2 * share - 1), np.clip(1 - 2 * share, 0, 1)], axis=1)
    return np.concatenate([ramp, np.ones((len(ramp), 1))], axis=1).astype(np.float32)


def draw(context, name, positions, faces, distances, scale):
    """An object with Supple's surface, colored by distance."""
    old = bpy.data.objects.get(name)
    if old is not None:
        bpy.data.objects.remove(old)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(positions.tolist(), [], faces)
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    attribute = mesh.color_attributes.new(ATTRIBUTE, "FLOAT_COLOR", "POINT")
    attribute.data.foreach_set("color", colors_of(distances, scale).ravel())
    material = bpy.data.materials.get(ATTRIBUTE) or bpy.data.materials.new(ATTRIBUTE)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    if "Attribute" not in nodes:
        node = nodes.new("ShaderNodeAttribute")
        node.attribute_name = ATTRIBUTE
        material.node_tree.links.new(node.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    mesh.materials.append(material)
    made = bpy.data.objects.new(name, mesh)
    context.collection.objects.link(made)
    return made


def measure(context, blender_object, scheme="auto"):
    wanted, wanted_faces = blender_surface(context, blender_object)
    positions, faces = supple_surface(context, blender_object, scheme)
    tree = BVHTree.FromPolygons(wanted.tolist(), wanted_faces)
    distances = np.array([tree.find_nearest(p)[3] for p in positions.tolist()])
    extent = float((wanted.max(axis=0) - wanted.min(axis=0)).max()) or 1.0
    scale = max(float(distances.max()), SMALLEST_SCALE * extent)
    made = draw(context, blender_object.name + SUFFIX, positions, faces, distances, scale)
    return Difference(float(distances.max()) / extent, float(distances.mean()) / extent, extent, made)
