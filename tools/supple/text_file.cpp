#include "tools/supple/text_file.h"

#include <charconv>

namespace supple::tools {
namespace {

constexpr size_t kBlock = 1 << 20;

} // namespace

TextFile::TextFile(std::string path) : path_(std::move(path)), stream_(path_, std::ios::binary | std::ios::trunc) {
    pending_.reserve(kBlock + 256);
}

TextFile& TextFile::text(std::string_view piece) {
    pending_ += piece;
    if (pending_.size() >= kBlock) {
        flush();
    }
    return *this;
}

TextFile& TextFile::number(float value) {
    char digits[32];
    const auto [end, error] =
        std::to_chars(digits, digits + sizeof digits, static_cast<double>(value), std::chars_format::general, 9);
    return text({digits, static_cast<size_t>(end - digits)});
}

TextFile& TextFile::number(uint64_t value) {
    char digits[32];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    return text({digits, static_cast<size_t>(end - digits)});
}

Status TextFile::close() {
    flush();
    stream_.close();
    if (!stream_) {
        return Error{ErrorCode::io, path_ + ": cannot be written"};
    }
    return success();
}

void TextFile::flush() {
    stream_.write(pending_.data(), static_cast<std::streamsize>(pending_.size()));
    pending_.clear();
}

Status writeTextFile(const std::string& path, std::string_view text) {
    return TextFile(path).text(text).close();
}

} // namespace supple::tools
