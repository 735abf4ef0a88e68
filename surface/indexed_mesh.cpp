#include "surface/indexed_mesh.h"

#include "shaders/shared/chains.h"
#include "shaders/shared/pm.h"
#include "shaders/shared/prep.h"
#include "surface/borders.h"
#include "surface/smooth_uvs.h"
#include "surface/subdivision_rules.h"
#include "surface/table_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace supple::surface {

namespace {

using namespace supple::shared;

/// A side of a patch, in the direction that has the patch on its left.
struct Side {
    uint32_t patch = 0;
    uint32_t side = 0;
};

/// What the record of an edge is made of, as one side of one patch has it.
struct EdgeSource {
    BorderCurve border{};
    BorderCurve across{};
    uint32_t flags = 0;
    uint32_t extra = 0;
    uint32_t kind = kPlainEdges;
};
static_assert(kPlainEdges < kPerturbedEdges && kPerturbedEdges < kMixedEdges && kMixedEdges < kHalvesEdges &&
              kHalvesEdges < kTriangleEdges && kTriangleEdges < kIrregularTriangleEdges);

const PatchRange& rangeOf(const Tables& tables, uint32_t patch) {
    return *std::find_if(tables.ranges.begin(), tables.ranges.end(),
                         [&](const PatchRange& range) { return patch < range.firstPatch + range.section.count; });
}

class Builder {
public:
    Builder(Tables& tables, bool attributes, bool tangents)
        : tables_(tables), attributes_(attributes), tangents_(tangents) {}

    void build() {
        tables_.mesh.tangents = tangents_;
        collect();
        chooseSides();
        writeEdges();
    }

private:
    [[nodiscard]] uint32_t recordOf(const PatchRange& range, uint32_t patch) const {
        return range.section.table + (patch - range.firstPatch) * recordElements(tables_, range.patchClass);
    }
    [[nodiscard]] uint32_t attributeElement(const PatchRange& range, uint32_t patch, uint32_t corner) const {
        const uint32_t at = cornerCount(domainOf(range.patchClass)) * (patch - range.firstPatch) + corner;
        const uint32_t word = tables_.words[range.attributes + (tables_.attributeHalves ? at / 2 : at)];
        const uint32_t number = !tables_.attributeHalves ? word : word >> 16 * (at % 2) & 0xFFFFu;
        return tables_.attributes + tables_.cornerElements() * number;
    }

    /// The texture coordinates that tangents follow.
    [[nodiscard]] glm::vec2 mapUv(uint32_t element) const {
        const auto pair = [&](size_t word) {
            const uint32_t* words = &tables_.words[size_t{4} * element + word];
            return glm::vec2(std::bit_cast<float>(words[0]), std::bit_cast<float>(words[1]));
        };
        if (!tables_.mapFrames) {
            return pair(0);
        }
        const size_t frame = size_t{4} * (tables_.cornerElements() - 1);
        const uint32_t* words = &tables_.words[size_t{4} * element + frame];
        return cage::MapFrame{words[3], pair(frame), std::bit_cast<float>(words[2])}.turn(
            pair(words[3] == 1 && tables_.uvSets == 2 ? 4 : 0));
    }

    /// The sign of a patch's area in these (shaders/evaluate/attributes.comp).
    [[nodiscard]] int handOf(const PatchRange& range, uint32_t patch) const {
        const uint32_t corners = cornerCount(domainOf(range.patchClass));
        std::array<glm::vec2, kMaxSides> uvs{};
        for (uint32_t k = 0; k < corners; ++k) {
            uvs[k] = mapUv(attributeElement(range, patch, k));
        }
        float area = 0.0f;
        for (uint32_t k = 0; k < corners; ++k) {
            const glm::vec2 p = uvs[k] - uvs[0], q = uvs[(k + 1) % corners] - uvs[0];
            area += p.x * q.y - p.y * q.x;
        }
        return area > 0.0f ? 1 : area < 0.0f ? -1 : 0;
    }

