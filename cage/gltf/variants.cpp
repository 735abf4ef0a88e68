#include "cage/gltf/variants.h"

#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>

namespace supple::cage::gltf {
namespace {

constexpr const char* kVariants = "KHR_materials_variants";

/// By the file's number of each; empty where it has none.
std::vector<std::string> namesIn(const Document& document) {
    std::vector<std::string> names;
    const Json& extension = document.json.root().at("extensions").at(kVariants);
    document.leniency->leaveOut([&] {
        const Json* variants = arrayMember(extension, "variants", kVariants);
        for (size_t i = 0; variants != nullptr && i < variants->size(); ++i) {
            names.emplace_back();
            document.leniency->leaveOut([&] {
                names.back() =
                    stringMember((*variants)[i], "name", at((std::string(kVariants) + " variant").c_str(), i));
            });
        }
    });
    return names;
}

/// The material that a primitive's mappings name for a variant; -1: none of them does.
int mappedMaterial(const Json& extension, size_t variant, size_t variantCount, size_t materialCount,
                   const std::string& element) {
    const Json* mappings = arrayMember(extension, "mappings", element);
    for (size_t m = 0; mappings != nullptr && m < mappings->size(); ++m) {
        const Json& mapping = (*mappings)[m];
        const std::string place = element + " " + at("mapping", m);
        if (!mapping.isObject()) {
            refuse(place, "not an object");
        }
        checkIndexArray(mapping, "variants", place, "variant", variantCount);
        checkIndexMember(mapping, "material", place, "material", materialCount, true);
        const std::span<const Json> variants = mapping.at("variants").items();
        if (std::any_of(variants.begin(), variants.end(), [&](const Json& v) { return v.index() == variant; })) {
            return static_cast<int>(mapping.at("material").index());
        }
    }
    return -1;
}

} // namespace

std::vector<std::string> chooseVariant(Document& document, const std::string& name) {
    const std::vector<std::string> all = namesIn(document);
    std::vector<std::string> names;
    std::set<std::string_view> known;
    for (const std::string& each : all) {
        if (!each.empty() && known.insert(each).second) {
            names.push_back(each);
        }
    }
    if (name.empty()) {
        return names;
    }
    const auto found = std::find(all.begin(), all.end(), name);
    if (found == all.end()) {
        std::string list;
        for (const std::string& each : names) {
            list += (list.empty() ? "; it has " : ", ") + quoted(each);
        }
        refuse("file", "no material variant " + quoted(name) + (list.empty() ? "; it has none" : list),
               ErrorCode::argument);
    }
    const auto variant = static_cast<size_t>(found - all.begin());
    for (size_t m = 0; m < document.model.meshes.size(); ++m) {
        std::vector<file::Primitive>& primitives = document.model.meshes[m].primitives;
        for (size_t k = 0; k < primitives.size(); ++k) {
            if (primitives[k].broken || !hasExtension(primitives[k].json, kVariants)) {
                continue;
            }
            document.leniency->leaveOut([&] {
                const int material = mappedMaterial(primitives[k].json.at("extensions").at(kVariants), variant,
                                                    all.size(), document.materials.size(),
                                                    at("mesh", m) + " " + at("primitive", k) + " " + kVariants);
                primitives[k].material = material >= 0 ? material : primitives[k].material;
            });
        }
    }
    return names;
}

} // namespace supple::cage::gltf
