// Budgets of passes: when a warning comes, what is counted. The device's timestamps are made up.
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"
#include "tests/support/wrapped_vulkan.h"

#include <gtest/gtest.h>

namespace supple::test {
namespace {

class Budget : public testing::Test {
protected:
    static void SetUpTestSuite() {
        wrappedVulkan().deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU; // whose timestamps the CPU reads
        device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
        uint32_t count = 0;
        vkGetPhysicalDeviceQueueFamilyProperties(device->physicalDevice(), &count, nullptr);
        std::vector<VkQueueFamilyProperties> families(count);
        vkGetPhysicalDeviceQueueFamilyProperties(device->physicalDevice(), &count, families.data());
        timestamps = families[device->queueFamily()].timestampValidBits > 0;
        period = static_cast<double>(device->properties().limits.timestampPeriod);
        context = std::make_unique<LoggedContext>(*device, [](SuppleContextDesc& desc) {
            desc.framesInFlight = 3;
            desc.mapping = SUPPLE_MAPPING_NARROW;
        });
        ASSERT_EQ(context->result(), SUPPLE_OK);
        ASSERT_EQ(createTube(context->handle(), asset), SUPPLE_OK);
        group = createGroup(context->handle(), asset).group;
    }
    static void TearDownTestSuite() {
        if (device != nullptr) {
            const auto log = device->validation();
            context = nullptr;
            device = nullptr;
            EXPECT_EQ(log->messageCount(), 0u);
        }
    }
    void SetUp() override {
        ASSERT_NE(context, nullptr);
        if (!timestamps) {
            GTEST_SKIP() << "the queue has no timestamps";
        }
        for (const SupplePass pass : {SUPPLE_PASS_ALL, SUPPLE_PASS_DEFORM, SUPPLE_PASS_EVALUATE}) {
            ASSERT_EQ(suppleSetBudget(context->handle(), pass, 0.0), SUPPLE_OK);
        }
        frame(1); // what the test before timed is none of this one's
        context->beginFrame();
        context->takeLines();
    }
    /// A timed frame whose passes take this long each; the frame before is judged in it.
    void frame(uint64_t ticks, uint32_t flags = SUPPLE_RECORD_TIMINGS) {
        context->evaluate({&group, 1}, flags);
        currentWrappedVulkan().ticksAPass = ticks;
    }
    [[nodiscard]] SuppleBudget budget(SupplePass pass, SuppleResult wanted = SUPPLE_OK) const {
        SuppleBudget out{};
        out.structSize = sizeof(out);
        EXPECT_EQ(suppleGetBudget(context->handle(), pass, &out), wanted);
        return out;
    }
    uint32_t warnings() { return context->takeCount(SUPPLE_MESSAGE_BUDGET); }

    static inline std::unique_ptr<host::Device> device;
    static inline std::unique_ptr<LoggedContext> context;
    static inline SuppleAsset asset{};
    static inline SuppleGroup group{};
    static inline double period = 1.0;
    static inline bool timestamps = false;
};

TEST_F(Budget, OneWarningEachTimeAPassComesToExceedIt) {
    ASSERT_EQ(suppleSetBudget(context->handle(), SUPPLE_PASS_EVALUATE, 100.0 * period), SUPPLE_OK);
    const struct {
        uint64_t ticks;
        uint32_t warnings; ///< when the frame after it begins
    } frames[] = {{50, 0}, {150, 1}, {160, 0}, {100, 0}, {101, 1}, {40, 0}, {170, 1}, {120, 0}};
    uint32_t expected = 0;
    for (const auto& f : frames) {
        frame(f.ticks);
        EXPECT_EQ(warnings(), expected) << "before the frame of " << f.ticks;
        expected = f.warnings;
    }
    context->beginFrame();
    EXPECT_EQ(warnings(), 0u);
    const SuppleBudget b = budget(SUPPLE_PASS_EVALUATE);
    EXPECT_DOUBLE_EQ(b.limit, 100.0 * period);
    EXPECT_DOUBLE_EQ(b.latest, 120.0 * period);
    EXPECT_DOUBLE_EQ(b.worst, 170.0 * period);
    EXPECT_EQ(b.framesMeasured, 8u);
    EXPECT_EQ(b.framesOver, 5u);
}

TEST_F(Budget, TheWarningNamesFrameAndPass) {
    ASSERT_EQ(suppleSetBudget(context->handle(), SUPPLE_PASS_DEFORM, 100.0 * period), SUPPLE_OK);
    frame(300);
    const uint64_t slow = context->frame;
    context->beginFrame();
    const std::vector<LogLine> lines = context->takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].severity, SUPPLE_SEVERITY_WARNING);
    EXPECT_EQ(lines[0].message, SUPPLE_MESSAGE_BUDGET);
    EXPECT_NE(lines[0].text.find("frame " + std::to_string(slow) + ": deform took"), std::string::npos)
        << lines[0].text;
}

