#include "cage/gltf/vrm_springs.h"

#include "cage/entry_faults.h"
#include "cage/limits.h"

#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>

namespace supple::cage::gltf {
namespace {

using Fault = std::optional<std::string>;

std::span<const Json> itemsIn(const Json& object, const char* key) {
    const Json* found = object.isObject() ? member(object, key) : nullptr;
    return found != nullptr ? found->items() : std::span<const Json>();
}

/// Numbers that files may leave out; the first that makes no sense is kept as the fault.
class Numbers {
public:
    explicit Numbers(const Json& from) : from_(from) {
        if (!from.isObject()) {
            fault_ = "not an object";
        }
    }

    void number(const char* key, float& into, float least = -kMaxCoordinate) {
        const Json* given = find(key);
        if (given == nullptr) {
            return;
        }
        if (!given->isNumber() || !isFiniteFloat(*given) || !(given->real() >= least) ||
            !(given->real() <= kMaxCoordinate)) {
            fault_ = std::string(key) + " is no number that it may be";
            return;
        }
        into = given->real();
    }
    /// An array of three numbers, or an object of x, y and z.
    void vector(const char* key, glm::vec3& into) {
        const Json* given = find(key);
        if (given == nullptr) {
            return;
        }
        glm::vec3 read(0.0f);
        for (int k = 0; k < 3; ++k) {
            constexpr const char* kAxes[] = {"x", "y", "z"};
            const Json* number = given->isObject() ? member(*given, kAxes[k]) : nullptr;
            number = given->size() == 3 ? &(*given)[static_cast<size_t>(k)] : number;
            if (number == nullptr || !number->isNumber() || !(std::abs(number->number()) <= kMaxCoordinate)) {
                fault_ = std::string(key) + " is not three numbers";
                return;
            }
            read[k] = number->real();
        }
        into = read;
    }
    /// One of `count` things. `needed`: it must be there. Negative numbers of VRM 0.x name none.
    void index(const char* key, size_t count, uint32_t& into, bool needed) {
        const Json* given = find(key);
        if (given != nullptr && given->isUnsigned() && given->unsignedInteger() < count) {
            into = static_cast<uint32_t>(given->unsignedInteger());
        } else if (needed || (given != nullptr && given->isUnsigned())) {
            fault_ = std::string(key) + " is out of range";
        }
    }
    void flag(const char* key, bool& into) {
        const Json* given = find(key);
        if (given != nullptr && !given->isBoolean()) {
            fault_ = std::string(key) + " is neither true nor false";
        } else if (given != nullptr) {
            into = given->boolean();
        }
    }
    [[nodiscard]] const Fault& fault() const { return fault_; }

private:
    [[nodiscard]] const Json* find(const char* key) const { return fault_ ? nullptr : member(from_, key); }

    const Json& from_;
    Fault fault_;
};

class SpringReader {
public:
    SpringReader(const Document& document, const Skeleton& skeleton, Warnings& warnings)
        : document_(document), nodes_(skeleton.nodes.size()), skeleton_(skeleton), warnings_(warnings) {}

    ReadSprings read() && {
        const Json* extensions = member(document_.json.root(), "extensions");
        if (const Json* own = objectIn(extensions, "VRMC_springBone"); own != nullptr) {
            readNew(*own);
        } else if (const Json* old = objectIn(objectIn(extensions, "VRM"), "secondaryAnimation"); old != nullptr) {
            readOld(*old);
        }
        return {std::move(bones_), std::move(colliders_)};
    }

private:
    /// Calls use(entry, its number), which returns why the entry is left out, or nothing.
    template <class Use>
    void each(std::span<const Json> list, const std::string& name, const Use& use) {
        EntryFaults faults(name);
        for (size_t i = 0; i < list.size(); ++i) {
            document_.memory->take(sizeof(Spring) + sizeof(SpringCollider), name);
            if (const Fault fault = use(list[i], i)) {
                faults.add(i, *fault);
            }
        }
        faults.report(warnings_);
    }

    Fault readShape(const Json& from, SpringCollider& collider) {
        // The extended shape stands before the other, which is there for those who do not know it.
        const Json* extended = objectIn(objectIn(&from, "extensions"), "VRMC_springBone_extended_collider");
        const Json* shape = objectIn(extended != nullptr ? extended : &from, "shape");
        const Json* sphere = objectIn(shape, "sphere");
        const Json* capsule = objectIn(shape, "capsule");
        const Json* plane = extended != nullptr ? objectIn(shape, "plane") : nullptr;
        if (plane != nullptr) {
            return readPlane(*plane, collider);
        }
        if (sphere == nullptr && capsule == nullptr) {
            return "its shape is none that is known";
        }
        collider.shape = capsule != nullptr ? ColliderShape::capsule : ColliderShape::sphere;
        Numbers numbers(capsule != nullptr ? *capsule : *sphere);
        numbers.vector("offset", collider.offset);
        collider.tail = collider.offset;
        if (capsule != nullptr) {
            numbers.vector("tail", collider.tail);
        }
        numbers.number("radius", collider.radius, 0.0f);
        if (extended != nullptr) {
            numbers.flag("inside", collider.inside);
        }
        return numbers.fault();
    }

