#include "props.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace market {

namespace {

constexpr glm::vec3 kUp(0.0f, 1.0f, 0.0f);
constexpr glm::vec3 kWood(0.21f, 0.12f, 0.062f), kDarkWood(0.10f, 0.058f, 0.032f), kStone(0.36f, 0.33f, 0.29f);

class Builder {
public:
    /// Everything is placed in this from then on.
    void setFrame(const glm::mat4& frame) { frame_ = frame; }

    void add(Shape shape, glm::vec3 middle, glm::vec3 size, glm::vec3 color, Surface surface,
             const glm::mat4& turn = glm::mat4(1.0f)) {
        Prop prop;
        prop.transform = frame_ * glm::translate(glm::mat4(1.0f), middle) * turn * glm::scale(glm::mat4(1.0f), size);
        prop.color = glm::vec4(color, static_cast<float>(surface));
        prop.size = glm::vec4(size, static_cast<float>(std::fmod(0.7548776662 * ++count_, 1.0)));
        byShape_[static_cast<size_t>(shape)].push_back(prop);
    }
    void box(glm::vec3 middle, glm::vec3 size, glm::vec3 color, Surface surface = Surface::plain) {
        add(Shape::box, middle, size, color, surface);
    }

    [[nodiscard]] Props props() const {
        Props props;
        for (size_t s = 0; s < kShapes; ++s) {
            props.runs[s] = {static_cast<uint32_t>(props.all.size()), static_cast<uint32_t>(byShape_[s].size())};
            props.all.insert(props.all.end(), byShape_[s].begin(), byShape_[s].end());
        }
        return props;
    }

private:
    glm::mat4 frame_{1.0f};
    std::array<std::vector<Prop>, kShapes> byShape_;
    uint32_t count_ = 0;
};

glm::mat4 frameAt(float x, float z, float heading) {
    return glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(x, 0.0f, z)), heading, kUp);
}

/// Rows of fruit, bread or jars on the counter.
void addGoods(Builder& builder, uint32_t number) {
    constexpr glm::vec3 kGoods[] = {{0.62f, 0.10f, 0.05f}, {0.75f, 0.42f, 0.06f}, {0.28f, 0.40f, 0.07f},
                                    {0.50f, 0.28f, 0.12f}, {0.35f, 0.07f, 0.20f}, {0.70f, 0.60f, 0.30f}};
    for (uint32_t tray = 0; tray < 3; ++tray) {
        const float x = 0.62f * (static_cast<float>(tray) - 1.0f);
        const glm::vec3 color = kGoods[(2 * number + tray) % std::size(kGoods)];
        builder.box({x, 0.93f, 0.12f}, {0.54f, 0.08f, 0.44f}, kWood, Surface::wood);
        for (uint32_t i = 0; i < 12; ++i) {
            const glm::vec3 place(x - 0.19f + 0.126f * static_cast<float>(i % 4), 1.0f,
                                  0.0f + 0.125f * static_cast<float>(i / 4));
            const glm::vec3 shade = color * (0.85f + 0.3f * std::fmod(0.618f * static_cast<float>(i), 1.0f));
            if ((number + tray) % 3 == 1)
                builder.add(Shape::cylinder, place + glm::vec3(0.0f, 0.03f, 0.0f), {0.09f, 0.15f, 0.09f}, shade,
                            Surface::plain);
            else
                builder.add(Shape::ball, place, glm::vec3(0.12f), shade, Surface::plain);
        }
    }
}

