// What the viewer shows: one figure of a list of files, playing, seen by an orbiting camera.
#pragma once

#include "cage/character.h"
#include "host/surface_renderer.h"
#include "tools/common/tuned_file.h"
#include "tools/supple/render_stage.h"
#include "tools/supple/soft_overlay.h"
#include "tools/supple/time_history.h"
#include "tools/supple/view_look.h"
#include "tools/supple/view_playback.h"
#include "tools/supple/view_props.h"

#include <cstdint>
#include <future>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace supple::tools {

/// What the panel and the keys change.
struct ViewSettings {
    uint32_t clip = SUPPLE_REST_POSE;
    double time = 0.0;
    bool playing = true;
    float speed = 1.0f;
    int rate = 8;
    uint32_t view = 0;                            ///< host::shared::kView...
    uint32_t joint = 0;                           ///< whose weights kViewWeights shows
    bool joints = false;                          ///< drawn over the picture
    SoftShown soft;                               ///< likewise
    bool simulate = false;                        ///< springs swing, vertices jiggle, cloth hangs
    host::Tuning tuning;                          ///< of their numbers; the figure has it once it is tuned
    std::optional<host::TransitionMethod> change; ///< of clips, while one plays; none: at once
    float changeSeconds = 0.3f;
    uint32_t fadeClip = SUPPLE_REST_POSE; ///< blended over `clip`; none: SUPPLE_REST_POSE
    float fade = 0.5f;                    ///< its weight
    bool cageFaces = false;               ///< the cage instead of the surface
    bool cageOverlay = false;
    bool split = false;             ///< the cage beside the surface
    bool levels = false;            ///< of detail, instead of `rate`
    bool levelsFrozen = false;      ///< the camera that chooses them stays
    float chordError = kChordError; ///< with levels: pixels
    bool ground = true;
    Look look = Look::studio;
    Prop prop = Prop::none; ///< what a click attaches
    bool panel = true;      ///< shown
    bool keys = false;      ///< the help window
    bool timingsPaused = false;
    bool timingsByPart = false;
    float budgetMs = 0.0f; ///< of the passes together, a line in their graph; 0: none
    /// Of all targets, instead of those of the pose; empty: those of the pose.
    std::vector<float> morphWeights;
    std::vector<bool> shownParts; ///< of the figure

    bool operator==(const ViewSettings&) const = default;
};

class ViewStage {
public:
    [[nodiscard]] static Result<std::unique_ptr<ViewStage>>
    create(host::Context& context, host::SurfaceRenderer& renderer, const DrawOptions& options);

    /// Opens a file and makes it the one that is shown; on failure the old one stays. No frame may be pending.
    [[nodiscard]] Status open(const std::string& file, const std::string& clip, float aspect);
    [[nodiscard]] bool hasFigure() const { return group_ != nullptr; }
    [[nodiscard]] const host::Figure& figure() const { return *figure_; }
    [[nodiscard]] const host::FigureGroup& group() const { return *group_; }
    /// The figure's, by vertex of its cage.
    [[nodiscard]] const cage::SkinWeights& skinWeights() const { return file_->character.weights; }
    /// What was repaired or left out when the file was read.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
    /// The figure's morph targets by name.
    [[nodiscard]] const std::vector<host::NamedTargets>& morphs() const { return morphs_; }
    /// As the panel shows and sets it: in all parts.
    [[nodiscard]] float morphWeight(const host::NamedTargets& morph) const;
    void setMorphWeight(const host::NamedTargets& morph, float weight);
    [[nodiscard]] const TimeHistory& passTimes() const { return passTimes_; }
    /// What each part takes, and what the figure takes as a whole. Parts of one surface go through passes together: its
    /// time is shared out by how many of its patches they have.
    [[nodiscard]] const TimeHistory& partTimes() const { return partTimes_; }

