#include "surface/pm/mesh.h"

#include "base/within_memory.h"
#include "cage/message.h"
#include "surface/pm/corners.h"
#include "surface/split.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace supple::surface::pm {
namespace {

using cage::Cage;
using cage::Topology;

/// Cuts the faces round every vertex into fans and packs their slots.
class FanBuilder {
public:
    explicit FanBuilder(Mesh& mesh) : mesh_(mesh) { mesh_.corners.resize(mesh_.cage.cornerCount()); }

    void add(uint32_t vertex) {
        const Topology& topology = mesh_.topology;
        base_ = topology.spokeStarts[vertex];
        spokes_ = topology.spokeCount(vertex);
        facets_ = topology.sectorCount(vertex);
        const bool boundary = topology.boundary[vertex] != 0;
        std::vector<uint32_t> hard;
        for (uint32_t k = 0; k < spokes_; ++k) {
            if (mesh_.features.hard(edgeOf(k))) { // a boundary's first and last spoke always are
                hard.push_back(k);
            }
        }
        const bool sharp = mesh_.features.vertexSharpness[vertex] >= cage::kHardSharpness;
        if (!boundary && hard.size() < 2) {
            addFan(vertex, FanKind::interior, 0, facets_, sharp);
            return;
        }
        const bool corner = sharp || hard.size() != 2 || (boundary && facets_ == 1);
        const FanKind kind = corner ? FanKind::corner : FanKind::crease;
        const size_t runs = boundary ? hard.size() - 1 : hard.size();
        for (size_t i = 0; i < runs; ++i) {
            const uint32_t last = i + 1 < hard.size() ? hard[i + 1] : hard[0] + facets_;
            addFan(vertex, kind, hard[i], last - hard[i], false);
        }
    }

private:
    /// Counted round the vertex, at most once.
    [[nodiscard]] uint32_t wrapped(uint32_t spoke) const { return spoke < spokes_ ? spoke : spoke - spokes_; }

    [[nodiscard]] uint32_t edgeOf(uint32_t spoke) const {
        return cage::spokeEdge(mesh_.cage, mesh_.topology, base_ + spoke);
    }

    /// Spokes first, first + 1, ... round the vertex.
    void addFan(uint32_t vertex, FanKind kind, uint32_t first, uint32_t facets, bool pinned) {
        const auto index = static_cast<uint32_t>(mesh_.fans.size());
        Fan fan{.vertex = vertex,
                .firstSlot = static_cast<uint32_t>(mesh_.slotSpokes.size()),
                .facets = facets,
                .kind = kind,
                .pinned = pinned};
        for (uint32_t j = 0; j < fan.edges(); ++j) {
            const uint32_t spoke = wrapped(first + j);
            const bool end = !fan.closed() && (j == 0 || j == facets);
            const double alpha = end ? kSmoothAlpha : alphaOf(spoke);
            fan.creased = fan.creased || alpha != kSmoothAlpha;
            const uint32_t set = end ? cage::kNone : setOf(spoke);
            fan.variable = fan.variable || set != cage::kNone;
            mesh_.slotSpokes.push_back(base_ + spoke);
            mesh_.slotAlphas.push_back(alpha);
            mesh_.slotSets.push_back(set);
            mesh_.slotGivens.push_back(mesh_.features.spokeAlphas[base_ + spoke] >= 0.0f ? 1 : 0);
        }
        for (uint32_t j = 0; j < facets; ++j) {
            const uint32_t slot = fan.firstSlot;
            const uint32_t next = fan.closed() ? (j + 1) % facets : j + 1;
            FacetCorner& corner = mesh_.corners[mesh_.topology.sectorCorners[base_ + wrapped(first + j)]];
            corner.fan = index;
            corner.slot = slot + j;
            corner.slotBack = slot + next;
            if (fan.closed() || j > 0) {
                corner.across = slot + (j + facets - 1) % facets;
            }
            if (next < facets) {
                corner.acrossBack = slot + next;
            }
        }
        addRims(fan);
        mesh_.fans.push_back(fan);
    }

    /// 0 for an edge that is smooth, or whose alpha the cage gives, up to 1 for a sharp one. Ends of open fans are
    /// cuts, and no edges of a rim.
    [[nodiscard]] double sharpness(const Fan& fan, uint32_t j) const {
        const uint32_t slot = fan.firstSlot + j;
        const bool end = !fan.closed() && (j == 0 || j == fan.facets);
        return end || mesh_.slotGivens[slot] != 0 ? 0.0 : 1.0 - mesh_.slotAlphas[slot] / kSmoothAlpha;
    }

