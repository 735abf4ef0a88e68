#include "host/whole_file.h"

#include "base/utf8_path.h"
#include "host/operating_system.h"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace supple::host {

namespace fs = std::filesystem;

namespace {

/// A device or a pipe.
bool isSpecial(const std::string& path) {
    std::error_code error;
    const fs::file_status target = fs::status(utf8Path(path), error);
    return fs::exists(target) && !fs::is_regular_file(target) && !fs::is_directory(target);
}

} // namespace

bool isRefusedLink(const std::string& path) {
    std::error_code error;
    return !isSpecial(path) && fs::is_symlink(fs::symlink_status(utf8Path(path), error));
}

WholeFile::WholeFile(std::string path) : path_(std::move(path)) {
    if (isRefusedLink(path_)) {
        refusal_ = "is a symbolic link";
        return;
    }
    const bool special = isSpecial(path_);
    if (!special) {
        temporary_ = path_ + "." + std::to_string(processId()) + ".tmp";
    }
    errno = 0;
    stream_.open(utf8Path(special ? path_ : temporary_), std::ios::binary | std::ios::trunc);
    if (!stream_) {
        refusal_ = "cannot be written" + (errno != 0 ? ": " + std::generic_category().message(errno) : "");
        temporary_.clear();
    }
}

WholeFile::~WholeFile() {
    if (!temporary_.empty()) {
        std::error_code ignored;
        fs::remove(utf8Path(temporary_), ignored);
    }
}

void WholeFile::write(std::span<const std::byte> bytes) {
    if (refusal_.empty()) {
        stream_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
}

Status WholeFile::status() const {
    return refusal_.empty() ? success() : Status(Error{ErrorCode::io, path_ + ": " + refusal_});
}

Status WholeFile::close() {
    if (Status open = status(); !open) {
        return open;
    }
    errno = 0;
    stream_.close();
    std::error_code error;
    if (!stream_) {
        error = {errno, std::generic_category()};
    } else if (!temporary_.empty()) {
        fs::rename(utf8Path(temporary_), utf8Path(path_), error);
    }
    if (!stream_ || error) {
        return Error{ErrorCode::io, path_ + ": cannot be written" + (error ? ": " + error.message() : "")};
    }
    temporary_.clear();
    return success();
}

Status writeWhole(const std::string& path, std::span<const std::byte> bytes) {
    WholeFile file(path);
    file.write(bytes);
    return file.close();
}

} // namespace supple::host
