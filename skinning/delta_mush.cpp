#include "skinning/delta_mush.h"

#include "cage/smoothing.h"
#include "skinning/box.h"
#include "skinning/cage_smoother.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

namespace supple::skinning {

namespace {

/// Products, for each of ten columns: some seconds.
constexpr uint64_t kMostSmoothingWork = uint64_t{1} << 31;
/// By so much of its size a neighborhood is made even, so that one that is thin does not turn about its length freely:
/// the heaviest joint decides.
constexpr double kEvened = 1e-5;
/// Smoothed weights below this are rounding.
constexpr double kLeastSmoothedWeight = 1e-11;

/// About a point.
struct Moments {
    double weight = 0.0;
    glm::dvec3 offset{0.0};
    std::array<double, 6> spread{};
};
constexpr int kRows[6] = {0, 0, 0, 1, 1, 2}, kColumnsOf[6] = {0, 1, 2, 1, 2, 2};

/// Moments of one weight at a point.
Moments momentsAt(const glm::dvec3& way, double weight) {
    Moments m{weight, weight * way, {}};
    for (int i = 0; i < 6; ++i) {
        m.spread[static_cast<size_t>(i)] = weight * way[kRows[i]] * way[kColumnsOf[i]];
    }
    return m;
}

CageSmoother::Values valuesOf(const Moments& m) {
    return {m.weight,    m.offset.x,  m.offset.y,  m.offset.z,  m.spread[0],
            m.spread[1], m.spread[2], m.spread[3], m.spread[4], m.spread[5]};
}
/// The same about a point that is `by` away.
Moments shifted(const CageSmoother::Values& values, const glm::dvec3& by) {
    const glm::dvec3 first(values[1], values[2], values[3]);
    Moments m{values[0], first - values[0] * by, {}};
    for (size_t i = 0; i < 6; ++i) {
        const int r = kRows[i], c = kColumnsOf[i];
        m.spread[i] = values[4 + i] - (first[r] * by[c] + by[r] * m.offset[c]);
    }
    return m;
}

MushInfluence influenceOf(uint32_t joint, const Moments& m) {
    MushInfluence influence{joint, static_cast<float>(m.weight), glm::vec3(m.offset), {}};
    std::transform(m.spread.begin(), m.spread.end(), influence.spread.begin(),
                   [](double value) { return static_cast<float>(value); });
    return influence;
}

bool isFiniteInfluence(const MushInfluence& influence) {
    const glm::vec3& o = influence.offset;
    return std::isfinite(influence.weight + o.x + o.y + o.z) &&
           std::all_of(influence.spread.begin(), influence.spread.end(),
                       [](float value) { return std::isfinite(value); });
}

bool isHeavier(const MushInfluence& a, const MushInfluence& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.joint < b.joint;
}

class MushFinder {
public:
    explicit MushFinder(const cage::Character& character)
        : character_(character), smoother_(character, cage::smoothingOf(character)) {
        const size_t joints = character.skin.joints.size();
        nodesOf_.resize(joints);
        weightsOf_.resize(joints);
        for (uint32_t n = 0; n < smoother_.nodeCount(); ++n) {
            for (const cage::Influence& own : influencesOf(smoother_.vertexOf(n))) {
                std::vector<uint32_t>& nodes = nodesOf_[own.joint];
                if (nodes.empty() || nodes.back() != n) { // a list may name a joint twice
                    nodes.push_back(n);
                    weightsOf_[own.joint].push_back(0.0);
                }
                weightsOf_[own.joint].back() += static_cast<double>(own.weight);
            }
        }
    }

    [[nodiscard]] Result<DeltaMush> find() {
        if (Status bearable = checkWork(); !bearable) {
            return bearable.error();
        }
        findPlaces();
        totals_.resize(smoother_.nodeCount());
        lists_.resize(smoother_.nodeCount());
        heaviest_.assign(smoother_.nodeCount(), MushInfluence{});
        for (uint32_t joint = 0; joint < nodesOf_.size(); ++joint) {
            addJoint(joint);
        }
        for (uint32_t n = 0; n < smoother_.nodeCount(); ++n) {
            finish(n);
        }
        return listed();
    }

private:
    [[nodiscard]] std::span<const cage::Influence> influencesOf(uint32_t vertex) const {
        const cage::SkinWeights& weights = character_.weights;
        return std::span(weights.influences)
            .subspan(weights.starts[vertex], weights.starts[vertex + 1] - weights.starts[vertex]);
    }
    [[nodiscard]] glm::dvec3 positionOf(uint32_t node) const {
        return glm::dvec3(character_.cage.positions[smoother_.vertexOf(node)]);
    }
    [[nodiscard]] glm::dvec3 middleOf(std::span<const uint32_t> nodes) const {
        glm::dvec3 sum(0.0);
        for (const uint32_t node : nodes) {
            sum += positionOf(node) / static_cast<double>(nodes.size());
        }
        return sum;
    }

