// Follows the tables of shaders/shared/polygons.h as the kernels of shaders/polygons do.
#include "surface/build.h"
#include "surface/polygons/kernels.h"
#include "surface/table_check_common.h"

#include <span>

namespace supple::surface::polygons {

namespace {

using namespace shared;

/// Lists of words that records name. They follow each other, so that no kernel reads more than there is.
class WordLists {
public:
    explicit WordLists(TableCheck& check) : check_(check) {}
    /// The list's words.
    std::span<const uint32_t> take(uint32_t first, uint32_t count) {
        if (!check_.words(first, count) ||
            !check_.require(next_ == kFirst || next_ == first, "lists that do not follow each other")) {
            return {};
        }
        next_ = uint64_t{first} + count;
        return std::span(check_.tables().words).subspan(first, count);
    }

private:
    TableCheck& check_;
    static constexpr uint64_t kFirst = ~uint64_t{0};
    uint64_t next_ = kFirst;
};

void checkShortFaces(TableCheck& check, const Section& section) {
    if (!check.elements(section.table, section.count) || !check.pool(0, section.count)) {
        return;
    }
    for (const uint32_t vertex :
         std::span(check.tables().words).subspan(size_t{4} * section.table, size_t{4} * section.count)) {
        if (!check.vertices(vertex)) {
            return;
        }
    }
}

void checkLongFaces(TableCheck& check, const Section& section) {
    if (!check.elements(section.table, section.count)) {
        return;
    }
    WordLists lists(check);
    for (uint64_t face = 0; face < section.count; ++face) {
        const std::span<const uint32_t> record = check.element(section.table + face);
        if (!check.require(record[1] > 2, "a face without area") || !check.pool(record[2])) {
            return;
        }
        for (const uint32_t vertex : lists.take(record[0], record[1])) {
            if (!check.vertices(vertex)) {
                return;
            }
        }
    }
}

void checkFrames(TableCheck& check, const Section& section) {
    const uint64_t coefficients = uint64_t{kFrameElements} * section.count;
    if (!check.elements(section.table, section.count) || !check.pool(check.tables().tangents, coefficients)) {
        return;
    }
    WordLists lists(check);
    for (uint64_t frame = 0; frame < section.count; ++frame) {
        const std::span<const uint32_t> record = check.element(section.table + frame);
        if (!check.vertices(record[0]) || !check.vertices(record[1])) {
            return;
        }
        for (const uint32_t face : lists.take(record[2], record[3])) {
            if (!check.pool(face)) {
                return;
            }
        }
    }
}

void checkConstructions(TableCheck& check) {
    for (const Construction& construction : check.tables().constructions) {
        if (construction.kernel == kFrameKernel) {
            check.begin("frames");
            checkFrames(check, construction.section);
        } else if (construction.kernel.kind == kLongFaces) {
            check.begin("long faces");
            checkLongFaces(check, construction.section);
        } else {
            check.begin("faces");
            checkShortFaces(check, construction.section);
        }
    }
}

/// Surface vertices, and what else there is of each.
void checkSurfaceVertices(TableCheck& check) {
    const Tables& tables = check.tables();
    const Recipe& recipe = check.source().recipe;
    const Section& vertices = tables.triangles.vertices;
    check.begin("surface vertices");
    if (!check.require(vertices.count > 0, "there are none") || !check.elements(vertices.table, vertices.count)) {
        return;
    }
    for (uint64_t vertex = 0; vertex < vertices.count; ++vertex) {
        if (!check.pool(check.element(vertices.table + vertex)[0], kFrameElements)) {
            return;
        }
    }
    check.begin("directions of tangents");
    const uint32_t directions = tables.triangles.directions;
    if (!check.require((directions != 0) == (recipe.tangents && recipe.attributes), "not as the recipe says") ||
        !check.words(directions, directions != 0 ? vertices.count : 0)) {
        return;
    }
    check.begin("corner attributes");
    check.elements(tables.attributes, recipe.attributes ? uint64_t{tables.cornerElements()} * vertices.count : 0);
}

void checkTriangles(TableCheck& check) {
    check.begin("triangles");
    const Triangles& triangles = check.tables().triangles;
    if (!check.require(triangles.indices.size() == 3 * check.tables().patches.size(), "another number of triangles")) {
        return;
    }
    for (const uint32_t vertex : triangles.indices) {
        if (!check.within(vertex, 1, triangles.vertices.count, "surface vertices")) {
            return;
        }
    }
}

void checkTriangleClass(TableCheck& check) {
    check.begin("patches");
    for (const PatchInfo& patch : check.tables().patches) {
        check.require(patch.patchClass == PatchClass::triangle, "a class of another scheme");
    }
}

} // namespace

void check(TableCheck& check) {
    checkKernels(check, {{Stage::vertex, kFaceKernels}, {Stage::assemble, {&kFrameKernel, 1}}});
    for (void (*part)(TableCheck&) :
         {&checkTriangleClass, &checkConstructions, &checkSurfaceVertices, &checkTriangles}) {
        if (!check.failed()) {
            part(check);
        }
    }
}

} // namespace supple::surface::polygons
