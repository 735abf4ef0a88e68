"""The picture that `supple render` makes of the scene, from where the user looks."""

import math
import os
import tempfile

import bpy
from mathutils import Vector

from . import character, command

IMAGE = "Supple preview"

# An orthographic view is drawn from this many times as far, through as narrow a field of view.
ORTHOGRAPHIC_DISTANCE = 100.0


class View:
    """A camera in Blender's axes. `slope`: the tangent of half the field of view from lower to upper edge."""

    def __init__(self, matrix, slope, size):
        self.eye = matrix.translation.copy()
        self.ahead = -matrix.col[2].to_3d().normalized()
        self.up = matrix.col[1].to_3d().normalized()
        self.slope = slope
        self.size = size

    def stand_back(self, height, focus):
        """The same picture of what is `focus` ahead, without perspective."""
        distance = ORTHOGRAPHIC_DISTANCE * height
        self.eye = self.eye + self.ahead * (focus - distance)
        self.slope = 0.5 * height / distance

    def arguments(self):
        def point(vector):
            return "%.9g,%.9g,%.9g" % (vector.x, vector.z, -vector.y)

        ahead = self.eye + self.ahead * max(1.0, self.eye.length)
        return ["--eye", point(self.eye), "--look-at", point(ahead), "--up", point(self.up),
                "--fov", "%.9g" % math.degrees(2 * math.atan(self.slope)), "--size", "%dx%d" % self.size]


def render_size(scene):
    share = scene.render.resolution_percentage / 100
    return max(1, int(scene.render.resolution_x * share)), max(1, int(scene.render.resolution_y * share))


def view_of_camera(context, camera):
    size = render_size(context.scene)
    graph = context.evaluated_depsgraph_get()
    projection = camera.calc_matrix_camera(graph, x=size[0], y=size[1])
    view = View(camera.matrix_world.normalized(), 1.0 / projection[1][1], size)
    if camera.data.type == "ORTHO":
        view.stand_back(2.0 / projection[1][1], 0.0)
    return view


def view_of_region(region, region_3d):
    matrix = region_3d.view_matrix.inverted()
    window = region_3d.window_matrix
    view = View(matrix, 1.0 / window[1][1], (region.width, region.height))
    if not region_3d.is_perspective:
        view.stand_back(2.0 / window[1][1], region_3d.view_distance)
    return view


def current_view(context):
    """What the 3D viewport shows; without one, or if it looks through the camera, the scene's camera."""
    region_3d = getattr(context.space_data, "region_3d", None)
    if region_3d is not None and region_3d.view_perspective != "CAMERA":
        for region in context.area.regions:
            if region.type == "WINDOW":
                return view_of_region(region, region_3d)
    if context.scene.camera is None:
        raise command.CommandError("The scene has no camera")
    return view_of_camera(context, context.scene.camera)


def render(context, path, more=()):
    """Draws the visible meshes into a PNG; returns the command's warnings."""
    view = current_view(context)
    meshes = character.visible_meshes(context)
    if not meshes:
        raise command.CommandError("No mesh is visible")
    with tempfile.TemporaryDirectory() as folder:
        glb = os.path.join(folder, "scene.glb")
        character.write(context, meshes, glb)
        _, warnings = command.run(["render", glb, "-o", path, "--no-ground"] + view.arguments() + list(more))
    return warnings


def load(path):
    """The picture as an image of this file, packed: the PNG may go."""
    image = bpy.data.images.get(IMAGE)
    if image is not None:
        bpy.data.images.remove(image)
    image = bpy.data.images.load(path, check_existing=False)
    image.name = IMAGE
    image.pack()
    return image


def show(context, image):
    """In an image editor that is open, else in a new window."""
    if bpy.app.background:
        return
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "IMAGE_EDITOR":
                area.spaces.active.image = image
                return
    bpy.ops.wm.window_new()
    area = context.window_manager.windows[-1].screen.areas[0]
    area.type = "IMAGE_EDITOR"
    area.spaces.active.image = image


def run(context):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "preview.png")
        warnings = render(context, path)
        show(context, load(path))
    return warnings
