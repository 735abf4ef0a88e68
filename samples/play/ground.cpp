#include "ground.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace play {

namespace {

// Two steps that lead up to a square platform. Their edges are between the tiles that shaders/ground.frag paints.
constexpr float kTile = 0.42f;
constexpr glm::vec2 kPlatform{4.0f * kTile, -kTile};
constexpr float kPlatformReach = 2.0f * kTile; ///< half its side
constexpr float kTread = kTile;
constexpr float kRiser = 0.11f;
constexpr float kEdge = 0.025f; ///< half the width over which a step rises

// What a foot reaches beyond its joints.
constexpr float kHeel = 0.07f, kToeTip = 0.09f, kHalfSole = 0.06f;
/// Ground that differs by more under a sole is a step, not a slope.
constexpr float kSlopeMost = 0.07f;

constexpr float kRoomReach = 5.5f;
constexpr float kMeshReach = 8.0f;
constexpr uint32_t kMeshCells = 140; ///< along a side, without those at the edges of the steps
constexpr glm::vec2 kMeshCenter{0.6f, 0.0f};

float bump(glm::vec2 place, glm::vec2 center, float height, float width) {
    const glm::vec2 away = (place - center) / width;
    return height * std::exp(-glm::dot(away, away));
}

/// 0 outside a square round the platform, 1 inside.
float within(glm::vec2 place, float reach) {
    const glm::vec2 away = glm::abs(place - kPlatform);
    return 1.0f - glm::smoothstep(reach - kEdge, reach + kEdge, std::max(away.x, away.y));
}

} // namespace

float heightAt(glm::vec2 place) {
    const float meadow = bump(place, {-0.85f, 0.25f}, 0.17f, 0.55f) + bump(place, {0.5f, 2.1f}, 0.26f, 0.9f) +
                         bump(place, {-2.6f, -1.6f}, 0.3f, 1.0f) +
                         0.018f * std::sin(2.3f * place.x + 0.7f) * std::sin(1.9f * place.y);
    const float lower = within(place, kPlatformReach + kTread), upper = within(place, kPlatformReach);
    return glm::mix(meadow, kRiser, lower) + kRiser * upper;
}

glm::vec3 normalAt(glm::vec2 place) {
    constexpr float kStep = 0.01f;
    const float x = heightAt(place + glm::vec2(kStep, 0.0f)) - heightAt(place - glm::vec2(kStep, 0.0f));
    const float z = heightAt(place + glm::vec2(0.0f, kStep)) - heightAt(place - glm::vec2(0.0f, kStep));
    return glm::normalize(glm::vec3(-x, 2.0f * kStep, -z));
}

glm::vec2 withinRoom(glm::vec2 place) {
    const float away = glm::length(place);
    return away > kRoomReach ? place * (kRoomReach / away) : place;
}

std::optional<glm::vec3> meetGround(glm::vec3 from, glm::vec3 direction) {
    constexpr float kFarthest = 30.0f, kStride = 0.05f;
    const auto isBelow = [&](float away) {
        const glm::vec3 point = from + away * direction;
        return point.y <= heightAt(placeOf(point));
    };
    float low = 0.0f, high = kStride;
    for (; !isBelow(high); low = high, high += kStride) {
        if (high > kFarthest)
            return std::nullopt;
    }
    for (int i = 0; i < 8; ++i) {
        const float middle = 0.5f * (low + high);
        (isBelow(middle) ? high : low) = middle;
    }
    return onGround(placeOf(from + high * direction));
}

Footing footingUnder(glm::vec3 ankle, glm::vec3 toes) {
    const glm::vec2 along = placeOf(toes) - placeOf(ankle);
    const float length = glm::length(along);
    const glm::vec2 ahead = length > 1e-4f ? along / length : glm::vec2(0.0f, 1.0f), aside(-ahead.y, ahead.x);
    // The corners of the sole, and its middle, from the ankle.
    const float front = length + kToeTip;
    const glm::vec2 sole[] = {{-kHeel, -kHalfSole},
                              {-kHeel, kHalfSole},
                              {front, -kHalfSole},
                              {front, kHalfSole},
                              {0.5f * (front - kHeel), 0.0f}};
    float heights[std::size(sole)];
    for (size_t i = 0; i < std::size(sole); ++i)
        heights[i] = heightAt(placeOf(ankle) + sole[i].x * ahead + sole[i].y * aside);
    const auto [lowest, highest] = std::minmax_element(std::begin(heights), std::end(heights));
    if (*highest - *lowest > kSlopeMost)
        return {{ankle.x, *highest, ankle.z}, {0.0f, 1.0f, 0.0f}};
    // The mean slope, as low as the ground lets it be.
    const float forwards = 0.5f * (heights[2] + heights[3] - heights[0] - heights[1]) / (front + kHeel),
                sideways = 0.25f * (heights[1] + heights[3] - heights[0] - heights[2]) / kHalfSole;
    float height = -1e9f;
    for (size_t i = 0; i < std::size(sole); ++i)
        height = std::max(height, heights[i] - forwards * sole[i].x - sideways * sole[i].y);
    const glm::vec2 slope = forwards * ahead + sideways * aside;
    return {{ankle.x, height, ankle.z}, glm::normalize(glm::vec3(-slope.x, 1.0f, -slope.y))};
}

namespace {

/// What rises all round, a hand's breadth away and an arm's length, hides the sky.
float openSkyAt(glm::vec2 place) {
    constexpr uint32_t kDirections = 8;
    const float height = heightAt(place);
    float hidden = 0.0f;
    for (const float reach : {0.07f, 0.25f}) {
        for (uint32_t i = 0; i < kDirections; ++i) {
            const float angle = 0.785398f * static_cast<float>(i);
            const float rise = heightAt(place + reach * glm::vec2(std::cos(angle), std::sin(angle))) - height;
            hidden += std::max(rise, 0.0f) / std::sqrt(reach * reach + rise * rise);
        }
    }
    return 1.0f - hidden / (2.0f * kDirections);
}

/// Where the mesh has lines across one axis: they are close together at the edges of the steps, and far apart far away.
std::vector<float> meshLines(float center, float platform) {
    std::vector<float> lines;
    for (uint32_t i = 0; i <= kMeshCells; ++i) {
        const float t = 2.0f * static_cast<float>(i) / static_cast<float>(kMeshCells) - 1.0f;
        lines.push_back(center + kMeshReach * t * (0.45f + 0.55f * t * t));
    }
    for (const float edge : {-kPlatformReach - kTread, -kPlatformReach, kPlatformReach, kPlatformReach + kTread}) {
        for (int i = -4; i <= 4; ++i)
            lines.push_back(platform + edge + kEdge * static_cast<float>(i) / 2.5f);
    }
    std::sort(lines.begin(), lines.end());
    return lines;
}

} // namespace

GroundMesh makeGroundMesh() {
    GroundMesh mesh;
    const std::vector<float> columns = meshLines(kMeshCenter.x, kPlatform.x),
                             rows = meshLines(kMeshCenter.y, kPlatform.y);
    for (const float z : rows) {
        for (const float x : columns) {
            const glm::vec2 place(x, z);
            mesh.vertices.push_back({glm::vec4(onGround(place), 1.0f), glm::vec4(normalAt(place), openSkyAt(place))});
        }
    }
    const auto side = static_cast<uint32_t>(columns.size());
    for (uint32_t row = 0; row + 1 < rows.size(); ++row) {
        for (uint32_t column = 0; column + 1 < side; ++column) {
            const uint32_t a = row * side + column, b = a + 1, c = a + side, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
        }
    }
    return mesh;
}

} // namespace play
