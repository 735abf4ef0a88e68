// Any recording: read to its end, or refused with a message.
#include "runtime/recording/recording_file.h"
#include "tests/fuzz/target.h"

#include <string>
#include <variant>

namespace supple::fuzz {
namespace {

/// Looks at every byte that an event has.
struct Look {
    uint64_t sum = 0;
    template <class T>
    void list(const T* values, uint32_t count) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(values); // NOLINT
        for (size_t i = 0; i < count * sizeof(T); ++i) {
            sum += bytes[i];
        }
    }
    void operator()(const runtime::calls::SetMatrixPose& call) { list(call.matrices, call.numberCount); }
    void operator()(const runtime::calls::SetMorphWeights& call) { list(call.weights, call.weightCount); }
    void operator()(const runtime::calls::SetPose& call) {
        list(call.pose.layers, call.pose.layerCount);
        for (uint32_t i = 0; i < call.pose.layerCount; ++i) {
            list(call.pose.layers[i].jointMask, call.pose.layers[i].jointMaskCount);
            list(call.pose.layers[i].morphMask, call.pose.layers[i].morphMaskCount);
        }
    }
    void operator()(const runtime::calls::SetPlayback& call) { list(call.playback.layers, call.playback.layerCount); }
    void operator()(const runtime::calls::SetModifiers& call) {
        list(call.modifiers.modifiers, call.modifiers.modifierCount);
    }
    void operator()(const runtime::calls::SetMask& call) {
        list(call.mask.jointMask, call.mask.jointMaskCount);
        list(call.mask.morphMask, call.mask.morphMaskCount);
    }
    void operator()(const runtime::calls::SetJointMatrices& call) {
        list(call.desc.jointMatrices, 16 * call.desc.jointCount);
        list(call.desc.joints, call.desc.joints != nullptr ? call.desc.jointCount : 0);
        list(call.desc.morphWeights, call.desc.morphTargetCount);
    }
    void operator()(const runtime::calls::CreateGroup& call) {
        list(call.desc.partSchemes, call.desc.partSchemeCount);
        list(call.desc.prep, call.desc.prep != nullptr ? 1 : 0);
    }
    void operator()(const runtime::calls::Record& call) { list(call.groups, call.groupCount); }
    void operator()(const runtime::calls::RecordWarmUp& call) { list(call.groups, call.groupCount); }
    template <class Call>
    void operator()(const Call&) {}

    void look(const runtime::RecordedAsset& asset) {
        list(asset.bytes, asset.byteCount);
        sum += std::char_traits<char>::length(asset.name);
    }
    void look(const runtime::Call& call) { std::visit(*this, call); }
    void look(const runtime::FrameHashes& hashes) { list(hashes.hashes, hashes.count); }
    void look(const runtime::RecordingEnd&) {}
};

} // namespace
} // namespace supple::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace supple;
    Result<runtime::RecordingReader> reader = runtime::RecordingReader::open(fuzz::bytesOf(data, size), "fuzz");
    fuzz::Look look;
    for (bool more = reader.ok(); more;) {
        const auto event = reader->next();
        fuzz::demand(event.ok() || !event.error().message.empty(), "an error without a message");
        more = event.ok() && event->has_value();
        if (more) {
            std::visit([&](const auto& one) { look.look(one); }, **event);
        }
    }
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateBytes, data, size, most, seed);
}
