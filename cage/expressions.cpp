#include "cage/expressions.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace supple::cage {
namespace {

/// A name that no expression before has.
std::string freeName(const std::string& name, const std::set<std::string>& taken) {
    std::string wanted = name;
    for (uint32_t number = 2; taken.contains(wanted); ++number) {
        wanted = name + "_" + std::to_string(number);
    }
    return wanted;
}

/// How much is left of those that expressions hold back, by kind.
struct Shares {
    float left[kExpressionKinds] = {1.0f, 1.0f, 1.0f, 1.0f};

    void hold(const Expression& expression, float weight) {
        for (size_t kind = 0; kind < kExpressionKinds; ++kind) {
            const ExpressionHold hold = expression.holds[kind];
            left[kind] -= hold == ExpressionHold::block   ? (weight > 0.0f ? 1.0f : 0.0f)
                          : hold == ExpressionHold::blend ? weight
                                                          : 0.0f;
        }
    }
    [[nodiscard]] float of(const Expression& expression) const {
        const float share = std::max(left[static_cast<size_t>(expression.kind)], 0.0f);
        return expression.isBinary && share < 1.0f ? 0.0f : share;
    }
};

} // namespace

void placeExpressions(std::span<const UnplacedExpression> expressions, Character& character) {
    std::map<uint32_t, const Part*> partOf; // node
    for (const Part& part : character.parts) {
        partOf.emplace(part.node, &part);
    }
    std::set<std::string> taken;
    for (const UnplacedExpression& given : expressions) {
        Expression placed = given.expression;
        placed.name = freeName(placed.name, taken);
        taken.insert(placed.name);
        std::map<uint32_t, float> weights; // by target; the first bind of one counts
        for (const ExpressionBind& bind : given.binds) {
            const auto part = partOf.find(bind.node);
            if (part != partOf.end() && bind.target < part->second->targetCount) {
                weights.emplace(part->second->firstTarget + bind.target, bind.weight);
            }
        }
        for (const auto& [target, weight] : weights) {
            placed.targets.push_back(target);
            placed.weights.push_back(weight);
        }
        character.expressions.push_back(std::move(placed));
    }
}

uint32_t findExpression(const Character& character, const std::string& name) {
    const auto found = std::find_if(character.expressions.begin(), character.expressions.end(),
                                    [&](const Expression& expression) { return expression.name == name; });
    return found == character.expressions.end() ? kNone : static_cast<uint32_t>(found - character.expressions.begin());
}

std::vector<float> expressionWeights(const Character& character, std::span<const float> weights) {
    std::vector<float> result = character.morphs.weights;
    std::vector<float> own;
    Shares shares;
    for (size_t e = 0; e < character.expressions.size(); ++e) {
        const Expression& expression = character.expressions[e];
        const float weight = std::clamp(weights[e], 0.0f, 1.0f);
        own.push_back(expression.isBinary ? (weight > 0.5f ? 1.0f : 0.0f) : weight);
        shares.hold(expression, own.back());
    }
    for (size_t e = 0; e < own.size(); ++e) {
        const Expression& expression = character.expressions[e];
        const float weight = own[e] * shares.of(expression);
        for (size_t i = 0; i < expression.targets.size(); ++i) {
            result[expression.targets[i]] += weight * expression.weights[i];
        }
    }
    return result;
}

} // namespace supple::cage
