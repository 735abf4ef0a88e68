#include "tests/support/gpu_surface.h"

#include "tools/common/cage_arrays.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <utility>

namespace supple::test {

namespace {

struct DeviceHolder {
    std::unique_ptr<host::Device> device;
    std::map<std::pair<SuppleMapping, uint32_t>, std::unique_ptr<host::Context>> contexts; ///< by mapping and flags
    bool tried = false;
};
DeviceHolder& holder() {
    static DeviceHolder h;
    return h;
}

/// Destroys the device after the last test, and fails the run when its destruction is commented on.
class DeviceEnvironment : public testing::Environment {
public:
    void TearDown() override {
        if (holder().device == nullptr) {
            return;
        }
        const auto log = holder().device->validation();
        holder().contexts.clear();
        holder().device = nullptr;
        EXPECT_EQ(log->messageCount(), 0u) << "the validation layer spoke";
    }
};
const auto* const kEnvironment = testing::AddGlobalTestEnvironment(new DeviceEnvironment);

} // namespace

glm::vec3 decodeOctahedral(uint32_t packed) {
    const auto unpack = [](uint32_t half) {
        return std::max(static_cast<float>(static_cast<int16_t>(half)) / 32767.0f, -1.0f);
    };
    glm::vec2 p(unpack(packed & 0xFFFFu), unpack(packed >> 16));
    glm::vec3 n(p, 1.0f - std::abs(p.x) - std::abs(p.y));
    if (n.z < 0.0f) {
        const glm::vec2 folded = 1.0f - glm::abs(glm::vec2(p.y, p.x));
        n.x = p.x >= 0.0f ? folded.x : -folded.x;
        n.y = p.y >= 0.0f ? folded.y : -folded.y;
    }
    return glm::normalize(n);
}

host::Device* testDevice() {
    DeviceHolder& h = holder();
    if (!h.tried) {
        h.tried = true;
        host::DeviceOptions options;
        options.validation = std::getenv("SUPPLE_VALIDATION") != nullptr;
        Result<std::unique_ptr<host::Device>> device = host::Device::create(options);
        if (device) {
            h.device = std::move(*device);
        } else {
            ADD_FAILURE() << device.error().message;
        }
    }
    EXPECT_NE(h.device, nullptr) << "no Vulkan device";
    return h.device.get();
}

ValidationGuard::ValidationGuard() {
    if (const host::Device* device = testDevice()) {
        before_ = device->validation()->messageCount();
    }
}
ValidationGuard::~ValidationGuard() {
    if (const host::Device* device = testDevice()) {
        EXPECT_EQ(device->validation()->messageCount(), before_) << "the validation layer spoke";
    }
}

GpuSurface::GpuSurface(host::Device& device, const cage::Cage& cage, const GpuOptions& options) {
    const host::CageArrays arrays(cage);
    SuppleAssetDesc asset{};
    asset.structSize = sizeof(asset);
    asset.name = "test cage";
    asset.cage = &arrays.desc;
    create(device, asset, options);
}

GpuSurface::GpuSurface(host::Device& device, const std::string& path, const GpuOptions& options) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    SuppleAssetDesc asset{};
    asset.structSize = sizeof(asset);
    asset.name = path.c_str();
    asset.bytes = bytes.data();
    asset.byteCount = bytes.size();
    create(device, asset, options);
}

