#include "cage/gltf/creases.h"

#include "cage/gltf/cage_extension.h"
#include "cage/gltf/entry_faults.h"
#include "cage/refusal.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace supple::cage::gltf {
namespace {

/// Edges and vertices in the order of the file, each once, with the sharpest of what it says of them.
class SharpFeatures {
public:
    void addCrease(uint32_t a, uint32_t b, float sharpness, Cage& cage) {
        const auto [known, isNew] = edges_.try_emplace(std::minmax(a, b), cage.creases.size());
        if (isNew) {
            cage.creases.push_back({a, b, sharpness});
        } else {
            float& kept = cage.creases[known->second].sharpness;
            kept = std::max(kept, sharpness);
        }
    }
    void addCorner(uint32_t vertex, float sharpness, Cage& cage) {
        const auto [known, isNew] = vertices_.try_emplace(vertex, cage.sharpVertices.size());
        if (isNew) {
            cage.sharpVertices.push_back({vertex, sharpness});
        } else {
            float& kept = cage.sharpVertices[known->second].sharpness;
            kept = std::max(kept, sharpness);
        }
    }

private:
    std::map<std::pair<uint32_t, uint32_t>, size_t> edges_;
    std::map<uint32_t, size_t> vertices_;
};

/// Creases and corners of SUPPLE_mesh_cage. What they name is a cage vertex by its number where the mesh numbers them,
/// else a vertex of the primitive.
class ExtensionReader {
public:
    ExtensionReader(const Document& document, const Mesh& mesh, std::span<const uint32_t> cageVertices, Cage& cage,
                    Warnings& warnings)
        : document_(document), cageVertices_(cageVertices), cage_(cage), warnings_(warnings) {
        for (uint32_t v = 0; v < mesh.cageNumbers.size(); ++v) {
            // Of several vertices of one number any will do, but one without a face only where none has.
            uint32_t& vertex = ofNumber_.try_emplace(mesh.cageNumbers[v], cageVertices[v]).first->second;
            vertex = vertex == kNone ? cageVertices[v] : vertex;
        }
    }

    void readCreases(const MeshPrimitive& primitive) {
        const SharpList list = readCreaseList(document_, *primitive.extension);
        EntryFaults faults(list.element);
        for (size_t i = 0; i < list.sharpnesses.size(); ++i) {
            const uint32_t a = vertexOf(primitive, list, 2 * i);
            const uint32_t b = vertexOf(primitive, list, 2 * i + 1);
            if (a == kNone || b == kNone) {
                faults.add(2 * i, "a crease at a vertex without a face");
            } else if (a == b) {
                refuse(item(list.element, 2 * i), "both ends are one vertex of the cage");
            } else {
                features_.addCrease(a, b, list.sharpnesses[i], cage_);
            }
        }
        faults.report(warnings_);
    }

    void readCorners(const MeshPrimitive& primitive) {
        const SharpList list = readCornerList(document_, *primitive.extension);
        EntryFaults faults(list.element);
        for (size_t i = 0; i < list.sharpnesses.size(); ++i) {
            const uint32_t vertex = vertexOf(primitive, list, i);
            if (vertex == kNone) {
                faults.add(i, "a vertex without a face");
            } else {
                features_.addCorner(vertex, list.sharpnesses[i], cage_);
            }
        }
        faults.report(warnings_);
    }

private:
    /// kNone for a vertex without a face.
    uint32_t vertexOf(const MeshPrimitive& primitive, const SharpList& list, size_t index) const {
        const uint32_t number = list.vertices[index];
        if (primitive.extension->cageVertices >= 0) {
            const auto found = ofNumber_.find(number);
            if (found == ofNumber_.end()) {
                refuse(item(list.element, index), "the mesh has no cage vertex " + std::to_string(number));
            }
            return found->second;
        }
        if (number >= primitive.vertexCount) {
            refuse(item(list.element, index), "vertex " + std::to_string(number) +
                                                  " is out of range: the primitive has " +
                                                  std::to_string(primitive.vertexCount));
        }
        return cageVertices_[primitive.firstVertex + number];
    }

