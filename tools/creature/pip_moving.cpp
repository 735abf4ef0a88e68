#include "pip_moving.h"

#include "assemble.h"
#include "mixing.h"
#include "springs.h"

#include <glm/geometric.hpp>

namespace supple::creature {

void addMoving(const Cage& model, const Skeleton& skeleton, cage::Character& character) {
    Springs springs(skeleton, character);
    const uint32_t ground = springs.addColliders({});
    springs.addPlane(ground, "root", {0, 0, 0}, {0, 1, 0});
    // Clips move ears and tail already: these follow, and run on.
    for (const std::string side : {".L", ".R"}) {
        springs.add("ear" + side, {"ear" + side, "earTip" + side, "earEnd" + side}, {},
                    {.stiffness = 1.1f, .gravityPower = 0.08f, .drag = 0.16f}, 0.7f);
    }
    std::vector<std::string> tail = skeleton.links("tail").joints;
    tail.push_back("tailEnd");
    springs.add("tail", tail, {ground}, {.hitRadius = 0.05f, .stiffness = 2.0f, .gravityPower = 0.1f, .drag = 0.25f},
                0.85f);
    character.jiggles = {{.frequency = 2.8f, .damping = 0.15f, .limit = 0.06f}};
    for (const Point& point : model.points) {
        const Vec3 belly{0, 0.55, 0.24};
        const float weight = rounded(ramp(0.30, 0.06, glm::length(point.position - belly)));
        const bool isBody = point.part == Part::Belly || point.part == Part::Torso;
        character.weights.jiggles.push_back(isBody && weight > 0 ? cage::PaintedWeight{0, weight}
                                                                 : cage::PaintedWeight{});
    }
}

} // namespace supple::creature
