#include "surface/fragments/steps.h"

#include "shaders/shared/specialization.h"
#include "shaders/shared/subdivision.h"

#include <algorithm>

namespace supple::surface::fragments {

using namespace subdivision;

namespace {

using namespace shared;

/// Small fragments must not hold the memory of large ones, or too few fit on a compute unit at a time.
constexpr uint32_t kBucketBytes[] = {4096, 16384, 32768, 49152};
constexpr uint32_t kPointBytes = 12;

/// The points that the smallest bucket with room for `sharedPoints` has; 0: none has.
uint32_t bucketFor(const gpu::Device& device, uint32_t sharedPoints) {
    for (const uint32_t bytes : kBucketBytes) {
        if (device.mapping.wide && bytes <= device.limits.maxComputeSharedMemorySize &&
            sharedPoints <= bytes / kPointBytes) {
            return bytes / kPointBytes;
        }
    }
    return 0;
}

/// Blocks of one step and kind from class `first` on.
Section blocksFrom(const Fragments& fragments, size_t first, size_t kind) {
    Section all = fragments.classes[first].blocks[kind];
    for (size_t c = first + 1; c < fragments.classes.size(); ++c) {
        all.count += fragments.classes[c].blocks[kind].count;
    }
    return all;
}

/// Makes the steps of one vertex pass.
class Evaluator {
public:
    Evaluator(ProgramBuilder& builder, const ProgramBuilder::VertexPass& pass)
        : builder_(builder), fragments_(builder.tables.fragments), format_(pass.format), steps_(*pass.steps),
          tangents_(tangentsConstant(builder, format_)), net_(format_ == kVertexPosition ? kFromPastNet : kFromNet) {
        const Evaluation& evaluation = builder.evaluation;
        push_.verticesPerInstance = evaluation.verticesPerInstance;
        push_.samples = sampleCount(Domain::quad, evaluation.rate);
        push_.firstVertex = evaluation.firstVertices.empty() ? 0 : evaluation.firstVertices.front();
        push_.today = builder.options.view && format_ == kVertexPosition ? 1 : 0;
    }

    void addAll() {
        const size_t stepwise = addInWorkgroups();
        if (stepwise < fragments_.classes.size()) {
            builder_.program.scratchStride = fragments_.steps > 0 ? fragments_.scratchStride : 0;
            addStepwise(stepwise);
        }
    }

private:
    /// Classes that a workgroup has room for; returns the first that it has none for. Those of one bucket follow each
    /// other, and go together.
    size_t addInWorkgroups() {
        size_t c = 0;
        push_.step = fragments_.steps;
        while (c < fragments_.classes.size()) {
            const uint32_t points = bucketFor(builder_.device, fragments_.classes[c].sharedPoints);
            if (points == 0) {
                break;
            }
            push_.table = fragments_.classes[c].fragments.table;
            push_.count = 0;
            for (; c < fragments_.classes.size() &&
                   bucketFor(builder_.device, fragments_.classes[c].sharedPoints) == points;
                 ++c) {
                push_.count += fragments_.classes[c].fragments.count;
            }
            add(builder_.kernel(SetKind::subdivide, Kernel::fragmentsFragment,
                                {{kVertexFormatConstant, format_},
                                 {kTangentsConstant, tangents_},
                                 {kWorkgroupPointsConstant, points}},
                                "supple subdivision, shared memory"),
                {push_.count, 1}, Order::free);
        }
        return c;
    }

    void addStepwise(size_t first) {
        // The level that is read is the isolated one in the first step, and in the limit where there is none.
        gpu::Kernel refine[kSources][kWorkKinds], limit[kWorkKinds];
        for (uint32_t kind = 0; kind < kWorkKinds; ++kind) {
            for (const uint32_t source : {kFromScratch, net_}) {
                if (fragments_.steps > (source == kFromScratch ? 1u : 0u)) {
                    refine[source][kind] = builder_.kernel(SetKind::subdivide, Kernel::fragmentsRefine,
                                                           {{kSourceConstant, source}, {kWorkConstant, kind}},
                                                           "supple subdivision, refine");
                }
            }
            limit[kind] = builder_.kernel(SetKind::subdivide, Kernel::fragmentsLimit,
                                          {{kVertexFormatConstant, format_},
                                           {kTangentsConstant, tangents_},
                                           {kSourceConstant, fragments_.steps == 0 ? net_ : kFromScratch},
                                           {kWorkConstant, kind}},
                                          "supple subdivision, limit");
        }
        Order order = Order::free;
        for (uint32_t step = 1; step <= fragments_.steps; ++step) {
            push_.step = step;
            addWork(refine[step == 1 ? net_ : kFromScratch], first, step - 1, order);
        }
        push_.step = fragments_.steps;
        addWork(limit, first, fragments_.steps, order);
    }

    /// All kinds of work of a step, the limit being the last one: they write other runs of the scratch buffer than they
    /// read. A step reads what the one before wrote.
    void addWork(const gpu::Kernel (&kernels)[kWorkKinds], size_t first, uint32_t step, Order& order) {
        for (uint32_t kind = 0; kind < kWorkKinds; ++kind) {
            const Section blocks = blocksFrom(fragments_, first, step * kWorkKinds + kind);
            if (blocks.count > 0) {
                push_.table = blocks.table;
                push_.count = blocks.count;
                add(kernels[kind], builder_.lanes(blocks.count * kBlockLanes), order);
                order = Order::disjoint;
            }
        }
        order = order == Order::free ? order : Order::after;
    }

    void add(const gpu::Kernel& kernel, DispatchSize size, Order order) {
        builder_.add(steps_, SetKind::subdivide, kernel, size, push_, static_cast<uint32_t>(steps_.size()), order);
    }

    ProgramBuilder& builder_;
    const Fragments& fragments_;
    uint32_t format_;
    Steps& steps_;
    uint32_t tangents_;
    uint32_t net_; ///< where the isolated level is read
    FragmentPush push_{};
};

} // namespace

void addSteps(ProgramBuilder& builder) {
    for (const ProgramBuilder::VertexPass& pass : builder.vertexPasses()) {
        Evaluator(builder, pass).addAll();
    }
}

} // namespace supple::surface::fragments
