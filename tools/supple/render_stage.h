// One character on the studio's floor, ready to be drawn at any clip and time: what render and the contact sheet share.
#pragma once

#include "host/surface_renderer.h"
#include "tools/supple/render_options.h"
#include "tools/supple/session.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace supple::tools {

/// "WxH".
[[nodiscard]] Result<VkExtent2D> parseSize(const std::string& text);
/// host::shared::kView... of a view's name.
[[nodiscard]] Result<uint32_t> parseView(const std::string& name);
[[nodiscard]] DeviceFlags deviceFlags(const DrawOptions& options);
[[nodiscard]] float radians(double degrees);
/// Lines keep their weight when a picture is drawn larger or smaller.
[[nodiscard]] float pixelScale(VkExtent2D extent);

struct ClipTime {
    uint32_t clip = SUPPLE_REST_POSE;
    double time = 0.0;
};
/// `count` times spread evenly over the clip, both ends among them; the bind pose once.
[[nodiscard]] std::vector<ClipTime> spreadTimes(const host::Figure& figure, uint32_t clip, uint32_t count);

/// Where a figure is over a number of poses.
struct Extent {
    std::vector<glm::vec3> points; ///< of all poses; what a camera has to hold
    host::Bounds bounds;
};

/// Evaluates every pose in turn and notes where the surface (or the cage) is. No frame may be pending.
[[nodiscard]] Result<Extent> measureGroup(host::FigureGroup& group, std::span<const ClipTime> poses, bool cage);

class Stage {
public:
    [[nodiscard]] static Result<std::unique_ptr<Stage>> open(Session& session, const std::string& file, VkExtent2D size,
                                                             const DrawOptions& options);

    [[nodiscard]] const host::Figure& figure() const { return *figure_; }

    [[nodiscard]] Result<Extent> measure(std::span<const ClipTime> poses, bool cage) {
        return measureGroup(*group_, poses, cage);
    }
    [[nodiscard]] Status pose(const ClipTime& pose);
    /// Draws the figure as it is posed; group and binding of the scene are filled in here.
    /// alpha: nothing stands behind it; shadows on the floor are there.
    [[nodiscard]] Result<host::Picture> draw(host::Scene scene, bool alpha = false);

private:
    [[nodiscard]] Result<host::Picture> drawPasses(host::Scene scene);
    explicit Stage(Session& session) : session_(session) {}

    Session& session_;
    std::unique_ptr<host::Figure> figure_;
    std::unique_ptr<host::FigureGroup> group_;
    std::unique_ptr<host::SurfaceRenderer> renderer_;
    host::FigureBinding binding_;
    host::DrawTarget target_;
};

} // namespace supple::tools
