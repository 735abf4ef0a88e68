#include "skinning/deform_kernels.h"

#include "shaders/deform_deform_comp.h"
#include "shaders/deform_gather_comp.h"
#include "shaders/shared/specialization.h"
#include "skinning/bits.h"

#include <algorithm>
#include <cstring>

namespace supple::skinning {
namespace {

using namespace shared;

static_assert(sizeof(DeformPush) <= gpu::kPushConstantBytes);
static_assert(sizeof(Affine) == 48);

constexpr size_t kElementBytes = 16;

/// The displacements of every vertex, target by target.
struct Displacements {
    struct One {
        uint32_t target = 0;
        glm::vec3 delta{0.0f};
    };
    std::vector<uint32_t> starts; ///< vertexCount + 1 entries
    std::vector<One> list;
};

Displacements displacementsOf(uint32_t vertexCount, const cage::Morphs& morphs) {
    Displacements result;
    result.starts.assign(size_t{vertexCount} + 1, 0);
    for (const cage::MorphTarget& target : morphs.targets) {
        for (const uint32_t vertex : target.vertices) {
            ++result.starts[vertex + 1];
        }
    }
    for (uint32_t v = 0; v < vertexCount; ++v) {
        result.starts[v + 1] += result.starts[v];
    }
    result.list.resize(result.starts.back());
    std::vector<uint32_t> next(result.starts.begin(), result.starts.end() - 1);
    for (uint32_t t = 0; t < morphs.targets.size(); ++t) {
        const cage::MorphTarget& target = morphs.targets[t];
        for (size_t i = 0; i < target.vertices.size(); ++i) {
            result.list[next[target.vertices[i]]++] = {t, target.deltas[i]};
        }
    }
    return result;
}

/// transform * joint, both affine.
Affine placed(const glm::mat4& transform, const Affine& joint) {
    Affine result;
    for (int row = 0; row < 3; ++row) {
        result.rows[row] =
            transform[0][row] * joint.rows[0] + transform[1][row] * joint.rows[1] + transform[2][row] * joint.rows[2];
        result.rows[row].w += transform[3][row];
    }
    return result;
}

} // namespace

DeformTable buildDeformTable(const cage::Cage& cage, const cage::SkinWeights& weights, const cage::Morphs& morphs) {
    const uint32_t vertexCount = cage.vertexCount();
    const Displacements displacements = displacementsOf(vertexCount, morphs);
    std::vector<uint32_t> vertices, runs, firstInfluences;
    vertices.reserve(4 * (size_t{vertexCount} + 1));
    runs.reserve(4 * displacements.list.size() + 2 * weights.influences.size());
    const auto nextElement = [&] { return static_cast<uint32_t>(vertexCount + 1 + runs.size() / 4); };
    std::vector<cage::Influence> own;
    for (uint32_t v = 0; v < vertexCount; ++v) {
        const glm::vec3& p = cage.positions[v];
        vertices.insert(vertices.end(), {bits(p.x), bits(p.y), bits(p.z), nextElement()});
        for (uint32_t i = displacements.starts[v]; i < displacements.starts[v + 1]; ++i) {
            const auto& [target, delta] = displacements.list[i];
            runs.insert(runs.end(), {target, bits(delta.x), bits(delta.y), bits(delta.z)});
        }
        firstInfluences.push_back(nextElement());
        own.assign(weights.influences.begin() + weights.starts[v], weights.influences.begin() + weights.starts[v + 1]);
        const auto heaviest =
            std::max_element(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; });
        std::rotate(own.begin(), heaviest, heaviest + 1);
        for (size_t i = 0; i < own.size(); i += 2) {
            const cage::Influence second = i + 1 < own.size() ? own[i + 1] : cage::Influence{own[i].joint, 0.0f};
            runs.insert(runs.end(), {own[i].joint, bits(own[i].weight), second.joint, bits(second.weight)});
        }
    }
    vertices.insert(vertices.end(), {0u, 0u, 0u, nextElement()});

    DeformTable table;
    table.words = std::move(vertices);
    table.words.insert(table.words.end(), runs.begin(), runs.end());
    if (!displacements.list.empty()) {
        table.firstInfluences = static_cast<uint32_t>(table.words.size() / 4);
        table.words.insert(table.words.end(), firstInfluences.begin(), firstInfluences.end());
        table.words.resize((table.words.size() + 3) / 4 * 4, 0u);
    }
    return table;
}

