// Makes the parts of a character of an OBJ file: its objects, or else its groups. Private to cage/obj/.
#pragma once

#include "cage/message.h"
#include "cage/obj/file.h"
#include "cage/parts.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::cage::obj {

struct BuildOptions {
    bool weld = true; ///< make vertices of a part that lie in one place one vertex (cage/weld.h)
    /// Per material: the color of corners that have none of their own. Faces without a material: white.
    std::span<const glm::vec3> colors;
};

/// Parts in the order of their first faces, each with one or more; none if no face of the file is whole. All of
/// their vertices together count as the last one's in PartCage::sourceVertexCount, so that Cage::sourceVertices are the
/// file's own numbers in every part.
[[nodiscard]] std::vector<PartCage> buildParts(const File& file, const BuildOptions& options, Warnings& warnings);

/// Whether corners of whole faces have colors of their own.
[[nodiscard]] bool hasColors(const File& file);

} // namespace supple::cage::obj
