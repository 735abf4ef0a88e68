// A tube of quads along +x with a chain of joints in it: a character made by hand, for tests of posing and deformation.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <vector>

namespace supple::test {

struct TubeOptions {
    uint32_t segments = 16; ///< quads along the tube
    uint32_t sides = 12;
    uint32_t joints = 3;       ///< at equal distances from the tube's beginning
    glm::vec3 origin{0.0f};    ///< where the tube begins, in the rest pose
    uint32_t morphTargets = 0; ///< every third moves all vertices, every third a few, every third none
};

/// Length 8, radius 1. Node 0 is no joint; node 1 + j carries joint j and is the child of the one before. Between two
/// joints weights pass linearly from one to the other over the middle half; the last joint's end is its alone. Rest and
/// bind pose agree; morph weights are 0 at rest; no clips.
[[nodiscard]] cage::Character riggedTube(const TubeOptions& options = {});

/// Numbers in [-1, 1), the same for the same seed everywhere.
class Noise {
public:
    explicit Noise(uint32_t seed) : state_(seed * 2654435761u + 1u) {}
    float operator()();
    glm::vec3 vector() {
        const float x = (*this)(), y = (*this)(), z = (*this)();
        return {x, y, z};
    }

private:
    uint32_t state_;
};

/// A channel of one node with the keys given.
[[nodiscard]] cage::Channel channel(uint32_t node, cage::ChannelPath path, std::vector<float> times,
                                    std::vector<float> values,
                                    cage::Interpolation interpolation = cage::Interpolation::linear);
/// A clip of these channels; its duration is their last key's time.
[[nodiscard]] cage::Clip clipOf(std::vector<cage::Channel> channels);

} // namespace supple::test
