#include "cage/gltf/look_extensions.h"

#include "cage/gltf/node_extensions.h"
#include "cage/gltf/specular_glossiness.h"
#include "cage/material_layers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace supple::cage::gltf {
namespace {

/// Those of nodes that do not change what is drawn of their meshes.
constexpr std::array<std::string_view, 6> kNodeExtensions{
    kNodeVisibility,          "KHR_lights_punctual",      "KHR_node_hoverability",
    "KHR_node_selectability", "KHR_physics_rigid_bodies", "VRMC_node_constraint"};

/// What becomes of a thing whose extension is not read, where it is not clear.
std::string instead(const std::string& extension) {
    return extension == "EXT_mesh_gpu_instancing" ? "; the mesh is drawn once"
           : extension == "VRMC_materials_mtoon"  ? "; the material is shown as its base"
                                                  : "";
}

class UnreadExtensions {
public:
    void add(const std::string& name, const std::string& element) {
        ++met_.try_emplace(name, Place{element, 0}).first->second.count;
    }

    /// Of a part of the file that has to do with nothing but looks.
    void addAllOf(const Json& object, const std::string& element,
                  std::span<const std::string_view> known = kLookExtensions) {
        const Json* extensions = object.isObject() ? member(object, "extensions") : nullptr;
        if (extensions == nullptr || !extensions->isObject()) {
            return;
        }
        for (const auto& [name, value] : extensions->members()) {
            if (std::find(known.begin(), known.end(), name) == known.end()) {
                add(std::string(name), element);
            }
        }
    }

    void name(Warnings& warnings) const {
        for (const auto& [name, place] : met_) {
            std::string text = name + " is not read";
            if (place.count > 1) {
                text.append(", here and in ").append(counted(place.count - 1, "other place", "other places"));
            }
            warn(warnings, place.first, text.append(instead(name)));
        }
    }

private:
    struct Place {
        std::string first;
        size_t count = 0;
    };
    std::map<std::string, Place> met_;
};

void addMaterial(const Json& material, const std::string& element, UnreadExtensions& unread) {
    unread.addAllOf(material, element);
    const auto addTextures = [&](const Json& object) {
        for (const char* key : {"baseColorTexture", "diffuseTexture", "metallicRoughnessTexture", "normalTexture",
                                "occlusionTexture", "emissiveTexture"}) {
            if (const Json* info = member(object, key)) {
                unread.addAllOf(*info, within(element, key));
            }
        }
    };
    addTextures(material);
    const Json* pbr = member(material, "pbrMetallicRoughness");
    if (pbr != nullptr && pbr->isObject()) {
        addTextures(*pbr);
    }
    addTextures(material.at("extensions").at(kSpecularGlossiness));
    for (const LayerTexture& row : kLayerTextures) {
        if (const Json* info = member(material.at("extensions").at(row.extension), row.name)) {
            unread.addAllOf(*info, within(element, row.name));
        }
    }
}

} // namespace

void nameUnreadLook(const Json& root, Warnings& warnings) {
    UnreadExtensions unread;
    const Json materials = table(root, "materials");
    for (size_t i = 0; i < materials.size(); ++i) {
        addMaterial(materials[i], at("material", i), unread);
    }
    for (const auto& [key, what] : {std::pair("textures", "texture"), {"samplers", "sampler"}}) {
        const Json list = table(root, key);
        for (size_t i = 0; i < list.size(); ++i) {
            unread.addAllOf(list[i], at(what, i));
        }
    }
    const Json nodes = table(root, "nodes");
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (member(nodes[i], "mesh") != nullptr) {
            unread.addAllOf(nodes[i], at("node", i), kNodeExtensions);
        }
    }
    unread.name(warnings);
}

} // namespace supple::cage::gltf
