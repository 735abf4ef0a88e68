#include "cage/topology.h"

#include "cage/message.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace supple::cage {
namespace {

/// Slots and corners are 32-bit and kNone is taken: a boundary vertex adds one slot to its corners, so twice the corner
/// count bounds every index.
constexpr size_t kMaxIndexed = 0x7FFFFFFFu;

Error fault(std::string message) {
    return {ErrorCode::asset, std::move(message)};
}

std::string countWord(size_t count) {
    static const char* const kWords[] = {"no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"};
    return count < std::size(kWords) ? kWords[count] : std::to_string(count);
}

std::string edgeName(uint32_t a, uint32_t b) {
    return "edge (" + std::to_string(a) + ", " + std::to_string(b) + ")";
}

std::string faceName(uint32_t face) {
    return "face " + std::to_string(face);
}

/// Checks the arrays themselves: after this, every index in them may be followed without a look.
std::optional<Error> checkArrays(const Cage& cage) {
    if (cage.faceCount() == 0) {
        return fault("the cage has no faces");
    }
    if (cage.faceVertices.size() > kMaxIndexed || cage.positions.size() > kMaxIndexed ||
        cage.faceStarts.size() > kMaxIndexed) {
        return Error{ErrorCode::limit, "the cage has more corners or vertices than 2^31 - 1"};
    }
    const std::vector<uint32_t>& starts = cage.faceStarts;
    if (starts.front() != 0) {
        return fault("the corners of face 0 start at " + std::to_string(starts.front()) + " and not at 0");
    }
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        if (starts[f + 1] < starts[f]) {
            return fault(faceName(f) + ": ends at corner " + std::to_string(starts[f + 1]) + ", before its start at " +
                         std::to_string(starts[f]));
        }
    }
    if (starts.back() != cage.faceVertices.size()) {
        return fault("the faces have " + std::to_string(starts.back()) + " corners, but " +
                     std::to_string(cage.faceVertices.size()) + " vertex indices are given");
    }
    std::vector<uint32_t> seenIn(cage.positions.size(), kNone); // per vertex: the last face that used it
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        if (cage.sides(f) < 3) {
            return fault(faceName(f) + ": " + countWord(cage.sides(f)) + (cage.sides(f) == 1 ? " corner" : " corners") +
                         ", at least three are needed");
        }
        for (uint32_t c = starts[f]; c < starts[f + 1]; ++c) {
            const uint32_t v = cage.faceVertices[c];
            if (v >= cage.positions.size()) {
                return fault(faceName(f) + ": corner " + std::to_string(c - starts[f]) + " is vertex " +
                             std::to_string(v) + ", but there are only " + std::to_string(cage.positions.size()) +
                             " vertices");
            }
            if (seenIn[v] == f) {
                return fault(faceName(f) + ": vertex " + std::to_string(v) + " appears more than once");
            }
            seenIn[v] = f;
        }
    }
    return std::nullopt;
}

/// Whether two faces are the same polygon: the same vertices in the same cyclic order.
bool samePolygon(const Cage& cage, uint32_t f, uint32_t g) {
    const uint32_t sides = cage.sides(f);
    if (sides != cage.sides(g)) {
        return false;
    }
    const auto a = cage.faceVertices.begin() + cage.faceStarts[f];
    const auto b = cage.faceVertices.begin() + cage.faceStarts[g];
    const auto shift = static_cast<uint32_t>(std::find(b, b + sides, *a) - b);
    for (uint32_t k = 0; k < sides; ++k) {
        if (shift == sides || a[k] != b[(shift + k) % sides]) {
            return false;
        }
    }
    return true;
}

/// A half-edge seen from its smaller vertex.
struct EdgeUse {
    uint32_t larger = 0;
    uint32_t corner = 0;
};

Error crowdedEdge(const Cage& cage, const Topology& topology, uint32_t smaller, const EdgeUse* uses, size_t count) {
    std::string message = edgeName(smaller, uses->larger) + ": " + countWord(count) + " faces meet here: ";
    const size_t listed = std::min(count, kMaxListedFaces);
    std::string duplicate;
    for (size_t i = 0; i < listed; ++i) {
        const uint32_t f = topology.cornerFaces[uses[i].corner];
        message += (i == 0 ? "" : ", ") + std::to_string(f);
        for (size_t j = 0; j < i && duplicate.empty(); ++j) {
            const uint32_t g = topology.cornerFaces[uses[j].corner];
            if (samePolygon(cage, g, f)) {
                duplicate = " (" + std::to_string(f) + " duplicates " + std::to_string(g) + ")";
            }
        }
    }
    message += listed < count ? ", ..." : "";
    return fault(message + duplicate);
}

