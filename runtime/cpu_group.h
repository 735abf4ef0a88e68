// The surfaces of a group on the CPU: the pieces of a prepared character, a surface for each scheme.
#pragma once

#include "base/result.h"
#include "cpu/surface.h"
#include "runtime/prepared.h"
#include "supple/supple_cpu.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace supple::runtime {

/// Nothing in it changes: any threads share it.
class CpuGroup {
public:
    /// One scheme's.
    struct Part {
        SuppleScheme scheme = SUPPLE_SCHEME_AUTO;
        std::shared_ptr<const PreparedPiece> piece; ///< null: the whole cage
        std::vector<surface::PatchInfo> patches;    ///< of the whole cage's faces and vertices
        std::unique_ptr<const cpu::Surface> surface;
    };

    /// `desc`: checked. SUPPLE_SCHEME_CAGE: the surface is the cage itself, which has no patches.
    [[nodiscard]] static Result<std::shared_ptr<const CpuGroup>> create(std::shared_ptr<const Prepared> prepared,
                                                                        const SuppleGroupDesc& desc);

    [[nodiscard]] const cage::Cage& cage() const { return prepared_->character.cage; }
    [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
    /// Of a part, at a rate.
    [[nodiscard]] static uint64_t vertexCount(const Part& part, uint32_t rate);
    [[nodiscard]] static uint64_t indexCount(const Part& part, uint32_t rate);
    static void writeIndices(const Part& part, uint32_t rate, uint32_t* out);

    /// Where a point lies: a part, and the place in its surface. The fault of the place says what is wrong with the
    /// point.
    struct Found {
        uint32_t part = 0;
        cpu::FoundPlace place;
    };
    [[nodiscard]] Found find(const SuppleSurfacePoint& point) const;

private:
    void addCage();
    Status addPart(const SuppleGroupDesc& desc, SuppleScheme scheme, bool chosen, const std::vector<uint32_t>& parts);

    std::shared_ptr<const Prepared> prepared_;
    std::vector<Part> parts_;
    std::vector<uint32_t> partOfFace_, faceInPart_; ///< by face of the cage
};

/// The coefficients of one deformed cage.
class CpuPose {
public:
    explicit CpuPose(std::shared_ptr<const CpuGroup> group);

    [[nodiscard]] const CpuGroup& group() const { return *group_; }
    [[nodiscard]] bool isBuilt() const { return built_; }
    /// `stride`: bytes from vertex to vertex. Refuses coordinates that are not finite or too large.
    [[nodiscard]] Status build(const std::byte* cage, size_t stride, const RunJobs& runJobs);
    /// Refuses points that do not exist; then what is in `out` is undefined.
    [[nodiscard]] Status evaluate(std::span<const SuppleSurfacePoint> points, SuppleSurfaceJet* out,
                                  const RunJobs& runJobs) const;
    /// normals: null for none.
    [[nodiscard]] Status evaluateGrid(uint32_t part, uint32_t rate, float* positions, float* normals,
                                      const RunJobs& runJobs) const;

private:
    Status takeCage(const std::byte* cage, size_t stride);
    /// The first point that does not exist, or the number of points.
    [[nodiscard]] uint32_t evaluateRange(std::span<const SuppleSurfacePoint> points, SuppleSurfaceJet* out) const;

    std::shared_ptr<const CpuGroup> group_;
    std::vector<glm::vec3> cage_;
    std::vector<std::vector<glm::vec3>> pieces_; ///< by part; empty: the whole cage
    std::vector<std::unique_ptr<cpu::Pose>> poses_;
    bool built_ = false;
};

} // namespace supple::runtime
