"""The glTF importer's hooks: polygons, creases and the intent of SUPPLE_mesh_cage back onto the mesh."""

import bmesh
import numpy as np

from . import cage, gltf_io


def _members(primitive):
    return (primitive.extensions or {}).get(cage.EXTENSION)


def has_cage(gltf_mesh):
    """Whether all its primitives of triangles list polygons."""
    triangles = [p for p in gltf_mesh.primitives if p.mode in (None, 4)]
    return bool(triangles) and all("faceVertexCounts" in (_members(p) or {}) for p in triangles)


class _Primitive:
    """A primitive's polygons, and where the importer has put its vertices."""

    def __init__(self, gltf, primitive, first_vertex):
        self.members = _members(primitive)
        self.counts = self._integers(gltf, "faceVertexCounts")
        self.corners = self._integers(gltf, "faceVertexIndices")
        count = gltf.data.accessors[primitive.attributes["POSITION"]].count
        if primitive.indices is None:
            used = np.arange(count)
        else:
            # The importer keeps the vertices that indices name, in the order of their numbers.
            used = np.unique(gltf_io.read_values(gltf, primitive.indices).ravel().astype(np.int64))
        self.mesh_vertices = np.full(count, -1, dtype=np.int64)
        self.mesh_vertices[used] = first_vertex + np.arange(len(used))
        self.next_vertex = first_vertex + len(used)
        self.numbers = self._integers(gltf, "cageVertices") if "cageVertices" in self.members else None
        if self.numbers is not None and len(self.numbers) != count:
            raise ValueError("cageVertices has %d numbers for %d vertices" % (len(self.numbers), count))
        if self.counts.sum() != len(self.corners) or (len(self.corners) and self.corners.max() >= count):
            raise ValueError("faceVertexIndices does not fit faceVertexCounts or the vertices")

    def _integers(self, gltf, member):
        return gltf_io.read_values(gltf, self.members[member]).ravel().astype(np.int64)

    def normals(self, gltf, primitive):
        if "NORMAL" not in primitive.attributes:
            return None
        return gltf_io.read_values(gltf, primitive.attributes["NORMAL"])[self.corners]

    def pairs(self, gltf, indices, values, width):
        if indices not in self.members:
            return []
        vertices = self._integers(gltf, indices)
        vertices = vertices.reshape(-1, width)
        sharpnesses = np.zeros(len(vertices), np.float32)
        if values:
            sharpnesses = gltf_io.read_values(gltf, self.members[values]).ravel().astype(np.float32)
        return list(zip(vertices.tolist(), sharpnesses))


def _read_primitives(gltf, gltf_mesh):
    primitives = []
    first_vertex = 0
    for primitive in gltf_mesh.primitives:
        if primitive.mode not in (None, 4):
            continue
        primitives.append(_Primitive(gltf, primitive, first_vertex))
        first_vertex = primitives[-1].next_vertex
    return primitives


class _Numbering:
    """Cage vertices in the order of their numbers; without numbers every vertex of the file is one."""

    def __init__(self, primitives):
        self.of_primitive = []
        numbers = [p.numbers if p.numbers is not None else p.mesh_vertices for p in primitives]
        kept = [own[p.mesh_vertices >= 0] for own, p in zip(numbers, primitives)]
        self.values, first = np.unique(np.concatenate(kept), return_index=True)
        sources = np.concatenate([p.mesh_vertices[p.mesh_vertices >= 0] for p in primitives])
        self.sources = sources[first]  # per cage vertex: a vertex of the imported mesh
        self.of_primitive = [np.searchsorted(self.values, own) for own in numbers]

    def find(self, numbers, primitive_index, primitives):
        """Cage vertices that a crease or a corner names."""
        if primitives[primitive_index].numbers is None:
            return [int(self.of_primitive[primitive_index][n]) for n in numbers]
        return [int(np.searchsorted(self.values, n)) for n in numbers]


def _rebuild(mesh, primitives, numbering):
    """Puts polygons over cage vertices in the place of the triangles. Weights, shape keys, texture coordinates and
    colors come along in the layers of an edit mesh."""
    edit = bmesh.new()
    try:
        edit.from_mesh(mesh)
        kept, skipped = _replace_faces(edit, primitives, numbering)
        edit.to_mesh(mesh)
    finally:
        edit.free()
    return kept, skipped


