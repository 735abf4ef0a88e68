#include "runtime/arrays/vertex_arrays.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace supple::runtime {

namespace {

/// The influences of one vertex among all.
struct Range {
    uint64_t begin = 0, end = 0;
};

Range rangeOf(const SuppleInfluences& from, uint32_t v) {
    if (from.starts != nullptr) {
        return {from.starts[v], from.starts[v + 1]};
    }
    return {uint64_t{v} * from.perVertex, (uint64_t{v} + 1) * from.perVertex};
}

class InfluenceCheck {
public:
    InfluenceCheck(const SuppleInfluences& from, uint32_t vertexCount, size_t jointCount, Faults& faults)
        : from_(from), vertexCount_(vertexCount), jointCount_(jointCount), faults_(faults) {}

    /// False: a fault.
    bool run() {
        if (!checkStarts() ||
            !faults_.present(1, "influences.joints or influences.weights", from_.joints, from_.weights)) {
            return false;
        }
        cage::Found weights;
        cage::Found joints;
        for (uint32_t v = 0; v < vertexCount_; ++v) {
            for (uint64_t i = rangeOf(from_, v).begin; i < rangeOf(from_, v).end; ++i) {
                if (!std::isfinite(from_.weights[i]) || from_.weights[i] < 0.0f) {
                    weights.add([&] { return placeOf(v, i); });
                } else if (from_.weights[i] > 0.0f && from_.joints[i] >= jointCount_) {
                    joints.add([&] {
                        return "joint " + std::to_string(from_.joints[i]) + " of " + std::to_string(jointCount_) +
                               " at " + placeOf(v, i);
                    });
                }
            }
        }
        faults_.add(weights, "weight is negative or not finite", "weights are negative or not finite");
        faults_.add(joints, "influence is of no joint of the skin", "influences are of no joints of the skin");
        return weights.count + joints.count == 0;
    }

private:
    [[nodiscard]] std::string placeOf(uint32_t v, uint64_t i) const {
        return "influence " + std::to_string(i - rangeOf(from_, v).begin) + " of vertex " + std::to_string(v);
    }

    bool checkStarts() {
        if (from_.starts == nullptr) {
            if (from_.perVertex == 0) {
                faults_.add("influences: neither starts nor perVertex, but the part has a skin");
            }
            return from_.perVertex != 0;
        }
        if (from_.starts[0] != 0) {
            faults_.add("influences.starts[0] is not 0");
            return false;
        }
        cage::Found falling;
        cage::Found none;
        for (uint32_t v = 0; v < vertexCount_; ++v) {
            if (from_.starts[v + 1] < from_.starts[v]) {
                falling.add([&] { return cage::item("starts", v + size_t{1}); });
            } else if (from_.starts[v + 1] == from_.starts[v]) {
                none.add([&] { return cage::at("vertex", v); });
            }
        }
        faults_.add(falling, "of influences.starts is less than the one before",
                    "of influences.starts are less than the one before");
        faults_.add(none, "vertex has no influence", "vertices have no influences");
        return falling.count + none.count == 0;
    }

    const SuppleInfluences& from_;
    const uint32_t vertexCount_;
    const size_t jointCount_;
    Faults& faults_;
};

} // namespace

bool checkInfluences(const SuppleInfluences& from, uint32_t vertexCount, size_t jointCount, Faults& faults) {
    return InfluenceCheck(from, vertexCount, jointCount, faults).run();
}

void appendInfluences(const SuppleInfluences& from, std::span<const uint32_t> vertices, size_t jointCount,
                      cage::VertexWeights& weights) {
    std::vector<cage::Influence> own;
    for (const uint32_t v : vertices) {
        const Range range = rangeOf(from, v);
        own.clear();
        for (uint64_t i = range.begin; i < range.end; ++i) {
            if (from.weights[i] > 0.0f) {
                own.push_back({from.joints[i], from.weights[i]});
            }
        }
        const uint32_t first = from.joints[range.begin];
        weights.append(own, first < jointCount ? first : 0);
    }
}

void refuseInfluences(const SuppleInfluences& from, Faults& faults) {
    if (from.starts != nullptr || from.perVertex != 0 || from.joints != nullptr || from.weights != nullptr) {
        faults.add("influences without a skin");
    }
}

std::vector<std::pair<uint32_t, cage::split::MorphDelta>>
readDisplacements(const SuppleDisplacements& from, uint32_t target, uint32_t vertexCount, Faults& faults) {
    std::vector<std::pair<uint32_t, cage::split::MorphDelta>> moved;
    const uint64_t count = from.deltas == nullptr ? 0 : from.vertices != nullptr ? from.count : vertexCount;
    cage::Found numbers;
    cage::Found strays;
    cage::Found twice;
    std::vector<uint8_t> seen(count > 0 ? vertexCount : 0, 0);
    for (uint64_t i = 0; i < count; ++i) {
        const uint64_t v = from.vertices != nullptr ? from.vertices[i] : i;
        const auto place = [&] { return cage::at("entry", i); };
        const glm::vec3 delta(from.deltas[3 * i], from.deltas[3 * i + 1], from.deltas[3 * i + 2]);
        if (v >= vertexCount) {
            strays.add(place);
        } else if (std::exchange(seen[v], uint8_t{1}) != 0) {
            twice.add(place);
        } else if (cage::faultOfCoordinates(&delta.x, 3) != nullptr) {
            numbers.add(place);
        } else if (delta != glm::vec3(0.0f)) {
            moved.push_back({static_cast<uint32_t>(v), {target, delta}});
        }
    }
    Faults own(faults.refusals(), faults.element() + " " + cage::at("target", target));
    own.add(numbers, "displacement is not finite or beyond 1e+09", "displacements are not finite or beyond 1e+09");
    own.add(strays, "displacement is of no vertex", "displacements are of no vertices");
    own.add(twice, "vertex is there twice", "vertices are there twice");
    std::sort(moved.begin(), moved.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    return moved;
}

} // namespace supple::runtime
