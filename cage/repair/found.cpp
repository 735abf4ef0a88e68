#include "cage/repair/found.h"

#include <algorithm>

namespace supple::cage::repair {

Places::Places(const Cage& cage, const CageNames& names) : cage_(cage), cornerVertices_(names.cornerVertices) {
    for (size_t part = 0; part < names.parts.size(); ++part) {
        const auto first = std::lower_bound(cage.faceParts.begin(), cage.faceParts.end(), part);
        firstFaces_.push_back(static_cast<uint32_t>(first - cage.faceParts.begin()));
    }
}

std::string Places::number(uint32_t face) const {
    return std::to_string(face - firstFaces_[partOf(face)]);
}

std::string Places::vertex(uint32_t corner) const {
    return "vertex " + std::to_string(vertexAt(corner));
}

std::string Places::edge(uint32_t corner, uint32_t other) const {
    const uint32_t a = vertexAt(corner), b = vertexAt(other);
    return "edge (" + std::to_string(std::min(a, b)) + ", " + std::to_string(std::max(a, b)) + ")";
}

} // namespace supple::cage::repair
