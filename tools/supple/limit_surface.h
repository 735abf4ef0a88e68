// The Catmull-Clark limit surface of a posed cage, in double: what other surfaces are measured against.
#pragma once

#include "base/result.h"
#include "cage/character.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

namespace supple::tools {

/// Points on the limit, from the subdivision on the CPU, with bicubic interpolation between them: where the
/// limit is bicubic it is met to double's precision, elsewhere nearly so (Deviation::doubt). Creases, sharp vertices
/// and holes are the cage's.
class LimitSurface {
public:
    [[nodiscard]] static Result<LimitSurface> build(const cage::Cage& cage, std::span<const glm::dvec3> positions);
    LimitSurface(LimitSurface&&) noexcept;
    ~LimitSurface();

    struct Deviation {
        double distance = 0.0;
        double degrees = 0.0; ///< between the normals; negative where one of them vanishes
        /// What the distance changes by if every second row and column of known points is left out: a cautious estimate
        /// of the error of measuring it.
        double doubt = 0.0;
    };

    /// Measures on one thread; the surface may serve several probes at once.
    class Probe {
    public:
        explicit Probe(const LimitSurface& surface);
        ~Probe();

        /// From a point of another surface to the nearest of the limit, among the parts that belong to the point's own
        /// face of the cage and to the faces round it: elsewhere the skin may lie on itself. The normal is compared
        /// with that of the nearest point on the same side of hard creases as the face; where several are equally near
        /// (at the end of a crease), with the most similar.
        [[nodiscard]] Deviation measure(uint32_t face, const glm::dvec3& position, const glm::dvec3& normal,
                                        bool withDoubt = false);

    private:
        struct State;
        std::unique_ptr<State> state_;
    };

private:
    struct Data;
    explicit LimitSurface(std::unique_ptr<Data> data);
    std::unique_ptr<Data> data_;
};

} // namespace supple::tools
