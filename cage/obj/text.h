// The lines and words of Wavefront's text files, OBJ and MTL. Private to cage/obj/.
#pragma once

#include "base/from_chars.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace supple::cage::obj {

inline constexpr size_t kMaxQuotedText = 40;

inline std::string lineName(size_t line) {
    return at("line", line);
}

inline std::string shortened(std::string_view text) {
    return quoted(text.size() > kMaxQuotedText ? std::string(text.substr(0, kMaxQuotedText)) + "..."
                                               : std::string(text));
}

/// Logical lines: those that end in a backslash go on. Numbers count the file's own lines.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}

    bool next() {
        if (rest_.empty()) {
            return false;
        }
        number_ = physical_ + 1;
        line_ = takeLine();
        if (!continues(line_)) {
            return true;
        }
        joined_.clear();
        while (continues(line_)) {
            joined_.append(line_.substr(0, line_.size() - 1)).append(" ");
            line_ = takeLine();
        }
        joined_.append(line_);
        line_ = joined_;
        return true;
    }
    [[nodiscard]] size_t number() const { return number_; }
    [[nodiscard]] std::string_view line() const { return line_; }

private:
    static bool continues(std::string_view line) { return !line.empty() && line.back() == '\\'; }

    /// Lines end in LF, CR LF or, on old machines, CR.
    std::string_view takeLine() {
        ++physical_;
        const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        const std::string_view line = rest_.substr(0, end);
        const bool isPair = rest_.substr(end).starts_with("\r\n");
        rest_.remove_prefix(std::min(end + (isPair ? 2 : 1), rest_.size()));
        return line;
    }

    std::string_view rest_;
    std::string_view line_;
    std::string joined_;
    size_t physical_ = 0;
    size_t number_ = 0;
};

/// The words of a line up to its comment.
class Words {
public:
    explicit Words(std::string_view line) : line_(line), rest_(line.substr(0, line.find('#'))) {}

    /// Empty at the end.
    std::string_view next() {
        const size_t begin = std::min(rest_.find_first_not_of(kSpace), rest_.size());
        rest_.remove_prefix(begin);
        const size_t end = std::min(rest_.find_first_of(kSpace), rest_.size());
        const std::string_view word = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return word;
    }
    /// All that is left, without space around it. It is a name, which may have a '#' within: one after white space
    /// begins a comment.
    std::string_view tail() {
        std::string_view rest = line_.substr(static_cast<size_t>(rest_.data() - line_.data()));
        for (size_t mark = rest.find('#'); mark != std::string_view::npos; mark = rest.find('#', mark + 1)) {
            if (mark == 0 || kSpace.find(rest[mark - 1]) != std::string_view::npos) {
                rest = rest.substr(0, mark);
                break;
            }
        }
        const size_t begin = rest.find_first_not_of(kSpace);
        const size_t end = rest.find_last_not_of(kSpace);
        return begin == std::string_view::npos ? std::string_view() : rest.substr(begin, end + 1 - begin);
    }

private:
    static constexpr std::string_view kSpace = " \t\r\v\f";
    std::string_view line_;
    std::string_view rest_;
};

bool parseWhole(std::string_view word, auto& value) {
    if (!word.empty() && word.front() == '+') {
        word.remove_prefix(1);
    }
    const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() && !word.empty();
}

inline float toFloat(std::string_view word, const std::string& element) {
    double value = 0.0;
    if (word.empty()) {
        refuse(element, "a number is missing");
    }
    if (!parseWhole(word, value) || !std::isfinite(static_cast<float>(value))) {
        refuse(element, shortened(word) + " is not a finite number");
    }
    return static_cast<float>(value);
}

inline int64_t toInteger(std::string_view word, const std::string& element) {
    int64_t value = 0;
    if (!parseWhole(word, value)) {
        refuse(element, (word.empty() ? "an index is missing" : shortened(word) + " is not an index"));
    }
    return value;
}

} // namespace supple::cage::obj
