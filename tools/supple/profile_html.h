// The report of supple profile as one page that needs nothing beside it: charts, tables, pictures of what was measured.
#pragma once

#include "tools/common/machine.h"
#include "tools/supple/profile_compare.h"
#include "tools/supple/profile_summary.h"

#include <span>
#include <string>
#include <vector>

namespace supple::tools {

struct HtmlReport {
    Machine machine;
    std::span<const ProfileRun> runs;
    std::span<const RunChange> changes; ///< --compare
    struct Picture {
        std::string file, scheme; ///< of the runs that it shows
        std::string png;          ///< its bytes
    };
    std::vector<Picture> pictures;
    std::vector<std::string> warnings; ///< of the files
    double budgetMs = 0.0;             ///< 0: none
    std::string command;               ///< that made it
};
/// HTML 5 with its styles and SVG inside, in light and dark.
[[nodiscard]] std::string toHtml(const HtmlReport& report);

} // namespace supple::tools
