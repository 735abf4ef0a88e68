// A group whose characters play a clip on the device, after its first frame, and the parts of its frames that are
// measured.
#pragma once

#include "tools/bench/replay.h"
#include "tools/bench/workbench.h"

#include <memory>
#include <vector>

namespace supple::bench {

/// A crowd's vertices take at most one part in this many of the device's memory. What is written beside them takes as
/// much.
inline constexpr VkDeviceSize kCrowdShareOfMemory = 4;

/// The size of the largest heap on the device, in bytes.
[[nodiscard]] VkDeviceSize deviceMemory(const host::Device& device);

enum class Passes {
    evaluate, ///< the evaluation alone
    skin,     ///< sampling poses and deforming the cage
    frame     ///< sampling poses to evaluation
};

/// Destroyed when this goes.
class PlayingGroup {
public:
    PlayingGroup(host::Device& device, Workbench& workbench) : device_(device), workbench_(workbench) {}
    ~PlayingGroup();
    PlayingGroup(const PlayingGroup&) = delete;
    PlayingGroup& operator=(const PlayingGroup&) = delete;

    /// `desc` has an asset, a scheme, a rate and how many characters.
    [[nodiscard]] Status create(SuppleGroupDesc desc);

    [[nodiscard]] host::GroupOutput output() const { return workbench_.output(group_); }
    [[nodiscard]] Workbench::StaticBytes staticBytes() const { return workbench_.staticBytes(group_); }
    /// Surface vertices of all characters.
    [[nodiscard]] uint64_t vertices() const { return uint64_t{output().grid.vertexCount} * output().info.capacity; }
    [[nodiscard]] Result<std::unique_ptr<Replay>> replay(Passes passes) const;
    /// Of an instance, as the device has them.
    [[nodiscard]] Result<std::vector<std::byte>> verticesOf(uint32_t instance) const;
    [[nodiscard]] Result<std::vector<std::byte>> deformedCageOf(uint32_t instance) const;

private:
    host::Device& device_;
    Workbench& workbench_;
    SuppleGroup group_{};
};

} // namespace supple::bench
