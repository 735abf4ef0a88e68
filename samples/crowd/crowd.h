// Supple in this sample: three kinds of characters, a view that they share, and the circles that everybody walks.
#pragma once

#include "host/graph.h"

#include <supple/supple.hpp>

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace crowd {

using namespace supple::host;

inline constexpr size_t kKinds = 3;

/// A group as it is drawn.
struct Kind {
    supple::Asset asset;
    supple::Group group;
    SuppleGroupInfo info{};
    SuppleVertexStreams streams{};
    SuppleLevelOutput levels{};  ///< of a view
    SuppleGridOutput grid{};     ///< at one rate
    SuppleDirectOutput direct{}; ///< and evaluated while it is drawn
    uint32_t firstArc = 0;       ///< clip of the first of its arcs
    double duration = 1.0;
    bool walks = true; ///< else its file has no clip to walk by
};

struct Camera {
    glm::vec3 eye{};
    glm::mat4 viewProjection{1.0f};
    glm::mat4 castersViewProjection{1.0f}; ///< wider: what casts a shadow into the picture is in it
    float pixelsPerUnit = 1.0f;
};

struct CrowdOptions {
    std::array<std::string, kKinds> files; ///< GLB
    uint32_t count = 1000;
    uint32_t fixedRate = 0;      ///< of all characters; 0: levels of detail
    bool direct = false;         ///< at a fixed rate: evaluate while drawing
    uint32_t budget = 5'500'000; ///< surface vertices a frame
    uint32_t coefficients = 0;   ///< MiB that those share who are drawn; 0: there is memory for all
    bool wall = false;           ///< nobody walks where it stands
    bool occlusion = false;
    bool backFaces = false; ///< leave out what faces away
    std::string record;     ///< a file for a recording; empty: none
};

/// Across the middle of the square, 0 at z, turned about +Y.
inline constexpr float kWallAngle = 0.35f, kWallHeight = 4.0f;

class Crowd {
public:
    Crowd(Device& device, const CrowdOptions& options);

    void beginFrame(uint64_t frame, uint64_t completed) const;
    /// All there is to say a frame: where everybody is at a time of the walk, the device finds.
    void update(double time, const Camera& camera) const;
    /// From now on what lies behind it is left out; null: nothing is.
    void setPyramid(const SuppleDepthPyramidDesc* pyramid) const;
    /// The graph's node. `pyramid`: read where there is one.
    void addToGraph(Graph& graph, Resource buffers, const Resource* pyramid) const;

    [[nodiscard]] const std::array<Kind, kKinds>& kinds() const { return kinds_; }
    [[nodiscard]] bool hasLevels() const { return fixedRate_ == 0; }
    [[nodiscard]] bool isDirect() const { return isDirect_; }
    [[nodiscard]] size_t size() const { return instances_.size(); }
    /// Half the width of the square that they walk in.
    [[nodiscard]] float reach() const { return reach_; }
    /// What the newest finished frame cost and drew, a line each.
    [[nodiscard]] std::vector<std::string> report() const;

private:
    void createView(const CrowdOptions& options);
    void createKind(size_t number, const CrowdOptions& options);
    void createInstances(const CrowdOptions& options);
    void reportView(std::vector<std::string>& lines) const;
    void reportMemory(std::vector<std::string>& lines) const;
    void reportPasses(std::vector<std::string>& lines) const;

    supple::Context context_;
    supple::View view_;
    std::array<Kind, kKinds> kinds_;
    std::vector<supple::Instance> instances_;
    float reach_ = 1.0f;
    uint32_t budget_ = 0, fixedRate_ = 0;
    bool backFaces_ = false, isDirect_ = false;
    mutable std::vector<SuppleTiming> timings_;
};

} // namespace crowd
