"""Inside Blender: deformers_test.py OUT. What swings, jiggles, hangs and is driven, from a .blend to Supple; SUPPLE_COMMAND is
the command."""

import contextlib
import io
import json
import math
import os
import subprocess
import sys
import unittest

import bpy
import numpy as np
from mathutils import Matrix

import glb
import support

FOLDER, = support.arguments()
RINGS, SIDES = 13, 8


def path_of(name):
    return os.path.join(FOLDER, name)


def supple(*arguments):
    made = subprocess.run([os.environ["SUPPLE_COMMAND"], *arguments], capture_output=True, text=True)
    if made.returncode != 0:
        raise RuntimeError(made.stderr)
    return made.stdout


def add_armature():
    """Bones one above the other: body, arm, and two of an antenna."""
    data = bpy.data.armatures.new("rig")
    rig = bpy.data.objects.new("rig", data)
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    above = None
    for number, name in enumerate(("body", "arm", "antenna1", "antenna2")):
        bone = data.edit_bones.new(name)
        bone.head, bone.tail = (0, 0, number), (0, 0, number + 1)
        bone.parent, above = above, bone
    bpy.ops.object.mode_set(mode="OBJECT")
    return rig


def add_tower(rig):
    """A tube round the bones, each ring with the bone beside it."""
    vertices = [(0.2 * math.cos(2 * math.pi * k / SIDES), 0.2 * math.sin(2 * math.pi * k / SIDES), 4.0 * r / (RINGS - 1))
                for r in range(RINGS) for k in range(SIDES)]
    faces = [(r * SIDES + k, r * SIDES + (k + 1) % SIDES, (r + 1) * SIDES + (k + 1) % SIDES, (r + 1) * SIDES + k)
             for r in range(RINGS - 1) for k in range(SIDES)]
    tower = add_mesh("tower", vertices, faces, rig)
    for number, bone in enumerate(("body", "arm", "antenna1", "antenna2")):
        group = tower.vertex_groups.new(name=bone)
        for vertex in tower.data.vertices:
            share = max(0.0, 1.0 - abs(vertex.co.z - number - 0.5)) if 0.5 < vertex.co.z < 3.5 else float(
                number == (0 if vertex.co.z <= 0.5 else 3))
            if share > 0:
                group.add([vertex.index], share, "REPLACE")
    belly = tower.vertex_groups.new(name="belly")
    belly.add([v.index for v in tower.data.vertices if 0.4 < v.co.z < 1.4], 0.75, "REPLACE")
    tower.shape_key_add(name="Basis")
    still, bulge = (tower.shape_key_add(name=name) for name in ("still", "bulge"))
    for vertex in tower.data.vertices:
        if 0.9 < vertex.co.z < 1.4:
            bulge.data[vertex.index].co = vertex.co * 1.0 + vertex.normal * 0.1
            still.data[vertex.index].co = vertex.co + vertex.normal * 0.05
    return tower


def add_mesh(name, vertices, faces, rig):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    made = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(made)
    made.parent = rig
    made.modifiers.new("Armature", "ARMATURE").object = rig
    return made


def add_flag(rig):
    """A sheet beside the body. Its first row is pinned."""
    columns, rows = 6, 7
    vertices = [(0.25 + 0.1 * i, 0.0, 1.0 - 0.1 * j) for j in range(rows) for i in range(columns)]
    faces = [(j * columns + i, (j + 1) * columns + i, (j + 1) * columns + i + 1, j * columns + i + 1)
             for j in range(rows - 1) for i in range(columns - 1)]
    flag = add_mesh("flag", vertices, faces, rig)
    flag.vertex_groups.new(name="body").add(range(len(vertices)), 1.0, "REPLACE")
    flag.vertex_groups.new(name="pin").add(range(columns), 1.0, "REPLACE")
    return flag


def drive(tower, rig):
    """The bulge grows as the arm turns about its X."""
    driver = tower.data.shape_keys.key_blocks["bulge"].driver_add("value").driver
    driver.type = "SCRIPTED"
    variable = driver.variables.new()
    variable.name, variable.type = "turn", "TRANSFORMS"
    target = variable.targets[0]
    target.id, target.bone_target = rig, "arm"
    target.transform_type, target.transform_space = "ROT_X", "LOCAL_SPACE"
    driver.expression = "min(1, max(0, turn / 1.5708))"


