// The integer parameters of a grid's samples.
#pragma once

#include "surface/grid.h"

namespace supple::surface {

/// A sample's integer parameters. quad and polar: (i, j). triangle: (i, j) as in surface/grid.h. pentagon: sector and
/// (i, j); the centre is (0, rate) of sector 0.
struct GridSample {
    uint32_t sector = 0;
    uint32_t i = 0;
    uint32_t j = 0;
};

inline GridSample gridSample(Domain domain, uint32_t rate, uint32_t sample) {
    if (domain == Domain::quad || domain == Domain::polar) {
        return {0, sample % (rate + 1), sample / (rate + 1)};
    }
    GridSample at;
    uint32_t row = rate + 1; // samples of row 0
    if (domain == Domain::pentagon) {
        const uint32_t perSector = rate * (rate + 1) / 2;
        if (sample == 5 * perSector) {
            return {0, 0, rate};
        }
        at.sector = sample / perSector;
        sample %= perSector;
        row = rate;
    }
    for (; sample >= row; --row, ++at.j) {
        sample -= row;
    }
    at.i = sample;
    return at;
}

} // namespace supple::surface
