#include "skinning/pose.h"

#include "skinning/rotation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace supple::skinning {
namespace {

using cage::Channel;
using cage::ChannelPath;
using cage::Interpolation;

glm::dmat4 compose(const Transform& t) {
    const double x = t.rotation.x, y = t.rotation.y, z = t.rotation.z, w = t.rotation.w;
    const double squared = x * x + y * y + z * z + w * w;
    const double s = squared > 0.0 ? 2.0 / squared : 0.0;
    const glm::dvec3 columns[3] = {
        {1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)},
        {s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)},
        {s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)},
    };
    return {glm::dvec4(columns[0] * t.scale.x, 0.0), glm::dvec4(columns[1] * t.scale.y, 0.0),
            glm::dvec4(columns[2] * t.scale.z, 0.0), glm::dvec4(t.translation, 1.0)};
}

/// Where a time falls among a channel's keys: at key `key`, or at fraction `t` of the `seconds` from it to the next
/// one.
struct KeySpan {
    size_t key = 0;
    double t = 0.0;
    double seconds = 0.0; ///< 0: the key's own value
};

KeySpan findKeys(const Channel& channel, double time) {
    const auto& times = channel.times;
    // The first key later than `time`; a key's own time gives its value as it is.
    const auto later = std::upper_bound(times.begin(), times.end(), time,
                                        [](double t, float k) { return t < static_cast<double>(k); });
    if (later == times.begin()) {
        return {};
    }
    const size_t k = static_cast<size_t>(later - times.begin()) - 1;
    const double begin = static_cast<double>(times[k]);
    if (later == times.end() || channel.interpolation == Interpolation::step || begin == time) {
        return {k, 0.0, 0.0};
    }
    const double seconds = static_cast<double>(times[k + 1]) - begin;
    return {k, (time - begin) / seconds, seconds};
}

glm::dvec3 mix(const glm::dvec3& a, const glm::dvec3& b, double t) {
    return a + (b - a) * t;
}
double mix(double a, double b, double t) {
    return a + (b - a) * t;
}
glm::dvec4 mix(const glm::dvec4& a, const glm::dvec4& b, double t) {
    const glm::dquat q = slerp(glm::dquat(a.w, a.x, a.y, a.z), glm::dquat(b.w, b.x, b.y, b.z), t);
    return {q.x, q.y, q.z, q.w};
}

/// The value between the keys. `read(k)` gives the k-th value as stored.
template <class Read>
auto interpolate(const Channel& channel, const KeySpan& span, Read&& read) {
    const bool cubic = channel.interpolation == Interpolation::cubicSpline;
    const auto key = [&](size_t k) { return read(cubic ? 3 * k + 1 : k); };
    if (span.seconds == 0.0) {
        return key(span.key);
    }
    if (!cubic) {
        return mix(key(span.key), key(span.key + 1), span.t);
    }
    const auto leaving = read(3 * span.key + 2);
    const auto arriving = read(3 * (span.key + 1));
    const double t = span.t, t2 = t * t, t3 = t2 * t;
    return key(span.key) * (2.0 * t3 - 3.0 * t2 + 1.0) + leaving * (span.seconds * (t3 - 2.0 * t2 + t)) +
           key(span.key + 1) * (3.0 * t2 - 2.0 * t3) + arriving * (span.seconds * (t3 - t2));
}

glm::dvec3 vectorAt(const Channel& channel, double time) {
    return interpolate(channel, findKeys(channel, time), [&](size_t k) {
        const float* v = &channel.values[3 * k];
        return glm::dvec3(v[0], v[1], v[2]);
    });
}

glm::dquat rotationAt(const Channel& channel, double time) {
    const glm::dvec4 q = interpolate(channel, findKeys(channel, time), [&](size_t k) {
        const float* v = &channel.values[4 * k];
        return glm::dvec4(v[0], v[1], v[2], v[3]);
    });
    return {q.w, q.x, q.y, q.z};
}

void sampleTransform(const Channel& channel, double time, Transform& transform) {
    switch (channel.path) {
    case ChannelPath::translation:
        transform.translation = vectorAt(channel, time);
        break;
    case ChannelPath::rotation:
        transform.rotation = rotationAt(channel, time);
        break;
    case ChannelPath::scale:
        transform.scale = vectorAt(channel, time);
        break;
    case ChannelPath::weights:
        break; // not a transform
    }
}

void sampleWeights(const Channel& channel, double time, std::span<double> weights) {
    const KeySpan span = findKeys(channel, time);
    const size_t width = channel.width();
    for (size_t target = 0; target < width; ++target) {
        weights[channel.firstTarget + target] = interpolate(
            channel, span, [&](size_t k) { return static_cast<double>(channel.values[width * k + target]); });
    }
}

} // namespace

Transform restTransform(const cage::Node& node) {
    return {glm::dvec3(node.translation), glm::dquat(node.rotation), glm::dvec3(node.scale)};
}

double sampleSharpness(const cage::SharpnessCurve& curve, double time) {
    double sharpness = 0.0;
    sampleWeights(curve.keys, time, {&sharpness, 1});
    return sharpness;
}

namespace {

void restLocals(const cage::Skeleton& skeleton, std::vector<Transform>& locals) {
    locals.resize(skeleton.nodes.size());
    std::transform(skeleton.nodes.begin(), skeleton.nodes.end(), locals.begin(), restTransform);
}

} // namespace

