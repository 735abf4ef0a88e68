#include "surface/kernel/mesh.h"

#include "cage/features.h"
#include "surface/kernel/masks.h"
#include "surface/kernel/pattern.h"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace supple::surface::kernel {
namespace {

using cage::Cage;
using cage::kNone;
using cage::Topology;

/// A mesh on the way to the isolated level.
struct Level {
    Cage cage; ///< without creases, sharp vertices and holes
    std::vector<uint32_t> sourceFaces;
    std::vector<uint8_t> holes;
    Stencils stencils;
    // What a further step needs; the isolated level itself has none of it.
    Topology topology;
    std::vector<float> edgeSharpness, vertexSharpness;
};

/// Calls `copy` with every attribute that corners carry.
template <class Copy>
void forEachCornerAttribute(const Cage& from, Cage& to, Copy&& copy) {
    copy(from.cornerUvs, to.cornerUvs);
    copy(from.cornerUvs1, to.cornerUvs1);
    copy(from.cornerColors, to.cornerColors);
}

/// After the corners of a face that came from face `face` of `from`.
void closeFace(Level& to, const Level& from, uint32_t face) {
    to.cage.faceStarts.push_back(to.cage.cornerCount());
    to.sourceFaces.push_back(from.sourceFaces[face]);
    to.holes.push_back(from.holes[face]);
    if (!from.cage.faceMaterials.empty()) {
        to.cage.faceMaterials.push_back(from.cage.faceMaterials[face]);
    }
}

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

Level givenLevel(const Cage& cage) {
    Level level;
    level.cage = cage;
    level.cage.creases.clear();
    level.cage.sharpVertices.clear();
    level.cage.creaseScalars.clear();
    level.cage.holes.clear();
    level.cage.sourceVertices.clear(); // the isolated level's vertices come from no file
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        level.sourceFaces.push_back(f);
    }
    level.holes.assign(cage.faceCount(), 0);
    for (const uint32_t f : cage.holes) {
        if (f < cage.faceCount()) {
            level.holes[f] = 1;
        }
    }
    return level;
}

float markedInfinite(float sharpness) {
    return sharpness >= cage::kHardSharpness ? kInfiniteSharpness : sharpness;
}

/// Lays the cage's creases on the level and begins its stencils; adds to `notes` what names no edge or vertex.
void begin(Level& level, const Cage& cage, std::vector<std::string>& notes) {
    Cage featured;
    featured.positions.resize(cage.positions.size());
    featured.faceStarts = level.cage.faceStarts;
    featured.faceVertices = level.cage.faceVertices;
    featured.creases = cage.creases;
    featured.sharpVertices = cage.sharpVertices;
    const cage::Features features = cage::buildFeatures(featured, level.topology);
    notes.insert(notes.end(), features.unused.begin(), features.unused.end());
    if (!cage.creaseScalars.empty()) {
        notes.push_back(std::to_string(cage.creaseScalars.size()) +
                        " crease scalars: not used, subdivision knows sharpness alone");
    }
    for (const float sharpness : features.edgeSharpness) {
        level.edgeSharpness.push_back(markedInfinite(sharpness));
    }
    for (uint32_t v = 0; v < level.cage.vertexCount(); ++v) {
        const bool tip = level.topology.boundary[v] != 0 && level.topology.sectorCount(v) == 1;
        level.vertexSharpness.push_back(tip ? kInfiniteSharpness : markedInfinite(features.vertexSharpness[v]));
        level.stencils.starts.push_back(v);
        level.stencils.vertices.push_back(v);
        level.stencils.weights.push_back(1.0);
    }
    level.stencils.starts.push_back(level.cage.vertexCount());
}

// ---- one step of subdivision ----

/// Writes stencil rows of a level from combinations of its parent's points.
class RowWriter {
public:
    RowWriter(const Stencils& parent, uint32_t vertices, Stencils& out)
        : parent_(parent), out_(out), sums_(vertices, 0.0), met_(vertices, 0) {
        out_.starts.push_back(0);
    }

