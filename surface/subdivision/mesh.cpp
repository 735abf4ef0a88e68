#include "surface/subdivision/mesh.h"

#include "base/within_memory.h"
#include "surface/subdivision/pattern.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

namespace supple::surface::subdivision {
namespace {

using cage::Cage;
using cage::kNone;
using cage::Topology;

// ---- the faces that come in ----

/// Every face a fan of triangles: from its first corner, unless diagonals from there are edges already.
class TriangleSplitter {
public:
    TriangleSplitter(const Level& given, const Topology& topology) : given_(given), topology_(topology) {}

    std::optional<Error> run() {
        out_.cage.positions = given_.cage.positions;
        out_.cage.faceStarts.push_back(0);
        for (uint32_t face = 0; face < given_.cage.faceCount(); ++face) {
            if (std::optional<Error> error = addFace(face)) {
                return error;
            }
        }
        if (splits_ > kListedSplits) {
            notes_.push_back("and " + std::to_string(splits_ - kListedSplits) +
                             " more faces of four and more sides: split into triangles");
        }
        return std::nullopt;
    }

    Level out() { return std::move(out_); }
    std::vector<std::string> notes() { return std::move(notes_); }

private:
    static constexpr uint32_t kStartCorners = 64; ///< tried at most
    static constexpr uint32_t kListedSplits = 16;

    [[nodiscard]] uint32_t corner(uint32_t face, uint32_t k) const {
        return given_.cage.faceStarts[face] + k % given_.cage.sides(face);
    }

    /// From corner `start` to corner start + k, smaller vertex first.
    [[nodiscard]] std::pair<uint32_t, uint32_t> diagonal(uint32_t face, uint32_t start, uint32_t k) const {
        const uint32_t a = given_.cage.faceVertices[corner(face, start)];
        const uint32_t b = given_.cage.faceVertices[corner(face, start + k)];
        return {std::min(a, b), std::max(a, b)};
    }

    [[nodiscard]] bool isFree(uint32_t face, uint32_t start) const {
        for (uint32_t k = 2; k + 1 < given_.cage.sides(face); ++k) {
            const auto [a, b] = diagonal(face, start, k);
            if (diagonals_.contains({a, b}) || cage::findEdge(given_.cage, topology_, a, b) != kNone) {
                return false;
            }
        }
        return true;
    }

    std::optional<Error> addFace(uint32_t face) {
        const uint32_t sides = given_.cage.sides(face);
        const std::string name = "face " + std::to_string(face) + " has " + std::to_string(sides) + " sides";
        uint32_t start = 0;
        while (!isFree(face, start)) {
            if (++start == std::min(sides, kStartCorners)) {
                return Error{ErrorCode::asset, name + ": every way to split it into a fan of triangles needs a "
                                                      "diagonal that is already an edge of the cage"};
            }
        }
        for (uint32_t k = 1; k + 1 < sides; ++k) {
            if (k > 1) {
                diagonals_.insert(diagonal(face, start, k));
            }
            for (const uint32_t c : {corner(face, start), corner(face, start + k), corner(face, start + k + 1)}) {
                out_.cage.faceVertices.push_back(given_.cage.faceVertices[c]);
                forEachCornerAttribute(given_.cage, out_.cage, [&](const auto& from, auto& to) {
                    if (!from.empty()) {
                        to.push_back(from[c]);
                    }
                });
            }
            closeFace(out_, given_, face);
        }
        if (sides > 3 && ++splits_ <= kListedSplits) {
            notes_.push_back(name + ": split into " + std::to_string(sides - 2) + " triangles" +
                             (start > 0 ? " from corner " + std::to_string(start) : ""));
        }
        return std::nullopt;
    }

    const Level& given_;
    const Topology& topology_;
    std::set<std::pair<uint32_t, uint32_t>> diagonals_; ///< laid so far
    uint32_t splits_ = 0;
    Level out_;
    std::vector<std::string> notes_;
};

// ---- fragments ----

/// Cuts the isolated level into fragments, by the topology of its parent.
class FragmentBuilder {
public:
    FragmentBuilder(const Level& parent, Mesh& mesh)
        : parent_(parent), topology_(parent.topology), mesh_(mesh),
          quads_(mesh.subdivision == Subdivision::catmullClark) {}

