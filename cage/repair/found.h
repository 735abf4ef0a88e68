// Where damage was found, part by part. Private to cage/repair.
#pragma once

#include "cage/character.h"
#include "cage/message.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::cage::repair {

/// A value for each part.
template <class T>
class PerPart {
public:
    [[nodiscard]] T& operator[](size_t part) {
        if (part >= values_.size()) {
            values_.resize(part + 1);
        }
        return values_[part];
    }
    [[nodiscard]] T at(size_t part) const { return part < values_.size() ? values_[part] : T{}; }

private:
    std::vector<T> values_;
};

/// Names the faces, vertices and edges of the given cage as its parts count them.
class Places {
public:
    Places(const Cage& cage, const CageNames& names);

    [[nodiscard]] size_t partOf(uint32_t face) const { return cage_.faceParts.empty() ? 0 : cage_.faceParts[face]; }
    [[nodiscard]] std::string number(uint32_t face) const;
    [[nodiscard]] std::string face(uint32_t face) const { return "face " + number(face); }
    [[nodiscard]] std::string vertex(uint32_t corner) const;
    [[nodiscard]] std::string edge(uint32_t corner, uint32_t other) const;

private:
    [[nodiscard]] uint32_t vertexAt(uint32_t corner) const {
        return cornerVertices_.empty() ? cage_.faceVertices[corner] : cornerVertices_[corner];
    }

    const Cage& cage_;
    const std::vector<uint32_t>& cornerVertices_;
    std::vector<uint32_t> firstFaces_; ///< per part
};

/// One kind of damage.
class Finds {
public:
    /// Adds a place at a face of the given cage; `name` names it.
    template <class Name>
    void add(const Places& places, uint32_t face, Name&& name) {
        found_[places.partOf(face)].add(name);
    }
    [[nodiscard]] Found of(size_t part) const { return found_.at(part); }

private:
    PerPart<Found> found_;
};

} // namespace supple::cage::repair