    void add(uint32_t parentPoint, double weight) {
        for (uint32_t i = parent_.starts[parentPoint]; i < parent_.starts[parentPoint + 1]; ++i) {
            const uint32_t v = parent_.vertices[i];
            if (met_[v] == 0) {
                met_[v] = 1;
                touched_.push_back(v);
            }
            sums_[v] += weight * parent_.weights[i];
        }
    }

    void close() {
        std::sort(touched_.begin(), touched_.end());
        for (const uint32_t v : touched_) {
            out_.vertices.push_back(v);
            out_.weights.push_back(sums_[v]);
            sums_[v] = 0.0;
            met_[v] = 0;
        }
        touched_.clear();
        out_.starts.push_back(static_cast<uint32_t>(out_.vertices.size()));
    }

private:
    const Stencils& parent_;
    Stencils& out_;
    std::vector<double> sums_; ///< per vertex of the cage
    std::vector<uint8_t> met_;
    std::vector<uint32_t> touched_;
};

/// A step of Catmull-Clark on any faces, or of Loop on triangles: the child level but for topology and sharpness.
class Refiner {
public:
    Refiner(const Level& parent, Subdivision subdivision, uint32_t cageVertices)
        : parent_(parent), subdivision_(subdivision), rows_(parent.stencils, cageVertices, child_.stencils) {}

    Level run() {
        for (uint32_t v = 0; v < parent_.cage.vertexCount(); ++v) {
            addVertexPoint(v);
        }
        for (uint32_t e = 0; e < parent_.topology.edges.size(); ++e) {
            addEdgePoint(e);
        }
        child_.cage.faceStarts.push_back(0);
        for (uint32_t f = 0; f < parent_.cage.faceCount(); ++f) {
            if (subdivision_ == Subdivision::catmullClark) {
                addFacePoint(f);
            }
        }
        for (uint32_t f = 0; f < parent_.cage.faceCount(); ++f) {
            if (subdivision_ == Subdivision::catmullClark) {
                addQuads(f);
            } else {
                addTriangles(f);
            }
        }
        return std::move(child_);
    }

private:
    /// What a corner of a child face is made of: corners of the parent face, all with the same weight.
    struct ChildCorner {
        uint32_t vertex = 0;
        uint32_t first = 0; ///< parent corners; first == second at a vertex point
        uint32_t second = 0;
        bool mean = false; ///< of the whole face instead
    };

    [[nodiscard]] uint32_t vertexAt(uint32_t corner) const { return parent_.cage.faceVertices[corner]; }
    [[nodiscard]] uint32_t faceOf(uint32_t corner) const { return parent_.topology.cornerFaces[corner]; }
    [[nodiscard]] uint32_t next(uint32_t corner) const {
        return cage::nextCorner(parent_.cage, faceOf(corner), corner);
    }
    [[nodiscard]] uint32_t previous(uint32_t corner) const {
        return cage::previousCorner(parent_.cage, faceOf(corner), corner);
    }

    void addVertexPoint(uint32_t v) {
        const Topology& topology = parent_.topology;
        const uint32_t base = topology.spokeStarts[v];
        sharpness_.clear();
        for (uint32_t k = 0; k < topology.spokeCount(v); ++k) {
            sharpness_.push_back(parent_.edgeSharpness[cage::spokeEdge(parent_.cage, topology, base + k)]);
        }
        const CentreStep step = centreStep(sharpness_, parent_.vertexSharpness[v]);
        if (step.smooth > 0.0) {
            addSmoothVertex(v, step.smooth);
        }
        if (step.crease > 0.0) {
            rows_.add(v, 0.75 * step.crease);
            rows_.add(topology.spokeVertices[base + step.first], 0.125 * step.crease);
            rows_.add(topology.spokeVertices[base + step.second], 0.125 * step.crease);
        }
        if (step.corner > 0.0) {
            rows_.add(v, step.corner);
        }
        rows_.close();
    }

