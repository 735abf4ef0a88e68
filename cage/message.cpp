#include "cage/message.h"

#include "base/utf8.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iterator>
#include <map>

namespace supple::cage {
namespace {

/// Neither a control character nor one that turns what stands beside it round, or cannot be seen.
bool isReadable(uint32_t code) {
    constexpr struct {
        uint32_t first, last;
    } kUnreadable[] = {{0x00, 0x1F},     {0x7F, 0x9F},     {0xAD, 0xAD},      {0x61C, 0x61C},
                       {0x200B, 0x200B}, {0x200E, 0x200F}, {0x2028, 0x202E},  {0x2060, 0x206F},
                       {0xFEFF, 0xFEFF}, {0xFFF9, 0xFFFD}, {0xE0000, 0xE0FFF}};
    return std::none_of(std::begin(kUnreadable), std::end(kUnreadable),
                        [code](const auto& range) { return code >= range.first && code <= range.last; });
}

/// A line without its numbers and quoted names.
std::string kindOf(const std::string& line) {
    std::string kind;
    bool quotedName = false;
    for (const char c : line) {
        quotedName = quotedName != (c == '"');
        const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
        if (!quotedName && !digit) {
            kind += c;
        } else if (digit && !quotedName && (kind.empty() || kind.back() != '#')) {
            kind += '#';
        }
    }
    return kind;
}

} // namespace

std::string at(const char* what, size_t index) {
    return std::string(what) + " " + std::to_string(index);
}

std::string item(const std::string& element, size_t index) {
    return element + "[" + std::to_string(index) + "]";
}

std::string within(const std::string& element, const std::string& part) {
    return element + " " + part;
}

std::string counted(size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string quoted(const std::string& text) {
    return "\"" + text + "\"";
}

std::string listed(const std::vector<std::string>& names) {
    constexpr size_t kMost = 8;
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), kMost); ++i) {
        text += (i == 0 ? "" : ", ") + names[i];
    }
    return names.size() > kMost ? text + " and " + std::to_string(names.size() - kMost) + " more" : text;
}

std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::string oneLine(std::string_view text, char instead) {
    std::string line;
    line.reserve(text.size());
    while (!text.empty()) {
        const CodePoint next = firstCodePoint(text);
        if (isReadable(next.code)) {
            line += text.substr(0, next.bytes);
        } else {
            line += instead;
        }
        text.remove_prefix(next.bytes);
    }
    return line;
}

std::string cutOff(std::string line) {
    if (line.size() > kLongestLine) {
        line.resize(kLongestLine);
        line += "...";
    }
    return line;
}

std::vector<std::string> readableLines(const std::vector<std::string>& lines) {
    std::map<std::string, size_t> counts;
    for (const std::string& line : lines) {
        ++counts[kindOf(line)];
    }
    std::vector<std::string> told;
    for (const std::string& line : lines) {
        size_t& count = counts[kindOf(line)];
        if (count == 0) {
            continue;
        }
        if (told.size() == kMostLines) {
            told.push_back("file: " + counted(lines.size() - kMostLines, "more line", "more lines") + " of warnings");
            break;
        }
        told.push_back(oneLine(cutOff(line)));
        if (count > kMostAlike) {
            told.back() += " (and " + counted(count - 1, "line", "lines") + " like this one)";
            count = 0;
        }
    }
    return told;
}

std::string Found::told(const char* one, const char* many) const {
    return counted(count, one, many) + (count == 1 ? ": " : ", the first is ") + first;
}

void warn(Warnings& warnings, const std::string& element, const std::string& reason) {
    warnings.push_back(element + ": " + reason);
}

} // namespace supple::cage
