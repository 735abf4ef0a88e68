// supple render: one picture of a character, or one of each scheme side by side.
#pragma once

#include "host/camera.h"
#include "tools/supple/render_options.h"
#include "tools/supple/session.h"

#include <glm/glm.hpp>
#include <string>

namespace supple::tools {

struct RenderOptions {
    std::string file;
    std::string output;            ///< .png
    std::string clip;              ///< name or index; empty is the bind pose
    double time = 0.0;             ///< seconds
    std::string size = "1280x960"; ///< WxH in pixels; of each picture where there are several
    double zoom = 1.0;             ///< how much larger than what fills the picture
    std::string at =
        "0.5,0.5";      ///< X,Y: what zoom keeps in the middle, in fractions of the whole picture from its upper left
    std::string eye;    ///< X,Y,Z: the camera stands here; empty: where the figure fills the picture
    std::string lookAt; ///< X,Y,Z: with `eye`
    std::string up = "0,1,0";  ///< X,Y,Z: with `eye`
    double fieldOfView = 27.0; ///< degrees from lower to upper edge; with `eye`
    DrawOptions draw;
};

/// What is left free on every side of a figure that fills the picture.
inline constexpr float kPictureMargin = 0.07f;

/// draw.scheme "all": a sheet of the schemes that take the cage, each drawn from the same place in the same light.
inline constexpr const char* kAllSchemes = "all";

/// "X,Y", both 0 to 1; false leaves x and y undefined.
[[nodiscard]] bool parsePlace(const std::string& text, double& x, double& y);

/// "X,Y,Z", all finite; false leaves the point undefined.
[[nodiscard]] bool parsePoint(const std::string& text, glm::vec3& point);

/// Draws the picture into its file.
[[nodiscard]] Status renderPicture(Session& session, const RenderOptions& options);

/// Draws the picture; returns the exit code and says why on stderr when it is not kExitOk.
int runRender(const RenderOptions& options);

} // namespace supple::tools
