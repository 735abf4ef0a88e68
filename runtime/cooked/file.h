// Prepared characters as bytes: the file that `supple cook` writes (docs/cooked_files.md).
//
//   header       magic; version; byte order; bytes of the file; hash of all that follows; all versions begin so
//   made by      text: the command that makes the file anew
//   character    cooked/character_fields.h
//   choices      what SUPPLE_SCHEME_AUTO takes for each part
//   clips        1: a group is to play them on the device
//   centers      of rotation, if a group is to be skinned about them
//   mush         1: a group is to be skinned by delta mush; then skinning::DeltaMush without its arms
//   pieces, tables  cooked/table_fields.h
//
// Numbers are little-endian as they lie in memory. A list is its count (64 bits) and its elements.
#pragma once

#include "base/result.h"
#include "runtime/prepared.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace supple::runtime {

/// Whether bytes begin as a cooked file does, of whatever version.
[[nodiscard]] bool isCooked(std::span<const std::byte> bytes);

/// How many bytes writeCooked() writes. Makes none of them: O(members of lists that are not plain numbers).
[[nodiscard]] size_t cookedBytes(const Prepared& prepared, const std::string& madeBy);

/// `madeBy`: the command that makes the file anew, for messages; or empty. `out` has cookedBytes().
void writeCooked(const Prepared& prepared, const std::string& madeBy, std::span<std::byte> out);
[[nodiscard]] std::vector<std::byte> writeCooked(const Prepared& prepared, const std::string& madeBy);
/// The file of the character alone, without its name and all that was prepared for groups.
[[nodiscard]] std::vector<std::byte> writeCookedCharacter(const Prepared& prepared);

/// Reads a file and checks all that somebody relies on later; it may be anybody's. `name` begins every error, and
/// becomes Character::name. Refuses files of another version or byte order, and says how to make them anew. No
/// exception but std::bad_alloc.
[[nodiscard]] Result<std::shared_ptr<Prepared>> readCooked(std::span<const std::byte> bytes, const std::string& name);

/// The character alone, which is checked; what is behind it nobody looks at.
[[nodiscard]] Result<cage::Character> readCookedCharacter(std::span<const std::byte> bytes, const std::string& name);

/// Refuses what comes from a cooked file if it has tables for the other mapping alone.
[[nodiscard]] Status checkMapping(const Prepared& prepared, bool wide);

} // namespace supple::runtime
