// Curvature: second derivatives of every scheme against differences of first ones, surfaces whose curvature is known,
// and that the derivatives belong to the points that the device draws.
#include "cpu/blend.h"
#include "cpu/catmull_clark.h"
#include "cpu/loop.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/sample_assets.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/tools/validated_device.h"
#include "tools/common/figure_file.h"
#include "tools/common/procedural.h"
#include "tools/common/schemes.h"
#include "tools/reference/pm.h"
#include "tools/reference/prep.h"
#include "tools/supple/curvature_view.h"

#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <mutex>

namespace supple::test {
namespace {

using surface::SurfaceJet;
using tools::PosedSurfaces;

constexpr glm::dvec2 kPlaces[] = {{0.37, 0.21}, {0.13, 0.61}, {0.84, 0.11}, {0.07, 0.03}, {0.66, 0.29}};

/// The largest difference between second derivatives and quotients of first ones, as a fraction of their size.
template <class At>
double differenceFrom(const At& at, const glm::dvec2& place) {
    constexpr double kStep = 1e-5;
    const SurfaceJet here = at(place.x, place.y);
    const SurfaceJet right = at(place.x + kStep, place.y), left = at(place.x - kStep, place.y);
    const SurfaceJet above = at(place.x, place.y + kStep), below = at(place.x, place.y - kStep);
    const double size = glm::length(here.du) + glm::length(here.dv) + glm::length(here.duu) + glm::length(here.dvv);
    const glm::dvec3 apart[] = {(right.position - left.position) / (2.0 * kStep) - here.du,
                                (above.position - below.position) / (2.0 * kStep) - here.dv,
                                (right.du - left.du) / (2.0 * kStep) - here.duu,
                                (above.du - below.du) / (2.0 * kStep) - here.duv,
                                (right.dv - left.dv) / (2.0 * kStep) - here.duv,
                                (above.dv - below.dv) / (2.0 * kStep) - here.dvv};
    double worst = 0.0;
    for (const glm::dvec3& each : apart)
        worst = std::max(worst, glm::length(each) / size);
    return std::isfinite(worst) ? worst : 1e9;
}

TEST(SecondDerivatives, OfPrep) {
    const cage::Cage cage = perturbed(biped(), 0.1f, 3);
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    ASSERT_TRUE(topology);
    const std::vector<glm::dvec3> positions = doublePositions(cage);
    const auto coefficients = surface::prep::construct<double>(cage, *topology, positions);
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        const auto patch = surface::prep::gatherPatch<double>(cage, *topology, coefficients, f);
        for (const glm::dvec2& p : kPlaces) {
            const auto at = [&](double u, double v) { return surface::prep::evaluateJet(patch, u, v); };
            EXPECT_LT(differenceFrom(at, p), 1e-8);
            const auto same = surface::prep::evaluate<double>(patch, {p.x, 1.0 - p.x}, {p.y, 1.0 - p.y});
            EXPECT_LT(glm::length(at(p.x, p.y).position - same.position), 1e-13);
            EXPECT_LT(glm::length(at(p.x, p.y).du - same.du) + glm::length(at(p.x, p.y).dv - same.dv), 1e-12);
        }
    }
}

TEST(SecondDerivatives, OfPm) {
    bool seen[8] = {};
    for (const cage::Cage& cage :
         {perturbed(biped(), 0.1f, 3), fanOverPentagons(6), dodecahedron(), quartered(gyroBipyramid(5))}) {
        const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(cage);
        ASSERT_TRUE(mesh);
        const std::vector<glm::dvec3> positions = doublePositions(cage);
        const auto coefficients = surface::pm::construct<double>(*mesh, positions);
        for (uint32_t f = 0; f < mesh->cage.faceCount(); ++f) {
            const auto patch = surface::pm::gatherPatch<double>(*mesh, coefficients, f);
            const bool tensor =
                patch.patchClass == surface::PatchClass::regular || patch.patchClass == surface::PatchClass::polar;
            seen[static_cast<size_t>(patch.patchClass)] = true;
            for (const glm::dvec2& p : kPlaces) {
                surface::pm::DomainPoint<double> point;
                point.sector = f % patch.sides;
                const auto place = [&](double u, double v) {
                    point.u = {u, 1.0 - u}, point.v = {v, 1.0 - v};
                    point.weights = {1.0 - u - v, u, v};
                    return point;
                };
                const auto at = [&](double u, double v) { return surface::pm::evaluateJet(patch, place(u, v)); };
                EXPECT_LT(differenceFrom(at, p), 1e-8);
                const auto same = surface::pm::evaluate(patch, place(p.x, p.y));
                EXPECT_LT(glm::length(at(p.x, p.y).position - same.position), 1e-13);
                if (!tensor) {
                    EXPECT_LT(glm::length(at(p.x, p.y).dv - surface::pm::derivatives(patch, place(p.x, p.y)).d2),
                              1e-12);
                }
            }
        }
    }
    for (const surface::PatchClass each : {surface::PatchClass::regular, surface::PatchClass::polar,
                                           surface::PatchClass::p3, surface::PatchClass::p4, surface::PatchClass::p5})
        EXPECT_TRUE(seen[static_cast<size_t>(each)]) << surface::className(each);
}

/// Compares jets of limit surfaces; creases and semi-sharp creases are among the cages.
template <class Limit>
void compareLimits(surface::subdivision::Subdivision subdivision, uint32_t (Limit::*count)() const) {
    const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
    for (size_t i = 0; i < zoo.size(); i += 5) {
        SCOPED_TRACE(zoo[i].name);
        const auto mesh = surface::subdivision::buildMesh(zoo[i].cage, subdivision);
        ASSERT_TRUE(mesh);
        const std::vector<glm::dvec3> positions = doublePositions(zoo[i].cage);
        const Limit limit(*mesh, positions);
        for (uint32_t f = 0; f < (limit.*count)(); f += 1 + (limit.*count)() / 12) {
            const auto at = [&](double u, double v) { return limit.at(f, u, v).jet(); };
            for (const glm::dvec2& p : kPlaces)
                EXPECT_LT(differenceFrom(at, p), 1e-7) << "face " << f << " at " << p.x << " " << p.y;
        }
    }
}

TEST(SecondDerivatives, OfCatmullClark) {
    using surface::catmull_clark::LimitSurface;
    compareLimits<LimitSurface>(surface::subdivision::Subdivision::catmullClark, &LimitSurface::quadCount);
}

TEST(SecondDerivatives, OfLoop) {
    using surface::loop::LimitSurface;
    compareLimits<LimitSurface>(surface::subdivision::Subdivision::loop, &LimitSurface::triangleCount);
}

TEST(SecondDerivatives, OfBlend) {
    cage::Cage creased = perturbed(biped(), 0.1f, 3);
    creased.creases = {{creased.faceVertices[0], creased.faceVertices[1], 10.0f},
                       {creased.faceVertices[1], creased.faceVertices[2], 10.0f}};
    for (const cage::Cage& cage : {creased, perturbed(fan(5, 2, 4.0, false), 0.1f, 1), trapezohedron(7)}) {
        for (const auto mode : {surface::blend::CreaseMode::cut, surface::blend::CreaseMode::curve}) {
            surface::blend::Options options;
            options.creases = mode;
            const Result<surface::blend::Mesh> mesh = surface::blend::buildMesh(cage, options);
            ASSERT_TRUE(mesh);
            const auto coefficients = surface::blend::construct<double>(*mesh, doublePositions(cage));
            const surface::blend::Evaluator<double> evaluator(*mesh, coefficients, 1);
            for (uint32_t f = 0; f < mesh->cage.faceCount(); ++f) {
                const auto at = [&](double u, double v) {
                    return surface::blend::evaluateJet(*mesh, coefficients, f, u, v);
                };
                for (const glm::dvec2& p : kPlaces) {
                    EXPECT_LT(differenceFrom(at, p), 1e-6);
                    const auto same = evaluator.at(f, glm::dvec2(p.x, 1.0 - p.x), glm::dvec2(p.y, 1.0 - p.y));
                    EXPECT_LT(glm::length(at(p.x, p.y).position - same.position), 1e-13);
                    EXPECT_LT(glm::length(at(p.x, p.y).du - same.du) + glm::length(at(p.x, p.y).dv - same.dv), 1e-12);
                }
            }
        }
    }
}

/// All tests share a device.
class Curvature : public testing::Test {
protected:
    static void SetUpTestSuite() {
        Result<std::unique_ptr<host::Device>> device = host::createValidatedDevice();
        ASSERT_TRUE(device) << device.error().message;
        device_ = std::move(*device);
    }
    static void TearDownTestSuite() { device_.reset(); }
    void SetUp() override { ASSERT_NE(device_, nullptr); }
    void TearDown() override { EXPECT_EQ(device_->validation()->messageCount(), 0u); }

