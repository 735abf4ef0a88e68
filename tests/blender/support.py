"""What the tests that run inside Blender have in common."""

import os
import sys

import bpy


def arguments():
    return sys.argv[sys.argv.index("--") + 1:]


def start(with_addon=True):
    """An empty file, with the add-on's zip installed or without."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
    if with_addon:
        if not getattr(start, "installed", False):
            bpy.ops.preferences.addon_install(filepath=os.environ["SUPPLE_ADDON_ZIP"], overwrite=True)
            start.installed = True
        bpy.ops.preferences.addon_enable(module="supple")


def import_glb(path, shading="NORMALS"):
    bpy.ops.import_scene.gltf(filepath=path, import_shading=shading)


def export_glb(path, **settings):
    bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", **settings)


def meshes():
    return [o for o in bpy.context.scene.objects if o.type == "MESH" and len(o.data.polygons) > 0]


def animated():
    """Every block that has tracks: objects and shape keys."""
    blocks = list(bpy.data.objects) + list(bpy.data.shape_keys)
    return [b for b in blocks if b.animation_data is not None]


def clips():
    """Name -> frames it lasts, first and last."""
    found = {}
    for block in animated():
        for track in block.animation_data.nla_tracks:
            for strip in track.strips:
                first, last = found.get(track.name, (1e9, -1e9))
                found[track.name] = (min(first, strip.action.frame_range[0]), max(last, strip.action.frame_range[1]))
    return found


def play(clip):
    """By its actions: the importer lays strips a frame later than the file has its keys. What it does not animate is at
    rest."""
    for blender_object in bpy.data.objects:
        for bone in blender_object.pose.bones if blender_object.pose else ():
            bone.matrix_basis.identity()
    for block in animated():
        data = block.animation_data
        data.action = None
        for track in data.nla_tracks:
            track.mute = True
            if track.name == clip:
                data.action = track.strips[0].action


def forget_exact_sharpness(mesh):
    """What is left is what Blender shows: 3.4 keeps a crease in a byte."""
    attribute = mesh.attributes.get("supple_sharpness")
    if attribute is not None:
        mesh.attributes.remove(attribute)
    return attribute is not None
