// Groups that play their clips on the device, against groups that are posed by calls at the same times.
#include "runtime/api/entry.h"
#include "skinning/deform_twin.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/shared_assets.h"
#include "tests/support/skinnings.h"
#include "tests/support/wrapped_vulkan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

// What the device's floats may be off by: of the extent of the cage for where things are, of 1 for linear parts,
// rotations and morph weights.
constexpr double kBound = 2e-5;
// And what the CPU says of the joints of those that play, of the diagonal extent.
constexpr double kSocketBound = 1e-5;

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
    /// Between what the CPU says of joints (suppleGetJointTransform) and the device's palettes, of the diagonal extent:
    /// the corners of the cage's box in the bind pose, carried by every joint.
    double sockets = 0.0;

    /// Words of the device's palettes, morph weights and deformed cages that the CPU's arithmetic gives otherwise.
    uint64_t words = 0;

    [[nodiscard]] double largest() const { return std::max({matrices, places, rotations, weights, cages}); }
    [[nodiscard]] bool within() const { return largest() < kBound && sockets < kSocketBound && words == 0; }
    void add(const Difference& other) {
        matrices = std::max(matrices, other.matrices);
        places = std::max(places, other.places);
        rotations = std::max(rotations, other.rotations);
        weights = std::max(weights, other.weights);
        cages = std::max(cages, other.cages);
        sockets = std::max(sockets, other.sockets);
        words += other.words;
    }
    void print(const std::string& what) const {
        std::printf("%s: off by at most %.2g in linear parts, %.2g of the extent in translations, %.2g in rotations, "
                    "%.2g in morph weights; cages %.2g of the extent; sockets %.2g; %llu words differ\n",
                    what.c_str(), matrices, places, rotations, weights, cages, sockets,
                    static_cast<unsigned long long>(words));
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
        for (uint32_t j = 0; j < info_.jointCount; ++j) {
            SuppleJointInfo joint{};
            joint.structSize = sizeof(joint);
            EXPECT_EQ(suppleGetJointInfo(context.handle(), desc.asset, j, &joint), SUPPLE_OK);
            binds_.emplace_back(glm::make_mat4(joint.bindTransform));
        }
        for (int axis = 0; axis < 3; ++axis) {
            extent_ = std::max(extent_, static_cast<double>(info_.boundsMax[axis] - info_.boundsMin[axis]));
        }
        for (uint32_t i = 0; valid() && i < desc.capacity; ++i) {
            toldOnes.push_back(told_.spawn());
            players.push_back(plays_.spawn());
            played_.emplace_back();
            transforms_.emplace_back(1.0f);
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
    /// The farthest from the origin that travel has taken an instance.
    [[nodiscard]] double travelled() const { return travelled_; }
    void setTransform(uint32_t slot, const glm::mat4& transform) {
        transforms_[slot] = transform;
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
            if ((played.flags & SUPPLE_PLAYBACK_TRAVEL) != 0) {
                layers[0].weight = 1.0f;
                layers[0].jointMask = nullptr;
                layers[0].jointMaskCount = 0;
                pose.layerCount = 1;
                SuppleRootMotion motion{};
                motion.structSize = sizeof(motion);
                EXPECT_EQ(suppleGetRootMotion(context_.handle(), desc_.asset, &pose, &motion), SUPPLE_OK);
                const glm::mat4 placed = transforms_[slot] * glm::make_mat4(motion.transform);
                travelled_ = std::max(travelled_, static_cast<double>(glm::length(glm::vec3(placed[3]))));
                EXPECT_EQ(suppleSetTransform(context_.handle(), toldOnes[slot], glm::value_ptr(placed)), SUPPLE_OK);
            }
        }
        EXPECT_EQ(suppleSetTime(context_.handle(), plays_.group(), time), SUPPLE_OK);
        sockets_[0] = socketsOf(toldOnes);
        sockets_[1] = socketsOf(players);
        const SuppleGroup groups[] = {told_.group(), plays_.group()};
        context_.run(groups);
    }

    /// What the last frame left; of the slots that are listed.
    [[nodiscard]] Difference difference() {
        Difference worst;
        const host::GroupOutput output = plays_.output();
        const std::vector<float> told = floatsOf(told_.read(told_.output().info.poses)),
                                 played = floatsOf(plays_.read(output.info.poses));
        EXPECT_EQ(told.size(), played.size());
        const size_t stride = output.info.poses.stride / sizeof(float);
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
        worst.sockets = std::max(socketsOff(told, stride, sockets_[0]), socketsOff(played, stride, sockets_[1]));
        const std::vector<float> toldCages = floatsOf(told_.read(told_.output().info.deformedCage)),
                                 playedCages = floatsOf(plays_.read(output.info.deformedCage));
        for (uint32_t slot = 0; slot < desc_.capacity; ++slot) {
            const size_t first = 4 * size_t{slot} * output.info.cageVerticesPerInstance;
            for (size_t i = first; i < first + 4 * size_t{output.info.cageVertexCount}; ++i) {
                const double off = std::abs(static_cast<double>(toldCages[i]) - static_cast<double>(playedCages[i]));
                worst.cages = std::max(worst.cages, off / extent_);
            }
        }
        worst.words = wordsOff(played, playedCages);
        return worst;
    }

    std::vector<SuppleInstance> toldOnes, players;

private:
    /// How many words of poses and cages of those that play are others than the CPU's.
    [[nodiscard]] uint64_t wordsOff(const std::vector<float>& poses, const std::vector<float>& cages) const {
        runtime::Group& group = *context_.handle()->context->groups.find(plays_.group().id);
        const skinning::PoseLayout& layout = group.instances().poseLayout();
        const cage::Character& character = group.asset().character;
        const skinning::DeformTable table = deformTableOf(group);
        const size_t elements = layout.morphWeights + (layout.morphCount + 3) / 4;
        std::vector<glm::vec4> pose(layout.stride), cage(character.cage.vertexCount());
        uint64_t off = 0;
        const auto compare = [&](std::span<const glm::vec4> own, const float* device) {
            for (size_t i = 0; i < 4 * own.size(); ++i) {
                off += std::memcmp(&own[i / 4][static_cast<int>(i % 4)], device + i, sizeof(float)) != 0 ? 1 : 0;
            }
        };
        for (uint32_t slot = 0; slot < desc_.capacity; ++slot) {
            group.poses().playback()->writePose(slot, pose);
            compare(std::span(pose).first(elements), poses.data() + 4 * size_t{slot} * layout.stride);
            skinning::deformLikeTheDevice(table, layout, pose, cage);
            compare(cage, cages.data() + 4 * size_t{slot} * group.instances().cageStride());
        }
        return off;
    }
    /// What the CPU says of all joints of all instances.
    [[nodiscard]] std::vector<glm::dmat4> socketsOf(std::span<const SuppleInstance> instances) const {
        std::vector<glm::dmat4> result;
        for (const SuppleInstance& instance : instances) {
            for (uint32_t j = 0; j < info_.jointCount; ++j) {
                float transform[16];
                EXPECT_EQ(suppleGetJointTransform(context_.handle(), instance, j, transform), SUPPLE_OK);
                result.emplace_back(glm::make_mat4(transform));
            }
        }
        return result;
    }
    /// How far those are from palette * bindTransform.
    [[nodiscard]] double socketsOff(const std::vector<float>& poses, size_t stride,
                                    const std::vector<glm::dmat4>& sockets) const {
        const bool linear = desc_.skinning == SUPPLE_SKINNING_LINEAR;
        const glm::dvec3 low(glm::make_vec3(info_.boundsMin)), high(glm::make_vec3(info_.boundsMax));
        const auto matrix = [&](size_t at) {
            glm::dmat4 rows(1.0);
            for (int row = 0; row < 3; ++row) {
                rows[row] = glm::dvec4(glm::make_vec4(poses.data() + at + 4 * static_cast<size_t>(row)));
            }
            return glm::transpose(rows);
        };
        double worst = 0.0;
        for (size_t i = 0; i < sockets.size(); ++i) {
            const size_t slot = i / info_.jointCount, joint = i % info_.jointCount, first = slot * stride;
            const glm::dmat4 palette =
                linear ? matrix(first + 12 * joint) : matrix(first) * matrix(first + 12 + 16 * joint);
            const glm::dmat4 held = palette * glm::dmat4(binds_[joint]);
            const glm::dmat4 toJoint = glm::inverse(glm::dmat4(binds_[joint]));
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 p = glm::mix(low, high, glm::bvec3((corner & 1) != 0, (corner & 2) != 0, corner > 3));
                const glm::dvec4 q = toJoint * glm::dvec4(p, 1.0);
                worst = std::max(worst, glm::length(glm::dvec3(held * q) - glm::dvec3(sockets[i] * q)));
            }
        }
        return worst / glm::length(high - low);
    }

    CrowdContext& context_;
    SuppleGroupDesc desc_;
    Crowd told_, plays_;
    std::vector<glm::mat4> binds_;
    std::array<std::vector<glm::dmat4>, 2> sockets_; ///< of the last run: told, played
    SuppleAssetInfo info_{};
    double extent_ = 0.0;
    double travelled_ = 0.0;
    std::vector<Played> played_;
    std::vector<glm::mat4> transforms_;
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
            channels.push_back(noisyChannel(noise, tube.parts[0].node, cage::ChannelPath::weights, kKinds[kind % 3], 5,
                                            duration, targets));
        }
        tube.clips.push_back(clipOf(std::move(channels)));
        tube.clips.back().name = "clip " + std::to_string(kind);
    }
    return tube;
}