def add_empty(name, rig, bone, place, radius, parent=None):
    empty = bpy.data.objects.new(name, None)
    empty.empty_display_type, empty.empty_display_size = "SPHERE", radius
    bpy.context.collection.objects.link(empty)
    empty.parent = parent or rig
    if parent is None:
        empty.parent_type, empty.parent_bone = "BONE", bone
    bpy.context.view_layer.update()
    empty.matrix_world = Matrix.Translation(place)  # upright
    bpy.context.view_layer.update()
    return empty


def animate(rig):
    """The arm swings to 90 degrees and back, in two seconds."""
    arm = rig.pose.bones["arm"]
    arm.rotation_mode = "XYZ"
    for frame, degrees in ((0, 0), (24, 90), (48, 0)):
        arm.rotation_euler = (math.radians(degrees), 0, 0)
        arm.keyframe_insert("rotation_euler", frame=frame)
    rig.animation_data.action.name = "swing"
    bpy.context.scene.frame_set(0)


def build():
    """The whole scene; saved, and opened again."""
    support.start()
    rig = add_armature()
    tower, flag = add_tower(rig), add_flag(rig)
    drive(tower, rig)
    animate(rig)
    jiggle = tower.data.supple.jiggles.add()
    jiggle.vertex_group, jiggle.frequency, jiggle.damping, jiggle.limit = "belly", 2.5, 0.125, 0.5
    cloth = flag.data.supple.cloths.add()
    cloth.pin_group, cloth.bend, cloth.hit_radius = "pin", 0.5, 0.0625
    for name, stiffness in (("antenna1", 0.5), ("antenna2", 0.25)):
        settings = rig.data.bones[name].supple
        settings.swings, settings.stiffness, settings.drag, settings.gravity = True, stiffness, 0.25, 0.125
    ball = add_empty("ball", rig, "body", (0, 0, 0.5), 0.25)
    rod = add_empty("rod", rig, "arm", (0, 0, 1.25), 0.125)
    add_empty("rod end", rig, "arm", (0, 0, 1.75), 0.125, parent=rod)
    floor = add_empty("floor", rig, "body", (0, 0, -1), 1.0)
    ball.supple.shape, rod.supple.shape, floor.supple.shape = "SPHERE", "CAPSULE", "PLANE"
    tower.modifiers["Armature"].use_deform_preserve_volume = True
    bpy.ops.wm.save_as_mainfile(filepath=path_of("deformers.blend"))
    bpy.ops.wm.open_mainfile(filepath=path_of("deformers.blend"))


def inspect(name):
    return json.loads(supple("inspect", path_of(name), "--json", "--strict"))


def baked(*arguments):
    """Positions of the cage, by part."""
    out = path_of("baked.obj")
    supple("bake", path_of("deformers.glb"), "-o", out, "--scheme", "cage", *arguments)
    with open(out, encoding="utf-8") as file:
        points = np.array([[float(x) for x in line.split()[1:4]] for line in file if line.startswith("v ")])
    parts, first = {}, 0
    for part in inspect("deformers.glb")["parts"]:
        parts[part["name"]] = points[first:first + part["vertices"]]
        first += part["vertices"]
    return parts


def evaluated(name):
    """As Blender has it at the frame at hand, in the axes of glTF."""
    mesh_object = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get())
    points = np.array([mesh_object.matrix_world @ v.co for v in mesh_object.data.vertices])
    return np.stack([points[:, 0], points[:, 2], -points[:, 1]], axis=1)


