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
    const std::scoped_lock lock(pipelines_.mutex_);
    giveUp();
    for (Entry* const entry : others_) {
        --entry->waiting;
    }
    pipelines_.entries_.remove_if([](const Entry& entry) {
        return entry.pipeline.get() == VK_NULL_HANDLE && !entry.beingMade && entry.waiting == 0;
    });
}

void Pipelines::Batch::giveUp() {
    for (Entry* const entry : missing_) {
        entry->beingMade = false;
    }
    missing_.clear();
    pipelines_.changed_.notify_all();
}

Kernel Pipelines::Batch::get(const ComputeLayout& layout, const Spirv& spirv, std::span<const Constant> constants,
                             const char* name) {
    const uint32_t* words = wordsOf(*pipelines_.device_, spirv).data();
    const VkPipelineLayout pipelineLayout = layout.pipelineLayout.get();
    const std::scoped_lock lock(pipelines_.mutex_);
    std::list<Entry>& entries = pipelines_.entries_;
    auto entry = std::find_if(entries.begin(), entries.end(), [&](const Entry& known) {
        return wordsOf(*pipelines_.device_, known.spirv).data() == words && known.layout == pipelineLayout &&
               std::equal(known.constants.begin(), known.constants.end(), constants.begin(), constants.end());
    });
    // Room before anything changes: an entry that is being made is always some batch's.
    missing_.reserve(missing_.size() + 1);
    others_.reserve(others_.size() + 1);
    if (entry == entries.end()) {
        entry = entries.insert(entry,
                               Entry{spirv, pipelineLayout, {constants.begin(), constants.end()}, name, {}, true, 0});
        missing_.push_back(&*entry);
    } else if (entry->pipeline.get() == VK_NULL_HANDLE) {
        const auto has = [&](const std::vector<Entry*>& list) {
            return std::find(list.begin(), list.end(), &*entry) != list.end();
        };
        if (!entry->beingMade) { // given up, and others wait for it
            entry->beingMade = true;
            missing_.push_back(&*entry);
        } else if (!has(missing_) && !has(others_)) {
            ++entry->waiting;
            others_.push_back(&*entry);
        }
    }
    return Kernel{&entry->pipeline, pipelineLayout};
}

Status Pipelines::Batch::make() {
    // Its own first: batches that wait for each other go on.
    Status status = makeMissing();
    while (status && !others_.empty()) {
        awaitOthers();
        status = makeMissing();
    }
    return status;
}

void Pipelines::Batch::awaitOthers() {
    std::unique_lock lock(pipelines_.mutex_);
    missing_.reserve(others_.size());
    pipelines_.changed_.wait(lock, [&] {
        return std::none_of(others_.begin(), others_.end(), [](const Entry* entry) { return entry->beingMade; });
    });
    for (Entry* const entry : others_) {
        --entry->waiting;
        if (entry->pipeline.get() == VK_NULL_HANDLE) {
            entry->beingMade = true;
            missing_.push_back(entry);
        }
    }
    others_.clear();
}

Status Pipelines::Batch::makeMissing() {
    const auto count = static_cast<uint32_t>(missing_.size());
    if (count == 0) {
        return success();
    }
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
    if (pipelines_.runJobs_) {
        pipelines_.runJobs_(count, job);
    } else {
        for (uint32_t i = 0; i < count && (i == 0 || made[i - 1]); ++i) {
            job(i);
        }
    }
    const std::scoped_lock lock(pipelines_.mutex_);
    for (uint32_t i = 0; i < count; ++i) {
        if (made[i]) {
            missing_[i]->pipeline = std::move(*made[i]);
        }
    }
    giveUp();
    if (outOfMemory) {
        return Error{ErrorCode::hostMemory, "out of memory for pipelines"};
    }
    const auto failed = std::find_if(made.begin(), made.end(), [](const auto& result) { return !result; });
    return failed == made.end() ? success() : failed->error();
}

} // namespace supple::gpu
