#include "tools/supple/view_props.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace supple::tools {
namespace {

using host::shared::AttachmentVertex;

/// In radii of the figure.
constexpr float kLanternSize = 0.30f, kArrowSize = 0.55f, kStickerSize = 0.30f;
constexpr int kSides = 24;
constexpr uint32_t kStickerPixels = 256;

/// How a ring of a turned body looks.
struct Finish {
    glm::vec3 color{1.0f}; ///< linear
    float roughness = 0.5f, metallic = 0.0f, shine = 0.0f;
};
constexpr Finish kBrass{{0.72f, 0.45f, 0.16f}, 0.32f, 1.0f, 0.0f};
constexpr Finish kGlow{{1.0f, 0.62f, 0.20f}, 0.4f, 0.0f, 0.9f};
constexpr Finish kIron{{0.16f, 0.16f, 0.17f}, 0.45f, 1.0f, 0.0f};
constexpr Finish kWood{{0.33f, 0.17f, 0.07f}, 0.6f, 0.0f, 0.0f};
constexpr Finish kFeather{{0.72f, 0.06f, 0.05f}, 0.8f, 0.0f, 0.0f};

AttachmentVertex vertexOf(const glm::vec3& position, const glm::vec3& normal, const Finish& finish) {
    return {{position, finish.roughness}, {normal, finish.shine}, {finish.color, finish.metallic}};
}

/// A place on the outline of a turned body.
struct Outline {
    float radius = 0.0f, z = 0.0f;
};

/// A band between two rings, which is smooth round the axis.
void addBand(std::vector<AttachmentVertex>& out, const Outline& below, const Outline& above, const Finish& finish) {
    const glm::vec2 along(above.radius - below.radius, above.z - below.z);
    const float length = std::max(glm::length(along), 1e-6f);
    const auto corner = [&](const Outline& ring, int side) {
        const float turn = 2.0f * std::numbers::pi_v<float> * static_cast<float>(side) / static_cast<float>(kSides);
        const glm::vec2 away(std::cos(turn), std::sin(turn));
        return vertexOf({ring.radius * away, ring.z}, {away * (along.y / length), -along.x / length}, finish);
    };
    for (int side = 0; side < kSides; ++side) {
        for (const AttachmentVertex& v : {corner(below, side), corner(below, side + 1), corner(above, side + 1),
                                          corner(below, side), corner(above, side + 1), corner(above, side)})
            out.push_back(v);
    }
}

void addBody(std::vector<AttachmentVertex>& out, std::span<const Outline> outline, const Finish& finish) {
    for (size_t k = 0; k + 1 < outline.size(); ++k)
        addBand(out, outline[k], outline[k + 1], finish);
}

/// How far inside of a five-pointed star of radius 1: above 0.
float insideStar(float x, float y) {
    const float turn = std::atan2(x, y), fifth = 2.0f * std::numbers::pi_v<float> / 5.0f;
    const float off = std::abs(turn - fifth * std::round(turn / fifth)); // from the nearest point's axis
    const float radius = std::hypot(x, y), inner = 0.45f;
    const glm::vec2 at = radius * glm::vec2(std::cos(off), std::sin(off));
    const glm::vec2 point(1.0f, 0.0f), valley = inner * glm::vec2(std::cos(0.5f * fifth), std::sin(0.5f * fifth));
    const glm::vec2 edge = glm::normalize(valley - point);
    return edge.y * (point.x - at.x) - edge.x * (point.y - at.y);
}

/// From 0 to 1 over a texel or two.
float covered(float inside) {
    return std::clamp(0.5f + inside * (0.25f * static_cast<float>(kStickerPixels)), 0.0f, 1.0f);
}

glm::vec3 stickerColor(float x, float y) {
    const glm::vec3 white(0.97f, 0.96f, 0.93f), red(0.80f, 0.10f, 0.12f), yellow(1.0f, 0.80f, 0.16f);
    const float radius = std::hypot(x, y);
    glm::vec3 color = glm::mix(white, red, covered(0.80f - radius));
    return glm::mix(color, yellow, covered(insideStar(x / 0.62f, y / 0.62f) * 0.62f));
}

/// The rim stands up, and the star a little.
float stickerHeight(float x, float y) {
    const float rim = (std::hypot(x, y) - 0.88f) / 0.06f;
    const float star = std::clamp(0.5f + insideStar(x / 0.62f, y / 0.62f) * 12.0f, 0.0f, 1.0f);
    return 0.020f * std::exp(-rim * rim) + 0.014f * star * star * (3.0f - 2.0f * star);
}

} // namespace

