"""The control cage of a Blender mesh in the terms of SUPPLE_mesh_cage: what is written, and how it is put back."""

import numpy as np

EXTENSION = "SUPPLE_mesh_cage"

# Edge attribute: sharpnesses that Blender's crease cannot hold exactly (3.4 keeps a crease in a byte).
EXACT_SHARPNESS = "supple_sharpness"
# Face-corner attribute: P_m's crease scalar at the corner's vertex, of the edge to the face's next vertex; negative: none.
ALPHA = "supple_alpha"
# Edge attributes of this prefix: the edges of the crease set that the rest of the name names.
CREASE_SET = "supple_set:"
# Face attribute: faces that shape their neighbors and are not drawn.
HOLE = "supple_hole"

# Blender's names on the left, OpenSubdiv's and USD's on the right.
UV_SMOOTH = {
    "NONE": "all",
    "PRESERVE_CORNERS": "cornersOnly",
    "PRESERVE_CORNERS_AND_JUNCTIONS": "cornersPlus1",
    "PRESERVE_CORNERS_JUNCTIONS_AND_CONCAVE": "cornersPlus2",
    "PRESERVE_BOUNDARIES": "boundaries",
    "SMOOTH_ALL": "none",
}
BOUNDARY_SMOOTH = {"ALL": "edgeOnly", "PRESERVE_CORNERS": "edgeAndCorner"}
SUBDIVISION_TYPE = {"CATMULL_CLARK": "catmullClark", "SIMPLE": "bilinear"}


def flipped(names):
    return {value: key for key, value in names.items()}


def sharpness_of(crease):
    """Blender's crease 0..1 as OpenSubdiv's sharpness, as Blender itself turns one into the other."""
    crease = np.asarray(crease, dtype=np.float32)
    return crease * crease * np.float32(10)


def crease_of(sharpness):
    """The crease whose sharpness comes nearest. 10 and more is infinitely sharp, which is Blender's 1."""
    sharpness = np.minimum(np.asarray(sharpness, dtype=np.float32), np.float32(10))
    best = np.sqrt(sharpness / np.float32(10)).astype(np.float32)
    for _ in range(2):
        for towards in (0, 1):
            other = np.nextafter(best, np.float32(towards))
            nearer = np.abs(sharpness_of(other) - sharpness) < np.abs(sharpness_of(best) - sharpness)
            best = np.where(nearer, other, best)
    return best


