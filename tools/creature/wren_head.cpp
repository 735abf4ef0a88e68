// Wren's head: rings from the neck to the crown, with loops drawn in round eyes, mouth and ears.
#include "wren.h"

#include "pose.h"
#include "wren_palette.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature::wren {

namespace {

// A ring of the head. Its plane tilts from the front to the back; its outline is a superellipse.
struct Level {
    double yFront, yBack, z, side, front, back;
};

constexpr Level kLevels[] = {
    {1.235, 1.240, -0.016, 0.058, 0.048, 0.052},    {1.270, 1.275, -0.014, 0.047, 0.042, 0.046},
    {1.306, 1.322, -0.012, 0.043, 0.042, 0.048},    {1.329, 1.365, -0.006, 0.047, 0.058, 0.060},
    {1.3365, 1.390, 0.000, 0.061, 0.084, 0.078},    {1.345, 1.402, 0.000, 0.0740, 0.0965, 0.092},
    {1.3600, 1.414, 0.000, 0.0855, 0.1005, 0.102},  {1.3730, 1.425, 0.000, 0.0935, 0.1015, 0.110},
    {1.3865, 1.436, 0.000, 0.0995, 0.1015, 0.117},  {1.4005, 1.447, 0.000, 0.1050, 0.1020, 0.124},
    {1.4105, 1.459, 0.000, 0.1100, 0.1030, 0.130},  {1.4215, 1.472, 0.000, 0.1140, 0.1035, 0.135},
    {1.4380, 1.484, 0.000, 0.1170, 0.1035, 0.138},  {1.4670, 1.504, 0.000, 0.1195, 0.1035, 0.142},
    {1.4990, 1.526, 0.000, 0.1220, 0.1045, 0.145},  {1.5210, 1.545, 0.000, 0.1230, 0.1055, 0.145},
    {1.5500, 1.569, -0.002, 0.1220, 0.1040, 0.143}, {1.5880, 1.599, -0.006, 0.1150, 0.0960, 0.135},
    {1.6220, 1.628, -0.010, 0.0980, 0.0780, 0.113}, {1.6480, 1.650, -0.014, 0.0660, 0.0520, 0.074},
};
constexpr int kColumns = 3, kDepth = 7, kRound = 2 * kColumns + kDepth; // edges of half a ring
constexpr double kAngles[kRound + 1] = {0, 8.5, 19.5, 31.5, 44, 57, 71, 85, 98, 111, 126, 142, 160, 180};
constexpr int kMouthLow = 7, kNoseBase = 10, kNoseTip = 11, kEyeLow = 12, kEyeHigh = 14;

double bump(double x, double y, double cx, double cy, double rx, double ry) {
    const double dx = (x - cx) / rx, dy = (y - cy) / ry;
    return std::exp(-dx * dx - dy * dy);
}

double power(double value, double exponent) {
    return std::copysign(std::pow(std::abs(value), exponent), value);
}

// What the face has in front of the bare skull.
double features(double x, double y) {
    double z = 0.0050 * bump(x, y, 0.062, 1.424, 0.034, 0.026); // cheek
    z += 0.0050 * bump(x, y, 0, 1.3885, 0.030, 0.022);          // mouth
    z += 0.0075 * bump(x, y, 0, 1.350, 0.026, 0.014);           // chin
    z -= 0.0045 * bump(x, y, 0, 1.3670, 0.026, 0.0065);         // furrow under the lip
    z -= 0.0085 * bump(x, y, 0.050, 1.466, 0.030, 0.024);       // eye socket
    z += 0.0025 * bump(x, y, 0.050, 1.517, 0.040, 0.014);       // brow
    z += 0.0125 * bump(x, y, 0, 1.452, 0.0112, 0.036);          // bridge of the nose
    return z;
}

Vec3 skull(const Level& level, double degrees) {
    const double a = degrees * kPi / 180;
    const double c = std::cos(a), s = std::sin(a);
    const double e = 2 / (c > 0 ? 2.25 : 2.0);
    Vec3 p{level.side * power(s, e), mix(level.yFront, level.yBack, ramp(-0.25, 1.05, -c + 0.12)),
           level.z + (c > 0 ? level.front : level.back) * power(c, e)};
    return p;
}

class Head {
public:
    explicit Head(const FaceShape& shape) : shape(shape) {}
    Cage build();

private:
    void rings();
    void nose();
    void eye();
    void mouth();
    void ear();
    void soften();
    std::vector<int> grid(int first, int last, int left, int right) const;
    int at(int level, int round) const { return rims[static_cast<size_t>(level)][static_cast<size_t>(round)]; }
    Vec3 mouthPoint(double s, bool upper, double rise, double out) const;

