#include "tests/support/spring_twin.h"

#include "shaders/pose/limbs.h"
#include "shaders/pose/swing.h"
#include "skinning/playback.h"

#include <algorithm>
#include <bit>
#include <glm/gtc/type_ptr.hpp>

namespace supple::test {
namespace {

using namespace shared;

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
    [[nodiscard]] vec4 posedCollider(uint collider, uint element) const {
        return colliders[kPosedColliderElements * collider + element];
    }
    void keepCollider(uint collider, const vec4& point, const vec4& way) const {
        colliders[kPosedColliderElements * collider] = point;
        colliders[kPosedColliderElements * collider + 1] = way;
    }
    [[nodiscard]] vec4 spring(uint i) const { return springs[i]; }
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

SpringTwin::SpringTwin(const skinning::ClipTable& table, const skinning::PoseLayout& layout, uint32_t transition)
    : table_(&table), twin_(table, layout, transition) {
    push_.nodeCount = static_cast<uint32_t>(table.nodes.size());
    push_.springs = table.springs;
    springs_.resize(kSpringJoints + kSpringJointElements * size_t{table.springJointCount});
    colliders_.resize(kPosedColliderElements * size_t{table.springColliderCount});
    locals_.resize(table.nodes.size());
    globals_.resize(table.nodes.size());
    bones_.resize(table.springJointCount);
}

void SpringTwin::step(std::span<const uint32_t> state, std::span<const float> masks, int64_t step, Begins begins,
                      std::optional<std::array<glm::vec4, 3>> moved) {
    const double time = runtime::springTime(step);
    const bool travels = (state[1] & kStateTravels) != 0;
    Affine way = identity();
    if (travels) {
        twin_.pose(state, masks, time, skinning::PoseTwin::Stands::unplaced);
        way = twin_.place();
    }
    twin_.pose(state, masks, time);
    std::copy(twin_.locals().begin(), twin_.locals().end(), locals_.begin());
    SpringCode code{table_->words.data(), push_, locals_.data(), globals_.data(), colliders_.data(), springs_.data()};
    SpringCode::SpringStep now{rowsOf(springs_[0], springs_[1], springs_[2]), twin_.place(), begins == Begins::anew};
    now.move = moved ? combined(rowsOf((*moved)[0], (*moved)[1], (*moved)[2]), now.move) : now.move;
    now.move = begins == Begins::withoutMove ? identity() : combined(undone(way), now.move);
    code.runStep(now);
    springs_[0] = way.x;
    springs_[1] = way.y;
    springs_[2] = way.z;
    code.forChains([&](uint element) {
        const uvec4 ids = code.table(element);
        if (ids.y != kNoNode) {
            const vec3 tail(code.tableFloats(element + 1));
            const Affine above = code.globalOfParent(ids.x);
            bones_[ids.y] = {through(globals_[ids.x], vec3(0.0f)), through(globals_[ids.x], tail),
                             through(combined(above, composed(locals_[ids.x])), tail)};
        }
    });
}

void SpringTwin::show(std::span<const uint32_t> state, std::span<const float> masks, double time, float part,
                      std::span<glm::vec4> pose) {
    twin_.pose(state, masks, time);
    std::copy(twin_.locals().begin(), twin_.locals().end(), locals_.begin());
    SpringCode code{table_->words.data(), push_, locals_.data(), globals_.data(), colliders_.data(), springs_.data()};
    code.forChains([&](uint element) { code.showSpringNode(element, part); });
    // As locals that nothing changes any more.
    std::vector<uint32_t> words(state.begin(), state.end());
    skinning::PlaybackState own(words);
    const Affine& place = twin_.place();
    own.setTransform(glm::transpose(glm::mat4(place.x, place.y, place.z, vec4(0.0f, 0.0f, 0.0f, 1.0f))));
    own.setModifierCount(0);
    twin_.poseLocals(words, locals_, {});
    twin_.write(pose);
}

} // namespace supple::test
