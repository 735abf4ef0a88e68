"""Panels in the properties editor: of meshes below their vertex groups, of bones, and of Empties that are colliders."""

import bpy


class SUPPLE_OT_add_deformer(bpy.types.Operator):
    """Let a painted vertex group move by itself in Supple"""

    bl_idname = "supple.add_deformer"
    bl_label = "Add"
    bl_options = {"REGISTER", "UNDO"}

    kind: bpy.props.EnumProperty(items=(("jiggles", "Jiggle", ""), ("cloths", "Cloth", "")))

    @classmethod
    def poll(cls, context):
        return context.active_object is not None and context.active_object.type == "MESH"

    def execute(self, context):
        entry = getattr(context.active_object.data.supple, self.kind).add()
        group = context.active_object.vertex_groups.active
        if group is not None:
            entry.vertex_group = group.name
        return {"FINISHED"}


class SUPPLE_OT_remove_deformer(bpy.types.Operator):
    """Remove it. The vertex group stays"""

    bl_idname = "supple.remove_deformer"
    bl_label = "Remove"
    bl_options = {"REGISTER", "UNDO"}

    kind: bpy.props.EnumProperty(items=(("jiggles", "Jiggle", ""), ("cloths", "Cloth", "")))
    index: bpy.props.IntProperty()

    def execute(self, context):
        getattr(context.active_object.data.supple, self.kind).remove(self.index)
        return {"FINISHED"}


class _Properties:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_options = {"DEFAULT_CLOSED"}


class SUPPLE_PT_mesh(_Properties, bpy.types.Panel):
    bl_context = "data"
    bl_label = "Supple"

    @classmethod
    def poll(cls, context):
        return context.mesh is not None and context.object is not None

    def draw(self, context):
        layout, settings = self.layout, context.mesh.supple
        layout.use_property_split = True
        layout.prop(settings, "skinning")
        self._draw_list(context, "jiggles", "Jiggle", ("frequency", "damping", "limit"))
        self._draw_list(context, "cloths", "Cloth", ("stretch", "shear", "bend", "volume", "tether", "drag", "air", "gravity",
                                                     "hit_radius", "substeps", "colliders"))

    def _draw_list(self, context, kind, label, names):
        for index, entry in enumerate(getattr(context.mesh.supple, kind)):
            column = self.layout.box().column()
            row = column.row()
            row.label(text=label)
            remove = row.operator("supple.remove_deformer", text="", icon="X")
            remove.kind, remove.index = kind, index
            for group in [name for name in ("vertex_group", "pin_group") if hasattr(entry, name)]:
                column.prop_search(entry, group, context.object, "vertex_groups")
            for name in names:
                column.prop(entry, name)
        self.layout.operator("supple.add_deformer", text="Add " + label, icon="ADD").kind = kind


class SUPPLE_PT_bone(_Properties, bpy.types.Panel):
    bl_context = "bone"
    bl_label = "Supple Spring"

    @classmethod
    def poll(cls, context):
        return isinstance(context.bone, bpy.types.Bone)

    def draw_header(self, context):
        self.layout.prop(context.bone.supple, "swings", text="")

    def draw(self, context):
        settings = context.bone.supple
        self.layout.use_property_split = True
        column = self.layout.column()
        column.active = settings.swings
        for name in ("stiffness", "drag", "gravity", "hit_radius", "colliders"):
            column.prop(settings, name)


class SUPPLE_PT_collider(_Properties, bpy.types.Panel):
    bl_context = "object"
    bl_label = "Supple Collider"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "EMPTY"

    def draw(self, context):
        settings = context.object.supple
        self.layout.use_property_split = True
        self.layout.prop(settings, "shape")
        if settings.shape in ("SPHERE", "CAPSULE"):
            self.layout.prop(settings, "inside")


CLASSES = (SUPPLE_OT_add_deformer, SUPPLE_OT_remove_deformer, SUPPLE_PT_mesh, SUPPLE_PT_bone, SUPPLE_PT_collider)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)


def unregister():
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
