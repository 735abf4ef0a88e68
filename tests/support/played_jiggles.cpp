#include "tests/support/played_jiggles.h"

#include "skinning/jiggle_table.h"

namespace supple::test {

using namespace shared;

PlayedJiggles::PlayedJiggles(const cage::Character& character, const skinning::ClipTable& clips,
                             const skinning::DeformTable& table, const skinning::PoseLayout& layout,
                             uint32_t transition)
    : character_(&character), table_(&table), layout_(layout), twin_(clips, layout, transition), way_(identity()) {
    for (uint32_t v = 0; v < character.weights.jiggles.size(); ++v) {
        if (character.weights.jiggles[v].index != cage::kNone) {
            vertices_.push_back(v);
        }
    }
    jiggling_.resize(vertices_.size(), jigglingOf(vec4(0.0f), vec4(0.0f), vec4(0.0f), vec4(0.0f)));
}

void PlayedJiggles::deformUnplaced(std::span<glm::vec4> cage) {
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
    skinning::deformLikeTheDevice(*table_, layout_, pose, cage);
}

void PlayedJiggles::run(std::span<const uint32_t> state, std::span<const float> masks,
                        const runtime::SpringClock::Due& due) {
    std::vector<glm::vec4> cage(character_->cage.vertexCount());
    for (uint32_t k = 0; k < due.count; ++k) {
        twin_.pose(state, masks, runtime::springTime(due.first + k), skinning::PoseTwin::Stands::unplaced);
        const Affine way = (state[1] & kStateTravels) != 0 ? twin_.place() : identity();
        JiggleStep now{way_, due.settles, due.jump == k, due.skipped};
        if (due.moves) {
            now.move = combined(rowsOf(due.rows[k][0], due.rows[k][1], due.rows[k][2]), now.move);
        }
        now.move = now.jumps ? identity() : combined(undone(way), now.move);
        way_ = way;
        deformUnplaced(cage);
        for (size_t i = 0; i < vertices_.size(); ++i) {
            const cage::Jiggle& own = character_->jiggles[character_->weights.jiggles[vertices_[i]].index];
            jiggling_[i] =
                jiggledStep(jiggling_[i], vec3(cage[vertices_[i]]), now, skinning::jiggleSpring(own), own.limit);
        }
    }
}

void PlayedJiggles::show(std::span<const uint32_t> state, std::span<const float> masks, double time, float part,
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
}

} // namespace supple::test
