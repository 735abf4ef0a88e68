// Where the samples of grids lie in their patches.
#pragma once

#include "cpu/grid_sample.h"
#include "cpu/place.h"

namespace supple::cpu {

/// In the patch's own domain (PatchSet::evaluate), moved by a share of the way to its middle. Pentagons: of the sector.
[[nodiscard]] inline Place gridPlace(surface::Domain domain, uint32_t rate, uint32_t sample, double inside) {
    const surface::GridSample at = surface::gridSample(domain, rate, sample);
    const double middle = domain == surface::Domain::triangle || domain == surface::Domain::pentagon ? 1.0 / 3.0 : 0.5;
    Place place;
    place.sector = at.sector;
    place.x = static_cast<double>(at.i) / rate;
    place.y = static_cast<double>(at.j) / rate;
    if (inside > 0.0) {
        place.x += inside * (middle - place.x);
        place.y += inside * (middle - place.y);
    }
    return place;
}

} // namespace supple::cpu
