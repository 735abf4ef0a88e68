// A prop that a character holds, drawn as docs/integration.md says: by the transform that the CPU gives and by the
// palette on the device. The prop has the shape of a part of the cage that follows one joint alone, so that both must
// cover the same pixels as that part of the deformed cage.
#include "cage/gltf/reader.h"
#include "shaders/prop_frag.h"
#include "shaders/prop_vert.h"
#include "shaders/prop_vert_DUAL_QUATERNIONS.h"
#include "shaders/prop_vert_PLACED.h"
#include "shaders/prop_vert_SKINNED.h"
#include "tests/support/canvas.h"
#include "tests/support/crowd.h"
#include "tests/support/sample_assets.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <supple/supple.hpp>

namespace supple::test {
namespace {

/// Triangles of the cage that follow one joint alone.
struct Part {
    uint32_t joint = 0;
    std::vector<uint32_t> corners; ///< three a triangle
};

/// Of the joint that has most of them.
Part largestPart(const cage::Character& character) {
    std::vector<Part> parts(character.skin.joints.size());
    const auto onlyJoint = [&](uint32_t vertex) {
        const cage::SkinWeights& weights = character.weights;
        const uint32_t first = weights.starts[vertex];
        return weights.starts[vertex + 1] - first == 1 ? weights.influences[first].joint : cage::kNone;
    };
    const cage::Cage& cage = character.cage;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const std::span<const uint32_t> own(cage.faceVertices.data() + cage.faceStarts[face], cage.sides(face));
        const uint32_t joint = onlyJoint(own[0]);
        if (joint == cage::kNone || !std::ranges::all_of(own, [&](uint32_t v) { return onlyJoint(v) == joint; })) {
            continue;
        }
        for (size_t i = 2; i < own.size(); ++i) {
            parts[joint].corners.insert(parts[joint].corners.end(), {own[0], own[i - 1], own[i]});
        }
    }
    const auto most = std::ranges::max_element(parts, {}, [](const Part& part) { return part.corners.size(); });
    most->joint = static_cast<uint32_t>(most - parts.begin());
    return *most;
}

/// shaders/prop.vert
struct Push {
    glm::mat4 bind;
    glm::vec4 window;
    uint32_t stride, slot, joint, firstCage;
};

/// Draws the prop, or the part of the cage, of one instance.
class Drawing {
public:
    Drawing(host::Device& device, const SuppleGroupInfo& info, std::span<const glm::vec4> prop, const Part& part)
        : device_(device), vertexCount_(static_cast<uint32_t>(part.corners.size())), canvas_(device) {
        constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT;
        const VkDescriptorSetLayout setLayout = *host::createSetLayout(
            device, {{0, kStorage, kVertex}, {1, kStorage, kVertex}, {2, kStorage, kVertex}, {3, kStorage, kVertex}});
        layout_ = *host::createPipelineLayout(device, {setLayout}, sizeof(Push), kVertex);
        pool_ = std::move(*host::DescriptorPool::create(device, 1));
        set_ = *pool_.allocate(setLayout);
        prop_ = std::move(*device.uploadBuffer(prop.data(), prop.size_bytes(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
        corners_ = std::move(*device.uploadBuffer(part.corners.data(), part.corners.size() * sizeof(uint32_t),
                                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
        pool_.write(set_, {host::storageBuffer(0, info.poses), host::storageBuffer(1, prop_.handle(), 0, VK_WHOLE_SIZE),
                           host::storageBuffer(2, info.deformedCage),
                           host::storageBuffer(3, corners_.handle(), 0, VK_WHOLE_SIZE)});
    }

    host::Picture draw(std::span<const uint32_t> vertexShader, const Push& push) {
        host::GraphicsDesc desc = Canvas::pipelineDesc("test prop");
        desc.layout = layout_;
        desc.vertexShader = vertexShader;
        desc.fragmentShader = prop_frag;
        const VkPipeline pipeline = *host::createGraphicsPipeline(device_, desc);
        return canvas_.draw([&](VkCommandBuffer commands) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set_, 0, nullptr);
            vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(push), &push);
            vkCmdDraw(commands, vertexCount_, 1, 0, 0);
        });
    }

private:
    host::Device& device_;
    uint32_t vertexCount_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    host::DescriptorPool pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    host::Buffer prop_, corners_;
    Canvas canvas_;
};

/// Pixels of which some channel differs by more than the rounding of a color.
uint32_t different(const host::Picture& a, const host::Picture& b) {
    uint32_t count = 0;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        bool off = false;
        for (size_t c = 0; c < 3; ++c) {
            off = off || std::abs(int{a.rgba[i + c]} - int{b.rgba[i + c]}) > 2;
        }
        count += off ? 1 : 0;
    }
    return count;
}
uint32_t covered(const host::Picture& picture) {
    return different(picture, Canvas::blank());
}

class Prop : public CrowdContexts {
protected:
    /// Poses and places the instance by whoever poses the group.
    static void pose(SuppleContext context, SuppleInstance instance, SupplePoseSource source) {
        if (source == SUPPLE_POSES_SET) {
            EXPECT_EQ(suppleSetClipPose(context, instance, 2, 0.9), SUPPLE_OK);
        } else {
            SupplePlaybackLayer layer{};
            layer.clip = 2;
            layer.weight = layer.speed = 1.0f;
            auto desc = sized<SupplePlaybackDesc>();
            desc.layers = &layer;
            desc.layerCount = 1;
            EXPECT_EQ(suppleSetPlayback(context, instance, &desc), SUPPLE_OK);
            EXPECT_EQ(suppleSetTime(context, instance.group, 0.9), SUPPLE_OK);
        }
        const glm::mat4 placed = glm::scale(
            glm::rotate(glm::translate(glm::mat4(1.0f), {0.4f, 0.2f, -0.3f}), 0.8f, {0, 1, 0}), glm::vec3(1.3f));
        EXPECT_EQ(suppleSetTransform(context, instance, glm::value_ptr(placed)), SUPPLE_OK);
    }
};

TEST_F(Prop, CoversWhatASkinnedPartCovers) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    std::ifstream file(kPip, std::ios::binary);
    const std::vector<char> chars((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const Result<cage::Character> character = cage::readGltf(std::as_bytes(std::span(chars)), "pip", "");
    ASSERT_TRUE(character.ok());
    const Part part = largestPart(*character);
    ASSERT_GT(part.corners.size(), 300u);
    const SuppleAsset asset = own.asset(kPip);
    auto joint = sized<SuppleJointInfo>();
    ASSERT_EQ(suppleGetJointInfo(own.handle(), asset, part.joint, &joint), SUPPLE_OK);
    const glm::mat4 bind = glm::make_mat4(joint.bindTransform);
    std::vector<glm::vec4> prop; // in the joint's space, as a modeller would hand it over
    for (const uint32_t corner : part.corners) {
        prop.emplace_back(glm::inverse(bind) * glm::vec4(character->cage.positions[corner], 1.0f));
    }
    for (const SuppleSkinning skinning :
         {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION, SUPPLE_SKINNING_CENTERS_OF_ROTATION}) {
        for (const SupplePoseSource source : {SUPPLE_POSES_SET, SUPPLE_POSES_PLAYBACK}) {
            SuppleGroupDesc desc{};
            desc.asset = asset;
            desc.capacity = 2;
            desc.scheme = SUPPLE_SCHEME_CAGE;
            desc.skinning = skinning;
            desc.poseSource = source;
            Crowd crowd(own, desc);
            ASSERT_TRUE(crowd.valid());
            static_cast<void>(crowd.spawn());
            const SuppleInstance instance = crowd.spawn(); // not in the first slot
            pose(own.handle(), instance, source);
            glm::mat4 held;
            ASSERT_EQ(suppleGetJointTransform(own.handle(), instance, part.joint, &held[0][0]), SUPPLE_OK);
            own.run(crowd.group());

            const SuppleGroupInfo info = crowd.output().info;
            Drawing drawing(own.device(), info, prop, part);
            Push push{bind, {}, info.poses.stride / 16, instance.slot, part.joint, 0};
            push.firstCage = instance.slot * info.cageVerticesPerInstance;
            glm::vec3 low(1e9f), high(-1e9f);
            for (const glm::vec4& p : prop) {
                low = glm::min(low, glm::vec3(held * p));
                high = glm::max(high, glm::vec3(held * p));
            }
            push.window = glm::vec4(0.5f * (low + high), 0.0f);
            push.window.z = 0.6f * std::max(high.x - low.x, high.y - low.y);
            const host::Picture skinned = drawing.draw(prop_vert_SKINNED, push);
            const bool linear = skinning == SUPPLE_SKINNING_LINEAR;
            const host::Picture palette = drawing.draw(linear ? std::span<const uint32_t>(prop_vert)
                                                              : std::span<const uint32_t>(prop_vert_DUAL_QUATERNIONS),
                                                       push);
            push.bind = held;
            const host::Picture placed = drawing.draw(prop_vert_PLACED, push);
            std::printf("%u pixels; differ: %u by the palette, %u by the CPU's transform\n", covered(skinned),
                        different(skinned, palette), different(skinned, placed));
            EXPECT_GT(covered(skinned), Canvas::kSide * Canvas::kSide / 16);
            EXPECT_LE(different(skinned, palette), 20u) << "but for rounding at edges";
            EXPECT_LE(different(skinned, placed), 20u);
            push.bind = glm::mat4(1.0f);
            EXPECT_GT(different(skinned, drawing.draw(prop_vert_PLACED, push)), 1000u) << "and it can be told";
        }
    }
}

} // namespace
} // namespace supple::test
