// One instance evaluated on the device in one frame, and what it wrote read back.
#pragma once

#include "host/group_output.h"
#include "tools/common/transition_setting.h"
#include "tools/supple/session.h"

#include <cstddef>
#include <cstring>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace supple::tools {

/// `output` lives as long as the session's context.
struct EvaluatedSurface {
    host::GroupOutput output{};
    std::vector<SupplePatchInfo> patches;
    std::vector<uint8_t> mirrored;     ///< per patch: 1 if the pose mirrors it (Evaluation::mirroredFaces)
    std::vector<std::byte> vertices;   ///< SUPPLE_VERTEX_24
    std::vector<std::byte> attributes; ///< these are empty where the group was made without
    std::vector<std::byte> uvs1;
    std::vector<std::byte> tangents;
    std::vector<std::byte> gridIndices;
    std::vector<std::byte> coefficients;

    /// Whether the pose mirrors a patch of a range; or a triangle of a mesh of SUPPLE_SCHEME_POLYGONS, whose patches
    /// are its triangles.
    [[nodiscard]] bool isMirrored(const SuppleDrawRange& range, uint64_t patch, size_t triangle) const {
        const bool mesh = range.domain == SUPPLE_DOMAIN_MESH;
        return mirrored[mesh ? range.firstIndex / 3 + triangle : range.firstPatch + patch] != 0;
    }
};
struct Evaluation {
    std::vector<EvaluatedSurface> surfaces; ///< one or more
    std::vector<std::byte> deformedCage;
    /// Per face of the cage: 1 if the pose mirrors it (host::shared::isMirrored). Winding and normals of what the
    /// device wrote show the inside of such a face as the outside.
    std::vector<uint8_t> mirroredFaces;
};

/// The first floats of element `index` of a buffer that was read back.
template <class Vec>
[[nodiscard]] Vec element(const std::vector<std::byte>& bytes, const SuppleBufferRange& view, size_t index,
                          size_t byteOffset = 0) {
    Vec value;
    std::memcpy(&value, bytes.data() + index * view.stride + byteOffset, sizeof value);
    return value;
}

struct Pose {
    uint32_t clip = SUPPLE_BIND_POSE;
    double time = 0.0;
    std::vector<float> morphWeights;                   ///< of all targets, instead of the clip's; empty: the clip's
    std::vector<SuppleModifier> modifiers;             ///< of any pose but the bind pose, which then is the rest pose
    std::optional<host::PlannedTransition> transition; ///< instead of the clip
    uint32_t updateInterval = 0; ///< steps of 1/60 s from pose to pose, with a clip; 0: the pose itself
    double simulate = 0.0;       ///< seconds that the clip has played in a loop while springs swung; 0: nothing swings
};

/// `asset` is of `character`. `groupFlags`: SuppleGroupFlags. `prepare`: what the group gets before its frame.
[[nodiscard]] Result<Evaluation> evaluate(Session& session, SuppleAsset asset, const cage::Character& character,
                                          const SurfaceFlags& surface, const Pose& pose, uint32_t groupFlags,
                                          const std::function<Status(SuppleGroup)>& prepare = {});

} // namespace supple::tools
