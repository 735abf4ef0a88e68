// Groups that play their clips on the device, against groups that are posed by calls at the same times.
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/shared_assets.h"
#include "tests/support/wrapped_vulkan.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace supple::test {
namespace {

const std::string kPip = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";
constexpr SuppleMapping kMappings[] = {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE};

// What the device's floats may be off by: of the extent of the cage for where things are, of 1 for linear parts,
// rotations and morph weights.
constexpr double kBound = 2e-5;

using PlaybackOnGpu = CrowdContexts;

/// What an instance plays, with the masks written out.
struct Played {
    std::vector<SupplePlaybackLayer> layers;
    uint32_t rootMotion = 0;
    uint32_t flags = 0;
    uint32_t rootJoint = 0;
};

SupplePlaybackLayer playing(uint32_t clip, double offset = 0.0, float speed = 1.0f, bool loop = true) {
    SupplePlaybackLayer layer{};
    layer.clip = clip;
    layer.flags = loop ? SUPPLE_LAYER_LOOP : 0;
    layer.weight = 1.0f;
    layer.speed = speed;
    layer.offset = offset;
    return layer;
}

struct Mask {
    std::vector<float> joints, morphs;
};

/// The layer at a time, as the header defines it.
SuppleClipLayer layerAt(const SupplePlaybackLayer& layer, double time, const std::vector<Mask>& masks) {
    SuppleClipLayer result{};
    result.clip = layer.clip;
    result.flags = layer.flags;
    result.mode = layer.mode;
    result.time = layer.offset + static_cast<double>(layer.speed) * (time - layer.startTime);
    result.previousTime = layer.offset;
    result.referenceTime = layer.referenceTime;
    result.weight = layer.weight;
    if (layer.fadeDuration > 0.0f) {
        const double faded = std::clamp((time - layer.fadeStart) / static_cast<double>(layer.fadeDuration), 0.0, 1.0);
        result.weight = static_cast<float>(static_cast<double>(layer.weight) +
                                           faded * (static_cast<double>(layer.fadeWeight) - layer.weight));
    }
    if (layer.mask != 0) {
        const Mask& mask = masks[layer.mask - 1];
        result.jointMask = mask.joints.empty() ? nullptr : mask.joints.data();
        result.jointMaskCount = static_cast<uint32_t>(mask.joints.size());
        result.morphMask = mask.morphs.empty() ? nullptr : mask.morphs.data();
        result.morphMaskCount = static_cast<uint32_t>(mask.morphs.size());
    }
    return result;
}

/// The largest differences between two poses.
struct Difference {
    double matrices = 0.0;  ///< of linear parts
    double places = 0.0;    ///< of translations, of the extent
    double rotations = 0.0; ///< dual quaternions: of unit quaternions, whatever their sign
    double weights = 0.0;
    double cages = 0.0; ///< of deformed vertices, of the extent

    [[nodiscard]] double largest() const { return std::max({matrices, places, rotations, weights, cages}); }
    void add(const Difference& other) {
        matrices = std::max(matrices, other.matrices);
        places = std::max(places, other.places);
        rotations = std::max(rotations, other.rotations);
        weights = std::max(weights, other.weights);
        cages = std::max(cages, other.cages);
    }
    void print(const std::string& what) const {
        std::printf("%s: off by at most %.2g in linear parts, %.2g of the extent in translations, %.2g in rotations, "
                    "%.2g in morph weights; cages %.2g of the extent\n",
                    what.c_str(), matrices, places, rotations, weights, cages);
    }
};

std::vector<float> floatsOf(const std::vector<std::byte>& bytes) {
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
    return values;
}

/// Two full groups of one asset: one plays, one is told the same.
class Duet {
public:
    Duet(CrowdContext& context, SuppleGroupDesc desc)
        : context_(context), desc_(desc), told_(context, desc), plays_(context, [&] {
              desc.poseSource = SUPPLE_POSES_PLAYBACK;
              return desc;
          }()) {
        info_.structSize = sizeof(info_);
        EXPECT_EQ(suppleGetAssetInfo(context.handle(), desc.asset, &info_), SUPPLE_OK);
        for (int axis = 0; axis < 3; ++axis) {
            extent_ = std::max(extent_, static_cast<double>(info_.boundsMax[axis] - info_.boundsMin[axis]));
        }
        for (uint32_t i = 0; valid() && i < desc.capacity; ++i) {
            toldOnes.push_back(told_.spawn());
            players.push_back(plays_.spawn());
            played_.emplace_back();
        }
    }

