#include "tools/bench/pass_times.h"

#include "tools/common/statistics.h"

#include <algorithm>

namespace supple::bench {

namespace {

constexpr double kMillisecondsANanosecond = 1e-6;

} // namespace

PassTimes::PassTimes(std::span<const SuppleTiming> timings) {
    double begin = 0.0, end = 0.0;
    for (const SuppleTiming& one : timings) {
        if (one.pass == SUPPLE_PASS_SHORTFALL) { // is no pass
            continue;
        }
        begin = passes.empty() ? one.gpuBegin : std::min(begin, one.gpuBegin);
        end = std::max(end, one.gpuEnd);
        const char* const name = suppleGetPassName(one.pass);
        const double time = kMillisecondsANanosecond * (one.gpuEnd - one.gpuBegin);
        const auto known =
            std::find_if(passes.begin(), passes.end(), [&](const auto& pass) { return pass.first == name; });
        if (known == passes.end()) {
            passes.emplace_back(name, time);
        } else {
            known->second += time;
        }
    }
    whole = kMillisecondsANanosecond * (end - begin);
}

double PassTimes::of(const std::string& pass) const {
    const auto found = std::find_if(passes.begin(), passes.end(), [&](const auto& p) { return p.first == pass; });
    return found == passes.end() ? 0.0 : found->second;
}

double medianOf(const std::vector<PassTimes>& frames, const std::function<double(const PassTimes&)>& value) {
    std::vector<double> values;
    for (const PassTimes& frame : frames) {
        values.push_back(value(frame));
    }
    return tools::summarize(values).median;
}

} // namespace supple::bench
