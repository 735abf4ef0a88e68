// The modelled, rigged and painted creature as the library's plain data.
#pragma once

#include "clips.h"
#include "uv.h"
#include "weights.h"

#include "cage/character.h"

namespace supple::creature {

// All numbers on a fixed grid, so that the last bits of a maths library cannot show in the file.
float rounded(double value);
glm::vec3 rounded(const Vec3& v);
// Joint j becomes node j.
void addSkeleton(cage::Character& character, const Skeleton& skeleton);
// For the cage's next vertices.
void addWeights(cage::Character& character, const std::vector<Influences>& influences);
cage::Clip assembleClip(const Clip& clip, const Skeleton& skeleton);

cage::Character assemble(const Cage& model, const Skeleton& skeleton, const std::vector<Influences>& influences,
                         const std::vector<Vec3>& colors, const Atlas& atlas, const std::vector<Clip>& clips);

} // namespace supple::creature
