// Patches that show their backs: what a view with SUPPLE_VIEW_BACK_FACES leaves out against one without.
#include "cage/gltf/reader.h"
#include "surface/lod/grid.h"
#include "surface/schemes.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_surface.h"
#include "tests/support/meshes.h"
#include "tests/support/shared_assets.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"

#include <cstdio>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

namespace supple::test {
namespace {

class BackFaces : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, BackFaces, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

/// By (slot, patch): levels, and how its triangles lie to the camera.
struct Seen {
    std::array<float, 12> levels{};
    uint32_t front = 0, back = 0; ///< triangles of some area
    double highest = 0.0;         ///< height of one that faces the camera, over its longest edge, pixels
    double area = 0.0;            ///< of all that do
};
/// Pixels: a triangle that is as good as flat may turn over by the rounding of its corners.
constexpr double kRounding = 1e-3;
using SeenPatches = std::map<std::pair<uint32_t, uint32_t>, Seen>;

SeenPatches seenPatches(const LodSurface& surface, const SuppleCameraDesc& camera) {
    const bool orthographic = (camera.flags & SUPPLE_CAMERA_ORTHOGRAPHIC) != 0;
    const glm::dvec3 eye(camera.position[0], camera.position[1], camera.position[2]);
    const glm::dvec3 direction =
        orthographic ? glm::normalize(glm::dvec3(camera.direction[0], camera.direction[1], camera.direction[2]))
                     : glm::dvec3(0.0);
    const double pixels = static_cast<double>(camera.pixelsPerUnit);
    SeenPatches seen;
    std::map<uint32_t, Seen*> byFirstVertex;
    for (const LodSurface::Patch& patch : surface.patches) {
        Seen& own = seen[{patch.slot, patch.patch}];
        own.levels = patch.levels;
        byFirstVertex[patch.firstVertex] = &own;
    }
    const std::vector<glm::vec3> positions = asPositions(surface.positions);
    auto patch = byFirstVertex.end(); // of the triangle before: those of a patch come one after the other
    for (const std::array<uint32_t, 3>& triangle : surface.triangles) {
        const glm::dvec3 a = positions[triangle[0]], b = positions[triangle[1]], c = positions[triangle[2]];
        const glm::dvec3 normal = glm::cross(b - a, c - a); // twice the area
        if (normal == glm::dvec3(0.0)) {
            continue;
        }
        if (patch == byFirstVertex.end() || triangle[0] < patch->first ||
            (std::next(patch) != byFirstVertex.end() && triangle[0] >= std::next(patch)->first)) {
            patch = std::prev(byFirstVertex.upper_bound(triangle[0]));
        }
        Seen& own = *patch->second;
        const glm::dvec3 from = a - eye;
        const double away = glm::length(from);
        const double towards = orthographic ? -glm::dot(normal, direction) * 0.5 * pixels * pixels
                                            : -glm::dot(normal, from) / away * 0.5 * pixels * pixels / (away * away);
        if (towards > 0.0) {
            ++own.front;
            const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
            own.highest = std::max(own.highest, 2.0 * towards / (longest * pixels / (orthographic ? 1.0 : away)));
            own.area += towards;
        } else {
            ++own.back;
        }
    }
    return seen;
}

/// Depths of a square picture as a rasterizer has them that leaves out what winds clockwise, and 0 where nothing is: of
/// 1 / distance along the view, which is linear in a perspective picture.
std::vector<float> picture(const LodSurface& surface, glm::dvec3 eye, glm::dvec3 middle, double pixels) {
    constexpr int kSide = 256;
    std::vector<float> depths(size_t{kSide} * kSide, 0.0f);
    const glm::dmat4 view = glm::lookAt(eye, middle, glm::dvec3(0.13, 0.97, 0.21));
    std::vector<glm::dvec3> projected; // the depth below 0: behind the eye
    projected.reserve(surface.positions.size());
    for (const glm::dvec3 position : asPositions(surface.positions)) {
        const glm::dvec3 q = view * glm::dvec4(position, 1.0);
        projected.emplace_back(kSide / 2 - pixels * q.x / q.z, kSide / 2 - pixels * q.y / q.z, -1.0 / q.z);
    }
    for (const std::array<uint32_t, 3>& triangle : surface.triangles) {
        const glm::dvec3 p[] = {projected[triangle[0]], projected[triangle[1]], projected[triangle[2]]};
        const bool before = p[0].z > 0.0 && p[1].z > 0.0 && p[2].z > 0.0;
        const auto side = [](glm::dvec3 a, glm::dvec3 b, double x, double y) {
            return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
        };
        const double area = side(p[0], p[1], p[2].x, p[2].y);
        if (!before || area <= 0.0) {
            continue;
        }
        const auto range = [&](int axis) {
            const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
            return std::pair(static_cast<int>(std::clamp(low, 0.0, double{kSide})),
                             static_cast<int>(std::clamp(high + 1.0, 0.0, double{kSide})));
        };
        const auto [left, right] = range(0);
        const auto [top, bottom] = range(1);
        for (int y = top; y < bottom; ++y) {
            for (int x = left; x < right; ++x) {
                const double a = side(p[1], p[2], x + 0.5, y + 0.5), b = side(p[2], p[0], x + 0.5, y + 0.5),
                             c = side(p[0], p[1], x + 0.5, y + 0.5);
                if (a >= 0.0 && b >= 0.0 && c >= 0.0) {
                    const double depth = (a * p[0].z + b * p[1].z + c * p[2].z) / area;
                    float& own = depths[static_cast<size_t>(y) * kSide + static_cast<size_t>(x)];
                    own = std::max(own, static_cast<float>(depth));
                }
            }
        }
    }
    return depths;
}

TEST_P(BackFaces, NothingThatFacesTheCameraIsLeftOut) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_LOOP}) {
        std::mt19937 random(9);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        std::normal_distribution<float> normal;
        struct Count {
            size_t patches = 0, back = 0, out = 0;
        };
        std::map<SupplePatchClass, Count> counts;
        size_t cameras = 0, lostTriangles = 0, triangles = 0, pixels = 0, differentPixels = 0;
        double highest = 0.0;
        // A third of them, in the wide mapping a sixth, and others: each takes seconds.
        for (const std::string& path :
             sampledCharacters(lessInWide(GetParam(), 3, 6), GetParam() == SUPPLE_MAPPING_WIDE ? 1 : 0)) {
            const Result<cage::Character> character = cage::readGltfFile(path);
            ASSERT_TRUE(character.ok());
            const auto asked = static_cast<surface::SchemeId>(scheme);
            if (!surface::buildTables({.scheme = asked}, character->cage).ok()) {
                continue; // refused
            }
            const std::string name = std::filesystem::path(path).filename().string();
            TestView all(context, 1'000'000), some(context, 1'000'000, SUPPLE_VIEW_BACK_FACES);
            SuppleGroupDesc desc{};
            desc.asset = context.asset(path);
            desc.capacity = 1;
            desc.scheme = scheme;
            desc.view = all.handle();
            Crowd allCrowd(context, desc);
            desc.view = some.handle();
            Crowd someCrowd(context, desc);
            ASSERT_TRUE(allCrowd.valid() && someCrowd.valid());
            const SuppleInstance instances[] = {allCrowd.spawn(), someCrowd.spawn()};
            std::vector<SupplePatchInfo> patches(allCrowd.output().surface.patchCount);
            auto count = static_cast<uint32_t>(patches.size());
            ASSERT_EQ(suppleGetPatches(context.handle(), allCrowd.group(), 0, patches.data(), &count), SUPPLE_OK);
            glm::vec3 low(1e30f), high(-1e30f);
            for (const glm::vec3& p : character->cage.positions) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            const float size = glm::length(high - low);
            Count ofAll;
            for (uint32_t frame = 0; frame < 7; ++frame) {
                const glm::mat4 place =
                    frame == 3 ? glm::scale(glm::mat4(1.0f), glm::vec3(-1.0f, 1.0f, 1.0f)) : glm::mat4(1.0f);
                const float time = unit(random);
                for (const auto& [crowd, instance] :
                     {std::pair(&allCrowd, instances[0]), std::pair(&someCrowd, instances[1])}) {
                    crowd->pose(instance, crowd->clipCount() > 0 ? frame % crowd->clipCount() : SUPPLE_BIND_POSE, time,
                                place);
                }
                const glm::vec3 direction = glm::normalize(glm::vec3{normal(random), normal(random), normal(random)});
                const float away = std::array{0.35f, 0.6f, 1.2f, 2.0f, 8.0f, 1.0f, 1.5f}[frame] * size;
                const glm::vec3 eye = 0.5f * (low + high) - away * direction;
                for (TestView* view : {&all, &some}) {
                    view->camera.flags = frame == 5 ? SUPPLE_CAMERA_ORTHOGRAPHIC : 0;
                    view->camera.pixelsPerUnit = frame == 5 ? 700.0f / size : 869.0f;
                    view->camera.nearest = 0.01f * size;
                    view->camera.vertexBudget = frame == 6 ? 20 * count : 0; // scales levels down
                    std::copy_n(&direction.x, 3, view->camera.direction);
                    view->look(eye);
                }
                context.run(allCrowd.group());
                const LodSurface wholeSurface = readLodSurface(allCrowd);
                const SeenPatches whole = seenPatches(wholeSurface, all.camera);
                context.run(someCrowd.group());
                const LodSurface leftSurface = readLodSurface(someCrowd);
                const SeenPatches left = seenPatches(leftSurface, all.camera);
                EXPECT_EQ(whole.size(), patches.size());
                if (frame < 5) { // with the same levels and one eye
                    const std::vector<float> before = picture(wholeSurface, eye, 0.5f * (low + high), 200.0);
                    const std::vector<float> after = picture(leftSurface, eye, 0.5f * (low + high), 200.0);
                    for (size_t i = 0; i < before.size(); ++i) {
                        pixels += before[i] > 0.0f ? 1 : 0;
                        differentPixels += before[i] != after[i] ? 1 : 0;
                    }
                }
                ++cameras;
                for (const auto& [which, seen] : whole) {
                    Count& own = counts[patches[which.second].patchClass];
                    ++own.patches;
                    own.back += seen.front == 0 ? 1 : 0;
                    ++ofAll.patches;
                    ofAll.back += seen.front == 0 ? 1 : 0;
                    triangles += seen.front + seen.back;
                    if (const auto found = left.find(which); found != left.end()) {
                        EXPECT_TRUE(frame == 6 || found->second.levels == seen.levels);
                        continue;
                    }
                    ++own.out;
                    ++ofAll.out;
                    if (seen.front > 0) {
                        lostTriangles += seen.front;
                        highest = std::max(highest, seen.highest);
                    }
                    EXPECT_LT(seen.highest, kRounding)
                        << name << ", frame " << frame << ", patch " << which.second << ": " << seen.area;
                }
            }
            std::printf("scheme %d, %s: %zu patches, %zu show their backs, %zu left out\n", scheme, name.c_str(),
                        ofAll.patches, ofAll.back, ofAll.out);
        }
        for (const auto& [patchClass, count] : counts) {
            std::printf("scheme %d, class %d: %zu patches, %zu show their backs, %zu left out\n", scheme, patchClass,
                        count.patches, count.back, count.out);
        }
        std::printf("scheme %d: %zu cameras, %zu triangles; of patches left out %zu face the camera, at most %.2g "
                    "pixels high\n",
                    scheme, cameras, triangles, lostTriangles, highest);
        std::printf("scheme %d: %zu pixels, %zu differ\n", scheme, pixels, differentPixels);
        EXPECT_GT(pixels, 100'000u);
        EXPECT_EQ(differentPixels, 0u);
        // What is worth it: many regular patches that show their backs are found, on coarse cages a sixth, on those
        // of the shared characters half of them.
        const Count& regular = counts[scheme == SUPPLE_SCHEME_LOOP ? SUPPLE_PATCH_LOOP_REGULAR : SUPPLE_PATCH_REGULAR];
        EXPECT_GT(regular.out * 10, regular.back);
        // Of the others some at least, but for polar ones, which all stay. Perturbed patches: of 100 one or two, where
        // there are more characters than the repository's own.
        if (scheme == SUPPLE_SCHEME_PREP) {
            EXPECT_TRUE(cameras < 20 || counts[SUPPLE_PATCH_PERTURBED].out > 0);
        } else if (scheme == SUPPLE_SCHEME_LOOP) {
            EXPECT_EQ(counts[SUPPLE_PATCH_LOOP_IRREGULAR].out, 0u);
        } else {
            EXPECT_GT(counts[SUPPLE_PATCH_P4].out, 0u);
            EXPECT_GT(counts[SUPPLE_PATCH_P3].out + counts[SUPPLE_PATCH_P5].out, 0u);
            EXPECT_EQ(counts[SUPPLE_PATCH_POLAR].out, 0u);
        }
    }
}

