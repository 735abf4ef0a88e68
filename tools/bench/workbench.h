// Groups of one instance, whose passes are recorded apart. The one file of the benchmark that knows the runtime's
// inside: the public interface records whole frames.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "tools/host/device.h"

#include <cstdint>
#include <memory>
#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::bench {

class Workbench {
public:
    [[nodiscard]] static Result<std::unique_ptr<Workbench>> create(const SuppleContextDesc& desc);
    ~Workbench();
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;

    [[nodiscard]] Result<SuppleAsset> createAsset(cage::Character character);
    /// A group with one instance in the bind pose. `desc.asset` is one of createAsset's.
    [[nodiscard]] Result<SuppleGroup> createGroup(SuppleGroupDesc desc);
    /// Their memory is freed in a later frame.
    void destroy(SuppleAsset asset);
    void destroy(SuppleGroup group);

    /// What suppleBeginFrame and suppleRecord do, all earlier frames being done. Timestamps off.
    [[nodiscard]] Status recordFrame(SuppleGroup group, VkCommandBuffer commands);
    /// The evaluation alone, from the coefficients of the last frame.
    void recordEvaluate(SuppleGroup group, VkCommandBuffer commands) const;
    /// Deformation to evaluation with the barriers between; the pose stays as it was uploaded.
    void recordCompute(SuppleGroup group, VkCommandBuffer commands) const;

    [[nodiscard]] const SuppleGroupOutput& output(SuppleGroup group) const;
    /// The group's first patches that are plain bicubic ones.
    [[nodiscard]] uint32_t regularPatches(SuppleGroup group) const;
    /// The cage's face of every patch.
    [[nodiscard]] std::vector<uint32_t> patchFaces(SuppleGroup group) const;

    struct StaticBytes {
        uint64_t deform = 0; ///< weights and morph targets
        uint64_t tables = 0; ///< of the scheme, corner attributes among them
        uint64_t group = 0;  ///< all that the group holds for its one instance
    };
    [[nodiscard]] StaticBytes staticBytes(SuppleGroup group) const;

private:
    struct Inside;
    Workbench();
    std::unique_ptr<Inside> inside_;
};

} // namespace supple::bench
