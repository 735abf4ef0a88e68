// Views: groups drawn at levels of detail, as the device wrote them.
#include "cage/gltf/reader.h"
#include "cpu/catmull_clark.h"
#include "tests/support/blend_surface.h"
#include "tests/support/corner_weights.h"
#include "tests/support/exact_quads.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_levels.h"
#include "tests/support/lod_surface.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_surface.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <set>

namespace supple::test {
namespace {

constexpr SuppleScheme kSchemes[] = {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK,
                                     SUPPLE_SCHEME_BLEND};

class LodViewsOnce : public CrowdContexts {};
class LodViews : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, LodViews, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(LodViews, ClosedCagesHaveNoCracks) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    const struct {
        const char* name;
        cage::Cage cage;
    } cages[] = {{"cube sphere", perturbed(cage::makeCubeSphere(4), 0.05f, 3)},
                 {"split torus", perturbed(cage::makeSplitTorus(8, 7), 0.02f, 11)}};
    for (const auto& [name, cage] : cages) {
        for (const SuppleScheme scheme : kSchemes) {
            TestView view(context, 400000);
            SuppleGroupDesc desc{};
            desc.asset = context.createAsset(cage);
            desc.capacity = 2;
            desc.scheme = scheme;
            desc.view = view.handle();
            Crowd crowd(context, desc);
            ASSERT_TRUE(crowd.valid());
            (void)crowd.spawn();
            std::set<uint32_t> capacities;
            for (const float distance : {40.0f, 9.0f, 4.0f, 2.2f, 1.6f}) {
                view.look({0.3f * distance, 0.2f * distance, 0.93f * distance});
                context.run(crowd.group());
                const LodSurface surface = readLodSurface(crowd);
                const Sides sides = matchSides(surface);
                EXPECT_EQ(surface.patches.size(), crowd.output().surface.patchCount);
                EXPECT_GE(sides.triangles, 2 * surface.patches.size());
                EXPECT_EQ(sides.unmatched, 0u) << name << " at " << distance;
                for (const LodSurface::Patch& patch : surface.patches) {
                    capacities.insert(patch.capacity);
                }
                std::printf("%s, scheme %d, distance %4.1f: %zu patches, %zu triangles, %zu unmatched\n", name, scheme,
                            static_cast<double>(distance), surface.patches.size(), sides.triangles, sides.unmatched);
            }
            EXPECT_GE(capacities.size(), 4u);
        }
    }
}

using surface::lod::Form;

/// Where a sample lies in its patch: u and v on quads, else the weights of a side's corners and the centre.
struct At {
    uint32_t side = 0;
    glm::dvec3 weights{};
    glm::dvec2 uv{}; ///< in the plane: the patch as a square, or as a regular polygon round the origin
};
At sampleAt(const LodSurface::Patch& patch, uint32_t sample) {
    using surface::lod::LevelPair;
    const auto form = static_cast<Form>(patch.grid);
    const surface::lod::GridSample at = surface::lod::gridSample(form, patch.capacity, sample);
    const auto level = [&](size_t pair) { return LevelPair{patch.levels[2 * pair], patch.levels[2 * pair + 1]}; };
    const auto parameter = [&](uint32_t i, size_t pair) {
        return static_cast<double>(surface::lod::parameter(patch.capacity, i, level(pair)).t);
    };
    const uint32_t last = patch.capacity;
    At result;
    if (form == Form::quad) {
        const uint32_t i = at.k, j = at.ring;
        result.uv.x = i == 0 ? 0.0 : i == last ? 1.0 : parameter(i, j == 0 ? 2 : j == last ? 4 : 0);
        result.uv.y = j == 0 ? 0.0 : j == last ? 1.0 : parameter(j, i == last ? 3 : i == 0 ? 5 : 1);
        return result;
    }
    const size_t pair = at.ring == 0 ? 1 + at.side : 0;
    const double t = at.ring == 0 ? 0.0 : parameter(at.ring, 0);
    result.side = at.side;
    result.weights = {parameter(last - at.k, pair) - t, parameter(at.k, pair) - t, 2.0 * t};
    const auto corner = [&](uint32_t i) {
        const double angle = 2.0 * glm::pi<double>() * i / surface::lod::sides(form);
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    result.uv = result.weights.x * corner(at.side) + result.weights.y * corner(at.side + 1);
    return result;
}

/// The surface of a cage on the CPU, by patches of the group.
class Reference {
public:
    Reference(const CrowdContext& context, SuppleGroup group, const cage::Cage& cage, SuppleScheme scheme) {
        uint32_t count = 0;
        EXPECT_EQ(suppleGetPatches(context.handle(), group, 0, nullptr, &count), SUPPLE_OK);
        patches_.resize(count);
        EXPECT_EQ(suppleGetPatches(context.handle(), group, 0, patches_.data(), &count), SUPPLE_OK);
        const std::vector<glm::dvec3> positions(cage.positions.begin(), cage.positions.end());
        if (scheme == SUPPLE_SCHEME_PREP) {
            const Result<cage::Topology> topology = cage::buildTopology(cage);
            const auto coefficients = surface::prep::construct<double>(cage, *topology, positions);
            for (uint32_t f = 0; f < cage.faceCount(); ++f) {
                prep_.push_back(surface::prep::gatherPatch<double>(cage, *topology, coefficients, f));
            }
        } else if (scheme == SUPPLE_SCHEME_CATMULL_CLARK) {
            quads_.emplace(cage);
            exact_.emplace(quads_->isolation.mesh, positions);
            exactFaces_ = quads_->patches(patches_).faces;
        } else if (scheme == SUPPLE_SCHEME_BLEND) {
            blendMesh_ = blendMesh(cage);
            blendFaces_ = facesOfPatches(blendMesh_);
            EXPECT_EQ(blendFaces_.size(), count);
            blendSurface_.emplace(blendMesh_, positions);
            blend_.emplace(blendMesh_, blendSurface_->coefficients, 1u);
        } else {
            pm_.emplace(pmMesh(cage), positions);
            // Two facets of one source face differ in their corners.
            const surface::pm::Mesh& mesh = pm_->mesh;
            std::map<std::vector<uint32_t>, uint32_t> facets;
            for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
                std::vector<uint32_t> key = {mesh.sourceFaces[f]};
                for (uint32_t i = 0; i < mesh.cage.sides(f); ++i) {
                    key.push_back(mesh.cage.faceVertices[mesh.corner(f, i)]);
                }
                facets[std::move(key)] = f;
            }
            for (const SupplePatchInfo& patch : patches_) {
                std::vector<uint32_t> key = {patch.face};
                key.insert(key.end(), patch.corners, patch.corners + patch.cornerCount);
                EXPECT_TRUE(facets.contains(key)) << "a patch of face " << patch.face << " is no facet of the mesh";
                pmFacets_.push_back(facets[key]);
            }
        }
    }
    /// How far the chains of an instance go.
    [[nodiscard]] uint32_t depth(const LodSurface& surface, uint32_t slot) const {
        return chainDepth(surface.patches, slot,
                          [&](uint32_t patch) { return static_cast<surface::PatchClass>(patches_[patch].patchClass); });
    }
    [[nodiscard]] glm::dvec3 at(uint32_t patch, const At& at, uint32_t depth) const {
        const glm::dvec2 u{at.uv.x, 1.0 - at.uv.x}, v{at.uv.y, 1.0 - at.uv.y};
        if (blend_) {
            return blend_->at(blendFaces_[patch], u, v).position;
        }
        if (exact_) {
            const uint32_t face = exactFaces_[patch];
            return quads_->atLevels(face, at.uv, depth).position([&](const glm::dvec2& uv) {
                const glm::dvec2 inFace = ExactQuads::inFace(uv.x, uv.y, quads_->corners.firstCorner(face));
                return exact_->at(face, inFace.x, inFace.y);
            });
        }
        if (!pm_) {
            return surface::prep::evaluate<double>(prep_[patches_[patch].face], u, v).position;
        }
        surface::pm::DomainPoint<double> point;
        point.u = u;
        point.v = v;
        point.sector = at.side;
        point.weights = at.weights;
        return surface::pm::evaluate<double>(pm_->patches[pmFacets_[patch]], point).position;
    }

private:
    std::vector<SupplePatchInfo> patches_;
    std::vector<surface::prep::Patch<double>> prep_;
    std::optional<PmSurface<double>> pm_;
    std::vector<uint32_t> pmFacets_; ///< by patch
    std::optional<ExactQuads> quads_;
    std::optional<surface::catmull_clark::LimitSurface> exact_;
    std::vector<uint32_t> exactFaces_; ///< by patch
    surface::blend::Mesh blendMesh_;
    std::vector<uint32_t> blendFaces_; ///< by patch
    std::optional<BlendSurface<double>> blendSurface_;
    std::optional<surface::blend::Evaluator<double>> blend_;
};

glm::dvec3 asPosition(const std::array<uint32_t, 3>& bits) {
    glm::vec3 position;
    std::memcpy(&position, bits.data(), sizeof(position));
    return position;
}

TEST_P(LodViews, SamplesLieOnTheSurfaceAndSoDoTheirPasts) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    const cage::Cage cage = perturbed(cage::makeSplitTorus(6, 5), 0.02f, 5);
    for (const SuppleScheme scheme : kSchemes) {
        TestView view(context, 200000, SUPPLE_VIEW_MOTION);
        SuppleGroupDesc desc{};
        desc.asset = context.createAsset(cage);
        desc.capacity = 3;
        desc.scheme = scheme;
        desc.view = view.handle();
        Crowd crowd(context, desc);
        ASSERT_TRUE(crowd.valid());
        const Reference reference(context, crowd.group(), cage, scheme);
        std::vector<SuppleInstance> instances{crowd.spawn(), crowd.spawn()};
        std::vector<glm::dvec3> before;
        std::vector<uint32_t> depthsBefore;
        double largest = 0.0, largestPast = 0.0;
        size_t samples = 0;
        for (uint32_t frame = 0; frame < 5; ++frame) {
            if (frame == 3) {
                instances.push_back(crowd.spawn()); // has no past
            }
            std::vector<glm::dvec3> now;
            for (size_t i = 0; i < instances.size(); ++i) {
                now.emplace_back(0.07 * frame * (1.0 + static_cast<double>(i)), 0.05 * frame,
                                 3.0 * static_cast<double>(i));
                crowd.pose(instances[i], SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), glm::vec3(now[i])));
            }
            view.look({0.4f * static_cast<float>(frame), 1.0f, 9.0f - static_cast<float>(frame)});
            context.run(crowd.group());
            const LodSurface surface = readLodSurface(crowd);
            EXPECT_EQ(surface.patches.size(), instances.size() * crowd.output().surface.patchCount);
            std::vector<uint32_t> depths;
            for (uint32_t slot = 0; slot < instances.size(); ++slot) {
                depths.push_back(reference.depth(surface, slot));
            }
            for (const LodSurface::Patch& patch : surface.patches) {
                const uint32_t count = surface::lod::sampleCount(static_cast<Form>(patch.grid), patch.capacity);
                const bool past = patch.slot < before.size();
                for (uint32_t s = 0; s < count; ++s, ++samples) {
                    const At at = sampleAt(patch, s);
                    const glm::dvec3 wanted = reference.at(patch.patch, at, depths[patch.slot]);
                    const glm::dvec3 wantedPast =
                        past ? reference.at(patch.patch, at, depthsBefore[patch.slot]) : wanted;
                    const glm::dvec3 position = asPosition(surface.positions[patch.firstVertex + s]);
                    largest = std::max(largest, glm::length(position - now[patch.slot] - wanted));
                    const glm::dvec3 earlier = asPosition(surface.previous[patch.firstVertex + s]);
                    const glm::dvec3 placed = past ? before[patch.slot] : now[patch.slot];
                    largestPast = std::max(largestPast, glm::length(earlier - placed - wantedPast));
                }
            }
            before = now;
            depthsBefore = depths;
        }
        std::printf("scheme %d: %zu samples, positions within %.1e, previous ones within %.1e\n", scheme, samples,
                    largest, largestPast);
        EXPECT_LE(largest, 1e-5);
        EXPECT_LE(largestPast, 1e-5);
    }
}

