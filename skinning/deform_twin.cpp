#include "skinning/deform_twin.h"

#include "shaders/shared/deform.h"
#include "shaders/shared/fitted_rotation.h"

namespace supple::twin {

using namespace shared;

namespace {

/// What GLSL has from shaders/deform/deform.comp.
struct DeformCode {
    const uint32_t* tableWords = nullptr;
    const glm::vec4* poseElements = nullptr;
    DeformPush push;
    bool kMorphs = false;
    uint kSkinning = kLinearSkinning;
    static constexpr bool kMush = true;

    [[nodiscard]] uvec4 table(uint i) const {
        const uint32_t* const w = tableWords + 4 * size_t{i};
        return {w[0], w[1], w[2], w[3]};
    }
    [[nodiscard]] vec4 pose(uint i) const { return poseElements[i]; }
#include "shaders/deform/skin.h"
};

} // namespace
} // namespace supple::twin

namespace supple::skinning {

void deformLikeTheDevice(const DeformTable& table, const PoseLayout& layout, std::span<const glm::vec4> pose,
                         std::span<glm::vec4> cage) {
    twin::DeformCode code{
        table.words.data(), pose.data(), {}, table.firstInfluences != 0, static_cast<uint32_t>(layout.mode)};
    code.push.firstCenter = table.firstCenter;
    code.push.morphWeights = layout.morphWeights;
    code.push.firstInfluences = table.firstInfluences;
    for (uint32_t vertex = 0; vertex < cage.size(); ++vertex) {
        cage[vertex] = code.deformedVertex(vertex, 0);
    }
}

} // namespace supple::skinning
