#include "pip_model.h"

#include "cage/character.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace supple::creature {

namespace {

using namespace landmark;

constexpr float kHard = supple::cage::kHardSharpness;

// A pointed or rounded stub of one column and row, in `steps` rings.
struct Ring {
    double along;
    double across;
    double deep;
    Vec3 shift{0};
};

void stub(Cage& cage, Part part, const Frame& frame, const std::vector<Ring>& rings) {
    cage.part = part;
    Frame at = frame;
    at.origin += frame.out * rings[0].along + rings[0].shift;
    Patch top = cage.beginShell(1, 1, at, rings[0].across, rings[0].deep, 0);
    for (size_t i = 1; i < rings.size(); ++i) {
        if (i > 1) {
            top = cage.extrude(top);
        }
        at.origin = frame.origin + frame.out * rings[i].along + rings[i].shift;
        cage.placeDisk(top, at, rings[i].across, rings[i].deep);
        for (int point : top.points) {
            cage.points[static_cast<size_t>(point)].along =
                static_cast<double>(i) / static_cast<double>(rings.size() - 1);
        }
    }
    cage.endShell();
}

// A shell open at its root, of rings of `sides` points; the last ring is one point, the tip.
struct Thorn {
    std::vector<std::vector<int>> rings;
    int tip = 0;

