#include "surface/blend/mesh.h"

#include "base/within_memory.h"
#include "cage/features.h"

#include <algorithm>
#include <utility>

namespace supple::surface::blend {
namespace {

using cage::Cage;
using cage::kNone;
using cage::Topology;

/// What the host made sharp.
struct Marks {
    std::vector<uint8_t> edges;    ///< boundary edges too: a boundary is none without a crease
    std::vector<uint8_t> vertices; ///< kHardSharpness and more
};

Marks marksOf(const Cage& cage, const Topology& topology, float threshold) {
    const cage::Features features = cage::buildFeatures(cage, topology);
    Marks marks;
    marks.edges.assign(topology.edges.size(), 0);
    for (const cage::Crease& crease : cage.creases) {
        const uint32_t edge = cage::findEdge(cage, topology, crease.a, crease.b);
        if (edge != kNone && crease.sharpness >= threshold) {
            marks.edges[edge] = 1;
        }
    }
    for (const float sharpness : features.vertexSharpness) {
        marks.vertices.push_back(sharpness >= cage::kHardSharpness ? 1 : 0);
    }
    return marks;
}

/// Both halves of a sharp edge are sharp; what the step adds to the vertices is not.
Marks childMarks(const Marks& marks, const RefinedMesh& child, const RefinedMesh& parent) {
    Marks result;
    result.edges.assign(child.topology.edges.size(), 0);
    for (uint32_t c = 0; c < parent.cage.cornerCount(); ++c) {
        const EdgeHalves halves = edgeHalves(child, parent, c);
        result.edges[halves.first] = result.edges[halves.second] = marks.edges[parent.topology.cornerEdges[c]];
    }
    result.vertices = marks.vertices;
    result.vertices.resize(child.cage.vertexCount(), 0);
    return result;
}

/// The step knows sharp and smooth alone, as the surface does: a crease must not change its nature because there is a
/// triangle elsewhere.
void makeSharp(RefinedMesh& mesh, const Marks& marks) {
    for (uint32_t e = 0; e < mesh.edgeSharpness.size(); ++e) {
        const bool boundary = mesh.topology.edges[e].twin == kNone;
        mesh.edgeSharpness[e] = boundary || marks.edges[e] != 0 ? kInfiniteSharpness : 0.0f;
    }
    for (float& sharpness : mesh.vertexSharpness) {
        sharpness = sharpness >= cage::kHardSharpness ? kInfiniteSharpness : 0.0f;
    }
}

class ChartBuilder {
public:
    ChartBuilder(const Marks& marks, Mesh& mesh) : marks_(marks), mesh_(mesh) {}

    void run() {
        mesh_.corners.resize(mesh_.cage.cornerCount());
        mesh_.chartStarts.push_back(0);
        for (uint32_t v = 0; v < mesh_.cage.vertexCount(); ++v) {
            addVertex(v);
            mesh_.chartStarts.push_back(static_cast<uint32_t>(mesh_.charts.size()));
        }
        mesh_.classes = chartClasses_;
        std::sort(mesh_.classes.begin(), mesh_.classes.end());
        mesh_.classes.erase(std::unique(mesh_.classes.begin(), mesh_.classes.end()), mesh_.classes.end());
        for (uint32_t i = 0; i < mesh_.charts.size(); ++i) {
            const auto at = std::lower_bound(mesh_.classes.begin(), mesh_.classes.end(), chartClasses_[i]);
            mesh_.charts[i].chartClass = static_cast<uint32_t>(at - mesh_.classes.begin());
        }
    }

private:
    void addVertex(uint32_t v) {
        const Topology& topology = mesh_.topology;
        vertex_ = v;
        base_ = topology.spokeStarts[v];
        const bool open = topology.boundary[v] != 0;
        const uint32_t sectors = topology.sectorCount(v);
        std::vector<uint32_t> sharp;
        bool inside = false; // a sharp spoke that is no boundary edge
        for (uint32_t k = 0; k < topology.spokeCount(v); ++k) {
            if (marks_.edges[cage::spokeEdge(mesh_.cage, topology, base_ + k)] != 0) {
                sharp.push_back(k);
                inside = inside || !open || (k > 0 && k < sectors);
            }
        }
        const bool curves = mesh_.creases == CreaseMode::curve;
        if (open && !inside && !curves) {
            sharp.clear(); // cut: nothing is on the boundary's other side
        }
        if (marks_.vertices[v] != 0 || (open && inside) || sharp.size() > 2 || (curves && sharp.size() == 1)) {
            addPoint(sectors);
        } else if (sharp.size() < 2) {
            addChart({open ? ChartKind::boundary : ChartKind::interior, sectors}, 0);
        } else {
            const ChartKind kind = curves ? ChartKind::curve : ChartKind::cut;
            const uint32_t side = sharp[1] - sharp[0];
            addChart({kind, side}, sharp[0]);
            if (!open) {
                addChart({kind, sectors - side}, sharp[1]);
            }
        }
    }

