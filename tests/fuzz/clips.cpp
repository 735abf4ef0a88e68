// The clips of any glTF, sampled, layered and played at any time. What comes out is finite, and the cage lies in the
// box of its clip.
#include "cage/gltf/reader.h"
#include "cage/limits.h"
#include "cage/refusal.h"
#include "skinning/clip_bounds.h"
#include "skinning/clip_markers.h"
#include "skinning/clip_packer.h"
#include "skinning/clip_table.h"
#include "skinning/layers.h"
#include "skinning/packed_clip.h"
#include "skinning/played_pose.h"
#include "skinning/retarget.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace supple::fuzz {
namespace {

/// Numbers from the end of the input, where a GLB may have anything; zeros when it has ended.
class Tail {
public:
    Tail(const uint8_t* data, size_t size) : data_(data), left_(size) {}
    uint32_t below(uint32_t count) { return left_ == 0 ? 0 : data_[--left_] % count; }
    /// Within the duration, at its ends, and some way outside.
    double time(double duration) { return duration * (static_cast<double>(below(64)) - 16.0) / 32.0; }
    float weight() { return static_cast<float>(below(5)) / 4.0f; }

private:
    const uint8_t* data_;
    size_t left_;
};

bool finite(const skinning::Pose& pose) {
    const auto sound = [](const skinning::Transform& t) {
        return std::isfinite(glm::dot(t.translation, glm::dvec3(1.0))) &&
               std::isfinite(glm::dot(t.rotation, t.rotation)) && std::isfinite(glm::dot(t.scale, glm::dvec3(1.0)));
    };
    return std::all_of(pose.locals.begin(), pose.locals.end(), sound);
}

/// The clip's box holds the cage, but for what floats lose.
void demandInBox(const cage::Character& character, const cage::Clip& clip, const skinning::Pose& pose,
                 skinning::PoseMemory& memory) {
    std::vector<skinning::Affine> palette(character.skin.joints.size());
    skinning::posePalette(character, pose, memory.nodes, palette);
    double largest = 1.0;
    for (const skinning::Affine& joint : palette) {
        for (const glm::vec4& row : joint.rows) {
            for (int k = 0; k < 4; ++k) {
                largest = std::max(largest, std::abs(double{row[k]}));
            }
        }
    }
    double farthest = 1.0;
    for (const glm::vec3& position : character.cage.positions) {
        farthest = std::max(farthest, double{glm::length(position)});
    }
    if (!std::isfinite(largest) || largest > 1e30) {
        return;
    }
    const double tolerance = 1e-5 * largest * farthest;
    const skinning::Box box = skinning::clipBounds(character, &clip, {});
    for (const glm::dvec3& vertex : skinning::deformOnCpu(character, pose)) {
        for (int axis = 0; axis < 3; ++axis) {
            demand(vertex[axis] >= box.low[axis] - tolerance && vertex[axis] <= box.high[axis] + tolerance,
                   "a vertex outside the box of its clip");
        }
    }
}

void layer(const cage::Character& character, const skinning::Rig& rig, Tail& choose, skinning::PoseMemory& memory) {
    skinning::restPose(character, memory.pose);
    const skinning::RootSelection root{rig.root, choose.below(8)};
    skinning::RootMotion moved;
    for (int n = 0; n < 3; ++n) {
        const cage::Clip& clip = character.clips[choose.below(static_cast<uint32_t>(character.clips.size()))];
        skinning::Layer layer;
        layer.clip = &clip;
        layer.time = choose.time(clip.duration);
        layer.previousTime = choose.time(clip.duration);
        layer.weight = choose.weight();
        layer.loop = choose.below(2) == 1;
        skinning::applyLayer(character, rig, layer, root, memory.scratch, memory.pose);
        moved = skinning::layerRootMotion(character, rig, layer, root, moved);
        std::vector<skinning::PassedMarker> markers(4);
        (void)skinning::markersBetween(clip, {layer.previousTime, layer.time, layer.loop, n == 0}, markers);
    }
    demand(finite(memory.pose), "layers are not finite");
    demand(std::isfinite(moved.yaw) && std::isfinite(glm::dot(moved.translation, glm::dvec3(1.0))),
           "root motion is not finite");
}

/// What was set is read back, and is the same pose.
void play(const cage::Character& character, const skinning::Rig& rig, Tail& choose, skinning::PoseMemory& memory) {
    std::vector<skinning::PlaybackLayer> layers(1 + choose.below(2));
    for (skinning::PlaybackLayer& layer : layers) {
        layer.clip = choose.below(static_cast<uint32_t>(character.clips.size()));
        layer.loop = choose.below(2) == 1;
        layer.weight = choose.weight();
        layer.fadeWeight = choose.weight();
        layer.fadeDuration = choose.weight();
        layer.offset = choose.time(character.clips[layer.clip].duration);
        layer.speed = static_cast<float>(choose.below(9)) - 4.0f;
    }
    const skinning::ClipTable table = skinning::buildClipTable(character);
    const auto morphs = static_cast<uint32_t>(character.morphs.targets.size());
    std::vector<uint32_t> words(size_t{4} * skinning::PlaybackState::elements(morphs));
    skinning::PlaybackState state(words);
    state.set(character, table, {layers, {rig.root, choose.below(8)}, choose.below(2) == 1});
    skinning::PlaybackState::Layers memoryOfLayers;
    const skinning::PlaybackDesc read = state.read(table, memoryOfLayers);
    demand(read.layers.size() == layers.size(), "other layers");
    skinning::poseNodes(character, rig, read, choose.time(10.0), {}, memory);
}

/// Any nodes have any roles, of the clips' skeleton and of another one. What comes out is as clips of files are.
void retarget(const cage::Character& character, Tail& choose) {
    const auto count = static_cast<uint32_t>(character.skeleton.nodes.size());
    cage::ClipSet set;
    set.name = "clips";
    set.skeleton = character.skeleton;
    set.clips = character.clips;
    set.meshes.assign(count, cage::kNone);
    cage::Skeleton to = character.skeleton;
    for (cage::Node& node : to.nodes) {
        node.translation *= 0.5f + choose.weight();
        node.name += node.name.empty() || choose.below(2) == 0 ? "node" : "";
    }
    skinning::RetargetOptions options{skinning::Retargeting::all, {}, choose.below(2) == 1};
    for (skinning::Role role = 0; role < skinning::kRoles; ++role) {
        const uint32_t node = choose.below(count);
        options.pairs.push_back({role, character.skeleton.nodes[node].name, to.nodes[choose.below(count)].name});
    }
    for (const size_t side : {skinning::kLeft, skinning::kRight}) { // legs, more often than by chance
        uint32_t from = choose.below(count), own = choose.below(count);
        using skinning::BodyPart;
        for (const BodyPart part : {BodyPart::foot, BodyPart::shin, BodyPart::thigh}) {
            options.pairs.push_back(
                {skinning::roleOf(part, side), character.skeleton.nodes[from].name, to.nodes[own].name});
            from = character.skeleton.nodes[from].parent == cage::kNone ? from : character.skeleton.nodes[from].parent;
            own = to.nodes[own].parent == cage::kNone ? own : to.nodes[own].parent;
        }
    }
    try {
        skinning::fitClips(options, to, set);
    } catch (const cage::Refusal&) {
        return;
    }
    demand(set.isFitted && set.skeleton.nodes.size() == count, "neither fitted nor refused");
    for (const cage::Clip& clip : set.clips) {
        for (const cage::Channel& channel : clip.channels) {
            demand(channel.node < count && !channel.times.empty() &&
                       channel.values.size() == channel.width() * channel.times.size(),
                   "a channel of no node, or without values");
            demand(std::adjacent_find(channel.times.begin(), channel.times.end(), std::greater_equal<>()) ==
                       channel.times.end(),
                   "times that do not rise");
            demand(std::all_of(channel.values.begin(), channel.values.end(),
                               [](float v) { return std::abs(v) <= cage::kMaxCoordinate; }),
                   "a key beyond all limits");
        }
    }
}

/// What is packed keeps within its error, and is read as it was written.
void pack(const cage::Character& character, skinning::PoseMemory& memory) {
    cage::Character packed = character;
    (void)skinning::packClips(packed, 1e-3);
    const skinning::NodeOrder order = skinning::nodeOrder(packed);
    for (const cage::Clip& clip : packed.clips) {
        demand(clip.packed.error <= 1e-3, "the error is larger than was asked");
        if (!clip.packed.words.empty()) {
            demand(skinning::readPackedWords(clip.packed.words, clip.duration, {order.nodes.size(), order.targetCount})
                       .ok(),
                   "words that were written are refused");
        }
        skinning::sampleClip(packed, clip, 0.4 * clip.duration, memory.pose);
        demand(finite(memory.pose), "a sample of a packed clip is not finite");
    }
    (void)skinning::buildClipTable(packed);
}

} // namespace
} // namespace supple::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace supple;
    const Result<cage::Character> character = cage::readGltf(fuzz::bytesOf(data, size), "fuzz.glb", "", {});
    if (!character || character->clips.empty() || character->skeleton.nodes.size() > 100 ||
        character->cage.vertexCount() > 1000) {
        return 0;
    }
    fuzz::Tail choose(data, size);
    const skinning::Rig rig = skinning::makeRig(*character);
    skinning::PoseMemory memory(*character);
    const cage::Clip& clip = character->clips[choose.below(static_cast<uint32_t>(character->clips.size()))];
    skinning::sampleClip(*character, clip, std::clamp(choose.time(clip.duration), 0.0, clip.duration), memory.pose);
    fuzz::demand(fuzz::finite(memory.pose), "a sample is not finite");
    fuzz::demandInBox(*character, clip, memory.pose, memory);
    fuzz::layer(*character, rig, choose, memory);
    fuzz::play(*character, rig, choose, memory);
    if (std::all_of(character->clips.begin(), character->clips.end(),
                    [](const cage::Clip& own) { return own.duration < 10.0; })) {
        fuzz::pack(*character, memory);
    }
    fuzz::retarget(*character, choose);
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateGltf, data, size, most, seed);
}
