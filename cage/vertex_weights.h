// The influences of joints on vertices, as makers of characters read them: normalised, by joint.
#pragma once

#include "cage/character.h"
#include "cage/message.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::cage {

/// Appends to `into` what is painted on a vertex of `from`: its jiggle, its cloth and its mask. Where a list of `from`
/// is empty, that of `into` stays as it is.
void appendPainted(const SkinWeights& from, uint32_t vertex, SkinWeights& into);
/// Appends the influences of the vertex, and what is painted on it. `into.starts` has its leading 0 already.
void appendVertex(const SkinWeights& from, uint32_t vertex, SkinWeights& into);

/// The influences of vertices that are appended one after the other: by joint, normalised, at least one a vertex.
class VertexWeights {
public:
    /// Vertices that follow one joint.
    void appendUnskinned(size_t count, uint32_t joint = 0);
    /// One vertex. `own`: its influences of more than zero, in any order; a joint may be there several times. If there
    /// are none, it is bound to `fallback`. `rounding`: how far each weight may be off because of its format.
    void append(std::span<const Influence> own, uint32_t fallback, double rounding = 0.0);

    [[nodiscard]] std::span<const Influence> of(uint32_t vertex) const;

    /// Warns of what had to be repaired. `element`: what messages call the weights.
    void report(const std::string& element, Warnings& warnings) const;

private:
    void closeVertex() { starts_.push_back(static_cast<uint32_t>(influences_.size())); }

    std::vector<uint32_t> starts_{0};
    std::vector<Influence> influences_;
    std::vector<Influence> sorted_; ///< of the vertex at hand
    size_t renormalised_ = 0;
    size_t unweighted_ = 0;
    double largestDeviation_ = 0.0;
};

} // namespace supple::cage
