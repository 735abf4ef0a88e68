"""What this add-on uses of Blender's glTF add-on, whose modules have other names in later versions."""

import importlib

import numpy as np


def _first_module(*names):
    for name in names:
        try:
            return importlib.import_module("io_scene_gltf2." + name)
        except ModuleNotFoundError:
            continue
    raise ModuleNotFoundError("Blender's glTF add-on has none of: " + ", ".join(names))


def extension(name, members):
    """An extension of a glTF object that viewers may ignore."""
    return _first_module("io.com.gltf2_io_extensions").Extension(name, members, required=False)


# Of a bufferView with vertex attributes.
ARRAY_BUFFER = 34962


def _accessor(array, component_type, kind="SCALAR", target=None):
    binary = _first_module("io.exp.gltf2_io_binary_data", "io.exp.binary_data").BinaryData(array.tobytes(), target)
    return _first_module("io.com.gltf2_io").Accessor(
        buffer_view=binary,
        byte_offset=None,
        component_type=component_type,
        count=len(array),
        extensions=None,
        extras=None,
        max=None,
        min=None,
        name=None,
        normalized=None,
        sparse=None,
        type=kind,
    )


def integer_accessor(values):
    """A SCALAR accessor of the smallest unsigned integers that hold all values."""
    array = np.asarray(values, dtype=np.uint32)
    largest = int(array.max())
    if largest < 256:
        return _accessor(array.astype(np.uint8), 5121)
    if largest < 65536:
        return _accessor(array.astype("<u2"), 5123)
    return _accessor(array.astype("<u4"), 5125)


def float_accessor(values, kind="SCALAR"):
    """`values`: a number or a row an element."""
    array = np.asarray(values, dtype="<f4")
    return _accessor(array if kind == "SCALAR" else array.reshape(-1, {"VEC4": 4}[kind]), 5126, kind)


def vertex_scalars(values):
    """A vertex attribute of one number."""
    return _accessor(np.asarray(values, dtype="<f4"), 5126, "SCALAR", ARRAY_BUFFER)


def node(name, translation):
    """A node of its own, without a mesh."""
    return _first_module("io.com.gltf2_io").Node(
        camera=None,
        children=None,
        extensions=None,
        extras=None,
        matrix=None,
        mesh=None,
        name=name,
        rotation=None,
        scale=None,
        skin=None,
        translation=translation,
        weights=None,
    )


def use_extension(gltf, name):
    """Where an extension stands inside another one."""
    if name not in gltf.extensions_used:
        gltf.extensions_used.append(name)


def vertex_accessor(values):
    """VEC4: joints, as bytes or shorts, or weights."""
    component_type = {"u1": 5121, "u2": 5123, "f4": 5126}[values.dtype.str[1:]]
    return _accessor(np.ascontiguousarray(values), component_type, "VEC4", ARRAY_BUFFER)


def written_values(accessor):
    """The values of an accessor that the exporter has not packed yet."""
    kinds = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
    return np.frombuffer(accessor.buffer_view.data, dtype=kinds[int(accessor.component_type)])


def read_values(gltf, accessor_index):
    """All values of an accessor of an imported file, one row per element."""
    module = _first_module("io.imp.gltf2_io_binary", "io.imp.io_binary")
    return module.BinaryData.decode_accessor_obj(gltf, gltf.data.accessors[accessor_index])