    /// Numbers corners and edges in the order in which patches come to them.
    void collect() {
        std::map<std::tuple<uint32_t, uint32_t, int>, uint32_t> corners; // by limit point, attributes and hand
        std::map<BorderCurve, uint32_t> edges;
        for (const PatchRange& range : tables_.ranges) {
            const uint32_t sides = cornerCount(domainOf(range.patchClass));
            for (uint32_t patch = range.firstPatch; patch < range.firstPatch + range.section.count; ++patch) {
                const std::vector<BorderCurve> curves = curvesOf(range, patch);
                const int hand = tangents_ ? handOf(range, patch) : 0;
                MeshTables::Patch& own = tables_.mesh.patches.emplace_back();
                for (uint32_t i = 0; i < sides; ++i) {
                    const std::tuple key(curves[i][0], attributes_ ? attributeElement(range, patch, i) : 0, hand);
                    own.corners[i] = corners.try_emplace(key, static_cast<uint32_t>(corners.size())).first->second;
                }
                for (uint32_t i = 0; i < sides; ++i) {
                    const BorderCurve curve{own.corners[i], curves[i][1], curves[i][2], own.corners[(i + 1) % sides]};
                    const BorderCurve back{curve[3], curve[2], curve[1], curve[0]};
                    own.reversed[i] = back < curve;
                    own.edges[i] =
                        edges.try_emplace(std::min(curve, back), static_cast<uint32_t>(edges.size())).first->second;
                    edges_.resize(edges.size());
                    edges_[own.edges[i]].sides[own.reversed[i] ? 1 : 0] = {patch, i};
                    edges_[own.edges[i]].has[own.reversed[i] ? 1 : 0] = true;
                }
            }
        }
        tables_.mesh.edgeCount = static_cast<uint32_t>(edges.size());
        tables_.mesh.cornerCount = static_cast<uint32_t>(corners.size());
    }

    /// Each corner's sample is stored by an edge that begins there: that of the first patch that comes to the corner.
    /// The edge is still free then, for both patches at it have the corner. It is taken from that patch's side.
    void chooseSides() {
        auto& patches = tables_.mesh.patches;
        std::vector<bool> stored(tables_.mesh.cornerCount, false);
        for (uint32_t p = 0; p < patches.size(); ++p) {
            for (uint32_t i = 0; i < tables_.patches[p].cornerCount; ++i) {
                const uint32_t corner = patches[p].corners[i];
                if (!stored[corner]) {
                    stored[corner] = true;
                    Edge& edge = edges_[patches[p].edges[i]];
                    edge.corner = corner;
                    edge.taken = patches[p].reversed[i] ? 1 : 0;
                }
            }
        }
        for (Edge& edge : edges_) {
            if (edge.corner == kNoEdgeSample) {
                edge.taken = edge.has[0] ? 0 : 1;
            }
            for (uint32_t s = 0; s < 2; ++s) { // from here on an edge runs as its record does
                if (edge.has[s]) {
                    const auto [patch, side] = edge.sides[s];
                    patches[patch].reversed[side] = s != edge.taken;
                }
            }
        }
    }

    void writeEdges() {
        std::vector<EdgeSource> sources;
        uint32_t most = kPlainEdges;
        for (const Edge& edge : edges_) {
            sources.push_back(sourceOf(edge.sides[edge.taken]));
            most = std::max(most, sources.back().kind);
        }
        // The kernel of mixed edges takes all of P_m's.
        const auto kind = [&](uint32_t e) { return most == kMixedEdges ? most : sources[e].kind; };
        std::vector<uint32_t> order(edges_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return kind(a) < kind(b); });

