"""Inside Blender: addon_test.py OUT SAMPLES. What the add-on writes, reads back, says and shows; SUPPLE_COMMAND is the command."""

import os
import sys
import tomllib
import unittest
import zipfile

import bmesh
import bpy
import numpy as np
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Euler, Vector

import glb
import support

FOLDER, SAMPLES = support.arguments()


def path_of(name):
    return os.path.join(FOLDER, name + ".glb")


def add(name, vertices, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    made = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(made)
    return made


def add_box(name="box"):
    """Its side x > 0 is a pentagon, there is a triangle beside it, and one side is of another material."""
    vertices = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)] + [(1.2, 0, 1)]
    faces = [(0, 1, 3, 2), (6, 7, 8, 5, 4), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 8, 3), (8, 7, 3)]
    made = add(name, vertices, faces)
    for material in ("skin", "cloth"):
        made.data.materials.append(bpy.data.materials.new(material))
    made.data.polygons[2].material_index = 1
    made.data.uv_layers.new(name="UVMap")
    return made


def edge_of(mesh, a, b):
    return next(e for e in mesh.edges if set(e.vertices) == {a, b})


def set_vertex_crease(mesh, creases):
    edit = bmesh.new()
    edit.from_mesh(mesh)
    layer = edit.verts.layers.crease.verify()
    edit.verts.ensure_lookup_table()
    for vertex, crease in creases.items():
        edit.verts[vertex][layer] = crease
    edit.to_mesh(mesh)
    edit.free()


def subdivided(blender_object, **settings):
    modifier = blender_object.modifiers.new("Subdivision", "SUBSURF")
    for name, value in settings.items():
        setattr(modifier, name, value)
    return modifier


def exported(name, **settings):
    support.export_glb(path_of(name), **settings)
    return glb.cages(path_of(name))


def select(*blender_objects):
    bpy.ops.object.select_all(action="DESELECT")
    for blender_object in blender_objects:
        blender_object.select_set(True)
    bpy.context.view_layer.objects.active = blender_objects[0]


class Case(unittest.TestCase):
    def setUp(self):
        support.start()


class Package(unittest.TestCase):
    def test_one_zip_is_an_addon_and_an_extension(self):
        with zipfile.ZipFile(os.environ["SUPPLE_ADDON_ZIP"]) as archive:
            names = archive.namelist()
            manifest = tomllib.loads(archive.read("supple/blender_manifest.toml").decode())
            sources = {name: archive.read(name).decode() for name in names if name.endswith(".py")}
        self.assertIn("supple/__init__.py", names)
        self.assertTrue(all(name.startswith("supple/") for name in names))
        self.assertEqual(manifest["version"], ".".join(str(n) for n in sys.modules["supple"].bl_info["version"]))
        # The rules of Blender's extensions: short lines without a full stop, and modules that find each other wherever
        # the package lies.
        for text in [manifest["tagline"]] + list(manifest["permissions"].values()):
            self.assertLessEqual(len(text), 64)
            self.assertTrue(text[-1].isalnum())
        for name, source in sources.items():
            self.assertNotRegex(source, r"(?m)^\s*(import|from) supple\b", name)


