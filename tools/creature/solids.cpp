#include "solids.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace supple::creature {

Tube Tube::begin(Cage& cage, int columns, int rows, const Frame& frame, double across, double along, bool half) {
    cage.shell = ++cage.shells;
    Patch underside;
    const Patch top = cage.seed(columns, rows, half, underside);
    cage.placeDisk(underside, frame, across, along);
    Tube tube(cage, top);
    tube.rims = {Cage::rimOf(underside), Cage::rimOf(top)};
    tube.fresh = true;
    return tube;
}

void Tube::ring(const Frame& frame, double across, double along, double dome) {
    if (!fresh) {
        end = cage.extrude(end);
        rims.push_back(Cage::rimOf(end));
    }
    fresh = false;
    cage.placeDisk(end, frame, across, along, dome);
}

void Tube::lay(double v) const {
    const std::map<std::pair<int, int>, size_t> edges = cage.directedEdges();
    double round = 0;
    const size_t count = rims[0].size();
    const bool half = end.half;
    const auto length = [&](int a, int b) { return glm::length(cage.position(a) - cage.position(b)); };
    for (const std::vector<int>& rim : rims) {
        for (size_t k = 0; k + (half ? 1 : 0) < count; ++k) {
            round += length(rim[k], rim[(k + 1) % count]) / static_cast<double>(rims.size());
        }
    }
    for (size_t i = 0; i + 1 < rims.size(); ++i) {
        double rise = 0;
        for (size_t k = 0; k < count; ++k) {
            rise += length(rims[i][k], rims[i + 1][k]) / static_cast<double>(count);
        }
        for (size_t k = 0; k + (half ? 1 : 0) < count; ++k) {
            const auto found = edges.find({rims[i][k], rims[i][(k + 1) % count]});
            if (found == edges.end()) {
                continue; // something else was drawn out of here
            }
            Face& face = cage.faces[found->second];
            const double step = round / static_cast<double>(half ? count - 1 : count);
            face.uvs.clear();
            for (const int point : face.points) {
                const bool second = point == rims[i][(k + 1) % count] || point == rims[i + 1][(k + 1) % count];
                const bool upper = point == rims[i + 1][k] || point == rims[i + 1][(k + 1) % count];
                face.uvs.push_back({(static_cast<double>(k) + (second ? 1 : 0)) * step, v + (upper ? rise : 0)});
            }
        }
        v += rise;
    }
}

std::vector<Vec3> spline(const std::vector<Vec3>& through, int count) {
    std::vector<Vec3> points;
    const size_t last = through.size() - 1;
    for (int i = 0; i < count; ++i) {
        const double at = static_cast<double>(i) / (count - 1) * static_cast<double>(last);
        const size_t k = std::min(static_cast<size_t>(at), last - 1);
        const double t = at - static_cast<double>(k);
        const Vec3& b = through[k];
        const Vec3& c = through[k + 1];
        const Vec3 a = k > 0 ? through[k - 1] : b + b - c;
        const Vec3 d = k + 2 <= last ? through[k + 2] : c + c - b;
        points.push_back(0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * (t * t) +
                                (3.0 * b - a - 3.0 * c + d) * (t * t * t)));
    }
    return points;
}

Sheet sheet(Cage& cage, int columns, int rows, const Surface& surface, double thickness) {
    cage.shell = ++cage.shells;
    Sheet made;
    const size_t first = cage.faces.size();
    made.top = cage.seed(columns, rows, false, made.bottom);
    std::map<int, Vec2> uv;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const double u = static_cast<double>(column) / columns;
            const double v = static_cast<double>(row) / rows;
            constexpr double kStep = 1e-3;
            const Vec3 at = surface(u, v);
            const Vec3 du = surface(u + kStep, v) - surface(u - kStep, v);
            const Vec3 dv = surface(u, v + kStep) - surface(u, v - kStep);
            const Vec3 normal = glm::normalize(glm::cross(du, dv));
            cage.position(made.top.at(column, row)) = at;
            cage.position(made.bottom.at(column, row)) = at - normal * thickness;
            const Vec2 place{u * glm::length(surface(1, 0.5) - surface(0, 0.5)),
                             v * glm::length(surface(0.5, 1) - surface(0.5, 0))};
            uv[made.top.at(column, row)] = place;
            uv[made.bottom.at(column, row)] = {place.x, -place.y};
        }
    }
    for (size_t f = first; f < cage.faces.size(); ++f) {
        Face& face = cage.faces[f];
        face.uvs.clear();
        for (const int point : face.points) {
            face.uvs.push_back(uv.at(point));
        }
        const Vec2 d1 = face.uvs[2] - face.uvs[0];
        const Vec2 d2 = face.uvs[3] - face.uvs[1];
        if (std::abs(d1.x * d2.y - d1.y * d2.x) < 1e-9) {
            face.uvs.clear(); // a wall
        }
    }
    return made;
}

