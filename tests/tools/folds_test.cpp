// Where P_m folds: corners of every width, rims, and what the measure itself sees.
#include "tests/support/chess_pieces.h"
#include "tests/support/meshes.h"
#include "tools/reference/pm.h"
#include "tools/supple/folds.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

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

TEST(PmFolds, ChessPiecesWithHardCreasesHaveNone) {
    std::set<uint32_t> widths;
    bool straight = false;
    for (const ChessPiece& piece : test::chessPieces()) {
        if (!hasHardCreases(piece)) {
            continue;
        }
        const Mesh mesh = meshOf(piece.cage);
        EXPECT_TRUE(findFolds(mesh).faces.empty()) << piece.name;
        const auto coefficients =
            surface::pm::construct<double>(mesh, std::span<const glm::dvec3>(test::doublePositions(mesh.cage)));
        for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
            EXPECT_EQ(turnedSamples(mesh, coefficients, f), 0u) << piece.name << ", facet " << f;
        }
        for (const surface::pm::Fan& fan : mesh.fans) {
            if (fan.kind == FanKind::corner) {
                widths.insert(fan.width);
            }
            straight = straight || fan.kind == FanKind::straight;
        }
    }
    EXPECT_TRUE(widths.contains(9)) << "feet of merlons";
    EXPECT_TRUE(straight) << "feet of merlons on a ring";
}

} // namespace
} // namespace supple::tools
