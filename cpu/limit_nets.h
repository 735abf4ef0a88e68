// The points that the limit of a subdivision is evaluated from: nets round the vertices of a mesh, level by level. Near
// vertices levels go on without end: some are kept for a posed cage, the rest are made when a place asks.
#pragma once

#include "cpu/fragment.h"
#include "cpu/jobs.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

namespace supple::surface::subdivision {

/// What no pose changes. The mesh must outlive it.
class LimitShape {
public:
    /// A sector of a fragment, or a facet.
    struct Sector {
        uint32_t fragment = 0, number = 0;
    };

    explicit LimitShape(const Mesh& mesh);

    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    /// Four per face of the level before: of its corners and, of a triangle, the middle.
    [[nodiscard]] const std::vector<Sector>& sectors() const { return sectors_; }
    [[nodiscard]] const Pattern& patternOf(const Fan& fan) const { return patterns_.at(fan); }
    /// No crease passes, and all faces are regular: leaves of level 2 reach up to the vertex.
    [[nodiscard]] bool isUniform(uint32_t fragment) const { return uniform_[fragment] != 0; }
    /// Alone between the two halves of a crease, which has one direction at the vertex: there the sector's edges are
    /// parallel in the limit.
    [[nodiscard]] bool isFlatCorner(const Sector& sector) const;

    /// The nets that LimitPose keeps for a fragment: levels 2 to `last`, or that of a facet. Before the points of a
    /// level stands what they are relative to.
    void keep(uint32_t fragment);
    struct Kept {
        size_t first = 0; ///< point
        uint32_t last = 0;
        uint32_t perLevel = 0; ///< points, and the one before them
    };
    [[nodiscard]] const Kept& keptOf(uint32_t fragment) const { return kept_[fragment]; }
    [[nodiscard]] std::span<const uint32_t> keptFragments() const { return keptFragments_; }
    [[nodiscard]] size_t keptPoints() const { return keptPoints_; }

private:
    const Mesh& mesh_;
    std::map<Fan, Pattern> patterns_; ///< of a step from radius 2 to radius 3
    std::vector<Sector> sectors_;
    std::vector<uint8_t> uniform_;
    std::vector<Kept> kept_;
    std::vector<uint32_t> keptFragments_;
    size_t keptPoints_ = 0;
};

/// The points of a posed cage.
class LimitPose {
public:
    explicit LimitPose(const LimitShape& shape);
    /// `positions`: of the cage that the mesh was built from.
    [[nodiscard]] Status build(std::span<const glm::dvec3> positions, const RunJobs& runJobs);
    [[nodiscard]] Status build(std::span<const glm::vec3> positions, const RunJobs& runJobs);

    [[nodiscard]] const LimitShape& shape() const { return shape_; }
    [[nodiscard]] std::span<const glm::dvec3> isolated() const { return steps_.back(); }
    /// A fragment on the isolated level.
    [[nodiscard]] FragmentNet<double> netOf(const Fragment& fragment) const;
    [[nodiscard]] bool keeps(uint32_t fragment, uint32_t level) const { return level <= shape_.keptOf(fragment).last; }
    /// A kept level: its origin, then its points.
    [[nodiscard]] std::span<const glm::dvec3> kept(uint32_t fragment, uint32_t level) const;

private:
    void buildNets(FragmentNet<double>& net, uint32_t fragment);

    const LimitShape& shape_;
    std::vector<glm::dvec3> given_;              ///< positions that came as floats
    std::vector<std::vector<glm::dvec3>> steps_; ///< the vertices after each step
    std::vector<glm::dvec3> nets_;
};

/// What a place is evaluated from: the net of a sector on a level. Level 0: the limit at the centre.
struct SectorLevel {
    LimitShape::Sector sector;
    uint32_t level = 0;
};

/// A fragment's net on a level: points up to radius 3 and the sharpness that is left.
class LevelNet {
public:
    /// Level 2 and up; a facet has level 1.
    LevelNet(const LimitPose& pose, uint32_t fragment, uint32_t level);
    /// On points of the caller, which are relative to nothing and must outlive it.
    LevelNet(const Mesh& mesh, uint32_t fragment, uint32_t level, std::span<const glm::dvec3> points)
        : mesh_(mesh), fragment_(mesh.fragments[fragment]), level_(level), origin_(0.0), points_(points) {}

    [[nodiscard]] const Fragment& fragment() const { return fragment_; }
    [[nodiscard]] uint32_t level() const { return level_; }

    /// Relative to the origin, which is the first of them.
    [[nodiscard]] std::span<const glm::dvec3> points() const { return points_; }
    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    [[nodiscard]] float sharpnessOf(uint32_t spoke) const;

private:
    const Mesh& mesh_;
    const Fragment& fragment_;
    uint32_t level_;
    glm::dvec3 origin_;
    std::span<const glm::dvec3> points_;
    std::vector<glm::dvec3> made_; ///< where the level is not kept
};

/// Both, for who poses a mesh once and keeps no nets. Its constructor throws if memory runs out.
struct PosedLimit {
    PosedLimit(const Mesh& mesh, std::span<const glm::dvec3> positions);
    PosedLimit(const PosedLimit&) = delete;
    PosedLimit& operator=(const PosedLimit&) = delete;

    LimitShape shape;
    LimitPose pose;
};

} // namespace supple::surface::subdivision
