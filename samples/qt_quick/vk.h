// Vulkan with its prototypes, ahead of Qt, whose headers leave them out (VK_NO_PROTOTYPES) and have functions of Vulkan
// 1.0 alone. Every file here begins with it. And how the sample stops.
#pragma once

#include <supple/supple.hpp>
#include <vulkan/vulkan.h>

#include <cstdio>
#include <cstdlib>

namespace qt_quick {

// The sample stops at the first failure. Not by exit(): it would destroy Qt's objects under a running render thread.
[[noreturn]] inline void fail(const char* what, int exitCode = 1) {
    std::fprintf(stderr, "supple_qt_quick: %s\n", what);
    std::fflush(nullptr);
    std::_Exit(exitCode);
}

inline void must(VkResult result, const char* what) {
    if (result != VK_SUCCESS) {
        std::fprintf(stderr, "VkResult %d\n", static_cast<int>(result));
        fail(what);
    }
}

inline void must(SuppleResult result, const char* what) {
    if (result != SUPPLE_OK) {
        std::fprintf(stderr, "%s\n", suppleResultString(result));
        fail(what);
    }
}

} // namespace qt_quick
