#include "cage/bind_space.h"

#include "cage/limits.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace supple::cage {
namespace {

glm::dmat4 localMatrix(const Node& node) {
    if (node.hasMatrix) {
        return glm::dmat4(node.matrix);
    }
    return glm::translate(glm::dmat4(1.0), glm::dvec3(node.translation)) *
           glm::mat4_cast(glm::normalize(glm::dquat(node.rotation))) *
           glm::scale(glm::dmat4(1.0), glm::dvec3(node.scale));
}

/// Nodes are hidden by a scale of 0: then nothing is known of where their vertices stand.
bool isUsable(const glm::dmat4& matrix) {
    const double determinant = glm::determinant(glm::dmat3(matrix));
    return std::isfinite(determinant) && std::abs(determinant) > 1e-30;
}

/// Points (w = 1) or displacements (w = 0) at their place; nothing if one is too far to be read again.
std::optional<std::vector<glm::vec3>> taken(const std::vector<glm::vec3>& from, const glm::dmat4& place, double w) {
    std::vector<glm::vec3> to;
    to.reserve(from.size());
    for (const glm::vec3& vector : from) {
        to.emplace_back(place * glm::dvec4(vector, w));
        if (faultOfCoordinates(&to.back().x, 3) != nullptr) {
            return std::nullopt;
        }
    }
    return to;
}

} // namespace

MeshBinding bindToNode(uint32_t node) {
    return {node, false, {{node}, {glm::mat4(1.0f)}}};
}

BindSpace::BindSpace(const Skeleton& skeleton, std::span<const MeshBinding> meshes)
    : skeleton_(skeleton), alone_(meshes.size() == 1) {
    for (const MeshBinding& mesh : meshes) {
        for (size_t j = 0; mesh.skinned && j < mesh.skin.joints.size(); ++j) {
            const glm::dmat4 bind(mesh.skin.inverseBinds[j]);
            if (isUsable(bind)) {
                joints_.emplace(mesh.skin.joints[j], glm::inverse(bind));
            }
        }
    }
}

glm::dmat4 BindSpace::placeOf(uint32_t node) const {
    glm::dmat4 place(1.0);
    for (; node != kNone; node = skeleton_.nodes[node].parent) {
        const auto joint = joints_.find(node);
        if (joint != joints_.end()) {
            return joint->second * place;
        }
        place = localMatrix(skeleton_.nodes[node]) * place;
    }
    return place;
}

bool BindSpace::place(PartCage& part, MeshBinding& mesh) const {
    if (mesh.skinned) {
        return true;
    }
    const glm::dmat4 place = placeOf(mesh.node);
    const bool mirrored = glm::determinant(glm::dmat3(place)) < 0.0;
    if (!isUsable(place) || (alone_ && !mirrored)) {
        return true;
    }
    glm::mat4 bind(glm::inverse(place));
    for (int k = 0; k < 4; ++k) {
        bind[k][3] = k < 3 ? 0.0f : 1.0f; // not -0
    }
    std::optional<std::vector<glm::vec3>> positions = taken(part.cage.positions, place, 1.0);
    std::vector<std::vector<glm::vec3>> deltas;
    for (const MorphTarget& target : part.morphs.targets) {
        std::optional<std::vector<glm::vec3>> of = taken(target.deltas, place, 0.0);
        if (!of) {
            return false;
        }
        deltas.push_back(std::move(*of));
    }
    if (!positions || faultOfCoordinates(&bind[0][0], 16) != nullptr) {
        return false;
    }
    part.cage.positions = std::move(*positions);
    for (size_t i = 0; i < deltas.size(); ++i) {
        part.morphs.targets[i].deltas = std::move(deltas[i]);
    }
    const glm::dmat3 normals = glm::transpose(glm::inverse(glm::dmat3(place)));
    for (glm::vec3& normal : part.cage.cornerNormals) {
        const glm::dvec3 placed = normals * glm::dvec3(normal);
        normal = normal == glm::vec3(0.0f) ? normal : glm::vec3(glm::normalize(placed)); // zero: as the face
    }
    for (glm::vec4& tangent : part.cage.cornerTangents) {
        const glm::dvec3 placed = glm::dmat3(place) * glm::dvec3(tangent);
        const bool none = glm::vec3(tangent) == glm::vec3(0.0f);
        tangent = none ? tangent : glm::vec4(glm::normalize(placed), mirrored ? -tangent.w : tangent.w);
    }
    if (mirrored) {
        reverseFaces(part.cage);
    }
    mesh.skin.inverseBinds[0] = bind;
    return true;
}

} // namespace supple::cage
