#include "cage/gltf/markers.h"

#include "cage/clip_checks.h"
#include "cage/entry_faults.h"

#include <optional>

namespace supple::cage::gltf {
namespace {

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
    marker.name = name->string();
    return placeMarker(time->number(), first, duration, marker);
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
    sortMarkers(markers);
    return markers;
}

} // namespace supple::cage::gltf
