// supple profile: what every pass of a frame takes, over many frames; what changed since an earlier result, or between
// two builds.
#include "base/utf8_path.h"
#include "tools/common/character_file.h"
#include "tools/common/machine.h"
#include "tools/supple/command.h"
#include "tools/supple/output_files.h"
#include "tools/supple/profile_compare.h"
#include "tools/supple/profile_frames.h"
#include "tools/supple/profile_page.h"
#include "tools/supple/profile_report.h"
#include "tools/supple/profile_rounds.h"
#include "tools/supple/profile_sweep.h"
#include "tools/supple/progress.h"
#include "tools/supple/session.h"
#include "tools/supple/text_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

namespace supple::tools {
namespace {

/// What two runs at different times may differ by where the device is a CPU that others use too.
constexpr double kFloorOnCpu = 0.5;

std::string dump(const nlohmann::ordered_json& json, int indent) {
    return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Status writeForms(const ProfileOptions& options, const Machine& machine, const std::vector<ProfileRun>& runs,
                  const std::vector<RunChange>& changes) {
    Status status = success();
    if (!options.json.empty()) {
        nlohmann::ordered_json result = toJson(machine, runs);
        if (!options.compare.empty()) {
            result["comparison"] = toJson(changes);
        }
        status = writeTextFile(options.json, dump(result, 2));
    }
    if (status && !options.csv.empty()) {
        status = writeTextFile(options.csv, toCsv(runs));
    }
    if (status && !options.trace.empty()) {
        status = writeTextFile(options.trace, dump(toTrace(machine, runs), -1));
    }
    if (status && !options.hashes.empty()) {
        std::string text;
        for (const ProfileRun& run : runs) {
            text += "scheme " + run.scheme + "\n" + run.hashes;
        }
        status = writeTextFile(options.hashes, text);
    }
    return status;
}

/// The earlier result of --compare; empty without it.
Result<std::vector<MeasuredRun>> earlierRuns(const ProfileOptions& options) {
    if (options.compare.empty()) {
        return std::vector<MeasuredRun>{};
    }
    std::ifstream file(utf8Path(options.compare));
    if (!file || std::filesystem::is_directory(utf8Path(options.compare))) {
        return Error{ErrorCode::asset, options.compare + ": cannot be read"};
    }
    return measuredRuns(nlohmann::ordered_json::parse(file, nullptr, false), options.compare);
}

/// A gate that has nothing to compare with would always be open.
Status comparedSomething(const ProfileOptions& options, const std::vector<RunChange>& changes) {
    const bool none =
        std::all_of(changes.begin(), changes.end(), [](const RunChange& run) { return run.passes.empty(); });
    if (options.failAbove > 0.0 && none) {
        return Error{ErrorCode::asset,
                     "--fail-above: " + (options.compare.empty() ? options.against : options.compare) +
                         " has none of these runs"};
    }
    return success();
}

/// What of the runs is above the limits of the command line.
std::vector<std::string> aboveLimits(const ProfileOptions& options, std::span<const ProfileRun> runs,
                                     const std::vector<RunChange>& changes) {
    std::vector<std::string> lines;
    if (options.failAbove > 0.0) {
        lines = slowerThan(changes, options.failAbove);
    }
    for (const ProfileRun& run : runs) {
        const double frame = summarizeRun(run).total.gpu.p95;
        if (options.budgetMs > 0.0 && frame > options.budgetMs) {
            char text[128];
            std::snprintf(text, sizeof text, ": 95 %% of frames take up to %.3f ms; the budget is %.3f", frame,
                          options.budgetMs);
            lines.push_back(run.file + ", " + run.scheme + text);
        }
    }
    return lines;
}

void printChanges(const std::vector<RunChange>& changes) {
    for (const RunChange& change : changes) {
        std::printf("\n%s", toTable(change).c_str());
    }
    if (!changes.empty()) {
        std::printf("\n%s\n", verdictOf(changes).c_str());
    }
}

/// Another build and this one in turns.
int profileAgainst(const ProfileOptions& options) {
    const Result<MeasuredPair> pair =
        measureInTurns({options.against, options.rounds, options.frames, options.timeout, options.arguments});
    if (!pair) {
        return fail(pair.error());
    }
    const std::vector<RunChange> changes = compareRuns(pair->before, pair->after);
    printChanges(changes);
    if (const Status some = comparedSomething(options, changes); !some) {
        return fail(some.error());
    }
    if (!options.json.empty()) {
        const Status kept = writeTextFile(options.json, dump({{"comparison", toJson(changes)}}, 2));
        if (!kept) {
            return fail(kept.error());
        }
    }
    const std::vector<std::string> lines = aboveLimits(options, {}, changes);
    for (const std::string& line : lines) {
        fail(kExitGate, line);
    }
    return lines.empty() ? kExitOk : kExitGate;
}

/// Every file, or all in a view, under every scheme that is asked for, with every setting.
Result<std::vector<ProfileRun>> measureAll(Session& session, const ProfileOptions& options, const Machine& machine,
                                           std::span<const host::CharacterFile> files) {
    const bool all = options.surface.scheme == "all";
    std::vector<std::string> names;
    for (const Scheme& scheme : kSchemes) {
        names.emplace_back(scheme.name);
    }
    if (!all) {
        names = {options.surface.scheme};
    }
    std::vector<ProfileRun> runs;
    ProfileOptions setting = options;
    Profiler profiler(session, setting);
    const auto measure = [&](std::span<const host::CharacterFile> some, const std::string& scheme) -> Status {
        Result<ProfileRun> run = profiler.run(some, scheme);
        if (!run) {
            return run.error();
        }
        std::printf("\n%s", toTable(*run, summarizeRun(*run)).c_str());
        std::fflush(stdout);
        runs.push_back(std::move(*run));
        // After every run: a later one's failure loses nothing.
        return options.json.empty() ? success() : writeTextFile(options.json, dump(toJson(machine, runs), 2));
    };
    const size_t together = options.view ? files.size() : 1;
    for (size_t first = 0; first < files.size(); first += together) {
        for (const std::string& scheme : names) {
            for (const ProfileOptions& one : settingsOf(options)) {
                setting = one;
                const Status status = measure(files.subspan(first, together), scheme);
                const bool refused =
                    !status && (status.error().code == ErrorCode::asset || status.error().code == ErrorCode::limit);
                if (refused && all) { // not every scheme takes every cage
                    warn(status.error().message);
                } else if (!status) {
                    return status.error();
                }
            }
        }
    }
    if (runs.empty()) {
        return Error{ErrorCode::asset, "no scheme takes any of the files"};
    }
    return runs;
}

Result<std::vector<ProfileRun>> profile(Session& session, const ProfileOptions& options,
                                        const std::vector<host::CharacterFile>& files,
                                        const std::vector<MeasuredRun>& earlier, std::vector<RunChange>& changes) {
    const Machine machine = describeMachine(*session.device, options.device.mapping);
    std::printf("%s (%s %s), %s mapping, CPU %s\n", machine.device.c_str(), machine.driver.c_str(),
                machine.driverInfo.c_str(), machine.mapping.c_str(), machine.cpu.c_str());
    Result<std::vector<ProfileRun>> runs = measureAll(session, options, machine, files);
    if (!runs) {
        return runs.error();
    }
    if (!options.compare.empty()) {
        const Result<std::vector<MeasuredRun>> measured = measuredRuns(toJson(machine, *runs), "this run");
        if (!measured) {
            return measured.error();
        }
        CompareRules rules;
        rules.floorOfFrames = machine.cpuDevice ? kFloorOnCpu : rules.floorOfFrames;
        changes = compareRuns(earlier, *measured, rules);
        printChanges(changes);
        if (!earlier.empty() && earlier.front().device != machine.device) {
            warn(options.compare + " was measured on another device: " +
                 (earlier.front().device.empty() ? "it does not say which" : earlier.front().device));
        }
        if (machine.cpuDevice) {
            std::printf("On a CPU device two runs can differ by half. Changes below that count for nothing here; "
                        "--against compares two builds in turns.\n");
        }
    }
    Status written = writeForms(options, machine, *runs, changes);
    if (written && !options.html.empty()) {
        written = writeProfilePage(session, options, machine, files, *runs, changes);
    }
    if (!written) {
        return written.error();
    }
    return runs;
}

std::vector<OutputPath> outputsOf(const ProfileOptions& options) {
    return {{"--json", options.json},
            {"--csv", options.csv},
            {"--html", options.html},
            {"--trace", options.trace},
            {"--hashes", options.hashes}};
}

/// What is wrong with the command line, as far as no file has to be read for it.
int checkUsage(const ProfileOptions& options) {
    const std::vector<OutputPath> outputs = outputsOf(options);
    if (const std::string same = sameOutputs(outputs); !same.empty()) {
        return fail(kExitUsage, same);
    }
    if (options.failAbove > 0.0 && options.compare.empty() && options.against.empty()) {
        return fail(kExitUsage, "--fail-above: needs --compare or --against");
    }
    const Status writable = canWrite(outputs);
    return writable ? kExitOk : fail(writable.error());
}

int runProfile(const ProfileOptions& options) {
    if (const int wrong = checkUsage(options); wrong != kExitOk) {
        return wrong;
    }
    if (!options.against.empty()) {
        return profileAgainst(options);
    }
    const Result<std::vector<MeasuredRun>> earlier = earlierRuns(options);
    if (!earlier) {
        return fail(kExitBadInput, earlier.error().message);
    }
    std::vector<host::CharacterFile> files;
    for (const std::string& path : options.files) {
        showProgress("reading " + path);
        Result<host::CharacterFile> file = host::readCharacterFile(path, options.surface.reading);
        if (!file) {
            return fail(kExitBadInput, file.error().message);
        }
        files.push_back(std::move(*file));
    }
    std::vector<std::string> above;
    const int code = withSession(options.device, [&](Session& session) -> Status {
        std::vector<RunChange> changes;
        const Result<std::vector<ProfileRun>> runs = profile(session, options, files, *earlier, changes);
        if (!runs) {
            return runs.error();
        }
        above = aboveLimits(options, *runs, changes);
        return comparedSomething(options, changes);
    });
    if (code != kExitOk) {
        return code;
    }
    for (const OutputPath& output : outputsOf(options)) {
        tellWritten(output.path);
    }
    for (const std::string& line : above) {
        fail(kExitGate, line);
    }
    return above.empty() ? kExitOk : kExitGate;
}

/// A number above 0 that is finite.
std::string whyNoLimit(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool whole = !text.empty() && end == text.c_str() + text.size();
    return whole && std::isfinite(value) && value > 0.0 ? "" : text + " is no number above 0";
}

void bindGates(CLI::App& command, ProfileOptions& options) {
    const auto given = [](const std::string& text) { return std::string(text.empty() ? "no name is given" : ""); };
    command.add_option("--compare", options.compare, "Compare with an earlier --json, pass by pass")
        ->check(given)
        ->type_name("OLD.json");
    CLI::Option* const against =
        command
            .add_option("--against", options.against,
                        "Compare with another build of this command: both are measured in turns")
            ->check(given)
            ->type_name("SUPPLE");
    for (const char* other : {"--compare", "--html", "--csv", "--trace", "--sweep", "--hashes"}) {
        against->excludes(command.get_option(other));
    }
    command.add_option("--rounds", options.rounds, "With --against: how often each is measured, --frames a time")
        ->needs(against)
        ->check(CLI::Range(kLeastRounds, 1000u))
        ->capture_default_str();
    command
        .add_option("--timeout", options.timeout,
                    "With --against: seconds after which a measurement is ended, and the command fails")
        ->needs(against)
        ->check(CLI::Range(1u, 86400u))
        ->capture_default_str();
    command
        .add_option("--fail-above", options.failAbove,
                    "With --compare or --against: end with exit code 4 if a pass or the frame is marked as slower, "
                    "by more than this")
        ->check(whyNoLimit)
        ->type_name("PERCENT");
    command
        .add_option("--budget-ms", options.budgetMs,
                    "End with exit code 4 if more than one frame in twenty takes longer on the device")
        ->check(whyNoLimit)
        ->excludes(against)
        ->type_name("MS");
}

} // namespace

void bindProfile(CLI::App& app, int& exitCode, const std::vector<std::string>& arguments) {
    auto options = std::make_shared<ProfileOptions>();
    options->arguments = arguments;
    CLI::App* command = app.add_subcommand("profile", "What every pass of a frame takes, over many frames");
    command->add_option("FILE", options->files, "glTF, GLB or OBJ, one run each")->required();
    command->add_option("--instances", options->instances, "Instances evaluated together")
        ->check(CLI::Range(1u, 1000000u))
        ->capture_default_str();
    command->add_option("--frames", options->frames, "Frames to measure, after a few to warm up")
        ->check(CLI::Range(1u, 1000000u))
        ->capture_default_str();
    command->add_option("--clip", options->clip, "Clip by name or index; without it the first")
        ->type_name("NAME|INDEX");
    bindMorphs(*command, options->morphs);
    command->add_flag("--motion", options->motion, "Previous positions as well, for motion vectors");
    command->add_flag("--tangent-frames", options->tangents,
                      "Tangents and texture coordinates as well, for normal maps");
    command->add_flag("--playback", options->playback, "Poses on the device, from the group's time alone");
    CLI::Option* view =
        command->add_flag("--view", options->view,
                          "All files together in one view: levels of detail under a budget, a crowd before a "
                          "camera, poses on the device");
    command->add_option("--budget", options->budget, "Surface vertices of the view's frame")
        ->needs(view)
        ->check(CLI::Range(1024u, SUPPLE_MAX_VIEW_VERTICES))
        ->capture_default_str();
    command
        ->add_option(
            "--coefficients", options->coefficients,
            "MiB of patch coefficients that the view's instances share while they are drawn; 0: memory for all")
        ->needs(view)
        ->check(CLI::Range(0u, 4095u))
        ->capture_default_str();
    command
        ->add_option("--keep-unseen", options->keepUnseen,
                     "Frames after which groups that nobody sees give memory back. After the measured frames the "
                     "camera looks away, and the table says what goes back; 0: all stays")
        ->needs(view)
        ->check(CLI::Range(0u, 100000u))
        ->capture_default_str();
    command->add_option("--hashes", options->hashes, "Write hashes of the patches that the view drew last")
        ->needs(view)
        ->type_name("OUT.txt");
    command->add_option("--json", options->json, "Write the figures as JSON, anew after every run")
        ->type_name("OUT.json");
    command->add_option("--csv", options->csv, "Write the figures as CSV, a row a pass")->type_name("OUT.csv");
    command->add_option("--html", options->html, "Write a page with charts, tables and pictures, for any browser")
        ->type_name("OUT.html");
    command
        ->add_option("--sweep", options->sweeps,
                     "Runs for each of these: instances=1,10,100 or rate=4,8,16. May be given again")
        ->check([](const std::string& text) {
            const Result<Sweep> sweep = parseSweep(text);
            return sweep ? std::string() : sweep.error().message;
        })
        ->type_name("NAME=N,N,..");
    command->add_option("--trace", options->trace, "Write every frame as a Chrome trace, for Perfetto")
        ->type_name("OUT.json");
    bindGates(*command, *options);
    bindSurface(*command, options->surface, {"all", "cage"});
    bindDevice(*command, options->device);
    command->callback([options, command, &exitCode] {
        std::vector<std::string> inputs = options->files;
        const std::vector<std::string>& clips = options->surface.reading.clipFiles;
        inputs.insert(inputs.end(), clips.begin(), clips.end());
        inputs.push_back(options->compare);
        checkOutputs(inputs, outputsOf(*options));
        const std::string unused =
            unusedBySweeps(*options, command->count("--rate") > 0, command->count("--instances") > 0);
        exitCode = unused.empty() ? runProfile(*options) : fail(kExitUsage, unused);
    });
}

} // namespace supple::tools
