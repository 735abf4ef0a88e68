#include "tests/support/recordings.h"

#include <gtest/gtest.h>
#include <supple/supple_recording.h>
#include <utility>
#include <variant>

namespace supple::test {

using runtime::RecordingReader;

SuppleResult Recorded::start(SuppleContext context, uint32_t flags) {
    SuppleRecordingDesc desc{};
    desc.structSize = sizeof desc;
    desc.flags = flags;
    desc.write = [](const void* from, size_t count, void* user) {
        auto& own = *static_cast<Recorded*>(user);
        const auto* first = static_cast<const std::byte*>(from);
        own.bytes.insert(own.bytes.end(), first, first + count);
        return own.refusedAfter-- > 0 ? 1 : 0;
    };
    desc.user = this;
    return suppleStartRecording(context, &desc);
}

namespace {

void put(Hashes& hashes, uint64_t frame, const runtime::StageHash& hash) {
    hashes[{frame, hash.group.id, static_cast<uint32_t>(hash.stage), hash.surface}] = {hash.sums[0], hash.sums[1]};
}

} // namespace

ReadRecording read(std::span<const std::byte> recording) {
    ReadRecording result;
    Result<RecordingReader> reader = RecordingReader::open(recording, "recording");
    EXPECT_TRUE(reader.ok());
    while (reader) {
        const auto event = reader->next();
        EXPECT_TRUE(event.ok()) << event.error().message;
        if (!event || !*event) {
            break;
        }
        if (const auto* const hashes = std::get_if<runtime::FrameHashes>(&**event)) {
            for (uint32_t i = 0; i < hashes->count; ++i) {
                put(result.hashes, hashes->frame, hashes->hashes[i]);
            }
        } else if (const auto* const call = std::get_if<runtime::Call>(&**event)) {
            result.calls.insert(call->index());
        }
        result.ended = std::holds_alternative<runtime::RecordingEnd>(**event);
    }
    return result;
}

Hashes replay(host::Device& device, std::span<const std::byte> recording, tools::Replayer::Options options) {
    Hashes hashes;
    Result<RecordingReader> reader = RecordingReader::open(recording, "recording");
    if (!reader) {
        ADD_FAILURE() << reader.error().message;
        return hashes;
    }
    auto replayer = tools::Replayer::create(device, reader->context(), std::move(options));
    if (!replayer) {
        ADD_FAILURE() << replayer.error().message;
        return hashes;
    }
    Status status = success();
    while (status) {
        const auto event = reader->next();
        if (!event) {
            ADD_FAILURE() << event.error().message;
            break;
        }
        if (!*event) {
            break;
        }
        status = (*replayer)->play(**event);
    }
    status = status ? (*replayer)->finish() : status;
    EXPECT_TRUE(status.ok()) << status.error().message;
    for (const tools::ReplayedFrame& frame : (*replayer)->takeHashes()) {
        for (const runtime::StageHash& hash : frame.hashes) {
            put(hashes, frame.number, hash);
        }
    }
    return hashes;
}

size_t expectSame(const Hashes& recorded, const Hashes& replayed) {
    size_t compared = 0;
    for (const auto& [key, sums] : recorded) {
        const auto found = replayed.find(key);
        if (found == replayed.end()) {
            continue;
        }
        ++compared;
        EXPECT_EQ(found->second, sums) << "frame " << std::get<0>(key) << ", group " << std::get<1>(key) << ", stage "
                                       << std::get<2>(key) << ", surface " << std::get<3>(key);
    }
    return compared;
}

ReadRecording expectReplayed(const Recorded& recorded, size_t least, std::span<const SuppleMapping> mappings) {
    ReadRecording own = read(recorded.bytes);
    EXPECT_TRUE(own.ended);
    EXPECT_GE(own.hashes.size(), least);
    for (const SuppleMapping mapping : mappings) {
        SCOPED_TRACE(mappingName(mapping));
        tools::Replayer::Options options;
        options.mapping = mapping;
        EXPECT_EQ(expectSame(own.hashes, replay(*testDevice(), recorded.bytes, std::move(options))), own.hashes.size());
    }
    return own;
}

ReadRecording expectReplayed(SuppleContext context, const Recorded& recorded, size_t least,
                             std::span<const SuppleMapping> mappings) {
    EXPECT_EQ(suppleStopRecording(context), SUPPLE_OK);
    return expectReplayed(recorded, least, mappings);
}

void expectReplayedFrom(uint32_t begins, uint32_t ends, CrowdContext& context,
                        const std::function<void(uint32_t first, uint32_t last)>& run, size_t least) {
    SCOPED_TRACE(begins);
    run(0, begins);
    Recorded recorded;
    context.beginFrame();
    ASSERT_EQ(recorded.start(context.handle()), SUPPLE_OK);
    run(begins, ends);
    context.beginFrame(); // the last ones are complete
    context.beginFrame();
    expectReplayed(context.handle(), recorded, least);
}

} // namespace supple::test
