// What the character does.
#pragma once

#include "pose.h"

#include <map>
#include <string>
#include <vector>

namespace supple::creature {

struct Clip {
    std::string name;
    double framesPerSecond = 30;
    std::vector<Pose> frames;                               // one more than the clip has intervals
    std::map<std::string, std::vector<double>> morphs = {}; // weights of morph targets, one a frame
};

std::vector<Clip> makeClips(const Skeleton& skeleton);

} // namespace supple::creature