    const FaceShape shape;
    Cage cage;
    std::vector<std::vector<int>> rims;
};

std::vector<int> Head::grid(int first, int last, int left, int right) const {
    std::vector<int> points;
    for (int level = first; level <= last; ++level) {
        for (int round = left; round <= right; ++round) {
            points.push_back(at(level, round));
        }
    }
    return points;
}

void Head::rings() {
    cage.part = Part::Head;
    const Frame up{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    Tube tube = Tube::begin(cage, kColumns, kDepth, up, 1, 1, true);
    for (size_t i = 1; i < std::size(kLevels); ++i) {
        tube.ring(up, 1, 1);
    }
    rims = tube.rims;
    for (size_t i = 0; i < rims.size(); ++i) {
        for (int k = 0; k <= kRound; ++k) {
            Vec3 p = skull(kLevels[i], kAngles[k]);
            if (p.z > 0.02 && i > 4) {
                p.z += features(p.x, p.y) * ramp(0.02, 0.06, p.z);
            }
            // A chin narrower than the cheeks.
            p.x *= 1 - 0.24 * ramp(1.405, 1.335, p.y) * ramp(0.0, 0.09, p.z);
            const double jaw = (0.0180 * shape.open + 0.0050 * shape.round) * ramp(1.378, 1.362, p.y) *
                               ramp(1.300, 1.335, p.y) * ramp(-0.010, 0.075, p.z);
            p += Vec3{0, -jaw, -0.3 * jaw};
            if (k == 0 || k == kRound) {
                p.x = 0;
            }
            cage.position(rims[i][static_cast<size_t>(k)]) = p;
        }
    }
    // The inside of the first and the last ring.
    for (const size_t i : {size_t{0}, rims.size() - 1}) {
        const Level& level = kLevels[i];
        for (int row = 1; row < kDepth; ++row) {
            for (int column = 0; column < kColumns; ++column) {
                const Vec3& right = cage.position(rims[i][static_cast<size_t>(kColumns + row)]);
                const double s = static_cast<double>(column) / kColumns;
                const double rise = i == 0 ? 0 : 0.020 * (1 - s * s) * (1 - std::pow((row - 3.5) / 4.2, 2));
                const int point = i == 0 ? 0 : tube.end.at(column, row);
                if (i > 0) {
                    cage.position(point) = {right.x * s, level.yFront + rise, right.z};
                }
            }
        }
    }
    for (int row = 1; row < kDepth; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            // The underside was made first, row by row.
            Vec3& p = cage.position(row * (kColumns + 1) + column);
            const Vec3& right = cage.position(rims[0][static_cast<size_t>(kColumns + row)]);
            p = {right.x * column / kColumns, kLevels[0].yFront, right.z};
        }
    }
}

void Head::nose() {
    const auto shift = [&](int level, int round, const Vec3& by) { cage.position(at(level, round)) += by; };
    shift(kNoseBase, 0, {0, 0.0015, 0.0100});
    shift(kNoseTip, 0, {0, 0.0030, 0.0285});
    shift(kEyeLow, 0, {0, 0.0010, 0.0125});
    shift(kEyeLow + 1, 0, {0, 0, 0.0020});
    cage.position(at(kNoseBase, 1)).x = 0.0105;
    shift(kNoseBase, 1, {0, 0.0010, 0.0070});
    cage.position(at(kNoseTip, 1)).x = 0.0178;
    shift(kNoseTip, 1, {0, 0.0005, 0.0180});
    cage.position(at(kNoseTip, 2)).x = 0.0245;
    shift(kNoseTip, 2, {0, 0, -0.0015});
    cage.position(at(kNoseBase, 2)).x = 0.0235;
    shift(kEyeLow, 1, {-0.0020, 0.0000, 0.0035});
    // A nostril is drawn into the underside.
    const Patch under = cage.patch(1, 1, false, grid(kNoseBase, kNoseTip, 0, 1));
    const Patch rim = cage.extrude(under);
    Vec3 middle{0.0068, 0, 0};
    for (const int point : under.points) {
        middle += cage.position(point) * 0.25 * Vec3{0, 1, 1};
    }
    for (size_t i = 0; i < 4; ++i) {
        Vec3& p = cage.position(rim.points[i]);
        p = mix(middle, cage.position(under.points[i]), 0.28);
        p.x = std::max(p.x, 0.0042);
    }
    const Patch hole = cage.extrude(rim);
    for (const int point : hole.points) {
        cage.position(point) += Vec3{0, 0.0050, -0.0040};
    }
}

// A place on the eyeball in degrees to the side and up, `far` radii from its centre.
Vec3 onEye(double side, double up, double far) {
    const Frame frame = frameFrom(kEye, kEyeOut, {1, 0, 0});
    const double a = side * kPi / 180, b = up * kPi / 180;
    const Vec3 d = frame.across * (std::sin(a) * std::cos(b)) + frame.along * std::sin(b) +
                   frame.out * (std::cos(a) * std::cos(b));
    return kEye + d * (kEyeRadius * far);
}

// The lid's edge in degrees at s from the inner corner (-1) to the outer one (1).
Vec2 lidEdge(double s, bool upper, double blink) {
    const double side = 4 + 52 * s;
    const double tilt = 3.0 * s;
    const double open = upper ? 28 * std::pow(1 - std::pow(std::abs(s), 2.3), 0.72) * (1 + 0.10 * s)
                              : -24 * std::pow(1 - std::pow(std::abs(s), 2.2), 0.80) * (1 + 0.12 * s);
    const double closed = -19 * (1 - s * s) + (upper ? 0.6 : -0.6);
    return {side, tilt + mix(open, closed, blink)};
}

void Head::eye() {
    Patch patch = cage.patch(4, 2, false, grid(kEyeLow, kEyeHigh, 1, 5));
    const std::vector<int> rimOrder = Cage::rimOf(patch);
    const double places[] = {-0.80, -0.45, 0, 0.45, 0.80, 1, 0.80, 0.45, 0, -0.45, -0.80, -1};
    struct Ring {
        double spread; // degrees beyond the lid's edge
        double far;
        double lid; // how far it follows the lid
    };
    const Ring rings[] = {{15, 1.040, 0.30}, {8.0, 1.092, 0.80}, {1.5, 1.090, 1}, {-1.0, 1.045, 1}, {9, 1.010, 0.6}};
    // The cage's own loop is drawn round the eye first.
    for (size_t i = 0; i < rimOrder.size(); ++i) {
        const bool upper = i > 5;
        const Vec2 edge = lidEdge(places[i], upper, 0);
        const Vec3 wanted =
            onEye(edge.x + 24 * places[i], edge.y + (upper ? 27 : -19) * (1 - 0.6 * std::pow(places[i], 4)), 1.05);
        Vec3& p = cage.position(rimOrder[i]);
        const double inner = places[i] < -0.9 ? 0.55 : 1.0;
        p.x = mix(p.x, wanted.x, 0.75 * inner);
        p.y = mix(p.y, wanted.y, 0.85);
        p.z = mix(p.z, wanted.z, 0.30);
    }
    cage.part = Part::Lid;
    for (const Ring& ring : rings) {
        patch = cage.extrude(patch);
        const std::vector<int> rim = Cage::rimOf(patch);
        for (size_t i = 0; i < rim.size(); ++i) {
            const bool upper = i > 5 && i < 11;
            const bool corner = i == 5 || i == 11;
            const double s = places[i];
            const Vec2 edge = lidEdge(s, upper, shape.blink * ring.lid);
            const double lower = shape.smile * (upper || corner ? 0 : 5.0 * (1 - s * s) * ring.lid);
            const double up = corner ? 0 : (upper ? 1 : -0.8) * ring.spread * (1 - 0.45 * s * s);
            cage.position(rim[i]) = onEye(edge.x + ring.spread * s * 0.85, edge.y + up + lower,
                                          ring.far - (upper || corner || ring.spread < 5 ? 0 : 0.022));
            cage.points[static_cast<size_t>(rim[i])].upper = upper ? ring.lid : 0;
        }
        for (int column = 1; column < 4; ++column) {
            cage.position(patch.at(column, 1)) = kEye;
        }
    }
    const Patch back = cage.extrude(patch);
    for (int row = 0; row <= 2; ++row) {
        for (int column = 0; column <= 4; ++column) {
            cage.position(back.at(column, row)) = onEye(-170 + 25 * (column - 2), 25 * (row - 1), 1.05);
        }
    }
}

// On the lips at s from the middle (0) to the corner (1): `rise` is the share of the lip's height, `out` is forward.
Vec3 Head::mouthPoint(double s, bool upper, double rise, double out) const {
    const double wide = 0.0268 * (1 + 0.17 * shape.smile - 0.34 * shape.round - 0.06 * shape.open);
    const Curve high{{0, 0.0066}, {0.33, 0.0078}, {0.70, 0.0050}, {1, 0}};
    const Curve low{{0, -0.0092}, {0.4, -0.0086}, {0.75, -0.0054}, {1, 0}};
    const double x = wide * s;
    double y = kMouthLine + 0.0022 * s * s - 0.0008 * (1 - s) + (upper ? high(s) : low(s)) * rise;
    y += shape.smile * (0.0090 * std::pow(s, 1.7) - 0.0013) - shape.frown * 0.0075 * std::pow(s, 2.0);
    const double gap = std::sqrt(std::max(0.0, 1 - s * s));
    y += (upper ? 0.004 : -0.0210) * shape.open * gap + (upper ? 0.0045 : -0.0085) * shape.round * gap;
    y -= shape.open * 0.0065 * s;
    const double base = 0.1015 - 0.0062 * std::pow(x / 0.0285, 2);
    return {s == 0 ? 0 : x, y,
            base + features(x, y) + out * (1 - 0.55 * s * s) + 0.0045 * shape.round - 0.003 * shape.smile * s -
                (upper ? 0.0 : 0.0016) - (upper ? 0 : 0.006 * shape.open * gap)};
}

void Head::mouth() {
    Patch patch = cage.patch(3, 2, true, grid(kMouthLow, kMouthLow + 2, 0, 3));
    struct Ring {
        double rise;
        double wide;
        double out;
        Part part;
    };
    const Ring rings[] = {{1.62, 1.08, 0.0016, Part::Head},
                          {1.0, 1.0, 0.0022, Part::Lip},
                          {0.55, 0.985, 0.0052, Part::Lip},
                          {-0.10, 0.965, 0.0020, Part::Lip},
                          {0.20, 0.93, -0.0085, Part::Mouth}};
    const double places[] = {0, 0.36, 0.70, 0.93, 1, 0.93, 0.70, 0.36, 0};
    for (size_t r = 0; r < std::size(rings); ++r) {
        if (r > 0) {
            cage.part = rings[r].part;
            patch = cage.extrude(patch);
        }
        const std::vector<int> rim = Cage::rimOf(patch);
        for (size_t i = 0; i < rim.size(); ++i) {
            const bool upper = i > 4;
            const double corner = i == 4 ? 0 : 1;
            Vec3 p = mouthPoint(places[i], upper, rings[r].rise * corner, rings[r].out);
            p.x *= rings[r].wide;
            if (r == 0 && (i == 3 || i == 5)) {
                p.y += upper ? 0.0036 : -0.0036; // or the corner is pinched far into the cheek
            }
            cage.position(rim[i]) = p;
        }
        for (int column = 0; column < 3; ++column) {
            cage.position(patch.at(column, 1)) =
                mix(cage.position(patch.at(column, 0)), cage.position(patch.at(column, 2)), 0.5);
        }
    }
    cage.part = Part::Mouth;
    for (const double depth : {0.016, 0.034}) {
        patch = cage.extrude(patch);
        for (int column = 0; column <= 3; ++column) {
            for (int row = 0; row <= 2; ++row) {
                Vec3& p = cage.position(patch.at(column, row));
                p = {0.0075 * column * (1.15 - 6 * depth),
                     kMouthLine + 0.011 * (row - 1) - (row == 0 ? 0.012 * shape.open : 0) - 0.002,
                     0.098 - depth - 0.0022 * column * column};
            }
        }
    }
}

void Head::ear() {
    cage.part = Part::Ear;
    Patch patch = cage.patch(2, 3, false, grid(11, 14, 6, 8));
    const Frame frame = frameFrom({0.1185, 1.4700, -0.002}, {0.88, 0.02, 0.36}, {0.30, -0.16, -1});
    struct Ring {
        double out, across, along, forward;
    };
    const Ring rings[] = {{-0.001, 0.0125, 0.0265, 0.000},
                          {0.0080, 0.0185, 0.0335, -0.003},
                          {0.0125, 0.0190, 0.0340, -0.004},
                          {0.0125, 0.0135, 0.0275, -0.004},
                          {0.0035, 0.0080, 0.0190, -0.001}};
    for (const Ring& ring : rings) {
        patch = cage.extrude(patch);
        Frame at = frame;
        at.origin += frame.out * ring.out - frame.across * ring.forward;
        cage.placeDisk(patch, at, ring.across, ring.along);
        for (const int point : patch.points) {
            // Narrower below, at the lobe, and nearer to the head in front.
            Vec3& p = cage.position(point);
            const Vec3 d = p - at.origin;
            const double low = ramp(0.010, -0.034, glm::dot(d, frame.along));
            const double ahead = ramp(0.0, -0.018, glm::dot(d, frame.across));
            p -= frame.across * (glm::dot(d, frame.across) * 0.35 * low) +
                 frame.out * (ahead * 0.7 * std::max(0.0, ring.out));
        }
    }
}

// Evens out the cheeks between what has been drawn into them.
void Head::soften() {
    std::vector<double> shares(cage.points.size(), 0);
    for (int level = 5; level <= 16; ++level) {
        for (int k = 1; k <= kRound - 4; ++k) {
            const bool nearNose = k <= 2 && level >= kNoseBase && level <= kEyeHigh;
            const bool orbit = k <= 5 && level >= kEyeLow && level <= kEyeHigh;
            const bool lips = k <= 3 && level >= kMouthLow && level <= kMouthLow + 2;
            if (!nearNose && !lips) {
                shares[static_cast<size_t>(at(level, k))] = orbit ? 0.10 : 0.45;
            }
        }
    }
    relax(cage, shares, 8);
}

Cage Head::build() {
    rings();
    nose();
    eye();
    mouth();
    ear();
    soften();
    cage.compact();
    cage.mirror();
    return cage;
}

// Things of the face: brows, lashes, teeth.
void addBrow(Cage& cage, const Body& face, const FaceShape& shape) {
    cage.part = Part::Brow;
    std::vector<LockRing> rings;
    for (int i = 0; i <= 6; ++i) {
        const double s = i / 6.0;
        const double x = mix(0.0175, 0.0930, s);
        double y = 1.5190 + 0.0095 * std::sin(kPi * std::pow(s, 1.25)) - 0.010 * std::pow(s, 3);
        y += 0.010 * shape.brows + shape.frown * (-0.009 * (1 - s) + 0.002 * s) + 0.002 * shape.smile * s;
        StrapPoint hit = face.cast({x, y, 0.3}, {0, 0, -1});
        const double wide = 0.0054 * std::pow(1 - std::pow(std::abs(s - 0.32) / 0.70, 2.2), 1.0) + 0.0010;
        rings.push_back({hit.at + hit.out * 0.0008, hit.out, wide, 0.0018});
    }
    lock(cage, rings);
}

void addLash(Cage& cage, const FaceShape& shape) {
    cage.part = Part::Lash;
    std::vector<LockRing> rings;
    for (int i = 0; i <= 8; ++i) {
        const double s = mix(-0.97, 1.06, i / 8.0);
        const double inside = std::clamp(s, -1.0, 1.0);
        const Vec2 edge = lidEdge(inside, true, shape.blink);
        const double wing = std::max(0.0, s - 0.9);
        const Vec3 at = onEye(edge.x + 30 * wing, edge.y + 0.3 + 20 * wing, 1.105 + 0.05 * ramp(-0.2, 1.0, s));
        const Vec3 up = glm::normalize(at - kEye + Vec3{0, 0.012, 0});
        rings.push_back({at, up, 0.0018 + 0.0016 * ramp(-1, 0.5, s) * ramp(1.1, 0.9, s), 0.0014});
    }
    for (LockRing& ring : rings) {
        std::swap(ring.wide, ring.thick);
    }
    lock(cage, rings);
}

void addTeeth(Cage& cage) {
    cage.part = Part::Tooth;
    sheet(
        cage, 6, 1,
        [](double u, double v) {
            const double a = (u - 0.5) * 2.2;
            return Vec3{0.0225 * std::sin(a), kMouthLine + 0.0015 + 0.0075 * v, 0.0715 + 0.0215 * std::cos(a)};
        },
        0.004);
    cage.endShell();
}

} // namespace

