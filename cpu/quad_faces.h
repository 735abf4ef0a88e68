// Faces of a cage as quads: as they are or, if some are no quads, after one step of Catmull-Clark a quad at each
// corner.
#pragma once

#include "cage/character.h"
#include "cpu/place.h"

#include <cstdint>
#include <vector>

namespace supple::cpu {

class QuadFaces {
public:
    /// `stepped`: the quads are those of a step.
    QuadFaces(const cage::Cage& cage, bool stepped);

    /// The quad and the place in it.
    [[nodiscard]] FoundPlace find(const FacePoint& point) const;

private:
    std::vector<uint32_t> faceStarts_;
    std::vector<bool> holes_;
    bool stepped_;
};

} // namespace supple::cpu
