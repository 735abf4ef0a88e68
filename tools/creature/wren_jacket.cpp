// Wren's jacket: one piece with its sleeves, belted, with a skirt that is open below in front.
#include "wren.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature::wren {

namespace {

struct JacketSlice {
    double y, z, side, front, back;
};

// From the inside of the skirt down to its hem, up to the collar and into it.
constexpr JacketSlice kSlices[] = {
    {0.900, 0.000, 0.105, 0.080, 0.085},   {0.722, 0.000, 0.168, 0.128, 0.142},   {0.714, 0.000, 0.174, 0.134, 0.148},
    {0.719, 0.000, 0.179, 0.139, 0.153},   {0.745, 0.000, 0.178, 0.137, 0.151},   {0.790, 0.000, 0.169, 0.127, 0.140},
    {0.840, -0.002, 0.155, 0.114, 0.126},  {0.885, -0.004, 0.139, 0.101, 0.110},  {0.925, -0.004, 0.123, 0.090, 0.094},
    {0.955, -0.005, 0.1110, 0.082, 0.084}, {0.985, -0.006, 0.1085, 0.082, 0.082}, {1.022, -0.008, 0.1150, 0.089, 0.087},
    {1.062, -0.010, 0.1250, 0.098, 0.094}, {1.102, -0.012, 0.1340, 0.106, 0.100}, {1.140, -0.014, 0.1400, 0.106, 0.101},
    {1.178, -0.016, 0.1410, 0.098, 0.096}, {1.210, -0.018, 0.1360, 0.084, 0.086}, {1.238, -0.019, 0.1180, 0.069, 0.073},
    {1.256, -0.020, 0.0780, 0.058, 0.062}, {1.280, -0.018, 0.0690, 0.057, 0.060}, {1.300, -0.017, 0.0690, 0.059, 0.062},
    {1.303, -0.017, 0.0640, 0.055, 0.058}, {1.270, -0.018, 0.0560, 0.046, 0.050},
};
constexpr double kBandDensity = 14; // as swatch() has it
constexpr int kFront = 3, kSide = 6, kHalf = 2 * kFront + kSide;
constexpr size_t kHem = 2, kArmLow = 13, kArmHigh = 16;

class Jacket {
public:
    Cage build();

private:
    void body();
    void shape();
    void sleeve();
    void dress();
    void dressCuff();

