// Bytes that several owners share: images of one file may lie on the same ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace supple::cage {

/// Some of the bytes of a list that lives as long as anybody has any of them.
class SharedBytes {
public:
    SharedBytes() = default;
    SharedBytes(std::vector<std::byte> bytes)
        : owner_(std::make_shared<const std::vector<std::byte>>(std::move(bytes))), bytes_(*owner_) {}

    /// The same list's bytes; the range must lie within.
    [[nodiscard]] SharedBytes part(size_t offset, size_t count) const {
        SharedBytes some = *this;
        some.bytes_ = bytes_.subspan(offset, count);
        return some;
    }

    [[nodiscard]] const std::byte* data() const { return bytes_.data(); }
    [[nodiscard]] size_t size() const { return bytes_.size(); }
    [[nodiscard]] bool empty() const { return bytes_.empty(); }
    [[nodiscard]] auto begin() const { return bytes_.begin(); }
    [[nodiscard]] auto end() const { return bytes_.end(); }
    operator std::span<const std::byte>() const { return bytes_; }

    bool operator==(const SharedBytes& other) const { return std::equal(begin(), end(), other.begin(), other.end()); }

private:
    std::shared_ptr<const std::vector<std::byte>> owner_;
    std::span<const std::byte> bytes_;
};

} // namespace supple::cage
