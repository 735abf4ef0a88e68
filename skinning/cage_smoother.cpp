#include "skinning/cage_smoother.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace supple::skinning {

namespace {

/// What polynomials of higher degrees add together, at most.
constexpr double kTail = 1e-12;
/// The series is found from so many samples of the function; it needs far fewer terms.
constexpr size_t kSamples = 512;

/// Those of f(w) = (1 + lambda (1 - w))^-iterations, w = cos(angle), up to the last that matters.
std::vector<double> chebyshevCoefficients(const cage::Smoothing& smoothing) {
    const double lambda = static_cast<double>(smoothing.lambda), step = 3.14159265358979323846 / kSamples;
    std::vector<double> samples(kSamples), coefficients(kSamples / 2);
    for (size_t s = 0; s < kSamples; ++s) {
        const double base = 1.0 / (1.0 + lambda * (1.0 - std::cos((static_cast<double>(s) + 0.5) * step)));
        samples[s] = 1.0;
        for (uint32_t i = 0; i < smoothing.iterations; ++i) {
            samples[s] *= base;
        }
    }
    double tail = 0.0;
    for (size_t k = coefficients.size(); k-- > 0;) {
        double sum = 0.0;
        for (size_t s = 0; s < kSamples; ++s) {
            sum += samples[s] * std::cos(static_cast<double>(k) * (static_cast<double>(s) + 0.5) * step);
        }
        coefficients[k] = (k == 0 ? 1.0 : 2.0) * sum / kSamples;
        tail += std::abs(coefficients[k]);
        if (tail < kTail) {
            coefficients.resize(k);
        }
    }
    return coefficients;
}

} // namespace

CageSmoother::CageSmoother(const cage::Character& character, const cage::Smoothing& smoothing)
    : coefficients_(chebyshevCoefficients(smoothing)) {
    findNodes(character);
    findEdges(character.cage);
    // Vertices of one node may have different masks: one that stays holds the others.
    shares_.assign(nodeCount(), 1.0);
    const std::vector<float>& mask = character.weights.mushMask;
    for (uint32_t v = 0; v < mask.size(); ++v) {
        shares_[nodes_[v]] = std::min(shares_[nodes_[v]], static_cast<double>(mask[v]));
    }
    for (uint32_t n = 0; n < nodeCount(); ++n) {
        const uint32_t degree = starts_[n + 1] - starts_[n];
        shares_[n] = degree > 0 ? shares_[n] / degree : 0.0;
    }
    isReached_.assign(nodeCount(), 0);
    before_.assign(nodeCount(), {});
    now_ = sums_ = before_;
}

void CageSmoother::findNodes(const cage::Character& character) {
    const std::vector<glm::vec3>& positions = character.cage.positions;
    const cage::SkinWeights& weights = character.weights;
    const auto skinOf = [&](uint32_t v) {
        return std::span(weights.influences).subspan(weights.starts[v], weights.starts[v + 1] - weights.starts[v]);
    };
    const auto isBefore = [&](uint32_t a, uint32_t b) {
        for (int axis = 0; axis < 3; ++axis) {
            if (positions[a][axis] != positions[b][axis]) {
                return positions[a][axis] < positions[b][axis];
            }
        }
        const auto x = skinOf(a), y = skinOf(b);
        return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end(),
                                            [](const cage::Influence& i, const cage::Influence& k) {
                                                return i.joint != k.joint ? i.joint < k.joint : i.weight < k.weight;
                                            });
    };
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return isBefore(a, b) || (!isBefore(b, a) && a < b); });
    std::vector<uint32_t> firsts(positions.size()); // by vertex: the first one of its node
    for (size_t i = 0; i < order.size(); ++i) {
        const bool isNew = i == 0 || isBefore(order[i - 1], order[i]);
        firsts[order[i]] = isNew ? order[i] : firsts[order[i - 1]];
    }
    nodes_.resize(positions.size());
    for (uint32_t v = 0; v < firsts.size(); ++v) {
        if (firsts[v] == v) {
            vertices_.push_back(v);
        }
        nodes_[v] = firsts[v] == v ? nodeCount() - 1 : nodes_[firsts[v]];
    }
}