    Cage cage;
    std::vector<std::vector<int>> rims;
    std::vector<std::vector<int>> cuffs;
};

void Jacket::body() {
    cage.part = Part::Jacket;
    const auto up = [](const JacketSlice& slice) {
        return Frame{{0, slice.y, slice.z}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    };
    const auto shaped = [&](const Patch& patch, const JacketSlice& slice) {
        for (const int point : patch.points) {
            Vec3& p = cage.position(point);
            p.z = slice.z + (p.z - slice.z) * (p.z > slice.z ? slice.front : slice.back);
        }
    };
    Tube tube = Tube::begin(cage, kFront, kSide, up(kSlices[0]), kSlices[0].side, 1, true);
    for (int row = 0; row <= kSide; ++row) {
        for (int column = 0; column <= kFront; ++column) {
            Vec3& p = cage.position(row * (kFront + 1) + column);
            p.z = kSlices[0].z + (p.z - kSlices[0].z) * kSlices[0].front;
        }
    }
    for (size_t i = 1; i < std::size(kSlices); ++i) {
        tube.ring(up(kSlices[i]), kSlices[i].side, 1);
        shaped(tube.end, kSlices[i]);
    }
    rims = tube.rims;
    shape();
    tube.lay();
}

// What makes cloth of it: the slit, hanging folds, a chest and shoulder blades, creases over the belt.
void Jacket::shape() {
    for (size_t i = 0; i < rims.size(); ++i) {
        for (int k = 0; k <= kHalf; ++k) {
            Vec3& p = cage.position(rims[i][static_cast<size_t>(k)]);
            const double angle = kPi * k / kHalf;
            const double hang = ramp(0.93, 0.74, p.y) * (i > 0 ? 1 : 0);
            const double fold = std::sin(angle * 7 + 0.6) * 0.0150 + std::sin(angle * 3) * 0.004;
            const Vec3 out = glm::normalize(Vec3{p.x, 0, p.z + 0.005});
            p += out * (fold * hang);
            // The seams lie a little deeper.
            if ((k == 3 || k == 9) && i > kHem + 2 && i <= 13) {
                p -= out * 0.0028;
            }
            // Two tails behind, an opening in front.
            const double front = ramp(0.75, 0.0, angle);
            p.y += hang * (0.085 * front * front + 0.012 * std::cos(2 * angle));
            const double chest =
                std::exp(-std::pow((std::abs(p.x) - 0.058) / 0.042, 2) - std::pow((p.y - 1.118) / 0.040, 2));
            p.z += (p.z > 0 ? 0.0125 : 0.0) * chest;
            const double blade =
                std::exp(-std::pow((std::abs(p.x) - 0.062) / 0.036, 2) - std::pow((p.y - 1.15) / 0.055, 2));
            p.z -= (p.z < 0 ? 0.006 : 0.0) * blade;
            // Cloth gathers above and below the belt.
            const double gather =
                std::exp(-std::pow((p.y - 0.998) / 0.016, 2)) + 0.8 * std::exp(-std::pow((p.y - 0.918) / 0.018, 2));
            p += out * (0.0042 * gather * (0.8 + 1.2 * std::sin(angle * 9 + 22 * p.y)));
            if (k == 0 || k == kHalf) {
                p.x = 0;
            }
        }
    }
}

void Jacket::sleeve() {
    cage.part = Part::Jacket;
    std::vector<int> grid;
    for (size_t level = kArmLow; level <= kArmHigh; ++level) {
        for (size_t k = 4; k <= 8; ++k) {
            grid.push_back(rims[level][k]);
        }
    }
    const Patch hole = cage.patch(4, 3, false, grid);
    std::vector<int> seam = Cage::rimOf(hole);
    seam.push_back(seam.front());
    cage.creaseChain(seam, 2);
    Tube tube(cage, hole);
    const Vec3 upper = kElbow - kShoulder, lower = kWrist - kElbow;
    const Vec3 bend = glm::normalize(upper) + glm::normalize(lower);
    struct Ring {
        double t; // 0..1 upper arm, 1..2 forearm
        double radius;
        double tilt; // of its plane, for creases that run round the arm
    };
    // Full at the shoulder, creased round the elbow, gathered in a cuff.
    const Ring rings[] = {{0.08, 0.0590, 0},     {0.24, 0.0605, 0.15}, {0.40, 0.0570, -0.2}, {0.54, 0.0580, 0.2},
                          {0.66, 0.0530, -0.15}, {0.76, 0.0565, 0.3},  {0.85, 0.0500, -0.3}, {0.93, 0.0535, 0.15},
                          {1.0, 0.0485, 0},      {1.07, 0.0525, -0.2}, {1.15, 0.0475, 0.3},  {1.24, 0.0515, -0.3},
                          {1.36, 0.0465, 0.2},   {1.55, 0.0450, 0.1},  {1.74, 0.0430, 0},    {1.86, 0.0450, 0},
                          {1.93, 0.0375, 0}};
    for (const Ring& ring : rings) {
        const bool low = ring.t > 1;
        const Vec3 at = low ? mix(kElbow, kWrist, ring.t - 1) : mix(kShoulder, kElbow, ring.t);
        const Vec3 out = glm::normalize(ring.t == 1 ? bend : (low ? lower : upper)) + Vec3{0, 0, ring.tilt};
        tube.ring(frameFrom(at, out, {0, 0, -1}), ring.radius * 0.97, ring.radius);
    }
    cage.part = Part::JacketTrim;
    const double cuff[][2] = {{1.945, 0.0385}, {1.975, 0.0390}, {2.005, 0.0385},
                              {2.012, 0.0355}, {1.99, 0.0310},  {1.93, 0.0290}};
    for (const auto& [t, radius] : cuff) {
        tube.ring(frameFrom(mix(kElbow, kWrist, t - 1), lower, {0, 0, -1}), radius, radius * 0.92);
        cuffs.push_back(tube.rims.back());
    }
    tube.lay();
    cage.part = Part::Jacket;
}

// The band's picture lies across its faces once.
void layBand(Face& face, const std::function<Vec2(int)>& at) {
    face.uvs.clear();
    for (const int point : face.points) {
        face.uvs.push_back(at(point));
    }
}

// Bands of another cloth: hem, front, collar.
void Jacket::dress() {
    std::map<int, std::pair<size_t, int>> place;
    for (size_t i = 0; i < rims.size(); ++i) {
        for (int k = 0; k <= kHalf; ++k) {
            place[rims[i][static_cast<size_t>(k)]] = {i, k};
        }
    }
    for (Face& face : cage.faces) {
        size_t low = 99, high = 0;
        int left = 99, right = 0;
        for (const int point : face.points) {
            const auto found = place.find(point);
            if (found == place.end()) {
                low = 99;
                break;
            }
            low = std::min(low, found->second.first);
            high = std::max(high, found->second.first);
            left = std::min(left, found->second.second);
            right = std::max(right, found->second.second);
        }
        if (low == 99) {
            continue;
        }
        const bool hem = low >= kHem && high <= kHem + 2;
        const bool front = right <= 1 && low >= kHem && high < 18;
        const bool collar = low >= 18;
        if (hem || front || collar) {
            face.part = collar ? Part::Collar : Part::JacketTrim;
            layBand(face, [&](int point) {
                const auto& [ring, k] = place.at(point);
                const double height = static_cast<double>(ring) - static_cast<double>(kHem);
                if (front && !collar && !(hem && k == 1 && right > 1)) {
                    return Vec2{cage.position(point).y, (0.5 + 0.5 * k) / kBandDensity};
                }
                const double up = collar ? (static_cast<double>(ring) - 18) / 2 : height / 2;
                return Vec2{0.030 * k, std::clamp(up, 0.0, 1.0) / kBandDensity};
            });
        }
    }
    dressCuff();
    for (size_t i = 18; i < rims.size(); ++i) {
        for (const int point : rims[i]) {
            cage.points[static_cast<size_t>(point)].part = Part::Collar;
        }
    }
    // Seams from the hem to chest and shoulder blades, and along the front's bands.
    for (const size_t k : {1u, 3u, 9u}) {
        std::vector<int> seam;
        for (size_t ring = kHem + 2; ring <= (k == 1 ? size_t{18} : size_t{13}); ++ring) {
            seam.push_back(rims[ring][k]);
        }
        cage.creaseChain(seam, k == 1 ? 1.5f : 2.5f);
    }
    for (const size_t ring : {kHem + 2, size_t{18}}) {
        cage.creaseChain(rims[ring], 1.2f);
    }
    cage.creaseChain(cuffs[1], 1.0f);
}

// The cuff's outside, from its first ring to its third.
void Jacket::dressCuff() {
    const std::map<std::pair<int, int>, size_t> edges = cage.directedEdges();
    for (size_t i = 0; i < 2; ++i) {
        const size_t count = cuffs[i].size();
        for (size_t k = 0; k < count; ++k) {
            const int corner = cuffs[i][k];
            layBand(cage.faces[edges.at({corner, cuffs[i][(k + 1) % count]})], [&](int point) {
                const bool second = point != corner && point != cuffs[i + 1][k];
                const bool upper = point == cuffs[i + 1][k] || point == cuffs[i + 1][(k + 1) % count];
                return Vec2{0.018 * static_cast<double>(k + second),
                            (static_cast<double>(i) + upper) / 2 / kBandDensity};
            });
        }
    }
}

Cage Jacket::build() {
    body();
    sleeve();
    dress();
    cage.compact();
    cage.mirror();
    return cage;
}

} // namespace

Cage modelJacket() {
    return Jacket().build();
}

} // namespace supple::creature::wren
