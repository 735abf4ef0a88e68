#include "cage/tangents.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <numeric>
#include <utility>

namespace supple::cage {
namespace {

glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > FLT_MIN ? v / length : glm::dvec3(0.0);
}
glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& normal) {
    return unitOrZero(v - glm::dot(normal, v) * normal);
}

constexpr uint32_t nextOf(uint32_t k) {
    return k == 2 ? 0 : k + 1;
}
constexpr uint32_t previousOf(uint32_t k) {
    return k == 0 ? 2 : k - 1;
}

/// MikkTSpace of triangles. A place is a corner of a triangle; it has the number 3 * triangle + k.
class TangentSpace {
public:
    TangentSpace(const Cage& cage, std::span<const uint32_t> triangles, std::span<const glm::vec3> normals,
                 std::span<const glm::vec2> uvs)
        : cage_(cage), corners_(triangles), normals_(normals), uvs_(uvs), triangles_(triangles.size() / 3),
          groups_(triangles.size(), kNone) {}

    std::vector<glm::vec4> build() {
        weld();
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            measure(t);
        }
        findNeighbours();
        std::vector<glm::vec4> tangents(corners_.size(), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
        for (uint32_t place = 0; place < corners_.size(); ++place) {
            const Triangle& triangle = triangles_[place / 3];
            if (!triangle.collapsed && !triangle.anyHand && groups_[place] == kNone) {
                const glm::vec4 tangent = tangentOf(gatherGroup(place));
                for (const uint32_t member : group_) {
                    tangents[member] = tangent;
                }
            }
        }
        fillCollapsed(tangents);
        return tangents;
    }

private:
    struct Triangle {
        glm::dvec3 along{0.0};    ///< the direction in which the first texture coordinate grows
        bool collapsed = false;   ///< two of its points are one
        bool rightHanded = false; ///< the area in texture coordinates is positive
        bool anyHand = true;      ///< there is no such area: it takes the hand of the first group that it joins
        std::array<uint32_t, 3> neighbours{kNone, kNone, kNone}; ///< across the edge from corner k
    };

    [[nodiscard]] glm::dvec3 position(uint32_t place) const {
        return cage_.positions[cage_.faceVertices[corners_[place]]];
    }
    [[nodiscard]] glm::dvec2 uv(uint32_t place) const { return uvs_[corners_[place]]; }
    [[nodiscard]] glm::dvec3 normal(uint32_t place) const { return normals_[corners_[place]]; }

