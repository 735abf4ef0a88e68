#include "skinning/pose.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace supple::skinning {
namespace {

using cage::Channel;
using cage::ChannelPath;
using cage::Interpolation;

/// A node's transform while it is put together; rotation as x, y, z, w, as clips store it.
struct Transform {
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};
    glm::dvec3 scale{1.0};
};

Transform restTransform(const cage::Node& node) {
    return {glm::dvec3(node.translation),
            glm::dvec4(node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w), glm::dvec3(node.scale)};
}

/// Translation * rotation * scale. The rotation need not be of unit length; a zero one (a spline may pass through it)
/// counts as none.
glm::mat4 compose(const Transform& t) {
    const double squared = glm::dot(t.rotation, t.rotation);
    const double s = squared > 0.0 ? 2.0 / squared : 0.0;
    const auto [x, y, z, w] = std::array{t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w};
    const glm::dvec3 columns[3] = {
        {1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)},
        {s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)},
        {s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)},
    };
    return glm::mat4(glm::vec4(glm::vec3(columns[0] * t.scale.x), 0.0f),
                     glm::vec4(glm::vec3(columns[1] * t.scale.y), 0.0f),
                     glm::vec4(glm::vec3(columns[2] * t.scale.z), 0.0f), glm::vec4(glm::vec3(t.translation), 1.0f));
}

glm::mat4 restLocal(const cage::Node& node) {
    return node.hasMatrix ? node.matrix : compose(restTransform(node));
}

template <int N>
using Vector = glm::vec<N, double, glm::defaultp>;

template <int N>
Vector<N> element(const Channel& channel, size_t index) {
    Vector<N> v;
    for (int k = 0; k < N; ++k) {
        v[k] = static_cast<double>(channel.values[N * index + static_cast<size_t>(k)]);
    }
    return v;
}

Vector<3> mix(const Vector<3>& a, const Vector<3>& b, double t) {
    return a + (b - a) * t;
}

/// Spherical, along the shorter way; straight where the arc is too short to divide by its sine.
Vector<4> mix(const Vector<4>& a, const Vector<4>& b, double t) {
    const double d = glm::dot(a, b);
    const double sign = d < 0.0 ? -1.0 : 1.0;
    const double cosine = std::min(std::abs(d), 1.0);
    const double angle = std::acos(cosine);
    const double sine = std::sin(angle);
    if (sine < 1e-6) {
        return a * (1.0 - t) + b * (sign * t);
    }
    return a * (std::sin((1.0 - t) * angle) / sine) + b * (sign * std::sin(t * angle) / sine);
}

template <int N>
Vector<N> sample(const Channel& channel, double time) {
    const auto& times = channel.times;
    const bool cubic = channel.interpolation == Interpolation::cubicSpline;
    const auto key = [&](size_t k) { return element<N>(channel, cubic ? 3 * k + 1 : k); };
    // The first key later than `time`; a key's own time gives its value as it is.
    const auto later = std::upper_bound(times.begin(), times.end(), time,
                                        [](double t, float k) { return t < static_cast<double>(k); });
    if (later == times.begin()) {
        return key(0);
    }
    const size_t k = static_cast<size_t>(later - times.begin()) - 1;
    if (later == times.end() || channel.interpolation == Interpolation::step || static_cast<double>(times[k]) == time) {
        return key(k);
    }
    const double span = static_cast<double>(times[k + 1]) - static_cast<double>(times[k]);
    const double t = (time - static_cast<double>(times[k])) / span;
    if (!cubic) {
        return mix(key(k), key(k + 1), t);
    }
    const Vector<N> leaving = element<N>(channel, 3 * k + 2);
    const Vector<N> arriving = element<N>(channel, 3 * (k + 1));
    const double t2 = t * t;
    const double t3 = t2 * t;
    return key(k) * (2.0 * t3 - 3.0 * t2 + 1.0) + leaving * (span * (t3 - 2.0 * t2 + t)) +
           key(k + 1) * (3.0 * t2 - 2.0 * t3) + arriving * (span * (t3 - t2));
}

} // namespace

Affine toAffine(const glm::mat4& matrix) {
    Affine affine;
    for (int r = 0; r < 3; ++r) {
        affine.rows[r] = glm::vec4(matrix[0][r], matrix[1][r], matrix[2][r], matrix[3][r]);
    }
    return affine;
}

void restPose(const cage::Skeleton& skeleton, std::span<glm::mat4> locals) {
    assert(locals.size() == skeleton.nodes.size());
    for (size_t i = 0; i < locals.size(); ++i) {
        locals[i] = restLocal(skeleton.nodes[i]);
    }
}

void sampleClip(const cage::Skeleton& skeleton, const cage::Clip& clip, double time, std::span<glm::mat4> locals) {
    assert(locals.size() == skeleton.nodes.size());
    std::vector<Transform> transforms;
    transforms.reserve(skeleton.nodes.size());
    for (const cage::Node& node : skeleton.nodes) {
        transforms.push_back(restTransform(node));
    }
    std::vector<bool> animated(skeleton.nodes.size(), false);
    for (const Channel& channel : clip.channels) {
        Transform& transform = transforms[channel.node];
        animated[channel.node] = true;
        switch (channel.path) {
        case ChannelPath::translation:
            transform.translation = sample<3>(channel, time);
            break;
        case ChannelPath::rotation:
            transform.rotation = sample<4>(channel, time);
            break;
        case ChannelPath::scale:
            transform.scale = sample<3>(channel, time);
            break;
        case ChannelPath::weights:
            break; // not a transform
        }
    }
    for (size_t i = 0; i < locals.size(); ++i) {
        locals[i] = animated[i] ? compose(transforms[i]) : restLocal(skeleton.nodes[i]);
    }
}

void globalTransforms(const cage::Skeleton& skeleton, std::span<const glm::mat4> locals, std::span<glm::mat4> globals) {
    assert(locals.size() == skeleton.nodes.size() && globals.size() == skeleton.nodes.size());
    for (const uint32_t i : skeleton.parentsFirst) {
        const uint32_t parent = skeleton.nodes[i].parent;
        globals[i] = parent == cage::kNone ? locals[i] : globals[parent] * locals[i];
    }
}

void jointPalette(const cage::Skin& skin, std::span<const glm::mat4> globals, const glm::mat4& transform,
                  std::span<Affine> palette) {
    assert(palette.size() == skin.joints.size());
    for (size_t j = 0; j < palette.size(); ++j) {
        palette[j] = toAffine(transform * globals[skin.joints[j]] * skin.inverseBinds[j]);
    }
}

std::vector<glm::dvec3> deformOnCpu(const cage::Cage& cage, const cage::SkinWeights& weights,
                                    std::span<const Affine> palette) {
    std::vector<glm::dvec3> deformed(cage.vertexCount(), glm::dvec3(0.0));
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        const glm::dvec4 position(glm::dvec3(cage.positions[v]), 1.0);
        for (uint32_t i = weights.starts[v]; i < weights.starts[v + 1]; ++i) {
            const Affine& affine = palette[weights.influences[i].joint];
            const glm::dvec3 moved(glm::dot(glm::dvec4(affine.rows[0]), position),
                                   glm::dot(glm::dvec4(affine.rows[1]), position),
                                   glm::dot(glm::dvec4(affine.rows[2]), position));
            deformed[v] += moved * static_cast<double>(weights.influences[i].weight);
        }
    }
    return deformed;
}

} // namespace supple::skinning
