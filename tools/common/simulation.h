// What swings and jiggles, for a while before something is shown.
#pragma once

#include "base/result.h"
#include "host/context.h"

#include <supple/supple.h>

namespace supple::host {

/// A clip that loops, from a time to another: sets what the instance plays, then records frames of the group, all but
/// the last. No clip (SUPPLE_REST_POSE): the rest pose. The group plays, with SUPPLE_GROUP_SPRINGS or _SOFT, and no
/// frame is pending.
[[nodiscard]] Status simulate(Context& context, SuppleGroup group, SuppleInstance instance, uint32_t clip, double begin,
                              double time);

} // namespace supple::host