Vec3 grown(const Vec3& p) {
    const Vec3 foot{0, 1.325, -0.014};
    const double size = 1 + 0.16 * ramp(1.29, 1.36, p.y + 0.45 * p.z);
    return foot + (p - foot) * size;
}

void grow(Cage& cage) {
    for (Point& point : cage.points) {
        point.position = grown(point.position);
    }
}

namespace {

// The face's picture lies on the surface: fitLimits() moves the cage's points off it.
void layPicture(Cage& cage) {
    for (Face& face : cage.faces) {
        if (swatch(face.part).material == kFaceMaterial) {
            face.uvs.clear();
            for (const int point : face.points) {
                face.uvs.push_back(facePlace(grown(cage.position(point))));
            }
        }
    }
}

} // namespace

Cage modelHead(const FaceShape& shape) {
    Cage cage = Head(shape).build();
    layPicture(cage);
    fitLimits(
        cage, [&](size_t i) { return cage.points[i].part == Part::Head; }, 4);
    const Body face(cage);
    Cage more;
    addBrow(more, face, shape);
    addLash(more, shape);
    append(cage, more);
    append(cage, reflected(more));
    addTeeth(cage);
    cage.compact();
    grow(cage);
    return cage;
}

Cage modelEyes(double blink) {
    Cage half;
    half.part = Part::Eye;
    const Frame frame = frameFrom(kEye - glm::normalize(kEyeOut) * (0.24 * kEyeRadius * blink), kEyeOut, {1, 0, 0});
    const auto at = [&](double degrees) {
        Frame ring = frame;
        ring.origin += frame.out * (kEyeRadius * std::cos(degrees * kPi / 180));
        return ring;
    };
    const auto radius = [](double degrees) { return kEyeRadius * std::sin(degrees * kPi / 180); };
    Tube tube = Tube::begin(half, 2, 2, at(150), radius(150), radius(150));
    for (const double degrees : {115.0, 85.0, 60.0, 42.0, 28.0, 15.0}) {
        tube.ring(at(degrees), radius(degrees), radius(degrees), degrees < 20 ? kEyeRadius * 0.045 : 0);
    }
    half.endShell();
    fitLimits(
        half, [](size_t) { return true; }, 8);
    // The cornea stands out a little; the picture is laid from the front.
    for (Point& point : half.points) {
        const Vec3 d = point.position - frame.origin;
        const double off = glm::length(d - frame.out * glm::dot(d, frame.out));
        if (glm::dot(d, frame.out) > 0) {
            point.position += frame.out * (0.055 * kEyeRadius * ramp(0.62 * kEyeRadius, 0.30 * kEyeRadius, off));
        }
    }
    for (Face& face : half.faces) {
        face.uvs.clear();
        for (const int point : face.points) {
            const Vec3 d = (half.position(point) - frame.origin) / (2.1 * kEyeRadius);
            face.uvs.push_back({0.5 + glm::dot(d, frame.across), 0.5 - glm::dot(d, frame.along)});
        }
    }
    Cage cage = half;
    Cage other = reflected(half);
    for (Face& face : other.faces) {
        for (Vec2& uv : face.uvs) {
            uv.x = 1 - uv.x;
        }
    }
    append(cage, other);
    grow(cage);
    return cage;
}

} // namespace supple::creature::wren
