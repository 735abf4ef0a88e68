// Materials of KHR_materials_pbrSpecularGlossiness as metallic ones. Private to cage/gltf/.
#pragma once

#include <glm/glm.hpp>

namespace supple::cage::gltf {

inline constexpr const char* kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";

/// What the extension's factors are where a file does not say them.
struct SpecularGlossiness {
    glm::vec4 diffuse{1.0f};
    glm::vec3 specular{1.0f};
    float glossiness = 1.0f;
};

struct MetallicRoughness {
    glm::vec4 baseColor{1.0f};
    float metallic = 1.0f;
    float roughness = 1.0f;
};

/// The conversion that Khronos has published beside the extension (examples/convert-between-workflows). The factors are
/// in 0..1.
[[nodiscard]] MetallicRoughness toMetallicRoughness(const SpecularGlossiness& from);

} // namespace supple::cage::gltf
