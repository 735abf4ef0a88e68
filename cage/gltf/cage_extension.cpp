#include "cage/gltf/cage_extension.h"

#include "cage/gltf/accessors.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

namespace supple::cage::gltf {
namespace {

void checkTogether(const CageExtension& extension, const char* a, int accessorA, const char* b, int accessorB) {
    if ((accessorA < 0) != (accessorB < 0)) {
        refuse(extension.element, std::string(accessorA < 0 ? b : a) + " without " + (accessorA < 0 ? a : b));
    }
}

/// A rule by OpenSubdiv's names. The scheme and its rules are the host's choice; what none here can follow is reported.
void checkRule(const Json& object, const char* key, std::initializer_list<std::string_view> followed,
               std::initializer_list<std::string_view> others, const std::string& element, Warnings& warnings) {
    const std::string value = stringMember(object, key, element);
    if (value.empty() || std::find(followed.begin(), followed.end(), value) != followed.end()) {
        return;
    }
    if (std::find(others.begin(), others.end(), value) == others.end()) {
        refuse(element + " " + key, quoted(value) + " is not allowed");
    }
    warn(warnings, element + " " + key, quoted(value) + " is not followed");
}

SharpList readSharpList(const Document& document, const CageExtension& extension, const char* indicesKey, int indices,
                        const char* sharpnessesKey, int sharpnesses, size_t width) {
    SharpList list;
    list.element = extension.element + " " + indicesKey;
    const std::string place = extension.element + " " + sharpnessesKey;
    list.vertices = readIntegers(document, indices, file::kScalar, kIntegers, list.element);
    list.sharpnesses = readFloats(document, sharpnesses, file::kScalar, kFloat, place);
    if (list.vertices.size() % width != 0 || list.vertices.size() / width != list.sharpnesses.size()) {
        refuse(place, counted(list.sharpnesses.size(), "sharpness", "sharpnesses") + " for " +
                          counted(list.vertices.size(), "index", "indices"));
    }
    for (size_t i = 0; i < list.sharpnesses.size(); ++i) {
        if (!std::isfinite(list.sharpnesses[i]) || list.sharpnesses[i] < 0.0f) {
            refuse(item(place, i), "not a number of at least 0");
        }
    }
    return list;
}

/// The crease sets as the file has them; each needs a name and a list of creases.
const Json* findCreaseSets(const Json& object, const CageExtension& extension, size_t accessors) {
    const Json* sets = arrayMember(object, "creaseSets", extension.element);
    if (sets == nullptr) {
        return nullptr;
    }
    if (extension.creaseIndices < 0) {
        refuse(extension.element, "creaseSets without creaseIndices");
    }
    for (size_t i = 0; i < sets->size(); ++i) {
        const std::string element = item(extension.element + " creaseSets", i);
        if (!(*sets)[i].isObject()) {
            refuse(element, "not an object");
        }
        if (stringMember((*sets)[i], "name", element).empty()) {
            refuse(element, "no name");
        }
        checkIndexMember((*sets)[i], "creases", element, "accessor", accessors, true);
    }
    return sets;
}

} // namespace

std::optional<CageExtension> findCageExtension(const Document& document, const Json& primitive,
                                               const std::string& element, Warnings& warnings) {
    if (!hasExtension(primitive, "SUPPLE_mesh_cage")) {
        return std::nullopt;
    }
    CageExtension extension;
    extension.element = element + " SUPPLE_mesh_cage";
    const Json* object = objectMember(primitive.at("extensions"), "SUPPLE_mesh_cage", element);
    if (object == nullptr) {
        return std::nullopt;
    }
    const auto accessor = [&](const char* key) {
        checkIndexMember(*object, key, extension.element, "accessor", document.model.accessors.size());
        return member(*object, key) == nullptr ? -1 : static_cast<int>(object->at(key).index());
    };
    extension.faceVertexCounts = accessor("faceVertexCounts");
    extension.faceVertexIndices = accessor("faceVertexIndices");
    extension.cageVertices = accessor("cageVertices");
    extension.creaseIndices = accessor("creaseIndices");
    extension.creaseSharpnesses = accessor("creaseSharpnesses");
    extension.cornerIndices = accessor("cornerIndices");
    extension.cornerSharpnesses = accessor("cornerSharpnesses");
    extension.creaseScalarIndices = accessor("creaseScalarIndices");
    extension.creaseScalars = accessor("creaseScalars");
    extension.holeIndices = accessor("holeIndices");
    checkTogether(extension, "faceVertexCounts", extension.faceVertexCounts, "faceVertexIndices",
                  extension.faceVertexIndices);
    checkTogether(extension, "creaseIndices", extension.creaseIndices, "creaseSharpnesses",
                  extension.creaseSharpnesses);
    checkTogether(extension, "cornerIndices", extension.cornerIndices, "cornerSharpnesses",
                  extension.cornerSharpnesses);
    checkTogether(extension, "creaseScalarIndices", extension.creaseScalarIndices, "creaseScalars",
                  extension.creaseScalars);
    if (extension.holeIndices >= 0 && extension.faceVertexCounts < 0) {
        refuse(extension.element, "holeIndices without faceVertexCounts");
    }
    extension.creaseSets = findCreaseSets(*object, extension, document.model.accessors.size());

    checkRule(*object, "scheme", {"catmullClark", "loop", "bilinear", "none"}, {}, extension.element, warnings);
    checkRule(*object, "interpolateBoundary", {"edgeAndCorner", "edgeOnly"}, {"none"}, extension.element, warnings);
    checkRule(*object, "faceVaryingLinearInterpolation",
              {"none", "cornersOnly", "cornersPlus1", "cornersPlus2", "boundaries", "all"}, {}, extension.element,
              warnings);
    const std::string uvs = stringMember(*object, "faceVaryingLinearInterpolation", extension.element);
    for (uint32_t mode = 0; mode <= static_cast<uint32_t>(UvMode::all); ++mode) {
        if (uvs == uvModeName(static_cast<UvMode>(mode))) {
            extension.uvMode = static_cast<UvMode>(mode);
        }
    }
    extension.roundCorners = stringMember(*object, "interpolateBoundary", extension.element) == "edgeOnly";
    const std::string scheme = stringMember(*object, "scheme", extension.element);
    for (uint32_t kind = 0; kind <= static_cast<uint32_t>(MadeFor::none); ++kind) {
        if (scheme == madeForName(static_cast<MadeFor>(kind))) {
            extension.madeFor = static_cast<MadeFor>(kind);
        }
    }
    checkRule(*object, "triangleSubdivisionRule", {"catmullClark"}, {"smooth"}, extension.element, warnings);
    return extension;
}

SharpList readCreaseList(const Document& document, const CageExtension& extension) {
    return readSharpList(document, extension, "creaseIndices", extension.creaseIndices, "creaseSharpnesses",
                         extension.creaseSharpnesses, 2);
}

SharpList readCornerList(const Document& document, const CageExtension& extension) {
    return readSharpList(document, extension, "cornerIndices", extension.cornerIndices, "cornerSharpnesses",
                         extension.cornerSharpnesses, 1);
}

SharpList readScalarList(const Document& document, const CageExtension& extension) {
    SharpList list = readSharpList(document, extension, "creaseScalarIndices", extension.creaseScalarIndices,
                                   "creaseScalars", extension.creaseScalars, 2);
    for (size_t i = 0; i < list.sharpnesses.size(); ++i) {
        if (list.sharpnesses[i] > 1.0f) {
            refuse(item(extension.element + " creaseScalars", i), "not a number from 0 to 1");
        }
    }
    return list;
}

std::vector<split::CreaseSet> readCreaseSets(const Document& document, const CageExtension& extension) {
    std::vector<split::CreaseSet> sets;
    for (size_t i = 0; extension.creaseSets != nullptr && i < extension.creaseSets->size(); ++i) {
        const Json& from = (*extension.creaseSets)[i];
        const std::string element = item(extension.element + " creaseSets", i);
        sets.push_back(
            {stringMember(from, "name", element), readIntegers(document, static_cast<int>(from.at("creases").index()),
                                                               file::kScalar, kIntegers, element + " creases")});
    }
    return sets;
}

} // namespace supple::cage::gltf
