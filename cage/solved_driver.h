// Pose drivers: radial basis functions of joints' rotations, solved so that they pass through the artist's poses
// (docs/pose_drivers.md). In double; the same numbers whenever and wherever it is done.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace supple::cage {

// What drivers may have. With more poses, lanes of the device go around loops for too long.
inline constexpr size_t kMaxDriverInputs = 4;
inline constexpr size_t kMaxDriverTargets = 8;
inline constexpr size_t kMaxDriverPoses = 64; ///< beside the rest pose
inline constexpr float kMinDriverWidth = 0.01f, kMaxDriverWidth = 100.0f;
inline constexpr float kMinInputWeight = 1e-3f, kMaxInputWeight = 1e3f;
// Lengths of quaternions, which count by their directions.
inline constexpr double kMinTurnLength = 1e-6, kMaxTurnLength = 1e6;

/// Rounds of the device's loops for a driver, as if no two of its targets stood in one group of four.
[[nodiscard]] size_t driverWork(const PoseDriver& driver);
/// All drivers of a character have at most so much. Some Vulkan drivers end an invocation after 65,536 rounds of its
/// loops, and count those of all lanes of a subgroup.
inline constexpr size_t kMaxDriverWork = 50'000;
/// What messages say where there are more.
[[nodiscard]] std::string tooMuchDriverWork();

struct SolvedDriver {
    /// The rest pose first: unit quaternions (x, y, z, w), of the part that the input looks at, pose after pose, one
    /// per input.
    std::vector<glm::vec4> samples;
    std::vector<float> coefficients; ///< pose after pose, one per target
    float inverseSigma2 = 0.0f;      ///< of squared distances
    double condition = 0.0;          ///< of the matrix that was solved: by how much errors of poses grow
    // The two poses that are closest, counted from 1 as the file has them; 0 is the rest pose.
    size_t closest[2]{};
    double closestDegrees = 0.0; ///< in the input that tells them apart best
};

/// Where a pose weighs (1 / (1 + d / sigma^2))^2 at a squared distance d, of sines of half the angles, the coefficients
/// give each pose its values. Poses within a degree of each other are one; error: if their values differ, if nothing
/// but the rest pose is left, or if the poses cannot be told apart in floats. The driver is sound: inputs, targets,
/// poses and values as its members say, quaternions not zero.
[[nodiscard]] Result<SolvedDriver> solveDriver(const PoseDriver& driver);

} // namespace supple::cage
