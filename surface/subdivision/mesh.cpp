#include "surface/subdivision/mesh.h"

#include "base/within_memory.h"
#include "surface/subdivision/pattern.h"

#include <algorithm>
#include <array>
#include <utility>

namespace supple::surface::subdivision {
namespace {

using cage::Cage;
using cage::kNone;
using cage::Topology;

/// A fan of triangles from one corner.
FaceCut fanCut(uint32_t sides) {
    FaceCut cut;
    for (uint32_t k = 1; k + 1 < sides; ++k) {
        cut.parts.push_back({0, k, k + 1});
        if (k > 1) {
            cut.diagonals.push_back({0, k});
        }
    }
    return cut;
}

constexpr SplitRule kTriangles{.mostSides = 3, .cut = fanCut, .startCorners = 64, .parts = "triangles"};

/// Cuts the isolated mesh into fragments, by the topology of its parent.
class FragmentBuilder : StepPoints {
public:
    FragmentBuilder(const RefinedMesh& parent, Mesh& mesh)
        : StepPoints(parent), topology_(parent.topology), mesh_(mesh),
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

    const Topology& topology_;
    Mesh& mesh_;
    bool quads_;
};

bool allQuads(const Cage& cage) {
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        if (cage.sides(f) != 4) {
            return false;
        }
    }
    return true;
}

void isolate(RefinedMesh parent, Isolation& isolation) {
    Mesh& mesh = isolation.mesh;
    RefinedMesh isolated = refine(parent, mesh.subdivision);
    FragmentBuilder(parent, mesh).run();
    mesh.cage = std::move(isolated.cage);
    mesh.sourceFaces = std::move(isolated.sourceFaces);
    mesh.stencils.push_back(std::move(isolated.stencils));
    isolation.parent = std::move(parent);
}

/// Round corners are as sharp as the cage says, and no sharper. The steps that follow know nothing else of them.
void roundCorners(const Cage& cage, RefinedMesh& mesh) {
    if (cage.roundCorners.empty()) {
        return;
    }
    std::vector<float> sharpness(cage.vertexCount(), 0.0f);
    for (const cage::SharpVertex& sharp : cage.sharpVertices) {
        if (sharp.vertex < cage.vertexCount()) {
            sharpness[sharp.vertex] = std::max(sharpness[sharp.vertex], sharp.sharpness);
        }
    }
    for (const uint32_t v : cage.roundCorners) {
        if (sharpness[v] < cage::kHardSharpness) {
            mesh.vertexSharpness[v] = sharpness[v];
        }
    }
}

Result<Isolation> build(const Cage& cage, Subdivision subdivision) {
    const bool loop = subdivision == Subdivision::loop;
    Isolation isolation;
    Mesh& mesh = isolation.mesh;
    mesh.subdivision = subdivision;
    Result<RefinedMesh> parent = beginSteps(cage, subdivision, mesh.notes);
    if (!parent) {
        return parent.error();
    }
    mesh.isolationSteps = loop || allQuads(cage) ? 1 : 2;
    if (mesh.isolationSteps == 2) {
        RefinedMesh quads = refine(*parent, subdivision);
        if (const Status equipped = equip(quads, *parent); !equipped) {
            return equipped.error();
        }
        mesh.stencils.push_back(std::move(quads.stencils));
        *parent = std::move(quads);
    }
    mesh.hostVertices = cage.vertexCount();
    isolate(std::move(*parent), isolation);
    return isolation;
}

} // namespace

Result<RefinedMesh> beginSteps(const Cage& cage, Subdivision subdivision, std::vector<std::string>& notes) {
    Result<RefinedMesh> mesh = beginRefinement(cage, subdivision == Subdivision::loop ? &kTriangles : nullptr, notes);
    if (mesh) {
        roundCorners(cage, *mesh);
    }
    return mesh;
}

Isolation isolateLevel(RefinedMesh parent, Subdivision subdivision) {
    Isolation isolation;
    isolation.mesh.subdivision = subdivision;
    isolate(std::move(parent), isolation);
    return isolation;
}

Result<Isolation> isolateCage(const Cage& cage, Subdivision subdivision) {
    return withinMemory("the isolated level of subdivision", [&] { return build(cage, subdivision); });
}

Result<Mesh> buildMesh(const Cage& cage, Subdivision subdivision) {
    Result<Isolation> isolation = isolateCage(cage, subdivision);
    if (!isolation) {
        return isolation.error();
    }
    return std::move(isolation->mesh);
}

} // namespace supple::surface::subdivision
