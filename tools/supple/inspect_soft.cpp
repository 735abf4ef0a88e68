#include "tools/supple/inspect_soft.h"

#include "cage/message.h"

#include <algorithm>
#include <cstdio>

namespace supple::tools {

namespace {

size_t vertexCount(const std::vector<cage::PaintedWeight>& weights, size_t index) {
    return static_cast<size_t>(std::ranges::count(weights, index, &cage::PaintedWeight::index));
}

} // namespace

nlohmann::ordered_json jigglesToJson(const cage::Character& character) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (size_t j = 0; j < character.jiggles.size(); ++j) {
        const cage::Jiggle& own = character.jiggles[j];
        list.push_back({{"frequency", own.frequency},
                        {"damping", own.damping},
                        {"limit", own.limit},
                        {"vertices", vertexCount(character.weights.jiggles, j)}});
    }
    return list;
}

nlohmann::ordered_json clothsToJson(const cage::Character& character) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (size_t c = 0; c < character.cloths.size(); ++c) {
        const cage::Cloth& own = character.cloths[c];
        list.push_back({{"stretch", own.stretch},
                        {"shear", own.shear},
                        {"bend", own.bend},
                        {"volume", own.volume},
                        {"tether", own.tether},
                        {"drag", own.drag},
                        {"air", own.air},
                        {"gravity", own.gravity},
                        {"hitRadius", own.hitRadius},
                        {"substeps", own.substeps},
                        {"colliders", own.colliders.size()},
                        {"vertices", vertexCount(character.weights.cloths, c)}});
    }
    return list;
}

std::vector<std::string> clothLines(const cage::Character& character) {
    std::vector<std::string> lines;
    for (size_t c = 0; c < character.cloths.size(); ++c) {
        const cage::Cloth& own = character.cloths[c];
        char text[160];
        std::snprintf(text, sizeof text, "stretch %g, shear %g, bend %g%s, %s: ", static_cast<double>(own.stretch),
                      static_cast<double>(own.shear), static_cast<double>(own.bend), own.volume ? ", volume kept" : "",
                      cage::counted(own.colliders.size(), "collider", "colliders").c_str());
        lines.push_back(text + cage::counted(vertexCount(character.weights.cloths, c), "vertex", "vertices"));
    }
    return lines;
}

std::vector<std::string> jiggleLines(const cage::Character& character) {
    std::vector<std::string> lines;
    for (size_t j = 0; j < character.jiggles.size(); ++j) {
        const cage::Jiggle& own = character.jiggles[j];
        char text[96];
        std::snprintf(text, sizeof text, "%g Hz, damping %g, at most %g: ", static_cast<double>(own.frequency),
                      static_cast<double>(own.damping), static_cast<double>(own.limit));
        lines.push_back(text + cage::counted(vertexCount(character.weights.jiggles, j), "vertex", "vertices"));
    }
    return lines;
}

} // namespace supple::tools