    const Document& document_;
    std::span<const uint32_t> cageVertices_;
    Cage& cage_;
    Warnings& warnings_;
    SharpFeatures features_;
    std::map<uint32_t, uint32_t>
        ofNumber_; ///< number of a cage vertex in the file -> cage vertex, kNone without a face
};

/// extras may hold anything: nothing in them is an error.
class ExtrasReader {
public:
    ExtrasReader(std::span<const uint32_t> cageVertices, Cage& cage, Warnings& warnings)
        : cageVertices_(cageVertices), cage_(cage), warnings_(warnings) {}

    /// Of `vertexCount` vertices and a sharpness each.
    void readList(const Json& extras, const char* key, const std::string& name, size_t vertexCount) {
        const Json* entries = extras.isObject() ? member(extras, key) : nullptr;
        if (entries == nullptr) {
            return;
        }
        if (!entries->isArray()) {
            warn(warnings_, name, "not an array; ignored");
            return;
        }
        EntryFaults faults(name);
        for (size_t i = 0; i < entries->size(); ++i) {
            const std::optional<std::string> fault = readEntry((*entries)[i], vertexCount);
            if (fault) {
                faults.add(i, *fault);
            }
        }
        faults.report(warnings_);
    }

private:
    std::optional<std::string> readEntry(const Json& entry, size_t vertexCount) {
        if (!entry.isArray() || entry.size() != vertexCount + 1) {
            return vertexCount == 2 ? "not [vertex, vertex, sharpness]" : "not [vertex, sharpness]";
        }
        uint32_t vertices[2] = {0, 0};
        for (size_t k = 0; k < vertexCount; ++k) {
            if (!entry[k].isUnsigned()) {
                return "not a vertex number: " + shown(entry[k], 40);
            }
            const auto number = entry[k].unsignedInteger();
            if (number >= cageVertices_.size()) {
                return "vertex " + std::to_string(number) + " is out of range: the mesh has " +
                       std::to_string(cageVertices_.size());
            }
            vertices[k] = cageVertices_[static_cast<size_t>(number)];
            if (vertices[k] == kNone) {
                return "vertex " + std::to_string(number) + " has no face";
            }
        }
        const Json& sharpness = entry[vertexCount];
        if (!sharpness.isNumber() || !isFiniteFloat(sharpness) || sharpness.real() < 0.0f) {
            return "sharpness is not a number of at least 0";
        }
        if (vertexCount == 1) {
            features_.addCorner(vertices[0], sharpness.real(), cage_);
        } else if (vertices[0] == vertices[1]) {
            return "both ends are one vertex of the cage";
        } else {
            features_.addCrease(vertices[0], vertices[1], sharpness.real(), cage_);
        }
        return std::nullopt;
    }

    std::span<const uint32_t> cageVertices_;
    Cage& cage_;
    Warnings& warnings_;
    SharpFeatures features_;
};

} // namespace

void readCreases(const Document& document, const Mesh& mesh, std::span<const uint32_t> cageVertices, Cage& cage,
                 Warnings& warnings) {
    bool creases = false;
    bool corners = false;
    ExtensionReader ofExtension(document, mesh, cageVertices, cage, warnings);
    for (const MeshPrimitive& primitive : mesh.primitives) {
        if (primitive.extension && primitive.extension->creaseIndices >= 0) {
            ofExtension.readCreases(primitive);
            creases = true;
        }
        if (primitive.extension && primitive.extension->cornerIndices >= 0) {
            ofExtension.readCorners(primitive);
            corners = true;
        }
    }
    const Json* extras = member(document.meshes[mesh.index], "extras");
    if (extras == nullptr) {
        return;
    }
    // extras.creases: [vertex, vertex, sharpness]; extras.corners: [vertex, sharpness].
    ExtrasReader ofExtras(cageVertices, cage, warnings);
    if (!creases) {
        ofExtras.readList(*extras, "creases", mesh.element + " extras creases", 2);
    }
    if (!corners) {
        ofExtras.readList(*extras, "corners", mesh.element + " extras corners", 1);
    }
}

} // namespace supple::cage::gltf
