// supple bake --patches --basis bezier: nets that any program can evaluate, and what they evaluate to is the surface.
#include "tests/support/meshes.h"
#include "tests/tools/baked_files.h"
#include "tests/tools/command_runner.h"
#include "tests/tools/obj_file.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace supple::test {
namespace {

/// A point of a curve in Bernstein-Bezier form, by de Casteljau.
glm::dvec3 pointAt(std::vector<glm::dvec3> coefficients, double t) {
    for (size_t left = coefficients.size(); left > 1; --left) {
        for (size_t i = 0; i + 1 < left; ++i) {
            coefficients[i] = (1.0 - t) * coefficients[i] + t * coefficients[i + 1];
        }
    }
    return coefficients[0];
}

glm::dvec3 pointAt(const nlohmann::json& patch, double u, double v) {
    const auto side = patch["degree"].get<size_t>() + 1;
    std::vector<glm::dvec3> column;
    for (size_t i = 0; i < side; ++i) {
        std::vector<glm::dvec3> coefficients;
        for (size_t j = 0; j < side; ++j) {
            const nlohmann::json& c = patch["coefficients"][i + side * j];
            coefficients.emplace_back(c[0].get<double>(), c[1].get<double>(), c[2].get<double>());
        }
        column.push_back(pointAt(std::move(coefficients), v));
    }
    return pointAt(std::move(column), u);
}

std::string objOf(const cage::Cage& cage) {
    std::ostringstream obj;
    for (const glm::vec3& p : cage.positions) {
        obj << "v " << p.x << " " << p.y << " " << p.z << "\n";
    }
    for (const std::vector<uint32_t>& face : facesOf(cage)) {
        obj << "f";
        for (const uint32_t v : face) {
            obj << " " << v + 1;
        }
        obj << "\n";
    }
    return obj.str();
}

class BezierPatches : public CommandTest {
protected:
    /// Bakes a cage and compares every sample with its patch's net; returns how many patches each class has.
    std::map<std::string, size_t> compare(const cage::Cage& cage, const std::string& scheme) {
        writeText(file("cage.obj"), objOf(cage));
        const Outcome baked =
            runOnDevice("bake cage.obj -o out.obj --rate 5 --patches p.json --basis bezier --scheme " + scheme);
        EXPECT_EQ(baked.exitCode, 0) << baked.err;
        std::map<std::string, size_t> counts;
        if (baked.exitCode != 0) {
            return counts;
        }
        const nlohmann::json json = nlohmann::json::parse(readText(file("p.json")));
        EXPECT_EQ(json["basis"], "bezier");
        const Obj obj = readObj(file("out.obj"));
        glm::vec3 low = obj.v.at(0), high = low;
        for (const glm::vec3& p : obj.v) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        double largest = 0.0;
        size_t sample = 0;
        for (const nlohmann::json& patch : json["patches"]) {
            ++counts[patch["class"].get<std::string>()];
            const auto side = patch["degree"].get<size_t>() + 1;
            EXPECT_EQ(side, patch["class"] == "perturbed" ? 6u : 4u);
            EXPECT_EQ(patch["coefficients"].size(), side * side);
            for (int j = 0; j <= 5; ++j) {
                for (int i = 0; i <= 5; ++i) {
                    const glm::dvec3 apart = pointAt(patch, i / 5.0, j / 5.0) - glm::dvec3(obj.v.at(sample++));
                    largest = std::max({largest, std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)});
                }
            }
        }
        EXPECT_EQ(sample, obj.v.size());
        EXPECT_LT(largest, 1e-6 * extent);
        return counts;
    }
};

TEST_F(BezierPatches, OfPRep) {
    const cage::Cage biped = perturbed(supple::test::biped(), 0.2f, 5);
    const std::map<std::string, size_t> counts = compare(biped, "prep");
    EXPECT_GT(counts.at("perturbed"), 50u);
    EXPECT_EQ(compare(grid(4, 4), "prep").at("regular"), 16u);
}

TEST_F(BezierPatches, OfPm) {
    EXPECT_EQ(compare(torus(6, 5), "pm"), (std::map<std::string, size_t>{{"regular", 30}}));
    EXPECT_EQ(compare(cappedCylinder(8, 5), "pm"), (std::map<std::string, size_t>{{"polar", 16}, {"regular", 32}}));
}

TEST_F(BezierPatches, WhatIsNoTensorProductIsNamed) {
    writeText(file("cube.obj"), kCubeObj);
    const Outcome refused = runOnDevice("bake cube.obj -o out.obj --patches p.json --basis bezier --scheme pm");
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_EQ(refused.err,
              "supple: --basis bezier: 6 p4, the first of face 0: these patches are no tensor products, but triangles "
              "of degree 4 (docs/pm.md); --basis stored writes them, and all of prep's are\n");
    EXPECT_FALSE(std::filesystem::exists(file("out.obj")));
    EXPECT_FALSE(std::filesystem::exists(file("p.json")));
    const Outcome alone = run("bake cube.obj -o out.obj --basis bezier");
    EXPECT_EQ(alone.exitCode, 2);
    EXPECT_NE(alone.err.find("--patches"), std::string::npos) << alone.err;
}

} // namespace
} // namespace supple::test
