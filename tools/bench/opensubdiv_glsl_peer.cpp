#include "tools/bench/opensubdiv_glsl_peer.h"

#include <EGL/egl.h>
#include <opensubdiv/osd/glComputeEvaluator.h>
#include <opensubdiv/osd/glPatchTable.h>
#include <opensubdiv/osd/glVertexBuffer.h>

namespace supple::bench {

using namespace OpenSubdiv;

namespace {

using Buffer = std::shared_ptr<Osd::GLVertexBuffer>;

Buffer buffer(int elements, size_t count) {
    return Buffer(Osd::GLVertexBuffer::Create(elements, static_cast<int>(count)));
}

std::vector<float> readBack(Osd::GLVertexBuffer& from, size_t floats) {
    constexpr GLenum kArrayBuffer = 0x8892; // GL_ARRAY_BUFFER, which gl.h of OpenGL 1 lacks
    const auto bind = reinterpret_cast<void (*)(GLenum, GLuint)>(eglGetProcAddress("glBindBuffer"));
    const auto read =
        reinterpret_cast<void (*)(GLenum, intptr_t, intptr_t, void*)>(eglGetProcAddress("glGetBufferSubData"));
    std::vector<float> values(floats);
    bind(kArrayBuffer, from.BindVBO());
    read(kArrayBuffer, 0, static_cast<intptr_t>(floats * sizeof(float)), values.data());
    bind(kArrayBuffer, 0);
    return values;
}

/// `ask` hands the work to OpenGL and says whether that went well.
Peer peer(const GlContext& gl, const OpensubdivTables& tables, const char* job, const std::function<bool()>& ask,
          std::function<std::vector<float>()> positions) {
    const auto asked = [ask] {
        return ask() ? success() : Status(Error{ErrorCode::vulkan, "OpenSubdiv's GLComputeEvaluator failed"});
    };
    const auto run = [&gl, asked] {
        const Status status = asked();
        gl.finish();
        return status;
    };
    const auto seconds = [&gl, asked](uint32_t times) { return gl.elapsedSeconds(times, asked); };
    return {peerName(tables.rules) + " GLSL, " + job,
            tables.rules,
            tables.points(),
            run,
            seconds,
            std::move(positions),
            tables.faces};
}

struct GlOutput {
    explicit GlOutput(size_t points) : position(buffer(3, points)), du(buffer(3, points)), dv(buffer(3, points)) {}
    Buffer position, du, dv;
};

} // namespace

Result<std::vector<Peer>> opensubdivGlslPeers(const GlContext& gl,
                                              const std::shared_ptr<const OpensubdivTables>& tables) {
    const size_t points = tables->points(), cageFloats = tables->cage.size(), cagePoints = cageFloats / 3;
    const Osd::BufferDescriptor refined(static_cast<int>(cageFloats), 3, 3);
    // Compiled for these layouts.
    const std::shared_ptr<Osd::GLComputeEvaluator> evaluator(Osd::GLComputeEvaluator::Create(kXyz, kXyz, kXyz, kXyz));
    const std::shared_ptr<Osd::GLComputeEvaluator> refiner(
        Osd::GLComputeEvaluator::Create(kXyz, refined, Osd::BufferDescriptor(), Osd::BufferDescriptor()));
    if (evaluator == nullptr || refiner == nullptr) {
        return Error{ErrorCode::vulkan, "OpenSubdiv's compute shaders do not compile"};
    }
    const std::shared_ptr<Osd::GLStencilTableSSBO> limits(Osd::GLStencilTableSSBO::Create(tables->limitStencils.get()));
    const std::shared_ptr<Osd::GLStencilTableSSBO> stencils(Osd::GLStencilTableSSBO::Create(tables->refinement.get()));
    const std::shared_ptr<Osd::GLPatchTable> patches(Osd::GLPatchTable::Create(tables->patches.get()));
    const Buffer source = buffer(3, cagePoints + static_cast<size_t>(tables->refinement->GetNumStencils()));
    source->UpdateData(tables->cage.data(), 0, static_cast<int>(cagePoints));
    static_assert(sizeof(Osd::PatchCoord) == 5 * sizeof(float));
    const Buffer coordinates = buffer(5, points);
    coordinates->UpdateData(reinterpret_cast<const float*>(tables->coordinates.data()), 0, static_cast<int>(points));

    const auto limitOut = std::make_shared<GlOutput>(points), patchOut = std::make_shared<GlOutput>(points);
    const auto askLimits = [evaluator, limits, source, limitOut] {
        return evaluator->EvalStencils(source.get(), kXyz, limitOut->position.get(), kXyz, limitOut->du.get(), kXyz,
                                       limitOut->dv.get(), kXyz, limits.get());
    };
    const auto askPatches = [evaluator, refiner, refined, stencils, patches, coordinates, source, patchOut, points] {
        return refiner->EvalStencils(source.get(), kXyz, source.get(), refined, stencils.get()) &&
               evaluator->EvalPatches(source.get(), kXyz, patchOut->position.get(), kXyz, patchOut->du.get(), kXyz,
                                      patchOut->dv.get(), kXyz, static_cast<int>(points), coordinates.get(),
                                      patches.get());
    };
    return std::vector<Peer>{peer(gl, *tables, "limit stencils", askLimits,
                                  [limitOut, points] { return readBack(*limitOut->position, 3 * points); }),
                             peer(gl, *tables, "patches", askPatches,
                                  [patchOut, points] { return readBack(*patchOut->position, 3 * points); })};
}

} // namespace supple::bench
