// A group whose characters play a clip on the device, after its first frame, and the parts of its frames that are
// measured.
#pragma once

#include "tools/bench/replay.h"
#include "tools/bench/workbench.h"

#include <memory>
#include <vector>

namespace supple::bench {

/// How many characters fit, at most `wanted`, from the bytes that one takes in all and in its largest buffer. A crowd
/// takes at most a quarter of the device's memory: what is written beside it takes as much.
[[nodiscard]] uint32_t charactersThatFit(const host::Device& device, VkDeviceSize bytes, VkDeviceSize largestBuffer,
                                         uint32_t wanted);

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
