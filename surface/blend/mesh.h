// The cage as the blending surface sees it: quads, and a chart around every vertex. A vertex on a crease has a chart on
// each side. Depends on connectivity and sharpness only; built once per asset. Paper and formulas: docs/blend.md.
#pragma once

#include "base/result.h"
#include "cage/topology.h"
#include "surface/recipe.h"
#include "surface/refinement.h"

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace supple::surface::blend {

enum class ChartKind : uint8_t {
    interior, ///< closed: the whole ring of an interior vertex
    boundary, ///< open: the whole fan of a boundary vertex
    cut,      ///< open: one side of a crease
    curve,    ///< open: one side of a crease, of which only the curve is used
    point     ///< the vertex itself
};

/// All that the weights and tables of a chart depend on.
struct ChartClass {
    ChartKind kind = ChartKind::interior;
    uint32_t sectors = 4; ///< 0 for a point

    /// k: the chart maps z to z^(4/k), and a sector takes an angle of 2 pi / k. A point has no use for it and gets 4.
    [[nodiscard]] uint32_t turns() const {
        if (kind == ChartKind::point || (kind == ChartKind::boundary && sectors == 1)) {
            return 4;
        }
        return kind == ChartKind::interior ? sectors : 2 * sectors;
    }
    /// How many points the coefficients are made of, besides the vertex.
    [[nodiscard]] uint32_t ringPoints() const {
        switch (kind) {
        case ChartKind::interior:
            return 2 * sectors;
        case ChartKind::curve:
            return 2;
        case ChartKind::point:
            return 0;
        default:
            return 2 * sectors + 1;
        }
    }
    /// Whether the first and the last spoke form a crease, which has a parameter of its own.
    [[nodiscard]] bool creased() const { return kind == ChartKind::cut || kind == ChartKind::curve; }

    bool operator==(const ChartClass&) const = default;
    bool operator<(const ChartClass& other) const {
        return std::tie(kind, sectors) < std::tie(other.kind, other.sectors);
    }
};

/// The ring points of a chart are stored counter-clockwise. With e_h the far end of spoke h and f_h the far corner of
/// the face in sector h, they are e_0 f_0 e_1 f_1 ...; an open chart ends with the far end of its last spoke. A curve
/// has only the far ends of its first and its last spoke.
struct Chart {
    uint32_t vertex = 0;
    uint32_t chartClass = 0; ///< into Mesh::classes
    uint32_t firstRing = 0;  ///< into Mesh::ring: ringPoints() entries
};

/// A corner of a face. Sector h of its chart lies between spokes h and h + 1. Spoke h leads to the next vertex of the
/// face.
struct Corner {
    uint32_t chart = 0;
    uint32_t sector = 0;
};

struct Mesh {
    CreaseMode creases = CreaseMode::cut;
    /// Whether the cage had faces other than quads and was subdivided once by Catmull-Clark. Then vertices and faces
    /// have the order of surface::refine(), else that of the host's cage.
    bool refined = false;
    /// Quads, with corner attributes, materials, holes and rest positions; without creases and sharp vertices.
    cage::Cage cage;
    cage::Topology topology; ///< of `cage`
    Stencils stencils;       ///< one row per vertex of `cage`, over the host's vertices; itself unless refined
    std::vector<uint32_t> sourceFaces; ///< per face: the host's face it came from
    uint32_t hostVertices = 0;         ///< so many vertices of `cage` are the host's; they come first
    std::vector<uint8_t> edgeSharp;    ///< per edge of `topology`: 1 if the host made it sharp

    std::vector<ChartClass> classes;   ///< sorted, without duplicates
    std::vector<Chart> charts;         ///< grouped by vertex; at a crease the side of the first sharp spoke comes first
    std::vector<uint32_t> chartStarts; ///< vertex v has the charts [chartStarts[v], chartStarts[v + 1])
    std::vector<uint32_t> ring;        ///< vertices of `cage`
    std::vector<Corner> corners;       ///< per corner of `cage`
    std::vector<std::string> notes;    ///< what was changed or left out, one line each

    [[nodiscard]] const ChartClass& classOf(uint32_t chart) const { return classes[charts[chart].chartClass]; }
};

/// Whether the surface has no derivative across the edge from this corner to the next. That is so if both ends are
/// points or curves. Such an edge is sharp even if the host did not make it so.
[[nodiscard]] bool flatAcross(const Mesh& mesh, uint32_t corner);

/// The cage before a step, with its sharpness as the surface has it: all or nothing.
[[nodiscard]] Result<RefinedMesh> beginCharts(const cage::Cage& cage, const Options& options);

/// Refuses what cage::buildTopology refuses, with the same message. O(corners).
[[nodiscard]] Result<Mesh> buildMesh(const cage::Cage& cage, const Options& options = {});

} // namespace supple::surface::blend
