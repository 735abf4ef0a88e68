"""What a user sets: in the preferences, where the command supple is; per scene, whether cages are exported."""

import bpy


class SupplePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    command: bpy.props.StringProperty(
        name="supple",
        description="The command supple. Empty: it is looked up in PATH",
        subtype="FILE_PATH",
    )

    def draw(self, _context):
        self.layout.prop(self, "command")


class SuppleSceneSettings(bpy.types.PropertyGroup):
    export: bpy.props.BoolProperty(
        name="Control cages",
        description="Export polygons, creases and UV modes beside the triangles (SUPPLE_mesh_cage)",
        default=True,
    )


class GLTF_PT_export_supple(bpy.types.Panel):
    """In the dialog of the glTF exporter."""

    bl_space_type = "FILE_BROWSER"
    bl_region_type = "TOOL_PROPS"
    bl_label = "Supple"
    bl_parent_id = "GLTF_PT_export_user_extensions"

    @classmethod
    def poll(cls, context):
        return context.space_data.active_operator.bl_idname == "EXPORT_SCENE_OT_gltf"

    def draw(self, context):
        draw_export(context, self.layout)


def draw_export(context, layout):
    layout.prop(context.scene.supple, "export")


def register_export_panel():
    if hasattr(bpy.types, "GLTF_PT_export_supple") or not hasattr(bpy.types, "GLTF_PT_export_user_extensions"):
        return lambda: None
    bpy.utils.register_class(GLTF_PT_export_supple)
    return lambda: bpy.utils.unregister_class(GLTF_PT_export_supple)


def export_wanted():
    return bpy.context.scene.supple.export


def command_path():
    addon = bpy.context.preferences.addons.get(__package__)
    return addon.preferences.command if addon and addon.preferences else ""


CLASSES = (SupplePreferences, SuppleSceneSettings)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Scene.supple = bpy.props.PointerProperty(type=SuppleSceneSettings)


def unregister():
    del bpy.types.Scene.supple
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