    [[nodiscard]] bool valid() const { return told_.valid() && plays_.valid(); }
    [[nodiscard]] const SuppleAssetInfo& info() const { return info_; }
    [[nodiscard]] double extent() const { return extent_; }
    [[nodiscard]] Crowd& told() { return told_; }
    [[nodiscard]] Crowd& plays() { return plays_; }
    [[nodiscard]] double duration(uint32_t clip) const {
        SuppleClipInfo info{};
        info.structSize = sizeof(info);
        EXPECT_EQ(suppleGetClipInfo(context_.handle(), desc_.asset, clip, &info), SUPPLE_OK);
        return info.duration;
    }

    void setMask(uint32_t number, const Mask& mask) {
        masks_.resize(std::max<size_t>(masks_.size(), number));
        masks_[number - 1] = mask;
        SuppleMaskDesc desc{};
        desc.structSize = sizeof(desc);
        desc.mask = number;
        desc.jointMask = mask.joints.empty() ? nullptr : mask.joints.data();
        desc.jointMaskCount = static_cast<uint32_t>(mask.joints.size());
        desc.morphMask = mask.morphs.empty() ? nullptr : mask.morphs.data();
        desc.morphMaskCount = static_cast<uint32_t>(mask.morphs.size());
        EXPECT_EQ(suppleSetMask(context_.handle(), plays_.group(), &desc), SUPPLE_OK);
    }
    void set(uint32_t slot, const Played& played) {
        played_[slot] = played;
        SupplePlaybackDesc desc{};
        desc.structSize = sizeof(desc);
        desc.flags = played.flags;
        desc.layers = played.layers.data();
        desc.layerCount = static_cast<uint32_t>(played.layers.size());
        desc.rootMotion = played.rootMotion;
        desc.rootJoint = played.rootJoint;
        EXPECT_EQ(suppleSetPlayback(context_.handle(), players[slot], &desc), SUPPLE_OK);
    }
    void setTransform(uint32_t slot, const glm::mat4& transform) {
        for (const SuppleInstance& instance : {toldOnes[slot], players[slot]}) {
            EXPECT_EQ(suppleSetTransform(context_.handle(), instance, glm::value_ptr(transform)), SUPPLE_OK);
        }
    }

    /// A frame of both at a time.
    void run(double time) {
        for (uint32_t slot = 0; slot < played_.size(); ++slot) {
            const Played& played = played_[slot];
            std::vector<SuppleClipLayer> layers;
            for (const SupplePlaybackLayer& layer : played.layers) {
                layers.push_back(layerAt(layer, time, masks_));
            }
            SupplePoseDesc pose{};
            pose.structSize = sizeof(pose);
            pose.flags = played.flags & SUPPLE_PLAYBACK_ROOT_JOINT;
            pose.layers = layers.data();
            pose.layerCount = static_cast<uint32_t>(layers.size());
            pose.rootMotion = played.rootMotion;
            pose.rootJoint = played.rootJoint;
            EXPECT_EQ(suppleSetPose(context_.handle(), toldOnes[slot], &pose), SUPPLE_OK);
        }
        EXPECT_EQ(suppleSetTime(context_.handle(), plays_.group(), time), SUPPLE_OK);
        const SuppleGroup groups[] = {told_.group(), plays_.group()};
        context_.run(groups);
    }

    /// What the last frame left; of the slots that are listed.
    [[nodiscard]] Difference difference() {
        Difference worst;
        const SuppleGroupOutput output = plays_.output();
        const std::vector<float> told = floatsOf(told_.read(told_.output().poses)),
                                 played = floatsOf(plays_.read(output.poses));
        EXPECT_EQ(told.size(), played.size());
        const size_t stride = output.poses.stride / sizeof(float);
        const bool linear = desc_.skinning == SUPPLE_SKINNING_LINEAR;
        const size_t joints = info_.jointCount;
        for (uint32_t slot = 0; slot < desc_.capacity; ++slot) {
            const float *a = told.data() + slot * stride, *b = played.data() + slot * stride;
            const auto rows = [&](size_t at) {
                for (size_t i = 0; i < 12; ++i) {
                    const double off = std::abs(static_cast<double>(a[at + i]) - static_cast<double>(b[at + i]));
                    double& to = i % 4 == 3 ? worst.places : worst.matrices;
                    to = std::max(to, i % 4 == 3 ? off / extent_ : off);
                    EXPECT_TRUE(std::isfinite(off));
                }
            };
            size_t at = 0;
            if (!linear) {
                rows(0);
                at = 12;
            }
            for (size_t j = 0; j < joints; ++j) {
                rows(at);
                at += 12;
                if (!linear) {
                    glm::dvec4 p, q;
                    for (int i = 0; i < 4; ++i) {
                        p[i] = static_cast<double>(a[at + static_cast<size_t>(i)]);
                        q[i] = static_cast<double>(b[at + static_cast<size_t>(i)]);
                    }
                    worst.rotations = std::max(worst.rotations, std::min(glm::length(p - q), glm::length(p + q)));
                    at += 4;
                }
            }
            for (uint32_t t = 0; t < info_.morphTargetCount && at + t < stride; ++t) {
                worst.weights =
                    std::max(worst.weights, std::abs(static_cast<double>(a[at + t]) - static_cast<double>(b[at + t])));
            }
        }
        const std::vector<float> toldCages = floatsOf(told_.read(told_.output().deformedCage)),
                                 playedCages = floatsOf(plays_.read(output.deformedCage));
        for (uint32_t slot = 0; slot < desc_.capacity; ++slot) {
            const size_t first = 4 * size_t{slot} * output.cageVerticesPerInstance;
            for (size_t i = first; i < first + 4 * size_t{output.cageVertexCount}; ++i) {
                const double off = std::abs(static_cast<double>(toldCages[i]) - static_cast<double>(playedCages[i]));
                worst.cages = std::max(worst.cages, off / extent_);
            }
        }
        return worst;
    }

