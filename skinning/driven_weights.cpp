#include "skinning/driven_weights.h"

#include "skinning/driver_twin.h"
#include "skinning/rotation.h"

namespace supple::skinning {

void DrivenWeights::addTo(const Pose& pose, std::vector<double>& weights) {
    if (table_.quads == 0) {
        return;
    }
    for (size_t i = 0; i < turns_.size(); ++i) {
        turns_[i] = floatsOf(pose.locals[table_.nodes[i]].rotation);
    }
    driven_.assign((weights.size() + 3) / 4, glm::vec4(0.0f));
    addDriven(table_.words, 0, turns_, driven_);
    for (size_t t = 0; t < weights.size(); ++t) {
        weights[t] += static_cast<double>(driven_[t / 4][static_cast<int>(t % 4)]);
    }
}

} // namespace supple::skinning
