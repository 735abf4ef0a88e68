// What a person at a terminal sees of work that takes long. Elsewhere nothing is printed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace supple::tools {

/// One line of stderr that says what is being done, in the place of the one before.
void showProgress(std::string_view doing);
/// With how far it has come: "drawing frames, 12 of 55".
void showProgress(std::string_view doing, size_t number, size_t count);
/// The line goes.
void endProgress();
/// endProgress() for whoever prints a line of his own on stderr. Empty if stderr is no terminal.
[[nodiscard]] std::string_view lineBegin();

/// Behind the work: "supple: wrote FILE, 1.2 MB", in place of the line.
void tellWritten(const std::string& path);

/// "999 bytes", "1.2 kB", "34.5 MB".
[[nodiscard]] std::string sizeText(double bytes);

} // namespace supple::tools
