// An OpenGL context without a window, through EGL: what OpenSubdiv's GLSL evaluator runs in. Only where EGL is
// installed.
#pragma once

#include "base/result.h"

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

private:
    GlContext() = default;

    void* display_ = nullptr; ///< EGLDisplay
    void* context_ = nullptr; ///< EGLContext
    void (*finish_)() = nullptr;
    std::string name_;
};

} // namespace supple::bench
