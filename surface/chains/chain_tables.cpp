#include "surface/chains/chain_tables.h"

#include "shaders/shared/subdivision.h"
#include "surface/build.h"
#include "surface/chains/kernels.h"
#include "surface/chains/net_lists.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace supple::surface::chains {
namespace {

using subdivision::Fan;

/// 16 bits number them. So a net, which has half as many, fits NeededRows, too.
constexpr uint32_t kMaxChainPoints = 0xFFFF;

} // namespace

uint32_t lastChainLevel(uint32_t rate) {
    return rate == 0 ? kLastChainLevel : std::max(kFirstChainLevel, static_cast<uint32_t>(std::bit_width(rate - 1)));
}

bool haveSameChains(uint32_t rate, uint32_t other) {
    return lastChainLevel(rate) == lastChainLevel(other);
}

ChainTables::ChainTables(const Desc& desc, std::vector<VertexContent> contents, FanTables& fans, TableWriter& writer)
    : mesh_(*desc.mesh), lastLevel_(desc.lastLevel), wide_(desc.wide), lod_(desc.lod), contents_(std::move(contents)),
      fans_(fans), writer_(writer) {}

Fan ChainTables::fanOf(uint32_t v) const {
    return {mesh_.subdivision, mesh_.fragments[v].sectors, mesh_.fragments[v].open};
}

uint32_t ChainTables::chainLevels(uint32_t v) const {
    return contents_[v] == VertexContent::chain ? lastLevel_ - kFirstChainLevel + 1 : 0;
}

KindOfKernel ChainTables::kernelOf(uint32_t makes, Stage stage) const {
    return chainKernel(mesh_.subdivision, makes, stage);
}

Status ChainTables::checkSizes() const {
    for (uint32_t v = 0; v < contents_.size(); ++v) {
        if (contents_[v] == VertexContent::chain && chainPoints(v) > kMaxChainPoints) {
            return Error{ErrorCode::limit, "vertex " + std::to_string(v) + " has " +
                                               std::to_string(mesh_.fragments[v].sectors) +
                                               " faces: more than chains of leaves count"};
        }
    }
    return success();
}

uint32_t ChainTables::netSize(uint32_t vertex) const {
    switch (contents_[vertex]) {
    case VertexContent::chain:
        return pointCount(fanOf(vertex), 2);
    case VertexContent::limit:
        return pointCount(fanOf(vertex), 1);
    default:
        return 0;
    }
}

std::span<const uint32_t> ChainTables::findNets() {
    nets_.clear();
    netStarts_.clear();
    for (uint32_t v = 0; v < contents_.size(); ++v) {
        const auto net = mesh_.net.begin() + mesh_.fragments[v].firstNet;
        netStarts_.push_back(static_cast<uint32_t>(nets_.size()));
        nets_.insert(nets_.end(), net, net + netSize(v));
    }
    return nets_;
}

void ChainTables::numberNets(NeededRows& levelOne) {
    for (uint32_t v = 0; v < contents_.size(); ++v) {
        levelOne.needNet(netOf(v));
    }
}

uint32_t ChainTables::layOut(uint32_t next) {
    normals_.assign(contents_.size(), 0);
    chains_.assign(contents_.size(), 0);
    vertexArrangements_.assign(contents_.size(), nullptr);
    for (uint32_t v = 0; v < contents_.size(); ++v) {
        if (contents_[v] == VertexContent::nothing) {
            continue;
        }
        vertexArrangements_[v] = &arrangementOf(v);
        normals_[v] = next;
        next += vertexArrangements_[v]->runs;
        if (chainLevels(v) > 0) {
            chains_[v] = next + 1; // behind the point that it is relative to
            next += 1 + chainLevels(v) * chainPoints(v);
            depth_ = lod_ ? 1 : 0;
        }
    }
    if (depth_ > 0) {
        depth_ = next++;
    }
    return next;
}

ChainTables::Corner ChainTables::cornerOf(uint32_t vertex, uint32_t sector) {
    Corner corner;
    if (contents_[vertex] == VertexContent::nothing) {
        return corner;
    }
    const ArrangementTable& arrangement = *vertexArrangements_[vertex];
    corner.chain = normals_[vertex] + arrangement.runs;
    if (chainLevels(vertex) > 0) {
        corner.chain = chains_[vertex];
        corner.netLists = fans_.of(fanOf(vertex)).netLists + fans_.netListElements(mesh_.subdivision) * sector;
    }
    corner.normal = corner.chain - (normals_[vertex] + arrangement.runOfSector[sector]);
    return corner;
}