    /// The rate the scheme makes of one that is asked for: with subdivision a power of two.
    [[nodiscard]] uint32_t offeredRate(uint32_t rate) const;
    [[nodiscard]] bool ratesArePowersOfTwo() const { return subdivides(scheme_); }
    [[nodiscard]] SuppleScheme scheme() const { return scheme_; }
    [[nodiscard]] SuppleSkinning skinning() const { return skinning_; }
    /// A group of the new kind takes the old one's place; the old one goes when its frames are completed. On failure it
    /// stays.
    [[nodiscard]] Status setRate(uint32_t rate, uint64_t lastFrame);
    [[nodiscard]] Status setScheme(SuppleScheme scheme, uint64_t lastFrame);
    [[nodiscard]] Status setSkinning(SuppleSkinning skinning, uint64_t lastFrame);
    /// Loads the figure anew with the numbers of settings.tuning. What swings begins at rest. Errors: the file is no
    /// glTF; then all stays as it was.
    [[nodiscard]] Status tune(uint64_t lastFrame);
    [[nodiscard]] const SoftFacts& softFacts() const { return softFacts_; }
    /// Lets go of what the completed frames used.
    void retire(uint64_t completedFrame);

    /// Puts something onto the surface. It stays there with all schemes and rates, until another file is opened. Waits
    /// for the device.
    [[nodiscard]] Status attach(const AttachedProp& what);
    /// Takes off what was attached last.
    [[nodiscard]] Status takeOff(uint64_t lastFrame);
    [[nodiscard]] const std::vector<AttachedProp>& attached() const { return attached_; }

    void advance(double seconds);
    /// The share of the picture, from the left, that a panel covers: figures are framed beside it.
    void setCovered(float share) { covered_ = share; }
    /// As at first: all that the clip reaches.
    void frameFigure(float aspect);
    /// From where the camera stands now.
    void fitFigure(float aspect);
    /// How far to the right the surface is moved in the picture, in widths of it.
    [[nodiscard]] float surfaceShift() const { return settings.split ? 0.25f * (1.0f - covered_) : 0.0f; }
    [[nodiscard]] const host::Camera& camera() const { return camera_; }
    /// The camera's target if no panel covered the picture when the figure was framed.
    [[nodiscard]] glm::vec3 centeredTarget() const;
    void orbit(float yaw, float pitch);
    /// In fractions of the picture's height.
    void pan(float right, float up);
    void zoom(float steps);

    /// What a frame shows: equal ones are the same picture.
    struct Shown {
        ViewSettings settings;
        host::Camera camera;
        host::Camera levelCamera;
        uint32_t version = 0;  ///< of the group
        uint32_t values = 0;   ///< counts measurements
        uint32_t attached = 0; ///< counts what was attached and taken off
        bool operator==(const Shown&) const = default;
    };
    [[nodiscard]] Shown shown() const;

    /// Whether the group should be one with levels, or without, or one that plays on the device, and is not.
    [[nodiscard]] bool needsOtherGroup() const;
    [[nodiscard]] Status changeGroup(uint64_t lastFrame);
    /// Whether the view shows values that are still to be measured: weights of another joint; distances and curvature
    /// in the pose in which the figure stands. While it plays, these stay those of the pose that was measured last.
    [[nodiscard]] bool needsValues() const;
    /// No frame may be pending. Afterwards poses are to be set anew. Distances and curvature take some seconds: they
    /// are measured beside the viewer's own work, and shown by a later call, unless it waits.
    [[nodiscard]] Status measureValues(bool wait);
    /// The pose in which values are, or are being measured.
    [[nodiscard]] std::string measuredPose() const;
    /// Joints in the picture, in fractions of it from its upper left; not where they are behind the eye.
    struct ShownJoint {
        bool seen = false;
        glm::vec2 at{0.0f};
    };
    [[nodiscard]] std::vector<ShownJoint> shownJoints(float aspect) const;
    /// Lines and dots of settings.soft over the picture, in fractions of it, as the frame before had the figure.
    [[nodiscard]] std::vector<PlacedStroke> shownStrokes(float aspect) const;

    /// Supple's passes of a frame. Levels are chosen for a picture of this height.
    [[nodiscard]] Status evaluate(VkCommandBuffer commands, uint64_t frame, uint64_t completedFrame, uint32_t height);
    [[nodiscard]] host::Scene scene(VkExtent2D extent) const;
    /// Both: Supple's passes, then the picture.
    [[nodiscard]] Status record(VkCommandBuffer commands, uint32_t slot, uint64_t frame, uint64_t completedFrame,
                                const host::DrawTarget& target);

    ViewSettings settings;

private:
    struct Retired {
        uint64_t frame = 0;
        std::unique_ptr<host::Figure> figure; ///< the group's, if it goes too
        std::unique_ptr<host::FigureGroup> group;
        host::FigureBinding binding;
        std::unique_ptr<host::Attachments> attachments;
    };

