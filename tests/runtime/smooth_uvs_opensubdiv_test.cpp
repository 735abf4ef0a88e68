// Smooth texture coordinates on the device against OpenSubdiv's face-varying limit, in its six modes. The cages have
// neither folds nor poles, where rules of ours go beyond OpenSubdiv's (docs/smooth_uvs.md).
#include "cpu/grid_sample.h"
#include "tests/support/crowd.h"
#include "tests/support/exact_quads.h"
#include "tests/support/loop_triangles.h"
#include "tests/support/meshes.h"
#include "tests/support/subdivision_zoo.h"
#ifdef SUPPLE_HAS_OPENSUBDIV
#include "tools/bench/opensubdiv_refiner.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#endif

#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace supple::test {
namespace {

#ifndef SUPPLE_HAS_OPENSUBDIV

TEST(SmoothUvsOpenSubdiv, InSixModes) {
    GTEST_SKIP() << "built without OpenSubdiv (opensubdiv/far/topologyRefiner.h and the library osdCPU)";
}

#else

using namespace OpenSubdiv;
using cage::UvMode;

constexpr struct {
    UvMode mode;
    Sdc::Options::FVarLinearInterpolation theirs;
} kModes[] = {{UvMode::none, Sdc::Options::FVAR_LINEAR_NONE},
              {UvMode::cornersOnly, Sdc::Options::FVAR_LINEAR_CORNERS_ONLY},
              {UvMode::cornersPlus1, Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1},
              {UvMode::cornersPlus2, Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2},
              {UvMode::boundaries, Sdc::Options::FVAR_LINEAR_BOUNDARIES},
              {UvMode::all, Sdc::Options::FVAR_LINEAR_ALL}};

/// The limit of the first UV set by Bfr, in double.
class UvLimit {
public:
    UvLimit(const cage::Cage& cage, Sdc::SchemeType scheme, Sdc::Options::FVarLinearInterpolation linear)
        : channel_(channelOf(cage, linear)), refiner_(bench::opensubdivRefiner(cage, scheme, &channel_)),
          factory_(*refiner_, Bfr::SurfaceFactory::Options().SetApproxLevelSmooth(10).SetApproxLevelSharp(10)),
          faces_(cage.faceCount()) {
        std::vector<glm::dvec2> values(static_cast<size_t>(channel_.count));
        for (uint32_t c = 0; c < cage.cornerCount(); ++c) {
            values[static_cast<size_t>(channel_.values[c])] = cage.cornerUvs[c];
        }
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            Face& face = faces_[f];
            if (factory_.InitFaceVaryingSurface(static_cast<int>(f), &face.surface, 0)) {
                face.points.resize(2 * static_cast<size_t>(face.surface.GetNumPatchPoints()));
                face.surface.PreparePatchPoints(&values[0].x, 2, face.points.data(), 2);
            }
        }
    }
    [[nodiscard]] glm::dvec2 at(const QuadsOfFaces::Place& place) const {
        const Face& face = faces_[place.face];
        glm::dvec2 uv = place.uv, value(0.0);
        const Bfr::Parameterization parameters = face.surface.GetParameterization();
        if (parameters.HasSubFaces()) {
            parameters.ConvertNormalizedSubFaceToCoord(static_cast<int>(place.part), &place.uv.x, &uv.x);
        }
        face.surface.Evaluate(&uv.x, face.points.data(), 2, &value.x);
        return value;
    }

private:
    static bench::FaceVaryingChannel channelOf(const cage::Cage& cage, Sdc::Options::FVarLinearInterpolation linear) {
        bench::FaceVaryingChannel channel{{}, 0, linear};
        std::map<std::pair<float, float>, int> values;
        for (const glm::vec2& uv : cage.cornerUvs) {
            channel.values.push_back(values.try_emplace({uv.x, uv.y}, static_cast<int>(values.size())).first->second);
        }
        channel.count = static_cast<int>(values.size());
        return channel;
    }

    struct Face {
        Bfr::Surface<double> surface;
        std::vector<double> points;
    };
    bench::FaceVaryingChannel channel_;
    std::unique_ptr<Far::TopologyRefiner> refiner_;
    Bfr::RefinerSurfaceFactory<> factory_;
    std::vector<Face> faces_;
};

/// A chart that is cut at random: the values of a third of the faces' corners are moved away from their neighbors'.
/// Runs round a vertex that are parted by others have no value in common: there OpenSubdiv 3.5 counts wrongly.
cage::Cage inPieces(cage::Cage cage, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    cage.cornerUvs.clear();
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            const glm::vec3& p = cage.positions[cage.faceVertices[c]];
            const glm::vec2 moved =
                share(random) < 0.33f ? glm::vec2(0.1f * share(random), 0.1f * share(random)) : glm::vec2(0.0f);
            cage.cornerUvs.push_back(glm::vec2(0.5f + 0.3f * p.x + 0.05f * p.y * p.y, 0.5f + 0.3f * p.y - 0.04f * p.x) +
                                     moved);
        }
    }
    return cage;
}

