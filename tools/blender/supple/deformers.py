"""SUPPLE_deformers and VRMC_springBone, put together while the exporter runs."""

import bpy

from . import drivers, gltf_io, soft, springs

# Drivers by mesh: sampled before the exporter reads poses.
_sampled = {}


def sample_drivers(report):
    _sampled.clear()
    meshes = {o.data for o in bpy.context.scene.objects if o.type == "MESH"}
    for mesh in sorted(meshes, key=lambda m: m.name):
        found = drivers.sample(mesh, report)
        if found:
            _sampled[mesh.name] = found


class Deformers:
    """Of one export."""

    def __init__(self, report):
        self._report = report
        self._springs = springs.Springs(report)
        self._groups = {}  # by mesh of the file: vertex groups, and where its primitives have the mesh's vertices
        self._drivers = []  # (mesh of the file, drivers)
        self._written = set()

    def add_mesh(self, gltf_mesh, blender_mesh, found):
        vertices = [(primitive, cage_vertices) for primitive, _, cage_vertices in found]
        self._groups[id(gltf_mesh)] = (soft.VertexGroups(blender_mesh), vertices)

    def add_joint(self, node, pose_bone):
        self._springs.add_joint(node, pose_bone)

    def add_node(self, node, blender_object):
        self._springs.add_object(node, blender_object)
        mesh = node.mesh
        if blender_object.type != "MESH" or mesh is None or id(mesh) in self._written or id(mesh) not in self._groups:
            return
        self._written.add(id(mesh))
        writer = soft.MeshWriter(blender_object, *self._groups.pop(id(mesh)), self._report)
        members = writer.members(self._springs.collider_numbers)
        sampled = _sampled.get(blender_object.data.name)
        if sampled and mesh.weights:
            own = drivers.MeshDrivers(blender_object.data, sampled, mesh.weights)
            members["drivers"] = own.members()
            self._drivers.append((mesh, members, own))
        if members:
            mesh.extensions = {**(mesh.extensions or {}), soft.EXTENSION: gltf_io.extension(soft.EXTENSION, members)}

    def still_animations(self, animations):
        """The exporter writes what drivers set into clips; Supple's own would come on top."""
        owners = {id(mesh): own for mesh, _, own in self._drivers}
        for animation in animations:
            for channel in animation.channels:
                mesh = getattr(channel.target.node, "mesh", None)
                own = owners.get(id(mesh)) if channel.target.path == "weights" else None
                if own is not None:
                    sampler = animation.samplers[channel.sampler]
                    weights = gltf_io.written_values(sampler.output).astype("<f4").reshape(-1, own.target_count)
                    sampler.output = gltf_io.float_accessor(own.still(weights).ravel())

    def write(self, gltf):
        """When nodes have their numbers."""
        for mesh, members, own in self._drivers:
            missing = own.resolve(lambda armature, bone: self._springs.node_number(gltf, armature, bone))
            for driver, bone in missing:
                self._report("%s: the driver '%s' is left out: its bone '%s' is not exported" % (mesh.name, driver["name"], bone))
            left_out = [driver for driver, _ in missing]
            members["drivers"] = [driver for driver in members["drivers"] if driver not in left_out]
            if not members["drivers"]:
                del members["drivers"]
        self._springs.write(gltf)
