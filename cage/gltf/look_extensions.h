// Extensions of a glTF file that change how a surface looks. Private to cage/gltf/.
#pragma once

#include "cage/gltf/json.h"
#include "cage/message.h"

#include <array>
#include <string_view>

namespace supple::cage::gltf {

/// Those that the reader looks into.
inline constexpr std::array<std::string_view, 16> kLookExtensions{"KHR_texture_transform",
                                                                  "KHR_materials_emissive_strength",
                                                                  "KHR_materials_unlit",
                                                                  "EXT_texture_webp",
                                                                  "KHR_texture_basisu",
                                                                  "KHR_materials_pbrSpecularGlossiness",
                                                                  "KHR_materials_variants",
                                                                  "KHR_materials_clearcoat",
                                                                  "KHR_materials_sheen",
                                                                  "KHR_materials_transmission",
                                                                  "KHR_materials_ior",
                                                                  "KHR_materials_specular",
                                                                  "KHR_materials_iridescence",
                                                                  "KHR_materials_anisotropy",
                                                                  "KHR_materials_diffuse_transmission",
                                                                  "KHR_materials_volume"};

/// Names every other one that a material, a textureInfo, a texture or a sampler has, those of nodes with meshes that
/// may change what is drawn of them: each once, where it is met first. The document must be checked.
void nameUnreadLook(const Json& root, Warnings& warnings);

} // namespace supple::cage::gltf
