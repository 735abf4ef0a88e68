// Makes the calls of a recording again, on a context of its own.
#pragma once

#include "base/result.h"
#include "host/context.h"
#include "runtime/recording/recording_file.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace supple::tools {

/// The hashes of a frame, by the handles that the recording has.
struct ReplayedFrame {
    uint64_t number = 0;
    std::vector<runtime::StageHash> hashes;
};

class Replayer {
public:
    struct Options {
        SuppleMapping mapping = SUPPLE_MAPPING_AUTO; ///< AUTO: that of the recording
        /// Characters of recordings without: cooked files, or whatever suppleCreateAsset reads.
        std::vector<std::pair<std::string, std::vector<std::byte>>> characters;
        /// Most bytes of device memory: small files can ask for much.
        VkDeviceSize memory = VkDeviceSize{4} << 30;
    };
    /// The device must outlive it.
    [[nodiscard]] static Result<std::unique_ptr<Replayer>>
    create(host::Device& device, const runtime::RecordedContext& recorded, Options options);
    ~Replayer();
    Replayer(const Replayer&) = delete;
    Replayer& operator=(const Replayer&) = delete;

    /// Does what the event says. Frames run when the next one begins, or in finish().
    [[nodiscard]] Status play(const runtime::RecordingEvent& event);
    /// Runs what is left.
    [[nodiscard]] Status finish();

    /// For frames that were completed since the last call.
    [[nodiscard]] std::vector<ReplayedFrame> takeHashes();
    /// The frame that has begun last.
    [[nodiscard]] uint64_t frame() const { return frame_; }
    /// "group 2 (pip)", of a handle in the recording.
    [[nodiscard]] std::string nameOf(SuppleGroup recorded) const;
    /// Whether the recording has all that the words depend on: not what the host fills, and not a depth pyramid.
    [[nodiscard]] bool isComparable(const runtime::StageHash& hash) const;
    /// What the recording lacks, in one line each.
    [[nodiscard]] const std::vector<std::string>& lacks() const { return lacks_; }

private:
    struct Character {
        std::string name;
        std::vector<std::byte> bytes; ///< empty: the recording has them not
    };
    struct Group {
        SuppleGroup own{};
        size_t number = 0;
        std::string name;
        uint64_t view = 0; ///< of the recording
        bool isFilledByHost = false;
    };
    struct View {
        SuppleView own{};
        bool lacksSomething = false; ///< that decides what it draws
    };
    using InstanceKey = std::tuple<uint64_t, uint32_t, uint32_t>;
    [[nodiscard]] static InstanceKey keyOf(const SuppleInstance& instance) {
        return {instance.group.id, instance.slot, instance.generation};
    }
    using HashKey = std::pair<uint64_t, uint64_t>;

    class Calls; ///< one for each

    Replayer(host::Device& device, Options options) : device_(device), options_(std::move(options)) {}
    [[nodiscard]] Status startHashes();
    [[nodiscard]] Status prepareCharacters();
    /// The command buffer of the frame, which has begun.
    [[nodiscard]] Result<VkCommandBuffer> commands();
    /// Submits what was recorded, and waits for it.
    [[nodiscard]] Status run();
    void dropCommands();
    /// What is to be taken for a character that the recording has not: a file of the same name.
    [[nodiscard]] Character ofSameName(const std::string& name);
    /// Notes once what the recording lacks.
    void lack(const std::string& what);
    /// Whether the recording has made the group. One that began late lacks groups that followed one which was gone.
    [[nodiscard]] bool knows(SuppleGroup recorded);
    template <class Load>
    [[nodiscard]] Status load(const runtime::calls::AssetHash& hash, uint64_t clipPoolBytes, Load&& load);

    // The own handles; those of nothing if the recording's are not known, which every call refuses.
    [[nodiscard]] SuppleAsset own(SuppleAsset recorded) const;
    [[nodiscard]] SuppleGroup own(SuppleGroup recorded) const;
    [[nodiscard]] SuppleView own(SuppleView recorded) const;
    [[nodiscard]] SuppleInstance own(const SuppleInstance& recorded) const;
    [[nodiscard]] std::vector<SuppleGroup> own(std::span<const SuppleGroup> recorded); ///< those that it knows

    host::Device& device_;
    Options options_;
    std::unique_ptr<host::Context> context_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    bool hasCommands_ = false;
    uint64_t frame_ = 0;
    std::map<HashKey, Character> characters_;
    std::map<uint64_t, std::pair<SuppleAsset, std::string>> assets_; ///< by the recording's handles, as all here
    std::map<uint64_t, Group> groups_;
    std::map<uint64_t, View> views_;
    std::map<InstanceKey, SuppleInstance> instances_;
    std::map<uint64_t, SupplePointSet> pointSets_;
    std::map<uint64_t, SuppleQueryPool> queryPools_;
    std::map<uint64_t, SuppleGroup> recordedGroups_; ///< by own handles
    size_t groupCount_ = 0;
    std::vector<std::string> lacks_;
    std::vector<std::byte> written_; ///< by the recording of this replay
};

} // namespace supple::tools
