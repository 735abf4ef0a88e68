#include "host/png_writer.h"

#include "host/deflate.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace supple::host {
namespace {

constexpr size_t kChannels = 3;
constexpr long kFirstRows = 8 + 25; ///< behind the signature and the header's chunk

void appendBig(std::vector<uint8_t>& bytes, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<uint8_t>(value >> shift));
}

uint32_t crc(const uint8_t* bytes, size_t count) {
    static const std::array<uint32_t, 256> kTable = [] {
        std::array<uint32_t, 256> table{};
        for (uint32_t n = 0; n < 256; ++n) {
            table[n] = n;
            for (int bit = 0; bit < 8; ++bit)
                table[n] = (table[n] & 1u) != 0 ? 0xEDB88320u ^ (table[n] >> 1) : table[n] >> 1;
        }
        return table;
    }();
    uint32_t value = 0xFFFFFFFFu;
    for (size_t i = 0; i < count; ++i)
        value = kTable[(value ^ bytes[i]) & 0xFFu] ^ (value >> 8);
    return ~value;
}

void appendChunk(std::vector<uint8_t>& file, const char* type, const std::vector<uint8_t>& data) {
    appendBig(file, static_cast<uint32_t>(data.size()));
    const size_t begin = file.size();
    file.insert(file.end(), type, type + 4);
    file.insert(file.end(), data.begin(), data.end());
    appendBig(file, crc(&file[begin], file.size() - begin));
}

std::vector<uint8_t> beginning(uint32_t width, uint32_t height) {
    std::vector<uint8_t> file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'}, header;
    appendBig(header, width);
    appendBig(header, height);
    header.insert(header.end(), {8, 2, 0, 0, 0}); // 8 bits of RGB, not interlaced
    appendChunk(file, "IHDR", header);
    return file;
}

uint8_t paeth(int left, int up, int corner) {
    const int guess = left + up - corner;
    const int toLeft = std::abs(guess - left), toUp = std::abs(guess - up), toCorner = std::abs(guess - corner);
    return static_cast<uint8_t>(toLeft <= toUp && toLeft <= toCorner ? left : toUp <= toCorner ? up : corner);
}

/// A row's bytes less what the filter foretells: 0 nothing, 1 the pixel to the left, 2 the one above, 4 Paeth's.
void filterRow(int filter, const std::vector<uint8_t>& row, const std::vector<uint8_t>& above,
               std::vector<uint8_t>& out) {
    for (size_t i = 0; i < row.size(); ++i) {
        const int left = i < kChannels ? 0 : row[i - kChannels], corner = i < kChannels ? 0 : above[i - kChannels];
        const int foretold = filter == 0   ? 0
                             : filter == 1 ? left
                             : filter == 2 ? above[i]
                                           : paeth(left, above[i], corner);
        out[i] = static_cast<uint8_t>(row[i] - foretold);
    }
}

/// The filter with the smallest sum of magnitudes, as the specification suggests, and the row behind it.
void appendRow(const std::vector<uint8_t>& row, const std::vector<uint8_t>& above, std::vector<uint8_t>& out) {
    std::vector<uint8_t> best, tried(row.size());
    uint64_t least = std::numeric_limits<uint64_t>::max();
    for (const int filter : {0, 1, 2, 4}) {
        filterRow(filter, row, above, tried);
        uint64_t sum = 0;
        for (const uint8_t byte : tried)
            sum += static_cast<uint64_t>(std::abs(static_cast<int8_t>(byte)));
        if (sum < least) {
            least = sum;
            best = {static_cast<uint8_t>(filter)};
            best.insert(best.end(), tried.begin(), tried.end());
        }
    }
    out.insert(out.end(), best.begin(), best.end());
}

uint32_t addToAdler(uint32_t adler, const std::vector<uint8_t>& bytes) {
    uint32_t low = adler & 0xFFFFu, high = adler >> 16;
    for (const uint8_t byte : bytes) {
        low = (low + byte) % 65521u;
        high = (high + low) % 65521u;
    }
    return high << 16 | low;
}

} // namespace

Status PngWriter::append(const Picture& rows) {
    if (rows.width != width_)
        return Error{ErrorCode::argument, path_ + ": rows of another width"};
    std::vector<uint8_t> filtered;
    lastRow_.resize(kChannels * width_);
    for (uint32_t y = 0; y < rows.height; ++y) {
        std::vector<uint8_t> row(kChannels * width_);
        for (uint32_t x = 0; x < width_; ++x)
            std::memcpy(&row[kChannels * x], rows.pixel(x, y), kChannels);
        appendRow(row, lastRow_, filtered);
        lastRow_ = std::move(row);
    }
    adler_ = addToAdler(adler_, filtered);
    height_ += rows.height;

    std::vector<uint8_t> compressed, last, chunks;
    if (file_ == nullptr)
        compressed = {0x78, 0x01}; // the stream's header: deflate, a window of 32 KiB
    appendDeflateBlock(filtered, compressed);
    appendChunk(chunks, "IDAT", compressed);
    const auto rowBytes = static_cast<long>(chunks.size());
    appendLastDeflateBlock(last);
    appendBig(last, adler_);
    appendChunk(chunks, "IDAT", last);
    appendChunk(chunks, "IEND", {});

    if (file_ == nullptr) {
        file_.reset(std::fopen(path_.c_str(), "wb"));
        end_ = kFirstRows;
    }
    // The height last: until then, the rows that it does not count are ignored.
    if (const Status status = write(chunks, end_); !status)
        return status.error();
    if (const Status status = write(beginning(width_, height_), 0); !status)
        return status.error();
    end_ += rowBytes;
    return success();
}

Status PngWriter::write(const std::vector<uint8_t>& bytes, long place) {
    if (!file_ || std::fseek(file_.get(), place, SEEK_SET) != 0 ||
        std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size() || std::fflush(file_.get()) != 0)
        return Error{ErrorCode::io, path_ + ": " + std::strerror(errno)};
    return success();
}

} // namespace supple::host
