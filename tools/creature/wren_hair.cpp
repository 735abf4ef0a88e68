// Wren's hair: a cap on the scalp, locks swept back over it, a fringe, locks beside the face, a ponytail.
#include "wren.h"

#include "pose.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace supple::creature::wren {

namespace {

constexpr Vec3 kScalp{0, 1.535, -0.015};
constexpr Vec3 kKnot{0, 1.624, -0.130};

// On the scalp: degrees to the left of the front, degrees up, and how far off the skull.
Vec3 scalp(double side, double up, double off) {
    const double a = side * kPi / 180, b = up * kPi / 180;
    const Vec3 d{std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b)};
    // The skull is fuller than a ball towards the nape.
    const double nape = 0.021 * ramp(-4, -46, up) * ramp(0.1, -0.6, d.z);
    return kScalp + d * (Vec3{0.1225, 0.135, d.z > 0 ? 0.117 : 0.131} + Vec3(off + nape));
}

Vec3 outward(const Vec3& p) {
    return glm::normalize((p - kScalp) / Vec3{0.015, 0.018, 0.016});
}

double hairline(double side) {
    const Curve line{{0, 43}, {25, 40}, {45, 30}, {62, 12}, {74, -10}, {92, -16}, {104, -38}, {130, -54}, {180, -58}};
    return line(std::abs(side));
}

