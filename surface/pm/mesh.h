// The cage as P_m sees it: facets of three to five sides, fans between sharp edges, facet classes. Depends on
// connectivity and sharpness; rest positions only decide which diagonals cut large faces and how wide corners are.
// Built once per asset. Paper: A. Myles, T. Ni, J. Peters, "Fast Parallel Construction of Smooth Surfaces from Meshes
// with Tri/Quad/Pent Facets", SGP 2008; numbers in parentheses are its equations, in the corrected form of docs/pm.md.
#pragma once

#include "base/result.h"
#include "cage/features.h"
#include "cage/topology.h"
#include "surface/patch_class.h"

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::surface::pm {

inline constexpr double kSmoothAlpha = 2.0 / 3.0;

/// With an alpha of 0 at both ends of an edge, or at all edges of a vertex, first derivatives vanish there, and there
/// is no normal. So smaller alphas count as this one. The surface of a cage whose alphas are all 0 is the polyhedron up
/// to this part of its edges.
inline constexpr double kLeastAlpha = 1.0 / 4096.0;

/// alpha = (2/3) 2^-s, between kLeastAlpha and 1. Edges that are hard in the cage are cut and have no alpha.
[[nodiscard]] double alphaOfSharpness(double sharpness);

enum class FanKind : uint8_t {
    interior, ///< closed: the whole ring of an interior vertex with no sharp edge, or with one (the tip of a dart)
    crease,   ///< open: two sharp edges meet at the vertex and form a smooth boundary or crease
    corner,   ///< open: the surface interpolates the vertex, and the two sharp edges span its tangent plane
    straight  ///< open: the surface interpolates the vertex, and the two sharp edges are one smooth curve through it
};

/// What a facet takes of the whole turn round a vertex: `part` of `whole`.
struct FacetAngle {
    uint32_t part = 1;
    uint32_t whole = 4;

    auto operator<=>(const FacetAngle&) const = default;
};

/// Where an open fan ends, at a sharp edge from p to A, its tangent is t = p + own (A - p) - other (B - p). As a rule
/// it is (2 p + A) / 3. At corners it may be shorter. If the curve runs smoothly through a corner, B is the far vertex
/// of its other edge. All fans that end at this edge have the same numbers.
struct FanEnd {
    uint32_t partner = cage::kNone; ///< the slot of an edge to B
    double own = 1.0 / 3.0;
    double other = 0.0;

    bool operator==(const FanEnd&) const = default;
};

/// The width of a fan that is a corner is a multiple of 30 degrees. As in the paper's corners it is a right angle,
/// unless the rest pose says otherwise.
inline constexpr uint32_t kRightAngle = 3;

/// A fan of facets around a vertex. Facet j (0 <= j < facets) lies between edges j and j + 1, counter-clockwise. The
/// edges and facets of all fans are numbered by slots: slot firstSlot + j stands for edge j and, if j < facets, for
/// facet j.
struct Fan {
    uint32_t vertex = 0;
    uint32_t firstSlot = 0;
    uint32_t facets = 0; ///< q
    FanKind kind = FanKind::interior;
    bool creased = false;  ///< an edge inside the fan has an alpha other than 2/3
    bool variable = false; ///< an edge inside the fan is in a crease set: instances may give it another alpha
    /// The fan is closed and its vertex p is sharp (cage::SharpVertex). Its v, t and f are moved by p - v, so that
    /// the surface passes through the vertex. An open fan becomes a corner instead.
    bool pinned = false;
    uint8_t width = kRightAngle;  ///< of a corner: between its two sharp edges, in twelfths of a turn
    std::array<FanEnd, 2> ends{}; ///< of an open fan: at its first and at its last edge

    [[nodiscard]] bool closed() const { return kind == FanKind::interior; }
    [[nodiscard]] uint32_t edges() const { return closed() ? facets : facets + 1; }
    /// 1 / N in cos(2 pi / N): N is q if closed, 2 q at creases, 4 q at corners of a right angle.
    [[nodiscard]] FacetAngle angle() const;
    /// A fan as in a bicubic B-spline: N = 4, and t_j = e_j on all inner edges.
    [[nodiscard]] bool regular() const;
    /// Whether both ends are as a rule.
    [[nodiscard]] bool plainEnds() const { return ends[0] == FanEnd{} && ends[1] == FanEnd{}; }
};

/// Corner c of facet f at vertex v. Half-edge c runs from v to the next vertex of f.
struct FacetCorner {
    uint32_t fan = 0;
    uint32_t slot = 0;     ///< slot of f in the fan, and of edge j, which is half-edge c
    uint32_t slotBack = 0; ///< slot of edge j + 1, which leads to the previous vertex of f
    /// Slots of the facets across edge j (facet j - 1) and across edge j + 1 (facet j + 1) in the same fan. kNone if
    /// the fan ends at that edge.
    uint32_t across = cage::kNone;
    uint32_t acrossBack = cage::kNone;
};

struct Mesh {
    cage::Cage cage; ///< the given cage with faces of six and more sides split; its vertices are unchanged
    cage::Topology topology;
    cage::Features features;
    std::vector<uint32_t> sourceFaces; ///< per facet: the face it came from
    std::vector<Fan> fans;             ///< grouped by vertex, in vertex order
    std::vector<uint32_t> slotSpokes;  ///< per slot: the spoke of `topology` that is edge j
    std::vector<double> slotAlphas;    ///< per slot: alpha of edge j at this vertex; 2/3 where an open fan ends
    /// Per slot: the weight of (X - p) + (Y - p) that f_j has beside (14); 0 unless facet j is alone on its side of a
    /// semi-sharp crease.
    std::vector<double> slotRims;
    std::vector<uint32_t> slotSets;   ///< per slot: crease set of edge j, kNone for none and where an open fan ends
    std::vector<uint8_t> slotGivens;  ///< per slot: 1 where the cage gives the alpha, which counts as smooth at rims
    std::vector<FacetCorner> corners; ///< per corner of `cage`
    std::vector<PatchClass> classes;  ///< per facet: regular, polar, p3, p4 or p5
    /// Per facet: the corner (0..sides-1) that is corner 0 of its patch; patch corner i is facet corner (first + i) %
    /// sides. It is 0 except for polar facets, because the last corner of a polar patch must be the apex.
    std::vector<uint8_t> firstCorners;
    /// What was changed or left out, one line each: "face 12 has 7 sides: split into a quad and a pentagon".
    std::vector<std::string> notes;

    [[nodiscard]] uint32_t corner(uint32_t facet, uint32_t patchCorner) const {
        return cage.faceStarts[facet] + (firstCorners[facet] + patchCorner) % cage.sides(facet);
    }
};

/// Splits large faces, builds topology and features, and finds fans and classes. Refuses what cage::buildTopology
/// refuses, and a face of six or more sides that no zig-zag split fits ("face 12 has 6 sides: ..."). O(corners), apart
/// from sorting neighbours and choosing splits.
[[nodiscard]] Result<Mesh> buildMesh(const cage::Cage& cage);

} // namespace supple::surface::pm
