// The targets that the issue of a release sets, held against a result.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace supple::bench {

/// Different characters, as many as a scene is judged with.
inline constexpr uint32_t kSceneCharacters = 60;

/// An array of {what, where, value, limit, met}, and atLeast where the value must not be below the limit. Ratios have
/// targets on CPU devices alone, crowds on others. What a result does not hold, or in another form than the target asks
/// for, has no entry.
[[nodiscard]] nlohmann::ordered_json judge(const nlohmann::ordered_json& result);

} // namespace supple::bench