    void addSmoothVertex(uint32_t v, double share) {
        const Topology& topology = parent_.topology;
        const double k = topology.sectorCount(v);
        const bool quads = subdivision_ == Subdivision::catmullClark;
        const CentreWeights loop = refineWeights(Subdivision::loop, topology.sectorCount(v));
        const double spoke = quads ? 1.0 / (k * k) : loop.spoke;
        rows_.add(v, share * (quads ? (k - 2.0) / k : loop.centre));
        for (uint32_t s = topology.spokeStarts[v]; s < topology.spokeStarts[v + 1]; ++s) {
            rows_.add(topology.spokeVertices[s], share * spoke);
            if (quads) {
                addFaceMean(faceOf(topology.sectorCorners[s]), share / (k * k));
            }
        }
    }

    void addFaceMean(uint32_t face, double weight) {
        for (uint32_t c = parent_.cage.faceStarts[face]; c < parent_.cage.faceStarts[face + 1]; ++c) {
            rows_.add(vertexAt(c), weight / parent_.cage.sides(face));
        }
    }

    void addEdgePoint(uint32_t e) {
        const auto [corner, twin] = parent_.topology.edges[e];
        const double sharp = std::clamp(static_cast<double>(parent_.edgeSharpness[e]), 0.0, 1.0);
        if (sharp > 0.0) {
            rows_.add(vertexAt(corner), 0.5 * sharp);
            rows_.add(vertexAt(next(corner)), 0.5 * sharp);
        }
        if (sharp < 1.0) {
            for (const uint32_t c : {corner, twin}) {
                if (subdivision_ == Subdivision::catmullClark) {
                    rows_.add(vertexAt(c), 0.25 * (1.0 - sharp));
                    addFaceMean(faceOf(c), 0.25 * (1.0 - sharp));
                } else {
                    rows_.add(vertexAt(c), 0.375 * (1.0 - sharp));
                    rows_.add(vertexAt(previous(c)), 0.125 * (1.0 - sharp));
                }
            }
        }
        rows_.close();
    }

    void addFacePoint(uint32_t f) {
        addFaceMean(f, 1.0);
        rows_.close();
    }

    [[nodiscard]] ChildCorner vertexPoint(uint32_t corner) const { return {vertexAt(corner), corner, corner, false}; }
    [[nodiscard]] ChildCorner edgePoint(uint32_t corner) const {
        return {parent_.cage.vertexCount() + parent_.topology.cornerEdges[corner], corner, next(corner), false};
    }
    [[nodiscard]] ChildCorner facePoint(uint32_t face) const {
        const auto edges = static_cast<uint32_t>(parent_.topology.edges.size());
        return {parent_.cage.vertexCount() + edges + face, 0, 0, true};
    }

    void addQuads(uint32_t f) {
        for (uint32_t c = parent_.cage.faceStarts[f]; c < parent_.cage.faceStarts[f + 1]; ++c) {
            addFace(f, std::array{vertexPoint(c), edgePoint(c), facePoint(f), edgePoint(previous(c))});
        }
    }

    void addTriangles(uint32_t f) {
        const uint32_t first = parent_.cage.faceStarts[f];
        for (uint32_t c = first; c < first + 3; ++c) {
            addFace(f, std::array{vertexPoint(c), edgePoint(c), edgePoint(previous(c))});
        }
        addFace(f, std::array{edgePoint(first), edgePoint(first + 1), edgePoint(first + 2)});
    }

    void addFace(uint32_t f, std::span<const ChildCorner> corners) {
        for (const ChildCorner& corner : corners) {
            child_.cage.faceVertices.push_back(corner.vertex);
            forEachCornerAttribute(parent_.cage, child_.cage, [&](const auto& from, auto& to) {
                if (!from.empty()) {
                    to.push_back(corner.mean ? faceMean(from, f) : (from[corner.first] + from[corner.second]) * 0.5f);
                }
            });
        }
        closeFace(child_, parent_, f);
    }