    static Fault readPlane(const Json& from, SpringCollider& collider) {
        Numbers numbers(from);
        collider.shape = ColliderShape::plane;
        collider.tail = {0.0f, 0.0f, 1.0f}; // the extension's own
        numbers.vector("offset", collider.offset);
        numbers.vector("normal", collider.tail);
        if (!numbers.fault() && !(glm::length(collider.tail) > 1e-6f)) {
            return "its normal has no direction";
        }
        return numbers.fault();
    }

    /// Groups and colliders that are left out leave a gap: numbers of a file go through `colliders_` and `groups`.
    void readNew(const Json& own) {
        each(itemsIn(own, "colliders"), "VRM colliders", [&](const Json& from, size_t) -> Fault {
            colliders_.push_back(kNone);
            SpringCollider collider;
            Numbers numbers(from);
            numbers.index("node", nodes_, collider.node, true);
            Fault fault = numbers.fault() ? numbers.fault() : readShape(from, collider);
            if (!fault) {
                colliders_.back() = static_cast<uint32_t>(bones_.colliders.size());
                bones_.colliders.push_back(collider);
            }
            return fault;
        });
        each(itemsIn(own, "colliderGroups"), "VRM collider groups", [&](const Json& from, size_t) -> Fault {
            std::vector<uint32_t>& group = bones_.colliderGroups.emplace_back();
            return indices(itemsIn(from, "colliders"), "collider", colliders_, group);
        });
        each(itemsIn(own, "springs"), "VRM springs", [&](const Json& from, size_t) -> Fault {
            Spring spring;
            Numbers numbers(from);
            numbers.index("center", nodes_, spring.center, false);
            Fault fault = numbers.fault();
            if (!fault) {
                const Json* name = member(from, "name");
                spring.name = name != nullptr ? name->string() : "";
                fault = indices(itemsIn(from, "colliderGroups"), "collider group", bones_.colliderGroups.size(),
                                spring.colliderGroups);
            }
            for (const Json& joint : itemsIn(from, "joints")) {
                fault = fault ? fault : readJoint(joint, spring);
            }
            fault = fault ? fault : chainFault(spring);
            return keep(std::move(spring), fault);
        });
    }

    Fault readJoint(const Json& from, Spring& spring) {
        SpringJoint joint;
        Numbers numbers(from);
        numbers.index("node", nodes_, joint.node, true);
        numbers.number("hitRadius", joint.hitRadius, 0.0f);
        numbers.number("stiffness", joint.stiffness, 0.0f);
        numbers.number("gravityPower", joint.gravityPower);
        numbers.number("dragForce", joint.drag, 0.0f);
        numbers.vector("gravityDir", joint.gravityDirection);
        document_.memory->take(sizeof joint, "VRM springs");
        spring.joints.push_back(joint);
        return numbers.fault();
    }

    /// Why the joints are no chain of their own; nothing if they are. Then no other spring may take them.
    Fault chainFault(const Spring& spring) {
        taken_.resize(nodes_);
        for (size_t j = 0; j < spring.joints.size(); ++j) {
            const uint32_t node = spring.joints[j].node;
            if (taken_[node] != 0) {
                return "a joint moves by another spring";
            }
            uint32_t above = node;
            do {
                above = skeleton_.nodes[above].parent;
            } while (j > 0 && above != kNone && above != spring.joints[j - 1].node);
            if (j > 0 && above == kNone) {
                return "a joint is not below the one before";
            }
        }
        for (const SpringJoint& joint : spring.joints) {
            taken_[joint.node] = 1;
        }
        return std::nullopt;
    }

