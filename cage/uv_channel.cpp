#include "cage/uv_channel.h"

#include "base/within_memory.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace supple::cage {
namespace {

/// Two texture coordinates are one value if they have the same bits. The two zeros are one.
using Value = std::array<uint32_t, 2>;
Value valueOf(const glm::vec2& uv) {
    return {std::bit_cast<uint32_t>(uv.x + 0.0f), std::bit_cast<uint32_t>(uv.y + 0.0f)};
}

/// The sign of a face's area in texture coordinates.
int sideOf(const Cage& cage, std::span<const glm::vec2> uvs, uint32_t face) {
    double twice = 0.0;
    for (uint32_t c = cage.faceStarts[face]; c < cage.faceStarts[face + 1]; ++c) {
        const glm::dvec2 a(uvs[c]), b(uvs[nextCorner(cage, face, c)]);
        twice += a.x * b.y - b.x * a.y;
    }
    return twice > 0.0 ? 1 : twice < 0.0 ? -1 : 0;
}

/// Cuts the faces round every vertex into runs, and says what becomes of each.
class ChannelBuilder {
public:
    ChannelBuilder(const Cage& cage, const Topology& topology, const UvSharpness& sharpness,
                   std::span<const glm::vec2> uvs, UvMode mode, bool folds)
        : cage_(cage), topology_(topology), sharpness_(sharpness), uvs_(uvs), mode_(mode), folds_(folds) {}

    Result<UvChannel> build() {
        cutEdges();
        for (uint32_t v = 0; v < cage_.vertexCount() && folds_; ++v) {
            poles_.push_back(isPole(v) ? 1 : 0);
        }
        channel_.cage.faceStarts = cage_.faceStarts;
        channel_.cage.faceVertices.assign(cage_.cornerCount(), kNone);
        for (uint32_t v = 0; v < cage_.vertexCount(); ++v) {
            addVertex(v);
        }
        channel_.cage.positions.assign(channel_.values.size(), glm::vec3(0.0f));
        Result<Topology> own = buildTopology(channel_.cage);
        if (!own) {
            return own.error();
        }
        channel_.topology = std::move(*own);
        return std::move(channel_);
    }

private:
    /// Consecutive faces round a vertex with nothing discontinuous between them.
    struct CornerRun {
        uint32_t first = 0, faces = 0;
        uint32_t value = 0; ///< a number of the value round this vertex
    };
    /// What a value has round a vertex.
    struct ValueFacts {
        uint32_t faces = 0, runs = 0, semiSharp = 0;
        bool hardInside = false;
    };

    void cutEdges() {
        channel_.cutEdges.assign(topology_.edges.size(), 0);
        foldEdges_.assign(topology_.edges.size(), 0);
        std::vector<int> sides;
        for (uint32_t f = 0; f < cage_.faceCount() && folds_; ++f) {
            sides.push_back(sideOf(cage_, uvs_, f));
        }
        std::vector<uint32_t> cuts(cage_.vertexCount(), 0);
        for (uint32_t e = 0; e < topology_.edges.size(); ++e) {
            const auto [corner, twin] = topology_.edges[e];
            if (twin == kNone) {
                continue;
            }
            const uint32_t f = topology_.cornerFaces[corner], g = topology_.cornerFaces[twin];
            const uint32_t next = nextCorner(cage_, f, corner), twinNext = nextCorner(cage_, g, twin);
            const bool seam =
                valueOf(uvs_[corner]) != valueOf(uvs_[twinNext]) || valueOf(uvs_[next]) != valueOf(uvs_[twin]);
            foldEdges_[e] = !seam && folds_ && sides[f] * sides[g] < 0 ? 1 : 0;
            if (seam || foldEdges_[e] != 0) {
                channel_.cutEdges[e] = 1;
                ++cuts[cage_.faceVertices[corner]];
                ++cuts[cage_.faceVertices[next]];
            }
        }
        // A single edge cannot be cut: each of its ends would still be one vertex.
        for (uint32_t e = 0; e < topology_.edges.size(); ++e) {
            const uint32_t corner = topology_.edges[e].corner;
            const uint32_t a = cage_.faceVertices[corner];
            const uint32_t b = cage_.faceVertices[nextCorner(cage_, topology_.cornerFaces[corner], corner)];
            if (foldEdges_[e] != 0 && cuts[a] == 1 && cuts[b] == 1 && topology_.boundary[a] == 0 &&
                topology_.boundary[b] == 0) {
                foldEdges_[e] = channel_.cutEdges[e] = 0;
            }
        }
    }