/// Where a sample's parameters lie in a plane in which the grid of a patch has no folds. A polar patch's is a triangle,
/// as its collapsed side is a point.
glm::dvec2 planeOf(const At& at, bool polar) {
    return polar ? glm::dvec2((at.uv.x - 0.5) * (1.0 - at.uv.y), at.uv.y) : at.uv;
}

/// Points of a patch that stay where they are, whatever the tessellation.
std::vector<At> materialPoints(uint32_t sides) {
    std::vector<At> points;
    for (uint32_t k = 0; k < 8; ++k) {
        const double a = 0.12 + 0.11 * k, b = std::fmod(0.37 + 0.618034 * k, 1.0);
        At& at = points.emplace_back();
        if (sides == 0) {
            at.uv = {a, b};
            continue;
        }
        at.side = k % sides;
        at.weights = glm::dvec3(a * b, (1.0 - a) * b, 1.0 - b);
        const double first = 2.0 * glm::pi<double>() * at.side / sides,
                     second = first + 2.0 * glm::pi<double>() / sides;
        at.uv = at.weights.x * glm::dvec2(std::cos(first), std::sin(first)) +
                at.weights.y * glm::dvec2(std::cos(second), std::sin(second));
    }
    return points;
}

/// Of a patch as drawn, the point that has a place in the plane of planeOf().
std::optional<glm::dvec3> drawnAt(const LodSurface& surface, const LodSurface::Patch& patch,
                                  const std::vector<glm::dvec2>& plane, const std::vector<uint16_t>& indices,
                                  size_t count, glm::dvec2 p) {
    const auto cross = [](glm::dvec2 x, glm::dvec2 y) { return x.x * y.y - x.y * y.x; };
    for (size_t t = 0; t < count; t += 3) {
        const glm::dvec2 a = plane[indices[t]], b = plane[indices[t + 1]], c = plane[indices[t + 2]];
        const double area = cross(b - a, c - a);
        const glm::dvec3 w = glm::dvec3(cross(b - p, c - p), cross(c - p, a - p), cross(a - p, b - p)) / area;
        if (!(area > 1e-14 && w.x >= -1e-9 && w.y >= -1e-9 && w.z >= -1e-9)) {
            continue;
        }
        glm::dvec3 drawn(0.0);
        for (int i = 0; i < 3; ++i) {
            drawn += w[i] * asPosition(surface.positions[patch.firstVertex + indices[t + static_cast<size_t>(i)]]);
        }
        return drawn;
    }
    return std::nullopt;
}