/// Pairs opposite half-edges. Half-edges are bucketed by the smaller of their two vertices and sorted within a bucket:
/// linear but for the sort, whose buckets are fans.
std::optional<Error> pairHalfEdges(const Cage& cage, Topology& topology) {
    const uint32_t cornerCount = cage.cornerCount();
    const uint32_t vertexCount = cage.vertexCount();
    const auto ends = [&](uint32_t corner) {
        const uint32_t a = cage.faceVertices[corner];
        const uint32_t b = cage.faceVertices[nextCorner(cage, topology.cornerFaces[corner], corner)];
        return std::pair{std::min(a, b), std::max(a, b)};
    };
    std::vector<uint32_t> starts(vertexCount + 1, 0);
    for (uint32_t c = 0; c < cornerCount; ++c) {
        ++starts[ends(c).first + 1];
    }
    for (uint32_t v = 0; v < vertexCount; ++v) {
        starts[v + 1] += starts[v];
    }
    std::vector<EdgeUse> uses(cornerCount);
    {
        std::vector<uint32_t> next(starts.begin(), starts.end() - 1);
        for (uint32_t c = 0; c < cornerCount; ++c) {
            const auto [smaller, larger] = ends(c);
            uses[next[smaller]++] = {larger, c};
        }
    }
    topology.twins.assign(cornerCount, kNone);
    for (uint32_t v = 0; v < vertexCount; ++v) {
        EdgeUse* const first = uses.data() + starts[v];
        EdgeUse* const last = uses.data() + starts[v + 1];
        std::sort(first, last, [](const EdgeUse& a, const EdgeUse& b) {
            return a.larger != b.larger ? a.larger < b.larger : a.corner < b.corner;
        });
        for (EdgeUse* use = first; use != last;) {
            EdgeUse* end = use;
            while (end != last && end->larger == use->larger) {
                ++end;
            }
            const auto count = static_cast<size_t>(end - use);
            if (count > 2) {
                return crowdedEdge(cage, topology, v, use, count);
            }
            if (count == 2) {
                const uint32_t c = use[0].corner;
                const uint32_t o = use[1].corner;
                if (cage.faceVertices[c] == cage.faceVertices[o]) {
                    const uint32_t f = topology.cornerFaces[c];
                    const uint32_t g = topology.cornerFaces[o];
                    const uint32_t from = cage.faceVertices[c];
                    return fault(edgeName(from, from == v ? use->larger : v) + ": " +
                                 (samePolygon(cage, f, g) ? "duplicate face: faces " : "flipped orientation: faces ") +
                                 std::to_string(f) + " and " + std::to_string(g) +
                                 " run along it in the same direction");
                }
                topology.twins[c] = o;
                topology.twins[o] = c;
            }
            use = end;
        }
    }
    return std::nullopt;
}

/// Fills the fan of a vertex whose first slot is `base`, from the corner `start` on; returns how many sectors it has.
/// Counter-clockwise: across the edge to the previous vertex of the face. Twins are an involution, so the walk either
/// meets the boundary or comes back to its start.
uint32_t walkFan(const Cage& cage, uint32_t start, uint32_t base, Topology& topology) {
    uint32_t walked = 0;
    for (uint32_t c = start;;) {
        const uint32_t f = topology.cornerFaces[c];
        const uint32_t back = previousCorner(cage, f, c);
        topology.spokeVertices[base + walked] = cage.faceVertices[nextCorner(cage, f, c)];
        topology.sectorCorners[base + walked] = c;
        topology.cornerSpokes[c] = base + walked;
        ++walked;
        const uint32_t next = topology.twins[back];
        topology.cornerSpokesBack[c] = next == start ? base : base + walked;
        if (next == kNone) {
            topology.spokeVertices[base + walked] = cage.faceVertices[back];
        }
        if (next == kNone || next == start) {
            return walked;
        }
        c = next;
    }
}

