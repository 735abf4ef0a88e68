#include "paint.h"

#include "mixing.h"
#include "pip_model.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature {

namespace {

const Vec3 kBack = srgb(0x0b4f7a);
const Vec3 kSkin = srgb(0x2bb5a4);
const Vec3 kBelly = srgb(0xfbe6b4);
const Vec3 kFin = srgb(0xff6a4a);
const Vec3 kFinTip = srgb(0xffc04a);
const Vec3 kCheek = srgb(0xf4907c);
const Vec3 kMouth = srgb(0x6d1830);
const Vec3 kTongue = srgb(0xf27a8c);
const Vec3 kHorn = srgb(0xfaedcf);
const Vec3 kHornTip = srgb(0xc98546);
const Vec3 kDusk = srgb(0x5a3a92);
const Vec3 kBellyBand = srgb(0xeab963);

// Skin to fin by way of violet: straight across, teal and coral would meet in mud.
Vec3 intoFin(const Vec3& skin, double t, double tip) {
    const Vec3 fin = mix(kFin, kFinTip, tip);
    return t < 0.5 ? mix(skin, kDusk, t * 2) : mix(kDusk, fin, t * 2 - 1);
}

bool odd(double ring) {
    return std::lround(ring) % 2 == 1;
}

} // namespace

std::vector<Vec3> paint(const Cage& cage) {
    std::vector<Vec3> normals(cage.points.size(), Vec3(0));
    for (const Face& face : cage.faces) {
        const Vec3 normal = cage.normal(face);
        for (int point : face.points) {
            normals[static_cast<size_t>(point)] += normal;
        }
    }
    std::vector<Vec3> colors(cage.points.size());
    for (size_t i = 0; i < cage.points.size(); ++i) {
        const Point& point = cage.points[i];
        const Vec3 p = point.position;
        const Vec3 n = glm::normalize(normals[i]);
        // Skin is darker where it faces up and back.
        Vec3 skin = mix(kSkin, kBack, ramp(-0.2, 1.0, 0.55 * n.y - 0.75 * n.z));
        Vec3& c = colors[i];
        switch (point.part) {
        case Part::Torso:
            // Dark stripes over the back, bands across the belly.
            c = odd(point.along) ? mix(skin, kBack, 0.75 * ramp(0.45, 0.0, n.z)) : mix(skin, kSkin, 0.6);
            c = mix(c, odd(point.along) ? kBellyBand : kBelly, ramp(0.50, 0.80, n.z) * ramp(0.95, 0.85, p.y));
            break;
        case Part::Belly:
            c = odd(point.along) ? kBellyBand : kBelly;
            break;
        case Part::Head:
        case Part::Lid: {
            // The stripes of the back go on over the back of the head.
            c = mix(skin, odd(point.along) ? kBack : kSkin, 0.6 * ramp(0.1, -0.5, n.z));
            // A pale jaw and muzzle.
            const double line = 1.052 + 0.075 * (p.x * p.x) / 0.16;
            c = mix(c, kBelly, ramp(line + 0.03, line - 0.01, p.y) * ramp(-0.05, 0.12, p.z));
            const Vec3 cheek = Vec3{std::abs(p.x), p.y, p.z} - Vec3{0.36, 1.075, 0.24};
            c = mix(c, kCheek, 0.8 * (1 - ramp(0.04, 0.11, glm::length(cheek))));
            break;
        }
        case Part::Mouth:
            c = kMouth;
            break;
        case Part::Ear:
            c = intoFin(skin, ramp(0.0, 0.42, point.along), ramp(0.55, 1.0, point.along));
            break;
        case Part::Wing:
            c = intoFin(skin, ramp(0.0, 0.45, point.along), ramp(0.5, 1.0, point.along));
            c = mix(c, kDusk, 0.85 * point.rib * ramp(1.02, 0.80, point.along));
            break;
        case Part::TailFin:
            c = intoFin(kSkin, ramp(0.0, 0.5, point.along), ramp(0.45, 1.0, point.along));
            break;
        case Part::Arm:
            c = mix(skin, kBack, 0.5 * ramp(0.30, 0.48, p.x));
            break;
        case Part::Thumb:
        case Part::Finger1:
        case Part::Finger2:
        case Part::Finger3:
            c = mix(skin, kBack, 0.5 + 0.3 * point.along);
            break;
        case Part::Leg:
            c = mix(skin, kBack, 0.4 * ramp(0.25, 0.10, p.y));
            break;
        case Part::Foot:
        case Part::Web: // no point's
            c = mix(skin, kBack, 0.5);
            break;
        case Part::Tail:
            c = odd(point.along) ? mix(skin, kBack, 1.0) : mix(skin, kSkin, 0.95);
            c = mix(c, kBelly, ramp(0.35, 0.85, -n.y) * ramp(-0.25, -0.45, p.z));
            break;
        case Part::Eye:
            if (point.along < 32) {
                c = srgb(0x140a12);
            } else if (point.along < 35) {
                c = srgb(0xffb62a);
            } else if (point.along < 43) {
                c = srgb(0xff9a1c);
            } else if (point.along < 51) {
                c = srgb(0x8a3206);
            } else {
                c = srgb(0xfffaf0);
            }
            break;
        case Part::EyeShine:
            c = {1, 1, 1};
            break;
        case Part::Nostril:
            c = srgb(0x083a4a);
            break;
        case Part::Tongue:
            c = kTongue;
            break;
        case Part::Tooth:
            c = srgb(0xfffdf2);
            break;
        case Part::Horn:
        case Part::Claw:
            c = mix(kHorn, kHornTip, point.part == Part::Horn ? ramp(0.4, 1.0, point.along) : 0.0);
            break;
        case Part::Spike:
            c = mix(kFin, kFinTip, point.along);
            break;
        default: // Wren's
            break;
        }
    }
    return colors;
}

} // namespace supple::creature
