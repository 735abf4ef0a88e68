// The index words of single schemes, for indexWords() (tests/surface/table_words.h).
#pragma once

#include "tests/surface/table_words.h"

namespace supple::test {

/// Collects words.
class WordList {
public:
    WordList(const surface::Tables& tables, std::vector<IndexWord>& words) : tables_(tables), words_(words) {}

    [[nodiscard]] const surface::Tables& tables() const { return tables_; }
    [[nodiscard]] uint32_t at(uint64_t word) const { return tables_.words[word]; }
    [[nodiscard]] uint32_t half(uint64_t word, uint32_t k) const { return at(word + k / 2) >> 16 * (k % 2) & 0xFFFFu; }
    [[nodiscard]] uint64_t elements() const { return tables_.words.size() / 4; }

    void add(const char* what, uint64_t word, std::vector<uint32_t> bad) {
        words_.push_back({what, word, std::move(bad)});
    }
    /// An index below a limit.
    void addIndex(const char* what, uint64_t word, uint64_t limit) {
        add(what, word, {0xFFFFFFFFu, static_cast<uint32_t>(limit)});
    }
    /// The same in number k of those of 16 bits that begin with a word. `allOnes`: that leads out of bounds, too.
    void addHalf(const char* what, uint64_t word, uint32_t k, uint64_t limit, bool allOnes = true);

private:
    const surface::Tables& tables_;
    std::vector<IndexWord>& words_;
};

/// Of a construction by stencils, which may read so many vertices, those before Construction::from counted.
void addStencilWords(WordList& list, const surface::Construction& construction, uint64_t vertices);
/// All but corner attributes and what patches with levels have.
void addBlendWords(WordList& list, const surface::TableSource& source);
/// All but corner attributes.
void addFragmentWords(WordList& list, const surface::TableSource& source);

} // namespace supple::test
