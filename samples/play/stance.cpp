#include "stance.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace play {

namespace {

/// The places in the list of modifiers. LOWER comes before the feet; the head comes last, as the hips carry it.
enum : uint32_t { kLower, kPlantL, kPlantR, kLook, kModifiers };

constexpr Point kAnkles[] = {kFootL, kFootR};
constexpr Point kToes[] = {kToesL, kToesR};

constexpr float kBlendInSeconds = 0.3f;
constexpr float kFootingSeconds = 0.04f; ///< ground under a foot may rise at once: the foot does not
constexpr float kLookSeconds = 0.15f;
constexpr float kLookLimit = 0.6f; ///< radians, of head and neck each

/// The part of the way to a target that is gone in some time.
float eased(float seconds, float constant) {
    return 1.0f - std::exp(-seconds / constant);
}

Footing footingOf(const Hero& hero, uint32_t foot) {
    return footingUnder(glm::vec3(hero.jointTransform(kAnkles[foot])[3]),
                        glm::vec3(hero.jointTransform(kToes[foot])[3]));
}

} // namespace

void Stance::begin(const Hero& hero, glm::vec3 lookAt) {
    std::array<SuppleModifier, kModifiers> modifiers{};
    modifiers[kLower].kind = SUPPLE_MODIFIER_LOWER;
    modifiers[kLower].joint = hero.joint(kHips);
    for (uint32_t foot = 0; foot < 2; ++foot) {
        SuppleModifier& plant = modifiers[kPlantL + foot];
        plant.kind = SUPPLE_MODIFIER_PLANT;
        plant.flags = SUPPLE_MODIFIER_WORLD;
        plant.joint = hero.joint(kAnkles[foot]);
        footings_[foot] = footingOf(hero, foot);
    }
    SuppleModifier& look = modifiers[kLook];
    look.kind = SUPPLE_MODIFIER_AIM;
    look.flags = SUPPLE_MODIFIER_WORLD;
    look.joint = hero.joint(kHead);
    look.chainLength = 2; // the neck helps
    look.share = 0.4f;
    look.limit = kLookLimit;
    look.offset[1] = 0.14f; // the eyes
    look.offset[2] = 0.08f;
    hero.setModifiers(modifiers);
    lookAt_ = lookAt;
    weight_ = 0.0f;
    setTargets(hero);
}

void Stance::update(const Hero& hero, glm::vec3 lookAt, float seconds) {
    for (uint32_t foot = 0; foot < 2; ++foot) {
        const Footing under = footingOf(hero, foot);
        Footing& footing = footings_[foot];
        const float part = eased(seconds, kFootingSeconds);
        footing.point = {under.point.x, glm::mix(footing.point.y, under.point.y, part), under.point.z};
        footing.normal = glm::normalize(glm::mix(footing.normal, under.normal, part));
    }
    lookAt_ = glm::mix(lookAt_, lookAt, eased(seconds, kLookSeconds));
    weight_ = std::min(weight_ + seconds / kBlendInSeconds, 1.0f);
    setTargets(hero);
}

void Stance::setTargets(const Hero& hero) const {
    const float weight = weight_ * weight_ * (3.0f - 2.0f * weight_);
    hero.setTarget(kLower, weight, {});
    for (uint32_t foot = 0; foot < 2; ++foot)
        hero.setTarget(kPlantL + foot, weight, footings_[foot].point,
                       glm::quat(glm::vec3(0.0f, 1.0f, 0.0f), footings_[foot].normal));
    hero.setTarget(kLook, weight, lookAt_);
}

} // namespace play
