#include "tools/supple/progress.h"

#include "base/utf8_path.h"
#include "host/operating_system.h"
#include "tools/common/formatted.h"
#include "tools/supple/command.h"

#include <cstdio>
#include <filesystem>
#include <system_error>

namespace supple::tools {

namespace {

bool atTerminal() {
    return host::isTerminal(stderr);
}

} // namespace

std::string_view lineBegin() {
    return atTerminal() ? "\r\x1b[K" : "";
}

void showProgress(std::string_view doing) {
    if (atTerminal()) {
        // Without wrapping, as only the last row of a line that wraps is taken back.
        std::fprintf(stderr, "\r\x1b[K\x1b[?7l%s ..\x1b[?7h", printable(doing).c_str());
        std::fflush(stderr);
    }
}

void showProgress(std::string_view doing, size_t number, size_t count) {
    showProgress(std::string(doing) + ", " + std::to_string(number) + " of " + std::to_string(count));
}

void endProgress() {
    std::fprintf(stderr, "%s", std::string(lineBegin()).c_str());
}

std::string sizeText(double bytes) {
    if (bytes < 1e3) {
        return formatted("%.0f bytes", bytes);
    }
    return bytes < 1e6   ? formatted("%.1f kB", 1e-3 * bytes)
           : bytes < 1e9 ? formatted("%.1f MB", 1e-6 * bytes)
                         : formatted("%.1f GB", 1e-9 * bytes);
}

void tellWritten(const std::string& path) {
    std::error_code failed;
    const uintmax_t bytes = std::filesystem::file_size(utf8Path(path), failed);
    if (atTerminal() && !failed) {
        std::fprintf(stderr, "%ssupple: wrote %s, %s\n", std::string(lineBegin()).c_str(), printable(path).c_str(),
                     sizeText(static_cast<double>(bytes)).c_str());
    }
}

} // namespace supple::tools
