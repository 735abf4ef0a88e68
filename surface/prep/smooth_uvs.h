// p-rep's construction over the channel of a UV set, in double (docs/smooth_uvs.md).
#pragma once

#include "surface/prep/weights.h"
#include "surface/smooth_uvs.h"

namespace supple::surface::prep {

/// The channel of a UV set: p-rep has no creases, so borders alone are sharp, and corners of one face by the options.
[[nodiscard]] Result<cage::UvChannel> buildUvChannel(const cage::Cage& cage, const cage::Topology& topology,
                                                     const Options& options, const std::vector<glm::vec2>& uvs,
                                                     cage::UvMode mode);

/// Coefficients by face. `cage` and `topology` must outlive it, the channel need not.
class UvConstruction {
public:
    UvConstruction(const cage::Cage& cage, const cage::Topology& topology, const Options& options,
                   const cage::UvChannel& channel);
    [[nodiscard]] UvPatch patch(uint32_t face) const;

private:
    /// X, FC, and the tangents towards the next and the previous corner.
    struct CornerUvs {
        glm::dvec2 v{0.0}, f{0.0}, t0{0.0}, t1{0.0};
    };
    class Fans;

    void perturb(const cage::UvChannel& channel);

    const cage::Cage& cage_;
    const cage::Topology& topology_;
    std::vector<CornerUvs> corners_;                   ///< per corner of the cage
    std::vector<std::array<glm::dvec2, 4>> perturbed_; ///< per edge: h20, h30, h21, h31 in its own direction
};

} // namespace supple::surface::prep
