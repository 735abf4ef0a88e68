#include "skinning/spring_table.h"

#include "cage/spring_tails.h"
#include "shaders/shared/pose.h"
#include "skinning/bits.h"
#include "skinning/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <map>
#include <optional>

namespace supple::skinning {
namespace {

using namespace shared;
using cage::kNone;

constexpr double kStep = 1.0 / kStepsASecond;

/// A joint of a spring, with its tail in its own frame.
struct Swinging {
    const cage::Spring* spring = nullptr;
    const cage::SpringJoint* joint = nullptr;
    glm::dvec3 tail{0.0};
};

/// A node of the table that something of the character hangs on, and where that lies in its frame.
struct Held {
    uint32_t node = kNone; ///< kNone: in model space
    glm::dmat4 frame{1.0};
};

class SpringBuilder {
public:
    SpringBuilder(const cage::Character& character, ClipTable& table)
        : character_(character), bones_(character.springBones), table_(table), flags_(nodes().size(), 0) {
        rest_.resize(nodes().size(), glm::dmat4(1.0));
        firstChild_ = cage::firstChildren(character.skeleton);
        for (const uint32_t node : character.skeleton.parentsFirst) {
            const uint32_t parent = nodes()[node].parent;
            rest_[node] = glm::dmat4(localMatrix(nodes()[node], restTransform(nodes()[node])));
            if (parent != kNone) {
                rest_[node] = rest_[parent] * rest_[node];
            }
        }
    }

    void put() {
        for (const cage::Spring& spring : bones_.springs) {
            for (size_t j = 0; j < spring.swingingCount(); ++j) {
                takeJoint(spring, j);
            }
        }
        if (swinging_.empty()) {
            return;
        }
        need();
        table_.springs = next();
        table_.words.resize(table_.words.size() + 4 * size_t{kSpringHeadElements}, 0u);
        putLevels();
        putChains();
        putColliders();
        for (const uint32_t node : table_.nodes) {
            table_.words[4 * size_t{kNodeElements * table_.places[node]} + 1] |= flags_[node];
        }
    }

private:
    [[nodiscard]] const std::vector<cage::Node>& nodes() const { return character_.skeleton.nodes; }
    [[nodiscard]] uint32_t next() const { return static_cast<uint32_t>(table_.words.size() / 4); }
    void put(const std::array<uint32_t, 4>& element) {
        table_.words.insert(table_.words.end(), element.begin(), element.end());
    }
    void put(const glm::dvec3& v, double w) {
        put({bits(static_cast<float>(v.x)), bits(static_cast<float>(v.y)), bits(static_cast<float>(v.z)),
             bits(static_cast<float>(w))});
    }
    void putHead(size_t word, uint32_t count, uint32_t first) {
        table_.words[4 * size_t{table_.springs} + word] = count;
        table_.words[4 * size_t{table_.springs} + word + 1] = first;
    }

    /// In model space, as the rest pose has it.
    [[nodiscard]] std::optional<glm::dvec3> tailOf(const cage::Spring& spring, size_t j) const {
        const uint32_t node = spring.joints[j].node;
        if (!spring.isTree) {
            return glm::dvec3(rest_[spring.joints[j + 1].node][3]);
        }
        return cage::tailInTree(character_.skeleton, firstChild_, rest_, node);
    }

    void takeJoint(const cage::Spring& spring, size_t j) {
        const uint32_t node = spring.joints[j].node;
        const std::optional<glm::dvec3> tail = tailOf(spring, j);
        if (!tail || table_.places[node] == kNone || nodes()[node].hasMatrix ||
            !(glm::distance(*tail, glm::dvec3(rest_[node][3])) > cage::kShortestTail) ||
            !(std::abs(glm::determinant(glm::dmat3(rest_[node]))) > 1e-30)) {
            return;
        }
        const auto [found, isNew] = swinging_.insert(
            {node, {&spring, &spring.joints[j], glm::dvec3(glm::inverse(rest_[node]) * glm::dvec4(*tail, 1.0))}});
        if (isNew) {
            table_.swinging.push_back(node);
        }
    }