/// A camera that comes closer by 0.5 % a frame.
struct Dolly {
    const char* name;
    SuppleScheme scheme;
    cage::Cage cage;
    struct Stretch {
        double from = 30.0; ///< in units, from the middle of the cage
        uint32_t frames = 320;
    };
    std::vector<Stretch> stretches = {{}};
    SuppleMapping mapping = SUPPLE_MAPPING_NARROW;
    uint32_t flags = 0; ///< of the group
    uint32_t instances = 1;
    uint32_t vertexBudget = 0;
    double deviation = 0.9; ///< pixels at most from where a point belongs, at levels that are not scaled down
    std::string asset{};    ///< a file that has the cage
};

/// The smallest cages with all that levels differ by, each on its own, and the demo character.
std::vector<Dolly> dollies() {
    const cage::Cage sphere = perturbed(cage::makeCubeSphere(2), 0.05f, 3);
    const cage::Cage mixed = perturbed(withMergedFaces(withCutQuads(cage::makeCubeSphere(3), 0.4, 3), 12, 5), 0.03f, 5);
    const cage::Cage poles = perturbed(cappedCylinder(6, 5), 0.03f, 7);
    for (const uint32_t sides : {3u, 4u, 5u}) {
        uint32_t count = 0;
        for (uint32_t f = 0; f < mixed.faceCount(); ++f) {
            count += mixed.sides(f) == sides ? 1 : 0;
        }
        EXPECT_GT(count, 0u) << sides << " sides";
    }
    const Dolly::Stretch far{30.0, 80}, middle{12.0, 80}, near{14.0, 160};
    std::vector<Dolly> list = {
        {"sphere, p-rep", SUPPLE_SCHEME_PREP, sphere},
        {"sphere, P_m", SUPPLE_SCHEME_PM, sphere, {far, near}},
        {"sphere, P_m, wide", SUPPLE_SCHEME_PM, sphere, {far, near}, SUPPLE_MAPPING_WIDE},
        {"mixed faces, P_m", SUPPLE_SCHEME_PM, mixed, {far, middle}},
        {"mixed faces, P_m, wide", SUPPLE_SCHEME_PM, mixed, {middle}, SUPPLE_MAPPING_WIDE},
        {"poles, P_m", SUPPLE_SCHEME_PM, poles, {far, near}},
        {"sphere, Catmull-Clark", SUPPLE_SCHEME_CATMULL_CLARK, sphere, {far, near}},
        {"sphere, Catmull-Clark, wide", SUPPLE_SCHEME_CATMULL_CLARK, sphere, {far, near}, SUPPLE_MAPPING_WIDE},
        {"mixed faces, Catmull-Clark", SUPPLE_SCHEME_CATMULL_CLARK, mixed, {far, middle}},
        {"poles, Catmull-Clark", SUPPLE_SCHEME_CATMULL_CLARK, poles, {far, near}},
        {"sphere, blend", SUPPLE_SCHEME_BLEND, sphere, {far, near}},
        {"sphere, blend, wide", SUPPLE_SCHEME_BLEND, sphere, {far}, SUPPLE_MAPPING_WIDE},
        {"mixed faces, blend", SUPPLE_SCHEME_BLEND, mixed, {middle}},
    };
    Dolly one{"mixed faces, P_m, one level", SUPPLE_SCHEME_PM, mixed, {far, middle}};
    one.flags = SUPPLE_GROUP_ONE_LEVEL;
    list.push_back(one);
    one.name = "sphere, p-rep, one level";
    one.scheme = SUPPLE_SCHEME_PREP;
    one.cage = sphere;
    list.push_back(one);
    Dolly budget{"6 mixed faces, P_m, scaled down", SUPPLE_SCHEME_PM, mixed, {{20.0, 200}}};
    budget.instances = 6;
    budget.vertexBudget = 9000;
    list.push_back(budget);
    budget.name = "6 spheres, p-rep, scaled down";
    budget.scheme = SUPPLE_SCHEME_PREP;
    budget.cage = sphere;
    budget.vertexBudget = 5000;
    list.push_back(budget);
    Dolly pip{"pip, P_m", SUPPLE_SCHEME_PM, {}};
    pip.asset = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";
    const Result<cage::Character> character = cage::readGltfFile(pip.asset);
    EXPECT_TRUE(character.ok());
    if (character.ok()) {
        pip.cage = character->cage;
        pip.deviation = 1.2;
        pip.stretches = {{20.0, 40}, {9.0, 40}, {5.0, 40}, {3.0, 40}};
        list.push_back(pip);
    }
    return list;
}

