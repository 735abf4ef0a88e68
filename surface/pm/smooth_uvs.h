// P_m's construction over the channel of a UV set, in double (docs/smooth_uvs.md).
#pragma once

#include "surface/pm/mesh.h"
#include "surface/smooth_uvs.h"

namespace supple::surface::pm {

/// Coefficients by facet. `mesh` must outlive it, the channel need not.
class UvConstruction {
public:
    UvConstruction(const Mesh& mesh, const cage::UvChannel& channel);
    /// In the order of docs/pm.md, from corner 0 of the patch on.
    [[nodiscard]] UvPatch patch(uint32_t facet) const;

private:
    /// What the patch stage takes of a corner of a facet.
    struct CornerUvs {
        glm::dvec2 v{0.0}, f{0.0};
        // Towards the next and towards the previous corner:
        glm::dvec2 t0{0.0}, t1{0.0};
        glm::dvec2 e0{0.0}, e1{0.0};
        glm::dvec2 jump0{0.0}, jump1{0.0}; ///< f - f_across; 2 (f - t) where the run ends at the edge
        bool ends0 = false, ends1 = false;
    };
    class Fans;

    void polar(uint32_t facet, const CornerUvs* q, UvPatch& patch) const;
    void sectors(uint32_t facet, const CornerUvs* q, UvPatch& patch) const;

    const Mesh& mesh_;
    std::vector<CornerUvs> corners_; ///< per corner of the mesh's cage
};

} // namespace supple::surface::pm