TEST_F(PlaybackOnGpu, PosesTheDemoCharacterAsCallsDo) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        for (const SuppleSkinning skinning : kSkinnings) {
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
            worst.print(mappingName(mapping) + ", " + std::string(skinningName(skinning)));
            EXPECT_TRUE(worst.within());
        }
    }
}

TEST_F(PlaybackOnGpu, PlaysEveryKindOfKeys) {
    const ValidationGuard guard;
    for (const uint32_t targets : {0u, 5u}) {
        for (const SuppleMapping mapping : kMappings) {
            for (const SuppleSkinning skinning : kSkinnings) {
                CrowdContext& own = context(mapping);
                ASSERT_TRUE(own.valid());
                const cage::Character tube = noisyTube(5, targets);
                constexpr uint32_t kInstances = 8;
                Duet duet(own, cageGroup(own.createAsset(tube), kInstances, skinning));
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
                worst.print(mappingName(mapping) + ", " + std::to_string(targets) + " targets" + ", " +
                            std::string(skinningName(skinning)));
                EXPECT_TRUE(worst.within());
            }
        }
    }
}

SupplePlaybackLayer adding(SupplePlaybackLayer layer, float weight, double referenceTime) {
    layer.mode = SUPPLE_LAYER_ADDITIVE;
    layer.weight = weight;
    layer.referenceTime = referenceTime;
    return layer;
}
SupplePlaybackLayer fading(SupplePlaybackLayer layer, float from, float to, double start, float duration) {
    layer.weight = from;
    layer.fadeWeight = to;
    layer.fadeStart = start;
    layer.fadeDuration = duration;
    return layer;
}
SupplePlaybackLayer masked(SupplePlaybackLayer layer, uint32_t mask) {
    layer.mask = mask;
    return layer;
}

