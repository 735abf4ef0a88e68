"""Bones that swing and what they meet: VRMC_springBone. Colliders are Empties."""

import bpy

from . import gltf_io

EXTENSION = "VRMC_springBone"
MORE_COLLIDERS = "VRMC_springBone_extended_collider"


class SuppleBoneSettings(bpy.types.PropertyGroup):
    swings: bpy.props.BoolProperty(
        name="Swings", description="The bone swings. Bones one below the other that swing are a chain", default=False)
    stiffness: bpy.props.FloatProperty(
        name="Stiffness", description="How strongly it is pulled to where the clip has it", default=1.0, min=0.0, soft_max=4.0)
    drag: bpy.props.FloatProperty(
        name="Drag", description="What part of its speed it loses: 1 does not swing on", default=0.4, min=0.0, max=1.0)
    gravity: bpy.props.FloatProperty(
        name="Gravity", description="How strongly it is pulled down; 0.16 is the earth's, if a unit is a metre",
        default=0.0, soft_min=0.0, soft_max=2.0)
    hit_radius: bpy.props.FloatProperty(
        name="Hit Radius", description="How far its tail stays from colliders", default=0.02, min=0.0, unit="LENGTH")
    colliders: bpy.props.PointerProperty(
        name="Colliders", type=bpy.types.Collection,
        description="The colliders that the chain meets, said at its first bone. None: those of the whole scene")


class SuppleColliderSettings(bpy.types.PropertyGroup):
    shape: bpy.props.EnumProperty(
        name="Collider",
        description="What bones and cloth do not enter. Parent the Empty to a bone",
        items=(
            ("NONE", "None", "No collider"),
            ("SPHERE", "Sphere", "As large as the Empty is shown"),
            ("CAPSULE", "Capsule", "From the Empty to its first child, as thick as the Empty is shown"),
            ("PLANE", "Plane", "Nothing gets below; up is the Empty's Z"),
        ),
        default="NONE",
    )
    inside: bpy.props.BoolProperty(name="Keep Inside", description="Bones stay in it, not out of it", default=False)


def colliders_of(collection=None):
    """The Empties of the scene, or of a collection, that are colliders."""
    objects = bpy.context.scene.objects if collection is None else collection.all_objects
    return [o for o in objects if o.type == "EMPTY" and o.supple.shape != "NONE"]


def _shape_of(blender_object):
    """In the space of the Empty's node: Y is up there, as everywhere in glTF."""
    settings = blender_object.supple
    if settings.shape == "PLANE":
        return {"plane": {"offset": [0.0, 0.0, 0.0], "normal": [0.0, 1.0, 0.0]}}
    radius = blender_object.empty_display_size * sum(blender_object.matrix_world.to_scale()) / 3.0
    shape = {"offset": [0.0, 0.0, 0.0], "radius": radius}
    if settings.inside:
        shape["inside"] = True
    if settings.shape == "SPHERE" or not blender_object.children:
        return {"sphere": shape}
    way = blender_object.matrix_world.inverted() @ blender_object.children[0].matrix_world.translation
    return {"capsule": {**shape, "tail": [way.x, way.z, -way.y]}}


class _Chain:
    """Bones that swing one below the other."""

    def __init__(self, name, bones, tail, numbers, colliders, center=""):
        self.name = name
        self.bones = bones  # names
        self.tail = tail  # the bone or the node that is its end
        self.numbers = numbers  # one of each bone
        self.colliders = colliders  # a collection, a list of Empties, or None
        self.center = center  # the bone in whose space it moves; empty: the world


def _numbers_of(settings):
    return {"hitRadius": settings.hit_radius, "stiffness": settings.stiffness, "gravityPower": settings.gravity,
            "gravityDir": [0.0, -1.0, 0.0], "dragForce": settings.drag}


def chains_of(armature):
    """By the bones' settings."""
    chains = []
    for bone in armature.data.bones:
        above = bone.parent
        if not bone.supple.swings or (above is not None and above.supple.swings and _next(above) == bone):
            continue
        bones = [bone]
        while _next(bones[-1]) is not None:
            bones.append(_next(bones[-1]))
        chains.append(_Chain(bone.name, [b.name for b in bones], None, [_numbers_of(b.supple) for b in bones],
                             bone.supple.colliders))
    return chains


def _next(bone):
    """The bone below that swings on in its chain."""
    return next((child for child in bone.children if child.supple.swings), None)


def vrm_chains_of(armature, report):
    """Those of the VRM add-on, if it is enabled and has some. `report` takes a line for what is left out."""
    extension = getattr(armature.data, "vrm_addon_extension", None)
    spring_bone = getattr(extension, "spring_bone1", None)
    if spring_bone is None:
        return []
    empties = {c.name: c.bpy_object for c in spring_bone.colliders if c.bpy_object is not None}
    groups = {g.name: [empties[c.collider_name] for c in g.colliders if c.collider_name in empties]
              for g in spring_bone.collider_groups}
    chains = []
    for spring in spring_bone.springs:
        joints = [j for j in spring.joints if j.node.bone_name in armature.data.bones]
        if len(joints) < 2:
            report("%s: '%s' has fewer than two bones; this spring is left out" % (armature.name, spring.vrm_name))
            continue
        numbers = [{"hitRadius": j.hit_radius, "stiffness": j.stiffness, "gravityPower": j.gravity_power,
                    "gravityDir": [j.gravity_dir[0], j.gravity_dir[2], -j.gravity_dir[1]], "dragForce": j.drag_force}
                   for j in joints]
        names = [j.node.bone_name for j in joints]
        own = [e for g in spring.collider_groups for e in groups.get(g.collider_group_name, ())]
        chains.append(_Chain(spring.vrm_name, names[:-1], names[-1], numbers, own, spring.center.bone_name))
    return chains


