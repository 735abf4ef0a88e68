// A view and its camera, for tests.
#pragma once

#include "tests/support/crowd.h"

#include <cstdlib>
#include <cstring>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::test {

class TestView {
public:
    TestView(CrowdContext& context, uint32_t maxVertices, uint32_t flags = 0, uint32_t maxRuns = 0,
             uint64_t coefficientBytes = defaultCoefficientBytes())
        : context_(context) {
        SuppleViewDesc desc{};
        desc.structSize = sizeof(desc);
        desc.flags = flags;
        desc.maxVertices = maxVertices;
        desc.vertexFormat = SUPPLE_VERTEX_24;
        desc.maxRuns = maxRuns;
        desc.coefficientBytes = coefficientBytes;
        EXPECT_EQ(suppleCreateView(context.handle(), &desc, &view_), SUPPLE_OK);
        camera.structSize = sizeof(camera);
        camera.pixelsPerUnit = 869.0f; // 720 lines, 45 degrees
    }
    ~TestView() { EXPECT_EQ(suppleDestroyView(context_.handle(), view_), SUPPLE_OK); }
    TestView(const TestView&) = delete;
    TestView& operator=(const TestView&) = delete;

    SuppleCameraDesc camera{};
    void look(glm::vec3 from) {
        camera.position[0] = from.x;
        camera.position[1] = from.y;
        camera.position[2] = from.z;
        EXPECT_EQ(suppleSetCamera(context_.handle(), view_, &camera), SUPPLE_OK);
    }
    /// Up is +y.
    void look(const glm::vec3& from, const glm::vec3& to, const glm::mat4& projection) {
        const glm::mat4 seen = projection * glm::lookAt(from, to, glm::vec3(0.0f, 1.0f, 0.0f));
        std::memcpy(camera.viewProjection, &seen, sizeof seen);
        look(from);
    }
    [[nodiscard]] SuppleView handle() const { return view_; }
    [[nodiscard]] SuppleViewStatistics statistics() const {
        SuppleViewStatistics statistics{};
        statistics.structSize = sizeof(statistics);
        EXPECT_EQ(suppleGetViewStatistics(context_.handle(), view_, &statistics), SUPPLE_OK);
        return statistics;
    }

private:
    /// SUPPLE_TEST_VIEW_COEFFICIENTS: what suites give their views that do not say it.
    [[nodiscard]] static uint64_t defaultCoefficientBytes() {
        const char* asked = std::getenv("SUPPLE_TEST_VIEW_COEFFICIENTS");
        return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 0;
    }

    CrowdContext& context_;
    SuppleView view_{};
};

} // namespace supple::test
