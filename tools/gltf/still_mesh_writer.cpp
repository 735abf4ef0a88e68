#include "tools/gltf/still_mesh_writer.h"

#include "cage/materials.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace supple::cage::gltf {
namespace {

json writeStillAttributes(const StillFaces& faces, size_t neededUvSets, Packer& packer) {
    constexpr Packer::Target kVertices = Packer::Target::vertices;
    json attributes;
    attributes["POSITION"] = packer.addFloats("VEC3", floatsOf(faces.positions), kVertices, true);
    if (!faces.normals.empty()) {
        attributes["NORMAL"] = packer.addFloats("VEC3", floatsOf(faces.normals), kVertices);
    }
    if (!faces.tangents.empty()) {
        attributes["TANGENT"] = packer.addFloats("VEC4", floatsOf(faces.tangents), kVertices);
    }
    // glTF counts texture coordinates without gaps, and a texture needs those it names: zeros where there are none.
    const size_t sets = std::max(neededUvSets, !faces.uvs[1].empty() ? size_t{2} : !faces.uvs[0].empty() ? 1 : 0);
    for (size_t set = 0; set < sets; ++set) {
        std::vector<glm::vec2> zeros(faces.uvs[set].empty() ? faces.positions.size() : 0, glm::vec2(0.0f));
        attributes["TEXCOORD_" + std::to_string(set)] =
            packer.addFloats("VEC2", floatsOf(zeros.empty() ? faces.uvs[set] : zeros), kVertices);
    }
    if (!faces.colors.empty()) {
        std::vector<uint32_t> channels;
        channels.reserve(4 * faces.colors.size());
        for (const auto& color : faces.colors) {
            channels.insert(channels.end(), color.begin(), color.end());
        }
        attributes["COLOR_0"] = packer.addIntegers("VEC4", channels, Packer::Component::u16, kVertices, true);
    }
    return attributes;
}

} // namespace

json writeStillMesh(const StillMesh& mesh, const Character& character, Packer& packer, GlbFile& file) {
    json primitives = json::array();
    for (const StillFaces& faces : mesh.faces) {
        const size_t uvSets = faces.material == kNone ? 0 : uvSetsOf(character.materials[faces.material]);
        const auto vertexCount = static_cast<uint32_t>(faces.positions.size());
        json primitive = {{"attributes", writeStillAttributes(faces, uvSets, packer)}, {"mode", 4}};
        primitive["indices"] = packer.addIntegers("SCALAR", faces.triangles, Packer::indexComponent(vertexCount - 1),
                                                  Packer::Target::indices);
        if (faces.material != kNone) {
            primitive["material"] = faces.material;
        }
        primitives.push_back(std::move(primitive));
        file.vertexCount += vertexCount;
    }
    json written = {{"primitives", std::move(primitives)}};
    if (!mesh.name.empty()) {
        written["name"] = mesh.name;
    }
    return written;
}

} // namespace supple::cage::gltf
