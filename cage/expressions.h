// Expressions as a file has them, before its parts are one character.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::cage {

/// A morph target that an expression moves: that of a node's mesh.
struct ExpressionBind {
    uint32_t node = 0;
    uint32_t target = 0; ///< of the part that the node carries
    float weight = 0.0f;
};

struct UnplacedExpression {
    Expression expression; ///< without targets and weights
    std::vector<ExpressionBind> binds;
};

/// Gives expressions to a character whose parts are joined. Parts that share their targets are moved once; what nodes
/// without a part would move is left out. Names that are taken get a number.
void placeExpressions(std::span<const UnplacedExpression> expressions, Character& character);

/// Weights of all morph targets: those of the file, and what expressions add. `weights`: one per expression, which
/// counts from 0 to 1. Expressions hold back others as VRM 1.0 says.
[[nodiscard]] std::vector<float> expressionWeights(const Character& character, std::span<const float> weights);

} // namespace supple::cage
