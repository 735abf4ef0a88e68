// How the characters are drawn: at levels of detail, or all at one rate.
#pragma once

#include "crowd.h"

#include <memory>
#include <vector>

namespace crowd {

constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

class Characters {
public:
    virtual ~Characters() = default;
    /// Passes that come before the draws of a frame.
    virtual void addToGraph(Graph& graph, Resource buffers) const = 0;
    /// What the draws read.
    [[nodiscard]] virtual std::vector<Use> uses(Resource buffers) const = 0;
    /// `scene`: set 0 of shaders/scene.glsl. `sun`: into the sun's map. `paint`: capacities as colors.
    virtual void draw(VkCommandBuffer commands, VkDescriptorSet scene, bool sun, bool paint) const = 0;
};

[[nodiscard]] std::unique_ptr<Characters> makeLevelCharacters(Device& device, Graph& graph, const Crowd& crowd,
                                                              VkDescriptorSetLayout scene);
[[nodiscard]] std::unique_ptr<Characters> makeFixedCharacters(Device& device, const Crowd& crowd,
                                                              VkDescriptorSetLayout scene);

} // namespace crowd