/// Where a sample of a patch lies in the faces of the cage.
using PlaceOf = std::function<QuadsOfFaces::Place(uint32_t patch, glm::dvec2 uv)>;

/// Patches of fragments are quarters of the cage's quads.
QuadsOfFaces::Place quarterOf(uint32_t patch, glm::dvec2 uv) {
    return {patch / 4, 0, ExactQuads::inFace(0.5 * uv.x, 0.5 * uv.y, patch % 4)};
}

struct UvFigures {
    double worst = 0.0;
    uint64_t samples = 0;
};

void compare(UvFigures& figures, const GpuSurface& gpu, const std::vector<glm::vec4>& attributes, const UvLimit& limit,
             const PlaceOf& placeOf) {
    const uint32_t rate = gpu.output().grid.rate;
    for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
        const auto domain = static_cast<surface::Domain>(gpu.rangeOf(p).domain);
        for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
            const surface::GridSample at = surface::gridSample(domain, rate, s);
            const QuadsOfFaces::Place place = placeOf(p, glm::dvec2(at.i, at.j) / static_cast<double>(rate));
            const glm::dvec2 uv(attributes[gpu.vertexIndex(p, s)]);
            figures.worst = std::max(figures.worst, glm::distance(uv, limit.at(place)));
            ++figures.samples;
        }
    }
}

void compareAll(const char* name, const cage::Cage& cage, SuppleScheme scheme) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const bool loop = scheme == SUPPLE_SCHEME_LOOP, exact = scheme == SUPPLE_SCHEME_CATMULL_CLARK;
    for (const auto& [mode, theirs] : kModes) {
        const UvLimit limit(cage, loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK, theirs);
        UvFigures figures;
        for (const SuppleMapping mapping : kMappings) {
            SCOPED_TRACE(std::string(name) + ", " + cage::uvModeName(mode) + ", " + mappingName(mapping));
            GpuOptions options;
            options.scheme = scheme;
            options.mapping = mapping;
            options.flags = SUPPLE_GROUP_ATTRIBUTES;
            options.uvInterpolation = static_cast<SuppleUvInterpolation>(static_cast<uint32_t>(mode) + 1);
            options.rate = exact ? ExactQuads(cage).rateFor(5) : 8;
            GpuSurface gpu(*device, cage, options);
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            const Result<std::vector<std::byte>> bytes = device->readBuffer(gpu.output().streams.attributes);
            ASSERT_TRUE(bytes.ok());
            const auto attributes = as<glm::vec4>(*bytes);
            if (exact) {
                const ExactQuads quads(cage);
                const QuadsOfFaces named(cage, quads);
                const PatchFaces found = quads.patches(gpu.patches());
                compare(figures, gpu, attributes, limit, [&](uint32_t p, glm::dvec2 uv) {
                    const uint32_t face = found.faces[p];
                    return named.at(face, ExactQuads::inFace(uv.x, uv.y, found.firstCorners[face]));
                });
            } else if (loop) {
                const LoopTriangles triangles(cage);
                const PatchFaces found = triangles.patches(gpu.patches());
                compare(figures, gpu, attributes, limit, [&](uint32_t p, glm::dvec2 uv) {
                    const uint32_t face = found.faces[p];
                    const glm::dvec3 at =
                        LoopTriangles::inFace({1.0 - uv.x - uv.y, uv.x, uv.y}, found.firstCorners[face]);
                    return QuadsOfFaces::Place{face, 0, {at.y, at.z}};
                });
            } else {
                compare(figures, gpu, attributes, limit, [](uint32_t p, glm::dvec2 uv) { return quarterOf(p, uv); });
            }
        }
        std::printf("%s, %s: %llu samples, at most %.1e off\n", name, cage::uvModeName(mode),
                    static_cast<unsigned long long>(figures.samples), figures.worst);
        EXPECT_GT(figures.samples, 1000u);
        EXPECT_LT(figures.worst, 1e-6);
    }
}

TEST(SmoothUvsOpenSubdiv, InSixModes) {
    const ValidationGuard guard;
    const cage::Cage quads = inPieces(perturbed(grid(7, 6), 0.1f, 4), 3);
    const cage::Cage mixed = inPieces(perturbed(withMergedFaces(withCutQuads(grid(7, 6), 0.3, 2), 4, 3), 0.1f, 4), 5);
    const cage::Cage triangles = inPieces(perturbed(withCutQuads(grid(7, 6), 1.0, 2), 0.1f, 4), 7);
    compareAll("catmull-clark, quads", quads, SUPPLE_SCHEME_CATMULL_CLARK);
    compareAll("catmull-clark, polygons", mixed, SUPPLE_SCHEME_CATMULL_CLARK);
    compareAll("catmull-clark, creases", withRandomSharpness(quads, 2), SUPPLE_SCHEME_CATMULL_CLARK);
    compareAll("fragments, quads", quads, SUPPLE_SCHEME_FRAGMENTS);
    compareAll("loop, triangles", triangles, SUPPLE_SCHEME_LOOP);
    compareAll("loop, creases", withRandomSharpness(triangles, 2), SUPPLE_SCHEME_LOOP);
}

#endif

} // namespace
} // namespace supple::test
