// Wren's hands: a forearm that ends in the sleeve, a palm of four by two, five fingers.
#include "wren.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace supple::creature::wren {

namespace {

// The last faces on the back of a finger; rims run round from the palm's side.
void addNail(Cage& cage, const std::vector<std::vector<int>>& rims) {
    const std::map<std::pair<int, int>, size_t> edges = cage.directedEdges();
    const size_t last = rims.size() - 1;
    for (size_t i = last - 2; i < last; ++i) {
        cage.faces[edges.at({rims[i][3], rims[i][4]})].part = Part::Nail;
    }
    cage.creaseChain({rims[last - 2][3], rims[last - 2][4]}, 2);
    for (const size_t side : {3u, 4u}) {
        cage.creaseChain({rims[last - 2][side], rims[last - 1][side], rims[last][side]}, 1.2f);
    }
}

void addFinger(Cage& cage, const Patch& base, const Finger& finger, Part part, const Vec3& back) {
    cage.part = part;
    Tube tube(cage, base);
    const Vec3 out = finger.to - finger.from;
    const Vec3 across = cage.position(base.at(base.columns, 1)) - cage.position(base.at(0, 1));
    const bool thumb = part == Part::Thumb;
    struct Ring {
        double t, wide, deep;
    };
    // Loops on both sides of each joint; the tip is flatter.
    const Ring fingerRings[] = {{0.16, 1.02, 1.06}, {0.34, 0.98, 1.0},  {0.42, 1.02, 1.04},
                                {0.50, 0.97, 0.98}, {0.65, 0.93, 0.93}, {0.72, 0.97, 0.97},
                                {0.80, 0.92, 0.90}, {0.93, 0.84, 0.78}, {1.0, 0.55, 0.50}};
    for (const Ring& ring : fingerRings) {
        if (thumb && ring.t < 0.2) {
            continue;
        }
        const Vec3 at = mix(finger.from, finger.to, ring.t);
        const double swell = thumb ? mix(1.30, 1.0, ramp(0.2, 0.6, ring.t)) : 1;
        tube.ring(frameFrom(at - back * (ring.t > 0.9 ? 0.0008 : 0), out, across), finger.radius * ring.wide * swell,
                  finger.radius * ring.deep * swell, ring.t == 1 ? finger.radius * 0.35 : 0);
    }
    tube.lay();
    addNail(cage, tube.rims);
}

Cage hand() {
    Cage cage;
    cage.part = Part::Hand;
    const Vec3 lower = glm::normalize(kWrist - kElbow);
    const Vec3 palm = glm::normalize(kKnuckles - kWrist);
    const Vec3 back = glm::normalize(Vec3{0.714, 0.70, 0});
    const Vec3 hint{0, 0, -1};
    Tube tube = Tube::begin(cage, 4, 2, frameFrom(kWrist - lower * 0.045, lower, hint), 0.026, 0.023);
    tube.ring(frameFrom(kWrist - lower * 0.020, lower, hint), 0.0255, 0.0215);
    tube.ring(frameFrom(kWrist + lower * 0.004, lower + palm, hint), 0.0250, 0.0195);
    tube.ring(frameFrom(kWrist + palm * 0.024, palm, hint), 0.0300, 0.0190);
    const Patch heel = tube.end;
    tube.ring(frameFrom(kWrist + palm * 0.052, palm, hint), 0.0370, 0.0165);
    const Patch web = tube.end;
    tube.ring(frameFrom(kKnuckles - palm * 0.006, palm, hint), 0.0400, 0.0135);
    const Patch knuckles = tube.end;
    // Four columns a finger each: evenly across, with knuckles on the back and a hollow palm.
    for (int row = 0; row <= 2; ++row) {
        for (int column = 0; column <= 4; ++column) {
            Vec3& p = cage.position(knuckles.at(column, row));
            const double s = 1 - column * 0.5;
            const double arch = 0.0035 * (1 - s * s);
            const double deep[] = {-0.0115, 0.0, 0.0118};
            p = kKnuckles + Vec3{0, 0, 0.0385 * s - 0.0005} + back * (deep[row] * (1 - 0.12 * s * s) + arch) -
                palm * (0.0035 + 0.0045 * std::abs(s) + (row == 0 ? -0.004 : 0.002) + (column == 4 ? 0.004 : 0));
        }
    }
    for (const int column : {1, 2, 3}) {
        cage.position(web.at(column, 0)) += back * 0.0035;
    }
    tube.lay();
    const Patch side = cage.patch(
        1, 2, false, {heel.at(0, 0), web.at(0, 0), heel.at(0, 1), web.at(0, 1), heel.at(0, 2), web.at(0, 2)});
    const std::array<Finger, 5> all = fingers();
    const Part parts[] = {Part::Finger1, Part::Finger2, Part::Finger3, Part::Finger4};
    for (int i = 0; i < 4; ++i) {
        std::vector<int> grid;
        for (int row = 0; row <= 2; ++row) {
            grid.push_back(knuckles.at(i, row));
            grid.push_back(knuckles.at(i + 1, row));
        }
        addFinger(cage, cage.patch(1, 2, false, grid), all[static_cast<size_t>(i)], parts[i], back);
    }
    addFinger(cage, side, all[4], Part::Thumb, back);
    cage.endShell();
    cage.compact();
    for (Point& point : cage.points) {
        point.position = handGrown(point.position);
    }
    return cage;
}

} // namespace

Cage modelHands() {
    Cage both = hand();
    append(both, reflected(both));
    return both;
}

} // namespace supple::creature::wren
