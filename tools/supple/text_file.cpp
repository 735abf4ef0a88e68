#include "tools/supple/text_file.h"

#include <charconv>
#include <span>

namespace supple::tools {
namespace {

constexpr size_t kBlock = 1 << 20;

} // namespace

TextFile::TextFile(std::string path) : file_(std::move(path)) {
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

TextFile& TextFile::number(double value) {
    char digits[32];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    return text({digits, static_cast<size_t>(end - digits)});
}

TextFile& TextFile::number(uint64_t value) {
    char digits[32];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    return text({digits, static_cast<size_t>(end - digits)});
}

Status TextFile::close() {
    flush();
    return file_.close();
}

void TextFile::flush() {
    file_.write(std::as_bytes(std::span(pending_)));
    pending_.clear();
}

Status writeTextFile(const std::string& path, std::string_view text) {
    return TextFile(path).text(text).close();
}

} // namespace supple::tools
