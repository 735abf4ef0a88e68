// Any glTF or GLB: read, or refused with a message.
#include "cage/gltf/reader.h"
#include "cage/limits.h"
#include "cage/repair.h"
#include "cage/solved_driver.h"
#include "cage/topology.h"
#include "tests/fuzz/target.h"

#include <algorithm>

namespace supple::fuzz {
namespace {

void checkCage(const cage::Character& character) {
    const cage::Cage& cage = character.cage;
    demand(cage.faceCount() > 0 && cage.faceStarts.back() == cage.faceVertices.size(), "faces and corners disagree");
    demand(std::all_of(cage.faceVertices.begin(), cage.faceVertices.end(),
                       [&](uint32_t vertex) { return vertex < cage.vertexCount(); }),
           "a corner out of range");
    for (const glm::vec3& position : cage.positions) {
        demand(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z),
               "a position is not finite");
    }
    demand(character.weights.starts.size() == cage.vertexCount() + 1, "a vertex without weights");
    for (const cage::Influence& influence : character.weights.influences) {
        demand(influence.joint < character.skin.joints.size(), "a joint out of range");
    }
    for (const uint32_t joint : character.skin.joints) {
        demand(joint < character.skeleton.nodes.size(), "a joint without a node");
    }
    demand(!character.parts.empty(), "no part");
    for (const cage::PoseDriver& driver : character.drivers) {
        demand(cage::solveDriver(driver).ok(), "a driver without a solution");
        for (const uint32_t target : driver.targets) {
            demand(target < character.morphs.targets.size(), "a driver of no morph target");
        }
    }
}

} // namespace
} // namespace supple::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace supple;
    cage::GltfOptions options;
    const uint8_t choice = size > 0 ? data[size - 1] : 0;
    options.pairing = choice % 3 == 0   ? cage::Pairing::whereClean
                      : choice % 3 == 1 ? cage::Pairing::always
                                        : cage::Pairing::never;
    options.strict = choice / 3 % 4 == 0;
    options.normalCreases = static_cast<cage::NormalCreases>(choice / 12 % 3);
    options.sewParts = choice / 24 % 2 == 0;
    options.readFile = [&](const std::string& path) -> Result<std::vector<std::byte>> {
        fuzz::demand(!path.empty() && path.front() != '/' && ("/" + path + "/").find("/../") == std::string::npos,
                     "a path that leaves the folder");
        return std::vector<std::byte>(100);
    };
    const Result<cage::Character> character = cage::readGltf(fuzz::bytesOf(data, size), "fuzz.glb", "", options);
    if (character) {
        fuzz::checkCage(*character);
    } else {
        fuzz::demand(character.error().message.starts_with("fuzz.glb: "), "a refusal without the name");
    }
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateGltf, data, size, most, seed);
}
