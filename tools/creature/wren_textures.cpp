#include "wren_textures.h"

#include "mixing.h"
#include "pose.h"
#include "texture.h"
#include "wren.h"
#include "wren_palette.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature::wren {

namespace {

constexpr double kIris = 0.560; // its radius in the eye's picture, of the eyeball's

double blob(double x, double y, double cx, double cy, double rx, double ry) {
    const double dx = (x - cx) / rx, dy = (y - cy) / ry;
    return std::exp(-dx * dx - dy * dy);
}

// 1 on the lips, with soft edges; `shade` is 1 where they meet and under the upper one's edge.
struct Lips {
    double share, shade;
};
Lips lips(double x, double y) {
    const double s = std::min(x / 0.0268, 1.0);
    const Curve high{{0, 0.0062}, {0.33, 0.0076}, {0.70, 0.0050}, {1, 0.0006}};
    const Curve low{{0, 0.0090}, {0.4, 0.0084}, {0.75, 0.0054}, {1, 0.0006}};
    const double off = y - (kMouthLine + 0.0022 * s * s - 0.0008 * (1 - s));
    const double t = off > 0 ? off / high(s) : -off / low(s);
    return {ramp(1.20, 0.82, t) * ramp(1.06, 0.90, x / 0.0268),
            ramp(0.0016, 0.0, std::abs(off)) + 0.35 * ramp(0, 0.7, t) * (off > 0 ? 1 : 0)};
}

// The face from the front, as facePlace() lays it.
Vec3 face(double u, double v) {
    const Vec3 p = facePoint({u, v});
    const double x = std::abs(p.x), y = p.y;
    const Vec3 skin = srgb(0xf3bd9c);
    const Vec3 warm = srgb(0xe0705c), dark = srgb(0x9a4a38), lip = srgb(0xc25a52);
    // Yellower where bone is near, paler where the skin is thin; a mottle that no two places share.
    Vec3 c = mix(skin, srgb(0xf4c79c), 0.35 * ramp(1.50, 1.56, y));
    c = mix(c, srgb(0xe9b09a), 0.30 * ramp(1.40, 1.36, y));
    c = c *
        (1 + 0.025 * tiledNoise(p.x * 60 + 9.1, p.y * 60, 512, 13) + 0.02 * tiledNoise(p.x * 170, p.y * 170, 512, 14));
    c = mix(c, warm, 0.42 * blob(x, y, 0.066, 1.424, 0.030, 0.019));      // cheeks
    c = mix(c, warm, 0.40 * blob(x, y, 0, 1.430, 0.017, 0.013));          // tip of the nose
    c = mix(c, warm, 0.16 * blob(x, y, 0, 1.345, 0.022, 0.012));          // chin
    c = mix(c, dark, 0.26 * blob(x, y, 0.052, 1.494, 0.034, 0.010));      // over the lid
    c = mix(c, warm, 0.16 * blob(x, y, 0.052, 1.436, 0.028, 0.006));      // under the eye
    c = mix(c, dark, 0.20 * blob(x, y, 0.020, 1.478, 0.008, 0.016));      // beside the bridge
    c = mix(c, dark, 0.34 * ramp(1.345, 1.320, y));                       // under the jaw
    c = mix(c, dark, 0.22 * ramp(1.545, 1.590, y + 0.25 * x));            // under the hair
    c = mix(c, warm, 0.30 * ramp(0.112, 0.125, x) * ramp(1.42, 1.44, y)); // ears
    c = mix(c, lip, 0.14 * blob(x, y, 0, 1.386, 0.034, 0.018));           // round the mouth
    const Lips on = lips(x, y);
    c = mix(c, mix(srgb(0xcf7468), srgb(0x9c4440), std::min(1.0, on.shade)), 0.85 * on.share);
    c = mix(c, srgb(0x7a2f18), ramp(1.632, 1.640, y)); // what shows between the locks
    // Freckles over nose and cheeks.
    const Vec2 cell = tiledCells(p.x * 150 + 40, y * 150, 512, 5);
    const double size = 0.16 + 0.10 * tiledNoise(p.x * 150 + 40.5, y * 150 + 0.5, 512, 9);
    const double where = std::max(blob(x, y, 0.052, 1.430, 0.036, 0.014), 0.9 * blob(x, y, 0, 1.440, 0.020, 0.014));
    c = mix(c, srgb(0xb8683f), 0.55 * ramp(size + 0.10, size - 0.06, cell.x) * ramp(0.25, 0.65, where));
    return c;
}

// The iris in the middle; its rim, rays and pupil, and the shade of the lid on the white.
Vec3 eye(double u, double v) {
    const double x = (u - 0.5) * 2.1, y = (0.5 - v) * 2.1;
    const double r = std::hypot(x, y), a = std::atan2(y, x);
    const double pupil = 0.270;
    Vec3 white = mix(srgb(0xf7f1ec), srgb(0xd9a79c), 0.55 * ramp(0.62, 0.92, std::abs(x)));
    white = mix(white, srgb(0x7c6a70), 0.55 * ramp(0.18, 0.62, y));
    const double rays = 0.5 + 0.5 * std::sin(a * 23 + 2.2 * std::sin(a * 7) + 3 * std::sin(a * 3 + 1));
    const double fine = 0.5 + 0.5 * std::sin(a * 61 + 3 * std::sin(a * 11));
    const double s = std::clamp((r - pupil) / (kIris - pupil), 0.0, 1.0);
    Vec3 color = mix(srgb(0x9c7a2c), srgb(0x2f7a5c), ramp(0.05, 0.55, s + 0.22 * (rays - 0.5)));
    color = mix(color, srgb(0x6fc79a), 0.50 * (0.6 * rays + 0.4 * fine) * ramp(0.12, 0.45, s) * ramp(0.98, 0.6, s));
    color = color * mix(1.25, 0.42, ramp(-0.30, 0.40, y)); // light gathers below
    color = mix(color, srgb(0x0d2a26), 0.92 * ramp(0.74, 1.0, s));
    color = mix(srgb(0x060507), color, ramp(pupil - 0.015, pupil + 0.035, r));
    return mix(color, white, ramp(kIris - 0.030, kIris + 0.040, r));
}

// The iris is a bowl, with rays, below the cornea.
double irisHeight(double u, double v) {
    const double x = (u - 0.5) * 2.1, y = (0.5 - v) * 2.1;
    const double r = std::hypot(x, y), a = std::atan2(y, x);
    const double s = std::min(r / kIris, 1.0);
    const double rays =
        std::sin(a * 23 + 2.2 * std::sin(a * 7) + 3 * std::sin(a * 3 + 1)) * ramp(0.48, 0.6, s) * ramp(1.0, 0.85, s);
    return s * s + 0.05 * rays;
}

// The cornea stands out as a smaller ball from a larger one.
double corneaHeight(double u, double v) {
    const double r = std::hypot(u - 0.5, v - 0.5) * 2.1 / (kIris * 1.12);
    return r < 1 ? 1 - r * r : std::pow(std::max(0.0, 1.5 - r) / 0.5, 2) - 1;
}

// How rough the skin of the face is: lips are moist; brow, nose and chin shine.
double faceRoughness(double u, double v) {
    const Vec3 p = facePoint({u, v});
    const double x = std::abs(p.x), y = p.y;
    double rough = 0.51 + 0.05 * tiledNoise(p.x * 90, p.y * 90, 512, 15);
    rough -= 0.10 * blob(x, y, 0, 1.445, 0.018, 0.035);     // nose
    rough -= 0.08 * blob(x, y, 0, 1.545, 0.045, 0.030);     // forehead
    rough -= 0.05 * blob(x, y, 0, 1.350, 0.020, 0.012);     // chin
    rough -= 0.06 * blob(x, y, 0.066, 1.440, 0.026, 0.016); // cheekbone
    return mix(rough, 0.34 + 0.05 * tiledNoise(p.x * 500, p.y * 60, 512, 16), lips(x, y).share);
}

// Pores, and what lies between them.
double pores(double u, double v) {
    const Vec2 cells = tiledCells(u * 17, v * 17, 17, 17);
    return -0.7 * ramp(0.34, 0.05, cells.x) + 0.45 * tiledNoise(u * 9, v * 9, 9, 18) +
           0.35 * tiledNoise(u * 26, v * 26, 26, 19);
}

// A plain weave of sixteen threads each way a tile.
double weave(double u, double v) {
    constexpr int kThreads = 16;
    const double x = u * kThreads, y = v * kThreads;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double fx = x - i - 0.5, fy = y - j - 0.5;
    const bool warpOver = (i + j) % 2 == 0;
    const double along = warpOver ? fy : fx, across = warpOver ? fx : fy;
    const double round = std::sqrt(std::max(0.0, 1 - std::pow(across * 2.05, 2)));
    return round * (0.55 + 0.45 * std::cos(along * kPi));
}

double cloth(double u, double v) {
    return weave(u, v) + 0.5 * tiledNoise(u * 6, v * 6, 6, 21) + 0.25 * tiledNoise(u * 24, v * 24, 24, 22);
}

// Cords along both edges and a row of lozenges between them; u is along the band.
double band(double u, double v) {
    const double edge = std::min(v, 1 - v);
    const double cord =
        std::max(0.0, 1 - std::pow((edge - 0.10) / 0.055, 2)) * (0.75 + 0.25 * std::sin((u * 16 + v * 4) * 2 * kPi));
    const double x = std::abs(u * 2 - std::floor(u * 2) - 0.5), y = std::abs(v - 0.5);
    const double d = x * 0.80 + y;
    const double lozenge = ramp(0.300, 0.270, d) - ramp(0.205, 0.175, d) + ramp(0.105, 0.080, d);
    const double stitch = 0.75 + 0.25 * std::sin((u * 24 + v * 10) * 2 * kPi);
    return std::max(cord, lozenge * stitch);
}

double leather(double u, double v) {
    const Vec2 cells = tiledCells(u * 22, v * 22, 22, 31);
    const Vec2 fine = tiledCells(u * 44, v * 44, 44, 41);
    const double crease = tiledNoise(u * 5 + 0.6 * tiledNoise(u * 4, v * 4, 4, 3), v * 5, 5, 51);
    return 0.7 * ramp(0.0, 0.35, cells.y - cells.x) + 0.3 * ramp(0.0, 0.3, fine.y - fine.x) -
           0.6 * ramp(0.10, 0.0, std::abs(crease));
}

// Stitches along both edges of a strap; the rest is leather. 1 in a stitch.
double stitch(double u, double v) {
    const double edge = std::min(v, 1 - v);
    const double along = std::abs(u * 8 - std::floor(u * 8) - 0.5);
    return ramp(0.055, 0.035, std::abs(edge - 0.15)) * ramp(0.36, 0.28, along);
}

double strapHeight(double u, double v) {
    const double edge = std::min(v, 1 - v);
    const double groove = 0.9 * ramp(0.075, 0.02, std::abs(edge - 0.15));
    return 0.35 * leather(u, v) - groove + 1.7 * stitch(u, v) - 0.8 * ramp(0.06, 0.0, edge);
}

// Hair runs along v: bundles, and the single hairs of which they are.
double strands(double u, double v) {
    const double bend = 0.012 * std::sin(2 * kPi * v) + 0.006 * std::sin(4 * kPi * v + 1);
    double sum = 0;
    for (const int count : {9, 19, 43, 89}) {
        sum += tiledNoise((u + bend) * count, v * 2, count, 2, static_cast<unsigned>(60 + count)) *
               (count < 20 ? 0.34 : 0.52);
    }
    return sum;
}

// Hammered a little, scratched along v.
double worn(double u, double v) {
    double scratches = 0;
    for (int k = 0; k < 3; ++k) {
        const double tilt = 0.15 * (k - 1);
        const double n =
            tiledNoise((u + std::sin(2 * kPi * v) * tilt * 0.1) * 64, v * 3, 64, 3, static_cast<unsigned>(80 + k));
        scratches += ramp(0.72, 0.95, n);
    }
    return 0.35 * tiledNoise(u * 7, v * 7, 7, 90) - 0.5 * scratches;
}

} // namespace

