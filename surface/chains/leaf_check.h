// Checks the records of quads and triangles of leaves (shaders/shared/chains.h): patches that are not bicubic, and
// smooth texture coordinates. Private to chains/.
#pragma once

#include "surface/chains/check_bounds.h"
#include "surface/subdivision_rules.h"

namespace supple::surface::chains {

/// Follows the records as shaders/catmull_clark/{quad,nets,sample}.glsl and shaders/loop/triangle.glsl do. It relies on
/// what checkTables() finds out before (surface/table_check_common.h): records lie in the tables.
class LeafCheck {
public:
    /// `lastLevel`: of chains.
    LeafCheck(TableCheck& check, Subdivision subdivision, uint32_t lastLevel)
        : check_(check), subdivision_(subdivision), lastLevel_(lastLevel), netLists_(check.tables()) {}

    /// All patches but regular quads.
    [[nodiscard]] bool takePatches();
    /// The leaves of smooth texture coordinates.
    [[nodiscard]] bool takeSmoothUvs();

private:
    /// What the points of a record are: coefficients of the pool, or pairs of floats of the tables.
    struct Points {
        uint64_t count = 0;
        const char* name = "";
    };
    /// What a record says of a corner.
    struct Corner {
        uint32_t chain = 0, netLists = 0, normal = 0;
        [[nodiscard]] bool isPlain() const { return normal == 0; }
    };
    [[nodiscard]] bool isTriangles() const { return subdivision_ == Subdivision::loop; }
    [[nodiscard]] bool takeQuad(uint64_t element, PatchClass patchClass);
    [[nodiscard]] bool takeTriangle(uint64_t element, PatchClass patchClass);
    [[nodiscard]] bool takeUvQuad(uint64_t element);
    [[nodiscard]] bool takeUvTriangle(uint64_t element);
    [[nodiscard]] bool checkQuadNet(const uint32_t* net, const Points& points);
    [[nodiscard]] bool checkSharpness(const uint32_t* net, bool has);
    [[nodiscard]] bool checkTriangleNet(const uint32_t* net, const Points& points);
    [[nodiscard]] bool checkCorner(const Corner& corner, const Points& points);
    [[nodiscard]] bool checkUvCorner(const Corner& corner, const Points& points);
    [[nodiscard]] bool checkChain(const Corner& corner, const Points& points);
    [[nodiscard]] bool checkNetList(uint64_t element);
    [[nodiscard]] bool point(uint64_t index, const Points& points) {
        return check_.within(index, 1, points.count, points.name);
    }
    [[nodiscard]] Points coefficients() const { return {check_.tables().poolStride, "coefficients"}; }
    [[nodiscard]] Points pairs() const { return {check_.tables().words.size() / 2, "pairs of floats"}; }

    TableCheck& check_;
    Subdivision subdivision_;
    uint32_t lastLevel_;
    SeenElements netLists_;
};

} // namespace supple::surface::chains
