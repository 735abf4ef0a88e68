// Draws the characters, once into the sun's depths and once into the picture, with a floor and a backdrop.
#pragma once

#include "camera.h"
#include "characters.h"
#include "materials.h"
#include "picture.h"

#include <memory>

namespace qt_quick {

class Painter {
public:
    explicit Painter(const Gpu& gpu);
    void destroy();

    /// After Characters::choose has made a new group: its materials, and sets of its buffers. The old ones go when the
    /// frames up to lastFrame are complete.
    void bind(const Characters& characters, Retired& retired, uint64_t lastFrame);
    /// Behind Characters::record, outside of a render pass.
    void draw(VkCommandBuffer commands, const Characters& characters, const Picture& picture,
              const FrameUniforms& uniforms, Retired& retired, uint64_t frame);

private:
    /// What belongs to a group.
    struct Bound {
        VkDescriptorPool pool = VK_NULL_HANDLE;
        std::vector<VkDescriptorSet> surfaces;
        std::vector<VkDescriptorSet> textures;
        std::shared_ptr<Materials> materials;
    };

    void unbind(Retired& retired, uint64_t lastFrame);
    void writeUniforms(VkCommandBuffer commands, const FrameUniforms& uniforms) const;
    void drawSurface(VkCommandBuffer commands, const Surface& surface, uint32_t number, bool colors) const;

    Gpu gpu_;
    Pipelines pipelines_;
    SunMap sun_;
    Buffer uniforms_;
    VkDescriptorPool framePool_ = VK_NULL_HANDLE;
    VkDescriptorSet frameSet_ = VK_NULL_HANDLE;
    Bound bound_;
};

} // namespace qt_quick
