// The cages that schemes are judged on, and supple gallery.
#include "cage/topology.h"
#include "surface/pm/mesh.h"
#include "tests/support/meshes.h"
#include "tests/tools/command_runner.h"
#include "tools/common/gallery_cages.h"

#include <gtest/gtest.h>
#include <map>

namespace supple::test {
namespace {

/// How many faces are regular quads, all of whose corners have valence 4.
uint32_t regularFaces(const cage::Cage& cage, const cage::Topology& topology) {
    uint32_t regular = 0;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        bool plain = cage.sides(f) == 4;
        for (uint32_t c = cage.faceStarts[f]; plain && c < cage.faceStarts[f + 1]; ++c)
            plain = topology.spokeCount(cage.faceVertices[c]) == 4;
        regular += plain ? 1 : 0;
    }
    return regular;
}

TEST(GalleryCages, ModelsHaveTheirFacesAndAreClosed) {
    const struct {
        const char* name;
        cage::Cage cage;
        uint32_t faces;
        int holes;
    } models[] = {{"triple donut", cage::makeTripleDonut(), 68, 3},
                  {"shaft", cage::makeShaft(), 1106, 0},
                  {"frog", cage::makeFrog(), 1292, 0}};
    for (const auto& model : models) {
        SCOPED_TRACE(model.name);
        EXPECT_EQ(model.cage.faceCount(), model.faces);
        EXPECT_TRUE(allQuads(model.cage));
        const Result<cage::Topology> topology = cage::buildTopology(model.cage);
        ASSERT_TRUE(topology) << topology.error().message;
        for (uint32_t v = 0; v < model.cage.vertexCount(); ++v)
            ASSERT_EQ(topology->boundary[v], 0) << v;
        const auto vertices = static_cast<int>(model.cage.vertexCount()),
                   edges = static_cast<int>(topology->edges.size());
        EXPECT_EQ(vertices - edges + static_cast<int>(model.faces), 2 - 2 * model.holes) << "Euler's number";
        double volume = 0.0;
        for (uint32_t f = 0; f < model.faces; ++f) {
            const auto at = [&](uint32_t i) {
                return glm::dvec3(model.cage.positions[model.cage.faceVertices[4 * f + i]]);
            };
            volume += glm::dot(at(0), glm::cross(at(1), at(2))) + glm::dot(at(0), glm::cross(at(2), at(3)));
        }
        EXPECT_GT(volume, 0.0) << "faces look outwards";
        std::printf("%s: %u of %u quads are regular\n", model.name, regularFaces(model.cage, *topology), model.faces);
    }
    const cage::Cage shaft = cage::makeShaft();
    EXPECT_NEAR(regularFaces(shaft, *cage::buildTopology(shaft)) / 1106.0, 0.9, 0.02) << "as the paper's";
}

TEST(GalleryCages, CagesHaveTheirValencesAndClasses) {
    const std::vector<cage::GalleryCage> cages = cage::galleryCages();
    ASSERT_EQ(cages.size(), 8u);
    const uint32_t valences[] = {3, 5, 6, 12};
    for (size_t i = 0; i < cages.size(); ++i) {
        SCOPED_TRACE(cages[i].name);
        const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(cages[i].cage);
        ASSERT_TRUE(mesh);
        EXPECT_EQ(mesh->topology.spokeCount(0), valences[i % 4]);
        std::map<surface::PatchClass, uint32_t> classes;
        for (const surface::PatchClass each : mesh->classes)
            ++classes[each];
        const surface::PatchClass middle = i % 4 < 2 ? surface::PatchClass::p4 : surface::PatchClass::polar;
        EXPECT_EQ(classes[middle], valences[i % 4]) << "round the middle";
        for (const glm::vec3& p : cages[i].cage.positions) {
            const float z = i < 4 ? -0.125f * (p.x * p.x + p.y * p.y) : 0.125f * (p.x * p.x - p.y * p.y);
            EXPECT_NEAR(p.z, z, 1e-5f);
        }
    }
    EXPECT_TRUE(cage::buildTopology(cage::makeGallery()));
}

class Gallery : public CommandTest {};

TEST_F(Gallery, IsAPicture) {
    ASSERT_EQ(runOnDevice("gallery -o gallery.png --cell 64x48 --rate 4 --only 'polar 6, s'").exitCode, 0);
    const std::string png = readText(file("gallery.png"));
    EXPECT_EQ(png.substr(1, 3), "PNG");
    EXPECT_GT(png.size(), 3000u);
    expectFailure(run("gallery -o x.png --only hexagons"), 2, "--only: no cage is called hexagons");
}

} // namespace
} // namespace supple::test
