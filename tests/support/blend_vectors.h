// The stored blending surfaces of tests/data/blend: an independent double-precision implementation of the formulas.
#pragma once

#include "surface/blend/mesh.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace supple::test {

struct BlendVectors {
    std::string name;
    surface::blend::Options options;
    cage::Cage cage;                                      ///< its positions are the rounded ones
    std::vector<glm::dvec3> positions;                    ///< as stored
    uint32_t grid = 4;                                    ///< segments along a face
    std::vector<std::vector<glm::dvec3>> points, normals; ///< per face, in grid order
    struct Vertex {
        std::string type;
        uint32_t firstFace = 0, firstCorner = 0; ///< of the stored fan
        /// Of the whole vertex; of curves the three Bezier points, of cuts side by side.
        std::vector<std::vector<glm::dvec3>> coefficients;
    };
    std::vector<Vertex> vertices;
};

/// Every .json in tests/data/blend, by name. Throws what the JSON reader throws: the files are our own.
[[nodiscard]] const std::vector<BlendVectors>& blendVectors();

/// 9 x (1 + ring points) weights on the vertex and its ring, by "closed_5" or "open_3".
[[nodiscard]] std::map<std::string, std::vector<std::vector<double>>> storedFitMatrices();

} // namespace supple::test
