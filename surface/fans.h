// What p-rep and P_m write alike about fans: their weights, and the ring (shaders/shared/surface.h). Private to
// surface/.
#pragma once

#include "cage/topology.h"
#include "surface/table_writer.h"

#include <span>
#include <vector>

namespace supple::surface {

/// The weights of a fan: one per spoke (..Edge) or per facet (..Face). They belong to differences from the vertex. An
/// open fan has one spoke more than facets.
struct FanWeights {
    std::vector<double> limitEdge, limitFace;           ///< of the limit point
    std::vector<double> e1Edge, e1Face, e2Edge, e2Face; ///< of two vectors that span the tangent plane
    std::vector<double> cosines, sines;                 ///< the tangent of spoke k is e1*cosines[k] + e2*sines[k]
};
/// Writes one element with the number of facets and `flags`, then two per spoke. Returns the first element.
uint32_t writeFanWeights(const FanWeights& weights, uint32_t flags, TableWriter& writer);

/// Writes the ring: one word per spoke of all fans.
class RingWriter {
public:
    /// `points`: per corner of the cage, the limit point in the record of its facet, or cage::kNone for a limit point
    /// whose number is not that of its vertex. `firstCorners`: see DraftFaces. All must outlive the writer.
    RingWriter(const cage::Cage& cage, const cage::Topology& topology, std::span<const uint32_t> points,
               std::span<const uint8_t> firstCorners, TableWriter& writer)
        : cage_(cage), topology_(topology), points_(points), firstCorners_(firstCorners), writer_(writer),
          records_(cage.faceCount(), cage::kNone) {}
    /// Tells where the record of a facet's patch begins.
    void setRecord(uint32_t facet, uint32_t element) { records_[facet] = element; }
    /// Adds a fan. `spokes`: of the topology, counter-clockwise.
    void add(uint32_t vertex, std::span<const uint32_t> spokes, bool open);
    /// Writes the ring and returns Tables::ring. Nothing may be added afterwards.
    [[nodiscard]] uint32_t write();

private:
    const cage::Cage& cage_;
    const cage::Topology& topology_;
    std::span<const uint32_t> points_;
    std::span<const uint8_t> firstCorners_;
    TableWriter& writer_;
    std::vector<uint32_t> records_; ///< by facet
    std::vector<uint32_t> words_;
};

} // namespace supple::surface