class Springs:
    """Gathers nodes while the exporter makes them, and writes the extension when their numbers are known."""

    def __init__(self, report):
        self._report = report
        self._joints = {}  # node by (armature, bone)
        self._objects = {}  # node by object
        self._chains = {}  # by armature
        self._colliders = []  # Empties, in the order of the file

    def add_joint(self, node, pose_bone):
        """Behind those below it. The last bone of a chain gets a node for its tail, which glTF's bones have not."""
        armature = pose_bone.id_data
        self._joints[armature.name, pose_bone.name] = node
        for chain in self._chains_of(armature):
            if chain.tail is None and chain.bones[-1] == pose_bone.name:
                chain.tail = gltf_io.node(pose_bone.name + "_end", [0.0, pose_bone.bone.length, 0.0])
                node.children.append(chain.tail)

    def add_object(self, node, blender_object):
        self._objects[blender_object.name] = node

    def collider_numbers(self, collection=None):
        """Of a collection, of a list of Empties, or of None: the scene's."""
        empties = collection if isinstance(collection, list) else colliders_of(collection)
        numbers = []
        for empty in empties:
            if empty not in self._colliders:
                self._colliders.append(empty)
            numbers.append(self._colliders.index(empty))
        return numbers

    def node_number(self, gltf, armature_name, bone_name):
        """Of a bone that was exported, or None."""
        node = self._joints.get((armature_name, bone_name))
        return gltf.nodes.index(node) if node in gltf.nodes else None

    def _chains_of(self, armature):
        if armature.name not in self._chains:
            own = vrm_chains_of(armature, self._report)
            taken = {bone for chain in own for bone in chain.bones + [chain.tail]}
            for chain in chains_of(armature):
                if taken.isdisjoint(chain.bones):
                    own.append(chain)
                else:
                    self._report("%s: '%s' swings as the VRM add-on says; its Supple Spring is left out" % (armature.name, chain.name))
            self._chains[armature.name] = own
        return self._chains[armature.name]

    def write(self, gltf):
        springs, groups = [], []
        for armature, chains in self._chains.items():
            for chain in chains:
                joints = [self.node_number(gltf, armature, bone) for bone in chain.bones]
                tail = chain.tail
                joints.append(self.node_number(gltf, armature, tail) if isinstance(tail, str)
                              else gltf.nodes.index(tail) if tail in gltf.nodes else None)
                if None in joints:
                    self._report("%s: '%s' has bones that are not exported; its spring is left out" % (armature, chain.name))
                    continue
                numbers = chain.numbers + [{}] * (len(joints) - len(chain.numbers))
                spring = {"name": chain.name, "joints": [{"node": j, **n} for j, n in zip(joints, numbers)]}
                center = self.node_number(gltf, armature, chain.center)
                if center is not None:
                    spring["center"] = center
                elif chain.center:
                    self._report("%s: '%s' swings in the world: its center '%s' is not exported" % (armature, chain.name, chain.center))
                met = self.collider_numbers(chain.colliders)
                if met:
                    spring["colliderGroups"] = [self._group(groups, met)]
                springs.append(spring)
        members = {"specVersion": "1.0"}
        colliders = [self._collider(gltf, empty) for empty in self._colliders]
        for key, entries in (("colliders", colliders), ("colliderGroups", groups), ("springs", springs)):
            if entries:
                members[key] = entries
        if len(members) > 1:
            if any("extensions" in collider for collider in colliders):
                gltf_io.use_extension(gltf, MORE_COLLIDERS)
            gltf.extensions[EXTENSION] = gltf_io.extension(EXTENSION, members)

    @staticmethod
    def _group(groups, colliders):
        group = {"colliders": colliders}
        if group not in groups:
            groups.append(group)
        return groups.index(group)

    def _collider(self, gltf, empty):
        node = self._objects.get(empty.name)
        if node not in gltf.nodes:
            # Its number is named already: it stays, far from everything.
            self._report("%s: the collider is not exported" % empty.name)
            return {"node": 0, "shape": {"sphere": {"offset": [0.0, -10000.0, 0.0], "radius": 0.0}}}
        if empty.supple.shape == "CAPSULE" and not empty.children:
            self._report("%s: a capsule needs a child, where it ends; it is written as a sphere" % empty.name)
        shape, number = _shape_of(empty), gltf.nodes.index(node)
        if "plane" not in shape and not empty.supple.inside:
            return {"node": number, "shape": shape}
        unknown = {"sphere": {"offset": [0.0, -10000.0, 0.0], "radius": 0.0}}
        return {"node": number, "shape": unknown,
                "extensions": {MORE_COLLIDERS: {"specVersion": "1.0", "shape": shape}}}


CLASSES = (SuppleBoneSettings, SuppleColliderSettings)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Bone.supple = bpy.props.PointerProperty(type=SuppleBoneSettings)
    bpy.types.Object.supple = bpy.props.PointerProperty(type=SuppleColliderSettings)


def unregister():
    del bpy.types.Object.supple
    del bpy.types.Bone.supple
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
