#include "surface/programs.h"

#include "shaders/shared/subdivision.h"
#include "surface/fragments/steps.h"
#include "surface/indexed_mesh.h"
#include "surface/lod/steps.h"
#include "surface/polygons/steps.h"
#include "surface/steps.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <vector>

namespace supple::surface {

namespace {

using namespace shared;

static_assert(sizeof(PatchPush) <= sizeof(ConstructPush) && sizeof(EdgePush) <= sizeof(EvaluatePush) &&
              sizeof(LevelsPush) <= sizeof(AttributesPush) && sizeof(DepthPush) <= sizeof(LodPush));

using gpu::narrowTexels;
using gpu::storage;
using gpu::wideStorage;
using SetKind::attributes, SetKind::construct, SetKind::evaluate, SetKind::evaluateLevels, SetKind::levels;
using SetKind::subdivide;

constexpr uint32_t in(std::initializer_list<SetKind> kinds) {
    uint32_t bits = 0;
    for (const SetKind kind : kinds) {
        bits |= 1u << static_cast<uint32_t>(kind);
    }
    return bits;
}
constexpr uint32_t kInAll = (1u << kSetKinds) - 1;

/// What passes bind, and which kinds of sets have it.
constexpr struct {
    gpu::Binding binding;
    uint32_t kinds;
} kResources[] = {
    {gpu::uniform(kTableHeaderBinding), kInAll},
    {wideStorage(kTableBinding), kInAll},
    {narrowTexels(kTable4TexelBinding), kInAll},
    {narrowTexels(kTable1TexelBinding), kInAll},
    {wideStorage(kAlphaBinding), in({construct})},
    {narrowTexels(kAlphaTexelBinding), in({construct})},
    {wideStorage(kCageBinding), in({construct})},
    {narrowTexels(kCageTexelBinding), in({construct})},
    {storage(kPoolBinding), in({construct, levels})},
    {wideStorage(kPoolBinding), in({evaluate, subdivide, evaluateLevels})},
    {narrowTexels(kPoolTexelBinding), in({construct, evaluate, subdivide, evaluateLevels, levels})},
    {wideStorage(kTodaysPoolBinding), in({subdivide, evaluateLevels})},
    {narrowTexels(kTodaysPoolTexelBinding), in({subdivide, evaluateLevels})},
    {storage(kSurfaceBinding), in({evaluate, subdivide, evaluateLevels})},
    {storage(kPatchCoefficientBinding), in({construct})},
    {storage(kAttributeBinding), in({attributes})},
    {storage(kUv1Binding), in({attributes})},
    {storage(kFaceUvBinding), in({attributes})},
    {storage(kTangentBinding), in({evaluate, subdivide, evaluateLevels})},
    {storage(kDirectionBinding), in({evaluate, subdivide, evaluateLevels})},
    {storage(kDirectionOutputBinding), in({attributes})},
    {storage(kPairBinding), in({evaluate, attributes})},
    {storage(kScratchBinding), in({subdivide, levels})},
    {narrowTexels(kScratchTexelBinding), in({subdivide, levels})},
    {wideStorage(kInstanceBinding), in({construct, evaluate, subdivide, evaluateLevels, levels})},
    {narrowTexels(kInstanceTexelBinding), in({construct, evaluate, subdivide, evaluateLevels, levels})},
    {storage(kLodBinding), in({levels})},
    {wideStorage(kLodBinding), in({evaluateLevels, attributes})},
    {narrowTexels(kLodTexelBinding), in({evaluateLevels, attributes, levels})},
};

/// What the solver binds: the view's words.
constexpr gpu::Binding kSolverBindings[] = {storage(kLodBinding)};

constexpr uint32_t storageBuffers(SetKind kind) {
    uint32_t narrow = 0, wide = 0;
    for (const auto& [binding, kinds] : kResources) {
        const uint32_t has = (kinds & in({kind})) != 0 && binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER ? 1 : 0;
        narrow += binding.isIn(false) ? has : 0;
        wide += binding.isIn(true) ? has : 0;
    }
    return std::max(narrow, wide);
}
/// A new stream is one more buffer that evaluation or attributes write. Layouts have room for it, but for those of
/// subdivision and of levels.
static_assert(storageBuffers(evaluate) < gpu::kMaxStorageBuffers &&
              storageBuffers(evaluateLevels) <= gpu::kMaxStorageBuffers &&
              storageBuffers(attributes) < gpu::kMaxStorageBuffers &&
              storageBuffers(subdivide) <= gpu::kMaxStorageBuffers);

/// By SetKind.
constexpr struct {
    uint32_t pushBytes;
    const char* name;
} kLayouts[] = {{sizeof(ConstructPush), "supple surface construction"},
                {sizeof(EvaluatePush), "supple surface"},
                {sizeof(FragmentPush), "supple fragments"},
                {sizeof(LevelsPush), "supple surface at levels"},
                {sizeof(AttributesPush), "supple attributes"},
                {sizeof(LodPush), "supple levels"}};
static_assert(std::size(kLayouts) == kSetKinds);

} // namespace

uint64_t Evaluation::layOut(const Tables& tables, uint64_t first) {
    firstVertices.clear();
    if (!tables.triangles.indices.empty()) {
        firstVertices.push_back(static_cast<uint32_t>(first));
        return first + tables.triangles.vertices.count;
    }
    uint64_t vertices = first;
    const bool shares = tables.hasIndexedMesh();
    for (const PatchRange& range : tables.ranges) {
        const Domain domain = domainOf(range.patchClass);
        firstVertices.push_back(static_cast<uint32_t>(vertices));
        vertices += uint64_t{shares ? interiorCount(domain, rate) : sampleCount(domain, rate)} * range.section.count;
    }
    if (shares) {
        firstEdgeVertex = static_cast<uint32_t>(vertices);
        vertices += uint64_t{rate - 1} * tables.mesh.edgeCount;
        firstCornerVertex = static_cast<uint32_t>(vertices);
        vertices += tables.mesh.cornerCount;
    }
    return vertices;
}

Result<Programs> Programs::create(const gpu::Device& device, gpu::Pipelines& pipelines, const Shaders& shaders) {
    Programs passes;
    passes.device_ = &device;
    passes.pipelines_ = &pipelines;
    passes.shaders_ = shaders;
    for (size_t kind = 0; kind < kSetKinds; ++kind) {
        std::vector<gpu::Binding> bindings;
        for (const auto& [binding, kinds] : kResources) {
            if ((kinds >> kind & 1u) != 0) {
                bindings.push_back(binding);
            }
        }
        Result<gpu::ComputeLayout> layout =
            gpu::ComputeLayout::ofShared(device, bindings, kLayouts[kind].pushBytes, kLayouts[kind].name);
        if (!layout) {
            return layout.error();
        }
        passes.layouts_[kind] = std::move(*layout);
    }
    Result<gpu::ComputeLayout> solver =
        gpu::ComputeLayout::create(device, kSolverBindings, sizeof(LodSolvePush), "supple view");
    if (!solver) {
        return solver.error();
    }
    passes.solverLayout_ = std::move(*solver);
    return passes;
}

Result<Program> Programs::prepare(const Tables& tables, const ProgramOptions& options, const Evaluation& evaluation) {
    ProgramBuilder builder(*device_, layouts_, *pipelines_, shaders_, tables, options, evaluation);
    addConstructions(builder);
    if (options.lod) {
        lod::addSteps(builder);
        addRangesAtLevels(builder);
    } else {
        addRanges(builder);
        fragments::addSteps(builder);
        polygons::addSteps(builder);
    }
    if (const Status made = builder.makePipelines(); !made) {
        return made.error();
    }
    return std::move(builder.program);
}

Result<Programs::Solver> Programs::prepareSolver() {
    gpu::Pipelines::Batch batch(*pipelines_);
    const auto get = [&](Kernel kernel, const char* name) {
        return batch.get(solverLayout_, shaders_[kernel], {}, name);
    };
    const Solver solver{get(Kernel::lodSolve, "supple level budget"), get(Kernel::lodCount, "supple level counts"),
                        get(Kernel::lodBuckets, "supple level buckets")};
    const Status made = batch.make();
    return made ? Result<Solver>(solver) : made.error();
}

} // namespace supple::surface
