// Constants of P_3, P_4 and P_5 (docs/pm.md, section on patches): mu = 1 - cos(2 pi / m), the ray weights k0 = 1 / (2 mu) and
// k1 = 1 - 2 k0 of (3), the centre weight w_m of (20).
#include "shaders/shared/pm.h"

layout(constant_id = kKindConstant) const uint kClass = kP3Patch;

const uint kSides = kClass == kP5Patch ? 5u : kClass == kP4Patch ? 4u : 3u;
const float kMu = kClass == kP5Patch ? 0.6909830056250526 : kClass == kP4Patch ? 1.0 : 1.5;
const float kRaySide = SUPPLE_PM_RAY_SIDE(kSides);
const float kRayMiddle = SUPPLE_PM_RAY_MIDDLE(kSides);
const float kCentreWeight = kClass == kP5Patch ? -3.0 : kClass == kP4Patch ? 1.0 : 2.0;
const float kCentreScale = kClass == kP5Patch ? 1.0 / 60.0 : kClass == kP4Patch ? 1.0 / 64.0 : 1.0 / 51.0; // 1 / (m (15 + w_m))
const float kD = -0.8090169943749475; // cos 144 degrees, (22)
