// Instances of a character made by hand, posed and deformed on the device: the runtime below its C interface.
#pragma once

#include "cage/character.h"
#include "runtime/context.h"
#include "tests/support/gpu_surface.h"

#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace supple::test {

/// A context below the C interface, and the frames it has seen. The device must outlive it.
struct PosedContext {
    PosedContext(host::Device& device, SuppleMapping mapping);

    host::Device& device;
    std::unique_ptr<runtime::Context> context; ///< null, with a failure recorded, when it could not be made
    uint64_t frame = 0;
};

struct PosedOptions {
    SuppleSkinning skinning = SUPPLE_SKINNING_LINEAR;
    uint32_t instanceCount = 1;
};

/// The deformed cage alone. Failures are recorded in the test; check valid().
class PosedGroup {
public:
    PosedGroup(PosedContext& context, cage::Character character, const PosedOptions& options);
    ~PosedGroup();
    PosedGroup(const PosedGroup&) = delete;
    PosedGroup& operator=(const PosedGroup&) = delete;

    [[nodiscard]] bool valid() const { return group_ != nullptr; }
    [[nodiscard]] const cage::Character& character() const { return group_->asset().character; }
    [[nodiscard]] runtime::HostPoses& poses() { return *group_->poses().host(); }

    /// Runs a frame and reads the cages back.
    void deform();
    [[nodiscard]] const std::vector<glm::vec3>& cage(uint32_t instance) const { return cages_[instance]; }
    /// By vertex: -1 where the pose mirrors, else 1.
    [[nodiscard]] const std::vector<float>& sides(uint32_t instance) const { return sides_[instance]; }

private:
    void create(cage::Character character, const PosedOptions& options);

    PosedContext& shared_;
    uint64_t assetId_ = 0;
    SuppleGroup handle_{};
    std::shared_ptr<runtime::Group> group_;
    std::vector<std::vector<glm::vec3>> cages_;
    std::vector<std::vector<float>> sides_;
};

} // namespace supple::test
