#include "surface/prep/pool_form.h"

#include "shaders/shared/prep.h"
#include "surface/patch_records.h"
#include "surface/prep/kernels.h"

#include <array>
#include <map>

namespace supple::surface::prep {

namespace {

/// X, TG, FC.
class Coefficients final : public PoolForm {
public:
    explicit Coefficients(const FanLayout& layout) : layout_(layout) {}

    uint32_t layOut(Tables& tables) override {
        const auto spokes = static_cast<uint32_t>(layout_.topology.spokeVertices.size());
        tables.tangents = layout_.cage.vertexCount();
        firstFace_ = tables.faces = tables.tangents + spokes;
        return tables.faces + spokes;
    }
    void countVertex(uint32_t kind, uint32_t spokes, TableWriter& writer, Tables& tables) const override {
        surface::countVertex(kVertexKernels[kind], 1 + 2 * spokes, writer, tables);
    }
    [[nodiscard]] KindOfKernel edgeKernel() const override { return kEdgeKernel; }
    [[nodiscard]] uint32_t cornerWord(uint32_t corner) const override {
        return spokeWord(layout_.slot(corner), layout_.slots[layout_.topology.cornerSpokesBack[corner]]);
    }
    void writeEdge(uint32_t a, uint32_t b, uint32_t corner, uint32_t twin, TableWriter& writer) const override {
        const auto slot = [&](uint32_t c, uint32_t steps) { return layout_.slot(layout_.corner(c, steps)); };
        writer.put({a, spokeWord(slot(corner, 0), slot(twin, 1)), b, spokeWord(slot(twin, 0), slot(corner, 1))});
    }
    [[nodiscard]] uint32_t cornerNormal(uint32_t v) const override {
        return firstFace_ + layout_.slots[layout_.topology.spokeStarts[v]] + 1;
    }

private:
    const FanLayout& layout_;
    uint32_t firstFace_ = 0;
};

class FanRecords final : public PoolForm {
public:
    explicit FanRecords(const FanLayout& layout) : layout_(layout) {}

    uint32_t layOut(Tables& tables) override {
        tables.fanRecords = true;
        return shared::kFanRecordElements * layout_.cage.vertexCount();
    }
    /// The turns of all facets. Regular fans have e1, e2, -e1 and -e2 as they are.
    void addClass(const ValenceClass& c, TableWriter& writer) override {
        const bool regular = c.sectors == 4 && !c.boundary;
        const std::vector<double> cosines = regular ? std::vector{1.0, 0.0, -1.0, 0.0} : c.cosines;
        const std::vector<double> sines = regular ? std::vector{0.0, 1.0, 0.0, -1.0} : c.sines;
        turns_[{c.sectors, c.boundary}] = writer.element();
        for (size_t k = 0; k < c.sectors; ++k) {
            const size_t next = (k + 1) % cosines.size();
            writer.putFloats({cosines[k], sines[k], cosines[next], sines[next]});
        }
    }
    void countVertex(uint32_t kind, uint32_t /*spokes*/, TableWriter& writer, Tables& tables) const override {
        surface::countVertex(kRecordVertexKernels[kind], shared::kFanRecordElements, writer, tables);
    }
    [[nodiscard]] KindOfKernel edgeKernel() const override { return kRecordEdgeKernel; }
    [[nodiscard]] uint32_t cornerWord(uint32_t corner) const override {
        const cage::Topology& topology = layout_.topology;
        const uint32_t v = layout_.cage.faceVertices[corner],
                       k = topology.cornerSpokes[corner] - topology.spokeStarts[v];
        const bool open = topology.boundary[v] != 0;
        return (turns_.at(layout_.classKey(v)) + k) | (open && k == 0 ? shared::kBorderSpoke : 0u) |
               (open && k + 1 == topology.sectorCount(v) ? shared::kBorderNextSpoke : 0u);
    }
    void writeEdge(uint32_t a, uint32_t b, uint32_t corner, uint32_t twin, TableWriter& writer) const override {
        const auto vertex = [&](uint32_t c, uint32_t steps) {
            return layout_.cage.faceVertices[layout_.corner(c, steps)];
        };
        writer.put({a, cornerWord(corner), b, cornerWord(twin)});
        writer.put({vertex(corner, 2), vertex(corner, 3), vertex(twin, 2), vertex(twin, 3)});
    }
    [[nodiscard]] uint32_t cornerNormal(uint32_t v) const override { return v; }

private:
    const FanLayout& layout_;
    std::map<std::pair<uint32_t, bool>, uint32_t> turns_; ///< by class: the first element
};

} // namespace

std::unique_ptr<PoolForm> makePoolForm(const FanLayout& layout, bool fanRecords) {
    if (fanRecords) {
        return std::make_unique<FanRecords>(layout);
    }
    return std::make_unique<Coefficients>(layout);
}

} // namespace supple::surface::prep
