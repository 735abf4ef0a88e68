#include "runtime/queries/query_pieces.h"

#include "runtime/points/point_domains.h"
#include "runtime/queries/piece_fit.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

namespace supple::runtime {
namespace {

using namespace shared;

/// A polynomial is near enough if the weights of its points differ from the surface's by this much in sum: then it lies
/// within that part of the size of the vertices around it.
constexpr double kNearEnough = 1e-3;
/// How often parts that are not near enough are quartered: to this part of a face's side.
constexpr double kLeastSize = 0.25;
/// What hangs on more vertices is not quartered: its table would be large.
constexpr size_t kMostToQuarter = 64;
constexpr size_t kMostVertices = 4096;
/// Shares are multiples of this, so that pieces of one kind have the same.
constexpr double kShareUnit = 0x1p-26;

struct FittedPart {
    FacePart part;
    PieceFit fit;
};

/// A way to cut a face, tried.
struct Cut {
    std::vector<FittedPart> parts;
    double missed = 0.0; ///< share of the parts that are not near enough
    double error = 0.0;

    [[nodiscard]] bool isBetterThan(const Cut& other) const {
        return std::pair(missed, error) < std::pair(other.missed, other.error);
    }
};

/// Packs pieces as they are found.
class PieceWriter {
public:
    explicit PieceWriter(uint64_t mostElements) : mostElements_(mostElements) {}

    Status add(const FittedPart& fitted) {
        std::vector<VertexShares> vertices = rounded(fitted.fit.vertices);
        if (vertices.size() > kMostVertices) {
            return Error{ErrorCode::limit, "face " + std::to_string(fitted.part.face) + " hangs on " +
                                               std::to_string(vertices.size()) + " vertices of the cage: the most is " +
                                               std::to_string(kMostVertices)};
        }
        const float reach = reachOf(vertices);
        reach_ = std::max(reach_, reach);
        putHead(fitted.part, static_cast<uint32_t>(vertices.size()), reach, sharesElement(vertices));
        for (size_t k = 0; k < (vertices.size() + 3) / 4 * 4; ++k) {
            vertices_.push_back(vertices[std::min(k, vertices.size() - 1)].vertex);
        }
        ++pieceCount_;
        const uint64_t elements = (heads_.size() + vertices_.size() + shares_.size()) / 4;
        return elements <= mostElements_
                   ? success()
                   : Status(Error{ErrorCode::limit, "the pieces of its surfaces are more than " +
                                                        std::to_string(mostElements_) + " elements of 16 bytes"});
    }
    [[nodiscard]] uint32_t pieceCount() const { return pieceCount_; }
    PieceTable finish() {
        // The vertices of all pieces stand behind the heads, then all shares.
        const auto firstVertex = static_cast<uint32_t>(heads_.size() / 4),
                   firstShare = firstVertex + static_cast<uint32_t>(vertices_.size() / 4);
        for (size_t head = 0; head < heads_.size(); head += size_t{4} * kPieceElements) {
            heads_[head + 2] += firstVertex;
            heads_[head + 3] += firstShare;
        }
        PieceTable table{std::move(heads_), {}, pieceCount_, reach_};
        table.words.insert(table.words.end(), vertices_.begin(), vertices_.end());
        table.words.insert(table.words.end(), shares_.begin(), shares_.end());
        return table;
    }

private:
    /// In an order that follows from the shares alone, without vertices that have none.
    static std::vector<VertexShares> rounded(std::vector<VertexShares> vertices) {
        for (VertexShares& own : vertices) {
            for (double& share : own.of) {
                share = std::nearbyint(share / kShareUnit) * kShareUnit + 0.0;
            }
        }
        std::erase_if(vertices, [](const VertexShares& own) {
            return std::all_of(own.of.begin(), own.of.end(), [](double share) { return share == 0.0; });
        });
        std::stable_sort(vertices.begin(), vertices.end(),
                         [](const VertexShares& a, const VertexShares& b) { return a.of > b.of; });
        return vertices;
    }
    /// How far coefficients may lie outside the box of the vertices, as a part of its size.
    static float reachOf(std::span<const VertexShares> vertices) {
        double most = 0.0;
        for (size_t k = 0; k < kPieceCoefficients; ++k) {
            double outside = 0.0;
            for (const VertexShares& own : vertices) {
                outside += std::max(-own.of[k], 0.0);
            }
            most = std::max(most, outside);
        }
        return static_cast<float>(most + 1e-6);
    }
    static uint32_t bits(double value) { return std::bit_cast<uint32_t>(static_cast<float>(value)); }
    /// Where the shares stand, which may be those of a piece before.
    uint32_t sharesElement(std::span<const VertexShares> vertices) {
        const size_t first = shares_.size();
        uint64_t hash = vertices.size();
        for (const VertexShares& own : vertices) {
            for (const double share : own.of) {
                shares_.push_back(bits(share));
                hash = (hash ^ shares_.back()) * 0x100000001B3u;
            }
        }
        const auto own = std::span(shares_).subspan(first);
        const auto [begin, end] = known_.equal_range(hash);
        for (auto known = begin; known != end; ++known) {
            if (known->second + own.size() <= first &&
                std::equal(own.begin(), own.end(), shares_.begin() + static_cast<ptrdiff_t>(known->second))) {
                const auto element = static_cast<uint32_t>(known->second / 4);
                shares_.resize(first);
                return element;
            }
        }
        known_.emplace(hash, first);
        return static_cast<uint32_t>(first / 4);
    }
    void putHead(const FacePart& part, uint32_t vertexCount, float reach, uint32_t shares) {
        const uint32_t kind = part.isSquare ? kSquarePiece : kTrianglePiece;
        const FacePart::Half &first = part.first, &second = part.second;
        const auto put = [&](uint32_t x, uint32_t y, uint32_t z, uint32_t w) {
            heads_.insert(heads_.end(), {x, y, z, w});
        };
        put(part.face, kind | vertexCount << kPieceVerticesShift, static_cast<uint32_t>(vertices_.size() / 4), shares);
        put(bits(part.corner.x), bits(part.corner.y), bits(part.size), std::bit_cast<uint32_t>(reach));
        put(bits(first.at.x), bits(first.at.y), bits(first.gain.x), bits(first.gain.y));
        put(bits(first.diagonal.x), bits(first.diagonal.y), first.side, second.side);
        put(bits(second.at.x), bits(second.at.y), bits(second.gain.x), bits(second.gain.y));
        put(bits(second.diagonal.x), bits(second.diagonal.y), 0, 0);
    }

