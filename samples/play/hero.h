// Supple in this sample: a context, a group of one character, whose clips the device plays, and what modifies them.
#pragma once

#include "body.h"

#include "host/graph.h"

#include <glm/gtc/quaternion.hpp>
#include <span>
#include <string>
#include <string_view>
#include <supple/supple.hpp>
#include <vector>

namespace play {

using namespace supple::host;

struct HeroOptions {
    uint32_t rate = 4;
    std::string record;         ///< a file for a recording, or empty
    bool bareRecording = false; ///< which names the character by its hash
};

/// How a clip begins.
struct Start {
    double offset = 0.0; ///< seconds of the clip
    float speed = 1.0f;
    bool loops = true;
    double transition = 0.0; ///< seconds in which it takes over from what was shown
    SuppleTransitionKind kind = SUPPLE_TRANSITION_DEAD_BLENDING;
    bool fromModified = false; ///< from what modifiers have made of that
};

class Hero {
public:
    Hero(Device& device, const HeroOptions& options);

    void beginFrame(uint64_t frame, uint64_t completed) const;
    /// buffers: what Supple writes for drawing.
    void addToGraph(Graph& graph, Resource buffers) const;

    /// All that follows happens at this time.
    void setTime(double time);
    [[nodiscard]] double time() const { return time_; }
    void play(std::string_view clip, const Start& start) const;
    [[nodiscard]] double duration(std::string_view clip) const;
    /// Units a second that the ground goes under the feet of a clip that walks on the spot.
    [[nodiscard]] float groundSpeed(std::string_view clip) const;
    void setTransform(const glm::mat4& transform);
    [[nodiscard]] const glm::mat4& transform() const { return transform_; }
    void setModifiers(std::span<const SuppleModifier> modifiers) const;
    /// What a kind of modifier does not need is not looked at.
    void setTarget(uint32_t modifier, float weight, const glm::vec3& point,
                   const glm::quat& rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f)) const;

    /// One for each of kJoints.
    [[nodiscard]] uint32_t joint(Point point) const { return joints_[point]; }
    /// In the world, as the next frame shows it.
    [[nodiscard]] glm::mat4 jointTransform(Point point) const;
    [[nodiscard]] BodyPose pose() const;

    [[nodiscard]] bool isShown(uint32_t part) const { return part != hidden_; }
    [[nodiscard]] const supple::Asset& asset() const { return asset_; }
    [[nodiscard]] const supple::Group& group() const { return group_; }

private:
    [[nodiscard]] uint32_t findClip(std::string_view name) const;
    [[nodiscard]] uint32_t findJoint(std::string_view name) const;
    void hideSword();

    supple::Context context_;
    supple::Asset asset_;
    supple::Group group_;
    supple::Instance instance_;
    std::array<uint32_t, kJoints> joints_{};
    uint32_t hidden_ = UINT32_MAX; ///< part
    glm::mat4 transform_{1.0f};
    double time_ = 0.0;
};

} // namespace play
