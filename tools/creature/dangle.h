// Chains of joints that hang, and are dragged along by what they hang on.
#pragma once

#include "clips.h"

namespace supple::creature {

struct Chain {
    std::vector<std::string> joints;
    Vec3 end;           // in the model at rest: where the last bone ends
    double stiff = 0.3; // how much of the way back to its rest shape it goes in a frame
    double damp = 0.25; // of its speed lost in a frame
    Vec3 wind{0};       // what blows on it, in units a frame squared
};

// Turns the chain's joints in all frames. A loop is run through until it meets itself.
void dangle(Clip& clip, const Skeleton& skeleton, const Chain& chain, bool loops);

} // namespace supple::creature
