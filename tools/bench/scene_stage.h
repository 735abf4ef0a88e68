// Many different characters in one context, as a host has them: each an asset and a group of its own.
#pragma once

#include "base/result.h"
#include "host/device.h"
#include "tools/bench/command_watch.h"
#include "tools/bench/counted_memory.h"

#include <memory>
#include <string>
#include <supple/supple.hpp>
#include <vector>

namespace supple::bench {

struct SceneUse {
    bool inView = false; ///< levels of detail; else one rate
    bool played = false; ///< the device plays clips; else the host sets every pose
};

/// What a host did for a frame.
struct SceneFrame {
    WatchedCommands commands;
    double setMicroseconds = 0.0;    ///< CPU time of setting poses or the time
    double recordMicroseconds = 0.0; ///< CPU time of suppleRecord
};

/// One at a time lives, as it watches the commands.
class SceneStage {
public:
    /// Segments along a patch edge where there is no view.
    static constexpr uint32_t kRate = 4;
    static constexpr uint32_t kInstances = 3; ///< of a character

    [[nodiscard]] static Result<std::unique_ptr<SceneStage>> create(host::Device& device, SuppleMapping mapping,
                                                                    SceneUse use);
    SceneStage(const SceneStage&) = delete;
    SceneStage& operator=(const SceneStage&) = delete;

    /// So many different characters, three of each, on a square before the camera. ErrorCode::limit: the view has no
    /// room for so many.
    [[nodiscard]] Status build(uint32_t characters);
    /// Another view of all characters, from the same place.
    [[nodiscard]] Status addView();
    /// Nobody stands before the cameras any more.
    [[nodiscard]] Status lookAway();
    /// Destroys the characters and all views.
    [[nodiscard]] Status clear();

    /// Poses, records, submits and waits.
    [[nodiscard]] Result<SceneFrame> frame(uint32_t recordFlags = 0);
    /// CPU time of suppleRecord, in microseconds, in a frame that never runs. Before it the host does work of its own,
    /// which writes so many bytes. Some frames must have run since build().
    [[nodiscard]] Result<double> recordBehindWork(size_t bytes);
    /// Of the last frame, which was recorded with SUPPLE_RECORD_TIMINGS.
    [[nodiscard]] Result<std::vector<SuppleTiming>> timings();
    /// Whether a timing is of a view that addView() has added.
    [[nodiscard]] bool isOfFurtherView(const SuppleTiming& timing) const;
    /// Surface vertices of the last frame, in all views.
    [[nodiscard]] Result<uint64_t> vertices();
    [[nodiscard]] Result<SuppleMemoryUse> memory();
    [[nodiscard]] const CountedMemory& countedMemory() const { return memory_; }

private:
    struct Character {
        supple::Asset asset;
        supple::Group group;
        std::vector<supple::Instance> instances;
        double duration = 1.0; ///< of the clip
    };
    struct FurtherView {
        supple::View view;
        std::vector<supple::Group> groups; ///< which follow those of the characters
    };

    SceneStage(host::Device& device, SceneUse use) : device_(device), use_(use), memory_(device) {}
    static void log(SuppleSeverity severity, SuppleMessage message, const char* text, void* user);
    [[nodiscard]] Status check(SuppleResult result, const char* call);
    [[nodiscard]] Status beginFrame();
    [[nodiscard]] Status createView(supple::View& view);
    [[nodiscard]] Status setCamera(const supple::View& view, bool away);
    [[nodiscard]] Status createCharacter(uint32_t number);
    [[nodiscard]] Status createInstance(Character& character, uint32_t place);
    [[nodiscard]] Status pose();
    /// Half the side of the square.
    [[nodiscard]] float reach() const;

    host::Device& device_;
    SceneUse use_;
    CommandWatch watch_;
    CountedMemory memory_;
    std::string lastError_;
    supple::Context context_;
    supple::View view_;
    uint32_t characterCount_ = 0; ///< that build() was asked for
    std::vector<Character> characters_;
    std::vector<FurtherView> further_;
    std::vector<SuppleGroup> recorded_;
    uint64_t frame_ = 0;
    double time_ = 0.0;
    std::vector<uint64_t> work_; ///< memory of recordBehindWork
};

} // namespace supple::bench