        TableWriter writer(tables_.words);
        MeshTables& mesh = tables_.mesh;
        for (const uint32_t e : order) {
            if (mesh.edges.empty() || mesh.edges.back().kind != kind(e)) {
                mesh.edges.push_back({kind(e), {writer.element(), 0}});
            }
            ++mesh.edges.back().section.count;
            writer.put(sources[e].border);
            writer.put(sources[e].across);
            writer.put({edges_[e].corner, e, sources[e].flags, sources[e].extra});
        }
        if (!attributes_) {
            return;
        }
        std::vector<uint32_t> curves; // elements
        for (size_t i = 0; i < order.size() && tables_.uvMode != cage::UvMode::all; ++i) {
            const Side& side = edges_[order[i]].sides[edges_[order[i]].taken];
            if (tables_.uvLeaves) {
                curves.push_back(uvElement(side.patch, 0));
                continue;
            }
            curves.push_back(writer.element());
            writeUvCurves(side, writer);
        }
        mesh.attributes = {writer.element(), static_cast<uint32_t>(order.size())};
        for (size_t i = 0; i < order.size(); ++i) {
            const auto [patch, side] = edges_[order[i]].sides[edges_[order[i]].taken];
            const PatchRange& range = rangeOf(tables_, patch);
            const uint32_t corners = cornerCount(domainOf(range.patchClass));
            const uint32_t place = corners * (patch - range.firstPatch), halves = tables_.attributeHalves ? 1 : 0;
            const uint32_t form = side | corners << kPatchCornersShift |
                                  (hasSectorFrames(range.patchClass) ? kPatchHasSectors : 0) |
                                  (place & halves) << kPatchHalfShift;
            writer.put({range.attributes + (place >> halves), form, curves.empty() ? 0u : curves[i], 0u});
        }
    }

    /// The first table element of a patch's smooth texture coordinates.
    [[nodiscard]] uint32_t uvElement(uint32_t patch, uint32_t set) const {
        const PatchRange& range = rangeOf(tables_, patch);
        const uint32_t each = uvElements(tables_, range.patchClass);
        return range.smoothUvs + each * (tables_.uvSets * (patch - range.firstPatch) + set);
    }

    /// Of every UV set the cubic along a side and that of the derivative across, each with what the perturbation adds.
    void writeUvCurves(const Side& at, TableWriter& writer) const {
        const PatchRange& range = rangeOf(tables_, at.patch);
        for (uint32_t set = 0; set < tables_.uvSets; ++set) {
            const uint32_t element = uvElement(at.patch, set);
            const auto c = [&](uint32_t k) {
                const uint32_t* words = &tables_.words[size_t{4} * element + size_t{2} * k];
                return glm::vec2(std::bit_cast<float>(words[0]), std::bit_cast<float>(words[1]));
            };
            const UvCurve curve = rowOf(range.patchClass).hasSectors()
                                      ? sectorUvCurve(c, cornerCount(domainOf(range.patchClass)), at.side)
                                      : bicubicUvCurve(c, range.patchClass, at.side);
            for (const std::array<glm::vec2, 6>* half : {&curve.along, &curve.across}) {
                for (const glm::vec2& p : *half) {
                    writer.putFloats({p.x, p.y});
                }
            }
        }
    }

    /// As evaluate/edge.comp has positions: a cubic, and two coefficients of the perturbation.
    struct UvCurve {
        std::array<glm::vec2, 6> along{}, across{};
    };
    using UvCoefficient = std::function<glm::vec2(uint32_t)>;

    static UvCurve sectorUvCurve(const UvCoefficient& c, uint32_t sides, uint32_t side) {
        const uint32_t own = 1 + 6 * side, next = 1 + 6 * ((side + 1) % sides);
        const uint32_t last = 1 + 6 * ((side + sides - 1) % sides);
        const glm::vec2 t0 = c(own + 1), t1 = c(own + 2), chord = c(next) - c(own);
        const auto ray = static_cast<float>(SUPPLE_PM_RAY_SIDE(sides));
        UvCurve curve;
        curve.along = {c(own), c(own) + t0, c(next) + t1, c(next)};
        curve.across = {0.75f * ray * (t0 + c(last + 2)), c(own + 3) - 0.75f * t0,
                        c(own + 4) + 0.5f * (chord - (t0 + t1)), 0.75f * (ray * (t1 + c(next + 1)) - t1)};
        return curve;
    }

