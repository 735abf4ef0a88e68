#include "surface/exact/fan_tables.h"

#include "shaders/shared/exact.h"
#include "surface/subdivision_rules.h"

#include <array>

namespace supple::surface::exact {

using subdivision::Fan;

const FanTables::Table& FanTables::of(const Fan& fan) {
    const auto [known, isNew] = tables_.try_emplace(fan);
    if (isNew) {
        known->second = write(fan);
    }
    return known->second;
}

FanTables::Table FanTables::write(const Fan& fan) {
    const Table table{writer_.element(), writer_.element() + 2};
    const CentreWeights weights = refineWeights(Subdivision::catmullClark, fan.sectors);
    writer_.put({fan.sectors, pointCount(fan, 3), fan.open ? 1u : 0u, 0u});
    writer_.putFloats({weights.spoke, weights.face, 0.0, 0.0});
    constexpr int32_t kSide = shared::kNetSide, kPoints = shared::kNetPoints;
    for (uint32_t h = 0; h < fan.sectors; ++h) {
        std::array<uint32_t, size_t{8} * shared::kWindowElements> window{};
        for (int32_t k = 1; k < kPoints; ++k) { // point 0 is read by the missing cell alone
            const uint32_t index = pointIndex(fan, h, k % kSide - 1, k / kSide - 1);
            window[static_cast<size_t>(k)] = index == subdivision::kNoPoint ? 0 : index; // its weight is 0
        }
        writer_.putHalves(window);
    }
    return table;
}

} // namespace supple::surface::exact
