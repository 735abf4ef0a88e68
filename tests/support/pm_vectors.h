// The stored P_m results of tests/data/pm: an independent double-precision implementation of the formulas.
#pragma once

#include "cage/character.h"
#include "surface/pm/mesh.h"
#include "tests/support/meshes.h"

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace supple::test {

struct PmVectors {
    std::string name;
    cage::Cage cage;                   ///< positions and crease scalars are the rounded ones
    std::vector<glm::dvec3> positions; ///< as stored
    struct Alpha {
        uint32_t vertex = 0, toward = 0;
        double alpha = 0.0;
    };
    std::vector<Alpha> alphas; ///< as stored

    Faces faces; ///< after the split
    std::vector<uint32_t> sourceFaces;
    std::vector<uint32_t> apexes; ///< of polar facets
    /// Closed fans begin at any of their edges.
    struct Fan {
        uint32_t vertex = 0;
        surface::pm::FanKind kind = surface::pm::FanKind::interior;
        uint32_t valence = 0;
        std::vector<uint32_t> edges; ///< the far vertices
        std::vector<uint32_t> faces;
        glm::dvec3 v{}, tau1{}, tau2{};
        std::vector<glm::dvec3> t, f;
    };
    std::vector<Fan> fans;
    struct Sample {
        std::vector<double> at; ///< u, v or sector, l1, l2
        glm::dvec3 position{}, normal{};
    };
    struct Patch {
        surface::PatchClass patchClass = surface::PatchClass::regular;
        std::vector<uint32_t> corners;
        std::vector<glm::dvec3> coefficients;
        std::vector<Sample> samples;
    };
    std::vector<Patch> patches; ///< one a face

    /// The mesh of the cage with the alphas as stored, not as floats.
    [[nodiscard]] surface::pm::Mesh mesh() const;
};

/// Every pm_*.json below tests/data/pm, by name. Throws what the JSON reader throws: the files are our own.
[[nodiscard]] const std::vector<PmVectors>& pmVectors();

} // namespace supple::test
