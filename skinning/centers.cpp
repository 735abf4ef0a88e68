#include "skinning/centers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace supple::skinning {

namespace {

constexpr double kSigma = 0.1;
/// Weights of two joints fall into cells, so many a side; triangles of one cell count as one with their mean weights.
constexpr uint32_t kCells = 64;

/// Lists of numbers by joint.
struct JointLists {
    std::vector<uint32_t> starts, entries;

    [[nodiscard]] std::span<const uint32_t> of(uint32_t joint) const {
        return std::span(entries).subspan(starts[joint], starts[joint + 1] - starts[joint]);
    }
};

/// `visit(number, joint)` is called for each entry by forEach(entry), which lists them in the same order every time.
template <class F>
JointLists listByJoint(size_t jointCount, F&& forEach) {
    JointLists lists;
    lists.starts.assign(jointCount + 1, 0);
    forEach([&](uint32_t, uint32_t joint) { ++lists.starts[joint + 1]; });
    for (size_t j = 0; j < jointCount; ++j) {
        lists.starts[j + 1] += lists.starts[j];
    }
    lists.entries.resize(lists.starts.back());
    std::vector<uint32_t> next(lists.starts.begin(), lists.starts.end() - 1);
    forEach([&](uint32_t number, uint32_t joint) { lists.entries[next[joint]++] = number; });
    return lists;
}

struct Triangle {
    std::array<uint32_t, 3> vertices{};
    double area = 0.0;
};

class CenterFinder {
public:
    explicit CenterFinder(const cage::Character& character) : character_(character) {
        const size_t joints = character.skin.joints.size(), vertices = character.cage.positions.size();
        takeInfluences();
        takeTriangles();
        verticesOf_ = listByJoint(joints, [&](auto&& visit) {
            for (uint32_t v = 0; v < vertices; ++v) {
                for (const cage::Influence& own : influences(v)) {
                    visit(v, own.joint);
                }
            }
        });
        trianglesOf_ = listByJoint(joints, [&](auto&& visit) {
            for (uint32_t t = 0; t < triangles_.size(); ++t) {
                forJoints(triangles_[t], [&](uint32_t joint) { visit(t, joint); });
            }
        });
        sums_.assign(vertices, glm::dvec4(0.0));
        cells_.resize(size_t{kCells} * kCells);
    }

    [[nodiscard]] std::vector<glm::vec4> find() {
        for (uint32_t joint = 0; joint < character_.skin.joints.size(); ++joint) {
            addPairsOf(joint);
        }
        double largest = 0.0;
        for (const Triangle& triangle : triangles_) {
            largest = std::max(largest, triangle.area);
        }
        std::vector<glm::vec4> points(sums_.size(), glm::vec4(0.0f));
        for (size_t v = 0; v < sums_.size(); ++v) {
            const glm::vec3 center(glm::dvec3(sums_[v]) / sums_[v].w);
            const bool found = sums_[v].w > 1e-12 * largest && std::isfinite(center.x + center.y + center.z);
            points[v] = found ? glm::vec4(center, 1.0f) : glm::vec4(0.0f);
        }
        return points;
    }

private:
    /// Triangles of like weights of two joints.
    struct Cell {
        double area = 0.0, first = 0.0, second = 0.0; ///< weights times areas
        glm::dvec3 point{0.0};                        ///< times areas
    };

    [[nodiscard]] std::span<const cage::Influence> influences(uint32_t vertex) const {
        return std::span(weights_.influences)
            .subspan(weights_.starts[vertex], weights_.starts[vertex + 1] - weights_.starts[vertex]);
    }
    [[nodiscard]] double weightOf(uint32_t vertex, uint32_t joint) const {
        for (const cage::Influence& own : influences(vertex)) {
            if (own.joint == joint) {
                return static_cast<double>(own.weight);
            }
        }
        return 0.0;
    }