/// Moves the camera and compares what is drawn of every material point with the point: that difference, in pixels, may
/// not change from frame to frame.
void expectToMoveByItsMotion(CrowdContext& context, const Dolly& dolly) {
    TestView view(context, dolly.asset.empty() ? 60000 : 300000);
    SuppleGroupDesc desc{};
    desc.asset = dolly.asset.empty() ? context.createAsset(dolly.cage) : context.asset(dolly.asset);
    desc.capacity = dolly.instances;
    desc.flags = dolly.flags;
    desc.scheme = dolly.scheme;
    desc.view = view.handle();
    Crowd crowd(context, desc);
    ASSERT_TRUE(crowd.valid());
    glm::vec3 low(1e30f), high(-1e30f);
    for (const glm::vec3& p : dolly.cage.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec3 center = 0.5f * (low + high), size = high - low;
    std::vector<glm::dvec3> places; // by slot: the first in the middle, others beside and behind it
    for (uint32_t i = 0; i < dolly.instances; ++i) {
        const uint32_t pair = (i + 1) / 2;
        const auto step = static_cast<float>(pair);
        const glm::vec3 at((i % 2 == 0 ? 1.2f : -1.2f) * step * size.x, 0.0f, -1.5f * step * size.z);
        crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), at));
        places.emplace_back(at);
    }
    view.camera.vertexBudget = dolly.vertexBudget;

    const Reference reference(context, crowd.group(), dolly.cage, dolly.scheme);
    const std::vector<surface::PatchInfo> infos = patchesOf(crowd);
    struct Material {
        std::vector<glm::dvec2> plane;
        std::vector<glm::dvec3> positions;
    };
    std::vector<Material> materials(infos.size()); // by patch, when it is drawn first
    std::map<std::pair<SuppleGrid, uint32_t>, std::vector<uint16_t>> grids;
    double largest = 0.0, deviation = 0.0;
    size_t compared = 0, wanted = 0, frames = 0, changes = 0;
    float leastScale = 1.0f, mostScale = 0.0f;
    std::set<uint32_t> capacities, classes;
    for (const Dolly::Stretch& stretch : dolly.stretches) {
        std::map<std::array<uint32_t, 3>, glm::dvec2> errors;               // in the frame before
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> capacitiesBefore; // by slot and patch
        double distance = stretch.from;
        for (uint32_t frame = 0; frame < stretch.frames; ++frame, ++frames, distance *= 0.995) {
            const glm::vec3 eye = center + glm::vec3(0.0f, 0.0f, static_cast<float>(distance));
            view.look(eye);
            context.run(crowd.group());
            const LodSurface surface = readLodSurface(crowd);
            ASSERT_EQ(surface.patches.size(), infos.size() * dolly.instances);
            if (frame > 0) {
                const SuppleViewStatistics last = view.statistics();
                ASSERT_EQ(last.shortfall, 0u);
                leastScale = std::min(leastScale, last.levelScales[0]);
                mostScale = std::max(mostScale, last.levelScales[0]);
            }
            const auto project = [&](glm::dvec3 p) {
                const glm::dvec3 seen = p - glm::dvec3(eye);
                return static_cast<double>(view.camera.pixelsPerUnit) / -seen.z * glm::dvec2(seen);
            };
            for (const LodSurface::Patch& patch : surface.patches) {
                const auto form = static_cast<Form>(patch.grid);
                const bool polar = infos[patch.patch].patchClass == surface::PatchClass::polar;
                Material& material = materials[patch.patch];
                if (material.plane.empty()) {
                    for (const At& at : materialPoints(form == Form::quad ? 0 : surface::lod::sides(form))) {
                        material.plane.push_back(planeOf(at, polar));
                        material.positions.push_back(reference.at(patch.patch, at, 6));
                    }
                }
                std::vector<uint16_t>& indices = grids[{patch.grid, patch.capacity}];
                if (indices.empty()) {
                    indices = surface::lod::gridIndices(form, patch.capacity);
                }
                const size_t count = indices.size() / surface::lod::patchesPerDraw(form, patch.capacity);
                std::vector<glm::dvec2> plane;
                for (uint32_t s = 0; s < surface::lod::sampleCount(form, patch.capacity); ++s) {
                    plane.push_back(planeOf(sampleAt(patch, s), polar));
                }
                for (uint32_t m = 0; m < material.plane.size(); ++m) {
                    const std::optional<glm::dvec3> drawn =
                        drawnAt(surface, patch, plane, indices, count, material.plane[m]);
                    ASSERT_TRUE(drawn.has_value()) << "patch " << patch.patch << " has a hole in its domain";
                    const glm::dvec2 error = project(*drawn) - project(material.positions[m] + places[patch.slot]);
                    raise(deviation, glm::length(error));
                    const auto [found, fresh] = errors.try_emplace({patch.slot, patch.patch, m}, error);
                    if (!fresh) {
                        raise(largest, glm::length(error - found->second));
                        found->second = error;
                        ++compared;
                    }
                }
                capacities.insert(patch.capacity);
                classes.insert(static_cast<uint32_t>(infos[patch.patch].patchClass));
                const auto [before, fresh] = capacitiesBefore.try_emplace({patch.slot, patch.patch}, patch.capacity);
                changes += before->second != patch.capacity ? 1 : 0;
                before->second = patch.capacity;
            }
        }
        wanted += size_t{stretch.frames - 1} * infos.size() * dolly.instances * 8;
    }
    std::printf(
        "%s: %zu frames, %zu points compared, at most %.3f px a frame beyond their motion, %.2f px from its "
        "place; %zu patches of %zu classes, %zu capacities, %zu changes of them, levels scaled by %.3f to %.3f\n",
        dolly.name, frames, compared, largest, deviation, infos.size(), classes.size(), capacities.size(), changes,
        static_cast<double>(mostScale), static_cast<double>(leastScale));
    EXPECT_EQ(compared, wanted);
    EXPECT_LE(largest, 0.05);
    // Grows by the square of what levels are scaled down by.
    EXPECT_LE(deviation * static_cast<double>(leastScale * leastScale), dolly.deviation);
    EXPECT_GT(changes, 0u) << "no patch takes another capacity";
    if (dolly.vertexBudget > 0) {
        EXPECT_LT(mostScale, 1.0f) << "the budget does not bind";
        EXPECT_LT(leastScale, 0.8f * mostScale);
    } else {
        EXPECT_EQ(leastScale, 1.0f);
    }
}

