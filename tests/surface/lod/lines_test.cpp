// Lines of samples at levels: those of a patch have every sample of its grid once, and a workgroup has lanes for them.
#include "shaders/lod/lines.h"
#include "surface/lod/grid.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace supple::surface::lod {
namespace {

using namespace shared;

/// How often each sample is stored.
class Stored {
public:
    Stored(Form form, uint32_t capacity) : counts_(sampleCount(form, capacity)) {}
    void add(uint32_t sample) {
        ASSERT_LT(sample, counts_.size());
        ++counts_[sample];
    }
    [[nodiscard]] bool areOnce() const {
        return std::ranges::all_of(counts_, [](uint32_t count) { return count == 1; });
    }

private:
    std::vector<uint32_t> counts_;
};

void addRow(Stored& stored, SampleRow row, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) {
        stored.add(row.first + k * row.step);
    }
}

TEST(LodLines, OfRowsStoreEverySampleOnce) {
    for (const uint32_t capacity : kCapacities) {
        for (const bool columns : {false, true}) { // regular blends and polar patches; other bicubic ones
            Stored stored(Form::quad, capacity);
            for (uint32_t side = 0; side < 4; ++side) {
                addRow(stored, sideRowOf(side, capacity), capacity);
            }
            for (uint32_t n = 1; n < capacity; ++n) {
                addRow(stored, innerRowOf(n, capacity, columns), capacity - 1);
            }
            EXPECT_TRUE(stored.areOnce()) << capacity << (columns ? ", columns" : ", rows");
            EXPECT_EQ(linesOf(kLodQuadForm, capacity), 4 + (capacity - 1));
        }
    }
}

/// Of a sector's side of the ring: P_m's steps store the sample's mirror image as well.
void addRingStep(Stored& stored, uint32_t sides, uint32_t sector, RingStep at, uint32_t capacity, bool mirrored) {
    const uint32_t start = ringSideStart(sides, at.ring, sector, capacity) - at.ring;
    stored.add(start + at.k);
    if (mirrored && at.k != at.ring) {
        stored.add(start + capacity - at.k);
    }
}

TEST(LodLines, OfRingsStoreEverySampleOnce) {
    for (const uint32_t capacity : kCapacities) {
        for (const Form form : {Form::triangleRings, Form::quadRings, Form::pentagonRings}) {
            const uint32_t lines = ringLines(capacity), sides = formSides(static_cast<uint32_t>(form));
            for (const bool mirrored : {false, true}) { // Loop's triangles; P_m's sectors
                Stored stored(form, capacity);
                for (uint32_t n = 0; n < sides * lines; ++n) {
                    const uint32_t sector = n / lines, line = n % lines;
                    for (uint32_t k = line; k < capacity; k += lines) {
                        stored.add(sector * capacity + k);
                    }
                    RingStep at = firstRingStep(line, capacity);
                    while (at.ring <= at.last) {
                        addRingStep(stored, sides, sector, at, capacity, mirrored);
                        at = nextRingStep(at, mirrored ? (capacity + 1) / 2 : capacity - at.ring);
                    }
                }
                EXPECT_TRUE(stored.areOnce()) << capacity << ", " << sides << (mirrored ? " mirrored" : " sides");
            }
        }
    }
}

TEST(LodLines, HaveALaneEach) {
    uint32_t most = 0;
    for (const uint32_t capacity : kCapacities) {
        for (uint32_t form = 0; form < kLodForms; ++form) {
            most = std::max(most, linesOf(form, capacity));
        }
    }
    EXPECT_EQ(most, kMostLines);
}

} // namespace
} // namespace supple::surface::lod
