// What the viewer draws over its picture.
#pragma once

#include "tools/supple/view_stage.h"

namespace supple::tools {

/// Joints if they are wanted, and the legend of the view.
void drawOverPicture(const ViewStage& stage, float aspect);

} // namespace supple::tools
