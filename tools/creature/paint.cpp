#include "paint.h"

#include "pip_model.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature {

namespace {

Vec3 srgb(unsigned hex) {
    Vec3 colour;
    for (int i = 0; i < 3; ++i) {
        const double c = static_cast<double>((hex >> (16 - 8 * i)) & 0xff) / 255.0;
        colour[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    return colour;
}

double ramp(double from, double to, double value) {
    const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

Vec3 mixed(const Vec3& a, const Vec3& b, double t) { return a + (b - a) * t; }

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
const Vec3 kSpot = srgb(0x7be3c4);

// Pale spots, mirrored. Each takes the one quad nearest to it; the surface blends it out to a soft round.
const Vec3 kSpots[] = {{0.28, 1.49, 0.06}, {0.20, 1.40, -0.28}, {0.33, 1.20, -0.22}, {0.17, 0.62, -0.18},
                       {0.28, 0.45, 0.0},  {0.10, 0.37, -0.42}, {0.07, 0.22, -0.70}};

} // namespace

std::vector<Vec3> paint(const Cage& cage) {
    std::vector<Vec3> normals(cage.points.size(), Vec3(0));
    for (const Quad& quad : cage.quads) {
        const Vec3 normal = glm::cross(cage.position(quad.points[2]) - cage.position(quad.points[0]),
                                       cage.position(quad.points[3]) - cage.position(quad.points[1]));
        for (int point : quad.points) {
            normals[static_cast<size_t>(point)] += normal;
        }
    }
    std::vector<size_t> spotted;
    for (const Vec3& spot : kSpots) {
        for (const double side : {1.0, -1.0}) {
            const Quad* nearest = nullptr;
            double best = 1e30;
            for (const Quad& quad : cage.quads) {
                Vec3 away = spot * Vec3{-side, -1, -1};
                for (int point : quad.points) {
                    away += cage.position(point) * 0.25;
                }
                // A margin, so that a tie goes to the same quad everywhere.
                if (cage.points[static_cast<size_t>(quad.points[0])].shell == 0 && glm::length(away) < best - 1e-9) {
                    best = glm::length(away);
                    nearest = &quad;
                }
            }
            for (int point : nearest->points) {
                spotted.push_back(static_cast<size_t>(point));
            }
        }
    }
    std::sort(spotted.begin(), spotted.end());
    std::vector<Vec3> colours(cage.points.size());
    for (size_t i = 0; i < cage.points.size(); ++i) {
        const Point& point = cage.points[i];
        const Vec3 p = point.position;
        const Vec3 n = glm::normalize(normals[i]);
        // Skin is darker where it faces up and back.
        Vec3 skin = mixed(kSkin, kBack, ramp(-0.2, 1.0, 0.55 * n.y - 0.75 * n.z));
        if (std::binary_search(spotted.begin(), spotted.end(), i)) {
            skin = mixed(skin, kSpot, 0.85);
        }
        const double finT = ramp(0.15, 1.0, point.along);
        Vec3& c = colours[i];
        switch (point.part) {
        case Part::Torso:
            c = mixed(skin, kBelly, ramp(0.50, 0.80, n.z) * ramp(0.95, 0.85, p.y));
            break;
        case Part::Head:
        case Part::Lid: {
            c = skin;
            // A pale jaw and muzzle.
            const double line = 1.062 + 0.03 * (p.x * p.x) / 0.16;
            c = mixed(c, kBelly, ramp(line + 0.03, line - 0.01, p.y) * ramp(-0.05, 0.12, p.z));
            const Vec3 cheek = Vec3{std::abs(p.x), p.y, p.z} - Vec3{0.335, 1.135, 0.24};
            c = mixed(c, kCheek, 0.75 * (1 - ramp(0.03, 0.11, glm::length(cheek))));
            break;
        }
        case Part::Mouth:
            c = kMouth;
            break;
        case Part::Ear:
            c = mixed(skin, mixed(kFin, kFinTip, ramp(0.55, 1.0, point.along)), ramp(0.1, 0.4, point.along));
            break;
        case Part::Wing:
            c = mixed(skin, mixed(kFin, kFinTip, ramp(0.5, 1.0, point.along)), ramp(0.1, 0.35, point.along));
            break;
        case Part::TailFin:
            c = mixed(kFin, kFinTip, finT);
            break;
        case Part::Arm:
            c = mixed(skin, kBack, 0.5 * ramp(0.30, 0.48, p.x));
            break;
        case Part::Thumb:
        case Part::Finger1:
        case Part::Finger2:
        case Part::Finger3:
            c = mixed(skin, kBack, 0.5 + 0.3 * point.along);
            break;
        case Part::Leg:
            c = mixed(skin, kBack, 0.4 * ramp(0.25, 0.10, p.y));
            break;
        case Part::Foot:
            c = mixed(skin, kBack, 0.5);
            break;
        case Part::Tail:
            c = mixed(skin, kBelly, ramp(0.35, 0.85, -n.y) * ramp(-0.25, -0.45, p.z));
            break;
        case Part::Eye:
            if (point.along < 28) {
                c = srgb(0x140a12);
            } else if (point.along < 31) {
                c = srgb(0xffb62a);
            } else if (point.along < 40) {
                c = srgb(0xff9a1c);
            } else if (point.along < 47) {
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
            c = mixed(kHorn, kHornTip, point.part == Part::Horn ? ramp(0.4, 1.0, point.along) : 0.0);
            break;
        case Part::Spike:
            c = mixed(kFin, kFinTip, point.along);
            break;
        }
    }
    return colours;
}

} // namespace supple::creature