class Export(Case):
    def test_polygons_stand_in_blenders_order_per_material(self):
        add_box()
        cage = exported("polygons")["box"]
        self.assertEqual(cage.polygons(), [(0, 1, 3, 2), (6, 7, 8, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 8, 3),
                                           (8, 7, 3), (0, 4, 5, 1)])
        self.assertEqual(cage.materials, ["skin"] * 6 + ["cloth"])
        self.assertEqual(cage.numbers.tolist(), list(range(9)))

    def test_creases_sharp_vertices_and_sharp_edges(self):
        box = add_box()
        set_vertex_crease(box.data, {7: 1.0, 2: 0.5})
        edge_of(box.data, 0, 1).crease = 1.0
        edge_of(box.data, 5, 8).crease = 128 / 255
        edge_of(box.data, 2, 3).use_edge_sharp = True
        subdivided(box)
        cage = exported("features")["box"]
        self.assertEqual(set(cage.creases), {(0, 1), (5, 8)})
        self.assertEqual(cage.creases[(0, 1)], 10)
        self.assertAlmostEqual(cage.creases[(5, 8)], 10 * (128 / 255) ** 2, places=6)
        self.assertEqual(cage.corners, {(7,): 10, (2,): 2.5})
        self.assertEqual(cage.sharp_edges, {(2, 3)})

    def test_the_modifier_is_exported_as_intent(self):
        box = add_box()
        self.assertEqual(exported("no_modifier")["box"].intent["scheme"], "none")
        modifier = subdivided(box, levels=3, uv_smooth="PRESERVE_CORNERS_AND_JUNCTIONS", boundary_smooth="ALL",
                              use_limit_surface=False)
        edge_of(box.data, 0, 1).crease = 1.0
        for apply in (False, True):
            cage = exported("modifier", export_apply=apply)["box"]
            self.assertEqual(cage.intent, {"scheme": "catmullClark", "levels": 3, "limitSurface": False,
                                           "interpolateBoundary": "edgeOnly",
                                           "faceVaryingLinearInterpolation": "cornersPlus1"})
            self.assertEqual(len(cage.counts), 7)
            self.assertEqual(len(cage.creases), 1)
            self.assertTrue(modifier.show_viewport)
        modifier.subdivision_type = "SIMPLE"
        modifier.use_creases = False
        cage = exported("simple")["box"]
        self.assertEqual(cage.intent["scheme"], "bilinear")
        self.assertEqual(cage.creases, {})
        modifier.show_viewport = modifier.show_render = False
        self.assertEqual(exported("switched_off")["box"].intent["scheme"], "none")

    def test_other_modifiers_are_applied_if_the_exporter_applies_them(self):
        box = add_box()
        box.modifiers.new("Mirror", "MIRROR").use_mirror_merge = False
        subdivided(box)
        cage = exported("mirrored", export_apply=True)["box"]
        self.assertEqual(len(cage.counts), 14)
        self.assertEqual(cage.intent["scheme"], "catmullClark")

    def test_without_cages_the_file_is_the_stock_exporters(self):
        subdivided(add_box())
        bpy.context.scene.supple.export = False
        support.export_glb(path_of("stock"))
        self.assertNotIn("SUPPLE_mesh_cage", glb.Glb(path_of("stock")).json.get("extensionsUsed", []))

    def test_shape_keys_come_through(self):
        box = add_box()
        box.shape_key_add(name="Basis")
        key = box.shape_key_add(name="wide")
        key.data[8].co.x += 0.5
        cage = exported("shape_keys")["box"]
        self.assertEqual(len(cage.targets), 1)
        moved = np.flatnonzero(np.abs(cage.targets[0]).max(axis=1))
        self.assertEqual(moved.tolist(), [8])

    def test_one_mesh_with_two_intents_is_said(self):
        box = add_box()
        other = bpy.data.objects.new("other", box.data)
        bpy.context.collection.objects.link(other)
        subdivided(box)
        cages = exported("shared")
        self.assertEqual({c.intent["scheme"] for c in cages.values()}, {"catmullClark"})


