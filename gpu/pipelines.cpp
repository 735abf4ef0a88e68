#include "gpu/pipelines.h"

#include <algorithm>
#include <atomic>
#include <new>

namespace supple::gpu {

Result<Kernel> Pipelines::get(const ComputeLayout& layout, const Spirv& spirv, std::span<const Constant> constants,
                              const char* name) {
    Batch batch(*this);
    const Kernel kernel = batch.get(layout, spirv, constants, name);
    if (const Status made = batch.make(); !made) {
        return made.error();
    }
    return kernel;
}

Pipelines::Batch::~Batch() {
    pipelines_.entries_.remove_if([&](const Entry& entry) {
        return entry.pipeline.get() == VK_NULL_HANDLE &&
               std::find(missing_.begin(), missing_.end(), &entry) != missing_.end();
    });
}

Kernel Pipelines::Batch::get(const ComputeLayout& layout, const Spirv& spirv, std::span<const Constant> constants,
                             const char* name) {
    const uint32_t* words = wordsOf(*pipelines_.device_, spirv).data();
    const VkPipelineLayout pipelineLayout = layout.pipelineLayout.get();
    std::list<Entry>& entries = pipelines_.entries_;
    auto entry = std::find_if(entries.begin(), entries.end(), [&](const Entry& known) {
        return wordsOf(*pipelines_.device_, known.spirv).data() == words && known.layout == pipelineLayout &&
               std::equal(known.constants.begin(), known.constants.end(), constants.begin(), constants.end());
    });
    missing_.reserve(missing_.size() + 1); // an entry without a pipeline is always some batch's
    if (entry == entries.end()) {
        entry = entries.insert(entry, Entry{spirv, pipelineLayout, {constants.begin(), constants.end()}, name, {}});
        missing_.push_back(&*entry);
    }
    return Kernel{&entry->pipeline, pipelineLayout};
}

Status Pipelines::Batch::make() {
    const auto count = static_cast<uint32_t>(missing_.size());
    std::vector<Result<PipelineHandle>> made;
    for (const Entry* entry : missing_) {
        made.emplace_back(Error{ErrorCode::argument, "pipeline " + entry->name + ": runJobs has not run its job"});
    }
    std::atomic<bool> outOfMemory{false};
    const std::function<void(uint32_t)> job = [&](uint32_t i) {
        const Entry& entry = *missing_[i];
        try { // the host's threads catch nothing
            made[i] = createComputePipeline(*pipelines_.device_, entry.layout, entry.spirv, entry.constants,
                                            entry.name.c_str());
        } catch (const std::bad_alloc&) {
            outOfMemory = true;
        }
    };
    if (count > 0 && pipelines_.runJobs_) {
        pipelines_.runJobs_(count, job);
    } else {
        for (uint32_t i = 0; i < count && (i == 0 || made[i - 1]); ++i) {
            job(i);
        }
    }
    for (uint32_t i = 0; i < count; ++i) {
        if (made[i]) {
            missing_[i]->pipeline = std::move(*made[i]);
        }
    }
    if (outOfMemory) {
        return Error{ErrorCode::hostMemory, "out of memory for pipelines"};
    }
    const auto failed = std::find_if(made.begin(), made.end(), [](const auto& result) { return !result; });
    return failed == made.end() ? success() : failed->error();
}

} // namespace supple::gpu
