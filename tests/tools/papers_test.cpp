// Contenders and tables of supple bench --papers.
#include "cage/topology.h"
#include "cpu/blend.h"
#include "cpu/catmull_clark.h"
#include "tests/support/meshes.h"
#include "tests/tools/command_runner.h"
#include "tools/bench/acc.h"
#include "tools/bench/blend_cpu.h"
#include "tools/bench/papers.h"
#include "tools/bench/printed_figures.h"
#include "tools/common/gallery_cages.h"
#include "tools/common/procedural.h"

#include <gtest/gtest.h>

namespace supple::test {
namespace {

/// What the tangent fields are for: normals of both sides of every edge agree, and corners are the limit's.
TEST(Acc, MeetsWithOneNormal) {
    for (const cage::Cage& cage : {cage::makeTripleDonut(), perturbed(jack(), 0.1f, 4), trapezohedron(7)}) {
        const Result<std::vector<bench::AccPatch>> patches = bench::makeAcc(cage);
        ASSERT_TRUE(patches);
        const Result<cage::Topology> topology = cage::buildTopology(cage);
        ASSERT_TRUE(topology);
        const auto onEdge = [&](uint32_t corner, double t) {
            const uint32_t f = topology->cornerFaces[corner], side = corner - cage.faceStarts[f];
            const glm::dvec2 at[] = {{t, 0.0}, {1.0, t}, {1.0 - t, 1.0}, {0.0, 1.0 - t}};
            return bench::evaluateAcc((*patches)[f], at[side].x, at[side].y);
        };
        for (const cage::Topology::Edge& edge : topology->edges) {
            for (const double t : {0.0, 0.2, 0.5, 0.77, 1.0}) {
                const bench::AccSample a = onEdge(edge.corner, t), b = onEdge(edge.twin, 1.0 - t);
                EXPECT_LT(glm::length(a.position - b.position), 1e-12);
                const glm::dvec3 n = glm::normalize(glm::cross(a.du, a.dv)), m = glm::normalize(glm::cross(b.du, b.dv));
                EXPECT_LT(glm::length(n - m), 1e-9);
            }
        }
        const auto mesh = surface::subdivision::buildMesh(cage, surface::subdivision::Subdivision::catmullClark);
        ASSERT_TRUE(mesh);
        const std::vector<glm::dvec3> positions = doublePositions(cage);
        const surface::catmull_clark::LimitSurface limit(*mesh, positions);
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            const bench::AccSample corner = bench::evaluateAcc((*patches)[f], 0.0, 0.0);
            EXPECT_LT(glm::length(corner.position - limit.at(f, 0.0, 0.0).position), 1e-12);
            EXPECT_GT(glm::dot(glm::normalize(glm::cross(corner.du, corner.dv)), limit.at(f, 0.0, 0.0).normal),
                      1.0 - 1e-9);
        }
    }
}

TEST(Acc, IsTheSplineWhereAllIsRegular) {
    const cage::Cage cage = perturbed(torus(7, 6), 0.05f, 2);
    const Result<std::vector<bench::AccPatch>> patches = bench::makeAcc(cage);
    ASSERT_TRUE(patches);
    const auto mesh = surface::subdivision::buildMesh(cage, surface::subdivision::Subdivision::catmullClark);
    const std::vector<glm::dvec3> positions = doublePositions(cage);
    const surface::catmull_clark::LimitSurface limit(*mesh, positions);
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        const bench::AccSample own = bench::evaluateAcc((*patches)[f], 0.3, 0.8);
        const auto exact = limit.at(f, 0.3, 0.8);
        EXPECT_LT(glm::length(own.position - exact.position), 1e-12);
        EXPECT_LT(glm::length(own.du - exact.du) + glm::length(own.dv - exact.dv), 1e-11);
    }
    EXPECT_FALSE(bench::makeAcc(grid(3, 3))) << "open";
    EXPECT_FALSE(bench::makeAcc(dodecahedron())) << "no quads";
}

