#include "cage/repair/fans.h"

#include <algorithm>
#include <utility>

namespace supple::cage::repair {
namespace {

class FanSeparator {
public:
    FanSeparator(Draft& draft, std::vector<uint32_t>& twins)
        : draft_(draft), twins_(twins), faces_(cornerFaces(draft)), visited_(draft.cornerCount(), 0),
          places_(draft.vertexCount(), kNone) {}

    /// Returns how many fans there are. `corners`: all of the vertex, rising.
    size_t separate(const uint32_t* corners, uint32_t count) {
        fans_.clear();
        for (uint32_t i = 0; i < count; ++i) {
            if (visited_[corners[i]] == 0) {
                cutFan(collect(corners[i]));
            }
        }
        std::sort(fans_.begin(), fans_.end(), [](const Fan& x, const Fan& y) { return x.lowest < y.lowest; });
        for (size_t i = 1; i < fans_.size(); ++i) {
            const uint32_t copy = draft_.copyVertex(draft_.vertices[corners[0]]);
            places_.push_back(kNone);
            for (const uint32_t c : fans_[i].sectors) {
                draft_.vertices[c] = copy;
            }
        }
        return fans_.size();
    }

private:
    struct Fan {
        std::vector<uint32_t> sectors; ///< corners
        uint32_t lowest = 0;
    };

    /// The side that ends at a corner.
    [[nodiscard]] uint32_t back(uint32_t corner) const { return draft_.previous(faces_[corner], corner); }
    /// The vertices at the far ends of the sides that begin and end at a corner.
    [[nodiscard]] uint32_t ahead(uint32_t corner) const { return draft_.vertices[draft_.next(faces_[corner], corner)]; }
    [[nodiscard]] uint32_t behind(uint32_t corner) const { return draft_.vertices[back(corner)]; }

    /// The sectors round a vertex, counter-clockwise: all round, or from one side of the boundary to the other.
    std::vector<uint32_t> collect(uint32_t corner) {
        uint32_t first = corner;
        for (uint32_t across = twins_[first]; across != kNone; across = twins_[first]) {
            first = draft_.next(faces_[across], across);
            if (first == corner) {
                break;
            }
        }
        std::vector<uint32_t> sectors;
        for (uint32_t c = first; c != kNone; c = twins_[back(c)]) {
            sectors.push_back(c);
            visited_[c] = 1;
            if (twins_[back(c)] == first) {
                break;
            }
        }
        return sectors;
    }

    /// Cuts a fan where its spokes lead to the same vertex.
    void cutFan(const std::vector<uint32_t>& sectors) {
        open_.clear();
        for (const uint32_t sector : sectors) {
            const uint32_t vertex = ahead(sector);
            if (places_[vertex] != kNone) {
                closeLoop(places_[vertex], sector);
            }
            places_[vertex] = static_cast<uint32_t>(open_.size());
            open_.push_back(sector);
        }
        const uint32_t last = sectors.back();
        if (twins_[back(last)] == kNone && places_[behind(last)] != kNone) {
            closeLoop(places_[behind(last)], kNone);
        }
        take(0);
    }

    /// Joins the sectors from a place on to a fan that closes, and what is before them to the sector behind, if there
    /// is one.
    void closeLoop(size_t first, uint32_t behindLoop) {
        const uint32_t begin = open_[first];
        const uint32_t end = back(open_.back());
        const uint32_t before = twins_[begin];
        twins_[begin] = end;
        twins_[end] = begin;
        if (before != kNone) {
            twins_[before] = behindLoop;
        }
        if (behindLoop != kNone) {
            twins_[behindLoop] = before;
        }
        take(first);
    }

    void take(size_t first) {
        if (first == open_.size()) {
            return;
        }
        Fan& fan = fans_.emplace_back();
        fan.sectors.assign(open_.begin() + static_cast<ptrdiff_t>(first), open_.end());
        fan.lowest = *std::min_element(fan.sectors.begin(), fan.sectors.end());
        for (const uint32_t sector : fan.sectors) {
            places_[ahead(sector)] = kNone;
        }
        open_.resize(first);
    }

    Draft& draft_;
    std::vector<uint32_t>& twins_;
    const std::vector<uint32_t> faces_; ///< per corner
    std::vector<uint8_t> visited_;      ///< per corner
    std::vector<uint32_t> open_;        ///< sectors of the fan at work that no loop has taken yet
    std::vector<uint32_t> places_;      ///< per vertex: of the spoke that leads there, in open_
    std::vector<Fan> fans_;             ///< of the vertex at work
};

} // namespace

void separateFans(Draft& draft, std::vector<uint32_t>& twins, const std::vector<uint8_t>& atCut, const Places& places,
                  FanDamage& damage) {
    const std::vector<uint32_t> faces = cornerFaces(draft);
    const VertexCorners of = vertexCorners(draft);
    const uint32_t vertexCount = draft.vertexCount();
    FanSeparator separator(draft, twins);
    for (uint32_t v = 0; v < vertexCount; ++v) {
        const size_t fans = separator.separate(of.corners.data() + of.starts[v], of.count(v));
        if (fans < 2) {
            continue;
        }
        const uint32_t corner = of.corners[of.starts[v]];
        const uint32_t face = draft.faces[faces[corner]];
        if (v < atCut.size() && atCut[v] != 0) {
            damage.copiesAtCuts[places.partOf(face)] += fans - 1;
        } else {
            draft.sharpVertices.push_back({draft.sources[v], kHardSharpness});
            damage.bowTies.add(places, face, [&] {
                return places.vertex(draft.corners[corner]) + " of " + std::to_string(fans) + " fans";
            });
        }
    }
}

} // namespace supple::cage::repair
