// Vertices of a mesh that is being baked, each once.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::tools {

/// What a vertex has. What the file that is written has no place for stays zero.
struct BakedVertex {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    glm::vec2 uvs[2]{};
    uint32_t color[2]{};     ///< as SuppleVertexStreams.attributes: linear RGBA, 4 x unorm16
    uint32_t tangent = 0;    ///< a word of SuppleVertexStreams.tangents
    uint32_t cageVertex = 0; ///< of a cage: vertices in one place stay apart, as they are in the cage
};

/// Neighboring patches sum up a common normal in another order: components that differ by less are the same.
inline constexpr float kSameNormal = 1e-6f;

/// Vertices are the same if their normals are (kSameNormal) and all else is equal to the bit. The normal that came
/// first stays.
class VertexPool {
public:
    /// The number of the vertex among those of the pool.
    [[nodiscard]] uint32_t add(BakedVertex vertex);
    [[nodiscard]] std::vector<BakedVertex> take() && { return std::move(vertices_); }

private:
    void grow();

    std::vector<BakedVertex> vertices_;
    std::vector<uint32_t> places_; ///< open addressing: a vertex, or kFree; a power of two of places, half of them free
};

} // namespace supple::tools
