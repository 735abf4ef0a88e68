#include "tests/support/bend.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numeric>
#include <set>

namespace supple::test {

namespace {

glm::dvec3 placeOf(const cage::Character& character, uint32_t joint) {
    return glm::dvec3(glm::inverse(glm::dmat4(character.skin.inverseBinds[joint]))[3]);
}

std::vector<std::array<uint32_t, 3>> fansOf(const cage::Cage& cage) {
    std::vector<std::array<uint32_t, 3>> fans;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        const uint32_t* const corners = &cage.faceVertices[cage.faceStarts[f]];
        for (uint32_t c = 2; c < cage.sides(f); ++c) {
            fans.push_back({corners[0], corners[c - 1], corners[c]});
        }
    }
    return fans;
}

std::vector<uint32_t> jointParents(const cage::Character& character) {
    std::map<uint32_t, uint32_t> jointOf;
    for (uint32_t j = 0; j < character.skin.joints.size(); ++j) {
        jointOf[character.skin.joints[j]] = j;
    }
    std::vector<uint32_t> parents;
    for (const uint32_t joint : character.skin.joints) {
        uint32_t node = character.skeleton.nodes[joint].parent;
        while (node != cage::kNone && jointOf.count(node) == 0) {
            node = character.skeleton.nodes[node].parent;
        }
        parents.push_back(node == cage::kNone ? cage::kNone : jointOf[node]);
    }
    return parents;
}

/// Against the directions of the triangles that they bound.
std::vector<std::vector<uint32_t>> loopsOf(const std::vector<std::array<uint32_t, 3>>& triangles) {
    std::set<std::array<uint32_t, 2>> edges;
    std::vector<std::array<uint32_t, 2>> inOrder;
    for (const auto& t : triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const std::array edge{t[k], t[(k + 1) % 3]};
            if (edges.insert(edge).second) {
                inOrder.push_back(edge);
            }
        }
    }
    std::vector<uint32_t> begins;
    std::map<uint32_t, std::vector<uint32_t>> next;
    for (const auto& [a, b] : inOrder) {
        if (edges.count({b, a}) == 0) {
            next[b].push_back(a);
            begins.push_back(b);
        }
    }
    std::vector<std::vector<uint32_t>> loops;
    for (const uint32_t begin : begins) {
        std::vector<uint32_t> loop;
        for (uint32_t vertex = begin; !next[vertex].empty();) {
            loop.push_back(vertex);
            const uint32_t after = next[vertex].back();
            next[vertex].pop_back();
            vertex = after;
        }
        if (!loop.empty()) {
            loops.push_back(std::move(loop));
        }
    }
    return loops;
}

double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const double at = share * static_cast<double>(values.size() - 1);
    const auto low = static_cast<size_t>(at);
    const double part = at - static_cast<double>(low);
    return values[low] + (part > 0.0 ? part * (values[low + 1] - values[low]) : 0.0);
}

glm::dvec3 perpendicular(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 across = glm::cross(a, b);
    if (glm::length(across) >= 0.05) {
        return across;
    }
    return glm::cross(b, std::abs(b.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0));
}

} // namespace

Bend::Bend(const cage::Character& character, const Turn& turn)
    : character_(character), rest_(character.cage.positions.begin(), character.cage.positions.end()),
      parents_(jointParents(character)) {
    uint32_t joint = 0;
    while (character.skeleton.nodes[character.skin.joints[joint]].name != turn.joint) {
        ++joint;
    }
    for (uint32_t j = 0; j < parents_.size(); ++j) {
        uint32_t above = j;
        while (above != cage::kNone && above != joint) {
            above = parents_[above];
        }
        below_.push_back(above == joint);
    }
    findBones(joint);
    const glm::dvec3 axis = turn.about == Turn::About::hinge  ? perpendicular(up_, down_)
                            : turn.about == Turn::About::bone ? down_
                                                              : turn.axis;
    turned_ = glm::angleAxis(glm::radians(turn.degrees), glm::normalize(axis));
    rotation_ = glm::mat3_cast(turned_);
    glm::dmat4 moved(rotation_);
    moved[3] = glm::dvec4(at_ - rotation_ * at_, 1.0);
    for (const bool moves : below_) {
        palette_.push_back(skinning::toAffine(moves ? glm::mat4(moved) : glm::mat4(1.0f)));
    }
    glm::dvec3 low = rest_[0], high = rest_[0];
    for (const glm::dvec3& p : rest_) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 size = high - low;
    takeFaces(turn.reach * std::max({size.x, size.y, size.z}));
}

