"""Inside Blender without the add-on: without_addon.py FILE.glb.. opens each file as anybody's Blender does."""

import sys

import glb
import support


def main():
    files = support.arguments()
    failed = 0
    for path in files:
        support.start(with_addon=False)
        # Smooth shading, because the importer of Debian 12's Blender asks NumPy for np.bool, which Debian 12's has not.
        support.import_glb(path, shading="SMOOTH")
        wanted = sum(glb_triangles(path))
        found = sum(len(o.data.polygons) for o in support.meshes())
        clips = len(support.clips())
        if found != wanted or clips != len(glb.Glb(path).json.get("animations", [])):
            failed += 1
            print("FAILED: %s: %d triangles of %d, %d clips" % (path, found, wanted, clips))
    print("%d of %d files opened by Blender without the add-on" % (len(files) - failed, len(files)))
    if failed or not files:
        sys.exit(1)


def glb_triangles(path):
    file = glb.Glb(path)
    for node in file.mesh_nodes():
        for primitive in file.json["meshes"][node["mesh"]]["primitives"]:
            yield file.json["accessors"][primitive["indices"]]["count"] // 3


main()