class Deformers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        build()
        support.export_glb(path_of("deformers.glb"))
        cls.json = glb.Glb(path_of("deformers.glb")).json

    def node_named(self, name):
        return next(n for n, node in enumerate(self.json["nodes"]) if node.get("name") == name)

    def test_supple_reads_all_parts(self):
        found = inspect("deformers.glb")
        self.assertEqual(found["warnings"], [])
        self.assertEqual([(s["name"], s["joints"]) for s in found["springs"]], [("antenna1", 3)])
        self.assertEqual(found["springColliders"], 3)
        self.assertEqual(len(found["jiggles"]), 1)
        self.assertEqual(found["jiggles"][0]["frequency"], 2.5)
        self.assertEqual(len(found["cloths"]), 1)
        self.assertEqual(found["cloths"][0]["bend"], 0.5)
        self.assertEqual(len(found["drivers"]), 1)
        tower = next(m for m in self.json["meshes"] if m["name"] == "tower")
        self.assertEqual(tower["extensions"]["SUPPLE_deformers"]["skinning"], "dualQuaternion")

    def test_sampled_bones_are_as_they_were(self):
        arm = bpy.data.objects["rig"].pose.bones["arm"]
        self.assertEqual(arm.rotation_euler[:], (0, 0, 0))
        self.assertEqual(bpy.data.objects["tower"].data.shape_keys.key_blocks["bulge"].value, 0)

    def test_springs_and_colliders_stand_at_their_bones(self):
        bones = self.json["extensions"]["VRMC_springBone"]
        joints = bones["springs"][0]["joints"]
        self.assertEqual([j["node"] for j in joints[:2]], [self.node_named("antenna1"), self.node_named("antenna2")])
        self.assertEqual([j["stiffness"] for j in joints[:2]], [0.5, 0.25])
        end = self.json["nodes"][joints[2]["node"]]
        self.assertEqual(end["name"], "antenna2_end")
        np.testing.assert_allclose(end["translation"], [0, 1, 0], atol=1e-6)
        shapes = {self.json["nodes"][c["node"]]["name"]: c for c in bones["colliders"]}
        self.assertEqual(set(shapes), {"ball", "rod", "floor"})
        self.assertEqual(shapes["ball"]["shape"]["sphere"]["radius"], 0.25)
        self.assertEqual(shapes["rod"]["shape"]["capsule"]["radius"], 0.125)
        np.testing.assert_allclose(shapes["rod"]["shape"]["capsule"]["tail"], [0, 0.5, 0], atol=1e-6)
        self.assertIn("plane", shapes["floor"]["extensions"]["VRMC_springBone_extended_collider"]["shape"])
        for name in ("VRMC_springBone", "VRMC_springBone_extended_collider", "SUPPLE_deformers"):
            self.assertIn(name, self.json["extensionsUsed"])
            self.assertNotIn(name, self.json.get("extensionsRequired", []))

    def test_weights_are_those_of_the_groups(self):
        file = glb.Glb(path_of("deformers.glb"))
        for mesh, attribute, expected in (("tower", "_SUPPLE_JIGGLE_0", {0.0, 0.75}), ("flag", "_SUPPLE_CLOTH_0", {0.0, 1.0})):
            primitive = next(m for m in self.json["meshes"] if m["name"] == mesh)["primitives"][0]
            self.assertEqual(set(file.values(primitive["attributes"][attribute]).ravel().tolist()), expected)
        cloth = next(m for m in self.json["meshes"] if m["name"] == "flag")["extensions"]["SUPPLE_deformers"]["cloth"][0]
        self.assertEqual(sorted(cloth["colliders"]), [0, 1, 2])

    def test_drivers_do_in_supple_what_they_do_in_blender(self):
        worst = 0.0
        for frame in (0, 8, 16, 24):
            bpy.context.scene.frame_set(frame)
            ours = baked("--clip", "swing", "--time", str(frame / 24))["tower"]
            worst = np.maximum(worst, np.abs(ours - evaluated("tower")).max())  # which keeps a NaN
            if frame == 24:
                self.assertAlmostEqual(bpy.data.objects["tower"].data.shape_keys.key_blocks["bulge"].value, 1.0, places=4)
        bpy.context.scene.frame_set(0)
        self.assertLess(worst, 0.01, "a tenth of what the key moves")

    def test_simulation_moves_what_is_soft(self):
        still = baked("--clip", "swing", "--time", "0.75")
        moved = baked("--clip", "swing", "--time", "0.75", "--simulate", "2")
        off = {part: np.linalg.norm(moved[part] - still[part], axis=1) for part in still}
        tower = off["tower"].reshape(RINGS, SIDES)
        self.assertGreater(tower[-1].max(), 0.02, "the antenna swings")
        self.assertGreater(tower[2:5].max(), 1e-3, "the belly jiggles")
        self.assertLess(tower[0].max(), 1e-5, "what is not painted stays")
        self.assertGreater(off["flag"].max(), 0.01, "the flag hangs")
        self.assertLess(off["flag"][:6].max(), 1e-5, "the pins stay")


class Mistakes(unittest.TestCase):
    def test_a_group_that_is_missing_is_named(self):
        support.start()
        mesh_object = add_flag(add_armature())
        mesh_object.data.supple.jiggles.add().vertex_group = "belly"
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            support.export_glb(path_of("missing.glb"))
        self.assertIn("flag: jiggle: there is no vertex group 'belly'; left out", said.getvalue())
        root = glb.Glb(path_of("missing.glb")).json
        self.assertNotIn("SUPPLE_deformers", root["extensionsUsed"])

    def test_corrective_smooth_is_delta_mush(self):
        support.start()
        rig = add_armature()
        tower = add_tower(rig)
        smooth = tower.modifiers.new("Smooth", "CORRECTIVE_SMOOTH")
        smooth.factor, smooth.iterations, smooth.vertex_group = 0.5, 8, "belly"
        support.export_glb(path_of("mush.glb"))
        mesh = glb.Glb(path_of("mush.glb")).json["meshes"][0]
        self.assertEqual(mesh["extensions"]["SUPPLE_deformers"],
                         {"skinning": "deltaMush", "smoothing": {"lambda": 0.5, "iterations": 8, "mask": "_SUPPLE_MUSH"}})
        self.assertIn("_SUPPLE_MUSH", mesh["primitives"][0]["attributes"])


