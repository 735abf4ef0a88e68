#include "surface/blend/smooth_uvs.h"

#include <algorithm>
#include <map>
#include <utility>

namespace supple::surface::blend {
namespace {

class UvChartBuilder {
public:
    UvChartBuilder(const Mesh& mesh, const ChannelLevel& channel) : mesh_(mesh), channel_(channel) {}

    UvCharts run() {
        charts_.corners.resize(mesh_.cage.cornerCount());
        for (uint32_t v = 0; v < channel_.values.size(); ++v) {
            addVertex(v);
        }
        return std::move(charts_);
    }

private:
    /// Cuts a fan of the channel where the surface's charts change.
    void addVertex(uint32_t vertex) {
        const cage::Topology& topology = channel_.mesh.topology;
        const auto first = topology.sectorCorners.begin() + topology.spokeStarts[vertex];
        std::vector<uint32_t> fan(first, first + topology.sectorCount(vertex));
        const bool closed = topology.boundary[vertex] == 0;
        vertex_ = channel_.values[vertex];
        const auto chartOf = [&](uint32_t corner) { return mesh_.corners[corner].chart; };
        if (closed) { // begin with a chart, and a chart with its first sector
            const auto begins = [&](uint32_t corner) { return mesh_.corners[corner].sector == 0; };
            std::rotate(fan.begin(), std::find_if(fan.begin(), fan.end(), begins), fan.end());
        }
        for (auto begin = fan.begin(); begin != fan.end();) {
            auto end = begin + 1;
            while (end != fan.end() && chartOf(*end) == chartOf(*begin)) {
                ++end;
            }
            addChart({begin, end}, closed);
            begin = end;
        }
    }

    void addChart(const std::vector<uint32_t>& sectors, bool closed) {
        const ChartClass& surface = mesh_.classOf(mesh_.corners[sectors[0]].chart);
        const auto count = static_cast<uint32_t>(sectors.size());
        const bool own = surface.kind == ChartKind::point ||
                         (surface.sectors == count && (closed || surface.kind != ChartKind::interior));
        const ChartClass chartClass = own ? surface : ChartClass{ChartKind::boundary, count};
        const auto chart = static_cast<uint32_t>(charts_.classes.size());
        for (uint32_t h = 0; h < count; ++h) {
            charts_.corners[sectors[h]] = {chart, chartClass.kind == ChartKind::point ? 0 : h};
        }
        charts_.classes.push_back(chartClass);
        charts_.coefficients.push_back(fitted(chartClass, ringOf(chartClass, sectors)));
    }

    [[nodiscard]] glm::dvec2 valueAfter(uint32_t corner, uint32_t steps) const {
        return channel_.values[channel_.mesh.cage.faceVertices[(corner & ~3u) | ((corner + steps) & 3u)]];
    }

    /// Relative to the vertex, as Chart says.
    [[nodiscard]] std::vector<glm::dvec2> ringOf(const ChartClass& chartClass,
                                                 const std::vector<uint32_t>& sectors) const {
        std::vector<glm::dvec2> ring;
        const bool curve = chartClass.kind == ChartKind::curve;
        for (size_t h = 0; h < sectors.size() && chartClass.kind != ChartKind::point; ++h) {
            if (!curve || h == 0) {
                ring.push_back(valueAfter(sectors[h], 1) - vertex_);
            }
            if (!curve) {
                ring.push_back(valueAfter(sectors[h], 2) - vertex_);
            }
            if (chartClass.kind != ChartKind::interior && h + 1 == sectors.size()) {
                ring.push_back(valueAfter(sectors[h], 3) - vertex_);
            }
        }
        return ring;
    }

    std::array<glm::dvec2, kCoefficients> fitted(const ChartClass& chartClass, const std::vector<glm::dvec2>& ring) {
        const auto [known, isNew] = fits_.try_emplace(chartClass);
        if (isNew) {
            known->second = makeFitMatrix(chartClass);
        }
        std::array<glm::dvec2, kCoefficients> c{};
        for (uint32_t row = 0; row < kCoefficients; ++row) {
            for (uint32_t i = 0; i < ring.size(); ++i) {
                c[row] += known->second.weight(row, i) * ring[i];
            }
        }
        c[0] += vertex_;
        return c;
    }

    const Mesh& mesh_;
    const ChannelLevel& channel_;
    UvCharts charts_;
    std::map<ChartClass, FitMatrix> fits_;
    glm::dvec2 vertex_{0.0}; ///< at work
};

} // namespace

Result<UvCharts> makeUvCharts(const Mesh& mesh, const RefinedMesh& begin, const std::vector<glm::vec2>& uvs,
                              cage::UvMode mode) {
    Result<cage::UvChannel> channel =
        cage::buildUvChannel(begin.cage, begin.topology, {begin.edgeSharpness, begin.vertexSharpness}, uvs, mode);
    if (!channel) {
        return channel.error();
    }
    ChannelLevel level = firstChannelLevel(begin, std::move(*channel));
    if (mesh.refined) {
        if (const Status refined = refineChannel(level, Subdivision::catmullClark, mode); !refined) {
            return refined.error();
        }
    }
    return UvChartBuilder(mesh, level).run();
}

} // namespace supple::surface::blend
