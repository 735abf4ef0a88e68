#include "surface/polygons/steps.h"

#include "shaders/shared/specialization.h"
#include "shaders/shared/subdivision.h"

namespace supple::surface::polygons {

namespace {

using namespace shared;

void addAttributes(ProgramBuilder& builder, uint32_t firstVertex) {
    const gpu::Kernel kernel = builder.kernel(SetKind::attributes, Kernel::evaluateAttributes,
                                              {{kKindConstant, kVertexDomain}, {kOutputsConstant, outputsOf(builder)}},
                                              "supple attributes of vertices");
    auto push = pushFor<AttributesPush>(builder.tables.triangles.vertices);
    push.firstVertex = firstVertex;
    builder.add(builder.program.attributes, SetKind::attributes, kernel, builder.lanes(push.count), push);
}

} // namespace

void addSteps(ProgramBuilder& builder) {
    const Section& vertices = builder.tables.triangles.vertices;
    if (vertices.count == 0) {
        return;
    }
    const Evaluation& evaluation = builder.evaluation;
    const uint32_t firstVertex = evaluation.firstVertices.front();
    if (builder.options.attributes) {
        addAttributes(builder, firstVertex);
    }
    for (const ProgramBuilder::VertexPass& pass : builder.vertexPasses()) {
        auto push = pushFor<FragmentPush>(vertices);
        push.verticesPerInstance = evaluation.verticesPerInstance;
        push.firstVertex = firstVertex;
        push.today = builder.options.view && pass.format == kVertexPosition ? 1 : 0;
        const gpu::Kernel kernel = builder.kernel(
            SetKind::subdivide, Kernel::polygonsVertex,
            {{kVertexFormatConstant, pass.format}, {kTangentsConstant, tangentsConstant(builder, pass.format)}},
            "supple evaluate vertices of polygons");
        builder.add(*pass.steps, SetKind::subdivide, kernel, builder.lanes(push.count), push);
    }
}

} // namespace supple::surface::polygons
