"""Supple: control cages to glTF and back, as the runtime will show them."""

bl_info = {
    "name": "Supple",
    "author": "The Supple authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Export and Import > glTF 2.0; 3D Viewport > Sidebar > Supple",
    "description": "Control cages to glTF and back, as Supple will show them",
    "doc_url": "",
    "category": "Import-Export",
}

from . import colors, deformers, deformer_panels, export, importer, panel, settings, soft, springs


MODULES = (settings, soft, springs, panel, deformer_panels)


def _say(line):
    print("Supple: " + line)


class glTF2ExportUserExtension(export.ExportHooks):
    def __init__(self):
        super().__init__(settings.export_wanted, _say)


class glTF2ImportUserExtension(importer.ImportHooks):
    def __init__(self):
        super().__init__(_say)


def glTF2_pre_export_callback(export_settings):
    colors.mend_exporter()
    if settings.export_wanted():
        deformers.sample_drivers(_say)
        export.switch_subdivision_off(export_settings)


def glTF2_post_export_callback(_export_settings):
    export.switch_subdivision_on()


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()


def draw_export(context, layout):
    """In the exporter's dialog, since Blender 4.2."""
    settings.draw_export(context, layout)


def register_panel():
    """The same before 4.2: the exporter calls this when its dialog opens, and what it returns when it closes."""
    return settings.register_export_panel()
