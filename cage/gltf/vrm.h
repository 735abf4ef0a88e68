// What VRM files have beside glTF. Private to cage/gltf/.
#pragma once

#include "cage/gltf/json.h"
#include "cage/message.h"

#include <array>
#include <string_view>

namespace supple::cage::gltf {

/// Of VRM 0.x and 1.0. A file may require them: without them it is a character still.
inline constexpr std::array<std::string_view, 6> kVrmExtensions{"VRM",
                                                                "VRMC_vrm",
                                                                "VRMC_materials_mtoon",
                                                                "VRMC_springBone",
                                                                "VRMC_springBone_extended_collider",
                                                                "VRMC_node_constraint"};

/// Names what of a VRM file is not used, in one line. The document must be checked.
void nameUnusedVrm(const Json& root, Warnings& warnings);

} // namespace supple::cage::gltf