    std::vector<SuppleInstance> toldOnes, players;

private:
    CrowdContext& context_;
    SuppleGroupDesc desc_;
    Crowd told_, plays_;
    SuppleAssetInfo info_{};
    double extent_ = 0.0;
    std::vector<Played> played_;
    std::vector<Mask> masks_;
};

SuppleGroupDesc cageGroup(SuppleAsset asset, uint32_t capacity, SuppleSkinning skinning = SUPPLE_SKINNING_LINEAR) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = SUPPLE_SCHEME_CAGE;
    desc.skinning = skinning;
    return desc;
}

/// Random keys: `count` of them, at uneven times up to `duration`.
cage::Channel noisyChannel(Noise& noise, uint32_t node, cage::ChannelPath path, cage::Interpolation interpolation,
                           size_t count, float duration, size_t targets) {
    std::vector<float> times, values;
    for (size_t k = 0; k < count; ++k) {
        const float even = static_cast<float>(k) / static_cast<float>(std::max<size_t>(count - 1, 1));
        times.push_back(duration *
                        (k == 0 || k + 1 == count ? even : even + 0.3f * noise() / static_cast<float>(count)));
        const bool cubic = interpolation == cage::Interpolation::cubicSpline;
        for (size_t part = 0; part < (cubic ? 3u : 1u); ++part) {
            const bool tangent = cubic && part != 1;
            const float size = tangent ? 0.7f : 1.0f;
            if (path == cage::ChannelPath::rotation) {
                glm::vec4 q(0.8f * noise.vector(), 0.6f + 0.4f * noise());
                q = tangent ? 0.3f * q : glm::normalize(q);
                values.insert(values.end(), {q.x, q.y, q.z, q.w});
            } else if (path == cage::ChannelPath::weights) {
                for (size_t t = 0; t < targets; ++t) {
                    values.push_back(size * noise());
                }
            } else {
                const bool scale = path == cage::ChannelPath::scale;
                const glm::vec3 v = (scale && !tangent ? glm::vec3(1.0f) : glm::vec3(0.0f)) +
                                    (scale ? 0.3f : 2.0f) * size * noise.vector();
                values.insert(values.end(), {v.x, v.y, v.z});
            }
        }
    }
    return channel(node, path, std::move(times), std::move(values), interpolation);
}

