#include "tests/support/prep_vectors.h"

#include "tests/support/json_vectors.h"
#include "tests/support/meshes.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace supple::test {
namespace {

using nlohmann::json;

template <size_t N>
std::array<glm::dvec3, N> fixedVectors(const json& j) {
    std::array<glm::dvec3, N> result;
    for (size_t i = 0; i < N; ++i) {
        result[i] = jsonVector(j.at(i));
    }
    return result;
}

PrepVectors readPrep(const json& j, const std::string&) {
    PrepVectors v;
    v.name = j.at("name").get<std::string>();
    v.positions = jsonVectors(j.at("vertices"));
    v.cage = makeCage({v.positions.begin(), v.positions.end()}, j.at("faces").get<Faces>());
    v.options.cornerRule =
        j.at("corner_rule") == "smooth" ? surface::prep::CornerRule::smooth : surface::prep::CornerRule::sharp;
    v.options.tangentMode =
        j.at("tangent_mode") == "printed" ? surface::prep::TangentMode::printed : surface::prep::TangentMode::standard;
    v.effectiveValences = j.at("effective_valence").get<std::vector<uint32_t>>();
    v.boundary = j.at("boundary").get<std::vector<bool>>();
    v.limitPoints = jsonVectors(j.at("limit_points"));
    v.limitNormals = jsonVectors(j.at("limit_normals"));
    for (uint32_t f = 0; f < v.cage.faceCount(); ++f) {
        v.faces.push_back({fixedVectors<16>(j.at("g").at(f)), fixedVectors<16>(j.at("h").at(f)),
                           fixedVectors<25>(j.at("positions").at(f)), fixedVectors<25>(j.at("normals").at(f))});
    }
    return v;
}

} // namespace

const std::vector<PrepVectors>& prepVectors() {
    static const std::vector<PrepVectors> kAll = readJsonFolder("prep", readPrep);
    return kAll;
}

} // namespace supple::test