    static UvCurve bicubicUvCurve(const UvCoefficient& c, PatchClass patchClass, uint32_t side) {
        const bool polar = patchClass == PatchClass::polar; // its row 3 is the apex
        const auto net = [&](uint32_t i, uint32_t j) { return c(polar ? std::min(4 * j + i, 12u) : 4 * j + i); };
        const uint32_t quadSide = polar && side == 2 ? 3 : side;
        UvCurve curve;
        std::array<glm::vec2, 4> a;
        for (uint32_t k = 0; k < 4; ++k) {
            const uint32_t borderI[4] = {k, 3, 3 - k, 0}, borderJ[4] = {0, k, 3, 3 - k};
            const uint32_t insideI[4] = {k, 2, 3 - k, 1}, insideJ[4] = {1, k, 2, 3 - k};
            curve.along[k] = net(borderI[quadSide], borderJ[quadSide]);
            a[k] = net(insideI[quadSide], insideJ[quadSide]) - curve.along[k];
        }
        if (polar && side == 1) { // without the factor that is the distance to the apex
            a = {a[0], a[0] * (1.0f / 3.0f) + a[1], a[1] + a[2], 3.0f * a[2]};
        } else if (polar && side == 2) {
            a = {3.0f * a[1], a[1] + a[2], a[3] * (1.0f / 3.0f) + a[2], a[3]};
        }
        std::copy(a.begin(), a.end(), curve.across.begin());
        std::array<glm::vec2, 4> h{};
        for (uint32_t k = 0; k < 16 && patchClass == PatchClass::perturbed; ++k) {
            if (const uint32_t place = SUPPLE_PREP_FACE_EDGE(k); place / 4 == side) {
                h[place % 4] = c(16 + k);
            }
        }
        curve.along[4] = h[0];
        curve.along[5] = h[1];
        curve.across[4] = h[2] - h[0];
        curve.across[5] = h[3] - h[1];
        return curve;
    }

    /// The border curves of its edges; a polar patch's apex is none.
    [[nodiscard]] std::vector<BorderCurve> curvesOf(const PatchRange& range, uint32_t patch) const {
        const uint32_t* record = &tables_.words[size_t{4} * recordOf(range, patch)];
        if (rowOf(range.patchClass).borders == Borders::splines) {
            return splineNames(tables_, record);
        }
        std::vector<BorderCurve> curves = borderCurves(tables_, record, range.patchClass);
        if (range.patchClass == PatchClass::polar) {
            curves.erase(curves.begin() + 2);
        }
        if (rowOf(range.patchClass).borders == Borders::halves) {
            nameHalves(tables_, record, curves);
        }
        return curves;
    }
    /// Corners by their normals, of which faces between creases have their own, and sides by what no other edge has:
    /// their middle, of level 1. On endless creases that of the quad, since the two sides have different normals.
    static void nameHalves(const Tables& tables, const uint32_t* record, std::vector<BorderCurve>& curves) {
        const auto corner = [&](uint32_t i, uint32_t point) {
            const uint32_t normal = quadNormal(record, i);
            return normal == kNoNormal ? point : normal;
        };
        const uint32_t flags = record[4 * kQuadNetElement + kWindowLastWord];
        for (uint32_t i = 0; i < 4; ++i) {
            BorderCurve& curve = curves[i];
            curve[0] = corner(i, curve[0]);
            curve[3] = corner((i + 1) % 4, curve[3]);
            if ((flags >> (kCubicSide + i) & 1u) == 0) {
                const bool endless = std::bit_cast<float>(record[4 * kQuadSharpnessElement + i]) >= kInfiniteSharpness;
                curve[1] = curve[2] = quadNetPoint(tables, record, endless ? kNetMiddle : SUPPLE_QUAD_SIDE_MIDDLE(i));
            }
        }
    }

