// Follows the tables of shaders/shared/prep.h as the kernels of shaders/prep do.
#include "shaders/shared/prep.h"

#include "surface/build.h"
#include "surface/prep/kernels.h"
#include "surface/table_check_common.h"

#include <span>

namespace supple::surface::prep {

namespace {

using namespace shared;

/// Records of two words: first slot, weights of the class.
bool checkVertices(TableCheck& check, const Construction& construction, FanSlots& slots) {
    const uint64_t first = uint64_t{4} * construction.section.table, count = construction.section.count;
    if (!check.words(first, 2 * count)) {
        return false;
    }
    uint32_t known = 0; // weights, which neighbours have in common
    uint64_t spokes = 0;
    for (uint64_t word = first; word < first + 2 * count; word += 2) {
        const uint32_t weights = check.word(word + 1);
        if (spokes == 0 || weights != known) {
            spokes = checkFanWeights(check, weights, kBoundaryClass);
            known = weights;
        }
        if (spokes == 0 || !slots.take(check.word(word), spokes)) {
            return false;
        }
    }
    return true;
}

void checkFans(TableCheck& check) {
    FanSlots slots(check, check.source().vertices);
    check.begin("vertices");
    for (const Construction& construction : check.tables().constructions) {
        if (construction.kernel.kernel != Kernel::prepVertex || check.failed()) {
            continue;
        }
        if (construction.kernel.kind == kRegularFan) {
            slots.takeRegular(construction.section.count);
        } else {
            checkVertices(check, construction, slots);
        }
    }
    slots.done();
}

/// A perturbed edge: its ends, which have what a patch's corners have, and the weights of its class.
bool checkPerturbedEdge(TableCheck& check, std::span<const uint32_t> record) {
    const uint64_t edgeClass = SUPPLE_PREP_EDGE_CLASS(record[0], record[2]);
    return checkPatchCorner(check, SUPPLE_POINT(record[0]), record[1]) &&
           checkPatchCorner(check, SUPPLE_POINT(record[2]), record[3]) &&
           check.elements(check.tables().edgeClasses + kEdgeClassElements * edgeClass, kEdgeClassElements);
}

void checkPerturbedEdges(TableCheck& check) {
    check.begin("perturbed edges");
    const Tables& tables = check.tables();
    for (const Construction& construction : tables.constructions) {
        const Section& section = construction.section;
        if (construction.kernel.kernel != Kernel::prepEdge) {
            continue;
        }
        if (!check.elements(section.table, section.count) || !check.pool(tables.inner, uint64_t{4} * section.count)) {
            return;
        }
        for (uint64_t edge = 0; edge < section.count; ++edge) {
            if (!checkPerturbedEdge(check, check.element(section.table + edge))) {
                return;
            }
        }
    }
}

} // namespace

void check(TableCheck& check) {
    checkClasses(check, {PatchClass::regular, PatchClass::perturbed});
    checkKernels(check, {{Stage::vertex, kVertexKernels}, {Stage::assemble, {&kEdgeKernel, 1}}});
    for (void (*part)(TableCheck&) : {&checkFans, &checkPerturbedEdges}) {
        if (!check.failed()) {
            part(check);
        }
    }
}

} // namespace supple::surface::prep
