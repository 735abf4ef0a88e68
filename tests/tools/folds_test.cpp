// Where P_m folds: corners of every width, rims, and what the measure itself sees.
#include "tests/support/chess_pieces.h"
#include "tests/support/meshes.h"
#include "tools/reference/pm.h"
#include "tools/supple/folds.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <set>
#include <span>
#include <vector>

namespace supple::tools {
namespace {

using surface::pm::FanKind;
using surface::pm::Mesh;
using test::ChessPiece;

Mesh meshOf(const cage::Cage& cage) {
    Result<Mesh> mesh = surface::pm::buildMesh(cage);
    EXPECT_TRUE(mesh.ok());
    return mesh.ok() ? std::move(*mesh) : Mesh{};
}

bool hasHardCreases(const ChessPiece& piece) {
    return piece.cage.creases.front().sharpness >= cage::kHardSharpness;
}

/// Samples of a facet whose normal is more than a right angle away from the facet's own.
uint32_t turnedSamples(const Mesh& mesh, const surface::pm::Coefficients<double>& coefficients, uint32_t facet) {
    constexpr uint32_t kRate = 16;
    const uint32_t first = mesh.cage.faceStarts[facet];
    const auto at = [&](uint32_t i) { return glm::dvec3(mesh.cage.positions[mesh.cage.faceVertices[first + i]]); };
    glm::dvec3 side(0.0);
    for (uint32_t i = 1; i + 1 < mesh.cage.sides(facet); ++i) {
        side += glm::cross(at(i) - at(0), at(i + 1) - at(0));
    }
    const surface::PatchClass patchClass = mesh.classes[facet];
    const auto patch = surface::pm::gatherPatch<double>(mesh, coefficients, facet);
    uint32_t turned = 0;
    for (uint32_t s = 0; s < surface::sampleCount(surface::domainOf(patchClass), kRate); ++s) {
        const auto point = surface::pm::domainPoint<double>(patchClass, kRate, s);
        turned += glm::dot(surface::pm::evaluate(patch, point).normal, side) <= 0.0 ? 1 : 0;
    }
    return turned;
}

/// Calls `check` with every piece whose creases are hard, or with all others.
template <class Check>
void forPieces(bool hard, const Check& check) {
    size_t pieces = 0;
    for (const ChessPiece& piece : test::chessPieces()) {
        if (hasHardCreases(piece) == hard) {
            SCOPED_TRACE(piece.name);
            check(meshOf(piece.cage));
            ++pieces;
        }
    }
    EXPECT_GT(pieces, 10u);
}

TEST(PmFolds, ChessPiecesWithHardCreasesHaveNone) {
    std::set<uint32_t> widths;
    bool straight = false;
    forPieces(true, [&](const Mesh& mesh) {
        EXPECT_TRUE(findFolds(mesh).faces.empty());
        const std::vector<glm::dvec3> positions = test::doublePositions(mesh.cage);
        const auto coefficients = surface::pm::construct<double>(mesh, std::span(positions));
        for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
            EXPECT_EQ(turnedSamples(mesh, coefficients, f), 0u) << "facet " << f;
        }
        for (const surface::pm::Fan& fan : mesh.fans) {
            if (fan.kind == FanKind::corner) {
                widths.insert(fan.width);
            }
            straight = straight || fan.kind == FanKind::straight;
        }
    });
    EXPECT_TRUE(widths.contains(9)) << "feet of merlons";
    EXPECT_TRUE(straight) << "feet of merlons on a ring";
}

TEST(PmFolds, DeformedChessPiecesWithHardCreasesHaveNone) {
    // Widths and factors are those of the rest pose.
    using Deform = glm::dvec3 (*)(glm::dvec3);
    constexpr Deform kDeforms[] = {
        [](glm::dvec3 p) {
            const double a = 0.65 * p.y;
            return glm::dvec3(p.x * std::cos(a) - p.z * std::sin(a), p.y, p.x * std::sin(a) + p.z * std::cos(a));
        },
        [](glm::dvec3 p) {
            const double a = 0.65 * p.y, r = 1.0 / 0.65 - p.x;
            return glm::dvec3(1.0 / 0.65 - r * std::cos(a), r * std::sin(a), p.z);
        },
        [](glm::dvec3 p) { return glm::dvec3(p.x, p.y / 3.0, p.z); },
        [](glm::dvec3 p) { return glm::dvec3(p.x / 3.0, p.y, p.z); },
        [](glm::dvec3 p) { return glm::dvec3(p.x + p.y, p.y, p.z); },
    };
    forPieces(true, [&](const Mesh& rest) {
        for (const Deform& deform : kDeforms) {
            Mesh mesh = rest;
            for (glm::vec3& p : mesh.cage.positions) {
                p = deform(p);
            }
            EXPECT_TRUE(findFolds(mesh).faces.empty());
        }
    });
}

TEST(PmFolds, SemiSharpChessPiecesHaveHardlyAny) {
    // Where three creases meet, all facets share a tangent plane.
    forPieces(false, [](const Mesh& mesh) {
        const Folds folds = findFolds(mesh);
        EXPECT_LE(folds.faces.size(), 4u);
        for (const Folds::Face& face : folds.faces) {
            EXPECT_LE(face.flipped, face.triangles / 32) << "face " << face.face;
        }
    });
}

TEST(PmFolds, LidsOfSemiSharpCreasesKeepTheirSideUp) {
    for (const float sharpness : {0.5f, 1.0f, 2.0f, 3.0f, 5.0f, 8.0f, 9.9f}) {
        cage::Cage cage = test::cube();
        const std::vector<uint32_t> lid = test::facesOf(cage)[1];
        for (size_t i = 0; i < lid.size(); ++i) {
            cage.creases.push_back({lid[i], lid[(i + 1) % lid.size()], sharpness});
        }
        const Mesh mesh = meshOf(cage);
        EXPECT_TRUE(findFolds(mesh).faces.empty()) << sharpness;
        const std::vector<glm::dvec3> positions = test::doublePositions(mesh.cage);
        const auto coefficients = surface::pm::construct<double>(mesh, std::span(positions));
        EXPECT_EQ(turnedSamples(mesh, coefficients, 1), 0u) << sharpness;
    }
}

TEST(PmFolds, TangentsInsideCornersAreAtMostHalfTheirEdges) {
    uint32_t shortened = 0;
    forPieces(true, [&](const Mesh& mesh) {
        const std::vector<glm::dvec3> positions = test::doublePositions(mesh.cage);
        const auto coefficients = surface::pm::construct<double>(mesh, std::span(positions));
        for (const surface::pm::Fan& fan : mesh.fans) {
            for (uint32_t j = 1; fan.kind == FanKind::corner && j < fan.facets; ++j) {
                const glm::dvec3 p = positions[fan.vertex], t = coefficients.tangents[fan.firstSlot + j] - p;
                const glm::dvec3 edge = positions[mesh.topology.spokeVertices[mesh.slotSpokes[fan.firstSlot + j]]] - p;
                EXPECT_LE(glm::length(t), 0.5001 * glm::length(edge));
                EXPECT_GT(glm::dot(t, edge), 0.0);
            }
            for (const surface::pm::FanEnd& end : fan.ends) {
                shortened += end.partner == cage::kNone && end.own < 1.0 / 3.0 ? 1 : 0;
            }
        }
    });
    EXPECT_GT(shortened, 0u);
}

TEST(PmFolds, RestPosesOfNoSizeMakeRightAngles) {
    // A host may write the cage later, and give no rest pose at all.
    for (const ChessPiece& piece : test::chessPieces()) {
        cage::Cage cage = piece.cage;
        std::fill(cage.positions.begin(), cage.positions.end(), glm::vec3(1.0f));
        for (const surface::pm::Fan& fan : meshOf(cage).fans) {
            EXPECT_EQ(fan.width, surface::pm::kRightAngle);
            EXPECT_NE(fan.kind, FanKind::straight);
            EXPECT_TRUE(fan.plainEnds());
        }
    }
}

} // namespace
} // namespace supple::tools
