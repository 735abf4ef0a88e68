#include "cage/gltf/manifold.h"

#include "cage/gltf/accessors.h"
#include "cage/refusal.h"

#include <string>

namespace supple::cage::gltf {
namespace {

/// The JSON of a mesh's EXT_mesh_manifold, checked.
struct Manifold {
    std::string element;
    const Json* object = nullptr;
    const Json* primitive = nullptr; ///< manifoldPrimitive
    bool merges = false;             ///< has mergeIndices and mergeValues
};

Manifold checkManifold(const Document& document, size_t meshIndex, const Mesh& mesh,
                       std::span<const int> positionAccessors) {
    Manifold manifold;
    manifold.element = mesh.element + " EXT_mesh_manifold";
    const std::string& element = manifold.element;
    manifold.object = objectMember(document.meshes[meshIndex].at("extensions"), "EXT_mesh_manifold", mesh.element);
    const Json* object = manifold.object;
    manifold.primitive = object == nullptr ? nullptr : objectMember(*object, "manifoldPrimitive", element);
    const Json* primitive = manifold.primitive;
    const Json* attributes = primitive == nullptr ? nullptr : objectMember(*primitive, "attributes", element);
    if (attributes == nullptr) {
        refuse(element, "no manifoldPrimitive with attributes");
    }
    const size_t accessorCount = document.model.accessors.size();
    const std::string place = element + " manifoldPrimitive";
    checkIndexMember(*attributes, "POSITION", place, "accessor", accessorCount, true);
    checkIndexMember(*primitive, "indices", place, "accessor", accessorCount, true);
    checkIndexMember(*object, "mergeIndices", element, "accessor", accessorCount);
    checkIndexMember(*object, "mergeValues", element, "accessor", accessorCount);
    manifold.merges = member(*object, "mergeIndices") != nullptr;
    if (manifold.merges != (member(*object, "mergeValues") != nullptr)) {
        refuse(element, manifold.merges ? "mergeIndices without mergeValues" : "mergeValues without mergeIndices");
    }
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
        if (positionAccessors[p] != static_cast<int>(attributes->at("POSITION").index())) {
            refuse(place, "its POSITION is not that of " + mesh.primitives[p].element);
        }
    }
    return manifold;
}

/// The manifold's indices are those of the primitives but for the positions mergeIndices, which hold mergeValues
/// instead; so the vertices found there are one with these. Vertices count within one primitive.
VertexPairs readMerges(const Document& document, const Manifold& manifold, size_t vertexCount) {
    const std::string& element = manifold.element;
    const auto read = [&](const Json& number, const char* name, Sparse sparse) {
        return readIntegers(document, static_cast<int>(number.index()), file::kScalar, kIntegers, element + " " + name,
                            sparse);
    };
    const auto before = read(manifold.primitive->at("indices"), "manifoldPrimitive indices", Sparse::ignored);
    const auto positions = read(manifold.object->at("mergeIndices"), "mergeIndices", Sparse::applied);
    const auto values = read(manifold.object->at("mergeValues"), "mergeValues", Sparse::applied);
    if (positions.size() != values.size()) {
        refuse(element + " mergeValues",
               counted(values.size(), "value", "values") + " for " + counted(positions.size(), "index", "indices"));
    }
    VertexPairs pairs;
    for (size_t i = 0; i < positions.size(); ++i) {
        if (positions[i] >= before.size()) {
            refuse(item(element + " mergeIndices", i), std::to_string(positions[i]) +
                                                           " is out of range: the manifoldPrimitive has " +
                                                           counted(before.size(), "index", "indices"));
        }
        const uint32_t vertices[2] = {before[positions[i]], values[i]};
        for (const uint32_t vertex : vertices) {
            if (vertex >= vertexCount) {
                refuse(item(element + " mergeValues", i), "vertex " + std::to_string(vertex) +
                                                              " is out of range: the mesh has " +
                                                              std::to_string(vertexCount));
            }
        }
        pairs.emplace_back(vertices[0], vertices[1]);
    }
    return pairs;
}

} // namespace

std::optional<VertexPairs> readManifold(const Document& document, size_t meshIndex, const Mesh& mesh,
                                        std::span<const int> positionAccessors, Warnings& warnings) {
    if (!hasExtension(document.meshes[meshIndex], "EXT_mesh_manifold")) {
        return std::nullopt;
    }
    const Manifold manifold = checkManifold(document, meshIndex, mesh, positionAccessors);
    const uint32_t vertexCount = mesh.primitives[0].vertexCount;
    VertexPairs pairs;
    if (manifold.merges) {
        const auto indices = manifold.primitive->at("indices").index();
        if (document.model.accessors[indices].sparseCount == 0) {
            warn(warnings, manifold.element,
                 "its indices are not sparse, so what they were before merging is lost; not used");
            return std::nullopt;
        }
        pairs = readMerges(document, manifold, vertexCount);
    }
    for (auto& [first, second] : pairs) {
        first += mesh.primitives[0].firstVertex;
        second += mesh.primitives[0].firstVertex;
    }
    // Primitives may have vertices of their own over the one POSITION accessor: other joints, other numbers.
    for (const split::Primitive& primitive : mesh.primitives) {
        if (primitive.firstVertex == mesh.primitives[0].firstVertex) {
            continue;
        }
        for (uint32_t v = 0; v < vertexCount; ++v) {
            pairs.emplace_back(mesh.primitives[0].firstVertex + v, primitive.firstVertex + v);
        }
    }
    return pairs;
}

} // namespace supple::cage::gltf
