// supple bench --papers: the tables of the papers that schemes come from, on models of the same make and this machine,
// beside the figures that they print.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "host/device.h"

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace supple::bench {

/// Distances to the Catmull-Clark limit, as fractions of the extent.
struct PaperDistance {
    double largest = 0.0, mean = 0.0;
};
/// Measures points on surfaces over one cage; `faces`: the face of the cage of each point.
using MeasureDistance =
    std::function<PaperDistance(const std::vector<uint32_t>& faces, const std::vector<glm::dvec3>& points)>;

struct PapersOptions {
    bool quick = false; ///< a frame each, and N = 5 alone
    SuppleMapping mapping = SUPPLE_MAPPING_AUTO;
    std::function<Result<MeasureDistance>(const cage::Cage& cage)> limitOf;
    std::function<void(const std::string& what)> progress;
};

[[nodiscard]] Result<nlohmann::ordered_json> runPapers(host::Device& device, const PapersOptions& options);

/// As Markdown tables. Seconds of frames and of evaluation are those of processor time on CPU devices.
[[nodiscard]] std::string papersText(const nlohmann::ordered_json& result);

} // namespace supple::bench
