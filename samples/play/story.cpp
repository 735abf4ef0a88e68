#include "story.h"

namespace play {

namespace {

constexpr double kSetsOff = 0.25, kIsHit = 5.25, kGoesOn = 7.75;
constexpr glm::vec2 kUp{1.75f, -0.1f}, kOn{0.6f, 1.5f};

struct Glance {
    double from;
    glm::vec3 at;
};
constexpr Glance kGlances[] = {{0.0, {3.5f, 1.1f, 0.3f}},   {3.5, {2.6f, 2.6f, 2.5f}}, {4.0, {0.9f, 1.1f, 3.0f}},
                               {4.75, {3.4f, 1.4f, -0.6f}}, {7.0, {1.0f, 1.4f, 4.0f}}, {7.75, {0.6f, 0.6f, 2.5f}}};

} // namespace

Input storyInput(double time, double seconds) {
    const auto comes = [&](double moment) { return time >= moment && time - seconds < moment; };
    Input input;
    if (comes(kSetsOff))
        input.goal = kUp;
    if (comes(kGoesOn))
        input.goal = kOn;
    if (comes(kIsHit))
        input.push = glm::vec3(-2.4f, 0.5f, 1.2f);
    for (const Glance& glance : kGlances) {
        if (time >= glance.from)
            input.lookAt = glance.at;
    }
    return input;
}

} // namespace play
