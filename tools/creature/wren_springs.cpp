#include "wren_springs.h"

#include "springs.h"
#include "wren.h"

namespace supple::creature::wren {

void addSprings(const Skeleton& skeleton, cage::Character& character) {
    Springs springs(skeleton, character);
    const Vec3 right{-1, 1, 1};
    const uint32_t back = springs.addColliders({
        {"spine", {0, 1.06, -0.010}, {0, 0.97, -0.006}, 0.095},
        {"hips", {-0.083, 0.945, -0.108}, {-0.086, 0.905, -0.114}, 0.052}, // the pouch
        {"skirtBack.L", {0.045, 0.90, -0.030}, {0.062, 0.72, -0.066}, 0.092},
        {"skirtBack.R", {-0.045, 0.90, -0.030}, {-0.062, 0.72, -0.066}, 0.092},
        {"upperArm.R", kShoulder * right, kElbow * right, 0.066},
        {"foreArm.R", kElbow * right, kWrist * right, 0.060},
    });
    springs.addPlane(back, "chest", {0, 1.12, -0.108}, {0, 0, -1});
    const uint32_t skull = springs.addColliders({
        {"head", {0, 1.62, -0.035}, {0, 1.55, -0.035}, 0.135},
        {"neck", {0, 1.33, -0.010}, {0, 1.27, -0.012}, 0.085},
    });
    const uint32_t legAndHand = springs.addColliders({
        {"thigh.R", kThigh * right, kKnee * right, 0.085},
        {"hand.R", kWrist * right, kKnuckles * right, 0.050},
    });
    const auto add = [&](const std::string& name, const std::vector<uint32_t>& colliders,
                         const cage::SpringJoint& first, float softer) {
        std::vector<std::string> joints = skeleton.links(name).joints;
        joints.push_back(name + "End");
        springs.add(name, joints, colliders, first, softer);
    };
    // Stiff at the root and loose at the tip, so that a swing runs down like a wave. Gravity is the earth's.
    add("ponytail", {skull, back}, {.hitRadius = 0.03f, .stiffness = 0.75f, .gravityPower = 0.16f, .drag = 0.2f},
        0.55f);
    add("scarf", {back}, {.hitRadius = 0.018f, .stiffness = 0.16f, .gravityPower = 0.16f, .drag = 0.14f}, 0.6f);
    for (const Pouch& pouch : kPouches) {
        add(pouch.name, {legAndHand}, {.hitRadius = 0.03f, .stiffness = 1.2f, .gravityPower = 0.16f, .drag = 0.18f},
            1.0f);
    }
}

} // namespace supple::creature::wren