void addCap(Cage& cage) {
    const Frame up{kScalp, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    Tube tube = Tube::begin(cage, 5, 5, up, 0.05, 0.05);
    struct Ring {
        double share, off;
    };
    const Ring rings[] = {{-0.02, -0.004}, {0.03, 0.006}, {0.18, 0.013}, {0.45, 0.017}, {0.75, 0.020}, {1, 0.022}};
    for (const Ring& ring : rings) {
        tube.ring(up, 0.05, 0.05);
        for (const int point : tube.end.points) {
            Vec3& p = cage.position(point);
            const double side = std::atan2(p.x, p.z) * 180 / kPi;
            const double off = glm::length(Vec3{p.x - kScalp.x, 0, p.z - kScalp.z}) / 0.05;
            const double at = mix(hairline(side), 64, ring.share);
            p = scalp(side, off > 0.98 ? at : 90 - 26 * off, ring.off);
        }
    }
    tube.lay();
    cage.endShell();
}

// A lock along places off the scalp; it swells from its root and runs to a point, unless it ends in the knot.
struct Place {
    double side, up, off;
};

void addLock(Cage& cage, const std::vector<Place>& places, double wide, double thick, double tip, double root = 0.45) {
    std::vector<Vec3> through;
    for (const Place& place : places) {
        through.push_back(scalp(place.side, place.up, place.off));
    }
    constexpr int kRings = 9;
    const std::vector<Vec3> path = spline(through, kRings);
    std::vector<LockRing> rings;
    for (int i = 0; i < kRings; ++i) {
        const double s = static_cast<double>(i) / (kRings - 1);
        const double swell = mix(root, 1, ramp(0, 0.35, s)) * mix(1, tip, ramp(0.45, 1, s) * ramp(0.2, 1, s));
        rings.push_back({path[static_cast<size_t>(i)], outward(path[static_cast<size_t>(i)]), wide * swell,
                         thick * mix(root, 1, swell)});
    }
    lock(cage, rings);
    cage.endShell();
}

// From the hairline back to the knot.
void addSwept(Cage& cage, double side, double wide, double lift) {
    const double start = hairline(side);
    // Each lock ends in a place of its own.
    const Vec3 knot = kKnot - kScalp;
    const double knotSide = (side < 0 ? -180.0 : 180.0) - 0.045 * side;
    const double knotUp = std::atan2(knot.y, -knot.z) * 180 / kPi;
    std::vector<Place> places;
    const Vec3 a = glm::normalize(scalp(side, start, 0) - kScalp);
    const Vec3 b = glm::normalize(scalp(knotSide, knotUp, 0) - kScalp);
    const double angle = std::acos(glm::dot(a, b));
    for (int i = 0; i <= 5; ++i) {
        const double s = i / 5.0;
        const Vec3 d = (a * std::sin((1 - s) * angle) + b * std::sin(s * angle)) / std::sin(angle);
        places.push_back({std::atan2(d.x, d.z) * 180 / kPi, std::asin(d.y) * 180 / kPi,
                          0.004 + lift * std::sin(kPi * std::min(1.0, s * 1.10 + 0.03))});
    }
    addLock(cage, places, wide, 0.0115, 0.55, 0.16);
}

void addFringe(Cage& cage) {
    // Parted on the left; the long side sweeps over the forehead to the right.
    addLock(cage,
            {{24, 62, 0.012}, {4, 52, 0.026}, {-22, 38, 0.033}, {-44, 20, 0.030}, {-60, 0, 0.020}, {-66, -16, 0.012}},
            0.0250, 0.0125, 0.08);
    addLock(cage,
            {{26, 66, 0.012}, {2, 60, 0.025}, {-30, 48, 0.032}, {-56, 28, 0.030}, {-72, 4, 0.022}, {-76, -24, 0.016}},
            0.0260, 0.0125, 0.08);
    addLock(cage, {{22, 58, 0.010}, {12, 44, 0.026}, {-6, 30, 0.034}, {-24, 18, 0.034}, {-38, 8, 0.028}}, 0.0200,
            0.0110, 0.06);
    addLock(cage,
            {{26, 58, 0.010}, {32, 48, 0.022}, {46, 32, 0.028}, {58, 14, 0.024}, {66, -4, 0.016}, {68, -20, 0.012}},
            0.0230, 0.0115, 0.08);
    addLock(cage, {{25, 62, 0.012}, {42, 56, 0.022}, {62, 36, 0.025}, {74, 10, 0.020}, {78, -20, 0.016}}, 0.0230,
            0.0115, 0.10);
    addLock(cage, {{20, 56, 0.014}, {22, 42, 0.028}, {30, 28, 0.034}, {44, 14, 0.032}}, 0.0120, 0.0080, 0.05);
}

// Locks that hang before the ears.
void addSideLocks(Cage& cage) {
    for (const double side : {1.0, -1.0}) {
        const auto hang = [&](const std::vector<Vec3>& through, double wide) {
            std::vector<LockRing> rings;
            const std::vector<Vec3> path = spline(through, 10);
            for (int i = 0; i < 10; ++i) {
                const double s = i / 9.0;
                const Vec3 p = path[static_cast<size_t>(i)] * Vec3{side, 1, 1};
                const double swell = mix(0.5, 1, ramp(0, 0.3, s)) * mix(1, 0.06, ramp(0.5, 1, s));
                rings.push_back({p, glm::normalize(Vec3{side, 0, 0.35}), wide * swell, 0.0085 * mix(0.4, 1, swell)});
            }
            lock(cage, rings);
            cage.endShell();
        };
        hang({{0.112, 1.560, 0.040},
              {0.128, 1.500, 0.040},
              {0.132, 1.440, 0.040},
              {0.122, 1.385, 0.046},
              {0.108, 1.345, 0.052},
              {0.112, 1.318, 0.052}},
             0.0170);
        hang({{0.116, 1.550, 0.022},
              {0.131, 1.495, 0.018},
              {0.137, 1.440, 0.018},
              {0.134, 1.395, 0.022},
              {0.126, 1.366, 0.026}},
             0.0140);
    }
}

void addPonytail(Cage& cage) {
    const size_t first = cage.points.size();
    struct Strand {
        double x, back, length, wide;
    };
    const Strand strands[] = {{0, 0.012, 1.0, 0.036},       {0.024, 0, 0.94, 0.030},       {-0.024, 0, 0.97, 0.030},
                              {0.014, -0.022, 0.88, 0.028}, {-0.015, -0.022, 0.84, 0.028}, {0.0, -0.010, 1.06, 0.026}};
    for (const Strand& strand : strands) {
        const double sway = strand.x * 0.4;
        std::vector<Vec3> through{kKnot + Vec3{strand.x * 0.25, 0.004, 0.004}};
        const double swell[] = {0.9, 1.5, 1.5, 1.0};
        for (int i = 0; i <= kTailJoints; ++i) {
            const Vec3 t = i == 0 ? kTail[0] + Vec3{0, 0.012, -0.022} : kTail[i];
            const Vec3 off = Vec3{strand.x, 0, 0} + Vec3{0, 0.5, -0.86} * strand.back;
            through.push_back(t + off * swell[i] + Vec3{sway * i * 0.3, 0, 0});
        }
        const Vec3 end = through.back() + (through.back() - through[through.size() - 2]) * 0.42 + Vec3{sway, 0, 0.018};
        through.push_back(end);
        const std::vector<Vec3> path = spline(through, 13);
        std::vector<LockRing> rings;
        for (int i = 0; i < 13; ++i) {
            const double s = i / 12.0;
            const double girth = mix(0.42, 1, ramp(0.02, 0.35, s)) * mix(1, 0.05, std::pow(ramp(0.35, 1.02, s), 1.2));
            const Vec3& at = path[static_cast<size_t>(i)];
            rings.push_back({Vec3{at.x, at.y + (1 - strand.length) * 0.25 * s, at.z},
                             glm::normalize(Vec3{strand.x * 14, 0.35, -0.9}), strand.wide * girth,
                             strand.wide * 0.62 * girth});
        }
        lock(cage, rings);
        cage.endShell();
    }
    cage.part = Part::Ribbon;
    std::vector<StrapPoint> path;
    const Frame knot = frameFrom(kKnot + Vec3{0, 0.008, -0.020}, {0, 0.35, -1}, {1, 0, 0});
    for (int i = 0; i < 12; ++i) {
        const double a = 2 * kPi * i / 12;
        const Vec3 out = knot.across * std::cos(a) + knot.along * std::sin(a);
        path.push_back({knot.origin + out * 0.0225, out});
    }
    torus(cage, path, 6, [](size_t, int k) {
        return Vec2{0.0055, 0.0115} * Vec2{std::cos(2 * kPi * k / 6), std::sin(2 * kPi * k / 6)};
    });
    for (size_t i = first; i < cage.points.size(); ++i) {
        cage.points[i].rib = 1;
    }
}

} // namespace

Cage modelHair() {
    Cage cage;
    cage.part = Part::Hair;
    addCap(cage);
    for (const double side : {34.0, 50.0, 66.0, 80.0, 98.0, 116.0, 140.0, 165.0}) {
        addSwept(cage, side, 0.0255, side < 90 ? 0.013 : 0.010);
        addSwept(cage, -side, 0.0255, side < 90 ? 0.013 : 0.010);
    }
    addSwept(cage, 18, 0.026, 0.017);
    addSwept(cage, -18, 0.026, 0.016);
    addSwept(cage, 0, 0.026, 0.014);
    addFringe(cage);
    addSideLocks(cage);
    addPonytail(cage);
    grow(cage);
    return cage;
}

} // namespace supple::creature::wren
