// Any recording, made again: every call of it comes back, and what does not fit ends it with a message.
#include "host/device.h"
#include "tests/fuzz/kept_pipelines.h"
#include "tests/fuzz/target.h"
#include "tools/replay/replayer.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace supple::fuzz {
namespace {

constexpr VkDeviceSize kMostMemory = VkDeviceSize{48} << 20;
constexpr uint32_t kMostFrames = 6; ///< the device takes its time for each

struct EndDevice {
    void operator()(host::Device* device) const {
        destroyKeptPipelines(device->handle());
        delete device;
    }
};

host::Device& device() {
    static const std::unique_ptr<host::Device, EndDevice> made = [] {
        host::DeviceOptions options;
        options.suppleGetInstanceProcAddr = &keepingGetInstanceProcAddr;
        Result<std::unique_ptr<host::Device>> result = host::Device::create(options);
        demand(result.ok(), "no device");
        return std::unique_ptr<host::Device, EndDevice>(result->release());
    }();
    return *made;
}

/// Frames that the event begins.
uint32_t framesIn(const runtime::RecordingEvent& event) {
    const auto* const call = std::get_if<runtime::Call>(&event);
    return call != nullptr && std::holds_alternative<runtime::calls::BeginFrame>(*call) ? 1 : 0;
}

void replayAll(runtime::RecordingReader& reader) {
    tools::Replayer::Options options;
    options.memory = kMostMemory;
    Result<std::unique_ptr<tools::Replayer>> replayer =
        tools::Replayer::create(device(), reader.context(), std::move(options));
    demand(replayer.ok(), "no replay of a recording whose header is sound");
    Status status = success();
    for (uint32_t frames = 0; status && frames <= kMostFrames;) {
        const auto event = reader.next();
        if (!event || !*event) {
            break;
        }
        frames += framesIn(**event);
        status = (*replayer)->play(**event);
        (void)(*replayer)->takeHashes();
    }
    demand(status || !status.error().message.empty(), "an error without a message");
    status = (*replayer)->finish();
    demand(status || !status.error().message.empty(), "an error without a message");
}

/// The chunks behind the header, each with its padding.
std::vector<std::vector<uint8_t>> chunksOf(const uint8_t* data, size_t size) {
    std::vector<std::vector<uint8_t>> chunks;
    for (size_t at = 0; at + sizeof(runtime::ChunkHead) <= size;) {
        runtime::ChunkHead head;
        std::memcpy(&head, data + at, sizeof head);
        const size_t padded =
            (size_t{head.bytes} + runtime::kChunkAlignment - 1) / runtime::kChunkAlignment * runtime::kChunkAlignment;
        if (padded > size - at - sizeof head) {
            break;
        }
        chunks.emplace_back(data + at, data + at + sizeof head + padded);
        at += sizeof head + padded;
    }
    return chunks;
}

/// Leaves calls out, makes them twice, in another order, with other arguments.
std::vector<uint8_t> mutateCalls(const uint8_t* data, size_t size, Random& random) {
    std::vector<std::vector<uint8_t>> chunks = chunksOf(data, size);
    if (chunks.size() < 3) {
        return {};
    }
    const auto any = [&] { return 1 + random() % (chunks.size() - 1); }; // but for the header
    for (uint32_t change = 1 + random() % 4; change > 0 && chunks.size() > 2; --change) {
        const size_t at = any();
        std::vector<uint8_t>& chunk = chunks[at];
        switch (random() % 4) {
        case 0:
            chunks.erase(chunks.begin() + static_cast<ptrdiff_t>(at));
            break;
        case 1: {
            const std::vector<uint8_t> copy = chunk;
            chunks.insert(chunks.begin() + static_cast<ptrdiff_t>(any()), copy);
            break;
        }
        case 2:
            std::swap(chunk, chunks[any()]);
            break;
        default:
            if (chunk.size() > sizeof(runtime::ChunkHead) + sizeof(uint32_t)) { // behind the call's number
                constexpr size_t kFirst = sizeof(runtime::ChunkHead) + sizeof(uint32_t);
                chunk[kFirst + random() % (chunk.size() - kFirst)] = static_cast<uint8_t>(random());
            }
            break;
        }
    }
    std::vector<uint8_t> all;
    for (const std::vector<uint8_t>& chunk : chunks) {
        all.insert(all.end(), chunk.begin(), chunk.end());
    }
    return all;
}

} // namespace
} // namespace supple::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace supple;
    Result<runtime::RecordingReader> reader = runtime::RecordingReader::open(fuzz::bytesOf(data, size), "fuzz");
    if (reader) {
        fuzz::replayAll(*reader);
    }
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateCalls, data, size, most, seed);
}