Affine toAffine(const glm::mat4& matrix) {
    Affine affine;
    for (int r = 0; r < 3; ++r) {
        affine.rows[r] = glm::vec4(matrix[0][r], matrix[1][r], matrix[2][r], matrix[3][r]);
    }
    return affine;
}

void restPose(const cage::Character& character, Pose& pose) {
    restLocals(character.skeleton, pose.locals);
    pose.morphWeights.assign(character.morphs.weights.begin(), character.morphs.weights.end());
}

void sampleClip(const cage::Character& character, const cage::Clip& clip, double time, Pose& pose) {
    restPose(character, pose);
    for (const Channel& channel : clip.channels) {
        if (channel.path == ChannelPath::weights) {
            sampleWeights(channel, time, pose.morphWeights);
        } else {
            sampleTransform(channel, time, pose.locals[channel.node]);
        }
    }
}

Transform sampleNode(const cage::Skeleton& skeleton, const cage::Clip& clip, double time, uint32_t node) {
    Transform transform = restTransform(skeleton.nodes[node]);
    for (const Channel& channel : clip.channels) {
        if (channel.node == node) {
            sampleTransform(channel, time, transform);
        }
    }
    return transform;
}

glm::dmat4 localMatrix(const cage::Node& node, const Transform& transform) {
    return node.hasMatrix ? glm::dmat4(node.matrix) : compose(transform);
}

void localMatrices(const cage::Skeleton& skeleton, const Pose& pose, std::span<glm::mat4> locals) {
    assert(locals.size() == skeleton.nodes.size() && pose.locals.size() == locals.size());
    for (size_t i = 0; i < locals.size(); ++i) {
        locals[i] = glm::mat4(localMatrix(skeleton.nodes[i], pose.locals[i]));
    }
}

void sampleClip(const cage::Skeleton& skeleton, const cage::Clip& clip, double time, std::span<glm::mat4> locals) {
    Pose pose;
    restLocals(skeleton, pose.locals);
    for (const Channel& channel : clip.channels) {
        sampleTransform(channel, time, pose.locals[channel.node]);
    }
    localMatrices(skeleton, pose, locals);
}

void restPose(const cage::Skeleton& skeleton, std::span<glm::mat4> locals) {
    Pose pose;
    restLocals(skeleton, pose.locals);
    localMatrices(skeleton, pose, locals);
}

void globalTransforms(const cage::Skeleton& skeleton, std::span<const glm::mat4> locals, std::span<glm::mat4> globals) {
    assert(locals.size() == globals.size());
    for (const uint32_t node : skeleton.parentsFirst) {
        const uint32_t parent = skeleton.nodes[node].parent;
        globals[node] = parent == cage::kNone ? locals[node] : globals[parent] * locals[node];
    }
}

void jointPalette(const cage::Skin& skin, std::span<const glm::mat4> globals, const glm::mat4& transform,
                  std::span<Affine> palette) {
    assert(palette.size() == skin.joints.size());
    for (size_t j = 0; j < palette.size(); ++j) {
        palette[j] = toAffine(transform * globals[skin.joints[j]] * skin.inverseBinds[j]);
    }
}

void posePalette(const cage::Character& character, const Pose& pose, std::span<glm::mat4> nodes,
                 std::span<Affine> palette) {
    localMatrices(character.skeleton, pose, nodes);
    globalTransforms(character.skeleton, nodes, nodes);
    jointPalette(character.skin, nodes, glm::mat4(1.0f), palette);
}

void jointRotations(std::span<const Affine> palette, std::span<glm::vec4> rotations) {
    assert(palette.size() == rotations.size());
    for (size_t j = 0; j < palette.size(); ++j) {
        glm::dmat3 matrix;
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                matrix[column][row] = static_cast<double>(palette[j].rows[row][column]);
            }
        }
        rotations[j] = floatsOf(nearestRotation(matrix));
    }
}

std::vector<glm::dvec3> morphOnCpu(const cage::Cage& cage, const cage::Morphs& morphs, std::span<const float> weights) {
    std::vector<glm::dvec3> positions(cage.positions.begin(), cage.positions.end());
    for (size_t t = 0; t < morphs.targets.size(); ++t) {
        const cage::MorphTarget& target = morphs.targets[t];
        for (size_t i = 0; i < target.vertices.size(); ++i) {
            positions[target.vertices[i]] += static_cast<double>(weights[t]) * glm::dvec3(target.deltas[i]);
        }
    }
    return positions;
}

std::vector<glm::dvec3> deformOnCpu(std::span<const glm::dvec3> positions, const cage::SkinWeights& weights,
                                    std::span<const Affine> palette) {
    std::vector<glm::dvec3> deformed(positions.size(), glm::dvec3(0.0));
    for (size_t v = 0; v < positions.size(); ++v) {
        const glm::dvec4 position(positions[v], 1.0);
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

std::vector<glm::dvec3> deformOnCpu(const cage::Cage& cage, const cage::SkinWeights& weights,
                                    std::span<const Affine> palette) {
    const std::vector<glm::dvec3> positions(cage.positions.begin(), cage.positions.end());
    return deformOnCpu(positions, weights, palette);
}

std::vector<glm::dvec3> deformOnCpu(const cage::Character& character, const Pose& pose) {
    std::vector<glm::mat4> nodes(character.skeleton.nodes.size());
    std::vector<Affine> palette(character.skin.joints.size());
    posePalette(character, pose, nodes, palette);
    const std::vector<float> weights(pose.morphWeights.begin(), pose.morphWeights.end());
    return deformOnCpu(morphOnCpu(character.cage, character.morphs, weights), character.weights, palette);
}

} // namespace supple::skinning
