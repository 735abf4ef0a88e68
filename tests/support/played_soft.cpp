#include "tests/support/played_soft.h"

#include "shaders/pose/swing.h"
#include "skinning/jiggle_table.h"
#include "skinning/soft_nodes.h"

#include <gtest/gtest.h>

namespace supple::test {

using namespace shared;

namespace {

std::unique_ptr<const skinning::ClothTable> clothTableOf(const cage::Character& character) {
    Result<skinning::ClothTable> table = skinning::buildClothTable(character);
    EXPECT_TRUE(table.ok());
    return std::make_unique<const skinning::ClothTable>(table ? std::move(*table) : skinning::ClothTable());
}

} // namespace

PlayedSoft::PlayedSoft(const cage::Character& character, const skinning::ClipTable& clips,
                       const skinning::DeformTable& table, const skinning::PoseLayout& layout, uint32_t transition)
    : character_(&character), table_(&table), layout_(layout), twin_(clips, layout, transition),
      clothTable_(clothTableOf(character)), cloths_(*clothTable_), clothState_(clothTable_->stateElements),
      way_(identity()) {
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        if (skinning::jiggles(character, v)) {
            vertices_.push_back(v);
        }
    }
    jiggling_.resize(vertices_.size(), jigglingOf(vec4(0.0f), vec4(0.0f), vec4(0.0f), vec4(0.0f)));
}

void PlayedSoft::deformUnplaced(std::span<glm::vec4> cage) {
    std::vector<glm::vec4> pose(layout_.stride);
    twin_.write(pose);
    const auto put = [&](const Affine& m, size_t at) {
        pose[at] = m.x;
        pose[at + 1] = m.y;
        pose[at + 2] = m.z;
    };
    if (layout_.hasRotations()) {
        put(identity(), 0); // joints stand before it already
    } else {
        for (uint32_t j = 0; j < layout_.jointCount; ++j) {
            put(combined(identity(), twin_.skinned(j)), kLinearElements * size_t{j});
        }
    }
    joints_.resize(layout_.jointCount);
    for (uint32_t j = 0; j < layout_.jointCount; ++j) {
        const size_t at =
            layout_.hasRotations() ? kRotationTransform + kRotationElements * size_t{j} : kLinearElements * size_t{j};
        joints_[j] = rowsOf(pose[at], pose[at + 1], pose[at + 2]);
    }
    skinning::deformLikeTheDevice(*table_, layout_, pose, cage);
}

void PlayedSoft::run(std::span<const uint32_t> state, std::span<const float> masks, const runtime::StepClock::Due& due,
                     bool light) {
    std::vector<glm::vec4> cage(character_->cage.vertexCount());
    for (uint32_t k = 0; k < due.count; ++k) {
        twin_.pose(state, masks, runtime::timeOfStep(due.first + k), skinning::PoseTwin::Stands::unplaced);
        const Affine way = (state[1] & kStateTravels) != 0 ? twin_.place() : identity();
        const Affine placed = combined(rowsOf(due.rows[k][0], due.rows[k][1], due.rows[k][2]), way_);
        const Affine move = combined(undone(way), placed);
        const bool jumps = due.jump == k;
        const JiggleStep now{jumps ? identity() : move, due.settles, jumps, due.skipped};
        way_ = way;
        deformUnplaced(cage);
        runCloths(cage, {move, worldDirection(way, due.down[k]), worldVelocity(way, due.wind[k]), due.settles,
                         due.skipped != 0, jumps, light});
        for (size_t i = 0; i < vertices_.size(); ++i) {
            const cage::Jiggle& own = character_->jiggles[character_->weights.jiggles[vertices_[i]].index];
            jiggling_[i] =
                jiggledStep(jiggling_[i], vec3(cage[vertices_[i]]), now, skinning::jiggleSpring(own), own.limit);
        }
    }
}

void PlayedSoft::runCloths(std::span<const glm::vec4> goals, const skinning::ClothTwin::Step& now) {
    for (uint32_t cloth = 0; cloth < clothTable_->clothCount; ++cloth) {
        cloths_.step(cloth, goals, joints_, now, clothState_);
    }
}

void PlayedSoft::show(std::span<const uint32_t> state, std::span<const float> masks, double time, float part,
                      std::span<glm::vec4> cage) {
    std::vector<glm::vec4> pose(layout_.stride);
    twin_.pose(state, masks, time);
    twin_.write(pose);
    skinning::deformLikeTheDevice(*table_, layout_, pose, cage);
    for (size_t i = 0; i < vertices_.size(); ++i) {
        glm::vec4& shown = cage[vertices_[i]];
        const float weight = character_->weights.jiggles[vertices_[i]].weight;
        shown = vec4(vec3(shown) + shownOffset(jiggling_[i], part, weight, twin_.place()), shown.w);
    }
    for (uint32_t cloth = 0; cloth < clothTable_->clothCount; ++cloth) {
        cloths_.show(cloth, part, twin_.place(), clothState_, cage);
    }
}

} // namespace supple::test