    ViewStage(host::Context& context, host::SurfaceRenderer& renderer) : context_(context), renderer_(renderer) {}
    [[nodiscard]] Result<std::unique_ptr<host::FigureGroup>> createGroup(host::Figure& figure, uint32_t rate,
                                                                         bool levels, bool plays) const;
    [[nodiscard]] Status remakeGroup(uint32_t rate, uint64_t lastFrame);
    /// All of attached_, on another group; none: null.
    [[nodiscard]] Result<std::unique_ptr<host::Attachments>> createAttachments(const host::FigureGroup& group) const;
    /// Of the clip that plays.
    [[nodiscard]] Extent reach() const;
    void readTimings();
    [[nodiscard]] Status readPartShares();
    /// Clip, time and crossfade, morph targets.
    [[nodiscard]] Status pose();
    [[nodiscard]] Status showParts() const;
    [[nodiscard]] Status chooseLevels(uint32_t height);
    [[nodiscard]] bool wantsLevels() const;
    [[nodiscard]] bool wantsPlayback() const;
    [[nodiscard]] bool wantsSimulation() const;
    /// What the settings ask to be measured.
    struct Values {
        uint32_t version = 0; ///< of the group; 0: nothing is measured
        uint32_t view = 0;
        uint32_t joint = 0; ///< weights
        // Measured views: the pose.
        uint32_t clip = 0, fadeClip = 0;
        double time = 0.0;
        float fade = 0.0f;
        std::vector<float> morphWeights;
        bool operator==(const Values&) const = default;
    };
    [[nodiscard]] Values wantedValues() const;
    [[nodiscard]] Status startMeasuring();
    [[nodiscard]] Status showMeasured();
    [[nodiscard]] Status bind();

    host::Context& context_;
    host::SurfaceRenderer& renderer_;
    SuppleScheme scheme_ = SUPPLE_SCHEME_AUTO;
    SuppleSkinning skinning_ = SUPPLE_SKINNING_LINEAR;
    SuppleCreaseMode creaseMode_ = SUPPLE_CREASES_CUT;
    float sharpThreshold_ = 1.0f;
    SuppleFragmentRules fragmentRules_ = SUPPLE_RULES_CATMULL_CLARK;
    SuppleUvInterpolation uvInterpolation_ = SUPPLE_UV_FROM_FILE;
    host::ReadOptions reading_;
    std::vector<host::MorphSetting> morphSettings_;
    std::vector<std::string> parts_; ///< shown at first; none: all
    std::vector<host::PartScheme> partSchemes_;
    bool sharedSamples_ = false;
    float covered_ = 0.0f;
    float aside_ = 0.0f; ///< how far the figure was framed beside the middle, in heights of the picture
    float startYaw_ = 0.0f;
    float startPitch_ = 0.0f;
    std::unique_ptr<host::Figure> figure_;
    std::shared_ptr<const host::CharacterFile> file_; ///< as it was read
    std::shared_ptr<const cage::Cage> cage_;          ///< its own
    SoftFacts softFacts_;
    std::vector<std::string> warnings_;
    std::vector<host::NamedTargets> morphs_;
    std::unique_ptr<host::FigureGroup> group_;
    host::FigureBinding binding_;
    std::vector<AttachedProp> attached_;
    uint32_t attachedChanges_ = 0;
    std::unique_ptr<host::Attachments> attachments_;   ///< of the group; null: none
    uint32_t version_ = 0;                             ///< counts groups
    uint32_t recordedVersion_ = 0;                     ///< of the group that a frame was recorded of
    Values values_;                                    ///< that the group has, or that are being measured
    std::future<Result<std::vector<float>>> measured_; ///< being computed
    uint32_t shownValues_ = 0;                         ///< counts measurements
    /// Before figure_ in time, so gone before it. A vector would move elements over those that go, and free a group
    /// before its attachments.
    std::list<Retired> retired_;
    ViewPlayback playback_;
    Extent extent_;                    ///< over all clips
    std::vector<size_t> measuredEnds_; ///< by clip: behind its poses in extent_; none: the rest pose was measured
    host::Camera camera_;
    host::Camera levelCamera_; ///< that levels are chosen by
    TimeHistory passTimes_;
    TimeHistory partTimes_;
    std::vector<std::vector<float>> partShares_; ///< of every surface, by part: they add up to 1
};

} // namespace supple::tools
