#include "tools/supple/inspect_parts.h"

#include "surface/choice.h"
#include "tools/common/schemes.h"

#include <set>

namespace supple::tools {
namespace {

struct PartContent {
    uint32_t faces = 0;
    std::set<uint32_t> vertices;
    std::set<uint32_t> materials; ///< without faces that have none
};

PartContent contentOf(const cage::Character& character, size_t part) {
    const cage::Cage& cage = character.cage;
    const uint32_t begin = character.parts[part].firstFace, end = cage::endFace(character, part);
    PartContent content;
    content.faces = end - begin;
    content.vertices.insert(cage.faceVertices.begin() + cage.faceStarts[begin],
                            cage.faceVertices.begin() + cage.faceStarts[end]);
    for (uint32_t f = begin; f < end && !cage.faceMaterials.empty(); ++f) {
        if (cage.faceMaterials[f] != cage::kNone) {
            content.materials.insert(cage.faceMaterials[f]);
        }
    }
    return content;
}

} // namespace

nlohmann::ordered_json partsToJson(const cage::Character& character) {
    const std::vector<surface::SchemeChoice> choices = surface::chooseSchemes(character);
    nlohmann::ordered_json parts = nlohmann::ordered_json::array();
    for (size_t p = 0; p < character.parts.size(); ++p) {
        const cage::Part& part = character.parts[p];
        const PartContent content = contentOf(character, p);
        parts.push_back({{"name", part.name},
                         {"node", part.node},
                         {"rigid", part.rigid},
                         {"faces", content.faces},
                         {"vertices", content.vertices.size()},
                         {"polygonSource", cage::polygonSourceName(part.polygonSource)},
                         {"weldSource", cage::weldSourceName(part.weldSource)},
                         {"morphTargets", part.targetCount},
                         {"scheme", schemeName(static_cast<SuppleScheme>(choices[p].scheme))},
                         {"schemeReason", choices[p].reason},
                         {"materials", content.materials}});
    }
    return parts;
}

std::vector<std::string> partLines(const cage::Character& character) {
    const std::vector<surface::SchemeChoice> choices = surface::chooseSchemes(character);
    std::vector<std::string> lines;
    for (size_t p = 0; p < character.parts.size(); ++p) {
        const cage::Part& part = character.parts[p];
        const PartContent content = contentOf(character, p);
        std::string line = std::to_string(p) + "  " + (part.name.empty() ? "(no name)" : part.name) + "  " +
                           std::to_string(content.faces) + " faces, " + std::to_string(content.vertices.size()) +
                           " vertices, " + (part.rigid ? "rigid" : "skinned");
        if (part.polygonSource == cage::PolygonSource::pairedTriangles) {
            line += ", paired triangles";
        }
        if (part.targetCount > 0) {
            line += ", " + std::to_string(part.targetCount) + " morph targets";
        }
        std::string separator = ", materials ";
        for (const uint32_t material : content.materials) {
            const std::string& name = character.materials[material].name;
            line += separator + (name.empty() ? std::to_string(material) : name);
            separator = ", ";
        }
        line += std::string("; auto: ") + schemeName(static_cast<SuppleScheme>(choices[p].scheme)) + ", " +
                choices[p].reason;
        lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace supple::tools
