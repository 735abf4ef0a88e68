#include "skinning/spring_twin.h"

#include "shaders/pose/colliders.h"

#include <algorithm>

namespace supple::twin {

using namespace shared;

namespace {

/// What GLSL has from springs.comp.
struct SpringCode {
    const uint32_t* tableWords = nullptr;
    PosePush push;
    Transform* locals = nullptr;
    Affine* globals = nullptr;
    vec4* colliders = nullptr;
    vec4* springs = nullptr;

    [[nodiscard]] uvec4 table(uint i) const {
        const uint32_t* const w = tableWords + 4 * size_t{i};
        return {w[0], w[1], w[2], w[3]};
    }
    [[nodiscard]] vec4 tableFloats(uint i) const {
        const uvec4 w = table(i);
        return {uintBitsToFloat(w.x), uintBitsToFloat(w.y), uintBitsToFloat(w.z), uintBitsToFloat(w.w)};
    }
    [[nodiscard]] Transform nodeLocal(uint node) const { return locals[node]; }
    void keepLocal(uint node, const Transform& t) const { locals[node].rotation = t.rotation; }
    [[nodiscard]] Affine nodeGlobal(uint node) const { return globals[node]; }
    void keepGlobal(uint node, const Affine& m) const { globals[node] = m; }
    [[nodiscard]] PosedCollider posedCollider(uint collider) const {
        const vec4* const elements = colliders + kPosedColliderElements * collider;
        return {elements[0], elements[1]};
    }
    void keepCollider(uint collider, const vec4& point, const vec4& way) const {
        colliders[kPosedColliderElements * collider] = point;
        colliders[kPosedColliderElements * collider + 1] = way;
    }
    [[nodiscard]] Affine springRows(uint i) const { return rowsOf(springs[i], springs[i + 1], springs[i + 2]); }
    void keepSpringRows(uint i, const Affine& rows) const {
        springs[i] = rows.x;
        springs[i + 1] = rows.y;
        springs[i + 2] = rows.z;
    }
    void keepSpring(uint i, const vec4& v) const { springs[i] = v; }
#include "shaders/pose/springs.h"

    void runStep(SpringStep now) {
        const SpringTables all = springTables();
        for (uint level = 0; level < all.levelCount; ++level) {
            const uvec4 nodes = table(all.levels + level);
            for (uint i = nodes.x; i < nodes.y; ++i) {
                poseSpringNode(table(i).x);
            }
        }
        for (uint i = 0; i < all.colliderCount; ++i) {
            poseCollider(i, all.colliders + kColliderElements * i);
        }
        for (uint chain = 0; chain < all.chainCount; ++chain) {
            stepChain(table(all.chains + chain), now);
        }
    }
    template <class F>
    void forChains(F&& visit) {
        const SpringTables all = springTables();
        for (uint chain = 0; chain < all.chainCount; ++chain) {
            const uvec4 nodes = table(all.chains + chain);
            for (uint i = nodes.x; i < nodes.y; i += kSpringNodeElements) {
                visit(i);
            }
        }
    }
};

} // namespace

} // namespace supple::twin

namespace supple::skinning {

SpringTwin::SpringTwin(const ClipTable& table) : table_(&table) {
    push_.nodeCount = static_cast<uint32_t>(table.nodes.size());
    push_.springs = table.springs;
    colliders_.resize(shared::kPosedColliderElements * size_t{table.springColliderCount});
    locals_.resize(table.nodes.size());
    globals_.resize(table.nodes.size());
}

size_t SpringTwin::stateElements(const ClipTable& table) {
    return shared::kSpringJoints + shared::kSpringJointElements * size_t{table.springJointCount};
}

void SpringTwin::step(std::span<const shared::Transform> locals, const Step& now, std::span<glm::vec4> state) {
    std::copy(locals.begin(), locals.end(), locals_.begin());
    twin::SpringCode code{table_->words.data(), push_,       locals_.data(), globals_.data(),
                          colliders_.data(),    state.data()};
    code.runStep({now.move, now.place, now.wind, now.settles});
}

void SpringTwin::show(std::span<glm::vec4> state, float part, std::span<shared::Transform> locals) {
    twin::SpringCode code{table_->words.data(), push_, locals.data(), globals_.data(), colliders_.data(), state.data()};
    code.forChains([&](shared::uint element) { code.showSpringNode(element, part, 1.0f); });
}

std::vector<SpringTwin::Bone> SpringTwin::bones() {
    std::vector<Bone> bones(table_->springJointCount);
    twin::SpringCode code{table_->words.data(), push_, locals_.data(), globals_.data(), colliders_.data(), nullptr};
    code.forChains([&](shared::uint element) {
        const shared::uvec4 ids = code.table(element);
        if (ids.y != shared::kNoNode) {
            const glm::vec3 tail(code.tableFloats(element + 1));
            const shared::Affine above = code.globalOfParent(ids.x);
            bones[ids.y] = {shared::through(globals_[ids.x], glm::vec3(0.0f)), shared::through(globals_[ids.x], tail),
                            shared::through(shared::combined(above, shared::composed(locals_[ids.x])), tail)};
        }
    });
    return bones;
}

} // namespace supple::skinning
