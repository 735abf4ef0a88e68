#include "cage/vertex_weights.h"

#include <algorithm>
#include <cmath>

namespace supple::cage {
namespace {

/// Half a unit in the last place of a weight near 1, as floats round.
constexpr double kFloatRounding = 1.0 / (1u << 24);

} // namespace

void appendPainted(const SkinWeights& from, uint32_t vertex, SkinWeights& into) {
    const auto append = [vertex](const auto& list, auto& to) {
        if (!list.empty()) {
            to.push_back(list[vertex]);
        }
    };
    append(from.jiggles, into.jiggles);
    append(from.cloths, into.cloths);
    append(from.mushMask, into.mushMask);
}

void appendVertex(const SkinWeights& from, uint32_t vertex, SkinWeights& into) {
    const auto begin = from.influences.begin();
    into.influences.insert(into.influences.end(), begin + from.starts[vertex], begin + from.starts[vertex + 1]);
    into.starts.push_back(static_cast<uint32_t>(into.influences.size()));
    appendPainted(from, vertex, into);
}

void VertexWeights::appendUnskinned(size_t count, uint32_t joint) {
    for (size_t v = 0; v < count; ++v) {
        influences_.push_back({joint, 1.0f});
        closeVertex();
    }
}

void VertexWeights::append(std::span<const Influence> own, uint32_t fallback, double rounding) {
    sorted_.assign(own.begin(), own.end());
    double sum = 0.0;
    for (const Influence& influence : sorted_) {
        sum += influence.weight;
    }
    if (!(sum > 0.0)) {
        sorted_.assign(1, {fallback, 1.0f});
        sum = 1.0;
        ++unweighted_;
    }
    const double deviation = std::abs(sum - 1.0);
    if (deviation > std::max(1e-4, rounding * static_cast<double>(sorted_.size()) * 1.001)) {
        ++renormalised_;
        largestDeviation_ = std::max(largestDeviation_, deviation);
    }
    // As they are where only their own rounding keeps floats from a sum of 1: what was read once is then read alike.
    if (deviation <= kFloatRounding * static_cast<double>(sorted_.size())) {
        sum = 1.0;
    }
    std::sort(sorted_.begin(), sorted_.end(), [](const Influence& a, const Influence& b) { return a.joint < b.joint; });
    for (size_t i = 0; i < sorted_.size();) {
        double weight = 0.0;
        const uint32_t joint = sorted_[i].joint;
        for (; i < sorted_.size() && sorted_[i].joint == joint; ++i) {
            weight += sorted_[i].weight;
        }
        // A subnormal weight may vanish when divided; the others keep the vertex bound.
        const auto scaled = static_cast<float>(weight / sum);
        if (scaled > 0.0f) {
            influences_.push_back({joint, scaled});
        }
    }
    closeVertex();
}

std::span<const Influence> VertexWeights::of(uint32_t vertex) const {
    return std::span(influences_).subspan(starts_[vertex], starts_[vertex + 1] - starts_[vertex]);
}

void VertexWeights::report(const std::string& element, Warnings& warnings) const {
    if (renormalised_ > 0) {
        warn(warnings, element,
             "normalised: they do not sum to 1 at " + counted(renormalised_, "vertex", "vertices") +
                 ", largest deviation " + shortNumber(largestDeviation_));
    }
    if (unweighted_ > 0) {
        warn(warnings, element,
             "all zero at " + counted(unweighted_, "vertex", "vertices") + "; bound to the first joint named there");
    }
}

} // namespace supple::cage