    void run() {
        const size_t corners = parent_.cage.cornerCount(), vertices = parent_.cage.vertexCount();
        const size_t facets = quads_ ? 0 : parent_.cage.faceCount();
        mesh_.fragments.reserve(vertices + facets);
        mesh_.net.reserve(vertices + (quads_ ? 6 : 3) * (corners + vertices) + facetPointCount(1) * facets);
        mesh_.sectorFaces.reserve(corners + facets);
        for (uint32_t v = 0; v < parent_.cage.vertexCount(); ++v) {
            addVertex(v);
        }
        for (uint32_t f = 0; f < parent_.cage.faceCount() && !quads_; ++f) {
            addFacet(f);
        }
    }

private:
    [[nodiscard]] uint32_t vertexAt(uint32_t corner) const { return parent_.cage.faceVertices[corner]; }
    [[nodiscard]] uint32_t next(uint32_t corner) const {
        return cage::nextCorner(parent_.cage, topology_.cornerFaces[corner], corner);
    }
    [[nodiscard]] uint32_t previous(uint32_t corner) const {
        return cage::previousCorner(parent_.cage, topology_.cornerFaces[corner], corner);
    }
    /// The point of the edge from a corner to the next.
    [[nodiscard]] uint32_t edgePoint(uint32_t corner) const {
        return parent_.cage.vertexCount() + topology_.cornerEdges[corner];
    }
    [[nodiscard]] uint32_t facePoint(uint32_t face) const {
        return parent_.cage.vertexCount() + static_cast<uint32_t>(topology_.edges.size()) + face;
    }
    [[nodiscard]] float sharpness(uint32_t edge) const { return softened(parent_.edgeSharpness[edge], 1); }

    Fragment& begin(FragmentKind kind, uint32_t sectors) {
        Fragment& fragment = mesh_.fragments.emplace_back();
        fragment.kind = kind;
        fragment.sectors = sectors;
        fragment.firstNet = static_cast<uint32_t>(mesh_.net.size());
        fragment.firstSector = static_cast<uint32_t>(mesh_.sectorFaces.size());
        fragment.firstSpoke = static_cast<uint32_t>(mesh_.spokeSharpness.size());
        return fragment;
    }

    void addVertex(uint32_t v) {
        const uint32_t base = topology_.spokeStarts[v];
        const uint32_t sectors = topology_.sectorCount(v);
        Fragment& fragment = begin(FragmentKind::vertex, sectors);
        fragment.open = topology_.boundary[v] != 0;
        fragment.centreSharpness = softened(parent_.vertexSharpness[v], 1);
        for (uint32_t k = 0; k < topology_.spokeCount(v); ++k) {
            mesh_.spokeSharpness.push_back(sharpness(cage::spokeEdge(parent_.cage, topology_, base + k)));
        }
        mesh_.net.push_back(v);
        for (uint32_t h = 0; h < sectors; ++h) {
            const uint32_t corner = topology_.sectorCorners[base + h];
            const uint32_t face = topology_.cornerFaces[corner];
            mesh_.net.push_back(edgePoint(corner));
            if (quads_) {
                mesh_.net.push_back(facePoint(face));
            }
            const uint32_t within = corner - parent_.cage.faceStarts[face];
            mesh_.sectorFaces.push_back(4 * face + within);
        }
        const uint32_t last = topology_.sectorCorners[base + sectors - 1];
        if (fragment.open) {
            mesh_.net.push_back(edgePoint(previous(last)));
        }
        for (uint32_t h = 0; h < sectors; ++h) {
            const uint32_t a = next(topology_.sectorCorners[base + h]);
            mesh_.net.push_back(vertexAt(a));
            mesh_.net.push_back(edgePoint(a));
            if (quads_) {
                const uint32_t b = next(a);
                mesh_.net.push_back(vertexAt(b));
                mesh_.net.push_back(edgePoint(b));
            }
        }
        if (fragment.open) {
            mesh_.net.push_back(vertexAt(previous(last)));
        }
    }