/// Two crowds of one asset, drawn with back faces and without, instances in their bind poses.
class BothWays {
public:
    BothWays(CrowdContext& context, SuppleAsset asset, SuppleScheme scheme, uint32_t maxVertices)
        : context_(context), whole_(context, maxVertices), left_(context, maxVertices, SUPPLE_VIEW_BACK_FACES),
          wholeCrowd_(context, descOf(asset, scheme, whole_)), leftCrowd_(context, descOf(asset, scheme, left_)) {
        EXPECT_TRUE(wholeCrowd_.valid() && leftCrowd_.valid());
        (void)wholeCrowd_.spawn();
        (void)leftCrowd_.spawn();
        patches.resize(wholeCrowd_.output().surface.patchCount);
        auto count = static_cast<uint32_t>(patches.size());
        EXPECT_EQ(suppleGetPatches(context.handle(), wholeCrowd_.group(), 0, patches.data(), &count), SUPPLE_OK);
    }
    /// Nothing that faces the camera is missing. Adds to the counts.
    void look(const SuppleCameraDesc& camera) {
        SuppleCameraDesc own = camera;
        own.structSize = sizeof(own);
        whole_.camera = left_.camera = own;
        const glm::vec3 eye(own.position[0], own.position[1], own.position[2]);
        whole_.look(eye);
        left_.look(eye);
        context_.run(wholeCrowd_.group());
        const SeenPatches whole = seenPatches(readLodSurface(wholeCrowd_), own);
        context_.run(leftCrowd_.group());
        const SeenPatches left = seenPatches(readLodSurface(leftCrowd_), own);
        EXPECT_EQ(whole.size(), patches.size());
        for (const auto& [which, seen] : whole) {
            const bool out = !left.contains(which);
            EXPECT_TRUE(!out || seen.highest < kRounding)
                << "patch " << which.second << ", class " << patches[which.second].patchClass << ": " << seen.front
                << " triangles, " << seen.area << " square pixels";
            outByClass[patches[which.second].patchClass] += out ? 1 : 0;
            mixed += seen.back > 3 * seen.front && seen.highest >= kRounding ? 1 : 0;
        }
    }
    std::vector<SupplePatchInfo> patches;
    std::map<SupplePatchClass, size_t> outByClass;
    size_t mixed = 0; ///< patches that show their backs but for some triangles

private:
    static SuppleGroupDesc descOf(SuppleAsset asset, SuppleScheme scheme, const TestView& view) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = 1;
        desc.scheme = scheme;
        desc.view = view.handle();
        return desc;
    }
    CrowdContext& context_;
    TestView whole_, left_;
    Crowd wholeCrowd_, leftCrowd_;
};

