// The reference against OpenSubdiv's uniform refinement and its limit masks, at equal depths.
#include "cage/formats/reader.h"
#include "tests/support/meshes.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <vector>
#ifdef SUPPLE_HAS_OPENSUBDIV
#include "tools/bench/opensubdiv_refiner.h"

#include <opensubdiv/far/primvarRefiner.h>
#endif

namespace supple::surface::subdivision {
namespace {

#ifndef SUPPLE_HAS_OPENSUBDIV

TEST(SubdivisionOpenSubdiv, zoo) {
    GTEST_SKIP() << "built without OpenSubdiv (opensubdiv/far/topologyRefiner.h and the library osdCPU)";
}

#else

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using test::raise;
using SdcRule = Sdc::Crease::Rule;

/// What OpenSubdiv asks of a point.
struct Primvar {
    glm::dvec3 v{0.0};
    void Clear(void* = nullptr) { v = glm::dvec3(0.0); }
    void AddWithWeight(const Primvar& source, double weight) { v += weight * source.v; }
};

/// OpenSubdiv's points of one depth.
class Uniform {
public:
    Uniform(const cage::Cage& cage, Subdivision subdivision, uint32_t depth)
        : refiner_(bench::opensubdivRefiner(cage, subdivision == Subdivision::catmullClark ? Sdc::SCHEME_CATMARK
                                                                                           : Sdc::SCHEME_LOOP)) {
        Far::TopologyRefiner::UniformOptions options(static_cast<int>(depth));
        options.fullTopologyInLastLevel = true;
        refiner_->RefineUniform(options);
        for (const glm::vec3& p : cage.positions) {
            points_.emplace_back().v = p;
        }
        const Far::PrimvarRefinerReal<double> primvars(*refiner_);
        for (uint32_t k = 1; k <= depth; ++k) {
            std::vector<Primvar> finer(static_cast<size_t>(level(k).GetNumVertices()));
            primvars.Interpolate(static_cast<int>(k), points_, finer);
            points_ = std::move(finer);
        }
        limits_.resize(points_.size());
        first_.resize(points_.size());
        second_.resize(points_.size());
        primvars.Limit(points_, limits_, first_, second_);
    }

    [[nodiscard]] const Far::TopologyLevel& level(uint32_t depth) const {
        return refiner_->GetLevel(static_cast<int>(depth));
    }
    [[nodiscard]] size_t size() const { return points_.size(); }
    [[nodiscard]] const glm::dvec3& refined(size_t i) const { return points_[i].v; }
    [[nodiscard]] const glm::dvec3& limit(size_t i) const { return limits_[i].v; }
    /// Of unit length; zero where the tangents are parallel.
    [[nodiscard]] glm::dvec3 normal(size_t i) const {
        const glm::dvec3 n = glm::cross(first_[i].v, second_[i].v);
        const double length = glm::length(n);
        return length > 1e-6 * glm::length(first_[i].v) * glm::length(second_[i].v) ? n / length : glm::dvec3(0.0);
    }

private:
    std::unique_ptr<Far::TopologyRefiner> refiner_;
    std::vector<Primvar> points_, limits_, first_, second_;
};

/// OpenSubdiv's vertices at the samples of the isolated level's faces, found by connectivity alone.
class SampleVertices {
public:
    using Grid = std::vector<Far::Index>;

    /// `faces`: of the isolated level, in its order.
    SampleVertices(const cage::Cage& cage, Subdivision subdivision, const Uniform& uniform, uint32_t isolation,
                   uint32_t depth)
        : quads_(subdivision == Subdivision::catmullClark), uniform_(uniform) {
        for (const std::vector<uint32_t>& p : test::facesOf(cage)) {
            grids_.emplace_back(p.begin(), p.end());
        }
        for (uint32_t k = 0; k < isolation; ++k) {
            splitFaces(k);
        }
        isolated_ = grids_;
        for (Grid& grid : grids_) {
            if (quads_) {
                std::swap(grid[2], grid[3]); // corners round the face, then samples row by row
            }
        }
        for (uint32_t k = isolation; k < depth; ++k) {
            refineGrids(k);
        }
    }