    [[nodiscard]] Value valueAt(uint32_t corner) const { return valueOf(uvs_[corner]); }

    /// Inside the surface, and every face has a value of its own.
    [[nodiscard]] bool isPole(uint32_t v) const {
        std::vector<Value> values;
        for (uint32_t k = 0; k < topology_.sectorCount(v); ++k) {
            values.push_back(valueAt(topology_.sectorCorners[topology_.spokeStarts[v] + k]));
        }
        std::sort(values.begin(), values.end());
        return topology_.boundary[v] == 0 && std::adjacent_find(values.begin(), values.end()) == values.end();
    }

    [[nodiscard]] uint32_t edgeAt(uint32_t spoke) const { return spokeEdge(cage_, topology_, base_ + spoke % spokes_); }
    [[nodiscard]] uint32_t cornerAt(uint32_t sector) const { return topology_.sectorCorners[base_ + sector % faces_]; }
    [[nodiscard]] bool linearBorders() const { return mode_ == UvMode::boundaries; }

    void findRuns() {
        std::vector<uint32_t> starts;
        for (uint32_t k = closed_ ? 0 : 1; k < faces_; ++k) {
            if (channel_.cutEdges[edgeAt(k)] != 0) {
                starts.push_back(k);
            }
        }
        cuts_ = static_cast<uint32_t>(starts.size());
        runs_.clear();
        if (!closed_ || starts.empty()) {
            starts.insert(starts.begin(), 0);
        }
        for (size_t i = 0; i < starts.size(); ++i) {
            const uint32_t end = i + 1 < starts.size() ? starts[i + 1] : closed_ ? starts[0] + faces_ : faces_;
            runs_.push_back({starts[i], end - starts[i], 0});
        }
    }

    /// Numbers the values of runs. At a fold every run counts as a value of its own.
    void numberValues() {
        folded_ = 0;
        for (uint32_t k = 0; k < faces_; ++k) {
            folded_ += foldEdges_[edgeAt(k)];
        }
        facts_.clear();
        std::vector<Value> known;
        for (CornerRun& run : runs_) {
            const Value value = valueAt(cornerAt(run.first));
            auto at = folded_ > 0 ? known.end() : std::find(known.begin(), known.end(), value);
            run.value = static_cast<uint32_t>(at - known.begin());
            if (at == known.end()) {
                known.push_back(value);
                facts_.emplace_back();
            }
            ValueFacts& facts = facts_[run.value];
            facts.faces += run.faces;
            ++facts.runs;
            for (uint32_t k = 1; k < run.faces; ++k) {
                const float sharpness = sharpness_.edges[edgeAt(run.first + k)];
                facts.hardInside = facts.hardInside || sharpness >= kHardSharpness;
                facts.semiSharp += sharpness > 0.0f && sharpness < kHardSharpness ? 1 : 0;
            }
        }
    }

    /// The value stands in two runs, or the surface is sharp inside its run.
    [[nodiscard]] static bool disjoint(const ValueFacts& facts) { return facts.runs > 1 || facts.hardInside; }