using Net = std::array<glm::dvec3, 16>; ///< i + 4 j

/// Appends a grid of 3 x 3 quads whose middle one has this net.
void appendNet(std::vector<glm::vec3>& positions, Faces& polygons, Net net) {
    for (const size_t axis : {0u, 1u}) { // cubic B-splines from Bezier coefficients, along u and then along v
        for (size_t k = 0; k < 4; ++k) {
            const auto at = [&](size_t i) -> glm::dvec3& { return net[axis == 0 ? i + 4 * k : k + 4 * i]; };
            const glm::dvec3 p1 = 2.0 * at(1) - at(2), p2 = 2.0 * at(2) - at(1);
            at(0) = 6.0 * at(0) - 4.0 * p1 - p2;
            at(3) = 6.0 * at(3) - 4.0 * p2 - p1;
            at(1) = p1;
            at(2) = p2;
        }
    }
    const auto first = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), net.begin(), net.end());
    for (uint32_t j = 0; j < 3; ++j) {
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t a = first + i + 4 * j;
            polygons.push_back({a, a + 1, a + 5, a + 4});
        }
    }
}

// Borders of few segments along insides of many: there the triangles of the first row are long and askew.
TEST_P(BackFaces, BordersThatAreCoarserThanTheInsideAreMinded) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    std::vector<glm::vec3> positions;
    Faces polygons;
    std::mt19937 random(31);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    constexpr size_t kNets = 240;
    for (size_t n = 0; n < kNets; ++n) {
        // The first by hand: its borders have the levels 1 and 11, and of those triangles two face the camera.
        const bool given = n == 0;
        const double rises[3] = {given ? 0.4 : 0.2 + unit(random), given ? 0.5 : 0.2 + unit(random),
                                 given ? 30.0 : 0.3 + 30.0 * unit(random)};
        const double low = given ? 0.33 : 0.7 * unit(random) * rises[0];
        const double bend = given ? 30.0 : 60.0 * unit(random), noise = given ? 0.0 : 0.2 * unit(random);
        Net net;
        for (size_t j = 0; j < 4; ++j) {
            for (size_t i = 0; i < 4; ++i) {
                const double y = (j > 0 ? rises[0] : 0.0) + (j > 1 ? rises[1] : 0.0) + (j > 2 ? rises[2] : 0.0);
                const double z[4] = {0.0, 30.0, 61.0, 91.0 + bend};
                const auto off = [&](double size) { return noise * size * (unit(random) - 0.5); };
                net[i + 4 * j] = {20.0 * static_cast<double>(i) + off(10.0),
                                  y - (i == 1 || i == 2 ? low : 0.0) + off(rises[0]), z[j]};
            }
        }
        for (size_t turns = 0; turns < n % 4; ++turns) { // every side is the first once
            Net turned;
            for (size_t j = 0; j < 4; ++j) {
                for (size_t i = 0; i < 4; ++i) {
                    turned[j + 4 * (3 - i)] = net[i + 4 * j];
                }
            }
            net = turned;
        }
        appendNet(positions, polygons, net);
    }
    const SuppleAsset asset = context.createAsset(makeCage(positions, polygons));
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_LOOP}) {
        // Loop cuts a net's middle quad in two, with corners of valence 6.
        const SupplePatchClass regular =
            scheme == SUPPLE_SCHEME_LOOP ? SUPPLE_PATCH_LOOP_REGULAR : SUPPLE_PATCH_REGULAR;
        BothWays both(context, asset, scheme, 1'000'000);
        SuppleCameraDesc camera{};
        camera.flags = SUPPLE_CAMERA_ORTHOGRAPHIC;
        camera.pixelsPerUnit = 1.0f;
        camera.direction[2] = 1.0f;
        both.look(camera);
        EXPECT_GT(both.mixed, 20u);
        camera.vertexBudget = 40'000; // scales levels down
        both.look(camera);
        camera.vertexBudget = 0;
        // From so far that rays are all but parallel.
        camera.flags = 0;
        camera.position[0] = 30.0f;
        camera.position[1] = 10.0f;
        camera.position[2] = -3000.0f;
        camera.pixelsPerUnit = 3000.0f;
        both.look(camera);
        std::printf("scheme %d: %zu regular patches left out, %zu show their backs but for some triangles\n", scheme,
                    both.outByClass[regular], both.mixed);
        EXPECT_GT(both.outByClass[regular], 50u);
    }
}

