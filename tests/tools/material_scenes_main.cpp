#include "tests/tools/material_scenes.h"

#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: supple_material_scenes FOLDER\n");
        return 2;
    }
    using namespace supple::test;
    const std::string folder = std::string(argv[1]) + "/";
    const bool written = writeScene(bumpScene(false), folder + "bumps.gltf") &&
                         writeScene(bumpScene(true), folder + "bumps_tangents.gltf") &&
                         writeScene(ballScene(), folder + "balls.gltf") && writeScene(layerScene(), folder + "layers.gltf");
    if (!written)
        std::fprintf(stderr, "supple_material_scenes: %s cannot be written to\n", argv[1]);
    return written ? 0 : 1;
}
