#include "cage/split/seams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace supple::cage::split {
namespace {

/// A seam of the skin is a fault of the file only if it hardly opens: what opens further is a mouth or an eye that the
/// rest pose shows closed. Measured in half the sum of the weights' differences: 0 is the same skin, 1 has no joint in
/// common. Weights rounded to bytes, or cut to four influences, differ by less.
constexpr float kMostWeightApart = 0.1f;
/// The same for displacements, in lengths of the vertex's shortest edge.
constexpr float kMostMovedApart = 0.1f;

/// Pairs of vertices in a run. A single one that would tear a closed surface is a fault of the file.
constexpr uint32_t kFewestOpening = 2;

float weightApart(const Mesh& mesh, uint32_t a, uint32_t b) {
    std::map<uint32_t, float> differences;
    for (const Influence& influence : mesh.weights.of(a)) {
        differences[influence.joint] += influence.weight;
    }
    for (const Influence& influence : mesh.weights.of(b)) {
        differences[influence.joint] -= influence.weight;
    }
    float sum = 0.0f;
    for (const auto& [joint, difference] : differences) {
        sum += std::abs(difference);
    }
    return sum / 2.0f;
}

float movedApart(const Mesh& mesh, uint32_t a, uint32_t b) {
    std::map<uint32_t, glm::vec3> differences;
    for (const MorphDelta& delta : mesh.morphs.of(a)) {
        differences[delta.target] += delta.delta;
    }
    for (const MorphDelta& delta : mesh.morphs.of(b)) {
        differences[delta.target] -= delta.delta;
    }
    float farthest = 0.0f;
    for (const auto& [target, difference] : differences) {
        farthest = std::max(farthest, glm::length(difference));
    }
    return farthest;
}

/// The vertices that `seams` sews, in runs: neighbors are in one.
class SeamRuns {
public:
    SeamRuns(const Mesh& mesh, const Polygons& faces, const Welding& seams)
        : roots_(seams.roots), runs_(seams.roots.size(), kNone), shortest_(seams.roots.size(), kInfinity) {
        for (uint32_t v = 0; v < roots_.size(); ++v) {
            if (roots_[v] != v) {
                runs_[roots_[v]] = roots_[v];
            }
        }
        for (size_t f = 0; f < faces.faceCount(); ++f) {
            for (uint32_t c = faces.starts[f]; c < faces.starts[f + 1]; ++c) {
                const uint32_t next = c + 1 < faces.starts[f + 1] ? c + 1 : faces.starts[f];
                addEdge(mesh, roots_[faces.vertices[c]], roots_[faces.vertices[next]]);
            }
        }
    }

    [[nodiscard]] uint32_t runOf(uint32_t root) {
        while (runs_[root] != root) {
            runs_[root] = runs_[runs_[root]];
            root = runs_[root];
        }
        return root;
    }
    [[nodiscard]] bool isInRun(uint32_t root) const { return runs_[root] != kNone; }
    [[nodiscard]] float shortestEdge(uint32_t root) const { return shortest_[root]; }

private:
    static constexpr float kInfinity = std::numeric_limits<float>::infinity();

    void addEdge(const Mesh& mesh, uint32_t a, uint32_t b) {
        const float length = glm::distance(mesh.positions[a], mesh.positions[b]);
        shortest_[a] = std::min(shortest_[a], length);
        shortest_[b] = std::min(shortest_[b], length);
        if (isInRun(a) && isInRun(b)) {
            const uint32_t x = runOf(a), y = runOf(b);
            runs_[std::max(x, y)] = std::min(x, y);
        }
    }

    const std::vector<uint32_t>& roots_;
    std::vector<uint32_t> runs_;  ///< per root of sewn vertices: another one of its run, at last the smallest
    std::vector<float> shortest_; ///< per root
};

} // namespace

void keepOpenings(const Mesh& mesh, const Polygons& faces, const MeshWelding& welded, Welding& seams) {
    SeamRuns runs(mesh, faces, seams);
    std::map<uint32_t, uint32_t> pairs; // per run
    std::set<uint32_t> open;
    for (const MeshWelding::Disagreement& pair : welded.disagreements) {
        const uint32_t root = seams.roots[welded.welding.roots[pair.a]];
        if (root != seams.roots[welded.welding.roots[pair.b]]) {
            continue;
        }
        ++pairs[runs.runOf(root)];
        if (weightApart(mesh, pair.a, pair.b) > kMostWeightApart ||
            movedApart(mesh, pair.a, pair.b) > kMostMovedApart * runs.shortestEdge(root)) {
            open.insert(runs.runOf(root));
        }
    }
    std::erase_if(open, [&](uint32_t run) { return pairs[run] < kFewestOpening; });
    for (uint32_t v = 0; v < seams.roots.size(); ++v) { // a root is the smallest of its vertices, and comes first
        const uint32_t root = seams.roots[v];
        if (runs.isInRun(root) && open.count(runs.runOf(root)) != 0) {
            seams.roots[v] = v;
        }
    }
}

} // namespace supple::cage::split