void GpuSurface::create(host::Device& device, const SuppleAssetDesc& asset, const GpuOptions& options) {
    device_ = &device;
    std::unique_ptr<host::Context>& shared = holder().contexts[{options.mapping, options.contextFlags}];
    if (shared == nullptr) {
        host::ContextOptions contextOptions;
        contextOptions.mapping = options.mapping;
        contextOptions.flags = options.contextFlags;
        contextOptions.printWarnings = false;
        Result<std::unique_ptr<host::Context>> context = host::Context::create(device, contextOptions);
        ASSERT_TRUE(context.ok()) << context.error().message;
        shared = std::move(*context);
    }
    context_ = shared.get();
    const auto check = [&](SuppleResult result, const char* call) {
        const Status status = context_->check(result, call);
        EXPECT_TRUE(status.ok()) << status.error().message;
        return status.ok();
    };
    if (!check(suppleCreateAsset(context_->handle(), &asset, &asset_), "suppleCreateAsset")) {
        return;
    }
    SuppleGroupDesc group{};
    group.structSize = sizeof(group);
    group.flags = options.flags | SUPPLE_GROUP_WINDOWS; // read back, never bound
    group.asset = asset_;
    group.capacity = options.instanceCount;
    group.scheme = options.scheme;
    group.uvInterpolation = options.uvInterpolation;
    group.rate = options.rate;
    group.vertexFormat = options.format;
    const SupplePrepOptions prep{sizeof(prep), options.tangents, options.corners};
    const SuppleBlendOptions blend{sizeof(blend), options.creases, 0.0f};
    const SuppleFragmentsOptions fragments{sizeof(fragments), options.rules};
    group.prep = &prep;
    group.blend = &blend;
    group.fragments = &fragments;
    if (!check(suppleCreateGroup(context_->handle(), &group, &group_), "suppleCreateGroup")) {
        return;
    }
    instances_.resize(options.instanceCount);
    for (SuppleInstance& instance : instances_) {
        if (!check(suppleCreateInstance(context_->handle(), group_, &instance), "suppleCreateInstance")) {
            return;
        }
    }
    if (!check(host::getGroupOutput(context_->handle(), group_, output_), "suppleGetGroupInfo")) {
        return;
    }
    uint32_t count = output_.surface.patchCount;
    patches_.resize(count);
    if (!check(suppleGetPatches(context_->handle(), group_, 0, patches_.data(), &count), "suppleGetPatches")) {
        return;
    }
    for (uint32_t r = 0; r < output_.grid.drawRangeCount; ++r) {
        ranges_.insert(ranges_.end(), output_.grid.drawRanges[r].patchCount, r);
    }
    valid_ = true;
}

GpuSurface::~GpuSurface() {
    if (context_ == nullptr) {
        return;
    }
    if (group_.id != 0) {
        EXPECT_EQ(suppleDestroyGroup(context_->handle(), group_), SUPPLE_OK);
    }
    if (asset_.id != 0) {
        EXPECT_EQ(suppleDestroyAsset(context_->handle(), asset_), SUPPLE_OK);
    }
}

void GpuSurface::evaluate() {
    ASSERT_TRUE(valid_);
    const Status status = context_->evaluate({&group_, 1});
    ASSERT_TRUE(status.ok()) << status.error().message;
    const auto read = [&](const SuppleBufferRange& view) {
        Result<std::vector<std::byte>> bytes = device_->readBuffer(view);
        EXPECT_TRUE(bytes.ok());
        return bytes.ok() ? std::move(*bytes) : std::vector<std::byte>(view.size);
    };
    rawVertices_ = read(output_.streams.vertices);
    const size_t stride = output_.streams.vertices.stride;
    vertices_.resize(rawVertices_.size() / stride);
    for (size_t i = 0; i < vertices_.size(); ++i) {
        const std::byte* source = rawVertices_.data() + i * stride;
        std::memcpy(&vertices_[i].position, source, 12);
        if (stride == 24) {
            std::memcpy(&vertices_[i].normal, source + 12, 12);
        } else {
            uint32_t packed = 0;
            std::memcpy(&packed, source + 12, 4);
            vertices_[i].normal = decodeOctahedral(packed);
        }
    }
    const auto readVec4 = [&](const SuppleBufferRange& view, std::vector<glm::vec3>& out) {
        if (view.buffer == VK_NULL_HANDLE) {
            return;
        }
        const std::vector<std::byte> bytes = read(view);
        out.resize(bytes.size() / 16);
        for (size_t i = 0; i < out.size(); ++i) {
            std::memcpy(&out[i], bytes.data() + 16 * i, 12);
        }
    };
    readVec4(output_.info.deformedCage, deformed_);
    readVec4(output_.surface.patchCoefficients, coefficients_);
}

} // namespace supple::test