    /// The triangle between the edge points of a face of Loop, with its neighbours.
    void addFacet(uint32_t face) {
        const uint32_t first = parent_.cage.faceStarts[face];
        Fragment& fragment = begin(FragmentKind::facet, 1);
        mesh_.sectorFaces.push_back(4 * face + 3);
        mesh_.net.resize(fragment.firstNet + facetPointCount(1));
        const auto put = [&](int32_t a, int32_t b, uint32_t point) {
            mesh_.net[fragment.firstNet + facetPointIndex(1, a, b)] = point;
        };
        struct Place {
            int32_t a, b;
        };
        // Per side, from v to its next vertex w: the corner in its middle, v, and across it the points of the edges
        // from v and from w.
        struct Side {
            Place corner, vertex, fromV, fromW;
        };
        constexpr std::array<Side, 3> kSides{{{{0, 0}, {-1, 1}, {-1, 0}, {0, -1}},
                                              {{1, 0}, {1, -1}, {2, -1}, {2, 0}},
                                              {{0, 1}, {1, 1}, {0, 2}, {-1, 2}}}};
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t corner = first + i;
            const uint32_t own = edgePoint(corner);
            const uint32_t twin = topology_.twins[corner];
            const Side& side = kSides[i];
            put(side.corner.a, side.corner.b, own);
            put(side.vertex.a, side.vertex.b, vertexAt(corner));
            // On the boundary nothing reads what is across: the edge is sharp.
            put(side.fromV.a, side.fromV.b, twin == kNone ? own : edgePoint(next(twin)));
            put(side.fromW.a, side.fromW.b, twin == kNone ? own : edgePoint(previous(twin)));
            mesh_.spokeSharpness.push_back(sharpness(topology_.cornerEdges[corner]));
        }
    }

    const Level& parent_;
    const Topology& topology_;
    Mesh& mesh_;
    bool quads_;
};

bool allOf(const Cage& cage, uint32_t sides) {
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        if (cage.sides(f) != sides) {
            return false;
        }
    }
    return true;
}

Result<Mesh> build(const Cage& cage, Subdivision subdivision) {
    Result<Topology> topology = cage::buildTopology(cage);
    if (!topology.ok()) {
        return topology.error();
    }
    Mesh mesh;
    mesh.subdivision = subdivision;
    Level parent = givenLevel(cage);
    if (subdivision == Subdivision::loop && !allOf(cage, 3)) {
        TriangleSplitter splitter(parent, *topology);
        if (std::optional<Error> error = splitter.run()) {
            return std::move(*error);
        }
        mesh.notes = splitter.notes();
        parent = splitter.out();
        topology = cage::buildTopology(parent.cage);
        if (!topology.ok()) {
            return topology.error();
        }
    }
    parent.topology = std::move(*topology);
    beginLevel(parent, cage, mesh.notes);
    mesh.isolationSteps = subdivision == Subdivision::catmullClark && !allOf(cage, 4) ? 2 : 1;
    if (mesh.isolationSteps == 2) {
        Level quads = refine(parent, subdivision);
        if (std::optional<Error> error = equip(quads, parent)) {
            return std::move(*error);
        }
        mesh.stencils.push_back(std::move(quads.stencils));
        parent = std::move(quads);
    }
    Level isolated = refine(parent, subdivision);
    FragmentBuilder(parent, mesh).run();
    mesh.cornerSources.reserve(isolated.cage.cornerCount());
    for (const uint32_t v : isolated.cage.faceVertices) {
        mesh.cornerSources.push_back(v < cage.vertexCount() ? v : kNone);
    }
    mesh.cage = std::move(isolated.cage);
    mesh.sourceFaces = std::move(isolated.sourceFaces);
    mesh.holes = std::move(isolated.holes);
    mesh.stencils.push_back(std::move(isolated.stencils));
    return mesh;
}

} // namespace

Result<Mesh> buildMesh(const Cage& cage, Subdivision subdivision) {
    return withinMemory("the isolated level of subdivision", [&] { return build(cage, subdivision); });
}

} // namespace supple::surface::subdivision
