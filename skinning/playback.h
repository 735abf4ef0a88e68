// What an instance plays on the device: its layers over the group's time, in the layout of shaders/shared/pose.h.
#pragma once

#include "cage/character.h"
#include "shaders/shared/pose.h"
#include "skinning/clip_table.h"
#include "skinning/layers.h"
#include "skinning/root_motion.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// A layer of skinning/layers.h whose time and weight follow from the group's time T: time = offset + speed * (T -
/// start), weight from `weight` to `fadeWeight` while T goes from fadeStart to fadeStart + fadeDuration.
struct PlaybackLayer {
    uint32_t clip = 0;
    LayerMode mode = LayerMode::blend;
    bool loop = false;
    uint32_t mask = 0; ///< 0: none; mask m is the m-th of those that were given
    float weight = 1.0f;
    float fadeWeight = 0.0f;
    double fadeStart = 0.0;
    float fadeDuration = 0.0f; ///< 0: the weight stands
    double start = 0.0;
    double offset = 0.0;
    float speed = 1.0f;
    double referenceTime = 0.0;
};

struct PlaybackDesc {
    std::span<const PlaybackLayer> layers; ///< at most shared::kMaxPlaybackLayers
    RootSelection root;
    bool travels = false; ///< the first layer's root motion goes into the instance's transform
};

/// An instance's state, `stateStride` elements of four words.
class PlaybackState {
public:
    explicit PlaybackState(std::span<uint32_t> words) : words_(words) {}

    void setBindPose();
    void set(const cage::Character& character, const ClipTable& table, const PlaybackDesc& desc);
    void setTransform(const glm::mat4& transform);
    void setMorphWeights(const float* weights, size_t count); ///< null: the clips' own again
    /// Of states with room for them: how many modifiers (skinning/modifiers.h) are executed, and the words of one.
    void setModifierCount(uint32_t count);
    [[nodiscard]] uint32_t modifierCount() const;
    [[nodiscard]] std::span<uint32_t> modifier(uint32_t morphCount, uint32_t index) const;

    /// Layers name the masks of the last frame: those behind all.
    void nameMasksBefore();

    /// Whether it is in a transition, whose words (skinning/transition.h) the state has. set() and setBindPose() end
    /// it.
    void setInTransition(bool isInIt);
    [[nodiscard]] bool isInTransition() const;

    /// Null if none are set: what setMorphWeights() got.
    [[nodiscard]] const float* morphWeights() const;

    // What the device reads.
    [[nodiscard]] bool inBindPose() const;
    [[nodiscard]] glm::mat4 transform() const;
    using Layers = std::array<PlaybackLayer, shared::kMaxPlaybackLayers>;
    /// What was set; not of the bind pose. `layers` is memory for its layers. Offsets of loops lie within the clip.
    [[nodiscard]] PlaybackDesc read(const ClipTable& table, Layers& layers) const;

    /// With `modifierCount` modifiers behind the rest.
    [[nodiscard]] static uint32_t elements(uint32_t morphCount, uint32_t modifierCount = 0);

private:
    void put(uint32_t element, float x, float y, float z, float w);
    [[nodiscard]] glm::vec4 floats(uint32_t element) const;
    void setTravel(const cage::Character& character, const PlaybackLayer& layer, const RootSelection& root);

    std::span<uint32_t> words_;
};

/// One run of the masks, `maskElements` elements: see fillJointMask for what stands in jointMask; an empty mask means
/// what it means in Layer.
[[nodiscard]] uint32_t maskElements(const ClipTable& table);
void writeMask(const ClipTable& table, const Rig& rig, std::span<const float> jointMask,
               std::span<const float> morphMask, std::span<float> values);
/// The morph targets' values within a run of the masks.
[[nodiscard]] std::span<const float> morphMaskOf(const ClipTable& table, std::span<const float> values);

} // namespace supple::skinning
