// Packed clips: the channels of a clip in a few bits, in the layout that the pose pass reads (shaders/shared/pose.h).
//
// Time is cut into frames, and these into segments of kSegmentFrames. A channel keeps some frames of each segment, its
// knots, as whole numbers of a lattice; between two knots it is linear, and rotations go along the arc, as glTF's
// LINEAR channels do. So a packed clip is a clip with fewer keys, whose values are rounded: channelsOf() gives it.
//
// A rotation is kept as the tangent of a quarter of its angle, along its axis, from a reference near all of them:
// nearly even, and decoded without a root. Morph weights are kept in threes, as translations are.
//
// Every second knot of a segment, and its last one, is an outer knot. The inner knot between two of these is kept as
// what it is off their line (shaders/pose/knots.h): mostly little, so that it takes few bits.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <vector>

namespace supple::skinning {

/// What a packed clip can move: the nodes of the clip table, and behind them morph targets, three in one place.
struct PackedPlaces {
    size_t nodes = 0, targets = 0;
    [[nodiscard]] size_t count() const { return nodes + (targets + 2) / 3; }
};

/// One property of a node, or the weights of three morph targets.
struct PackedProperty {
    uint32_t place = 0; ///< of PackedPlaces
    cage::ChannelPath path = cage::ChannelPath::translation;
    bool isConstant = false;
    int exponent = 0; ///< values are multiples of 2^-exponent
    /// Used only by rotations that change: the quarter tangent of a rotation near all of them. 15 encodes 0, and 0 and
    /// 30 encode -1 and 1.
    std::array<uint32_t, 3> reference{15u, 15u, 15u};
    std::vector<uint32_t> frames;   ///< of the knots, rising: the first and the last of each segment among them
    std::vector<glm::ivec3> values; ///< one a knot; of a constant one
};

struct PackedClip {
    uint32_t last = 1;                      ///< the number of the last frame, which is the clip's end; the first is 0
    std::vector<PackedProperty> properties; ///< by place, then by path
};

/// Numbers that the fields of the layout have room for.
inline constexpr int kLeastExponent = -8, kMostExponent = 20;
inline constexpr uint32_t kMostPackedFrames = 1u << 20;

/// The rotation whose axis is as long as the tangent of a quarter of its angle, and back. q and -q are one rotation.
[[nodiscard]] glm::dquat fromQuarterTangent(const glm::dvec3& r);
[[nodiscard]] glm::dvec3 toQuarterTangent(const glm::dquat& q);

/// The rotation that a reference encodes, and the reference nearest to a rotation.
[[nodiscard]] glm::dquat referenceTurn(const std::array<uint32_t, 3>& reference);
[[nodiscard]] std::array<uint32_t, 3> referenceNear(const glm::dquat& rotation);

/// Whether the values of a property have room in the layout: 20 bits each, and 129 for an inner knot with both its
/// neighbors.
[[nodiscard]] bool fitsLayout(const PackedProperty& property);
/// Removes the knots inside of segments all of whose values are equal: the layout has no such knots.
void removeEqualKnots(PackedProperty& property);

/// The exponent with which a constant is kept: its largest number fits into 20 bits.
[[nodiscard]] int constantExponent(const glm::dvec3& value);

/// Elements that are behind a packed clip's segments: knots are read as two.
inline constexpr uint32_t kPackedPadding = 2;

/// Nothing if a number is too large for its field. `places`: of the clip table and the morph targets. There are four
/// words an element, and offsets count from the first.
[[nodiscard]] std::optional<std::vector<uint32_t>> packedWords(const PackedClip& clip, double duration,
                                                               const PackedPlaces& places);

/// Reads words that may be anybody's; refuses all that a reader of them would have to check.
[[nodiscard]] Result<PackedClip> readPackedWords(std::span<const uint32_t> words, double duration,
                                                 const PackedPlaces& places);

/// What is read of a time within one segment alone: records of its own, and data of its own. Elements from the first of
/// the words on.
struct SegmentPlaces {
    uint32_t records = 0, recordsEnd = 0, data = 0, dataEnd = 0;
};
/// Of words that packedWords() has made.
[[nodiscard]] std::vector<SegmentPlaces> segmentsIn(std::span<const uint32_t> words);
/// Words that all segments have together.
[[nodiscard]] size_t segmentWords(std::span<const uint32_t> words);

/// Whether words may be those of a packed clip's coarse twin: both are sound, and have the same frames.
[[nodiscard]] bool areTwins(std::span<const uint32_t> fine, std::span<const uint32_t> coarse);

/// The properties as channels, in their order. `nodes`: by place, as ClipTable has them. `targets`: how many there are.
[[nodiscard]] std::vector<cage::Channel> channelsOf(const PackedClip& clip, double duration,
                                                    std::span<const uint32_t> nodes, size_t targets);

} // namespace supple::skinning