TEST_F(LodViewsOnce, ADollyMovesNothingButByItsMotion) {
    const ValidationGuard guard;
    for (const Dolly& dolly : dollies()) {
        SCOPED_TRACE(dolly.name);
        expectToMoveByItsMotion(CrowdContexts::context(dolly.mapping), dolly);
    }
}

TEST_P(LodViews, TheBudgetHolds) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 150000);
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(perturbed(cage::makeCubeSphere(3), 0.05f, 3));
    desc.capacity = 64;
    desc.scheme = SUPPLE_SCHEME_PREP;
    desc.view = view.handle();
    Crowd crowd(context, desc);
    ASSERT_TRUE(crowd.valid());
    for (int i = 0; i < 64; ++i) {
        const int column = i % 8, row = i / 8;
        const SuppleInstance instance = crowd.spawn();
        EXPECT_EQ(suppleSetPriority(context.handle(), instance, i < 3 ? 2 : 0), SUPPLE_OK);
        crowd.pose(instance, SUPPLE_BIND_POSE, 0.0,
                   glm::translate(glm::mat4(1.0f), glm::vec3(3.0f * static_cast<float>(column) - 10.5f, 0.0f,
                                                             -3.0f * static_cast<float>(row))));
    }
    const auto run = [&](uint32_t budget, float z) {
        view.camera.vertexBudget = budget;
        view.look({0.0f, 3.0f, z});
        context.run(crowd.group());
        context.run(crowd.group()); // statistics come with the frame after
        return view.statistics();
    };
    const SuppleViewStatistics free = run(0, 40.0f);
    EXPECT_EQ(free.levelScales[0], 1.0f);
    EXPECT_EQ(free.shortfall, 0u);
    std::printf("%u vertices wanted, %u written\n", free.wantedVertexCount, free.vertexCount);
    const uint32_t budget = free.vertexCount * 7 / 10;
    float scale = 1.0f;
    for (float z = 40.0f; z > 12.0f; z *= 0.97f) {
        const SuppleViewStatistics now = run(budget, z);
        EXPECT_LE(now.vertexCount, budget);
        EXPECT_GE(now.vertexCount, budget * 85 / 100);
        EXPECT_EQ(now.patchCount, 64u * crowd.output().surface.patchCount);
        EXPECT_EQ(now.shortfall, 0u);
        EXPECT_LE(now.levelScales[0], scale) << "at " << z;
        EXPECT_NEAR(now.levelScales[2], std::pow(now.levelScales[0], 0.25f), 1e-4f);
        scale = now.levelScales[0];
        const Sides sides = matchSides(readLodSurface(crowd));
        EXPECT_EQ(sides.unmatched, 0u);
    }
    std::printf("scale of levels falls to %.3f\n", static_cast<double>(scale));
    EXPECT_LT(scale, 0.6f);
}

