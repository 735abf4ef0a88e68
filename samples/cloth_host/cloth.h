// Cloth that the host simulates on the device, and the smooth surface that Supple makes of it. The control cage is a
// grid of quads with sharp corners; a compute shader of the host's moves its points straight in
// SuppleGroupInfo.deformedCage.
#pragma once

#include "host/pipelines.h"

#include <supple/supple.hpp>

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace cloth {

using namespace supple::host;

inline constexpr uint32_t kColumns = 25; ///< of points, away from the pinned edge
inline constexpr uint32_t kRows = 17;    ///< along it
inline constexpr float kSpacing = 0.1f;  ///< metres between points

/// Where a sheet is pinned, and which way it is laid out at first. The shader's Sheet.
struct Sheet {
    glm::vec4 origin; ///< w: spacing along the pinned edge, as a share of kSpacing
    glm::vec4 along;  ///< w: how light it is in the wind
    glm::vec4 down;
    glm::uvec4 slot;
};

class Cloth {
public:
    /// `record`: a file for a recording, or empty.
    Cloth(Device& device, uint32_t rate, const std::string& record);

    void beginFrame(uint64_t frame, uint64_t completed) const;
    /// Moves the cloth by a frame, then lets Supple make the surface, for draws as vertex shader reads. All barriers
    /// round the two are recorded too.
    void record(VkCommandBuffer commands, double seconds);
    const SuppleGroupInfo& info() const { return info_; }
    /// The only one: arrays are an asset of one part.
    const SuppleSurfaceInfo& surface() const { return surface_; }
    const SuppleVertexStreams& streams() const { return streams_; }
    const SuppleGridOutput& grid() const { return grid_; }

private:
    void createSupple(Device& device, uint32_t rate, const std::string& record);
    void createSimulation(Device& device);
    void simulate(VkCommandBuffer commands, double seconds);

    supple::Context context_;
    supple::Asset asset_;
    supple::Group group_;
    std::array<supple::Instance, 2> sheets_;
    SuppleGroupInfo info_{};
    SuppleSurfaceInfo surface_{};
    SuppleVertexStreams streams_{};
    SuppleGridOutput grid_{};

    Buffer sheetBuffer_;
    Buffer pointBuffer_; ///< positions and velocities: the host's own
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    bool begun_ = false;
};

} // namespace cloth
