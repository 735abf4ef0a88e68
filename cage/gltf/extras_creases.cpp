#include "cage/gltf/extras_creases.h"

#include <algorithm>
#include <optional>

namespace supple::cage::gltf {
namespace {

std::optional<std::string> readEntry(const Json& entry, size_t meshVertices, size_t vertexCount,
                                     split::LooseSharpList::Entry& read) {
    if (!entry.isArray() || entry.size() != vertexCount + 1) {
        return vertexCount == 2 ? "not [vertex, vertex, sharpness]" : "not [vertex, sharpness]";
    }
    for (size_t k = 0; k < vertexCount; ++k) {
        if (!entry[k].isUnsigned()) {
            return "not a vertex number: " + shown(entry[k], 40);
        }
        const auto number = entry[k].unsignedInteger();
        if (number >= meshVertices) {
            return "vertex " + std::to_string(number) + " is out of range: the mesh has " +
                   std::to_string(meshVertices);
        }
        read.vertices[k] = static_cast<uint32_t>(number);
    }
    const Json& sharpness = entry[vertexCount];
    if (!sharpness.isNumber() || !isFiniteFloat(sharpness) || sharpness.real() < 0.0f) {
        return "sharpness is not a number of at least 0";
    }
    read.sharpness = sharpness.real();
    return std::nullopt;
}

/// `extras` has the key. Entries of `vertexCount` vertices and a sharpness each.
std::optional<split::LooseSharpList> readList(const Json& extras, const char* key, const std::string& name,
                                              size_t meshVertices, size_t vertexCount, Warnings& warnings) {
    const Json* entries = member(extras, key);
    if (!entries->isArray()) {
        warn(warnings, name, "not an array; ignored");
        return std::nullopt;
    }
    split::LooseSharpList list{vertexCount, {}, EntryFaults(name)};
    for (size_t i = 0; i < entries->size(); ++i) {
        split::LooseSharpList::Entry entry;
        entry.index = i;
        if (const std::optional<std::string> fault = readEntry((*entries)[i], meshVertices, vertexCount, entry)) {
            list.faults.add(i, *fault);
        } else {
            list.entries.push_back(entry);
        }
    }
    return list;
}

} // namespace

void readExtrasCreases(const Json& fileMesh, bool isCounted, Mesh& mesh, Warnings& warnings) {
    const Json* extras = member(fileMesh, "extras");
    if (extras == nullptr || !extras->isObject()) {
        return;
    }
    const auto isUsed = [&](const char* key, std::optional<split::SharpList> split::Primitive::*own) {
        return member(*extras, key) != nullptr &&
               std::none_of(mesh.primitives.begin(), mesh.primitives.end(),
                            [&](const split::Primitive& primitive) { return (primitive.*own).has_value(); });
    };
    const bool creases = isUsed("creases", &split::Primitive::creases);
    const bool corners = isUsed("corners", &split::Primitive::corners);
    const std::string element = mesh.element + " extras ";
    if ((creases || corners) && !isCounted) {
        warn(warnings,
             element + (!corners   ? "creases"
                        : !creases ? "corners"
                                   : "creases and corners"),
             "they count the vertices of a primitive that is left out; left out");
        return;
    }
    if (creases) {
        mesh.creases = readList(*extras, "creases", element + "creases", mesh.positions.size(), 2, warnings);
    }
    if (corners) {
        mesh.corners = readList(*extras, "corners", element + "corners", mesh.positions.size(), 1, warnings);
    }
}

} // namespace supple::cage::gltf
