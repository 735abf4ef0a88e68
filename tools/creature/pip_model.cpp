#include "pip_model.h"

#include "mixing.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature {

namespace {

using namespace landmark;

// A horizontal slice of torso or head: radii to the side, the front and the back.
struct Slice {
    double y;
    double z;
    double side;
    double front;
    double back;
};

// The rim of a half patch, from the middle of the front round the side to the middle of the back.
std::vector<int> halfRim(const Patch& patch) {
    std::vector<int> rim;
    for (int column = 0; column < patch.columns; ++column) {
        rim.push_back(patch.at(column, 0));
    }
    for (int row = 0; row <= patch.rows; ++row) {
        rim.push_back(patch.at(patch.columns, row));
    }
    for (int column = patch.columns - 1; column >= 0; --column) {
        rim.push_back(patch.at(column, patch.rows));
    }
    return rim;
}

void placeSlice(Cage& cage, const Patch& patch, const Slice& slice, double dome) {
    const Frame up{{0, slice.y, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    cage.placeDisk(patch, up, 1, 1, dome);
    for (int point : patch.points) {
        Vec3& p = cage.position(point);
        p.x *= slice.side;
        p.z = slice.z + p.z * (p.z > 0 ? slice.front : slice.back);
    }
}

// Puts a thin patch (one column) between two offset copies of a line of points.
void placeSheet(Cage& cage, const Patch& patch, const std::vector<Vec3>& line, const Vec3& normal, double thickness) {
    for (int row = 0; row <= patch.rows; ++row) {
        const Vec3& p = line[static_cast<size_t>(row)];
        cage.position(patch.at(0, row)) = p + normal * (thickness / 2);
        cage.position(patch.at(1, row)) = p - normal * (thickness / 2);
    }
}

void setAlong(Cage& cage, const Patch& patch, double value) {
    for (int point : patch.points) {
        cage.points[static_cast<size_t>(point)].along = value;
    }
}

} // namespace

std::array<FingerLine, 4> fingerLines() {
    const Vec3 palm = glm::normalize(kKnuckles - kWrist);
    const Vec3 across{0, 0, 1};
    const auto line = [&](const char* name, Part part, const Vec3& from, const Vec3& direction, double length) {
        return FingerLine{name, part, from, from + glm::normalize(direction) * length};
    };
    return {line("index", Part::Finger1, kKnuckles + across * 0.060, palm + across * 0.46, 0.112),
            line("middle", Part::Finger2, kKnuckles + palm * 0.004, palm + across * 0.02, 0.124),
            line("pinky", Part::Finger3, kKnuckles - across * 0.060, palm - across * 0.44, 0.106),
            line("thumb", Part::Thumb, kWrist + (kKnuckles - kWrist) * 0.69 + across * 0.080,
                 palm * 0.55 + Vec3{-0.12, -0.15, 0.9}, 0.100)};
}

namespace {

class Builder {
public:
    explicit Builder(Variant variant) : variant(variant) {}
    Cage build();

private:
    void torsoAndHead();
    void muzzle();
    void mouth();
    void eye();
    void ear();
    void arm();
    void finger(const Patch& base, const FingerLine& line, double radius);
    void leg();
    void tail();
    void wing();
    void rigJaw();
    // What only the mixed variant has.
    void tip(const Patch& patch, const Vec3& at);
    void crown();
    void belly();
    void webs();
    void brow();
    void easeLoops();

    std::vector<int> rim(const std::vector<std::vector<int>>& rims, std::initializer_list<int> levels, int first,
                         int last) const;

    const Variant variant;
    Cage cage;
    Patch bottom;
    Patch top;
    Patch orbit, socket;
    Patch palm, knuckles;          // rings of the hand
    Patch knee, shin, ankle, sole; // and of the leg
    std::array<Patch, 2> foot;
    std::vector<Patch> tailRings; // its fin's among them
    int tailTip = 0;
    std::vector<std::vector<int>> body; // rims of the torso, from below
    std::vector<std::vector<int>> head; // rims of the head, from below
    std::vector<std::vector<int>> muzzleRings;
    Patch muzzleFront;
};

std::vector<int> Builder::rim(const std::vector<std::vector<int>>& rims, std::initializer_list<int> levels, int first,
                              int last) const {
    std::vector<int> grid;
    for (int level : levels) {
        const int step = first <= last ? 1 : -1;
        for (int i = first; i != last + step; i += step) {
            grid.push_back(rims[static_cast<size_t>(level)][static_cast<size_t>(i)]);
        }
    }
    return grid;
}

void Builder::torsoAndHead() {
    cage.part = Part::Torso;
    const Slice torso[] = {
        {0.365, -0.02, 0.180, 0.165, 0.150}, {0.425, -0.02, 0.262, 0.240, 0.215}, {0.530, -0.02, 0.292, 0.285, 0.225},
        {0.645, -0.02, 0.262, 0.262, 0.200}, {0.755, -0.02, 0.212, 0.198, 0.172}, {0.850, -0.02, 0.172, 0.150, 0.145},
        {0.896, -0.01, 0.145, 0.138, 0.130},
    };
    top = cage.seed(2, 4, true, bottom);
    placeSlice(cage, bottom, torso[0], -0.045);
    body.push_back(halfRim(bottom));
    for (size_t i = 1; i < std::size(torso); ++i) {
        if (i > 1) {
            top = cage.extrude(top);
        }
        placeSlice(cage, top, torso[i], 0);
        setAlong(cage, top, static_cast<double>(i));
        body.push_back(halfRim(top));
    }
    cage.part = Part::Head;
    const Slice skull[] = {
        {0.940, 0.00, 0.200, 0.230, 0.170}, {0.968, 0.02, 0.315, 0.335, 0.250}, {1.055, 0.02, 0.385, 0.345, 0.310},
        {1.100, 0.02, 0.405, 0.345, 0.330}, {1.190, 0.02, 0.412, 0.345, 0.355}, {1.310, 0.02, 0.398, 0.345, 0.370},
        {1.440, 0.01, 0.335, 0.310, 0.335}, {1.540, 0.00, 0.210, 0.205, 0.230},
    };
    for (size_t i = 0; i < std::size(skull); ++i) {
        top = cage.extrude(top);
        placeSlice(cage, top, skull[i], i + 1 == std::size(skull) ? 0.065 : 0);
        setAlong(cage, top, static_cast<double>(i));
        head.push_back(halfRim(top));
    }
}

void Builder::muzzle() {
    cage.part = Part::Head;
    Patch patch = cage.patch(3, 3, true, rim(head, {1, 2, 3, 4}, 0, 3));
    muzzleRings.push_back(patch.points);
    for (int step = 0; step < 2; ++step) {
        patch = cage.extrude(patch);
        const double forward = step == 0 ? 0.060 : 0.036;
        const double narrow = step == 0 ? 0.90 : 0.82;
        // From the chin to the bridge of the nose: the front is rounded, and the chin keeps its depth.
        const double bow[] = {0.90, 1.08, 1.10, 0.80};
        const double flat[] = {0.97, 1.0, 1.0, 0.90};
        for (int row = 0; row <= patch.rows; ++row) {
            for (int column = 0; column <= patch.columns; ++column) {
                Vec3& p = cage.position(patch.at(column, row));
                p.x *= narrow;
                p.z += forward * bow[row];
                p.y = 1.085 + (p.y - 1.085) * flat[row];
                if (step == 1 && column == patch.columns && row < patch.rows) {
                    p.z -= 0.018; // or the chin comes out square
                }
            }
        }
        muzzleRings.push_back(patch.points);
    }
    muzzleFront = patch;
}

void Builder::mouth() {
    // The slit runs over the front of the muzzle and round its corner to the cheek.
    std::vector<int> grid;
    for (int row = 1; row <= 2; ++row) {
        for (int column = 0; column <= 3; ++column) {
            grid.push_back(muzzleFront.at(column, row));
        }
        grid.push_back(muzzleRings[1][static_cast<size_t>(row * 4 + 3)]);
        grid.push_back(muzzleRings[0][static_cast<size_t>(row * 4 + 3)]);
    }
    Patch slit = cage.patch(5, 1, true, grid);
    // A smile: the line of the mouth rises towards its corners, and the lips nearly meet.
    for (int column = 0; column <= 5; ++column) {
        Vec3& low = cage.position(slit.at(column, 0));
        Vec3& high = cage.position(slit.at(column, 1));
        const double middle = 1.052 + 0.085 * column * column / 25.0;
        const double gap = column == 5 ? 0.010 : 0.016;
        low.y = middle - gap;
        high.y = middle + gap;
        cage.points[static_cast<size_t>(slit.at(column, 0))].jaw = 1.0;
    }
    // The far wall is set well back, or the mouth is only a groove round a pillar.
    const double inwards[] = {0.955, 0.82, 0.64};
    const double backwards[] = {0.955, 0.72, 0.24};
    const double heights[] = {0.010, 0.035, 0.055};
    for (int step = 0; step < 3; ++step) {
        cage.part = Part::Mouth;
        slit = cage.extrude(slit);
        for (int column = 0; column <= 5; ++column) {
            for (int row = 0; row <= 1; ++row) {
                const Vec3 lip = cage.position(grid[static_cast<size_t>(row * 6 + column)]);
                Vec3& p = cage.position(slit.at(column, row));
                const double s = inwards[step];
                const double corner = column == 5 ? 0.35 : 1.0;
                p.x = lip.x * s;
                p.z = lip.z * backwards[step];
                p.y = lip.y - (row == 0 ? 1 : -1) * (heights[step] - 0.012) * corner - (1 - s) * 0.06;
                cage.points[static_cast<size_t>(slit.at(column, row))].jaw =
                    row == 0 ? (step < 2 ? 1.0 : 0.6) : (step < 2 ? 0.0 : 0.2);
            }
        }
    }
    for (Face& face : cage.faces) {
        const bool inside = std::all_of(face.points.begin(), face.points.end(), [&](int point) {
            return std::find(slit.points.begin(), slit.points.end(), point) != slit.points.end();
        });
        if (inside) {
            face.part = Part::Mouth;
        }
    }
}

void Builder::eye() {
    Patch patch = cage.patch(2, 2, false, rim(head, {4, 5, 6}, 1, 3));
    const double r = kEyeRadius;
    const Frame frame = frameFrom(kEye, kEyeOut, {1, 0, 0});
    struct Ring {
        double radius;
        double out;
        double lid; // how far this ring follows the lids
    };
    // Brow, two loops in the lids, their edge, their inner side, and the wall behind the eyeball. The lid rings lie
    // just outside the eyeball so that they slide over it.
    const Ring rings[] = {{1.24, 0.38, 0.0}, {1.16, 0.58, 0.36}, {1.06, 0.72, 0.72},
                          {0.95, 0.78, 1.0}, {0.87, 0.62, 1.0},  {0.70, -0.2, 0}};
    orbit = patch;
    for (int row = 0; row <= 2; ++row) {
        for (int column = 0; column <= 2; ++column) {
            if (column != 1 || row != 1) {
                // Draw the orbit's loop round the eye.
                Vec3& p = cage.position(orbit.at(column, row));
                const Vec3 d = p - frame.origin;
                Vec3 flat{glm::dot(d, frame.across), glm::dot(d, frame.along), 0};
                const double length = glm::length(flat);
                const double wanted = 1.46 * r;
                p += (frame.across * flat.x + frame.along * flat.y) * (0.6 * (wanted / length - 1));
            }
        }
    }
    for (const Ring& ring : rings) {
        cage.part = ring.lid > 0 || ring.radius > 1.1 ? Part::Lid : Part::Mouth;
        patch = cage.extrude(patch);
        Frame at = frame;
        at.origin += frame.out * (ring.out * r);
        cage.placeDisk(patch, at, ring.radius * r, ring.radius * r);
        for (int row = 0; row <= 2; ++row) {
            for (int column = 0; column <= 2; ++column) {
                Point& point = cage.points[static_cast<size_t>(patch.at(column, row))];
                // Less at the inner corner of the eye, where the lids have a shorter way to meet.
                const double upper[] = {0.70, 1.0, 0.92};
                const double lower[] = {0.90, 1.0, 1.0};
                point.upper = row == 2 ? ring.lid * upper[column] : 0.0;
                point.lower = row == 0 ? ring.lid * lower[column] : 0.0;
            }
        }
    }
    socket = patch;
}

void Builder::ear() {
    cage.part = Part::Ear;
    Patch patch = cage.patch(1, 3, false, rim(head, {3, 4, 5, 6}, 4, 5));
    const Vec3 out = glm::normalize(Vec3{0.88, 0.14, -0.42});
    const Vec3 normal = glm::normalize(Vec3{0.42, 0, 0.88});
    const Vec3 root = kEar;
    const auto at = [&](double along, double up) { return root + out * along + Vec3{0, up, 0}; };
    patch = cage.extrude(patch);
    setAlong(cage, patch, 0.1);
    placeSheet(cage, patch, {at(0.00, -0.065), at(0.01, -0.025), at(0.01, 0.025), at(0.00, 0.065)}, normal, 0.07);
    patch = cage.extrude(patch);
    setAlong(cage, patch, 0.4);
    placeSheet(cage, patch, {at(0.08, -0.10), at(0.10, -0.035), at(0.10, 0.045), at(0.08, 0.12)}, normal, 0.045);
    const Vec3 tips[] = {at(0.19, -0.20), at(0.28, -0.02), at(0.24, 0.24)};
    for (int row = 0; row < 3; ++row) {
        const Patch lobe = cage.cell(patch, 0, row);
        const Vec3 low = (cage.position(lobe.at(0, 0)) + cage.position(lobe.at(1, 0))) * 0.5;
        const Vec3 high = (cage.position(lobe.at(0, 1)) + cage.position(lobe.at(1, 1))) * 0.5;
        const Vec3 middle = (low + high) * 0.5;
        Patch step = lobe;
        for (double t : {0.5, 0.92}) {
            step = cage.extrude(step);
            setAlong(cage, step, 0.4 + 0.6 * t);
            const double width = t < 0.6 ? 0.95 : 0.42;
            const Vec3 centre = middle + (tips[row] - middle) * t;
            placeSheet(cage, step, {centre + (low - middle) * width, centre + (high - middle) * width}, normal,
                       0.045 - 0.02 * t);
        }
        tip(step, middle + (tips[row] - middle) * 1.06);
    }
}

void Builder::finger(const Patch& base, const FingerLine& line, double radius) {
    cage.part = line.part;
    Patch patch = base;
    const Frame frame =
        frameFrom(line.from, line.to - line.from, cage.position(base.at(1, 0)) - cage.position(base.at(0, 0)));
    const double length = glm::length(line.to - line.from);
    // A loop each side of the middle joint keeps the bend round.
    const double steps[] = {0.36, 0.66, 1.0};
    const double widths[] = {1.0, 1.04, 0.86};
    for (int i = 0; i < 3; ++i) {
        patch = cage.extrude(patch);
        setAlong(cage, patch, steps[i]);
        Frame at = frame;
        at.origin += frame.out * (length * steps[i]);
        cage.placeDisk(patch, at, radius * widths[i], radius * widths[i]);
    }
    tip(patch, frame.origin + frame.out * (length * 1.10));
}

void Builder::arm() {
    cage.part = Part::Arm;
    Patch patch = cage.patch(3, 1, false, rim(body, {4, 5}, 2, 5));
    const Vec3 upper = kElbow - kShoulder;
    const Vec3 lower = kWrist - kElbow;
    const Vec3 hint{0, 0, -1};
    const auto ring = [&](const Vec3& origin, const Vec3& out, double across, double along) {
        patch = cage.extrude(patch);
        cage.placeDisk(patch, frameFrom(origin, out, hint), across, along);
    };
    const Vec3 bend = glm::normalize(upper) + glm::normalize(lower);
    ring(kShoulder + upper * 0.18, upper, 0.094, 0.094);
    ring(kShoulder + upper * 0.52, upper, 0.084, 0.084);
    ring(kShoulder + upper * 0.80, upper, 0.078, 0.078);
    ring(kElbow, bend, 0.077, 0.079);
    ring(kElbow + lower * 0.24, lower, 0.077, 0.077);
    ring(kElbow + lower * 0.90, lower, 0.064, 0.058);
    const Vec3 hand = kKnuckles - kWrist;
    ring(kWrist + hand * 0.38, hand, 0.080, 0.052);
    palm = patch;
    ring(kWrist + hand * 1.0, hand, 0.094, 0.050);
    knuckles = patch;

    const Patch side = cage.patch(1, 1, false, {palm.at(0, 1), palm.at(0, 0), knuckles.at(0, 1), knuckles.at(0, 0)});
    const std::array<FingerLine, 4> lines = fingerLines();
    for (int i = 0; i < 3; ++i) {
        finger(cage.cell(knuckles, i, 0), lines[static_cast<size_t>(i)], 0.043);
    }
    finger(side, lines[3], 0.043);
}

void Builder::leg() {
    cage.part = Part::Leg;
    // The patch folds from the side of the hip round to its underside.
    std::vector<int> grid;
    for (int row = 0; row <= 2; ++row) {
        const size_t i = static_cast<size_t>(3 + row);
        grid.push_back(body[2][i]);
        grid.push_back(body[1][i]);
        grid.push_back(body[0][i]);
        grid.push_back(bottom.at(1, 1 + row));
    }
    Patch patch = cage.patch(3, 2, false, grid);
    const Vec3 hint{-1, 0, 0};
    const auto ring = [&](const Vec3& origin, const Vec3& out, double across, double along) {
        patch = cage.extrude(patch);
        cage.placeDisk(patch, frameFrom(origin, out, hint), across, along);
    };
    const Vec3 upper = kKnee - kThigh;
    const Vec3 lower = kAnkle - kKnee;
    ring(kThigh + Vec3{0.035, 0.0, 0}, {0.6, -0.8, 0.05}, 0.165, 0.185);
    ring(kThigh + upper * 0.46, upper, 0.142, 0.162);
    ring(kThigh + upper * 0.82, upper, 0.114, 0.124);
    ring(kKnee, upper + lower, 0.098, 0.104);
    knee = patch;
    ring(kKnee + lower * 0.36, lower, 0.088, 0.092);
    shin = patch;
    cage.part = Part::Foot;
    ring({kAnkle.x, 0.100, kAnkle.z}, {0, -1, 0}, 0.094, 0.104);
    ankle = patch;
    ring({kAnkle.x + 0.004, 0.004, kAnkle.z - 0.004}, {0, -1, 0}, 0.108, 0.118);
    sole = patch;

    std::vector<int> front;
    for (const Patch* edge : {&ankle, &sole}) {
        for (int column = 0; column <= 3; ++column) {
            front.push_back(edge->at(column, 0));
        }
    }
    patch = cage.patch(3, 1, false, front);
    // Columns run from the outside of the foot to the inside.
    const double reach[] = {0.120, 0.170};
    for (int step = 0; step < 2; ++step) {
        patch = cage.extrude(patch);
        foot[static_cast<size_t>(step)] = patch;
        for (int column = 0; column <= 3; ++column) {
            const double s = 1 - 2.0 * column / 3;
            const double width = step == 0 ? 0.122 : 0.138;
            const double bow = 0.030 * (1 - s * s);
            const double z = reach[step] + bow - 0.012;
            cage.position(patch.at(column, 0)) = {kBall.x + 0.93 * width * s, step == 0 ? 0.104 : 0.090, z - 0.012};
            cage.position(patch.at(column, 1)) = {kBall.x + width * s, 0.002, z};
        }
    }
    for (int toe = 0; toe < 3; ++toe) {
        Patch step = cage.cell(patch, toe, 0);
        Vec3 middle{0};
        for (int point : step.points) {
            middle += cage.position(point) * 0.25;
        }
        const double side = 1.0 - toe;
        const Vec3 direction = glm::normalize(Vec3{0.30 * side, -0.03, 1.0});
        const double lengths[] = {0.045, 0.085};
        for (int i = 0; i < 2; ++i) {
            step = cage.extrude(step);
            const double radius = i == 0 ? 0.058 : 0.046;
            const Vec3 centre = middle + direction * lengths[i];
            const Frame frame = frameFrom({centre.x, i == 0 ? 0.043 : 0.038, centre.z}, direction,
                                          cage.position(step.at(1, 0)) - cage.position(step.at(0, 0)));
            cage.placeDisk(step, frame, radius, radius);
        }
        tip(step, Vec3{middle.x, 0.036, middle.z} + direction * Vec3{1, 0, 1} * 0.108);
    }
}

void Builder::tail() {
    cage.part = Part::Tail;
    std::vector<int> grid;
    for (int level : {2, 1, 0}) {
        grid.push_back(body[static_cast<size_t>(level)][8]);
        grid.push_back(body[static_cast<size_t>(level)][7]);
    }
    Patch patch = cage.patch(1, 2, true, grid);
    int ring = 0;
    const double radii[] = {0.150, 0.128, 0.108, 0.090, 0.073, 0.055, 0.040};
    for (int i = 0; i < kTailJoints; ++i) {
        // One ring a joint, and one more where the tail leaves the body.
        const Vec3 before = i == 0 ? kTail[1] - kTail[0] : kTail[i] - kTail[i - 1];
        const Vec3 after = kTail[i + 1] - kTail[i];
        if (i > 0) {
            patch = cage.extrude(patch);
            cage.placeDisk(patch, frameFrom(kTail[i], glm::normalize(before) + glm::normalize(after), {1, 0, 0}),
                           radii[i], radii[i]);
            setAlong(cage, patch, ring++);
            tailRings.push_back(patch);
        }
        if (i == 0) {
            patch = cage.extrude(patch);
            const double radius = (radii[0] + radii[1]) / 2;
            cage.placeDisk(patch, frameFrom(kTail[0] + after * 0.62, after, {1, 0, 0}), radius, radius);
            setAlong(cage, patch, ring++);
        }
    }
    // A leaf of a fin stands up and down from the tip.
    cage.part = Part::TailFin;
    const Vec3 end = kTail[kTailJoints] - kTail[kTailJoints - 1];
    const double leaf[][3] = {{0.25, 0.034, 0.080}, {0.70, 0.032, 0.165}, {1.20, 0.026, 0.115}, {1.7, 0.014, 0.020}};
    for (const auto& [along, thin, wide] : leaf) {
        patch = cage.extrude(patch);
        setAlong(cage, patch, along / 1.5);
        cage.placeDisk(patch, frameFrom(kTail[kTailJoints - 1] + end * along, end, {1, 0, 0}), thin, wide);
        tailRings.push_back(patch);
    }
    tip(patch, kTail[kTailJoints - 1] + end * 1.77);
    tailTip = static_cast<int>(cage.points.size()) - 1;
}

void Builder::wing() {
    cage.part = Part::Wing;
    Patch patch = cage.patch(1, 3, false, rim(body, {3, 4, 5, 6}, 6, 7));
    const Vec3 out = glm::normalize(Vec3{0.78, 0.0, -0.62});
    const Vec3 normal = glm::normalize(Vec3{0.62, 0, 0.78});
    const auto at = [&](double along, double y) { return Vec3{0.075, y, -0.145} + out * along; };
    // The upper edge is the wing's arm.
    const auto setRib = [&](const Patch& edge) {
        for (int column = 0; column <= 1; ++column) {
            cage.points[static_cast<size_t>(edge.at(column, edge.rows))].rib = 1;
        }
    };
    const auto sheet = [&](double along, double thickness, const std::vector<Vec3>& line) {
        patch = cage.extrude(patch);
        setAlong(cage, patch, along);
        placeSheet(cage, patch, line, normal, thickness);
        setRib(patch);
    };
    sheet(0.05, 0.075, {at(0.03, 0.745), at(0.04, 0.790), at(0.04, 0.835), at(0.03, 0.875)});
    sheet(0.2, 0.054, {at(0.13, 0.740), at(0.14, 0.800), at(0.14, 0.860), at(0.12, 0.920)});
    sheet(0.45, 0.040, {at(0.25, 0.690), at(0.28, 0.825), at(0.28, 0.945), at(0.24, 1.070)});
    sheet(0.7, 0.034, {at(0.38, 0.610), at(0.41, 0.800), at(0.41, 0.985), at(0.37, 1.180)});
    const Vec3 tips[] = {at(0.52, 0.50), at(0.64, 0.87), at(0.62, 1.34)};
    for (int row = 0; row < 3; ++row) {
        Patch step = cage.cell(patch, 0, row);
        const Vec3 low = (cage.position(step.at(0, 0)) + cage.position(step.at(1, 0))) * 0.5;
        const Vec3 high = (cage.position(step.at(0, 1)) + cage.position(step.at(1, 1))) * 0.5;
        const Vec3 middle = (low + high) * 0.5;
        for (double t : {0.45, 1.0}) {
            step = cage.extrude(step);
            setAlong(cage, step, 0.7 + 0.3 * t);
            const double width = t < 0.6 ? 0.60 : 0.16;
            const Vec3 centre = middle + (tips[row] - middle) * t;
            placeSheet(cage, step, {centre + (low - middle) * width, centre + (high - middle) * width}, normal,
                       0.034 - 0.014 * t);
            if (row == 2) {
                setRib(step);
            }
        }
        tip(step, middle + (tips[row] - middle) * 1.07);
    }
}

// What lies under the line of the mouth goes with the jaw, fading out towards the throat and the hinge.
void Builder::rigJaw() {
    for (Point& point : cage.points) {
        if (point.part == Part::Head && point.shell == 0 && point.jaw == 0) {
            const Vec3& p = point.position;
            const double line = 1.052 + 0.085 * ramp(0.0, 0.42, p.x);
            point.jaw = ramp(line - 0.002, line - 0.03, p.y) * ramp(0.0, 0.20, p.z) * ramp(0.90, 0.965, p.y);
        }
    }
}

// Draws the last ring of a limb together round its tip, in triangles; the quads keep their blunt end.
void Builder::tip(const Patch& patch, const Vec3& at) {
    if (variant == Variant::mixed) {
        cage.fan(patch, at);
    }
}

// Half as many columns go over the top of the head, and meet in one point.
void Builder::crown() {
    cage.part = Part::Head;
    cage.open(top);
    const std::vector<int>& rim = head.back();
    std::vector<int> inner;
    for (size_t i = 0; i < rim.size(); i += 2) {
        const Vec3 p = cage.position(rim[i]);
        inner.push_back(cage.addPoint({p.x * 0.5, 1.589, p.z * 0.5}));
        cage.points.back().along = cage.points[static_cast<size_t>(rim[i])].along;
    }
    const int pole = cage.addPoint({0, 1.606, 0});
    for (size_t k = 0; k + 1 < inner.size(); ++k) {
        cage.faces.push_back({{rim[2 * k], rim[2 * k + 1], rim[2 * k + 2], inner[k + 1], inner[k]}, cage.part});
        cage.faces.push_back({{inner[k], inner[k + 1], pole}, cage.part});
    }
}

// A plate of three scutes over the belly, its edge crisp.
void Builder::belly() {
    cage.part = Part::Belly;
    const Patch base = cage.patch(2, 3, true, rim(body, {1, 2, 3, 4}, 0, 2));
    const Patch plate = cage.extrude(base);
    const Vec3 middle{0, 0.58, -0.02};
    for (int row = 0; row <= plate.rows; ++row) {
        for (int column = 0; column <= plate.columns; ++column) {
            Point& point = cage.points[static_cast<size_t>(plate.at(column, row))];
            const bool edge = row == 0 || row == plate.rows || column == plate.columns;
            const Vec3 out = point.position - middle;
            point.position = middle + out * (edge ? 1.050 : 1.040);
            point.position.x *= 0.96;
            point.along = row;
        }
    }
    // Its corners are cut, to a triangle on the plate and a pentagon in the wall below.
    std::vector<int> edge = Cage::rimOf(plate);
    for (const int row : {0, plate.rows}) {
        cage.dissolve({base.at(base.columns, row), plate.at(plate.columns, row)});
        std::erase(edge, plate.at(plate.columns, row));
    }
    cage.creaseChain(edge, 3);
    // The furrows between the scutes.
    for (const int row : {1, 2}) {
        cage.creaseChain({plate.at(0, row), plate.at(1, row), plate.at(2, row)}, 3);
    }
}

// Room between fingers and between toes.
void Builder::webs() {
    cage.part = Part::Web;
    for (const int column : {1, 2}) {
        cage.widen(palm.at(column, 0), knuckles.at(column, 0), knuckles.at(column, 1), palm.at(column, 1), 0.012);
        cage.widen(foot[0].at(column, 0), foot[1].at(column, 0), foot[1].at(column, 1), foot[0].at(column, 1), 0.016);
    }
}

// A fold over the eye that runs out on both sides.
void Builder::brow() {
    cage.creaseChain({orbit.at(0, 2), orbit.at(1, 2), orbit.at(2, 2)}, 2);
}

// Ends loops of edges where they are needed no more. From pole to pole that leaves a pentagon and a regular point for
// each pole.
void Builder::easeLoops() {
    // Over the crown, from the corners of the eye and the ear.
    for (const size_t i : {1u, 3u, 5u}) {
        cage.dissolve({head[6][i], head[7][i]});
    }
    // Down the back of the head to the wing.
    std::vector<int> nape;
    for (size_t level = head.size(); level-- > 0;) {
        nape.push_back(head[level][7]);
    }
    nape.push_back(body[6][7]);
    cage.dissolve(nape);
    // From the neck to the arm, and from the arm to the leg.
    cage.dissolve({head[0][5], body[6][5], body[5][5]});
    cage.dissolve({body[4][5], body[3][5], body[2][5]});
    cage.dissolve({body[4][3], body[3][3], body[2][3]});
    // From the inside of the knee under the foot to its outside.
    cage.dissolve({knee.at(0, 1), shin.at(0, 1), ankle.at(0, 1), sole.at(0, 1), sole.at(1, 1), sole.at(2, 1),
                   sole.at(3, 1), ankle.at(3, 1), shin.at(3, 1), knee.at(3, 1)});
    // The sole is flat: one hexagon.
    cage.dissolve({sole.at(2, 0), sole.at(2, 2)});
    // The end of the tail is a tube of six.
    std::vector<int> flank;
    for (size_t ring = 2; ring < tailRings.size(); ++ring) {
        flank.push_back(tailRings[ring].at(1, 1));
        if (ring > 2) {
            const Vec3 middle =
                (cage.position(tailRings[ring].at(0, 0)) + cage.position(tailRings[ring].at(0, 2))) * 0.5;
            for (const int row : {0, 2}) {
                Vec3& p = cage.position(tailRings[ring].at(1, row));
                const double x = p.x * std::sqrt(1.5);
                p = middle + (p - middle) * std::sqrt(0.5);
                p.x = x;
            }
        }
    }
    flank.push_back(tailTip);
    cage.dissolve(flank);
}

Cage Builder::build() {
    torsoAndHead();
    muzzle();
    mouth();
    eye();
    ear();
    arm();
    leg();
    tail();
    wing();
    if (variant == Variant::mixed) {
        crown();
        easeLoops();
        belly();
        webs();
        brow();
        cage.open(socket);
    }
    rigJaw();
    addPairedDetails(cage, variant);
    cage.compact();
    cage.mirror();
    addMiddleDetails(cage, variant);
    cage.compact();
    return cage;
}

} // namespace

Cage modelPip(Variant variant) {
    return Builder(variant).build();
}

} // namespace supple::creature
