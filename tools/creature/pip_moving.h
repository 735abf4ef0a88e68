// What of Pip swings and jiggles.
#pragma once

#include "pip_model.h"
#include "skeleton.h"

#include "cage/character.h"

namespace supple::creature {

// Ears, tail and belly. The model's points are the character's vertices.
void addMoving(const Cage& model, const Skeleton& skeleton, cage::Character& character);

} // namespace supple::creature
