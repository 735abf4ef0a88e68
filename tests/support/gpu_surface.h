// A group evaluated on the device and read back: what the GPU wrote, for comparison with the CPU.
#pragma once

#include "cage/character.h"
#include "host/context.h"
#include "host/group_output.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace supple::test {

/// One device for a whole test program, with validation when SUPPLE_VALIDATION is set (tools/test.sh sets it). Null,
/// with a failure recorded, when there is no device.
[[nodiscard]] host::Device* testDevice();

/// Fails the test when the validation layer has spoken since the guard was made.
class ValidationGuard {
public:
    ValidationGuard();
    ~ValidationGuard();
    ValidationGuard(const ValidationGuard&) = delete;
    ValidationGuard& operator=(const ValidationGuard&) = delete;

private:
    uint32_t before_ = 0;
};

struct GpuOptions {
    SuppleMapping mapping = SUPPLE_MAPPING_NARROW;
    uint32_t contextFlags = 0;
    uint32_t instanceCount = 1;
    uint32_t rate = 8;
    SuppleVertexFormat format = SUPPLE_VERTEX_24;
    SuppleScheme scheme = SUPPLE_SCHEME_PREP;
    SuppleTangentMode tangents = SUPPLE_TANGENTS_DEFAULT;
    SuppleCornerRule corners = SUPPLE_CORNERS_SHARP;
    SuppleCreaseMode creases = SUPPLE_CREASES_CUT;
    SuppleFragmentRules rules = SUPPLE_RULES_CATMULL_CLARK;
    uint32_t flags = SUPPLE_GROUP_PATCHES | SUPPLE_GROUP_ATTRIBUTES;
    SuppleUvInterpolation uvInterpolation = SUPPLE_UV_FROM_FILE;
};

/// The normal of a vertex of 16 bytes.
[[nodiscard]] glm::vec3 decodeOctahedral(uint32_t packed);

/// An asset and a group on a context that all tests of a mapping and context flags share: pipelines are created once.
class GpuSurface {
public:
    /// The cage goes in as arrays. Failures are recorded in the test; check valid().
    GpuSurface(host::Device& device, const cage::Cage& cage, const GpuOptions& options);
    /// The file goes in as bytes.
    GpuSurface(host::Device& device, const std::string& path, const GpuOptions& options);
    ~GpuSurface();
    GpuSurface(const GpuSurface&) = delete;
    GpuSurface& operator=(const GpuSurface&) = delete;

    [[nodiscard]] bool valid() const { return valid_; }
    [[nodiscard]] host::Context& context() const { return *context_; }
    [[nodiscard]] SuppleAsset asset() const { return asset_; }
    [[nodiscard]] SuppleGroup group() const { return group_; }
    [[nodiscard]] SuppleInstance instance(uint32_t index) const { return instances_[index]; }
    [[nodiscard]] const host::GroupOutput& output() const { return output_; }
    [[nodiscard]] const std::vector<SupplePatchInfo>& patches() const { return patches_; }

    /// Runs a frame and reads everything back.
    void evaluate();

    struct Vertex {
        glm::vec3 position, normal;
    };
    [[nodiscard]] const Vertex& vertex(uint32_t instance, uint32_t patch, uint32_t sample) const {
        return vertices_[size_t{instance} * output_.grid.verticesPerInstance + vertexIndex(patch, sample)];
    }
    /// With SUPPLE_GROUP_INDEXED_MESH: of the mesh; what has patches below is then not to be asked.
    [[nodiscard]] const Vertex& sharedVertex(uint32_t instance, uint32_t vertex) const {
        return vertices_[size_t{instance} * output_.grid.verticesPerInstance + vertex];
    }
    /// Of a patch's sample among the surface vertices of an instance.
    [[nodiscard]] uint32_t vertexIndex(uint32_t patch, uint32_t sample) const {
        const SuppleDrawRange& range = rangeOf(patch);
        return range.firstVertex + (patch - range.firstPatch) * range.samplesPerPatch + sample;
    }
    [[nodiscard]] const SuppleDrawRange& rangeOf(uint32_t patch) const {
        return output_.grid.drawRanges[ranges_[patch]];
    }
    [[nodiscard]] uint32_t sampleCount(uint32_t patch) const { return rangeOf(patch).samplesPerPatch; }
    /// Quad patches.
    [[nodiscard]] const Vertex& vertex(uint32_t instance, uint32_t patch, uint32_t i, uint32_t j) const {
        return vertex(instance, patch, j * (output_.grid.rate + 1) + i);
    }
    [[nodiscard]] glm::vec3 deformed(uint32_t instance, uint32_t cageVertex) const {
        return deformed_[size_t{instance} * output_.info.cageVerticesPerInstance + cageVertex];
    }
    [[nodiscard]] std::vector<glm::vec3> deformedCage(uint32_t instance) const {
        const auto first = deformed_.begin() + instance * ptrdiff_t{output_.info.cageVerticesPerInstance};
        return {first, first + output_.info.cageVerticesPerInstance};
    }
    /// In the order of SupplePatchClass.
    [[nodiscard]] glm::vec3 coefficient(uint32_t instance, uint32_t patch, uint32_t k) const {
        return coefficients_[(size_t{instance} * output_.surface.patchCount + patch) * SUPPLE_PATCH_STRIDE + k];
    }
    [[nodiscard]] const std::vector<std::byte>& rawVertices() const { return rawVertices_; }

private:
    void create(host::Device& device, const SuppleAssetDesc& asset, const GpuOptions& options);

    host::Device* device_ = nullptr;
    host::Context* context_ = nullptr;
    SuppleAsset asset_{};
    SuppleGroup group_{};
    std::vector<SuppleInstance> instances_;
    host::GroupOutput output_{};
    std::vector<SupplePatchInfo> patches_;
    std::vector<uint32_t> ranges_; ///< per patch: its draw range
    std::vector<std::byte> rawVertices_;
    std::vector<Vertex> vertices_;
    std::vector<glm::vec3> deformed_;
    std::vector<glm::vec3> coefficients_;
    bool valid_ = false;
};

} // namespace supple::test
