// What Wren carries on belt, back and arms: straps, buckles, pouches, bracers, the plates on the left shoulder.
#include "wren.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature::wren {

namespace {

// Evens out where a path's points face.
std::vector<StrapPoint> evened(const std::vector<StrapPoint>& path, bool closed, double lift) {
    std::vector<StrapPoint> result = path;
    const size_t count = path.size();
    for (int round = 0; round < 2; ++round) {
        const std::vector<StrapPoint> before = result;
        for (size_t i = 0; i < count; ++i) {
            if (!closed && (i == 0 || i + 1 == count)) {
                continue;
            }
            const StrapPoint& a = before[(i + count - 1) % count];
            const StrapPoint& b = before[(i + 1) % count];
            result[i].out = glm::normalize(before[i].out * 2.0 + a.out + b.out);
            result[i].at = before[i].at * 0.5 + (a.at + b.at) * 0.25;
        }
    }
    for (size_t i = 0; i < count; ++i) {
        // On the outside of what it was drawn together from.
        const double in = glm::dot(path[i].at - result[i].at, result[i].out);
        result[i].at += result[i].out * (std::max(0.0, in) + lift);
    }
    return result;
}

std::vector<StrapPoint> roundWaist(const Body& jacket, int count, const std::function<double(double)>& height) {
    std::vector<StrapPoint> path;
    for (int i = 0; i < count; ++i) {
        const double a = 2 * kPi * i / count;
        const Vec3 out{std::sin(a), 0, std::cos(a)};
        // From inside, or the rays would end on the sleeves.
        path.push_back(jacket.cast(Vec3{0, height(a), -0.005}, out));
        path.back().out *= Vec3{-1, -0.5, -1};
    }
    return path;
}

// A frame with its pin.
void addBuckle(Cage& cage, const Frame& at, double wide, double high) {
    cage.part = Part::Buckle;
    std::vector<StrapPoint> path;
    const double corners[][2] = {{-1, -1}, {0, -1.05}, {1, -1}, {1.05, 0}, {1, 1}, {0, 1.05}, {-1, 1}, {-1.05, 0}};
    for (const auto& [x, y] : corners) {
        path.push_back({at.origin + at.across * (x * wide) + at.along * (y * high), at.out});
    }
    strap(cage, path, 0.0075, 0.0055, true, 1.5f);
    strap(cage,
          {{at.origin - at.across * wide + at.out * 0.002, at.out},
           {at.origin + at.out * 0.005, at.out},
           {at.origin + at.across * (wide + 0.003) + at.out * 0.003, at.out}},
          0.005, 0.004, false, 1.5f);
}

void addPouch(Cage& cage, const StrapPoint& place, const Vec3& size) {
    const Frame at = frameFrom(place.at + place.out * (size.z * 0.5), Vec3{place.out.x, 0, place.out.z},
                               glm::cross(Vec3{0, 1, 0}, place.out));
    cage.part = Part::Pouch;
    box(cage, at, size, 1.1f);
    // A flap from the back edge over the front.
    const Sheet flap = sheet(
        cage, 4, 5,
        [&](double u, double v) {
            const double s = u - 0.5, over = v * 1.55;
            const double tongue = 1 - 0.55 * s * s * 4 * ramp(0.55, 1, v);
            const double top = std::min(over, 0.45) / 0.45, down = std::max(0.0, over - 0.45) / 1.1;
            return at.origin + at.across * (size.x * 1.06 * s * (1 - 0.12 * ramp(0.6, 1, v))) +
                   at.out * (size.z * (-0.5 + 1.12 * top) + 0.002 + 0.004 * std::sin(kPi * down)) +
                   at.along * (size.y * (0.52 + 0.05 * std::sin(kPi * top) - 0.72 * down * tongue));
        },
        -0.005);
    creaseSheet(cage, flap, 1.5f);
    cage.part = Part::Buckle;
    Frame button = at;
    button.origin += at.out * (size.z * 0.5 + 0.013) - at.along * (size.y * 0.06);
    stud(cage, button, 0.008, 0.005);
}

void addBelts(Cage& cage, const Body& jacket) {
    cage.part = Part::Strap;
    const std::vector<StrapPoint> belt = evened(roundWaist(jacket, 28, [](double) { return 0.957; }), true, 0.0030);
    strap(cage, belt, 0.036, 0.0085, true);
    const StrapPoint front = belt[0];
    addBuckle(cage, frameFrom(front.at + front.out * 0.007, front.out, {1, 0, 0}), 0.023, 0.021);
    // The belt's end hangs down beside the buckle.
    cage.part = Part::Strap;
    const Vec3 at = belt[2].at + belt[2].out * 0.008;
    strap(cage,
          {{at + Vec3{0, 0.012, 0.001}, belt[2].out},
           {at + Vec3{0.003, -0.012, 0.005}, belt[2].out},
           {at + Vec3{0.008, -0.045, 0.010}, belt[2].out},
           {at + Vec3{0.013, -0.088, 0.016}, belt[2].out}},
          0.024, 0.005, false);
    addPouch(cage, {belt[24].at + belt[24].out * 0.010 + Vec3{0, -0.034, 0}, belt[24].out}, {0.074, 0.070, 0.036});
    addPouch(cage, {belt[17].at + belt[17].out * 0.010 + Vec3{0, -0.030, 0}, belt[17].out}, {0.060, 0.058, 0.032});
}

// From the right shoulder over the chest to the left hip, and up the back again.
void addBaldric(Cage& cage, const Body& jacket) {
    std::vector<StrapPoint> path;
    const Vec3 low{0.103, 0.985, 0}, high{-0.080, 1.232, 0};
    for (int i = 0; i <= 9; ++i) {
        const Vec3 p = mix(low, high, i / 9.0);
        path.push_back(jacket.cast({p.x, p.y, 0.5}, {0, 0, -1}));
    }
    path.push_back(jacket.cast({-0.088, 1.5, 0.008}, {0, -1, 0}));
    path.push_back(jacket.cast({-0.090, 1.5, -0.030}, {0, -1, 0}));
    for (int i = 0; i <= 9; ++i) {
        const Vec3 p = mix(high, low, i / 9.0);
        path.push_back(jacket.cast({p.x, p.y, -0.5}, {0, 0, 1}));
    }
    path.push_back(jacket.cast({0, 0.972, -0.005}, {1, 0, 0}));
    path.back().out *= -1.0;
    cage.part = Part::Strap;
    const std::vector<StrapPoint> laid = evened(path, true, 0.0055);
    strap(cage, laid, 0.030, 0.006, true);
    const Vec3 along = laid[6].at - laid[4].at;
    addBuckle(cage, frameFrom(laid[5].at + laid[5].out * 0.006, laid[5].out, along), 0.018, 0.018);
}

void addBracers(Cage& cage) {
    const Vec3 axis = glm::normalize(kWrist - kElbow);
    Cage left;
    left.part = Part::Bracer;
    const auto frame = [&](double t) { return frameFrom(mix(kElbow, kWrist, t), axis, {0, 0, -1}); };
    Tube tube = Tube::begin(left, 3, 3, frame(0.34), 0.040, 0.040);
    const double rings[][2] = {{0.31, 0.0490}, {0.320, 0.0545}, {0.37, 0.0540},  {0.55, 0.0520}, {0.74, 0.0490},
                               {0.86, 0.0485}, {0.895, 0.0500}, {0.905, 0.0455}, {0.87, 0.036}};
    for (const auto& [t, radius] : rings) {
        tube.ring(frame(t), radius, radius * 0.97);
    }
    for (const size_t i : {2u, 7u}) {
        std::vector<int> rim = tube.rims[i];
        rim.push_back(rim.front());
        left.creaseChain(rim, 2);
    }
    tube.lay();
    left.endShell();
    for (const double t : {0.45, 0.74}) {
        left.part = Part::Strap;
        std::vector<StrapPoint> path;
        const Frame at = frame(t);
        for (int i = 0; i < 14; ++i) {
            const double a = 2 * kPi * i / 14;
            const Vec3 out = at.across * std::cos(a) + at.along * std::sin(a);
            path.push_back({at.origin + out * (t < 0.5 ? 0.0520 : 0.0480), out});
        }
        strap(left, path, 0.015, 0.005, true, 2);
        for (Point& point : left.points) {
            point.part = Part::Bracer;
        }
        const Vec3 out = glm::normalize(at.along * 0.75 - at.across * 0.66);
        addBuckle(left, frameFrom(at.origin + out * (t < 0.5 ? 0.0575 : 0.0535), out, glm::cross(axis, out)), 0.0095,
                  0.0095);
        for (Point& point : left.points) {
            point.part = Part::Bracer;
        }
    }
    append(cage, left);
    append(cage, reflected(left));
}

// Three plates down the left upper arm.
void addPauldron(Cage& cage) {
    const Vec3 axis = glm::normalize(kElbow - kShoulder);
    const Vec3 up = glm::normalize(Vec3{0.714, 0.70, 0});
    struct Plate {
        double from, length, radius, spread;
    };
    const Plate plates[] = {{0.078, 0.056, 0.0745, 64}, {0.036, 0.060, 0.0790, 72}, {-0.046, 0.100, 0.0830, 80}};
    for (size_t i = 0; i < 3; ++i) {
        const Plate& plate = plates[i];
        cage.part = Part::Pauldron;
        const auto surface = [&](double u, double v) {
            const double s = 2 * u - 1;
            const double a = s * plate.spread * kPi / 180;
            const double l =
                plate.from + plate.length * v + 0.010 * s * s * (i == 2 ? -1.0 : 0.6) + 0.012 * (1 - s * s) * v;
            const double cap = i == 2 ? 0.42 * std::pow(std::max(0.0, 1 - v), 2.2) : 0.05 * (1 - v);
            const double lip = 0.004 * ramp(0.8, 1.0, v);
            return kShoulder + Vec3{-0.002, 0.002, 0} + axis * l +
                   (up * std::cos(a) - Vec3{0, 0, 1} * std::sin(a)) * (plate.radius * (1 - cap) + lip);
        };
        const Sheet made = sheet(cage, 8, 4, surface, 0.0065);
        creaseSheet(cage, made, 2);
        cage.endShell();
        cage.part = Part::Buckle;
        for (const double u : {0.16, 0.84}) {
            const double v = 0.62;
            const Vec3 normal =
                glm::normalize(glm::cross(surface(u + 0.01, v) - surface(u, v), surface(u, v + 0.01) - surface(u, v)));
            const size_t first = cage.points.size();
            stud(cage, frameFrom(surface(u, v) + normal * 0.0005, normal, axis), 0.0062, 0.0045);
            for (size_t k = first; k < cage.points.size(); ++k) {
                cage.points[k].part = Part::Pauldron;
            }
        }
    }
}

void addBootStraps(Cage& cage) {
    Cage left;
    left.part = Part::Strap;
    for (const double y : {0.158}) {
        std::vector<StrapPoint> path;
        const Vec3 middle = mix(kKnee, kAnkle, (kKnee.y - y) / (kKnee.y - kAnkle.y));
        for (int i = 0; i < 14; ++i) {
            const double a = 2 * kPi * i / 14;
            const Vec3 out{std::sin(a), 0, std::cos(a)};
            path.push_back({middle + out * Vec3{0.0505, 0, 0.0575} + Vec3{0, -0.014 * std::cos(a), 0.001}, out});
        }
        strap(left, path, 0.018, 0.006, true, 2);
        const StrapPoint side = path[3];
        left.part = Part::Buckle;
        addBuckle(left, frameFrom(side.at + side.out * 0.006, side.out, glm::cross(Vec3{0, 1, 0}, side.out)), 0.011,
                  0.0115);
    }
    for (Point& point : left.points) {
        point.part = Part::Boot;
    }
    append(cage, left);
    append(cage, reflected(left));
}

} // namespace

Cage modelGear(const Cage& jacket) {
    const Body body(jacket);
    Cage cage;
    addBelts(cage, body);
    addBaldric(cage, body);
    addBracers(cage);
    addPauldron(cage);
    addBootStraps(cage);
    // Buttons down the front.
    cage.part = Part::Buckle;
    for (const double y : {1.215, 1.168, 1.121, 1.074, 1.027}) {
        const StrapPoint hit = body.cast({0, y, 0.5}, {0, 0, -1});
        stud(cage, frameFrom(hit.at + hit.out * 0.0005, hit.out, {1, 0, 0}), 0.0082, 0.0055);
    }
    return cage;
}

} // namespace supple::creature::wren
