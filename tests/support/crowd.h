// Groups driven through the C interface frame by frame, and what a frame left in their buffers.
#pragma once

#include "cage/character.h"
#include "host/group_output.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <functional>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace supple::test {

/// The bytes of a buffer as what it holds.
template <class T>
std::vector<T> as(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) {
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    }
    return values;
}

/// A command buffer that the test submits when it likes, or never. The device must outlive it.
class Commands {
public:
    explicit Commands(host::Device& device);
    ~Commands(); ///< waits when submitted
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    void record(const std::function<void(VkCommandBuffer)>& body); ///< anew; not while submitted
    void submit();
    void wait(); ///< nothing when not submitted

private:
    host::Device& device_;
    VkCommandBuffer buffer_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    bool submitted_ = false;
};

/// A context for groups that are driven frame by frame. The device must outlive it.
class CrowdContext : public LoggedContext {
public:
    explicit CrowdContext(host::Device& device, SuppleMapping mapping = SUPPLE_MAPPING_AUTO,
                          uint32_t framesInFlight = 2, uint32_t flags = 0); ///< SuppleContextFlags

    [[nodiscard]] bool valid() const { return handle() != nullptr; } ///< a failure was recorded when not

    /// The id of the last error since this was asked; 0 when there was none.
    [[nodiscard]] int takeError();

    /// Each file is read once.
    [[nodiscard]] SuppleAsset asset(const std::string& path);
    [[nodiscard]] SuppleAsset createAsset(const cage::Cage& cage);
    [[nodiscard]] SuppleAsset createAsset(const cage::Character& character);
    [[nodiscard]] SuppleAsset createAsset(std::span<const std::byte> glb, const char* name);
    SuppleResult reloadAsset(SuppleAsset asset, const cage::Character& character);

    /// A frame from its beginning until it has run. `first` is what the host records ahead of Supple.
    void run(std::span<const SuppleGroup> groups, const std::function<void(VkCommandBuffer)>& first = {});
    void run(SuppleGroup group, const std::function<void(VkCommandBuffer)>& first = {}) { run({&group, 1}, first); }
    /// What a frame of this group alone uploads, in bytes.
    [[nodiscard]] uint64_t uploadedFor(SuppleGroup group);
    /// A frame that is recorded and cancelled.
    void cancel(std::span<const SuppleGroup> groups);
    void cancel(SuppleGroup group) { cancel({&group, 1}); }
    /// suppleRecord between any host use of the buffers and copies.
    SuppleResult record(VkCommandBuffer commands, std::span<const SuppleGroup> groups);
    void setTime(double seconds) { time_ = seconds; } ///< of the frames that follow

private:
    double time_ = 0.0;
    std::map<std::string, SuppleAsset> assets_;
};

/// A suite's contexts, made when asked for and gone after its last test.
class CrowdContexts : public testing::Test {
protected:
    static void TearDownTestSuite() { contexts().clear(); }
    static CrowdContext& context(SuppleMapping mapping);
    void SetUp() override { ASSERT_NE(testDevice(), nullptr); }

private:
    static std::map<SuppleMapping, std::unique_ptr<CrowdContext>>& contexts();
};

/// Positions as bits.
using PositionBits = std::vector<std::array<uint32_t, 3>>;
/// Those that differ in some bit; all when the lists differ in length.
[[nodiscard]] size_t differences(const PositionBits& a, const PositionBits& b);
[[nodiscard]] std::vector<glm::vec3> asPositions(const PositionBits& bits);

/// A group through the C interface. Failures are recorded in the test; check valid().
class Crowd {
public:
    /// `desc` without structSize.
    Crowd(CrowdContext& context, SuppleGroupDesc desc);
    ~Crowd();
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

    [[nodiscard]] bool valid() const { return group_.id != 0; }
    void end(); ///< destroys the group now
    [[nodiscard]] CrowdContext& context() const { return context_; }
    [[nodiscard]] SuppleGroup group() const { return group_; }
    [[nodiscard]] host::GroupOutput output(uint32_t surface = 0) const; ///< as it is now
    [[nodiscard]] uint32_t clipCount() const { return clipCount_; }

    [[nodiscard]] SuppleInstance spawn();
    void destroy(SuppleInstance instance);
    void setVisible(SuppleInstance instance, bool visible);
    void teleport(SuppleInstance instance);
    void setRate(uint32_t rate);
    void pose(SuppleInstance instance, uint32_t clip, double time, const glm::mat4& transform);

    /// A frame of this group alone, read back.
    void run(const std::function<void(VkCommandBuffer)>& first = {});
    /// Reads what the last frame left.
    void read();
    [[nodiscard]] std::vector<std::byte> read(const SuppleBufferRange& view) const;
    [[nodiscard]] PositionBits positions(uint32_t slot) const { return bits(slot, surface_, surfaceStride_); }
    [[nodiscard]] PositionBits previous(uint32_t slot) const { return bits(slot, previous_, 12); }
    /// What the slot has of a buffer that is counted by slots.
    [[nodiscard]] std::vector<std::byte> slotBytes(const SuppleBufferRange& view, uint32_t slot) const;
    [[nodiscard]] std::vector<uint32_t> listed() const; ///< as many of the list of instances as are drawn
    [[nodiscard]] std::vector<VkDrawIndexedIndirectCommand> draws(uint32_t surface = 0) const;

private:
    [[nodiscard]] PositionBits bits(uint32_t slot, const std::vector<std::byte>& bytes, size_t stride) const;

    CrowdContext& context_;
    SuppleGroup group_{};
    uint32_t clipCount_ = 0;
    std::vector<std::byte> surface_, previous_;
    size_t surfaceStride_ = 0;
    uint32_t vertexCount_ = 0, verticesPerInstance_ = 0;
};

} // namespace supple::test
