// Where rays meet a surface on the CPU.
#pragma once

#include "base/result.h"
#include "runtime/cpu_group.h"
#include "runtime/points/point_domains.h"

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace supple::runtime {

struct Ray {
    glm::dvec3 origin{0.0}, direction{0.0}; ///< of any length but 0
};

/// Finds what a ray meets first. Domains have triangles between samples, and boxes that hold them with their bends; a
/// tree halves the boxes along the longest side. A ray begins Newton's method at each triangle that it meets, or nearly
/// meets.
class RayTree {
public:
    /// `pose`: built; it and `domains` must outlive the tree.
    [[nodiscard]] static Result<RayTree> plant(const CpuPose& pose, std::span<const PointDomain> domains);

    struct Hit {
        uint32_t domain = 0;
        double a = 0.0, b = 0.0;
        double t = 0.0; ///< in lengths of the direction, 0 and more
    };
    [[nodiscard]] Result<std::optional<Hit>> find(const Ray& ray) const;

private:
    struct Box {
        glm::vec3 low{0.0f}, high{0.0f};

        void add(const glm::vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
        void add(const Box& other) { low = glm::min(low, other.low), high = glm::max(high, other.high); }
    };
    struct Node {
        Box box;
        uint32_t begin = 0, end = 0; ///< in order_
        uint32_t second = 0; ///< the node of its second half; the first half's follows it. 0: a leaf of one domain
    };
    /// A domain that a ray may meet, and from where on.
    using Candidate = std::pair<double, uint32_t>;
    class Search;

    RayTree(const CpuPose& pose, std::span<const PointDomain> domains) : pose_(&pose), domains_(domains) {}
    [[nodiscard]] Status sample();
    /// The samples' box and their bends.
    [[nodiscard]] static Box boxOf(bool isQuad, uint32_t along, std::span<const glm::vec3> samples);
    uint32_t split(uint32_t begin, uint32_t end);
    /// From where on the ray is in the box, or nothing.
    [[nodiscard]] std::optional<double> enters(const Ray& ray, const Box& box) const;
    /// Nearest first.
    [[nodiscard]] std::vector<Candidate> candidates(const Ray& ray) const;
    /// At least two, so that samples show a bend.
    [[nodiscard]] uint32_t alongOf(const PointDomain& domain) const {
        return std::max(2u, cellsAlong(pose_->group().cage().sides(domain.face)));
    }

    const CpuPose* pose_;
    std::span<const PointDomain> domains_;
    std::vector<glm::vec3> samples_;
    std::vector<size_t> firsts_; ///< by domain, into samples_
    std::vector<Box> boxes_;     ///< by domain
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
    double tolerance_ = 0.0; ///< how far from the ray a hit may be
};

} // namespace supple::runtime
