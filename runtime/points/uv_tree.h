// The faces that cover texture coordinates.
#pragma once

#include "cage/character.h"
#include "runtime/points/point_domains.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace supple::runtime {

struct UvBox {
    glm::dvec2 low{0.0}, high{0.0};

    void add(const UvBox& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    [[nodiscard]] bool covers(const glm::dvec2& uv) const {
        return uv.x >= low.x && uv.y >= low.y && uv.x <= high.x && uv.y <= high.y;
    }
};

/// The texture coordinates of a domain's corners.
class DomainUvs {
public:
    /// `middle`: of the face, if it has more than four sides.
    DomainUvs(const cage::Cage& cage, std::span<const glm::vec2> uvs, const PointDomain& domain,
              const glm::dvec2& middle) {
        const uint32_t first = cage.faceStarts[domain.face], sides = cage.sides(domain.face);
        const auto corner = [&](uint32_t k) { return glm::dvec2(uvs[first + k % sides]); };
        if (sides <= 4) {
            count_ = sides;
            for (uint32_t k = 0; k < sides; ++k) {
                corners_[k] = corner(k);
            }
            return;
        }
        corners_ = {corner(domain.side), corner(domain.side + 1), middle, {}};
    }

    [[nodiscard]] UvBox box() const {
        UvBox box{corners_[0], corners_[0]};
        for (uint32_t k = 1; k < count_; ++k) {
            box.add({corners_[k], corners_[k]});
        }
        return box;
    }
    /// The numbers of the point that has the coordinates, if the domain covers them.
    [[nodiscard]] std::optional<glm::dvec2> find(const glm::dvec2& uv) const {
        return count_ == 4 ? inQuad(uv - corners_[0]) : inTriangle(uv - corners_[0]);
    }

private:
    static double crossOf(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
    static bool isIn(double t) { return t >= -1e-9 && t <= 1.0 + 1e-9; }
    [[nodiscard]] std::optional<glm::dvec2> inTriangle(const glm::dvec2& h) const {
        const glm::dvec2 x = corners_[1] - corners_[0], y = corners_[2] - corners_[0];
        const double area = crossOf(x, y), a = crossOf(h, y) / area, b = crossOf(x, h) / area;
        return isIn(a) && isIn(b) && a + b <= 1.0 + 1e-9 ? std::optional(glm::dvec2(a, b)) : std::nullopt;
    }
    /// h = u e + v f + u v g, by the quadratic for v in its stable form.
    [[nodiscard]] std::optional<glm::dvec2> inQuad(const glm::dvec2& h) const {
        const glm::dvec2 e = corners_[1] - corners_[0], f = corners_[3] - corners_[0],
                         g = (corners_[0] - corners_[1]) + (corners_[2] - corners_[3]);
        const double k2 = crossOf(g, f), k1 = crossOf(e, f) + crossOf(h, g), k0 = crossOf(h, e);
        const double root = k1 * k1 - 4.0 * k2 * k0;
        if (!(root >= 0.0)) {
            return std::nullopt;
        }
        const double s = -0.5 * (k1 + std::copysign(std::sqrt(root), k1));
        for (const double v : {k0 / s, s / k2}) {
            const glm::dvec2 across = e + v * g, rest = h - v * f;
            const double u = std::abs(across.x) > std::abs(across.y) ? rest.x / across.x : rest.y / across.y;
            if (isIn(u) && isIn(v)) {
                return glm::dvec2(u, v);
            }
        }
        return std::nullopt;
    }

    std::array<glm::dvec2, 4> corners_{};
    uint32_t count_ = 3;
};

/// Finds the domains that cover coordinates, by a tree of boxes that halves the domains along the longest side.
class UvTree {
public:
    /// `uvs`: by corner of the cage.
    UvTree(const cage::Cage& cage, std::span<const glm::vec2> uvs, std::span<const PointDomain> domains);

    struct Found {
        uint32_t domain = 0;
        glm::dvec2 at{0.0};
    };
    /// The first `most` faces that cover the coordinates, by one domain of each.
    [[nodiscard]] std::vector<Found> find(const glm::dvec2& uv, size_t most) const;

private:
    struct Node {
        UvBox box;
        uint32_t first = 0;          ///< of its domains, the lowest number
        uint32_t begin = 0, end = 0; ///< in order_
        uint32_t second = 0;         ///< the node of its second half; the first half's follows it. 0: a leaf
    };
    static constexpr uint32_t kLeaf = 4;

    uint32_t split(uint32_t begin, uint32_t end, std::span<const UvBox> boxes);
    void search(uint32_t node, const glm::dvec2& uv, size_t most, std::vector<Found>& found) const;
    /// Puts a domain into what is found, in rising order.
    void take(const Found& own, size_t most, std::vector<Found>& found) const;

    std::vector<DomainUvs> domains_;
    std::vector<uint32_t> faces_; ///< by domain
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace supple::runtime