class Import(Case):
    def there_and_back(self, name, **settings):
        support.export_glb(path_of(name), **settings)
        support.start()
        support.import_glb(path_of(name))
        return support.meshes()[0]

    def test_what_was_exported_comes_back(self):
        box = add_box()
        set_vertex_crease(box.data, {7: 1.0, 2: 0.25})
        edge_of(box.data, 0, 1).crease = 1.0
        edge_of(box.data, 5, 8).crease = 100 / 255
        edge_of(box.data, 2, 3).use_edge_sharp = True
        box.shape_key_add(name="Basis")
        box.shape_key_add(name="wide").data[8].co.x += 0.5
        subdivided(box, levels=3, uv_smooth="PRESERVE_BOUNDARIES", boundary_smooth="ALL", use_limit_surface=False)
        for polygon in box.data.polygons:
            polygon.use_smooth = True
        back = self.there_and_back("back")
        mesh = back.data
        self.assertEqual([tuple(p.vertices) for p in mesh.polygons],
                         [(0, 1, 3, 2), (6, 7, 8, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 8, 3), (8, 7, 3), (0, 4, 5, 1)])
        self.assertEqual(edge_of(mesh, 0, 1).crease, 1)
        self.assertAlmostEqual(edge_of(mesh, 5, 8).crease, 100 / 255, places=6)
        self.assertEqual(sum(1 for e in mesh.edges if e.crease > 0), 2)
        self.assertEqual([round(v.value, 6) for v in mesh.vertex_creases[0].data], [0, 0, 0.25, 0, 0, 0, 0, 1, 0])
        self.assertTrue(edge_of(mesh, 2, 3).use_edge_sharp)
        self.assertEqual([m.name for m in mesh.materials], ["skin", "cloth"])
        self.assertEqual([p.material_index for p in mesh.polygons], [0] * 6 + [1])
        keys = mesh.shape_keys.key_blocks
        self.assertEqual([k.name for k in keys], ["Basis", "wide"])
        self.assertAlmostEqual(keys["wide"].data[8].co.x - keys["Basis"].data[8].co.x, 0.5, places=6)
        modifier = back.modifiers["Subdivision"]
        self.assertEqual((modifier.levels, modifier.uv_smooth, modifier.boundary_smooth, modifier.use_limit_surface),
                         (3, "PRESERVE_BOUNDARIES", "ALL", False))

    def test_exact_sharpness_stays_until_the_crease_is_changed(self):
        box = add_box()
        subdivided(box)
        attribute = box.data.attributes.new("supple_sharpness", "FLOAT", "EDGE")
        exact = np.float32(2.3)
        for a, b in ((0, 1), (5, 8)):
            edge = edge_of(box.data, a, b)
            attribute.data[edge.index].value = exact
            edge.crease = np.sqrt(exact / 10)
        back = self.there_and_back("exact")
        self.assertEqual({e: np.float32(s) for e, s in exported("exact_again")["box"].creases.items()},
                         {(0, 1): exact, (5, 8): exact})
        edge_of(back.data, 5, 8).crease = 0.8
        changed = exported("exact_changed")["box"].creases
        self.assertEqual(np.float32(changed[(0, 1)]), exact)
        self.assertAlmostEqual(changed[(5, 8)], 6.4, places=5)

    def test_crease_scalars_and_sets_come_back(self):
        box = add_box()
        subdivided(box)
        mesh = box.data
        edge_of(mesh, 0, 1).crease = 1.0
        values = np.full(len(mesh.loops), -1, np.float32)
        values[:3] = (0.0, 0.3, 1.0)  # of the face 0 1 3 2: at 0 towards 1, at 1 towards 3, at 3 towards 2
        mesh.attributes.new("supple_alpha", "FLOAT", "CORNER").data.foreach_set("value", values)
        for name, edges in (("brow", ((0, 1), (5, 8))), ("lid", ((2, 3),))):
            marked = np.zeros(len(mesh.edges), bool)
            marked[[edge_of(mesh, a, b).index for a, b in edges]] = True
            mesh.attributes.new("supple_set:" + name, "BOOLEAN", "EDGE").data.foreach_set("value", marked)
        for step in ("scalars", "scalars_again"):
            cage = exported(step)["box"]
            self.assertEqual(cage.scalars, {(0, 1): 0.0, (1, 3): float(np.float32(0.3)), (3, 2): 1.0})
            self.assertEqual(cage.crease_sets, {"brow": {(0, 1), (5, 8)}, "lid": {(2, 3)}})
            self.assertEqual(cage.creases, {(0, 1): 10, (5, 8): 0, (2, 3): 0})
            support.start()
            support.import_glb(path_of(step))

    def test_holes_stay_holes(self):
        box = add_box()
        subdivided(box)
        box.data.attributes.new("supple_hole", "BOOLEAN", "FACE").data[3].value = True
        before = exported("holes")["box"]
        self.there_and_back("holes")
        after = exported("holes_again")["box"]
        self.assertEqual(before.holes, [2])
        self.assertEqual(after.holes, before.holes)

    def test_a_cage_that_does_not_fit_stays_in_triangles(self):
        add_box()
        support.export_glb(path_of("broken"))
        file = glb.Glb(path_of("broken"))
        members = file.json["meshes"][0]["primitives"][0]["extensions"]["SUPPLE_mesh_cage"]
        members["cageVertices"] = members["faceVertexCounts"]
        file.write(path_of("broken"))
        support.start()
        support.import_glb(path_of("broken"))
        mesh = support.meshes()[0].data
        self.assertEqual({len(p.vertices) for p in mesh.polygons}, {3})

    def test_no_subdivision_stays_none(self):
        add_box()
        self.assertEqual(len(self.there_and_back("plain").modifiers), 0)

    def test_armature_deforms_before_the_surface_is_made(self):
        box = add_box()
        armature = bpy.data.objects.new("rig", bpy.data.armatures.new("rig"))
        bpy.context.collection.objects.link(armature)
        select(armature)
        bpy.ops.object.mode_set(mode="EDIT")
        armature.data.edit_bones.new("bone").tail = (0, 0, 1)
        bpy.ops.object.mode_set(mode="OBJECT")
        box.parent = armature
        box.modifiers.new("Armature", "ARMATURE").object = armature
        subdivided(box)
        box.vertex_groups.new(name="bone").add(range(9), 1.0, "REPLACE")
        self.assertEqual([m.type for m in self.there_and_back("rigged").modifiers], ["ARMATURE", "SUBSURF"])


