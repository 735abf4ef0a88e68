// Which words of tables are indices, counts or enumerators, by what the kernels in shaders/ read. All others are
// weights, coordinates, colors or padding, and may be anything. This is written apart from what checks the words, and
// knows its code not.
#pragma once

#include "surface/table_check.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::test {

/// A word of the tables, and values of it that lead out of bounds.
struct IndexWord {
    std::string what;
    size_t word = 0;
    std::vector<uint32_t> bad;
};

/// The words of all schemes but the exact ones (tests/surface/chains/table_words_test.cpp).
[[nodiscard]] std::vector<IndexWord> indexWords(const surface::Tables& tables, const surface::TableSource& source);

} // namespace supple::test