    void beginChart(const ChartClass& chartClass) {
        mesh_.charts.push_back({vertex_, 0, static_cast<uint32_t>(mesh_.ring.size())});
        chartClasses_.push_back(chartClass);
    }

    void addPoint(uint32_t sectors) {
        beginChart({ChartKind::point, 0});
        for (uint32_t h = 0; h < sectors; ++h) {
            mesh_.corners[mesh_.topology.sectorCorners[base_ + h]] = {lastChart(), 0};
        }
    }

    /// The sectors from `first` on, round the vertex.
    void addChart(const ChartClass& chartClass, uint32_t first) {
        beginChart(chartClass);
        const uint32_t all = mesh_.topology.sectorCount(vertex_);
        const bool curve = chartClass.kind == ChartKind::curve;
        for (uint32_t h = 0; h < chartClass.sectors; ++h) {
            const uint32_t corner = mesh_.topology.sectorCorners[base_ + (first + h) % all];
            mesh_.corners[corner] = {lastChart(), h};
            if (!curve || h == 0) {
                mesh_.ring.push_back(vertexAfter(corner, 1));
            }
            if (!curve) {
                mesh_.ring.push_back(vertexAfter(corner, 2));
            }
            if (chartClass.kind != ChartKind::interior && h + 1 == chartClass.sectors) {
                mesh_.ring.push_back(vertexAfter(corner, 3));
            }
        }
    }

    [[nodiscard]] uint32_t lastChart() const { return static_cast<uint32_t>(mesh_.charts.size() - 1); }

    [[nodiscard]] uint32_t vertexAfter(uint32_t corner, uint32_t steps) const {
        return mesh_.cage.faceVertices[(corner & ~3u) | ((corner + steps) & 3u)]; // all faces are quads
    }

    const Marks& marks_;
    Mesh& mesh_;
    std::vector<ChartClass> chartClasses_; ///< per chart
    uint32_t vertex_ = 0;                  ///< at work, and its first spoke slot
    uint32_t base_ = 0;
};

uint32_t countOtherThanQuads(const Cage& cage) {
    uint32_t count = 0;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        count += cage.sides(f) != 4 ? 1 : 0;
    }
    return count;
}

Result<Mesh> build(const Cage& cage, const Options& options) {
    Mesh mesh;
    mesh.creases = options.creases;
    Result<RefinedMesh> quads = beginRefinement(cage, nullptr, mesh.notes);
    if (!quads) {
        return quads.error();
    }
    if (const std::string corners = cage::sharpRoundCorners(cage); !corners.empty()) {
        mesh.notes.push_back(corners);
    }
    Marks marks = marksOf(cage, quads->topology, options.sharpThreshold);
    if (const uint32_t others = countOtherThanQuads(cage); others > 0) {
        mesh.refined = true;
        mesh.notes.push_back(std::to_string(others) + " of " + std::to_string(cage.faceCount()) +
                             " faces are no quads: the cage takes one step of Catmull-Clark first");
        makeSharp(*quads, marks);
        RefinedMesh child = refine(*quads, Subdivision::catmullClark);
        if (const Status equipped = equip(child, *quads); !equipped) {
            return equipped.error();
        }
        marks = childMarks(marks, child, *quads);
        *quads = std::move(child);
    }
    mesh.hostVertices = cage.vertexCount();
    mesh.cage = std::move(quads->cage);
    mesh.topology = std::move(quads->topology);
    mesh.stencils = std::move(quads->stencils);
    mesh.sourceFaces = std::move(quads->sourceFaces);
    ChartBuilder(marks, mesh).run();
    mesh.edgeSharp = std::move(marks.edges);
    return mesh;
}

} // namespace

bool flatAcross(const Mesh& mesh, uint32_t corner) {
    const auto flat = [&](const Corner& at, uint32_t spoke) {
        const ChartClass& chartClass = mesh.classOf(at.chart);
        return chartClass.kind == ChartKind::point ||
               (chartClass.kind == ChartKind::curve && (spoke == 0 || spoke == chartClass.sectors));
    };
    const Corner& begin = mesh.corners[corner];
    const Corner& end = mesh.corners[(corner & ~3u) | ((corner + 1) & 3u)];
    return flat(begin, begin.sector) && flat(end, end.sector + 1);
}

Result<RefinedMesh> beginCharts(const Cage& cage, const Options& options) {
    std::vector<std::string> notes; // buildMesh() has them too
    Result<RefinedMesh> mesh = beginRefinement(cage, nullptr, notes);
    if (mesh) {
        makeSharp(*mesh, marksOf(cage, mesh->topology, options.sharpThreshold));
    }
    return mesh;
}

Result<Mesh> buildMesh(const Cage& cage, const Options& options) {
    return withinMemory("the charts of the blending surface", [&] { return build(cage, options); });
}

} // namespace supple::surface::blend
