#include "tests/support/prep_vectors.h"

#include "tests/support/meshes.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace supple::test {
namespace {

using nlohmann::json;

glm::dvec3 vector(const json& j) {
    return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

std::vector<glm::dvec3> vectors(const json& j) {
    std::vector<glm::dvec3> result;
    for (const json& v : j) {
        result.push_back(vector(v));
    }
    return result;
}

template <size_t N>
std::array<glm::dvec3, N> fixedVectors(const json& j) {
    std::array<glm::dvec3, N> result;
    for (size_t i = 0; i < N; ++i) {
        result[i] = vector(j.at(i));
    }
    return result;
}

PrepVectors read(const std::filesystem::path& path) {
    std::ifstream file(path);
    const json j = json::parse(file);
    PrepVectors v;
    v.name = j.at("name").get<std::string>();
    v.positions = vectors(j.at("vertices"));
    v.cage = makeCage({v.positions.begin(), v.positions.end()}, j.at("faces").get<Polygons>());
    v.options.cornerRule =
        j.at("corner_rule") == "smooth" ? surface::prep::CornerRule::smooth : surface::prep::CornerRule::sharp;
    v.options.tangentMode =
        j.at("tangent_mode") == "printed" ? surface::prep::TangentMode::printed : surface::prep::TangentMode::standard;
    v.effectiveValences = j.at("effective_valence").get<std::vector<uint32_t>>();
    v.boundary = j.at("boundary").get<std::vector<bool>>();
    v.limitPoints = vectors(j.at("limit_points"));
    v.limitNormals = vectors(j.at("limit_normals"));
    for (uint32_t f = 0; f < v.cage.faceCount(); ++f) {
        v.faces.push_back({fixedVectors<16>(j.at("g").at(f)), fixedVectors<16>(j.at("h").at(f)),
                           fixedVectors<25>(j.at("positions").at(f)), fixedVectors<25>(j.at("normals").at(f))});
    }
    return v;
}

} // namespace

const std::vector<PrepVectors>& prepVectors() {
    static const std::vector<PrepVectors> kAll = [] {
        std::vector<std::filesystem::path> paths;
        for (const auto& entry : std::filesystem::directory_iterator(SUPPLE_TEST_DATA "/prep")) {
            if (entry.path().extension() == ".json") {
                paths.push_back(entry.path());
            }
        }
        std::sort(paths.begin(), paths.end());
        std::vector<PrepVectors> all;
        for (const auto& path : paths) {
            all.push_back(read(path));
        }
        return all;
    }();
    return kAll;
}

} // namespace supple::test
