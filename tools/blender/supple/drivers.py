"""Shape keys that Blender's drivers set from bones' rotations, as pose drivers of SUPPLE_deformers: drivers are sampled."""

import math
import re

import bpy
import numpy as np
from mathutils import Matrix, Quaternion

from . import gltf_io

# Angles of samples about one or two axes, and about three: a driver has 64 poses at most.
STEPS = {1: (15.0, 165.0), 2: (15.0, 165.0), 3: (22.5, 157.5)}
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
CHANNELS = ("location", "rotation_euler", "rotation_quaternion", "rotation_axis_angle", "scale")
MOST_INPUTS, MOST_POSES, MOST_TARGETS = 4, 64, 8
FLAT = 1e-4


class Sampled:
    """A pose driver of a mesh: `inputs` are (armature, bone, members); a pose has a rotation for each of them."""

    def __init__(self, keys, inputs, poses, values):
        self.keys = keys
        self.inputs = inputs
        self.found = len(poses)  # how many poses say something; more than MOST_POSES are thinned out
        chosen = np.linspace(0, len(poses) - 1, MOST_POSES).astype(int) if len(poses) > MOST_POSES else range(len(poses))
        self.poses = [poses[k] for k in chosen]  # (x, y, z, w), pose after pose
        self.values = [values[k] for k in chosen]  # pose after pose, one for each key


def _bones_in(fcurve):
    """The pose bones that a driver reads."""
    found = []
    for variable in fcurve.driver.variables:
        for target in variable.targets:
            armature = target.id
            if not isinstance(armature, bpy.types.Object) or armature.pose is None:
                continue
            named = re.match(r'pose\.bones\["((?:[^"\\]|\\.)*)"\]', target.data_path)
            name = target.bone_target if variable.type != "SINGLE_PROP" else named.group(1) if named else ""
            bone = armature.pose.bones.get(name)
            if bone is not None and bone not in found:
                found.append(bone)
    return found


def driven_keys(mesh):
    """Name of a shape key -> the pose bones that its driver reads, where the exporter writes the key and bones drive it."""
    keys = mesh.shape_keys
    found = {}
    for fcurve in keys.animation_data.drivers if keys and keys.animation_data else ():
        named = re.match(r'key_blocks\["((?:[^"\\]|\\.)*)"\]\.value$', fcurve.data_path)
        if named and named.group(1) in target_numbers(mesh) and fcurve.is_valid:
            bones = _bones_in(fcurve)
            if bones:
                found[named.group(1)] = bones
    return found


class _Poser:
    """Turns one bone from where it stands, and reads what drivers make of it."""

    def __init__(self, mesh, keys):
        self._mesh = mesh
        self._keys = keys

    def values(self, bone=None, turn=None):
        if bone is None:
            return self._read()
        # Not the matrix: from it, an angle beyond 180 degrees would come back as another one.
        before = {name: getattr(bone, name)[:] for name in CHANNELS}
        place, rotation, scale = bone.matrix_basis.decompose()
        bone.matrix_basis = Matrix.LocRotScale(place, rotation @ turn, scale)
        found = self._read()
        for name, values in before.items():
            setattr(bone, name, values)
        return found

    def _read(self):
        bpy.context.view_layer.update()
        return np.array([self._mesh.shape_keys.key_blocks[key].value for key in self._keys])


def _turns(axis, step, most):
    count = int(most / step)
    return [Quaternion(axis, math.radians(step * k)) for k in range(-count, count + 1) if k != 0]


def _kept(values):
    """Samples that say something: those that are flat beside flat ones do not. `values`: one row a sample."""
    moved = np.any(np.abs(values) > FLAT, axis=1)
    beside = moved.copy()
    beside[1:] |= moved[:-1]
    beside[:-1] |= moved[1:]
    return np.flatnonzero(beside)


def _part_of(axes):
    """What an input looks at, if turns about these axes count; a bone lies along its Y."""
    if axes == [1]:
        return {"part": "twist", "axis": [0.0, 1.0, 0.0]}
    if 1 not in axes:
        return {"part": "swing", "axis": [0.0, 1.0, 0.0]}
    return {"part": "rotation"}