    /// Corners of a face of the isolated level, in the numbers of that level.
    [[nodiscard]] const Grid& corners(uint32_t face) const { return isolated_[face]; }
    [[nodiscard]] const Grid& samples(uint32_t face) const { return grids_[face]; }
    [[nodiscard]] size_t faces() const { return grids_.size(); }

private:
    [[nodiscard]] Far::Index edgePoint(uint32_t k, Far::Index a, Far::Index b) const {
        const Far::TopologyLevel& level = uniform_.level(k);
        return level.GetEdgeChildVertex(level.FindEdge(a, b));
    }

    /// Of the face that has a, b and c in a row.
    [[nodiscard]] Far::Index facePoint(uint32_t k, Far::Index a, Far::Index b, Far::Index c) const {
        const Far::TopologyLevel& level = uniform_.level(k);
        const Far::ConstIndexArray near = level.GetEdgeFaces(level.FindEdge(a, b));
        const Far::ConstIndexArray far = level.GetEdgeFaces(level.FindEdge(b, c));
        for (int i = 0; i < near.size(); ++i) {
            for (int j = 0; j < far.size(); ++j) {
                if (near[i] == far[j]) {
                    return level.GetFaceChildVertex(near[i]);
                }
            }
        }
        return Far::INDEX_INVALID;
    }

    void splitFaces(uint32_t k) {
        const Far::TopologyLevel& level = uniform_.level(k);
        std::vector<Grid> children;
        for (const Grid& p : grids_) {
            const size_t n = p.size();
            std::vector<Far::Index> middles;
            for (size_t i = 0; i < n; ++i) {
                middles.push_back(edgePoint(k, p[i], p[(i + 1) % n]));
            }
            const Far::Index centre = quads_ ? facePoint(k, p[0], p[1], p[2]) : 0;
            for (size_t i = 0; i < n; ++i) {
                Grid& child = children.emplace_back();
                child = {level.GetVertexChildVertex(p[i]), middles[i], middles[(i + n - 1) % n]};
                if (quads_) {
                    child.insert(child.begin() + 2, centre);
                }
            }
            if (!quads_) {
                children.push_back(middles);
            }
        }
        grids_ = std::move(children);
        side_ = 1;
    }

    void refineGrids(uint32_t k) {
        const Far::TopologyLevel& level = uniform_.level(k);
        const uint32_t n = side_;
        side_ *= 2;
        for (Grid& grid : grids_) {
            // Row b begins behind n + 1, then, in a triangle, n, n - 1, ... samples.
            const auto at = [&](uint32_t a, uint32_t b) {
                return grid[quads_ ? b * (n + 1) + a : b * (n + 1) - b * (b - 1) / 2 + a];
            };
            Grid finer;
            for (uint32_t b = 0; b <= side_; ++b) {
                for (uint32_t a = 0; a <= (quads_ ? side_ : side_ - b); ++a) {
                    const uint32_t x = a / 2, y = b / 2;
                    if (a % 2 == 0 && b % 2 == 0) {
                        finer.push_back(level.GetVertexChildVertex(at(x, y)));
                    } else if (b % 2 == 0) {
                        finer.push_back(edgePoint(k, at(x, y), at(x + 1, y)));
                    } else if (a % 2 == 0) {
                        finer.push_back(edgePoint(k, at(x, y), at(x, y + 1)));
                    } else if (quads_) {
                        finer.push_back(facePoint(k, at(x, y), at(x + 1, y), at(x + 1, y + 1)));
                    } else {
                        finer.push_back(edgePoint(k, at(x + 1, y), at(x, y + 1)));
                    }
                }
            }
            grid = std::move(finer);
        }
    }

    bool quads_;
    const Uniform& uniform_;
    uint32_t side_ = 1;
    std::vector<Grid> grids_, isolated_;
};

/// Largest deviations: lengths relative to the extent; normals absolute.
struct Figures {
    double refined = 0.0, limits = 0.0;
    double smoothNormals = 0.0;
    double creaseNormals = 0.0; ///< of OpenSubdiv's one normal from the nearer of our two
    double floatRefined = 0.0, floatLimits = 0.0, floatNormals = 0.0;
    uint64_t samples = 0;
    uint64_t corners = 0, folded = 0; ///< samples left out of the normals

