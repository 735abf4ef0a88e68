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
    /// `facets`: how many the cage has.
    RingWriter(TableWriter& writer, uint32_t facets) : writer_(writer), elements_(facets, cage::kNone) {}
    /// Tells where the record of a facet's patch begins.
    void setRecord(uint32_t facet, uint32_t element) { elements_[facet] = element; }
    /// Adds the next slot. `vertices`: the vertex, the far end of its spoke, and the two far corners of the facet
    /// behind the spoke. `points`: the limit points in the record of that facet, with cage::kNone for a limit point
    /// whose number is not that of its vertex.
    void add(const std::array<uint32_t, 4>& vertices, uint32_t facet, std::span<const uint32_t> points);
    /// Writes the ring and returns Tables::ring. Nothing may be added afterwards.
    [[nodiscard]] uint32_t write();

private:
    TableWriter& writer_;
    std::vector<uint32_t> elements_; ///< by facet
    std::vector<uint32_t> words_;
};

} // namespace supple::surface
