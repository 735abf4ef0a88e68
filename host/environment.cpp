#include "host/environment.h"

#include "host/shaders/draw.h"
#include "host/studio.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/packing.hpp>

namespace supple::host {

namespace {

constexpr uint32_t kLevels = shared::kEnvironmentLevels;
constexpr uint32_t kSourceSize = 128; ///< of the masks that are blurred
constexpr uint32_t kMeasuredDirections = 8192;

/// A lit rectangle with round corners and a soft edge, seen from the middle of the sphere.
struct SoftBox {
    glm::vec3 middle;
    glm::vec2 half; ///< on a plane at distance 1
    float softness;

    [[nodiscard]] float at(glm::vec3 direction) const {
        const float ahead = glm::dot(direction, middle);
        if (ahead <= 0.05f)
            return 0.0f;
        const glm::vec3 up = std::abs(middle.y) > 0.9f ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
        const glm::vec3 side = glm::normalize(glm::cross(up, middle));
        const glm::vec2 place =
            glm::vec2(glm::dot(direction, side), glm::dot(direction, glm::cross(middle, side))) / ahead;
        const float corner = 0.35f * std::min(half.x, half.y);
        const glm::vec2 over = glm::abs(place) - half + corner;
        const float distance = glm::length(glm::max(over, 0.0f)) + std::min(std::max(over.x, over.y), 0.0f) - corner;
        const glm::vec2 within = glm::min(glm::abs(place) / half, 1.0f);
        const float bulb = 1.0f - 0.18f * glm::dot(within, within); // the cloth is brightest in its middle
        return bulb * (1.0f - glm::smoothstep(-softness, softness, distance));
    }
};

class Masks {
public:
    [[nodiscard]] glm::vec4 at(glm::vec3 direction) const {
        const float soft = std::max(overhead_.at(direction), 0.4f * card_.at(direction));
        return {key_.at(direction), rim_.at(direction), soft, glm::smoothstep(-0.12f, 0.12f, direction.y)};
    }

private:
    StudioMiddle studio_ = studioMiddle(0.0f);
    SoftBox key_{studio_.keyDirection, {0.34f, 0.40f}, 0.05f};
    SoftBox rim_{studio_.rimDirection, {0.17f, 0.52f}, 0.04f};
    SoftBox overhead_{glm::normalize(glm::vec3(0.0f, 1.0f, 0.12f)), {1.0f, 0.8f}, 0.22f};
    SoftBox card_{glm::normalize(glm::vec3(0.86f, 0.22f, 0.46f)), {0.28f, 0.62f}, 0.10f};
};

/// The masks with their texels' middles at (i + 0.5) / size, and averages of them: what is summed up when they are
/// blurred.
class Source {
public:
    explicit Source(const Masks& masks) {
        for (uint32_t size = kSourceSize; size >= 4; size /= 2) {
            std::vector<glm::vec4>& level = levels_.emplace_back(size_t{size} * size);
            for (uint32_t i = 0; i < size * size; ++i)
                level[i] =
                    size == kSourceSize
                        ? masks.at(octahedralDirection((glm::vec2(i % size, i / size) + 0.5f) * (2.0f / size) - 1.0f))
                        : average(levels_[levels_.size() - 2], size, i % size, i / size);
        }
    }

    [[nodiscard]] glm::vec4 at(glm::vec3 direction, float level) const {
        const auto which = static_cast<size_t>(std::clamp(level + 0.5f, 0.0f, static_cast<float>(levels_.size() - 1)));
        const auto size = static_cast<int>(kSourceSize >> which);
        const glm::vec2 texel = (octahedralPlace(direction) * 0.5f + 0.5f) * static_cast<float>(size) - 0.5f;
        const glm::vec2 whole = glm::floor(texel);
        const glm::vec2 part = texel - whole;
        const auto read = [&](int dx, int dy) {
            const int x = std::clamp(static_cast<int>(whole.x) + dx, 0, size - 1);
            const int y = std::clamp(static_cast<int>(whole.y) + dy, 0, size - 1);
            return levels_[which][static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x)];
        };
        return glm::mix(glm::mix(read(0, 0), read(1, 0), part.x), glm::mix(read(0, 1), read(1, 1), part.x), part.y);
    }

private:
    static glm::vec4 average(const std::vector<glm::vec4>& finer, uint32_t size, uint32_t x, uint32_t y) {
        const size_t first = size_t{2} * y * 2 * size + size_t{2} * x;
        return 0.25f * (finer[first] + finer[first + 1] + finer[first + 2 * size] + finer[first + 2 * size + 1]);
    }

