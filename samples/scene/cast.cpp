#include "cast.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>
#include <random>

namespace market {

namespace {

// Units a second of the ground under the clips (samples/assets/README.md).
constexpr float kWrenWalk = 0.672f, kWrenRun = 1.958f, kPipWalk = 0.406f;

class Casting {
public:
    std::vector<Figure> figures;

    float uniform(float low, float high) {
        return low + (high - low) * static_cast<float>(random_() >> 8) / static_cast<float>(1u << 24);
    }

    Figure& person(glm::vec2 place, float heading, const char* clip) {
        Figure& figure = add(Kind::wren, place, heading, clip);
        figure.size = uniform(0.94f, 1.06f);
        figure.scarf = uniform(0.0f, 1.0f) < 0.4f;
        // Dyes: madder, ochre, moss, woad, plum, undyed; hair from black to straw; leather from tan to black.
        constexpr float kDyes[] = {0.0f, 1.1f, 2.2f, 3.1f, -1.5f, -0.7f};
        const float dye = kDyes[figures.size() % std::size(kDyes)];
        figure.tints = {glm::vec4(dye + uniform(-0.2f, 0.2f), uniform(0.8f, 1.5f), uniform(0.8f, 1.9f), 0.0f),
                        glm::vec4(uniform(-0.05f, 0.3f), uniform(0.4f, 1.0f), uniform(0.45f, 1.6f), 0.0f),
                        glm::vec4(uniform(-0.1f, 0.1f), uniform(0.6f, 1.1f), uniform(0.7f, 1.3f), 0.0f),
                        glm::vec4(0.0f, uniform(0.95f, 1.15f), uniform(0.55f, 1.02f), 0.0f)};
        return figure;
    }

    Figure& dragon(glm::vec2 place, float heading, const char* clip, float size) {
        Figure& figure = add(figures.size() % 2 == 0 ? Kind::pip : Kind::pipQuads, place, heading, clip);
        figure.size = size * uniform(0.92f, 1.08f);
        figure.tints.fill(glm::vec4(uniform(-1.9f, 1.9f), uniform(0.5f, 0.8f), uniform(0.8f, 1.1f), 0.0f));
        return figure;
    }

    static void walk(Figure& figure, float radius, float turn, float stride) {
        figure.radius = radius;
        figure.turn = turn;
        figure.stride = stride;
    }

private:
    Figure& add(Kind kind, glm::vec2 place, float heading, const char* clip) {
        Figure& figure = figures.emplace_back();
        figure.kind = kind;
        figure.place = place;
        figure.heading = heading;
        figure.clip = clip;
        figure.phase = uniform(0.0f, 1.0f);
        figure.speed = uniform(0.93f, 1.07f);
        return figure;
    }