def _sample(mesh, keys, bones):
    """A driver of keys that read the same bones, or why there is none."""
    poser = _Poser(mesh, keys)
    rest = poser.values()
    axes_of = {}
    for bone in bones:
        axes_of[bone] = [number for number, axis in enumerate(AXES)
                         if any(np.any(np.abs(poser.values(bone, turn) - rest) > FLAT) for turn in _turns(axis, 45.0, 135.0))]
    moving = [bone for bone in bones if axes_of[bone]]
    if not moving:
        return "no rotation of its bones moves it"
    if len(moving) > MOST_INPUTS:
        return "more than %d bones turn it" % MOST_INPUTS
    step, most = STEPS[max(len(axes_of[bone]) for bone in moving)]
    poses, values = [], []
    for place, bone in enumerate(moving):
        for number in axes_of[bone]:
            turns = _turns(AXES[number], step, most)
            own = np.array([poser.values(bone, turn) - rest for turn in turns])
            for k in _kept(own):
                rotations = [(0.0, 0.0, 0.0, 1.0)] * len(moving)
                rotations[place] = (turns[k].x, turns[k].y, turns[k].z, turns[k].w)
                poses.append(rotations)
                values.append(own[k])
    poser.values()
    inputs = [(bone.id_data.name, bone.name, _part_of(axes_of[bone])) for bone in moving]
    return Sampled(keys, inputs, poses, values)


def sample(mesh, report):
    """All drivers of a mesh. Poses bones, and leaves them as they were: not while the exporter reads them."""
    by_bones = {}
    for key, bones in driven_keys(mesh).items():
        by_bones.setdefault(tuple(bones), []).append(key)
    found = []
    for bones, keys in by_bones.items():
        for first in range(0, len(keys), MOST_TARGETS):
            own = keys[first:first + MOST_TARGETS]
            sampled = _sample(mesh, own, bones)
            if not isinstance(sampled, Sampled):
                report("%s: the driver of '%s' is left out: %s" % (mesh.name, own[0], sampled))
                continue
            found.append(sampled)
            if sampled.found > MOST_POSES:
                report("%s: the driver of '%s' needs %d poses; %d of them are written" % (mesh.name, own[0], sampled.found, MOST_POSES))
    return found


def target_numbers(mesh):
    """Name of a shape key -> its number among the morph targets that the exporter writes."""
    keys = [k for k in mesh.shape_keys.key_blocks if k != k.relative_key and not k.mute]
    return {key.name: number for number, key in enumerate(keys)}


class MeshDrivers:
    """The drivers of a mesh, as they are written."""

    def __init__(self, mesh, sampled, rest):
        """`rest`: the weights of the mesh of the file."""
        self._rest = rest
        self._targets = target_numbers(mesh)
        self._sampled = sampled
        self._pending = []  # (driver, members of an input, armature, bone): its node is known later

    @property
    def target_count(self):
        return len(self._targets)

    def members(self):
        written = []
        for driver in self._sampled:
            values = np.array(driver.values)
            inputs = [{"node": 0, **members} for _, _, members in driver.inputs]
            written.append({
                "name": driver.inputs[0][1],
                "inputs": inputs,
                "poses": gltf_io.float_accessor(driver.poses, "VEC4"),
                "values": gltf_io.float_accessor(values.ravel()),
                "targets": [self._targets[key] for key in driver.keys],
                "clamp": [min(0.0, float(values.min())), max(0.0, float(values.max()))],
            })
            self._pending += [(written[-1], own, armature, bone) for own, (armature, bone, _) in zip(inputs, driver.inputs)]
        return written

    def resolve(self, node_number):
        """`node_number(armature, bone)`. Returns (driver, bone) for each bone that was not exported."""
        missing = []
        for driver, members, armature, bone in self._pending:
            members["node"] = node_number(armature, bone)
            if members["node"] is None:
                missing.append((driver, bone))
        return missing

    def still(self, weights):
        """Takes from keys of weights, one row a key, what drivers set: it is added again."""
        for driver in self._sampled:
            for key in driver.keys:
                weights[:, self._targets[key]] = self._rest[self._targets[key]]
        return weights
