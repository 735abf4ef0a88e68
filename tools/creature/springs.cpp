#include "springs.h"

#include "assemble.h"

namespace supple::creature {

uint32_t Springs::addColliders(const std::vector<Capsule>& capsules) {
    std::vector<uint32_t>& group = bones.colliderGroups.emplace_back();
    for (const Capsule& capsule : capsules) {
        const int joint = skeleton.index(capsule.joint);
        const Vec3 rest = skeleton.joints[static_cast<size_t>(joint)].rest;
        cage::SpringCollider collider{.node = static_cast<uint32_t>(joint), .shape = cage::ColliderShape::capsule};
        collider.offset = rounded(capsule.from - rest);
        collider.tail = rounded(capsule.to - rest);
        collider.radius = rounded(capsule.radius);
        group.push_back(static_cast<uint32_t>(bones.colliders.size()));
        bones.colliders.push_back(collider);
    }
    return static_cast<uint32_t>(bones.colliderGroups.size() - 1);
}

void Springs::add(const std::string& name, const std::vector<uint32_t>& colliderGroups, const cage::SpringJoint& first,
                  float softer) {
    cage::Spring spring;
    spring.name = name;
    spring.colliderGroups = colliderGroups;
    cage::SpringJoint joint = first;
    for (const std::string& link : skeleton.links(name).joints) {
        joint.node = static_cast<uint32_t>(skeleton.index(link));
        spring.joints.push_back(joint);
        joint.stiffness *= softer;
    }
    joint.node = static_cast<uint32_t>(skeleton.index(name + "End"));
    spring.joints.push_back(joint);
    bones.springs.push_back(spring);
}

} // namespace supple::creature
