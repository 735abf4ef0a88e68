#include "cage/gltf/normals.h"

#include "cage/corner_normals.h"
#include "cage/gltf/accessors.h"

namespace supple::cage::gltf {

std::vector<glm::vec3> readNormals(const Document& document, const supple_tinygltf::Primitive& primitive,
                                   size_t vertexCount, const std::string& element, Warnings& warnings) {
    std::vector<glm::vec3> normals;
    const auto found = primitive.attributes.find("NORMAL");
    if (found == primitive.attributes.end()) {
        return normals;
    }
    const std::string name = element + " NORMAL";
    const uint32_t allowed =
        isUsed(document, "KHR_mesh_quantization") ? kFloat | kNormalizedS8 | kNormalizedS16 : uint32_t{kFloat};
    checkVertexCount(document, found->second, vertexCount, name);
    const std::vector<float> values = readFloats(document, found->second, TINYGLTF_TYPE_VEC3, allowed, name);
    normals.reserve(vertexCount);
    size_t missing = 0;
    for (size_t v = 0; v < vertexCount; ++v) {
        normals.push_back(unitNormal({values[3 * v], values[3 * v + 1], values[3 * v + 2]}));
        missing += normals.back() == glm::vec3(0.0f) ? 1 : 0;
    }
    if (missing > 0) {
        warn(warnings, name,
             counted(missing, "normal is", "normals are") + " zero or not finite; the faces' own instead");
    }
    return normals;
}

} // namespace supple::cage::gltf
