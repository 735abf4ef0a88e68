// The ring of a scheme's tables (shaders/shared/surface.h). Private to surface/.
#pragma once

#include "surface/scheme.h"
#include "surface/table_writer.h"

#include <array>
#include <span>
#include <vector>

namespace supple::surface {

class RingWriter {
public:
    /// `facets`: of the cage. `pointVertices`: for limit points that are numbered as vertices are, or cage::kNone.
    RingWriter(TableWriter& writer, uint32_t facets) : writer_(writer), elements_(facets, cage::kNone) {}
    /// The element that begins the record of a facet's patch.
    void setRecord(uint32_t facet, uint32_t element) { elements_[facet] = element; }
    /// The next slot of the ring: vertex, far end of its spoke, two far corners of the facet behind it. `points`: of
    /// the facet's record, cage::kNone for limit points of other numbers than their vertices have.
    void add(const std::array<uint32_t, 4>& vertices, uint32_t facet, std::span<const uint32_t> points);
    /// The ring, for Tables::ring. Nothing may be added after it.
    [[nodiscard]] uint32_t write();

private:
    TableWriter& writer_;
    std::vector<uint32_t> elements_; ///< by facet
    std::vector<uint32_t> words_;
};

} // namespace supple::surface
