// What the viewer draws over its picture.
#pragma once

#include "tools/supple/view_stage.h"

#include <string>

namespace supple::tools {

/// Joints if they are wanted, and the legend of the view.
void drawOverPicture(const ViewStage& stage, float aspect);

/// A line in the middle of the window.
void drawAnnouncement(const std::string& text);

} // namespace supple::tools
