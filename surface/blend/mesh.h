// The cage as the blending surface sees it: quads, and a chart round every vertex, or one a side where a crease passes.
// Connectivity and sharpness only; built once per asset. Paper and formulas: docs/blend.md.
#pragma once

#include "base/result.h"
#include "cage/topology.h"
#include "surface/subdivision.h"

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace supple::surface::blend {

/// What stands at a vertex through which a crease runs.
enum class CreaseMode : uint8_t {
    cut,  ///< a chart a side: two smooth sheets that share the crease
    curve ///< the curve alone, as published: the surface leaves it in a narrow ridge
};

struct Options {
    CreaseMode creases = CreaseMode::cut;
    float sharpThreshold = 1.0f; ///< edges of this sharpness and more are sharp, others smooth: nothing lies between

    bool operator==(const Options&) const = default;
};

enum class ChartKind : uint8_t {
    interior, ///< closed: the whole ring of an interior vertex
    boundary, ///< open: the whole fan of a boundary vertex
    cut,      ///< open: one side of a crease
    curve,    ///< open: one side of a crease, of which it has the curve alone
    point     ///< the vertex itself
};

/// All that weights and tables of a chart depend on.
struct ChartClass {
    ChartKind kind = ChartKind::interior;
    uint32_t sectors = 4; ///< 0 for points

    /// k: a sector turns by 2 pi / k in the chart, whose points are z^(4/k). 4 for points, which have no use for it.
    [[nodiscard]] uint32_t turns() const {
        if (kind == ChartKind::point || (kind == ChartKind::boundary && sectors == 1)) {
            return 4;
        }
        return kind == ChartKind::interior ? sectors : 2 * sectors;
    }
    /// Points that the coefficients are made of, besides the vertex.
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
    /// Whether the chart's first and last spoke are one crease, which has a parameter of its own.
    [[nodiscard]] bool creased() const { return kind == ChartKind::cut || kind == ChartKind::curve; }

    bool operator==(const ChartClass&) const = default;
    bool operator<(const ChartClass& other) const {
        return std::tie(kind, sectors) < std::tie(other.kind, other.sectors);
    }
};

/// Ring points counter-clockwise: with e_h the far end of spoke h and f_h the far corner of sector h's face, e_0 f_0
/// e_1 f_1 ... and, where the chart is open, the last spoke's end. A curve has the ends of its first and its last
/// spoke.
struct Chart {
    uint32_t vertex = 0;
    uint32_t chartClass = 0; ///< into Mesh::classes
    uint32_t firstRing = 0;  ///< into Mesh::ring: ringPoints() entries
};

/// A corner of a face: sector h of its chart lies between spokes h (towards the face's next vertex) and h + 1.
struct Corner {
    uint32_t chart = 0;
    uint32_t sector = 0;
};

struct Mesh {
    CreaseMode creases = CreaseMode::cut;
    /// Whether the cage had faces other than quads and took a step of Catmull-Clark, after which vertices and faces
    /// come as surface::refine() says. Else vertices and faces are the cage's.
    bool refined = false;
    /// Quads, with corner attributes, materials and rest positions; without creases, sharp vertices and holes.
    cage::Cage cage;
    cage::Topology topology;           ///< of `cage`
    Stencils stencils;                 ///< a row a vertex of `cage`, in the host's cage; 1 times itself unless refined
    std::vector<uint32_t> sourceFaces; ///< per face: the host's face it came from
    std::vector<uint8_t> holes;        ///< per face: 1 where the host's face is not drawn
    std::vector<uint32_t> cornerSources; ///< per corner: the host's cage vertex that stands there, or kNone
    std::vector<uint8_t> edgeSharp;      ///< per edge of `topology`: 1 where the host made it sharp

    std::vector<ChartClass> classes;   ///< rising, each once
    std::vector<Chart> charts;         ///< by vertex, at a crease the side of the first sharp spoke first
    std::vector<uint32_t> chartStarts; ///< per vertex, and one more: charts [chartStarts[v], chartStarts[v + 1])
    std::vector<uint32_t> ring;        ///< vertices of `cage`
    std::vector<Corner> corners;       ///< per corner of `cage`
    std::vector<std::string> notes;    ///< what was changed or left out on the way in

    [[nodiscard]] const ChartClass& classOf(uint32_t chart) const { return classes[charts[chart].chartClass]; }
};

/// Whether the surface lies still across the edge from a corner to the next: points or curves at both ends have no
/// derivative there. Such an edge is sharp whether the host said so or not.
[[nodiscard]] bool flatAcross(const Mesh& mesh, uint32_t corner);

/// Refuses by name what cage::buildTopology refuses. O(corners).
[[nodiscard]] Result<Mesh> buildMesh(const cage::Cage& cage, const Options& options = {});

} // namespace supple::surface::blend
