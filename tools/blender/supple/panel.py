"""The panel in the sidebar of the 3D viewport, and its buttons."""

import bpy

from . import command, difference, preview, report

# The sidebar cuts off what does not fit, so longer lines are broken. Pixels: of a letter, and beside the text.
LETTER_WIDTH = 6.6
MARGIN = 80


def _lines(context, text):
    scale = context.preferences.system.ui_scale
    length = max(16, int((context.region.width / scale - MARGIN) / LETTER_WIDTH))
    line = ""
    for word in text.split():
        if line and len(line) + 1 + len(word) > length:
            yield line
            line = ""
        line = line + " " + word if line else word
    yield line


def _guarded(operator, work):
    """Runs what may fail in the command's words."""
    try:
        return work()
    except command.CommandError as reason:
        operator.report({"ERROR"}, str(reason))
        return None


class SUPPLE_OT_inspect(bpy.types.Operator):
    """Ask the command supple what it will do with each selected mesh"""

    bl_idname = "supple.inspect"
    bl_label = "Ask Supple"

    @classmethod
    def poll(cls, context):
        return any(o.type == "MESH" for o in context.selected_objects)

    def execute(self, context):
        for blender_object in [o for o in context.selected_objects if o.type == "MESH"]:
            if _guarded(self, lambda mesh=blender_object: report.inspect(context, mesh)) is None:
                return {"CANCELLED"}
        return {"FINISHED"}


class SUPPLE_OT_select_faces(bpy.types.Operator):
    """Select these faces in edit mode"""

    bl_idname = "supple.select_faces"
    bl_label = "Select Faces"
    bl_options = {"REGISTER", "UNDO"}

    finding: bpy.props.IntProperty()

    @classmethod
    def poll(cls, context):
        return context.active_object is not None and context.active_object.name in report.reports

    def execute(self, context):
        blender_object = context.active_object
        faces = set(report.reports[blender_object.name].findings[self.finding].faces)
        bpy.ops.object.mode_set(mode="EDIT")
        context.tool_settings.mesh_select_mode = (False, False, True)
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.object.mode_set(mode="OBJECT")
        for polygon in blender_object.data.polygons:
            polygon.select = polygon.index in faces
        bpy.ops.object.mode_set(mode="EDIT")
        return {"FINISHED"}


class SUPPLE_OT_preview(bpy.types.Operator):
    """Draw the visible meshes as Supple shows them, from here and in this pose"""

    bl_idname = "supple.preview"
    bl_label = "Preview"

    def execute(self, context):
        warnings = _guarded(self, lambda: preview.run(context))
        if warnings is None:
            return {"CANCELLED"}
        for warning in warnings:
            self.report({"WARNING"}, warning)
        return {"FINISHED"}


class SUPPLE_OT_difference(bpy.types.Operator):
    """Draw how far Supple's surface is from Blender's own subdivision, in this pose"""

    bl_idname = "supple.difference"
    bl_label = "Difference"

    @classmethod
    def poll(cls, context):
        return context.active_object is not None and context.active_object.type == "MESH"

    def execute(self, context):
        found = _guarded(self, lambda: difference.measure(context, context.active_object))
        if found is None:
            return {"CANCELLED"}
        context.active_object["supple_difference"] = found.text()
        self.report({"INFO"}, context.active_object.name + ": " + found.text())
        return {"FINISHED"}


class VIEW3D_PT_supple(bpy.types.Panel):
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Supple"
    bl_label = "Supple"

    def draw(self, context):
        layout = self.layout
        column = layout.column(align=True)
        column.operator("supple.inspect", icon="VIEWZOOM")
        column.operator("supple.preview", icon="RENDER_STILL")
        column.operator("supple.difference", icon="MOD_SUBSURF")
        blender_object = context.active_object
        if blender_object is None or blender_object.type != "MESH":
            return
        if "supple_difference" in blender_object:
            for line in _lines(context, "Difference: " + blender_object["supple_difference"]):
                layout.label(text=line)
        found = report.reports.get(blender_object.name)
        if found is None:
            return
        layout.label(text="%s: %s" % (blender_object.name, found.scheme), icon="MESH_DATA")
        for line in _lines(context, found.reason):
            layout.label(text=line)
        for number, finding in enumerate(found.findings):
            self._draw_finding(context, layout.box(), number, finding)

    @staticmethod
    def _draw_finding(context, box, number, finding):
        column = box.column(align=True)
        for i, line in enumerate(_lines(context, finding.text)):
            column.label(text=line, icon=finding.icon if i == 0 else "BLANK1")
        if finding.faces:
            count = len(finding.faces)
            button = column.operator("supple.select_faces", text="Select %d face%s" % (count, "" if count == 1 else "s"))
            button.finding = number


CLASSES = (SUPPLE_OT_inspect, SUPPLE_OT_select_faces, SUPPLE_OT_preview, SUPPLE_OT_difference, VIEW3D_PT_supple)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)


def unregister():
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