void Bend::findBones(uint32_t joint) {
    at_ = placeOf(character_, joint);
    glm::dvec3 low = rest_[0], high = rest_[0];
    for (const glm::dvec3& p : rest_) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    // Of several joints that hang on it, the one that moves most.
    std::vector<double> moved(parents_.size(), 0.0);
    for (const cage::Influence& influence : character_.weights.influences) {
        for (uint32_t j = influence.joint; j != cage::kNone; j = parents_[j]) {
            moved[j] += static_cast<double>(influence.weight);
        }
    }
    uint32_t child = cage::kNone;
    for (uint32_t j = 0; j < parents_.size(); ++j) {
        if (parents_[j] == joint && glm::distance(placeOf(character_, j), at_) > 0.01 * extent &&
            (child == cage::kNone || moved[j] > moved[child])) {
            child = j;
        }
    }
    const glm::dmat4 bind = glm::inverse(glm::dmat4(character_.skin.inverseBinds[joint]));
    down_ = glm::normalize(child != cage::kNone ? placeOf(character_, child) - at_ : glm::dvec3(bind[1]));
    uint32_t above = parents_[joint];
    while (glm::distance(placeOf(character_, above), at_) < 0.02 * extent && parents_[above] != cage::kNone) {
        above = parents_[above];
    }
    up_ = glm::normalize(at_ - placeOf(character_, above));
}

double Bend::weightBelow(size_t vertex) const {
    double sum = 0.0;
    for (uint32_t i = character_.weights.starts[vertex]; i < character_.weights.starts[vertex + 1]; ++i) {
        const cage::Influence& influence = character_.weights.influences[i];
        sum += below_[influence.joint] ? static_cast<double>(influence.weight) : 0.0;
    }
    return sum;
}

/// Those of the limb alone: what moves, or hangs together with it within the radius.
void Bend::takeFaces(double radius) {
    const size_t count = rest_.size();
    std::vector<bool> near(count), taken(count);
    for (size_t v = 0; v < count; ++v) {
        near[v] = glm::distance(rest_[v], at_) < radius;
        taken[v] = near[v] && weightBelow(v) > 0.02 && weightBelow(v) < 0.98;
    }
    if (std::find(taken.begin(), taken.end(), true) == taken.end()) {
        taken = near;
    }
    const cage::Cage& cage = character_.cage;
    for (int round = 0; round < 60; ++round) {
        const std::vector<bool> before = taken;
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            for (uint32_t c = 0; c < cage.sides(f); ++c) {
                const uint32_t a = cage.faceVertices[cage.faceStarts[f] + c];
                const uint32_t b = cage.faceVertices[cage.faceStarts[f] + (c + 1) % cage.sides(f)];
                taken[a] = taken[a] || (before[b] && near[a]);
                taken[b] = taken[b] || (before[a] && near[b]);
            }
        }
    }
    for (const auto& t : fansOf(cage)) {
        if (taken[t[0]] && taken[t[1]] && taken[t[2]]) {
            triangles_.push_back(t);
            vertices_.insert(vertices_.end(), t.begin(), t.end());
        }
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    loops_ = loopsOf(triangles_);
}

double Bend::signedVolume(std::span<const glm::dvec3> points) const {
    glm::dvec3 middle(0.0);
    for (const uint32_t v : vertices_) {
        middle += points[v] / static_cast<double>(vertices_.size());
    }
    const auto at = [&](uint32_t v) { return points[v] - middle; };
    double sum = 0.0;
    for (const auto& t : triangles_) {
        sum += glm::dot(at(t[0]), glm::cross(at(t[1]), at(t[2])));
    }
    for (const std::vector<uint32_t>& loop : loops_) {
        glm::dvec3 mean(0.0);
        for (const uint32_t v : loop) {
            mean += at(v) / static_cast<double>(loop.size());
        }
        for (size_t i = 0; i < loop.size(); ++i) {
            sum += glm::dot(glm::cross(at(loop[i]), at(loop[(i + 1) % loop.size()])), mean);
        }
    }
    return sum / 6.0;
}

double Bend::volume(std::span<const glm::dvec3> skinned) const {
    return signedVolume(skinned) / signedVolume(rest_);
}

std::array<double, 2> Bend::thickness(std::span<const glm::dvec3> skinned) const {
    const auto fromBones = [&](const glm::dvec3& point, const glm::dvec3& down) {
        double nearest = 1e30;
        for (const glm::dvec3& bone : {-up_, down}) {
            const glm::dvec3 way = point - at_;
            nearest = std::min(nearest, glm::length(way - std::max(glm::dot(way, bone), 0.0) * bone));
        }
        return nearest;
    };
    std::vector<double> rest, ratios;
    for (const uint32_t v : vertices_) {
        rest.push_back(fromBones(rest_[v], down_));
    }
    const double least = 0.25 * quantile(rest, 0.5);
    for (size_t i = 0; i < vertices_.size(); ++i) {
        ratios.push_back(fromBones(skinned[vertices_[i]], rotation_ * down_) / std::max(rest[i], least));
    }
    return {quantile(ratios, 0.05), quantile(ratios, 0.95)};
}

uint32_t Bend::turnedOver(std::span<const glm::dvec3> skinned) const {
    const auto normal = [](std::span<const glm::dvec3> points, const std::array<uint32_t, 3>& t) {
        return glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
    };
    uint32_t count = 0;
    for (const auto& t : triangles_) {
        const double share = (weightBelow(t[0]) + weightBelow(t[1]) + weightBelow(t[2])) / 3.0;
        const glm::dquat blend = glm::normalize(glm::dquat(1.0, 0.0, 0.0, 0.0) * (1.0 - share) + turned_ * share);
        count += glm::dot(blend * normal(rest_, t), normal(skinned, t)) < 0.0 ? 1 : 0;
    }
    return count;
}

} // namespace supple::test
