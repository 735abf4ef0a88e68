#include "runtime/recording/recording_file.h"

#include <utility>

namespace supple::runtime {

namespace {

/// The call with a number, and its arguments. Null: there is no such call, or it has other arguments.
template <size_t... Numbers>
std::optional<Call> readCall(uint32_t number, CallReader& reader, std::index_sequence<Numbers...>) {
    std::optional<Call> call;
    const auto take = [&]<class C>(C value) {
        reader(value);
        call = value;
    };
    const bool known = ((number == Numbers && (take(std::variant_alternative_t<Numbers, Call>{}), true)) || ...);
    return known && reader.complete() ? call : std::nullopt;
}

/// The next chunk, which `left` then lacks. Null: there is no whole one.
std::optional<Chunk> takeChunk(std::span<const std::byte>& left) {
    ChunkHead head;
    if (left.size() < sizeof(head)) {
        return std::nullopt;
    }
    std::memcpy(&head, left.data(), sizeof(head));
    const uint64_t padded = (uint64_t{head.bytes} + kChunkAlignment - 1) / kChunkAlignment * kChunkAlignment;
    if (padded > left.size() - sizeof(head)) {
        return std::nullopt;
    }
    const Chunk chunk{head.kind, left.subspan(sizeof(head), head.bytes)};
    left = left.subspan(sizeof(head) + padded);
    return chunk;
}

} // namespace

void forEachHashes(std::span<const std::byte> chunks, const std::function<void(const FrameHashes&)>& tell) {
    while (const std::optional<Chunk> chunk = takeChunk(chunks)) {
        if (chunk->kind == ChunkKind::hashes) {
            CallMemory memory;
            FrameHashes hashes;
            CallReader reader(chunk->bytes, memory);
            reader(hashes);
            tell(hashes);
        }
    }
}

Result<RecordingReader> RecordingReader::open(std::span<const std::byte> bytes, const std::string& name) {
    RecordingReader made(bytes, name);
    const std::optional<Chunk> chunk = takeChunk(made.left_);
    char magic[std::size(kRecordingMagic)] = {};
    uint32_t version = 0;
    if (!chunk || chunk->kind != ChunkKind::header || chunk->bytes.size() < sizeof(magic) + sizeof(version)) {
        return Error{ErrorCode::asset, name + ": no recording"};
    }
    CallReader beginning(chunk->bytes.first(sizeof(magic) + sizeof(version)), *made.memory_);
    beginning(magic, version);
    if (!std::equal(std::begin(magic), std::end(magic), std::begin(kRecordingMagic))) {
        return Error{ErrorCode::asset, name + ": no recording"};
    }
    if (version < kOldestRecordingVersion || version > kRecordingVersion) {
        return Error{ErrorCode::asset, name + ": a recording of version " + std::to_string(version) +
                                           "; this library reads versions " + std::to_string(kOldestRecordingVersion) +
                                           " to " + std::to_string(kRecordingVersion)};
    }
    CallReader reader(chunk->bytes.subspan(sizeof(magic) + sizeof(version)), *made.memory_);
    reader(made.context_);
    if (!reader.complete() || made.context_.deviceName == nullptr) {
        return made.refused("the header is damaged");
    }
    made.deviceName_ = made.context_.deviceName;
    made.context_.deviceName = nullptr; // the string may move with the reader
    return made;
}

Error RecordingReader::refused(const std::string& reason) const {
    return {ErrorCode::asset, name_ + ": byte " + std::to_string(all_.size() - left_.size()) + ": " + reason};
}

Result<std::optional<RecordingEvent>> RecordingReader::next() {
    memory_->release();
    const std::optional<Chunk> chunk = takeChunk(left_);
    return chunk ? read(*chunk) : Result<std::optional<RecordingEvent>>(std::nullopt);
}

Result<std::optional<RecordingEvent>> RecordingReader::read(const Chunk& chunk) {
    using Event = std::optional<RecordingEvent>;
    CallReader reader(chunk.bytes, *memory_);
    switch (chunk.kind) {
    case ChunkKind::asset: {
        RecordedAsset asset;
        reader(asset);
        if (reader.complete()) {
            asset.name = asset.name != nullptr ? asset.name : "";
            return Event(asset);
        }
        return refused("a character is damaged");
    }
    case ChunkKind::call: {
        uint32_t number = 0;
        reader(number);
        const auto call = readCall(number, reader, std::make_index_sequence<std::variant_size_v<Call>>());
        return call ? Result<Event>(RecordingEvent(*call))
                    : refused(number < kCallNames.size() ? std::string(kCallNames[number]) + " is damaged"
                                                         : "no such call: " + std::to_string(number));
    }
    case ChunkKind::hashes: {
        FrameHashes hashes;
        reader(hashes);
        return reader.complete() ? Result<Event>(hashes) : refused("hashes are damaged");
    }
    case ChunkKind::end:
        return Event(RecordingEnd{});
    case ChunkKind::header:
        break;
    }
    return refused("no such chunk: " + std::to_string(static_cast<uint32_t>(chunk.kind)));
}

} // namespace supple::runtime
