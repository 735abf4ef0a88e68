#include "cage/gltf/normals.h"

#include "cage/corner_normals.h"
#include "cage/gltf/accessors.h"

namespace supple::cage::gltf {

namespace {

/// The components of an attribute of directions; empty if the primitive does not have it.
std::vector<float> readDirections(const Document& document, const file::Primitive& primitive, const char* attribute,
                                  int type, size_t vertexCount, const std::string& name) {
    const auto found = primitive.attributes.find(attribute);
    if (found == primitive.attributes.end()) {
        return {};
    }
    checkVertexCount(document, found->second, vertexCount, name);
    return readFloats(document, found->second, type, kFloat, name, kNormalizedS8 | kNormalizedS16);
}

} // namespace

std::vector<glm::vec3> readNormals(const Document& document, const file::Primitive& primitive, size_t vertexCount,
                                   const std::string& element, Warnings& warnings) {
    const std::string name = element + " NORMAL";
    const std::vector<float> values = readDirections(document, primitive, "NORMAL", file::kVec3, vertexCount, name);
    std::vector<glm::vec3> normals;
    normals.reserve(values.size() / 3);
    size_t missing = 0;
    for (size_t i = 0; i < values.size(); i += 3) {
        normals.push_back(unitNormal({values[i], values[i + 1], values[i + 2]}));
        missing += normals.back() == glm::vec3(0.0f) ? 1 : 0;
    }
    if (missing > 0) {
        warn(warnings, name,
             counted(missing, "normal is", "normals are") + " zero or not finite; the faces' own instead");
    }
    return normals;
}

std::vector<glm::vec4> readTangents(const Document& document, const file::Primitive& primitive, size_t vertexCount,
                                    const std::string& element, Warnings& warnings) {
    if (primitive.attributes.count("NORMAL") == 0) {
        return {}; // glTF 2.0, 3.7.2.1: tangents without normals are to be ignored
    }
    const std::string name = element + " TANGENT";
    const std::vector<float> values = readDirections(document, primitive, "TANGENT", file::kVec4, vertexCount, name);
    std::vector<glm::vec4> tangents;
    tangents.reserve(values.size() / 4);
    size_t missing = 0;
    for (size_t i = 0; i < values.size(); i += 4) {
        tangents.push_back(unitTangent({values[i], values[i + 1], values[i + 2], values[i + 3]}));
        missing += tangents.back() == glm::vec4(0.0f) ? 1 : 0;
    }
    if (missing > 0) {
        warn(warnings, name,
             counted(missing, "tangent is", "tangents are") +
                 " zero or not finite; those of the texture coordinates instead");
    }
    return tangents;
}

} // namespace supple::cage::gltf