TEST_F(PlaybackOnGpu, LayersClipsAsCallsDo) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        for (const SuppleSkinning skinning : kSkinnings) {
            CrowdContext& own = context(mapping);
            ASSERT_TRUE(own.valid());
            Duet duet(own, cageGroup(own.createAsset(noisyTube(5, 5)), 9, skinning));
            ASSERT_TRUE(duet.valid());
            duet.setMask(1, {{1.0f, 0.25f, 0.0f, 0.5f, 1.0f}, {}});
            duet.setMask(16, {{0.0f, 0.0f, 0.75f, 1.0f, 1.0f}, {1.0f, 0.5f, 0.0f, 1.0f, 0.25f}});
            duet.setMask(7, {{}, {0.0f, 1.0f, 0.5f, 0.0f, 1.0f}});
            duet.set(0, {});
            duet.set(1, {{playing(0), fading(playing(1, 0.2), 0.0f, 1.0f, 1.0, 2.0f)}});
            duet.set(2, {{fading(playing(0, 0.1, -1.3f), 0.8f, 0.3f, -0.5, 1.0f), adding(playing(2), 1.0f, 0.0)}});
            duet.set(3, {{playing(1), adding(playing(0, 0.4), 2.5f, 0.3), adding(playing(3), -0.7f, 9.0)}});
            duet.set(4, {{playing(1), masked(playing(0), 1), masked(adding(playing(2), 0.6f, 0.2), 16)}});
            duet.set(5, {{masked(playing(3), 7), masked(fading(playing(1), 1.0f, 0.25f, 2.0, 0.25f), 16)}});
            Played eight;
            for (uint32_t i = 0; i < SUPPLE_MAX_PLAYBACK_LAYERS; ++i) {
                eight.layers.push_back(
                    fading(playing(i % 4, 0.1 * i, 0.5f + 0.1f * static_cast<float>(i)), 0.2f, 0.6f, 0.5 * i, 1.5f));
            }
            duet.set(6, eight);
            SupplePlaybackLayer later = playing(0, 0.25, 0.5f);
            later.startTime = 1.75;
            duet.set(7, {{later}});
            duet.set(8, {{playing(0), fading(playing(2), 0.0f, 0.0f, 0.0, 1.0f)}});
            Difference worst;
            for (const double time : {0.0, 0.4, 1.0, 1.75, 2.0, 2.1, 2.25, 3.0, 5.5, -2.0}) {
                duet.run(time);
                worst.add(duet.difference());
            }
            // Set anew while it plays.
            duet.setMask(1, {{0.0f, 0.5f, 1.0f, 0.1f, 0.0f}, {}});
            duet.set(0, {{playing(2)}});
            const std::vector<float> weights = {0.5f, -0.5f, 0.25f, 0.0f, 2.0f};
            for (const SuppleInstance& instance : {duet.toldOnes[3], duet.players[3]}) {
                EXPECT_EQ(suppleSetMorphWeights(own.handle(), instance, weights.data(), 5), SUPPLE_OK);
            }
            duet.run(1.1);
            worst.add(duet.difference());
            for (const SuppleInstance& instance : {duet.toldOnes[3], duet.players[3]}) {
                EXPECT_EQ(suppleSetMorphWeights(own.handle(), instance, nullptr, 0), SUPPLE_OK);
            }
            duet.run(1.2);
            worst.add(duet.difference());
            worst.print(mappingName(mapping) + ", " + std::string(skinningName(skinning)));
            EXPECT_TRUE(worst.within());
        }
    }
}

TEST_F(PlaybackOnGpu, IsInPhaseAfterTenHours) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        Duet duet(own, cageGroup(own.asset(kPip), 6));
        ASSERT_TRUE(duet.valid());
        const double hours = 36000.0;
        Difference worst;
        for (const float speed : {1.0f, -0.3f, 17.3f}) {
            for (uint32_t i = 0; i < 6; ++i) {
                SupplePlaybackLayer late = playing(i % 3, 0.2, speed, i != 4);
                late.startTime = i < 3 ? 0.1 * i : hours + 0.1 * i;
                SupplePlaybackLayer over = fading(playing((i + 1) % 3, 0.1, speed), 0.0f, 1.0f, hours + 0.3, 1.0f);
                duet.set(i, {{late, over}});
            }
            for (const double time : {hours, hours + 0.0123, hours + 0.7, hours + 1.1, hours + 3.3}) {
                duet.run(time);
                worst.add(duet.difference());
            }
        }
        worst.print(mappingName(mapping));
        // 1e-4 s of a walk at speed 17 would show as far more.
        EXPECT_TRUE(worst.within());
        // Within the last frame's motion of a loop, no more than 1e-4 s off: the other way round, poses of times that
        // far apart differ by more than was measured.
        duet.run(hours + 3.3);
        const std::vector<float> now = floatsOf(duet.plays().read(duet.plays().output().info.poses));
        duet.run(hours + 3.3 + 1e-4);
        const std::vector<float> then = floatsOf(duet.plays().read(duet.plays().output().info.poses));
        double moved = 0.0;
        for (size_t i = 0; i < now.size(); ++i) {
            moved = std::max(moved, std::abs(static_cast<double>(now[i]) - static_cast<double>(then[i])));
        }
        std::printf("0.1 ms move a pose by %.2g\n", moved);
        EXPECT_GT(moved, worst.matrices);
    }
}

/// A tube whose first joint wanders: straight on, or turning by `turn` a loop.
cage::Character wanderingTube(float turn) {
    cage::Character tube = riggedTube({.segments = 8, .sides = 6, .joints = 3});
    const auto about = [](float angle) {
        return std::array<float, 4>{0.0f, std::sin(0.5f * angle), 0.0f, std::cos(0.5f * angle)};
    };
    std::vector<float> times, places, turns;
    for (int k = 0; k <= 4; ++k) {
        const float part = 0.25f * static_cast<float>(k);
        times.push_back(0.96f * part);
        places.insert(places.end(), {1.5f * part, 0.2f * std::sin(6.0f * part), 0.5f * part * part});
        const std::array<float, 4> q = about(turn * part);
        turns.insert(turns.end(), q.begin(), q.end());
    }
    tube.clips.push_back(clipOf({channel(1, cage::ChannelPath::translation, times, places),
                                 channel(1, cage::ChannelPath::rotation, times, turns)}));
    Noise noise(3);
    tube.clips.push_back(
        clipOf({noisyChannel(noise, 1, cage::ChannelPath::translation, cage::Interpolation::cubicSpline, 4, 1.3f, 0),
                noisyChannel(noise, 1, cage::ChannelPath::rotation, cage::Interpolation::linear, 4, 1.3f, 0)}));
    for (size_t c = 0; c < 2; ++c) {
        tube.clips[c].name = "clip " + std::to_string(c);
    }
    return tube;
}