    std::vector<std::vector<glm::vec4>> levels_;
};

/// Where GGX looks from a surface that is seen from straight above, about the normal (0, 0, 1).
struct Look {
    glm::vec3 direction;
    float sourceLevel; ///< averages over about what falls to this look
};

std::vector<Look> looksFor(float roughness, uint32_t count) {
    std::vector<Look> looks;
    const float a2 = std::pow(roughness, 4.0f);
    const float texel = 4.0f * glm::pi<float>() / float{kSourceSize * kSourceSize};
    for (uint32_t i = 0; i < count; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
        const float angle = 2.39996323f * static_cast<float>(i);
        const float cosine2 = (1.0f - u) / (1.0f + (a2 - 1.0f) * u); // of the half vector, as dense as GGX
        const float cosine = std::sqrt(cosine2);
        const float sine = std::sqrt(1.0f - cosine2);
        const glm::vec3 half(sine * std::cos(angle), sine * std::sin(angle), cosine);
        const glm::vec3 light = 2.0f * cosine * half - glm::vec3(0.0f, 0.0f, 1.0f);
        if (light.z <= 0.0f)
            continue;
        const float d = cosine2 * (a2 - 1.0f) + 1.0f;
        const float density =
            a2 / (glm::pi<float>() * d * d) / 4.0f; // of light; the half vector's, seen along the normal
        looks.push_back({light, 0.5f * std::log2(1.0f / (static_cast<float>(count) * density * texel)) + 0.5f});
    }
    return looks;
}

glm::vec4 blurred(const Source& source, const std::vector<Look>& looks, glm::vec3 normal) {
    const glm::vec3 other = std::abs(normal.y) > 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::vec3 side = glm::normalize(glm::cross(other, normal));
    const glm::mat3 frame(side, glm::cross(normal, side), normal);
    glm::vec4 sum(0.0f);
    float weight = 0.0f;
    for (const Look& look : looks) {
        sum += look.direction.z * source.at(frame * look.direction, look.sourceLevel);
        weight += look.direction.z;
    }
    return sum / weight;
}

/// 1 over the share of a light's radiance that a surface facing it gets, over pi.
glm::vec2 radiances(const Masks& masks) {
    const StudioMiddle middle = studioMiddle(0.0f);
    glm::vec2 sum(0.0f);
    for (uint32_t i = 0; i < kMeasuredDirections; ++i) {
        const float height = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / float{kMeasuredDirections};
        const float angle = 2.39996323f * static_cast<float>(i);
        const float out = std::sqrt(1.0f - height * height);
        const glm::vec3 direction(out * std::cos(angle), height, out * std::sin(angle));
        const glm::vec4 mask = masks.at(direction);
        sum.x += mask.x * std::max(glm::dot(direction, middle.keyDirection), 0.0f);
        sum.y += mask.y * std::max(glm::dot(direction, middle.rimDirection), 0.0f);
    }
    return float{kMeasuredDirections} / (4.0f * sum); // each stands for 4 pi / count
}

} // namespace

glm::vec3 octahedralDirection(glm::vec2 at) {
    glm::vec3 direction(at.x, 1.0f - std::abs(at.x) - std::abs(at.y), at.y);
    if (direction.y < 0.0f) {
        const glm::vec2 folded = 1.0f - glm::abs(glm::vec2(at.y, at.x));
        direction.x = at.x >= 0.0f ? folded.x : -folded.x;
        direction.z = at.y >= 0.0f ? folded.y : -folded.y;
    }
    return glm::normalize(direction);
}

glm::vec2 octahedralPlace(glm::vec3 direction) {
    const glm::vec3 size = glm::abs(direction);
    const glm::vec2 at = glm::vec2(direction.x, direction.z) / (size.x + size.y + size.z);
    if (direction.y >= 0.0f)
        return at;
    const glm::vec2 folded = 1.0f - glm::abs(glm::vec2(at.y, at.x));
    return {at.x >= 0.0f ? folded.x : -folded.x, at.y >= 0.0f ? folded.y : -folded.y};
}

float environmentRoughness(uint32_t level) {
    return std::pow(static_cast<float>(level) / float{kLevels - 1}, 1.5f);
}

StudioEnvironment studioEnvironment() {
    const Masks masks;
    const Source source(masks);
    StudioEnvironment environment;
    for (uint32_t level = 0; level < kLevels; ++level) {
        const uint32_t size = shared::kEnvironmentSize >> level;
        const std::vector<Look> looks = looksFor(environmentRoughness(level), 24 * (2 * std::max(level, 1u) - 1));
        std::vector<glm::vec4>& texels = environment.levels.emplace_back(size_t{size} * size);
        for (uint32_t i = 0; i < size * size; ++i) {
            const glm::vec2 at = glm::vec2(i % size, i / size) * (2.0f / static_cast<float>(size - 1)) - 1.0f;
            const glm::vec3 direction = octahedralDirection(at);
            texels[i] = level == 0 ? masks.at(direction) : blurred(source, looks, direction);
        }
    }
    const glm::vec2 radiance = radiances(masks);
    environment.keyRadiance = radiance.x;
    environment.rimRadiance = radiance.y;
    return environment;
}

Result<Image> uploadEnvironment(Device& device, const StudioEnvironment& environment) {
    Result<Image> image = device.createImage({.format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                              .extent = {shared::kEnvironmentSize, shared::kEnvironmentSize},
                                              .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                              .mipLevels = kLevels});
    if (!image)
        return image.error();
    std::vector<uint64_t> texels;
    std::vector<VkBufferImageCopy> copies;
    for (uint32_t level = 0; level < kLevels; ++level) {
        VkBufferImageCopy& copy = copies.emplace_back();
        copy.bufferOffset = texels.size() * sizeof texels[0];
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
        copy.imageExtent = {shared::kEnvironmentSize >> level, shared::kEnvironmentSize >> level, 1};
        for (const glm::vec4& texel : environment.levels[level])
            texels.push_back(glm::packHalf4x16(texel));
    }
    Result<Buffer> staging =
        device.createBuffer(texels.size() * sizeof texels[0], VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload);
    if (!staging)
        return staging.error();
    std::memcpy(staging->mapped(), texels.data(), texels.size() * sizeof texels[0]);
    const ImageUse written{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT}};
    const Status status = device.submitAndWait([&](VkCommandBuffer commands) {
        imageBarrier(commands, *image, {VK_IMAGE_LAYOUT_UNDEFINED, {}}, written);
        vkCmdCopyBufferToImage(commands, staging->handle(), image->handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                               static_cast<uint32_t>(copies.size()), copies.data());
        imageBarrier(commands, *image, written,
                     {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                      {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}});
    });
    if (!status)
        return status.error();
    return image;
}

} // namespace supple::host
