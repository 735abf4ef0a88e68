// The viewer's panel and keys.
#pragma once

#include "host/window.h"
#include "tools/supple/file_browser.h"
#include "tools/supple/view_export.h"
#include "tools/supple/view_pick.h"
#include "tools/supple/view_stage.h"

#include <optional>
#include <string>
#include <vector>

namespace supple::tools {

struct PanelFile {
    std::string path;
    bool refused = false; ///< it could not be opened
};

struct PanelState {
    std::vector<PanelFile> files;
    size_t file = 0;     ///< the one that is shown, if one is
    std::string message; ///< the last failure
    std::string device;  ///< its name
    double frameMilliseconds = 0.0;
    bool timings = true;              ///< shown; they differ from run to run
    std::vector<host::KeyPress> keys; ///< that went down since the last frame
    LookStep step;                    ///< of the last frame
    FileBrowser browser;
    std::string exported; ///< what is being written, or was
    int exportSize[2] = {1280, 960};
    bool exportAlpha = false;
    std::vector<std::string> recent; ///< files that were opened last
    std::optional<ViewPick> picked;  ///< by the last click
};

/// What the user asked for that cannot be done while the panel is built.
struct PanelWishes {
    std::optional<std::string> file;
    std::optional<uint32_t> rate;
    std::optional<SuppleScheme> scheme;
    std::optional<SuppleSkinning> skinning;
    bool tune = false; ///< as the settings say
    std::optional<ExportWish> save;
    std::optional<glm::vec2> pick; ///< a place in the picture
    bool takeOff = false;          ///< what was attached last
    bool windowPicture = false;    ///< of the next frame, panel and all
    bool close = false;
};

/// Pixels from the left that the panel takes, when it is shown.
inline constexpr float kPanelRight = 332.0f;

/// The names and messages that the panel may show: what is not its own text.
[[nodiscard]] std::string panelText(const PanelState& state, const ViewStage& stage);

/// Builds the panel and moves the camera; changes the stage's settings in place.
[[nodiscard]] PanelWishes buildPanel(PanelState& state, ViewStage& stage, float aspect);

} // namespace supple::tools
