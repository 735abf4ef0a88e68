#include "tools/supple/surface_jets.h"

#include "cpu/blend.h"
#include "cpu/catmull_clark.h"
#include "cpu/grid_sample.h"
#include "cpu/loop.h"
#include "cpu/patch_faces.h"
#include "cpu/patch_place.h"
#include "cpu/stencils.h"
#include "surface/patch_class.h"
#include "tools/reference/pm.h"
#include "tools/reference/prep.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

namespace supple::tools {
namespace {

using surface::SurfaceJet;

constexpr double kInside = 1e-3;

using cpu::FaceFinder;
using cpu::PatchFace;

/// The faces of a mesh whose first vertices are the cage's.
FaceFinder finderOf(const cage::Cage& mesh, std::span<const uint32_t> sourceFaces, uint32_t cageVertices) {
    FaceFinder finder;
    finder.addAll(mesh, sourceFaces, cageVertices);
    return finder;
}

glm::dvec2 quadSample(uint32_t rate, uint32_t sample, double inside) {
    const surface::GridSample at = surface::gridSample(surface::Domain::quad, rate, sample);
    return glm::mix(glm::dvec2(at.i, at.j) / static_cast<double>(rate), glm::dvec2(0.5), inside);
}
/// Weights of the patch's corners.
glm::dvec3 triangleSample(uint32_t rate, uint32_t sample, double inside) {
    const surface::GridSample at = surface::gridSample(surface::Domain::triangle, rate, sample);
    return glm::mix(glm::dvec3(rate - at.i - at.j, at.i, at.j) / static_cast<double>(rate), glm::dvec3(1.0 / 3.0),
                    inside);
}
/// Parameters of a patch as those of its face, whose corner `firstCorner` is the patch's corner 0.
glm::dvec2 inQuad(const glm::dvec2& p, uint32_t firstCorner) {
    const glm::dvec2 turned[] = {{p.x, p.y}, {1.0 - p.y, p.x}, {1.0 - p.x, 1.0 - p.y}, {p.y, 1.0 - p.x}};
    return turned[firstCorner];
}
glm::dvec3 inTriangle(const glm::dvec3& weights, uint32_t firstCorner) {
    const int first = static_cast<int>(firstCorner);
    return {weights[(3 - first) % 3], weights[(4 - first) % 3], weights[(5 - first) % 3]};
}

Result<Jets> prepJets(const JetSource& source, const cage::Cage& cage, std::span<const glm::dvec3> positions) {
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    if (!topology)
        return topology.error();
    const auto coefficients = surface::prep::construct<double>(cage, *topology, positions);
    std::vector<surface::prep::Patch<double>> patches;
    for (const SupplePatchInfo& patch : source.patches)
        patches.push_back(surface::prep::gatherPatch<double>(cage, *topology, coefficients, patch.face));
    return Jets([rate = source.rate, patches = std::move(patches)](uint32_t patch, uint32_t sample, double inside) {
        const glm::dvec2 at = quadSample(rate, sample, inside);
        return surface::prep::evaluateJet(patches[patch], at.x, at.y);
    });
}

Result<Jets> pmJets(const JetSource& source, const cage::Cage& cage, std::span<const glm::dvec3> positions) {
    const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(cage);
    if (!mesh)
        return mesh.error();
    FaceFinder finder;
    for (uint32_t f = 0; f < mesh->cage.faceCount(); ++f) {
        std::vector<uint32_t> corners;
        for (uint32_t i = 0; i < mesh->cage.sides(f); ++i)
            corners.push_back(mesh->cage.faceVertices[mesh->corner(f, i)]);
        finder.add(mesh->sourceFaces[f], std::move(corners));
    }
    const Result<std::vector<PatchFace>> faces = finder.find(source.patches);
    if (!faces)
        return faces.error();
    const auto coefficients = surface::pm::construct<double>(*mesh, positions);
    std::vector<surface::pm::Patch<double>> patches;
    for (const PatchFace& face : *faces)
        patches.push_back(surface::pm::gatherPatch<double>(*mesh, coefficients, face.face));
    return Jets([rate = source.rate, patches = std::move(patches)](uint32_t index, uint32_t sample, double inside) {
        const surface::pm::Patch<double>& patch = patches[index];
        surface::pm::DomainPoint<double> at = surface::pm::domainPoint<double>(patch.patchClass, rate, sample);
        at.u = glm::mix(at.u, glm::dvec2(0.5), inside);
        at.v = glm::mix(at.v, glm::dvec2(0.5), inside);
        at.weights = glm::mix(at.weights, glm::dvec3(1.0 / 3.0), inside);
        return surface::pm::evaluateJet(patch, at);
    });
}

/// A limit surface with the mesh that it needs.
template <class Limit>
struct LimitOf {
    LimitOf(surface::subdivision::Isolation of, std::span<const glm::dvec3> positions)
        : isolation(std::move(of)), limit(isolation.mesh, positions) {}
    surface::subdivision::Isolation isolation;
    Limit limit;
};
template <class Limit>
Result<std::shared_ptr<const LimitOf<Limit>>> limitOf(const cage::Cage& cage, std::span<const glm::dvec3> positions,
                                                      surface::subdivision::Subdivision subdivision) {
    Result<surface::subdivision::Isolation> isolation = surface::subdivision::isolateCage(cage, subdivision);
    if (!isolation)
        return isolation.error();
    return std::make_shared<const LimitOf<Limit>>(std::move(*isolation), positions);
}
using QuadLimit = surface::catmull_clark::LimitSurface;
using TriangleLimit = surface::loop::LimitSurface;
using surface::subdivision::Subdivision;

Result<std::vector<PatchFace>> facesBefore(const surface::subdivision::Isolation& isolation, const cage::Cage& cage,
                                           const JetSource& source) {
    return finderOf(isolation.parent.cage, isolation.parent.sourceFaces, cage.vertexCount()).find(source.patches);
}

/// A place of a limit surface.
struct LimitPlace {
    uint32_t face = 0;
    double u = 0.0, v = 0.0;
};

/// Jets of a limit surface. facesOf(isolation) gives what each patch draws, and place(that, sample, inside) where a
/// sample of it lies.
template <class Limit, class FacesOf, class Place>
Result<Jets> limitJets(const cage::Cage& cage, std::span<const glm::dvec3> positions,
                       surface::subdivision::Subdivision subdivision, const FacesOf& facesOf, const Place& place) {
    const auto limit = limitOf<Limit>(cage, positions, subdivision);
    if (!limit)
        return limit.error();
    auto faces = facesOf((*limit)->isolation);
    if (!faces)
        return faces.error();
    return Jets([limit = *limit, faces = std::move(*faces), place](uint32_t patch, uint32_t sample, double inside) {
        const LimitPlace at = place(faces[patch], sample, inside);
        return limit->limit.at(at.face, at.u, at.v).jet();
    });
}

Result<Jets> catmullClarkJets(const JetSource& source, const cage::Cage& cage, std::span<const glm::dvec3> positions) {
    return limitJets<QuadLimit>(
        cage, positions, Subdivision::catmullClark,
        [&](const surface::subdivision::Isolation& isolation) { return facesBefore(isolation, cage, source); },
        [rate = source.rate](const PatchFace& face, uint32_t sample, double inside) {
            const glm::dvec2 at = inQuad(quadSample(rate, sample, inside), face.firstCorner);
            return LimitPlace{face.face, at.x, at.y};
        });
}

Result<Jets> loopJets(const JetSource& source, const cage::Cage& cage, std::span<const glm::dvec3> positions) {
    return limitJets<TriangleLimit>(
        cage, positions, Subdivision::loop,
        [&](const surface::subdivision::Isolation& isolation) { return facesBefore(isolation, cage, source); },
        [rate = source.rate](const PatchFace& face, uint32_t sample, double inside) {
            const glm::dvec3 at = inTriangle(triangleSample(rate, sample, inside), face.firstCorner);
            return LimitPlace{face.face, at.y, at.z};
        });
}

/// Fragments draw the isolated mesh, whose faces come four by four of a face before: in each of its corners one, and of
/// triangles the middle.
Result<Jets> fragmentJets(const JetSource& source, const cage::Cage& cage, std::span<const glm::dvec3> positions) {
    const auto drawn = [](const surface::subdivision::Isolation& isolation) {
        return Result<std::vector<uint32_t>>(cpu::drawnFaces(isolation.mesh.cage));
    };
    if (source.rules.fragments == SUPPLE_RULES_LOOP) {
        return limitJets<TriangleLimit>(cage, positions, Subdivision::loop, drawn,
                                        [rate = source.rate](uint32_t face, uint32_t sample, double inside) {
                                            const uint32_t corner = face % 4;
                                            const glm::dvec3 half = 0.5 * triangleSample(rate, sample, inside);
                                            const glm::dvec3 at =
                                                corner == 3
                                                    ? glm::dvec3(half.x + half.z, half.x + half.y, half.y + half.z)
                                                    : inTriangle({half.x + 0.5, half.y, half.z}, corner);
                                            return LimitPlace{face / 4, at.y, at.z};
                                        });
    }
    return limitJets<QuadLimit>(cage, positions, Subdivision::catmullClark, drawn,
                                [rate = source.rate](uint32_t face, uint32_t sample, double inside) {
                                    const glm::dvec2 at = inQuad(0.5 * quadSample(rate, sample, inside), face % 4);
                                    return LimitPlace{face / 4, at.x, at.y};
                                });
}

Result<Jets> blendJets(const JetSource& source, const cage::Cage& cage, std::span<const glm::dvec3> positions) {
    struct Blended {
        surface::blend::Mesh mesh;
        std::vector<surface::blend::ChartCoefficients<double>> coefficients;
    };
    surface::blend::Options options;
    options.creases = source.rules.creases == SUPPLE_CREASES_CURVE ? surface::blend::CreaseMode::curve
                                                                   : surface::blend::CreaseMode::cut;
    options.sharpThreshold = source.rules.sharpThreshold;
    Result<surface::blend::Mesh> mesh = surface::blend::buildMesh(cage, options);
    if (!mesh)
        return mesh.error();
    Result<std::vector<PatchFace>> faces =
        finderOf(mesh->cage, mesh->sourceFaces, cage.vertexCount()).find(source.patches);
    if (!faces)
        return faces.error();
    auto blended = std::make_shared<Blended>(Blended{std::move(*mesh), {}});
    const std::vector<glm::dvec3> points = surface::applyStencils<double>(blended->mesh.stencils, positions);
    blended->coefficients = surface::blend::construct<double>(blended->mesh, points);
    return Jets(
        [rate = source.rate, blended, faces = std::move(*faces)](uint32_t patch, uint32_t sample, double inside) {
            const glm::dvec2 at = inQuad(quadSample(rate, sample, inside), faces[patch].firstCorner);
            return surface::blend::evaluateJet(blended->mesh, blended->coefficients, faces[patch].face, at.x, at.y);
        });
}

} // namespace

Result<Jets> surfaceJets(const JetSource& source, const cage::Cage& cage, std::span<const glm::dvec3> positions) {
    switch (source.scheme) {
    case SUPPLE_SCHEME_PREP:
        return prepJets(source, cage, positions);
    case SUPPLE_SCHEME_PM:
        return pmJets(source, cage, positions);
    case SUPPLE_SCHEME_CATMULL_CLARK:
        return catmullClarkJets(source, cage, positions);
    case SUPPLE_SCHEME_LOOP:
        return loopJets(source, cage, positions);
    case SUPPLE_SCHEME_FRAGMENTS:
        return fragmentJets(source, cage, positions);
    case SUPPLE_SCHEME_BLEND:
        return blendJets(source, cage, positions);
    default:
        return Error{ErrorCode::argument, "the scheme has no derivatives"};
    }
}

surface::Curvature curvatureAt(const Jets& jets, uint32_t patch, uint32_t sample) {
    const auto isFinite = [](const surface::Curvature& c) {
        return c.exists && std::isfinite(c.mean) && std::isfinite(c.gaussian);
    };
    surface::Curvature curvature = surface::curvatureOf(jets(patch, sample, 0.0));
    if (!isFinite(curvature))
        curvature = surface::curvatureOf(jets(patch, sample, kInside));
    curvature.exists = isFinite(curvature);
    return curvature;
}

} // namespace supple::tools
