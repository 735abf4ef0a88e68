#include "tools/supple/bezier_net.h"

#include <array>

namespace supple::tools {
namespace {

using surface::PatchClass;

/// A cubic of degree 5: what the coefficient j of degree 3 counts in coefficient i, C(3, j) C(2, i - j) / C(5, i).
constexpr double kRaised[6][4] = {{1.0, 0.0, 0.0, 0.0}, {0.4, 0.6, 0.0, 0.0}, {0.1, 0.6, 0.3, 0.0},
                                  {0.0, 0.3, 0.6, 0.1}, {0.0, 0.0, 0.6, 0.4}, {0.0, 0.0, 0.0, 1.0}};

std::vector<glm::dvec3> raised(std::span<const glm::dvec3> cubic) {
    std::array<glm::dvec3, 24> rows{}; // i + 6 j: raised along u alone
    for (size_t j = 0; j < 4; ++j) {
        for (size_t i = 0; i < 6; ++i) {
            for (size_t k = 0; k < 4; ++k) {
                rows[i + 6 * j] += kRaised[i][k] * cubic[k + 4 * j];
            }
        }
    }
    std::vector<glm::dvec3> quintic(36, glm::dvec3(0.0));
    for (size_t j = 0; j < 6; ++j) {
        for (size_t i = 0; i < 6; ++i) {
            for (size_t k = 0; k < 4; ++k) {
                quintic[i + 6 * j] += kRaised[j][k] * rows[i + 6 * k];
            }
        }
    }
    return quintic;
}

/// The place of the coefficient (a, b) of a corner's frame in a net of degree 5 (docs/prep.md, conventions).
size_t placeInNet(size_t corner, size_t a, size_t b) {
    switch (corner) {
    case 0:
        return a + 6 * b;
    case 1:
        return 5 - b + 6 * a;
    case 2:
        return 5 - a + 6 * (5 - b);
    default:
        return b + 6 * (5 - a);
    }
}

/// `h`: for each edge h20, h30, h21, h31.
void addPerturbation(std::vector<glm::dvec3>& quintic, std::span<const glm::vec3> h) {
    for (size_t edge = 0; edge < 4; ++edge) {
        for (size_t s = 0; s < 4; ++s) {
            quintic[placeInNet(edge, 2 + s % 2, s / 2)] += glm::dvec3(h[4 * edge + s]);
        }
    }
}

} // namespace

bool hasBezierNet(PatchClass patchClass) {
    return patchClass == PatchClass::regular || patchClass == PatchClass::perturbed || patchClass == PatchClass::polar;
}

std::optional<BezierNet> bezierNet(PatchClass patchClass, std::span<const glm::vec3> stored) {
    if (!hasBezierNet(patchClass)) {
        return std::nullopt;
    }
    const size_t given = patchClass == PatchClass::polar ? 13 : 16;
    std::vector<glm::dvec3> cubic(stored.begin(), stored.begin() + static_cast<ptrdiff_t>(given));
    cubic.resize(16, cubic.back());
    if (patchClass != PatchClass::perturbed) {
        return BezierNet{3, std::move(cubic)};
    }
    BezierNet net{5, raised(cubic)};
    addPerturbation(net.coefficients, stored.subspan(16, 16));
    return net;
}

} // namespace supple::tools
