// One cache of compute pipelines. Whoever needs a pipeline asks for it by what it is made of; what exists is found.
#pragma once

#include "base/run_jobs.h"
#include "gpu/pipeline.h"

#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace supple::gpu {

/// The pipelines of one context. Two are the same if their SPIR-V (its address), layout and constants are the same.
/// Any threads may use it at the same time, and none waits while another one compiles, unless both want the same
/// pipeline. Recording does not need it.
class Pipelines {
    struct Entry {
        Spirv spirv;
        VkPipelineLayout layout = VK_NULL_HANDLE;
        std::vector<Constant> constants;
        std::string name;
        PipelineHandle pipeline; ///< empty until a batch has made it
        bool beingMade = false;  ///< some batch will make it, or give it up
        uint32_t waiting = 0;    ///< batches that wait for another one to make it
    };

public:
    /// `runJobs`: makes the pipelines of a batch; empty: one after the other, on the calling thread.
    explicit Pipelines(const Device& device, RunJobs runJobs = {}) : device_(&device), runJobs_(std::move(runJobs)) {}

    /// The pipeline, created if it is not there yet. The SPIR-V's words and the layout must outlive the cache; `name`
    /// is for debuggers, and that of the first call stays.
    [[nodiscard]] Result<Kernel> get(const ComputeLayout& layout, const Spirv& spirv,
                                     std::span<const Constant> constants, const char* name);

    /// Pipelines that are made side by side. A thread has one batch at a time. Until make() succeeds its kernels may
    /// not be used; without it they are void when the batch ends.
    class Batch {
    public:
        explicit Batch(Pipelines& pipelines) : pipelines_(pipelines) {}
        ~Batch();
        Batch(const Batch&) = delete;
        Batch& operator=(const Batch&) = delete;

        [[nodiscard]] Kernel get(const ComputeLayout& layout, const Spirv& spirv, std::span<const Constant> constants,
                                 const char* name);
        /// Makes what is not there, and waits for what batches of other threads make. The error of the first that could
        /// not be made.
        [[nodiscard]] Status make();

    private:
        [[nodiscard]] Status makeMissing();
        /// Waits for the others' until they are there, or takes those over that were given up.
        void awaitOthers();
        /// Gives up what is not made. Under the mutex.
        void giveUp();

        Pipelines& pipelines_;
        std::vector<Entry*> missing_; ///< in the order in which they were asked for
        std::vector<Entry*> others_;  ///< that batches of other threads make
    };

private:
    const Device* device_;
    RunJobs runJobs_;
    std::mutex mutex_; ///< of the entries; not held while pipelines are made
    std::condition_variable changed_;
    std::list<Entry> entries_; ///< a few dozen: a search costs nothing beside a pipeline. Kernels have their addresses
};

} // namespace supple::gpu
