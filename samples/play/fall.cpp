#include "fall.h"

#include "ground.h"

#include <cmath>

namespace play {

namespace {

constexpr float kLeastSeconds = 1.2f, kMostSeconds = 2.6f;
/// From the hips to the feet of someone who sits up or kneels.
constexpr float kToFeet = 0.22f;

} // namespace

Fall::Fall(const Hero& hero, const BodyPose& before, float seconds, glm::vec3 push)
    : ragdoll_(hero.pose(), before, seconds, push) {
    std::array<SuppleModifier, kMoved> modifiers{};
    for (uint32_t i = 0; i < kMoved; ++i) { // parents come first: what hangs on a joint follows it
        modifiers[i].kind = SUPPLE_MODIFIER_HAND_OVER;
        modifiers[i].flags = SUPPLE_MODIFIER_WORLD;
        modifiers[i].joint = hero.joint(static_cast<Point>(i));
        modifiers[i].rotation[3] = 1.0f;
    }
    hero.setModifiers(modifiers);
    handOver(hero);
}

void Fall::update(const Hero& hero, float seconds) {
    ragdoll_.update(seconds);
    handOver(hero);
}

void Fall::handOver(const Hero& hero) const {
    // Places are points of the world, rotations are in model space.
    const glm::quat toModel = glm::conjugate(glm::normalize(glm::quat_cast(glm::mat3(hero.transform()))));
    for (uint32_t i = 0; i < kMoved; ++i) {
        const auto point = static_cast<Point>(i);
        hero.setTarget(i, 1.0f, ragdoll_.place(point), toModel * ragdoll_.rotation(point));
    }
}

bool Fall::isOver() const {
    return ragdoll_.age() > kMostSeconds || (ragdoll_.age() > kLeastSeconds && ragdoll_.lies());
}

Standing Fall::standing() const {
    // Who lies on the back rises towards the feet, who lies on the belly towards the head.
    const glm::vec2 spine = placeOf(ragdoll_.spine());
    const glm::vec2 ahead = glm::normalize(isOnBack() ? -spine : spine);
    return {placeOf(ragdoll_.place(kHips)) + kToFeet * ahead, std::atan2(ahead.x, ahead.y)};
}

} // namespace play