    /// The border curves of a Loop patch are no cubics. This names their ends and middles so that the two sides of an
    /// edge have the same, but for creases.
    static std::vector<BorderCurve> splineNames(const Tables& tables, const uint32_t* record) {
        const uint32_t* cage = record + size_t{4} * kTriangleCageElement;
        const uint32_t flags = record[4 * kTriangleCornerElement + 3];
        std::vector<BorderCurve> curves(3);
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t last = (i + 2) % 3;
            const bool sharp = (flags >> (kSharpTriangleSide + i) & 1u) != 0;
            BorderCurve& curve = curves[i];
            curve[0] = curves[last][3] = triangleCornerName(record, i);
            if ((flags >> (kWholeTriangleSide + i) & 1u) == 0) {
                curve[1] = triangleNetPoint(tables, record, 3 + i); // its middle, of level 1
                curve[2] = sharp ? triangleNetPoint(tables, record, 3 + last) : curve[1];
            } else { // of two plain vertices: the vertices opposite
                curve[1] = curve[2] = sharp ? cage[last] : std::min(cage[last], cage[6 + i]);
            }
        }
        return curves;
    }
    /// Faces between creases have normals of their own. Where the vertex is plain, those on one side of a crease have
    /// the limit point's name, those on the other side another one.
    static uint32_t triangleCornerName(const uint32_t* record, uint32_t i) {
        const uint32_t* cage = record + size_t{4} * kTriangleCageElement;
        const uint32_t* corners = record + size_t{4} * kTriangleCornerElement;
        const uint32_t flags = corners[3], last = (i + 2) % 3;
        if ((flags >> (kPlainTriangleCorner + i) & 1u) == 0) {
            return triangleNormal(record, i);
        }
        // Counter-clockwise, from the patch's own two edges on (loop::Triangles::cageOf()).
        const std::array<uint32_t, 6> around = {cage[(i + 1) % 3], cage[last],  cage[6 + last],
                                                cage[9 + last],    cage[3 + i], cage[6 + i]};
        // The crease runs along an edge and the opposite one. Inside the patch's side of it are the two that follow.
        const bool along = (flags >> (kSharpTriangleSide + i) & 1u) != 0;
        const bool back = (flags >> (kSharpTriangleSide + last) & 1u) != 0;
        const bool passes = (flags >> (kCreasedTriangleCorner + i) & 1u) != 0;
        if (!along && !back && !passes) {
            return corners[i];
        }
        const uint32_t crease = along ? 0 : back ? 4 : 5;
        const auto neighbour = [&](uint32_t steps) { return around[(crease + steps) % 6]; };
        const bool border =
            neighbour(4) == cage[0] || neighbour(5) == cage[0]; // cageOf() fills what is missing with it
        const bool other = !border && std::min(neighbour(1), neighbour(2)) > std::min(neighbour(4), neighbour(5));
        return corners[i] | (other ? 1u << 31 : 0u);
    }

    /// Derivatives on edges are those along it and towards the centre.
    static bool hasSectorFrames(PatchClass patchClass) {
        return rowOf(patchClass).hasSectors() || rowOf(patchClass).borders == Borders::splines;
    }

    [[nodiscard]] EdgeSource sourceOf(const Side& at) const {
        const PatchRange& range = rangeOf(tables_, at.patch);
        const uint32_t* record = &tables_.words[size_t{4} * recordOf(range, at.patch)];
        EdgeSource source;
        if (rowOf(range.patchClass).borders == Borders::halves) {
            source.border = {recordOf(range, at.patch), at.side, 0, 0};
            source.kind = kHalvesEdges;
            return source;
        }
        if (rowOf(range.patchClass).borders == Borders::splines) {
            source.border = {recordOf(range, at.patch), at.side, 0, 0};
            source.kind = range.patchClass == PatchClass::loopRegular ? kTriangleEdges : kIrregularTriangleEdges;
            return source;
        }
        source.border = curvesOf(range, at.patch)[at.side];
        if (!rowOf(range.patchClass).isBicubic()) {
            addSector(record, cornerCount(domainOf(range.patchClass)), at.side, source);
            return source;
        }
        const std::array<uint32_t, 16> net = netIndices(tables_, record, range.patchClass);
        const auto g = [&](uint32_t i, uint32_t j) { return net[4 * j + i]; };
        const bool polar = range.patchClass == PatchClass::polar;
        const uint32_t quadSide = polar && at.side == 2 ? 3 : at.side;
        for (uint32_t k = 0; k < 4; ++k) { // one step inside
            const uint32_t i[4] = {k, 2, 3 - k, 1}, j[4] = {1, k, 2, 3 - k};
            source.across[k] = g(i[quadSide], j[quadSide]);
        }
        if (polar) {
            source.kind = at.side != 0 ? kMixedEdges : kPlainEdges;
            source.flags = at.side == 1 ? kApexLastEdge : at.side == 2 ? kApexFirstEdge : 0;
        }
        if (range.patchClass == PatchClass::perturbed) {
            addPerturbation(record, at.side, source);
        }
        const uint32_t normal =
            tables_.cornerNormals ? record[4 * (recordElements(tables_, range.patchClass) - 1) + at.side] : kNoNormal;
        if (normal != kNoNormal) {
            source.flags |= kStoredNormalEdge;
            source.extra = normal;
        }
        return source;
    }

    static void addPerturbation(const uint32_t* record, uint32_t side, EdgeSource& source) {
        const uint32_t edge = record[8 + side];
        if ((edge & kStillEdgeOfPatch) != 0) {
            return;
        }
        source.kind = kPerturbedEdges;
        source.extra = edge & kEdgeOfPatchMask;
        source.flags |= (edge & kReversedEdgeOfPatch) != 0 ? kSwappedEdge : 0;
    }

    void addSector(const uint32_t* record, uint32_t sides, uint32_t i, EdgeSource& source) const {
        const uint32_t next = (i + 1) % sides, last = (i + sides - 1) % sides;
        const uint32_t innerWord = record[SUPPLE_PM_INNER_WORD(sides)];
        const uint32_t inner = SUPPLE_INNER(innerWord) + 1; // b211, b121, b112 a sector
        source.across = {tables_.tangents + SUPPLE_NEXT_SPOKE(record[SUPPLE_PM_SPOKE_WORD(i)]), inner + 3 * i,
                         inner + 3 * i + 1, tables_.tangents + SUPPLE_SPOKE(record[SUPPLE_PM_SPOKE_WORD(next)])};
        source.kind = kMixedEdges;
        source.flags = sides;
        if ((SUPPLE_SINGULAR(innerWord) & 1u << i) != 0) {
            source.flags |= kSingularEdge;
            source.extra = inner + 3 * last + 1;
        }
    }

    struct Edge {
        std::array<Side, 2> sides; ///< the second against the edge's own direction
        std::array<bool, 2> has{};
        uint32_t corner = kNoEdgeSample; ///< whose sample it stores
        uint32_t taken = 0;
    };
    Tables& tables_;
    bool attributes_, tangents_;
    std::vector<Edge> edges_;
};

