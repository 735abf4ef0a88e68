// Ray queries against structures that are built and updated from Supple's own buffers, compared with the same triangles
// met in double. They need a device with ray queries: where none is at hand, they say so and are skipped.
#include "cage/character.h"
#include "host/pipelines.h"
#include "host/ray_scene.h"
#include "shaders/cast_rays_comp.h"
#include "tests/support/crowd.h"
#include "tests/support/sample_assets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <random>

namespace supple::test {
namespace {

struct Ray {
    glm::vec4 origin;    ///< and the least t
    glm::vec4 direction; ///< and the largest
};
struct Hit {
    float t = -1.0f; ///< negative: nothing is hit
    uint32_t slot = 0, geometry = 0, triangle = 0, front = 0;
};

/// A device with ray queries; null where there is none. It is made once.
host::Device* rayDevice() {
    static const std::unique_ptr<host::Device> own = [] {
        host::DeviceOptions options;
        options.validation = std::getenv("SUPPLE_VALIDATION") != nullptr;
        options.rayTracing = true;
        Result<std::unique_ptr<host::Device>> device = host::Device::create(options);
        if (!device) {
            std::printf("no ray queries: %s\n", device.error().message.c_str());
            return std::unique_ptr<host::Device>();
        }
        std::printf("ray queries on %s\n", (*device)->name().c_str());
        return std::move(*device);
    }();
    return own.get();
}

/// The triangles of a frame, met in double. Boxes over runs of triangles keep it from meeting all.
class Truth {
public:
    void add(const Hit& place, const std::array<glm::dvec3, 3>& corners) {
        if (triangles_.size() % kRun == 0) {
            runs_.push_back({corners[0], corners[0]});
        }
        for (const glm::dvec3& corner : corners) {
            runs_.back().low = glm::min(runs_.back().low, corner);
            runs_.back().high = glm::max(runs_.back().high, corner);
        }
        triangles_.push_back({place, corners});
    }
    [[nodiscard]] size_t size() const { return triangles_.size(); }

    struct Met {
        double t = -1.0;
        Hit place;
    };
    [[nodiscard]] Met meet(const Ray& ray) const {
        const glm::dvec3 origin(ray.origin), direction(ray.direction);
        Met nearest;
        double limit = ray.direction.w;
        for (size_t run = 0; run < runs_.size(); ++run) {
            if (!meetsBox(runs_[run], origin, direction, limit)) {
                continue;
            }
            const size_t end = std::min(triangles_.size(), (run + 1) * kRun);
            for (size_t i = run * kRun; i < end; ++i) {
                const double t = meetTriangle(triangles_[i].corners, origin, direction);
                if (t >= ray.origin.w && t < limit) {
                    limit = t;
                    nearest = {t, triangles_[i].place};
                    nearest.place.front = isFront(triangles_[i].corners, direction) ? 1 : 0;
                }
            }
        }
        return nearest;
    }

private:
    static constexpr size_t kRun = 32;
    struct Box {
        glm::dvec3 low, high;
    };
    struct Triangle {
        Hit place;
        std::array<glm::dvec3, 3> corners;
    };
    static bool meetsBox(const Box& box, const glm::dvec3& origin, const glm::dvec3& direction, double limit) {
        double enter = 0.0, leave = limit;
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (box.low[axis] - origin[axis]) / direction[axis];
            const double b = (box.high[axis] - origin[axis]) / direction[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter <= leave * (1.0 + 1e-12);
    }
    /// Moeller and Trumbore (1997); negative: it is not met.
    static double meetTriangle(const std::array<glm::dvec3, 3>& p, const glm::dvec3& origin,
                               const glm::dvec3& direction) {
        const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0], across = glm::cross(direction, e2), s = origin - p[0];
        const double determinant = glm::dot(e1, across);
        if (determinant == 0.0) {
            return -1.0;
        }
        const glm::dvec3 q = glm::cross(s, e1);
        const double u = glm::dot(s, across) / determinant, v = glm::dot(direction, q) / determinant;
        return u >= 0.0 && v >= 0.0 && u + v <= 1.0 ? glm::dot(e2, q) / determinant : -1.0;
    }
    static bool isFront(const std::array<glm::dvec3, 3>& p, const glm::dvec3& direction) {
        return glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), direction) < 0.0;
    }

    std::vector<Triangle> triangles_;
    std::vector<Box> runs_;
};

/// The shader that casts rays, and what it binds.
class Caster {
public:
    static constexpr uint32_t kRays = 4096;

