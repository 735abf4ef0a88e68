#include "cage/gltf/keys.h"

#include "cage/clip_checks.h"
#include "cage/entry_faults.h"
#include "cage/limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace supple::cage::gltf {
namespace {

/// Per key whether it stays. Moves keys that are at the time of another.
std::vector<uint8_t> keysInOrder(const std::string& input, Leniency& leniency, std::vector<float>& times) {
    EntryFaults broken(input), late(input), equal(input);
    std::vector<uint8_t> stays(times.size(), 1);
    float last = -std::numeric_limits<float>::infinity(); // as the file has it
    float lastMoved = last;
    for (size_t k = 0; k < times.size(); ++k) {
        constexpr const char* kNotLater = "not later than the key before it";
        if (!std::isfinite(times[k])) {
            broken.add(k, "not finite");
            stays[k] = 0;
        } else if (times[k] < last) {
            late.add(k, kNotLater);
            stays[k] = 0;
        } else {
            last = times[k];
            if (times[k] <= lastMoved) {
                times[k] = std::nextafter(lastMoved, std::numeric_limits<float>::infinity());
                equal.add(k, kNotLater);
            }
            lastMoved = times[k];
        }
    }
    broken.report(leniency, "the key is left out");
    late.report(leniency, "the key is left out");
    equal.report(leniency, "moved behind it");
    return stays;
}

void dropKeysWithoutValue(const std::string& output, size_t elementWidth, size_t keyWidth, Leniency& leniency,
                          const Channel& channel, std::vector<uint8_t>& stays) {
    EntryFaults faults(output);
    const size_t elementsPerKey = keyWidth / elementWidth;
    for (size_t k = 0; k < stays.size(); ++k) {
        const std::span<const float> values = std::span(channel.values).subspan(k * keyWidth, keyWidth);
        size_t place = 0;
        while (place < keyWidth && faultOfCoordinate(values[place]) == nullptr) {
            ++place;
        }
        if (place < keyWidth) {
            faults.add(k * elementsPerKey + place / elementWidth, faultOfCoordinate(values[place]));
            stays[k] = 0;
        } else if (channel.path == ChannelPath::rotation && isZeroRotation(&values[elementsPerKey / 2 * 4])) {
            faults.add(k * elementsPerKey + elementsPerKey / 2, "zero quaternion");
            stays[k] = 0;
        }
    }
    faults.report(leniency, "the key is left out");
}

} // namespace

void mendKeys(const std::string& input, const std::string& output, size_t elementWidth, Leniency& leniency,
              Channel& channel) {
    const size_t keys = channel.times.size(), keyWidth = channel.values.size() / keys;
    std::vector<uint8_t> stays = keysInOrder(input, leniency, channel.times);
    dropKeysWithoutValue(output, elementWidth, keyWidth, leniency, channel, stays);
    size_t kept = 0;
    for (size_t k = 0; k < keys; ++k) {
        if (stays[k] != 0) {
            channel.times[kept] = channel.times[k];
            std::copy_n(channel.values.begin() + static_cast<ptrdiff_t>(k * keyWidth), keyWidth,
                        channel.values.begin() + static_cast<ptrdiff_t>(kept * keyWidth));
            ++kept;
        }
    }
    if (kept == 0) {
        refuse(input, "no key is left");
    }
    channel.times.resize(kept);
    channel.values.resize(kept * keyWidth);
}

} // namespace supple::cage::gltf
