#include "wren_springs.h"

#include "springs.h"
#include "wren.h"

namespace supple::creature::wren {

void addSprings(const Skeleton& skeleton, cage::Character& character) {
    Springs springs(skeleton, character);
    const uint32_t back = springs.addColliders({
        {"chest", {0, 1.21, -0.022}, {0, 1.10, -0.016}, 0.095},
        {"spine", {0, 1.06, -0.010}, {0, 0.97, -0.006}, 0.090},
        {"skirtBack.L", {0.045, 0.90, -0.030}, {0.062, 0.72, -0.066}, 0.092},
        {"skirtBack.R", {-0.045, 0.90, -0.030}, {-0.062, 0.72, -0.066}, 0.092},
        {"upperArm.L", kShoulder, kElbow, 0.060},
        {"upperArm.R", kShoulder * Vec3{-1, 1, 1}, kElbow * Vec3{-1, 1, 1}, 0.060},
    });
    const uint32_t skull = springs.addColliders({
        {"head", grown({0, 1.50, -0.035}), grown({0, 1.45, -0.035}), 0.135},
        {"neck", {0, 1.33, -0.010}, {0, 1.27, -0.012}, 0.085},
    });
    const uint32_t legs = springs.addColliders({
        {"thigh.R", kThigh * Vec3{-1, 1, 1}, kKnee * Vec3{-1, 1, 1}, 0.085},
    });
    // Heavy at the root, lighter to the tip, so that a swing runs down it like a wave.
    springs.add("ponytail", {skull, back}, {.hitRadius = 0.030f, .stiffness = 0.55f, .gravityPower = 0.16f, .drag = 0.12f}, 0.55f);
    springs.add("scarf", {back, skull}, {.hitRadius = 0.018f, .stiffness = 0.16f, .gravityPower = 0.16f, .drag = 0.10f}, 0.6f);
    for (const Pouch& pouch : kPouches) {
        springs.add(pouch.name, {legs}, {.hitRadius = 0.030f, .stiffness = 1.2f, .gravityPower = 0.16f, .drag = 0.18f}, 1.0f);
    }
}

} // namespace supple::creature::wren
