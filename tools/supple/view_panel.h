// The viewer's panel and keys.
#pragma once

#include "tools/supple/view_stage.h"

#include <optional>
#include <string>
#include <vector>

namespace supple::tools {

struct PanelState {
    const std::vector<std::string>& files;
    std::vector<bool> refused; ///< per file: it could not be opened
    size_t file = 0;           ///< the one that is shown
    std::string message;       ///< the last failure
    std::string device;        ///< its name
    double frameMilliseconds = 0.0;
    bool timings = true; ///< shown; they differ from run to run
};

/// What the user asked for that cannot be done while the panel is built.
struct PanelWishes {
    std::optional<size_t> file;
    std::optional<uint32_t> rate;
    std::optional<SuppleScheme> scheme;
    std::optional<SuppleSkinning> skinning;
    bool close = false;
};

/// Pixels from the left that the panel takes, when it is shown.
inline constexpr float kPanelRight = 332.0f;

/// Builds the panel and moves the camera; changes the stage's settings in place.
[[nodiscard]] PanelWishes buildPanel(const PanelState& state, ViewStage& stage, float aspect);

} // namespace supple::tools
