// Groups whose passes are recorded apart. The one file of the benchmark that knows the runtime's inside: the public
// interface records whole frames.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "host/device.h"
#include "host/group_output.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <supple/supple.h>
#include <supple/supple_queries.h>
#include <vector>

namespace supple::runtime {
struct Prepared;
}

namespace supple::bench {

/// A patch over a face of four sides.
struct QuadPatch {
    uint32_t face = 0;
    std::array<uint32_t, 4> corners{}; ///< cage vertices, in the order of the domain
};

class Workbench {
public:
    [[nodiscard]] static Result<std::unique_ptr<Workbench>> create(const SuppleContextDesc& desc);
    ~Workbench();
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;

    [[nodiscard]] Result<SuppleAsset> createAsset(cage::Character character);
    /// What supplePrepare does of a character that is read, for a group of createGroup. Null: it is refused.
    [[nodiscard]] std::shared_ptr<const runtime::Prepared> prepare(cage::Character character,
                                                                   const SuppleGroupDesc& desc) const;
    /// Evaluates all vertices of a surface with their normals on the calling thread, at a patch rate, in the bind pose.
    /// Refuses schemes without an evaluator.
    [[nodiscard]] static Result<std::function<void()>> cpuGrid(cage::Character character, SuppleScheme scheme,
                                                               uint32_t rate);
    [[nodiscard]] Result<SuppleAsset> createAsset(std::shared_ptr<const runtime::Prepared> prepared);
    /// A group with as many instances as it has room for, one where desc.capacity is 0. `desc.asset` is one of
    /// createAsset's. All are in the bind pose; or, with SUPPLE_POSES_PLAYBACK, instance i plays the first clip, in a
    /// loop, from phaseOf(i) of its length on.
    /// `updateInterval`: SupplePlaybackDesc.updateInterval.
    [[nodiscard]] Result<SuppleGroup> createGroup(SuppleGroupDesc desc, uint32_t updateInterval = 0);
    /// Scatters so many points over the group's surfaces: SUPPLE_POINT_FRAME_48. They go with the group.
    [[nodiscard]] Status scatterPoints(SuppleGroup group, uint32_t count);
    /// For so many rays a frame at a group. It goes with destroy().
    [[nodiscard]] Result<SuppleQueryPool> createQueryPool(SuppleGroup group, uint32_t rayCount);
    /// Behind recordFrame of the group. Hits are not read back.
    [[nodiscard]] Status recordQueries(SuppleQueryPool pool, VkCommandBuffer commands, std::span<const SuppleRay> rays);
    /// What suppleFindPoints does with rays, six numbers each, and a deformed cage.
    [[nodiscard]] Status findRays(SuppleGroup group, std::span<const glm::vec3> cage,
                                  std::span<const float> rays) const;
    /// Of a group that plays.
    void setTime(SuppleGroup group, double seconds);
    /// Irrational steps: no two instances have a pose in common, and an instance's does not hang on how many there are.
    [[nodiscard]] static double phaseOf(uint32_t instance);
    /// Bytes of static data a frame uploads at most; 0: no bound.
    [[nodiscard]] Status setUploadBudget(uint64_t bytes);
    /// Whether the group's static data is on the device.
    [[nodiscard]] bool isThere(SuppleGroup group) const;
    /// With a camera that sees what lies about the origin.
    /// Its camera sees everything.
    [[nodiscard]] Result<SuppleView> createView(SuppleViewDesc desc);
    /// The camera sees what is far behind it alone, and no longer what stands about the origin.
    void lookAway(SuppleView view);
    /// The camera sees what stands about the origin alone.
    void lookAhead(SuppleView view);
    /// A camera that looks ahead does not see the instance in the slot any more.
    void moveBehind(SuppleGroup group, uint32_t slot);
    void moveTo(SuppleGroup group, uint32_t slot, const glm::dvec3& position);
    /// Their memory is freed in a later frame.
    void destroy(SuppleAsset asset);
    void destroy(SuppleGroup group);
    void destroy(SuppleView view);
    void destroy(SuppleQueryPool pool);

    /// What suppleBeginFrame and suppleRecord do, all earlier frames being done. `flags`: SuppleRecordDesc.flags.
    [[nodiscard]] Status recordFrame(SuppleGroup group, VkCommandBuffer commands, uint32_t flags = 0);
    /// As suppleGetTimings has them when a frame begins.
    [[nodiscard]] const std::vector<SuppleTiming>& timings() const;
    /// Bytes that are never mapped (SuppleMemoryUse.deviceLocal).
    [[nodiscard]] uint64_t deviceMemoryOf(SuppleGroup group) const;
    /// What the newest completed frame wrote.
    [[nodiscard]] uint32_t verticesOf(SuppleView view) const;
    /// A frame of suppleRecordWarmUp alone.
    [[nodiscard]] Status recordWarmUp(SuppleGroup group, VkCommandBuffer commands);
    /// The evaluation alone, from the coefficients of the last frame.
    void recordEvaluate(SuppleGroup group, VkCommandBuffer commands) const;
    /// The patches of a class that a group at a rate has.
    struct ClassRange {
        size_t index = 0;      ///< among the dispatches of evaluation
        uint32_t patches = 0;  ///< 0: there are none
        uint64_t vertices = 0; ///< of an instance
    };
    /// `patchClass`: a name of surface/patch_class.h; empty: all patches.
    [[nodiscard]] ClassRange rangeOf(SuppleGroup group, const std::string& patchClass) const;
    /// The evaluation of these alone.
    void recordEvaluate(SuppleGroup group, VkCommandBuffer commands, const ClassRange& range) const;
    /// Deformation alone; of groups that play, from sampling their poses on.
    void recordSkin(SuppleGroup group, VkCommandBuffer commands) const;
    /// Deformation to evaluation with the barriers between, the pose staying as it was uploaded; of groups that play,
    /// from sampling their poses on. Groups without a view.
    void recordCompute(SuppleGroup group, VkCommandBuffer commands) const;

    [[nodiscard]] host::GroupOutput output(SuppleGroup group) const;
    /// The group's first patches that are plain bicubic ones.
    [[nodiscard]] uint32_t regularPatches(SuppleGroup group) const;
    /// Every patch; none if one of them is not a whole face of four sides.
    [[nodiscard]] std::vector<QuadPatch> quadPatches(SuppleGroup group) const;
    /// The cage's face of every patch.
    [[nodiscard]] std::vector<uint32_t> patchFaces(SuppleGroup group) const;

    struct StaticBytes {
        uint64_t deform = 0;  ///< weights and morph targets
        uint64_t tables = 0;  ///< of the scheme, corner attributes among them
        uint64_t indices = 0; ///< the group's own: the triangles of a patch, for every rate that may be set
        uint64_t group = 0;   ///< all that the group holds
    };
    [[nodiscard]] StaticBytes staticBytes(SuppleGroup group) const;

private:
    struct Inside;
    Workbench();
    std::unique_ptr<Inside> inside_;
};

} // namespace supple::bench
