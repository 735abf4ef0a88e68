"""Inside Blender: surfaces.py OUT FILE.glb.. makes cages that have all that Blender's subdivision looks at, and takes the UV
modes of the given files one by one; supple_blender_limit compares Supple's surface and texture coordinates with Blender's."""

import json
import os

import bmesh
import bpy

import evaluated
import support

UV_MODES = ("NONE", "PRESERVE_CORNERS", "PRESERVE_CORNERS_AND_JUNCTIONS", "PRESERVE_CORNERS_JUNCTIONS_AND_CONCAVE",
            "PRESERVE_BOUNDARIES", "SMOOTH_ALL")


# Supple keeps a fold of mirrored halves that meet, which Blender's mode makes flat (docs/smooth_uvs.md).
FOLDED = {("helmet", "SMOOTH_ALL")}


def linked(name, mesh, boundary="PRESERVE_CORNERS"):
    made = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(made)
    modifier = made.modifiers.new("Subdivision", "SUBSURF")
    modifier.boundary_smooth = boundary
    return made


def box(side=1.0):
    edit = bmesh.new()
    bmesh.ops.create_cube(edit, size=side)
    bmesh.ops.subdivide_edges(edit, edges=edit.edges, cuts=1, use_grid_fill=True)
    return edit


def finished(name, edit):
    mesh = bpy.data.meshes.new(name)
    edit.to_mesh(mesh)
    edit.free()
    return mesh


def creased_box(creases):
    """A ring of edges of each sharpness round a box."""
    edit = box()
    layer = edit.edges.layers.crease.verify()
    for height, crease in creases:
        for edge in edit.edges:
            if all(abs(v.co.z - height) < 1e-6 for v in edge.verts) and any(len(f.verts) for f in edge.link_faces):
                if all(max(abs(v.co.x), abs(v.co.y)) > 0.49 for v in edge.verts):
                    edge[layer] = crease
    return finished("creased", edit)


def cornered_box():
    """Sharp and half-sharp vertices."""
    edit = box()
    layer = edit.verts.layers.crease.verify()
    for vertex in edit.verts:
        if vertex.co.z > 0.4:
            vertex[layer] = 1.0 if vertex.co.x > 0.1 else 0.5 if vertex.co.y > 0.1 else 0.0
    return finished("cornered", edit)


def prism(sides):
    edit = bmesh.new()
    bmesh.ops.create_cone(edit, cap_ends=True, segments=sides, radius1=1, radius2=0.6, depth=1.5)
    return finished("prism", edit)


def sheet():
    """Open, with corners of one face."""
    edit = bmesh.new()
    bmesh.ops.create_grid(edit, x_segments=3, y_segments=2, size=1)
    for i, vertex in enumerate(edit.verts):
        vertex.co.z = 0.1 * (i % 3)
    return finished("sheet", edit)


def write(folder, name, corners=False):
    """A case of the objects of the scene, at rest."""
    for armature in bpy.data.armatures:
        armature.pose_position = "REST"
    objects = support.meshes()
    for blender_object in objects:
        evaluated.subdivide(blender_object)
    path = os.path.join(folder, name + ".glb")
    support.export_glb(path, export_animations=False)
    points = os.path.join(folder, name + ".points")
    bpy.context.view_layer.update()
    (evaluated.write_corners if corners else evaluated.write_points)(objects, points)
    return {"name": name, "file": path, "rate": 1 << evaluated.LEVELS,
            "poses": [{"corners" if corners else "points": points}]}


def made_cases(folder):
    cages = {
        "creases": lambda: linked("box", creased_box([(-0.5, 1.0), (0.0, 0.37), (0.5, 0.7)])),
        "sharp_vertices": lambda: linked("box", cornered_box()),
        "prism_of_5": lambda: linked("prism", prism(5)),
        "prism_of_9": lambda: linked("prism", prism(9)),
        "sheet_sharp_corners": lambda: linked("sheet", sheet()),
        "sheet_round_corners": lambda: linked("sheet", sheet(), "ALL"),
    }
    for name, make in cages.items():
        support.start()
        make()
        yield write(folder, name)


def uv_cases(folder, path):
    support.start()
    support.import_glb(path)
    character = os.path.splitext(os.path.basename(path))[0]
    for mode in UV_MODES:
        if (character, mode) in FOLDED:
            print("%s %s left out: its map folds" % (character, mode))
            continue
        for blender_object in support.meshes():
            evaluated.subdivide(blender_object).uv_smooth = mode
        yield write(folder, character + "_" + mode.lower(), corners=True)


def main():
    folder, *files = support.arguments()
    cases = list(made_cases(folder))
    for path in files:
        cases.extend(uv_cases(folder, path))
    with open(os.path.join(folder, "cases.json"), "w") as stream:
        json.dump(cases, stream, indent=1)


main()
