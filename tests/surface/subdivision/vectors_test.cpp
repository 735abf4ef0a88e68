// The reference against the stored vectors.
#include "tests/support/meshes.h"
#include "tests/support/subdivision_surface.h"
#include "tests/support/subdivision_vectors.h"
#include "tests/support/vector_files.h"
#include "tests/support/worst.h"

#include <cstdio>
#include <map>

namespace supple::surface::subdivision {
namespace {

using test::raise;
using test::SubdivisionVectors;

class SubdivisionVectorFiles : public testing::TestWithParam<size_t> {
protected:
    const SubdivisionVectors& v = test::subdivisionVectors()[GetParam()];
};

/// Largest deviations: lengths relative to the extent, normals absolute.
struct Deviation {
    double isolated = 0.0, refined = 0.0, limits = 0.0, normals = 0.0;
};

template <class T>
Deviation deviation(const SubdivisionVectors& v) {
    const Mesh mesh = test::subdivisionMesh(v.cage, v.subdivision);
    const double extent = test::extent(v.positions);
    const auto apart = [](const glm::vec<3, T>& a, const glm::dvec3& b) { return glm::distance(glm::dvec3(a), b); };
    const std::vector<glm::vec<3, T>> positions(v.positions.begin(), v.positions.end());
    const std::vector<glm::vec<3, T>> isolated = isolate<T>(mesh, positions);
    Deviation d;
    EXPECT_EQ(isolated.size(), v.isolated.size());
    for (size_t i = 0; i < std::min(isolated.size(), v.isolated.size()); ++i) {
        raise(d.isolated, apart(isolated[i], v.isolated[i]) / extent);
    }
    std::map<uint32_t, SectorGrid<T>> byFace;
    for (SectorGrid<T>& grid : evaluate<T>(mesh, isolated, v.depth - mesh.isolationSteps)) {
        EXPECT_TRUE(byFace.emplace(grid.face, std::move(grid)).second) << "two sectors on one face";
    }
    EXPECT_EQ(byFace.size(), mesh.cage.faceCount());
    EXPECT_EQ(byFace.size(), v.sectors.size());
    for (const SubdivisionVectors::Sector& stored : v.sectors) {
        const std::vector<Sample<T>>& samples = byFace[stored.face].samples;
        EXPECT_EQ(samples.size(), stored.refined.size());
        for (size_t i = 0; i < std::min(samples.size(), stored.refined.size()); ++i) {
            raise(d.refined, apart(samples[i].refined, stored.refined[i]) / extent);
            raise(d.limits, apart(samples[i].position, stored.limits[i]) / extent);
            raise(d.normals, apart(samples[i].normal, stored.normals[i]));
        }
    }
    return d;
}

template <class T>
void expectWithin(const SubdivisionVectors& v, const char* type, const Deviation& bounds) {
    const Deviation d = deviation<T>(v);
    std::printf("%-20s %s: isolated %.1e, refined %.1e, limits %.1e, normals %.1e\n", v.name.c_str(), type, d.isolated,
                d.refined, d.limits, d.normals);
    EXPECT_LE(d.isolated, bounds.isolated);
    EXPECT_LE(d.refined, bounds.refined);
    EXPECT_LE(d.limits, bounds.limits);
    EXPECT_LE(d.normals, bounds.normals);
}

TEST_P(SubdivisionVectorFiles, inDouble) {
    expectWithin<double>(v, "double", {1e-12, 1e-12, 1e-12, 1e-12});
}

TEST_P(SubdivisionVectorFiles, inFloat) {
    expectWithin<float>(v, "float", {1e-6, 1e-6, 1e-6, 1e-4});
}

INSTANTIATE_TEST_SUITE_P(Subdivision, SubdivisionVectorFiles,
                         testing::Range(size_t{0}, test::vectorFiles("subdivision").size()), [](const auto& entry) {
                             return test::vectorFiles("subdivision")[entry.param].stem().string();
                         });

TEST(SubdivisionVectorData, allThere) {
    EXPECT_EQ(test::subdivisionVectors().size(), 6u);
}

/// The sources of a row, those of Catmull-Clark's vertices spelled out.
std::vector<uint32_t> sourcesOf(const Fan& fan, const Pattern& pattern, const Row& row) {
    const bool quads = fan.subdivision == Subdivision::catmullClark;
    if (row.rule == Rule::vertex && quads) {
        const Neighbours& n = pattern.neighbours[row.sources[0]];
        return {row.sources[0], n[0], n[4], n[2], n[6], n[1], n[5], n[3], n[7]};
    }
    const size_t count = row.rule == Rule::vertex ? 7 : row.rule == Rule::edge && quads ? 6 : 4;
    return {row.sources.begin(), row.sources.begin() + count};
}

TEST(SubdivisionPatterns, storedRows) {
    for (const test::StoredPattern& stored : test::storedPatterns()) {
        const Pattern pattern = fanPattern(stored.fan, 1);
        ASSERT_EQ(pattern.rows.size(), pointCount(stored.fan, 3));
        ASSERT_EQ(pattern.rows.size(), stored.rows.size());
        for (const test::StoredPattern::Row& row : stored.rows) {
            SCOPED_TRACE(row.point);
            const Row& own = pattern.rows[row.point];
            EXPECT_EQ(own.rule, row.rule);
            EXPECT_EQ(own.spoke, row.spoke);
            if (row.rule != Rule::centre) {
                EXPECT_EQ(sourcesOf(stored.fan, pattern, own), row.sources);
            }
        }
    }
}

} // namespace
} // namespace supple::surface::subdivision
