// Wren's sword, in the right hand, and its scabbard on the left hip.
#include "wren.h"

#include "cage/character.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace supple::creature::wren {

namespace {

constexpr float kKeen = supple::cage::kHardSharpness;

// A bar of four lines: two on the flat's middle, two on the edges.
struct Section {
    double at, wide, thick;
};

void addBar(Cage& cage, const Frame& frame, const std::vector<Section>& sections, float edge, float ridge) {
    const Vec3 across = glm::normalize(frame.across + frame.along);
    const Vec3 along = glm::cross(frame.out, across);
    Tube tube = Tube::begin(cage, 1, 1, Frame{frame.origin, across, along, frame.out}, 1, 1);
    for (size_t i = 0; i < sections.size(); ++i) {
        const Vec3 origin = frame.origin + frame.out * sections[i].at;
        if (i > 0) {
            tube.ring(Frame{origin, across, along, frame.out}, 1, 1);
        }
        for (const int point : tube.rims[i]) {
            const Vec3 d = i == 0 || i == 1 ? cage.position(point) - frame.origin : cage.position(point) - origin;
            const double u = glm::dot(d, frame.across), w = glm::dot(d, frame.along);
            cage.position(point) =
                origin + frame.across * (u * sections[i].wide) + frame.along * (w * sections[i].thick);
        }
    }
    for (size_t k = 0; k < 4; ++k) {
        const Vec3 d = cage.position(tube.rims[2][k]) - frame.origin;
        const bool keen = std::abs(glm::dot(d, frame.across)) > std::abs(glm::dot(d, frame.along));
        for (size_t i = 0; i + 1 < tube.rims.size(); ++i) {
            cage.crease(tube.rims[i][k], tube.rims[i + 1][k], keen ? edge : ridge);
        }
    }
    tube.lay();
    cage.endShell();
}

void addGrip(Cage& cage, const Frame& frame) {
    cage.part = Part::Grip;
    const auto at = [&](double along) {
        Frame ring = frame;
        ring.origin += frame.out * along;
        return ring;
    };
    Tube grip = Tube::begin(cage, 2, 2, at(-0.068), 0.012, 0.0105);
    for (int i = 0; i <= 12; ++i) {
        const double bulge = 1 + 0.10 * std::sin(kPi * i / 12.0) + (i % 2 == 0 ? 0.07 : -0.03);
        grip.ring(at(mix(-0.064, 0.054, i / 12.0)), 0.0145 * bulge, 0.0125 * bulge);
    }
    grip.lay();
    cage.endShell();
    cage.part = Part::Guard;
    Tube pommel = Tube::begin(cage, 2, 2, at(-0.098), 0.010, 0.010);
    const double rings[][2] = {
        {-0.096, 0.0175}, {-0.088, 0.0205}, {-0.078, 0.0195}, {-0.070, 0.0150}, {-0.064, 0.0130}};
    for (const auto& [along, radius] : rings) {
        pommel.ring(at(along), radius, radius * 0.82);
    }
    pommel.lay();
    cage.endShell();
    std::vector<LockRing> bar;
    for (int i = 0; i <= 10; ++i) {
        const double s = i / 5.0 - 1;
        const double end = ramp(0.72, 0.95, std::abs(s));
        bar.push_back({frame.origin + frame.out * (0.062 + 0.020 * s * s) + frame.across * (0.084 * s), frame.along,
                       mix(0.0105, 0.0140, end) * (std::abs(s) > 0.98 ? 0.7 : 1),
                       mix(0.0090, 0.0115, end) * (std::abs(s) > 0.98 ? 0.7 : 1)});
    }
    lock(cage, bar);
    cage.endShell();
    // A block in the middle, where blade and grip meet.
    Frame block = frame;
    block.origin += frame.out * 0.063;
    box(cage, block, {0.036, 0.025, 0.024}, 1.5f);
}

void addScabbard(Cage& cage) {
    const Vec3 down = glm::normalize(Vec3{0.16, -0.80, -0.58});
    const Frame frame = frameFrom(kScabbard + Vec3{0.028, 0.0, 0.012}, down, {0, -0.58, 0.80});
    cage.part = Part::Scabbard;
    addBar(cage, frame,
           {{-0.020, 0.026, 0.013},
            {-0.018, 0.029, 0.0155},
            {0.0, 0.029, 0.0155},
            {0.20, 0.027, 0.0145},
            {0.40, 0.025, 0.0135},
            {0.53, 0.022, 0.012},
            {0.56, 0.018, 0.010}},
           0.6f, 0.0f);
    cage.part = Part::Guard;
    const size_t first = cage.points.size();
    const auto band = [&](double at, double wide, double thick, double length) {
        Frame ring = frame;
        ring.origin += frame.out * at;
        addBar(cage, ring,
               {{0, wide * 0.9, thick * 0.9},
                {0.002, wide, thick},
                {length * 0.5, wide, thick},
                {length, wide, thick},
                {length + 0.002, wide * 0.85, thick * 0.85}},
               0.6f, 0.0f);
    };
    band(-0.026, 0.034, 0.0195, 0.040);
    band(0.135, 0.0315, 0.0180, 0.016);
    band(0.505, 0.0275, 0.0155, 0.062);
    for (size_t i = first; i < cage.points.size(); ++i) {
        cage.points[i].part = Part::Scabbard;
    }
}

} // namespace

Cage modelSword() {
    Cage sword;
    const Vec3 palm = glm::normalize(kKnuckles - kWrist);
    const Frame frame = frameFrom(grip(), {0, 0, 1}, palm);
    addGrip(sword, frame);
    sword.part = Part::Blade;
    Frame root = frame;
    root.origin += frame.out * 0.066;
    addBar(sword, root,
           {{0, 0.024, 0.0050},
            {0.004, 0.0245, 0.0052},
            {0.10, 0.0240, 0.0050},
            {0.30, 0.0225, 0.0046},
            {0.48, 0.0200, 0.0040},
            {0.555, 0.0165, 0.0034},
            {0.600, 0.0085, 0.0020},
            {0.618, 0.0012, 0.0006}},
           kKeen, kKeen);
    Cage cage = reflected(sword);
    addScabbard(cage);
    return cage;
}

} // namespace supple::creature::wren
