#include "runtime/culling/bounds_kernels.h"

#include "gpu/tasks.h"
#include "shaders/bounds_bounds_comp.h"
#include "shaders/bounds_demand_comp.h"
#include "shaders/bounds_list_comp.h"
#include "shaders/bounds_rates_comp.h"
#include "shaders/bounds_size_comp.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace supple::runtime {

using namespace supple::shared;

static_assert(sizeof(ListWindow) == 16 && sizeof(ListArgument) == 16 && sizeof(ListDraw) == 16 &&
              sizeof(ListPart) == 16);

namespace {

constexpr uint32_t kPushBytes = std::max({sizeof(BoundsPush), sizeof(ListPush), sizeof(DemandPush), sizeof(RatesPush)});
static_assert(kPushBytes <= gpu::kPushConstantBytes);

} // namespace

size_t listTableBytes(size_t windows, size_t arguments, size_t draws, size_t parts) {
    return windows * sizeof(ListWindow) + arguments * sizeof(ListArgument) + draws * sizeof(ListDraw) +
           parts * sizeof(ListPart);
}

void writeListTable(std::span<const ListWindow> windows, std::span<const ListArgument> arguments,
                    std::span<const ListDraw> draws, std::span<const ListPart> parts, std::byte* target) {
    const auto put = [&](std::span<const std::byte> bytes) { target = std::copy(bytes.begin(), bytes.end(), target); };
    put(std::as_bytes(windows));
    put(std::as_bytes(arguments));
    put(std::as_bytes(draws));
    put(std::as_bytes(parts));
}

std::array<float, 24> frustumPlanes(const std::array<float, 16>& columns) {
    const auto row = [&](size_t r) {
        return std::array<float, 4>{columns[r], columns[4 + r], columns[8 + r], columns[12 + r]};
    };
    const std::array<float, 4> x = row(0), y = row(1), z = row(2), w = row(3);
    std::array<float, 24> planes{};
    for (size_t c = 0; c < 4; ++c) { // -w <= x <= w, -w <= y <= w, 0 <= z <= w
        const float sides[6] = {w[c] + x[c], w[c] - x[c], w[c] + y[c], w[c] - y[c], z[c], w[c] - z[c]};
        for (size_t k = 0; k < 6; ++k) {
            planes[4 * k + c] = sides[k];
        }
    }
    return planes;
}

Result<BoundsKernels> BoundsKernels::create(const gpu::Device& device, gpu::Pipelines& pipelines) {
    using gpu::narrowTexels, gpu::storage, gpu::wideStorage;
    const gpu::Binding bounds[] = {
        wideStorage(kBoundsCageBinding), narrowTexels(kBoundsCageTexelBinding),
        storage(kBoundsBinding),         storage(kBoundsStateBinding),
        wideStorage(kHostListBinding),   narrowTexels(kHostListTexelBinding),
        storage(kCullViewBinding),       storage(kWantedBinding),
    };
    const gpu::Binding list[] = {
        storage(kBoundsBinding),       storage(kBoundsStateBinding),        narrowTexels(kBoundsStateTexelBinding),
        wideStorage(kHostListBinding), narrowTexels(kHostListTexelBinding), storage(kListBinding),
        storage(kListArgumentBinding), storage(kListTableBinding),          storage(kSizeBinding),
        storage(kViewWordsBinding),
    };
    BoundsKernels made;
    made.device_ = &device;
    made.pipelines_ = &pipelines;
    Status status = success();
    const auto makeLayout = [&](gpu::ComputeLayout& target, std::span<const gpu::Binding> bindings, const char* name) {
        Result<gpu::ComputeLayout> made = gpu::ComputeLayout::ofShared(device, bindings, kPushBytes, name);
        status = made ? success() : made.error();
        if (made) {
            target = std::move(*made);
        }
    };
    makeLayout(made.boundsLayout_, bounds, "supple bounds");
    if (status) {
        makeLayout(made.listLayout_, list, "supple list");
    }
    if (!status) {
        return status.error();
    }
    return made;
}

