#include "tools/supple/profile_sweep.h"

#include <algorithm>
#include <charconv>

namespace supple::tools {

Result<Sweep> parseSweep(const std::string& text) {
    const size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    Sweep sweep;
    sweep.ofRate = name == "rate";
    const uint32_t most = sweep.ofRate ? SUPPLE_MAX_RATE : 1000000u;
    if (equals == std::string::npos || (!sweep.ofRate && name != "instances")) {
        return Error{ErrorCode::argument, text + ": is not instances=.. or rate=.."};
    }
    for (size_t begin = equals + 1; begin <= text.size();) {
        const size_t end = std::min(text.find(',', begin), text.size());
        uint32_t value = 0;
        const auto [stop, failed] = std::from_chars(text.data() + begin, text.data() + end, value);
        if (failed != std::errc() || stop != text.data() + end || value == 0 || value > most) {
            return Error{ErrorCode::argument, text + ": " + name + " is a number from 1 to " + std::to_string(most)};
        }
        sweep.values.push_back(value);
        begin = end + 1;
    }
    return sweep;
}

std::vector<ProfileOptions> settingsOf(const ProfileOptions& options) {
    std::vector<ProfileOptions> settings;
    for (const std::string& text : options.sweeps) {
        const Result<Sweep> sweep = parseSweep(text); // the command line has checked it
        for (const uint32_t value : sweep ? sweep->values : std::vector<uint32_t>{}) {
            ProfileOptions& setting = settings.emplace_back(options);
            (sweep->ofRate ? setting.surface.rate : setting.instances) = value;
        }
    }
    if (settings.empty()) {
        settings.push_back(options);
    }
    return settings;
}

std::string unusedBySweeps(const ProfileOptions& options, bool givesRate, bool givesInstances) {
    bool everyRate = !options.sweeps.empty();
    bool everyCount = everyRate;
    for (const std::string& text : options.sweeps) {
        const Result<Sweep> sweep = parseSweep(text); // the command line has checked it
        everyRate = everyRate && sweep && sweep->ofRate;
        everyCount = everyCount && sweep && !sweep->ofRate;
    }
    if (everyRate && givesRate) {
        return "--rate: every run has a rate of --sweep; leave one of them out";
    }
    return everyCount && givesInstances ? "--instances: every run has a number of --sweep; leave one of them out" : "";
}

} // namespace supple::tools
