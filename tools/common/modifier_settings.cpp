#include "tools/common/modifier_settings.h"

#include "base/from_chars.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace supple::host {
namespace {

Result<ModifierSetting> parseModifier(const std::string& text, SuppleModifierKind kind, size_t count,
                                      const char* form) {
    const size_t equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0) {
        return Error{ErrorCode::argument, text + " is not " + form};
    }
    ModifierSetting setting{kind, text.substr(0, equals)};
    const char* at = text.data() + equals + 1;
    const char* const last = text.data() + text.size();
    for (size_t i = 0; i < count; ++i) {
        const auto [end, error] = from_chars(at, last, setting.numbers[i]);
        const bool whole = i + 1 == count ? end == last : end != last && *end == ',';
        if (error != std::errc() || !whole || !std::isfinite(setting.numbers[i])) {
            return Error{ErrorCode::argument, text + " is not " + form};
        }
        at = end + 1;
    }
    return setting;
}

std::optional<uint32_t> findJoint(const cage::Character& character, const std::string& nameOrIndex) {
    const std::vector<uint32_t>& joints = character.skin.joints;
    for (uint32_t j = 0; j < joints.size(); ++j) {
        if (character.skeleton.nodes[joints[j]].name == nameOrIndex) {
            return j;
        }
    }
    uint32_t index = 0;
    const char* const last = nameOrIndex.data() + nameOrIndex.size();
    const auto [end, error] = std::from_chars(nameOrIndex.data(), last, index);
    return error == std::errc() && end == last && index < joints.size() ? std::optional(index) : std::nullopt;
}

/// What takes +Y to a normal that does not point down.
void putTurnTo(const double* normal, float* rotation) {
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    const std::array<double, 4> q{normal[2] / length, 0.0, -normal[0] / length, 1.0 + normal[1] / length};
    std::ranges::transform(q, rotation, [](double x) { return static_cast<float>(x); });
}

} // namespace

Result<ModifierSetting> parseAim(const std::string& text) {
    return parseModifier(text, SUPPLE_MODIFIER_AIM, 3, "JOINT=x,y,z");
}

Result<ModifierSetting> parseTwoBone(const std::string& text) {
    return parseModifier(text, SUPPLE_MODIFIER_TWO_BONE, 3, "JOINT=x,y,z");
}

Result<ModifierSetting> parseSet(const std::string& text) {
    Result<ModifierSetting> setting = parseModifier(text, SUPPLE_MODIFIER_SET, 4, "JOINT=qx,qy,qz,qw");
    if (setting && std::ranges::all_of(setting->numbers, [](double x) { return x == 0.0; })) {
        return Error{ErrorCode::argument, "a rotation of zeros is none"};
    }
    return setting;
}

Result<ModifierSetting> parsePlant(const std::string& text) {
    Result<ModifierSetting> setting = parseModifier(text, SUPPLE_MODIFIER_PLANT, 6, "JOINT=x,y,z,nx,ny,nz");
    if (setting && !(setting->numbers[4] > 0.0)) {
        return Error{ErrorCode::argument, "the ground's normal points down or aside"};
    }
    return setting;
}

Result<ModifierSetting> parseLower(const std::string& text) {
    Result<ModifierSetting> setting = parseModifier(text, SUPPLE_MODIFIER_LOWER, 1, "JOINT=distance");
    if (setting && !(setting->numbers[0] >= 0.0)) {
        return Error{ErrorCode::argument, text + " lowers by less than nothing"};
    }
    return setting;
}

Result<std::vector<SuppleModifier>> modifiersOf(const cage::Character& character,
                                                const std::vector<ModifierSetting>& settings, float weight) {
    if (settings.size() > SUPPLE_MAX_MODIFIERS) {
        return Error{ErrorCode::argument,
                     std::to_string(settings.size()) + " modifiers of at most " + std::to_string(SUPPLE_MAX_MODIFIERS)};
    }
    std::vector<SuppleModifier> modifiers;
    for (const SuppleModifierKind kind : {SUPPLE_MODIFIER_SET, SUPPLE_MODIFIER_AIM, SUPPLE_MODIFIER_TWO_BONE,
                                          SUPPLE_MODIFIER_LOWER, SUPPLE_MODIFIER_PLANT}) {
        for (const ModifierSetting& setting : settings) {
            if (setting.kind != kind) {
                continue;
            }
            const std::optional<uint32_t> joint = findJoint(character, setting.joint);
            if (!joint) {
                return Error{ErrorCode::argument, character.name + ": no joint \"" + setting.joint + "\""};
            }
            SuppleModifier modifier{};
            modifier.kind = kind;
            modifier.joint = *joint;
            modifier.weight = weight;
            if (kind == SUPPLE_MODIFIER_SET) {
                modifier.flags = SUPPLE_MODIFIER_MODEL;
                std::transform(setting.numbers.begin(), setting.numbers.begin() + 4, modifier.rotation,
                               [](double x) { return static_cast<float>(x); });
            } else if (kind == SUPPLE_MODIFIER_LOWER) {
                modifier.limit = static_cast<float>(setting.numbers[0]);
            } else {
                if (kind == SUPPLE_MODIFIER_PLANT) {
                    putTurnTo(&setting.numbers[3], modifier.rotation);
                }
                std::copy_n(setting.numbers.begin(), 3, modifier.target);
            }
            modifiers.push_back(modifier);
        }
    }
    return modifiers;
}

} // namespace supple::host
