// A recording of a context in a file: supple_recording.h. `supple replay` makes the calls again.
#pragma once

#include "base/result.h"
#include "base/utf8_path.h"

#include <fstream>
#include <memory>
#include <string>
#include <supple/supple.h>

namespace supple::host {

class Recording {
public:
    /// Records all that is done to the context from now on, with hashes. The context must be fresh, and must end, or
    /// end its recording, before this does. `flags`: SuppleRecordingFlags besides.
    [[nodiscard]] static Result<std::unique_ptr<Recording>> start(SuppleContext context, const std::string& path,
                                                                  uint32_t flags = 0);

private:
    explicit Recording(const std::string& path) : file_(utf8Path(path), std::ios::binary) {}
    static int write(const void* bytes, size_t count, void* user);

    std::ofstream file_;
};

} // namespace supple::host
