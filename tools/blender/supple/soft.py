"""What jiggles and what is cloth, painted as vertex groups, and how the mesh is skinned: SUPPLE_deformers."""

import bpy
import numpy as np

from . import gltf_io

EXTENSION = "SUPPLE_deformers"
MUSH_MASK = "_SUPPLE_MUSH"
MOST_COLLIDERS = 16  # of a cloth


class SuppleJiggle(bpy.types.PropertyGroup):
    vertex_group: bpy.props.StringProperty(name="Vertex Group", description="How far each vertex jiggles: 1 wholly")
    frequency: bpy.props.FloatProperty(
        name="Frequency", description="Swings per second: 2 to 4 for a belly, 6 to 10 for cheeks",
        default=4.0, min=0.05, max=30.0)
    damping: bpy.props.FloatProperty(
        name="Damping", description="0 never stops, 0.1 to 0.3 rings down, 1 creeps back", default=0.2, min=0.0, max=10.0)
    limit: bpy.props.FloatProperty(
        name="Limit", description="The farthest that a vertex gets from its place",
        default=0.05, min=1e-6, max=1e9, unit="LENGTH")

    def members(self):
        return {"frequency": self.frequency, "damping": self.damping, "limit": self.limit}


class SuppleCloth(bpy.types.PropertyGroup):
    vertex_group: bpy.props.StringProperty(name="Vertex Group", description="What moves: 1 is light, less is heavier")
    pin_group: bpy.props.StringProperty(
        name="Pin Group", description="What stays on the bones: 1 is pinned, as in Blender's cloth")
    stretch: bpy.props.FloatProperty(
        name="Stretch", description="How much edges give: 0 is rigid, 1e-7 cotton",
        default=1e-7, min=0.0, max=1000.0, precision=9)
    shear: bpy.props.FloatProperty(
        name="Shear", description="How much diagonals give", default=1e-7, min=0.0, max=1000.0, precision=9)
    bend: bpy.props.FloatProperty(
        name="Bend", description="1e-3 bends easily, 1e-6 is stiff", default=1e-3, min=0.0, max=1000.0, precision=7)
    volume: bpy.props.BoolProperty(name="Keep Volume", description="For balls, cushions and bellies", default=False)
    tether: bpy.props.FloatProperty(
        name="Tether", description="The farthest from what is pinned, by the way over the mesh; 0: any",
        default=1.02, min=0.0, max=10.0)
    drag: bpy.props.FloatProperty(
        name="Drag", description="What part of its speed beside the character is lost in 1/60 s", default=0.1, min=0.0, max=1.0)
    air: bpy.props.FloatProperty(
        name="Air", description="What part of its speed through the air is lost in 1/60 s", default=0.05, min=0.0, max=1.0)
    gravity: bpy.props.FloatProperty(name="Gravity", default=9.81, min=0.0, max=10000.0)
    hit_radius: bpy.props.FloatProperty(
        name="Hit Radius", description="How far vertices stay from colliders", default=0.01, min=0.0, max=1e9, unit="LENGTH")
    substeps: bpy.props.IntProperty(name="Substeps", description="More are stiffer and cost more", default=4, min=1, max=8)
    colliders: bpy.props.PointerProperty(
        name="Colliders", type=bpy.types.Collection, description="The colliders that it meets. None: those of the whole scene")

    def members(self):
        tether = max(1.0, self.tether) if self.tether > 0 else 0.0
        return {"stretch": self.stretch, "shear": self.shear, "bend": self.bend, "volume": self.volume, "tether": tether,
                "drag": self.drag, "air": self.air, "gravity": self.gravity, "hitRadius": self.hit_radius,
                "substeps": self.substeps}


class SuppleMeshSettings(bpy.types.PropertyGroup):
    skinning: bpy.props.EnumProperty(
        name="Skinning",
        description="How several bones move a vertex",
        items=(
            ("MODIFIERS", "As the Modifiers Say",
             "Corrective Smooth: delta mush. Preserve Volume of the Armature: dual quaternions. Else nothing is said"),
            ("linear", "Linear", ""),
            ("dualQuaternion", "Dual Quaternions", ""),
            ("centersOfRotation", "Centers of Rotation", ""),
            ("deltaMush", "Delta Mush", ""),
            ("deltaMushLight", "Delta Mush, Light", ""),
        ),
        default="MODIFIERS",
    )
    jiggles: bpy.props.CollectionProperty(type=SuppleJiggle)
    cloths: bpy.props.CollectionProperty(type=SuppleCloth)


def _modifier(blender_object, kind):
    return next((m for m in blender_object.modifiers if m.type == kind and m.show_viewport), None)