    std::mt19937 random_{11};
};

float towards(glm::vec2 from, glm::vec2 to) {
    return std::atan2(to.x - from.x, to.y - from.y);
}

/// Behind every stall of props.cpp somebody sells, and before it somebody looks.
void addStalls(Casting& casting) {
    for (const float side : {-1.0f, 1.0f}) {
        for (uint32_t i = 0; i < 5; ++i) {
            const float z = 4.0f - 2.6f * static_cast<float>(i);
            const glm::vec2 behind(side * 6.75f, z + casting.uniform(-0.3f, 0.3f));
            casting.person(behind, -side * glm::half_pi<float>() + casting.uniform(-0.3f, 0.3f),
                           i % 3 == 1 ? "wave" : "idle");
            const glm::vec2 before(side * 4.75f, z + casting.uniform(-0.7f, 0.7f));
            const float looks = side * glm::half_pi<float>() + casting.uniform(-0.4f, 0.4f);
            if (i % 2 == 0)
                casting.person(before, looks, "idle");
            else
                casting.dragon(before, looks, "idle", 0.8f);
        }
    }
}

/// Two who talk.
void addPairs(Casting& casting) {
    constexpr glm::vec2 kPairs[] = {{-2.6f, 4.6f}, {2.3f, 5.2f}, {-3.4f, -4.6f}, {3.1f, -5.0f}, {0.2f, -6.2f}};
    for (const glm::vec2 middle : kPairs) {
        const float angle = casting.uniform(0.0f, glm::two_pi<float>());
        const glm::vec2 half = 0.42f * glm::vec2(std::sin(angle), std::cos(angle));
        casting.person(middle + half, towards(middle + half, middle), "idle");
        if (casting.uniform(0.0f, 1.0f) < 0.6f)
            casting.person(middle - half, towards(middle - half, middle), "idle");
        else
            casting.dragon(middle - half, towards(middle - half, middle), "idle", 0.75f);
    }
}

/// Small dragons leap for joy round the fountain.
void addFountain(Casting& casting) {
    for (uint32_t i = 0; i < 8; ++i) {
        const float angle = (static_cast<float>(i) + casting.uniform(0.1f, 0.9f)) * glm::two_pi<float>() / 8.0f;
        const glm::vec2 place = 1.75f * glm::vec2(std::sin(angle), std::cos(angle));
        casting.dragon(place, angle + glm::pi<float>() * (i % 3 == 0 ? 0.0f : 1.0f), i % 2 == 0 ? "joy" : "idle",
                       0.48f);
    }
}

/// Rings round the fountain: the inner ones walk against the outer one, and two guards run.
void addWalkers(Casting& casting) {
    struct Ring {
        float radius, turn;
        uint32_t count;
    };
    constexpr Ring kRings[] = {{2.55f, 1.0f, 8}, {3.45f, -1.0f, 10}};
    for (const Ring& ring : kRings) {
        for (uint32_t i = 0; i < ring.count; ++i) {
            const float angle = (static_cast<float>(i) + casting.uniform(-0.15f, 0.15f)) * glm::two_pi<float>() /
                                static_cast<float>(ring.count);
            const float radius = ring.radius + casting.uniform(-0.15f, 0.15f);
            if (i % 3 == 2) {
                Figure& figure = casting.dragon({0.0f, 0.0f}, angle, "walk", 0.9f);
                figure.speed *= 1.4f; // keeps up with the others
                Casting::walk(figure, radius, ring.turn, kPipWalk);
            } else {
                Casting::walk(casting.person({0.0f, 0.0f}, angle, "walk"), radius, ring.turn, kWrenWalk);
            }
        }
    }
    for (const float angle : {0.4f, 0.62f}) {
        Figure& guard = casting.person({0.0f, 0.0f}, angle, "run");
        guard.armed = true;
        guard.tints[0] = glm::vec4(0.0f, 1.0f, 1.0f, 0.0f);
        Casting::walk(guard, 4.1f, 1.0f, kWrenRun);
    }
    Figure& watch = casting.person({-1.2f, 7.0f}, 2.6f, "idle");
    watch.armed = true;
    Figure& drill = casting.person({1.5f, -8.0f}, 0.3f, "attack");
    drill.armed = true;
}

/// What a walker has gone in a second.
float pace(const Figure& figure) {
    return figure.stride * figure.speed * figure.size;
}

} // namespace

std::vector<Figure> makeCast(uint32_t count) {
    Casting casting;
    addStalls(casting);
    addPairs(casting);
    addFountain(casting);
    addWalkers(casting);
    // Steps of the golden ratio: the first few come from everywhere.
    std::vector<size_t> order(casting.figures.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const auto rank = [](size_t i) { return std::fmod(0.6180339887 * static_cast<double>(i), 1.0); };
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return rank(a) < rank(b); });
    std::vector<Figure> cast;
    for (size_t i = 0; i < std::min<size_t>(count, order.size()); ++i)
        cast.push_back(casting.figures[order[i]]);
    return cast;
}

glm::mat4 transformOf(const Figure& figure, double time) {
    glm::vec2 place = figure.place;
    float heading = figure.heading;
    if (figure.radius > 0.0f) {
        const double turned = std::fmod(time * pace(figure) / figure.radius, glm::two_pi<double>());
        const float angle = figure.heading + figure.turn * static_cast<float>(turned);
        place += figure.radius * glm::vec2(std::sin(angle), std::cos(angle));
        heading = angle + figure.turn * glm::half_pi<float>();
    }
    glm::mat4 transform = glm::translate(glm::mat4(1.0f), glm::vec3(place.x, 0.0f, place.y));
    transform = glm::rotate(transform, heading, glm::vec3(0.0f, 1.0f, 0.0f));
    return glm::scale(transform, glm::vec3(figure.size));
}

} // namespace market