    void addRims(const Fan& fan) {
        for (uint32_t j = 0; j < fan.edges(); ++j) {
            double rim = 1.0 / 6.0;
            const uint32_t next = j + 1 < fan.edges() ? j + 1 : 0;
            for (uint32_t k = 0; k < fan.edges(); ++k) {
                rim *= k == j || k == next ? sharpness(fan, k) : 1.0 - sharpness(fan, k);
            }
            mesh_.slotRims.push_back(fan.creased && j < fan.facets ? rim : 0.0);
        }
    }

    /// Alpha at this vertex of an edge inside a fan. The one hard edge at a dart's tip is as smooth as the others.
    [[nodiscard]] double alphaOf(uint32_t spoke) const {
        const float given = mesh_.features.spokeAlphas[base_ + spoke];
        if (given >= 0.0f) {
            return given == static_cast<float>(kSmoothAlpha) ? kSmoothAlpha : std::max<double>(given, kLeastAlpha);
        }
        const uint32_t edge = edgeOf(spoke);
        return mesh_.features.hard(edge) ? kSmoothAlpha : alphaOfSharpness(mesh_.features.edgeSharpness[edge]);
    }

    /// Hard edges are cut, whatever instances say.
    [[nodiscard]] uint32_t setOf(uint32_t spoke) const {
        const uint32_t edge = edgeOf(spoke);
        return mesh_.features.edgeSets.empty() || mesh_.features.hard(edge) ? cage::kNone
                                                                            : mesh_.features.edgeSets[edge];
    }

    Mesh& mesh_;
    uint32_t base_ = 0; ///< of the vertex at work: first spoke slot, spokes, facets
    uint32_t spokes_ = 0;
    uint32_t facets_ = 0;
};

/// Whether the facets round a vertex could be polar patches, were it not for other such vertices near.
bool couldBeApex(const Mesh& mesh, uint32_t vertex) {
    const Topology& topology = mesh.topology;
    if (topology.boundary[vertex] != 0) {
        return false;
    }
    for (uint32_t s = topology.spokeStarts[vertex]; s < topology.spokeStarts[vertex + 1]; ++s) {
        const uint32_t corner = topology.sectorCorners[s];
        const uint32_t facet = topology.cornerFaces[corner];
        if (mesh.features.hard(topology.cornerEdges[corner]) || mesh.cage.sides(facet) != 3) {
            return false;
        }
        const uint32_t next = cage::nextCorner(mesh.cage, facet, corner);
        for (const uint32_t outer : {next, cage::nextCorner(mesh.cage, facet, next)}) {
            const Fan& fan = mesh.fans[mesh.corners[outer].fan];
            if (!fan.regular() || fan.kind == FanKind::corner) {
                return false;
            }
        }
    }
    return true;
}

std::vector<uint8_t> polarApexes(const Mesh& mesh) {
    const Topology& topology = mesh.topology;
    std::vector<uint8_t> candidates(mesh.cage.vertexCount(), 0);
    for (uint32_t v = 0; v < mesh.cage.vertexCount(); ++v) {
        candidates[v] = couldBeApex(mesh, v) ? 1 : 0;
    }
    std::vector<uint8_t> apexes = candidates;
    for (uint32_t v = 0; v < mesh.cage.vertexCount(); ++v) {
        for (uint32_t s = topology.spokeStarts[v]; s < topology.spokeStarts[v + 1]; ++s) {
            if (candidates[topology.spokeVertices[s]] != 0) {
                apexes[v] = 0;
            }
        }
    }
    return apexes;
}

void classify(Mesh& mesh) {
    const std::vector<uint8_t> apexes = polarApexes(mesh);
    mesh.classes.assign(mesh.cage.faceCount(), PatchClass::p5);
    mesh.firstCorners.assign(mesh.cage.faceCount(), 0);
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        const uint32_t first = mesh.cage.faceStarts[f];
        const uint32_t sides = mesh.cage.sides(f);
        if (sides == 3) {
            mesh.classes[f] = PatchClass::p3;
            for (uint32_t j = 0; j < 3; ++j) {
                if (apexes[mesh.cage.faceVertices[first + j]] != 0) {
                    mesh.classes[f] = PatchClass::polar;
                    mesh.firstCorners[f] = static_cast<uint8_t>((j + 1) % 3);
                }
            }
        } else if (sides == 4) {
            const bool regular = std::all_of(mesh.corners.begin() + first, mesh.corners.begin() + first + 4,
                                             [&](const FacetCorner& c) { return mesh.fans[c.fan].regular(); });
            mesh.classes[f] = regular ? PatchClass::regular : PatchClass::p4;
        }
    }
}