/// Open towards +Z, with a striped awning.
void addStall(Builder& builder, uint32_t number, glm::vec3 color) {
    for (const float x : {-1.0f, 1.0f}) {
        builder.box({x, 1.25f, -0.55f}, {0.08f, 2.5f, 0.08f}, kDarkWood, Surface::wood);
        builder.box({x, 1.02f, 0.55f}, {0.08f, 2.04f, 0.08f}, kDarkWood, Surface::wood);
    }
    builder.box({0.0f, 0.42f, 0.28f}, {2.0f, 0.84f, 0.06f}, kWood, Surface::wood);
    builder.box({0.0f, 0.86f, 0.1f}, {2.14f, 0.06f, 0.62f}, kWood * 1.3f, Surface::wood);
    const glm::mat4 slope = glm::rotate(glm::mat4(1.0f), 0.36f, glm::vec3(1.0f, 0.0f, 0.0f));
    builder.add(Shape::box, {0.0f, 2.3f, 0.12f}, {2.3f, 0.025f, 1.62f}, color, Surface::stripes, slope);
    builder.box({0.0f, 1.93f, 0.875f}, {2.3f, 0.2f, 0.02f}, color, Surface::stripes); // hangs down in front
    addGoods(builder, number);
    if (number % 2 == 0) {
        builder.add(Shape::cylinder, {1.35f, 0.4f, 0.45f}, {0.52f, 0.8f, 0.52f}, kWood * 1.1f, Surface::wood);
    } else {
        builder.box({-1.35f, 0.24f, 0.4f}, {0.48f, 0.48f, 0.48f}, kWood * 1.4f, Surface::wood);
        builder.box({-1.31f, 0.66f, 0.36f}, {0.4f, 0.36f, 0.4f}, kWood * 1.2f, Surface::wood);
    }
}

void addStalls(Builder& builder) {
    constexpr glm::vec3 kAwnings[] = {{0.52f, 0.055f, 0.04f},
                                      {0.05f, 0.17f, 0.34f},
                                      {0.60f, 0.36f, 0.05f},
                                      {0.08f, 0.24f, 0.10f},
                                      {0.30f, 0.06f, 0.20f}};
    uint32_t number = 0;
    for (const float side : {-1.0f, 1.0f}) {
        for (uint32_t i = 0; i < 5; ++i, ++number) {
            builder.setFrame(frameAt(side * 6.0f, 4.0f - 2.6f * static_cast<float>(i), -side * glm::half_pi<float>()));
            addStall(builder, number, kAwnings[(number * 3 + (side > 0.0f ? 1 : 0)) % std::size(kAwnings)]);
        }
    }
}

void addFountain(Builder& builder) {
    builder.setFrame(glm::mat4(1.0f));
    builder.add(Shape::cylinder, {0.0f, 0.06f, 0.0f}, {2.9f, 0.12f, 2.9f}, kStone, Surface::stone);
    builder.add(Shape::cylinder, {0.0f, 0.26f, 0.0f}, {2.3f, 0.52f, 2.3f}, kStone * 1.15f, Surface::stone);
    builder.add(Shape::cylinder, {0.0f, 0.527f, 0.0f}, {2.02f, 0.01f, 2.02f}, {0.03f, 0.10f, 0.12f}, Surface::water);
    builder.add(Shape::cylinder, {0.0f, 0.95f, 0.0f}, {0.34f, 1.1f, 0.34f}, kStone * 1.1f, Surface::stone);
    builder.add(Shape::cylinder, {0.0f, 1.5f, 0.0f}, {1.05f, 0.12f, 1.05f}, kStone * 1.2f, Surface::stone);
    builder.add(Shape::cylinder, {0.0f, 1.563f, 0.0f}, {0.92f, 0.01f, 0.92f}, {0.03f, 0.10f, 0.12f}, Surface::water);
    builder.add(Shape::ball, {0.0f, 1.8f, 0.0f}, glm::vec3(0.5f), {0.42f, 0.26f, 0.09f}, Surface::plain);
}

