// Supple in this sample: three kinds of characters, a view that they share, and where everybody walks.
#pragma once

#include "common/graph.h"

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace crowd {

inline constexpr size_t kKinds = 3;

/// A group as it is drawn.
struct Kind {
    supple::Asset asset;
    supple::Group group;
    SuppleGroupOutput output{};
    uint32_t clip = 0;
    double duration = 1.0;
    float stride = 1.0f; ///< metres a loop of the clip
    float size = 1.0f;
};

struct Walker {
    supple::Instance instance;
    uint32_t kind = 0;
    glm::vec2 centre{}; ///< of the circle it walks
    float radius = 1.0f;
    float angle = 0.0f; ///< at time 0
    float turn = 1.0f;  ///< 1 or -1
};

struct Camera {
    glm::vec3 eye{};
    glm::mat4 viewProjection{1.0f};
    glm::mat4 castersViewProjection{1.0f}; ///< wider: what casts a shadow into the picture is in it
    float pixelsPerUnit = 1.0f;
};

struct CrowdOptions {
    std::array<std::string, kKinds> files; ///< .glb
    uint32_t count = 1000;
    uint32_t budget = 5'500'000; ///< surface vertices a frame
    bool wall = false;           ///< nobody walks where it stands
    bool occlusion = false;
    bool backFaces = false; ///< leave out what faces away
};

/// Across the middle of the square, 0 at z, turned about +Y.
inline constexpr float kWallAngle = 0.35f, kWallHeight = 4.0f;

class Crowd {
public:
    Crowd(const sample::Device& device, const CrowdOptions& options);

    void beginFrame(uint64_t frame, uint64_t completed) const;
    /// Puts everybody where they are at a time of the walk.
    void update(double time, const Camera& camera);
    /// From now on what lies behind it is left out; null: nothing is.
    void setPyramid(const SuppleDepthPyramidDesc* pyramid) const;
    /// The graph's node. `pyramid`: read where there is one.
    void addToGraph(engine::Graph& graph, engine::Resource buffers, const engine::Resource* pyramid) const;

    [[nodiscard]] const std::array<Kind, kKinds>& kinds() const { return kinds_; }
    [[nodiscard]] size_t size() const { return walkers_.size(); }
    /// Half the width of the square that they walk in.
    [[nodiscard]] float reach() const { return reach_; }
    /// What the newest finished frame cost and drew, a line each.
    [[nodiscard]] std::vector<std::string> report() const;

private:
    supple::Context context_;
    supple::View view_;
    std::array<Kind, kKinds> kinds_;
    std::vector<Walker> walkers_;
    float reach_ = 1.0f;
    uint32_t budget_ = 0;
    bool backFaces_ = false;
    mutable std::vector<SuppleTiming> timings_;
};

} // namespace crowd