class Vrm(unittest.TestCase):
    def test_springs_of_the_vrm_addon(self):
        """Its data as its documents name it: the add-on itself is not packaged."""
        support.start()
        rig = add_armature()
        add_tower(rig)
        ball = add_empty("ball", rig, "body", (0, 0, 0.5), 0.25)
        made = vrm_stub()
        try:
            spring_bone = rig.data.vrm_addon_extension.spring_bone1
            collider = spring_bone.colliders.add()
            collider.name, collider.bpy_object = "ball", ball
            group = spring_bone.collider_groups.add()
            group.name = "group"
            group.colliders.add().collider_name = "ball"
            spring = spring_bone.springs.add()
            spring.vrm_name, spring.center.bone_name = "ear", "body"
            spring.collider_groups.add().collider_group_name = "group"
            for bone in ("antenna1", "antenna2"):
                joint = spring.joints.add()
                joint.node.bone_name, joint.stiffness, joint.gravity_dir = bone, 0.5, (0, 0, -1)
            support.export_glb(path_of("vrm.glb"))
        finally:
            del bpy.types.Armature.vrm_addon_extension
            for kind in reversed(made):
                bpy.utils.unregister_class(kind)
        root = glb.Glb(path_of("vrm.glb")).json
        bones = root["extensions"]["VRMC_springBone"]
        self.assertEqual(root["nodes"][bones["springs"][0]["center"]]["name"], "body")
        self.assertEqual(bones["springs"][0]["name"], "ear")
        self.assertEqual(len(bones["springs"][0]["joints"]), 2)
        self.assertEqual(bones["springs"][0]["joints"][0]["gravityDir"], [0, -1, 0])
        self.assertEqual(bones["springs"][0]["colliderGroups"], [0])
        self.assertEqual(bones["colliders"][0]["shape"]["sphere"]["radius"], 0.25)


def vrm_stub():
    """Property groups with the names that the VRM add-on has."""
    props = bpy.props

    def group(name, **members):
        return type(name, (bpy.types.PropertyGroup,), {"__annotations__": members})

    bone = group("VrmBone", bone_name=props.StringProperty())
    joint = group("VrmJoint", node=props.PointerProperty(type=bone), hit_radius=props.FloatProperty(),
                  stiffness=props.FloatProperty(), gravity_power=props.FloatProperty(),
                  gravity_dir=props.FloatVectorProperty(size=3), drag_force=props.FloatProperty())
    collider = group("VrmCollider", bpy_object=props.PointerProperty(type=bpy.types.Object))
    named_collider = group("VrmNamedCollider", collider_name=props.StringProperty())
    collider_group = group("VrmColliderGroup", colliders=props.CollectionProperty(type=named_collider))
    named_group = group("VrmNamedGroup", collider_group_name=props.StringProperty())
    spring = group("VrmSpring", vrm_name=props.StringProperty(), center=props.PointerProperty(type=bone),
                   joints=props.CollectionProperty(type=joint),
                   collider_groups=props.CollectionProperty(type=named_group))
    spring_bone = group("VrmSpringBone", colliders=props.CollectionProperty(type=collider),
                        collider_groups=props.CollectionProperty(type=collider_group),
                        springs=props.CollectionProperty(type=spring))
    extension = group("VrmExtension", spring_bone1=props.PointerProperty(type=spring_bone))
    made = [bone, joint, collider, named_collider, collider_group, named_group, spring, spring_bone, extension]
    for kind in made:
        bpy.utils.register_class(kind)
    bpy.types.Armature.vrm_addon_extension = props.PointerProperty(type=extension)
    return made


result = unittest.main(argv=["deformers_test"], exit=False, verbosity=1).result
print("%d tests of deformers, %d failed" % (result.testsRun, len(result.failures) + len(result.errors)))
sys.exit(0 if result.wasSuccessful() and result.testsRun > 0 else 1)
