#include "cage/expressions.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace supple::cage {
namespace {

/// Names that no expression before has.
class NumberedNames {
public:
    std::string of(const std::string& name) {
        std::string wanted = name;
        for (uint32_t& number = numbers_.try_emplace(name, 1).first->second; !taken_.insert(wanted).second;) {
            wanted = name + "_" + std::to_string(++number);
        }
        return wanted;
    }

private:
    std::set<std::string> taken_;
    std::map<std::string, uint32_t> numbers_; ///< that each name was given last
};

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
    NumberedNames names;
    for (const UnplacedExpression& given : expressions) {
        Expression placed = given.expression;
        placed.name = names.of(placed.name);
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
    for (float& weight : result) { // sums of large binds may leave the floats
        weight = std::clamp(weight, -std::numeric_limits<float>::max(), std::numeric_limits<float>::max());
    }
    return result;
}

} // namespace supple::cage
