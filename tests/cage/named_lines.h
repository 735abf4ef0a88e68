// What every refusal looks like.
#pragma once

#include <cctype>
#include <sstream>
#include <string>

namespace supple::test {

/// Whether every line of a message begins with the file's name, says more, and has no control characters.
inline bool isLinesAbout(const std::string& name, const std::string& message) {
    std::istringstream lines(message);
    size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        if (!line.starts_with(name + ": ") || line.size() == name.size() + 2) {
            return false;
        }
        for (const char c : line) {
            if (std::iscntrl(static_cast<unsigned char>(c)) != 0) {
                return false;
            }
        }
    }
    return count > 0 && !message.ends_with('\n');
}

} // namespace supple::test
