#include "tests/support/rigged_tube.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace supple::test {

namespace {

constexpr float kLength = 8.0f;

} // namespace

float Noise::operator()() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return static_cast<float>(state_ >> 8) / 8388608.0f - 1.0f;
}

cage::Character riggedTube(const TubeOptions& options) {
    cage::Character character;
    character.name = "tube";
    cage::Cage& cage = character.cage;
    const float spacing = kLength / static_cast<float>(options.joints);
    character.weights.starts = {0};
    for (uint32_t i = 0; i <= options.segments; ++i) {
        const float x = kLength * static_cast<float>(i) / static_cast<float>(options.segments);
        for (uint32_t k = 0; k < options.sides; ++k) {
            const float angle = 6.2831853f * static_cast<float>(k) / static_cast<float>(options.sides);
            cage.sourceVertices.push_back(cage.vertexCount());
            cage.positions.push_back(options.origin + glm::vec3(x, std::cos(angle), std::sin(angle)));
            // Joint j owns the tube round its place; half a spacing on, it has passed half to the next one.
            const float along = x / spacing;
            const auto joint = std::min(static_cast<uint32_t>(along), options.joints - 1);
            const float next = joint + 1 < options.joints
                                   ? std::clamp(2.0f * (along - static_cast<float>(joint)) - 0.5f, 0.0f, 1.0f)
                                   : 0.0f;
            if (next < 1.0f) {
                character.weights.influences.push_back({joint, 1.0f - next});
            }
            if (next > 0.0f) {
                character.weights.influences.push_back({joint + 1, next});
            }
            character.weights.starts.push_back(static_cast<uint32_t>(character.weights.influences.size()));
        }
    }
    cage.faceStarts = {0};
    for (uint32_t i = 0; i < options.segments; ++i) {
        for (uint32_t k = 0; k < options.sides; ++k) {
            const uint32_t a = i * options.sides + k, b = i * options.sides + (k + 1) % options.sides;
            for (const uint32_t v : {a, b, b + options.sides, a + options.sides}) {
                cage.faceVertices.push_back(v);
            }
            cage.faceStarts.push_back(static_cast<uint32_t>(cage.faceVertices.size()));
        }
    }

    character.skeleton.nodes.resize(1);
    character.skeleton.nodes[0].name = "rig";
    character.skeleton.parentsFirst = {0};
    for (uint32_t j = 0; j < options.joints; ++j) {
        cage::Node node;
        node.name = "joint " + std::to_string(j);
        node.parent = j;
        node.translation = j == 0 ? options.origin : glm::vec3(spacing, 0.0f, 0.0f);
        character.skeleton.nodes.push_back(node);
        character.skeleton.parentsFirst.push_back(j + 1);
        character.skin.joints.push_back(j + 1);
        character.skin.inverseBinds.push_back(
            glm::translate(glm::mat4(1.0f), -options.origin - glm::vec3(spacing * static_cast<float>(j), 0.0f, 0.0f)));
    }

    Noise noise(7);
    for (uint32_t t = 0; t < options.morphTargets; ++t) {
        cage::MorphTarget target;
        target.name = "target " + std::to_string(t);
        for (uint32_t v = 0; v < cage.vertexCount() && t % 3 != 2; ++v) {
            if (t % 3 == 0 || noise() > 0.8f) {
                target.vertices.push_back(v);
                target.deltas.push_back(0.2f * noise.vector());
            }
        }
        character.morphs.targets.push_back(target);
        character.morphs.weights.push_back(0.0f);
    }
    character.parts[0].targetCount = options.morphTargets;
    return character;
}

cage::Channel channel(uint32_t node, cage::ChannelPath path, std::vector<float> times, std::vector<float> values,
                      cage::Interpolation interpolation) {
    return {node, path, interpolation, std::move(times), std::move(values)};
}

cage::Clip clipOf(std::vector<cage::Channel> channels) {
    cage::Clip clip;
    for (const cage::Channel& own : channels) {
        clip.duration = std::max(clip.duration, static_cast<double>(own.times.back()));
    }
    clip.channels = std::move(channels);
    return clip;
}

} // namespace supple::test
