// p-rep on the CPU.
#include "cpu/grid_places.h"
#include "cpu/patch_surface.h"
#include "cpu/prep_construction.h"
#include "cpu/surface.h"

#include <array>

namespace supple::cpu {
namespace {

using surface::prep::PointPatch;

/// A cubic's coefficients as those of degree 5: row i has the weights of the cubic's.
constexpr std::array<std::array<double, 4>, 6> kRaised{{{1.0, 0.0, 0.0, 0.0},
                                                        {0.4, 0.6, 0.0, 0.0},
                                                        {0.1, 0.6, 0.3, 0.0},
                                                        {0.0, 0.3, 0.6, 0.1},
                                                        {0.0, 0.0, 0.6, 0.4},
                                                        {0.0, 0.0, 0.0, 1.0}}};

/// The bicubic patch and its perturbation, as one of degree 5.
std::array<Form, 36> quinticNet(const PointPatch<Form>& patch) {
    std::array<Form, 36> net;
    for (size_t j = 0; j < 6; ++j) {
        for (size_t i = 0; i < 6; ++i) {
            for (size_t k = 0; k < 16; ++k) {
                if (const double weight = kRaised[i][k % 4] * kRaised[j][k / 4]; weight != 0.0) {
                    net[i + 6 * j].addTimes(patch.g[k], weight);
                }
            }
        }
    }
    // h20, h30, h21, h31 of each edge, in steps along it and inwards from it.
    for (size_t e = 0; e < 4; ++e) {
        for (size_t s = 0; s < 4; ++s) {
            const size_t a = s % 2 == 0 ? 2 : 3, b = s / 2;
            const std::array<size_t, 4> places{a + 6 * b, (5 - b) + 6 * a, (5 - a) + 6 * (5 - b), b + 6 * (5 - a)};
            net[places[e]] += patch.h[4 * e + s];
        }
    }
    return net;
}

class PrepSurface final : public PatchSurface {
public:
    PrepSurface(const cage::Cage& cage, Patches patches) : PatchSurface(patches), patchOfFace_(cage.faceCount(), 0) {}

    static Built create(const surface::Recipe& recipe, const cage::Cage& cage, Patches patches) {
        const Result<cage::Topology> topology = cage::buildTopology(cage);
        if (!topology) {
            return topology.error();
        }
        auto made = std::make_unique<PrepSurface>(cage, patches);
        const std::vector<Form> vertices = vertexForms(cage.vertexCount());
        const auto coefficients = surface::prep::constructPoints<Form>(cage, *topology, vertices, recipe.prep);
        for (const surface::PatchInfo& info : patches) {
            const PointPatch<Form> patch =
                surface::prep::gatherPoints<Form>(cage, *topology, coefficients, info.face, recipe.prep);
            made->patchOfFace_[info.face] =
                1 + (patch.perturbed ? made->set_.addTensor(quinticNet(patch)) : made->set_.addTensor(patch.g));
        }
        made->set_.finish();
        return std::unique_ptr<const Surface>(std::move(made));
    }

    [[nodiscard]] FoundPlace findPlace(const FacePoint& point) const override {
        FoundPlace found;
        if (patchOfFace_[point.face] == 0) {
            found.fault = kHole;
            return found;
        }
        found.place.piece = patchOfFace_[point.face] - 1;
        found.place.x = point.a;
        found.place.y = point.b;
        return found;
    }

private:
    std::vector<uint32_t> patchOfFace_; ///< by face: 1 more than its patch, 0 for holes
};

} // namespace

Built prepSurface(const surface::Recipe& recipe, const cage::Cage& cage, Patches patches) {
    return PrepSurface::create(recipe, cage, patches);
}

} // namespace supple::cpu
