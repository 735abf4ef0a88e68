#include "cage/message.h"

#include <cctype>
#include <cstdio>

namespace supple::cage {

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

std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::string oneLine(std::string text) {
    for (char& c : text) {
        if (std::iscntrl(static_cast<unsigned char>(c)) != 0) {
            c = '?';
        }
    }
    return text;
}

std::string Found::told(const char* one, const char* many) const {
    return counted(count, one, many) + (count == 1 ? ": " : ", the first is ") + first;
}

void warn(Warnings& warnings, const std::string& element, const std::string& reason) {
    warnings.push_back(element + ": " + reason);
}

} // namespace supple::cage