std::optional<Error> buildFans(const Cage& cage, Topology& topology) {
    const uint32_t cornerCount = cage.cornerCount();
    const uint32_t vertexCount = cage.vertexCount();
    // Per vertex: its corners, the smallest of them, and the smallest that starts a fan (no face on its clockwise
    // side).
    std::vector<uint32_t> counts(vertexCount, 0);
    std::vector<uint32_t> smallest(vertexCount, kNone);
    std::vector<uint32_t> fanStarts(vertexCount, kNone);
    for (uint32_t c = cornerCount; c-- > 0;) {
        const uint32_t v = cage.faceVertices[c];
        ++counts[v];
        smallest[v] = c;
        if (topology.twins[c] == kNone) {
            fanStarts[v] = c;
        }
    }
    topology.spokeStarts.assign(vertexCount + 1, 0);
    topology.boundary.assign(vertexCount, 0);
    for (uint32_t v = 0; v < vertexCount; ++v) {
        topology.boundary[v] = fanStarts[v] != kNone ? 1 : 0;
        topology.spokeStarts[v + 1] = topology.spokeStarts[v] + counts[v] + topology.boundary[v];
    }
    const uint32_t slotCount = topology.spokeStarts.back();
    topology.spokeVertices.assign(slotCount, kNone);
    topology.sectorCorners.assign(slotCount, kNone);
    topology.cornerSpokes.assign(cornerCount, kNone);
    topology.cornerSpokesBack.assign(cornerCount, kNone);

    for (uint32_t v = 0; v < vertexCount; ++v) {
        if (counts[v] == 0) {
            return fault("vertex " + std::to_string(v) + ": no face uses it");
        }
        const bool boundary = topology.boundary[v] != 0;
        const uint32_t base = topology.spokeStarts[v];
        const uint32_t walked = walkFan(cage, boundary ? fanStarts[v] : smallest[v], base, topology);
        if (walked != counts[v]) {
            std::string message = "vertex " + std::to_string(v) + ": several separate fans of faces meet here";
            message += " (" + countWord(counts[v]) + " faces, " + countWord(walked) + " in the first fan)";
            return fault(std::move(message));
        }
        if (!boundary && counts[v] == 2) {
            const uint32_t f = topology.cornerFaces[topology.sectorCorners[base]];
            const uint32_t g = topology.cornerFaces[topology.sectorCorners[base + 1]];
            return fault("vertex " + std::to_string(v) + ": interior valence 2, between faces " + std::to_string(f) +
                         " and " + std::to_string(g));
        }
    }
    return std::nullopt;
}

void numberEdges(Topology& topology) {
    const auto cornerCount = static_cast<uint32_t>(topology.twins.size());
    topology.cornerEdges.assign(cornerCount, kNone);
    for (uint32_t c = 0; c < cornerCount; ++c) {
        const uint32_t twin = topology.twins[c];
        if (twin != kNone && twin < c) {
            topology.cornerEdges[c] = topology.cornerEdges[twin];
            continue;
        }
        topology.cornerEdges[c] = static_cast<uint32_t>(topology.edges.size());
        topology.edges.push_back({c, twin});
    }
}

} // namespace

uint32_t nextCorner(const Cage& cage, uint32_t face, uint32_t corner) {
    return corner + 1 == cage.faceStarts[face + 1] ? cage.faceStarts[face] : corner + 1;
}

uint32_t previousCorner(const Cage& cage, uint32_t face, uint32_t corner) {
    return corner == cage.faceStarts[face] ? cage.faceStarts[face + 1] - 1 : corner - 1;
}

uint32_t spokeEdge(const Cage& cage, const Topology& topology, uint32_t spoke) {
    const uint32_t corner = topology.sectorCorners[spoke];
    if (corner != kNone) {
        return topology.cornerEdges[corner];
    }
    const uint32_t last = topology.sectorCorners[spoke - 1]; // the far side of a boundary fan
    return topology.cornerEdges[previousCorner(cage, topology.cornerFaces[last], last)];
}

uint32_t findEdge(const Cage& cage, const Topology& topology, uint32_t a, uint32_t b) {
    if (std::max(a, b) >= cage.vertexCount()) {
        return kNone;
    }
    if (topology.spokeCount(b) < topology.spokeCount(a)) {
        std::swap(a, b);
    }
    for (uint32_t s = topology.spokeStarts[a]; s < topology.spokeStarts[a + 1]; ++s) {
        if (topology.spokeVertices[s] == b) {
            return spokeEdge(cage, topology, s);
        }
    }
    return kNone;
}

Result<Topology> buildTopology(const Cage& cage) {
    if (std::optional<Error> error = checkArrays(cage)) {
        return *error;
    }
    Topology topology;
    topology.cornerFaces.resize(cage.cornerCount());
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        std::fill(topology.cornerFaces.begin() + cage.faceStarts[f],
                  topology.cornerFaces.begin() + cage.faceStarts[f + 1], f);
    }
    if (std::optional<Error> error = pairHalfEdges(cage, topology)) {
        return *error;
    }
    if (std::optional<Error> error = buildFans(cage, topology)) {
        return *error;
    }
    numberEdges(topology);
    return topology;
}

} // namespace supple::cage
