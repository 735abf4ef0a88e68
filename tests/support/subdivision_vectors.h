// The stored subdivision results of tests/data/subdivision: an independent double-precision implementation of the
// formulas.
#pragma once

#include "cage/character.h"
#include "surface/subdivision/pattern.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace supple::test {

struct SubdivisionVectors {
    std::string name;
    surface::subdivision::Subdivision subdivision = surface::subdivision::Subdivision::catmullClark;
    uint32_t depth = 0;                ///< the isolated level's steps included
    cage::Cage cage;                   ///< its positions are the rounded ones
    std::vector<glm::dvec3> positions; ///< as stored
    std::vector<glm::dvec3> isolated;
    struct Sector {
        uint32_t face = 0; ///< of the isolated level
        uint32_t side = 0; ///< segments along it
        std::vector<glm::dvec3> refined, limits, normals;
    };
    std::vector<Sector> sectors;
};

/// Every .json in tests/data/subdivision, by name. Throws what the JSON reader throws: the files are our own.
[[nodiscard]] const std::vector<SubdivisionVectors>& subdivisionVectors();

/// The first rows of a pattern table as stored.
struct StoredPattern {
    surface::subdivision::Fan fan;
    struct Row {
        uint32_t point = 0;
        surface::subdivision::Rule rule = surface::subdivision::Rule::vertex;
        uint32_t spoke = surface::subdivision::kNoSpoke;
        /// Of Catmull-Clark's vertices: the point, its edge neighbors and its face neighbors, both as opposite pairs.
        std::vector<uint32_t> sources;
    };
    std::vector<Row> rows;
};
[[nodiscard]] std::vector<StoredPattern> storedPatterns();

} // namespace supple::test
