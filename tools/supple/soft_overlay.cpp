#include "tools/supple/soft_overlay.h"

#include "cage/skeleton.h"
#include "host/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace supple::tools {

namespace {

using StrokeColor = std::array<uint8_t, 3>;

constexpr StrokeColor kSpring{255, 196, 64}, kTail{255, 255, 255}, kCollider{90, 220, 255},
    kInsideCollider{255, 120, 220};
constexpr StrokeColor kLight{40, 40, 60}, kJiggle{255, 110, 40}, kCloth{120, 255, 90};
constexpr int kCircleSides = 24;

StrokeColor mixedColor(const StrokeColor& from, const StrokeColor& to, float share) {
    StrokeColor color{};
    for (size_t k = 0; k < 3; ++k)
        color[k] = static_cast<uint8_t>(std::lround(from[k] + (to[k] - from[k]) * share));
    return color;
}

/// Where nodes stand as the figure was posed: with the joints of the skin, or with the next one above.
class Nodes {
public:
    Nodes(const SoftFacts& facts, std::vector<glm::mat4> palette)
        : skeleton_(facts.skeleton), palette_(std::move(palette)), bind_(facts.skin.inverseBinds) {
        joints_.assign(skeleton_.nodes.size(), cage::kNone);
        for (uint32_t j = 0; j < facts.skin.joints.size() && j < palette_.size(); ++j)
            joints_[facts.skin.joints[j]] = j;
    }

    [[nodiscard]] glm::mat4 placeOf(uint32_t node) const {
        glm::mat4 below(1.0f);
        for (; node != cage::kNone; node = skeleton_.nodes[node].parent) {
            if (const uint32_t joint = joints_[node]; joint != cage::kNone)
                return palette_[joint] * glm::inverse(bind_[joint]) * below;
            below = glm::mat4(cage::localMatrix(skeleton_.nodes[node])) * below;
        }
        return below;
    }

private:
    const cage::Skeleton& skeleton_;
    std::vector<glm::mat4> palette_;
    const std::vector<glm::mat4>& bind_;
    std::vector<uint32_t> joints_; ///< by node
};

class Strokes {
public:
    void line(const glm::vec3& from, const glm::vec3& to, const StrokeColor& color) {
        all.push_back({from, to, color});
    }
    void dot(const glm::vec3& at, const StrokeColor& color) { line(at, at, color); }
    /// A circle about `middle`, with radii that stand on each other.
    void circle(const glm::vec3& middle, const glm::vec3& a, const glm::vec3& b, const StrokeColor& color) {
        glm::vec3 before = middle + a;
        for (int k = 1; k <= kCircleSides; ++k) {
            const float angle = 2.0f * glm::pi<float>() * static_cast<float>(k) / kCircleSides;
            const glm::vec3 next = middle + std::cos(angle) * a + std::sin(angle) * b;
            line(before, next, color);
            before = next;
        }
    }
    void sphere(const glm::vec3& middle, float radius, const StrokeColor& color) {
        const glm::vec3 x(radius, 0.0f, 0.0f), y(0.0f, radius, 0.0f), z(0.0f, 0.0f, radius);
        circle(middle, x, y, color);
        circle(middle, y, z, color);
        circle(middle, z, x, color);
    }
    void capsule(const glm::vec3& from, const glm::vec3& to, float radius, const StrokeColor& color) {
        sphere(from, radius, color);
        if (!(glm::distance(from, to) > 1e-6f))
            return;
        sphere(to, radius, color);
        const auto [a, b] = across(glm::normalize(to - from));
        for (const glm::vec3& side : {a, -a, b, -b})
            line(from + radius * side, to + radius * side, color);
    }
    void plane(const glm::vec3& at, const glm::vec3& normal, float extent, const StrokeColor& color) {
        const auto [a, b] = across(normal);
        for (int k = -2; k <= 2; ++k) {
            const float place = 0.5f * extent * static_cast<float>(k);
            line(at + place * a - extent * b, at + place * a + extent * b, color);
            line(at + place * b - extent * a, at + place * b + extent * a, color);
        }
        line(at, at + 0.5f * extent * normal, color);
    }

