// One character on the studio's floor, ready to be drawn at any clip and time: what render and the contact sheet share.
#pragma once

#include "cage/character.h"
#include "host/ray_scene.h"
#include "host/surface_renderer.h"
#include "tools/supple/measured_views.h"
#include "tools/supple/render_options.h"
#include "tools/supple/session.h"
#include "tools/supple/soft_overlay.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace supple::tools {

/// host::shared::kView... of a view's name.
[[nodiscard]] Result<uint32_t> parseView(const std::string& name);
/// The size of a picture, or of a cell of a sheet, and its view.
struct PictureKind {
    VkExtent2D size{};
    uint32_t view = 0;
};
/// `option`: what gives the size. The error names the option that is wrong.
[[nodiscard]] Result<PictureKind> parsePicture(const char* option, const std::string& size, const std::string& view);
[[nodiscard]] DeviceFlags deviceFlags(const DrawOptions& options);
[[nodiscard]] float radians(double degrees);
/// Lines keep their weight when a picture is drawn larger or smaller, and small pictures have fewer stripes of the
/// zebra, so that they can be told apart.
void fitToPixels(host::Scene& scene, VkExtent2D extent);

struct ClipTime {
    uint32_t clip = SUPPLE_REST_POSE;
    double time = 0.0;
    std::optional<host::PlannedTransition> transition; ///< at `time`, instead of the clip; of groups that play
    std::optional<double>
        since; ///< when the clip, which loops, has begun to play, where springs swing; none: at `time`
};
/// `count` times spread evenly over the clip, both ends among them; the bind pose once.
[[nodiscard]] std::vector<ClipTime> spreadTimes(const host::Figure& figure, uint32_t clip, uint32_t count);

/// Where a figure is over a number of poses.
struct Extent {
    std::vector<glm::vec3> points;     ///< of all poses; what a camera has to hold
    std::vector<glm::vec3> cagePoints; ///< if the cage may stand beside the surface
    host::Bounds bounds;               ///< of points

    /// Also of the cage, if it is shown beside.
    [[nodiscard]] std::vector<glm::vec3> framed(bool split) const;
};

/// Evaluates every pose in turn and notes where the surface (or the cage) is. `beside`: the cage as well, in
/// Extent::cagePoints. No frame may be pending.
[[nodiscard]] Result<Extent> measureGroup(host::FigureGroup& group, std::span<const ClipTime> poses, bool cage,
                                          bool beside);

class Stage {
public:
    [[nodiscard]] static Result<std::unique_ptr<Stage>> open(Session& session, const std::string& file, VkExtent2D size,
                                                             const DrawOptions& options);
    /// Opens a character that was read, or made.
    [[nodiscard]] static Result<std::unique_ptr<Stage>> open(Session& session, host::CharacterFile character,
                                                             VkExtent2D size, const DrawOptions& options);

    [[nodiscard]] const host::Figure& figure() const { return *figure_; }
    /// That the options name.
    [[nodiscard]] Result<std::optional<host::PlannedTransition>> transition() const;

    /// Poses the figure in every pose in turn.
    [[nodiscard]] Result<Extent> measure(std::span<const ClipTime> poses, bool cage) {
        pose_ = poses.back();
        return measureGroup(*group_, poses, cage, options_.split);
    }
    [[nodiscard]] Status pose(const ClipTime& pose);
    /// Draws the figure as it was posed last; group and binding of the scene are filled in here.
    /// alpha: nothing stands behind it; shadows on the floor are there.
    [[nodiscard]] Result<host::Picture> draw(host::Scene scene, bool alpha = false);

private:
    [[nodiscard]] Result<host::Picture> drawPasses(host::Scene scene);
    Stage(Session& session, const DrawOptions& options) : session_(session), options_(options) {}
    [[nodiscard]] Status openRays();
    /// Structures of the figure as it is posed.
    [[nodiscard]] Status buildRays();
    [[nodiscard]] Status openRenderer(VkExtent2D size);
    [[nodiscard]] Result<std::unique_ptr<host::FigureGroup>> createGroup(bool levels) const;
    [[nodiscard]] Status bind();
    /// What the view shows of the figure as it is posed: levels for this camera, or what is measured.
    [[nodiscard]] Status prepare(const host::Scene& scene);
    [[nodiscard]] Status chooseLevels(const host::Scene& scene);
    void drawLegendOf(uint32_t view, host::Picture& picture) const;
    [[nodiscard]] Status drawSoft(const host::Scene& scene, host::Picture& picture) const;

    Session& session_;
    const DrawOptions options_;
    std::unique_ptr<host::Figure> figure_;
    std::unique_ptr<host::FigureGroup> group_;
    std::unique_ptr<host::FigureGroup> levels_; ///< is drawn instead of group_, if levels are wanted
    std::optional<cage::Cage> cage_;            ///< if the view is measured
    SoftFacts softFacts_;
    SurfaceRules rules_;
    uint32_t joint_ = 0; ///< whose weights are shown
    ClipTime pose_;
    std::unique_ptr<host::RayGroup> rayGroup_; ///< if it is traced
    std::unique_ptr<host::RayScene> rayScene_;
    std::vector<uint32_t> hiddenParts_; ///< of its rays
    std::unique_ptr<host::SurfaceRenderer> renderer_;
    host::FigureBinding binding_; ///< of the group that is drawn
    host::DrawTarget target_;
};

} // namespace supple::tools