    // The line from the root to the tip at one of the sides.
    std::vector<int> line(size_t side) const {
        std::vector<int> points;
        for (const std::vector<int>& ring : rings) {
            points.push_back(ring[side]);
        }
        points.push_back(tip);
        return points;
    }
};

Thorn thorn(Cage& cage, Part part, const Frame& frame, size_t sides, const std::vector<Ring>& rings) {
    cage.part = part;
    cage.shell = ++cage.shells;
    Thorn made;
    for (size_t i = 0; i < rings.size(); ++i) {
        const Vec3 origin = frame.origin + frame.out * rings[i].along + rings[i].shift;
        const double along = static_cast<double>(i) / static_cast<double>(rings.size() - 1);
        if (i + 1 == rings.size()) {
            made.tip = cage.addPoint(origin);
            cage.points.back().along = along;
            break;
        }
        std::vector<int> ring;
        for (size_t k = 0; k < sides; ++k) {
            const double angle = 2 * kPi * static_cast<double>(k) / static_cast<double>(sides);
            ring.push_back(cage.addPoint(origin + frame.across * (rings[i].across * std::cos(angle)) +
                                         frame.along * (rings[i].deep * std::sin(angle))));
            cage.points.back().along = along;
        }
        made.rings.push_back(ring);
    }
    for (size_t i = 0; i < made.rings.size(); ++i) {
        const std::vector<int>& ring = made.rings[i];
        for (size_t k = 0; k < sides; ++k) {
            const size_t next = (k + 1) % sides;
            if (i + 1 == made.rings.size()) {
                cage.faces.push_back({{ring[k], ring[next], made.tip}, part});
            } else {
                cage.addQuad(ring[k], ring[next], made.rings[i + 1][next], made.rings[i + 1][k]);
            }
        }
    }
    cage.endShell();
    return made;
}

// A closed loop of creases.
void creaseRing(Cage& cage, std::vector<int> ring, float sharpness) {
    ring.push_back(ring.front());
    cage.creaseChain(ring, sharpness);
}

// Moves a shell's points so that its limit surface, not its cage, lies on the sphere.
void fitToSphere(Cage& cage, int shell, const Vec3& centre, double radius) {
    for (int round = 0; round < 12; ++round) {
        const std::vector<Vec3> limits = cage.limits();
        for (size_t i = 0; i < cage.points.size(); ++i) {
            if (cage.points[i].shell == shell) {
                const Vec3 offset = limits[i] - centre;
                cage.points[i].position += offset * (radius / glm::length(offset) - 1);
            }
        }
    }
}

// Where a ray meets the body's surface, taken as flat between limit points.
Vec3 castToBody(const Cage& cage, const Vec3& from, const Vec3& along) {
    const std::vector<Vec3> limits = cage.limits();
    double nearest = 1e30;
    for (const Face& face : cage.faces) {
        if (cage.points[static_cast<size_t>(face.points[0])].shell != 0) {
            continue;
        }
        for (size_t i = 1, k = 2; k < face.points.size(); ++i, ++k) {
            const Vec3& a = limits[static_cast<size_t>(face.points[0])];
            const Vec3 u = limits[static_cast<size_t>(face.points[i])] - a;
            const Vec3 v = limits[static_cast<size_t>(face.points[k])] - a;
            const Vec3 normal = glm::cross(u, v);
            const double facing = glm::dot(normal, along);
            if (facing > -1e-12) {
                continue;
            }
            const double distance = glm::dot(normal, a - from) / facing;
            const Vec3 w = from + along * distance - a;
            const double area = glm::dot(normal, normal);
            const double s = glm::dot(glm::cross(w, v), normal) / area;
            const double t = glm::dot(glm::cross(u, w), normal) / area;
            if (distance > 0 && s >= -1e-6 && t >= -1e-6 && s + t <= 1 + 1e-6) {
                nearest = std::min(nearest, distance);
            }
        }
    }
    return from + along * std::min(nearest, 10.0);
}

// Angles from the axis, of the eye's rings: the back, the white, the iris' edge, the iris, the pupil's edge, the pupil.
constexpr double kEyeAngles[] = {100, 53, 50, 42, 34, 31, 18};

// The back half, which nobody sees, is not there.
void openEyeball(Cage& cage) {
    std::vector<Ring> rings;
    for (const double degrees : kEyeAngles) {
        const double angle = degrees * kPi / 180;
        rings.push_back({kEyeRadius * std::cos(angle), kEyeRadius * std::sin(angle), kEyeRadius * std::sin(angle)});
    }
    rings.push_back({kEyeRadius, 0, 0});
    const Thorn eye = thorn(cage, Part::Eye, frameFrom(kEye, kEyeOut, {1, 0, 0}), 8, rings);
    for (size_t i = 0; i < eye.rings.size(); ++i) {
        for (int point : eye.rings[i]) {
            cage.points[static_cast<size_t>(point)].along = kEyeAngles[i];
        }
    }
    cage.points[static_cast<size_t>(eye.tip)].along = 0;
    fitToSphere(cage, cage.shells, kEye, kEyeRadius);
}

void eyeball(Cage& cage) {
    cage.part = Part::Eye;
    const Frame frame = frameFrom(kEye, kEyeOut, {1, 0, 0});
    Patch top;
    for (size_t i = 0; i < std::size(kEyeAngles); ++i) {
        const double angle = kEyeAngles[i] * kPi / 180;
        Frame at = frame;
        at.origin += frame.out * (kEyeRadius * std::cos(angle));
        const double radius = kEyeRadius * std::sin(angle);
        if (i == 0) {
            top = cage.beginShell(2, 2, at, radius, radius, kEyeRadius * 0.13);
            for (Point& point : cage.points) {
                if (point.shell == cage.shell) {
                    point.along = 150;
                }
            }
        } else {
            if (i > 1) {
                top = cage.extrude(top);
            }
            const bool last = i + 1 == std::size(kEyeAngles);
            cage.placeDisk(top, at, radius, radius, last ? kEyeRadius * (1 - std::cos(angle)) : 0);
            for (int point : top.points) {
                cage.points[static_cast<size_t>(point)].along = kEyeAngles[i];
            }
        }
    }
    const int shell = cage.shell;
    cage.endShell();
    fitToSphere(cage, shell, kEye, kEyeRadius);
}

// Modelled highlights that stay whatever the light does; on both eyes they are on the same side.
void glints(Cage& cage, Variant variant) {
    for (const double side : {1.0, -1.0}) {
        const Vec3 mirror{side, 1, 1};
        const Frame frame = frameFrom(kEye * mirror, kEyeOut * mirror, {1, 0, 0});
        const auto glint = [&](double across, double along, double size) {
            const Vec3 direction = glm::normalize(frame.out + frame.across * across + frame.along * along);
            const Frame at = frameFrom(frame.origin + direction * (kEyeRadius * 0.985), direction, {1, 0, 0});
            if (variant == Variant::mixed) {
                thorn(cage, Part::EyeShine, at, 6,
                      {{-0.012, 0.8 * size, 0.8 * size},
                       {0.004, 0.76 * size, 0.76 * size},
                       {0.010, 0.44 * size, 0.44 * size},
                       {0.012, 0, 0}});
                return;
            }
            stub(cage, Part::EyeShine, at, {{-0.012, size, size}, {0.012, size, size}});
        };
        glint(0.34, 0.42, 0.050);
        glint(-0.34, -0.34, 0.026);
    }
}

} // namespace