    [[nodiscard]] Held heldBy(uint32_t node) const {
        Held held;
        for (held.node = node; held.node != kNone && table_.places[held.node] == kNone;) {
            held.frame = glm::dmat4(localMatrix(nodes()[held.node], restTransform(nodes()[held.node]))) * held.frame;
            held.node = nodes()[held.node].parent;
        }
        return held;
    }
    void need(uint32_t node) {
        for (; node != kNone && (flags_[node] & kNodeOfSprings) == 0; node = nodes()[node].parent) {
            flags_[node] |= kNodeOfSprings;
        }
    }
    /// Marks the nodes that steps need, and those of chains.
    void need() {
        for (const auto& [node, own] : swinging_) {
            flags_[node] |= kNodeInChain;
        }
        for (const uint32_t node : character_.skeleton.parentsFirst) {
            const uint32_t parent = nodes()[node].parent;
            flags_[node] |= parent != kNone ? flags_[parent] & kNodeInChain : 0u;
        }
        for (const auto& [node, own] : swinging_) {
            need(node);
            need(centerOf(*own.spring).node);
            for (const uint32_t group : own.spring->colliderGroups) {
                for (const uint32_t collider : bones_.colliderGroups[group]) {
                    need(heldBy(bones_.colliders[collider].node).node);
                }
            }
        }
    }
    /// A center that swings itself is none.
    [[nodiscard]] Held centerOf(const cage::Spring& spring) const {
        const Held held = spring.center != kNone ? heldBy(spring.center) : Held();
        return held.node != kNone && (flags_[held.node] & kNodeInChain) == 0 ? held : Held();
    }

    void putLevels() {
        const uint32_t first = next(), count = table_.levelCount;
        table_.words.resize(table_.words.size() + 4 * size_t{count}, 0u);
        for (uint32_t level = 0; level < count; ++level) {
            const size_t places = 4 * size_t{table_.levels + level};
            const uint32_t begin = next(), end = table_.words[places + 1];
            for (uint32_t place = table_.words[places]; place < end; ++place) {
                if (flags_[table_.nodes[place]] == kNodeOfSprings) {
                    put({place, 0u, 0u, 0u});
                    ++table_.springWork;
                }
            }
            table_.words[4 * size_t{first + level}] = begin;
            table_.words[4 * size_t{first + level} + 1] = next();
        }
        putHead(0, count, first);
    }

