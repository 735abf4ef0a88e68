#include "skinning/cloth_twin.h"

#include "shaders/pose/colliders.h"
#include "shaders/shared/soft.h"

namespace supple::twin {

using namespace shared;

namespace {

/// What GLSL has from cloth.comp, of a workgroup of one lane.
struct ClothCode {
    const uint32_t* tableWords = nullptr;
    const vec4* goals = nullptr;
    std::span<const Affine> joints;
    vec4* states = nullptr;
    vec4* places = nullptr;
    vec4* posedColliders = nullptr;
    float* sums = nullptr;

    [[nodiscard]] uvec4 clothTable(uint i) const {
        const uint32_t* const w = tableWords + 4 * size_t{i};
        return {w[0], w[1], w[2], w[3]};
    }
    static vec4 uintBitsToFloat(const uvec4& w) {
        return {shared::uintBitsToFloat(w.x), shared::uintBitsToFloat(w.y), shared::uintBitsToFloat(w.z),
                shared::uintBitsToFloat(w.w)};
    }
    static float uintBitsToFloat(uint w) { return shared::uintBitsToFloat(w); }
    [[nodiscard]] vec3 goalOf(uint vertex) const { return {goals[vertex]}; }
    [[nodiscard]] Affine posedJoint(uint joint) const { return joint < joints.size() ? joints[joint] : identity(); }
    [[nodiscard]] vec4 clothState(uint i) const { return states[i]; }
    void keepClothState(uint i, const vec4& v) const { states[i] = v; }
    [[nodiscard]] vec4 placeAt(uint i) const { return places[i]; }
    void keepPlace(uint i, const vec4& v) const { places[i] = v; }
    [[nodiscard]] float sumAt(uint i) const { return sums[i]; }
    void keepSum(uint i, float v) const { sums[i] = v; }
    [[nodiscard]] vec4 colliderAt(uint i) const { return posedColliders[i]; }
    void keepCollider(uint collider, const vec4& point, const vec4& way) const {
        posedColliders[2 * collider] = point;
        posedColliders[2 * collider + 1] = way;
    }
    static uint laneOf() { return 0; }
    static uint laneCount() { return 1; }
    static void meet() {}
#include "shaders/soft/cloth.h"

    [[nodiscard]] Affine stateRows(uint i) const {
        return rowsOf(states[i], states[i + 1], states[i + 2]);
    }
};

} // namespace
} // namespace supple::twin

namespace supple::skinning {

using namespace shared;

namespace {

twin::ClothCode codeOf(const ClothTable& table, const glm::vec4* state) {
    twin::ClothCode code;
    code.tableWords = table.words.data();
    code.states = const_cast<glm::vec4*>(state); // nothing writes to it
    return code;
}

} // namespace

ClothTwin::ClothTwin(const ClothTable& table)
    : table_(&table), places_(kMostClothVertices), colliders_(2 * kMostClothColliders), sums_(kClothSums) {}

void ClothTwin::step(uint32_t cloth, std::span<const glm::vec4> goals, std::span<const shared::Affine> joints,
                     const Step& now, std::span<glm::vec4> state) {
    twin::ClothCode code{table_->words.data(), goals.data(),      joints,      state.data(),
                         places_.data(),       colliders_.data(), sums_.data()};
    const auto all = code.clothTables(cloth);
    glm::vec4* const head = state.data() + all.state;
    auto own = code.clothStep(now.move, code.stateRows(all.state + 3), now.settles, now.skips, now.jumps, head[6].x);
    own.down = now.down;
    own.wind = now.wind;
    own.light = now.light;
    code.runClothStep(all, own);
    head[3] = own.move.x;
    head[4] = own.move.y;
    head[5] = own.move.z;
    head[6] = glm::vec4(code.knownAfter(own, head[6].x), 0.0f, 0.0f, 0.0f);
}

void ClothTwin::show(uint32_t cloth, float part, const shared::Affine& place, std::span<const glm::vec4> state,
                     std::span<glm::vec4> cage) const {
    twin::ClothCode code = codeOf(*table_, state.data());
    const auto all = code.clothTables(cloth);
    for (uint32_t i = all.hangingCount; i < all.vertexCount; ++i) {
        glm::vec4& shown = cage[code.clothTable(vertexElement(cloth, i)).x];
        shown = glm::vec4(glm::vec3(shown) + code.shownClothOffset(all, i, part, place), shown.w);
    }
}

uint32_t ClothTwin::vertexCount(uint32_t cloth) const {
    return codeOf(*table_, nullptr).clothTables(cloth).vertexCount;
}

uint32_t ClothTwin::vertexElement(uint32_t cloth, uint32_t vertex) const {
    return codeOf(*table_, nullptr).clothTables(cloth).vertices + kClothVertexElements * vertex;
}

glm::vec3 ClothTwin::place(uint32_t cloth, uint32_t vertex, std::span<const glm::vec4> state) const {
    twin::ClothCode code = codeOf(*table_, state.data());
    return glm::vec3(code.clothState(code.clothVertexState(code.clothTables(cloth), vertex)));
}

glm::vec3 ClothTwin::speed(uint32_t cloth, uint32_t vertex, std::span<const glm::vec4> state) const {
    twin::ClothCode code = codeOf(*table_, state.data());
    return glm::vec3(code.clothState(code.clothVertexState(code.clothTables(cloth), vertex) + 1));
}

glm::vec3 ClothTwin::offset(uint32_t cloth, uint32_t vertex, std::span<const glm::vec4> state) const {
    twin::ClothCode code = codeOf(*table_, state.data());
    return glm::vec3(code.clothState(code.clothVertexState(code.clothTables(cloth), vertex) + 2));
}

} // namespace supple::skinning
