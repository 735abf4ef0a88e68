// Tables that come from a file are no trusted input: kernels follow their words without looking. So every word that is
// an index, a count or an enumerator is checked before a device sees it. Words that are weights are taken as they are:
// they move points, nothing else.
#pragma once

#include "base/result.h"
#include "surface/recipe.h"
#include "surface/scheme.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace supple::surface {

/// What the tables were made of.
struct TableSource {
    const Recipe& recipe;
    uint32_t vertices = 0;  ///< of the cage
    uint32_t faces = 0;     ///< of the whole cage: PatchInfo::face is below
    uint32_t parts = 0;     ///< of the character
    uint32_t materials = 0; ///< of the character
    /// If the cage is a piece: of the whole cage, whose vertices PatchInfo::corners name.
    uint32_t wholeVertices = 0;
};

/// Follows the tables as the kernels do. A check asks it about each index, and stops at the first fault.
class TableCheck {
public:
    /// Both must outlive it.
    TableCheck(const Tables& tables, const TableSource& source) : tables_(tables), source_(source) {}

    [[nodiscard]] const Tables& tables() const { return tables_; }
    [[nodiscard]] const TableSource& source() const { return source_; }
    /// What is checked now, for messages: "patch records". Its lifetime is the program's.
    void begin(const char* what) { what_ = what; }

    /// Whether `count` things from `first` on are within `limit`. If not, this is the fault.
    bool within(uint64_t first, uint64_t count, uint64_t limit, const char* of) {
        return (first <= limit && count <= limit - first) || refuse(first, count, limit, of);
    }
    /// The same of words and elements (four words) of the tables, coefficients of an instance's pool, and vertices of
    /// the cage.
    bool words(uint64_t first, uint64_t count) { return within(first, count, tables_.words.size(), "words"); }
    bool elements(uint64_t first, uint64_t count) { return within(first, count, tables_.words.size() / 4, "elements"); }
    bool pool(uint64_t first, uint64_t count = 1) { return within(first, count, tables_.poolStride, "coefficients"); }
    bool vertices(uint64_t first, uint64_t count = 1) {
        return within(first, count, source_.vertices, "cage vertices");
    }
    /// Coefficients of an instance's pool, one for each of one index or more.
    bool poolAll(std::span<const uint32_t> indices) { return pool(*std::max_element(indices.begin(), indices.end())); }
    /// Whether something else holds that kernels rely on. If not, `fault` is the fault.
    bool require(bool holds, const char* fault) { return holds || refuse(fault); }

    /// A word that words() or elements() has found to be there.
    [[nodiscard]] uint32_t word(uint64_t at) const { return tables_.words[at]; }
    [[nodiscard]] std::span<const uint32_t> element(uint64_t at) const {
        return std::span(tables_.words).subspan(4 * at, 4);
    }

    [[nodiscard]] bool failed() const { return fault_.has_value(); }
    /// "patch records: 12345, of 800 coefficients"; ErrorCode::asset.
    [[nodiscard]] Status status() const;

private:
    /// Notes the first fault. False.
    bool refuse(uint64_t first, uint64_t count, uint64_t limit, const char* of);
    bool refuse(const char* fault);

    const Tables& tables_;
    const TableSource& source_;
    const char* what_ = "tables";
    std::optional<std::string> fault_;
};

/// Refuses tables with which a kernel could read or write beyond its buffers or loop beyond its bounds, or the library
/// read beyond an array. Tables that buildTables() made of the same recipe and cage pass. O(words).
[[nodiscard]] Status checkTables(const Tables& tables, const TableSource& source);

/// Whether tables for several rates (Scheme::hasRates) are of one mesh: what the constructions of one make serves all,
/// and each has the patches of the others. buildTables() makes such tables of one cage; those of files are compared
/// where they meet. O(ranges).
[[nodiscard]] bool areOfOneMesh(const Tables& tables, const Tables& others);

} // namespace supple::surface
