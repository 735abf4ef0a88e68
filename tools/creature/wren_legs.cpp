// Wren's trousers and boots.
#include "wren.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature::wren {

namespace {

// A ring round the leg: its middle follows the bones.
Vec3 legAt(double y) {
    if (y > kKnee.y) {
        return mix(kThigh, kKnee, (kThigh.y - y) / (kThigh.y - kKnee.y));
    }
    return mix(kKnee, kAnkle, (kKnee.y - y) / (kKnee.y - kAnkle.y));
}

} // namespace

Cage modelTrousers() {
    Cage cage;
    cage.part = Part::Trousers;
    const auto up = [](double y) { return Frame{{0, y, -0.004}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}}; };
    Tube hips = Tube::begin(cage, 3, 4, up(0.786), 0.128, 0.096, true);
    const std::vector<int> bottom = [&] {
        std::vector<int> points;
        for (int i = 0; i < 4 * 5; ++i) {
            points.push_back(i);
        }
        return points;
    }();
    const double waist[][3] = {
        {0.815, 0.142, 0.108}, {0.860, 0.136, 0.102}, {0.905, 0.118, 0.088}, {0.950, 0.100, 0.074}};
    for (const auto& [y, side, deep] : waist) {
        hips.ring(up(y), side, deep);
    }
    hips.lay();
    // The crotch is a strip between the legs.
    for (int row = 0; row <= 4; ++row) {
        Vec3& p = cage.position(bottom[static_cast<size_t>(row * 4 + 1)]);
        p.x = 0.014;
        p.y = 0.776 + 0.004 * std::abs(row - 2);
        cage.position(bottom[static_cast<size_t>(row * 4)]).y = 0.780 + 0.006 * std::abs(row - 2);
    }
    std::vector<int> grid;
    for (int row = 0; row <= 4; ++row) {
        for (const int column : {3, 2, 1}) {
            grid.push_back(bottom[static_cast<size_t>(row * 4 + column)]);
        }
    }
    Tube leg(cage, cage.patch(2, 4, false, grid));
    struct Ring {
        double y, side, deep, tilt;
    };
    const Ring rings[] = {
        {0.755, 0.0725, 0.0880, 0.0},   {0.705, 0.0735, 0.0860, 0.10},  {0.660, 0.0700, 0.0815, -0.08},
        {0.615, 0.0690, 0.0775, 0.10},  {0.572, 0.0635, 0.0700, -0.14}, {0.540, 0.0665, 0.0720, 0.22},
        {0.512, 0.0595, 0.0635, -0.18}, {0.490, 0.0630, 0.0690, 0.10},  {0.468, 0.0580, 0.0640, 0.0},
        {0.446, 0.0625, 0.0675, 0.20},  {0.426, 0.0560, 0.0595, -0.18}, {0.408, 0.0620, 0.0660, 0.16},
        {0.388, 0.0555, 0.0590, -0.08}, {0.360, 0.0500, 0.0520, 0},     {0.315, 0.0440, 0.0460, 0}};
    for (const Ring& ring : rings) {
        const Vec3 at = legAt(ring.y) + Vec3{ring.y > 0.74 ? 0.006 : 0, 0, ring.y < 0.45 ? -0.004 : 0};
        leg.ring(frameFrom(at, Vec3{ring.tilt * 0.6, -1, ring.tilt}, {-1, 0, 0}), ring.side, ring.deep);
    }
    leg.lay();
    // A patch over the knee.
    for (Face& face : cage.faces) {
        const Vec3 middle = cage.centre(face);
        const Vec3 normal = glm::normalize(cage.normal(face));
        if (normal.z > 0.55 && middle.y < 0.515 && middle.y > 0.425) {
            face.part = Part::KneePatch;
        }
    }
    cage.compact();
    cage.mirror();
    return cage;
}