def _replace_faces(edit, primitives, numbering):
    edit.verts.ensure_lookup_table()
    edit.faces.ensure_lookup_table()
    old_vertices = list(edit.verts)
    loops = {}
    for face in edit.faces:
        for loop in face.loops:
            loops.setdefault(loop.vert.index, loop)
    vertices = [edit.verts.new(old_vertices[source].co, old_vertices[source]) for source in numbering.sources]
    skipped = 0
    kept = []
    for primitive, own in zip(primitives, numbering.of_primitive):
        end = 0
        for count in primitive.counts:
            corners = primitive.corners[end:end + count]
            end += count
            sources = [loops.get(int(primitive.mesh_vertices[c])) for c in corners]
            if None in sources:
                raise ValueError("a polygon has a vertex that no triangle has")
            try:
                face = edit.faces.new([vertices[own[c]] for c in corners])
            except ValueError:  # a face that repeats a vertex, or stands there already
                skipped += 1
                kept.append(False)
                continue
            kept.append(True)
            face.copy_from(sources[0].face)
            for loop, source in zip(face.loops, sources):
                loop.copy_from(source)
    bmesh.ops.delete(edit, geom=old_vertices, context="VERTS")
    return np.array(kept), skipped


def _edge_numbers(mesh):
    edges = cage.column(mesh.edges, "vertices", 2, np.int32)
    return {(min(a, b), max(a, b)): e for e, (a, b) in enumerate(edges.tolist())}


def _mark_features(gltf, mesh, primitives, numbering):
    edge_numbers = _edge_numbers(mesh)
    creases = np.zeros(len(mesh.edges), np.float32)
    marked = np.zeros(len(mesh.edges), bool)
    corners = np.zeros(len(mesh.vertices), np.float32)
    sets, alphas = {}, {}
    for i, primitive in enumerate(primitives):
        edges = []  # of this primitive's creases
        for ends, sharpness in primitive.pairs(gltf, "creaseIndices", "creaseSharpnesses", 2):
            edge = edge_numbers.get(tuple(sorted(numbering.find(ends, i, primitives))))
            edges.append(edge)
            if edge is not None:  # else it has no effect, as the extension says
                creases[edge] = max(creases[edge], sharpness)
        for crease_set in primitive.members.get("creaseSets", []):
            chosen = gltf_io.read_values(gltf, crease_set["creases"]).ravel().astype(int)
            sets.setdefault(crease_set["name"], []).extend(edges[c] for c in chosen if edges[c] is not None)
        for ends, alpha in primitive.pairs(gltf, "creaseScalarIndices", "creaseScalars", 2):
            alphas[tuple(numbering.find(ends, i, primitives))] = float(alpha)
        for vertex, sharpness in primitive.pairs(gltf, "cornerIndices", "cornerSharpnesses", 1):
            number = numbering.find(vertex, i, primitives)[0]
            corners[number] = max(corners[number], sharpness)
        for ends, _ in primitive.pairs(gltf, "sharpEdgeIndices", None, 2):
            edge = edge_numbers.get(tuple(sorted(numbering.find(ends, i, primitives))))
            if edge is not None:
                marked[edge] = True
    if corners.any():
        cage.set_vertex_sharpnesses(mesh, corners)
    if creases.any():
        cage.set_edge_sharpnesses(mesh, creases)
    if alphas:
        cage.set_corner_alphas(mesh, alphas)
    for name, chosen in sets.items():
        cage.set_crease_set(mesh, name, chosen)
    return marked


def _split_edges(mesh, normals):
    """Edges on whose sides the normals of the file differ."""
    loop_edges = cage.column(mesh.loops, "edge_index", 1, np.int32)
    loop_vertices = cage.column(mesh.loops, "vertex_index", 1, np.int32)
    split = np.zeros(len(mesh.edges), bool)
    seen = {}
    for polygon in mesh.polygons:
        for k in range(polygon.loop_total):
            a = polygon.loop_start + k
            b = polygon.loop_start + (k + 1) % polygon.loop_total
            ends = {int(loop_vertices[a]): normals[a], int(loop_vertices[b]): normals[b]}
            other = seen.setdefault(int(loop_edges[a]), ends)
            if other is not ends:
                split[loop_edges[a]] |= any(np.dot(other[v], ends[v]) < 0.9998 for v in ends)
    return split


