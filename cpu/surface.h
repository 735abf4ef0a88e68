// A surface on the CPU: a scheme over a cage. What poses do not change is made once and shared by any threads; a pose
// has the coefficients of one deformed cage.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cpu/jobs.h"
#include "cpu/patch_set.h"
#include "cpu/place.h"
#include "cpu/point_weights.h"
#include "surface/recipe.h"
#include "surface/scheme.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace supple::cpu {

/// The coefficients of one deformed cage. One thread builds; then any threads evaluate.
class Pose {
public:
    virtual ~Pose() = default;

    /// `cage`: the deformed vertices, in the cage's order.
    [[nodiscard]] virtual Status build(std::span<const glm::vec3> cage, const RunJobs& runJobs) = 0;
    /// Derivatives by a and b of the places.
    virtual void evaluate(std::span<const Place> places, std::span<SurfaceJet> out) const = 0;
    /// The limit's normal at a place whose du and dv span no plane, of unit length. Zero where it is not known.
    [[nodiscard]] virtual glm::dvec3 limitNormal(const Place& /*place*/) const { return glm::dvec3(0.0); }
};

class Surface {
public:
    virtual ~Surface() = default;
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    /// `patches`: those of the scheme's tables, in their order; faces and corners are the cage's. Refuses what the
    /// scheme refuses of the cage, and schemes that have no evaluator here.
    [[nodiscard]] static Result<std::unique_ptr<const Surface>>
    create(const surface::Recipe& recipe, const cage::Cage& cage, std::span<const surface::PatchInfo> patches);

    /// The pose must not outlive the surface.
    [[nodiscard]] virtual std::unique_ptr<Pose> newPose() const = 0;

    /// Where a point of a face lies. The face exists, and the point is in it.
    [[nodiscard]] virtual FoundPlace findPlace(const FacePoint& point) const = 0;
    /// Where a sample of a patch lies, moved by a share of the way to the middle of the patch or of its sector.
    /// Derivatives are those in the patch's own domain.
    [[nodiscard]] virtual Place placeOfSample(uint32_t patch, uint32_t rate, uint32_t sample, double inside) const = 0;
    /// Fills in the weights of a place, with derivatives by its a and b: what Pose::evaluate() gives of any cage.
    virtual void weigh(const Place& place, PointWeights& out) const = 0;

    /// The samples of the patches begin..end, in the order of the device. Normals are of unit length, or zero where
    /// there is none.
    void grid(const Pose& pose, uint32_t begin, uint32_t end, uint32_t rate, const GridOutput& out) const;

    [[nodiscard]] std::span<const surface::PatchInfo> patches() const { return patches_; }
    [[nodiscard]] surface::Domain domainOf(uint32_t patch) const {
        return surface::domainOf(patches_[patch].patchClass);
    }
    [[nodiscard]] uint32_t samplesOf(uint32_t patch, uint32_t rate) const {
        return surface::sampleCount(domainOf(patch), rate);
    }

protected:
    explicit Surface(std::span<const surface::PatchInfo> patches) : patches_(patches.begin(), patches.end()) {}
    /// How many patches are written, and whether some normals of theirs are zero.
    struct FastGrid {
        uint32_t patches = 0;
        bool lacksNormals = false;
    };
    /// Writes the first of the patches that it has a faster way for than place by place, and returns how many.
    [[nodiscard]] virtual FastGrid fastGrid(const Pose& /*pose*/, uint32_t /*begin*/, uint32_t /*end*/,
                                            uint32_t /*rate*/, const GridOutput& /*out*/) const {
        return {};
    }

    /// Whether a patch has samples where du and dv are parallel or zero, though rounding may leave them a normal.
    [[nodiscard]] virtual bool hasFlatPlaces(uint32_t /*patch*/) const { return false; }
    /// Whether a sample of such a patch is one.
    [[nodiscard]] virtual bool isFlat(const Place& /*place*/) const { return false; }
    /// Whose normal a sample takes that has none.
    [[nodiscard]] virtual Place placeInside(uint32_t patch, uint32_t rate, uint32_t sample) const;

private:
    void slowGrid(const Pose& pose, uint32_t patch, uint32_t rate, const GridOutput& out) const;
    /// Gives a sample without a normal that of the limit, or of a place inside.
    void mendNormals(const Pose& pose, uint32_t patch, uint32_t rate, std::span<glm::vec3> normals) const;

    std::vector<surface::PatchInfo> patches_;
};

inline constexpr const char* kHole = "the face is a hole";

// What builds the surface of each scheme.
using Built = Result<std::unique_ptr<const Surface>>;
using Patches = std::span<const surface::PatchInfo>;
[[nodiscard]] Built prepSurface(const surface::Recipe& recipe, const cage::Cage& cage, Patches patches);
[[nodiscard]] Built pmSurface(const cage::Cage& cage, Patches patches);
[[nodiscard]] Built catmullClarkSurface(const surface::Recipe& recipe, const cage::Cage& cage, Patches patches);
[[nodiscard]] Built loopSurface(const surface::Recipe& recipe, const cage::Cage& cage, Patches patches);
[[nodiscard]] Built blendSurface(const surface::Recipe& recipe, const cage::Cage& cage, Patches patches);
[[nodiscard]] Built polygonsSurface(const cage::Cage& cage, Patches patches);
/// The cage itself, which has no patches: triangles, bilinear quads, and faces of more sides as triangles round their
/// middle.
[[nodiscard]] std::unique_ptr<const Surface> cageSurface(const cage::Cage& cage);

} // namespace supple::cpu
