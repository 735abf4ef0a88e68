#include "tests/support/cape.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace supple::test {
namespace {

/// Fills in a skeleton of one joint, which moves all vertices; those that do not hang are a cloth.
cage::Character onAJoint(cage::Cage cage, uint32_t hanging) {
    cage::Character made;
    made.name = "cloth";
    made.cage = std::move(cage);
    made.skeleton.nodes.resize(1);
    made.skeleton.nodes[0].name = "chest";
    made.skeleton.parentsFirst = {0};
    made.skin.joints = {0};
    made.skin.inverseBinds = {glm::mat4(1.0f)};
    made.parts[0].joints = {0};
    made.parts[0].rigid = true;
    made.weights.starts = {0};
    made.cloths.resize(1);
    made.cloths[0].tether = 1.02f;
    for (uint32_t v = 0; v < made.cage.vertexCount(); ++v) {
        made.cage.sourceVertices.push_back(v);
        made.weights.influences.push_back({0, 1.0f});
        made.weights.starts.push_back(v + 1);
        made.weights.cloths.push_back(v < hanging ? cage::PaintedWeight{} : cage::PaintedWeight{0, 1.0f});
    }
    return made;
}

void addFace(cage::Cage& cage, std::initializer_list<uint32_t> vertices) {
    cage.faceVertices.insert(cage.faceVertices.end(), vertices);
    cage.faceStarts.push_back(cage.cornerCount());
}

} // namespace

cage::Character cape(float last) {
    cage::Cage cage;
    cage.faceStarts = {0};
    for (uint32_t j = 0; j < 16; ++j) {
        for (uint32_t i = 0; i < 12; ++i) {
            const auto x = static_cast<float>(i) / 11.0f, y = static_cast<float>(j) / 15.0f;
            cage.positions.emplace_back(0.6f * (x - 0.5f), 1.5f - 0.9f * y, -0.13f + last * y);
        }
    }
    for (uint32_t j = 0; j + 1 < 16; ++j) {
        for (uint32_t i = 0; i + 1 < 12; ++i) {
            addFace(cage, {capeVertex(i, j), capeVertex(i + 1, j), capeVertex(i + 1, j + 1), capeVertex(i, j + 1)});
        }
    }
    cage::Character made = onAJoint(std::move(cage), 12);
    cage::SpringCollider body;
    body.shape = cage::ColliderShape::capsule;
    body.offset = {0.0f, 1.4f, 0.0f};
    body.tail = {0.0f, 0.6f, 0.0f};
    body.radius = 0.11f;
    made.springBones.colliders = {body};
    made.cloths[0].colliders = {0};
    return made;
}

cage::Character ball() {
    constexpr uint32_t kRings = 9, kAround = 14;
    constexpr float kRadius = 0.12f;
    cage::Cage cage;
    cage.faceStarts = {0};
    cage.positions.emplace_back(0.0f, kRadius, 0.0f);
    for (uint32_t i = 1; i < kRings; ++i) {
        for (uint32_t j = 0; j < kAround; ++j) {
            const float a = glm::pi<float>() * static_cast<float>(i) / kRings;
            const float b = 2.0f * glm::pi<float>() * static_cast<float>(j) / kAround;
            cage.positions.emplace_back(kRadius * std::sin(a) * std::cos(b), kRadius * std::cos(a),
                                        kRadius * std::sin(a) * std::sin(b));
        }
    }
    cage.positions.emplace_back(0.0f, -kRadius, 0.0f);
    const uint32_t bottom = cage.vertexCount() - 1;
    const auto at = [](uint32_t i, uint32_t j) { return 1 + (i - 1) * kAround + j % kAround; };
    for (uint32_t j = 0; j < kAround; ++j) {
        addFace(cage, {0, at(1, j + 1), at(1, j)});
        addFace(cage, {at(kRings - 1, j), at(kRings - 1, j + 1), bottom});
        for (uint32_t i = 1; i + 1 < kRings; ++i) {
            addFace(cage, {at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            addFace(cage, {at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    }
    cage::Character made = onAJoint(std::move(cage), 1 + kAround);
    made.cloths[0].stretch = made.cloths[0].shear = 1e-4f;
    made.cloths[0].bend = 1e3f;
    made.cloths[0].volume = true;
    made.cloths[0].tether = 0.0f;
    return made;
}

} // namespace supple::test
