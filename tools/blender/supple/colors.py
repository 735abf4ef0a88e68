"""Colors of corners in Blender 3.4's exporter: it takes the color of the corner whose number is the vertex's. Later versions are
right."""

import importlib
import inspect

import numpy as np

_METHOD = "_PrimitiveCreator__get_color_attribute"


def _is_wrong(method):
    of_corners = inspect.getsource(method).rpartition('"CORNER":')[2]
    return "colors[self.dots['vertex_index']]" in of_corners


def mend_exporter():
    try:
        name = "io_scene_gltf2.blender.exp.gltf2_blender_gather_primitives_extract"
        creator = importlib.import_module(name).PrimitiveCreator
        original = getattr(creator, _METHOD)
        if getattr(original, "mended", False) or not _is_wrong(original):
            return
    except (ModuleNotFoundError, AttributeError, OSError):
        return  # another version

    def get_color_attribute(self, attribute):
        if attribute["blender_domain"] != "CORNER":
            return original(self, attribute)
        mesh = self.blender_mesh
        colors = np.empty(len(mesh.loops) * 4, np.float32)
        mesh.color_attributes[mesh.color_attributes.render_color_index].data.foreach_get("color", colors)
        for i in range(4):  # one dot a corner
            self.dots[attribute["gltf_attribute_name"] + str(i)] = colors[i::4]

    get_color_attribute.mended = True
    setattr(creator, _METHOD, get_color_attribute)
