// The materials of an OBJ file, from the MTL files that it names. Private to cage/obj/.
#pragma once

#include "cage/character.h"
#include "cage/file_reader.h"
#include "cage/message.h"
#include "cage/obj/file.h"

#include <glm/glm.hpp>
#include <vector>

namespace supple::cage::obj {

/// Fills materials and images, and warns of what is missing or not used. A name that no MTL file has is a white
/// material.
void readMaterials(const File& file, const FileReader& readFile, Character& character);

/// Where corners have colors of their own, these take the place of their material's base color, which becomes white.
/// Returns, per material, what corners have that have none: BuildOptions::colors.
[[nodiscard]] std::vector<glm::vec3> giveWayToColors(const File& file, Character& character);

} // namespace supple::cage::obj
