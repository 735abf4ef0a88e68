#include "sticker.h"

#include "host/must.h"
#include "host/texture.h"
#include "shaders/decal_frag.h"
#include "shaders/decal_vert.h"

#include <algorithm>
#include <optional>

namespace engine {

namespace {

constexpr uint32_t kPixels = 128;
/// In heights of the character: where its chest is, and how large the sticker.
constexpr float kChest = 0.40f, kSize = 0.15f;

/// From a place to a line.
float distanceTo(glm::vec2 at, glm::vec2 from, glm::vec2 to) {
    const float along = glm::clamp(glm::dot(at - from, to - from) / glm::dot(to - from, to - from), 0.0f, 1.0f);
    return glm::distance(at, glm::mix(from, to, along));
}

/// A seven on a disk with a dark rim.
Picture numberPicture() {
    constexpr glm::vec3 kRim{0.10f, 0.13f, 0.30f}, kPaper{0.96f, 0.95f, 0.90f}, kRed{0.75f, 0.10f, 0.13f};
    const auto covered = [](float inside) { return glm::clamp(0.5f + inside * (0.5f * kPixels), 0.0f, 1.0f); };
    Picture picture = Picture::blank(kPixels, kPixels);
    for (uint32_t row = 0; row < kPixels; ++row) {
        for (uint32_t column = 0; column < kPixels; ++column) {
            const glm::vec2 at = (2.0f * glm::vec2(column, row) + 1.0f) / static_cast<float>(kPixels) - 1.0f;
            const float radius = glm::length(at);
            const float stroke = std::min(distanceTo(at, {-0.32f, -0.42f}, {0.32f, -0.42f}),
                                          distanceTo(at, {0.32f, -0.42f}, {-0.10f, 0.48f}));
            glm::vec3 color = glm::mix(kRim, kPaper, covered(0.80f - radius));
            color = glm::mix(color, kRed, covered(0.10f - stroke));
            uint8_t* const pixel = picture.pixel(column, row);
            for (int k = 0; k < 3; ++k)
                pixel[k] = static_cast<uint8_t>(255.0f * color[k]);
            pixel[3] = static_cast<uint8_t>(255.0f * covered(0.95f - radius));
        }
    }
    return picture;
}

/// Where a ray from the front meets the chest, in the bind pose.
std::optional<SuppleSurfacePoint> findChest(const CharacterGroup& group, float& height) {
    SuppleBounds bounds{};
    must(suppleGetGroupClipBounds(group.group.context(), group.group.handle(), SUPPLE_REST_POSE, &bounds),
         "suppleGetGroupClipBounds");
    height = bounds.max[1] - bounds.min[1];
    const float ray[] = {0.5f * (bounds.min[0] + bounds.max[0]),
                         bounds.min[1] + kChest * height,
                         bounds.max[2] + height,
                         0.0f,
                         0.0f,
                         -1.0f};
    auto query = supple::sized<SupplePointQuery>();
    query.kind = SUPPLE_FIND_RAY;
    query.count = 1;
    query.values = ray;
    std::vector<SuppleSurfacePoint> found;
    must(group.group.findPoints(query, found), "suppleFindPoints");
    return found[0].face == SUPPLE_NO_FACE ? std::nullopt : std::optional(found[0]);
}

} // namespace

Sticker::Sticker(Device& device, const Characters& characters, VkDescriptorSetLayout frameLayout, GraphicsDesc scene) {
    setLayout_ =
        must(createSetLayout(device, {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT},
                                      {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT},
                                      {2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT},
                                      {3, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}}));
    layout_ = must(createPipelineLayout(device, {frameLayout, setLayout_}, sizeof(Push), VK_SHADER_STAGE_VERTEX_BIT));
    scene.layout = layout_;
    scene.vertexShader = decal_vert;
    scene.fragmentShader = decal_frag;
    scene.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    scene.depthWrite = false;
    scene.blend = Blend::over;
    pipeline_ = must(createGraphicsPipeline(device, scene));
    const CharacterGroup& walker = characters.groups()[0];
    float height = 1.0f;
    if (const std::optional<SuppleSurfacePoint> chest = findChest(walker, height)) {
        DecalDesc desc;
        desc.at = *chest;
        desc.size = glm::vec2(kSize * height);
        const Decal decal = must(projectDecal(walker.group.context(), walker.group.handle(), desc));
        push_.lift = decal.lift(walker.grid.rate * walker.patchesPerEdge);
        place(device, characters, decal);
    }
}

void Sticker::place(Device& device, const Characters& characters, const Decal& decal) {
    const CharacterGroup& walker = characters.groups()[0];
    auto desc = supple::sized<SupplePointSetDesc>();
    desc.group = walker.group.handle();
    desc.points = decal.points.data();
    desc.pointCount = static_cast<uint32_t>(decal.points.size());
    desc.format = SUPPLE_POINT_FRAME_64;
    must(supple::PointSet::create(characters.context(), desc, points_), "suppleCreatePointSet");
    SupplePointOutput output{};
    must(points_.output(output), "suppleGetPointOutput");
    push_.pointCount = desc.pointCount;
    std::vector<glm::vec4> places;
    for (const Decal::Place& place : decal.places)
        places.emplace_back(place.u, place.v, place.opacity, place.sag);
    places_ =
        must(device.uploadBuffer(places.data(), places.size() * sizeof(glm::vec4), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
    const std::vector<uint32_t> indices = decal.indices();
    indexCount_ = static_cast<uint32_t>(indices.size());
    indices_ =
        must(device.uploadBuffer(indices.data(), indices.size() * sizeof(uint32_t), VK_BUFFER_USAGE_INDEX_BUFFER_BIT));
    picture_ = must(uploadTexture(device, numberPicture()));
    DescriptorPool pool = must(DescriptorPool::create(device, 1));
    set_ = must(pool.allocate(setLayout_));
    pool.write(set_, {storageBuffer(0, walker.info.instances), storageBuffer(1, output.frames),
                      storageBuffer(2, places_.handle(), 0, VK_WHOLE_SIZE),
                      sampledImage(3, picture_, must(createTextureSampler(device)))});
}

void Sticker::draw(VkCommandBuffer commands, VkDescriptorSet frameSet) const {
    if (indexCount_ == 0)
        return;
    const VkDescriptorSet sets[] = {frameSet, set_};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 2, sets, 0, nullptr);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push_, &push_);
    vkCmdBindIndexBuffer(commands, indices_.handle(), 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(commands, indexCount_, 1, 0, 0, 0); // there is one walker
}

} // namespace engine