    /// Whether all runs round the vertex are corners.
    [[nodiscard]] bool allCorners(uint32_t v) const {
        const bool plus2 = mode_ == UvMode::cornersPlus2, plus = plus2 || mode_ == UvMode::cornersPlus1;
        if (linearBorders() || sharpness_.vertices[v] >= kHardSharpness || (plus && facts_.size() > 2) ||
            (plus2 && facts_.size() == 1 && closed_)) {
            return true;
        }
        if (plus && facts_.size() == 2) {
            const bool single = facts_[0].faces == 1 || facts_[1].faces == 1;
            if (disjoint(facts_[0]) || disjoint(facts_[1]) || (plus2 && single)) {
                return true;
            }
        }
        // Values agree across a fold, so both sides must move alike, and not along it where it ends.
        const bool through = closed_ && runs_.size() == 2 && runs_[0].faces > 1 && runs_[1].faces > 1 && folded_ == 2;
        return folded_ > 0 && !through;
    }

    /// A dart whose other end is a pole.
    [[nodiscard]] bool pointsToPole() const {
        bool found = false;
        for (uint32_t k = 0; k < spokes_ && folds_; ++k) {
            found = found || (channel_.cutEdges[edgeAt(k)] != 0 && poles_[topology_.spokeVertices[base_ + k]] != 0);
        }
        return found && facts_.size() == 1 && closed_ && mode_ != UvMode::none;
    }

    void addVertex(uint32_t v) {
        base_ = topology_.spokeStarts[v];
        spokes_ = topology_.spokeCount(v);
        faces_ = topology_.sectorCount(v);
        closed_ = topology_.boundary[v] == 0;
        findRuns();
        numberValues();
        const bool matches = cuts_ == 0 && (closed_ || !linearBorders());
        const bool all = !matches && (allCorners(v) || pointsToPole());
        const auto first = static_cast<uint32_t>(channel_.values.size());
        for (const CornerRun& run : runs_) {
            const auto index = static_cast<uint32_t>(channel_.values.size());
            const ValueFacts& facts = facts_[run.value];
            const bool corner = all || disjoint(facts) || (facts.faces == 1 && mode_ != UvMode::none);
            channel_.values.emplace_back(uvs_[cornerAt(run.first)]);
            channel_.vertices.push_back(v);
            channel_.rules.push_back(matches  ? UvChannel::Rule::match
                                     : corner ? UvChannel::Rule::corner
                                              : UvChannel::Rule::crease);
            // If one of two values has semi-sharp edges, both go over from corner to crease as these do.
            const bool follows = facts_.size() == 2 && runs_.size() == 2 && facts.semiSharp == 0 &&
                                 facts_[1 - run.value].semiSharp > 0 &&
                                 (mode_ == UvMode::cornersPlus1 || mode_ == UvMode::cornersPlus2);
            channel_.companions.push_back(follows ? first + (index == first ? 1 : 0) : kNone);
            for (uint32_t k = 0; k < run.faces; ++k) {
                channel_.cage.faceVertices[cornerAt(run.first + k)] = index;
            }
        }
    }

    const Cage& cage_;
    const Topology& topology_;
    const UvSharpness& sharpness_;
    std::span<const glm::vec2> uvs_;
    UvMode mode_;
    bool folds_;
    UvChannel channel_;
    std::vector<uint8_t> foldEdges_; ///< per edge
    std::vector<uint8_t> poles_;     ///< per vertex
    // The vertex at work:
    uint32_t base_ = 0, spokes_ = 0, faces_ = 0, cuts_ = 0;
    uint32_t folded_ = 0; ///< edges that are folds
    bool closed_ = true;
    std::vector<CornerRun> runs_;
    std::vector<ValueFacts> facts_; ///< by number of the value
};

} // namespace

Result<UvChannel> buildUvChannel(const Cage& cage, const Topology& topology, const UvSharpness& sharpness,
                                 std::span<const glm::vec2> uvs, UvMode mode, bool folds) {
    return withinMemory("the channel of texture coordinates",
                        [&] { return ChannelBuilder(cage, topology, sharpness, uvs, mode, folds).build(); });
}

} // namespace supple::cage
