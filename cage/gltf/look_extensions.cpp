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
    void addAllOf(const Json& object, const std::string& element) {
        const Json* extensions = object.isObject() ? member(object, "extensions") : nullptr;
        if (extensions == nullptr || !extensions->isObject()) {
            return;
        }
        for (const auto& [name, value] : extensions->members()) {
            if (std::find(kLookExtensions.begin(), kLookExtensions.end(), name) == kLookExtensions.end()) {
                add(std::string(name), element);
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

void addMaterial(const Json& material, const std::string& element, UnreadExtensions& unread) {
    unread.addAllOf(material, element);
    const auto addTextures = [&](const Json& object) {
        for (const char* key :
             {"baseColorTexture", "metallicRoughnessTexture", "normalTexture", "occlusionTexture", "emissiveTexture"}) {
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
    const Json meshes = table(root, "meshes");
    for (size_t i = 0; i < meshes.size(); ++i) {
        for (const Json& primitive : meshes[i].at("primitives")) {
            if (hasExtension(primitive, "KHR_materials_variants")) {
                unread.add("KHR_materials_variants", at("mesh", i));
            }
        }
    }
    unread.name(warnings);
}

} // namespace supple::cage::gltf