constexpr uint32_t kAllAxes = SUPPLE_ROOT_MOTION_GROUND | SUPPLE_ROOT_MOTION_HEIGHT | SUPPLE_ROOT_MOTION_YAW;

TEST_F(PlaybackOnGpu, TakesRootMotionOutAsCallsDo) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const bool demo : {true, false}) {
            Duet duet(own, cageGroup(demo ? own.asset(kPip) : own.createAsset(wanderingTube(0.7f)), 7));
            ASSERT_TRUE(duet.valid());
            const std::vector<SupplePlaybackLayer> two = {playing(0), fading(playing(1, 0.3), 0.2f, 0.9f, 0.5, 1.0f)};
            for (uint32_t axes = 1; axes <= kAllAxes; ++axes) {
                duet.set(axes - 1, {two, axes});
            }
            Difference worst;
            for (const double time : {0.0, 0.3, 0.96, 1.5, -0.2}) {
                duet.run(time);
                worst.add(duet.difference());
            }
            // Of a joint that moves with those above it; of what is added.
            for (uint32_t i = 0; i < 3; ++i) {
                duet.set(i, {two, kAllAxes, SUPPLE_PLAYBACK_ROOT_JOINT, i});
                duet.set(i + 3, {{playing(1), adding(playing(0), 0.5f, 0.4)}, kAllAxes});
            }
            for (const double time : {0.1, 1.1}) {
                duet.run(time);
                worst.add(duet.difference());
            }
            worst.print(mappingName(mapping) + (demo ? ", demo character" : ", tube"));
            EXPECT_TRUE(worst.within());
        }
    }
}

TEST_F(PlaybackOnGpu, TravelsByTheRootsMovement) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const float turn : {0.0f, 0.7f, -0.01f, 1e-4f, 3.0f}) {
            Duet duet(own, cageGroup(own.createAsset(wanderingTube(turn)), 5));
            ASSERT_TRUE(duet.valid());
            for (uint32_t i = 0; i < 5; ++i) {
                const float speeds[] = {1.0f, -1.0f, 0.6f, 1.0f, 2.0f};
                SupplePlaybackLayer walk = playing(0, 0.3 * i - 0.5, speeds[i], i != 3);
                walk.startTime = 0.25 * i;
                walk.weight = i == 4 ? 0.5f : 1.0f;
                const uint32_t axes = i == 2 ? uint32_t{SUPPLE_ROOT_MOTION_GROUND} : kAllAxes;
                duet.set(i, {{walk, adding(playing(1), 0.3f, 0.1)}, axes, SUPPLE_PLAYBACK_TRAVEL});
                duet.setTransform(i, glm::rotate(glm::translate(glm::mat4(1.0f), {3.0f, 0.0f, static_cast<float>(i)}),
                                                 0.4f * static_cast<float>(i), {0.0f, 1.0f, 0.0f}));
            }
            Difference worst;
            for (const double time : {0.0, 0.5, 0.96, 2.0, 7.3, -3.1}) {
                duet.run(time);
                worst.add(duet.difference());
            }
            worst.print(mappingName(mapping) + ", " + std::to_string(turn) + " rad a loop");
            EXPECT_TRUE(worst.within());
            // Ten hours on: what floats have of the distance.
            Difference far;
            for (const double time : {36000.0, 36000.4}) {
                duet.run(time);
                far.add(duet.difference());
            }
            const double away = std::max(duet.travelled() / duet.extent(), 1.0);
            std::printf("after ten hours %.3g extents away: off by %.2g of that, turned by %.2g\n", away,
                        far.places / away, far.matrices);
            EXPECT_LT(far.places / away, 1e-5);
            EXPECT_LT(far.sockets / away, 1e-4) << "turned by as much";
            // A loop's turn of floats, 36,000 times over, on both sides.
            EXPECT_LT(far.matrices, 1e-4);
        }
    }
}

TEST_F(PlaybackOnGpu, TravelsFromAClipTimeFarOff) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const float turn : {0.0f, 0.7f}) {
            Duet duet(own, cageGroup(own.createAsset(wanderingTube(turn)), 4));
            ASSERT_TRUE(duet.valid());
            // More whole loops of 0.96 s than floats tell apart.
            const double offsets[] = {1e8, 1e8 + 0.5, -1e8, 3e8};
            for (uint32_t i = 0; i < 4; ++i) {
                duet.set(i, {{playing(0, offsets[i], i == 1 ? -0.7f : 1.0f)}, kAllAxes, SUPPLE_PLAYBACK_TRAVEL});
            }
            Difference worst;
            for (const double time : {0.0, 0.3, 0.96, 2.0, 7.3}) {
                duet.run(time);
                worst.add(duet.difference());
            }
            worst.print(mappingName(mapping) + ", " + std::to_string(turn) + " rad a loop, 1e8 s into the clip");
            EXPECT_TRUE(worst.within());
        }
    }
}

