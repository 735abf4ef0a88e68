// Vertices that are not plain: what lies in the pool for them, and the records that make it (shaders/shared/chains.h).
// Private to chains/.
#pragma once

#include "shaders/shared/chains.h"
#include "surface/chains/arrangement.h"
#include "surface/chains/fan_tables.h"
#include "surface/chains/needed_rows.h"
#include "surface/subdivision/mesh.h"
#include "surface/table_writer.h"

#include <functional>
#include <map>
#include <span>
#include <vector>

namespace supple::surface::chains {

inline constexpr uint32_t kLastChainLevel = 6; ///< of 64 segments along an edge

/// A sample at 1 / rate or further from a corner lies in a leaf of this level at most. `rate` 0: any rate.
[[nodiscard]] uint32_t lastChainLevel(uint32_t rate);

enum class VertexContent : uint8_t { nothing, limit, chain };

class ChainTables {
public:
    struct Desc {
        const subdivision::Mesh* mesh = nullptr;
        uint32_t lastLevel = kLastChainLevel;
        bool wide = false, lod = false;
    };
    /// `fans` and `writer` must outlive this, as the mesh. `needs`: by vertex.
    ChainTables(const Desc& desc, std::vector<VertexContent> contents, FanTables& fans, TableWriter& writer);

    /// Refuses a vertex with more faces than 16 bits number the points of its chain.
    [[nodiscard]] Status checkSizes() const;
    /// The points of level 1 that chains and limits are made of, as the mesh numbers them.
    std::span<const uint32_t> findNets();
    /// Numbers them. Behind findNets().
    void numberNets(NeededRows& levelOne);
    /// Takes pool indices from `next` on, and returns the first that is free.
    [[nodiscard]] uint32_t layOut(uint32_t next);

    /// Where points lie in the pool: the first of level 1, and the limit at a vertex.
    struct Places {
        uint32_t firstLevelOne = 0;
        std::function<uint32_t(uint32_t)> limit;
        bool isStepped = false; ///< the stage before this one, assemble, writes points of level 1
    };
    /// Behind layOut(). At levels of detail later levels are made for the instances that need them (Stage::deepen).
    void write(const Places& places, Tables& tables);

    /// What records of patches say of a sector of a vertex: the pool index of its chain, or what lies behind its
    /// normals; net lists, 0 where there is no chain; and so far before the first the sector's normal lies. Of a plain
    /// vertex all are 0.
    struct Corner {
        uint32_t chain = 0, netLists = 0, normal = 0;
    };
    [[nodiscard]] Corner cornerOf(uint32_t vertex, uint32_t sector);

private:
    struct ArrangementTable {
        uint32_t element = 0, runs = 0;
        std::vector<uint32_t> runOfSector;
    };

    /// How many points of level 1 round a vertex are needed: up to radius 2 for its chain, up to 1 for its limit.
    [[nodiscard]] uint32_t netSize(uint32_t vertex) const;
    [[nodiscard]] std::span<uint32_t> netOf(uint32_t vertex) {
        return std::span(nets_).subspan(netStarts_[vertex], netSize(vertex));
    }
    [[nodiscard]] subdivision::Fan fanOf(uint32_t v) const;
    [[nodiscard]] uint32_t chainPoints(uint32_t v) const { return pointCount(fanOf(v), 3); }
    [[nodiscard]] uint32_t chainLevels(uint32_t v) const;
    [[nodiscard]] KindOfKernel kernelOf(uint32_t makes, Stage stage = Stage::assemble) const;
    [[nodiscard]] bool fitsInBlock(uint32_t v) const;
    [[nodiscard]] bool isByLevels(uint32_t v) const;
    const ArrangementTable& arrangementOf(uint32_t v);
    ArrangementTable writeArrangement(const Arrangement& key);
    void writeRun(const subdivision::CentreMask& position, const LimitRun& run);
    void writeChains(const std::vector<uint32_t>& vertices, uint32_t firstRecord, Tables& tables);
    uint32_t writeLevel(const std::vector<uint32_t>& vertices, uint32_t firstRecord, uint32_t level, Tables& tables);

    const subdivision::Mesh& mesh_;
    uint32_t lastLevel_;
    bool wide_, lod_;
    uint32_t depth_ = 0; ///< pool index; 0: chains are as long everywhere
    std::vector<VertexContent> contents_;
    FanTables& fans_;
    TableWriter& writer_;
    std::map<Arrangement, ArrangementTable> arrangements_;
    std::vector<const ArrangementTable*> vertexArrangements_; ///< by vertex; null where it is plain
    std::vector<uint32_t> nets_, netStarts_; ///< numbers of points of level 1; by vertex: where its net begins
    std::vector<uint32_t> normals_, chains_; ///< by vertex: pool indices; 0 where there are none
};

} // namespace supple::surface::chains
