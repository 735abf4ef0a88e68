#include "surface/pm/split.h"

#include "surface/pm/mesh.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <utility>

namespace supple::surface::pm {
namespace {

using cage::Cage;
using cage::Topology;

using Diagonal = std::pair<uint32_t, uint32_t>; ///< smaller vertex first

/// Diagonals and quads of a zig-zag split.
uint32_t quadsCutOff(uint32_t sides) {
    return (sides - 4) / 2;
}

class Splitter {
public:
    Splitter(const Cage& given, const Topology& topology) : given_(given), topology_(topology) {}

    Result<SplitCage> run() {
        out_.cage.positions = given_.positions;
        out_.cage.sourceVertices = given_.sourceVertices;
        out_.cage.creases = given_.creases;
        out_.cage.sharpVertices = given_.sharpVertices;
        out_.cage.creaseScalars = given_.creaseScalars;
        out_.cage.faceStarts.push_back(0);
        auto hole = given_.holes.begin();
        for (uint32_t face = 0; face < given_.faceCount(); ++face) {
            const auto firstPart = static_cast<uint32_t>(out_.sourceFaces.size());
            if (std::optional<Error> error = addFace(face)) {
                return std::move(*error);
            }
            if (hole != given_.holes.end() && *hole == face) {
                for (uint32_t part = firstPart; part < out_.sourceFaces.size(); ++part) {
                    out_.cage.holes.push_back(part);
                }
                ++hole;
            }
        }
        return std::move(out_);
    }

private:
    [[nodiscard]] uint32_t corner(uint32_t face, uint32_t k) const {
        return given_.faceStarts[face] + k % given_.sides(face);
    }

    [[nodiscard]] Diagonal diagonal(uint32_t face, uint32_t start, uint32_t a) const {
        const uint32_t v = given_.faceVertices[corner(face, start + a + 1)];
        const uint32_t w = given_.faceVertices[corner(face, start + given_.sides(face) - 2 - a)];
        return {std::min(v, w), std::max(v, w)};
    }

    [[nodiscard]] bool isEdge(const Diagonal& d) const {
        return diagonals_.contains(d) || cage::findEdge(given_, topology_, d.first, d.second) != cage::kNone;
    }

    /// Summed length of the diagonals from a start corner, or nothing where one of them is an edge already.
    [[nodiscard]] std::optional<double> cost(uint32_t face, uint32_t start) const {
        double sum = 0.0;
        for (uint32_t a = 0; a < quadsCutOff(given_.sides(face)); ++a) {
            const Diagonal d = diagonal(face, start, a);
            if (isEdge(d)) {
                return std::nullopt;
            }
            sum += glm::distance(glm::dvec3(given_.positions[d.first]), glm::dvec3(given_.positions[d.second]));
        }
        return sum;
    }

    [[nodiscard]] std::optional<uint32_t> bestStart(uint32_t face) const {
        // Regular polygons have many equal splits whose sums differ by rounding only: the first of them, so that the
        // choice survives a change of units.
        constexpr double kEqual = 1e-6;
        std::optional<uint32_t> best;
        double least = 0.0;
        for (uint32_t start = 0; start < std::min(given_.sides(face), kStartCorners); ++start) {
            const std::optional<double> length = cost(face, start);
            if (length && (!best || *length < least * (1.0 - kEqual))) {
                best = start;
                least = *length;
            }
        }
        return best;
    }

    std::optional<Error> addFace(uint32_t face) {
        const uint32_t sides = given_.sides(face);
        if (sides <= kMaxSides) {
            addPart(face, 0, 0, sides - 1);
            return std::nullopt;
        }
        const std::string name = "face " + std::to_string(face) + " has " + std::to_string(sides) + " sides";
        const std::optional<uint32_t> start = bestStart(face);
        if (!start) {
            return Error{ErrorCode::asset, name + ": every way to split it into quads needs a diagonal that is already "
                                                  "an edge of the cage"};
        }
        const uint32_t cut = quadsCutOff(sides);
        for (uint32_t a = 0; a < cut; ++a) {
            diagonals_.insert(diagonal(face, *start, a));
            const uint32_t far = sides - 1 - a;
            for (const uint32_t k : {a, a + 1, far - 1, far}) {
                addCorner(corner(face, *start + k));
            }
            closePart(face);
        }
        addPart(face, *start, cut, sides - 1 - cut);
        const bool pentagon = sides % 2 != 0;
        const uint32_t quads = pentagon ? cut : cut + 1;
        out_.notes.push_back(name + ": split into " + (quads == 1 ? "a quad" : std::to_string(quads) + " quads") +
                             (pentagon ? " and a pentagon" : ""));
        return std::nullopt;
    }

    /// Corners first..last of the face counted from its corner `start`, as one part.
    void addPart(uint32_t face, uint32_t start, uint32_t first, uint32_t last) {
        for (uint32_t k = first; k <= last; ++k) {
            addCorner(corner(face, start + k));
        }
        closePart(face);
    }

    void addCorner(uint32_t c) {
        Cage& to = out_.cage;
        to.faceVertices.push_back(given_.faceVertices[c]);
        const auto copy = [c](const auto& from, auto& attribute) {
            if (!from.empty()) {
                attribute.push_back(from[c]);
            }
        };
        copy(given_.cornerUvs, to.cornerUvs);
        copy(given_.cornerUvs1, to.cornerUvs1);
        copy(given_.cornerFaceUvs, to.cornerFaceUvs);
        copy(given_.cornerColors, to.cornerColors);
    }

    void closePart(uint32_t face) {
        out_.cage.faceStarts.push_back(out_.cage.cornerCount());
        out_.sourceFaces.push_back(face);
        if (!given_.faceMaterials.empty()) {
            out_.cage.faceMaterials.push_back(given_.faceMaterials[face]);
        }
    }

    const Cage& given_;
    const Topology& topology_;
    std::set<Diagonal> diagonals_; ///< laid so far
    SplitCage out_;
};

} // namespace

Result<SplitCage> splitFaces(const Cage& cage, const Topology& topology) {
    return Splitter(cage, topology).run();
}

} // namespace supple::surface::pm
