#include "surface/chains/fan_tables.h"

#include "shaders/shared/chains.h"
#include "surface/chains/net_lists.h"
#include "surface/chains/triangles.h"
#include "surface/subdivision_rules.h"

#include <vector>

namespace supple::surface::chains {

using subdivision::Fan;

namespace {

/// What lies outside of an open fan has the weight 0, or is replaced.
uint32_t pointOrCentre(const Fan& fan, uint32_t sector, int32_t a, int32_t b) {
    const uint32_t index = pointIndex(fan, sector, a, b);
    return index == subdivision::kNoPoint ? 0 : index;
}

std::vector<uint32_t> quadNetList(const Fan& fan, uint32_t sector) {
    constexpr int32_t kSide = shared::kNetSide, kPoints = shared::kNetPoints;
    std::vector<uint32_t> netList{0}; // point 0 is read by the missing cell alone
    for (int32_t k = 1; k < kPoints; ++k) {
        netList.push_back(pointOrCentre(fan, sector, k % kSide - 1, k / kSide - 1));
    }
    return netList;
}

std::vector<uint32_t> triangleNetList(const Fan& fan, uint32_t sector) {
    std::vector<uint32_t> netList;
    for (const loop::TrianglePlace& place : loop::kTriangleNet) {
        const bool missing = place.a + place.b < 0; // beside the vertex, in the missing cell
        netList.push_back(missing ? 0 : pointOrCentre(fan, sector, place.a, place.b));
    }
    return netList;
}

} // namespace

uint32_t FanTables::netListElements(Subdivision subdivision) {
    return subdivision == Subdivision::loop ? shared::kTriangleNetListElements : shared::kNetListElements;
}

const FanTables::Table& FanTables::of(const Fan& fan) {
    const auto [known, isNew] = tables_.try_emplace(fan);
    if (isNew) {
        known->second = write(fan);
    }
    return known->second;
}

FanTables::Table FanTables::write(const Fan& fan) {
    const Table table{writer_.element(), writer_.element() + 2};
    const CentreWeights weights = refineWeights(fan.subdivision, fan.sectors);
    writer_.put({fan.sectors, pointCount(fan, 3), fan.open ? 1u : 0u, 0u});
    writer_.putFloats({weights.spoke, weights.face, 0.0, 0.0});
    const uint32_t size = pointCount(fan, 3) | lastLevel_ << shared::kChainLevelShift;
    for (uint32_t h = 0; h < fan.sectors; ++h) {
        const bool loop = fan.subdivision == Subdivision::loop;
        const std::vector<uint32_t> netList = loop ? triangleNetList(fan, h) : quadNetList(fan, h);
        writeNetList(netList, 0, netListElements(fan.subdivision), {static_cast<uint32_t>(netList.size()), {}, size},
                     writer_);
    }
    return table;
}

} // namespace supple::surface::chains
