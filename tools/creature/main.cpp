// supple_creature [--quads|--moving] OUT.glb: makes the sample character, always to the same bytes.

#include "assemble.h"
#include "paint.h"
#include "pip_model.h"
#include "pip_moving.h"
#include "skeleton.h"

#include "surface/pm/mesh.h"
#include "tools/gltf/writer.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>

using namespace supple::creature;

namespace {

int fail(const std::string& message) {
    std::fprintf(stderr, "supple_creature: %s\n", message.c_str());
    return 1;
}

bool writeFile(const char* path, const std::vector<std::byte>& bytes) {
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return static_cast<bool>(out.flush());
}

} // namespace

int main(int argc, char** argv) {
    const auto isGiven = [&](const char* flag) { return argc == 3 && std::strcmp(argv[1], flag) == 0; };
    const bool quads = isGiven("--quads"), moving = isGiven("--moving");
    if (argc != 2 && !quads && !moving) {
        std::fprintf(stderr, "usage: supple_creature [--quads|--moving] OUT.glb\n");
        return 2;
    }
    const char* path = argv[argc - 1];
    const Cage model = modelPip(quads ? Variant::quads : Variant::mixed);
    if (hasCoincidentPoints(model)) {
        return fail("two points coincide");
    }
    const Skeleton skeleton = makeSkeleton(moving);
    supple::cage::Character character =
        assemble(model, skeleton, skinWeights(model, skeleton), paint(model), unwrap(model), makeClips(skeleton));
    if (moving) {
        addMoving(model, skeleton, character);
    }
    const auto mesh = supple::surface::pm::buildMesh(character.cage);
    if (!mesh) {
        return fail(mesh.error().message);
    }
    const auto file = supple::cage::writeGlb(character);
    if (!file) {
        return fail(file.error().message);
    }
    for (const std::string& warning : file->warnings) {
        return fail(warning);
    }
    if (!writeFile(path, file->bytes)) {
        return fail(std::string("cannot write ") + path);
    }
    std::map<size_t, int> sides;
    for (const Face& face : model.faces) {
        ++sides[face.points.size()];
    }
    std::printf("%zu points, %zu creases, %zu joints, %zu faces; by sides", model.points.size(), model.creases.size(),
                skeleton.joints.size(), model.faces.size());
    for (const auto& [count, faces] : sides) {
        std::printf(" %zu:%d", count, faces);
    }
    std::printf("\n");
    return 0;
}