    std::vector<Stroke> all;

private:
    static std::pair<glm::vec3, glm::vec3> across(const glm::vec3& way) {
        const glm::vec3 other = std::abs(way.y) < 0.9f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
        const glm::vec3 a = glm::normalize(glm::cross(way, other));
        return {a, glm::cross(way, a)};
    }
};

void addSprings(const SoftFacts& facts, const Nodes& nodes, Strokes& strokes) {
    for (const cage::Spring& spring : facts.springBones.springs) {
        for (size_t j = 0; j < spring.joints.size(); ++j) {
            const cage::SpringJoint& joint = spring.joints[j];
            const glm::vec3 at(nodes.placeOf(joint.node)[3]);
            const uint32_t above =
                j > 0 ? spring.isTree ? facts.skeleton.nodes[joint.node].parent : spring.joints[j - 1].node
                      : cage::kNone;
            if (above != cage::kNone) {
                strokes.line(glm::vec3(nodes.placeOf(above)[3]), at, kSpring);
                if (const float radius = spring.joints[j - 1].hitRadius; radius > 0.0f)
                    strokes.sphere(at, radius, kTail);
            }
            strokes.dot(at, kSpring);
        }
    }
}

/// Radii do not follow the scale of nodes, as in the steps of springs.
void addColliders(const SoftFacts& facts, const Nodes& nodes, float extent, Strokes& strokes) {
    for (const cage::SpringCollider& collider : facts.springBones.colliders) {
        const glm::mat4 place = nodes.placeOf(collider.node);
        const glm::vec3 at(place * glm::vec4(collider.offset, 1.0f));
        const StrokeColor& color = collider.inside ? kInsideCollider : kCollider;
        if (collider.shape == cage::ColliderShape::plane) {
            const glm::vec3 normal = glm::mat3(place) * collider.tail;
            if (glm::length(normal) > 1e-6f)
                strokes.plane(at, glm::normalize(normal), 0.15f * extent, color);
        } else {
            const bool capsule = collider.shape == cage::ColliderShape::capsule;
            strokes.capsule(at, capsule ? glm::vec3(place * glm::vec4(collider.tail, 1.0f)) : at, collider.radius,
                            color);
        }
    }
}

void addPainted(const std::vector<cage::PaintedWeight>& weights, const std::vector<glm::vec3>& cage,
                const StrokeColor& color, Strokes& strokes) {
    for (size_t v = 0; v < weights.size() && v < cage.size(); ++v) {
        if (weights[v].index != cage::kNone)
            strokes.dot(cage[v], mixedColor(kLight, color, weights[v].weight));
    }
}

/// Lays a color over a pixel.
void blendPixel(uint8_t* pixel, const StrokeColor& color, float share) {
    for (size_t k = 0; k < 3; ++k)
        pixel[k] = static_cast<uint8_t>(std::lround(pixel[k] + (color[k] - pixel[k]) * share));
}

/// A line with round ends, of a width in pixels.
void drawStroke(host::Picture& picture, const glm::vec2& from, const glm::vec2& to, float width,
                const StrokeColor& color) {
    const float reach = 0.5f * width + 1.0f;
    const glm::vec2 size(static_cast<float>(picture.width), static_cast<float>(picture.height));
    const glm::vec2 low = glm::clamp(glm::min(from, to) - reach, glm::vec2(0.0f), size),
                    high = glm::clamp(glm::max(from, to) + reach, glm::vec2(0.0f), size);
    const glm::vec2 way = to - from;
    const float squared = glm::dot(way, way);
    for (auto y = static_cast<uint32_t>(low.y); y < static_cast<uint32_t>(high.y); ++y) {
        for (auto x = static_cast<uint32_t>(low.x); x < static_cast<uint32_t>(high.x); ++x) {
            const glm::vec2 at = glm::vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f - from;
            const float t = squared > 0.0f ? std::clamp(glm::dot(at, way) / squared, 0.0f, 1.0f) : 0.0f;
            const float covered = std::clamp(0.5f * width + 0.5f - glm::length(at - t * way), 0.0f, 1.0f);
            if (covered > 0.0f)
                blendPixel(picture.pixel(x, y), color, 0.9f * covered);
        }
    }
}

} // namespace

SoftFacts::SoftFacts(const cage::Character& character)
    : skeleton(character.skeleton), skin(character.skin), springBones(character.springBones),
      jiggles(character.weights.jiggles), cloths(character.weights.cloths) {}

