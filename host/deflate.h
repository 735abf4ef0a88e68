// Blocks of a deflate stream (RFC 1951), each compressed by itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace supple::host {

/// Appends the bytes as a block of fixed codes and fills up the last byte, so that another block can follow.
void appendDeflateBlock(std::span<const uint8_t> bytes, std::vector<uint8_t>& out);
/// Appends the empty block that ends a stream.
void appendLastDeflateBlock(std::vector<uint8_t>& out);

} // namespace supple::host
