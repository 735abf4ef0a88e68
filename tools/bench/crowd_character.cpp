#include "tools/bench/crowd_character.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace supple::bench {

namespace {

constexpr float kJointRadius = 0.6f;    ///< of the sphere of joints, inside that of vertices
constexpr float kSwing = 0.06f;         ///< radians
constexpr float kDistanceFloor = 0.05f; ///< no joint takes all of a vertex

/// Evenly over a sphere, along a spiral from pole to pole.
glm::vec3 jointPlace(uint32_t joint) {
    constexpr float kGoldenAngle = 2.3999632f;
    const float y = 1.0f - 2.0f * (static_cast<float>(joint) + 0.5f) / static_cast<float>(kCrowdJoints);
    const float angle = kGoldenAngle * static_cast<float>(joint), ring = std::sqrt(1.0f - y * y);
    return kJointRadius * glm::vec3(ring * std::cos(angle), y, ring * std::sin(angle));
}

void addSkeleton(cage::Character& character) {
    character.skeleton = {};
    character.skin = {};
    for (uint32_t j = 0; j < kCrowdJoints; ++j) {
        cage::Node node;
        node.name = "joint " + std::to_string(j);
        node.parent = j == 0 ? cage::kNone : (j - 1) / 2;
        node.translation = jointPlace(j) - (j == 0 ? glm::vec3(0.0f) : jointPlace(node.parent));
        character.skeleton.nodes.push_back(node);
        character.skeleton.parentsFirst.push_back(j);
        character.skin.joints.push_back(j);
        character.skin.inverseBinds.push_back(glm::translate(glm::mat4(1.0f), -jointPlace(j)));
    }
    character.parts.assign(1, {});
    character.parts[0].node = kCrowdJoints;
    character.parts[0].name = "mesh";
    character.skeleton.nodes.push_back({"mesh"});
    character.skeleton.parentsFirst.push_back(kCrowdJoints);
}

void addWeights(cage::Character& character) {
    character.weights = {};
    character.weights.starts.push_back(0);
    for (const glm::vec3& vertex : character.cage.positions) {
        std::array<std::pair<float, uint32_t>, kCrowdJoints> joints;
        for (uint32_t j = 0; j < kCrowdJoints; ++j) {
            joints[j] = {glm::distance(vertex, jointPlace(j)), j};
        }
        std::partial_sort(joints.begin(), joints.begin() + kCrowdInfluences, joints.end());
        float sum = 0.0f;
        for (uint32_t i = 0; i < kCrowdInfluences; ++i) {
            sum += 1.0f / (joints[i].first + kDistanceFloor);
        }
        for (uint32_t i = 0; i < kCrowdInfluences; ++i) {
            character.weights.influences.push_back({joints[i].second, 1.0f / (joints[i].first + kDistanceFloor) / sum});
        }
        character.weights.starts.push_back(static_cast<uint32_t>(character.weights.influences.size()));
    }
}

void addClip(cage::Character& character) {
    cage::Clip clip;
    clip.name = "sway";
    clip.duration = 1.0;
    for (uint32_t j = 0; j < kCrowdJoints; ++j) {
        cage::Channel channel;
        channel.node = j;
        channel.path = cage::ChannelPath::rotation;
        const glm::vec3 axis = glm::normalize(jointPlace(j));
        for (uint32_t k = 0; k < kCrowdKeys; ++k) {
            const float time = static_cast<float>(k) / static_cast<float>(kCrowdKeys - 1);
            const float half = 0.5f * kSwing *
                               std::sin(glm::two_pi<float>() * static_cast<float>(k % (kCrowdKeys - 1)) /
                                            static_cast<float>(kCrowdKeys - 1) +
                                        static_cast<float>(j));
            channel.times.push_back(time);
            const glm::vec3 imaginary = std::sin(half) * axis;
            channel.values.insert(channel.values.end(), {imaginary.x, imaginary.y, imaginary.z, std::cos(half)});
        }
        clip.channels.push_back(std::move(channel));
    }
    character.clips = {std::move(clip)};
}

} // namespace

Result<BenchCage> makeCrowdCharacter() {
    Result<BenchCage> cage = makeCage("sphere");
    if (cage) {
        addSkeleton(cage->character);
        addWeights(cage->character);
        addClip(cage->character);
    }
    return cage;
}

} // namespace supple::bench
