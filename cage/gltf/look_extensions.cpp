#include "cage/gltf/look_extensions.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace supple::cage::gltf {
namespace {

class UnreadExtensions {
public:
    void add(const std::string& name, const std::string& element) {
        ++met_.try_emplace(name, Place{element, 0}).first->second.count;
    }

    /// Of a part of the file that has to do with nothing but looks.
    void addAllOf(const json& object, const std::string& element) {
        const json* extensions = object.is_object() ? member(object, "extensions") : nullptr;
        if (extensions == nullptr || !extensions->is_object()) {
            return;
        }
        for (const auto& [name, value] : extensions->items()) {
            if (std::find(kLookExtensions.begin(), kLookExtensions.end(), name) == kLookExtensions.end()) {
                add(name, element);
            }
        }
    }

    void name(Warnings& warnings) const {
        for (const auto& [name, place] : met_) {
            const std::string more =
                place.count == 1 ? "" : ", here and in " + counted(place.count - 1, "other place", "other places");
            warn(warnings, place.first, name + " is not read" + more);
        }
    }

private:
    struct Place {
        std::string first;
        size_t count = 0;
    };
    std::map<std::string, Place> met_;
};

void addMaterial(const json& material, const std::string& element, UnreadExtensions& unread) {
    unread.addAllOf(material, element);
    const auto addTextures = [&](const json& object) {
        for (const char* key :
             {"baseColorTexture", "metallicRoughnessTexture", "normalTexture", "occlusionTexture", "emissiveTexture"}) {
            if (const json* info = member(object, key)) {
                unread.addAllOf(*info, within(element, key));
            }
        }
    };
    addTextures(material);
    const json* pbr = member(material, "pbrMetallicRoughness");
    if (pbr != nullptr && pbr->is_object()) {
        addTextures(*pbr);
    }
}

} // namespace

void nameUnreadLook(const json& root, Warnings& warnings) {
    UnreadExtensions unread;
    const json& materials = table(root, "materials");
    for (size_t i = 0; i < materials.size(); ++i) {
        addMaterial(materials[i], at("material", i), unread);
    }
    for (const auto& [key, what] : {std::pair("textures", "texture"), {"samplers", "sampler"}}) {
        const json& list = table(root, key);
        for (size_t i = 0; i < list.size(); ++i) {
            unread.addAllOf(list[i], at(what, i));
        }
    }
    const json& meshes = table(root, "meshes");
    for (size_t i = 0; i < meshes.size(); ++i) {
        for (const json& primitive : meshes[i].at("primitives")) {
            if (hasExtension(primitive, "KHR_materials_variants")) {
                unread.add("KHR_materials_variants", at("mesh", i));
            }
        }
    }
    unread.name(warnings);
}

} // namespace supple::cage::gltf
