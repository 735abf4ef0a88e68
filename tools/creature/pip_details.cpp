#include "pip_model.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace supple::creature {

namespace {

using namespace landmark;

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
        for (const auto& [i, k] : {std::pair<size_t, size_t>{1, 2}, {2, 3}}) {
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

void eyeball(Cage& cage) {
    cage.part = Part::Eye;
    const Frame frame = frameFrom(kEye, kEyeOut, {1, 0, 0});
    // Angles from the axis: pupil, its edge, iris, its edge, the white, and round the back.
    const double angles[] = {100, 53, 50, 42, 34, 31, 18};
    Patch top;
    for (size_t i = 0; i < std::size(angles); ++i) {
        const double angle = angles[i] * kPi / 180;
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
            const bool last = i + 1 == std::size(angles);
            cage.placeDisk(top, at, radius, radius, last ? kEyeRadius * (1 - std::cos(angle)) : 0);
            for (int point : top.points) {
                cage.points[static_cast<size_t>(point)].along = angles[i];
            }
        }
    }
    const int shell = cage.shell;
    cage.endShell();
    fitToSphere(cage, shell, kEye, kEyeRadius);
}

// Modelled highlights that stay whatever the light does; on both eyes they are on the same side.
void glints(Cage& cage) {
    for (const double side : {1.0, -1.0}) {
        const Vec3 mirror{side, 1, 1};
        const Frame frame = frameFrom(kEye * mirror, kEyeOut * mirror, {1, 0, 0});
        const auto glint = [&](double across, double along, double size) {
            const Vec3 direction = glm::normalize(frame.out + frame.across * across + frame.along * along);
            const Frame at = frameFrom(frame.origin + direction * (kEyeRadius * 0.985), direction, {1, 0, 0});
            stub(cage, Part::EyeShine, at, {{-0.012, size, size}, {0.012, size, size}});
        };
        glint(0.34, 0.42, 0.050);
        glint(-0.34, -0.34, 0.026);
    }
}

} // namespace

void addPairedDetails(Cage& cage, [[maybe_unused]] Variant variant) {
    Cage whole = cage;
    whole.compact();
    whole.mirror();
    eyeball(cage);

    // Horns sweep back from the crown.
    const Vec3 hornOut = glm::normalize(Vec3{0.28, 0.86, -0.36});
    const Frame horn = frameFrom({0.165, 1.475, -0.02}, hornOut, {1, 0, 0});
    stub(cage, Part::Horn, horn,
         {{-0.03, 0.070, 0.070},
          {0.04, 0.068, 0.068},
          {0.125, 0.046, 0.046, {0.006, 0, -0.018}},
          {0.21, 0.016, 0.016, {0.004, 0, -0.072}}});

    // Nostrils.
    stub(cage, Part::Nostril,
         frameFrom(castToBody(whole, {0.062, 1.32, 0.80}, {0, -0.5, -1}), {0.25, 0.5, 0.9}, {1, 0, 0}),
         {{-0.010, 0.030, 0.020}, {0.018, 0.028, 0.018}});

    // One small fang each side, out over the lower lip.
    stub(cage, Part::Tooth, frameFrom({0.150, 1.085, 0.400}, {0.08, -1, 0.10}, {1, 0, 0}),
         {{-0.020, 0.030, 0.024}, {0.050, 0.012, 0.010}});

    // Claws on the toes.
    for (int toe = 0; toe < 3; ++toe) {
        const double side = 1.0 - toe;
        const Vec3 direction = glm::normalize(Vec3{0.30 * side, -0.10, 1.0});
        const Frame at = frameFrom({kBall.x + 0.120 * side, 0.040, 0.258 - 0.024 * side * side}, direction, {1, 0, 0});
        stub(cage, Part::Claw, at, {{-0.030, 0.036, 0.034}, {0.046, 0.016, 0.014}});
    }
}

void addMiddleDetails(Cage& cage, [[maybe_unused]] Variant variant) {
    glints(cage);

    // A tongue, its root in the throat.
    stub(cage, Part::Tongue, frameFrom({0, 1.028, 0.10}, {0, 0, 1}, {1, 0, 0}),
         {{0.0, 0.110, 0.050},
          {0.10, 0.140, 0.052, {0, 0.004, 0}},
          {0.20, 0.130, 0.044, {0, 0.006, 0}},
          {0.28, 0.085, 0.026, {0, 0.010, 0}}});

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
        stub(cage, Part::Spike, at,
             {{-0.45 * s, 0.42 * s, 0.85 * s},
              {0.20 * s, 0.36 * s, 0.80 * s},
              {1.05 * s, 0.10 * s, 0.20 * s, lean * (0.45 * s)}});
    }
}

} // namespace supple::creature