TEST_P(LodViews, WhatTheCameraDoesNotSeeHasNoSurface) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    for (const SuppleScheme scheme : kSchemes) {
        TestView view(context, 200000, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL);
        SuppleGroupDesc desc{};
        desc.asset = context.createAsset(perturbed(cage::makeCubeSphere(2), 0.05f, 3));
        desc.capacity = 12;
        desc.scheme = scheme;
        desc.view = view.handle();
        Crowd crowd(context, desc);
        ASSERT_TRUE(crowd.valid());
        std::vector<SuppleInstance> instances;
        for (int i = 0; i < 10; ++i) {
            instances.push_back(crowd.spawn());
        }
        const auto place = [&](float drift) {
            for (size_t i = 0; i < instances.size(); ++i) {
                const glm::vec3 at(6.0f * static_cast<float>(i) + drift, 0.0f, 0.0f);
                crowd.pose(instances[i], SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), at));
            }
        };
        std::map<uint32_t, double> moved; // along x, by slot
        // Sees about 12 units of the row, from `left` on.
        const auto drawn = [&](float left, float drift) {
            place(drift);
            const glm::mat4 projection = glm::orthoRH_ZO(-6.0f, 6.0f, -4.0f, 4.0f, 0.1f, 100.0f);
            const glm::mat4 both =
                projection * glm::lookAt(glm::vec3(left + 6.0f, 0.0f, 30.0f), glm::vec3(left + 6.0f, 0.0f, 0.0f),
                                         glm::vec3(0.0f, 1.0f, 0.0f));
            std::memcpy(view.camera.viewProjection, &both, sizeof(both));
            view.look({left + 6.0f, 0.0f, 30.0f});
            context.run(crowd.group());
            const LodSurface surface = readLodSurface(crowd);
            EXPECT_EQ(matchSides(surface).unmatched, 0u);
            std::map<uint32_t, uint32_t> slots; // patches by slot
            for (const LodSurface::Patch& patch : surface.patches) {
                ++slots[patch.slot];
                const glm::dvec3 now = asPosition(surface.positions[patch.firstVertex]);
                const glm::dvec3 before = asPosition(surface.previous[patch.firstVertex]);
                moved[patch.slot] = now.x - before.x;
            }
            std::set<uint32_t> seen;
            for (const auto& [slot, patches] : slots) {
                EXPECT_EQ(patches, crowd.output().surface.patchCount);
                seen.insert(slot);
            }
            return seen;
        };
        EXPECT_EQ(drawn(-3.0f, 0.0f), (std::set<uint32_t>{0, 1}));
        EXPECT_EQ(drawn(3.0f, 0.25f), (std::set<uint32_t>{1, 2}));
        EXPECT_NEAR(moved[1], 0.25, 1e-5);
        EXPECT_NEAR(moved[2], 0.0, 1e-5) << "was not seen before: has no past";
        EXPECT_EQ(drawn(21.0f, 0.5f), (std::set<uint32_t>{4, 5}));
        EXPECT_EQ(drawn(200.0f, 0.75f), std::set<uint32_t>{});
        EXPECT_EQ(drawn(3.0f, 1.0f), (std::set<uint32_t>{1, 2}));
        EXPECT_NEAR(moved[1], 0.0, 1e-5) << "was not seen in the frame before";
        crowd.setVisible(instances[1], false);
        EXPECT_EQ(drawn(3.0f, 1.25f), (std::set<uint32_t>{2}));
        EXPECT_NEAR(moved[2], 0.25, 1e-5);
        // Bounds hold the surface.
        const std::vector<std::byte> bounds = crowd.slotBytes(crowd.output().bounds, 2);
        float box[8];
        std::memcpy(box, bounds.data(), sizeof(box));
        const LodSurface surface = readLodSurface(crowd);
        for (const LodSurface::Patch& patch : surface.patches) {
            const uint32_t count = surface::lod::sampleCount(static_cast<Form>(patch.grid), patch.capacity);
            for (uint32_t s = 0; s < count; ++s) {
                const glm::dvec3 p = asPosition(surface.positions[patch.firstVertex + s]);
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_GE(p[axis], static_cast<double>(box[axis]));
                    EXPECT_LE(p[axis], static_cast<double>(box[4 + axis]));
                }
            }
        }
    }
}