void CageSmoother::findEdges(const cage::Cage& cage) {
    std::vector<uint64_t> edges; // both ways
    edges.reserve(2 * cage.faceVertices.size());
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        const uint32_t first = cage.faceStarts[f], count = cage.faceStarts[f + 1] - first;
        for (uint32_t c = 0; c < count; ++c) {
            const uint64_t a = nodes_[cage.faceVertices[first + c]];
            const uint64_t b = nodes_[cage.faceVertices[first + (c + 1) % count]];
            if (a != b) {
                edges.push_back(a << 32 | b);
                edges.push_back(b << 32 | a);
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    starts_.assign(nodeCount() + size_t{1}, 0);
    neighbors_.reserve(edges.size());
    for (const uint64_t edge : edges) {
        ++starts_[(edge >> 32) + 1];
        neighbors_.push_back(static_cast<uint32_t>(edge));
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
}

void CageSmoother::forget() {
    for (const uint32_t node : reached_) {
        before_[node] = now_[node] = sums_[node] = {};
    }
}

/// Ring k is what a walk of k steps can reach.
void CageSmoother::reach(std::span<const uint32_t> nodes) {
    forget();
    reached_.assign(nodes.begin(), nodes.end());
    for (const uint32_t node : nodes) {
        isReached_[node] = 1;
    }
    ends_.assign(1, static_cast<uint32_t>(reached_.size()));
    size_t next = 0;
    while (ends_.size() < coefficients_.size()) {
        for (; next < ends_.back(); ++next) {
            const uint32_t node = reached_[next];
            for (uint32_t i = starts_[node]; i < starts_[node + 1]; ++i) {
                if (isReached_[neighbors_[i]] == 0 && moves(neighbors_[i])) {
                    isReached_[neighbors_[i]] = 1;
                    reached_.push_back(neighbors_[i]);
                }
            }
        }
        ends_.push_back(static_cast<uint32_t>(reached_.size()));
    }
    for (const uint32_t node : reached_) {
        isReached_[node] = 0;
    }
}

uint64_t CageSmoother::work(std::span<const uint32_t> nodes) {
    reach(nodes);
    uint64_t products = 0;
    for (const uint32_t node : reached_) {
        products += 1 + starts_[node + 1] - starts_[node];
    }
    return products * coefficients_.size();
}

std::span<const uint32_t> CageSmoother::smooth(std::span<const uint32_t> nodes, std::span<const Values> values) {
    reach(nodes);
    for (size_t i = 0; i < nodes.size(); ++i) {
        now_[nodes[i]] = values[i];
        for (size_t c = 0; c < kColumns; ++c) {
            sums_[nodes[i]][c] = coefficients_[0] * values[i][c];
        }
    }
    // T_0 = 1, T_1 = W, T_k+1 = 2 W T_k - T_k-1
    for (size_t k = 1; k < coefficients_.size(); ++k) {
        const double factor = k == 1 ? 1.0 : 2.0, coefficient = coefficients_[k];
        for (size_t r = 0; r < ends_[k]; ++r) {
            const uint32_t node = reached_[r];
            const double share = shares_[node];
            const double stays = 1.0 - share * (starts_[node + 1] - starts_[node]);
            Values around{};
            for (uint32_t i = starts_[node]; i < starts_[node + 1]; ++i) {
                const Values& other = now_[neighbors_[i]];
                for (size_t c = 0; c < kColumns; ++c) {
                    around[c] += other[c];
                }
            }
            const Values& own = now_[node];
            Values& next = before_[node]; // in the place of what is needed here for the last time
            Values& sum = sums_[node];
            for (size_t c = 0; c < kColumns; ++c) {
                next[c] = factor * (stays * own[c] + share * around[c]) - next[c];
                sum[c] += coefficient * next[c];
            }
        }
        std::swap(before_, now_);
    }
    return reached_;
}

} // namespace supple::skinning
