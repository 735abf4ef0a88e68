#include "tools/gltf/spring_writer.h"

#include "cage/skeleton.h"
#include "cage/spring_tails.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace supple::cage::gltf {
namespace {

constexpr const char* kSprings = "VRMC_springBone";
constexpr const char* kMoreColliders = "VRMC_springBone_extended_collider";

bool isExtended(const SpringCollider& collider) {
    return collider.inside || collider.shape == ColliderShape::plane;
}

json shapeOf(const SpringCollider& collider) {
    if (collider.shape == ColliderShape::plane) {
        return {{"plane", {{"offset", numbers(collider.offset)}, {"normal", numbers(collider.tail)}}}};
    }
    const bool capsule = collider.shape == ColliderShape::capsule;
    json shape = {{"offset", numbers(collider.offset)}, {"radius", collider.radius}};
    if (capsule) {
        shape["tail"] = numbers(collider.tail);
    }
    if (collider.inside) {
        shape["inside"] = true;
    }
    return {{capsule ? "capsule" : "sphere", std::move(shape)}};
}

json writeCollider(const SpringCollider& collider) {
    json written = {{"node", collider.node}};
    if (isExtended(collider)) {
        // Who does not know the extension has a sphere that nothing meets.
        written["shape"] = {{"sphere", {{"offset", json::array({0, -10000, 0})}, {"radius", 0}}}};
        written["extensions"][kMoreColliders] = {{"specVersion", "1.0"}, {"shape", shapeOf(collider)}};
    } else {
        written["shape"] = shapeOf(collider);
    }
    return written;
}

json writeJoint(const SpringJoint& joint) {
    return {{"node", joint.node},
            {"hitRadius", joint.hitRadius},
            {"stiffness", joint.stiffness},
            {"gravityPower", joint.gravityPower},
            {"gravityDir", numbers(joint.gravityDirection)},
            {"dragForce", joint.drag}};
}

json writeSpring(const Spring& spring, json joints) {
    json written = {{"joints", std::move(joints)}};
    if (!spring.name.empty()) {
        written["name"] = spring.name;
    }
    if (spring.center != kNone) {
        written["center"] = spring.center;
    }
    if (!spring.colliderGroups.empty()) {
        written["colliderGroups"] = spring.colliderGroups;
    }
    return written;
}

/// Springs of VRM 0.x as chains.
class Trees {
public:
    Trees(const Skeleton& skeleton, json& nodes)
        : skeleton_(skeleton), nodes_(nodes), firstChild_(firstChildren(skeleton)),
          jointOf_(skeleton.nodes.size(), kNoJoint), places_(restPlaces(skeleton)) {}

    void write(const Spring& spring, json& springs) {
        for (size_t j = 0; j < spring.joints.size(); ++j) {
            jointOf_[spring.joints[j].node] = j;
        }
        std::vector<bool> written(spring.joints.size());
        for (size_t j = 0; j < spring.joints.size(); ++j) {
            if (written[j]) {
                continue;
            }
            json joints = json::array();
            size_t last = j;
            for (size_t next = j; next != kNoJoint; next = childOf(spring.joints[last])) {
                joints.push_back(writeJoint(spring.joints[next]));
                written[next] = true;
                last = next;
            }
            if (const uint32_t tail = addTail(spring.joints[last].node); tail != kNone) {
                joints.push_back({{"node", tail}});
            }
            springs.push_back(writeSpring(spring, std::move(joints)));
        }
        for (const SpringJoint& joint : spring.joints) {
            jointOf_[joint.node] = kNoJoint;
        }
    }

private:
    static constexpr size_t kNoJoint = std::numeric_limits<size_t>::max();

    /// The joint that is the tail of another, or kNoJoint: it is none of the spring.
    [[nodiscard]] size_t childOf(const SpringJoint& joint) const {
        const uint32_t child = firstChild_[joint.node];
        return child != kNone ? jointOf_[child] : kNoJoint;
    }

    /// A node at the tail of a chain's last joint; kNone if it has none, and so does not swing.
    uint32_t addTail(uint32_t node) {
        const std::optional<glm::dvec3> tail = tailInTree(skeleton_, firstChild_, places_, node);
        if (!tail || *tail == glm::dvec3(places_[node][3]) || glm::determinant(places_[node]) == 0.0) {
            return kNone;
        }
        const auto added = static_cast<uint32_t>(nodes_.size());
        const glm::vec3 offset(glm::inverse(places_[node]) * glm::dvec4(*tail, 1.0));
        nodes_.push_back({{"name", skeleton_.nodes[node].name + "_tail"}, {"translation", numbers(offset)}});
        nodes_[node]["children"].push_back(added);
        return added;
    }

    const Skeleton& skeleton_;
    json& nodes_;
    std::vector<uint32_t> firstChild_; ///< by node
    std::vector<size_t> jointOf_;      ///< by node: the number in the spring that is written
    std::vector<glm::dmat4> places_;
};

json writeSprings(const Character& character, json& root) {
    json list = json::array();
    Trees trees(character.skeleton, root["nodes"]);
    for (const Spring& spring : character.springBones.springs) {
        if (spring.isTree) {
            trees.write(spring, list);
            continue;
        }
        json joints = json::array();
        for (const SpringJoint& joint : spring.joints) {
            joints.push_back(writeJoint(joint));
        }
        list.push_back(writeSpring(spring, std::move(joints)));
    }
    return list;
}

} // namespace

void writeSpringBones(const Character& character, json& root) {
    const SpringBones& bones = character.springBones;
    if (bones.springs.empty() && bones.colliders.empty()) {
        return;
    }
    json written = {{"specVersion", "1.0"}};
    for (const SpringCollider& collider : bones.colliders) {
        written["colliders"].push_back(writeCollider(collider));
    }
    for (const std::vector<uint32_t>& group : bones.colliderGroups) {
        written["colliderGroups"].push_back({{"colliders", group}});
    }
    if (!bones.springs.empty()) {
        written["springs"] = writeSprings(character, root);
    }
    root["extensions"][kSprings] = std::move(written);
    root["extensionsUsed"].push_back(kSprings);
    if (std::any_of(bones.colliders.begin(), bones.colliders.end(), isExtended)) {
        root["extensionsUsed"].push_back(kMoreColliders);
    }
}

} // namespace supple::cage::gltf
