#include "tools/common/morph_weights.h"

#include "cage/expressions.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
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

/// "smile, frown", each once; those without a name by number.
std::string listed(const std::vector<std::string>& names) {
    std::string list;
    std::set<std::string> said;
    for (size_t i = 0; i < names.size(); ++i) {
        const std::string name = names[i].empty() ? std::to_string(i) : names[i];
        list += said.insert(name).second ? (list.empty() ? "" : ", ") + name : "";
    }
    return list.empty() ? "none" : list;
}

/// What settings may name.
struct Settable {
    std::string owner;
    std::vector<Figure::MorphTarget> targets;
    std::vector<std::string> expressions;
    std::function<Result<std::vector<float>>(const std::vector<float>&)> fill; ///< of weights of expressions
};

/// What the expressions that are set make of all targets.
Result<std::vector<float>> expressedWeights(const Settable& of, const std::vector<MorphSetting>& settings) {
    std::vector<float> weights(of.expressions.size(), 0.0f);
    for (const MorphSetting& setting : settings) {
        const auto found = std::find(of.expressions.begin(), of.expressions.end(), setting.target);
        if (setting.isExpression && found == of.expressions.end()) {
            return Error{ErrorCode::argument,
                         of.owner + ": no expression \"" + setting.target + "\"; it has " + listed(of.expressions)};
        }
        if (setting.isExpression) {
            weights[static_cast<size_t>(found - of.expressions.begin())] = setting.weight;
        }
    }
    return of.fill(weights);
}

Result<std::vector<float>> weightsOf(const Settable& of, const std::vector<MorphSetting>& settings) {
    if (settings.empty()) {
        return std::vector<float>{};
    }
    Result<std::vector<float>> weights = expressedWeights(of, settings);
    if (!weights) {
        return weights.error();
    }
    for (const MorphSetting& setting : settings) {
        if (setting.isExpression) {
            continue;
        }
        const std::vector<uint32_t> found = findTargets(of.targets, setting.target);
        if (found.empty()) {
            std::vector<std::string> names;
            for (const Figure::MorphTarget& target : of.targets) {
                names.push_back(target.name);
            }
            return Error{ErrorCode::argument,
                         of.owner + ": no morph target \"" + setting.target + "\"; it has " + listed(names)};
        }
        for (const uint32_t target : found) {
            (*weights)[target] = setting.weight;
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

Result<MorphSetting> parseExpression(const std::string& text) {
    Result<MorphSetting> setting = parseMorph(text);
    if (setting) {
        setting->isExpression = true;
    }
    return setting;
}

Result<std::vector<float>> morphWeights(const Figure& figure, const std::vector<MorphSetting>& settings) {
    return weightsOf({figure.path(), figure.morphTargets(), figure.expressions(),
                      [&](const std::vector<float>& weights) { return figure.expressionWeights(weights); }},
                     settings);
}

Result<std::vector<float>> morphWeights(const cage::Character& character, const std::vector<MorphSetting>& settings) {
    Settable of{character.name, {}, {}, [&](const std::vector<float>& weights) {
                    return Result<std::vector<float>>(cage::expressionWeights(character, weights));
                }};
    for (size_t t = 0; t < character.morphs.targets.size(); ++t) {
        of.targets.push_back({character.morphs.targets[t].name, character.morphs.weights[t]});
    }
    for (const cage::Expression& expression : character.expressions) {
        of.expressions.push_back(expression.name);
    }
    return weightsOf(of, settings);
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
