#include "springs.h"

#include "assemble.h"

namespace supple::creature {

uint32_t Springs::addColliders(const std::vector<Capsule>& capsules) {
    bones.colliderGroups.emplace_back();
    const auto group = static_cast<uint32_t>(bones.colliderGroups.size() - 1);
    for (const Capsule& capsule : capsules) {
        cage::SpringCollider& collider = addCollider(group, capsule.joint, cage::ColliderShape::capsule, capsule.from);
        collider.tail = rounded(capsule.to - restOf(capsule.joint));
        collider.radius = rounded(capsule.radius);
    }
    return group;
}

void Springs::addPlane(uint32_t group, const std::string& joint, const Vec3& at, const Vec3& normal) {
    addCollider(group, joint, cage::ColliderShape::plane, at).tail = rounded(normal);
}

cage::SpringCollider& Springs::addCollider(uint32_t group, const std::string& joint, cage::ColliderShape shape,
                                           const Vec3& at) {
    bones.colliderGroups[group].push_back(static_cast<uint32_t>(bones.colliders.size()));
    cage::SpringCollider& collider = bones.colliders.emplace_back();
    collider.node = static_cast<uint32_t>(skeleton.index(joint));
    collider.shape = shape;
    collider.offset = rounded(at - restOf(joint));
    return collider;
}

Vec3 Springs::restOf(const std::string& joint) const {
    return skeleton.joints[static_cast<size_t>(skeleton.index(joint))].rest;
}

void Springs::add(const std::string& name, const std::vector<std::string>& joints,
                  const std::vector<uint32_t>& colliderGroups, const cage::SpringJoint& first, float softer) {
    cage::Spring spring;
    spring.name = name;
    spring.colliderGroups = colliderGroups;
    cage::SpringJoint joint = first;
    for (const std::string& link : joints) {
        joint.node = static_cast<uint32_t>(skeleton.index(link));
        spring.joints.push_back(joint);
        joint.stiffness = rounded(joint.stiffness * softer);
    }
    bones.springs.push_back(spring);
}

} // namespace supple::creature
