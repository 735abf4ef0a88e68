#include "cage/split/weld_mesh.h"

#include "cage/refusal.h"
#include "cage/split/seams.h"

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace supple::cage::split {
namespace {

using VertexPairs = std::vector<std::pair<uint32_t, uint32_t>>;

// All three compare two vertices as -1, 0, 1. Positions are finite: comparing values is comparing bits, but for -0 = 0.

int comparePositions(const Mesh& mesh, uint32_t a, uint32_t b) {
    for (int k = 0; k < 3; ++k) {
        if (mesh.positions[a][k] != mesh.positions[b][k]) {
            return mesh.positions[a][k] < mesh.positions[b][k] ? -1 : 1;
        }
    }
    return 0;
}

int compareSkins(const Mesh& mesh, uint32_t a, uint32_t b) {
    const auto x = mesh.weights.of(a);
    const auto y = mesh.weights.of(b);
    if (x.size() != y.size()) {
        return x.size() < y.size() ? -1 : 1;
    }
    for (size_t i = 0; i < x.size(); ++i) {
        if (x[i].joint != y[i].joint) {
            return x[i].joint < y[i].joint ? -1 : 1;
        }
        if (x[i].weight != y[i].weight) {
            return x[i].weight < y[i].weight ? -1 : 1;
        }
    }
    return 0;
}

int compareMorphs(const Mesh& mesh, uint32_t a, uint32_t b) {
    const auto x = mesh.morphs.of(a);
    const auto y = mesh.morphs.of(b);
    if (x.size() != y.size()) {
        return x.size() < y.size() ? -1 : 1;
    }
    for (size_t i = 0; i < x.size(); ++i) {
        if (x[i].target != y[i].target) {
            return x[i].target < y[i].target ? -1 : 1;
        }
        for (int k = 0; k < 3; ++k) {
            if (x[i].delta[k] != y[i].delta[k]) {
                return x[i].delta[k] < y[i].delta[k] ? -1 : 1;
            }
        }
    }
    return 0;
}

/// Pairs of vertices that disagree in something: counted, the first by name.
struct Disagreements {
    size_t count = 0;
    uint32_t first[2] = {0, 0};

    void add(uint32_t a, uint32_t b) {
        if (count++ == 0) {
            first[0] = std::min(a, b);
            first[1] = std::max(a, b);
        }
    }
    [[nodiscard]] std::string firstNamed() const {
        return " (first: vertices " + std::to_string(first[0]) + " and " + std::to_string(first[1]) + ")";
    }
};

/// Numbers the sets of vertices with equal position, skin and morphs, and finds where only the position is equal.
std::vector<uint32_t> candidateSets(const Mesh& mesh, const Polygons& faces, MeshWelding& out) {
    std::vector<uint32_t> order = faces.vertices;
    std::sort(order.begin(), order.end());
    order.erase(std::unique(order.begin(), order.end()), order.end());
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        int by = comparePositions(mesh, a, b);
        by = by != 0 ? by : compareSkins(mesh, a, b);
        by = by != 0 ? by : compareMorphs(mesh, a, b);
        return by != 0 ? by < 0 : a < b;
    });
    std::vector<uint32_t> sets(mesh.positions.size(), 0);
    out.places.assign(mesh.positions.size(), 0);
    uint32_t set = 0;
    uint32_t place = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        if (i > 0) {
            const uint32_t a = order[i - 1];
            const uint32_t b = order[i];
            const bool samePosition = comparePositions(mesh, a, b) == 0;
            const bool sameSkin = samePosition && compareSkins(mesh, a, b) == 0;
            const bool same = sameSkin && compareMorphs(mesh, a, b) == 0;
            set += same ? 0 : 1;
            place += samePosition ? 0 : 1;
            if (samePosition && !same) {
                out.disagreements.push_back({std::min(a, b), std::max(a, b), !sameSkin});
            }
        }
        sets[order[i]] = set;
        out.places[order[i]] = place;
    }
    return sets;
}

