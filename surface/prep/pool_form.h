// What p-rep's pool has of fans, and what the tables say of it: two forms (shaders/shared/prep.h). Private to
// surface/prep.
#pragma once

#include "cage/topology.h"
#include "surface/prep/weights.h"
#include "surface/scheme.h"
#include "surface/table_writer.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace supple::surface::prep {

/// A cage and where the spokes of its fans stand in the ring, by spoke of the topology.
struct FanLayout {
    const cage::Cage& cage;
    const cage::Topology& topology;
    const std::vector<uint32_t>& slots;

    /// The corner of the same face, so many steps on.
    [[nodiscard]] uint32_t corner(uint32_t c, uint32_t steps) const {
        const uint32_t first = cage.faceStarts[topology.cornerFaces[c]];
        return first + (c - first + steps) % 4;
    }
    [[nodiscard]] uint32_t slot(uint32_t corner) const { return slots[topology.cornerSpokes[corner]]; }
    /// What the vertices of a valence class have in common: faces, and whether they lie on the boundary.
    [[nodiscard]] std::pair<uint32_t, bool> classKey(uint32_t v) const {
        return {topology.sectorCount(v), topology.boundary[v] != 0};
    }
};

class PoolForm {
public:
    virtual ~PoolForm() = default;
    /// Notes in the tables what lies where. Returns the first coefficient behind it.
    virtual uint32_t layOut(Tables& tables) = 0;
    virtual void addClass(const ValenceClass& /*c*/, TableWriter& /*writer*/) {}
    /// Counts a vertex, whose record comes next. `kind`: of its fan.
    virtual void countVertex(uint32_t kind, uint32_t spokes, TableWriter& writer, Tables& tables) const = 0;
    [[nodiscard]] virtual KindOfKernel edgeKernel() const = 0;
    /// What the record of a patch says of the spokes at one of its corners.
    [[nodiscard]] virtual uint32_t cornerWord(uint32_t corner) const = 0;
    /// The record of a perturbed edge: the words of its ends, and the corners of the cage behind which it lies.
    virtual void writeEdge(uint32_t a, uint32_t b, uint32_t corner, uint32_t twin, TableWriter& writer) const = 0;
    /// Where the normal of a boundary vertex with one face comes from.
    [[nodiscard]] virtual uint32_t cornerNormal(uint32_t v) const = 0;
};

/// `layout` must outlive the form.
[[nodiscard]] std::unique_ptr<PoolForm> makePoolForm(const FanLayout& layout, bool fanRecords);

} // namespace supple::surface::prep
