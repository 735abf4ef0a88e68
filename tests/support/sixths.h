// Frames that come to every sixth of a second, and what a host does there. What is shown at the sixths must not depend
// on the frames between them.
#pragma once

#include "tests/support/played_group.h"
#include "tests/support/rigged_tube.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <span>
#include <vector>

namespace supple::test {

/// Frames of a rate that come to every sixth of a second.
inline std::vector<double> framesOf(uint32_t rate, uint32_t sixths) {
    std::vector<double> times;
    for (uint32_t k = 0; k <= rate * sixths / 6; ++k) {
        times.push_back(k * 6 % rate == 0 ? static_cast<double>(k * 6 / rate) / 6.0 : static_cast<double>(k) / rate);
    }
    return times;
}

/// `count` irregular frames among those that come to every sixth of a second; never more than 8 steps apart.
inline std::vector<double> irregularFrames(uint32_t count, uint32_t sixths) {
    std::vector<double> times;
    Noise noise(11);
    for (uint32_t k = 0; k < count; ++k) {
        times.push_back((0.5 + 0.5 * static_cast<double>(noise())) * sixths / 6.0);
    }
    for (uint32_t k = 0; k <= 2 * sixths; ++k) {
        times.push_back(k % 2 == 0 ? static_cast<double>(k / 2) / 6.0 : k / 12.0);
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

/// Four instances play: two a clip, one travels, and one has two clips, one of them through a mask.
inline void playFour(const PlayedGroup& stage) {
    const auto clips = static_cast<uint32_t>(stage.character().clips.size());
    for (uint32_t i = 0; i < 4; ++i) {
        stage.play(i, (1 + i % 2) % clips, 0.1 * i, i == 3 ? SUPPLE_ROOT_MOTION_GROUND : 0,
                   i == 3 ? SUPPLE_PLAYBACK_TRAVEL : 0);
    }
    SupplePlaybackLayer layers[] = {PlayedGroup::loops(1, 0.2), PlayedGroup::loops(4 % clips, 0.2)};
    stage.setMask(1, 1.0f);
    layers[1].mask = 1;
    stage.play(2, layers);
}

/// What a host does with them in the sixths from `first` on, whatever the frame rate.
inline void callAt(const PlayedGroup& stage, uint32_t first, uint32_t sixth, double time) {
    if (sixth == first) { // one goes over to another clip
        SupplePlaybackLayer layer = PlayedGroup::loops(2 % static_cast<uint32_t>(stage.character().clips.size()), 0.1);
        layer.startTime = time;
        SupplePlaybackDesc desc{};
        desc.transition = 0.3;
        stage.play(0, {&layer, 1}, desc);
    }
    if (sixth == first + 1) {
        SuppleModifier turn{};
        turn.kind = SUPPLE_MODIFIER_ADD;
        turn.joint = stage.joint("head");
        turn.weight = 1.0f;
        turn.rotation[1] = 0.5f;
        turn.rotation[3] = 0.8660254f;
        stage.modify(1, turn);
    }
    if (sixth == first + 2) {
        stage.place(2, glm::rotate(glm::mat4(1.0f), 2.0f, glm::vec3(0.0f, 0.0f, 1.0f)));
        EXPECT_EQ(suppleTeleport(stage.handle(), stage.instances[2]), SUPPLE_OK);
    }
    if (sixth == first + 3) {
        stage.setMask(1, 0.25f);
    }
    if (sixth == first || sixth == first + 2) {
        stage.setWind({sixth == first ? 6.0f : -2.0f, 0.0f, 3.0f});
    }
}

/// What instances showed, by sixths and instances.
using ShownAtSixths = std::vector<std::vector<std::vector<float>>>;

/// Runs frames at these times: `frame(time)`. Those at a sixth come behind `call(sixth, time)`.
template <class Stage, class Call, class Frame>
ShownAtSixths shownAtSixths(const Stage& stage, std::span<const double> times, const Call& call, const Frame& frame) {
    ShownAtSixths shown;
    for (const double time : times) {
        const auto sixth = static_cast<uint32_t>(std::lround(time * 6.0));
        const bool meets = time == sixth / 6.0;
        if (meets) {
            EXPECT_EQ(suppleSetTime(stage.handle(), stage.crowd.group(), time), SUPPLE_OK);
            call(sixth, time);
        }
        frame(time);
        for (uint32_t i = 0; meets && i < stage.instances.size(); ++i) {
            shown.resize(sixth + 1);
            shown[sixth].push_back(stage.shown(i));
        }
    }
    return shown;
}

} // namespace supple::test
