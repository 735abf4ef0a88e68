// Patches that show their backs: what a view with SUPPLE_VIEW_BACK_FACES leaves out against one without.
#include "cage/gltf_reader.h"
#include "surface/lod/grid.h"
#include "surface/schemes.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_surface.h"
#include "tests/support/shared_assets.h"
#include "tests/support/test_view.h"

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
    double largest = 0.0;         ///< area of one that faces the camera, square pixels
    double area = 0.0;            ///< of all that do
};
/// Square pixels: a triangle between samples that all but coincide may turn over by the rounding of its corners.
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
    const auto at = [&](uint32_t v) { return glm::dvec3(asPositions({surface.positions[v]})[0]); };
    for (const std::array<uint32_t, 3>& triangle : surface.triangles) {
        const glm::dvec3 a = at(triangle[0]), b = at(triangle[1]), c = at(triangle[2]);
        const glm::dvec3 normal = glm::cross(b - a, c - a); // twice the area
        if (normal == glm::dvec3(0.0)) {
            continue;
        }
        Seen& own = *std::prev(byFirstVertex.upper_bound(triangle[0]))->second;
        const glm::dvec3 from = a - eye;
        const double away = glm::length(from);
        const double towards = orthographic ? -glm::dot(normal, direction) * 0.5 * pixels * pixels
                                            : -glm::dot(normal, from) / away * 0.5 * pixels * pixels / (away * away);
        if (towards > 0.0) {
            ++own.front;
            own.largest = std::max(own.largest, towards);
            own.area += towards;
        } else {
            ++own.back;
        }
    }
    return seen;
}

TEST_P(BackFaces, NothingThatFacesTheCameraIsLeftOut) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM}) {
        std::mt19937 random(9);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        std::normal_distribution<float> normal;
        struct Count {
            size_t patches = 0, back = 0, out = 0;
        };
        std::map<SupplePatchClass, Count> counts;
        size_t cameras = 0, lostTriangles = 0, triangles = 0;
        double largest = 0.0;
        for (const std::string& path : allCharacters()) {
            const Result<cage::Character> character = cage::readGltfFile(path);
            ASSERT_TRUE(character.ok());
            if (!surface::buildTables({.scheme = static_cast<surface::SchemeId>(scheme)}, character->cage).ok()) {
                continue;
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
            std::vector<SupplePatchInfo> patches(allCrowd.output().patchCount);
            auto count = static_cast<uint32_t>(patches.size());
            ASSERT_EQ(suppleGetPatches(context.handle(), allCrowd.group(), patches.data(), &count), SUPPLE_OK);
            glm::vec3 low(1e30f), high(-1e30f);
            for (const glm::vec3& p : character->cage.positions) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            const float size = glm::length(high - low);
            Count ofAll;
            for (uint32_t frame = 0; frame < 6; ++frame) {
                const glm::mat4 place =
                    frame == 3 ? glm::scale(glm::mat4(1.0f), glm::vec3(-1.0f, 1.0f, 1.0f)) : glm::mat4(1.0f);
                const float time = unit(random);
                for (const auto& [crowd, instance] :
                     {std::pair(&allCrowd, instances[0]), std::pair(&someCrowd, instances[1])}) {
                    crowd->pose(instance, crowd->clipCount() > 0 ? frame % crowd->clipCount() : SUPPLE_BIND_POSE, time,
                                place);
                }
                const glm::vec3 direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
                const float away = std::array{0.35f, 0.6f, 1.2f, 2.0f, 8.0f, 1.0f}[frame] * size;
                const glm::vec3 eye = 0.5f * (low + high) - away * direction;
                for (TestView* view : {&all, &some}) {
                    view->camera.flags = frame == 5 ? SUPPLE_CAMERA_ORTHOGRAPHIC : 0;
                    view->camera.pixelsPerUnit = frame == 5 ? 700.0f / size : 869.0f;
                    view->camera.nearest = 0.01f * size;
                    std::copy_n(&direction.x, 3, view->camera.direction);
                    view->look(eye);
                }
                context.run(allCrowd.group());
                const SeenPatches whole = seenPatches(readLodSurface(allCrowd), all.camera);
                context.run(someCrowd.group());
                const SeenPatches left = seenPatches(readLodSurface(someCrowd), all.camera);
                EXPECT_EQ(whole.size(), patches.size());
                ++cameras;
                for (const auto& [which, seen] : whole) {
                    Count& own = counts[patches[which.second].patchClass];
                    ++own.patches;
                    own.back += seen.front == 0 ? 1 : 0;
                    ++ofAll.patches;
                    ofAll.back += seen.front == 0 ? 1 : 0;
                    triangles += seen.front + seen.back;
                    if (const auto found = left.find(which); found != left.end()) {
                        EXPECT_EQ(found->second.levels, seen.levels);
                        continue;
                    }
                    ++own.out;
                    ++ofAll.out;
                    if (seen.front > 0) {
                        lostTriangles += seen.front;
                        largest = std::max(largest, seen.largest);
                    }
                    EXPECT_LT(seen.largest, kRounding)
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
        std::printf(
            "scheme %d: %zu cameras, %zu triangles; of patches left out %zu face the camera, at most %.2g square "
            "pixels each\n",
            scheme, cameras, triangles, lostTriangles, largest);
        // What is worth it: most regular patches that show their backs are found.
        EXPECT_GT(counts[SUPPLE_PATCH_REGULAR].out * 10, counts[SUPPLE_PATCH_REGULAR].back * 5);
    }
}

} // namespace
} // namespace supple::test
