#include "cage/skeleton.h"

#include "cage/message.h"
#include "cage/refusal.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace supple::cage {
namespace {

/// The children of each node, by number.
struct Children {
    std::vector<uint32_t> starts, nodes;

    explicit Children(const std::vector<Node>& of) : starts(of.size() + 1, 0) {
        for (const Node& node : of) {
            if (node.parent != kNone) {
                ++starts[node.parent + 1];
            }
        }
        for (size_t i = 1; i < starts.size(); ++i) {
            starts[i] += starts[i - 1];
        }
        nodes.resize(starts.back());
        std::vector<uint32_t> next(starts.begin(), starts.end() - 1);
        for (uint32_t i = 0; i < of.size(); ++i) {
            if (of[i].parent != kNone) {
                nodes[next[of[i].parent]++] = i;
            }
        }
    }
};

} // namespace

namespace {

constexpr const char* kNotAffine = "last row is not 0 0 0 1";

/// Tells whether the last row was 0 0 0 1 but for rounding.
bool setLastRow(glm::mat4& matrix) {
    const glm::vec4 wanted(0.0f, 0.0f, 0.0f, 1.0f);
    bool was = true;
    for (int k = 0; k < 4; ++k) {
        was = std::abs(matrix[k][3] - wanted[k]) <= 1e-4f && was;
        matrix[k][3] = wanted[k];
    }
    return was;
}

} // namespace

void makeAffine(glm::mat4& matrix, const std::string& element) {
    if (!setLastRow(matrix)) {
        refuse(element, kNotAffine);
    }
}

void makeAffine(glm::mat4& matrix, const std::string& element, Leniency& leniency) {
    if (!setLastRow(matrix)) {
        leniency.mend(element, kNotAffine, "read as if it were");
    }
}

std::string nameOf(const Skeleton& skeleton, uint32_t node) {
    const std::string& name = skeleton.nodes[node].name;
    return name.empty() ? at("node", node) : name;
}

glm::dmat4 localMatrix(const Node& node) {
    if (node.hasMatrix) {
        return glm::dmat4(node.matrix);
    }
    return glm::translate(glm::dmat4(1.0), glm::dvec3(node.translation)) *
           glm::mat4_cast(glm::normalize(glm::dquat(node.rotation))) *
           glm::scale(glm::dmat4(1.0), glm::dvec3(node.scale));
}

std::vector<glm::dmat4> restPlaces(const Skeleton& skeleton) {
    std::vector<glm::dmat4> places(skeleton.nodes.size());
    for (const uint32_t node : skeleton.parentsFirst) {
        const glm::dmat4 local = localMatrix(skeleton.nodes[node]);
        const uint32_t parent = skeleton.nodes[node].parent;
        places[node] = parent == kNone ? local : places[parent] * local;
    }
    return places;
}

bool decompose(Node& node) {
    const glm::mat3 linear(node.matrix);
    glm::vec3 scale(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
    if (!(scale.x > 0.0f && scale.y > 0.0f && scale.z > 0.0f)) {
        return false;
    }
    if (glm::determinant(linear) < 0.0f) {
        scale.x = -scale.x;
    }
    const glm::quat rotation =
        glm::normalize(glm::quat_cast(glm::mat3(linear[0] / scale.x, linear[1] / scale.y, linear[2] / scale.z)));
    const glm::mat3 turned = glm::mat3_cast(rotation);
    for (int axis = 0; axis < 3; ++axis) {
        if (!(glm::length(turned[axis] * scale[axis] - linear[axis]) <= 1e-4f * std::abs(scale[axis]))) {
            return false;
        }
    }
    node.translation = glm::vec3(node.matrix[3]);
    node.rotation = rotation;
    node.scale = scale;
    node.matrix = glm::mat4(1.0f);
    node.hasMatrix = false;
    return true;
}

glm::quat unitRotation(const std::array<double, 4>& q, const std::string& element) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 1e-6)) {
        refuse(element, "zero quaternion");
    }
    const double scale = std::abs(length - 1.0) > 1e-5 ? 1.0 / length : 1.0;
    return {static_cast<float>(q[3] * scale), static_cast<float>(q[0] * scale), static_cast<float>(q[1] * scale),
            static_cast<float>(q[2] * scale)};
}

void orderParentsFirst(Skeleton& skeleton) {
    // Breadth-first from the roots, no recursion.
    const std::vector<Node>& nodes = skeleton.nodes;
    const Children children(nodes);
    std::vector<uint32_t>& order = skeleton.parentsFirst;
    order.reserve(nodes.size());
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].parent == kNone) {
            order.push_back(i);
        }
    }
    uint32_t depth = 1;
    for (size_t begin = 0, end = order.size(); begin < end; ++depth) {
        if (depth > kMaxNodeDepth) {
            refuse(at("node", order[begin]), "nested deeper than " + std::to_string(kMaxNodeDepth) + " levels",
                   ErrorCode::limit);
        }
        for (size_t k = begin; k < end; ++k) {
            for (uint32_t c = children.starts[order[k]]; c < children.starts[order[k] + 1]; ++c) {
                order.push_back(children.nodes[c]);
            }
        }
        begin = end;
        end = order.size();
    }
    if (order.size() == nodes.size()) {
        return;
    }
    std::vector<uint8_t> reached(nodes.size(), 0);
    for (const uint32_t node : order) {
        reached[node] = 1;
    }
    Found found;
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        if (reached[i] == 0) {
            found.add([&] { return at("node", i); });
        }
    }
    refuse("nodes", found.told("node is its own ancestor, or below one that is",
                               "nodes are their own ancestors, or below one that is"));
}

} // namespace supple::cage