TEST_P(BackFaces, RoughCagesOfAllClassesLoseNothingThatFacesTheCamera) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    std::mt19937 random(37);
    std::normal_distribution<float> normal;
    std::map<SupplePatchClass, size_t> out;
    for (const float rough : {0.0f, 0.02f, 0.1f}) {
        const std::pair<cage::Cage, SuppleScheme> cages[] = {
            {perturbed(dodecahedron(), rough, 1), SUPPLE_SCHEME_PM},
            {perturbed(quartered(gyroBipyramid(5)), rough, 2), SUPPLE_SCHEME_PM},
            {perturbed(withMergedFaces(withCutQuads(torus(14, 9), 0.5, 3), 60, 4), rough, 5), SUPPLE_SCHEME_PM},
            {perturbed(cage::makeCubeSphere(3), rough, 6), SUPPLE_SCHEME_PREP},
            {perturbed(quartered(quartered(gyroBipyramid(5))), rough, 7), SUPPLE_SCHEME_LOOP}};
        for (const auto& [cage, scheme] : cages) {
            BothWays both(context, context.createAsset(cage), scheme, 150'000);
            glm::vec3 low(1e30f), high(-1e30f);
            for (const glm::vec3& p : cage.positions) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            const float size = glm::length(high - low);
            for (uint32_t frame = 0; frame < 4; ++frame) {
                const glm::vec3 direction = glm::normalize(glm::vec3{normal(random), normal(random), normal(random)});
                const float away = std::array{0.8f, 1.2f, 3.0f, 1.5f}[frame] * size;
                const glm::vec3 eye = 0.5f * (low + high) - away * direction;
                SuppleCameraDesc camera{};
                camera.flags = frame == 3 ? SUPPLE_CAMERA_ORTHOGRAPHIC : 0;
                camera.pixelsPerUnit = frame == 3 ? 250.0f / size : 300.0f;
                camera.nearest = 0.01f * size;
                std::copy_n(&direction.x, 3, camera.direction);
                std::copy_n(&eye.x, 3, camera.position);
                both.look(camera);
                camera.vertexBudget = 6'000; // scales levels down
                both.look(camera);
            }
            for (const auto& [patchClass, count] : both.outByClass) {
                out[patchClass] += count;
            }
        }
    }
    for (const auto& [patchClass, count] : out) {
        std::printf("class %d: %zu left out\n", patchClass, count);
    }
    EXPECT_GT(out[SUPPLE_PATCH_REGULAR], 50u);
    EXPECT_GT(out[SUPPLE_PATCH_P3], 20u);
    EXPECT_GT(out[SUPPLE_PATCH_P4], 20u);
    EXPECT_GT(out[SUPPLE_PATCH_LOOP_REGULAR], 50u);
}