TEST(BlendCpu, IsTheReferencesSurface) {
    const cage::Cage cage = cage::makeFrog();
    constexpr uint32_t kRate = 5;
    Result<std::unique_ptr<bench::BlendCpu>> made = bench::BlendCpu::create(cage, kRate);
    ASSERT_TRUE(made) << made.error().message;
    const Result<surface::blend::Mesh> mesh = surface::blend::buildMesh(cage);
    ASSERT_TRUE(mesh);
    const auto coefficients = surface::blend::construct<double>(*mesh, doublePositions(cage));
    const surface::blend::Evaluator<double> reference(*mesh, coefficients, kRate);
    for (const bool allThreads : {false, true}) {
        (*made)->run(allThreads);
        const std::span<const float> own = (*made)->vertices();
        ASSERT_EQ(own.size(), size_t{6} * (kRate + 1) * (kRate + 1) * cage.faceCount());
        size_t at = 0, steep = 0;
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            for (uint32_t j = 0; j <= kRate; ++j) {
                for (uint32_t i = 0; i <= kRate; ++i, at += 6) {
                    const auto exact = reference.at(f, i, j);
                    EXPECT_LT(glm::length(glm::dvec3(own[at], own[at + 1], own[at + 2]) - exact.position), 1e-5);
                    const glm::dvec3 normal(own[at + 3], own[at + 4], own[at + 5]);
                    steep += glm::length(normal - exact.normal) > 1e-3 ? 1 : 0;
                }
            }
        }
        EXPECT_LE(steep * 1000, own.size() / 6);
    }
    EXPECT_FALSE(bench::BlendCpu::create(grid(3, 3), kRate));
}

TEST(PrintedFigures, HaveAModelAndRise) {
    for (const bench::PrintedRow& row : bench::printedRows()) {
        for (size_t i = 1; i < row.figures.size(); ++i) {
            EXPECT_GT(row.figures[i].samples, row.figures[i - 1].samples);
            EXPECT_LE(row.figures[i].framesPerSecond, row.figures[i - 1].framesPerSecond);
        }
    }
    for (const bench::PrintedBlend& row : bench::printedBlend()) {
        EXPECT_GT(row.gpu / row.cpu, 17.0) << "the paper's claim is 17 to 20 times";
        EXPECT_LT(row.gpu / row.cpu, 20.5);
    }
}

class Papers : public CommandTest {};

TEST_F(Papers, TablesAreWritten) {
    const Outcome outcome = runOnDevice("bench --papers --quick --json papers.json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const nlohmann::json result = nlohmann::json::parse(readText(file("papers.json")));
    ASSERT_EQ(result["models"].size(), 5u);
    for (const nlohmann::json& model : result["models"]) {
        size_t taken = 0;
        for (const nlohmann::json& scheme : model["schemes"]) {
            taken += scheme["rows"].empty() ? 0 : 1;
            for (const nlohmann::json& row : scheme["rows"]) {
                EXPECT_GT(row["framesPerSecond"].get<double>(), 0.0);
                EXPECT_GT(row["triangles"].get<uint64_t>(), 0u);
            }
        }
        EXPECT_GE(taken, 3u) << model["name"];
    }
    EXPECT_EQ(result["models"][2]["schemes"][0]["rows"][0]["triangles"], 1292 * 32) << "frog, N = 5";
    for (const nlohmann::json& model : result["acc"]) {
        EXPECT_LT(model["schemes"][0]["apart"].get<double>(), 1e-6);
        EXPECT_GT(model["schemes"][0]["largest"].get<double>(), 1e-5);
        EXPECT_LT(model["schemes"][0]["largest"].get<double>(), 1e-2);
        EXPECT_LT(model["schemes"][3]["largest"].get<double>(), 1e-6) << "catmull-clark is the limit";
    }
    for (const char* word : {"printed (p-rep, 2008)", "printed (P_m, 2008)", "printed (2011)", "ACC"})
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
}

} // namespace
} // namespace supple::test
