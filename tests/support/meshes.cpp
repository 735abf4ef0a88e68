#include "tests/support/meshes.h"

#include "cage/obj/reader.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <span>
#include <utility>

namespace supple::test {

cage::Cage makeCage(std::vector<glm::vec3> positions, const Faces& polygons) {
    cage::Cage cage;
    cage.positions = std::move(positions);
    cage.faceStarts.push_back(0);
    for (const std::vector<uint32_t>& polygon : polygons) {
        cage.faceVertices.insert(cage.faceVertices.end(), polygon.begin(), polygon.end());
        cage.faceStarts.push_back(cage.cornerCount());
    }
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        cage.sourceVertices.push_back(v);
    }
    return cage;
}

Faces facesOf(const cage::Cage& cage) {
    Faces polygons;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        polygons.emplace_back(cage.faceVertices.begin() + cage.faceStarts[f],
                              cage.faceVertices.begin() + cage.faceStarts[f + 1]);
    }
    return polygons;
}

cage::Cage cube() {
    std::vector<glm::vec3> positions;
    for (int i = 0; i < 8; ++i) {
        positions.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
    }
    return makeCage(std::move(positions),
                    {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
}

cage::Cage grid(uint32_t columns, uint32_t rows) {
    std::vector<glm::vec3> positions;
    Faces polygons;
    for (uint32_t y = 0; y <= rows; ++y) {
        for (uint32_t x = 0; x <= columns; ++x) {
            positions.push_back({static_cast<float>(x), static_cast<float>(y), 0.0f});
        }
    }
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            const uint32_t a = y * (columns + 1) + x;
            const uint32_t d = a + columns + 1;
            polygons.push_back({a, a + 1, d + 1, d});
        }
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage torus(uint32_t around, uint32_t across) {
    std::vector<glm::vec3> positions;
    Faces polygons;
    for (uint32_t i = 0; i < around; ++i) {
        for (uint32_t j = 0; j < across; ++j) {
            const double a = 2.0 * std::numbers::pi * i / around;
            const double b = 2.0 * std::numbers::pi * j / across;
            const double reach = 2.0 + 0.8 * std::cos(b);
            positions.push_back(glm::vec3(reach * std::cos(a), reach * std::sin(a), 0.8 * std::sin(b)));
            const uint32_t i1 = (i + 1) % around;
            const uint32_t j1 = (j + 1) % across;
            polygons.push_back({i * across + j, i1 * across + j, i1 * across + j1, i * across + j1});
        }
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage dodecahedron() {
    const float golden = std::numbers::phi_v<float>;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> axes; // of the faces: the vertices of an icosahedron
    for (const float a : {-1.0f, 1.0f}) {
        for (const float b : {-1.0f, 1.0f}) {
            for (const float c : {-1.0f, 1.0f}) {
                positions.push_back({a, b, c});
            }
            for (int turn = 0; turn < 3; ++turn) {
                const auto turned = [turn](float x, float y, float z) {
                    return turn == 0 ? glm::vec3(x, y, z) : turn == 1 ? glm::vec3(y, z, x) : glm::vec3(z, x, y);
                };
                positions.push_back(turned(0.0f, a / golden, b * golden));
                axes.push_back(turned(0.0f, b * golden, a));
            }
        }
    }
    Faces polygons;
    for (const glm::vec3& axis : axes) {
        std::vector<std::pair<double, uint32_t>> around; // angle about the axis, vertex
        const glm::vec3 e1 = glm::cross(axis, glm::vec3(0.3f, 0.5f, 0.7f));
        const glm::vec3 e2 = glm::cross(axis, e1) / glm::length(axis);
        for (uint32_t v = 0; v < positions.size(); ++v) {
            if (glm::dot(positions[v], axis) > 2.0f) {
                around.push_back({std::atan2(glm::dot(positions[v], e2), glm::dot(positions[v], e1)), v});
            }
        }
        std::sort(around.begin(), around.end());
        std::vector<uint32_t>& polygon = polygons.emplace_back();
        for (const auto& [angle, v] : around) {
            polygon.push_back(v);
        }
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage voxels(const std::vector<glm::ivec3>& cubes) {
    std::vector<glm::vec3> positions;
    Faces polygons;
    const auto vertex = [&](const glm::ivec3& p) {
        const auto found = std::find(positions.begin(), positions.end(), glm::vec3(p));
        const auto index = static_cast<uint32_t>(found - positions.begin());
        if (found == positions.end()) {
            positions.emplace_back(p);
        }
        return index;
    };
    for (const glm::ivec3& cube : cubes) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const int side : {0, 1}) {
                glm::ivec3 outward(0), u(0), v(0);
                outward[axis] = side == 1 ? 1 : -1;
                u[(axis + 1) % 3] = 1;
                v[(axis + 2) % 3] = 1;
                if (std::find(cubes.begin(), cubes.end(), cube + outward) != cubes.end()) {
                    continue;
                }
                const glm::ivec3 first = side == 1 ? cube + outward : cube;
                const glm::ivec3 second = side == 1 ? first + u : first + v, last = side == 1 ? first + v : first + u;
                polygons.push_back({vertex(first), vertex(second), vertex(first + u + v), vertex(last)});
            }
        }
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage jack() {
    return voxels({{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
}

cage::Cage biped() {
    std::vector<glm::ivec3> cubes;
    for (const int x : {0, 1}) {
        for (const int z : {2, 3, 4}) {
            cubes.insert(cubes.end(), {{x, 0, z}, {x, 1, z}});
        }
        cubes.insert(cubes.end(), {{x, 0, 5}, {x, 0, 6}});
    }
    for (const int i : {0, 1, 2}) {
        cubes.insert(cubes.end(), {{-1 - i, 0, 4}, {2 + i, 0, 4}, {-1, 0, i}, {2, 0, i}});
    }
    return voxels(cubes);
}

cage::Cage trapezohedron(uint32_t n) {
    std::vector<glm::vec3> positions{{0.0f, 0.0f, -1.3f}, {0.0f, 0.0f, 1.3f}};
    Faces polygons;
    const uint32_t belt = 2 * n;
    for (uint32_t i = 0; i < belt; ++i) {
        const double angle = std::numbers::pi * i / n;
        positions.push_back(glm::vec3(std::cos(angle), std::sin(angle), i % 2 == 0 ? 0.15 : -0.15));
    }
    const auto onBelt = [&](uint32_t i) { return 2 + i % belt; };
    for (uint32_t i = 0; i < belt; i += 2) {
        polygons.push_back({1, onBelt(i), onBelt(i + 1), onBelt(i + 2)});
        polygons.push_back({0, onBelt(i + 1), onBelt(i), onBelt(i + belt - 1)});
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage fan(uint32_t sectors, uint32_t rings, double angle, bool closed) {
    std::vector<glm::vec3> positions;
    std::map<std::pair<uint64_t, uint64_t>, uint32_t> known;
    Faces polygons;
    const uint32_t spokes = closed ? sectors : sectors + 1;
    const auto direction = [&](uint32_t k) {
        const double a = angle * k / sectors;
        return glm::dvec2(std::cos(a), std::sin(a));
    };
    // Point (i, j) of sector k: i steps along spoke k, j along spoke k + 1. Points on spokes are shared.
    const auto vertex = [&](uint32_t k, uint32_t i, uint32_t j) {
        std::pair<uint64_t, uint64_t> key;
        if (i == 0 && j == 0) {
            key = {0, 0};
        } else if (j == 0) {
            key = {1 + k, i};
        } else if (i == 0) {
            key = {1 + (k + 1) % spokes, j};
        } else {
            key = {1000 + k, uint64_t{1000} * i + j};
        }
        const auto [entry, isNew] = known.try_emplace(key, static_cast<uint32_t>(positions.size()));
        if (isNew) {
            const glm::dvec2 p = double(i) * direction(k) + double(j) * direction(k + 1);
            positions.push_back(glm::vec3(p.x, p.y, 0.1 * glm::dot(p, p)));
        }
        return entry->second;
    };
    vertex(0, 0, 0); // the apex is vertex 0
    for (uint32_t k = 0; k < sectors; ++k) {
        for (uint32_t j = 0; j < rings; ++j) {
            for (uint32_t i = 0; i < rings; ++i) {
                const uint32_t a = vertex(k, i, j);
                const uint32_t b = vertex(k, i + 1, j);
                const uint32_t c = vertex(k, i + 1, j + 1);
                const uint32_t d = vertex(k, i, j + 1);
                polygons.push_back({a, b, c, d});
            }
        }
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage prism(uint32_t n) {
    std::vector<glm::vec3> positions;
    Faces polygons;
    std::vector<uint32_t> bottom;
    std::vector<uint32_t> top;
    for (const float z : {-1.0f, 1.0f}) {
        for (uint32_t i = 0; i < n; ++i) {
            const double a = 2.0 * std::numbers::pi * i / n;
            positions.push_back(glm::vec3(std::cos(a), std::sin(a), z));
        }
    }
    for (uint32_t i = 0; i < n; ++i) {
        polygons.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
        bottom.push_back(n - 1 - i);
        top.push_back(n + i);
    }
    polygons.push_back(bottom);
    polygons.push_back(top);
    return makeCage(std::move(positions), polygons);
}

cage::Cage cappedCylinder(uint32_t n, uint32_t rings) {
    std::vector<glm::vec3> positions;
    Faces polygons;
    for (uint32_t r = 0; r < rings; ++r) {
        for (uint32_t i = 0; i < n; ++i) {
            const double a = 2.0 * std::numbers::pi * i / n;
            positions.push_back(glm::vec3(std::cos(a), std::sin(a), 0.8 * r));
        }
    }
    const uint32_t bottom = n * rings;
    const uint32_t top = bottom + 1;
    positions.push_back({0.0f, 0.0f, -0.5f});
    positions.push_back(glm::vec3(0.0, 0.0, 0.8 * (rings - 1) + 0.5));
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t next = (i + 1) % n;
        for (uint32_t r = 0; r + 1 < rings; ++r) {
            polygons.push_back({r * n + i, r * n + next, (r + 1) * n + next, (r + 1) * n + i});
        }
        polygons.push_back({next, i, bottom});
        polygons.push_back({(rings - 1) * n + i, (rings - 1) * n + next, top});
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage gyroBipyramid(uint32_t n) {
    std::vector<glm::vec3> positions{{0.0f, 0.0f, -1.2f}, {0.0f, 0.0f, 1.2f}};
    Faces polygons;
    for (const double turn : {0.0, 0.5}) {
        for (uint32_t i = 0; i < n; ++i) {
            const double a = 2.0 * std::numbers::pi * (i + turn) / n;
            positions.push_back(glm::vec3(std::cos(a), std::sin(a), turn - 0.25));
        }
    }
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t low = 2 + i;
        const uint32_t lowNext = 2 + (i + 1) % n;
        const uint32_t high = low + n;
        const uint32_t highNext = lowNext + n;
        polygons.push_back({0, lowNext, low});
        polygons.push_back({1, high, highNext});
        polygons.push_back({low, lowNext, high});
        polygons.push_back({lowNext, highNext, high});
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage fanOverQuads(uint32_t n) {
    const cage::Cage source = prism(n);
    Faces polygons = facesOf(source);
    const std::vector<uint32_t> lid = polygons.back();
    polygons.pop_back();
    std::vector<glm::vec3> positions = source.positions;
    positions.push_back({0.0f, 0.0f, 1.5f});
    for (uint32_t i = 0; i < n; ++i) {
        polygons.push_back({lid[i], lid[(i + 1) % n], 2 * n});
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage fanOverTriangles(uint32_t n) {
    std::vector<glm::vec3> positions{{0.0f, 0.0f, 1.0f}};
    Faces polygons;
    const auto add = [&](double angle, double z) {
        positions.push_back(glm::vec3(std::cos(angle), std::sin(angle), z));
    };
    for (uint32_t i = 0; i < 2 * n; ++i) {
        add(std::numbers::pi * i / n, 0.5);
    }
    for (uint32_t i = 0; i < n; ++i) { // foot i stands below the middle of rim 2 i and rim 2 i + 1
        add(std::numbers::pi * (2 * i + 0.5) / n, -0.5);
    }
    const auto rim = [n](uint32_t i) { return 1 + (i == 2 * n ? 0 : i); };
    const auto foot = [n](uint32_t i) { return 1 + 2 * n + (i == n ? 0 : i); };
    std::vector<uint32_t>& bottom = polygons.emplace_back();
    for (uint32_t i = n; i-- > 0;) {
        bottom.push_back(foot(i));
    }
    for (uint32_t i = 0; i < n; ++i) {
        polygons.push_back({0, rim(2 * i), rim(2 * i + 1)});
        polygons.push_back({0, rim(2 * i + 1), rim(2 * i + 2)});
        polygons.push_back({rim(2 * i + 1), rim(2 * i), foot(i)});
        polygons.push_back({rim(2 * i + 2), rim(2 * i + 1), foot(i), foot(i + 1)});
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage fanOverPentagons(uint32_t n) {
    std::vector<glm::vec3> positions{{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, -1.0f}};
    Faces polygons;
    const auto ring = [&](double radius, double z, double turn) {
        for (uint32_t i = 0; i < n; ++i) {
            const double a = 2.0 * std::numbers::pi * (i + turn) / n;
            positions.push_back(glm::vec3(radius * std::cos(a), radius * std::sin(a), z));
        }
    };
    ring(0.9, 0.7, 0.0);
    ring(1.1, 0.0, 0.0);
    ring(1.0, -0.5, 0.5);
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t next = (i + 1) % n;
        const uint32_t rim = 2;
        const uint32_t belt = 2 + n;
        const uint32_t foot = 2 + 2 * n; // foot i stands between belt i and i + 1
        polygons.push_back({0, rim + i, rim + next});
        polygons.push_back({rim + next, rim + i, belt + i, foot + i, belt + next});
        polygons.push_back({1, foot + next, belt + next, foot + i});
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage quartered(const cage::Cage& triangles) {
    std::vector<glm::vec3> positions = triangles.positions;
    Faces polygons;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [entry, isNew] =
            middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<uint32_t>(positions.size()));
        if (isNew) {
            positions.push_back((positions[a] + positions[b]) * 0.5f);
        }
        return entry->second;
    };
    for (const std::vector<uint32_t>& t : facesOf(triangles)) {
        const uint32_t x = middle(t.at(0), t.at(1));
        const uint32_t y = middle(t.at(1), t.at(2));
        const uint32_t z = middle(t.at(2), t.at(0));
        polygons.insert(polygons.end(), {{t[0], x, z}, {t[1], y, x}, {t[2], z, y}, {x, y, z}});
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage withCutQuads(const cage::Cage& cage, double share, uint32_t seed) {
    std::mt19937 random(seed);
    Faces polygons;
    for (const std::vector<uint32_t>& p : facesOf(cage)) {
        if (p.size() == 4 && random() < share * 4294967296.0) {
            polygons.push_back({p[0], p[1], p[2]});
            polygons.push_back({p[0], p[2], p[3]});
        } else {
            polygons.push_back(p);
        }
    }
    return makeCage(cage.positions, polygons);
}

cage::Cage withMergedFaces(const cage::Cage& cage, uint32_t tries, uint32_t seed) {
    std::mt19937 random(seed);
    Faces polygons = facesOf(cage);
    std::vector<uint32_t> valences(cage.vertexCount(), 0); // of closed cages; boundaries only lose less
    for (const std::vector<uint32_t>& p : polygons) {
        for (const uint32_t v : p) {
            ++valences[v];
        }
    }
    for (uint32_t t = 0; t < tries; ++t) {
        std::vector<uint32_t>& p = polygons[random() % polygons.size()];
        const size_t i = random() % p.size();
        const uint32_t a = p[i];
        const uint32_t b = p[(i + 1) % p.size()];
        const auto other = std::find_if(polygons.begin(), polygons.end(), [&](const std::vector<uint32_t>& q) {
            const auto at = std::find(q.begin(), q.end(), b);
            return at != q.end() && (at + 1 == q.end() ? q.front() : *(at + 1)) == a;
        });
        if (other == polygons.end() || p.size() + other->size() > 7 || valences[a] <= 3 || valences[b] <= 3) {
            continue;
        }
        // b ... a of this face, then what lies between a and b in the other; each other vertex must be met once.
        std::vector<uint32_t> merged = p;
        std::rotate(merged.begin(), merged.begin() + static_cast<std::ptrdiff_t>((i + 1) % p.size()), merged.end());
        std::vector<uint32_t> rest = *other;
        std::rotate(rest.begin(), std::find(rest.begin(), rest.end(), a), rest.end());
        merged.insert(merged.end(), rest.begin() + 1, rest.end() - 1);
        if (std::set<uint32_t>(merged.begin(), merged.end()).size() != merged.size()) {
            continue;
        }
        --valences[a];
        --valences[b];
        p = merged;
        polygons.erase(other);
    }
    return makeCage(cage.positions, polygons);
}

cage::Cage withoutFaces(const cage::Cage& cage, const std::vector<uint32_t>& faces) {
    std::vector<glm::vec3> positions;
    Faces polygons;
    std::vector<uint32_t> renumbered(cage.vertexCount(), cage::kNone);
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        if (std::find(faces.begin(), faces.end(), f) != faces.end()) {
            continue;
        }
        std::vector<uint32_t>& polygon = polygons.emplace_back();
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            uint32_t& v = renumbered[cage.faceVertices[c]];
            if (v == cage::kNone) {
                v = static_cast<uint32_t>(positions.size());
                positions.push_back(cage.positions[cage.faceVertices[c]]);
            }
            polygon.push_back(v);
        }
    }
    return makeCage(std::move(positions), polygons);
}

cage::Cage perturbed(cage::Cage cage, float amount, uint32_t seed) {
    std::mt19937 random(seed); // the engine is specified bit for bit; the standard's distributions are not
    for (glm::vec3& p : cage.positions) {
        for (int i = 0; i < 3; ++i) {
            const double unit = static_cast<double>(random()) / 4294967295.0;
            p[i] += amount * static_cast<float>(2.0 * unit - 1.0);
        }
    }
    return cage;
}

cage::Cage rotatedFaces(cage::Cage cage) {
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        const auto first = cage.faceVertices.begin() + cage.faceStarts[f];
        std::rotate(first, first + f % cage.sides(f), cage.faceVertices.begin() + cage.faceStarts[f + 1]);
    }
    return cage;
}

RefinedCage refineCatmullClark(const cage::Cage& cage, const std::vector<glm::dvec3>& positions, bool sharpCorners) {
    // Written from the subdivision rules alone, on maps: independent of cage/topology.
    struct EdgeData {
        std::vector<uint32_t> faces;
        uint32_t point = 0;
    };
    const uint32_t vertexCount = cage.vertexCount();
    std::vector<glm::dvec3> facePoints;
    std::map<std::pair<uint32_t, uint32_t>, EdgeData> edges;
    const auto key = [](uint32_t a, uint32_t b) { return std::pair{std::min(a, b), std::max(a, b)}; };
    std::vector<std::vector<uint32_t>> vertexFaces(vertexCount);
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        glm::dvec3 sum(0.0);
        const uint32_t sides = cage.sides(f);
        for (uint32_t j = 0; j < sides; ++j) {
            const uint32_t a = cage.faceVertices[cage.faceStarts[f] + j];
            const uint32_t b = cage.faceVertices[cage.faceStarts[f] + (j + 1) % sides];
            sum += positions[a];
            edges[key(a, b)].faces.push_back(f);
            vertexFaces[a].push_back(f);
        }
        facePoints.push_back(sum / double(sides));
    }
    RefinedCage refined;
    refined.positions.resize(vertexCount);
    std::vector<glm::dvec3> edgeSums(vertexCount, glm::dvec3(0.0));
    std::vector<std::vector<uint32_t>> boundaryNeighbours(vertexCount);
    for (auto& [ends, edge] : edges) {
        const auto [a, b] = ends;
        edge.point = static_cast<uint32_t>(refined.positions.size());
        if (edge.faces.size() == 2) {
            refined.positions.push_back(
                (positions[a] + positions[b] + facePoints[edge.faces[0]] + facePoints[edge.faces[1]]) / 4.0);
        } else {
            refined.positions.push_back((positions[a] + positions[b]) / 2.0);
            boundaryNeighbours[a].push_back(b);
            boundaryNeighbours[b].push_back(a);
        }
        edgeSums[a] += (positions[a] + positions[b]) / 2.0;
        edgeSums[b] += (positions[a] + positions[b]) / 2.0;
    }
    for (uint32_t v = 0; v < vertexCount; ++v) {
        const double n = static_cast<double>(vertexFaces[v].size());
        if (!boundaryNeighbours[v].empty()) {
            const bool kept = n == 1.0 && sharpCorners;
            refined.positions[v] = kept ? positions[v]
                                        : (positions[boundaryNeighbours[v].at(0)] + 6.0 * positions[v] +
                                           positions[boundaryNeighbours[v].at(1)]) /
                                              8.0;
            continue;
        }
        glm::dvec3 faceSum(0.0);
        for (const uint32_t f : vertexFaces[v]) {
            faceSum += facePoints[f];
        }
        refined.positions[v] = (faceSum / n + 2.0 * edgeSums[v] / n + (n - 3.0) * positions[v]) / n;
    }
    const auto facePoint = static_cast<uint32_t>(refined.positions.size());
    refined.positions.insert(refined.positions.end(), facePoints.begin(), facePoints.end());
    Faces polygons;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        const uint32_t sides = cage.sides(f);
        for (uint32_t j = 0; j < sides; ++j) {
            const uint32_t before = cage.faceVertices[cage.faceStarts[f] + (j + sides - 1) % sides];
            const uint32_t v = cage.faceVertices[cage.faceStarts[f] + j];
            const uint32_t after = cage.faceVertices[cage.faceStarts[f] + (j + 1) % sides];
            polygons.push_back({v, edges[key(v, after)].point, facePoint + f, edges[key(before, v)].point});
        }
    }
    refined.cage = makeCage({refined.positions.begin(), refined.positions.end()}, polygons);
    return refined;
}

std::vector<glm::dvec3> doublePositions(const cage::Cage& cage) {
    return {cage.positions.begin(), cage.positions.end()};
}

bool allQuads(const cage::Cage& cage) {
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        if (cage.sides(f) != 4) {
            return false;
        }
    }
    return cage.faceCount() > 0;
}

double extent(const std::vector<glm::dvec3>& positions) {
    if (positions.empty()) {
        return 0.0;
    }
    glm::dvec3 low = positions.front();
    glm::dvec3 high = low;
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::distance(low, high);
}

Result<cage::Character> readObjFile(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    return cage::readObj(std::as_bytes(std::span(text)), path);
}

} // namespace supple::test
