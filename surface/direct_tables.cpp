#include "surface/direct_tables.h"

#include "surface/grid.h"
#include "surface/patch_records.h"

#include <bit>
#include <iterator>

namespace supple::surface {

static_assert(SUPPLE_BICUBIC_RECORD_ELEMENTS == rowOf(PatchClass::regular).recordElements &&
              SUPPLE_BICUBIC_RECORD_ELEMENTS == rowOf(PatchClass::polar).recordElements &&
              SUPPLE_PERTURBED_RECORD_ELEMENTS == rowOf(PatchClass::perturbed).recordElements);

DirectTables directTables(const Tables& tables, uint32_t mostRate) {
    DirectTables direct;
    const std::vector<float> pairs = parameterPairs();
    const size_t floats = size_t{2} * SUPPLE_FIRST_PAIR(mostRate + 1);
    for (size_t i = 0; i < floats; ++i) {
        direct.words.push_back(std::bit_cast<uint32_t>(pairs[i]));
    }
    direct.words.resize((floats + 3) / 4 * 4);
    for (const PatchRange& range : tables.ranges) {
        direct.firstRecords.push_back(static_cast<uint32_t>(direct.words.size() / 4));
        const auto first = tables.words.begin() + ptrdiff_t{4} * range.section.table;
        const uint32_t elements = range.section.count * recordElements(tables, range.patchClass);
        direct.words.insert(direct.words.end(), first, first + ptrdiff_t{4} * elements);
    }
    return direct;
}

} // namespace supple::surface
