// Tangents of polygons against the original MikkTSpace: tests/data/tangents/mikktspace.js says where the vectors are
// from.
#include "cage/corner_normals.h"
#include "cage/tangents.h"
#include "tests/support/json_vectors.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace supple::cage {
namespace {

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / 3.14159265358979323846;
}

struct Vectors {
    std::string name;
    Cage cage;
    std::vector<glm::vec4> tangents;
};

std::vector<Vectors> readVectors() {
    std::vector<Vectors> all;
    for (const nlohmann::json& j : test::parseFile(std::string(SUPPLE_TEST_DATA) + "/tangents/mikktspace.json")) {
        Vectors v;
        v.name = j.at("name").get<std::string>();
        for (const glm::dvec3& position : test::jsonVectors(j.at("positions"))) {
            v.cage.positions.emplace_back(position);
        }
        v.cage.faceVertices = j.at("triangles").get<std::vector<uint32_t>>();
        for (uint32_t corner = 0; corner <= v.cage.cornerCount(); corner += 3) {
            v.cage.faceStarts.push_back(corner);
        }
        for (const glm::dvec3& normal : test::jsonVectors(j.at("normals"))) {
            v.cage.cornerNormals.emplace_back(normal);
        }
        for (const auto& uv : j.at("uvs")) {
            v.cage.cornerUvs.emplace_back(uv.at(0).get<float>(), uv.at(1).get<float>());
        }
        for (const auto& t : j.at("tangents")) {
            v.tangents.emplace_back(t.at(0).get<float>(), t.at(1).get<float>(), t.at(2).get<float>(),
                                    t.at(3).get<float>());
        }
        all.push_back(std::move(v));
    }
    return all;
}

std::vector<uint32_t> allCorners(const Cage& cage) {
    std::vector<uint32_t> corners(cage.cornerCount());
    std::iota(corners.begin(), corners.end(), 0u);
    return corners;
}

TEST(Tangents, OfTexturesAreThoseOfMikktspace) {
    const std::vector<Vectors> all = readVectors();
    ASSERT_EQ(all.size(), 5u);
    for (const Vectors& v : all) {
        const std::vector<glm::vec4> tangents =
            triangleTangents(v.cage, allCorners(v.cage), v.cage.cornerNormals, v.cage.cornerUvs);
        ASSERT_EQ(tangents.size(), v.tangents.size());
        double largest = 0.0;
        uint32_t none = 0;
        for (size_t i = 0; i < tangents.size(); ++i) {
            if (glm::vec3(tangents[i]) == glm::vec3(0.0f)) {
                // MikkTSpace says x where it knows no direction.
                EXPECT_EQ(glm::vec3(v.tangents[i]), glm::vec3(1.0f, 0.0f, 0.0f)) << v.name << ", corner " << i;
                EXPECT_EQ(tangents[i].w, 1.0f);
                ++none;
                continue;
            }
            largest = std::max(largest, degreesBetween(tangents[i], v.tangents[i]));
            EXPECT_NEAR(glm::length(glm::vec3(tangents[i])), 1.0f, 1e-6f);
            EXPECT_EQ(tangents[i].w, -v.tangents[i].w) << v.name << ", corner " << i;
        }
        std::printf("%s: %zu corners, %u without a direction, up to %.2e degrees from MikkTSpace\n", v.name.c_str(),
                    tangents.size(), none, largest);
        EXPECT_LT(largest, 0.002) << v.name;
        EXPECT_LT(none, tangents.size() / 4);
    }
}

TEST(Tangents, OfTheFileComeFirst) {
    Vectors v = readVectors().front();
    const std::vector<glm::vec4> own =
        triangleTangents(v.cage, allCorners(v.cage), v.cage.cornerNormals, v.cage.cornerUvs);
    v.cage.cornerTangents.assign(v.cage.cornerCount(), glm::vec4(0.0f));
    v.cage.cornerTangents[5] = {0.6f, 0.0f, 0.8f, -1.0f};
    const std::vector<glm::vec4> mixed =
        triangleTangents(v.cage, allCorners(v.cage), v.cage.cornerNormals, v.cage.cornerUvs);
    for (size_t i = 0; i < mixed.size(); ++i) {
        EXPECT_EQ(mixed[i], i == 5 ? v.cage.cornerTangents[5] : own[i]) << "corner " << i;
    }
}

TEST(Tangents, AreNoneWithoutTextureCoordinates) {
    Vectors v = readVectors().front();
    v.cage.cornerUvs.clear();
    for (const glm::vec4& tangent :
         triangleTangents(v.cage, allCorners(v.cage), v.cage.cornerNormals, v.cage.cornerUvs)) {
        EXPECT_EQ(tangent, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    }
    EXPECT_TRUE(triangleTangents({}, {}, {}, {}).empty());
}

} // namespace
} // namespace supple::cage
