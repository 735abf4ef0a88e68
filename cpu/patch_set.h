// Polynomial patches of a surface. Coefficients are combinations of the cage's vertices that no pose changes. They are
// made once for a posed cage; then any number of places are evaluated.
#pragma once

#include "cpu/form.h"
#include "cpu/jobs.h"
#include "cpu/place.h"
#include "cpu/point_weights.h"
#include "surface/patch_class.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace supple::cpu {

using surface::Form;
using surface::PatchClass;

/// The coefficients of a posed cage, relative to its first vertex: far from the origin floats keep their digits.
struct PatchPose {
    glm::vec3 origin{0.0f};
    std::vector<glm::vec3> points;
};

/// What a grid of one rate writes of a sample.
struct GridOutput {
    std::span<glm::vec3> positions;
    std::span<glm::vec3> normals; ///< of unit length, or zero where du and dv are parallel; empty: none

    /// From a vertex on.
    [[nodiscard]] GridOutput from(size_t vertex) const {
        return {positions.subspan(vertex), normals.empty() ? normals : normals.subspan(vertex)};
    }
};

class PatchSet {
public:
    /// A patch of N x N coefficients, u fastest: 4 x 4 or, p-rep's perturbed ones, 6 x 6.
    uint32_t addTensor(std::span<const Form> net);
    /// A polar patch: the last four of its 16 coefficients are one point.
    uint32_t addPolar(std::span<const Form> net);
    /// P_m: b004, then six coefficients a sector (cpu/pm_construction.h).
    uint32_t addSectors(PatchClass patchClass, std::span<const Form> coefficients);
    /// No patch is added any more: what only finds equal coefficients is freed.
    void finish() { known_ = {}; }

    [[nodiscard]] uint32_t patchCount() const { return static_cast<uint32_t>(patches_.size()); }
    [[nodiscard]] PatchPose newPose() const { return {glm::vec3(0.0f), std::vector<glm::vec3>(rows_.size())}; }
    /// The coefficients of a deformed cage.
    [[nodiscard]] Status build(std::span<const glm::vec3> cage, const RunJobs& runJobs, PatchPose& pose) const;

    /// Where the parameters of places lie: tensors (u, v); polar patches the weights of the two outer corners' side, as
    /// (u, v) too; triangles the weights of corners 1 and 2; quads of sectors (u, v); pentagons, by sector, the weights
    /// of the sector's second corner and of the middle. The result is by the places' own a and b.
    void evaluate(std::span<const Place> places, const PatchPose& pose, std::span<SurfaceJet> out) const;

    /// Fills in the weights of a place, as evaluate() has it.
    void weigh(const Place& place, PointWeights& out) const;

    /// Polar patches have a row without du: their normals ask for care.
    [[nodiscard]] bool hasFastGrid(uint32_t patch) const { return patches_[patch].patchClass != PatchClass::polar; }
    /// The samples of patches that have one, in the order of their domains, patch after patch. Normals are
    /// by du and dv alone.
    /// False: some normals are zero.
    bool grid(std::span<const uint32_t> patches, uint32_t rate, const PatchPose& pose, const GridOutput& out) const;

private:
    enum class Kind : uint8_t { cubic, quintic, sectors };
    struct Patch {
        Kind kind = Kind::cubic;
        uint32_t sides = 4;
        uint32_t first = 0; ///< into coefficients_
        uint32_t count = 0;
        PatchClass patchClass = PatchClass::regular;
    };
    /// The vertices that a coefficient is made of, whose weights sum to 1.
    struct Row {
        uint32_t first = 0, count = 0; ///< into vertices_ and weights_
    };

    uint32_t add(Kind kind, PatchClass patchClass, uint32_t sides, std::span<const Form> coefficients);
    uint32_t rowOf(const Form& form);
    /// Adds a coefficient with its weights.
    void weighRow(uint32_t row, const VertexWeight& weight, PointWeights& out) const;
    [[nodiscard]] const glm::vec3& coefficient(const Patch& patch, uint32_t k, const PatchPose& pose) const {
        return pose.points[coefficients_[patch.first + k]];
    }
    struct SectorSamples;
    [[nodiscard]] std::array<glm::vec3, 15> quarticNet(const Patch& patch, uint32_t sector,
                                                       const PatchPose& pose) const;
    bool sectorGrid(const Patch& patch, const SectorSamples& samples, const PatchPose& pose,
                    const GridOutput& out) const;
    template <uint32_t N>
    struct GridWeights;
    template <uint32_t N>
    bool gridOf(std::span<const uint32_t> patches, const GridWeights<N>& weights, const PatchPose& pose,
                const GridOutput& out) const;

    std::vector<Patch> patches_;
    std::vector<uint32_t> coefficients_; ///< numbers of rows
    std::vector<Row> rows_;
    std::vector<uint32_t> vertices_;
    std::vector<float> weights_;
    std::unordered_multimap<uint64_t, uint32_t> known_; ///< rows by a hash of what they are made of
};

} // namespace supple::cpu