class Panel(Case):
    def reported(self, blender_object):
        from supple import report

        select(blender_object)
        self.assertEqual(bpy.ops.supple.inspect(), {"FINISHED"})
        return report.reports[blender_object.name]

    def test_scheme_classes_and_refusals_with_their_faces(self):
        box = add_box()
        subdivided(box)
        found = self.reported(box)
        self.assertEqual(found.scheme, "catmull-clark")
        self.assertIn("made for catmullClark", found.reason)
        self.assertTrue(any("irregular" in f.text for f in found.findings))
        number = next(i for i, f in enumerate(found.findings) if f.text.startswith("prep: refused"))
        self.assertEqual(found.findings[number].faces, [1, 6])
        bpy.ops.supple.select_faces(finding=number)
        self.assertEqual(box.mode, "EDIT")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual([p.index for p in box.data.polygons if p.select], [1, 6])

    def test_faces_are_blenders_behind_another_material(self):
        box = add_box()
        box.data.polygons[2].material_index = 0
        box.data.polygons[0].material_index = 1
        subdivided(box)
        found = self.reported(box)
        refused = next(f for f in found.findings if f.text.startswith("prep: refused"))
        self.assertEqual(sorted(refused.faces), [1, 6])

    def test_folds(self):
        # The vertex in the middle lies beyond its neighbors.
        points = [(x, y, 0) for y in range(5) for x in range(5)]
        points[12] = (4.4, 2, 0)
        spike = add("spike", points, [(i, i + 1, i + 6, i + 5) for i in range(19) if i % 5 != 4])
        subdivided(spike)
        found = self.reported(spike)
        folds = [f for f in found.findings if "fold" in f.text]
        self.assertEqual(len(folds), 1, [f.text for f in found.findings])
        self.assertTrue(folds[0].faces)

    def test_damage_is_named(self):
        fins = add("fins", [(0, 0, 0), (0, 0, 1), (1, 0, 0), (1, 0, 1), (0, 1, 0), (0, 1, 1), (-1, 0, 0), (-1, 0, 1)],
                   [(0, 2, 3, 1), (0, 4, 5, 1), (0, 6, 7, 1)])
        subdivided(fins)
        found = self.reported(fins)
        damage = [f for f in found.findings if "three or more faces" in f.text]
        self.assertEqual(len(damage), 1, [f.text for f in found.findings])
        self.assertEqual(sorted(damage[0].faces), [0, 1, 2])

    def test_unsubdivided_meshes_are_polygons(self):
        self.assertEqual(self.reported(add_box()).scheme, "polygons")

    def test_clips_say_when_feet_stand(self):
        support.import_glb(os.path.join(SAMPLES, "pip.glb"))
        found = self.reported(support.meshes()[0])
        walk = [f.text for f in found.findings if f.text.startswith("walk: ")]
        self.assertEqual(len(walk), 1, [f.text for f in found.findings])
        self.assertRegex(walk[0], r"^walk: 2\.\d\d s; foot\.L stands 0\.\d\d to .*; foot\.R stands .*; packed \d+\.\d:1 within ")
        box = add_box()
        self.assertFalse(any(" stands " in f.text for f in self.reported(box).findings), "no armature, no clips")

    def test_a_missing_command_is_said(self):
        box = add_box()
        select(box)
        kept, os.environ["SUPPLE_COMMAND"] = os.environ["SUPPLE_COMMAND"], "/nowhere/supple"
        path, os.environ["PATH"] = os.environ["PATH"], ""
        try:
            with self.assertRaisesRegex(RuntimeError, "preferences"):
                bpy.ops.supple.inspect()
        finally:
            os.environ["SUPPLE_COMMAND"], os.environ["PATH"] = kept, path


