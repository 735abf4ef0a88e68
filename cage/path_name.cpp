#include "cage/path_name.h"

#include "base/utf8.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace supple::cage {
namespace {

/// Windows finds the device also behind an ending: NUL.png is NUL.
bool isDeviceName(std::string_view name) {
    std::string stem(name.substr(0, name.find('.')));
    stem.erase(stem.find_last_not_of(' ') + 1);
    std::transform(stem.begin(), stem.end(), stem.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    constexpr std::string_view kDevices[] = {"AUX", "CON", "CONIN$", "CONOUT$", "NUL", "PRN"};
    if (std::find(std::begin(kDevices), std::end(kDevices), stem) != std::end(kDevices)) {
        return true;
    }
    if (!stem.starts_with("COM") && !stem.starts_with("LPT")) {
        return false;
    }
    // The digits 1, 2 and 3 count in superscript as well.
    constexpr std::string_view kRaised[] = {"\xC2\xB9", "\xC2\xB2", "\xC2\xB3"};
    const std::string_view number = std::string_view(stem).substr(3);
    return (number.size() == 1 && number[0] >= '0' && number[0] <= '9') ||
           std::find(std::begin(kRaised), std::end(kRaised), number) != std::end(kRaised);
}

} // namespace

std::string whyRefusedName(std::string_view name) {
    const auto isControl = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
    if (const auto found = std::find_if(name.begin(), name.end(), isControl); found != name.end()) {
        return *found == '\0' ? "path contains a NUL character" : "path contains a control character";
    }
    if (!isUtf8(name)) {
        return "path is not UTF-8";
    }
    if (name.find(':') != std::string_view::npos) {
        return "path contains a colon, which means a drive or a stream on Windows";
    }
    if (isDeviceName(name)) {
        return "path names a device of Windows";
    }
    const bool isFolder = name == "." || name == "..";
    if (!name.empty() && !isFolder && (name.back() == '.' || name.back() == ' ')) {
        return "path has a name that ends in a dot or a space, which Windows leaves out";
    }
    return {};
}

} // namespace supple::cage