PoseLayout PoseLayout::of(SkinningMode mode, uint32_t jointCount, uint32_t morphCount) {
    PoseLayout layout{mode, jointCount, morphCount, 0, 0, 0};
    layout.morphWeights = mode == SkinningMode::linear
                              ? kLinearElements * jointCount
                              : kDualQuaternionTransform + kDualQuaternionElements * jointCount;
    layout.stride = layout.runStride = layout.morphWeights + (morphCount + 3) / 4;
    return layout;
}

void writePose(const PoseLayout& layout, const InstancePose& pose, std::byte* target) {
    const auto put = [&target](const void* source, size_t bytes) {
        if (bytes > 0) { // an empty list has no address to copy from
            std::memcpy(target, source, bytes);
        }
        target += bytes;
    };
    if (layout.mode == SkinningMode::dualQuaternion) {
        const Affine transform = toAffine(pose.transform);
        put(&transform, sizeof(transform));
        for (size_t j = 0; j < pose.palette.size(); ++j) {
            put(&pose.palette[j], sizeof(Affine));
            put(&pose.rotations[j], sizeof(glm::vec4));
        }
    } else if (pose.transform == glm::mat4(1.0f)) {
        put(pose.palette.data(), pose.palette.size_bytes());
    } else {
        for (const Affine& own : pose.palette) {
            const Affine joint = placed(pose.transform, own);
            put(&joint, sizeof(joint));
        }
    }
    put(pose.morphWeights.data(), layout.morphCount * sizeof(float));
    std::memset(target, 0, (layout.stride - layout.morphWeights) * kElementBytes - layout.morphCount * sizeof(float));
}

Result<DeformKernels> DeformKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines) {
    const gpu::Binding bindings[] = {
        gpu::wideStorage(kDeformTableBinding),    gpu::narrowTexels(kDeformTableTexelBinding),
        gpu::wideStorage(kPoseBinding),           gpu::narrowTexels(kPoseTexelBinding),
        gpu::storage(kDeformedCageBinding),       gpu::wideStorage(kInstanceBinding),
        gpu::narrowTexels(kInstanceTexelBinding),
    };
    DeformKernels made;
    made.device_ = &device;
    made.pipelines_ = &pipelines;
    Result<gpu::ComputeLayout> layout =
        gpu::ComputeLayout::ofShared(device, bindings, sizeof(DeformPush), "supple deform");
    if (!layout) {
        return layout.error();
    }
    made.layout_ = std::move(*layout);
    return made;
}

Result<gpu::Kernel> DeformKernels::make(SkinningMode mode, bool morphs) const {
    constexpr const char* kNames[2][2] = {
        {"supple deform", "supple deform, morphs"},
        {"supple deform, dual quaternions", "supple deform, dual quaternions, morphs"}};
    const auto m = static_cast<uint32_t>(mode), t = uint32_t{morphs};
    const gpu::Constant constants[] = {{kMorphsConstant, t}, {kDualQuaternionsConstant, m}};
    return pipelines_->get(layout_, deform_deform_comp, constants, kNames[m][t]);
}

Result<gpu::Kernel> DeformKernels::makeGather() const {
    return pipelines_->get(layout_, deform_gather_comp, {}, "supple gather");
}

Status DeformKernels::prepare(SkinningMode mode, bool morphs) {
    const Result<gpu::Kernel> kernel = make(mode, morphs);
    if (!kernel) {
        return kernel.error();
    }
    kernels_[static_cast<size_t>(mode)][morphs ? 1 : 0] = *kernel;
    return success();
}

Status DeformKernels::prepareGather() {
    const Result<gpu::Kernel> kernel = makeGather();
    if (!kernel) {
        return kernel.error();
    }
    gather_ = *kernel;
    return success();
}

void DeformKernels::record(gpu::Dispatches& dispatches, const gpu::BoundSet& set, SkinningMode mode,
                           const shared::DeformPush& push) const {
    record(dispatches, kernels_[static_cast<size_t>(mode)][push.firstInfluences != 0 ? 1 : 0], set, push);
}

void DeformKernels::recordGather(gpu::Dispatches& dispatches, const gpu::BoundSet& set,
                                 const shared::DeformPush& push) const {
    record(dispatches, gather_, set, push);
}

void DeformKernels::record(gpu::Dispatches& dispatches, const gpu::Kernel& kernel, const gpu::BoundSet& set,
                           const shared::DeformPush& push) const {
    const uint64_t lanes = uint64_t{push.vertexCount} * push.instanceCount;
    const uint64_t local = device_->mapping.localSize;
    dispatches.dispatch(kernel, set, push, (lanes + local - 1) / local);
}

} // namespace supple::skinning
