// Creases and sharp vertices as somebody lists them.
#pragma once

#include "cage/character.h"
#include "cage/limits.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace supple::cage {

/// Adds what is said of an edge once more: the sharper counts, and the first set.
inline void mergeCrease(const Crease& more, Crease& crease) {
    crease.sharpness = std::max(crease.sharpness, more.sharpness);
    crease.set = crease.set != kNone ? crease.set : more.set;
}

/// The place of a crease set by name, which is added if it is new. No more than one set too many is added: it stands
/// for all that boundCreaseSets() leaves out, however many a file names.
[[nodiscard]] inline uint32_t creaseSetOf(const std::string& name, Cage& cage) {
    const auto known = std::find(cage.creaseSets.begin(), cage.creaseSets.end(), name);
    if (known == cage.creaseSets.end() && cage.creaseSets.size() > kMaxCreaseSets) {
        return kMaxCreaseSets;
    }
    if (known == cage.creaseSets.end()) {
        cage.creaseSets.push_back(name);
        return static_cast<uint32_t>(cage.creaseSets.size() - 1);
    }
    return static_cast<uint32_t>(known - cage.creaseSets.begin());
}

/// Puts edges and vertices into a cage in the order in which they come, each once, with the sharpest of what is said of
/// them.
class SharpFeatures {
public:
    void addCrease(const Crease& crease, Cage& cage) {
        const auto [known, isNew] = edges_.try_emplace(std::minmax(crease.a, crease.b), cage.creases.size());
        if (isNew) {
            cage.creases.push_back(crease);
        } else {
            mergeCrease(crease, cage.creases[known->second]);
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
