#include "tools/supple/inspect_jiggles.h"

#include "cage/message.h"

#include <algorithm>
#include <cstdio>

namespace supple::tools {

namespace {

size_t vertexCount(const cage::Character& character, size_t jiggle) {
    return static_cast<size_t>(std::ranges::count(character.weights.jiggles, jiggle, &cage::JiggleWeight::jiggle));
}

} // namespace

nlohmann::ordered_json jigglesToJson(const cage::Character& character) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (size_t j = 0; j < character.jiggles.size(); ++j) {
        const cage::Jiggle& own = character.jiggles[j];
        list.push_back({{"frequency", own.frequency},
                        {"damping", own.damping},
                        {"limit", own.limit},
                        {"vertices", vertexCount(character, j)}});
    }
    return list;
}

std::vector<std::string> jiggleLines(const cage::Character& character) {
    std::vector<std::string> lines;
    for (size_t j = 0; j < character.jiggles.size(); ++j) {
        const cage::Jiggle& own = character.jiggles[j];
        char text[96];
        std::snprintf(text, sizeof text, "%g Hz, damping %g, at most %g: ", static_cast<double>(own.frequency),
                      static_cast<double>(own.damping), static_cast<double>(own.limit));
        lines.push_back(text + cage::counted(vertexCount(character, j), "vertex", "vertices"));
    }
    return lines;
}

} // namespace supple::tools