TEST_F(PlaybackOnGpu, BothMappingsGiveTheSameBits) {
    const ValidationGuard guard;
    // More nodes than shared memory holds, too.
    for (const uint32_t joints : {6u, 400u}) {
        std::vector<std::byte> poses[2];
        Difference worst;
        for (size_t m = 0; m < 2; ++m) {
            CrowdContext& own = context(kMappings[m]);
            ASSERT_TRUE(own.valid());
            Duet duet(own, cageGroup(own.createAsset(noisyTube(joints, 3)), 3, SUPPLE_SKINNING_DUAL_QUATERNION));
            ASSERT_TRUE(duet.valid());
            for (uint32_t i = 0; i < 3; ++i) {
                duet.set(i, {{playing(i), fading(playing(3, 0.1 * i), 0.0f, 1.0f, 0.0, 1.0f)}});
            }
            duet.run(0.6);
            if (joints < 100) { // four hundred that scale one another leave no number that could be compared
                worst.add(duet.difference());
            }
            poses[m] = duet.plays().read(duet.plays().output().info.poses);
        }
        EXPECT_FALSE(poses[0].empty());
        EXPECT_TRUE(poses[0] == poses[1]) << joints << " joints";
        EXPECT_TRUE(worst.within());
    }
}

TEST_F(PlaybackOnGpu, PlaysOtherHandsFiles) {
    const ValidationGuard guard;
    std::vector<std::string> names;
    for (const char* name : {"CesiumMan.glb", "Fox.glb", "RiggedSimple.glb", "SimpleSkin.gltf", "BoxAnimated.gltf",
                             "InterpolationTest.gltf", "MorphStressTest.gltf", "SimpleMorph/SimpleMorph.gltf",
                             "AnimatedMorphCube/AnimatedMorphCube.gltf"}) {
        names.push_back(std::string("khronos/") + name);
    }
    for (const std::string& path : sharedAssets(names)) {
        SCOPED_TRACE(path);
        for (const SuppleMapping mapping : kMappings) {
            CrowdContext& own = context(mapping);
            ASSERT_TRUE(own.valid());
            std::ifstream file(path, std::ios::binary);
            const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
            const std::string folder = std::filesystem::path(path).parent_path().string();
            SuppleAssetDesc desc{};
            desc.structSize = sizeof(desc);
            desc.name = path.c_str();
            desc.bytes = bytes.data();
            desc.byteCount = bytes.size();
            desc.baseDirectory = folder.c_str();
            SuppleAsset asset{};
            ASSERT_EQ(suppleCreateAsset(own.handle(), &desc, &asset), SUPPLE_OK);
            Duet duet(own, cageGroup(asset, 6));
            ASSERT_TRUE(duet.valid());
            const uint32_t clips = duet.info().clipCount;
            ASSERT_GT(clips, 0u);
            Difference worst;
            for (uint32_t first = 0; first < clips; first += 3) {
                for (uint32_t i = 0; i < 6; ++i) {
                    duet.set(i, {{playing((first + i) % clips, 0.2 * i, 1.0f, i < 3)}});
                }
                for (const double time : {0.0, 0.4, 1.1, 2.9}) {
                    duet.run(time);
                    worst.add(duet.difference());
                }
            }
            worst.print(std::filesystem::path(path).filename().string() + ", " + mappingName(mapping));
            EXPECT_TRUE(worst.within());
        }
    }
}

/// Every kind of layer, for a character of any joints and clips.
std::vector<Played> allKindsOfLayers(uint32_t clips) {
    const auto clip = [&](uint32_t i) { return i % clips; };
    std::vector<Played> kinds = {{}};
    kinds.push_back({{playing(clip(0), 0.2), fading(playing(clip(1), 0.1, -0.7f), 0.0f, 1.0f, 1e6 + 0.1, 2.0f)}});
    kinds.push_back({{playing(clip(1), 0.0, 1.0f, false), masked(fading(playing(clip(2)), 0.9f, 0.1f, 0.3, 4.0f), 1)}});
    kinds.push_back({{playing(clip(2)), masked(adding(playing(clip(0), 0.3, 1.3f), 0.7f, 0.1), 1)}});
    kinds.push_back({{playing(clip(0)), fading(playing(clip(1), 0.3), 0.2f, 0.9f, 0.5, 1.0f)}, kAllAxes});
    Played eight;
    for (uint32_t i = 0; i < SUPPLE_MAX_PLAYBACK_LAYERS; ++i) {
        eight.layers.push_back(
            fading(playing(clip(i), 0.1 * i, 0.5f + 0.1f * static_cast<float>(i)), 0.2f, 0.6f, 0.5 * i, 1.5f));
    }
    kinds.push_back(eight);
    return kinds;
}

TEST_F(PlaybackOnGpu, TheCpuKnowsWhereTheJointsAre) {
    const ValidationGuard guard;
    std::vector<std::string> paths = allCharacters();
    const std::vector<std::string> others =
        sharedAssets({"khronos/CesiumMan.glb", "khronos/Fox.glb", "khronos/RiggedSimple.glb"});
    paths.insert(paths.end(), others.begin(), others.end());
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    uint32_t played = 0;
    for (const std::string& path : paths) {
        SCOPED_TRACE(path);
        const SuppleAsset asset = own.asset(path);
        SuppleAssetInfo info{};
        info.structSize = sizeof(info);
        ASSERT_EQ(suppleGetAssetInfo(own.handle(), asset, &info), SUPPLE_OK);
        const std::vector<Played> kinds =
            info.clipCount == 0 ? std::vector<Played>{{}} : allKindsOfLayers(info.clipCount);
        Duet duet(own, cageGroup(asset, static_cast<uint32_t>(kinds.size())));
        ASSERT_TRUE(duet.valid());
        Mask mask;
        for (uint32_t j = 0; j < info.jointCount; ++j) {
            mask.joints.push_back(0.5f * static_cast<float>(j % 3));
        }
        duet.setMask(1, mask);
        for (uint32_t i = 0; i < kinds.size(); ++i) {
            duet.set(i, kinds[i]);
            duet.setTransform(i, glm::scale(glm::rotate(glm::mat4(1.0f), 0.3f * static_cast<float>(i), {0, 1, 0}),
                                            glm::vec3(1.0f + 0.1f * static_cast<float>(i))));
        }
        Difference worst;
        // Not at the ends of loops, where clips jump and either side is right.
        for (const double time : {0.0, 0.37, 1.73, 5.11, -2.31, 1e6, 1e6 + 0.83, -1e6}) {
            duet.run(time);
            worst.add(duet.difference());
        }
        worst.print(std::filesystem::path(path).filename().string());
        EXPECT_LT(worst.sockets, kSocketBound);
        played += info.clipCount > 0 ? 1 : 0;
    }
    EXPECT_GE(played, 2u);
}

