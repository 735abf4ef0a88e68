"""Objects of the scene as a GLB for the command: exactly what File > Export would write of them."""

import bpy

from . import command


def with_armatures(blender_objects):
    """The objects, and the armatures that deform them."""
    found = list(blender_objects)
    for blender_object in blender_objects:
        for modifier in blender_object.modifiers:
            if modifier.type == "ARMATURE" and modifier.object is not None and modifier.object not in found:
                found.append(modifier.object)
    return found


def visible_meshes(context):
    return [o for o in context.scene.objects if o.type == "MESH" and o.visible_get() and len(o.data.polygons) > 0]


def has_clips(blender_object):
    """Whether an armature that deforms it moves in an action."""
    for armature in with_armatures([blender_object])[1:]:
        data = armature.animation_data
        if data is not None and (data.action is not None or any(track.strips for track in data.nla_tracks)):
            return True
    return False


def write(context, blender_objects, path, clips=False):
    """With clips, at rest; else in the pose of the current frame, which is the file's rest pose, without clips."""
    objects = with_armatures(blender_objects)
    selected = list(context.selected_objects)
    active = context.view_layer.objects.active
    wanted = context.scene.supple.export
    mode = active.mode if active is not None else "OBJECT"
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    # What is hidden cannot be selected, and a mesh whose armature is not exported would be at rest.
    hidden = [o for o in objects if o.hide_get()]
    try:
        context.scene.supple.export = True
        for blender_object in hidden:
            blender_object.hide_set(False)
        bpy.ops.object.select_all(action="DESELECT")
        for blender_object in objects:
            blender_object.select_set(True)
            if not blender_object.select_get():
                raise command.CommandError("%s cannot be selected, and so not be exported: its collection is hidden"
                                           % blender_object.name)
        bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", use_selection=True, export_animations=clips,
                                  export_current_frame=not clips, export_all_influences=True)
    finally:
        context.scene.supple.export = wanted
        bpy.ops.object.select_all(action="DESELECT")
        for blender_object in selected:
            blender_object.select_set(True)
        for blender_object in hidden:
            blender_object.hide_set(True)
        context.view_layer.objects.active = active
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode=mode)
