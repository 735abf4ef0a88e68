// Springs of a character that is modelled in code.
#pragma once

#include "skeleton.h"

#include "cage/character.h"

#include <string>
#include <vector>

namespace supple::creature {

// A capsule that goes with a joint, between two places of the model at rest.
struct Capsule {
    std::string joint;
    Vec3 from, to;
    double radius;
};

class Springs {
public:
    Springs(const Skeleton& skeleton, cage::Character& character) : skeleton(skeleton), bones(character.springBones) {}

    // A group of them; returns its number.
    uint32_t addColliders(const std::vector<Capsule>& capsules);
    // A plane that goes with a joint, at a place of the model at rest: nothing of the group's springs gets behind it.
    void addPlane(uint32_t group, const std::string& joint, const Vec3& at, const Vec3& normal);
    // A chain of joints, of which the last one is an end alone. Each has `softer` times the stiffness of the one
    // before.
    void add(const std::string& name, const std::vector<std::string>& joints,
             const std::vector<uint32_t>& colliderGroups, const cage::SpringJoint& first, float softer);

private:
    cage::SpringCollider& addCollider(uint32_t group, const std::string& joint, cage::ColliderShape shape,
                                      const Vec3& at);
    Vec3 restOf(const std::string& joint) const;

    const Skeleton& skeleton;
    cage::SpringBones& bones;
};

} // namespace supple::creature