    [[nodiscard]] Status checkWork() {
        uint64_t work = 0;
        for (const std::vector<uint32_t>& nodes : nodesOf_) {
            work += smoother_.work(nodes);
            if (work > kMostSmoothingWork) {
                const cage::Smoothing smoothing = cage::smoothingOf(character_);
                return Error{ErrorCode::limit, character_.name + ": delta mush: smoothing the weights of " +
                                                   std::to_string(nodesOf_.size()) + " joints on " +
                                                   std::to_string(smoother_.nodeCount()) + " vertices, with " +
                                                   std::to_string(smoothing.iterations) + " iterations of lambda " +
                                                   std::to_string(smoothing.lambda) + ", takes more than " +
                                                   std::to_string(kMostSmoothingWork) + " products"};
            }
        }
        return success();
    }

    void findPlaces() {
        std::vector<uint32_t> all(smoother_.nodeCount());
        std::vector<CageSmoother::Values> values;
        places_.resize(all.size());
        for (uint32_t n = 0; n < all.size(); ++n) {
            all[n] = n;
        }
        const glm::dvec3 middle = middleOf(all);
        for (const uint32_t n : all) {
            values.push_back(valuesOf(momentsAt(positionOf(n) - middle, 1.0)));
        }
        for (const uint32_t n : smoother_.smooth(all, values)) {
            const CageSmoother::Values& smoothed = smoother_.smoothed(n);
            places_[n] = middle + glm::dvec3(smoothed[1], smoothed[2], smoothed[3]);
        }
    }

    /// What a joint has of the neighborhoods of all vertices.
    void addJoint(uint32_t joint) {
        const std::vector<uint32_t>& nodes = nodesOf_[joint];
        const glm::dvec3 middle = middleOf(nodes);
        std::vector<CageSmoother::Values> values;
        for (size_t i = 0; i < nodes.size(); ++i) {
            values.push_back(valuesOf(momentsAt(positionOf(nodes[i]) - middle, weightsOf_[joint][i])));
        }
        for (const uint32_t n : smoother_.smooth(nodes, values)) {
            if (smoother_.smoothed(n)[0] < kLeastSmoothedWeight) {
                continue;
            }
            const Moments moments = shifted(smoother_.smoothed(n), places_[n] - middle);
            Moments& total = totals_[n];
            total.weight += moments.weight;
            total.offset += moments.offset;
            for (size_t i = 0; i < 6; ++i) {
                total.spread[i] += moments.spread[i];
            }
            const MushInfluence influence = influenceOf(joint, moments);
            heaviest_[n] = influence.weight > heaviest_[n].weight ? influence : heaviest_[n];
            if (moments.weight >= kMushCut) {
                add(influence, lists_[n]);
            }
        }
    }

    static void add(const MushInfluence& influence, std::vector<MushInfluence>& list) {
        list.push_back(influence);
        if (list.size() >= 2 * kMostMushInfluences) {
            keepHeaviest(list, kMostMushInfluences);
        }
    }
    static void keepHeaviest(std::vector<MushInfluence>& list, size_t count) {
        std::sort(list.begin(), list.end(), isHeavier);
        list.resize(std::min(list.size(), count));
    }

    /// The heaviest joint has what the others leave of the whole; the others follow in the order of the joints.
    void finish(uint32_t n) {
        std::vector<MushInfluence>& list = lists_[n];
        std::erase_if(list, [&](const MushInfluence& own) { return own.joint == heaviest_[n].joint; });
        keepHeaviest(list, kMostMushInfluences - 1);
        std::sort(list.begin(), list.end(),
                  [](const MushInfluence& a, const MushInfluence& b) { return a.joint < b.joint; });
        Moments left = totals_[n];
        for (const MushInfluence& own : list) {
            left.weight -= static_cast<double>(own.weight);
            left.offset -= glm::dvec3(own.offset);
            for (size_t i = 0; i < 6; ++i) {
                left.spread[i] -= static_cast<double>(own.spread[i]);
            }
        }
        const double size = totals_[n].spread[0] + totals_[n].spread[3] + totals_[n].spread[5];
        for (const size_t diagonal : {0u, 3u, 5u}) {
            left.spread[diagonal] += kEvened * size;
        }
        list.insert(list.begin(), influenceOf(heaviest_[n].joint, left));
    }

