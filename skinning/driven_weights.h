// What pose drivers add to the morph weights of a pose in double.
#pragma once

#include "skinning/driver_table.h"
#include "skinning/pose.h"

#include <glm/glm.hpp>
#include <vector>

namespace supple::skinning {

class DrivenWeights {
public:
    /// The table must outlive this.
    explicit DrivenWeights(const DriverTable& table) : table_(table), turns_(table.nodes.size()) {}

    /// Adds it to `weights`, one a morph target.
    void addTo(const Pose& pose, std::vector<double>& weights);

private:
    const DriverTable& table_;
    std::vector<glm::vec4> turns_, driven_;
};

} // namespace supple::skinning
