#include "skinning/jiggle_table.h"

#include "shaders/shared/pose.h"
#include "skinning/bits.h"
#include "skinning/soft_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace supple::skinning {

namespace {

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

} // namespace

glm::vec4 jiggleSpring(const cage::Jiggle& jiggle) {
    const double step = 1.0 / shared::kStepsASecond;
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
    const std::vector<uint32_t> work = deformWork(character);
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        if (!jiggles(character, v)) {
            continue;
        }
        const cage::PaintedWeight& own = character.weights.jiggles[v];
        const cage::Jiggle& jiggle = character.jiggles[own.index];
        const glm::vec4 spring = jiggleSpring(jiggle);
        table.words.insert(table.words.end(), {v, bits(own.weight), bits(jiggle.limit), 0u});
        table.words.insert(table.words.end(), {bits(spring.x), bits(spring.y), bits(spring.z), bits(spring.w)});
        table.mostWork = std::max(table.mostWork, work[v]);
        ++table.vertexCount;
    }
    return table;
}

} // namespace supple::skinning