void creaseSheet(Cage& cage, const Sheet& made, float sharpness) {
    for (const Patch* side : {&made.top, &made.bottom}) {
        std::vector<int> rim = Cage::rimOf(*side);
        rim.push_back(rim.front());
        cage.creaseChain(rim, sharpness);
    }
}

void lock(Cage& cage, const std::vector<LockRing>& rings) {
    const auto frame = [&](size_t i) {
        const Vec3 out = rings[std::min(i + 1, rings.size() - 1)].at - rings[i > 0 ? i - 1 : 0].at;
        return frameFrom(rings[i].at, out, glm::cross(rings[i].up, out));
    };
    Tube tube = Tube::begin(cage, 2, 1, frame(0), rings[0].wide, rings[0].thick);
    for (size_t i = 1; i < rings.size(); ++i) {
        tube.ring(frame(i), rings[i].wide, rings[i].thick);
    }
    tube.lay();
}

void strap(Cage& cage, const std::vector<StrapPoint>& path, double wide, double thick, bool closed, float sharpness) {
    cage.shell = ++cage.shells;
    const size_t count = path.size();
    std::vector<std::array<int, 4>> rings;
    std::vector<double> lengths{0};
    for (size_t i = 0; i < count; ++i) {
        const Vec3& before = path[closed ? (i + count - 1) % count : (i > 0 ? i - 1 : 0)].at;
        const Vec3& after = path[closed ? (i + 1) % count : std::min(i + 1, count - 1)].at;
        const Vec3 out = glm::normalize(path[i].out);
        const Vec3 side = glm::normalize(glm::cross(out, after - before)) * (wide / 2);
        std::array<int, 4> ring{};
        const Vec3 corners[] = {-side, side, side + out * thick, out * thick - side};
        for (size_t k = 0; k < 4; ++k) {
            ring[k] = cage.addPoint(path[i].at + corners[k]);
        }
        rings.push_back(ring);
        lengths.push_back(lengths.back() + glm::length(path[(i + 1) % count].at - path[i].at));
    }
    // The face lies on the whole height of a tile of 5 cm, for stitches along both edges.
    const double v[][2] = {{0.020, 0.024}, {0.0, 0.002}, {0.0, 0.050}, {0.048, 0.050}};
    for (size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
        const std::array<int, 4>& a = rings[i];
        const std::array<int, 4>& b = rings[(i + 1) % count];
        for (size_t k = 0; k < 4; ++k) {
            const size_t next = (k + 1) % 4;
            cage.addQuad(a[k], b[k], b[next], a[next]);
            cage.faces.back().uvs = {
                {lengths[i], v[k][0]}, {lengths[i + 1], v[k][0]}, {lengths[i + 1], v[k][1]}, {lengths[i], v[k][1]}};
            cage.crease(a[k], b[k], sharpness);
        }
    }
    if (!closed) {
        const std::array<int, 4>& a = rings.front();
        const std::array<int, 4>& b = rings.back();
        cage.addQuad(a[0], a[1], a[2], a[3]);
        cage.addQuad(b[3], b[2], b[1], b[0]);
        for (size_t k = 0; k < 4; ++k) {
            cage.crease(a[k], a[(k + 1) % 4], sharpness);
            cage.crease(b[k], b[(k + 1) % 4], sharpness);
        }
    }
    cage.endShell();
}

