// An OpenGL context without a window, through EGL: what OpenSubdiv's GLSL evaluator runs in. Only where EGL is
// installed.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace supple::bench {

/// Current on the thread that made it, for as long as it lives. One at a time.
class GlContext {
public:
    /// On Mesa without a surface, else on EGL's first device. The error says what there is none of.
    [[nodiscard]] static Result<std::unique_ptr<GlContext>> create();
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// GL_RENDERER and GL_VERSION.
    [[nodiscard]] const std::string& name() const { return name_; }
    /// Waits for all that was asked for so far.
    void finish() const { finish_(); }
    /// Mean seconds of so many runs of `work`, by GL_TIME_ELAPSED, waiting for the end of each. llvmpipe gives 0 for
    /// compute shaders. The first failure of `work` ends it.
    [[nodiscard]] Result<double> elapsedSeconds(uint32_t times, const std::function<Status()>& work) const;

private:
    GlContext() = default;

    void* display_ = nullptr; ///< EGLDisplay
    void* context_ = nullptr; ///< EGLContext
    void (*finish_)() = nullptr;
    void (*genQueries_)(int count, uint32_t* queries) = nullptr;
    void (*deleteQueries_)(int count, const uint32_t* queries) = nullptr;
    void (*beginQuery_)(uint32_t target, uint32_t query) = nullptr;
    void (*endQuery_)(uint32_t target) = nullptr;
    void (*queryResult_)(uint32_t query, uint32_t what, uint64_t* value) = nullptr;
    std::string name_;
};

} // namespace supple::bench