    /// A chain begins at a joint that hangs on none that swings, and has what hangs on it.
    void putChains() {
        std::map<uint32_t, std::vector<uint32_t>> chains; // by the first place
        std::vector<uint32_t> top(nodes().size(), kNone);
        for (uint32_t place = 0; place < table_.nodes.size(); ++place) {
            const uint32_t node = table_.nodes[place], parent = nodes()[node].parent;
            if ((flags_[node] & kNodeInChain) != 0) {
                top[node] = parent != kNone && (flags_[parent] & kNodeInChain) != 0 ? top[parent] : place;
                if ((flags_[node] & kNodeOfSprings) != 0) {
                    chains[top[node]].push_back(node);
                }
            }
        }
        putReferences();
        const auto count = static_cast<uint32_t>(chains.size());
        const uint32_t first = next();
        table_.words.resize(table_.words.size() + 4 * chains.size(), 0u);
        uint32_t chain = first;
        for (const auto& [place, own] : chains) {
            table_.words[4 * size_t{chain}] = next();
            for (const uint32_t node : own) {
                putNode(node);
            }
            table_.words[4 * size_t{chain++} + 1] = next();
        }
        putHead(2, count, first);
    }
    /// The numbers of the colliders of each spring. Those that no spring uses have none.
    void putReferences() {
        std::vector<uint32_t> all;
        for (const cage::Spring& spring : bones_.springs) {
            const size_t begin = all.size();
            for (const uint32_t group : spring.colliderGroups) {
                for (const uint32_t collider : bones_.colliderGroups[group]) {
                    all.push_back(used_.insert({collider, static_cast<uint32_t>(used_.size())}).first->second);
                    colliders_.resize(used_.size());
                    colliders_[all.back()] = collider;
                }
            }
            references_[&spring] = {4 * next() + static_cast<uint32_t>(begin),
                                    static_cast<uint32_t>(all.size() - begin)};
        }
        table_.words.insert(table_.words.end(), all.begin(), all.end());
        table_.words.resize((table_.words.size() + 3) / 4 * 4, 0u);
    }
    void putNode(uint32_t node) {
        const auto found = swinging_.find(node);
        ++table_.springWork;
        if (found == swinging_.end()) {
            put({table_.places[node], kNoNode, 0u, 0u});
            table_.words.resize(table_.words.size() + 4 * size_t{kSpringNodeElements - 1}, 0u);
            return;
        }
        const Swinging& own = found->second;
        const auto& [first, count] = references_[own.spring];
        const glm::dvec3 gravity(own.joint->gravityDirection);
        const double length = glm::length(gravity);
        const Held center = centerOf(*own.spring);
        put({table_.places[node], table_.springJointCount++, first, count});
        put(own.tail, static_cast<double>(own.joint->stiffness) * kStep);
        put(length > 0.0 ? gravity / length : glm::dvec3(0.0, -1.0, 0.0),
            static_cast<double>(own.joint->gravityPower) * length * kStep);
        put({bits(1.0f - std::clamp(own.joint->drag, 0.0f, 1.0f)), bits(own.joint->hitRadius),
             center.node != kNone ? table_.places[center.node] : kNoNode, 0u});
        table_.springWork += count;
    }

    void putColliders() {
        putHead(4, static_cast<uint32_t>(colliders_.size()), next());
        table_.springColliderCount = static_cast<uint32_t>(colliders_.size());
        table_.springWork += table_.springColliderCount;
        for (const uint32_t collider : colliders_) {
            const cage::SpringCollider& own = bones_.colliders[collider];
            const Held held = heldBy(own.node);
            const bool plane = own.shape == cage::ColliderShape::plane;
            const bool capsule = own.shape == cage::ColliderShape::capsule;
            put({held.node != kNone ? table_.places[held.node] : kNoNode,
                 (own.inside && !plane ? kColliderInside : 0u) | (plane ? kColliderPlane : 0u), 0u, 0u});
            const glm::dvec3 offset(own.offset), end(capsule ? own.tail : own.offset);
            put(glm::dvec3(held.frame * glm::dvec4(offset, 1.0)), static_cast<double>(own.radius));
            put(plane ? glm::dmat3(held.frame) * glm::normalize(glm::dvec3(own.tail))
                      : glm::dvec3(held.frame * glm::dvec4(end, 1.0)),
                0.0);
        }
    }

    const cage::Character& character_;
    const cage::SpringBones& bones_;
    ClipTable& table_;
    std::vector<glm::dmat4> rest_;     ///< by node: where it is in the rest pose
    std::vector<uint32_t> firstChild_; ///< by node
    std::vector<uint32_t> flags_;      ///< by node: kNodeOfSprings, kNodeInChain
    std::map<uint32_t, Swinging> swinging_;
    std::map<uint32_t, uint32_t> used_; ///< by collider of the character: its number
    std::vector<uint32_t> colliders_;   ///< and back
    std::map<const cage::Spring*, std::pair<uint32_t, uint32_t>> references_; ///< the first, how many
};

} // namespace

void putSprings(const cage::Character& character, ClipTable& table) {
    if (!character.springBones.springs.empty()) {
        SpringBuilder(character, table).put();
    }
}

} // namespace supple::skinning