    void add(const Figures& other) {
        raise(refined, other.refined);
        raise(limits, other.limits);
        raise(smoothNormals, other.smoothNormals);
        raise(creaseNormals, other.creaseNormals);
        raise(floatRefined, other.floatRefined);
        raise(floatLimits, other.floatLimits);
        raise(floatNormals, other.floatNormals);
        samples += other.samples;
        corners += other.corners;
        folded += other.folded;
    }
};

/// `plain` is the cage in triangles where Loop splits it.
Figures compare(const cage::Cage& cage, const cage::Cage& plain, Subdivision subdivision, uint32_t depth) {
    const Mesh mesh = test::subdivisionMesh(cage, subdivision);
    const Uniform uniform(plain, subdivision, depth);
    const SampleVertices vertices(plain, subdivision, uniform, mesh.isolationSteps, depth);
    const std::vector<glm::dvec3> positions = test::doublePositions(cage);
    const double extent = test::extent(positions);
    const Far::TopologyLevel& last = uniform.level(depth);
    Figures figures;
    EXPECT_EQ(mesh.cage.faceCount(), vertices.faces());
    EXPECT_EQ(mesh.cage.vertexCount(), uniform.level(mesh.isolationSteps).GetNumVertices());
    std::vector<double> nearest(uniform.size(), 4.0); // at creases

    const auto take = [&](const auto& grid, double& refined, double& limits, double& normals, bool all) {
        const SampleVertices::Grid& own = vertices.samples(grid.face);
        ASSERT_EQ(own.size(), grid.samples.size());
        for (size_t i = 0; i < own.size(); ++i) {
            const auto v = static_cast<size_t>(own[i]);
            const auto& sample = grid.samples[i];
            raise(refined, glm::distance(glm::dvec3(sample.refined), uniform.refined(v)) / extent);
            raise(limits, glm::distance(glm::dvec3(sample.position), uniform.limit(v)) / extent);
            const glm::dvec3 normal = uniform.normal(v);
            const SdcRule rule = last.GetVertexRule(own[i]);
            const double off = glm::distance(glm::dvec3(sample.normal), normal);
            const bool folded = normal == glm::dvec3(0.0);
            if (!folded && rule != SdcRule::RULE_CORNER && rule != SdcRule::RULE_CREASE) {
                raise(normals, off);
            }
            if (all) {
                ++figures.samples;
                figures.corners += rule == SdcRule::RULE_CORNER ? 1 : 0;
                figures.folded += folded && rule != SdcRule::RULE_CORNER ? 1 : 0;
                if (rule == SdcRule::RULE_CREASE && !folded) {
                    nearest[v] = std::min(nearest[v], off);
                }
            }
        }
    };
    const uint32_t steps = depth - mesh.isolationSteps;
    const std::vector<glm::dvec3> isolated = isolate<double>(mesh, positions);
    forEachSector<double>(mesh, isolated, steps, [&](const SectorGrid<double>& grid) {
        take(grid, figures.refined, figures.limits, figures.smoothNormals, true);
    });
    const std::vector<glm::vec3> isolatedFloat = isolate<float>(mesh, cage.positions);
    forEachSector<float>(mesh, isolatedFloat, steps, [&](const SectorGrid<float>& grid) {
        take(grid, figures.floatRefined, figures.floatLimits, figures.floatNormals, false);
    });
    for (const double off : nearest) {
        raise(figures.creaseNormals, off < 4.0 ? off : 0.0);
    }
    return figures;
}

void print(const char* name, const Figures& f) {
    std::printf("%-44s %9llu samples: refined %.1e, limits %.1e, normals %.1e (creases %.1e); float: %.1e, %.1e, %.1e",
                name, static_cast<unsigned long long>(f.samples), f.refined, f.limits, f.smoothNormals, f.creaseNormals,
                f.floatRefined, f.floatLimits, f.floatNormals);
    if (f.folded > 0) {
        std::printf("; no normal: %llu", static_cast<unsigned long long>(f.folded));
    }
    std::printf("\n");
}

void expectEqual(const Figures& f) {
    EXPECT_LE(f.refined, 1e-12);
    EXPECT_LE(f.limits, 1e-12);
    EXPECT_LE(f.floatRefined, 1e-5);
    EXPECT_LE(f.floatLimits, 1e-5);
    EXPECT_LE(f.smoothNormals, 1e-9);
    EXPECT_LE(f.creaseNormals, 1e-9);
    EXPECT_LE(f.floatNormals, 0.05);
}

/// Depths from the isolated level to 4, or as deep as `kMaxSamples` goes.
Figures compareDepths(const cage::Cage& cage, const cage::Cage& plain, Subdivision subdivision) {
    constexpr uint64_t kMaxSamples = 150000;
    const uint32_t least = subdivision == Subdivision::loop || test::allQuads(plain) ? 1 : 2;
    const uint64_t faces = subdivision == Subdivision::loop ? plain.faceCount() : plain.cornerCount() / 4;
    Figures all;
    for (uint32_t depth = least; depth <= 4; ++depth) {
        if (depth == least || faces << (2 * depth) <= kMaxSamples) {
            all.add(compare(cage, plain, subdivision, depth));
        }
    }
    return all;
}

const char* nameOf(Subdivision subdivision) {
    return subdivision == Subdivision::catmullClark ? "Catmull-Clark" : "Loop";
}

TEST(SubdivisionOpenSubdiv, zoo) {
    for (const Subdivision subdivision : {Subdivision::catmullClark, Subdivision::loop}) {
        Figures all;
        for (const test::SubdivisionCage& entry : test::subdivisionZoo()) {
            SCOPED_TRACE(entry.name + ", " + nameOf(subdivision));
            const cage::Cage plain = subdivision == Subdivision::loop ? test::inTriangles(entry.cage) : entry.cage;
            const Figures f = compareDepths(entry.cage, plain, subdivision);
            expectEqual(f);
            if (f.refined > 1e-12 || f.limits > 1e-12 || f.smoothNormals > 1e-9 || f.creaseNormals > 1e-9) {
                print((entry.name + ", " + nameOf(subdivision)).c_str(), f);
            }
            all.add(f);
        }
        print((std::string("zoo, ") + nameOf(subdivision)).c_str(), all);
    }
}

Result<cage::Character> readFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> text{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::byte> bytes(text.size());
    std::transform(text.begin(), text.end(), bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
    const std::filesystem::path at(path);
    return cage::readCharacter(bytes, at.filename().string(), at.parent_path().string());
}

/// Every mesh and character beside the repository by both schemes: equal to OpenSubdiv, or refused by name. What the
/// reader leaves out of a file (Chaikin's crease rule, other boundary rules, faces that repeat a vertex) is missing on
/// both sides and listed.
TEST(SubdivisionOpenSubdiv, files) {
    std::vector<std::string> paths = test::filesBelow(std::string(SUPPLE_SHARED_DIR) + "/assets/meshes", {".obj"});
    if (paths.empty()) {
        std::printf("all shared meshes left out: %s/assets/meshes is not present\n", SUPPLE_SHARED_DIR);
    }
    const std::vector<std::string> characters = test::allCharacters();
    paths.insert(paths.end(), characters.begin(), characters.end());
    for (const Subdivision subdivision : {Subdivision::catmullClark, Subdivision::loop}) {
        Figures all;
        uint32_t compared = 0, refused = 0;
        for (const std::string& path : paths) {
            const Result<cage::Character> character = readFile(path);
            ASSERT_TRUE(character.ok()) << character.error().message;
            const cage::Cage& cage = character->cage;
            const std::string name = std::filesystem::path(path).filename().string();
            SCOPED_TRACE(name + ", " + nameOf(subdivision));
            if (subdivision == Subdivision::catmullClark) {
                for (const std::string& warning : character->warnings) {
                    std::printf("  read without: %s: %s\n", name.c_str(), warning.c_str());
                }
            }
            const Result<Mesh> mesh = buildMesh(cage, subdivision);
            if (!mesh.ok()) {
                std::printf("  refused by %s: %s: %s\n", nameOf(subdivision), name.c_str(),
                            mesh.error().message.c_str());
                ++refused;
                continue;
            }
            const cage::Cage plain = subdivision == Subdivision::loop ? test::trianglesOf(*mesh, cage) : cage;
            const Figures f = compareDepths(cage, plain, subdivision);
            expectEqual(f);
            if (f.refined > 1e-12 || f.limits > 1e-12 || f.smoothNormals > 1e-9 || f.creaseNormals > 1e-9 ||
                f.floatNormals > 1e-2) {
                print(name.c_str(), f);
            }
            all.add(f);
            ++compared;
        }
        std::printf("%s: %u files compared, %u refused\n", nameOf(subdivision), compared, refused);
        print((std::string("files, ") + nameOf(subdivision)).c_str(), all);
    }
}

#endif

} // namespace
} // namespace supple::surface::subdivision