def covered(image):
    """Left, right, bottom, top of what stands out from the background, which changes slowly, in pixels."""
    width, height = image.size
    pixels = np.array(image.pixels[:]).reshape(height, width, 4)[:, :, :3]
    step = np.zeros((height, width))
    step[:, 1:] = np.abs(np.diff(pixels, axis=1)).max(axis=2)
    step[1:, :] = np.maximum(step[1:, :], np.abs(np.diff(pixels, axis=0)).max(axis=2))
    drawn = step > 0.03
    rows, columns = np.flatnonzero(drawn.any(axis=1)), np.flatnonzero(drawn.any(axis=0))
    return columns[0], columns[-1], rows[0], rows[-1]


class Preview(Case):
    def expect_place(self, camera, box):
        """The picture shows the mesh where Blender's camera sees it."""
        scene = bpy.context.scene
        scene.render.resolution_x, scene.render.resolution_y = 320, 240
        scene.render.resolution_percentage = 100
        scene.camera = camera
        bpy.context.view_layer.update()
        self.assertEqual(bpy.ops.supple.preview(), {"FINISHED"})
        image = bpy.data.images["Supple preview"]
        self.assertEqual(tuple(image.size), (320, 240))
        seen = [world_to_camera_view(scene, camera, box.matrix_world @ v.co) for v in box.data.vertices]
        wanted = (min(p.x for p in seen) * 320, max(p.x for p in seen) * 320,
                  min(p.y for p in seen) * 240, max(p.y for p in seen) * 240)
        for found, place in zip(covered(image), wanted):
            self.assertLess(abs(found - place), 4.0, (covered(image), wanted))

    def scene(self):
        box = add("brick", [(x, y, z) for x in (-1, 1) for y in (-0.5, 0.5) for z in (0, 0.8)],
                  [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
        box.location = (0.7, 0.2, 0.3)
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        bpy.context.collection.objects.link(camera)
        return box, camera

    def test_a_camera_that_rolls(self):
        box, camera = self.scene()
        camera.location = (3, -6, 2.5)
        camera.rotation_euler = ((Vector((0, 0, 0.5)) - camera.location).to_track_quat("-Z", "Y") @
                                 Euler((0, 0, 0.6)).to_quaternion()).to_euler()
        self.expect_place(camera, box)

    def test_a_camera_straight_above(self):
        box, camera = self.scene()
        camera.location = (0.5, 0, 7)
        camera.rotation_euler = (0, 0, 0.8)
        self.expect_place(camera, box)

    def test_a_camera_without_perspective(self):
        box, camera = self.scene()
        camera.data.type = "ORTHO"
        camera.data.ortho_scale = 4
        camera.location = (3, -6, 2.5)
        camera.rotation_euler = (Vector((0, 0, 0.5)) - camera.location).to_track_quat("-Z", "Y").to_euler()
        self.expect_place(camera, box)

    def test_the_pose_of_the_frame(self):
        box, camera = self.scene()
        camera.location = (0, -8, 1)
        camera.rotation_euler = (np.pi / 2, 0, 0)
        for frame, height in ((1, 0.0), (11, 1.0)):
            box.location.z = height
            box.keyframe_insert("location", frame=frame)
        bpy.context.scene.frame_set(11)
        self.expect_place(camera, box)


class Difference(Case):
    def measured(self, scheme):
        from supple import difference

        box = add_box()
        edge_of(box.data, 0, 1).crease = 1.0
        subdivided(box, boundary_smooth="PRESERVE_CORNERS")
        select(box)
        return difference.measure(bpy.context, box, scheme), box

    def test_catmull_clark_is_blenders(self):
        found, _ = self.measured("auto")
        self.assertLess(found.largest, 2e-6)

    def test_another_scheme_is_not_and_is_drawn(self):
        found, _ = self.measured("pm")
        self.assertGreater(found.largest, 1e-3)
        colors = found.blender_object.data.color_attributes["Supple difference"]
        values = np.empty(len(colors.data) * 4, np.float32)
        colors.data.foreach_get("color", values)
        red = values.reshape(-1, 4)[:, 0]
        self.assertEqual(red.max(), 1)
        self.assertEqual(red.min(), 0)
        select(next(o for o in support.meshes() if o.name == "box"))
        self.assertEqual(bpy.ops.supple.difference(), {"FINISHED"})


result = unittest.main(argv=["addon_test"], exit=False, verbosity=1).result
print("%d tests of the add-on, %d failed" % (result.testsRun, len(result.failures) + len(result.errors)))
sys.exit(0 if result.wasSuccessful() and result.testsRun > 0 else 1)