const ChainTables::ArrangementTable& ChainTables::arrangementOf(uint32_t v) {
    const subdivision::Fragment& fragment = mesh_.fragments[v];
    const auto spokes = mesh_.spokeSharpness.begin() + fragment.firstSpoke;
    const Arrangement key{fanOf(v), {spokes, spokes + fragment.spokes()}, fragment.centreSharpness};
    const auto [known, isNew] = arrangements_.try_emplace(key);
    if (isNew) {
        known->second = writeArrangement(key);
    }
    return known->second;
}

ChainTables::ArrangementTable ChainTables::writeArrangement(const Arrangement& key) {
    const bool sharp = std::any_of(key.spokes.begin(), key.spokes.end(), [](float s) { return s > 0.0f; });
    uint32_t words = shared::kNoSharpness;
    if (sharp) {
        words = 4 * writer_.element();
        for (const float sharpness : key.spokes) {
            writer_.put({std::bit_cast<uint32_t>(sharpness)});
        }
    }
    const uint32_t steps = writer_.element();
    for (uint32_t level = 0; level + kFirstChainLevel <= lastLevel_; ++level) {
        const CentreStep step = centreStep(softened(key.spokes, level), softened(key.vertex, level));
        writer_.put({floatBits(step.smooth), floatBits(step.crease), step.first, step.second});
    }
    const Limit limit = limitOf(key);
    const auto ring = static_cast<uint32_t>(limit.position.size()) - 1;
    ArrangementTable table{writer_.element(), static_cast<uint32_t>(limit.runs.size()),
                           std::vector<uint32_t>(key.fan.sectors, 0)};
    writer_.put({table.runs, words, steps, ring});
    for (uint32_t r = 0; r < table.runs; ++r) {
        const LimitRun& run = limit.runs[r];
        writeRun(limit.position, run);
        for (uint32_t h = 0; h < run.sectors; ++h) {
            table.runOfSector[(run.firstSector + h) % key.fan.sectors] = r;
        }
    }
    return table;
}

void ChainTables::writeRun(const subdivision::CentreMask& position, const LimitRun& run) {
    std::vector<const subdivision::CentreMask*> masks{&position};
    for (const subdivision::CentreMask& tangent : run.tangents) {
        masks.push_back(&tangent);
    }
    const auto blocks = static_cast<uint32_t>((masks.size() + 3) / 4);
    writer_.put({blocks, 0u, 0u, 0u});
    for (uint32_t block = 0; block < blocks; ++block) {
        for (size_t i = 1; i < position.size(); ++i) {
            for (size_t k = size_t{4} * block; k < size_t{4} * block + 4; ++k) {
                writer_.putFloats({k < masks.size() ? (*masks[k])[i] : 0.0});
            }
        }
    }
}

/// Those that are not plain, by the size of their fans, so that neighbouring lanes loop equally long.
void ChainTables::write(const Places& places, Tables& tables) {
    std::vector<uint32_t> vertices, nets, firstOfNets;
    for (uint32_t v = 0; v < contents_.size(); ++v) {
        if (contents_[v] != VertexContent::nothing) {
            vertices.push_back(v);
        }
    }
    std::stable_sort(vertices.begin(), vertices.end(), [&](uint32_t a, uint32_t b) {
        return std::pair(chainLevels(a), fanOf(a)) < std::pair(chainLevels(b), fanOf(b));
    });
    for (const uint32_t v : vertices) {
        const uint32_t first = firstOfNet(netOf(v));
        firstOfNets.push_back(places.firstLevelOne + first);
        nets.push_back(writer_.word());
        writeNet(netOf(v), first, writer_);
        (void)fans_.of(fanOf(v));
    }
    uint32_t limits = 0; // coefficients
    const uint32_t first = writer_.element();
    for (size_t i = 0; i < vertices.size(); ++i) {
        const uint32_t v = vertices[i];
        const ArrangementTable& arrangement = *vertexArrangements_[v];
        const uint32_t levels = chainLevels(v);
        writer_.put({nets[i], fans_.of(fanOf(v)).element, arrangement.element, places.limit(v), chains_[v], normals_[v],
                     firstOfNets[i], isByLevels(v) ? chains_[v] : 0u});
        limits += 1 + arrangement.runs + (levels > 0 ? 1 : 0) + (isByLevels(v) ? 1 : 0);
    }
    if (vertices.empty()) {
        return;
    }
    const auto count = static_cast<uint32_t>(vertices.size());
    tables.constructions.push_back(
        {Stage::assemble, kernelOf(shared::kMakesLimits), {first, count}, limits, places.isStepped});
    writeChains(vertices, first, tables);
    std::array<uint32_t, shared::kDepths> lanes{};
    for (uint32_t level = kFirstChainLevel; level <= lastLevel_; ++level) {
        const uint32_t made = writeLevel(vertices, first, level, tables);
        if (level >= shared::kFirstDepth && level < shared::kFirstDepth + shared::kDepths) {
            lanes[level - shared::kFirstDepth] = made;
        }
    }
    if (depth_ > 0) {
        tables.lod.depth = depth_;
        tables.lod.depthLanes = writer_.element();
        writer_.put(lanes);
    }
}