    uint64_t mostElements_;
    uint32_t pieceCount_ = 0;
    float reach_ = 0.0f;
    std::vector<uint32_t> heads_, vertices_, shares_;
    std::unordered_multimap<uint64_t, size_t> known_; ///< by a hash of shares, where they begin
};

class PieceBuilder {
public:
    PieceBuilder(const CpuGroup& group, uint64_t mostElements)
        : fitter_(group), writer_(mostElements), ofFaces_(group.cage().faceCount()) {}

    Status add(uint32_t face, uint32_t sides) {
        const uint32_t first = writer_.pieceCount();
        for (const FittedPart& fitted : cut(face, sides).parts) {
            if (Status added = add(fitted, fitted.part.size); !added) {
                return added;
            }
        }
        ofFaces_[face] = {first, writer_.pieceCount() - first};
        return success();
    }
    PieceTable finish() {
        PieceTable table = writer_.finish();
        table.ofFaces = std::move(ofFaces_);
        return table;
    }

private:
    static bool isNearEnough(const PieceFit& fit) { return fit.error <= kNearEnough; }
    Status add(const FittedPart& fitted, double size) {
        if (isNearEnough(fitted.fit) || size <= kLeastSize || fitted.fit.vertices.size() > kMostToQuarter) {
            return writer_.add(fitted);
        }
        for (const FacePart& quarter : fitted.part.quarters()) {
            if (Status added = add({quarter, fitter_.fit(quarter)}, 0.5 * size); !added) {
                return added;
            }
        }
        return success();
    }
    [[nodiscard]] Cut tried(const std::vector<FacePart>& parts) {
        Cut cut;
        for (const FacePart& part : parts) {
            cut.parts.push_back({part, fitter_.fit(part)});
            const PieceFit& fit = cut.parts.back().fit;
            cut.missed += isNearEnough(fit) ? 0.0 : 1.0 / static_cast<double>(parts.size());
            cut.error = std::max(cut.error, fit.error);
        }
        return cut;
    }
    /// The best way to cut a face. The first that will do is taken, and first the way of the face before.
    Cut cut(uint32_t face, uint32_t sides) {
        const std::vector<std::vector<FacePart>> ways = waysToCut(face, sides);
        Cut best = tried(ways[0]);
        size_t& last = lastWay_[std::min(sides, kMostSides)];
        const size_t before = last;
        for (size_t k = 0; k < ways.size() && best.missed > 0.0; ++k) {
            const size_t way = k == 0 ? before : k == before ? 0 : k;
            if (way == 0) {
                continue;
            }
            Cut own = tried(ways[way]);
            if (own.isBetterThan(best)) {
                best = std::move(own);
                last = way;
            }
            if (best.missed <= kMissedByCorners) {
                break;
            }
        }
        return best;
    }
    static constexpr uint32_t kMostSides = 5; ///< faces of more are cut as faces of so many
    /// Half of the parts lie at extraordinary vertices.
    static constexpr double kMissedByCorners = 0.5;

    PieceFitter fitter_;
    PieceWriter writer_;
    std::vector<FacePieces> ofFaces_;
    std::array<size_t, kMostSides + 1> lastWay_{}; ///< by number of sides
};

} // namespace

Result<PieceTable> pieceTable(const CpuGroup& group, uint64_t mostElements) {
    PieceBuilder builder(group, mostElements);
    std::optional<uint32_t> last;
    for (const PointDomain& domain : pointDomains(group)) {
        if (last == domain.face) {
            continue; // another side of the same
        }
        last = domain.face;
        if (Status added = builder.add(domain.face, group.cage().sides(domain.face)); !added) {
            return added.error();
        }
    }
    return builder.finish();
}

} // namespace supple::runtime
