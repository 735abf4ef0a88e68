"""The glTF exporter's hooks: SUPPLE_mesh_cage beside the triangles that the exporter writes."""

import bpy
import numpy as np

from . import cage, deformers, gltf_io, weights

# Subdivision Surface modifiers that are switched off while the exporter runs. With "Apply Modifiers" it would export their
# result instead of the cage; and it would evaluate them for each frame of each clip.
_switched_off = []


def switch_subdivision_off(_export_settings=None):
    for blender_object in bpy.context.scene.objects:
        modifier = cage.subdivision_of(blender_object)
        if modifier is not None and modifier.show_viewport:
            _switched_off.append(modifier)
            modifier.show_viewport = False
    # An export that fails never comes to the callback behind it.
    if not bpy.app.background and not bpy.app.timers.is_registered(switch_subdivision_on):
        bpy.app.timers.register(switch_subdivision_on, first_interval=0.0)


def switch_subdivision_on(_export_settings=None):
    while _switched_off:
        _switched_off.pop().show_viewport = True


def _subdivision_of(blender_object):
    for modifier in _switched_off:
        if modifier.id_data == blender_object:
            return modifier
    return cage.subdivision_of(blender_object)


class Unwritable(Exception):
    """Why a mesh goes without the extension."""


def _loops_of_primitives(mesh, primitives):
    """Per primitive of triangles: the mesh's loops at its indices. The exporter writes the triangles of loop_triangles,
    material by material; so an index of the file and a loop of the mesh stand at the same place."""
    mesh.calc_loop_triangles()
    loops = cage.column(mesh.loop_triangles, "loops", 3, np.int32)
    materials = cage.column(mesh.loop_triangles, "material_index", 1, np.int32)
    triangles = [p for p in primitives if p.mode in (None, 4)]
    if len(triangles) == 1 and len(gltf_io.written_values(triangles[0].indices)) == loops.size:
        return [(triangles[0], loops.ravel())]
    numbers = np.unique(materials)
    if len(numbers) != len(triangles):
        raise Unwritable("the exporter wrote %d primitives for %d materials" % (len(triangles), len(numbers)))
    return [(primitive, loops[materials == number].ravel()) for primitive, number in zip(triangles, numbers)]


def _vertices_of_loops(mesh, primitive, loops):
    """Per loop of the mesh, the primitive's vertex (-1: not of this primitive); per vertex of the primitive, the mesh's."""
    indices = gltf_io.written_values(primitive.indices).astype(np.int64)
    if len(indices) != len(loops):
        raise Unwritable("the exporter wrote %d indices where the mesh has %d" % (len(indices), len(loops)))
    loop_vertices = cage.column(mesh.loops, "vertex_index", 1, np.int32)
    of_loop = np.full(len(mesh.loops), -1, dtype=np.int64)
    of_loop[loops] = indices
    cage_vertices = np.full(primitive.attributes["POSITION"].count, -1, dtype=np.int64)
    cage_vertices[indices] = loop_vertices[loops]
    if np.any(cage_vertices[indices] != loop_vertices[loops]) or np.any(of_loop[loops] != indices):
        raise Unwritable("the exporter wrote its triangles in another order than Blender's")
    if np.any(cage_vertices < 0):
        raise Unwritable("the exporter wrote vertices without triangles")
    return of_loop, cage_vertices


class _Features:
    """Creases with their sets, crease scalars, sharp vertices and sharp edges, each written in the first primitive that has
    all its vertices."""

    def __init__(self, mesh):
        edges = cage.column(mesh.edges, "vertices", 2, np.int32)
        creases = cage.edge_sharpnesses(mesh)
        corners = cage.vertex_sharpnesses(mesh)
        marked = cage.column(mesh.edges, "use_edge_sharp", 1, bool)
        used = np.unique(cage.column(mesh.loops, "edge_index", 1, np.int32))
        has_face = np.zeros(len(mesh.edges), bool)
        has_face[used] = True
        self.sets, of_edge = cage.crease_sets(mesh)
        is_crease = ((creases > 0) | (of_edge >= 0)) & has_face
        self.creases = [(edges[e], creases[e], of_edge[e]) for e in np.flatnonzero(is_crease)]
        alphas = cage.corner_alphas(mesh)
        ends = np.stack([cage.column(mesh.loops, "vertex_index", 1, np.int32), cage.next_vertices(mesh)], axis=1)
        self.scalars = [(ends[c], alphas[c]) for c in np.flatnonzero(alphas >= 0)]
        self.corners = [((v,), corners[v]) for v in np.flatnonzero(corners > 0)]
        self.marked = [(edges[e], 0) for e in np.flatnonzero(marked & has_face)]

    @staticmethod
    def _take(entries, vertices):
        taken = [entry for entry in entries if all(v in vertices for v in entry[0])]
        entries[:] = [entry for entry in entries if not all(v in vertices for v in entry[0])]
        return taken

    def write(self, vertices, members):
        for entries, indices, values in (
            (self.creases, "creaseIndices", "creaseSharpnesses"),
            (self.scalars, "creaseScalarIndices", "creaseScalars"),
            (self.corners, "cornerIndices", "cornerSharpnesses"),
            (self.marked, "sharpEdgeIndices", None),
        ):
            taken = self._take(entries, vertices)
            if taken:
                members[indices] = gltf_io.integer_accessor([v for entry in taken for v in entry[0]])
                if values:
                    members[values] = gltf_io.float_accessor([entry[1] for entry in taken])
                if entries is self.creases:
                    self._write_sets([entry[2] for entry in taken], members)

    def _write_sets(self, set_numbers, members):
        sets = []
        for number, name in enumerate(self.sets):
            creases = np.flatnonzero(np.array(set_numbers) == number)
            if len(creases) > 0 and name:
                sets.append({"name": name, "creases": gltf_io.integer_accessor(creases)})
        if sets:
            members["creaseSets"] = sets


