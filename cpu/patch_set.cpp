#include "cpu/patch_set.h"

#include "cpu/grid_places.h"
#include "cpu/lanes.h"
#include "cpu/normals.h"
#include "cpu/pm_construction.h"
#include "cpu/sectors.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

namespace supple::cpu {
namespace {

constexpr uint32_t kRowsPerJob = 2048;
/// Weights that are nothing but what the sums of forms left over.
constexpr double kNoWeight = 1e-14;

void set(Lanes3& to, uint32_t lane, const glm::vec3& from) {
    to.at[0][lane] = from.x;
    to.at[1][lane] = from.y;
    to.at[2][lane] = from.z;
}
glm::vec3 at(const Lanes3& from, uint32_t lane) {
    return {from.at[0][lane], from.at[1][lane], from.at[2][lane]};
}

/// Places that wait for all lanes to be taken.
struct Waiting {
    std::array<uint32_t, kLanes> places{};
    uint32_t count = 0;

    /// The lane of one more place.
    uint32_t take(size_t place) {
        places[count] = static_cast<uint32_t>(place);
        return count++;
    }
    [[nodiscard]] bool full() const { return count == kLanes; }
    /// Hands over the results.
    void give(const JetLanes& from, const glm::vec3& origin, std::span<const Place> all, std::span<SurfaceJet> out) {
        for (uint32_t lane = 0; lane < count; ++lane) {
            SurfaceJet& jet = out[places[lane]];
            jet.position = glm::dvec3(origin) + glm::dvec3(at(from.position, lane));
            jet.du = at(from.du, lane), jet.dv = at(from.dv, lane);
            jet.duu = at(from.duu, lane), jet.duv = at(from.duv, lane), jet.dvv = at(from.dvv, lane);
            turn(all[places[lane]], jet);
        }
        count = 0;
    }
};

template <uint32_t N>
struct Tensors {
    TensorLanes<N> patches{};
    WeightLanes<N> u{}, v{};
    Waiting waiting;

    void flush(const glm::vec3& origin, std::span<const Place> places, std::span<SurfaceJet> out) {
        if (waiting.count == 0) {
            return;
        }
        JetLanes jets;
        laneKernels().tensors<N>().evaluate(patches, u, v, jets);
        waiting.give(jets, origin, places, out);
    }
};

/// Places in sectors; their derivatives are turned from the sector's into the patch's before they wait.
struct Quartics {
    QuarticLanes triangles{};
    Waiting waiting;

