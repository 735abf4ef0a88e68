// Supple in this sample: sixty characters, each an asset and a group of its own, in one view under one budget.
#pragma once

#include "cast.h"
#include "host/graph.h"

#include <memory>
#include <string>
#include <supple/supple.hpp>
#include <vector>

namespace market {

using namespace supple::host;

struct Camera {
    glm::vec3 eye{};
    glm::mat4 viewProjection{1.0f};
    glm::mat4 castersViewProjection{1.0f}; ///< wider: what casts a shadow into the picture is in it
    float pixelsPerUnit = 1.0f;
    glm::vec3 right{}, up{}, ahead{}; ///< the first two reach to the picture's edges
};

struct PassMilliseconds {
    std::string name;
    double milliseconds = 0.0;
};

/// A file of samples/assets, which the assets of several figures are made from.
struct Source {
    std::string name;
    std::vector<char> bytes;
    SuppleScheme scheme = SUPPLE_SCHEME_PM;
};

class Market {
public:
    /// `budget`: the most surface vertices a frame that setBudget() may be given.
    /// `record`: a file for a recording, or empty.
    Market(Device& device, uint32_t figures, uint32_t mostVertices, const std::string& record);

    void beginFrame(uint64_t frame, uint64_t completed) const;
    void update(double time, const Camera& camera, uint32_t budget) const;
    /// buffers: what Supple writes for drawing.
    void addToGraph(Graph& graph, Resource buffers) const;

    [[nodiscard]] const std::vector<Figure>& cast() const { return cast_; }
    /// The asset of a figure.
    [[nodiscard]] const supple::Asset& asset(size_t figure) const { return members_[figure].asset; }
    /// One a figure.
    [[nodiscard]] std::vector<SuppleLevelOutput> surfaces() const;
    /// The view's, of all figures.
    [[nodiscard]] SuppleVertexStreams streams() const;

    /// What the newest completed frame drew; all zero if there is none.
    [[nodiscard]] SuppleViewStatistics statistics() const;
    /// Supple's passes in that frame, in its order.
    [[nodiscard]] std::vector<PassMilliseconds> passTimes() const;
    [[nodiscard]] SuppleMemoryUse memory() const;

private:
    struct Member {
        supple::Asset asset;
        supple::Group group;
        supple::Instance instance;
    };

    /// False: the view has no room for another character.
    [[nodiscard]] bool addMember(const Figure& figure, const Source& source);

    supple::Context context_;
    supple::View view_;
    std::vector<Figure> cast_;
    std::vector<Member> members_; ///< one of cast_
};

} // namespace market