def _set_normals(gltf, gltf_mesh, mesh, primitives, kept, marked):
    """Normals of the file as custom normals, with sharp edges where they are split."""
    triangles = [p for p in gltf_mesh.primitives if p.mode in (None, 4)]
    normals = [own.normals(gltf, p) for own, p in zip(primitives, triangles)]
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    shading = gltf.import_settings.get("import_shading", "NORMALS")
    if shading != "NORMALS" or any(own is None for own in normals):
        mesh.edges.foreach_set("use_edge_sharp", marked)
        return
    counts = np.concatenate([p.counts for p in primitives])
    normals = np.concatenate(normals)[np.repeat(kept, counts)].astype(np.float32)
    normals = np.stack([normals[:, 0], -normals[:, 2], normals[:, 1]], axis=1)
    mesh.edges.foreach_set("use_edge_sharp", marked | _split_edges(mesh, normals))
    mesh.normals_split_custom_set(normals.tolist())
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth = True


class ImportHooks:
    """What glTF2ImportUserExtension is made of. `report` takes a line for each mesh that stays in triangles."""

    def __init__(self, report):
        self._report = report
        self._merge = None

    def gather_import_gltf_before_hook(self, _gltf):
        # Debian 12's NumPy has no np.bool any more, which the importer of Debian 12's Blender still asks for.
        if "bool" not in np.__dict__:
            np.bool = bool

    def gather_import_mesh_before_hook(self, gltf_mesh, gltf):
        # Merging by position would lose which vertex is which; the cage says what is one.
        if has_cage(gltf_mesh):
            self._merge = gltf.import_settings.get("merge_vertices")
            gltf.import_settings["merge_vertices"] = False

    def gather_import_mesh_after_hook(self, gltf_mesh, blender_mesh, gltf):
        if self._merge is not None:
            gltf.import_settings["merge_vertices"] = self._merge
            self._merge = None
        if not has_cage(gltf_mesh):
            return
        try:
            primitives = _read_primitives(gltf, gltf_mesh)
            if primitives[-1].next_vertex > len(blender_mesh.vertices):
                raise ValueError("the importer has left vertices out")
            numbering = _Numbering(primitives)
            kept, skipped = _rebuild(blender_mesh, primitives, numbering)
            marked = _mark_features(gltf, blender_mesh, primitives, numbering)
            _set_holes(gltf, blender_mesh, primitives, kept)
            _set_normals(gltf, gltf_mesh, blender_mesh, primitives, kept, marked)
            if skipped:
                self._report("%s: %d faces left out: Blender takes no face twice and no vertex twice in a face"
                             % (blender_mesh.name, skipped))
        except (ValueError, KeyError) as reason:
            self._report("%s: imported as triangles: %s" % (blender_mesh.name, reason))

    def gather_import_scene_after_nodes_hook(self, _gltf_scene, _scene, gltf):
        for vnode in gltf.vnodes.values():
            blender_object = getattr(vnode, "blender_object", None)
            if blender_object is None or getattr(vnode, "mesh_node_idx", None) is None:
                continue
            gltf_mesh = gltf.data.meshes[gltf.data.nodes[vnode.mesh_node_idx].mesh]
            if has_cage(gltf_mesh):
                cage.apply_intent(blender_object, _members(gltf_mesh.primitives[0]))


def _set_holes(gltf, mesh, primitives, kept):
    holes = []
    first = 0
    for primitive in primitives:
        if "holeIndices" in primitive.members:
            holes.extend(first + gltf_io.read_values(gltf, primitive.members["holeIndices"]).ravel().astype(np.int64))
        first += len(primitive.counts)
    if holes:
        numbers = np.cumsum(kept) - 1
        cage.set_holes(mesh, numbers[[h for h in holes if kept[h]]])