TEST_F(Budget, OfAllPassesTogether) {
    ASSERT_EQ(suppleSetBudget(context->handle(), SUPPLE_PASS_ALL, 1.0 * period), SUPPLE_OK);
    frame(50);
    context->beginFrame();
    EXPECT_EQ(warnings(), 1u);
    uint32_t passes = 0;
    ASSERT_EQ(suppleGetTimings(context->handle(), sizeof(SuppleTiming), nullptr, &passes), SUPPLE_OK);
    EXPECT_GE(passes, 4u);
    EXPECT_DOUBLE_EQ(budget(SUPPLE_PASS_ALL).latest, 50.0 * passes * period);
    EXPECT_EQ(budget(SUPPLE_PASS_EVALUATE, SUPPLE_NOT_READY).framesMeasured, 0u) << "the others have none";
}

TEST_F(Budget, FramesThatWereNotTimedAreNotCounted) {
    ASSERT_EQ(suppleSetBudget(context->handle(), SUPPLE_PASS_EVALUATE, 100.0 * period), SUPPLE_OK);
    frame(150);
    frame(150, 0);
    frame(150, 0);
    frame(150);
    context->beginFrame();
    EXPECT_EQ(budget(SUPPLE_PASS_EVALUATE).framesMeasured, 2u);
    EXPECT_EQ(warnings(), 1u) << "the timed frame before was over as well";
}

TEST_F(Budget, FramesThatCompleteTogetherAreAllCounted) {
    ASSERT_EQ(suppleSetBudget(context->handle(), SUPPLE_PASS_EVALUATE, 100.0 * period), SUPPLE_OK);
    // Whatever slots the frames take.
    for (uint64_t turn = 0; turn < 3; ++turn) {
        ASSERT_EQ(suppleSetBudget(context->handle(), SUPPLE_PASS_EVALUATE, 100.0 * period), SUPPLE_OK);
        context->beginFrame();
        const uint64_t before = context->frame;
        for (uint64_t f = 1; f <= 2; ++f) {
            ASSERT_EQ(suppleBeginFrame(context->handle(), before + f, before), SUPPLE_OK);
            ASSERT_TRUE(device
                            ->submitAndWait([&](VkCommandBuffer commands) {
                                EXPECT_EQ(context->record(commands, {&group, 1}, SUPPLE_RECORD_TIMINGS), SUPPLE_OK);
                            })
                            .ok());
        }
        currentWrappedVulkan().ticksAPass = 150;
        context->frame = before + 2;
        context->beginFrame();
        EXPECT_EQ(budget(SUPPLE_PASS_EVALUATE).framesMeasured, 2u) << turn;
        EXPECT_EQ(budget(SUPPLE_PASS_EVALUATE).framesOver, 2u) << turn;
        EXPECT_EQ(warnings(), 1u) << turn;
        uint32_t count = 1;
        SuppleTiming timing{};
        EXPECT_EQ(suppleGetTimings(context->handle(), sizeof(SuppleTiming), &timing, &count), SUPPLE_INCOMPLETE);
        EXPECT_EQ(timing.frame, before + 2) << "the newest";
    }
}

TEST_F(Budget, ZeroTakesItAwayAndSettingItBeginsAnew) {
    ASSERT_EQ(suppleSetBudget(context->handle(), SUPPLE_PASS_EVALUATE, 100.0 * period), SUPPLE_OK);
    frame(150);
    frame(150);
    EXPECT_EQ(budget(SUPPLE_PASS_EVALUATE).framesOver, 1u);
    ASSERT_EQ(suppleSetBudget(context->handle(), SUPPLE_PASS_EVALUATE, 0.0), SUPPLE_OK);
    frame(150);
    EXPECT_EQ(budget(SUPPLE_PASS_EVALUATE, SUPPLE_NOT_READY).limit, 0.0);
    warnings();
    frame(150);
    context->beginFrame();
    EXPECT_EQ(warnings(), 0u);
    ASSERT_EQ(suppleSetBudget(context->handle(), SUPPLE_PASS_EVALUATE, 100.0 * period), SUPPLE_OK);
    EXPECT_EQ(budget(SUPPLE_PASS_EVALUATE).framesMeasured, 0u);
    frame(150);
    context->beginFrame();
    EXPECT_EQ(warnings(), 1u);
    EXPECT_EQ(budget(SUPPLE_PASS_EVALUATE).framesMeasured, 1u);
}

TEST_F(Budget, UnknownPassesAreRefused) {
    EXPECT_EQ(suppleSetBudget(context->handle(), SUPPLE_PASS_SHORTFALL, 1.0), SUPPLE_ERROR_ARGUMENT);
    SuppleBudget out{};
    out.structSize = sizeof(out);
    EXPECT_EQ(suppleGetBudget(context->handle(), SUPPLE_PASS_MAX_ENUM, &out), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(context->takeCount(SUPPLE_MESSAGE_OUT_OF_RANGE), 2u);
    for (uint32_t number = SUPPLE_PASS_UPLOAD; number <= SUPPLE_PASS_QUERIES; ++number) {
        const auto pass = static_cast<SupplePass>(number);
        if (pass == SUPPLE_PASS_SHORTFALL) {
            continue;
        }
        EXPECT_EQ(suppleSetBudget(context->handle(), pass, 1e9), SUPPLE_OK) << suppleGetPassName(pass);
        EXPECT_EQ(budget(pass).limit, 1e9);
        EXPECT_EQ(suppleSetBudget(context->handle(), pass, 0.0), SUPPLE_OK);
    }
}

} // namespace
} // namespace supple::test
