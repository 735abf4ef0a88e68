#include "surface/chains/chain_check.h"

#include "shaders/shared/chains.h"
#include "shaders/shared/subdivision.h"
#include "surface/chains/fan_tables.h"

namespace supple::surface::chains {
namespace {

constexpr uint64_t kVertexElements = 2;
constexpr uint32_t kNoChain = 0xFFFFFFFFu;
constexpr uint32_t kMostPoints = 0xFFFF; ///< of a level: 16 bits number them

} // namespace

bool ChainCheck::readFan(uint64_t element, CheckedFan& fan) {
    if (!check_.elements(element, 2)) { // its weights are the second
        return false;
    }
    const auto words = check_.element(element);
    if (!check_.within(words[0], 1, uint64_t{kMostPoints} + 1, "sectors of a fan") ||
        !check_.require(words[0] > 0 && words[2] <= 1, "a fan without sectors, or neither open nor closed")) {
        return false;
    }
    fan.fan = {subdivision_, words[0], words[2] != 0};
    fan.points = pointCount(fan.fan, 3);
    return check_.require(words[1] == fan.points && fan.points <= kMostPoints, "a fan with another number of points");
}

bool ChainCheck::takeVertices(const Section& section) {
    check_.begin("vertices with chains");
    if (!check_.require(firstAlike_.empty(), "there are two lists of them") ||
        !check_.elements(section.table, kVertexElements * section.count)) {
        return false;
    }
    vertices_ = section;
    firstAlike_.reserve(section.count);
    for (uint64_t i = 0; i < section.count; ++i) {
        const uint64_t element = section.table + kVertexElements * i;
        if (!takeVertex(element)) {
            return false;
        }
        const bool hasChain = check_.element(element + 1)[0] != 0;
        const bool goesOn = i > 0 && firstAlike_.back() != kNoChain &&
                            check_.element(element)[1] == check_.element(element - kVertexElements)[1];
        firstAlike_.push_back(!hasChain ? kNoChain : goesOn ? firstAlike_.back() : static_cast<uint32_t>(i));
    }
    return true;
}

bool ChainCheck::takeVertex(uint64_t element) {
    const auto first = check_.element(element), second = check_.element(element + 1);
    CheckedFan fan;
    if (!readFan(first[1], fan)) {
        return false;
    }
    const uint64_t chain = second[0];
    if (!checkNet(first[0], second[2], pointCount(fan.fan, chain != 0 ? 2 : 1)) ||
        !checkArrangement(first[2], pointCount(fan.fan, 1) - 1)) {
        return false;
    }
    const uint64_t runs = check_.element(first[2])[0], levels = lastLevel_ - kFirstChainLevel + 1;
    // The point that a chain is relative to lies before it.
    return checkTarget(check_, first[3]) && checkTarget(check_, second[1], runs) &&
           check_.require(second[3] == 0 || second[3] == chain, "a centre that is not its chain's") &&
           (chain == 0 || checkTarget(check_, chain - 1, 1 + levels * fan.points));
}

bool ChainCheck::checkNet(uint64_t word, uint64_t first, uint32_t points) {
    const uint64_t words = (points + 1) / 2;
    // Vertices have nets of their own. With this no file can make kernels read a large one for every vertex.
    netWords_ += words;
    return check_.words(word, words) &&
           check_.require(netWords_ <= check_.tables().words.size(), "their nets overlap") &&
           check_.pool(first + largestHalf(&check_.tables().words[word], points));
}

/// Its fan is not told: points of ring 1 tell all that must be known of it.
bool ChainCheck::checkArrangement(uint64_t element, uint32_t ringPoints) {
    if (!check_.elements(element, 1)) {
        return false;
    }
    const auto head = check_.element(element);
    if (!check_.require(head[3] == ringPoints, "an arrangement of another number of points")) {
        return false;
    }
    if (!arrangements_.isFirst(element)) {
        return true;
    }
    // Behind the last spoke of an open fan of quads there is no face point.
    const uint64_t spokes = subdivision_ == Subdivision::loop ? ringPoints : (ringPoints + 1) / 2;
    return (head[1] == shared::kNoSharpness || check_.words(head[1], spokes)) && checkSteps(head[2], spokes) &&
           checkRuns(element, spokes);
}

/// A normal is a sum over the sectors of its run: the number of sectors bounds that of all runs, and of their blocks.
bool ChainCheck::checkRuns(uint64_t element, uint64_t spokes) {
    const auto head = check_.element(element);
    if (!check_.require(head[0] > 0, "an arrangement without runs") ||
        !check_.within(head[0] - uint64_t{1}, 1, spokes, "runs of an arrangement")) {
        return false;
    }
    uint64_t at = element + 1, allBlocks = 0;
    for (uint32_t run = 0; run < head[0]; ++run) {
        if (!check_.elements(at, 1)) {
            return false;
        }
        const uint64_t blocks = check_.word(4 * at);
        allBlocks += blocks;
        if (!check_.require(blocks > 0, "a run without blocks") ||
            !check_.within(allBlocks - 1, 1, 2 * spokes, "blocks of an arrangement") ||
            !check_.elements(at, 1 + blocks * head[3])) {
            return false;
        }
        at += 1 + blocks * head[3];
    }
    return true;
}

bool ChainCheck::checkSteps(uint64_t element, uint64_t spokes) {
    const uint64_t levels = lastLevel_ - kFirstChainLevel + 1;
    if (!check_.elements(element, levels)) {
        return false;
    }
    for (uint64_t level = 0; level < levels; ++level) {
        const auto step = check_.element(element + level);
        if (!check_.within(std::max(step[2], step[3]), 1, spokes, "spokes of a centre's step")) {
            return false;
        }
    }
    return true;
}

bool ChainCheck::takeBlocks(const Section& section, uint32_t makes) {
    check_.begin("blocks of chains");
    if (!check_.require(section.count % shared::kBlockLanes == 0, "a block without all of its lanes") ||
        !check_.elements(section.table, section.count / shared::kBlockLanes)) {
        return false;
    }
    last_ = {};
    for (uint64_t block = 0; block < section.count / shared::kBlockLanes; ++block) {
        if (!takeBlock(check_.element(section.table + block), makes)) {
            return false;
        }
    }
    return true;
}

bool ChainCheck::takeBlock(std::span<const uint32_t> block, uint32_t makes) {
    const uint64_t first = vertices_.table;
    const uint64_t count = makes == shared::kMakesChains ? block[2] : block[2] & ((1u << shared::kChainLevelShift) - 1);
    if (!check_.require(block[1] >= first && (block[1] - first) % kVertexElements == 0 && count > 0,
                        "not at the record of a vertex, or none")) {
        return false;
    }
    const uint64_t vertex = (block[1] - first) / kVertexElements;
    if (!check_.within(vertex, count, firstAlike_.size(), "vertices") ||
        !check_.require(firstAlike_[vertex + count - 1] <= vertex, "vertices of several fans, or without chains") ||
        !check_.require(check_.element(block[1])[1] == block[0], "another fan than that of its vertices") ||
        !follows(vertex, count, block[3], makes == shared::kMakesChains)) {
        return false;
    }
    CheckedFan fan;
    return readFan(block[0], fan) &&
           (makes == shared::kMakesChains ? checkWholeChains(block, fan) : checkLevel(block, fan, makes));
}

/// Blocks do not overlap. With this no file can make kernels go round a large fan for every block.
bool ChainCheck::follows(uint64_t vertex, uint64_t count, uint32_t item, bool whole) {
    const bool goesOn = !whole && vertex == last_.vertex && count == last_.count;
    const bool follows = goesOn ? item == last_.nextItem : vertex >= last_.vertex + last_.count && (whole || item == 0);
    last_ = {vertex, count, uint64_t{item} + shared::kBlockLanes};
    return check_.require(follows, "blocks do not follow each other");
}

/// They are made in workgroup memory. All blocks of a workgroup have the same barriers.
bool ChainCheck::checkWholeChains(std::span<const uint32_t> block, const CheckedFan& fan) {
    const uint64_t count = block[2];
    return check_.require(check_.source().recipe.wide, "whole chains are of the wide mapping") &&
           check_.require(block[3] == lastLevel_, "another last level than that of chains") &&
           check_.within(0, count * fan.points, shared::kBlockPoints, "points of a block") &&
           check_.within(0, count * (fan.spokes() + 1), shared::kBlockLanes, "lanes of a block");
}

bool ChainCheck::checkLevel(std::span<const uint32_t> block, const CheckedFan& fan, uint32_t makes) {
    const uint64_t count = block[2] & ((1u << shared::kChainLevelShift) - 1);
    const uint32_t level = block[2] >> shared::kChainLevelShift;
    const bool isKnown =
        makes == shared::kMakesFirstLevel ? level == kFirstChainLevel : level > kFirstChainLevel && level <= lastLevel_;
    const uint64_t items = count * (fan.spokes() + (makes == shared::kMakesFirstLevel ? 0 : 1));
    return check_.require(isKnown, "a level that chains do not have") &&
           check_.within(items, 0, 0xFFFFFFFFu, "items of a level") &&
           check_.within(block[3], 1, items, "items of a level");
}

} // namespace supple::surface::chains
