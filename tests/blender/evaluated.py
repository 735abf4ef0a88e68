"""What Blender itself makes of a cage: its limit surface, deformed by its armature."""

import bpy
import numpy as np

LEVELS = 2

# Blender's patches are exact at their corners: what is isolated this deep is exact on level 2.
QUALITY = 8


def subdivide(blender_object):
    modifier = next(m for m in blender_object.modifiers if m.type == "SUBSURF")
    modifier.levels, modifier.quality, modifier.use_limit_surface = LEVELS, QUALITY, True
    return modifier


def _in_gltf_axes(blender_object, points):
    matrix = np.array(blender_object.matrix_world)
    points = points.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
    return points[:, [0, 2, 1]] * (1, 1, -1)


def _column(collection, name, width, kind=np.float32):
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width)


def write_points(objects, path):
    """Three floats a vertex."""
    graph = bpy.context.evaluated_depsgraph_get()
    found = []
    for blender_object in objects:
        evaluated = blender_object.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        found.append(_in_gltf_axes(blender_object, _column(mesh.vertices, "co", 3)))
        evaluated.to_mesh_clear()
    np.concatenate(found).astype(np.float32).tofile(path)


def write_corners(objects, path):
    """Five floats a corner: where it is, and its texture coordinates as glTF counts them."""
    graph = bpy.context.evaluated_depsgraph_get()
    found = []
    for blender_object in objects:
        evaluated = blender_object.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        points = _in_gltf_axes(blender_object, _column(mesh.vertices, "co", 3))
        vertices = _column(mesh.loops, "vertex_index", 1, np.int32).ravel()
        uvs = _column(mesh.uv_layers[0].data, "uv", 2).astype(np.float64)
        found.append(np.concatenate([points[vertices], uvs * (1, -1) + (0, 1)], axis=1))
        evaluated.to_mesh_clear()
    np.concatenate(found).astype(np.float32).tofile(path)
