// Creases and sharp vertices as somebody lists them.
#pragma once

#include "cage/character.h"

#include <algorithm>
#include <map>
#include <utility>

namespace supple::cage {

/// Puts edges and vertices into a cage in the order in which they come, each once, with the sharpest of what is said of
/// them.
class SharpFeatures {
public:
    void addCrease(uint32_t a, uint32_t b, float sharpness, Cage& cage) {
        const auto [known, isNew] = edges_.try_emplace(std::minmax(a, b), cage.creases.size());
        if (isNew) {
            cage.creases.push_back({a, b, sharpness});
        } else {
            float& kept = cage.creases[known->second].sharpness;
            kept = std::max(kept, sharpness);
        }
    }
    void addCorner(uint32_t vertex, float sharpness, Cage& cage) {
        const auto [known, isNew] = vertices_.try_emplace(vertex, cage.sharpVertices.size());
        if (isNew) {
            cage.sharpVertices.push_back({vertex, sharpness});
        } else {
            float& kept = cage.sharpVertices[known->second].sharpness;
            kept = std::max(kept, sharpness);
        }
    }

private:
    std::map<std::pair<uint32_t, uint32_t>, size_t> edges_;
    std::map<uint32_t, size_t> vertices_;
};

} // namespace supple::cage
