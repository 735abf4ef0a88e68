// supple_tracy.h against a stand-in for Tracy that notes its calls: passes become zones, once, with their own times.
#include "host/context.h"
#include "host/must.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <supple/supple_tracy.h>

namespace {

struct Zone {
    std::string name, function;
    uint16_t begin = 0, end = 0;
};
/// What Tracy was told.
struct Told {
    std::vector<___tracy_gpu_new_context_data> contexts;
    std::vector<___tracy_gpu_calibration_data> calibrations;
    std::vector<Zone> zones;
    std::map<uint16_t, int64_t> times; ///< by query
    std::string contextName, name, function;
} told;

} // namespace

extern "C" {
uint64_t ___tracy_alloc_srcloc_name(uint32_t, const char*, size_t, const char* function, size_t functionSz,
                                    const char* name, size_t nameSz, uint32_t) {
    told.name.assign(name, nameSz);
    told.function.assign(function, functionSz);
    return 1;
}
void ___tracy_emit_gpu_zone_begin_alloc_serial(const ___tracy_gpu_zone_begin_data data) {
    told.zones.push_back({told.name, told.function, data.queryId, 0});
}
void ___tracy_emit_gpu_zone_end_serial(const ___tracy_gpu_zone_end_data data) {
    told.zones.back().end = data.queryId;
}
void ___tracy_emit_gpu_time_serial(const ___tracy_gpu_time_data data) {
    told.times[data.queryId] = data.gpuTime;
}
void ___tracy_emit_gpu_new_context_serial(const ___tracy_gpu_new_context_data data) {
    told.contexts.push_back(data);
}
void ___tracy_emit_gpu_context_name_serial(const ___tracy_gpu_context_name_data data) {
    told.contextName.assign(data.name, data.len);
}
void ___tracy_emit_gpu_calibration_serial(const ___tracy_gpu_calibration_data data) {
    told.calibrations.push_back(data);
}
}

namespace supple::test {
namespace {

/// Frames of Pip, as a host records and collects them.
class TracyTest : public testing::Test {
protected:
    void SetUp() override {
        told = {};
        std::ifstream file(SUPPLE_SAMPLE_ASSETS "/pip.glb", std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
        auto assetDesc = sized<SuppleAssetDesc>();
        assetDesc.name = "pip";
        assetDesc.bytes = bytes.data();
        assetDesc.byteCount = bytes.size();
        ASSERT_EQ(suppleCreateAsset(context_->handle(), &assetDesc, &asset_), SUPPLE_OK);
        auto groupDesc = sized<SuppleGroupDesc>();
        groupDesc.asset = asset_;
        groupDesc.capacity = 1;
        groupDesc.rate = 2;
        ASSERT_EQ(suppleCreateGroup(context_->handle(), &groupDesc, &group_), SUPPLE_OK);
        SuppleInstance instance{};
        ASSERT_EQ(suppleCreateInstance(context_->handle(), group_, &instance), SUPPLE_OK);
    }
    void drawFrame() {
        ASSERT_TRUE(context_->evaluate({&group_, 1}, SUPPLE_RECORD_TIMINGS).ok());
        const uint64_t next = context_->nextFrame();
        ASSERT_EQ(suppleBeginFrame(context_->handle(), next, next - 1), SUPPLE_OK);
    }

    std::unique_ptr<host::Device> device_ = host::mustCreateDevice();
    std::unique_ptr<host::Context> context_ = host::must(host::Context::create(*device_));
    SuppleAsset asset_{};
    SuppleGroup group_{};
    SuppleTracy tracy_{};
};

TEST_F(TracyTest, EveryPassIsAZoneOnceWithItsOwnTimes) {
    drawFrame();
    suppleTracyCollect(&tracy_, context_->handle());
    EXPECT_TRUE(told.zones.empty()) << "nothing before it has begun";
    suppleTracyBegin(&tracy_, 200, "Supple", 5e6, 7e9);
    ASSERT_EQ(told.contexts.size(), 1u);
    EXPECT_EQ(told.contexts[0].gpuTime, 5'000'000);
    EXPECT_EQ(told.contexts[0].period, 1.0f);
    EXPECT_EQ(told.contexts[0].context, 200);
    EXPECT_EQ(told.contextName, "Supple");

    suppleTracyCollect(&tracy_, context_->handle());
    suppleTracyCollect(&tracy_, context_->handle()); // the same frame again
    uint32_t count = 0;
    ASSERT_EQ(suppleGetTimings(context_->handle(), sizeof(SuppleTiming), nullptr, &count), SUPPLE_OK);
    std::vector<SuppleTiming> timings(count);
    ASSERT_EQ(suppleGetTimings(context_->handle(), sizeof(SuppleTiming), timings.data(), &count), SUPPLE_OK);
    ASSERT_EQ(told.zones.size(), timings.size());
    for (size_t i = 0; i < timings.size(); ++i) {
        EXPECT_EQ(told.zones[i].name, suppleGetPassName(timings[i].pass));
        EXPECT_EQ(told.zones[i].function, "group " + std::to_string(group_.id) +
                                              (timings[i].surface == SUPPLE_NO_SURFACE ? "" : ", surface 0"));
        EXPECT_EQ(told.times.at(told.zones[i].begin), static_cast<int64_t>(timings[i].gpuBegin));
        EXPECT_EQ(told.times.at(told.zones[i].end), static_cast<int64_t>(timings[i].gpuEnd));
    }
    EXPECT_EQ(told.times.size(), 2 * timings.size()) << "no query is used twice";

    const size_t before = told.zones.size();
    drawFrame();
    suppleTracyCollect(&tracy_, context_->handle());
    EXPECT_GT(told.zones.size(), before);
}

TEST_F(TracyTest, CalibrationsTellWhatHasPassedOnTheHost) {
    suppleTracyCalibrate(&tracy_, 1.0, 1.0);
    EXPECT_TRUE(told.calibrations.empty()) << "nothing before it has begun";
    suppleTracyBegin(&tracy_, 3, "Supple", 1e6, 2e9);
    suppleTracyCalibrate(&tracy_, 2e6, 2.5e9);
    suppleTracyCalibrate(&tracy_, 2e6, 2.5e9);
    suppleTracyCalibrate(&tracy_, 4e6, 2.6e9);
    ASSERT_EQ(told.calibrations.size(), 2u);
    EXPECT_EQ(told.calibrations[0].gpuTime, 2'000'000);
    EXPECT_EQ(told.calibrations[0].cpuDelta, 500'000'000);
    EXPECT_EQ(told.calibrations[1].cpuDelta, 100'000'000);
    EXPECT_EQ(told.calibrations[1].context, 3);
}

} // namespace
} // namespace supple::test