/// Edges of crease sets that instances cannot change.
std::vector<std::string> hardInSets(const Mesh& mesh) {
    const std::vector<uint32_t>& sets = mesh.features.edgeSets;
    std::vector<cage::Found> found(mesh.cage.creaseSets.size());
    for (uint32_t e = 0; e < sets.size(); ++e) {
        if (sets[e] != cage::kNone && mesh.features.hard(e)) {
            const uint32_t corner = mesh.topology.edges[e].corner;
            const uint32_t next = cage::nextCorner(mesh.cage, mesh.topology.cornerFaces[corner], corner);
            found[sets[e]].add([&] {
                return "edge (" + std::to_string(mesh.cage.faceVertices[corner]) + ", " +
                       std::to_string(mesh.cage.faceVertices[next]) + ")";
            });
        }
    }
    std::vector<std::string> notes;
    for (size_t set = 0; set < found.size(); ++set) {
        if (found[set].count > 0) {
            notes.push_back("crease set " + cage::quoted(mesh.cage.creaseSets[set]) + ": " +
                            found[set].told("edge is hard or a boundary", "edges are hard or boundaries") +
                            ", which no instance can change");
        }
    }
    return notes;
}

void fill(Mesh& mesh) {
    mesh.features = cage::buildFeatures(mesh.cage, mesh.topology);
    mesh.notes.insert(mesh.notes.end(), mesh.features.unused.begin(), mesh.features.unused.end());
    if (const std::string corners = cage::sharpRoundCorners(mesh.cage); !corners.empty()) {
        mesh.notes.push_back(corners);
    }
    for (std::string& note : hardInSets(mesh)) {
        mesh.notes.push_back(std::move(note));
    }
    FanBuilder fans(mesh);
    for (uint32_t v = 0; v < mesh.cage.vertexCount(); ++v) {
        fans.add(v);
    }
    shapeCorners(mesh);
    classify(mesh);
}

/// Zig-zag diagonals: from a start corner r the quads r+a, r+a+1, r-2-a, r-1-a for a = 0, 1, .., until four or five
/// corners are left.
FaceCut zigzagCut(uint32_t sides) {
    FaceCut cut;
    const uint32_t quads = (sides - 4) / 2;
    for (uint32_t a = 0; a < quads; ++a) {
        const uint32_t far = sides - 1 - a;
        cut.parts.push_back({a, a + 1, far - 1, far});
        cut.diagonals.push_back({a + 1, far - 1});
    }
    std::vector<uint32_t>& rest = cut.parts.emplace_back();
    for (uint32_t k = quads; k < sides - quads; ++k) {
        rest.push_back(k);
    }
    return cut;
}

/// P_m has no patch for more than five sides.
constexpr SplitRule kZigzag{
    .mostSides = kMaxSides, .cut = zigzagCut, .startCorners = 256, .shortest = true, .parts = "quads and pentagons"};

Result<Mesh> build(const Cage& cage) {
    Result<SplitCage> split = splitFaces(cage, &kZigzag);
    if (!split) {
        return split.error();
    }
    Mesh mesh;
    mesh.cage = std::move(split->cage);
    mesh.topology = std::move(split->topology);
    mesh.sourceFaces = std::move(split->sourceFaces);
    mesh.notes = std::move(split->notes);
    fill(mesh);
    return mesh;
}

} // namespace

double alphaOfSharpness(double sharpness) {
    return std::clamp(kSmoothAlpha * std::exp2(-sharpness), kLeastAlpha, 1.0);
}

FacetAngle Fan::angle() const {
    if (kind == FanKind::interior) {
        return {1, facets};
    }
    if (kind != FanKind::corner) {
        return {1, 2 * facets};
    }
    const uint32_t common = std::gcd(uint32_t{width}, 12 * facets);
    return {width / common, 12 * facets / common};
}

bool Fan::regular() const {
    // The tangents inside corners and straight fans come from their ends, and not from f.
    const bool fromEnds = kind == FanKind::straight || (kind == FanKind::corner && facets > 1);
    return !fromEnds && angle() == FacetAngle{1, 4};
}

Result<Mesh> buildMesh(const Cage& cage) {
    return withinMemory("the facets and fans of P_m", [&] { return build(cage); });
}

} // namespace supple::surface::pm