    template <class Value>
    [[nodiscard]] Value faceMean(const std::vector<Value>& values, uint32_t f) const {
        Value sum(0.0f);
        for (uint32_t c = parent_.cage.faceStarts[f]; c < parent_.cage.faceStarts[f + 1]; ++c) {
            sum += values[c];
        }
        return sum / static_cast<float>(parent_.cage.sides(f));
    }

    const Level& parent_;
    Subdivision subdivision_;
    Level child_;
    RowWriter rows_;
    std::vector<float> sharpness_; ///< of the vertex at work
};

void placeVertices(Level& level, const std::vector<glm::vec3>& positions) {
    const Stencils& stencils = level.stencils;
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        glm::dvec3 sum(0.0);
        for (uint32_t i = stencils.starts[row]; i < stencils.starts[row + 1]; ++i) {
            sum += stencils.weights[i] * glm::dvec3(positions[stencils.vertices[i]]);
        }
        level.cage.positions.emplace_back(sum);
    }
}

/// Gives a child of Catmull-Clark what another step asks of it.
std::optional<Error> equip(Level& child, const Level& parent) {
    Result<Topology> topology = cage::buildTopology(child.cage);
    if (!topology.ok()) {
        return topology.error();
    }
    child.topology = std::move(*topology);
    child.edgeSharpness.assign(child.topology.edges.size(), 0.0f);
    child.vertexSharpness.assign(child.cage.vertexCount(), 0.0f);
    for (uint32_t v = 0; v < parent.cage.vertexCount(); ++v) {
        child.vertexSharpness[v] = softened(parent.vertexSharpness[v], 1);
    }
    // The quad of corner c begins with the first half of the edge from c; the quad of the next corner ends with the
    // second.
    for (uint32_t c = 0; c < parent.cage.cornerCount(); ++c) {
        const float sharpness = softened(parent.edgeSharpness[parent.topology.cornerEdges[c]], 1);
        const uint32_t next = cage::nextCorner(parent.cage, parent.topology.cornerFaces[c], c);
        child.edgeSharpness[child.topology.cornerEdges[4 * c]] = sharpness;
        child.edgeSharpness[child.topology.cornerEdges[4 * next + 3]] = sharpness;
    }
    return std::nullopt;
}

// ---- fragments ----

/// Cuts the isolated level into fragments, by the topology of its parent.
class FragmentBuilder {
public:
    FragmentBuilder(const Level& parent, Mesh& mesh)
        : parent_(parent), topology_(parent.topology), mesh_(mesh),
          quads_(mesh.subdivision == Subdivision::catmullClark) {}

    void run() {
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
    begin(parent, cage, mesh.notes);
    mesh.isolationSteps = subdivision == Subdivision::catmullClark && !allOf(cage, 4) ? 2 : 1;
    if (mesh.isolationSteps == 2) {
        Level quads = Refiner(parent, subdivision, cage.vertexCount()).run();
        placeVertices(quads, cage.positions);
        if (std::optional<Error> error = equip(quads, parent)) {
            return std::move(*error);
        }
        parent = std::move(quads);
    }
    Level isolated = Refiner(parent, subdivision, cage.vertexCount()).run();
    placeVertices(isolated, cage.positions);
    FragmentBuilder(parent, mesh).run();
    for (const uint32_t v : isolated.cage.faceVertices) {
        mesh.cornerSources.push_back(v < cage.vertexCount() ? v : kNone);
    }
    mesh.cage = std::move(isolated.cage);
    mesh.sourceFaces = std::move(isolated.sourceFaces);
    mesh.holes = std::move(isolated.holes);
    mesh.stencils = std::move(isolated.stencils);
    return mesh;
}

} // namespace

Result<Mesh> buildMesh(const Cage& cage, Subdivision subdivision) {
    try {
        return build(cage, subdivision);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::hostMemory, "out of memory for the isolated level of subdivision"};
    }
}

} // namespace supple::surface::kernel
