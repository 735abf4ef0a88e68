#include "tools/reference/fragments.h"

#include "cpu/fragment.h"

#include <map>
#include <utility>

namespace supple::surface::subdivision {
namespace {

/// Evaluates fragments one after the other, with their patterns kept.
template <class T>
class Evaluator {
public:
    using Vec = Vec3<T>;

    Evaluator(const Mesh& mesh, std::span<const Vec> isolated, uint32_t steps)
        : mesh_(mesh), net_(mesh, isolated), steps_(steps), side_(1u << steps) {}

    void run(const std::function<void(const SectorGrid<T>&)>& visit) {
        for (const Fragment& fragment : mesh_.fragments) {
            net_.load(fragment);
            if (fragment.kind == FragmentKind::vertex) {
                runVertex(fragment, visit);
            } else {
                runFacet(fragment, visit);
            }
        }
    }

private:
    const Pattern& patternOf(const Fan& fan) {
        auto found = fans_.find(fan);
        if (found == fans_.end()) {
            found = fans_.emplace(fan, fanPattern(fan, steps_)).first;
        }
        return found->second;
    }

    void runVertex(const Fragment& fragment, const std::function<void(const SectorGrid<T>&)>& visit) {
        const Fan fan = net_.fanOf(fragment);
        const Pattern& pattern = patternOf(fan);
        for (uint32_t j = 1; j <= steps_; ++j) {
            net_.refine(fan, pattern, pointCount(fan, (1u << j) + 1));
        }
        const std::vector<Sample<T>> centres = net_.centre(fan);
        const Rules<T> rules(mesh_.subdivision, net_.points());
        for (uint32_t h = 0; h < fan.sectors; ++h) {
            grid_.face = mesh_.sectorFaces[fragment.firstSector + h];
            grid_.samples.clear();
            forEachSample([&](uint32_t a, uint32_t b) {
                const uint32_t index = pointIndex(fan, h, static_cast<int32_t>(a), static_cast<int32_t>(b));
                grid_.samples.push_back(index == 0 ? centres[h]
                                                   : rules.limit(index, pattern.neighbours[index],
                                                                 net_.sharpnessOf(pattern.spokes[index]),
                                                                 a == 0 ? Side::right : Side::left));
            });
            visit(grid_);
        }
    }

    void runFacet(const Fragment& fragment, const std::function<void(const SectorGrid<T>&)>& visit) {
        while (facets_.size() <= steps_) {
            facets_.push_back(facetPattern(static_cast<uint32_t>(facets_.size())));
        }
        for (uint32_t j = 1; j <= steps_; ++j) {
            net_.refine({}, facets_[j], facetPointCount(1u << j));
        }
        const Pattern& pattern = facets_[steps_];
        const Rules<T> rules(mesh_.subdivision, net_.points());
        grid_.face = mesh_.sectorFaces[fragment.firstSector];
        grid_.samples.clear();
        forEachSample([&](uint32_t a, uint32_t b) {
            const uint32_t index = facetPointIndex(side_, static_cast<int32_t>(a), static_cast<int32_t>(b));
            const uint32_t line = pattern.spokes[index];
            // The facet lies right of the lines through c0 and c2, left of that through c1.
            grid_.samples.push_back(rules.limit(index, pattern.neighbours[index], net_.sharpnessOf(line),
                                                line == 1 ? Side::left : Side::right));
        });
        visit(grid_);
    }

    /// In grid order.
    template <class Visit>
    void forEachSample(Visit&& visit) const {
        for (uint32_t b = 0; b <= side_; ++b) {
            const uint32_t last = mesh_.subdivision == Subdivision::catmullClark ? side_ : side_ - b;
            for (uint32_t a = 0; a <= last; ++a) {
                visit(a, b);
            }
        }
    }

    const Mesh& mesh_;
    FragmentNet<T> net_; ///< of the fragment at work
    uint32_t steps_;
    uint32_t side_; ///< segments along a sector's side
    std::map<Fan, Pattern> fans_;
    std::vector<Pattern> facets_; ///< by step
    SectorGrid<T> grid_;
};

} // namespace

template <class T>
void forEachSector(const Mesh& mesh, std::span<const Vec3<T>> isolated, uint32_t steps,
                   const std::function<void(const SectorGrid<T>&)>& visit) {
    Evaluator<T>(mesh, isolated, steps).run(visit);
}

template <class T>
std::vector<SectorGrid<T>> evaluate(const Mesh& mesh, std::span<const Vec3<T>> isolated, uint32_t steps) {
    std::vector<SectorGrid<T>> all;
    forEachSector<T>(mesh, isolated, steps, [&](const SectorGrid<T>& grid) { all.push_back(grid); });
    return all;
}

template void forEachSector<float>(const Mesh&, std::span<const Vec3<float>>, uint32_t,
                                   const std::function<void(const SectorGrid<float>&)>&);
template void forEachSector<double>(const Mesh&, std::span<const Vec3<double>>, uint32_t,
                                    const std::function<void(const SectorGrid<double>&)>&);
template std::vector<SectorGrid<float>> evaluate<float>(const Mesh&, std::span<const Vec3<float>>, uint32_t);
template std::vector<SectorGrid<double>> evaluate<double>(const Mesh&, std::span<const Vec3<double>>, uint32_t);

} // namespace supple::surface::subdivision