def skinning_of(blender_object):
    """The members `skinning` and `smoothing`, and the vertex group of the mask, or None: (group, inverted)."""
    members, mask = {}, None
    skinning = blender_object.data.supple.skinning
    smooth, armature = _modifier(blender_object, "CORRECTIVE_SMOOTH"), _modifier(blender_object, "ARMATURE")
    if skinning != "MODIFIERS":
        members["skinning"] = skinning
    elif smooth is not None:
        members["skinning"] = "deltaMush"
    elif armature is not None and armature.use_deform_preserve_volume:
        members["skinning"] = "dualQuaternion"
    if smooth is not None and members["skinning"].startswith("deltaMush"):
        members["smoothing"] = {"lambda": min(10.0, max(0.01, smooth.factor)), "iterations": min(32, max(1, smooth.iterations))}
        if smooth.vertex_group:
            members["smoothing"]["mask"] = MUSH_MASK
            mask = (smooth.vertex_group, smooth.invert_vertex_group)
    return members, mask


class VertexGroups:
    """The weights of a mesh, while the exporter has it."""

    def __init__(self, mesh):
        self.count = len(mesh.vertices)
        self._weights = {}
        for vertex in mesh.vertices:
            for group in vertex.groups:
                self._weights.setdefault(group.group, []).append((vertex.index, group.weight))

    def weights(self, blender_object, name):
        """Per vertex; None: the object has no such group."""
        group = blender_object.vertex_groups.get(name)
        if group is None:
            return None
        weights = np.zeros(self.count, np.float32)
        for vertex, weight in self._weights.get(group.index, ()):
            weights[vertex] = weight
        return np.clip(weights, 0.0, 1.0)


class MeshWriter:
    """Writes the extension of a mesh. `found`: per primitive it, and the mesh's vertex of each of its own. `report` takes
    a line for what is left out."""

    def __init__(self, blender_object, groups, found, report):
        self._object = blender_object
        self._groups = groups
        self._found = found
        self._report = report

    def members(self, collider_numbers):
        """`collider_numbers`: of a collection of objects, or of None, the scene's."""
        members, mask = skinning_of(self._object)
        if mask:
            self._write_mask(members, *mask)
        settings = self._object.data.supple
        for kind, entries, attribute in (("jiggle", settings.jiggles, "_SUPPLE_JIGGLE_%d"),
                                         ("cloth", settings.cloths, "_SUPPLE_CLOTH_%d")):
            written = []
            for entry in entries:
                weights = self._weights_of(kind, entry)
                if weights is None:
                    continue
                name = attribute % len(written)
                self._write(name, weights)
                written.append({"weights": name, **entry.members()})
                if kind == "cloth":
                    written[-1]["colliders"] = self._met(collider_numbers(entry.colliders))
            if written:
                members[kind] = written
        return members

    def _met(self, colliders):
        if len(colliders) > MOST_COLLIDERS:
            self._report("%s: cloth: it meets %d of %d colliders; choose them by a collection"
                         % (self._object.name, MOST_COLLIDERS, len(colliders)))
        return colliders[:MOST_COLLIDERS]

    def _group(self, kind, name):
        weights = self._groups.weights(self._object, name)
        if weights is None:
            self._report("%s: %s: there is no vertex group '%s'; left out" % (self._object.name, kind, name))
        return weights

    def _weights_of(self, kind, entry):
        pins = entry.pin_group if kind == "cloth" else ""
        if pins and not entry.vertex_group:
            weights = np.ones(self._groups.count, np.float32)
        else:
            weights = self._group(kind, entry.vertex_group)
        if weights is not None and pins:
            pinned = self._group(kind, pins)
            weights = None if pinned is None else weights * (1.0 - pinned)
        if weights is not None and not np.any(weights > 0):
            self._report("%s: %s: '%s' has no weight anywhere; left out" % (self._object.name, kind, entry.vertex_group or pins))
            return None
        return weights

    def _write(self, name, weights):
        for primitive, vertices in self._found:
            own = weights[vertices]
            if np.any(own > 0) or name == MUSH_MASK:
                primitive.attributes[name] = gltf_io.vertex_scalars(own)

    def _write_mask(self, members, group, inverted):
        weights = self._group("Corrective Smooth", group)
        if weights is None:
            del members["smoothing"]["mask"]
        else:
            self._write(MUSH_MASK, 1.0 - weights if inverted else weights)


CLASSES = (SuppleJiggle, SuppleCloth, SuppleMeshSettings)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Mesh.supple = bpy.props.PointerProperty(type=SuppleMeshSettings)


def unregister():
    del bpy.types.Mesh.supple
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
