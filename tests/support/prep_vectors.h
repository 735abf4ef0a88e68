// The stored p-rep results of tests/data/prep: an independent double-precision implementation of the formulas.
#pragma once

#include "cage/character.h"
#include "surface/prep/weights.h"

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace supple::test {

struct PrepVectors {
    std::string name;
    cage::Cage cage;                   ///< its positions are the rounded ones
    std::vector<glm::dvec3> positions; ///< as stored
    surface::prep::Options options;
    std::vector<uint32_t> effectiveValences;
    std::vector<bool> boundary;
    std::vector<glm::dvec3> limitPoints, limitNormals; ///< per vertex
    struct Face {
        std::array<glm::dvec3, 16> g, h;               ///< g[i + 4 j], h[4 e + s]
        std::array<glm::dvec3, 25> positions, normals; ///< [a + 5 b] at u = a/4, v = b/4
    };
    std::vector<Face> faces;
};

/// Every prep_*.json below tests/data/prep, by name. Throws what the JSON reader throws: the files are our own.
[[nodiscard]] const std::vector<PrepVectors>& prepVectors();

} // namespace supple::test
