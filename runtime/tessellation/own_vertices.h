// What tessellations have in common whose vertices are the group's own: streams, static attributes, index buffer, draw
// ranges.
#pragma once

#include "runtime/tessellation/tessellation.h"
#include "surface/indexed_mesh.h"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace supple::runtime {

/// What an index buffer is made of.
struct IndexBytes {
    IndexBytes() = default;
    template <class Index>
    explicit IndexBytes(std::vector<Index> indices) {
        const auto kept = std::make_shared<const std::vector<Index>>(std::move(indices));
        bytes = std::as_bytes(std::span(*kept));
        keeper = kept;
    }
    std::span<const std::byte> bytes;
    std::shared_ptr<const void> keeper; ///< of the bytes
};

class OwnVertices : public Tessellation {
public:
    [[nodiscard]] BoundBytes boundBytes() const override;
    [[nodiscard]] Status cutDraws(InstanceWindows& windows, bool byWindows) override;
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging) override;
    [[nodiscard]] gpu::MemoryUse memoryUse() const override { return indices_.buffers->use(); }
    [[nodiscard]] const VertexStreams* streams() const override { return &streams_; }
    [[nodiscard]] const SharedIndices* indices() const override { return &indices_; }
    void fillGrid(SuppleGridOutput& output) const override;
    void fillRays(SuppleRayGeometry& output) const override;
    void addTransfers(Transfers& transfers, uint64_t frame) const override;

    [[nodiscard]] Status createSets(const SurfaceInput& input, const InstanceListing& listing,
                                    const Visibility& visibility) override;
    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, bool changed) override;
    void freeSets() override;
    [[nodiscard]] bool attributesDue() const override { return hasBuffers() && attributes_.due(); }
    PassCost recordAttributes(gpu::Dispatches& dispatches, uint64_t frame) override;

protected:
    using Tessellation::Tessellation;

    /// Takes the vertices that layOut() has counted, without padding.
    [[nodiscard]] Status setVertexCount(uint64_t vertices);
    /// Lays out one mesh per instance: its index buffer, and a draw range per material and part at the end of draws_.
    [[nodiscard]] Result<IndexBytes> layOutMesh(const surface::Evaluation& evaluation, uint32_t vertices);
    /// Takes the bytes, unless the surface before has the same. `whole`: of a whole instance (SharedIndices::buffers).
    [[nodiscard]] Status createIndices(IndexBytes indices, IndexBytes whole);
    /// If isTraced(): builds find a range by a byte of 32 bits.
    [[nodiscard]] Status checkRayIndices(uint64_t count) const;
    void setRayRanges(const surface::IndexedMesh& mesh);
    void bindOutput(const SurfaceSets::Which& which, SetContents& contents) const override;
    /// The part of it that attributes write.
    void bindStatics(const SurfaceSets::Which& which, SetContents& contents) const;
    /// Attributes are the same for all instances: a window of one.
    virtual void recordAttributeSteps(gpu::Dispatches& dispatches) const;
    [[nodiscard]] surface::Window oneInstance(const surface::Sets& sets) const;
    /// Which of SharedIndices::buffers has the triangles of a whole instance: of a mesh, those that are drawn.
    [[nodiscard]] size_t wholeList() const { return kind() == SUPPLE_TESSELLATION_GRIDS ? 1 : 0; }

    uint32_t vertexCount_ = 0; ///< of an instance
    VertexStreams streams_;
    SharedIndices indices_;
    uint32_t indexBytes_ = 2;
    RecordedOnce attributes_;
    std::vector<SuppleDrawRange> draws_;
    std::vector<SuppleRate> rates_;         ///< what is drawn at each rate
    std::vector<SuppleRayRange> rayRanges_; ///< if isTraced()
};

/// One index buffer for the grids of several rates, and the draw ranges over them.
class GridDraws {
public:
    /// Adds the grids of a rate, one for every domain in use.
    void addRate(const surface::Tables& tables, uint32_t rate);
    /// The index buffer of all rates that were added, 16 bits an index.
    [[nodiscard]] IndexBytes takeIndices() { return IndexBytes(std::exchange(indices_, {})); }
    /// Appends the draw ranges of the index-th rate to `draws`. `firstVertex` goes on behind them.
    void append(const surface::Tables& tables, size_t index, uint32_t& firstVertex,
                std::vector<SuppleDrawRange>& draws) const;

private:
    struct Grid {
        uint32_t firstIndex = 0, indexCount = 0;
    };
    struct Rate {
        uint32_t rate = 0;
        std::array<Grid, surface::kDomainCount> grids{};
    };
    std::vector<Rate> rates_;
    std::vector<uint16_t> indices_;
};

} // namespace supple::runtime
