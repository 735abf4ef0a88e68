#include "tools/common/morph_weights.h"

#include <charconv>
#include <cmath>
#include <map>
#include <set>

namespace supple::host {
namespace {

/// The targets of that name, else of that number.
std::vector<uint32_t> findTargets(const std::vector<Figure::MorphTarget>& targets, const std::string& nameOrIndex) {
    std::vector<uint32_t> found;
    for (uint32_t t = 0; t < targets.size(); ++t) {
        if (!nameOrIndex.empty() && targets[t].name == nameOrIndex) {
            found.push_back(t);
        }
    }
    uint32_t index = 0;
    const char* const last = nameOrIndex.data() + nameOrIndex.size();
    const auto [end, error] = std::from_chars(nameOrIndex.data(), last, index);
    if (found.empty() && error == std::errc() && end == last && index < targets.size()) {
        found.push_back(index);
    }
    return found;
}

Result<std::vector<float>> weightsOf(const std::string& owner, const std::vector<Figure::MorphTarget>& targets,
                                     const std::vector<MorphSetting>& settings) {
    std::vector<float> weights;
    for (size_t t = 0; t < targets.size() && !settings.empty(); ++t) {
        weights.push_back(targets[t].weight);
    }
    for (const MorphSetting& setting : settings) {
        const std::vector<uint32_t> found = findTargets(targets, setting.target);
        if (found.empty()) {
            std::string names;
            std::set<std::string> said;
            for (size_t t = 0; t < targets.size(); ++t) {
                const std::string name = targets[t].name.empty() ? std::to_string(t) : targets[t].name;
                names += said.insert(name).second ? (names.empty() ? "" : ", ") + name : "";
            }
            return Error{ErrorCode::argument, owner + ": no morph target \"" + setting.target + "\"; it has " +
                                                  (names.empty() ? "none" : names)};
        }
        for (const uint32_t target : found) {
            weights[target] = setting.weight;
        }
    }
    return weights;
}

} // namespace

Result<MorphSetting> parseMorph(const std::string& text) {
    const size_t equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0) {
        return Error{ErrorCode::argument, text + " is not NAME=WEIGHT"};
    }
    MorphSetting setting{text.substr(0, equals)};
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data() + equals + 1, last, setting.weight);
    if (error != std::errc() || end != last || !std::isfinite(setting.weight)) {
        return Error{ErrorCode::argument, text.substr(equals + 1) + " is not a finite number"};
    }
    return setting;
}

Result<std::vector<float>> morphWeights(const Figure& figure, const std::vector<MorphSetting>& settings) {
    return weightsOf(figure.path(), figure.morphTargets(), settings);
}

Result<std::vector<float>> morphWeights(const cage::Character& character, const std::vector<MorphSetting>& settings) {
    std::vector<Figure::MorphTarget> targets;
    for (size_t t = 0; t < character.morphs.targets.size(); ++t) {
        targets.push_back({character.morphs.targets[t].name, character.morphs.weights[t]});
    }
    return weightsOf(character.name, targets, settings);
}

std::vector<NamedTargets> targetsByName(const Figure& figure) {
    std::vector<NamedTargets> named;
    std::map<std::string, size_t> places;
    for (uint32_t t = 0; t < figure.morphTargets().size(); ++t) {
        const std::string& given = figure.morphTargets()[t].name;
        const std::string name = given.empty() ? "target " + std::to_string(t) : given;
        const auto [place, isNew] = places.try_emplace(name, named.size());
        if (isNew) {
            named.push_back({name, {}});
        }
        named[place->second].targets.push_back(t);
    }
    return named;
}

} // namespace supple::host
