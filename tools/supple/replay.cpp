// supple replay: makes the calls of a recording again, and compares what comes out.
#include "base/utf8_path.h"
#include "cage/gltf/uri.h"
#include "tools/replay/replayer.h"
#include "tools/supple/command.h"
#include "tools/supple/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <map>
#include <memory>
#include <utility>

namespace supple::tools {
namespace {

using runtime::HashedStage;
using runtime::StageHash;

struct ReplayOptions {
    std::string file;
    std::vector<std::string> characters;
    uint64_t until = 0; ///< 0: all frames
    bool printHashes = false;
    uint32_t memory = 4096; ///< MiB
    DeviceFlags device;
};

const char* nameOf(HashedStage stage) {
    switch (stage) {
    case HashedStage::palettes:
        return "joint palettes";
    case HashedStage::cages:
        return "deformed cages";
    case HashedStage::vertices:
        return "surface vertices";
    }
    return "unknown words";
}

/// 16 digits.
std::string textOf(const StageHash& hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%08" PRIx32 "%08" PRIx32, hash.sums[1], hash.sums[0]);
    return text;
}

bool areOfOne(const StageHash& a, const StageHash& b) {
    return a.group.id == b.group.id && a.stage == b.stage && a.surface == b.surface;
}

/// Compares the hashes of the recording with those of the replay, which come after them.
class Comparison {
public:
    explicit Comparison(const Replayer& replayer) : replayer_(replayer) {}

    void addRecorded(const runtime::FrameHashes& hashes) {
        recorded_[hashes.frame].assign(hashes.hashes, hashes.hashes + hashes.count);
        recordedCount_ += hashes.count;
    }
    void addReplayed(const ReplayedFrame& frame) {
        const auto found = recorded_.find(frame.number);
        if (found != recorded_.end()) {
            compare(frame, found->second);
            recorded_.erase(found);
        }
    }
    /// Hashes of the recording that have no counterpart.
    [[nodiscard]] size_t left() const { return recordedCount_ - compared_; }
    [[nodiscard]] size_t compared() const { return compared_; }
    [[nodiscard]] size_t differing() const { return differing_; }
    /// The first that differs: of the earliest frame, and in it of the first stage. Empty: none.
    [[nodiscard]] const std::string& first() const { return first_; }

private:
    void compare(const ReplayedFrame& frame, const std::vector<StageHash>& recorded) {
        const StageHash* worst = nullptr;
        std::string text;
        for (const StageHash& own : frame.hashes) {
            if (!replayer_.isComparable(own)) {
                continue;
            }
            const auto other = std::find_if(recorded.begin(), recorded.end(),
                                            [&](const StageHash& hash) { return areOfOne(hash, own); });
            if (other == recorded.end()) {
                continue;
            }
            ++compared_;
            if (std::equal(std::begin(own.sums), std::end(own.sums), other->sums)) {
                continue;
            }
            ++differing_;
            if (worst == nullptr || own.stage < worst->stage) {
                worst = &own;
                text = "frame " + std::to_string(frame.number) + ", " + replayer_.nameOf(own.group) + ": " +
                       nameOf(own.stage) + " are " + textOf(own) + ", recorded as " + textOf(*other);
            }
        }
        first_ = first_.empty() ? text : first_;
    }

