#include "tools/supple/whole_file.h"

#include <filesystem>
#include <fstream>
#include <system_error>
#include <unistd.h>

namespace supple::tools {

Status writeWhole(const std::string& path, std::span<const std::byte> bytes) {
    const std::string temporary = path + "." + std::to_string(getpid()) + ".tmp";
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    std::error_code error;
    if (stream) {
        std::filesystem::rename(temporary, path, error);
        if (!error) {
            return success();
        }
    }
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    return Error{ErrorCode::io, path + ": cannot be written" + (error ? ": " + error.message() : "")};
}

} // namespace supple::tools
