// How the readers of cage/ and the writers of tools/gltf/ word their messages: they name the element, count and quote
// in one way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace supple::cage {

/// "node 3"
[[nodiscard]] std::string at(const char* what, size_t index);
/// "mesh 0 primitive 1 POSITION[7]"
[[nodiscard]] std::string item(const std::string& element, size_t index);
/// "mesh 0 primitive 1 NORMAL"
[[nodiscard]] std::string within(const std::string& element, const std::string& part);
/// "1 vertex", "2 vertices"
[[nodiscard]] std::string counted(size_t count, const char* one, const char* many);
[[nodiscard]] std::string quoted(const std::string& text);
/// "a, b", "a, b, c, d, e, f, g, h and 20 more"
[[nodiscard]] std::string listed(const std::vector<std::string>& names);
/// Three significant digits.
[[nodiscard]] std::string shortNumber(double value);
/// Messages are one line that reads as it stands, whatever a file calls its parts: `instead` takes the place of control
/// characters, of those that turn the direction of text or cannot be seen, and of bytes that are no UTF-8.
[[nodiscard]] std::string oneLine(std::string_view text, char instead = '?');
/// The same for lines of which a file can cause any number: of more than kMostAlike that differ in numbers and quoted
/// names alone, only the first stays, with their count. There are kMostLines in all, and one that counts the rest.
[[nodiscard]] std::vector<std::string> readableLines(const std::vector<std::string>& lines);
inline constexpr size_t kMostAlike = 8;
inline constexpr size_t kMostLines = 256;
/// Longer messages are cut off here: a file can have names of any length.
inline constexpr size_t kLongestLine = 1024;
[[nodiscard]] std::string cutOff(std::string line);

/// Faces that one message lists.
inline constexpr size_t kMaxListedFaces = 8;

/// One kind of fault or damage: how often it was found, and where first.
struct Found {
    size_t count = 0;
    std::string first;

    /// `name` gives the name of the place, and is called for the first one alone.
    template <class Name>
    void add(Name&& name) {
        if (count++ == 0) {
            first = name();
        }
    }
    /// "1 face is empty: face 3", "12 faces are empty, the first is face 3"
    [[nodiscard]] std::string told(const char* one, const char* many) const;
};

/// What messages about a cage call its elements: every part has a name, and counts its own faces and vertices.
struct CageNames {
    std::vector<std::string> parts;       ///< "mesh 0"; one, if the cage is one part
    std::vector<uint32_t> cornerVertices; ///< per corner: its vertex as the part counts; empty: as the cage counts
};

/// What was repaired or left out, as "element: reason"; who shows it puts the character's name in front.
using Warnings = std::vector<std::string>;
void warn(Warnings& warnings, const std::string& element, const std::string& reason);

} // namespace supple::cage