/// Where a sample of a domain lies: on an edge at k, at a corner (k = 0), or inside.
struct Place {
    bool inside = true;
    uint32_t edge = 0; ///< or the number among those inside
    uint32_t k = 0;
};

std::vector<Place> placesOf(Domain domain, uint32_t rate) {
    std::vector<Place> all(sampleCount(domain, rate));
    for (uint32_t edge = 0; edge < cornerCount(domain); ++edge) {
        for (uint32_t k = 0; k < rate; ++k) {
            all[edgeSample(domain, rate, edge, k)] = {false, edge, k};
        }
    }
    if (domain == Domain::polar) { // the apex is a whole row
        for (uint32_t i = 0; i <= rate; ++i) {
            all[rate * (rate + 1) + i] = {false, 2, 0};
        }
    }
    uint32_t inside = 0;
    for (Place& place : all) {
        if (place.inside) {
            place.edge = inside++;
        }
    }
    return all;
}

/// Which vertices are a patch's, by its samples. `places`: those of its domain.
std::vector<uint32_t> verticesOf(const Tables& tables, const Evaluation& evaluation, const std::vector<Place>& places,
                                 uint32_t patch) {
    const uint32_t rate = evaluation.rate;
    const PatchRange& range = rangeOf(tables, patch);
    const uint32_t inside = evaluation.firstVertices[static_cast<size_t>(&range - tables.ranges.data())] +
                            (patch - range.firstPatch) * interiorCount(domainOf(range.patchClass), rate);
    const MeshTables::Patch& own = tables.mesh.patches[patch];
    std::vector<uint32_t> result;
    result.reserve(places.size());
    for (const Place& place : places) {
        if (place.inside) {
            result.push_back(inside + place.edge);
        } else if (place.k == 0) {
            result.push_back(evaluation.firstCornerVertex + own.corners[place.edge]);
        } else {
            const uint32_t k = own.reversed[place.edge] ? rate - place.k : place.k;
            result.push_back(evaluation.firstEdgeVertex + own.edges[place.edge] * (rate - 1) + k - 1);
        }
    }
    return result;
}

