#include "skinning/jiggle_table.h"

#include "shaders/shared/pose.h"
#include "skinning/bits.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace supple::skinning {

namespace {

using cage::kNone;

/// sin(x) / x of a squared x, which may be negative: then sinh(y) / y of y^2 = -x^2.
double sineOver(double squares) {
    const double x = std::sqrt(std::abs(squares));
    if (x < 1e-4) {
        return 1.0 - squares / 6.0;
    }
    return (squares > 0.0 ? std::sin(x) : std::sinh(x)) / x;
}
double cosineOf(double squares) {
    const double x = std::sqrt(std::abs(squares));
    return squares > 0.0 ? std::cos(x) : std::cosh(x);
}

float towardsZero(double x) {
    const auto rounded = static_cast<float>(x);
    return std::abs(static_cast<double>(rounded)) > std::abs(x) ? std::nextafter(rounded, 0.0f) : rounded;
}

bool jiggles(const cage::Character& character, uint32_t vertex) {
    return !character.weights.jiggles.empty() && character.weights.jiggles[vertex].jiggle != kNone;
}

} // namespace

glm::vec4 jiggleSpring(const cage::Jiggle& jiggle) {
    const double step = 1.0 / shared::kSpringSteps;
    const double angular = 2.0 * glm::pi<double>() * static_cast<double>(jiggle.frequency);
    const double damping = static_cast<double>(jiggle.damping), decay = damping * angular;
    // Of the damped oscillation, squared: below 0 it creeps back instead.
    const double squares = angular * angular * (1.0 - damping * damping) * step * step;
    const double kept = std::exp(-decay * step), cosine = kept * cosineOf(squares);
    const double sine = kept * step * sineOver(squares);
    return {towardsZero(cosine + decay * sine), towardsZero(sine), towardsZero(-angular * angular * sine),
            towardsZero(cosine - decay * sine)};
}

JiggleTable buildJiggleTable(const cage::Character& character) {
    JiggleTable table;
    std::vector<uint32_t> work(character.cage.vertexCount(), 0);
    for (const cage::MorphTarget& target : character.morphs.targets) {
        for (const uint32_t vertex : target.vertices) {
            ++work[vertex];
        }
    }
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        if (!jiggles(character, v)) {
            continue;
        }
        const cage::JiggleWeight& own = character.weights.jiggles[v];
        const cage::Jiggle& jiggle = character.jiggles[own.jiggle];
        const glm::vec4 spring = jiggleSpring(jiggle);
        table.words.insert(table.words.end(), {v, bits(own.weight), bits(jiggle.limit), 0u});
        table.words.insert(table.words.end(), {bits(spring.x), bits(spring.y), bits(spring.z), bits(spring.w)});
        const uint32_t influences = character.weights.starts[v + 1] - character.weights.starts[v];
        table.mostWork = std::max(table.mostWork, work[v] + (influences + 1) / 2);
        ++table.vertexCount;
    }
    return table;
}

void markJiggleNodes(const cage::Character& character, ClipTable& table) {
    const auto mark = [&](uint32_t node) {
        for (; node != kNone; node = character.skeleton.nodes[node].parent) {
            uint32_t& flags = table.words[4 * size_t{shared::kNodeElements * table.places[node]} + 1];
            if ((flags & shared::kNodeOfJiggles) != 0) {
                return;
            }
            flags |= shared::kNodeOfJiggles;
        }
    };
    bool any = false;
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        if (jiggles(character, v)) {
            any = true;
            for (uint32_t i = character.weights.starts[v]; i < character.weights.starts[v + 1]; ++i) {
                mark(character.skin.joints[character.weights.influences[i].joint]);
            }
        }
    }
    for (const uint32_t node : table.driverNodes) {
        if (any) {
            mark(node);
        }
    }
}

} // namespace supple::skinning