namespace {

// The foot is drawn forward out of the front of the boot's rings, from the instep down to the sole.
void addFoot(Cage& cage, const std::array<Patch, 4>& rings) {
    std::vector<int> grid;
    for (const Patch& ring : rings) {
        for (int column = 0; column <= 2; ++column) {
            grid.push_back(ring.at(column, 0));
        }
    }
    Patch patch = cage.patch(2, 3, false, grid);
    struct Step {
        double z, top, wide, shift;
    };
    // Each step's front: how far, how high its upper side, how wide, and how far the middle swings in.
    const Step steps[] = {{0.052, 0.092, 0.049, 0.001},
                          {0.092, 0.074, 0.0545, 0.002},
                          {0.128, 0.064, 0.0530, -0.001},
                          {0.152, 0.054, 0.0385, -0.005}};
    for (size_t i = 0; i < std::size(steps); ++i) {
        const Step& step = steps[i];
        patch = cage.extrude(patch);
        const double heights[] = {step.top, mix(0.028, step.top, 0.55), 0.024, 0.0};
        const double widths[] = {0.62, 0.98, 1.0, 1.05};
        for (int row = 0; row <= 3; ++row) {
            for (int column = 0; column <= 2; ++column) {
                const double s = 1 - column; // outside to inside
                const double bow = (i == 3 ? 0.021 : 0.007) * (1 - s * s);
                const double round = row == 0 ? (i == 3 ? -0.020 : -0.004) : 0;
                const double lift = i == 3 ? 0.006 : (i == 2 ? 0.001 : 0);
                cage.position(patch.at(column, row)) = {kBall.x + step.shift + step.wide * widths[row] * s,
                                                        heights[row] + (column == 1 && row == 0 ? 0.006 : 0) +
                                                            lift * (row == 3 ? 0.6 : 1),
                                                        step.z + bow + round + (row == 3 ? 0.003 : 0)};
            }
        }
    }
}

} // namespace

Cage modelBoots() {
    Cage cage;
    cage.part = Part::BootCuff;
    const auto frame = [](double y, double tilt = 0) {
        return frameFrom(legAt(y) + Vec3{0, 0, y < 0.3 ? 0.0 : -0.004}, {0, -1, tilt}, {-1, 0, 0});
    };
    Tube tube = Tube::begin(cage, 2, 4, frame(0.325), 0.046, 0.048);
    tube.ring(frame(0.378, -0.10), 0.0585, 0.0610);
    struct Ring {
        double y, side, deep, tilt;
        Part part;
    };
    const Ring rings[] = {
        {0.386, 0.0635, 0.0660, -0.12, Part::BootCuff}, {0.381, 0.0685, 0.0715, -0.12, Part::BootCuff},
        {0.352, 0.0680, 0.0720, -0.10, Part::BootCuff}, {0.318, 0.0700, 0.0745, -0.06, Part::BootCuff},
        {0.309, 0.0665, 0.0705, -0.05, Part::BootCuff}, {0.316, 0.0590, 0.0625, -0.04, Part::Boot},
        {0.285, 0.0560, 0.0605, 0, Part::Boot},         {0.240, 0.0540, 0.0590, 0.02, Part::Boot},
        {0.195, 0.0500, 0.0550, -0.05, Part::Boot},     {0.165, 0.0500, 0.0560, 0.08, Part::Boot}};
    for (const Ring& ring : rings) {
        cage.part = ring.part;
        tube.ring(frame(ring.y, ring.tilt), ring.side, ring.deep);
    }
    std::array<Patch, 4> low;
    const double foot[][4] = {{0.128, 0.0475, 0.0580, -0.018},
                              {0.078, 0.0470, 0.0560, -0.026},
                              {0.026, 0.0470, 0.0560, -0.028},
                              {0.0, 0.0495, 0.0585, -0.028}};
    for (size_t i = 0; i < 4; ++i) {
        const auto& [y, side, deep, z] = foot[i];
        cage.part = i == 3 ? Part::Sole : Part::Boot;
        tube.ring(Frame{{kAnkle.x + 0.002 * static_cast<double>(i), y, z}, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, side,
                  deep);
        low[i] = tube.end;
    }
    tube.lay();
    addFoot(cage, low);
    for (Face& face : cage.faces) {
        const bool sole =
            std::all_of(face.points.begin(), face.points.end(), [&](int p) { return cage.position(p).y < 0.0305; });
        face.part = sole ? Part::Sole : (face.part == Part::Sole ? Part::Boot : face.part);
        const size_t sides = face.points.size();
        for (size_t k = 0; sole && k < sides; ++k) {
            const int a = face.points[k], b = face.points[(k + 1) % sides];
            const bool upper = cage.position(a).y > 0.018 && cage.position(b).y > 0.018;
            const bool lower =
                cage.position(a).y < 0.010 && cage.position(b).y < 0.010 && glm::normalize(cage.normal(face)).y > -0.5;
            if (upper || lower) {
                cage.crease(a, b, 2.5f);
            }
        }
    }
    cage.endShell();
    cage.compact();
    Cage both = cage;
    append(both, reflected(cage));
    return both;
}

} // namespace supple::creature::wren
