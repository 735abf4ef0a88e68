#include "surface/program.h"

#include <algorithm>
#include <initializer_list>

namespace supple::surface {

namespace {

std::vector<DispatchSize> sizesOf(std::initializer_list<const Steps*> passes) {
    std::vector<DispatchSize> sizes;
    for (const Steps* steps : passes) {
        for (const Step& step : *steps) {
            if (step.size.isOneGroup()) {
                continue;
            }
            sizes.resize(std::max<size_t>(sizes.size(), step.argument + 1));
            sizes[step.argument] = step.size;
        }
    }
    return sizes;
}

void recordBarrier(gpu::Dispatches& dispatches, Order order) {
    if (order == Order::after) {
        dispatches.computeBarrier();
    } else if (order != Order::free) {
        dispatches.disjointBarrier();
    }
}

/// Whether a step waits for a round of its own.
bool beginsRound(const Step& step) {
    return step.order == Order::disjoint || step.order == Order::after;
}

/// Whether it writes into a pool that other groups have, too.
bool sharesPool(const Step& step, const Window& window) {
    return window.push.pools != 0 && (step.sets == SetKind::construct || step.sets == SetKind::levels);
}

void dispatch(gpu::Dispatches& dispatches, const Step& step, const Window& window) {
    std::array<std::byte, gpu::kPushConstantBytes> words = step.push;
    std::memcpy(words.data(), &window.push, sizeof(window.push));
    const std::span<const std::byte> push = std::span<const std::byte>(words).first(step.pushBytes);
    const gpu::BoundSet& bound = window.sets[static_cast<size_t>(step.sets)];
    if (step.size.isOneGroup()) {
        dispatches.dispatch(step.kernel, bound, push, 1);
    } else if (window.arguments != VK_NULL_HANDLE) {
        dispatches.dispatchIndirect(step.kernel, bound, push, window.arguments,
                                    window.firstArgument + step.argument * window.argumentStride);
    } else {
        const uint64_t elements = uint64_t{step.size.elements} * window.push.instanceCount;
        dispatches.dispatch(step.kernel, bound, push, (elements + step.size.perGroup - 1) / step.size.perGroup);
    }
}

} // namespace

bool Round::advance() {
    if (next == Order::free) {
        return false;
    }
    recordBarrier(dispatches, next);
    ++number;
    next = Order::free;
    return true;
}

void record(Round& round, std::span<const Step> steps, const Window& window) {
    uint32_t number = 0;
    for (const Step& step : steps) {
        number += beginsRound(step) ? 1 : 0;
        if (number > round.number) {
            round.next = std::max(round.next, step.order);
            return;
        }
        if (number == round.number) {
            if (sharesPool(step, window)) {
                round.dispatches.disjointBarrier();
            }
            dispatch(round.dispatches, step, window);
        }
    }
}

void record(gpu::Dispatches& dispatches, std::span<const Step> steps, const Window& window) {
    for (const Step& step : steps) {
        recordBarrier(dispatches, step.order);
        dispatch(dispatches, step, window);
    }
}

void Program::setCamera(const shared::LodCamera& camera) {
    for (Steps* steps : {&edgeLevels, &patchLevels, &depths, &places}) {
        for (Step& step : *steps) {
            std::memcpy(step.push.data() + offsetof(shared::LodPush, camera), &camera, sizeof(camera));
        }
    }
}

std::vector<DispatchSize> Program::constructionSizes() const {
    return sizesOf({&vertex, &assemble, &edgeLevels, &patchLevels, &places});
}

uint32_t Program::constructionCount() const {
    return static_cast<uint32_t>(sizesOf({&vertex, &assemble}).size());
}

std::vector<DispatchSize> Program::evaluationSizes() const {
    return sizesOf({&evaluate});
}

} // namespace supple::surface