std::vector<cage::Image> pictures() {
    const auto gray = [](double value) { return Vec3(value); };
    const Vec3 thread = srgb(0x27477a);
    std::vector<cage::Image> list;
    const auto add = [&](const char* name, std::vector<std::byte> bytes) {
        list.push_back({name, "image/png", std::move(bytes)});
    };
    add("face", paintPng(512, 512, true, face));
    add("eye", paintPng(256, 256, true, eye));
    add("weave", paintPng(128, 128, true, [&](double u, double v) {
            return gray(0.80 + 0.20 * weave(u, v) + 0.07 * tiledNoise(u * 6, v * 6, 6, 21));
        }));
    add("weave normal", normalPng(128, 128, 1.5, cloth));
    add("band", paintPng(128, 64, true, [&](double u, double v) {
            return mix(Vec3(0.97), thread, 0.93 * std::min(1.0, 1.15 * band(u, v)));
        }));
    add("band normal", normalPng(128, 64, 2.2, [](double u, double v) { return band(u, v) + 0.25 * weave(u, v); }));
    add("grain", paintPng(256, 256, false, [&](double u, double v) {
            const double cavity = 0.5 - 0.35 * leather(u, v) + 0.10 * tiledNoise(u * 3, v * 3, 3, 71);
            return Vec3{1, 0.48 + 0.30 * cavity, 0};
        }));
    add("grain normal", normalPng(256, 256, 2.2, leather));
    add("strap", paintPng(128, 128, true, [&](double u, double v) {
            return mix(gray(0.86 + 0.08 * leather(u, v)), Vec3(3.2, 2.6, 1.7), 0.9 * stitch(u, v));
        }));
    add("strap normal", normalPng(128, 128, 1.6, strapHeight));
    add("strands", paintPng(256, 64, true, [&](double u, double v) { return gray(0.80 + 0.24 * strands(u, v)); }));
    add("strands normal", normalPng(256, 64, 2.6, strands));
    add("worn", paintPng(128, 128, false, [&](double u, double v) { return Vec3{1, 0.30 - 0.22 * worn(u, v), 1}; }));
    add("worn normal", normalPng(128, 128, 0.8, worn));
    add("face roughness", paintPng(128, 128, false, [](double u, double v) {
            return Vec3{1, faceRoughness(u, v), 0};
        }));
    add("skin normal", normalPng(128, 128, 1.1, pores));
    add("iris normal", normalPng(128, 128, 9, irisHeight));
    add("cornea normal", normalPng(64, 64, 4.5, corneaHeight));
    return list;
}

} // namespace supple::creature::wren