    void flush(const glm::vec3& origin, std::span<const Place> places, std::span<SurfaceJet> out) {
        if (waiting.count == 0) {
            return;
        }
        JetLanes jets;
        laneKernels().quartics(triangles, jets);
        waiting.give(jets, origin, places, out);
    }
};

} // namespace

uint32_t PatchSet::addTensor(std::span<const Form> net) {
    return net.size() == 16 ? add(Kind::cubic, PatchClass::regular, 4, net)
                            : add(Kind::quintic, PatchClass::perturbed, 4, net);
}

uint32_t PatchSet::addPolar(std::span<const Form> net) {
    return add(Kind::cubic, PatchClass::polar, 3, net);
}

uint32_t PatchSet::addSectors(PatchClass patchClass, std::span<const Form> coefficients) {
    return add(Kind::sectors, patchClass, static_cast<uint32_t>(coefficients.size() / 6), coefficients);
}

uint32_t PatchSet::add(Kind kind, PatchClass patchClass, uint32_t sides, std::span<const Form> coefficients) {
    patches_.push_back({kind, sides, static_cast<uint32_t>(coefficients_.size()),
                        static_cast<uint32_t>(coefficients.size()), patchClass});
    for (const Form& form : coefficients) {
        coefficients_.push_back(rowOf(form));
    }
    return patchCount() - 1;
}

/// Patches share the coefficients that are made of the same vertices with the same weights. Borders of two patches have
/// the same coefficients where their weights come out the same, and others nearly.
uint32_t PatchSet::rowOf(const Form& form) {
    const auto first = static_cast<uint32_t>(vertices_.size());
    uint64_t hash = 0xCBF29CE484222325u;
    const auto mix = [&](uint32_t word) { hash = (hash ^ word) * 0x100000001B3u; };
    for (const Form::Entry& entry : form.entries()) {
        if (std::abs(entry.weight) > kNoWeight) {
            vertices_.push_back(entry.vertex);
            weights_.push_back(static_cast<float>(entry.weight));
            mix(entry.vertex);
            mix(std::bit_cast<uint32_t>(weights_.back()));
        }
    }
    const Row row{first, static_cast<uint32_t>(vertices_.size()) - first};
    const auto [begin, end] = known_.equal_range(hash);
    for (auto known = begin; known != end; ++known) {
        const Row& other = rows_[known->second];
        if (other.count == row.count &&
            std::equal(vertices_.begin() + first, vertices_.end(), vertices_.begin() + other.first) &&
            std::equal(weights_.begin() + first, weights_.end(), weights_.begin() + other.first)) {
            vertices_.resize(first);
            weights_.resize(first);
            return known->second;
        }
    }
    rows_.push_back(row);
    const auto number = static_cast<uint32_t>(rows_.size()) - 1;
    known_.emplace(hash, number);
    return number;
}

Status PatchSet::build(std::span<const glm::vec3> cage, const RunJobs& runJobs, PatchPose& pose) const {
    pose.origin = cage.empty() ? glm::vec3(0.0f) : cage[0];
    return inRanges(runJobs, static_cast<uint32_t>(rows_.size()), kRowsPerJob, [&](uint32_t begin, uint32_t end) {
        for (uint32_t r = begin; r < end; ++r) {
            // Differences from the row's first vertex: its own weight need not be known, as all sum to 1.
            const uint32_t* const vertex = &vertices_[rows_[r].first];
            const float* const weight = &weights_[rows_[r].first];
            const glm::vec3 first = cage[vertex[0]];
            glm::vec3 sum(0.0f);
            for (uint32_t k = 1; k < rows_[r].count; ++k) {
                sum += weight[k] * (cage[vertex[k]] - first);
            }
            pose.points[r] = (first - pose.origin) + sum;
        }
    });
}

std::array<glm::vec3, 15> PatchSet::quarticNet(const Patch& patch, uint32_t sector, const PatchPose& pose) const {
    std::array<glm::vec3, 31> c;
    for (uint32_t k = 0; k < patch.count; ++k) {
        c[k] = coefficient(patch, k, pose);
    }
    return surface::pm::quarticOf(surface::pm::SectorView<glm::vec3>(c, patch.sides, glm::vec3(0.0f)), sector);
}

void PatchSet::evaluate(std::span<const Place> places, const PatchPose& pose, std::span<SurfaceJet> out) const {
    Tensors<4> cubics;
    Tensors<6> quintics;
    Quartics quartics;
    std::vector<Place> turned(places.begin(), places.end());
    const auto addTensorPlace = [&](auto& tensors, const Patch& patch, size_t p) {
        const uint32_t lane = tensors.waiting.take(p);
        for (uint32_t k = 0; k < patch.count; ++k) {
            set(tensors.patches.net[k], lane, coefficient(patch, k, pose));
        }
        const Place& place = places[p];
        setBernstein(tensors.u, lane, static_cast<float>(place.x), static_cast<float>(1.0 - place.x));
        setBernstein(tensors.v, lane, static_cast<float>(place.y), static_cast<float>(1.0 - place.y));
        if (tensors.waiting.full()) {
            tensors.flush(pose.origin, turned, out);
        }
    };
    const auto addSectorPlace = [&](const Patch& patch, size_t p) {
        const uint32_t lane = quartics.waiting.take(p);
        const SectorPlace place = sectorPlace(patch.sides, places[p]);
        const std::array<glm::vec3, 15> net = quarticNet(patch, place.place.sector, pose);
        for (size_t k = 0; k < net.size(); ++k) {
            set(quartics.triangles.net[k], lane, net[k]);
        }
        set(quartics.triangles.weights, lane, glm::vec3(place.weights));
        turned[p] = place.place;
        if (quartics.waiting.full()) {
            quartics.flush(pose.origin, turned, out);
        }
    };
    for (size_t p = 0; p < places.size(); ++p) {
        const Patch& patch = patches_[places[p].piece];
        if (patch.kind == Kind::cubic) {
            addTensorPlace(cubics, patch, p);
        } else if (patch.kind == Kind::quintic) {
            addTensorPlace(quintics, patch, p);
        } else {
            addSectorPlace(patch, p);
        }
    }
    cubics.flush(pose.origin, turned, out);
    quintics.flush(pose.origin, turned, out);
    quartics.flush(pose.origin, turned, out);
}

namespace {

/// Bernstein polynomials of degree N - 1 at t, and their slopes.
template <size_t N>
struct Bernstein {
    explicit Bernstein(double t) {
        std::array<double, N> lower{}; // of one degree less
        value[0] = 1.0;
        for (size_t degree = 1; degree < N; ++degree) {
            lower = value;
            for (size_t k = degree + 1; k-- > 0;) {
                value[k] = (1.0 - t) * (k < degree ? lower[k] : 0.0) + t * (k > 0 ? lower[k - 1] : 0.0);
            }
        }
        for (size_t k = 0; k < N; ++k) {
            slope[k] = static_cast<double>(N - 1) * ((k > 0 ? lower[k - 1] : 0.0) - (k + 1 < N ? lower[k] : 0.0));
        }
    }
    std::array<double, N> value{}, slope{};
};

/// What the coefficients of a tensor patch have at a place.
template <size_t N>
std::array<VertexWeight, N * N> tensorWeights(const Place& place) {
    const Bernstein<N> u(place.x), v(place.y);
    std::array<VertexWeight, N * N> weights;
    for (size_t k = 0; k < weights.size(); ++k) {
        const size_t i = k % N, j = k / N;
        weights[k] = {0, u.value[i] * v.value[j], u.slope[i] * v.value[j], u.value[i] * v.slope[j]};
    }
    return weights;
}

/// What the 15 coefficients of a sector have where its corners have the weights w.
std::array<VertexWeight, 15> quarticWeights(const glm::dvec3& w) {
    constexpr std::array<double, 5> kFactorials{1.0, 1.0, 2.0, 6.0, 24.0};
    std::array<VertexWeight, 15> weights;
    size_t number = 0;
    for (int r = 0; r <= 4; ++r) {
        for (int i = 0; i + r <= 4; ++i) {
            const std::array<int, 3> powers{4 - i - r, i, r};
            const auto term = [&](int lowered) { // the product, or its slope by one of the weights
                double product = 24.0;
                for (int c = 0; c < 3; ++c) {
                    const auto power = static_cast<size_t>(powers[static_cast<size_t>(c)]);
                    product *= std::pow(w[c], static_cast<double>(power) - (c == lowered ? 1.0 : 0.0)) /
                               kFactorials[power] * (c == lowered ? static_cast<double>(power) : 1.0);
                }
                return product;
            };
            const auto slope = [&](int by) { return powers[static_cast<size_t>(by)] > 0 ? term(by) : 0.0; };
            weights[number++] = {0, term(-1), slope(1) - slope(0), slope(2) - slope(0)};
        }
    }
    return weights;
}

} // namespace

void PatchSet::weighRow(uint32_t row, const VertexWeight& weight, PointWeights& out) const {
    // As build() has it: the first vertex has what the others leave of 1.
    const Row& of = rows_[row];
    double rest = 1.0;
    for (uint32_t k = of.first + 1; k < of.first + of.count; ++k) {
        const double own = weights_[k];
        VertexWeight entry = own * weight;
        entry.vertex = vertices_[k];
        out.add(entry);
        rest -= own;
    }
    VertexWeight entry = rest * weight;
    entry.vertex = vertices_[of.first];
    out.add(entry);
}

void PatchSet::weigh(const Place& place, PointWeights& out) const {
    const Patch& patch = patches_[place.piece];
    const auto weighAll = [&](const auto& weights) {
        for (uint32_t k = 0; k < weights.size(); ++k) {
            weighRow(coefficients_[patch.first + k], weights[k], out);
        }
    };
    if (patch.kind == Kind::cubic) {
        weighAll(tensorWeights<4>(place));
        out.turn(place);
        return;
    }
    if (patch.kind == Kind::quintic) {
        weighAll(tensorWeights<6>(place));
        out.turn(place);
        return;
    }
    std::array<Form, 31> coefficients;
    for (uint32_t k = 0; k < patch.count; ++k) {
        coefficients[k] = Form::ofVertex(k);
    }
    const SectorPlace sector = sectorPlace(patch.sides, place);
    const std::array<Form, 15> net =
        surface::pm::quarticOf(surface::pm::SectorView<Form>(coefficients, patch.sides, Form()), sector.place.sector);
    const std::array<VertexWeight, 15> weights = quarticWeights(sector.weights);
    PointWeights ofPatch; // by coefficient
    for (size_t k = 0; k < net.size(); ++k) {
        ofPatch.add(net[k], weights[k]);
    }
    for (const VertexWeight& entry : ofPatch.entries()) {
        weighRow(coefficients_[patch.first + entry.vertex], entry, out);
    }
    out.turn(sector.place);
}

/// The weights of all parameters of a rate, the same in every lane.
template <uint32_t N>
struct PatchSet::GridWeights {
    explicit GridWeights(uint32_t rateOf) : rate(rateOf), at(rateOf + 1) {
        for (uint32_t k = 0; k <= rate; ++k) {
            const float t = static_cast<float>(k) / static_cast<float>(rate);
            const float back = static_cast<float>(rate - k) / static_cast<float>(rate);
            for (uint32_t lane = 0; lane < kLanes; ++lane) {
                setBernstein(at[k], lane, t, back);
            }
        }
    }
    uint32_t rate;
    std::vector<WeightLanes<N>> at;
};

template <uint32_t N>
bool PatchSet::gridOf(std::span<const uint32_t> patches, const GridWeights<N>& weights, const PatchPose& pose,
                      const GridOutput& out) const {
    const uint32_t rate = weights.rate;
    const TensorKernels<N>& kernels = laneKernels().tensors<N>();
    TensorLanes<N> nets{};
    for (uint32_t lane = 0; lane < patches.size(); ++lane) {
        for (uint32_t k = 0; k < N * N; ++k) {
            set(nets.net[k], lane, coefficient(patches_[patches[lane]], k, pose));
        }
    }
    const size_t samples = size_t{rate + 1} * (rate + 1);
    RowLanes<N> row;
    VertexLanes vertices{};
    bool lacks = false;
    for (uint32_t j = 0; j <= rate; ++j) {
        kernels.collapse(nets, weights.at[j], row);
        for (uint32_t i = 0; i <= rate; ++i) {
            kernels.vertices(row, weights.at[i], vertices);
            size_t vertex = j * size_t{rate + 1} + i;
            for (uint32_t lane = 0; lane < patches.size(); ++lane, vertex += samples) {
                out.positions[vertex] = pose.origin + at(vertices.position, lane);
                if (!out.normals.empty()) {
                    out.normals[vertex] = at(vertices.normal, lane);
                }
            }
            lacks = lacks || vertices.lacksNormals;
        }
    }
    return !lacks;
}

/// The samples of a patch of sectors, sector by sector, with the weights of the sector's corners.
struct PatchSet::SectorSamples {
    SectorSamples(const Patch& patch, uint32_t rate) : bySector(patch.sides) {
        const surface::Domain domain = surface::domainOf(patch.patchClass);
        count = surface::sampleCount(domain, rate);
        for (uint32_t sample = 0; sample < count; ++sample) {
            const SectorPlace at = sectorPlace(patch.sides, gridPlace(domain, rate, sample, 0.0));
            bySector[at.place.sector].push_back({sample, at.weights});
        }
    }
    struct Sample {
        uint32_t number = 0;
        glm::vec3 weights{0.0f};
    };
    std::vector<std::vector<Sample>> bySector;
    uint32_t count = 0;
};

bool PatchSet::sectorGrid(const Patch& patch, const SectorSamples& samples, const PatchPose& pose,
                          const GridOutput& out) const {
    QuarticLanes triangles{};
    JetLanes jets;
    bool lacks = false;
    for (uint32_t sector = 0; sector < patch.sides; ++sector) {
        const std::array<glm::vec3, 15> net = quarticNet(patch, sector, pose);
        for (uint32_t lane = 0; lane < kLanes; ++lane) {
            for (size_t k = 0; k < net.size(); ++k) {
                set(triangles.net[k], lane, net[k]);
            }
        }
        const std::vector<SectorSamples::Sample>& all = samples.bySector[sector];
        for (size_t first = 0; first < all.size(); first += kLanes) {
            const auto count = static_cast<uint32_t>(std::min<size_t>(kLanes, all.size() - first));
            for (uint32_t lane = 0; lane < count; ++lane) {
                set(triangles.weights, lane, all[first + lane].weights);
            }
            laneKernels().quartics(triangles, jets);
            for (uint32_t lane = 0; lane < count; ++lane) {
                const uint32_t vertex = all[first + lane].number;
                out.positions[vertex] = pose.origin + at(jets.position, lane);
                if (!out.normals.empty()) {
                    // Corner, next corner, middle: counter-clockwise, so du x dv points outwards.
                    out.normals[vertex] = unitNormal(at(jets.du, lane), at(jets.dv, lane));
                    lacks = lacks || out.normals[vertex] == glm::vec3(0.0f);
                }
            }
        }
    }
    return !lacks;
}

bool PatchSet::grid(std::span<const uint32_t> patches, uint32_t rate, const PatchPose& pose,
                    const GridOutput& out) const {
    std::array<std::optional<SectorSamples>, surface::kMaxSides + 1> sectors; // by sides
    std::optional<GridWeights<4>> cubic;
    std::optional<GridWeights<6>> quintic;
    bool whole = true;
    size_t vertex = 0;
    for (size_t begin = 0; begin < patches.size();) {
        const Patch& patch = patches_[patches[begin]];
        if (patch.kind == Kind::sectors) {
            std::optional<SectorSamples>& samples = sectors[patch.sides];
            samples = samples ? std::move(samples) : SectorSamples(patch, rate);
            whole = sectorGrid(patch, *samples, pose, out.from(vertex)) && whole;
            vertex += samples->count;
            ++begin;
            continue;
        }
        size_t end = begin + 1;
        while (end < patches.size() && end - begin < kLanes && patches_[patches[end]].kind == patch.kind) {
            ++end;
        }
        const std::span<const uint32_t> some = patches.subspan(begin, end - begin);
        const GridOutput here = out.from(vertex);
        if (patch.kind == Kind::cubic) {
            if (!cubic) {
                cubic.emplace(rate);
            }
            whole = gridOf<4>(some, *cubic, pose, here) && whole;
        } else {
            if (!quintic) {
                quintic.emplace(rate);
            }
            whole = gridOf<6>(some, *quintic, pose, here) && whole;
        }
        vertex += some.size() * (rate + 1) * (rate + 1);
        begin = end;
    }
    return whole;
}

} // namespace supple::cpu