TEST_F(PlaybackOnGpu, NewInstancesAreInTheBindPose) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    for (const SuppleSkinning skinning : kSkinnings) {
        SuppleGroupDesc desc = cageGroup(own.createAsset(noisyTube(3, 3)), 2, skinning);
        Crowd told(own, desc);
        desc.poseSource = SUPPLE_POSES_PLAYBACK;
        Crowd plays(own, desc);
        ASSERT_TRUE(told.valid() && plays.valid());
        const auto same = [&] {
            own.run(told.group());
            own.run(plays.group());
            return told.read(told.output().info.poses) == plays.read(plays.output().info.poses);
        };
        static_cast<void>(told.spawn());
        static_cast<void>(told.spawn());
        SuppleInstance instance = plays.spawn();
        static_cast<void>(plays.spawn());
        EXPECT_TRUE(same());
        // Of what played in the slot before, nothing is left.
        const SupplePlaybackLayer layer = playing(1);
        SupplePlaybackDesc playback{};
        playback.structSize = sizeof(playback);
        playback.layers = &layer;
        playback.layerCount = 1;
        const float weights[3] = {1.0f, 2.0f, 3.0f};
        const glm::mat4 away = glm::translate(glm::mat4(1.0f), {5.0f, 0.0f, 0.0f});
        EXPECT_EQ(suppleSetPlayback(own.handle(), instance, &playback), SUPPLE_OK);
        EXPECT_EQ(suppleSetMorphWeights(own.handle(), instance, weights, 3), SUPPLE_OK);
        EXPECT_EQ(suppleSetTransform(own.handle(), instance, glm::value_ptr(away)), SUPPLE_OK);
        EXPECT_FALSE(same());
        plays.destroy(instance);
        instance = plays.spawn();
        EXPECT_EQ(instance.slot, 0u);
        EXPECT_TRUE(same());
    }
}

/// Groups whose instances play, driven alike.
struct Walkers {
    Walkers(CrowdContext& context, SuppleGroupDesc desc)
        : crowd(context, [&] {
              desc.poseSource = SUPPLE_POSES_PLAYBACK;
              return desc;
          }()) {
        for (uint32_t i = 0; crowd.valid() && i < desc.capacity; ++i) {
            instances.push_back(crowd.spawn());
            play(i, i % 2, 0.1 * i);
            place(i, {0.3f * static_cast<float>(i), 0.0f, 0.0f});
        }
    }
    void play(uint32_t i, uint32_t clip, double offset) const {
        const SupplePlaybackLayer layer = playing(clip, offset);
        SupplePlaybackDesc desc{};
        desc.structSize = sizeof(desc);
        desc.layers = &layer;
        desc.layerCount = 1;
        EXPECT_EQ(suppleSetPlayback(crowd.context().handle(), instances[i], &desc), SUPPLE_OK);
    }
    void place(uint32_t i, const glm::vec3& at) const {
        const glm::mat4 transform = glm::translate(glm::mat4(1.0f), at);
        EXPECT_EQ(suppleSetTransform(crowd.context().handle(), instances[i], glm::value_ptr(transform)), SUPPLE_OK);
    }
    void setTime(double time) const {
        EXPECT_EQ(suppleSetTime(crowd.context().handle(), crowd.group(), time), SUPPLE_OK);
    }
    void run(double time) {
        setTime(time);
        crowd.run();
    }
    Crowd crowd;
    std::vector<SuppleInstance> instances;
};

SuppleGroupDesc movingGroup(SuppleAsset asset, uint32_t capacity) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 2;
    desc.flags = SUPPLE_GROUP_MOTION;
    return desc;
}

TEST_F(PlaybackOnGpu, PreviousPositionsAreThoseOfTheFrameBefore) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        constexpr uint32_t kInstances = 5;
        Walkers walkers(own, movingGroup(own.createAsset(noisyTube(3, 0)), kInstances));
        Crowd& crowd = walkers.crowd;
        ASSERT_TRUE(crowd.valid());
        std::vector<PositionBits> past(kInstances);
        std::vector<bool> had(kInstances, false);
        for (uint32_t frame = 0; frame < 12; ++frame) {
            SCOPED_TRACE(mappingName(mapping) + " frame " + std::to_string(frame));
            // Hidden, shown, teleported and replaced, with frames between in which nothing is set.
            crowd.setVisible(walkers.instances[1], frame < 4 || frame > 6);
            if (frame == 5) {
                crowd.teleport(walkers.instances[2]);
                had[2] = false;
            }
            if (frame == 8) {
                crowd.destroy(walkers.instances[3]);
                walkers.instances[3] = crowd.spawn();
                walkers.play(3, 1, 0.4);
                had[3] = false;
            }
            if (frame == 10) {
                own.cancel(crowd.group());
                had.assign(kInstances, false);
            }
            walkers.run(0.05 * frame);
            const std::vector<uint32_t> listed = crowd.listed();
            EXPECT_EQ(listed.size(), frame >= 4 && frame <= 6 ? kInstances - 1 : kInstances);
            std::vector<bool> has(kInstances, false);
            for (const uint32_t slot : listed) {
                has[slot] = true;
                const PositionBits& wanted = had[slot] ? past[slot] : crowd.positions(slot);
                EXPECT_EQ(differences(crowd.previous(slot), wanted), 0u) << "slot " << slot;
                EXPECT_TRUE(!had[slot] || differences(crowd.positions(slot), past[slot]) > 0) << "slot " << slot;
                past[slot] = crowd.positions(slot);
            }
            had = has;
        }
    }
}

