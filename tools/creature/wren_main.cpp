// supple_wren [--moving] OUT.glb: makes the second sample character, always to the same bytes.

#include "wren_assemble.h"
#include "wren_clips.h"
#include "wren_springs.h"

#include "tools/gltf/writer.h"

#include <cstdio>
#include <cstring>
#include <fstream>

using namespace supple::creature;

namespace {

int fail(const std::string& message) {
    std::fprintf(stderr, "supple_wren: %s\n", message.c_str());
    return 1;
}

std::vector<wren::Piece> pieces() {
    std::vector<wren::Piece> list;
    list.push_back({"head", wren::modelHead({})});
    list.back().targets = {{"blink", wren::modelHead({.blink = 1})}, {"smile", wren::modelHead({.smile = 1})},
                           {"open", wren::modelHead({.open = 1})},   {"round", wren::modelHead({.round = 1})},
                           {"brows", wren::modelHead({.brows = 1})}, {"frown", wren::modelHead({.frown = 1})}};
    list.push_back({"eyes", wren::modelEyes(0), {{"blink", wren::modelEyes(1)}}});
    list.push_back({"hands", wren::modelHands()});
    list.push_back({"hair", wren::modelHair()});
    const Cage jacket = wren::modelJacket();
    list.push_back({"jacket", jacket});
    list.push_back({"trousers", wren::modelTrousers()});
    list.push_back({"boots", wren::modelBoots()});
    list.push_back({"gear", wren::modelGear(jacket)});
    list.push_back({"scarf", wren::modelScarf()});
    list.push_back({"sword", wren::modelSword()});
    for (wren::Piece& piece : list) {
        piece.cage.compact();
        for (auto& [name, shaped] : piece.targets) {
            shaped.compact();
        }
    }
    return list;
}

} // namespace

int main(int argc, char** argv) {
    const bool moving = argc == 3 && std::strcmp(argv[1], "--moving") == 0;
    if (argc != 2 && !moving) {
        std::fprintf(stderr, "usage: supple_wren [--moving] OUT.glb\n");
        return 2;
    }
    const char* path = argv[argc - 1];
    const std::vector<wren::Piece> made = pieces();
    size_t points = 0, faces = 0, quads = 0;
    for (const wren::Piece& piece : made) {
        if (hasCoincidentPoints(piece.cage)) {
            return fail(piece.name + ": two points coincide");
        }
        points += piece.cage.points.size();
        faces += piece.cage.faces.size();
        for (const Face& face : piece.cage.faces) {
            quads += face.points.size() == 4;
        }
    }
    const Skeleton skeleton = wren::makeSkeleton(moving);
    supple::cage::Character character = wren::assemble(made, skeleton, wren::makeClips(skeleton));
    if (moving) {
        wren::addSprings(skeleton, character);
    }
    const auto file = supple::cage::writeGlb(character);
    if (!file) {
        return fail(file.error().message);
    }
    for (const std::string& warning : file->warnings) {
        return fail(warning);
    }
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(file->bytes.data()), static_cast<std::streamsize>(file->bytes.size()));
    if (!out.flush()) {
        return fail(std::string("cannot write ") + path);
    }
    std::printf("%zu parts, %zu points, %zu faces, %zu of them quads, %zu joints, %zu bytes\n", made.size(), points,
                faces, quads, skeleton.joints.size(), file->bytes.size());
    return 0;
}
