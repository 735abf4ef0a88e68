// The joint tree. Every joint rests unrotated, in model axes, so that clips can be written in plain directions.
#pragma once

#include "modeller.h"

#include <string>
#include <vector>

namespace supple::creature {

struct Joint {
    std::string name;
    int parent = -1;
    Vec3 rest{0}; // in the model
    Vec3 end{0};  // where the bone it moves ends, for weighting
};

struct Skeleton {
    std::vector<Joint> joints;

    int index(const std::string& name) const;
    Vec3 offset(int joint) const; // from the parent's rest position
};

Skeleton makeSkeleton(); // Pip's

} // namespace supple::creature
