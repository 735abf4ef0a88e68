#include "rise.h"

#include "ground.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace play {

namespace {

// There is no clip for getting up. The end of the jump, where she lands and straightens, will do.
constexpr const char* kClip = "jump";
constexpr double kCrouch = 1.17; ///< seconds of the clip
constexpr float kSpeed = 0.3f;
constexpr double kTransition = 1.1;
constexpr double kSeconds = 1.0; ///< after which she stands

/// Who lies on the back sits up, knees before the body; who lies on the belly draws the knees under it.
constexpr Bend kSitUp[] = {{kSpine, 0.65f},  {kChest, 0.5f}, {kThighL, -1.35f},
                           {kThighR, -1.1f}, {kShinL, 1.7f}, {kShinR, 1.35f}};
constexpr Bend kKneel[] = {{kThighL, -1.35f}, {kThighR, -1.1f}, {kShinL, 1.7f}, {kShinR, 1.35f}};

} // namespace

Rise::Rise(const Hero& hero, bool isOnBack)
    : bends_(isOnBack ? std::span<const Bend>(kSitUp) : std::span<const Bend>(kKneel)), start_(hero.time()) {
    // Arms may have to turn by half a turn: the quintic keeps to one way round.
    hero.play(kClip, {.offset = kCrouch,
                      .speed = kSpeed,
                      .loops = false,
                      .transition = kTransition,
                      .kind = SUPPLE_TRANSITION_QUINTIC,
                      .fromModified = true});
    std::vector<SuppleModifier> modifiers(bends_.size());
    for (size_t i = 0; i < bends_.size(); ++i) {
        modifiers[i].kind = SUPPLE_MODIFIER_ADD;
        modifiers[i].joint = hero.joint(bends_[i].point);
        modifiers[i].rotation[3] = 1.0f;
    }
    hero.setModifiers(modifiers);
}

void Rise::update(const Hero& hero) {
    const double part = std::clamp((hero.time() - start_) / kSeconds, 0.0, 1.0);
    const auto swing = static_cast<float>(std::sin(glm::pi<double>() * part));
    for (uint32_t i = 0; i < bends_.size(); ++i)
        hero.setTarget(i, swing * swing, {}, glm::angleAxis(bends_[i].angle, glm::vec3(1.0f, 0.0f, 0.0f)));
}

bool Rise::isOver(const Hero& hero) const {
    return hero.time() - start_ > kSeconds;
}

float Rise::toGround(const Hero& hero) {
    const BodyPoints points = pointsOf(hero.pose());
    float deepest = std::numeric_limits<float>::lowest();
    for (uint32_t i = 0; i < kPoints; ++i)
        deepest = std::max(deepest, heightAt(placeOf(points[i])) + kBody[i].radius - points[i].y);
    return deepest;
}

} // namespace play
