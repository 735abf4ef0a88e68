// How much memory a file may ask for.
#pragma once

#include <cstdint>
#include <string>

namespace supple::cage {

/// Reading takes this much for each byte of a file, and kBaseMemory. Measured: no character of 185 needs more than 6 MB
/// and 5 bytes a byte; a mesh of bare positions with 16-bit indices needs 30.
inline constexpr uint64_t kMemoryPerByte = 64;
inline constexpr uint64_t kBaseMemory = 16u << 20;

/// What reading one file may take. Elements of a file may share bytes or have none, so its size does not bound what is
/// built from it; whoever builds asks here first. What is asked for is an estimate from above of what is then held at a
/// time.
class MemoryBudget {
public:
    /// `limit`: in bytes; 0: in proportion to the file.
    explicit MemoryBudget(uint64_t limit = 0) : given_(limit) {}

    /// The file has these bytes, or they come from another that it names.
    void addFile(uint64_t bytes) { fileBytes_ += bytes; }
    /// For `element`. Throws Refusal.
    void take(uint64_t bytes, const std::string& element);
    /// The same for `count` things.
    void take(uint64_t count, uint64_t bytesEach, const std::string& element);

    /// For what is given back before anything else is taken. Throws Refusal.
    void check(uint64_t bytes, const std::string& element) const;

    [[nodiscard]] uint64_t limit() const { return given_ != 0 ? given_ : kBaseMemory + kMemoryPerByte * fileBytes_; }

private:
    uint64_t given_ = 0;
    uint64_t fileBytes_ = 0;
    uint64_t taken_ = 0;
};

} // namespace supple::cage