TEST_P(LodViews, AttributesFollowTheSamples) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    const SuppleAsset asset = context.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb");
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_BLEND}) {
        TestView view(context, 400000, SUPPLE_VIEW_ATTRIBUTES);
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = 1;
        desc.scheme = scheme;
        desc.view = view.handle();
        Crowd crowd(context, desc);
        ASSERT_TRUE(crowd.valid());
        (void)crowd.spawn();
        view.look({0.4f, 1.2f, 1.6f});
        context.run(crowd.group());
        const LodSurface surface = readLodSurface(crowd);
        const std::vector<std::byte> bytes = crowd.read(crowd.output().streams.attributes);
        const auto uvOf = [](const std::vector<std::byte>& from, size_t vertex) {
            glm::vec2 uv;
            std::memcpy(&uv, &from[16 * vertex], sizeof(uv));
            return glm::dvec2(uv);
        };
        // Rate 1 has the corners alone.
        SuppleGroupDesc cornersDesc{};
        cornersDesc.flags = SUPPLE_GROUP_ATTRIBUTES;
        cornersDesc.asset = asset;
        cornersDesc.capacity = 1;
        cornersDesc.scheme = scheme;
        cornersDesc.rate = 1;
        Crowd corners(context, cornersDesc);
        ASSERT_TRUE(corners.valid());
        (void)corners.spawn();
        context.run(corners.group());
        const host::GroupOutput output = corners.output();
        const std::vector<std::byte> cornerBytes = corners.read(output.streams.attributes);
        size_t compared = 0;
        double largest = 0.0;
        std::set<SuppleDomain> domains;
        for (const LodSurface::Patch& patch : surface.patches) {
            const SuppleDrawRange* range = output.grid.drawRanges;
            while (patch.patch >= range->firstPatch + range->patchCount) {
                ++range;
            }
            const size_t first = range->firstVertex + size_t{patch.patch - range->firstPatch} * range->samplesPerPatch;
            std::vector<glm::dvec2> at; // in the order of the domain's corners
            constexpr uint32_t kQuad[] = {0, 1, 3, 2};
            const uint32_t sides = range->domain == SUPPLE_DOMAIN_PENTAGON ? 5
                                   : range->domain == SUPPLE_DOMAIN_QUAD   ? 4
                                                                           : 3;
            for (uint32_t c = 0; c < sides; ++c) {
                at.push_back(uvOf(cornerBytes, first + (range->domain == SUPPLE_DOMAIN_QUAD ? kQuad[c] : c)));
            }
            domains.insert(range->domain);
            const uint32_t count = surface::lod::sampleCount(static_cast<Form>(patch.grid), patch.capacity);
            for (uint32_t s = 0; s < count; ++s, ++compared) {
                const At sample = sampleAt(patch, s);
                double u = sample.uv.x, v = sample.uv.y;
                glm::dvec2 wanted(0.0);
                if (range->domain == SUPPLE_DOMAIN_POLAR) {
                    wanted = (1.0 - v) * ((1.0 - u) * at[0] + u * at[1]) + v * at[2];
                } else if (range->domain == SUPPLE_DOMAIN_QUAD) {
                    if (patch.grid != SUPPLE_GRID_QUAD) { // from the place in the square round the centre
                        constexpr double kX[] = {0, 1, 1, 0}, kY[] = {0, 0, 1, 1};
                        const uint32_t next = (sample.side + 1) % 4;
                        u = sample.weights.x * kX[sample.side] + sample.weights.y * kX[next] + sample.weights.z * 0.5;
                        v = sample.weights.x * kY[sample.side] + sample.weights.y * kY[next] + sample.weights.z * 0.5;
                    }
                    wanted = (1.0 - v) * ((1.0 - u) * at[0] + u * at[1]) + v * ((1.0 - u) * at[3] + u * at[2]);
                } else if (range->domain == SUPPLE_DOMAIN_PENTAGON) {
                    const auto weights = pentagonWeights(sample.side, sample.weights);
                    for (uint32_t c = 0; c < sides; ++c) {
                        wanted += static_cast<double>(weights[c]) * at[c];
                    }
                } else {
                    for (uint32_t c = 0; c < sides; ++c) {
                        wanted += sample.weights.z / sides * at[c];
                    }
                    wanted += sample.weights.x * at[sample.side] + sample.weights.y * at[(sample.side + 1) % sides];
                }
                largest = std::max(largest, glm::length(uvOf(bytes, patch.firstVertex + s) - wanted));
            }
        }
        std::printf("scheme %d: %zu samples of %zu domains, UVs within %.1e\n", scheme, compared, domains.size(),
                    largest);
        EXPECT_GE(domains.size(), scheme == SUPPLE_SCHEME_PM ? 3u : 1u);
        EXPECT_LE(largest, 1e-5);
    }
}