VertexPairs pairsOfNumbers(const std::vector<uint32_t>& cageNumbers) {
    VertexPairs pairs;
    std::map<uint32_t, uint32_t> firstOf;
    for (uint32_t v = 0; v < cageNumbers.size(); ++v) {
        const auto [first, isNew] = firstOf.try_emplace(cageNumbers[v], v);
        if (!isNew) {
            pairs.emplace_back(first->second, v);
        }
    }
    return pairs;
}

Welding weldAsGiven(const Mesh& mesh, const VertexPairs& pairs, WeldSource source, Warnings& warnings) {
    const std::string element = mesh.element + " " + weldSourceName(source);
    Disagreements skins;
    Disagreements morphs;
    for (const auto& [a, b] : pairs) {
        if (comparePositions(mesh, a, b) != 0) {
            refuse(element,
                   "merges vertices " + std::to_string(a) + " and " + std::to_string(b) + ", which differ in position");
        }
        if (compareSkins(mesh, a, b) != 0) {
            skins.add(a, b);
        }
        if (compareMorphs(mesh, a, b) != 0) {
            morphs.add(a, b);
        }
    }
    const auto report = [&](const Disagreements& found, const std::string& what) {
        if (found.count > 0) {
            warn(warnings, element,
                 "merges " + counted(found.count, "pair", "pairs") + " of vertices that differ in " + what +
                     found.firstNamed() + "; the first one's is taken");
        }
    };
    report(skins, "skin");
    report(morphs, "morph targets");
    return weldPairs(mesh.positions.size(), pairs);
}

MayJoin exceptBackToBack(const Mesh& mesh, const Polygons& faces) {
    return [&](uint32_t face, uint32_t other) { return !lieBackToBack(mesh.positions, faces, face, other); };
}

} // namespace

MeshWelding weldMesh(const Mesh& mesh, const Polygons& faces, Warnings& warnings) {
    if (!mesh.cageNumbers.empty()) {
        return {weldAsGiven(mesh, pairsOfNumbers(mesh.cageNumbers), mesh.numberSource, warnings), mesh.numberSource};
    }
    if (mesh.merges) {
        return {weldAsGiven(mesh, *mesh.merges, WeldSource::meshManifold, warnings), WeldSource::meshManifold};
    }
    MeshWelding found{{}, WeldSource::equality, {}, {}};
    found.welding = weld(candidateSets(mesh, faces, found), faces, exceptBackToBack(mesh, faces));
    return found;
}

void joinSeams(const Mesh& mesh, const Polygons& faces, MeshWelding& welded, Warnings& warnings,
               std::vector<Damage>& damages) {
    if (welded.disagreements.empty()) {
        return;
    }
    std::vector<uint32_t>& roots = welded.welding.roots;
    Polygons cageFaces = faces;
    for (uint32_t& vertex : cageFaces.vertices) {
        vertex = roots[vertex];
    }
    Welding seams = weld(welded.places, cageFaces, exceptBackToBack(mesh, cageFaces));
    unweldDefects(cageFaces, seams);
    keepOpenings(mesh, cageFaces, welded, seams);
    for (uint32_t& root : roots) {
        root = seams.roots[root];
    }
    Disagreements joined[2]; // in morph targets; in skin
    Disagreements apart[2];
    for (const MeshWelding::Disagreement& pair : welded.disagreements) {
        (roots[pair.a] == roots[pair.b] ? joined : apart)[pair.inSkin ? 1 : 0].add(pair.a, pair.b);
    }
    for (const bool inSkin : {true, false}) {
        const auto told = [&](const Disagreements& found) {
            return counted(found.count, "vertex agrees", "vertices agree") + " with another in position but not in " +
                   (inSkin ? "skin" : "morph targets") + found.firstNamed();
        };
        if (const Disagreements& found = joined[inSkin ? 1 : 0]; found.count > 0) {
            damages.push_back(
                {mesh.element + ": " + told(found) + " along a seam", "joined, as the first vertex of each has it"});
        }
        if (const Disagreements& found = apart[inSkin ? 1 : 0]; found.count > 0) {
            warn(warnings, mesh.element, told(found) + "; kept apart");
        }
    }
}

} // namespace supple::cage::split