    explicit Caster(host::Device& device)
        : device_(device), pool_(std::move(*host::DescriptorPool::create(device, 1))) {
        constexpr VkShaderStageFlags kCompute = VK_SHADER_STAGE_COMPUTE_BIT;
        const VkDescriptorSetLayout layout =
            *host::createSetLayout(device, {{0, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, kCompute},
                                            {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kCompute},
                                            {2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kCompute}});
        layout_ = *host::createPipelineLayout(device, {layout}, 0, 0);
        pipeline_ = *host::createComputePipeline(device, layout_, cast_rays_comp);
        set_ = *pool_.allocate(layout);
        rays_ = std::move(
            *device.createBuffer(kRays * sizeof(Ray), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, host::MemoryKind::upload));
        hits_ = std::move(
            *device.createBuffer(kRays * sizeof(Hit), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, host::MemoryKind::readback));
    }
    void set(std::span<const Ray> rays, VkAccelerationStructureKHR scene) {
        std::copy(rays.begin(), rays.end(), static_cast<Ray*>(rays_.mapped()));
        pool_.write(set_,
                    {host::accelerationStructure(0, scene), host::storageBuffer(1, rays_.handle(), 0, VK_WHOLE_SIZE),
                     host::storageBuffer(2, hits_.handle(), 0, VK_WHOLE_SIZE)});
    }
    void record(VkCommandBuffer commands) const {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
        vkCmdDispatch(commands, kRays / 64, 1, 1);
        host::memoryBarrier(commands, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                            {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    }
    [[nodiscard]] std::span<const Hit> hits() const { return {static_cast<const Hit*>(hits_.mapped()), kRays}; }

private:
    host::Device& device_;
    host::DescriptorPool pool_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    host::Buffer rays_, hits_;
};

struct RayCase {
    const char* name;
    const std::string& file;
    SuppleScheme scheme;
    uint32_t rate;
    uint32_t flags;
    SuppleVertexFormat format;
    SuppleMapping mapping;
    uint32_t contextFlags = 0;
    bool follows = false; ///< a group of a view that culls
};

/// A group with its structures, and what a host knows of its instances.
class RayCrowd {
public:
    static constexpr uint32_t kCapacity = 5; ///< a slot stays free

    RayCrowd(host::Device& device, const RayCase& c) : device_(device), caster_(device) {
        host::ContextOptions options;
        options.mapping = c.mapping;
        options.flags = c.contextFlags;
        options.printWarnings = false;
        context_ = std::move(*host::Context::create(device, options));
        std::ifstream file(c.file, std::ios::binary);
        const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        SuppleAssetDesc assetDesc{};
        assetDesc.structSize = sizeof(assetDesc);
        assetDesc.name = c.file.c_str();
        assetDesc.bytes = bytes.data();
        assetDesc.byteCount = bytes.size();
        SuppleAsset asset{};
        EXPECT_EQ(suppleCreateAsset(handle(), &assetDesc, &asset), SUPPLE_OK);
        const bool mixed = c.scheme == SUPPLE_SCHEME_AUTO;
        const SuppleScheme own = SUPPLE_SCHEME_CATMULL_CLARK;
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.asset = asset;
        desc.capacity = kCapacity;
        desc.scheme = mixed ? SUPPLE_SCHEME_POLYGONS : c.scheme;
        desc.rate = c.rate;
        desc.flags = c.flags | SUPPLE_GROUP_RAY_TRACING;
        desc.vertexFormat = c.format;
        desc.partSchemes = &own;
        desc.partSchemeCount = mixed ? 1 : 0; // the first part is a surface of its own
        if (c.follows) {
            createLeader(asset);
            desc.instancesOf = leader_;
            desc.capacity = 0;
        }
        EXPECT_EQ(suppleCreateGroup(handle(), &desc, &group_), SUPPLE_OK);
        leader_ = c.follows ? leader_ : group_;
        for (uint32_t i = 0; i < kCapacity - 1; ++i) {
            EXPECT_EQ(suppleCreateInstance(handle(), leader_, &instances_.emplace_back()), SUPPLE_OK);
            traced_.push_back({.slot = instances_.back().slot});
        }
        host::RayGroupOptions rayOptions;
        rayOptions.plan.mostPerFrame = kCapacity;
        rayOptions.plan.rebuildAge = 1000;
        Result<std::unique_ptr<host::RayGroup>> group = host::RayGroup::create(*context_, group_, rayOptions);
        EXPECT_TRUE(group.ok()) << group.error().message;
        rays_ = std::move(*group);
        scene_ = std::move(*host::RayScene::create(device, kCapacity, 1, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT));
    }
    ~RayCrowd() { device_.waitIdle(); }
    RayCrowd(const RayCrowd&) = delete;
    RayCrowd& operator=(const RayCrowd&) = delete;

    [[nodiscard]] SuppleContext handle() const { return context_->handle(); }
    [[nodiscard]] SuppleGroup group() const { return group_; }
    [[nodiscard]] SuppleGroup leader() const { return leader_; }
    [[nodiscard]] SuppleInstance instance(uint32_t i) const { return instances_[i]; }
    [[nodiscard]] host::TracedInstance& traced(uint32_t i) { return traced_[i]; }
    void setVisible(uint32_t i, bool visible) {
        EXPECT_EQ(suppleSetVisible(handle(), instances_[i], visible ? 1 : 0), SUPPLE_OK);
        visible_[i] = visible;
    }

    void pose(double time, float spread) {
        for (uint32_t i = 0; i < instances_.size(); ++i) {
            const glm::mat4 place =
                glm::rotate(glm::translate(glm::mat4(1.0f), {spread * static_cast<float>(i), 0.1f, 0.0f}),
                            0.3f * static_cast<float>(i), {0.0f, 1.0f, 0.0f});
            EXPECT_EQ(suppleSetClipPose(handle(), instances_[i], 0, time + 0.2 * i), SUPPLE_OK);
            EXPECT_EQ(suppleSetTransform(handle(), instances_[i], glm::value_ptr(place)), SUPPLE_OK);
        }
    }

    /// A frame: evaluated, built or updated, and traced in one submission.
    void run(uint32_t seed) {
        std::vector<host::TracedInstance> shown;
        for (uint32_t i = 0; i < traced_.size(); ++i) {
            if (visible_[i]) {
                shown.push_back(traced_[i]);
            }
        }
        caster_.set(raysFrom(seed), scene_->handle());
        const uint64_t frame = context_->nextFrame();
        EXPECT_EQ(suppleBeginFrame(handle(), frame, frame - 1), SUPPLE_OK);
        const host::RayScene::Part part{rays_.get(), shown};
        const Status submitted = device_.submitAndWait([&](VkCommandBuffer commands) {
            SuppleRecordDesc record{};
            record.structSize = sizeof(record);
            const SuppleGroup groups[] = {leader_, group_};
            record.groups = groups;
            record.groupCount = leader_.id != group_.id ? 2 : 1;
            record.before = {host::kBuildUse.stages | VK_PIPELINE_STAGE_2_COPY_BIT, 0};
            record.after = {host::kBuildUse.stages | VK_PIPELINE_STAGE_2_COPY_BIT,
                            host::kBuildUse.access | VK_ACCESS_2_TRANSFER_READ_BIT};
            EXPECT_EQ(suppleRecord(handle(), commands, &record), SUPPLE_OK);
            scene_->record(commands, {&part, 1});
            caster_.record(commands);
        });
        ASSERT_TRUE(submitted.ok()) << submitted.error().message;
    }

    [[nodiscard]] const host::RayPlan& plan() const { return rays_->plan(); }
    [[nodiscard]] uint32_t works(host::RayPlan::Work work) const {
        return static_cast<uint32_t>(
            std::ranges::count_if(plan().tasks(), [=](const host::RayPlan::Task& task) { return task.work == work; }));
    }

    /// Compares the last frame's hits; how many rays have hit something.
    uint32_t compare(const char* what) const {
        const Truth truth = read();
        uint32_t hits = 0, differ = 0, otherTriangle = 0, otherSide = 0;
        double farthest = 0.0;
        for (size_t i = 0; i < Caster::kRays; ++i) {
            const Hit& hit = caster_.hits()[i];
            const Truth::Met met = truth.meet(rayList_[i]);
            const bool isHit = hit.t >= 0.0f, isMet = met.t >= 0.0;
            hits += isMet ? 1 : 0;
            differ += isHit != isMet || (isHit && hit.slot != met.place.slot) ? 1 : 0;
            if (isHit && isMet && hit.slot == met.place.slot) {
                farthest = std::max(farthest, std::abs(hit.t - met.t));
                otherTriangle += hit.geometry != met.place.geometry || hit.triangle != met.place.triangle ? 1 : 0;
                otherSide += hit.front != met.place.front ? 1 : 0;
            }
        }
        EXPECT_EQ(differ, 0u) << what;
        EXPECT_EQ(otherTriangle, 0u) << what;
        EXPECT_EQ(otherSide, 0u) << what;
        EXPECT_LT(farthest, 2e-5) << what; // rays begin 5 units from what they aim at
        std::printf("%-22s %zu triangles, %u of %u rays hit, farthest %.1e\n", what, truth.size(), hits, Caster::kRays,
                    farthest);
        return hits;
    }

private:
    /// A group at levels of a view whose camera sees nobody.
    void createLeader(SuppleAsset asset) {
        SuppleViewDesc viewDesc{};
        viewDesc.structSize = sizeof(viewDesc);
        viewDesc.flags = SUPPLE_VIEW_CULL;
        viewDesc.maxVertices = 1u << 16;
        SuppleView view{};
        EXPECT_EQ(suppleCreateView(handle(), &viewDesc, &view), SUPPLE_OK);
        SuppleCameraDesc camera{};
        camera.structSize = sizeof(camera);
        camera.position[1] = 1000.0f;
        camera.pixelsPerUnit = 869.0f;
        camera.farthest = 1.0f;
        EXPECT_EQ(suppleSetCamera(handle(), view, &camera), SUPPLE_OK);
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.asset = asset;
        desc.capacity = kCapacity;
        desc.scheme = SUPPLE_SCHEME_PREP;
        desc.flags = SUPPLE_GROUP_POSE_UNSEEN;
        desc.view = view;
        EXPECT_EQ(suppleCreateGroup(handle(), &desc, &leader_), SUPPLE_OK);
    }

    /// From all sides into the box of the instances.
    std::span<const Ray> raysFrom(uint32_t seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> in(0.0f, 1.0f), across(-1.0f, 1.0f);
        rayList_.clear();
        while (rayList_.size() < Caster::kRays) {
            glm::vec3 side(across(random), across(random), across(random));
            if (glm::dot(side, side) > 1.0f || glm::dot(side, side) < 0.01f) {
                continue;
            }
            const glm::vec3 target(5.0f * in(random)-0.8f, 2.0f * in(random)-0.1f, 1.2f * in(random)-0.6f);
            const glm::vec3 origin = target + 5.0f * glm::normalize(side);
            rayList_.push_back({glm::vec4(origin, 0.0f), glm::vec4(glm::normalize(target - origin), 100.0f)});
        }
        return rayList_;
    }

    /// The triangles that the frame's vertices have, by what a host is told.
    [[nodiscard]] Truth read() const {
        Truth truth;
        SuppleGroupInfo info{};
        info.structSize = sizeof(info);
        EXPECT_EQ(suppleGetGroupInfo(handle(), group_, &info), SUPPLE_OK);
        uint32_t firstGeometry = 0;
        for (uint32_t surface = 0; surface < info.surfaceCount; ++surface) {
            SuppleRayGeometry geometry{};
            geometry.structSize = sizeof(geometry);
            EXPECT_EQ(suppleGetRayGeometry(handle(), group_, surface, &geometry), SUPPLE_OK);
            const std::vector<uint32_t> indices = as<uint32_t>(*device_.readBuffer(geometry.indexBuffer));
            EXPECT_EQ(indices.size(), 3 * size_t{geometry.triangleCount});
            EXPECT_EQ(*std::ranges::max_element(indices), geometry.maxVertex);
            host::GroupOutput output{};
            EXPECT_EQ(host::getGroupOutput(handle(), group_, output, surface), SUPPLE_OK);
            const std::vector<std::byte> vertices = *device_.readBuffer(output.streams.vertices);
            for (uint32_t i = 0; i < instances_.size(); ++i) {
                if (visible_[i]) {
                    addInstance(truth, geometry, indices, vertices, i, firstGeometry);
                }
            }
            firstGeometry += geometry.rangeCount;
        }
        return truth;
    }
    void addInstance(Truth& truth, const SuppleRayGeometry& geometry, const std::vector<uint32_t>& indices,
                     const std::vector<std::byte>& vertices, uint32_t i, uint32_t firstGeometry) const {
        const uint32_t slot = instances_[i].slot;
        const std::byte* first = vertices.data() + slot * geometry.instanceStride;
        bool finite = true;
        for (uint32_t r = 0; r < geometry.rangeCount; ++r) {
            const SuppleRayRange& range = geometry.ranges[r];
            if (std::ranges::binary_search(traced_[i].hiddenParts, range.part)) {
                continue;
            }
            for (uint32_t t = 0; t < range.triangleCount; ++t) {
                std::array<glm::dvec3, 3> corners{};
                for (uint32_t corner = 0; corner < 3; ++corner) {
                    glm::vec3 position;
                    std::memcpy(&position, first + indices[range.firstIndex + 3 * t + corner] * geometry.vertexStride,
                                sizeof(position));
                    finite =
                        finite && std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
                    corners[corner] = position;
                }
                truth.add({-1.0f, slot, firstGeometry + r, t, 0}, corners);
            }
        }
        EXPECT_TRUE(finite) << "slot " << slot;
    }

    host::Device& device_;
    Caster caster_;
    std::unique_ptr<host::Context> context_;
    SuppleGroup group_{}, leader_{}; ///< whose instances it draws: its own or those of another group
    std::vector<SuppleInstance> instances_;
    std::vector<host::TracedInstance> traced_;
    std::array<bool, kCapacity> visible_{true, true, true, true};
    std::unique_ptr<host::RayGroup> rays_;
    std::unique_ptr<host::RayScene> scene_;
    std::vector<Ray> rayList_;
};

constexpr SuppleMapping kNarrow = SUPPLE_MAPPING_NARROW, kWide = SUPPLE_MAPPING_WIDE;
const RayCase kRayCases[] = {
    {"Mesh", kWren, SUPPLE_SCHEME_CATMULL_CLARK, 1, SUPPLE_GROUP_INDEXED_MESH, SUPPLE_VERTEX_16, kNarrow},
    {"Grids", kPip, SUPPLE_SCHEME_PM, 2, 0, SUPPLE_VERTEX_12, kWide, SUPPLE_CONTEXT_SHARED_DISPATCHES},
    {"TwoSurfaces", kWren, SUPPLE_SCHEME_AUTO, 1, SUPPLE_GROUP_MOTION, SUPPLE_VERTEX_24, kNarrow},
    {"FollowsAView", kPipQuads, SUPPLE_SCHEME_PREP, 2, 0, SUPPLE_VERTEX_12, kNarrow, 0, true},
};

class RayQueries : public testing::TestWithParam<RayCase> {
protected:
    void SetUp() override {
        if (rayDevice() != nullptr) {
            messages_ = rayDevice()->validation()->messageCount();
            return;
        }
        // Where a driver with ray queries is at hand, the build says so (tests/runtime/CMakeLists.txt).
        ASSERT_EQ(std::getenv("SUPPLE_TEST_RAY_QUERIES"), nullptr) << "the device has no ray queries";
        GTEST_SKIP() << "left out: the device has no ray queries. tools/lavapipe.sh fetches a driver that has";
    }
    void TearDown() override {
        if (rayDevice() != nullptr) {
            EXPECT_EQ(rayDevice()->validation()->messageCount(), messages_) << "the validation layer spoke";
        }
    }

private:
    uint64_t messages_ = 0;
};

void expectDrawRanges(const RayCrowd& crowd, uint32_t surface) {
    host::GroupOutput output{};
    ASSERT_EQ(host::getGroupOutput(crowd.handle(), crowd.group(), output, surface), SUPPLE_OK);
    SuppleRayGeometry geometry{};
    geometry.structSize = sizeof(geometry);
    ASSERT_EQ(suppleGetRayGeometry(crowd.handle(), crowd.group(), surface, &geometry), SUPPLE_OK);
    EXPECT_EQ(geometry.format, VK_FORMAT_R32G32B32_SFLOAT);
    EXPECT_EQ(geometry.vertexStride, output.streams.vertices.stride);
    EXPECT_EQ(geometry.instanceStride, uint64_t{output.grid.verticesPerInstance} * geometry.vertexStride);
    EXPECT_EQ(geometry.maxVertex, output.grid.vertexCount - 1);
    EXPECT_NE(geometry.vertices, 0u);
    EXPECT_NE(geometry.indices, 0u);
    ASSERT_EQ(geometry.rangeCount, output.grid.drawRangeCount);
    uint32_t triangles = 0;
    for (uint32_t r = 0; r < geometry.rangeCount; ++r) {
        const SuppleDrawRange& draw = output.grid.drawRanges[r];
        EXPECT_EQ(geometry.ranges[r].part, draw.part);
        EXPECT_EQ(geometry.ranges[r].material, draw.material);
        EXPECT_EQ(geometry.ranges[r].firstIndex, 3 * triangles);
        EXPECT_EQ(geometry.ranges[r].triangleCount, draw.patchCount * draw.indexCount / 3);
        triangles += geometry.ranges[r].triangleCount;
    }
    EXPECT_EQ(geometry.triangleCount, triangles);
}

/// A host asks again, and finds the same triangles.
void growAndAskAgain(RayCrowd& crowd) {
    SuppleRayGeometry before{}, after{};
    before.structSize = after.structSize = sizeof(before);
    ASSERT_EQ(suppleGetRayGeometry(crowd.handle(), crowd.group(), 0, &before), SUPPLE_OK);
    ASSERT_EQ(suppleSetCapacity(crowd.handle(), crowd.leader(), 2 * RayCrowd::kCapacity), SUPPLE_OK);
    ASSERT_EQ(suppleGetRayGeometry(crowd.handle(), crowd.group(), 0, &after), SUPPLE_OK);
    EXPECT_NE(after.vertices, before.vertices);
    EXPECT_NE(after.indices, 0u);
    EXPECT_EQ(after.triangleCount, before.triangleCount);
    EXPECT_EQ(after.maxVertex, before.maxVertex);
}

/// Rays meet the draw ranges of every surface, in the same order.
void expectRanges(const RayCrowd& crowd) {
    SuppleGroupInfo info{};
    info.structSize = sizeof(info);
    ASSERT_EQ(suppleGetGroupInfo(crowd.handle(), crowd.group(), &info), SUPPLE_OK);
    for (uint32_t surface = 0; surface < info.surfaceCount; ++surface) {
        expectDrawRanges(crowd, surface);
    }
}

TEST_P(RayQueries, HitWhatIsMetInDouble) {
    using Work = host::RayPlan::Work;
    RayCrowd crowd(*rayDevice(), GetParam());
    constexpr uint32_t kInstances = RayCrowd::kCapacity - 1;

    expectRanges(crowd);
    crowd.pose(0.0, 1.0f);
    crowd.run(1);
    EXPECT_EQ(crowd.works(Work::build), kInstances);
    EXPECT_GT(crowd.compare("built"), Caster::kRays / 20);

    for (uint32_t frame = 1; frame < 4; ++frame) {
        crowd.pose(0.15 * frame, 1.0f);
        crowd.run(1 + frame);
        EXPECT_EQ(crowd.works(Work::update), kInstances);
    }
    EXPECT_GT(crowd.compare("updated three times"), Caster::kRays / 20);

    crowd.pose(0.6, 1.0f);
    const glm::mat4 away = glm::rotate(glm::translate(glm::mat4(1.0f), {3.6f, 0.0f, 0.3f}), 2.0f, {0.0f, 1.0f, 0.0f});
    EXPECT_EQ(suppleSetTransform(crowd.handle(), crowd.instance(1), glm::value_ptr(away)), SUPPLE_OK);
    EXPECT_EQ(suppleTeleport(crowd.handle(), crowd.instance(1)), SUPPLE_OK);
    crowd.traced(1).isNew = true;
    crowd.run(10);
    crowd.traced(1).isNew = false;
    EXPECT_EQ(crowd.works(Work::build), 1u);
    crowd.compare("teleported");

    const uint32_t hidden[] = {0};
    crowd.traced(0).hiddenParts = hidden;
    EXPECT_EQ(suppleSetPartVisible(crowd.handle(), crowd.instance(0), 0, 0), SUPPLE_OK);
    crowd.pose(0.7, 1.0f);
    crowd.run(11);
    EXPECT_EQ(crowd.works(Work::build), 1u);
    crowd.compare("a part is hidden");
    crowd.pose(0.8, 1.0f);
    crowd.run(12);
    EXPECT_EQ(crowd.works(Work::build), 0u);
    crowd.compare("hidden, updated");
    crowd.traced(0).hiddenParts = {};
    EXPECT_EQ(suppleSetPartVisible(crowd.handle(), crowd.instance(0), 0, 1), SUPPLE_OK);
    crowd.run(13);
    crowd.compare("shown again");

    crowd.setVisible(2, false);
    crowd.run(14);
    EXPECT_EQ(crowd.plan().traced().size(), kInstances - 1);
    crowd.compare("an instance is hidden");
    crowd.setVisible(2, true);
    crowd.pose(0.9, 1.0f);
    crowd.run(15);
    EXPECT_EQ(crowd.works(Work::build), 1u);
    crowd.compare("and comes back");
    growAndAskAgain(crowd);
}

INSTANTIATE_TEST_SUITE_P(Groups, RayQueries, testing::ValuesIn(kRayCases),
                         [](const auto& info) { return info.param.name; });

} // namespace
} // namespace supple::test
