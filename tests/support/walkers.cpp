#include "tests/support/walkers.h"

#include "skinning/contacts.h"
#include "tests/support/rigged_tube.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

/// The topmost node above the joints.
uint32_t carrierOf(const cage::Character& character) {
    uint32_t node = character.skin.joints.front();
    while (character.skeleton.nodes[node].parent != cage::kNone) {
        node = character.skeleton.nodes[node].parent;
    }
    return node;
}

} // namespace

size_t clipNumber(const cage::Character& character, const std::string& name) {
    const auto found = std::find_if(character.clips.begin(), character.clips.end(),
                                    [&](const cage::Clip& clip) { return clip.name == name; });
    EXPECT_NE(found, character.clips.end()) << name;
    return static_cast<size_t>(found - character.clips.begin());
}

cage::Character walking(cage::Character character, double yaw) {
    const skinning::Contacts contacts = skinning::findContacts(character);
    const size_t number = clipNumber(character, "walk");
    cage::Clip& walk = character.clips[number];
    const glm::dvec2 ground = contacts.of(number, 0).front().drift;
    const uint32_t carrier = carrierOf(character);
    constexpr int kKeys = 33;
    std::vector<float> times, places, turns;
    glm::dvec2 place(0.0);
    for (int k = 0; k < kKeys; ++k) {
        const double part = static_cast<double>(k) / (kKeys - 1), angle = yaw * part;
        if (k > 0) {
            const double step = walk.duration / (kKeys - 1), middle = angle - 0.5 * yaw / (kKeys - 1);
            const double c = std::cos(middle), s = std::sin(middle);
            place -= step * glm::dvec2(c * ground.x + s * ground.y, c * ground.y - s * ground.x);
        }
        times.push_back(static_cast<float>(walk.duration * part));
        places.insert(places.end(), {static_cast<float>(place.x), 0.0f, static_cast<float>(place.y)});
        turns.insert(turns.end(), {0.0f, static_cast<float>(std::sin(0.5 * angle)), 0.0f,
                                   static_cast<float>(std::cos(0.5 * angle))});
    }
    walk.channels.push_back(channel(carrier, cage::ChannelPath::translation, times, places));
    walk.channels.push_back(channel(carrier, cage::ChannelPath::rotation, times, turns));
    return character;
}

void raise(const cage::Character& character, cage::Clip& clip, float height) {
    clip.channels.push_back(
        channel(carrierOf(character), cage::ChannelPath::translation, {0.0f}, {0.0f, height, 0.0f}));
}

} // namespace supple::test