def members_of(mesh, primitives):
    """Per primitive of triangles: it, the members of its SUPPLE_mesh_cage, and the mesh's vertex of each of its own."""
    starts = cage.column(mesh.polygons, "loop_start", 1, np.int32)
    totals = cage.column(mesh.polygons, "loop_total", 1, np.int32)
    hole = cage.holes(mesh)
    features = _Features(mesh)
    found = []
    for primitive, loops in _loops_of_primitives(mesh, primitives):
        of_loop, cage_vertices = _vertices_of_loops(mesh, primitive, loops)
        faces = np.flatnonzero(of_loop[starts] >= 0)
        corners = np.concatenate([of_loop[starts[f]:starts[f] + totals[f]] for f in faces])
        if np.any(corners < 0):
            raise Unwritable("a face has corners that none of its triangles has")
        members = {
            "faceVertexCounts": gltf_io.integer_accessor(totals[faces]),
            "faceVertexIndices": gltf_io.integer_accessor(corners),
            "cageVertices": gltf_io.integer_accessor(cage_vertices),
        }
        own_holes = np.flatnonzero(hole[faces])
        if len(own_holes) > 0:
            members["holeIndices"] = gltf_io.integer_accessor(own_holes)
        features.write(set(cage_vertices.tolist()), members)
        found.append((primitive, members, cage_vertices))
    return found


class ExportHooks:
    """What glTF2ExportUserExtension is made of. `report` takes a line for each mesh that goes without its cage."""

    def __init__(self, wanted, report):
        self._wanted = wanted
        self._report = report
        self._weights = {}  # by mesh of the file: what the node's hook completes
        self._deformers = deformers.Deformers(report)

    # Later versions of the exporter have no skip_filter among the arguments.
    def gather_mesh_hook(self, gltf_mesh, blender_mesh, *_others):
        if not self._wanted():
            return
        if not gltf_mesh.primitives or len(blender_mesh.polygons) == 0:
            return
        try:
            found = members_of(blender_mesh, gltf_mesh.primitives)
            for primitive, members, _ in found:
                extensions = dict(primitive.extensions or {})
                extensions[cage.EXTENSION] = gltf_io.extension(cage.EXTENSION, members)
                primitive.extensions = extensions
            self._weights[id(gltf_mesh)] = (weights.VertexWeights(blender_mesh), found)
            self._deformers.add_mesh(gltf_mesh, blender_mesh, found)
        except Unwritable as reason:
            self._report("%s: exported without its cage: %s" % (blender_mesh.name, reason))

    def gather_node_hook(self, gltf_node, blender_object, export_settings):
        if blender_object is None or not self._wanted():
            return
        self._deformers.add_node(gltf_node, blender_object)
        mesh = getattr(gltf_node, "mesh", None)
        if mesh is None or blender_object.type != "MESH":
            return
        self._write_intent(mesh, blender_object)
        self._complete_weights(mesh, getattr(gltf_node, "skin", None), blender_object, export_settings)

    def gather_joint_hook(self, gltf_node, blender_bone, _export_settings):
        if self._wanted():
            self._deformers.add_joint(gltf_node, blender_bone)

    def gather_gltf_hook(self, _active_scene, _scenes, animations, _export_settings):
        self._deformers.still_animations(animations)

    def gather_gltf_extensions_hook(self, gltf, _export_settings):
        self._deformers.write(gltf)

    def _complete_weights(self, mesh, skin, blender_object, export_settings):
        vertex_weights, found = self._weights.pop(id(mesh), (None, ()))
        if skin is None or not vertex_weights:
            return
        numbers = {joint.name: number for number, joint in enumerate(skin.joints)}
        joints = {g.index: numbers[g.name] for g in blender_object.vertex_groups if g.name in numbers}
        for primitive, _, cage_vertices in found:
            weights.complete(primitive, cage_vertices, vertex_weights, joints,
                             export_settings.get("gltf_all_vertex_influences", True))

    def _write_intent(self, mesh, blender_object):
        modifier = _subdivision_of(blender_object)
        intent = cage.intent_of(modifier)
        for primitive in mesh.primitives:
            extension = (primitive.extensions or {}).get(cage.EXTENSION)
            if extension is None:
                continue
            members = extension.extension
            if members.get("scheme", intent["scheme"]) != intent["scheme"]:
                self._report("%s: shares its mesh with an object whose Subdivision Surface differs; that one's is exported"
                             % blender_object.name)
                return
            members.update(intent)
            if modifier is not None and not modifier.use_creases:
                for name in ("creaseIndices", "creaseSharpnesses", "creaseSets", "cornerIndices", "cornerSharpnesses"):
                    members.pop(name, None)
