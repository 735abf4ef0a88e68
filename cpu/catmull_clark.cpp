// Equation numbers are those of docs/catmull_clark.md.
#include "cpu/catmull_clark.h"

#include "cpu/fragment.h"
#include "surface/chains/arrangement.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace supple::surface::catmull_clark {

using namespace chains;
namespace {

using subdivision::Fan;
using subdivision::Fragment;
using subdivision::FragmentNet;
using subdivision::kNoPoint;
using subdivision::LevelNet;
using subdivision::LimitShape;

constexpr int kMostLevels = 40;

/// The four weights of a leaf in one direction, and their first and second derivatives.
struct Weights {
    std::array<double, 4> value{}, slope{}, bend{};
};

/// Of an endless crease, and of one that is sharp for `steps` steps, a point across it keeps this weight (1).
struct Crease {
    double value = 0.0, slope = 0.0, bend = 0.0;
};
Crease sharpWeight(float sharpness, double x) {
    if (sharpness >= kInfiniteSharpness) {
        return {};
    }
    const double steps = std::floor(static_cast<double>(sharpness)), part = static_cast<double>(sharpness) - steps;
    Crease sum;
    for (const auto& [weight, scale] :
         {std::pair(1.0 - part, std::exp2(steps)), std::pair(part, std::exp2(steps + 1.0))}) {
        const double rest = std::max(0.0, 1.0 - x * scale);
        sum.value += weight * rest * rest * rest / (6.0 * scale);
        sum.slope -= weight * rest * rest / 2.0;
        sum.bend += weight * rest * scale;
    }
    return sum;
}

/// Uniform cubic B-splines at x of 0..1, with a crease of this sharpness at x = 0 (2).
Weights leafWeights(double x, float sharpness) {
    const double s = 1.0 - x;
    Weights w;
    w.value = {s * s * s / 6.0, (1.0 + 3.0 * (s + s * s * x)) / 6.0, (1.0 + 3.0 * (x + x * x * s)) / 6.0,
               x * x * x / 6.0};
    w.slope = {-s * s / 2.0, 1.5 * x * x - 2.0 * x, 2.0 * s - 1.5 * s * s, x * x / 2.0};
    w.bend = {s, 3.0 * x - 2.0, 3.0 * s - 2.0, x};
    if (sharpness > 0.0f) {
        const Crease crease = sharpWeight(sharpness, x);
        const double value = w.value[0] - crease.value, slope = w.slope[0] - crease.slope;
        const double bend = w.bend[0] - crease.bend;
        w.value = {crease.value, w.value[1] + 2.0 * value, w.value[2] - value, w.value[3]};
        w.slope = {crease.slope, w.slope[1] + 2.0 * slope, w.slope[2] - slope, w.slope[3]};
        w.bend = {crease.bend, w.bend[1] + 2.0 * bend, w.bend[2] - bend, w.bend[3]};
    }
    return w;
}

/// A leaf: 4 x 4 points of a fragment, the first at (firstA, firstB) of a sector.
struct Leaf {
    int32_t firstA = -1, firstB = -1;
    Weights a, b;
};

Point evaluate(const LevelNet& net, const Fan& fan, uint32_t sector, const Leaf& leaf) {
    const std::span<const glm::dvec3> points = net.points();
    Point sum;
    for (int32_t j = 0; j < 4; ++j) {
        for (int32_t i = 0; i < 4; ++i) {
            const uint32_t index = subdivision::pointIndex(fan, sector, leaf.firstA + i, leaf.firstB + j);
            if (index == kNoPoint || index >= points.size()) {
                continue; // behind a border, where weights are zero
            }
            const glm::dvec3& p = points[index];
            const size_t x = static_cast<size_t>(i), y = static_cast<size_t>(j);
            sum.position += leaf.a.value[x] * leaf.b.value[y] * p;
            sum.du += leaf.a.slope[x] * leaf.b.value[y] * p;
            sum.dv += leaf.a.value[x] * leaf.b.slope[y] * p;
            sum.duu += leaf.a.bend[x] * leaf.b.value[y] * p;
            sum.duv += leaf.a.slope[x] * leaf.b.slope[y] * p;
            sum.dvv += leaf.a.value[x] * leaf.b.bend[y] * p;
        }
    }
    sum.position += net.origin();
    return sum;
}

glm::dvec3 unitNormal(const glm::dvec3& du, const glm::dvec3& dv) {
    return subdivision::unitOrZero(glm::cross(du, dv));
}

} // namespace