    const Replayer& replayer_;
    std::map<uint64_t, std::vector<StageHash>> recorded_;
    size_t recordedCount_ = 0, compared_ = 0, differing_ = 0;
    std::string first_;
};

void print(const ReplayedFrame& frame, const Replayer& replayer) {
    for (const StageHash& hash : frame.hashes) {
        std::printf("frame %" PRIu64 ": %s  %s  %s", frame.number, textOf(hash).c_str(), nameOf(hash.stage),
                    printable(replayer.nameOf(hash.group)).c_str());
        if (hash.stage == HashedStage::vertices) {
            std::printf(", surface %" PRIu32, hash.surface);
        }
        std::printf("\n");
    }
}

/// Plays the events up to the frame that is asked for. True: the recording has an end.
Result<bool> playAll(runtime::RecordingReader& reader, Replayer& replayer, const ReplayOptions& options,
                     Comparison& comparison) {
    const auto takeHashes = [&] {
        for (const ReplayedFrame& frame : replayer.takeHashes()) {
            comparison.addReplayed(frame);
            if (options.printHashes) {
                print(frame, replayer);
            }
        }
    };
    bool ended = false, plays = true;
    while (!ended) {
        const Result<std::optional<runtime::RecordingEvent>> event = reader.next();
        if (!event) {
            return event.error();
        }
        if (!*event) {
            break;
        }
        ended = std::holds_alternative<runtime::RecordingEnd>(**event);
        // Hashes of the last frames that are asked for come behind the beginning of others.
        const auto* const hashes = std::get_if<runtime::FrameHashes>(&**event);
        if (hashes != nullptr && (options.until == 0 || hashes->frame <= options.until)) {
            comparison.addRecorded(*hashes);
        }
        const auto* const call = std::get_if<runtime::Call>(&**event);
        const auto* const begin = call != nullptr ? std::get_if<runtime::calls::BeginFrame>(call) : nullptr;
        plays = plays && (begin == nullptr || options.until == 0 || begin->frame <= options.until);
        if (plays) {
            const Status played = replayer.play(**event);
            if (!played) {
                return played.error();
            }
            takeHashes();
        }
    }
    const Status finished = replayer.finish();
    takeHashes();
    return finished ? Result<bool>(ended) : finished.error();
}

/// What went wrong, with the file's name.
Error ofFile(const std::string& path, const Error& error) {
    return {error.code, path + ": " + error.message};
}

Result<Replayer::Options> replayerOptions(const ReplayOptions& options) {
    Replayer::Options made;
    made.mapping = mappingOf(options.device);
    made.memory = VkDeviceSize{options.memory} << 20;
    for (const std::string& path : options.characters) {
        Result<std::vector<std::byte>> bytes = cage::gltf::readRegularFile(utf8Path(path));
        if (!bytes) {
            return ofFile(path, bytes.error());
        }
        made.characters.emplace_back(path, std::move(*bytes));
    }
    return made;
}

/// Where it was recorded, if that is elsewhere.
void tellPlaces(const runtime::RecordingReader& reader, const host::Device& device) {
    const VkPhysicalDeviceProperties& own = device.properties();
    const runtime::RecordedContext& recorded = reader.context();
    if (reader.deviceName() != device.name()) {
        note("recorded on " + printable(reader.deviceName()) + ", replayed on " + printable(device.name()));
    } else if (recorded.vendorId != own.vendorID || recorded.deviceId != own.deviceID ||
               recorded.driverVersion != own.driverVersion) {
        note("recorded with version " + std::to_string(recorded.driverVersion) + " of the driver, replayed with " +
             std::to_string(own.driverVersion));
    }
    if (recorded.libraryVersion != suppleGetVersion()) {
        note("recorded by version " + std::to_string(recorded.libraryVersion) + " of Supple, replayed by " +
             std::to_string(suppleGetVersion()));
    }
}

int report(const runtime::RecordingReader& reader, const Replayer& replayer, const Comparison& comparison,
           const host::Device& device) {
    for (const std::string& lack : replayer.lacks()) {
        warn("not in the recording: " + printable(lack));
    }
    if (comparison.compared() == 0) {
        note(std::to_string(replayer.frame()) + " frames; the recording has no hashes that could be compared");
        return kExitOk;
    }
    note("up to frame " + std::to_string(replayer.frame()) + ", " + std::to_string(comparison.compared()) +
         " hashes were compared, " + std::to_string(comparison.differing()) + " differ");
    if (comparison.left() > 0) {
        note(std::to_string(comparison.left()) + " hashes of the recording were not compared");
    }
    if (comparison.differing() == 0) {
        return kExitOk;
    }
    tellPlaces(reader, device);
    return fail(kExitGate, printable(comparison.first()));
}

int run(const ReplayOptions& options) {
    const Result<std::vector<std::byte>> bytes = cage::gltf::readRegularFile(utf8Path(options.file));
    if (!bytes) {
        return fail(ofFile(options.file, bytes.error()));
    }
    Result<runtime::RecordingReader> reader = runtime::RecordingReader::open(*bytes, options.file);
    if (!reader) {
        return fail(reader.error());
    }
    Result<Replayer::Options> own = replayerOptions(options);
    if (!own) {
        return fail(own.error());
    }
    Result<std::unique_ptr<host::Device>> device =
        host::Device::create({.device = options.device.device, .validation = options.device.validate});
    if (!device) {
        return fail(device.error());
    }
    Result<std::unique_ptr<Replayer>> replayer = Replayer::create(**device, reader->context(), std::move(*own));
    if (!replayer) {
        return fail(replayer.error());
    }
    Comparison comparison(**replayer);
    const Result<bool> ended = playAll(*reader, **replayer, options, comparison);
    if (!ended) {
        return fail(ofFile(options.file, ended.error()));
    }
    if (!*ended) {
        warn(options.file + ": the recording has no end, as after a crash: this was all that is whole");
    }
    if (const uint64_t messages = (*device)->validation()->messageCount(); messages != 0) {
        return fail(kExitBadInput, std::to_string(messages) + " validation messages");
    }
    return report(*reader, **replayer, comparison, **device);
}

} // namespace

void bindReplay(CLI::App& app, int& exitCode) {
    const auto options = std::make_shared<ReplayOptions>();
    CLI::App* const command = app.add_subcommand("replay", "make the calls of a recording again and compare hashes");
    command->add_option("file", options->file, "the recording (suppleStartRecording, --record)")->required();
    command->add_flag("--hash", options->printHashes, "print the hashes of every frame");
    command->add_option("--until", options->until, "the last frame to replay")->check(CLI::PositiveNumber);
    command->add_option("--characters", options->characters, "files that the recording was made without")
        ->delimiter(',');
    command->add_option("--memory", options->memory, "Most device memory, in MiB: small files can ask for much")
        ->capture_default_str();
    bindDevice(*command, options->device);
    command->callback([options, &exitCode] { exitCode = run(*options); });
}

} // namespace supple::tools