TEST_F(PlaybackOnGpu, WindowsOfInstancesPlayAlike) {
    constexpr uint32_t kCapacity = 150, kRange = 1u << 16;
    for (const SuppleMapping mapping : kMappings) {
        WrappedVulkan& wrapped = wrappedVulkan();
        const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
        wrapped.maxStorageBufferRange = kRange;
        {
            CrowdContext small(*device, mapping);
            CrowdContext& large = context(mapping);
            ASSERT_TRUE(small.valid() && large.valid());
            const cage::Character tube = noisyTube(3, 3);
            Walkers windows(small, cageGroup(small.createAsset(tube), kCapacity)),
                one(large, cageGroup(large.createAsset(tube), kCapacity));
            ASSERT_TRUE(windows.crowd.valid() && one.crowd.valid());
            EXPECT_GT(windows.crowd.output().info.poses.stride * VkDeviceSize{kCapacity}, kRange / 2);
            for (const double time : {0.3, 0.7, 0.9}) {
                for (Walkers* walkers : {&windows, &one}) {
                    if (time == 0.7) {
                        walkers->play(77, 2, 0.5);
                        walkers->crowd.setVisible(walkers->instances[70], false);
                    }
                    walkers->setTime(time);
                    walkers->crowd.context().run(walkers->crowd.group());
                }
                const host::GroupOutput a = windows.crowd.output(), b = one.crowd.output();
                const std::vector<std::byte> cages = windows.crowd.read(a.info.deformedCage),
                                             wanted = one.crowd.read(b.info.deformedCage);
                size_t different = 0;
                for (uint32_t slot = 0; slot < kCapacity; ++slot) {
                    different += std::memcmp(cages.data() + size_t{slot} * a.info.cageVerticesPerInstance * 16,
                                             wanted.data() + size_t{slot} * b.info.cageVerticesPerInstance * 16,
                                             size_t{a.info.cageVertexCount} * 16) != 0;
                }
                EXPECT_EQ(different, 0u) << "time " << time;
            }
        }
        EXPECT_EQ(device->validation()->messageCount(), 0u);
        wrapped.maxStorageBufferRange = 0;
    }
}

TEST_F(PlaybackOnGpu, WhatIsNotSetIsNotUploaded) {
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    {
        CrowdContext own(*device);
        ASSERT_TRUE(own.valid());
        const SuppleAsset asset = own.createAsset(noisyTube(3, 3));
        uint64_t one = 0;
        for (const uint32_t instances : {1u, 7u, 64u}) {
            SCOPED_TRACE(std::to_string(instances) + " instances");
            Walkers walkers(own, movingGroup(asset, instances));
            ASSERT_TRUE(walkers.crowd.valid());
            walkers.run(0.0);
            walkers.run(0.01); // what was new has come to have a past
            const WrappedVulkan& counts = wrappedVulkan();
            PositionBits before = walkers.crowd.positions(0);
            for (int frame = 2; frame < 6; ++frame) {
                walkers.setTime(0.05 * frame);
                own.run(walkers.crowd.group());
            }
            EXPECT_EQ(counts.copies + counts.maps + counts.flushes + counts.updates + counts.fills, 0u);
            EXPECT_EQ(counts.copiedBytes, 0u) << "the time goes with the commands";
            walkers.crowd.read();
            EXPECT_GT(differences(walkers.crowd.positions(0), before), 0u);
            // One that is set costs what one costs.
            wrappedVulkan();
            walkers.play(instances / 2, 1, 0.2);
            own.run(walkers.crowd.group());
            EXPECT_EQ(counts.copies, 1u);
            EXPECT_EQ(counts.copiedBytes, one == 0 ? counts.copiedBytes : one);
            one = counts.copiedBytes;
            wrappedVulkan();
            walkers.place(0, glm::vec3(1.0f));
            walkers.place(instances - 1, glm::vec3(2.0f));
            own.run(walkers.crowd.group());
            EXPECT_EQ(counts.copiedBytes, instances == 1 ? one : 2 * one);
            // A frame that never ran is made up for.
            wrappedVulkan();
            before = walkers.crowd.positions(0);
            walkers.place(0, glm::vec3(3.0f));
            own.cancel(walkers.crowd.group());
            walkers.crowd.run();
            EXPECT_EQ(counts.copiedBytes, 2 * one + instances * 8 + walkers.crowd.output().grid.drawRangeCount * 20);
            EXPECT_GT(differences(walkers.crowd.positions(0), before), 0u);
        }
        std::printf("%llu bytes for an instance that is set\n", static_cast<unsigned long long>(one));
    }
    EXPECT_EQ(device->validation()->messageCount(), 0u);
}

TEST_F(PlaybackOnGpu, EveryBarrierOfItCounts) {
    // In order: entry, uploads, between the halves of the pose pass, behind it, behind deform, exit.
    for (const int64_t dropped : {1, 2, 3}) {
        wrappedVulkan();
        const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
        const auto log = device->validation();
        {
            // In the other mapping a kernel reads and writes a buffer through one binding, and the layer misses what it
            // reads.
            CrowdContext own(*device, SUPPLE_MAPPING_NARROW);
            ASSERT_TRUE(own.valid());
            Walkers walkers(own, cageGroup(own.createAsset(noisyTube(3, 0)), 2));
            ASSERT_TRUE(walkers.crowd.valid());
            own.run(walkers.crowd.group());
            own.run(walkers.crowd.group());
            ASSERT_EQ(log->messageCount(), 0u);
            WrappedVulkan& wrapped = wrappedVulkan();
            wrapped.dropBarrier = dropped;
            walkers.play(1, 1, 0.3);
            own.run(walkers.crowd.group());
            EXPECT_EQ(wrapped.barriers, 6u) << "the frame has other barriers now: look at the indices above";
        }
        EXPECT_GT(log->messageCount(), 0u) << "barrier " << dropped;
    }
}