    /// Whether a vertex of the node can be smoothed in floats.
    [[nodiscard]] bool isSmoothed(uint32_t n) const {
        const glm::vec3 place(places_[n]);
        return smoother_.moves(n) && std::isfinite(place.x + place.y + place.z) &&
               std::all_of(lists_[n].begin(), lists_[n].end(), isFiniteInfluence);
    }

    [[nodiscard]] DeltaMush listed() const {
        std::vector<glm::vec4> places;
        std::vector<uint32_t> starts{0};
        std::vector<MushInfluence> influences;
        for (uint32_t v = 0; v < character_.cage.vertexCount(); ++v) {
            const uint32_t n = smoother_.nodeOf(v);
            if (isSmoothed(n)) {
                places.emplace_back(places_[n], 1.0);
                influences.insert(influences.end(), lists_[n].begin(), lists_[n].end());
            } else {
                places.emplace_back(0.0f);
                for (const cage::Influence& own : influencesOf(v)) {
                    influences.push_back({own.joint, own.weight, glm::vec3(0.0f), {}});
                }
                const auto first = influences.begin() + starts.back();
                const auto heaviest =
                    std::max_element(first, influences.end(), [](const MushInfluence& a, const MushInfluence& b) {
                        return a.weight < b.weight;
                    });
                std::rotate(first, heaviest, heaviest + 1);
            }
            starts.push_back(static_cast<uint32_t>(influences.size()));
        }
        return DeltaMush::of(character_, std::move(places), std::move(starts), std::move(influences));
    }

    const cage::Character& character_;
    CageSmoother smoother_;
    std::vector<std::vector<uint32_t>> nodesOf_; ///< by joint: those that it moves
    std::vector<std::vector<double>> weightsOf_; ///< the weights of these
    // By node:
    std::vector<glm::dvec3> places_;
    std::vector<Moments> totals_;                   ///< of all joints, about the places
    std::vector<std::vector<MushInfluence>> lists_; ///< of joints above the cut
    std::vector<MushInfluence> heaviest_;
};

double distanceTo(const Box& box, const glm::dvec3& point) {
    return glm::length(glm::max(glm::max(box.low - point, point - box.high), glm::dvec3(0.0)));
}

} // namespace

DeltaMush DeltaMush::of(const cage::Character& character, std::vector<glm::vec4> places, std::vector<uint32_t> starts,
                        std::vector<MushInfluence> influences) {
    const std::vector<glm::vec3>& positions = character.cage.positions;
    std::vector<Box> joints(character.skin.joints.size(), emptyBox());
    for (uint32_t v = 0; v < positions.size(); ++v) {
        for (uint32_t i = character.weights.starts[v]; i < character.weights.starts[v + 1]; ++i) {
            extend(joints[character.weights.influences[i].joint], glm::dvec3(positions[v]));
        }
    }
    std::vector<double> arms(joints.size(), 0.0);
    for (uint32_t v = 0; v < places.size(); ++v) {
        if (places[v].w == 0.0f) {
            continue;
        }
        const glm::dvec3 place(places[v]);
        double arm = glm::distance(glm::dvec3(positions[v]), place);
        // A joint moves the mean of its part of the neighborhood; mostly that lies among vertices that follow it.
        const auto add = [&](uint32_t joint, double weight, const glm::dvec3& offset) {
            if (weight > 0.0 && !isEmpty(joints[joint])) {
                arm += weight * distanceTo(joints[joint], place + offset / weight);
            }
        };
        double left = 1.0; // what the heaviest has, and its offset: what the others leave
        glm::dvec3 offset(0.0);
        for (uint32_t i = starts[v] + 1; i < starts[v + 1]; ++i) {
            const MushInfluence& own = influences[i];
            add(own.joint, static_cast<double>(own.weight), glm::dvec3(own.offset));
            left -= static_cast<double>(own.weight);
            offset -= glm::dvec3(own.offset);
        }
        add(influences[starts[v]].joint, left, offset);
        for (uint32_t i = starts[v]; i < starts[v + 1]; ++i) {
            arms[influences[i].joint] = std::max(arms[influences[i].joint], arm);
        }
    }
    return {std::move(places), std::move(starts), std::move(influences), std::move(arms)};
}

Result<DeltaMush> findDeltaMush(const cage::Character& character) {
    return MushFinder(character).find();
}

} // namespace supple::skinning
