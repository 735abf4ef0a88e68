#include "host/recording.h"

#include "host/whole_file.h"

namespace supple::host {

Result<std::unique_ptr<Recording>> Recording::start(SuppleContext context, const std::string& path, uint32_t flags) {
    if (isRefusedLink(path)) {
        return Error{ErrorCode::io, path + ": is a symbolic link"};
    }
    std::unique_ptr<Recording> made(new Recording(path));
    if (!made->file_) {
        return Error{ErrorCode::io, path + ": cannot be written"};
    }
    SuppleRecordingDesc desc{};
    desc.structSize = sizeof desc;
    desc.flags = SUPPLE_RECORDING_HASHES | flags;
    desc.write = write;
    desc.user = made.get();
    const SuppleResult result = suppleStartRecording(context, &desc);
    if (result != SUPPLE_OK) {
        return Error{ErrorCode::argument, path + ": " + suppleResultString(result)};
    }
    return made;
}

int Recording::write(const void* bytes, size_t count, void* user) {
    std::ofstream& file = static_cast<Recording*>(user)->file_;
    file.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
    file.flush(); // what is written outlives a crash
    return file ? 1 : 0;
}

} // namespace supple::host
