// SUPPLE_GROUP_INDEXED_MESH against the same group without: every sample of every patch by the index buffer, its
// position to the bit, its normal, its attributes; and the mesh: closed where the cage's surface is.
#include "cage/features.h"
#include "surface/grid.h"
#include "tests/support/loop_triangles.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_gpu.h"
#include "tests/support/pm_surface.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <vector>

namespace supple::test {
namespace {

constexpr uint32_t kShared = SUPPLE_GROUP_INDEXED_MESH;

std::vector<uint32_t> readIndices(const GpuSurface& gpu) {
    const SuppleBufferRange& view = gpu.output().indices();
    EXPECT_EQ(view.stride, 4u);
    const Result<std::vector<std::byte>> bytes = testDevice()->readBuffer(view);
    EXPECT_TRUE(bytes.ok());
    std::vector<uint32_t> indices(bytes.ok() ? bytes->size() / 4 : 0);
    std::memcpy(indices.data(), bytes->data(), indices.size() * 4);
    return indices;
}

/// The surface vertex of every sample, as the header says: triangles come patch by patch, as those of grids do. A
/// sample that no triangle has, as one of the many at a polar patch's apex, has none.
std::vector<std::vector<uint32_t>> sharedVertices(const GpuSurface& grid, const GpuSurface& shared,
                                                  const std::vector<uint32_t>& indices) {
    const uint32_t rate = grid.output().grid.rate;
    std::vector<std::vector<uint32_t>> vertices(grid.patches().size());
    std::map<uint32_t, uint32_t> next; // by material: the first index not yet taken
    for (uint32_t r = 0; r < shared.output().grid.drawRangeCount; ++r) {
        const SuppleDrawRange& range = shared.output().grid.drawRanges[r];
        EXPECT_EQ(range.domain, SUPPLE_DOMAIN_MESH);
        EXPECT_EQ(range.patchCount, 1u);
        EXPECT_EQ(range.firstVertex, 0u);
        EXPECT_EQ(range.samplesPerPatch, shared.output().grid.vertexCount);
        EXPECT_TRUE(next.emplace(range.material, range.firstIndex).second) << "one range a material";
    }
    for (uint32_t p = 0; p < vertices.size(); ++p) {
        const SuppleDrawRange& range = grid.rangeOf(p);
        const std::vector<uint16_t> own = surface::gridIndices(static_cast<surface::Domain>(range.domain), rate);
        vertices[p].assign(grid.sampleCount(p), cage::kNone);
        uint32_t& first = next.at(range.material);
        for (const uint16_t sample : own) {
            const uint32_t vertex = indices.at(first++);
            EXPECT_LT(vertex, shared.output().grid.vertexCount);
            uint32_t& known = vertices[p][sample];
            EXPECT_TRUE(known == cage::kNone || known == vertex) << "patch " << p << ", sample " << sample;
            known = vertex;
        }
    }
    for (uint32_t r = 0; r < shared.output().grid.drawRangeCount; ++r) {
        const SuppleDrawRange& range = shared.output().grid.drawRanges[r];
        EXPECT_EQ(next.at(range.material), range.firstIndex + range.indexCount);
    }
    return vertices;
}

struct ComparedMesh {
    ComparedBits positions;
    double inside = 0.0, border = 0.0; ///< largest angle between normals, degrees
    uint64_t above = 0;                ///< border normals more than 0.02 degrees apart
    uint64_t vertices = 0, samples = 0;
    void print(const char* what) const {
        std::printf("%s: %llu vertices of %llu samples, %llu positions differ; normals inside %.4f, on borders %.4f "
                    "degrees, %llu above 0.02\n",
                    what, static_cast<unsigned long long>(vertices), static_cast<unsigned long long>(samples),
                    static_cast<unsigned long long>(positions.different), inside, border,
                    static_cast<unsigned long long>(above));
    }
};

bool onBorder(surface::Domain domain, uint32_t rate, uint32_t sample) {
    for (uint32_t e = 0; e < surface::cornerCount(domain); ++e) {
        for (uint32_t k = 0; k <= rate; ++k) {
            if (surface::edgeSample(domain, rate, e, k) == sample) {
                return true;
            }
        }
    }
    return domain == surface::Domain::polar && sample >= rate * (rate + 1);
}

/// Sample by sample; `singular` says which corners have no normal of their own.
template <class Singular>
void compareSamples(const GpuSurface& grid, const GpuSurface& shared, ComparedMesh& all, Singular&& singular) {
    const std::vector<uint32_t> indices = readIndices(shared);
    const std::vector<std::vector<uint32_t>> vertices = sharedVertices(grid, shared, indices);
    const uint32_t rate = grid.output().grid.rate;
    std::map<uint32_t, std::vector<bool>> borders; // by domain
    std::vector<bool> used(shared.output().grid.vertexCount, false);
    for (uint32_t p = 0; p < vertices.size(); ++p) {
        const auto domain = static_cast<surface::Domain>(grid.rangeOf(p).domain);
        std::vector<bool>& border = borders[static_cast<uint32_t>(domain)];
        for (uint32_t s = 0; border.size() < vertices[p].size(); ++s) {
            border.push_back(onBorder(domain, rate, s));
        }
        for (uint32_t s = 0; s < vertices[p].size(); ++s) {
            if (vertices[p][s] == cage::kNone) {
                continue;
            }
            used[vertices[p][s]] = true;
            const GpuSurface::Vertex &a = grid.vertex(0, p, s), &b = shared.sharedVertex(0, vertices[p][s]);
            all.positions.compare(a.position, b.position);
            const double angle = angleDegrees(a.normal, b.normal);
            if (!border[s]) {
                raise(all.inside, angle);
            } else if (!singular(p, s)) {
                raise(all.border, angle);
                all.above += angle <= 0.02 ? 0 : 1;
            } else {
                EXPECT_LE(angle, 0.2) << "a singular corner, patch " << p;
            }
        }
        all.samples += vertices[p].size();
    }
    all.vertices += used.size();
    EXPECT_TRUE(std::find(used.begin(), used.end(), false) == used.end()) << "a vertex that no triangle has";
}
void compareSamples(const GpuSurface& grid, const GpuSurface& shared, ComparedMesh& all) {
    compareSamples(grid, shared, all, [](uint32_t, uint32_t) { return false; });
}

/// The mesh's directed edges, none twice, and how many have none against them. Of a mesh that covers every patch that
/// is the segments of its borders.
uint64_t openSegments(const std::vector<uint32_t>& indices) {
    std::vector<uint64_t> edges; // the lesser end, the greater one, and in the last bit whether it runs to the latter
    edges.reserve(indices.size());
    for (size_t t = 0; t < indices.size(); t += 3) {
        for (size_t k = 0; k < 3; ++k) {
            const uint64_t a = indices[t + k], b = indices[t + (k + 1) % 3];
            EXPECT_NE(a, b);
            edges.push_back(std::min(a, b) << 33 | std::max(a, b) << 1 | (a < b ? 1u : 0u));
        }
    }
    std::sort(edges.begin(), edges.end());
    const auto twice = std::adjacent_find(edges.begin(), edges.end());
    EXPECT_TRUE(twice == edges.end()) << "two triangles run between " << (*twice >> 33) << " and "
                                      << (*twice >> 1 & 0xFFFFFFFFu) << " in one direction";
    uint64_t open = 0;
    for (size_t i = 0, end = 0; i < edges.size(); i = end) {
        while (end < edges.size() && edges[end] >> 1 == edges[i] >> 1) {
            ++end;
        }
        open += edges[i] == edges[end - 1] ? 1 : 0;
    }
    return open;
}

class IndexedMesh : public testing::TestWithParam<SuppleMapping> {
protected:
    void SetUp() override { ASSERT_NE(testDevice(), nullptr); }
};
INSTANTIATE_TEST_SUITE_P(Mappings, IndexedMesh, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

GpuOptions withFlags(GpuOptions options, uint32_t flags) {
    options.flags = flags;
    return options;
}
bool evaluated(GpuSurface& surface) {
    if (surface.valid()) {
        surface.evaluate();
    }
    return surface.valid();
}

std::vector<NamedCage> quadCages() {
    return {{"cube", cube()},
            {"cube sphere", rotatedFaces(perturbed(cage::makeCubeSphere(4), 0.02f, 1))},
            {"split torus", perturbed(cage::makeSplitTorus(6, 5), 0.02f, 2)},
            {"trapezohedron", perturbed(trapezohedron(7), 0.05f, 3)},
            {"open grid", perturbed(grid(4, 3), 0.1f, 4)},
            {"open fan", perturbed(fan(5, 3, 4.7, false), 0.02f, 5)},
            {"with holes", withoutFaces(perturbed(cage::makeCubeSphere(4), 0.02f, 6), {2, 40, 70})},
            {"one quad", grid(1, 1)}};
}

/// Two rates of four for a cage of a zoo. Its neighbors have the others, and so has the same cage in the other
/// mapping.
std::vector<uint32_t> ratesOf(size_t cage, SuppleMapping mapping) {
    const bool other = (cage % 2 == 0) == (mapping == SUPPLE_MAPPING_WIDE);
    return other ? std::vector{1u, 8u} : std::vector{2u, 3u};
}
/// Some cages have more: even and odd rates whose chains have two levels and more.
std::vector<uint32_t> ratesOfChains(size_t cage, SuppleMapping mapping) {
    std::vector<uint32_t> rates = ratesOf(cage, mapping);
    if (cage % 7 == (mapping == SUPPLE_MAPPING_WIDE ? 0 : 3)) {
        rates.insert(rates.end(), {5u, 6u, 7u, 17u});
    }
    return rates;
}

TEST_P(IndexedMesh, PrepHasTheGridsBits) {
    const ValidationGuard guard;
    for (const NamedCage& named : quadCages()) {
        const Result<cage::Topology> topology = cage::buildTopology(named.cage);
        ASSERT_TRUE(topology.ok()) << named.name << ": " << topology.error().message;
        uint64_t boundary = 0;
        for (const cage::Topology::Edge& edge : topology->edges) {
            boundary += edge.twin == cage::kNone ? 1 : 0;
        }
        ComparedMesh all;
        for (const SuppleCornerRule corners : {SUPPLE_CORNERS_SHARP, SUPPLE_CORNERS_SMOOTH}) {
            for (const uint32_t rate : {1u, 2u, 3u, 8u, 17u}) {
                SCOPED_TRACE(std::string(named.name) + " at rate " + std::to_string(rate));
                GpuOptions options;
                options.mapping = GetParam();
                options.rate = rate;
                options.corners = corners;
                GpuSurface gridded(*testDevice(), named.cage, withFlags(options, 0));
                GpuSurface shared(*testDevice(), named.cage, withFlags(options, kShared));
                ASSERT_TRUE(evaluated(gridded) && evaluated(shared));
                compareSamples(gridded, shared, all);
                EXPECT_EQ(openSegments(readIndices(shared)), boundary * rate);
                // Euler: V - E + F of the cage is that of the mesh.
                const uint64_t r = rate, faces = named.cage.faceCount(), edges = topology->edges.size();
                EXPECT_EQ(shared.output().grid.vertexCount,
                          faces * (r - 1) * (r - 1) + edges * (r - 1) + named.cage.vertexCount());
            }
        }
        all.print(named.name);
        EXPECT_EQ(all.positions.different, 0u) << named.name;
        EXPECT_LE(all.inside, 1e-3) << named.name;
        EXPECT_EQ(all.above, 0u) << named.name << ", " << all.border;
    }
}

TEST_P(IndexedMesh, PmHasTheGridsBits) {
    const ValidationGuard guard;
    ComparedMesh all;
    for (size_t z = 0; z < pmZoo().size(); ++z) {
        const PmCage& zoo = pmZoo()[z];
        const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(zoo.cage);
        ASSERT_TRUE(mesh.ok()) << zoo.name;
        // An edge is one where both its facets lie in the same fans at both ends.
        const cage::Topology& topology = mesh->topology;
        uint64_t sides = 0;
        for (const cage::Topology::Edge& edge : topology.edges) {
            if (edge.twin == cage::kNone) {
                ++sides;
                continue;
            }
            const auto fan = [&](uint32_t corner) { return mesh->corners[corner].fan; };
            const auto next = [&](uint32_t corner) {
                return cage::nextCorner(mesh->cage, topology.cornerFaces[corner], corner);
            };
            const bool same = fan(edge.corner) == fan(next(edge.twin)) && fan(edge.twin) == fan(next(edge.corner));
            const bool cutThrough = mesh->corners[edge.corner].across == cage::kNone;
            sides += same && !cutThrough ? 0 : 2;
        }
        for (const uint32_t rate : ratesOf(z, GetParam())) {
            SCOPED_TRACE(zoo.name + " at rate " + std::to_string(rate));
            const GpuOptions options = pmOptions(GetParam(), rate);
            GpuSurface gridded(*testDevice(), zoo.cage, withFlags(options, 0));
            GpuSurface shared(*testDevice(), zoo.cage, withFlags(options, kShared));
            ASSERT_TRUE(evaluated(gridded) && evaluated(shared));
            const PmPatches facets(gridded, *mesh);
            compareSamples(gridded, shared, all, [&](uint32_t p, uint32_t s) {
                const uint32_t f = facets.facet(p);
                const auto domain = static_cast<surface::Domain>(gridded.rangeOf(p).domain);
                for (uint32_t i = 0; i < mesh->cage.sides(f); ++i) {
                    const surface::pm::Fan& fan = mesh->fans[mesh->corners[mesh->corner(f, i)].fan];
                    if (surface::edgeSample(domain, rate, i, 0) == s && fan.facets == 1 &&
                        (fan.kind == surface::pm::FanKind::crease || fan.kind == surface::pm::FanKind::straight)) {
                        return true;
                    }
                }
                return false;
            });
            if (mesh->cage.holes.empty()) {
                EXPECT_EQ(openSegments(readIndices(shared)), sides * rate);
            }
        }
    }
    all.print("P_m zoo");
    EXPECT_EQ(all.positions.different, 0u);
    EXPECT_LE(all.inside, 1e-3);
    EXPECT_EQ(all.above, 0u);
}

/// A cage's grids and its mesh, whose indices it returns.
std::vector<uint32_t> compareAtRate(const cage::Cage& cage, const GpuOptions& options, ComparedMesh& all) {
    GpuSurface gridded(*testDevice(), cage, withFlags(options, 0));
    GpuSurface shared(*testDevice(), cage, withFlags(options, kShared));
    if (!evaluated(gridded) || !evaluated(shared)) {
        ADD_FAILURE();
        return {};
    }
    compareSamples(gridded, shared, all);
    return readIndices(shared);
}

TEST_P(IndexedMesh, ExactHasTheGridsBits) {
    const ValidationGuard guard;
    ComparedMesh all;
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
    options.mapping = GetParam();
    for (size_t z = 0; z < subdivisionZoo().size(); ++z) {
        const SubdivisionCage& zoo = subdivisionZoo()[z];
        for (const uint32_t rate : ratesOfChains(z, GetParam())) {
            SCOPED_TRACE(zoo.name + " at rate " + std::to_string(rate));
            options.rate = rate;
            compareAtRate(zoo.cage, options, all);
        }
    }
    all.print("zoo of exact patches");
    EXPECT_EQ(all.positions.different, 0u);
    EXPECT_LE(all.inside, 1e-3);
    EXPECT_EQ(all.above, 0u) << all.border;
}

TEST_P(IndexedMesh, LoopHasTheGridsBits) {
    const ValidationGuard guard;
    ComparedMesh all;
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_LOOP;
    options.mapping = GetParam();
    for (size_t z = 0; z < subdivisionZoo().size(); ++z) {
        const SubdivisionCage& zoo = subdivisionZoo()[z];
        const surface::RefinedMesh mesh = LoopTriangles(zoo.cage).isolation.parent;
        uint64_t sides = 0; // that nothing is shared across: borders and endless creases
        for (uint32_t e = 0; e < mesh.topology.edges.size(); ++e) {
            const bool endless = mesh.edgeSharpness[e] >= surface::kInfiniteSharpness;
            sides += mesh.topology.edges[e].twin == cage::kNone ? 1 : endless ? 2 : 0;
        }
        for (const uint32_t rate : ratesOf(z, GetParam())) {
            SCOPED_TRACE(zoo.name + " at rate " + std::to_string(rate));
            options.rate = rate;
            const std::vector<uint32_t> indices = compareAtRate(zoo.cage, options, all);
            // At rate 1 a crease between two tips of darts has no sample of its own.
            if (zoo.cage.holes.empty() && rate > 1) {
                EXPECT_EQ(openSegments(indices), sides * rate);
            }
        }
    }
    all.print("zoo of Loop patches");
    EXPECT_EQ(all.positions.different, 0u);
    EXPECT_LE(all.inside, 1e-3);
    EXPECT_EQ(all.above, 0u) << all.border;
}

/// Attributes of the samples, where two have one vertex and where seams keep them apart.
void compareAttributes(const GpuSurface& grid, const GpuSurface& shared) {
    const std::vector<std::vector<uint32_t>> vertices = sharedVertices(grid, shared, readIndices(shared));
    uint64_t samples = 0, different = 0;
    const auto compare = [&](SuppleBufferRange SuppleVertexStreams::*view) {
        const SuppleBufferRange &a = grid.output().streams.*view, &b = shared.output().streams.*view;
        ASSERT_EQ(a.buffer == VK_NULL_HANDLE, b.buffer == VK_NULL_HANDLE);
        if (a.buffer == VK_NULL_HANDLE) {
            return;
        }
        const Result<std::vector<std::byte>> of = testDevice()->readBuffer(a), as = testDevice()->readBuffer(b);
        ASSERT_TRUE(of.ok() && as.ok());
        ASSERT_GE(as->size(), size_t{shared.output().grid.vertexCount} * b.stride);
        for (uint32_t p = 0; p < vertices.size(); ++p) {
            for (uint32_t s = 0; s < vertices[p].size(); ++s) {
                if (vertices[p][s] != cage::kNone) {
                    ++samples;
                    different += std::memcmp(of->data() + size_t{grid.vertexIndex(p, s)} * a.stride,
                                             as->data() + size_t{vertices[p][s]} * b.stride, a.stride) != 0
                                     ? 1
                                     : 0;
                }
            }
        }
    };
    compare(&SuppleVertexStreams::attributes);
    compare(&SuppleVertexStreams::uvs1);
    compare(&SuppleVertexStreams::faceUvs);
    std::printf("%llu attributes, %llu differ\n", static_cast<unsigned long long>(samples),
                static_cast<unsigned long long>(different));
    EXPECT_GT(samples, 0u);
    EXPECT_EQ(different, 0u);
}

TEST_P(IndexedMesh, CharactersInAPose) {
    const ValidationGuard guard;
    const std::string samples = std::string(SUPPLE_SOURCE_DIR) + "/samples/assets/";
    std::vector<std::string> paths{samples + "pip.glb", samples + "pip_quads.glb", samples + "helmet.glb"};
    for (const std::string& path :
         sharedAssets({"characters/man_casual_quads.glb", "characters/pawn_creased.glb", "khronos/Fox.glb"})) {
        paths.push_back(path);
    }
    forEachCharacter(paths, [&](const std::string& path, const cage::Character& character) {
        for (const SuppleScheme scheme :
             {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP}) {
            if (scheme == SUPPLE_SCHEME_PREP && !allQuads(character.cage)) {
                continue;
            }
            uint32_t vertices[2]{};
            for (const uint32_t attributes : {0u, uint32_t{SUPPLE_GROUP_ATTRIBUTES}}) {
                GpuOptions options;
                options.mapping = GetParam();
                options.scheme = scheme;
                options.rate = attributes != 0 ? 3 : 8;
                options.flags = attributes;
                GpuSurface gridded(*testDevice(), path, options);
                options.flags |= kShared;
                options.rate = 3;
                GpuSurface shared3(*testDevice(), path, options);
                options.rate = attributes != 0 ? 3 : 8;
                GpuSurface shared(*testDevice(), path, options);
                ASSERT_TRUE(gridded.valid() && shared.valid() && shared3.valid());
                evaluateInAPose(gridded, character);
                evaluateInAPose(shared, character);
                ComparedMesh all;
                compareSamples(gridded, shared, all, [](uint32_t, uint32_t) { return false; });
                all.print(path.c_str());
                EXPECT_EQ(all.positions.different, 0u);
                EXPECT_LE(all.inside, 1e-3);
                // As many as P_m's two sides are apart beside sharp creases (characters_gpu_test.cpp).
                EXPECT_LE(all.border, 0.05);
                openSegments(readIndices(shared));
                vertices[attributes != 0 ? 1 : 0] = shared3.output().grid.vertexCount;
                if (attributes != 0) {
                    compareAttributes(gridded, shared);
                }
            }
            EXPECT_GE(vertices[1], vertices[0]);
            if (path.find("pip", path.find_last_of('/')) != std::string::npos) {
                EXPECT_GT(vertices[1], vertices[0]) << "Pip has seams";
            }
        }
    });
}

TEST_P(IndexedMesh, FormatsInstancesAndDraws) {
    const ValidationGuard guard;
    const cage::Cage cage = perturbed(cage::makeSplitTorus(6, 5), 0.02f, 2);
    GpuOptions options;
    options.mapping = GetParam();
    options.rate = 5;
    options.instanceCount = 3;
    options.flags = kShared | SUPPLE_GROUP_PATCHES;
    GpuSurface full(*testDevice(), cage, options);
    options.format = SUPPLE_VERTEX_16;
    GpuSurface packed(*testDevice(), cage, options);
    ASSERT_TRUE(full.valid() && packed.valid());
    ASSERT_EQ(suppleSetVisible(packed.context().handle(), packed.instance(1), 0), SUPPLE_OK);
    full.evaluate();
    packed.evaluate();
    double worst = 0.0;
    for (const uint32_t instance : {0u, 2u}) {
        for (uint32_t v = 0; v < full.output().grid.vertexCount; ++v) {
            const GpuSurface::Vertex &a = full.sharedVertex(instance, v), &b = packed.sharedVertex(instance, v);
            ASSERT_EQ(std::memcmp(&a.position, &b.position, 12), 0);
            raise(worst, angleDegrees(a.normal, b.normal));
            ASSERT_EQ(std::memcmp(&a, &full.sharedVertex(0, v), sizeof(a)), 0);
        }
    }
    EXPECT_LE(worst, 0.005);
    ASSERT_EQ(packed.output().grid.drawRangeCount, 1u);
    const Result<std::vector<std::byte>> bytes = testDevice()->readBuffer(packed.output().indirect());
    ASSERT_TRUE(bytes.ok());
    VkDrawIndexedIndirectCommand draw{};
    std::memcpy(&draw, bytes->data(), sizeof(draw));
    EXPECT_EQ(draw.indexCount, 6u * 25u * cage.faceCount());
    EXPECT_EQ(draw.instanceCount, 2u);
    EXPECT_EQ(draw.firstIndex, 0u);
    EXPECT_EQ(draw.vertexOffset, 0);
    // The rate stands.
    EXPECT_EQ(suppleSetRate(full.context().handle(), full.group(), 5), SUPPLE_OK);
    EXPECT_EQ(suppleSetRate(full.context().handle(), full.group(), 4), SUPPLE_ERROR_ARGUMENT);
}

} // namespace
} // namespace supple::test
