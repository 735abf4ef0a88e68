// Boxes of posed cages, for tests of what bounds them.
#pragma once

#include "skinning/box.h"

#include <glm/glm.hpp>
#include <vector>

namespace supple::test {

inline skinning::Box boxAround(const std::vector<glm::dvec3>& points) {
    skinning::Box box = skinning::emptyBox();
    for (const glm::dvec3& p : points) {
        skinning::extend(box, p);
    }
    return box;
}

inline bool holds(const skinning::Box& outer, const skinning::Box& inner) {
    return glm::all(glm::lessThanEqual(outer.low, inner.low)) &&
           glm::all(glm::greaterThanEqual(outer.high, inner.high));
}

inline double diagonal(const skinning::Box& box) {
    return glm::length(box.high - box.low);
}

} // namespace supple::test
