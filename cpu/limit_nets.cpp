#include "cpu/limit_nets.h"

#include <algorithm>
#include <new>

namespace supple::surface::subdivision {
namespace {

/// Grids up to rate 64 ask for no more.
constexpr uint32_t kLastKept = 7;
constexpr uint32_t kFragmentsPerJob = 32;
constexpr uint32_t kRowsPerJob = 4096;

void applyRows(const Stencils& stencils, std::span<const glm::dvec3> from, uint32_t begin, uint32_t end,
               std::span<glm::dvec3> to) {
    for (uint32_t row = begin; row < end; ++row) {
        to[row] = applyStencil<double>(stencils, row, from);
    }
}

} // namespace

LimitShape::LimitShape(const Mesh& mesh)
    : mesh_(mesh), sectors_(mesh.cage.faceCount()), uniform_(mesh.fragments.size(), 0), kept_(mesh.fragments.size()) {
    const FragmentNet<double> net(mesh, {});
    const uint32_t regular = mesh.subdivision == Subdivision::catmullClark ? 4 : 6;
    for (uint32_t f = 0; f < mesh.fragments.size(); ++f) {
        const Fragment& fragment = mesh.fragments[f];
        const auto spokes = mesh.spokeSharpness.begin() + fragment.firstSpoke;
        if (fragment.kind == FragmentKind::vertex) {
            if (const Fan fan = net.fanOf(fragment); !patterns_.contains(fan)) {
                patterns_.emplace(fan, fanPattern(fan, 1));
            }
            uniform_[f] = !fragment.open && fragment.sectors == regular && fragment.centreSharpness == 0.0f &&
                          std::all_of(spokes, spokes + fragment.spokes(), [](float sharp) { return sharp == 0.0f; });
        }
        for (uint32_t h = 0; h < fragment.sectors; ++h) {
            sectors_[mesh.sectorFaces[fragment.firstSector + h]] = {f, h};
        }
    }
}

bool LimitShape::isFlatCorner(const Sector& sector) const {
    const Fragment& fragment = mesh_.fragments[sector.fragment];
    const auto spokes = mesh_.spokeSharpness.begin() + fragment.firstSpoke;
    const auto isCrease = [&](uint32_t spoke) { return spokes[spoke % fragment.spokes()] >= kInfiniteSharpness; };
    return fragment.kind == FragmentKind::vertex && fragment.centreSharpness == 0.0f && isCrease(sector.number) &&
           isCrease(sector.number + 1) && std::count_if(spokes, spokes + fragment.spokes(), [](float sharpness) {
                                              return sharpness >= kInfiniteSharpness;
                                          }) == 2;
}

void LimitShape::keep(uint32_t fragment) {
    Kept& kept = kept_[fragment];
    if (kept.last != 0) {
        return;
    }
    const Fragment& of = mesh_.fragments[fragment];
    kept.first = keptPoints_;
    if (of.kind == FragmentKind::facet) {
        kept.last = 1;
        kept.perLevel = 1 + facetPointCount(1);
        keptPoints_ += kept.perLevel;
    } else {
        kept.last = uniform_[fragment] != 0 ? 2 : kLastKept;
        kept.perLevel = 1 + pointCount({mesh_.subdivision, of.sectors, of.open}, 3);
        keptPoints_ += size_t{kept.perLevel} * (kept.last - 1);
    }
    keptFragments_.push_back(fragment);
}

LimitPose::LimitPose(const LimitShape& shape) : shape_(shape), nets_(shape.keptPoints()) {
    for (const Stencils& step : shape.mesh().stencils) {
        steps_.emplace_back(step.rows());
    }
}

Status LimitPose::build(std::span<const glm::dvec3> positions, const RunJobs& runJobs) {
    const std::vector<Stencils>& stencils = shape_.mesh().stencils;
    for (size_t step = 0; step < steps_.size(); ++step) {
        const std::span<const glm::dvec3> from = step == 0 ? positions : std::span<const glm::dvec3>(steps_[step - 1]);
        if (const Status made = cpu::inRanges(
                runJobs, stencils[step].rows(), kRowsPerJob,
                [&](uint32_t begin, uint32_t end) { applyRows(stencils[step], from, begin, end, steps_[step]); });
            !made) {
            return made;
        }
    }
    const std::span<const uint32_t> fragments = shape_.keptFragments();
    return cpu::inRanges(runJobs, static_cast<uint32_t>(fragments.size()), kFragmentsPerJob,
                         [&](uint32_t begin, uint32_t end) {
                             FragmentNet<double> net(shape_.mesh(), isolated());
                             for (uint32_t k = begin; k < end; ++k) {
                                 buildNets(net, fragments[k]);
                             }
                         });
}

Status LimitPose::build(std::span<const glm::vec3> positions, const RunJobs& runJobs) {
    given_.assign(positions.begin(), positions.end());
    return build(std::span<const glm::dvec3>(given_), runJobs);
}

void LimitPose::buildNets(FragmentNet<double>& net, uint32_t fragment) {
    const LimitShape::Kept& kept = shape_.keptOf(fragment);
    const Fragment& of = shape_.mesh().fragments[fragment];
    net.load(of);
    auto to = nets_.begin() + static_cast<ptrdiff_t>(kept.first);
    const auto put = [&] {
        net.recentre();
        *to++ = net.origin();
        to = std::copy(net.points().begin(), net.points().end(), to);
    };
    if (of.kind == FragmentKind::facet) {
        put();
        return;
    }
    const Fan fan = net.fanOf(of);
    for (uint32_t level = 2; level <= kept.last; ++level) {
        net.refine(fan, shape_.patternOf(fan), kept.perLevel - 1);
        put();
    }
}

FragmentNet<double> LimitPose::netOf(const Fragment& fragment) const {
    FragmentNet<double> net(shape_.mesh(), isolated());
    net.load(fragment);
    return net;
}

std::span<const glm::dvec3> LimitPose::kept(uint32_t fragment, uint32_t level) const {
    const LimitShape::Kept& kept = shape_.keptOf(fragment);
    const uint32_t before = kept.last == 1 ? 0 : level - 2;
    return std::span(nets_).subspan(kept.first + size_t{before} * kept.perLevel, kept.perLevel);
}

LevelNet::LevelNet(const LimitPose& pose, uint32_t fragment, uint32_t level)
    : mesh_(pose.shape().mesh()), fragment_(mesh_.fragments[fragment]), level_(level) {
    if (pose.keeps(fragment, level)) {
        const std::span<const glm::dvec3> kept = pose.kept(fragment, level);
        origin_ = kept[0];
        points_ = kept.subspan(1);
        return;
    }
    FragmentNet<double> net = pose.netOf(fragment_);
    const Fan fan = net.fanOf(fragment_);
    for (uint32_t j = 2; j <= level; ++j) {
        net.refine(fan, pose.shape().patternOf(fan), pointCount(fan, 3));
        net.recentre();
    }
    origin_ = net.origin();
    made_ = net.points();
    points_ = made_;
}

float LevelNet::sharpnessOf(uint32_t spoke) const {
    return softened(mesh_.spokeSharpness[fragment_.firstSpoke + spoke], level_ - 1);
}

PosedLimit::PosedLimit(const Mesh& mesh, std::span<const glm::dvec3> positions) : shape(mesh), pose(shape) {
    if (!pose.build(positions, {})) {
        throw std::bad_alloc();
    }
}

} // namespace supple::surface::subdivision
