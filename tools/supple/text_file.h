// A text file written piece by piece, for outputs too large to hold in memory. Independent of the locale.
#pragma once

#include "base/result.h"
#include "host/whole_file.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace supple::tools {

class TextFile {
public:
    explicit TextFile(std::string path);

    TextFile& text(std::string_view piece);
    /// As printf's %.9g: enough digits to read the same float back.
    TextFile& number(float value);
    /// The fewest digits that read the same double back.
    TextFile& number(double value);
    TextFile& number(uint64_t value);

    /// Writes what is left. Anything that went wrong on the way is reported here.
    [[nodiscard]] Status close();

private:
    void flush();

    host::WholeFile file_;
    std::string pending_;
};

/// Writes a whole file at once.
[[nodiscard]] Status writeTextFile(const std::string& path, std::string_view text);

} // namespace supple::tools