    /// A figure posed on the device and read back.
    static PosedSurfaces posed(host::CharacterFile file, const host::GroupOptions& options) {
        PosedSurfaces surfaces;
        const Status status = read(*device_, std::move(file), options, surfaces);
        EXPECT_TRUE(status) << (status ? "" : status.error().message);
        return surfaces;
    }
    static PosedSurfaces posed(const cage::Cage& cage, const host::GroupOptions& options) {
        host::CharacterFile file;
        file.path = "cage";
        file.character.name = "cage";
        file.character.cage = cage;
        return posed(std::move(file), options);
    }

private:
    static Status read(host::Device& device, host::CharacterFile file, const host::GroupOptions& options,
                       PosedSurfaces& posed) {
        Result<std::unique_ptr<host::Context>> context = host::Context::create(device);
        if (!context)
            return context.error();
        Result<std::unique_ptr<host::Figure>> figure = host::createFigure(**context, std::move(file));
        if (!figure)
            return figure.error();
        Result<std::unique_ptr<host::FigureGroup>> group = host::FigureGroup::create(**figure, options);
        if (!group)
            return group.error();
        Status status = (*group)->pose(0, SUPPLE_REST_POSE, 0.0);
        const SuppleGroup groups[] = {(*group)->handle()};
        if (status)
            status = (*context)->evaluate(groups);
        Result<PosedSurfaces> read = status ? tools::readPosed(**group) : Result<PosedSurfaces>(status.error());
        if (!read)
            return read.error();
        posed = std::move(*read);
        return success();
    }
    inline static std::unique_ptr<host::Device> device_;
};

const host::GroupOptions kSmooth[] = {
    {.scheme = SUPPLE_SCHEME_PREP, .rate = 4},
    {.scheme = SUPPLE_SCHEME_PM, .rate = 4},
    {.scheme = SUPPLE_SCHEME_CATMULL_CLARK, .rate = 4},
    {.scheme = SUPPLE_SCHEME_LOOP, .rate = 4},
    {.scheme = SUPPLE_SCHEME_BLEND, .rate = 4},
    {.scheme = SUPPLE_SCHEME_FRAGMENTS, .rate = 4},
    {.scheme = SUPPLE_SCHEME_FRAGMENTS, .rate = 4, .fragmentRules = SUPPLE_RULES_LOOP},
};

/// How far the points that derivatives are taken at are from the device's, as a fraction of the extent.
double apart(const PosedSurfaces& posed, const cage::Cage& cage, const tools::SurfaceRules& rules) {
    std::mutex mutex;
    double worst = 0.0;
    size_t visited = 0;
    const double extent = 2.0 * static_cast<double>(host::boundsOf(posed.cage).radius());
    const Status status = tools::visitSamples(
        posed, cage, rules, [&](size_t vertex, const tools::Jets& jets, uint32_t patch, uint32_t sample) {
            const double distance =
                glm::length(jets(patch, sample, 0.0).position - glm::dvec3(posed.vertices[vertex])) / extent;
            const std::scoped_lock lock(mutex);
            worst = std::max(worst, std::isfinite(distance) ? distance : 1e9);
            ++visited;
        });
    EXPECT_TRUE(status) << (status ? "" : status.error().message);
    EXPECT_EQ(visited, posed.vertices.size());
    return worst;
}

TEST_F(Curvature, IsTakenWhereTheDeviceDraws) {
    cage::Cage open = perturbed(biped(), 0.1f, 3);
    open.holes = {3, 40};
    for (const host::GroupOptions& options : kSmooth) {
        const tools::SurfaceRules rules{.fragments = options.fragmentRules};
        for (const cage::Cage& cage : {open, rotatedFaces(fanOverPentagons(7))}) {
            if (options.scheme == SUPPLE_SCHEME_PREP && !allQuads(cage))
                continue;
            EXPECT_LT(apart(posed(cage, options), cage, rules), 2e-6)
                << tools::schemeName(options.scheme) << " " << cage.faceCount();
        }
    }
}

/// Parts of several schemes: each surface has a cage of its own.
TEST_F(Curvature, IsTakenWhereTheDeviceDrawsParts) {
    Result<host::CharacterFile> file = host::readCharacterFile(kWren, {});
    ASSERT_TRUE(file);
    const cage::Cage cage = file->character.cage;
    host::GroupOptions options{.rate = 1};
    options.partSchemes = {SUPPLE_SCHEME_PM};
    const PosedSurfaces surfaces = posed(std::move(*file), options);
    EXPECT_GE(surfaces.surfaces.size(), 2u);
    EXPECT_LT(apart(surfaces, cage, {}), 2e-6);
}

/// z = a x^2 + b y^2 on a grid: what the splines make of `lower` less of it, they have exactly, away from the border.
constexpr double kA = 0.11, kB = -0.07;
cage::Cage paraboloid(bool triangles, double lower) {
    cage::Cage cage = grid(8, 8);
    for (glm::vec3& p : cage.positions) {
        const double x = static_cast<double>(p.x) - 4.0, y = static_cast<double>(p.y) - 4.0;
        p = glm::vec3(glm::dvec3(x, y, kA * x * x + kB * y * y - lower * (kA + kB)));
    }
    return triangles ? inTriangles(cage) : cage;
}

TEST_F(Curvature, OfParaboloidsIsExact) {
    for (const host::GroupOptions& options : kSmooth) {
        const bool loop = options.scheme == SUPPLE_SCHEME_LOOP || options.fragmentRules == SUPPLE_RULES_LOOP;
        const cage::Cage cage = paraboloid(loop, options.scheme == SUPPLE_SCHEME_BLEND ? 0.0 : 1.0 / 3.0);
        const PosedSurfaces surfaces = posed(cage, options);
        std::mutex mutex;
        double worstMean = 0.0, worstGaussian = 0.0;
        size_t count = 0;
        const Status status = tools::visitSamples(
            surfaces, cage, {.fragments = options.fragmentRules},
            [&](size_t vertex, const tools::Jets& jets, uint32_t patch, uint32_t sample) {
                const glm::dvec3 at(surfaces.vertices[vertex]);
                if (std::max(std::abs(at.x), std::abs(at.y)) > 1.99)
                    return; // the border's rules reach so far
                const double p = 2.0 * kA * at.x, q = 2.0 * kB * at.y, square = 1.0 + p * p + q * q;
                // The grid faces +z, so that the bowl along x is hollow: its mean curvature is negative.
                const double mean =
                    -((1.0 + q * q) * 2.0 * kA + (1.0 + p * p) * 2.0 * kB) / (2.0 * square * std::sqrt(square));
                const double gaussian = 4.0 * kA * kB / (square * square);
                const surface::Curvature found = tools::curvatureAt(jets, patch, sample);
                const std::scoped_lock lock(mutex);
                worstMean = std::max(worstMean, found.exists ? std::abs(found.mean - mean) : 1e9);
                worstGaussian = std::max(worstGaussian, found.exists ? std::abs(found.gaussian - gaussian) : 1e9);
                ++count;
            });
        ASSERT_TRUE(status);
        std::printf("%-14s %5zu samples, mean curvature within %.1e, Gaussian within %.1e\n",
                    tools::schemeName(options.scheme), count, worstMean, worstGaussian);
        EXPECT_GT(count, 100u);
        // Corners of limits are taken a thousandth of a patch further in.
        EXPECT_LT(worstMean, 2e-4);
        EXPECT_LT(worstGaussian, 2e-4);
    }
}

/// A fine cage of a unit sphere: every scheme is near it, so both curvatures are near 1 but round the corners of the
/// cube.
TEST_F(Curvature, OfSpheresIsOne) {
    const cage::Cage cage = cage::makeCubeSphere(6);
    for (const host::GroupOptions& options : kSmooth) {
        if (options.scheme == SUPPLE_SCHEME_LOOP || options.fragmentRules == SUPPLE_RULES_LOOP)
            continue; // quads cut along one diagonal are no even triangles
        const PosedSurfaces surfaces = posed(cage, options);
        std::atomic<size_t> near = 0, all = 0, concave = 0;
        ASSERT_TRUE(tools::visitSamples(
            surfaces, cage, {}, [&](size_t, const tools::Jets& jets, uint32_t patch, uint32_t sample) {
                const surface::Curvature found = tools::curvatureAt(jets, patch, sample);
                near += found.exists && std::abs(found.mean - 1.0) < 0.1 && std::abs(found.gaussian - 1.0) < 0.2;
                concave += !found.exists || found.mean < 0.0;
                ++all;
            }));
        std::printf("%-14s %zu of %zu samples near 1, %zu concave\n", tools::schemeName(options.scheme), near.load(),
                    all.load(), concave.load());
        EXPECT_GT(near.load() * 10, all.load() * 8) << tools::schemeName(options.scheme);
        EXPECT_EQ(concave.load(), 0u) << tools::schemeName(options.scheme);
    }
}

TEST_F(Curvature, ScaleHasZeroInTheMiddle) {
    const cage::Cage cage = grid(4, 4);
    const PosedSurfaces surfaces = posed(cage, kSmooth[1]);
    for (const uint32_t view : {host::shared::kViewMeanCurvature, host::shared::kViewGaussianCurvature}) {
        const Result<std::vector<float>> values = tools::curvatures(surfaces, cage, {}, view);
        ASSERT_TRUE(values);
        for (const float value : *values)
            EXPECT_NEAR(value, 0.5f, 1e-5f) << "a plane";
    }
    const std::vector<tools::Legend::Mark> marks = tools::curvatureMarks();
    EXPECT_EQ(marks.front().at, 0.0f);
    EXPECT_EQ(marks.back().at, 1.0f);
    EXPECT_EQ(marks[marks.size() / 2].at, 0.5f);
}

} // namespace
} // namespace supple::test