    /// The heaviest of every vertex.
    void takeInfluences() {
        std::vector<cage::Influence> own;
        const cage::SkinWeights& all = character_.weights;
        weights_.starts.push_back(0);
        for (size_t v = 0; v + 1 < all.starts.size(); ++v) {
            own.clear();
            std::copy_if(all.influences.begin() + all.starts[v], all.influences.begin() + all.starts[v + 1],
                         std::back_inserter(own), [](const cage::Influence& one) { return one.weight > 0.0f; });
            std::stable_sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });
            own.resize(std::min(own.size(), kCenterInfluences));
            weights_.influences.insert(weights_.influences.end(), own.begin(), own.end());
            weights_.starts.push_back(static_cast<uint32_t>(weights_.influences.size()));
        }
    }

    void takeTriangles() {
        const cage::Cage& cage = character_.cage;
        const auto at = [&](uint32_t vertex) { return glm::dvec3(cage.positions[vertex]); };
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            const uint32_t* const corners = &cage.faceVertices[cage.faceStarts[f]];
            for (uint32_t c = 2; c < cage.sides(f); ++c) {
                const glm::dvec3 a = at(corners[0]), b = at(corners[c - 1]), d = at(corners[c]);
                triangles_.push_back(
                    {{corners[0], corners[c - 1], corners[c]}, 0.5 * glm::length(glm::cross(b - a, d - a))});
            }
        }
    }

    /// Every joint of the triangle's vertices once.
    template <class F>
    void forJoints(const Triangle& triangle, F&& visit) const {
        const auto has = [&](uint32_t vertex, uint32_t joint) { return weightOf(vertex, joint) > 0.0; };
        for (size_t corner = 0; corner < 3; ++corner) {
            for (const cage::Influence& own : influences(triangle.vertices[corner])) {
                if ((corner < 1 || !has(triangle.vertices[0], own.joint)) &&
                    (corner < 2 || !has(triangle.vertices[1], own.joint))) {
                    visit(own.joint);
                }
            }
        }
    }

    /// What the pairs of a joint and a later one give to the vertices of both.
    void addPairsOf(uint32_t joint) {
        partners_.clear();
        for (const uint32_t v : verticesOf_.of(joint)) {
            for (const cage::Influence& other : influences(v)) {
                if (other.joint > joint) {
                    partners_.push_back({other.joint, v});
                }
            }
        }
        std::sort(partners_.begin(), partners_.end());
        for (size_t begin = 0; begin < partners_.size();) {
            const uint32_t other = partners_[begin][0];
            size_t end = begin;
            while (end < partners_.size() && partners_[end][0] == other) {
                ++end;
            }
            fillCells(joint, other);
            for (; begin < end; ++begin) {
                addCells(partners_[begin][1], joint, other);
            }
        }
    }

    void fillCells(uint32_t first, uint32_t second) {
        for (const uint32_t cell : filled_) {
            cells_[cell] = {};
        }
        filled_.clear();
        const std::span<const uint32_t> a = trianglesOf_.of(first), b = trianglesOf_.of(second);
        for (const uint32_t t : a.size() < b.size() ? a : b) {
            const Triangle& triangle = triangles_[t];
            glm::dvec3 v, w;
            std::array<glm::dvec3, 3> points;
            for (int corner = 0; corner < 3; ++corner) {
                const uint32_t vertex = triangle.vertices[static_cast<size_t>(corner)];
                v[corner] = weightOf(vertex, first);
                w[corner] = weightOf(vertex, second);
                points[static_cast<size_t>(corner)] = glm::dvec3(character_.cage.positions[vertex]);
            }
            if (v == glm::dvec3(0.0) || w == glm::dvec3(0.0)) {
                continue;
            }
            // Cut at the middles of its edges: their corners' means, in shares of the corners.
            for (int part = 0; part < 4; ++part) {
                glm::dvec3 shares(part < 3 ? 1.0 / 6.0 : 1.0 / 3.0);
                if (part < 3) {
                    shares[part] = 4.0 / 6.0;
                }
                addTriangle(0.25 * triangle.area, glm::dot(shares, v), glm::dot(shares, w),
                            shares.x * points[0] + shares.y * points[1] + shares.z * points[2]);
            }
        }
    }

    void addTriangle(double area, double first, double second, const glm::dvec3& point) {
        const auto place = [](double weight) {
            return std::min(static_cast<uint32_t>(std::max(weight, 0.0) * kCells), kCells - 1);
        };
        const uint32_t number = place(first) * kCells + place(second);
        Cell& cell = cells_[number];
        if (cell.area == 0.0 && area > 0.0) {
            filled_.push_back(number);
        }
        cell.area += area;
        cell.first += area * first;
        cell.second += area * second;
        cell.point += area * point;
    }

    void addCells(uint32_t vertex, uint32_t first, uint32_t second) {
        const double w = weightOf(vertex, first), v = weightOf(vertex, second);
        glm::dvec4& sum = sums_[vertex];
        for (const uint32_t number : filled_) {
            const Cell& cell = cells_[number];
            const double x = w * cell.second / cell.area, y = v * cell.first / cell.area, apart = (x - y) / kSigma;
            const double likeness = 2.0 * x * y * std::exp(-apart * apart);
            sum += likeness * glm::dvec4(cell.point, cell.area);
        }
    }

    const cage::Character& character_;
    cage::SkinWeights weights_;
    std::vector<Triangle> triangles_;
    JointLists verticesOf_, trianglesOf_;
    std::vector<glm::dvec4> sums_; ///< by vertex: likeness times area times point, and likeness times area

    // For one pair of joints:
    std::vector<std::array<uint32_t, 2>> partners_; ///< later joint, vertex
    std::vector<Cell> cells_;
    std::vector<uint32_t> filled_;
};

} // namespace

Centers Centers::of(const cage::Character& character, std::vector<glm::vec4> points) {
    Centers centers{std::move(points), std::vector<double>(character.skin.joints.size(), 0.0)};
    for (size_t v = 0; v < centers.points.size(); ++v) {
        if (centers.points[v].w == 0.0f) {
            continue;
        }
        const double arm = glm::distance(glm::dvec3(character.cage.positions[v]), glm::dvec3(centers.points[v]));
        for (uint32_t i = character.weights.starts[v]; i < character.weights.starts[v + 1]; ++i) {
            double& longest = centers.arms[character.weights.influences[i].joint];
            longest = std::max(longest, arm);
        }
    }
    return centers;
}

Centers findCenters(const cage::Character& character) {
    return Centers::of(character, CenterFinder(character).find());
}

} // namespace supple::skinning