/// A front of `width`, with its eaves at `height` and the gable towards +Z.
void addHouse(Builder& builder, float width, float height, float depth, glm::vec3 wall, glm::vec3 roof) {
    builder.box({0.0f, 0.5f * height, 0.0f}, {width, height, depth}, wall, Surface::timbered);
    builder.box({0.0f, 0.3f, 0.02f}, {width + 0.06f, 0.6f, depth}, kStone, Surface::stone);
    builder.add(Shape::gable, {0.0f, height + 0.35f * width, 0.0f}, {width + 0.02f, 0.7f * width, depth}, wall,
                Surface::timbered);
    // Two slopes of tiles over the gable, which reach over the walls.
    const float slope = std::atan2(0.7f * width, 0.5f * width), along = std::hypot(0.7f * width, 0.5f * width) + 0.45f;
    for (const float side : {-1.0f, 1.0f}) {
        const glm::vec2 out(std::cos(slope), -std::sin(slope)); // down the slope
        const glm::vec3 middle(side * (0.25f * width + 0.22f * out.x + 0.05f),
                               height + 0.35f * width + 0.22f * out.y + 0.07f, 0.0f);
        builder.add(Shape::box, middle, {along, 0.09f, depth + 0.5f}, roof, Surface::tiles,
                    glm::rotate(glm::mat4(1.0f), -side * slope, glm::vec3(0.0f, 0.0f, 1.0f)));
    }
    builder.box({0.0f, 1.05f, 0.5f * depth + 0.01f}, {1.0f, 2.1f, 0.06f}, kDarkWood, Surface::wood);
}

void addHouses(Builder& builder) {
    constexpr glm::vec3 kWalls[] = {{0.66f, 0.58f, 0.44f},
                                    {0.60f, 0.42f, 0.30f},
                                    {0.55f, 0.56f, 0.50f},
                                    {0.70f, 0.62f, 0.52f},
                                    {0.58f, 0.48f, 0.32f}};
    constexpr glm::vec3 kRoofs[] = {{0.30f, 0.095f, 0.055f}, {0.24f, 0.085f, 0.055f}, {0.17f, 0.10f, 0.08f}};
    uint32_t number = 0;
    const auto house = [&](float x, float z, float heading, float width, float height) {
        builder.setFrame(frameAt(x, z, heading));
        addHouse(builder, width, height, 5.0f, kWalls[number % std::size(kWalls)], kRoofs[number % std::size(kRoofs)]);
        ++number;
    };
    for (uint32_t i = 0; i < 5; ++i) { // the far side
        const float widths[] = {4.2f, 3.6f, 4.6f, 3.8f, 4.3f}, heights[] = {4.6f, 5.6f, 4.9f, 6.0f, 4.4f};
        house(-8.6f + 4.3f * static_cast<float>(i), -13.6f, 0.0f, widths[i], heights[i]);
    }
    for (const float side : {-1.0f, 1.0f}) {
        for (uint32_t i = 0; i < 5; ++i) {
            const float heights[] = {4.8f, 5.5f, 4.3f, 5.9f, 5.0f};
            house(side * 11.6f, 6.2f - 4.2f * static_cast<float>(i), -side * glm::half_pi<float>(), 4.1f,
                  heights[(i + (side > 0.0f ? 2 : 0)) % 5]);
        }
    }
}

/// Pennants on lines across the place.
void addPennants(Builder& builder) {
    constexpr glm::vec3 kColors[] = {
        {0.55f, 0.06f, 0.04f}, {0.66f, 0.44f, 0.06f}, {0.05f, 0.2f, 0.38f}, {0.10f, 0.28f, 0.12f}};
    builder.setFrame(glm::mat4(1.0f));
    for (const float z : {-8.3f, -3.1f}) {
        constexpr uint32_t kPennants = 26;
        for (uint32_t i = 0; i <= kPennants; ++i) {
            const float t = 2.0f * static_cast<float>(i) / kPennants - 1.0f;
            const float height = 4.1f + 0.75f * t * t;
            const float slope = std::atan(1.5f * t / 9.2f);
            const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), slope, glm::vec3(0.0f, 0.0f, 1.0f));
            builder.add(Shape::box, {9.2f * t, height, z}, {0.74f, 0.015f, 0.015f}, kDarkWood, Surface::plain, turn);
            builder.add(Shape::gable, {9.2f * t, height - 0.17f, z}, {0.3f, 0.34f, 0.01f},
                        kColors[i % std::size(kColors)], Surface::cloth,
                        turn * glm::rotate(glm::mat4(1.0f), glm::pi<float>(), glm::vec3(0.0f, 0.0f, 1.0f)));
        }
    }
}

} // namespace

Props makeProps() {
    Builder builder;
    addStalls(builder);
    addFountain(builder);
    addHouses(builder);
    addPennants(builder);
    return builder.props();
}

} // namespace market
