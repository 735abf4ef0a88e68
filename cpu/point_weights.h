// Places of a surface as combinations of the cage's vertices. Weights depend on connectivity alone, so one set of them
// serves all poses.
#pragma once

#include "cpu/form.h"
#include "cpu/place.h"

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::cpu {

/// What a vertex has of a position and of its derivatives by the place's a and b.
struct VertexWeight {
    uint32_t vertex = 0;
    double position = 0.0, du = 0.0, dv = 0.0;
};
[[nodiscard]] inline VertexWeight operator*(double factor, const VertexWeight& weight) {
    return {weight.vertex, factor * weight.position, factor * weight.du, factor * weight.dv};
}

/// The weights of a place. Those of the position sum to 1, those of derivatives to 0.
class PointWeights {
public:
    void clear() { entries_.clear(); }
    /// Adds to the vertex' weights.
    void add(const VertexWeight& weight) {
        for (VertexWeight& entry : entries_) {
            if (entry.vertex == weight.vertex) {
                entry.position += weight.position, entry.du += weight.du, entry.dv += weight.dv;
                return;
            }
        }
        entries_.push_back(weight);
    }
    /// The same of many: they are summed up by merge(), which leaves them rising by vertex.
    void append(const VertexWeight& weight) { entries_.push_back(weight); }
    void merge() {
        std::stable_sort(entries_.begin(), entries_.end(),
                         [](const VertexWeight& a, const VertexWeight& b) { return a.vertex < b.vertex; });
        size_t kept = 0;
        for (size_t k = 0; k < entries_.size(); ++k) {
            if (kept > 0 && entries_[kept - 1].vertex == entries_[k].vertex) {
                VertexWeight& sum = entries_[kept - 1];
                sum.position += entries_[k].position, sum.du += entries_[k].du, sum.dv += entries_[k].dv;
            } else {
                entries_[kept++] = entries_[k];
            }
        }
        entries_.resize(kept);
    }
    /// Adds a point that is a combination of vertices itself. `weight`: what the point has; its vertex is not asked.
    void add(const surface::Form& point, const VertexWeight& weight) {
        for (const surface::Form::Entry& entry : point.entries()) {
            VertexWeight own = entry.weight * weight;
            own.vertex = entry.vertex;
            add(own);
        }
    }
    /// Derivatives by the x and y of a place become those by its a and b, as turn() does it.
    void turn(const Place& place) {
        for (VertexWeight& entry : entries_) {
            const double x = entry.du, y = entry.dv;
            entry.du = place.xSlope.x * x + place.ySlope.x * y;
            entry.dv = place.xSlope.y * x + place.ySlope.y * y;
        }
    }

    [[nodiscard]] std::span<const VertexWeight> entries() const { return entries_; }
    [[nodiscard]] std::span<VertexWeight> entries() { return entries_; }

private:
    std::vector<VertexWeight> entries_; ///< a few dozen; more at vertices of many faces
};

} // namespace supple::cpu