/// A tube with clips of every kind of keys: linear, cubic, step, mixed with nodes left out; under a fixed matrix.
cage::Character noisyTube(uint32_t joints, uint32_t targets) {
    cage::Character tube = riggedTube({.segments = 12, .sides = 6, .joints = joints, .morphTargets = targets});
    cage::Node& rig = tube.skeleton.nodes[0];
    rig.hasMatrix = true;
    rig.matrix = glm::rotate(glm::translate(glm::mat4(1.0f), {0.3f, -0.2f, 0.1f}), 0.4f, {0.6f, 0.0f, 0.8f});
    for (size_t t = 0; t < targets; ++t) {
        tube.morphs.weights[t] = 0.1f * static_cast<float>(t);
    }
    Noise noise(99);
    constexpr cage::Interpolation kKinds[] = {cage::Interpolation::linear, cage::Interpolation::cubicSpline,
                                              cage::Interpolation::step};
    for (uint32_t kind = 0; kind < 4; ++kind) {
        std::vector<cage::Channel> channels;
        const float duration = 1.0f + 0.37f * static_cast<float>(kind);
        for (uint32_t j = 0; j < joints; ++j) {
            for (const cage::ChannelPath path :
                 {cage::ChannelPath::translation, cage::ChannelPath::rotation, cage::ChannelPath::scale}) {
                if (kind == 3 && noise() > 0.2f) {
                    continue;
                }
                const cage::Interpolation own =
                    kind == 3 ? kKinds[(j + static_cast<uint32_t>(path)) % 3] : kKinds[kind];
                // A spline needs two.
                const size_t least = own == cage::Interpolation::cubicSpline ? 2 : 1;
                const size_t keys = least + static_cast<size_t>(4.0f * (noise() + 1.0f));
                channels.push_back(noisyChannel(noise, j + 1, path, own, keys, duration, targets));
            }
        }
        if (targets > 0) {
            channels.push_back(
                noisyChannel(noise, tube.meshNode, cage::ChannelPath::weights, kKinds[kind % 3], 5, duration, targets));
        }
        tube.clips.push_back(clipOf(std::move(channels)));
        tube.clips.back().name = "clip " + std::to_string(kind);
    }
    return tube;
}

TEST_F(PlaybackOnGpu, PosesTheDemoCharacterAsCallsDo) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        for (const SuppleSkinning skinning : {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION}) {
            CrowdContext& own = context(mapping);
            ASSERT_TRUE(own.valid());
            constexpr uint32_t kInstances = 12;
            Duet duet(own, cageGroup(own.asset(kPip), kInstances, skinning));
            ASSERT_TRUE(duet.valid());
            ASSERT_EQ(duet.info().clipCount, 3u);
            for (uint32_t i = 0; i < kInstances; ++i) {
                const uint32_t clip = i % 3;
                const float speeds[] = {1.0f, -0.7f, 2.5f, 0.0f};
                duet.set(i, {{playing(clip, 0.31 * i, speeds[i / 3], i % 2 == 0)}});
                duet.setTransform(i, glm::rotate(glm::translate(glm::mat4(1.0f), {0.2f * static_cast<float>(i), 0, 0}),
                                                 0.5f * static_cast<float>(i), {0.0f, 1.0f, 0.0f}));
            }
            const double end = duet.duration(0);
            Difference worst;
            for (const double time : {0.0, 0.123, 0.5 * end, end, 1.5 * end, 2.0 * end, 7.77, -0.4, -end, 100.3}) {
                duet.run(time);
                worst.add(duet.difference());
            }
            worst.print(mappingName(mapping) +
                        (skinning == SUPPLE_SKINNING_LINEAR ? ", linear" : ", dual quaternions"));
            EXPECT_LT(worst.largest(), kBound);
        }
    }
}

TEST_F(PlaybackOnGpu, PlaysEveryKindOfKeys) {
    const ValidationGuard guard;
    for (const uint32_t targets : {0u, 5u}) {
        for (const SuppleMapping mapping : kMappings) {
            for (const SuppleSkinning skinning : {SUPPLE_SKINNING_LINEAR, SUPPLE_SKINNING_DUAL_QUATERNION}) {
                CrowdContext& own = context(mapping);
                ASSERT_TRUE(own.valid());
                const cage::Character tube = noisyTube(5, targets);
                constexpr uint32_t kInstances = 8;
                Duet duet(own, cageGroup(own.createAsset(tube), kInstances, skinning));
                for (const LogLine& line : own.takeLines()) printf("%s\n", line.text.c_str());
                ASSERT_TRUE(duet.valid());
                ASSERT_EQ(duet.info().clipCount, 4u);
                for (uint32_t i = 0; i < kInstances; ++i) {
                    duet.set(i, {{playing(i % 4, 0.0, 1.0f, i < 4)}});
                }
                std::vector<double> times;
                for (const cage::Clip& clip : tube.clips) {
                    for (const cage::Channel& own : clip.channels) {
                        times.push_back(static_cast<double>(own.times[own.times.size() / 2])); // of a key, to the bit
                    }
                    times.push_back(clip.duration);
                }
                Noise noise(5);
                for (int i = 0; i < 30; ++i) {
                    times.push_back(4.0 * static_cast<double>(noise()));
                }
                Difference worst;
                for (const double time : times) {
                    duet.run(time);
                    worst.add(duet.difference());
                }
                worst.print(mappingName(mapping) + ", " + std::to_string(targets) + " targets" +
                            (skinning == SUPPLE_SKINNING_LINEAR ? "" : ", dual quaternions"));
                EXPECT_LT(worst.largest(), kBound);
            }
        }
    }
}

} // namespace
} // namespace supple::test
