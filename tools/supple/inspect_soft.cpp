#include "tools/supple/inspect_soft.h"

#include "cage/message.h"
#include "tools/common/formatted.h"
#include "tools/gltf/soft_numbers.h"

#include <algorithm>
#include <utility>

namespace supple::tools {

namespace {

size_t vertexCount(const std::vector<cage::PaintedWeight>& weights, size_t index) {
    return static_cast<size_t>(std::ranges::count(weights, index, &cage::PaintedWeight::index));
}

} // namespace

nlohmann::ordered_json jigglesToJson(const cage::Character& character) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (size_t j = 0; j < character.jiggles.size(); ++j) {
        nlohmann::ordered_json jiggle = cage::gltf::softNumbers(character.jiggles[j]);
        jiggle["vertices"] = vertexCount(character.weights.jiggles, j);
        list.push_back(std::move(jiggle));
    }
    return list;
}

nlohmann::ordered_json clothsToJson(const cage::Character& character) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (size_t c = 0; c < character.cloths.size(); ++c) {
        nlohmann::ordered_json cloth = cage::gltf::softNumbers(character.cloths[c]);
        cloth["colliders"] = character.cloths[c].colliders.size();
        cloth["vertices"] = vertexCount(character.weights.cloths, c);
        list.push_back(std::move(cloth));
    }
    return list;
}

std::vector<std::string> jiggleLines(const cage::Character& character) {
    std::vector<std::string> lines;
    for (size_t j = 0; j < character.jiggles.size(); ++j) {
        const cage::Jiggle& own = character.jiggles[j];
        const std::string text = formatted("%g Hz, damping %g, at most %g: ", static_cast<double>(own.frequency),
                                           static_cast<double>(own.damping), static_cast<double>(own.limit));
        lines.push_back(text + cage::counted(vertexCount(character.weights.jiggles, j), "vertex", "vertices"));
    }
    return lines;
}

std::vector<std::string> clothLines(const cage::Character& character) {
    std::vector<std::string> lines;
    for (size_t c = 0; c < character.cloths.size(); ++c) {
        const cage::Cloth& own = character.cloths[c];
        const std::string text =
            formatted("stretch %g, shear %g, bend %g%s, %s: ", static_cast<double>(own.stretch),
                      static_cast<double>(own.shear), static_cast<double>(own.bend), own.volume ? ", volume kept" : "",
                      cage::counted(own.colliders.size(), "collider", "colliders").c_str());
        lines.push_back(text + cage::counted(vertexCount(character.weights.cloths, c), "vertex", "vertices"));
    }
    return lines;
}

} // namespace supple::tools