/// Whether a block makes all levels of the vertex's chain, in workgroup memory. On CPU devices barriers within a
/// workgroup cost more than dispatches.
bool ChainTables::fitsInBlock(uint32_t v) const {
    return wide_ && chainPoints(v) <= shared::kBlockPoints && mesh_.fragments[v].spokes() < shared::kBlockLanes;
}

/// Whether each level of the vertex's chain is made by itself. The kernel of limits makes the centre of the first one.
bool ChainTables::isByLevels(uint32_t v) const {
    return chainLevels(v) > 0 && !fitsInBlock(v);
}

/// Blocks of kBlockLanes lanes: whole chains of one fan each. Vertices follow each other by fans.
void ChainTables::writeChains(const std::vector<uint32_t>& vertices, uint32_t firstRecord, Tables& tables) {
    Construction work{Stage::assemble, kernelOf(shared::kMakesChains), {writer_.element(), 0}, 0};
    for (size_t i = 0; i < vertices.size();) {
        const uint32_t v = vertices[i];
        if (chainLevels(v) == 0 || !fitsInBlock(v)) {
            ++i;
            continue;
        }
        const size_t most =
            std::min(shared::kBlockPoints / chainPoints(v), shared::kBlockLanes / (mesh_.fragments[v].spokes() + 1));
        uint32_t count = 1;
        while (count < most && i + count < vertices.size() && chainLevels(vertices[i + count]) > 0 &&
               fanOf(vertices[i + count]) == fanOf(v)) {
            ++count;
        }
        writer_.put({fans_.of(fanOf(v)).element, firstRecord + 2 * static_cast<uint32_t>(i), count, lastLevel_});
        work.section.count += shared::kBlockLanes;
        work.coefficients += count * chainPoints(v) * chainLevels(v);
        i += count;
    }
    if (work.section.count > 0) {
        tables.constructions.push_back(work);
    }
}

/// One level of the other chains: blocks of kBlockLanes lanes, of each fan's. Returns how many lanes.
uint32_t ChainTables::writeLevel(const std::vector<uint32_t>& vertices, uint32_t firstRecord, uint32_t level,
                                 Tables& tables) {
    const bool isFirst = level == kFirstChainLevel;
    const Stage stage = depth_ > 0 && level >= shared::kFirstDepth ? Stage::deepen : Stage::assemble;
    Construction work{
        stage, kernelOf(isFirst ? shared::kMakesFirstLevel : shared::kMakesLevel, stage), {writer_.element(), 0}, 0};
    work.readsPool = !isFirst;
    const auto add = [&](uint32_t fan, uint32_t record, uint32_t count, uint32_t items) {
        for (uint32_t item = 0; item < items; item += shared::kBlockLanes) {
            writer_.put({fan, record, count | level << shared::kChainLevelShift, item});
            work.section.count += shared::kBlockLanes;
        }
    };
    for (size_t i = 0; i < vertices.size();) {
        size_t end = i;
        while (end < vertices.size() && fanOf(vertices[end]) == fanOf(vertices[i]) &&
               chainLevels(vertices[end]) == chainLevels(vertices[i])) {
            ++end;
        }
        if (isByLevels(vertices[i])) {
            const auto count = static_cast<uint32_t>(end - i);
            const uint32_t centres = isFirst ? 0 : 1;
            add(fans_.of(fanOf(vertices[i])).element, firstRecord + 2 * static_cast<uint32_t>(i), count,
                count * (mesh_.fragments[vertices[i]].spokes() + centres));
            work.coefficients += count * (chainPoints(vertices[i]) - 1 + centres);
        }
        i = end;
    }
    if (work.section.count > 0) {
        tables.constructions.push_back(work);
    }
    return work.section.count;
}

} // namespace supple::surface::chains