void addPairedDetails(Cage& cage, Variant variant) {
    Cage whole = cage;
    whole.compact();
    whole.mirror();
    const bool mixed = variant == Variant::mixed;
    mixed ? openEyeball(cage) : eyeball(cage);

    // Horns sweep back from the crown.
    const Vec3 hornOut = glm::normalize(Vec3{0.28, 0.86, -0.36});
    const Frame horn = frameFrom({0.165, 1.475, -0.02}, hornOut, {1, 0, 0});
    if (mixed) {
        // Out of a collar with a sharp rim.
        const Thorn made = thorn(cage, Part::Horn, horn, 6,
                                 {{0.010, 0.070, 0.070},
                                  {0.080, 0.061, 0.061},
                                  {0.085, 0.049, 0.049},
                                  {0.118, 0.047, 0.047, {0.003, 0, -0.007}},
                                  {0.170, 0.032, 0.032, {0.005, 0, -0.027}},
                                  {0.212, 0.016, 0.016, {0.004, 0, -0.056}},
                                  {0.236, 0, 0, {0.002, 0, -0.078}}});
        creaseRing(cage, made.rings[1], kHard);
        creaseRing(cage, made.rings[2], 3);
    } else {
        stub(cage, Part::Horn, horn,
             {{-0.03, 0.070, 0.070},
              {0.04, 0.068, 0.068},
              {0.125, 0.046, 0.046, {0.006, 0, -0.018}},
              {0.21, 0.016, 0.016, {0.004, 0, -0.072}}});
    }

    // Nostrils.
    const Frame nostril = frameFrom(castToBody(whole, {0.062, 1.32, 0.80}, {0, -0.5, -1}), {0.25, 0.5, 0.9}, {1, 0, 0});
    if (mixed) {
        thorn(cage, Part::Nostril, nostril, 4,
              {{-0.010, 0.030, 0.020}, {0.008, 0.030, 0.020}, {0.014, 0.016, 0.011}, {0.015, 0, 0}});
    } else {
        stub(cage, Part::Nostril, nostril, {{-0.010, 0.030, 0.020}, {0.018, 0.028, 0.018}});
    }

    // One small fang each side, out over the lower lip.
    const Frame fang = frameFrom({0.150, 1.085, 0.400}, {0.08, -1, 0.10}, {1, 0, 0});
    if (mixed) {
        thorn(cage, Part::Tooth, fang, 5,
              {{-0.034, 0.020, 0.016, {0, 0, -0.060}},
               {-0.008, 0.025, 0.021, {0, 0, -0.008}},
               {0.020, 0.023, 0.019},
               {0.044, 0.013, 0.011},
               {0.060, 0, 0}});
    } else {
        stub(cage, Part::Tooth, fang, {{-0.020, 0.030, 0.024}, {0.050, 0.012, 0.010}});
    }

    // Claws on the toes.
    for (int toe = 0; toe < 3; ++toe) {
        const double side = 1.0 - toe;
        const Vec3 direction = glm::normalize(Vec3{0.30 * side, -0.10, 1.0});
        const Frame at = frameFrom({kBall.x + 0.120 * side, 0.040, 0.258 - 0.024 * side * side}, direction, {1, 0, 0});
        if (mixed) {
            // A ridge along its back.
            const Thorn made = thorn(cage, Part::Claw, at, 4,
                                     {{-0.036, 0.031, 0.032},
                                      {0.010, 0.029, 0.031, {0, 0.003, 0}},
                                      {0.044, 0.017, 0.019, {0, 0, 0}},
                                      {0.070, 0, 0, {0, -0.016, 0}}});
            cage.creaseChain(made.line(1), 3);
        } else {
            stub(cage, Part::Claw, at, {{-0.030, 0.036, 0.034}, {0.046, 0.016, 0.014}});
        }
    }
}

