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

// Joints "name1", "name2".. of a skeleton, and where they are in the model: one place more, where the last one ends.
struct Links {
    std::vector<std::string> joints;
    std::vector<Vec3> places;
};

struct Skeleton {
    std::vector<Joint> joints;
    bool springs = false; // what hangs is left to springs: clips do not move it

    Links links(const std::string& name) const;
    int index(const std::string& name) const;
    Vec3 offset(int joint) const; // from the parent's rest position
};

// Pip's. `ends`: with joints where ears and tail end, for springs.
Skeleton makeSkeleton(bool ends);

} // namespace supple::creature
