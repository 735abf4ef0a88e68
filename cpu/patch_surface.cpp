#include "cpu/patch_surface.h"

#include "cpu/grid_places.h"

#include <array>

namespace supple::cpu {
namespace {

class PosedPatches final : public Pose {
public:
    explicit PosedPatches(const PatchSet& set) : set_(set), pose_(set.newPose()) {}

    Status build(std::span<const glm::vec3> cage, const RunJobs& runJobs) override {
        return set_.build(cage, runJobs, pose_);
    }
    void evaluate(std::span<const Place> places, std::span<SurfaceJet> out) const override {
        set_.evaluate(places, pose_, out);
    }
    [[nodiscard]] const PatchPose& pose() const { return pose_; }

private:
    const PatchSet& set_;
    PatchPose pose_;
};

} // namespace

std::vector<Form> vertexForms(uint32_t count) {
    std::vector<Form> forms;
    for (uint32_t v = 0; v < count; ++v) {
        forms.push_back(Form::ofVertex(v));
    }
    return forms;
}

std::vector<Form> formsOf(const surface::Stencils& stencils) {
    std::vector<Form> forms(stencils.rows());
    for (uint32_t row = 0; row < stencils.rows(); ++row) {
        for (uint32_t i = stencils.starts[row]; i < stencils.starts[row + 1]; ++i) {
            forms[row].addTimes(Form::ofVertex(stencils.vertices[i]), stencils.weights[i]);
        }
    }
    return forms;
}

std::unique_ptr<Pose> PatchSurface::newPose() const {
    return std::make_unique<PosedPatches>(set_);
}

Place PatchSurface::placeOfSample(uint32_t patch, uint32_t rate, uint32_t sample, double inside) const {
    Place place = gridPlace(domainOf(patch), rate, sample, inside);
    place.piece = patch;
    return place;
}

Surface::FastGrid PatchSurface::fastGrid(const Pose& pose, uint32_t begin, uint32_t end, uint32_t rate,
                                         const GridOutput& out) const {
    std::array<uint32_t, 64> patches;
    uint32_t count = 0;
    while (count < patches.size() && begin + count < end && set_.hasFastGrid(begin + count)) {
        patches[count] = begin + count;
        ++count;
    }
    const PatchPose& posed = static_cast<const PosedPatches&>(pose).pose();
    return {count, !set_.grid(std::span(patches).first(count), rate, posed, out)};
}

} // namespace supple::cpu
