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
    // The chain of a name, which ends at the joint "nameEnd". Each joint is by `softer` less stiff than the one before.
    void add(const std::string& name, const std::vector<uint32_t>& colliderGroups, const cage::SpringJoint& first,
             float softer);

private:
    const Skeleton& skeleton;
    cage::SpringBones& bones;
};

} // namespace supple::creature