TEST_P(LodViews, GroupsComeAndGoAndShareTheView) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 200000);
    view.look({0.0f, 0.0f, 8.0f});
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(perturbed(cage::makeCubeSphere(2), 0.05f, 3));
    desc.capacity = 1;
    desc.view = view.handle();
    std::vector<std::unique_ptr<Crowd>> crowds;
    const auto add = [&](SuppleScheme scheme) {
        desc.scheme = scheme;
        crowds.push_back(std::make_unique<Crowd>(context, desc));
        (void)crowds.back()->spawn();
    };
    const auto run = [&] {
        std::vector<SuppleGroup> groups;
        for (const auto& crowd : crowds) {
            groups.push_back(crowd->group());
        }
        context.run(groups);
        std::set<uint32_t> firsts; // no two groups write the same vertices
        size_t patches = 0;
        for (const auto& crowd : crowds) {
            const LodSurface surface = readLodSurface(*crowd);
            EXPECT_EQ(surface.patches.size(), crowd->output().surface.patchCount);
            EXPECT_EQ(matchSides(surface).unmatched, 0u);
            for (const LodSurface::Patch& patch : surface.patches) {
                firsts.insert(patch.firstVertex);
            }
            patches += surface.patches.size();
        }
        EXPECT_EQ(firsts.size(), patches);
    };
    add(SUPPLE_SCHEME_PREP);
    add(SUPPLE_SCHEME_PM);
    add(SUPPLE_SCHEME_PREP);
    run();
    crowds.erase(crowds.begin() + 1); // leaves a gap among the runs
    run();
    add(SUPPLE_SCHEME_BLEND);
    add(SUPPLE_SCHEME_CATMULL_CLARK);
    add(SUPPLE_SCHEME_PM);
    run();
    crowds.erase(crowds.begin(), crowds.begin() + 2);
    run();
}

} // namespace
} // namespace supple::test
