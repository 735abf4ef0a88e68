#include "runtime/modifiers_desc.h"

#include "runtime/playback_desc.h"
#include "runtime/sized.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <string>

namespace supple::runtime {

namespace {

using namespace shared;

static_assert(SUPPLE_MAX_MODIFIERS == kMaxModifiers && SUPPLE_MAX_AIM_JOINTS == kMaxChain);
static_assert(uint32_t{SUPPLE_MODIFIER_SET} == kModifierSet && uint32_t{SUPPLE_MODIFIER_ADD} == kModifierAdd &&
              uint32_t{SUPPLE_MODIFIER_AIM} == kModifierAim && uint32_t{SUPPLE_MODIFIER_TWO_BONE} == kModifierTwoBone &&
              uint32_t{SUPPLE_MODIFIER_HAND_OVER} == kModifierHandOver &&
              uint32_t{SUPPLE_MODIFIER_PLANT} == kModifierPlant && uint32_t{SUPPLE_MODIFIER_LOWER} == kModifierLower);
static_assert(uint32_t{SUPPLE_MODIFIER_WORLD} == kModifierWorld && uint32_t{SUPPLE_MODIFIER_POLE} == kModifierPole &&
              uint32_t{SUPPLE_MODIFIER_END_ROTATION} == kModifierEndRotation &&
              uint32_t{SUPPLE_MODIFIER_MODEL} == kModifierModel);

constexpr uint32_t kKinds = kModifierLower + 1;
/// By kind: the flags that it takes.
constexpr uint32_t kModifierFlags[kKinds] = {kModifierModel,
                                             kModifierModel,
                                             kModifierWorld,
                                             kModifierWorld | kModifierPole | kModifierEndRotation,
                                             kModifierWorld,
                                             kModifierWorld | kModifierPole,
                                             0};
/// Places of nodes are kept in 16 bits.
constexpr size_t kMostNodes = 0xFFFF;
constexpr float kDefaultSoft = 0.97f;
constexpr float kDefaultTilt = 0.5236f;  ///< radians: of a foot
constexpr double kDefaultLowering = 0.3; ///< of the longest leg

Error beyond(const char* reason) {
    return {ErrorCode::range, reason};
}

bool needsRotation(uint32_t kind, uint32_t flags) {
    return kind == kModifierSet || kind == kModifierAdd || kind == kModifierHandOver || kind == kModifierPlant ||
           (flags & kModifierEndRotation) != 0;
}

bool allFinite(const double* values, size_t count) {
    return std::all_of(values, values + count, [](double x) { return std::isfinite(x); });
}
bool allFinite(const float* values, size_t count) {
    return std::all_of(values, values + count, [](float x) { return std::isfinite(x); });
}
bool isPart(float x) {
    return x >= 0.0f && x <= 1.0f;
}

/// `kind`: of the modifier. The ground is level if nobody says.
Result<glm::vec4> unitRotation(uint32_t kind, const float* rotation) {
    const glm::dvec4 q(glm::make_vec4(rotation));
    if (kind == kModifierPlant && q == glm::dvec4(0.0)) {
        return glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    }
    const double length = glm::length(q);
    if (!(length > 1e-30)) {
        return beyond("rotation has length 0");
    }
    return glm::vec4(q / length);
}

std::array<glm::dvec3, 2> pointsOf(const double* target, const double* pole) {
    return {glm::make_vec3(target), glm::make_vec3(pole)};
}

Status checkNumbers(const SuppleModifier& from) {
    if (!allFinite(from.target, 3) || !allFinite(from.pole, 3) || !allFinite(from.rotation, 4) ||
        !allFinite(from.axis, 3) || !allFinite(from.offset, 3)) {
        return Error{ErrorCode::notFinite, "a point, rotation or axis is not finite"};
    }
    const float numbers[] = {from.weight, from.fadeWeight, from.fadeDuration, from.share,
                             from.limit,  from.soft,       from.poleWeight};
    if (!allFinite(numbers, std::size(numbers))) {
        return Error{ErrorCode::notFinite, "a number is not finite"};
    }
    if (!isPart(from.weight) || !isPart(from.fadeWeight) || !isPart(from.share) || !isPart(from.poleWeight)) {
        return beyond("a weight or share leaves 0..1");
    }
    if (from.fadeDuration < 0.0f || from.limit < 0.0f) {
        return beyond("fadeDuration or limit is negative");
    }
    if (from.soft != 0.0f && !(from.soft >= 0.5f && from.soft <= 0.999f)) {
        return beyond("soft leaves 0.5..0.999");
    }
    return checkTime(from.fadeStart);
}

/// Whose joints it moves; the axis follows from the rest pose if nobody says.
Result<skinning::Modifier> chained(const Asset& asset, const SuppleModifier& from) {
    const cage::Character& character = asset.character;
    const std::vector<uint32_t>& parents = asset.rig.jointParents;
    if (from.joint >= character.skin.joints.size()) {
        return beyond("no such joint");
    }
    const bool aims = from.kind == SUPPLE_MODIFIER_AIM, plants = from.kind == SUPPLE_MODIFIER_PLANT;
    const bool limb = plants || from.kind == SUPPLE_MODIFIER_TWO_BONE;
    const uint32_t length = aims ? std::max(from.chainLength, 1u) : 1u;
    if (length > SUPPLE_MAX_AIM_JOINTS) {
        return beyond("chainLength is beyond SUPPLE_MAX_AIM_JOINTS");
    }
    const std::optional<skinning::Modifier> found = limb ? skinning::limbOf(character, asset.rig, from.joint)
                                                         : skinning::chainOf(character, parents, from.joint, length);
    if (!found) {
        return beyond("the chain has fewer joints, or one with a fixed matrix");
    }
    skinning::Modifier modifier = *found;
    if (plants && !asset.clipTable->isFoot(character.skin.joints[from.joint])) {
        return beyond("the joint is no foot: none that hangs below two others, near the ground in the rest pose");
    }
    const glm::vec3 axis = glm::make_vec3(from.axis);
    if (glm::length(axis) > 0.0f) {
        modifier.axis = glm::vec3(glm::normalize(glm::dvec3(axis)));
    } else if (limb) {
        modifier.axis = skinning::restHinge(character, modifier);
    } else if (aims) {
        modifier.axis = skinning::restForward(character, modifier.chain[modifier.chainLength - 1]);
    }
    return modifier;
}

float defaultLimit(const Asset& asset, uint32_t kind) {
    switch (kind) {
    case kModifierPlant:
        return kDefaultTilt;
    case kModifierLower:
        return static_cast<float>(kDefaultLowering * asset.clipTable->longestLeg);
    default:
        return 0.0f;
    }
}

Result<PlacedModifier> readModifier(const Asset& asset, const SuppleModifier& from) {
    const uint32_t kind = rawValue(from.kind);
    if (kind >= kKinds) {
        return beyond("no such kind");
    }
    if ((from.flags & ~kModifierFlags[kind]) != 0) {
        return beyond("flags that the kind does not have");
    }
    if (const Status valid = checkNumbers(from); !valid) {
        return valid.error();
    }
    Result<skinning::Modifier> modifier = chained(asset, from);
    if (!modifier) {
        return modifier.error();
    }
    modifier->kind = kind;
    modifier->flags = from.flags;
    modifier->weight = from.weight;
    modifier->fadeWeight = from.fadeWeight;
    modifier->fadeStart = from.fadeStart;
    modifier->fadeDuration = from.fadeDuration;
    modifier->share = from.share;
    modifier->limit = from.limit != 0.0f ? from.limit : defaultLimit(asset, kind);
    modifier->soft = from.soft != 0.0f ? from.soft : kDefaultSoft;
    modifier->poleWeight = (from.flags & kModifierPole) != 0 ? from.poleWeight : 0.0f;
    modifier->eye = glm::make_vec3(from.offset);
    if (needsRotation(kind, from.flags)) {
        const Result<glm::vec4> rotation = unitRotation(kind, from.rotation);
        if (!rotation) {
            return rotation.error();
        }
        modifier->rotation = *rotation;
    }
    return PlacedModifier{*modifier, pointsOf(from.target, from.pole)};
}

} // namespace

Status readModifiers(const Asset& asset, const SuppleModifiersDesc& desc, PlacedModifiers& modifiers) {
    if (desc.modifierCount > 0 && desc.modifiers == nullptr) {
        return Error{ErrorCode::nullPointer, "modifiers is null"};
    }
    if (desc.modifierCount > SUPPLE_MAX_MODIFIERS) {
        return Error{ErrorCode::range, std::to_string(desc.modifierCount) + " modifiers of at most " +
                                           std::to_string(SUPPLE_MAX_MODIFIERS)};
    }
    if (desc.modifierCount > 0 && asset.clipTable->nodes.size() > kMostNodes) {
        return Error{ErrorCode::limit, "modifiers take skeletons of at most 65535 nodes"};
    }
    for (uint32_t i = 0; i < desc.modifierCount; ++i) {
        Result<PlacedModifier> read = readModifier(asset, desc.modifiers[i]);
        if (!read) {
            return Error{read.error().code, "modifier " + std::to_string(i) + ": " + read.error().message};
        }
        modifiers[i] = *read;
    }
    return success();
}

Result<ModifierGoal> readModifierTarget(std::span<const uint32_t> words, const SuppleModifierTarget& target) {
    if (!allFinite(target.target, 3) || !allFinite(target.pole, 3) || !allFinite(target.rotation, 4)) {
        return Error{ErrorCode::notFinite, "a point or rotation is not finite"};
    }
    if (!isPart(target.weight)) {
        return Error{std::isfinite(target.weight) ? ErrorCode::range : ErrorCode::notFinite, "weight leaves 0..1"};
    }
    ModifierGoal goal;
    goal.points = pointsOf(target.target, target.pole);
    goal.weight = target.weight;
    const uint32_t kind = skinning::modifierKind(words);
    if (needsRotation(kind, skinning::modifierFlags(words))) {
        const Result<glm::vec4> rotation = unitRotation(kind, target.rotation);
        if (!rotation) {
            return rotation.error();
        }
        goal.rotation = *rotation;
    }
    return goal;
}

} // namespace supple::runtime