void torus(Cage& cage, const std::vector<StrapPoint>& path, int sides,
           const std::function<Vec2(size_t, int)>& section) {
    cage.shell = ++cage.shells;
    const size_t count = path.size();
    std::vector<int> points;
    std::vector<double> lengths{0};
    for (size_t i = 0; i < count; ++i) {
        const Vec3 along = path[(i + 1) % count].at - path[(i + count - 1) % count].at;
        const Vec3 out = glm::normalize(path[i].out);
        const Vec3 side = glm::normalize(glm::cross(out, along));
        for (int k = 0; k < sides; ++k) {
            const Vec2 p = section(i, k);
            points.push_back(cage.addPoint(path[i].at + out * p.x + side * p.y));
        }
        lengths.push_back(lengths.back() + glm::length(path[(i + 1) % count].at - path[i].at));
    }
    const auto at = [&](size_t i, int k) {
        return points[(i % count) * static_cast<size_t>(sides) + static_cast<size_t>(k % sides)];
    };
    for (size_t i = 0; i < count; ++i) {
        double v = 0;
        for (int k = 0; k < sides; ++k) {
            const double wide = glm::length(section(0, (k + 1) % sides) - section(0, k));
            cage.addQuad(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
            cage.faces.back().uvs = {
                {lengths[i], v}, {lengths[i + 1], v}, {lengths[i + 1], v + wide}, {lengths[i], v + wide}};
            v += wide;
        }
    }
    cage.endShell();
}

void box(Cage& cage, const Frame& frame, const Vec3& size, float sharpness) {
    const Sheet made = sheet(
        cage, 2, 2,
        [&](double u, double v) {
            return frame.origin + frame.across * (size.x * (u - 0.5)) + frame.along * (size.y * (v - 0.5)) +
                   frame.out * (size.z * 0.5);
        },
        size.z);
    creaseSheet(cage, made, sharpness);
    for (const auto& [column, row] : {std::pair{0, 0}, {2, 0}, {0, 2}, {2, 2}}) {
        cage.crease(made.top.at(column, row), made.bottom.at(column, row), sharpness);
    }
    cage.endShell();
}

void stud(Cage& cage, const Frame& frame, double radius, double height) {
    Frame at = frame;
    at.origin -= frame.out * height;
    Tube tube = Tube::begin(cage, 2, 2, at, radius, radius);
    tube.ring(frame, radius, radius);
    at.origin = frame.origin + frame.out * (0.6 * height);
    tube.ring(at, radius * 0.72, radius * 0.72, height * 0.4);
    cage.endShell();
}

void fitLimits(Cage& cage, const std::function<bool(size_t)>& chosen, int rounds) {
    std::vector<Vec3> wanted;
    for (const Point& point : cage.points) {
        wanted.push_back(point.position);
    }
    for (int round = 0; round < rounds; ++round) {
        const std::vector<Vec3> now = cage.limits();
        for (size_t i = 0; i < wanted.size(); ++i) {
            if (chosen(i)) {
                const bool middle = cage.points[i].position.x == 0;
                cage.points[i].position += (wanted[i] - now[i]) * 0.8;
                if (middle) {
                    cage.points[i].position.x = 0;
                }
            }
        }
    }
}

void relax(Cage& cage, const std::vector<double>& shares, int rounds) {
    const std::vector<std::vector<int>> around = cage.neighbours();
    for (int round = 0; round < rounds; ++round) {
        const std::vector<Point> before = cage.points;
        for (size_t i = 0; i < before.size(); ++i) {
            if (shares[i] <= 0) {
                continue;
            }
            Vec3 mean{0};
            for (const int other : around[i]) {
                mean += before[static_cast<size_t>(other)].position / static_cast<double>(around[i].size());
            }
            cage.points[i].position = mix(before[i].position, mean, shares[i]);
            if (before[i].position.x == 0) {
                cage.points[i].position.x = 0;
            }
        }
    }
}

StrapPoint Body::cast(const Vec3& from, const Vec3& along) const {
    double nearest = 1e30;
    StrapPoint hit{from, -along};
    for (const Face& face : cage.faces) {
        for (size_t i = 2; i < face.points.size(); ++i) {
            const Vec3& a = limits[static_cast<size_t>(face.points[0])];
            const Vec3 ab = limits[static_cast<size_t>(face.points[i - 1])] - a;
            const Vec3 ac = limits[static_cast<size_t>(face.points[i])] - a;
            const Vec3 cross = glm::cross(along, ac);
            const double det = glm::dot(ab, cross);
            if (std::abs(det) < 1e-14) {
                continue;
            }
            const Vec3 d = from - a;
            const double u = glm::dot(d, cross) / det;
            const Vec3 q = glm::cross(d, ab);
            const double v = glm::dot(along, q) / det;
            const double t = glm::dot(ac, q) / det;
            if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest) {
                nearest = t;
                const Vec3 normal = glm::normalize(glm::cross(ab, ac));
                hit = {from + along * t, glm::dot(normal, along) < 0 ? normal : -normal};
            }
        }
    }
    return hit;
}

void append(Cage& cage, const Cage& more) {
    const int base = static_cast<int>(cage.points.size());
    for (Point point : more.points) {
        point.shell += point.shell > 0 ? cage.shells : 0;
        cage.points.push_back(point);
    }
    for (Face face : more.faces) {
        for (int& point : face.points) {
            point += base;
        }
        cage.faces.push_back(face);
    }
    for (const auto& [edge, sharpness] : more.creases) {
        cage.crease(edge.first + base, edge.second + base, sharpness);
    }
    cage.shells += more.shells;
}

Cage reflected(const Cage& cage) {
    Cage result = cage;
    for (Point& point : result.points) {
        point.position.x = -point.position.x;
    }
    for (Face& face : result.faces) {
        std::reverse(face.points.begin(), face.points.end());
        std::reverse(face.uvs.begin(), face.uvs.end());
    }
    return result;
}

} // namespace supple::creature