Result<std::vector<Stroke>> softStrokes(const SoftFacts& facts, const host::FigureGroup& group,
                                        const SoftShown& shown) {
    Strokes strokes;
    if (!shown.any())
        return std::move(strokes.all);
    const Result<std::vector<glm::vec3>> cage = group.readCage();
    Result<std::vector<glm::mat4>> palette = group.readPalette();
    if (!cage || !palette)
        return !cage ? cage.error() : palette.error();
    const Nodes nodes(facts, std::move(*palette));
    if (shown.painted) {
        addPainted(facts.jiggles, *cage, kJiggle, strokes);
        addPainted(facts.cloths, *cage, kCloth, strokes);
    }
    if (shown.colliders) {
        const host::Bounds bounds = host::boundsOf(*cage);
        addColliders(facts, nodes, glm::length(bounds.max - bounds.min), strokes);
    }
    if (shown.springs)
        addSprings(facts, nodes, strokes);
    return std::move(strokes.all);
}

std::vector<SoftKey> softKeys(const SoftFacts& facts, const SoftShown& shown) {
    std::vector<SoftKey> keys;
    const auto has = [](const std::vector<cage::PaintedWeight>& weights) {
        return std::any_of(weights.begin(), weights.end(), [](const auto& w) { return w.index != cage::kNone; });
    };
    const std::vector<cage::SpringCollider>& colliders = facts.springBones.colliders;
    if (shown.springs) {
        keys.push_back({kSpring, facts.springBones.springs.empty() ? "no springs" : "springs"});
        if (!facts.springBones.springs.empty())
            keys.push_back({kTail, "hit radius"});
    }
    if (shown.colliders) {
        keys.push_back({kCollider, colliders.empty() ? "no colliders" : "colliders"});
        if (std::any_of(colliders.begin(), colliders.end(), [](const auto& collider) { return collider.inside; }))
            keys.push_back({kInsideCollider, "colliders that keep inside"});
    }
    if (shown.painted && has(facts.jiggles))
        keys.push_back({kJiggle, "jiggles; darker: less weight"});
    if (shown.painted && has(facts.cloths))
        keys.push_back({kCloth, "cloth; darker: less weight"});
    if (shown.painted && !has(facts.jiggles) && !has(facts.cloths))
        keys.push_back({kLight, "nothing is painted"});
    return keys;
}

std::vector<PlacedStroke> placeStrokes(const std::vector<Stroke>& strokes, const glm::mat4& view) {
    constexpr float kFar = 100.0f; // pictures; absurd poses have absurd joints
    std::vector<PlacedStroke> placed;
    for (const Stroke& stroke : strokes) {
        const glm::vec4 from = view * glm::vec4(stroke.from, 1.0f), to = view * glm::vec4(stroke.to, 1.0f);
        const auto place = [](const glm::vec4& at) {
            return glm::vec2(0.5f + 0.5f * at.x / at.w, 0.5f - 0.5f * at.y / at.w);
        };
        const auto isSeen = [&](const glm::vec4& at) {
            return at.w > 0.0f && std::abs(place(at).x) < kFar && std::abs(place(at).y) < kFar;
        };
        if (isSeen(from) && isSeen(to))
            placed.push_back({place(from), place(to), stroke.color});
    }
    return placed;
}

void drawStrokes(host::Picture& picture, const std::vector<Stroke>& strokes, const std::vector<SoftKey>& keys,
                 const glm::mat4& view) {
    const glm::vec2 size(static_cast<float>(picture.width), static_cast<float>(picture.height));
    const float scale = std::max(1.0f, size.y / 600.0f);
    for (const PlacedStroke& stroke : placeStrokes(strokes, view))
        drawStroke(picture, size * stroke.from, size * stroke.to, (stroke.isDot() ? 4.5f : 1.5f) * scale, stroke.color);
    const uint32_t letters = picture.height < 400 ? 1 : 2, line = 12 * letters;
    if (picture.width < 200)
        return;
    for (size_t k = 0; k < keys.size(); ++k) {
        const uint32_t y = 8 + static_cast<uint32_t>(k) * line;
        const float middle = static_cast<float>(y) + 5.0f * static_cast<float>(letters);
        drawStroke(picture, {12.0f, middle}, {12.0f, middle}, 7.0f * static_cast<float>(letters), keys[k].color);
        picture.drawText(16 + 6 * letters, y, keys[k].text, letters, {255, 255, 255});
    }
}

} // namespace supple::tools
