#include "tools/supple/profile_advice.h"

#include "tools/common/formatted.h"

#include <numeric>
#include <vector>

namespace supple::tools {
namespace {

/// By pass: what makes it cheaper. `inView`: of passes of which views and rates need other advice.
struct Help {
    const char* pass;
    const char* text;
    const char* inView = nullptr;
};
constexpr const char* kScheme = "It builds patches; --scheme all shows what other schemes take for it.";
constexpr const char* kLevels = "It chooses levels patch by patch: what is drawn at one rate does without it.";
constexpr Help kHelp[] = {
    {"upload", "Tables go up with a group's first frames; suppleSetUploadBudget spreads them over more."},
    {"attributes", "Texture coordinates and colors: at one rate they are made once, in views for what is drawn."},
    {"pose", "SUPPLE_GROUP_UPDATE_RATES poses who is far away in every second to eighth frame."},
    {"deform",
     "It grows with the cage's vertices, their joints, and morph targets in use. A view leaves out who is not "
     "seen."},
    {"bounds", "It measures boxes for culling; a group that is always seen can do without."},
    {"assemble", kScheme},
    {"patch", kScheme},
    {"solve", kScheme},
    {"level", kLevels},
    {"place", kLevels},
    {"evaluate",
     "Half of the --rate writes a quarter of the vertices, and --view chooses levels by the size on the screen.",
     "A smaller --budget writes fewer vertices."},
    {"motion", "It is for motion vectors alone: leave it out where nothing reads them."},
};

} // namespace

std::string adviceOf(const ProfileRun& run) {
    const auto sumOf = [](const std::vector<double>& times) {
        return std::accumulate(times.begin(), times.end(), 0.0);
    };
    const FrameTimes times = frameTimes(run);
    const double frames = sumOf(times.frame), gaps = frames - sumOf(times.covered);
    const FrameTimes::Pass* most = nullptr;
    for (const FrameTimes::Pass& pass : times.passes) {
        most = most == nullptr || sumOf(pass.times) > sumOf(most->times) ? &pass : most;
    }
    if (most == nullptr || !(frames > 0.0)) {
        return "";
    }
    if (gaps > sumOf(most->times)) {
        return formatted("%.0f %% of the frame lies between passes. With many groups, SUPPLE_CONTEXT_SHARED_DISPATCHES "
                         "leaves fewer gaps; with little work, more instances fill the device.",
                         100.0 * gaps / frames);
    }
    std::string text = most->pass + formatted(" takes %.0f %% of the frame.", 100.0 * sumOf(most->times) / frames);
    for (const Help& help : kHelp) {
        if (most->pass == help.pass) {
            text += std::string(" ") + (run.budget > 0 && help.inView != nullptr ? help.inView : help.text);
        }
    }
    return text;
}

} // namespace supple::tools
