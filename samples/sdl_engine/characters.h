// Supple in this engine: a context, two groups of the same character, and who plays what. One walks round the stage on
// a P_m surface. On a Catmull-Clark surface one leaps, and is somewhere else after every leap; now and then a small one
// joins.
#pragma once

#include "host/graph.h"

#include <supple/supple.hpp>

#include <array>
#include <glm/glm.hpp>
#include <optional>

namespace engine {

using namespace supple::host;

/// What is drawn of a material: its factors. Colors of vertices multiply the base color.
struct Look {
    glm::vec4 baseColor{1.0f};
    float metallic = 0.0f;
    float roughness = 0.5f;
    bool doubleSided = true;
};

/// One of the two groups as the passes draw it.
struct CharacterGroup {
    supple::Group group;
    SuppleGroupInfo info{};
    SuppleVertexStreams streams{};
    SuppleGridOutput grid{};
    uint32_t patchesPerEdge = 1;
    std::vector<Look> looks; ///< a draw range
};

/// Where somebody stands, and how much of the sky he takes from the floor.
struct Footprint {
    glm::vec3 position{};
    float radius = 0.0f;
};

class Characters {
public:
    /// `record`: a file for a recording, or empty.
    Characters(Device& device, const std::string& path, uint32_t rate, const std::string& record);

    /// Poses everybody for a time of the show. May create and destroy instances, so it comes after beginFrame.
    void update(double time);
    void beginFrame(uint64_t frame, uint64_t completed) const;
    /// The graph's node: every barrier before and after it is the graph's.
    void addToGraph(Graph& graph, Resource buffers) const;

    const supple::Context& context() const { return context_; }
    const std::array<CharacterGroup, 2>& groups() const { return groups_; }
    const std::vector<Footprint>& footprints() const { return footprints_; }
    /// Milliseconds of the device in Supple's passes, of the newest frame that is known.
    double milliseconds() const;

private:
    void place(const supple::Instance& instance, glm::vec3 position, float heading, float size);
    uint32_t findClip(const char* name) const;

    supple::Context context_;
    supple::Asset asset_;
    std::array<CharacterGroup, 2> groups_;
    supple::Instance walker_;
    supple::Instance leaper_;
    std::optional<supple::Instance> guest_;
    int64_t leap_ = -1; ///< the leap that is being shown
    uint32_t walk_ = 0;
    uint32_t joy_ = 0;
    uint32_t idle_ = 0;
    double joyDuration_ = 1.0;
    std::vector<Footprint> footprints_;
    mutable std::vector<SuppleTiming> timings_;
};

} // namespace engine