TEST_F(PlaybackOnGpu, OutOfMemoryIsAnError) {
    for (const bool hostMemory : {false, true}) {
        wrappedVulkan();
        const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
        const auto log = device->validation();
        uint32_t failures = 0;
        {
            CrowdContext own(*device);
            ASSERT_TRUE(own.valid());
            SuppleGroupDesc desc = cageGroup(own.createAsset(noisyTube(3, 2)), 2);
            desc.structSize = sizeof(desc);
            desc.poseSource = SUPPLE_POSES_PLAYBACK;
            SuppleGroup group{};
            for (int64_t n = 0; n < 100; ++n) {
                WrappedVulkan& wrapped = wrappedVulkan();
                (hostMemory ? wrapped.failBuffer : wrapped.failAllocation) = n;
                const SuppleResult result = suppleCreateGroup(own.handle(), &desc, &group);
                if (result == SUPPLE_OK) {
                    break;
                }
                ++failures;
                EXPECT_EQ(result, hostMemory ? SUPPLE_ERROR_HOST_MEMORY : SUPPLE_ERROR_DEVICE_MEMORY) << n;
            }
            wrappedVulkan();
            SuppleInstance instance{};
            EXPECT_EQ(suppleCreateInstance(own.handle(), group, &instance), SUPPLE_OK);
            own.run(group);
        }
        EXPECT_GE(failures, 4u);
        EXPECT_EQ(log->messageCount(), 0u);
    }
}

TEST_F(PlaybackOnGpu, IsAPassOfItsOwn) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    Walkers walkers(own, movingGroup(own.createAsset(noisyTube(3, 0)), 2));
    ASSERT_TRUE(walkers.crowd.valid());
    const SuppleGroup group = walkers.crowd.group();
    for (int frame = 0; frame < 3; ++frame) {
        own.evaluate({&group, 1}, SUPPLE_RECORD_TIMINGS);
    }
    own.beginFrame();
    SuppleTiming timings[16];
    uint32_t count = 16;
    ASSERT_EQ(suppleGetTimings(own.handle(), sizeof(SuppleTiming), timings, &count), SUPPLE_OK);
    ASSERT_GE(count, 3u);
    EXPECT_EQ(timings[0].pass, SUPPLE_PASS_POSE) << "nothing was uploaded";
    EXPECT_EQ(timings[0].points, 0u) << "local matrices, of which poses are made";
    EXPECT_GE(timings[0].gpuEnd, timings[0].gpuBegin);
    EXPECT_EQ(timings[1].pass, SUPPLE_PASS_POSE);
    EXPECT_EQ(timings[1].points, 2u * 3u);
    EXPECT_EQ(timings[2].pass, SUPPLE_PASS_DEFORM);
}

TEST_F(PlaybackOnGpu, WhatItDoesNotTakeIsRefused) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    SuppleGroupDesc desc = cageGroup(own.createAsset(noisyTube(2, 2)), 1);
    Crowd told(own, desc);
    desc.poseSource = SUPPLE_POSES_CAGE_BUFFER;
    Crowd filled(own, desc);
    desc.poseSource = SUPPLE_POSES_PLAYBACK;
    Crowd plays(own, desc);
    ASSERT_TRUE(told.valid() && filled.valid() && plays.valid());
    const SuppleInstance player = plays.spawn();
    SuppleContext handle = own.handle();
    const auto conflict = [&](SuppleResult result, const char* call) {
        EXPECT_EQ(result, SUPPLE_ERROR_ARGUMENT) << call;
        EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_CONFLICT) << call;
    };
    SupplePoseDesc pose{};
    pose.structSize = sizeof(pose);
    const glm::mat4 matrices[2] = {glm::mat4(1.0f), glm::mat4(1.0f)};
    conflict(suppleSetClipPose(handle, player, 0, 0.0), "suppleSetClipPose");
    conflict(suppleSetPose(handle, player, &pose), "suppleSetPose");
    conflict(suppleSetMatrixPose(handle, player, glm::value_ptr(matrices[0]), 2), "suppleSetMatrixPose");
    SupplePlaybackDesc playback{};
    playback.structSize = sizeof(playback);
    const float joints[2] = {1.0f, 0.0f};
    SuppleMaskDesc mask{};
    mask.structSize = sizeof(mask);
    mask.mask = 1;
    mask.jointMask = joints;
    mask.jointMaskCount = 2;
    for (Crowd* other : {&told, &filled}) {
        conflict(suppleSetPlayback(handle, other->spawn(), &playback), "suppleSetPlayback");
        conflict(suppleSetTime(handle, other->group(), 1.0), "suppleSetTime");
        conflict(suppleSetMask(handle, other->group(), &mask), "suppleSetMask");
    }
    // A mask that is not there yet, and then is.
    SupplePlaybackLayer layer = masked(playing(0), 1);
    playback.layers = &layer;
    playback.layerCount = 1;
    EXPECT_EQ(suppleSetPlayback(handle, player, &playback), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_RANGE);
    EXPECT_EQ(suppleSetMask(handle, plays.group(), &mask), SUPPLE_OK);
    EXPECT_EQ(suppleSetPlayback(handle, player, &playback), SUPPLE_OK);
    playback.flags = SUPPLE_PLAYBACK_TRAVEL;
    conflict(suppleSetPlayback(handle, player, &playback), "travel by nothing");
}

} // namespace
} // namespace supple::test
