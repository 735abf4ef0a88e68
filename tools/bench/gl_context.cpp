#include "tools/bench/gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <cstring>

namespace supple::bench {

namespace {

template <class Function>
Function loadFunction(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// gl.h of OpenGL 1 lacks them.
constexpr GLenum kTimeElapsed = 0x88BF; // GL_TIME_ELAPSED
constexpr GLenum kQueryResult = 0x8866; // GL_QUERY_RESULT

EGLDisplay openDisplay() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto has = [&](const char* extension) {
        return extensions != nullptr && std::strstr(extensions, extension) != nullptr;
    };
    const auto usable = [](EGLDisplay display) {
        return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE;
    };
    const auto platformDisplay = loadFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (platformDisplay != nullptr && has("EGL_EXT_platform_device") && has("EGL_EXT_device_enumeration")) {
        // A GPU's driver, where there is one; Mesa lists its software renderer last.
        const auto queryDevices = loadFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
        EGLDeviceEXT device = nullptr;
        EGLint count = 0;
        if (queryDevices != nullptr && queryDevices(1, &device, &count) == EGL_TRUE && count == 1) {
            const EGLDisplay display = platformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
            if (usable(display)) {
                return display;
            }
        }
    }
    if (platformDisplay != nullptr && has("EGL_MESA_platform_surfaceless")) {
        const EGLDisplay display = platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (usable(display)) {
            return display;
        }
    }
    return EGL_NO_DISPLAY;
}

} // namespace

Result<std::unique_ptr<GlContext>> GlContext::create() {
    std::unique_ptr<GlContext> gl(new GlContext);
    gl->display_ = openDisplay();
    if (gl->display_ == EGL_NO_DISPLAY) {
        return Error{ErrorCode::unsupported, "EGL has no display without a window"};
    }
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    if (eglBindAPI(EGL_OPENGL_API) == EGL_TRUE) {
        gl->context_ = eglCreateContext(gl->display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    }
    if (gl->context_ == EGL_NO_CONTEXT ||
        eglMakeCurrent(gl->display_, EGL_NO_SURFACE, EGL_NO_SURFACE, gl->context_) != EGL_TRUE) {
        return Error{ErrorCode::unsupported, "EGL has no OpenGL 4.3 context"};
    }
    gl->finish_ = loadFunction<void (*)()>("glFinish");
    const auto getString = loadFunction<const GLubyte* (*)(GLenum)>("glGetString");
    gl->genQueries_ = loadFunction<decltype(gl->genQueries_)>("glGenQueries");
    gl->deleteQueries_ = loadFunction<decltype(gl->deleteQueries_)>("glDeleteQueries");
    gl->beginQuery_ = loadFunction<decltype(gl->beginQuery_)>("glBeginQuery");
    gl->endQuery_ = loadFunction<decltype(gl->endQuery_)>("glEndQuery");
    gl->queryResult_ = loadFunction<decltype(gl->queryResult_)>("glGetQueryObjectui64v");
    if (gl->finish_ == nullptr || getString == nullptr || gl->genQueries_ == nullptr || gl->deleteQueries_ == nullptr ||
        gl->beginQuery_ == nullptr || gl->endQuery_ == nullptr || gl->queryResult_ == nullptr) {
        return Error{ErrorCode::unsupported, "EGL gives no OpenGL functions"};
    }
    for (const GLenum what : {GL_RENDERER, GL_VERSION}) {
        const GLubyte* text = getString(what);
        gl->name_ += std::string(gl->name_.empty() ? "" : ", OpenGL ") +
                     (text == nullptr ? "?" : reinterpret_cast<const char*>(text));
    }
    return gl;
}

Result<double> GlContext::elapsedSeconds(uint32_t times, const std::function<Status()>& work) const {
    uint32_t query = 0;
    genQueries_(1, &query);
    Status status = success();
    double total = 0.0;
    for (uint32_t i = 0; status && i < times; ++i) {
        uint64_t nanoseconds = 0;
        beginQuery_(kTimeElapsed, query);
        status = work();
        endQuery_(kTimeElapsed);
        queryResult_(query, kQueryResult, &nanoseconds); // waits for it
        total += static_cast<double>(nanoseconds);
    }
    deleteQueries_(1, &query);
    if (!status) {
        return status.error();
    }
    return 1e-9 * total / times;
}

GlContext::~GlContext() {
    if (display_ != EGL_NO_DISPLAY) {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT) {
            eglDestroyContext(display_, context_);
        }
        eglTerminate(display_);
    }
}

} // namespace supple::bench
