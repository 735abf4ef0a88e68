#include "tests/support/blend_vectors.h"

#include "tests/support/json_vectors.h"
#include "tests/support/meshes.h"

#include <fstream>

namespace supple::test {
namespace {

using nlohmann::json;
using surface::blend::CreaseMode;

/// Rows of grids of vectors, one a face.
std::vector<std::vector<glm::dvec3>> gridsOf(const json& faces) {
    std::vector<std::vector<glm::dvec3>> grids;
    for (const json& rows : faces) {
        std::vector<glm::dvec3>& grid = grids.emplace_back();
        for (const json& row : rows) {
            const std::vector<glm::dvec3> values = jsonVectors(row);
            grid.insert(grid.end(), values.begin(), values.end());
        }
    }
    return grids;
}

BlendVectors readBlend(const json& j, const std::string& name) {
    BlendVectors v;
    v.name = name;
    const bool cut = v.name.size() > 4 && v.name.substr(v.name.size() - 4) == "_cut";
    v.options.creases = cut ? CreaseMode::cut : CreaseMode::curve;
    v.positions = jsonVectors(j.at("vertices"));
    v.cage = makeCage({v.positions.begin(), v.positions.end()}, j.at("faces").get<Faces>());
    for (const json& edge : j.at("sharp")) {
        v.cage.creases.push_back({edge.at(0), edge.at(1), 1.0f});
    }
    v.grid = j.at("grid");
    v.points = gridsOf(j.at("points"));
    v.normals = gridsOf(j.at("normals"));
    for (uint32_t i = 0; i < v.positions.size(); ++i) {
        const json& first = j.at("fans").at(i).at("sectors").at(0);
        BlendVectors::Vertex& vertex = v.vertices.emplace_back();
        vertex.type = j.at("types").at(i);
        vertex.firstFace = first.at(0);
        vertex.firstCorner = first.at(1);
        if (vertex.type == "cut") {
            for (const auto& side : j.at("cut").at(std::to_string(i)).items()) {
                vertex.coefficients.push_back(jsonVectors(side.value()));
            }
        } else {
            vertex.coefficients.push_back(jsonVectors(j.at("coefficients").at(i)));
        }
    }
    return v;
}

} // namespace

const std::vector<BlendVectors>& blendVectors() {
    static const std::vector<BlendVectors> kAll = readJsonFolder("blend", readBlend);
    return kAll;
}

std::map<std::string, std::vector<std::vector<double>>> storedFitMatrices() {
    return parseFile(SUPPLE_TEST_DATA "/blend/tables/fit_matrices.json")
        .get<std::map<std::string, std::vector<std::vector<double>>>>();
}

} // namespace supple::test
