#include "runtime/points/gltf_points.h"

#include "cage/character.h"
#include "runtime/cpu_group.h"
#include "runtime/points/point_domains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace supple::runtime {

namespace {

constexpr double kOutside = 1e-5; ///< weights may be off by rounding

/// Triangles of a primitive: where they begin in Cage::sourceTriangles, and how many they are.
struct TriangleRun {
    uint32_t mesh = 0, primitive = 0, first = 0, count = 0;

    [[nodiscard]] auto name() const { return std::tuple(mesh, primitive); }
};

/// Sorted by name; of parts with one mesh, the first part's comes first.
std::vector<TriangleRun> runsOf(const cage::Cage& cage) {
    std::vector<TriangleRun> runs;
    auto end = static_cast<uint32_t>(cage.sourceTriangles.size() / 3);
    for (auto own = cage.sourcePrimitives.rbegin(); own != cage.sourcePrimitives.rend(); ++own) {
        runs.push_back({own->mesh, own->primitive, own->firstTriangle, end - own->firstTriangle});
        end = own->firstTriangle;
    }
    std::sort(runs.begin(), runs.end(), [](const TriangleRun& a, const TriangleRun& b) {
        return std::tuple(a.name(), a.first) < std::tuple(b.name(), b.first);
    });
    return runs;
}

/// A corner of a face of more sides lies on a circle round the middle.
glm::dvec2 onCircle(uint32_t corner, uint32_t sides) {
    const double turn = 2.0 * std::numbers::pi * corner / sides;
    return {std::cos(turn), std::sin(turn)};
}

/// The place that has these weights of three corners of a face.
SuppleSurfacePoint placeIn(uint32_t face, uint32_t sides, const std::array<uint32_t, 3>& corners,
                           const glm::dvec3& weights) {
    glm::dvec2 at(0.0);
    for (int k = 0; k < 3; ++k) {
        const uint32_t c = corners[static_cast<size_t>(k)];
        const glm::dvec2 square(c == 1 || c == 2 ? 1.0 : 0.0, c >= 2 ? 1.0 : 0.0);
        const glm::dvec2 triangle(c == 1 ? 1.0 : 0.0, c == 2 ? 1.0 : 0.0);
        at += weights[k] * (sides == 3 ? triangle : sides == 4 ? square : onCircle(c, sides));
    }
    if (sides <= 4) {
        const auto a = static_cast<float>(std::clamp(at.x, 0.0, 1.0)),
                   b = static_cast<float>(std::clamp(at.y, 0.0, 1.0));
        return {face, 0, a, sides == 3 ? std::min(b, 1.0f - a) : b};
    }
    const double turn = std::atan2(at.y, at.x) / (2.0 * std::numbers::pi);
    const auto side = std::min(static_cast<uint32_t>((turn < 0.0 ? turn + 1.0 : turn) * sides), sides - 1);
    const glm::dvec2 first = onCircle(side, sides), next = onCircle((side + 1) % sides, sides);
    const double area = first.x * next.y - first.y * next.x;
    const double ofFirst = std::max(0.0, (at.x * next.y - at.y * next.x) / area);
    const double ofNext = std::max(0.0, (first.x * at.y - first.y * at.x) / area);
    const double most = std::max(1.0, ofFirst + ofNext);
    const auto a = static_cast<float>(ofNext / most);
    return {face, side, a, std::clamp(static_cast<float>(1.0 - (ofFirst + ofNext) / most), 0.0f, 1.0f - a)};
}

std::string triangleText(const SuppleGltfPoint& point) {
    return "mesh " + std::to_string(point.mesh) + " primitive " + std::to_string(point.primitive) + " triangle " +
           std::to_string(point.triangle);
}

Result<SuppleSurfacePoint> findOne(const cage::Cage& cage, const std::vector<TriangleRun>& runs,
                                   const SuppleGltfPoint& point) {
    const glm::dvec3 weights(1.0 - double{point.a} - double{point.b}, point.a, point.b);
    const bool isWithin = weights.x >= -kOutside && weights.y >= -kOutside && weights.z >= -kOutside;
    if (!isWithin || !std::isfinite(weights.x)) {
        return Error{ErrorCode::range, "weights outside of " + triangleText(point)};
    }
    const auto run = std::lower_bound(
        runs.begin(), runs.end(), std::tuple(point.mesh, point.primitive),
        [](const TriangleRun& own, const std::tuple<uint32_t, uint32_t>& name) { return own.name() < name; });
    if (run == runs.end() || run->name() != std::tuple(point.mesh, point.primitive) || point.triangle >= run->count) {
        return Error{ErrorCode::range, "the character has no " + triangleText(point)};
    }
    const uint32_t* const corners = &cage.sourceTriangles[3 * (size_t{run->first} + point.triangle)];
    if (corners[0] == cage::kNone) {
        return kNoPoint;
    }
    const uint32_t face = cage.faceOf(corners[0]);
    if (std::binary_search(cage.holes.begin(), cage.holes.end(), face)) {
        return kNoPoint;
    }
    const uint32_t start = cage.faceStarts[face];
    return placeIn(face, cage.sides(face), {corners[0] - start, corners[1] - start, corners[2] - start}, weights);
}

} // namespace

Status findGltfPoints(const CpuGroup& group, std::span<const SuppleGltfPoint> points,
                      std::span<SuppleSurfacePoint> out) {
    const cage::Cage& cage = group.cage();
    if (cage.sourcePrimitives.empty()) {
        return Error{ErrorCode::range, "the character was read from no glTF file, so it has no triangles of one"};
    }
    const std::vector<TriangleRun> runs = runsOf(cage);
    std::vector<SuppleSurfacePoint> all; // a call that fails writes nothing
    all.reserve(points.size());
    for (size_t k = 0; k < points.size(); ++k) {
        const Result<SuppleSurfacePoint> found = findOne(cage, runs, points[k]);
        if (!found) {
            return Error{found.error().code, "point " + std::to_string(k) + ": " + found.error().message};
        }
        all.push_back(*found);
    }
    std::copy(all.begin(), all.end(), out.begin());
    return success();
}

} // namespace supple::runtime