void addMiddleDetails(Cage& cage, Variant variant) {
    glints(cage, variant);

    // A tongue, its root in the throat.
    const Frame tongue = frameFrom({0, 1.028, 0.10}, {0, 0, 1}, {1, 0, 0});
    if (variant == Variant::mixed) {
        const Thorn made = thorn(cage, Part::Tongue, tongue, 8,
                                 {{0.0, 0.082, 0.040},
                                  {0.10, 0.104, 0.042, {0, 0.004, 0}},
                                  {0.20, 0.097, 0.036, {0, 0.006, 0}},
                                  {0.265, 0.062, 0.024, {0, 0.009, 0}},
                                  {0.29, 0, 0, {0, 0.010, 0}}});
        // A furrow that runs out before the tip.
        std::vector<int> furrow = made.line(2);
        furrow.resize(3);
        for (int point : furrow) {
            cage.position(point).y -= 0.022;
        }
        cage.creaseChain(furrow, 3);
    } else {
        stub(cage, Part::Tongue, tongue,
             {{0.0, 0.110, 0.050},
              {0.10, 0.140, 0.052, {0, 0.004, 0}},
              {0.20, 0.130, 0.044, {0, 0.006, 0}},
              {0.28, 0.085, 0.026, {0, 0.010, 0}}});
    }

    // A crest from the crown down the back to the tail.
    struct Plate {
        Vec3 at;
        Vec3 out;
        double size;
    };
    const Plate plates[] = {
        {{0, 1.570, -0.02}, {0, 1, -0.15}, 0.105},    {{0, 1.495, -0.22}, {0, 0.8, -0.7}, 0.125},
        {{0, 1.310, -0.335}, {0, 0.3, -0.95}, 0.115}, {{0, 0.80, -0.172}, {0, 0.25, -1}, 0.085},
        {{0, 0.655, -0.205}, {0, 0.35, -1}, 0.100},   {{0, 0.515, -0.295}, {0, 0.8, -0.7}, 0.100},
        {{0, 0.405, -0.445}, {0, 0.85, -0.6}, 0.088}, {{0, 0.305, -0.605}, {0, 0.95, -0.35}, 0.076},

    };
    const Cage whole = cage;
    for (const Plate& plate : plates) {
        const double s = plate.size;
        const Frame at = frameFrom(castToBody(whole, plate.at + plate.out * 0.3, -plate.out), plate.out, {1, 0, 0});
        // The tip leans back along the spine.
        const Vec3 lean = -at.along * (at.along.z > 0 ? 1.0 : -1.0);
        if (variant == Variant::mixed) {
            // A blade: sharp along the front, over the tip and down the back.
            const Thorn made = thorn(cage, Part::Spike, at, 8,
                                     {{-0.45 * s, 0.28 * s, 0.60 * s},
                                      {0.20 * s, 0.25 * s, 0.60 * s, lean * (0.03 * s)},
                                      {0.72 * s, 0.13 * s, 0.34 * s, lean * (0.24 * s)},
                                      {1.16 * s, 0, 0, lean * (0.62 * s)}});
            const float sharpness = plate.at.y > 1 ? kHard : 3.0f;
            cage.creaseChain(made.line(2), sharpness);
            cage.creaseChain(made.line(6), sharpness);
            continue;
        }
        stub(cage, Part::Spike, at,
             {{-0.45 * s, 0.42 * s, 0.85 * s},
              {0.20 * s, 0.36 * s, 0.80 * s},
              {1.05 * s, 0.10 * s, 0.20 * s, lean * (0.45 * s)}});
    }
}

} // namespace supple::creature