    /// Places with one position, normal and texture coordinate are one point.
    void weld() {
        const auto key = [&](uint32_t place) {
            const uint32_t corner = corners_[place];
            const glm::vec3& p = cage_.positions[cage_.faceVertices[corner]];
            const glm::vec3& n = normals_[corner];
            const glm::vec2& t = uvs_[corner];
            return std::array<float, 8>{p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y};
        };
        std::vector<uint32_t> order(corners_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
            const auto x = key(a), y = key(b);
            return x != y ? x < y : a < b;
        });
        points_.resize(order.size());
        for (size_t i = 0; i < order.size(); ++i) {
            const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
            points_[order[i]] = same ? points_[order[i - 1]] : order[i];
        }
    }

    void measure(uint32_t t) {
        Triangle& triangle = triangles_[t];
        const glm::dvec3 p = position(3 * t), d1 = position(3 * t + 1) - p, d2 = position(3 * t + 2) - p;
        const glm::dvec2 s = uv(3 * t), s1 = uv(3 * t + 1) - s, s2 = uv(3 * t + 2) - s;
        triangle.collapsed = d1 == glm::dvec3(0.0) || d2 == glm::dvec3(0.0) || d1 == d2;
        const double area = s1.x * s2.y - s1.y * s2.x;
        triangle.rightHanded = area > 0.0;
        const glm::dvec3 along = s2.y * d1 - s1.y * d2, up = s1.x * d2 - s2.x * d1;
        if (std::abs(area) > FLT_MIN) {
            triangle.along = unitOrZero(triangle.rightHanded ? along : -along);
            triangle.anyHand = !(glm::length(along) > FLT_MIN && glm::length(up) > FLT_MIN);
        }
    }

    /// Two triangles are neighbours if an edge of one runs from point to point against an edge of the other.
    void findNeighbours() {
        struct Edge {
            uint32_t low = 0, high = 0, place = 0;
            bool rising = false;
        };
        std::vector<Edge> edges;
        for (uint32_t place = 0; place < corners_.size(); ++place) {
            const uint32_t a = points_[place], b = points_[place - place % 3 + nextOf(place % 3)];
            if (!triangles_[place / 3].collapsed) {
                edges.push_back({std::min(a, b), std::max(a, b), place, a < b});
            }
        }
        const auto ends = [](const Edge& edge) { return std::pair(edge.low, edge.high); };
        std::stable_sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return ends(a) < ends(b); });
        for (size_t first = 0, last = 0; first < edges.size(); first = last) {
            while (last < edges.size() && ends(edges[last]) == ends(edges[first])) {
                ++last;
            }
            // If an edge has more than two triangles, the first two that run against each other are neighbours.
            std::array<std::vector<uint32_t>, 2> places;
            for (size_t i = first; i < last; ++i) {
                places[edges[i].rising ? 1 : 0].push_back(edges[i].place);
            }
            for (size_t i = 0; i < std::min(places[0].size(), places[1].size()); ++i) {
                const uint32_t a = places[0][i], b = places[1][i];
                triangles_[a / 3].neighbours[a % 3] = b / 3;
                triangles_[b / 3].neighbours[b % 3] = a / 3;
            }
        }
    }

    /// Fills group_ with the places that share a tangent: those of the point that triangles of one hand lead to, over
    /// their edges at the point.
    uint32_t gatherGroup(uint32_t first) {
        const uint32_t point = points_[first];
        const bool hand = triangles_[first / 3].rightHanded;
        group_.assign(1, first);
        groups_[first] = first;
        for (size_t i = 0; i < group_.size(); ++i) {
            const uint32_t place = group_[i], k = place % 3;
            for (const uint32_t edge : {k, previousOf(k)}) {
                const uint32_t t = triangles_[place / 3].neighbours[edge];
                const uint32_t there = t == kNone ? kNone : placeAt(t, point);
                if (there != kNone && groups_[there] == kNone && takesHand(t, hand)) {
                    groups_[there] = first;
                    group_.push_back(there);
                }
            }
        }
        return first;
    }

    [[nodiscard]] uint32_t placeAt(uint32_t triangle, uint32_t point) const {
        for (uint32_t place = 3 * triangle; place < 3 * triangle + 3; ++place) {
            if (points_[place] == point) {
                return place;
            }
        }
        return kNone;
    }

    bool takesHand(uint32_t t, bool hand) {
        Triangle& triangle = triangles_[t];
        const bool free = groups_[3 * t] == kNone && groups_[3 * t + 1] == kNone && groups_[3 * t + 2] == kNone;
        if (triangle.anyHand && free) {
            triangle.rightHanded = hand;
        }
        return triangle.rightHanded == hand;
    }

    /// The mean of the group's directions on the plane of its normal, weighted by angles.
    [[nodiscard]] glm::vec4 tangentOf(uint32_t first) const {
        const glm::dvec3 n = normal(first);
        glm::dvec3 sum(0.0);
        for (const uint32_t place : group_) {
            const Triangle& triangle = triangles_[place / 3];
            if (triangle.anyHand) {
                continue;
            }
            const uint32_t start = place - place % 3;
            const glm::dvec3 back = across(position(start + previousOf(place % 3)) - position(place), n);
            const glm::dvec3 to = across(position(start + nextOf(place % 3)) - position(place), n);
            sum += std::acos(std::clamp(glm::dot(back, to), -1.0, 1.0)) * across(triangle.along, n);
        }
        return {glm::vec3(unitOrZero(sum)), triangles_[first / 3].rightHanded ? -1.0f : 1.0f};
    }

    /// A collapsed triangle takes what another has at the same point.
    void fillCollapsed(std::vector<glm::vec4>& tangents) const {
        std::vector<uint32_t> known(corners_.size(), kNone); // by point
        for (uint32_t place = 0; place < corners_.size(); ++place) {
            if (!triangles_[place / 3].collapsed && known[points_[place]] == kNone) {
                known[points_[place]] = place;
            }
        }
        for (uint32_t place = 0; place < corners_.size(); ++place) {
            if (triangles_[place / 3].collapsed && known[points_[place]] != kNone) {
                tangents[place] = tangents[known[points_[place]]];
            }
        }
    }

    const Cage& cage_;
    const std::span<const uint32_t> corners_;
    const std::span<const glm::vec3> normals_;
    const std::span<const glm::vec2> uvs_;
    std::vector<Triangle> triangles_;
    std::vector<uint32_t> points_; ///< by place: the first place with the same
    std::vector<uint32_t> groups_; ///< by place: the place that its group began with
    std::vector<uint32_t> group_;  ///< the places of the latest
};

} // namespace

std::vector<glm::vec4> triangleTangents(const Cage& cage, std::span<const uint32_t> triangles,
                                        std::span<const glm::vec3> normals, std::span<const glm::vec2> uvs) {
    const glm::vec4 kNoTangent(0.0f, 0.0f, 0.0f, 1.0f);
    const bool authored = !cage.cornerTangents.empty();
    const auto given = [&](uint32_t corner) { return authored && cage.cornerTangents[corner] != glm::vec4(0.0f); };
    std::vector<glm::vec4> tangents(triangles.size(), kNoTangent);
    if (!uvs.empty() && !std::all_of(triangles.begin(), triangles.end(), given)) {
        tangents = TangentSpace(cage, triangles, normals, uvs).build();
    }
    for (size_t place = 0; place < triangles.size() && authored; ++place) {
        if (given(triangles[place])) {
            tangents[place] = cage.cornerTangents[triangles[place]];
        }
    }
    return tangents;
}

} // namespace supple::cage