/// Patches of one class are sorted by material and part.
IndexedMesh triangleMesh(const Tables& tables) {
    IndexedMesh mesh;
    mesh.indices = tables.triangles.indices;
    for (const DrawRange& draw : tables.drawRanges) {
        mesh.ranges.push_back({draw.part, draw.material, 3 * draw.firstPatch, 3 * draw.patchCount});
    }
    return mesh;
}

} // namespace

uint32_t interiorCount(Domain domain, uint32_t rate) {
    switch (domain) {
    case Domain::triangle:
        return rate < 3 ? 0 : sampleCount(domain, rate - 3);
    case Domain::pentagon:
        return sampleCount(domain, rate - 1);
    default:
        return (rate - 1) * (rate - 1);
    }
}

void appendIndexedMesh(Tables& tables, bool attributes, bool tangents) {
    Builder(tables, attributes, tangents).build();
}

IndexedMesh indexedMesh(const Tables& tables, const Evaluation& evaluation) {
    if (!tables.triangles.indices.empty()) {
        return triangleMesh(tables);
    }
    std::vector<DrawRange> draws = tables.drawRanges;
    std::stable_sort(draws.begin(), draws.end(), [](const DrawRange& a, const DrawRange& b) {
        return std::tie(a.material, a.part) < std::tie(b.material, b.part);
    });
    IndexedMesh mesh;
    for (const DrawRange& draw : draws) {
        const auto first = static_cast<uint32_t>(mesh.indices.size());
        if (mesh.ranges.empty() || mesh.ranges.back().part != draw.part ||
            mesh.ranges.back().material != draw.material) {
            mesh.ranges.push_back({draw.part, draw.material, first, 0});
        }
        const std::vector<uint16_t> grid = gridIndices(draw.domain, evaluation.rate);
        const std::vector<Place> places = placesOf(draw.domain, evaluation.rate);
        for (uint32_t patch = draw.firstPatch; patch < draw.firstPatch + draw.patchCount; ++patch) {
            const std::vector<uint32_t> vertices = verticesOf(tables, evaluation, places, patch);
            for (const uint16_t sample : grid) {
                mesh.indices.push_back(vertices[sample]);
            }
        }
        mesh.ranges.back().indexCount += static_cast<uint32_t>(mesh.indices.size()) - first;
    }
    return mesh;
}

} // namespace supple::surface
