#include "tests/support/centers_reference.h"

#include "tests/support/joint_factors.h"

#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

namespace supple::test {

namespace {

/// A place of the surface with all its weights.
struct Place {
    glm::dvec3 point{0.0};
    std::map<uint32_t, double> weights;
};

Place meanOf(std::span<const Place> places) {
    Place mean;
    for (const Place& place : places) {
        mean.point += place.point / static_cast<double>(places.size());
        for (const auto& [joint, weight] : place.weights) {
            mean.weights[joint] += weight / static_cast<double>(places.size());
        }
    }
    return mean;
}

struct Piece {
    double area = 0.0;
    Place middle;
};

void cut(const std::array<Place, 3>& corners, int cuts, std::vector<Piece>& pieces) {
    if (cuts == 0) {
        const glm::dvec3 a = corners[1].point - corners[0].point, b = corners[2].point - corners[0].point;
        pieces.push_back({0.5 * glm::length(glm::cross(a, b)), meanOf(corners)});
        return;
    }
    std::array<Place, 3> middles;
    for (size_t i = 0; i < 3; ++i) {
        middles[i] = meanOf(std::array{corners[i], corners[(i + 1) % 3]});
    }
    for (size_t i = 0; i < 3; ++i) {
        cut({corners[i], middles[i], middles[(i + 2) % 3]}, cuts - 1, pieces);
    }
    cut(middles, cuts - 1, pieces);
}

} // namespace

std::vector<std::optional<glm::dvec3>> centersOneByOne(const cage::Character& character, int cuts) {
    const cage::Cage& cage = character.cage;
    std::vector<Place> vertices(cage.vertexCount());
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        vertices[v].point = glm::dvec3(cage.positions[v]);
        for (uint32_t i = character.weights.starts[v]; i < character.weights.starts[v + 1]; ++i) {
            const cage::Influence& influence = character.weights.influences[i];
            if (influence.weight > 0.0f) {
                vertices[v].weights[influence.joint] += static_cast<double>(influence.weight);
            }
        }
    }
    std::vector<Piece> pieces;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        const uint32_t first = cage.faceStarts[f];
        for (uint32_t c = first + 2; c < cage.faceStarts[f + 1]; ++c) {
            cut({vertices[cage.faceVertices[first]], vertices[cage.faceVertices[c - 1]],
                 vertices[cage.faceVertices[c]]},
                cuts, pieces);
        }
    }
    std::vector<std::optional<glm::dvec3>> centers(vertices.size());
    for (size_t v = 0; v < vertices.size(); ++v) {
        const auto& own = vertices[v].weights;
        double total = 0.0;
        glm::dvec3 sum(0.0);
        for (const Piece& piece : pieces) {
            double likeness = 0.0;
            for (auto j = own.begin(); j != own.end(); ++j) {
                const auto vj = piece.middle.weights.find(j->first);
                for (auto k = std::next(j); k != own.end() && vj != piece.middle.weights.end(); ++k) {
                    if (const auto vk = piece.middle.weights.find(k->first); vk != piece.middle.weights.end()) {
                        const double x = j->second * vk->second, y = k->second * vj->second;
                        likeness += 2.0 * x * y * std::exp(-std::pow((x - y) / 0.1, 2.0));
                    }
                }
            }
            total += likeness * piece.area;
            sum += likeness * piece.area * piece.middle.point;
        }
        if (total > 0.0) {
            centers[v] = sum / total;
        }
    }
    return centers;
}

std::vector<std::optional<glm::dvec3>> centersOf(const skinning::Centers& centers) {
    std::vector<std::optional<glm::dvec3>> result;
    for (const glm::vec4& point : centers.points) {
        result.push_back(point.w != 0.0f ? std::optional(glm::dvec3(point)) : std::nullopt);
    }
    return result;
}

std::vector<glm::dvec3> skinAboutCenters(std::span<const glm::dvec3> positions,
                                         std::span<const std::optional<glm::dvec3>> centers,
                                         const cage::SkinWeights& weights, std::span<const skinning::Affine> palette,
                                         const glm::dmat4& transform) {
    const std::vector<JointFactors> joints = factorsOf(palette);
    std::vector<glm::dvec3> skinned;
    for (size_t v = 0; v < positions.size(); ++v) {
        const glm::dvec3 center = centers[v].value_or(positions[v]);
        const VertexInfluences influences(weights, v);
        const glm::dquat side = glm::quat_cast(joints[influences.heaviest.joint].rotation);
        glm::dquat blend{0.0, 0.0, 0.0, 0.0};
        glm::dmat3 stretch(0.0);
        glm::dvec3 moved(0.0);
        for (const cage::Influence& i : influences.all) {
            const JointFactors& joint = joints[i.joint];
            const double weight = static_cast<double>(i.weight);
            const glm::dquat rotation = glm::quat_cast(joint.rotation);
            blend = blend + rotation * (glm::dot(rotation, side) < 0.0 ? -weight : weight);
            stretch += weight * joint.stretch;
            moved += weight * (joint.rotation * (joint.stretch * center) + joint.translation);
        }
        const glm::dvec3 result = moved + glm::mat3_cast(glm::normalize(blend)) * (stretch * (positions[v] - center));
        skinned.emplace_back(transform * glm::dvec4(result, 1.0));
    }
    return skinned;
}

} // namespace supple::test
