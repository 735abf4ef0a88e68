// Skeleton and clips in the layout that the pose pass reads (shaders/shared/pose.h).
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <vector>

namespace supple::skinning {

/// Nodes that move a joint, or that drivers look at, by depth: parents stand before children.
struct NodeOrder {
    std::vector<uint32_t> nodes;     ///< by place: the node
    std::vector<uint32_t> places;    ///< by node: its place, or kNone
    std::vector<uint32_t> levelEnds; ///< by depth: behind the last place
    uint32_t targetCount = 0;        ///< morph targets
};
[[nodiscard]] NodeOrder nodeOrder(const cage::Character& character);

/// What the clips of a character are made of.
struct ClipKinds {
    bool keyed = false;  ///< some have channels of keys
    bool packed = false; ///< some are packed
    bool coarse = false; ///< some have a coarse twin
};
[[nodiscard]] ClipKinds clipKinds(const cage::Character& character);

/// Bytes that a clip takes in the table, beside key times that it shares with others.
[[nodiscard]] size_t clipBytes(const NodeOrder& order, const cage::Clip& clip);

/// A clip with a coarse twin, whose segments may be missing on the device.
struct StreamedClip {
    uint32_t clip = 0;
    uint32_t twin = 0; ///< its first element
    uint32_t frames = 0;
    uint32_t firstSegment = 0, segmentCount = 0; ///< among those of the table
};
/// A segment of such a clip: its records, and its data behind them.
struct StreamedSegment {
    uint32_t element = 0; ///< that says where it is
    uint32_t records = 0, data = 0, end = 0;
    [[nodiscard]] uint32_t size() const { return end - records; } ///< elements
};

/// Only nodes of nodeOrder() are in the table, in an order of its own. Sections are given by their first element.
struct ClipTable {
    std::vector<uint32_t> words;  ///< four an element
    std::vector<uint32_t> nodes;  ///< by place in the table: the node
    std::vector<uint32_t> places; ///< by node: its place, or kNone
    uint32_t jointCount = 0;
    uint32_t targetCount = 0;
    uint32_t joints = 0;
    uint32_t levels = 0;
    uint32_t levelCount = 0;
    uint32_t restWeights = 0;
    uint32_t clips = 0;
    uint32_t contacts = 0;
    uint32_t footCount = 0;
    double longestLeg = 0.0; ///< of the feet
    uint32_t springs = 0;    ///< 0: no joint swings
    uint32_t springJointCount = 0, springColliderCount = 0;
    uint32_t springWork = 0;        ///< nodes, colliders and tests against these in a step
    std::vector<uint32_t> swinging; ///< nodes, in any order
    uint32_t drivers = 0;           ///< 0: no morph weights follow from joints
    uint32_t drivenQuads = 0;
    std::vector<uint32_t> driverNodes; ///< by the number that inputs of drivers have for them
    /// By clip. All their segments are there: they end the table, and kPackedPadding elements behind them.
    std::vector<StreamedClip> streamedClips;
    std::vector<StreamedSegment> streamedSegments;
    uint32_t segments = 0; ///< where they begin, or the table ends

    /// Whether feet can be planted there.
    [[nodiscard]] bool isFoot(uint32_t node) const;
    /// The place of a foot by its number, and back: of a place that is a foot's.
    [[nodiscard]] uint32_t footPlace(uint32_t number) const;
    [[nodiscard]] uint32_t footNumber(uint32_t place) const;
};
[[nodiscard]] ClipTable buildClipTable(const cage::Character& character);

} // namespace supple::skinning
