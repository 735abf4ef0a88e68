#include "surface/split.h"

#include "cage/message.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace supple::surface {
namespace {

using cage::Cage;
using cage::Topology;

using Diagonal = std::pair<uint32_t, uint32_t>; ///< smaller vertex first

class Splitter {
public:
    Splitter(const Cage& given, const Topology& topology, const SplitRule& rule, SplitCage& out)
        : given_(given), topology_(topology), rule_(rule), out_(out) {}

    Status run() {
        out_.cage.positions = given_.positions;
        out_.cage.sourceVertices = given_.sourceVertices;
        out_.cage.creases = given_.creases;
        out_.cage.creaseSets = given_.creaseSets;
        out_.cage.sharpVertices = given_.sharpVertices;
        out_.cage.creaseScalars = given_.creaseScalars;
        out_.cage.roundCorners = given_.roundCorners;
        out_.cage.faceStarts.push_back(0);
        for (uint32_t face = 0; face < given_.faceCount(); ++face) {
            if (const Status added = addFace(face); !added) {
                return added;
            }
        }
        if (splits_.count > 0) {
            const std::string sides = " more than " + std::to_string(rule_.mostSides) + " sides";
            out_.notes.push_back(splits_.told(("face has" + sides).c_str(), ("faces have" + sides).c_str()) +
                                 "; split into " + rule_.parts);
        }
        return success();
    }

private:
    [[nodiscard]] uint32_t corner(uint32_t face, uint32_t k) const {
        return given_.faceStarts[face] + k % given_.sides(face);
    }

    [[nodiscard]] Diagonal diagonal(uint32_t face, uint32_t start, const std::array<uint32_t, 2>& ends) const {
        const uint32_t v = given_.faceVertices[corner(face, start + ends[0])];
        const uint32_t w = given_.faceVertices[corner(face, start + ends[1])];
        return {std::min(v, w), std::max(v, w)};
    }

    /// Summed length of the diagonals from a start corner, or nothing where one of them is an edge already.
    [[nodiscard]] std::optional<double> cost(uint32_t face, uint32_t start, const FaceCut& cut) const {
        double sum = 0.0;
        for (const std::array<uint32_t, 2>& ends : cut.diagonals) {
            const auto [v, w] = diagonal(face, start, ends);
            if (diagonals_.contains({v, w}) || cage::findEdge(given_, topology_, v, w) != cage::kNone) {
                return std::nullopt;
            }
            sum += glm::distance(glm::dvec3(given_.positions[v]), glm::dvec3(given_.positions[w]));
        }
        return sum;
    }

    [[nodiscard]] std::optional<uint32_t> bestStart(uint32_t face, const FaceCut& cut) const {
        // Regular polygons have many equal splits whose sums differ by rounding only: the first of them, so that the
        // choice survives a change of units.
        constexpr double kEqual = 1e-6;
        const uint32_t starts = std::min(given_.sides(face), rule_.startCorners);
        std::optional<uint32_t> best;
        double least = 0.0;
        for (uint32_t start = 0; start < starts && (rule_.shortest || !best); ++start) {
            const std::optional<double> length = cost(face, start, cut);
            if (length && (!best || *length < least * (1.0 - kEqual))) {
                best = start;
                least = *length;
            }
        }
        return best;
    }

    Status addFace(uint32_t face) {
        const uint32_t sides = given_.sides(face);
        const auto [known, isNew] = cuts_.try_emplace(sides);
        FaceCut& cut = known->second;
        if (isNew && sides > rule_.mostSides) {
            cut = rule_.cut(sides);
        } else if (isNew) {
            std::vector<uint32_t>& whole = cut.parts.emplace_back(sides);
            std::iota(whole.begin(), whole.end(), 0u);
        }
        const std::optional<uint32_t> start = cut.diagonals.empty() ? 0 : bestStart(face, cut);
        const auto name = [&] { return "face " + std::to_string(face) + " has " + std::to_string(sides) + " sides"; };
        if (!start) {
            return Error{ErrorCode::asset, name() + ": every way to split it into " + rule_.parts +
                                               " needs a diagonal that is already an edge of the cage"};
        }
        for (const std::array<uint32_t, 2>& ends : cut.diagonals) {
            diagonals_.insert(diagonal(face, *start, ends));
        }
        for (const std::vector<uint32_t>& part : cut.parts) {
            addPart(face, *start, part);
        }
        if (sides > rule_.mostSides) {
            splits_.add([&] { return "face " + std::to_string(face); });
        }
        return success();
    }

    void addPart(uint32_t face, uint32_t start, const std::vector<uint32_t>& part) {
        for (const uint32_t k : part) {
            const uint32_t c = corner(face, start + k);
            out_.cage.faceVertices.push_back(given_.faceVertices[c]);
            forEachCornerAttribute(given_, out_.cage, [&](const auto& from, auto& to) {
                if (!from.empty()) {
                    to.push_back(from[c]);
                }
            });
        }
        closeFace(out_.cage, given_, face);
        out_.sourceFaces.push_back(face);
    }

    const Cage& given_;
    const Topology& topology_;
    const SplitRule& rule_;
    SplitCage& out_;
    std::map<uint32_t, FaceCut> cuts_; ///< by number of sides
    std::set<Diagonal> diagonals_;     ///< laid so far
    cage::Found splits_;
};

} // namespace

Result<SplitCage> splitFaces(const Cage& cage, const SplitRule* rule) {
    Result<Topology> topology = cage::buildTopology(cage);
    if (!topology) {
        return topology.error();
    }
    uint32_t most = 0;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        most = std::max(most, cage.sides(face));
    }
    SplitCage out;
    if (rule == nullptr || most <= rule->mostSides) {
        out.cage = cage;
        out.sourceFaces.resize(cage.faceCount());
        std::iota(out.sourceFaces.begin(), out.sourceFaces.end(), 0u);
    } else {
        if (const Status split = Splitter(cage, *topology, *rule, out).run(); !split) {
            return split.error();
        }
        topology = cage::buildTopology(out.cage);
        if (!topology) {
            return topology.error();
        }
    }
    out.topology = std::move(*topology);
    return out;
}

void closeFace(Cage& to, const Cage& from, uint32_t face) {
    if (std::binary_search(from.holes.begin(), from.holes.end(), face)) {
        to.holes.push_back(to.faceCount());
    }
    to.faceStarts.push_back(to.cornerCount());
    if (!from.faceMaterials.empty()) {
        to.faceMaterials.push_back(from.faceMaterials[face]);
    }
    if (!from.faceParts.empty()) {
        to.faceParts.push_back(from.faceParts[face]);
    }
}

} // namespace supple::surface
