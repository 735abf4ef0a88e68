// What of Wren swings: springs and colliders.
#pragma once

#include "skeleton.h"

#include "cage/character.h"

namespace supple::creature::wren {

// The skeleton is one with springs.
void addSprings(const Skeleton& skeleton, cage::Character& character);

} // namespace supple::creature::wren
