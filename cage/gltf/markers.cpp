#include "cage/gltf/markers.h"

#include "cage/gltf/entry_faults.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace supple::cage::gltf {
namespace {

/// Keys are floats, and the times of markers need not be: what rounding alone moves out of the clip is in it.
constexpr double kTimeRounding = 1e-6;

/// Why an entry is no marker, or nothing.
std::optional<std::string> readMarker(const Json& entry, double first, double duration, Marker& marker) {
    if (!entry.isObject()) {
        return "not an object";
    }
    const Json* name = member(entry, "name");
    const Json* time = member(entry, "time");
    if (name == nullptr || !name->isString()) {
        return "name is not a string";
    }
    if (time == nullptr || !time->isNumber() || !isFiniteFloat(*time)) {
        return "time is not a finite number";
    }
    const double given = time->number();
    const double slack = kTimeRounding * std::max({std::abs(given), std::abs(first), duration});
    if (given - first < -slack) {
        return "time " + shortNumber(given) + " is before the clip's beginning";
    }
    if (given - first > duration + slack) {
        return "time " + shortNumber(given) + " is behind the clip's end, " + shortNumber(first + duration) + " s";
    }
    marker = {name->string(), std::clamp(given - first, 0.0, duration)};
    return std::nullopt;
}

} // namespace

std::vector<Marker> readMarkers(const Json& extras, const std::string& element, double first, double duration,
                                Warnings& warnings) {
    const Json* entries = extras.isObject() ? member(extras, "markers") : nullptr;
    if (entries == nullptr) {
        return {};
    }
    const std::string list = element + " extras markers";
    if (!entries->isArray()) {
        warn(warnings, list, "not an array; ignored");
        return {};
    }
    std::vector<Marker> markers;
    EntryFaults faults(list);
    for (size_t i = 0; i < entries->size(); ++i) {
        Marker marker;
        if (const std::optional<std::string> fault = readMarker((*entries)[i], first, duration, marker)) {
            faults.add(i, *fault);
        } else {
            markers.push_back(std::move(marker));
        }
    }
    faults.report(warnings);
    std::stable_sort(markers.begin(), markers.end(), [](const Marker& a, const Marker& b) { return a.time < b.time; });
    return markers;
}

} // namespace supple::cage::gltf
