// What two sectors have in common must come out with the same bits from both, in float, as on the device.
#include "tests/support/subdivision_surface.h"
#include "tests/support/subdivision_zoo.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <set>
#include <string>
#include <utility>

namespace supple::surface::subdivision {
namespace {

using Edge = std::pair<uint32_t, uint32_t>; ///< of the isolated level, smaller vertex first

Edge edgeOf(uint32_t a, uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

/// The edges of the isolated level that are still sharp `steps` steps later: pieces of spokes.
std::set<Edge> sharpEdges(const Mesh& mesh, uint32_t steps) {
    std::set<Edge> edges;
    const uint32_t stride = mesh.subdivision == Subdivision::catmullClark ? 2 : 1;
    for (const Fragment& fragment : mesh.fragments) {
        for (uint32_t k = 0; fragment.kind == FragmentKind::vertex && k < fragment.spokes(); ++k) {
            const float sharpness = mesh.spokeSharpness[fragment.firstSpoke + k];
            if (sharpness > static_cast<float>(steps)) {
                edges.insert(edgeOf(mesh.net[fragment.firstNet], mesh.net[fragment.firstNet + 1 + stride * k]));
            }
        }
    }
    return edges;
}

/// Samples along a face's side, from its corner `side` on.
std::vector<uint32_t> sideSamples(Subdivision subdivision, uint32_t n, uint32_t side) {
    std::vector<uint32_t> samples;
    const auto at = [&](uint32_t a, uint32_t b) {
        return subdivision == Subdivision::catmullClark ? b * (n + 1) + a : b * (n + 1) - b * (b - 1) / 2 + a;
    };
    for (uint32_t k = 0; k <= n; ++k) {
        if (subdivision == Subdivision::loop) {
            samples.push_back(side == 0 ? at(k, 0) : side == 1 ? at(n - k, k) : at(0, n - k));
        } else {
            samples.push_back(side == 0 ? at(k, 0) : side == 1 ? at(n, k) : side == 2 ? at(n - k, n) : at(0, n - k));
        }
    }
    return samples;
}

/// Bits, with the two zeros as one: what is 0 may come out as either.
bool same(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i) {
        if (std::bit_cast<uint32_t>(a[i] + 0.0f) != std::bit_cast<uint32_t>(b[i] + 0.0f)) {
            return false;
        }
    }
    return true;
}

struct Counts {
    uint64_t shared = 0, refined = 0, positions = 0; ///< points that several sectors have, and those that differ
    uint64_t smooth = 0, normals = 0;                ///< pairs of samples on edges that are not sharp

    void add(const Counts& other) {
        shared += other.shared;
        refined += other.refined;
        positions += other.positions;
        smooth += other.smooth;
        normals += other.normals;
    }
};

/// A point of the level's edges as the first sector had it.
struct Met {
    glm::vec3 refined{0.0f}, position{0.0f};
    bool known = false, shared = false;
};

Counts compare(const Mesh& mesh, const cage::Topology& topology, const std::vector<glm::vec3>& isolated,
               uint32_t steps) {
    const std::set<Edge> sharp = sharpEdges(mesh, steps);
    const uint32_t n = 1u << steps;
    const size_t edges = topology.edges.size();
    std::vector<Met> vertices(mesh.cage.vertexCount()), inside(edges * n); // inside: from the smaller vertex on
    std::vector<glm::vec3> normals(edges * (n + 1));
    std::vector<uint8_t> hasNormals(edges, 0);
    Counts counts;
    forEachSector<float>(mesh, isolated, steps, [&](const SectorGrid<float>& grid) {
        const uint32_t sides = mesh.cage.sides(grid.face), first = mesh.cage.faceStarts[grid.face];
        const uint32_t* const corners = mesh.cage.faceVertices.data() + first;
        for (uint32_t side = 0; side < sides; ++side) {
            const uint32_t from = corners[side], to = corners[(side + 1) % sides];
            std::vector<uint32_t> samples = sideSamples(mesh.subdivision, n, side);
            if (from > to) {
                std::reverse(samples.begin(), samples.end());
            }
            const Edge edge = edgeOf(from, to);
            const size_t e = topology.cornerEdges[first + side];
            for (uint32_t k = 0; k <= n; ++k) {
                const Sample<float>& sample = grid.samples[samples[k]];
                Met& met = k == 0 ? vertices[edge.first] : k == n ? vertices[edge.second] : inside[e * n + k];
                if (!met.known) {
                    met = {sample.refined, sample.position, true, false};
                } else {
                    counts.shared += met.shared ? 0 : 1;
                    met.shared = true;
                    counts.refined += same(met.refined, sample.refined) ? 0 : 1;
                    counts.positions += same(met.position, sample.position) ? 0 : 1;
                }
            }
            if (sharp.contains(edge)) {
                continue;
            }
            for (uint32_t k = 0; k <= n; ++k) {
                const glm::vec3 normal = grid.samples[samples[k]].normal;
                glm::vec3& other = normals[e * (n + 1) + k];
                if (hasNormals[e] == 0) {
                    other = normal;
                } else {
                    ++counts.smooth;
                    counts.normals += same(other, normal) ? 0 : 1;
                }
            }
            hasNormals[e] = 1;
        }
    });
    return counts;
}

class SubdivisionBits : public testing::TestWithParam<Subdivision> {};

TEST_P(SubdivisionBits, sharedPoints) {
    Counts all;
    for (const test::SubdivisionCage& entry : test::subdivisionZoo()) {
        SCOPED_TRACE(entry.name);
        const Mesh mesh = test::subdivisionMesh(entry.cage, GetParam());
        const Result<cage::Topology> topology = cage::buildTopology(mesh.cage);
        ASSERT_TRUE(topology.ok()) << topology.error().message;
        const std::vector<glm::vec3> isolated = isolate<float>(mesh, entry.cage.positions);
        for (uint32_t steps = 0; steps <= 4; ++steps) {
            const Counts counts = compare(mesh, *topology, isolated, steps);
            EXPECT_EQ(counts.refined, 0u) << steps;
            EXPECT_EQ(counts.positions, 0u) << steps;
            EXPECT_EQ(counts.normals, 0u) << steps;
            EXPECT_GT(counts.shared, 0u);
            all.add(counts);
        }
    }
    std::printf("%llu shared points: %llu differ when refined, %llu at the limit; %llu pairs of normals on smooth "
                "edges: %llu differ\n",
                static_cast<unsigned long long>(all.shared), static_cast<unsigned long long>(all.refined),
                static_cast<unsigned long long>(all.positions), static_cast<unsigned long long>(all.smooth),
                static_cast<unsigned long long>(all.normals));
}

INSTANTIATE_TEST_SUITE_P(Subdivision, SubdivisionBits, testing::Values(Subdivision::catmullClark, Subdivision::loop),
                         [](const auto& entry) {
                             return entry.param == Subdivision::catmullClark ? "catmullClark" : "loop";
                         });

} // namespace
} // namespace supple::surface::subdivision