BoundsKernels::Kernels BoundsKernels::kernels(gpu::Pipelines::Batch& batch) const {
    return {batch.get(boundsLayout_, bounds_bounds_comp, {}, "supple bounds"),
            batch.get(listLayout_, bounds_size_comp, {}, "supple sizes of instances"),
            batch.get(listLayout_, bounds_list_comp, {}, "supple list of instances")};
}

BoundsKernels::RateKernels BoundsKernels::rateKernels(gpu::Pipelines::Batch& batch) const {
    return {batch.get(listLayout_, bounds_demand_comp, {}, "supple demand of rates"),
            batch.get(listLayout_, bounds_rates_comp, {}, "supple lists of rates")};
}

Status BoundsKernels::make(bool rates) const {
    gpu::Pipelines::Batch batch(*pipelines_);
    (void)kernels(batch);
    if (rates) {
        (void)rateKernels(batch);
    }
    return batch.make();
}

Status BoundsKernels::prepare() {
    gpu::Pipelines::Batch batch(*pipelines_);
    const Kernels found = kernels(batch);
    Status made = batch.make();
    kernels_ = made ? found : kernels_;
    return made;
}

Status BoundsKernels::prepareRates() {
    gpu::Pipelines::Batch batch(*pipelines_);
    const RateKernels found = rateKernels(batch);
    Status made = batch.make();
    rateKernels_ = made ? found : rateKernels_;
    return made;
}

template <class Push>
void BoundsKernels::record(gpu::Dispatches& dispatches, const gpu::Kernel& kernel, const gpu::BoundSet& set,
                           const Push& push, uint64_t groups) const {
    if (groups > 0) {
        dispatches.dispatch(kernel, set, push, groups);
    }
}

uint64_t BoundsKernels::groupsFor(uint32_t lanes) const {
    return (uint64_t{lanes} + device_->mapping.localSize - 1) / device_->mapping.localSize;
}

void BoundsKernels::recordBounds(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const BoundsPush& push) const {
    record(dispatches, kernels_.bounds, set, push,
           device_->mapping.wide ? push.instanceCount : groupsFor(push.instanceCount));
}

void BoundsKernels::recordSizes(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const SizePush& push) const {
    record(dispatches, kernels_.sizes, set, push, groupsFor(push.instanceCount));
}

void BoundsKernels::recordDemand(gpu::Dispatches& dispatches, const gpu::BoundSet& set, const DemandPush& push) const {
    record(dispatches, rateKernels_.demand, set, push, groupsFor(push.instanceCount));
}

void BoundsKernels::recordList(gpu::Dispatches& dispatches, const gpu::BoundSet& set, ListPush push) const {
    push.maxGroups = gpu::maxGroupsInX(*device_);
    record(dispatches, kernels_.list, set, push, 1);
}

void BoundsKernels::recordRates(gpu::Dispatches& dispatches, const gpu::BoundSet& set, RatesPush push) const {
    push.maxGroups = gpu::maxGroupsInX(*device_);
    record(dispatches, rateKernels_.rates, set, push, 1);
}

void BoundsKernels::recordWarmUp(VkCommandBuffer commandBuffer, const gpu::BoundSet& ofWindow,
                                 const gpu::BoundSet& ofGroup) const {
    gpu::OwnDispatches dispatches(*device_, commandBuffer);
    const std::array<std::byte, kPushBytes> push{};
    for (const gpu::Kernel* kernel :
         {&kernels_.bounds, &kernels_.sizes, &kernels_.list, &rateKernels_.demand, &rateKernels_.rates}) {
        if (kernel->pipeline != nullptr) { // rates are made when a group has some
            dispatches->computeBarrier();
            dispatches->dispatch(*kernel, kernel == &kernels_.bounds ? ofWindow : ofGroup,
                                 std::span<const std::byte>(push), 0);
        }
    }
}

} // namespace supple::runtime
