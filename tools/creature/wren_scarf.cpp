// Wren's scarf: wound twice round the neck, its ends down the back.
#include "wren.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace supple::creature::wren {

namespace {

void addTurn(Cage& cage, const Vec3& middle, const Vec2& radii, double dip, double thick, double phase) {
    std::vector<StrapPoint> path;
    constexpr int kCount = 22;
    for (int i = 0; i < kCount; ++i) {
        const double a = 2 * kPi * i / kCount;
        const Vec3 out{std::sin(a), 0, std::cos(a)};
        const double front = 0.5 + 0.5 * std::cos(a);
        path.push_back({middle + Vec3{out.x * radii.x, -dip * front * front + 0.004 * std::sin(2 * a + phase),
                                      out.z * radii.y + 0.010 * front},
                        glm::normalize(out + Vec3{0, 0.25 + 0.15 * front, 0})});
    }
    torus(cage, path, 8, [&](size_t i, int k) {
        const double a = 2 * kPi * k / 8;
        const double turn = 2 * kPi * static_cast<double>(i) / kCount;
        // Folds run round with the cloth and slip from one place of its section to another.
        const double fold = 1 + 0.20 * std::sin(3 * a + 2 * turn + phase) + 0.08 * std::sin(5 * turn + 2 * a + phase);
        return Vec2{std::cos(a) * 0.78, std::sin(a) * 1.18} * (thick * fold);
    });
}

void addTail(Cage& cage, double shift, double length, double wide, double phase) {
    const size_t firstFace = cage.faces.size();
    const std::vector<Vec3> line = spline({std::begin(kScarfTail), std::end(kScarfTail)}, 33);
    const auto surface = [&](double u, double v) {
        const double at = std::clamp(v, -0.01, 1.01) * length * 32;
        const size_t k = static_cast<size_t>(std::clamp(at, 0.0, 31.0));
        const Vec3 p = line[k] + (line[k + 1] - line[k]) * (at - static_cast<double>(k));
        const double s = 2 * u - 1;
        const double half = wide * mix(0.55, 1, ramp(0, 0.5, v)) * 0.5;
        const double wave = 0.010 * std::sin(3.2 * s + phase + 3 * v) * ramp(0, 0.4, v);
        return p + Vec3{shift + s * half, -0.010 * s * shift * 20 * v, wave - 0.008 * std::abs(shift * 20)};
    };
    const Sheet made = sheet(
        cage, 5, 11, [&](double u, double v) { return surface(1 - u, v * -1 + 1); }, 0.007);
    creaseSheet(cage, made, 1.5f);
    cage.endShell();
    // The end is of another color.
    for (size_t f = firstFace; f < cage.faces.size(); ++f) {
        if (cage.centre(cage.faces[f]).y < surface(0.5, 0.86).y) {
            cage.faces[f].part = Part::ScarfFringe;
        }
    }
}

} // namespace

Cage modelScarf() {
    Cage cage;
    cage.part = Part::Scarf;
    addTurn(cage, {0, 1.284, -0.012}, {0.0830, 0.0770}, 0.026, 0.0275, 0.4);
    addTurn(cage, {0, 1.318, -0.010}, {0.0690, 0.0660}, 0.018, 0.0215, 2.1);
    const size_t first = cage.points.size();
    addTail(cage, 0.0, 1.0, 0.082, 0.2);
    addTail(cage, 0.030, 0.74, 0.070, 1.9);
    for (size_t i = first; i < cage.points.size(); ++i) {
        cage.points[i].rib = 1;
    }
    return cage;
}

} // namespace supple::creature::wren
