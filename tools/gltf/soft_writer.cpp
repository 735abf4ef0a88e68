#include "tools/gltf/soft_writer.h"

#include "tools/gltf/soft_numbers.h"

#include <algorithm>
#include <utility>

namespace supple::cage::gltf {
namespace {

constexpr const char* kSprings = "VRMC_springBone";
constexpr const char* kMoreColliders = "VRMC_springBone_extended_collider";

json vectorOf(const glm::vec3& v) {
    return json::array({v.x, v.y, v.z});
}

bool isExtended(const SpringCollider& collider) {
    return collider.inside || collider.shape == ColliderShape::plane;
}

json shapeOf(const SpringCollider& collider) {
    if (collider.shape == ColliderShape::plane) {
        return {{"plane", {{"offset", vectorOf(collider.offset)}, {"normal", vectorOf(collider.tail)}}}};
    }
    const bool capsule = collider.shape == ColliderShape::capsule;
    json shape = {{"offset", vectorOf(collider.offset)}, {"radius", collider.radius}};
    if (capsule) {
        shape["tail"] = vectorOf(collider.tail);
    }
    if (collider.inside) {
        shape["inside"] = true;
    }
    return {{capsule ? "capsule" : "sphere", std::move(shape)}};
}

json writeCollider(const SpringCollider& collider) {
    json written = {{"node", collider.node}};
    if (isExtended(collider)) {
        // Who does not know the extension has a sphere that nothing meets.
        written["shape"] = {{"sphere", {{"offset", json::array({0, -10000, 0})}, {"radius", 0}}}};
        written["extensions"][kMoreColliders] = {{"specVersion", "1.0"}, {"shape", shapeOf(collider)}};
    } else {
        written["shape"] = shapeOf(collider);
    }
    return written;
}

} // namespace

std::string jiggleAttribute(size_t jiggle) {
    return "_SUPPLE_JIGGLE_" + std::to_string(jiggle);
}

std::string clothAttribute(size_t cloth) {
    return "_SUPPLE_CLOTH_" + std::to_string(cloth);
}

json writeJiggles(std::span<const Jiggle> jiggles) {
    json list = json::array();
    for (size_t j = 0; j < jiggles.size(); ++j) {
        json jiggle = softNumbers(jiggles[j]);
        jiggle["weights"] = jiggleAttribute(j);
        list.push_back(std::move(jiggle));
    }
    return list;
}

json writeCloths(std::span<const Cloth> cloths) {
    json list = json::array();
    for (size_t c = 0; c < cloths.size(); ++c) {
        json cloth = softNumbers(cloths[c]);
        cloth["weights"] = clothAttribute(c);
        cloth["colliders"] = cloths[c].colliders;
        list.push_back(std::move(cloth));
    }
    return list;
}

void writeColliders(const Character& character, json& root) {
    const auto names = [](const Cloth& cloth) { return !cloth.colliders.empty(); };
    if (std::none_of(character.cloths.begin(), character.cloths.end(), names)) {
        return;
    }
    const std::vector<SpringCollider>& all = character.springBones.colliders;
    json list = json::array();
    for (const SpringCollider& collider : all) {
        list.push_back(writeCollider(collider));
    }
    root["extensions"][kSprings] = {{"specVersion", "1.0"}, {"colliders", std::move(list)}};
    root["extensionsUsed"].push_back(kSprings);
    if (std::any_of(all.begin(), all.end(), isExtended)) {
        root["extensionsUsed"].push_back(kMoreColliders);
    }
}

} // namespace supple::cage::gltf