    void readOld(const Json& own) {
        each(itemsIn(own, "colliderGroups"), "VRM collider groups", [&](const Json& from, size_t) -> Fault {
            std::vector<uint32_t>& group = bones_.colliderGroups.emplace_back();
            uint32_t node = kNone;
            Numbers owner(from);
            owner.index("node", nodes_, node, true);
            Fault fault = owner.fault();
            for (const Json& sphere : itemsIn(from, "colliders")) {
                SpringCollider collider{.node = node};
                Numbers numbers(sphere);
                numbers.vector("offset", collider.offset);
                numbers.number("radius", collider.radius, 0.0f);
                fault = fault ? fault : numbers.fault();
                if (fault) {
                    break;
                }
                collider.offset.z = -collider.offset.z; // Unity's z, as VRM 0.x writes it
                collider.tail = collider.offset;
                document_.memory->take(sizeof collider, "VRM colliders");
                group.push_back(static_cast<uint32_t>(bones_.colliders.size()));
                colliders_.push_back(group.back());
                bones_.colliders.push_back(collider);
            }
            return fault;
        });
        findChildren();
        each(itemsIn(own, "boneGroups"), "VRM bone groups",
             [&](const Json& from, size_t) -> Fault { return readOldGroup(from); });
    }

    /// A spring for each bone of a group.
    Fault readOldGroup(const Json& from) {
        Spring group;
        group.isTree = true;
        SpringJoint joint;
        Numbers numbers(from);
        numbers.index("center", nodes_, group.center, false);
        numbers.number("stiffiness", joint.stiffness, 0.0f); // so it is spelled
        numbers.number("gravityPower", joint.gravityPower);
        numbers.number("dragForce", joint.drag, 0.0f);
        numbers.number("hitRadius", joint.hitRadius, 0.0f);
        numbers.vector("gravityDir", joint.gravityDirection);
        if (numbers.fault()) {
            return numbers.fault();
        }
        const Json* comment = member(from, "comment");
        group.name = comment != nullptr ? comment->string() : "";
        Fault fault = indices(itemsIn(from, "colliderGroups"), "collider group", bones_.colliderGroups.size(),
                              group.colliderGroups);
        for (const Json& bone : itemsIn(from, "bones")) {
            if (!bone.isUnsigned() || bone.unsignedInteger() >= nodes_) {
                fault = fault ? fault : "a bone is no node of the file";
                continue;
            }
            Spring spring = group;
            document_.memory->take(sizeof spring + spring.name.size() + 4 * spring.colliderGroups.size(),
                                   "VRM springs");
            addBelow(static_cast<uint32_t>(bone.unsignedInteger()), joint, spring);
            if (!spring.joints.empty()) { // else it is below another bone
                bones_.springs.push_back(std::move(spring));
            }
        }
        return fault;
    }

    void findChildren() {
        children_.resize(nodes_);
        taken_.assign(nodes_, 0);
        for (uint32_t node = 0; node < nodes_; ++node) {
            if (skeleton_.nodes[node].parent != kNone) {
                children_[skeleton_.nodes[node].parent].push_back(node);
            }
        }
    }
    /// A bone and all below it, parents first. A node moves by one spring alone.
    void addBelow(uint32_t bone, SpringJoint joint, Spring& spring) {
        std::vector<uint32_t> left{bone};
        while (!left.empty()) {
            joint.node = left.back();
            left.pop_back();
            if (taken_[joint.node] != 0) {
                continue;
            }
            taken_[joint.node] = 1;
            document_.memory->take(sizeof joint, "VRM springs");
            spring.joints.push_back(joint);
            left.insert(left.end(), children_[joint.node].rbegin(), children_[joint.node].rend());
        }
    }

    Fault keep(Spring spring, const Fault& fault) {
        if (fault) {
            return fault;
        }
        if (spring.joints.empty()) {
            return "it has no joints";
        }
        bones_.springs.push_back(std::move(spring));
        return std::nullopt;
    }

    static Fault indices(std::span<const Json> from, const char* what, size_t count, std::vector<uint32_t>& into) {
        for (const Json& index : from) {
            if (!index.isUnsigned() || index.unsignedInteger() >= count) {
                return std::string("a ") + what + " is out of range";
            }
            into.push_back(static_cast<uint32_t>(index.unsignedInteger()));
        }
        return std::nullopt;
    }
    /// The same of things of which some were left out.
    static Fault indices(std::span<const Json> from, const char* what, const std::vector<uint32_t>& kept,
                         std::vector<uint32_t>& into) {
        std::vector<uint32_t> numbers;
        Fault fault = indices(from, what, kept.size(), numbers);
        for (const uint32_t number : numbers) {
            if (kept[number] != kNone) {
                into.push_back(kept[number]);
            }
        }
        return fault;
    }

    const Document& document_;
    size_t nodes_;
    const Skeleton& skeleton_;
    Warnings& warnings_;
    SpringBones bones_;
    std::vector<uint32_t> colliders_; ///< ReadSprings
    std::vector<std::vector<uint32_t>> children_;
    std::vector<uint8_t> taken_;
};

} // namespace

ReadSprings readSpringBones(const Document& document, const Skeleton& skeleton, Warnings& warnings) {
    return SpringReader(document, skeleton, warnings).read();
}

} // namespace supple::cage::gltf