def column(collection, name, width, kind):
    values = np.empty(len(collection) * width, dtype=kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def _attribute_values(mesh, names, domain, length):
    """Of the first attribute of these names, or None."""
    for name in names:
        attribute = mesh.attributes.get(name)
        if attribute is not None and attribute.domain == domain and len(attribute.data) == length:
            kind = bool if attribute.data_type == "BOOLEAN" else np.float32
            return column(attribute.data, "value", 1, kind)
    return None


def _edge_creases(mesh):
    values = _attribute_values(mesh, ("crease_edge",), "EDGE", len(mesh.edges))
    if values is None and len(mesh.edges) > 0 and hasattr(mesh.edges[0], "crease"):
        values = column(mesh.edges, "crease", 1, np.float32)
    return np.zeros(len(mesh.edges), np.float32) if values is None else values


def _vertex_creases(mesh):
    values = _attribute_values(mesh, ("crease_vert",), "POINT", len(mesh.vertices))
    if values is None:
        layers = getattr(mesh, "vertex_creases", None) or ()
        for layer in layers:
            if hasattr(layer, "data"):
                return column(layer.data, "value", 1, np.float32)
    return np.zeros(len(mesh.vertices), np.float32) if values is None else values


def edge_sharpnesses(mesh):
    """Per edge. What the file that a mesh came from said counts until somebody changes the crease."""
    creases = _edge_creases(mesh)
    sharpnesses = sharpness_of(creases)
    exact = _attribute_values(mesh, (EXACT_SHARPNESS,), "EDGE", len(mesh.edges))
    if exact is not None:
        untouched = (exact > 0) & (np.abs(crease_of(exact) - creases) <= 0.51 / 255)
        sharpnesses = np.where(untouched, exact, sharpnesses)
    return sharpnesses


def corner_alphas(mesh):
    """Per loop; negative where there is none."""
    values = _attribute_values(mesh, (ALPHA,), "CORNER", len(mesh.loops))
    return np.full(len(mesh.loops), -1, np.float32) if values is None else np.minimum(values, np.float32(1))


def next_vertices(mesh):
    """Per loop: the next vertex of its face."""
    vertices = column(mesh.loops, "vertex_index", 1, np.int32)
    following = np.roll(vertices, -1)
    starts = column(mesh.polygons, "loop_start", 1, np.int32)
    following[starts + column(mesh.polygons, "loop_total", 1, np.int32) - 1] = vertices[starts]
    return following


def crease_sets(mesh):
    """The names of the crease sets, and per edge its set, -1 for none. An edge is in the first that has it."""
    names = sorted(a.name for a in mesh.attributes if a.name.startswith(CREASE_SET) and a.domain == "EDGE")
    of_edge = np.full(len(mesh.edges), -1, np.int32)
    for number, name in enumerate(names):
        values = _attribute_values(mesh, (name,), "EDGE", len(mesh.edges))
        if values is not None:
            of_edge[(of_edge < 0) & (values > 0)] = number
    return [name[len(CREASE_SET):] for name in names], of_edge


def vertex_sharpnesses(mesh):
    return sharpness_of(_vertex_creases(mesh))


def holes(mesh):
    marked = _attribute_values(mesh, (HOLE,), "FACE", len(mesh.polygons))
    return np.zeros(len(mesh.polygons), bool) if marked is None else marked


def set_edge_sharpnesses(mesh, sharpnesses):
    creases = crease_of(sharpnesses)
    if hasattr(mesh, "edge_creases_ensure"):
        mesh.edge_creases_ensure().data.foreach_set("value", creases)
    else:
        mesh.edges.foreach_set("crease", creases)
    held = sharpness_of(_edge_creases(mesh))
    wanted = np.minimum(sharpnesses, np.float32(10))
    if np.any(held != wanted):
        attribute = mesh.attributes.new(EXACT_SHARPNESS, "FLOAT", "EDGE")
        attribute.data.foreach_set("value", np.where(held != wanted, wanted, 0).astype(np.float32))


def set_vertex_sharpnesses(mesh, sharpnesses):
    creases = crease_of(sharpnesses)
    if hasattr(mesh, "vertex_creases_ensure"):
        mesh.vertex_creases_ensure().data.foreach_set("value", creases)
        return
    if not mesh.vertex_creases:
        mesh.vertex_creases_add() if hasattr(mesh, "vertex_creases_add") else _add_vertex_creases(mesh)
    mesh.vertex_creases[0].data.foreach_set("value", creases)


def _add_vertex_creases(mesh):
    """Blender 3.4 makes this layer in edit meshes only."""
    import bmesh

    edit = bmesh.new()
    edit.from_mesh(mesh)
    edit.verts.layers.crease.verify()
    edit.to_mesh(mesh)
    edit.free()


def set_corner_alphas(mesh, alphas):
    """`alphas`: by (vertex, next vertex)."""
    vertices = column(mesh.loops, "vertex_index", 1, np.int32)
    values = [alphas.get(ends, -1) for ends in zip(vertices.tolist(), next_vertices(mesh).tolist())]
    mesh.attributes.new(ALPHA, "FLOAT", "CORNER").data.foreach_set("value", np.array(values, np.float32))


def set_crease_set(mesh, name, edges):
    marked = np.zeros(len(mesh.edges), bool)
    marked[edges] = True
    mesh.attributes.new(CREASE_SET + name, "BOOLEAN", "EDGE").data.foreach_set("value", marked)


def set_holes(mesh, indices):
    marked = np.zeros(len(mesh.polygons), bool)
    marked[indices] = True
    mesh.attributes.new(HOLE, "BOOLEAN", "FACE").data.foreach_set("value", marked)


def subdivision_of(blender_object):
    """The modifier that says how the artist looks at the cage: the last Subdivision Surface that is not switched off."""
    found = None
    for modifier in blender_object.modifiers:
        if modifier.type == "SUBSURF" and (modifier.show_viewport or modifier.show_render):
            found = modifier
    return found


def intent_of(modifier):
    """The strings and numbers of SUPPLE_mesh_cage that a Subdivision Surface modifier stands for."""
    if modifier is None:
        return {"scheme": "none"}
    intent = {
        "scheme": SUBDIVISION_TYPE[modifier.subdivision_type],
        "levels": modifier.levels,
        "limitSurface": bool(modifier.use_limit_surface),
        "faceVaryingLinearInterpolation": UV_SMOOTH[modifier.uv_smooth],
    }
    if modifier.boundary_smooth in BOUNDARY_SMOOTH:
        intent["interpolateBoundary"] = BOUNDARY_SMOOTH[modifier.boundary_smooth]
    return intent


def apply_intent(blender_object, intent):
    """A Subdivision Surface modifier as the file says; none where it says none. Behind an armature's modifier: the cage
    is deformed first."""
    scheme = intent.get("scheme", "catmullClark")
    if scheme not in ("catmullClark", "bilinear"):
        return None
    modifier = blender_object.modifiers.new("Subdivision", "SUBSURF")
    modifier.subdivision_type = flipped(SUBDIVISION_TYPE)[scheme]
    modifier.levels = intent.get("levels", 2)
    modifier.render_levels = max(modifier.levels, 2)
    modifier.use_limit_surface = intent.get("limitSurface", True)
    modifier.use_creases = True
    # Blender has nothing for "none".
    modifier.boundary_smooth = flipped(BOUNDARY_SMOOTH).get(intent.get("interpolateBoundary"), "PRESERVE_CORNERS")
    modifier.uv_smooth = flipped(UV_SMOOTH)[intent.get("faceVaryingLinearInterpolation", "all")]
    return modifier