TEST_P(BackFaces, AreCountedAndDoubleSidedOnesStay) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    Result<cage::Character> character = cage::readGltfFile(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb");
    ASSERT_TRUE(character.ok());
    ASSERT_FALSE(character->materials.empty());
    for (const bool doubleSided : {false, true}) {
        for (cage::Material& material : character->materials) {
            material.doubleSided = doubleSided;
        }
        TestView view(context, 1'000'000, SUPPLE_VIEW_BACK_FACES | SUPPLE_VIEW_CULL);
        SuppleGroupDesc desc{};
        desc.asset = context.createAsset(*character);
        desc.capacity = 3;
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.view = view.handle();
        Crowd crowd(context, desc);
        ASSERT_TRUE(crowd.valid());
        for (int i = 0; i < 3; ++i) {
            crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0,
                       glm::translate(glm::mat4(1.0f), glm::vec3(2.0f * static_cast<float>(i), 0.0f, 0.0f)));
        }
        view.look({2.0f, 1.0f, 7.0f});
        context.run(crowd.group());
        const size_t drawn = readLodSurface(crowd).patches.size();
        context.run(crowd.group());
        const SuppleViewStatistics statistics = view.statistics();
        EXPECT_EQ(statistics.instanceCount, 3u);
        EXPECT_EQ(statistics.drawnInstanceCount, 3u);
        EXPECT_EQ(statistics.patchCount, drawn);
        EXPECT_EQ(statistics.backFaceCount, 3 * crowd.output().surface.patchCount - drawn);
        EXPECT_EQ(statistics.backFaceCount == 0, doubleSided);
    }
}

} // namespace
} // namespace supple::test
