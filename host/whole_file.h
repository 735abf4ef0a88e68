// A file written all or nothing.
#pragma once

#include "base/result.h"

#include <cstddef>
#include <fstream>
#include <span>
#include <string>

namespace supple::host {

/// A file beside the target takes its place when it is complete. Devices and pipes are written to as they are. Symbolic
/// links are refused: they lead to files that nobody named.
class WholeFile {
public:
    explicit WholeFile(std::string path);
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;
    ~WholeFile(); ///< what is not closed leaves nothing behind

    /// An error if the file cannot be written at all.
    [[nodiscard]] Status status() const;
    void write(std::span<const std::byte> bytes);
    /// Anything that went wrong on the way is reported here.
    [[nodiscard]] Status close();

private:
    std::string path_;
    std::string temporary_; ///< empty: the target itself is written
    std::string refusal_;
    std::ofstream stream_;
};

/// Whether the path is a symbolic link that WholeFile refuses. A link to a device or a pipe is none.
[[nodiscard]] bool isRefusedLink(const std::string& path);

[[nodiscard]] Status writeWhole(const std::string& path, std::span<const std::byte> bytes);

} // namespace supple::host
