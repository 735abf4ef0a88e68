// The polygons of a cage, for drawing it: Supple hands out the deformed vertices alone.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::host {

/// Corner attributes are per corner, or empty. Vertices are numbered as in SuppleGroupInfo::deformedCage.
struct CageMesh {
    std::vector<glm::vec3> positions; ///< in the bind pose
    std::vector<uint32_t> faceStarts; ///< one per face and one more: corners of face f are [f], [f + 1])
    std::vector<uint32_t> corners;    ///< vertices
    std::vector<uint32_t> materials;  ///< per face, or SUPPLE_NO_MATERIAL; or empty
    std::vector<uint32_t> parts;      ///< per face; or empty, if there is one part
    std::vector<glm::vec2> uvSets[2];
    std::vector<glm::vec4> colors; ///< linear
    /// Some pose may mirror the cage or a part of it. Then winding does not tell front faces from back faces.
    bool mayMirror = false;

    [[nodiscard]] uint32_t faceCount() const { return static_cast<uint32_t>(faceStarts.size()) - 1; }
    [[nodiscard]] uint32_t sides(uint32_t face) const { return faceStarts[face + 1] - faceStarts[face]; }
};

} // namespace supple::host