Point limitAtCentre(const subdivision::LimitPose& pose, const LimitShape::Sector& at) {
    const subdivision::Mesh& mesh = pose.shape().mesh();
    const Fragment& fragment = mesh.fragments[at.fragment];
    const FragmentNet<double> net = pose.netOf(fragment);
    const Fan fan = net.fanOf(fragment);
    const auto spokes = mesh.spokeSharpness.begin() + fragment.firstSpoke;
    const Limit limit = limitOf({fan, {spokes, spokes + fragment.spokes()}, fragment.centreSharpness});
    const glm::dvec3 centre = net.points()[0];
    const auto weighted = [&](const subdivision::CentreMask& mask) {
        glm::dvec3 sum(0.0);
        for (size_t i = 1; i < mask.size(); ++i) {
            sum += mask[i] * (net.points()[i] - centre);
        }
        return sum;
    };
    Point point;
    point.position = centre + weighted(limit.position);
    for (const LimitRun& run : limit.runs) {
        if ((at.number + fan.sectors - run.firstSector) % fan.sectors >= run.sectors) {
            continue;
        }
        glm::dvec3 normal(0.0);
        for (size_t k = 1; k < run.tangents.size(); ++k) {
            normal += glm::cross(weighted(run.tangents[k - 1]), weighted(run.tangents[k]));
        }
        point.normal = subdivision::unitOrZero(normal);
    }
    return point;
}

void turnSecondDerivatives(const glm::dvec2& u, const glm::dvec2& v, Point& point) {
    const glm::dvec3 aa = point.duu, ab = point.duv, bb = point.dvv;
    point.duu = u.x * u.x * aa + 2.0 * u.x * u.y * ab + u.y * u.y * bb;
    point.duv = u.x * v.x * aa + (u.x * v.y + u.y * v.x) * ab + u.y * v.y * bb;
    point.dvv = v.x * v.x * aa + 2.0 * v.x * v.y * ab + v.y * v.y * bb;
}

namespace {

/// The corner that a place is nearest to.
uint32_t cornerAt(double u, double v) {
    const bool right = u > 1.0 - u, up = v > 1.0 - v;
    return up ? (right ? 2 : 3) : (right ? 1 : 0);
}

} // namespace

subdivision::SectorLevel LimitSurface::levelAt(const LimitShape& shape, uint32_t quad, double u, double v) {
    const LimitShape::Sector& sector = shape.sectors()[4 * size_t{quad} + cornerAt(u, v)];
    if (shape.isUniform(sector.fragment)) {
        return {sector, 2};
    }
    const double larger = std::max(std::min(u, 1.0 - u), std::min(v, 1.0 - v));
    if (larger < std::exp2(-kMostLevels)) {
        return {sector, 0};
    }
    int exponent = 0;
    std::frexp(larger, &exponent);
    // 2^-level <= the larger one < 2^(1 - level)
    return {sector, static_cast<uint32_t>(std::clamp(1 - exponent, 2, kMostLevels))};
}

Point LimitSurface::at(uint32_t quad, double u, double v) const {
    const subdivision::SectorLevel at = levelAt(pose_->shape(), quad, u, v);
    return at.level == 0 ? limitAtCentre(*pose_, at.sector)
                         : on({*pose_, at.sector.fragment, at.level}, at.sector, u, v);
}

Point LimitSurface::on(const LevelNet& net, const LimitShape::Sector& sector, double u, double v) {
    const uint32_t corner = cornerAt(u, v);
    const bool right = corner == 1 || corner == 2, up = corner >= 2;
    const double across = right ? 1.0 - u : u, along = up ? 1.0 - v : v;
    const bool turned = corner % 2 == 1; // a runs along v
    const double a = turned ? along : across, b = turned ? across : along;
    Point point = inQuarter(net, sector.number, a, b);
    const glm::dvec3 da = point.du, db = point.dv;
    const std::array<std::array<glm::dvec3, 2>, 4> derivatives = {{{da, db}, {-db, da}, {-da, -db}, {db, -da}}};
    point.du = derivatives[corner][0];
    point.dv = derivatives[corner][1];
    constexpr glm::dvec2 kA(1.0, 0.0), kB(0.0, 1.0);
    constexpr std::array<std::array<glm::dvec2, 2>, 4> kSlopes = {{{kA, kB}, {-kB, kA}, {-kA, -kB}, {kB, -kA}}};
    turnSecondDerivatives(kSlopes[corner][0], kSlopes[corner][1], point);
    return point;
}

Point LimitSurface::inQuarter(const LevelNet& net, uint32_t sector, double a, double b) {
    const Fragment& fragment = net.fragment();
    const Fan fan{Subdivision::catmullClark, fragment.sectors, fragment.open};
    const double scale = std::exp2(net.level()), x = a * scale, y = b * scale;
    const bool farA = x >= 1.0, farB = y >= 1.0;
    const uint32_t spokes = fragment.spokes();
    const float alongA = net.sharpnessOf(sector), alongB = net.sharpnessOf((sector + 1) % spokes);
    Leaf leaf;
    leaf.firstA = farA ? 0 : -1;
    leaf.firstB = farB ? 0 : -1;
    leaf.a = leafWeights(farA ? x - 1.0 : x, farA ? 0.0f : alongB);
    leaf.b = leafWeights(farB ? y - 1.0 : y, farB ? 0.0f : alongA);
    Point point = evaluate(net, fan, sector, leaf);
    point.normal = unitNormal(point.du, point.dv);
    point.du *= scale;
    point.dv *= scale;
    turnSecondDerivatives({scale, 0.0}, {0.0, scale}, point);
    return point;
}

} // namespace supple::surface::catmull_clark
