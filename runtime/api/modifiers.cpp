// supple_playback.h, modifiers.
#include "runtime/api/poses.h"
#include "runtime/modifiers_desc.h"

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

/// For groups whose instances may have modifiers.
template <class Body>
SuppleResult withModifiers(SuppleContext handle, SuppleInstance instance, const char* function, Body&& body) noexcept {
    return withAnyPose(handle, instance, function, [&](Context& context, Group& found) {
        return found.poses().takesModifiers() ? body(context, found)
                                              : refuse(context, found, ErrorCode::argument, function,
                                                       "the group was created without SUPPLE_GROUP_MODIFIERS");
    });
}

} // namespace

SuppleResult suppleSetModifiers(SuppleContext handle, SuppleInstance instance, const SuppleModifiersDesc* given) {
    constexpr const char* kHere = "suppleSetModifiers";
    return withModifiers(handle, instance, kHere, [&](Context& context, Group& found) {
        SuppleModifiersDesc desc{};
        if (const auto fault = takeIn(context, kHere, "modifiers", given, desc)) {
            return *fault;
        }
        runtime::PlacedModifiers room;
        const Status valid = runtime::readModifiers(found.asset(), desc, room);
        if (!valid) {
            return refuse(context, found, valid.error().code, kHere, valid.error().message);
        }
        const std::span<const runtime::PlacedModifier> modifiers = std::span(room).first(desc.modifierCount);
        const auto fades = std::find_if(modifiers.begin(), modifiers.end(),
                                        [](const auto& m) { return m.modifier.fadeDuration > 0.0f; });
        if (found.poses().playback() == nullptr && fades != modifiers.end()) {
            return refuse(context, found, ErrorCode::argument, kHere,
                          "modifier " + std::to_string(fades - modifiers.begin()) +
                              ": its weight fades, and the group has no time: it was created without "
                              "SUPPLE_POSES_PLAYBACK");
        }
        found.poses().setModifiers(instance.slot, modifiers);
        return noted(context, calls::SetModifiers{instance, desc});
    });
}

SuppleResult suppleSetModifierTarget(SuppleContext handle, SuppleInstance instance, uint32_t index,
                                     const SuppleModifierTarget* given) {
    constexpr const char* kHere = "suppleSetModifierTarget";
    return withModifiers(handle, instance, kHere, [&](Context& context, Group& found) {
        SuppleModifierTarget target{};
        if (const auto fault = takeIn(context, kHere, "target", given, target)) {
            return *fault;
        }
        const uint32_t count = found.poses().modifierCount(instance.slot);
        if (index >= count) {
            return refuse(context, found, ErrorCode::range, kHere,
                          "modifier " + std::to_string(index) + ": the instance has " + std::to_string(count));
        }
        const Result<runtime::ModifierGoal> goal =
            runtime::readModifierTarget(found.poses().modifierWords(instance.slot, index), target);
        if (!goal) {
            return refuse(context, found, goal.error().code, kHere, goal.error().message);
        }
        found.poses().setModifierGoal(instance.slot, index, *goal);
        return noted(context, calls::SetModifierTarget{instance, index, target});
    });
}
