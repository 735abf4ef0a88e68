// supple replay: makes the calls of a recording again, and compares what comes out.
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
    case HashedStage::count:
        break;
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

/// Compares the hashes of the recording with those of the replay, as both come in.
class Comparison {
public:
    explicit Comparison(const Replayer& replayer) : replayer_(replayer) {}

    void addRecorded(const runtime::FrameHashes& hashes) {
        recorded_[hashes.frame].assign(hashes.hashes, hashes.hashes + hashes.count);
    }
    void addReplayed(const ReplayedFrame& frame) {
        const auto found = recorded_.find(frame.number);
        if (found == recorded_.end()) {
            waiting_.push_back(frame);
            return;
        }
        compare(frame, found->second);
        recorded_.erase(found);
    }
    /// What came before its counterpart.
    void settle() {
        const std::vector<ReplayedFrame> waiting = std::exchange(waiting_, {});
        std::for_each(waiting.begin(), waiting.end(), [&](const ReplayedFrame& frame) { addReplayed(frame); });
    }
    [[nodiscard]] size_t compared() const { return compared_; }
    [[nodiscard]] size_t differing() const { return differing_; }
    /// The first that differs: of the earliest frame, and in it of the first stage. Empty: none.
    [[nodiscard]] const std::string& first() const { return first_; }

private:
    void compare(const ReplayedFrame& frame, const std::vector<StageHash>& recorded) {
        const StageHash* worst = nullptr;
        std::string text;
        for (const StageHash& own : frame.hashes) {
            if (replayer_.isFilledByHost(own.group)) {
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
    std::vector<ReplayedFrame> waiting_;
    size_t compared_ = 0, differing_ = 0;
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

/// Plays the events up to the frame that is asked for.
Status playAll(runtime::RecordingReader& reader, Replayer& replayer, const ReplayOptions& options,
               Comparison& comparison) {
    const auto takeHashes = [&] {
        for (const ReplayedFrame& frame : replayer.takeHashes()) {
            comparison.addReplayed(frame);
            if (options.printHashes) {
                print(frame, replayer);
            }
        }
    };
    bool ended = false;
    while (!ended) {
        const Result<std::optional<runtime::RecordingEvent>> event = reader.next();
        if (!event) {
            return event.error();
        }
        if (!*event) {
            break;
        }
        if (const auto* const hashes = std::get_if<runtime::FrameHashes>(&**event)) {
            comparison.addRecorded(*hashes);
            comparison.settle();
        }
        const auto* const call = std::get_if<runtime::Call>(&**event);
        const auto* const begin = call != nullptr ? std::get_if<runtime::calls::BeginFrame>(call) : nullptr;
        if (begin != nullptr && options.until != 0 && begin->frame > options.until) {
            break;
        }
        const Status played = replayer.play(**event);
        if (!played) {
            return played;
        }
        takeHashes();
        ended = std::holds_alternative<runtime::RecordingEnd>(**event);
    }
    const Status finished = replayer.finish();
    takeHashes();
    return finished;
}

Result<Replayer::Options> replayerOptions(const ReplayOptions& options) {
    Replayer::Options made;
    made.mapping = mappingOf(options.device);
    for (const std::string& path : options.characters) {
        Result<std::vector<std::byte>> bytes = cage::gltf::readRegularFile(path);
        if (!bytes) {
            return bytes.error();
        }
        made.characters.emplace_back(path, std::move(*bytes));
    }
    return made;
}

int report(const runtime::RecordingReader& reader, const Replayer& replayer, const Comparison& comparison,
           const host::Device& device) {
    for (const std::string& lack : replayer.lacks()) {
        warn("not in the recording: " + printable(lack));
    }
    if (reader.isCut()) {
        warn("the recording is cut off, as after a crash: this was all that is whole");
    }
    if (comparison.compared() == 0) {
        note(std::to_string(replayer.frame()) + " frames; the recording has no hashes to compare");
        return kExitOk;
    }
    note("up to frame " + std::to_string(replayer.frame()) + ", " + std::to_string(comparison.compared()) +
         " hashes were compared, " + std::to_string(comparison.differing()) + " differ");
    if (comparison.differing() == 0) {
        return kExitOk;
    }
    if (reader.deviceName() != device.name()) {
        note("recorded on " + printable(reader.deviceName()) + ", replayed on " + printable(device.name()));
    }
    return fail(kExitGate, printable(comparison.first()));
}

int run(const ReplayOptions& options) {
    const Result<std::vector<std::byte>> bytes = cage::gltf::readRegularFile(options.file);
    if (!bytes) {
        return fail(bytes.error());
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
    const Status played = playAll(*reader, **replayer, options, comparison);
    if (!played) {
        return fail({played.error().code, options.file + ": " + played.error().message});
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
    bindDevice(*command, options->device);
    command->callback([options, &exitCode] { exitCode = run(*options); });
}

} // namespace supple::tools
