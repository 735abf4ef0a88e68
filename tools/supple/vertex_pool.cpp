#include "tools/supple/vertex_pool.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

namespace supple::tools {
namespace {

constexpr uint32_t kFree = 0xFFFFFFFFu;
constexpr size_t kFirstPlaces = 1024;

/// Everything behind the normal is compared as bytes.
constexpr size_t kBehindNormal = offsetof(BakedVertex, uvs);
static_assert(sizeof(BakedVertex) == 14 * sizeof(float), "without gaps");

/// Of everything but the normal. Vertices in one place rarely differ in other things, so chains stay short.
size_t hashOf(const BakedVertex& vertex) {
    uint32_t words[sizeof(BakedVertex) / sizeof(uint32_t)];
    std::memcpy(words, &vertex, sizeof words);
    uint64_t hash = 0;
    for (size_t i = 0; i < std::size(words); ++i) {
        const bool normal = i >= 3 && i < kBehindNormal / sizeof(uint32_t);
        hash = normal ? hash : (hash ^ words[i]) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 29;
    }
    return hash;
}

bool areSame(const BakedVertex& a, const BakedVertex& b) {
    if (std::memcmp(&a.position, &b.position, sizeof a.position) != 0 ||
        std::memcmp(a.uvs, b.uvs, sizeof(BakedVertex) - kBehindNormal) != 0) {
        return false;
    }
    const glm::vec3 apart = glm::abs(a.normal - b.normal);
    return apart.x <= kSameNormal && apart.y <= kSameNormal && apart.z <= kSameNormal;
}

} // namespace

uint32_t VertexPool::add(BakedVertex vertex) {
    // Minus zero becomes zero: the bytes of equal numbers are equal.
    vertex.position += 0.0f;
    vertex.normal += 0.0f;
    vertex.uvs[0] += 0.0f;
    vertex.uvs[1] += 0.0f;
    if (2 * vertices_.size() >= places_.size()) {
        grow();
    }
    size_t place = hashOf(vertex) & (places_.size() - 1);
    while (places_[place] != kFree) {
        if (areSame(vertices_[places_[place]], vertex)) {
            return places_[place];
        }
        place = (place + 1) & (places_.size() - 1);
    }
    places_[place] = static_cast<uint32_t>(vertices_.size());
    vertices_.push_back(vertex);
    return places_[place];
}

void VertexPool::grow() {
    places_.assign(places_.empty() ? kFirstPlaces : 2 * places_.size(), kFree);
    for (uint32_t v = 0; v < vertices_.size(); ++v) {
        size_t place = hashOf(vertices_[v]) & (places_.size() - 1);
        while (places_[place] != kFree) {
            place = (place + 1) & (places_.size() - 1);
        }
        places_[place] = v;
    }
}

} // namespace supple::tools