std::vector<AttachmentVertex> lanternVertices() {
    std::vector<AttachmentVertex> out;
    constexpr Outline kFoot[] = {{0.0f, -0.01f}, {0.16f, -0.01f}, {0.16f, 0.03f}, {0.05f, 0.06f},
                                 {0.05f, 0.16f}, {0.22f, 0.20f},  {0.24f, 0.24f}, {0.18f, 0.27f}};
    constexpr Outline kGlass[] = {{0.18f, 0.27f}, {0.21f, 0.36f}, {0.215f, 0.46f}, {0.20f, 0.56f}, {0.16f, 0.64f}};
    constexpr Outline kRoof[] = {{0.16f, 0.64f}, {0.25f, 0.66f}, {0.24f, 0.69f},  {0.13f, 0.78f}, {0.08f, 0.86f},
                                 {0.04f, 0.88f}, {0.04f, 0.93f}, {0.055f, 0.96f}, {0.04f, 0.99f}, {0.0f, 1.0f}};
    addBody(out, kFoot, kBrass);
    addBody(out, kGlass, kGlow);
    addBody(out, kRoof, kBrass);
    for (int bar = 0; bar < 4; ++bar) { // before the glass
        std::vector<AttachmentVertex> rod;
        constexpr Outline kRod[] = {{0.014f, 0.25f}, {0.014f, 0.66f}};
        addBody(rod, kRod, kBrass);
        const float turn = 0.5f * std::numbers::pi_v<float> * static_cast<float>(bar);
        for (AttachmentVertex& v : rod) {
            v.a.x += 0.222f * std::cos(turn);
            v.a.y += 0.222f * std::sin(turn);
            out.push_back(v);
        }
    }
    return out;
}

std::vector<AttachmentVertex> arrowVertices() {
    std::vector<AttachmentVertex> out;
    constexpr Outline kHead[] = {{0.0f, -0.20f}, {0.035f, -0.06f}, {0.012f, -0.04f}};
    constexpr Outline kShaft[] = {{0.012f, -0.06f}, {0.012f, 0.97f}};
    constexpr Outline kNock[] = {{0.012f, 0.97f}, {0.016f, 0.98f}, {0.016f, 1.0f}, {0.0f, 1.0f}};
    addBody(out, kHead, kIron);
    addBody(out, kShaft, kWood);
    addBody(out, kNock, kIron);
    for (int feather = 0; feather < 3; ++feather) {
        const float turn = 2.0f * std::numbers::pi_v<float> * static_cast<float>(feather) / 3.0f;
        const glm::vec3 away(std::cos(turn), std::sin(turn), 0.0f), normal(-away.y, away.x, 0.0f);
        const auto at = [&](float radius, float z) {
            return vertexOf(radius * away + glm::vec3(0.0f, 0.0f, z), normal, kFeather);
        };
        const std::array outline = {at(0.010f, 0.68f), at(0.070f, 0.76f), at(0.075f, 0.94f), at(0.010f, 0.93f)};
        for (const size_t k : {0, 1, 2, 0, 2, 3})
            out.push_back(outline[k]);
    }
    return out;
}

host::DecalLook stickerLook() {
    host::DecalLook look;
    look.color = look.normals = host::Picture::blank(kStickerPixels, kStickerPixels);
    look.roughness = 0.35f;
    constexpr float kStep = 2.0f / static_cast<float>(kStickerPixels);
    const auto toByte = [](float x) { return static_cast<uint8_t>(std::lround(255.0f * std::clamp(x, 0.0f, 1.0f))); };
    for (uint32_t row = 0; row < kStickerPixels; ++row) {
        for (uint32_t column = 0; column < kStickerPixels; ++column) {
            const float x = (static_cast<float>(column) + 0.5f) * kStep - 1.0f;
            const float y = 1.0f - (static_cast<float>(row) + 0.5f) * kStep;
            const glm::vec3 color = stickerColor(x, y);
            const glm::vec3 normal =
                glm::normalize(glm::vec3(stickerHeight(x - kStep, y) - stickerHeight(x + kStep, y),
                                         stickerHeight(x, y - kStep) - stickerHeight(x, y + kStep), 2.0f * kStep));
            uint8_t* const c = look.color.pixel(column, row);
            uint8_t* const n = look.normals.pixel(column, row);
            for (int k = 0; k < 3; ++k) {
                c[k] = toByte(color[k]);
                n[k] = toByte(0.5f + 0.5f * normal[k]);
            }
            c[3] = toByte(covered(0.96f - std::hypot(x, y)));
            n[3] = 255;
        }
    }
    return look;
}

Status attach(host::Attachments& to, const AttachedProp& what, float radius) {
    if (what.prop == Prop::sticker) {
        host::DecalDesc desc;
        desc.at = what.at;
        desc.size = glm::vec2(kStickerSize * radius);
        return to.addDecal(desc, stickerLook());
    }
    return what.prop == Prop::lantern ? to.addProp(what.at, lanternVertices(), kLanternSize * radius)
                                      : to.addProp(what.at, arrowVertices(), kArrowSize * radius);
}

} // namespace supple::tools
