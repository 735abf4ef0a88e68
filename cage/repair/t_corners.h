// T-corners: vertices of a face's neighbors that lie on the face's edge. Private to cage/repair.
#pragma once

#include "cage/repair/draft.h"
#include "cage/repair/found.h"
#include "cage/topology.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::cage::repair {

/// How far a vertex may be from an edge that it lies on, in parts of the edge's length. It is more than the rounding of
/// positions in 16 bits on an edge of a hundredth of the extent. No hole is lost by it: only a hole that is itself so
/// narrow closes.
inline constexpr double kTCornerTolerance = 1e-3;

/// No edge takes more T-corners, and of a vertex with more open sides none is followed.
inline constexpr size_t kMaxTCorners = 64;

/// Faces as packed corner lists, as in Cage and Draft.
struct FaceLists {
    std::span<const uint32_t> starts;
    std::span<const uint32_t> vertices;

    [[nodiscard]] uint32_t next(uint32_t face, uint32_t corner) const {
        return corner + 1 == starts[face + 1] ? starts[face] : corner + 1;
    }
};

/// A side of a face with T-corners on it: from its begin to its end runs a chain of sides of other faces.
struct SplitSide {
    /// A side of the chain. Its face may run along it in either direction.
    struct Link {
        uint32_t face = 0;
        uint32_t begin = 0; ///< the face's corner at the end of the link that comes first in the chain
        uint32_t end = 0;   ///< and at the other one
    };
    uint32_t face = 0;
    uint32_t corner = 0;        ///< that it begins at
    std::vector<Link> chain;    ///< two or more
    std::vector<double> places; ///< of the vertices between the links: parts of the side's length, rising
};

/// The sides that one face alone has.
[[nodiscard]] std::vector<Side> openSides(const Cage& cage, const Topology& topology);
[[nodiscard]] std::vector<Side> openSides(const Draft& draft);

/// The open sides that have T-corners. The chain consists of open sides that are no part of another chain. Its vertices
/// lie on the side within kTCornerTolerance, one behind the other, and its faces do not lie back to back with the
/// side's. Positions in the rest pose alone decide. O(sides log sides).
[[nodiscard]] std::vector<SplitSide> findTCorners(std::span<const glm::vec3> positions, const FaceLists& faces,
                                                  std::span<const Side> open);

struct TCornerDamage {
    Finds corners;
    PerPart<std::vector<uint32_t>> sides; ///< of the faces that have taken them
};

/// Makes T-corners corners of the face whose edge they lie on. The new corner has the attributes that the face has at
/// this place of the edge. The edge's crease goes to its pieces. If a fan of triangles from the face's first corner has
/// a flat one and a fan from another corner has none, the face begins at that corner.
///
/// New corners are added to `cage` and `names` behind the last face's: the draft names them, no face of `cage` has
/// them.
void mendTCorners(Cage& cage, CageNames& names, const Places& places, Draft& draft, TCornerDamage& damage);

} // namespace supple::cage::repair
