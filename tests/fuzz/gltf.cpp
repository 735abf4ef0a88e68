// Any glTF or GLB: read, or refused with a message.
#include "cage/gltf/reader.h"
#include "cage/limits.h"
#include "cage/repair.h"
#include "cage/solved_driver.h"
#include "cage/topology.h"
#include "skinning/cloth_table.h"
#include "skinning/cloth_twin.h"
#include "skinning/jiggle_table.h"
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

void checkPainted(const cage::Character& character, const std::vector<cage::PaintedWeight>& weights, size_t kinds) {
    demand(weights.size() == (kinds > 0 ? character.cage.vertexCount() : 0), "weights that nobody painted");
    for (const cage::PaintedWeight& weight : weights) {
        demand(weight.index == cage::kNone || (weight.index < kinds && weight.weight > 0.0f && weight.weight <= 1.0f),
               "a painted weight out of range");
    }
}

/// What is soft has tables, or too much of something; cloths come to rest in numbers.
void checkSoft(const cage::Character& character) {
    checkPainted(character, character.weights.jiggles, character.jiggles.size());
    checkPainted(character, character.weights.cloths, character.cloths.size());
    for (const cage::Cloth& cloth : character.cloths) {
        for (const uint32_t collider : cloth.colliders) {
            demand(collider < character.springBones.colliders.size(), "a cloth without its collider");
        }
    }
    (void)skinning::buildJiggleTable(character);
    const Result<skinning::ClothTable> table = skinning::buildClothTable(character);
    if (!table || table->clothCount == 0) {
        return;
    }
    skinning::ClothTwin twin(*table);
    std::vector<glm::vec4> state(table->stateElements, glm::vec4(0.0f)), goals;
    for (const glm::vec3& position : character.cage.positions) {
        goals.emplace_back(position, 1.0f);
    }
    for (uint32_t cloth = 0; cloth < table->clothCount; ++cloth) {
        skinning::ClothTwin::Step now;
        now.settles = true;
        for (int step = 0; step < 3; ++step, now.settles = false) {
            now.wind.x = 10.0f * static_cast<float>(step);
            twin.step(cloth, goals, {}, now, state);
        }
        for (uint32_t i = 0; i < twin.vertexCount(cloth); ++i) {
            const glm::vec3 place = twin.place(cloth, i, state);
            demand(std::isfinite(place.x + place.y + place.z), "a cloth that leaves all numbers");
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
        fuzz::checkSoft(*character);
    } else {
        fuzz::demand(character.error().message.starts_with("fuzz.glb: "), "a refusal without the name");
    }
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateGltf, data, size, most, seed);
}
