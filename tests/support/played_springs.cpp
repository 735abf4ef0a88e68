#include "tests/support/played_springs.h"

#include "shaders/pose/limbs.h"
#include "shaders/pose/swing.h"
#include "skinning/playback.h"

#include <algorithm>

namespace supple::test {

using namespace shared;

PlayedSprings::PlayedSprings(const skinning::ClipTable& table, const skinning::PoseLayout& layout, uint32_t transition)
    : twin_(table, layout, transition), springs_(table), state_(skinning::SpringTwin::stateElements(table)),
      locals_(table.nodes.size()) {}

void PlayedSprings::step(std::span<const uint32_t> state, std::span<const float> masks, int64_t step, Begins begins,
                         std::optional<std::array<glm::vec4, 3>> moved) {
    const double time = runtime::timeOfStep(step);
    const bool travels = (state[1] & kStateTravels) != 0;
    Affine way = identity();
    if (travels) {
        twin_.pose(state, masks, time, skinning::PoseTwin::Stands::unplaced);
        way = twin_.place();
    }
    twin_.pose(state, masks, time);
    skinning::SpringTwin::Step now{rowsOf(state_[0], state_[1], state_[2]), twin_.place(), begins == Begins::anew,
                                   worldVelocity(way, wind_)};
    now.move = moved ? combined(rowsOf((*moved)[0], (*moved)[1], (*moved)[2]), now.move) : now.move;
    now.move = begins == Begins::withoutMove ? identity() : combined(undone(way), now.move);
    springs_.step(twin_.locals(), now, state_);
    state_[0] = way.x;
    state_[1] = way.y;
    state_[2] = way.z;
}

void PlayedSprings::show(std::span<const uint32_t> state, std::span<const float> masks, double time, float part,
                         std::span<glm::vec4> pose) {
    twin_.pose(state, masks, time);
    std::copy(twin_.locals().begin(), twin_.locals().end(), locals_.begin());
    springs_.show(state_, part, locals_);
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
