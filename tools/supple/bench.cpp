// supple bench: the permanent benchmark (tools/bench) as a subcommand.
#include "tools/bench/bench.h"

#include "base/utf8_path.h"
#include "tools/bench/check.h"
#include "tools/bench/papers.h"
#include "tools/bench/plot.h"
#include "tools/bench/report.h"
#include "tools/supple/command.h"
#include "tools/supple/limit_surface.h"
#include "tools/supple/session.h"
#include "tools/supple/text_file.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace supple::tools {
namespace {

using Json = nlohmann::ordered_json;

struct BenchFlags {
    bench::BenchOptions bench;
    DeviceFlags device;
    std::string json, plots, check, from;
    bool driverCache = false, papers = false;
};

Result<Json> readResult(const std::string& path) {
    std::ifstream stream(utf8Path(path), std::ios::binary);
    if (!stream) {
        return Error{ErrorCode::io, path + ": cannot be opened"};
    }
    Json json = Json::parse(stream, nullptr, false);
    if (json.is_discarded()) {
        return Error{ErrorCode::asset, path + ": is no JSON"};
    }
    if (const std::string why = bench::whyNoResult(json); !why.empty()) {
        return Error{ErrorCode::asset, path + ": is no result of supple bench: it " + why};
    }
    return json;
}

Status writePlots(const Json& result, const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(utf8Path(folder), error);
    for (const bench::Picture& picture : bench::plotsOf(result)) {
        Status status = writeTextFile(utf8Text(utf8Path(folder) / utf8Path(picture.fileName)), picture.svg);
        if (!status) {
            return status;
        }
    }
    return success();
}

Status checkable(const BenchFlags& flags, const Json& stored, const std::string& device, const std::string& mapping) {
    const std::string why = bench::whyNoCheck(stored, device, mapping);
    return why.empty() ? success()
                       : Status(Error{ErrorCode::asset, flags.check + ": cannot be checked against: " + why});
}

Status check(const Json& stored, const Json& result) {
    for (const std::string& line : bench::otherSettings(stored, result)) {
        warn(line);
    }
    for (const std::string& line : bench::firstFrames(stored, result)) {
        std::printf("for information: %s\n", line.c_str());
    }
    const std::vector<std::string> regressions = bench::findRegressions(stored, result);
    for (const std::string& line : regressions) {
        std::printf("REGRESSION %s\n", line.c_str());
    }
    if (!regressions.empty()) {
        return Error{ErrorCode::asset,
                     std::to_string(regressions.size()) +
                         " values are worse by more than 15 % or missing, the first: " + regressions.front()};
    }
    std::printf("Nothing is worse by more than 15 %%.\n");
    return success();
}

/// Everything that follows from a result.
Status report(const BenchFlags& flags, const Json* stored, const Json& result) {
    std::printf("%s", bench::toTables(result).c_str());
    Status status = success();
    if (!flags.json.empty()) {
        status = writeTextFile(flags.json, result.dump(2) + "\n");
    }
    if (status && !flags.plots.empty()) {
        status = writePlots(result, flags.plots);
    }
    if (status && stored != nullptr) {
        status = check(*stored, result);
    }
    return status;
}

/// Measures points on surfaces over the cage.
Result<bench::MeasureDistance> limitOf(const cage::Cage& cage) {
    const std::vector<glm::dvec3> positions(cage.positions.begin(), cage.positions.end());
    Result<LimitSurface> built = LimitSurface::build(cage, positions);
    if (!built) {
        return built.error();
    }
    glm::dvec3 low = positions[0], high = low;
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const auto limit = std::make_shared<const LimitSurface>(std::move(*built));
    return bench::MeasureDistance([limit, extent = glm::distance(low, high)](const std::vector<uint32_t>& faces,
                                                                             const std::vector<glm::dvec3>& points) {
        LimitSurface::Probe probe(*limit);
        bench::PaperDistance distance;
        for (size_t i = 0; i < points.size(); ++i) {
            const double own = probe.measure(faces[i], points[i], glm::dvec3(0.0)).distance / extent;
            distance.largest = std::max(distance.largest, own);
            distance.mean += own / static_cast<double>(points.size());
        }
        return distance;
    });
}

int runPapersCommand(const BenchFlags& flags) {
    return withSession(flags.device, [&](Session& session) {
        bench::PapersOptions options;
        options.quick = flags.bench.quick;
        options.mapping = mappingOf(flags.device);
        options.limitOf = limitOf;
        options.progress = [](const std::string& what) { std::fprintf(stderr, "%s\n", what.c_str()); };
        Result<Json> result = bench::runPapers(*session.device, options);
        if (!result) {
            return Status(result.error());
        }
        const Machine machine = describeMachine(*session.device, flags.device.mapping);
        (*result)["device"] = machine.device;
        (*result)["mapping"] = machine.mapping;
        std::printf("%s, %s\n\n%s", machine.device.c_str(), machine.mapping.c_str(),
                    bench::papersText(*result).c_str());
        return flags.json.empty() ? success() : writeTextFile(flags.json, result->dump(2) + "\n");
    });
}

int runBenchCommand(BenchFlags flags) {
    Json stored; // read first: a mistyped name should not cost minutes
    if (!flags.check.empty()) {
        Result<Json> read = readResult(flags.check);
        if (!read) {
            return fail(read.error());
        }
        stored = std::move(*read);
    }
    const Json* const against = flags.check.empty() ? nullptr : &stored;
    if (!flags.from.empty()) {
        const Result<Json> result = readResult(flags.from);
        if (!result) {
            return fail(result.error());
        }
        const Json& machine = (*result)["machine"];
        Status status = against == nullptr
                            ? success()
                            : checkable(flags, stored, machine.value("device", ""), machine.value("mapping", ""));
        if (status) {
            status = report(flags, against, *result);
        }
        return status ? kExitOk : fail(status.error());
    }
    if (!flags.driverCache) {
        bench::disableDriverCaches();
    }
    flags.bench.mapping = mappingOf(flags.device);
    if (!flags.json.empty()) {
        flags.bench.keep = [&flags](const Json& soFar) { return writeTextFile(flags.json, soFar.dump(2) + "\n"); };
    }
    return withSession(flags.device, [&](Session& session) {
        const Machine machine = describeMachine(*session.device, flags.device.mapping);
        Status status = against == nullptr ? success() : checkable(flags, stored, machine.device, machine.mapping);
        if (!status) {
            return status;
        }
        const Result<Json> result = bench::runBench(*session.device, machine, flags.bench);
        return result ? report(flags, against, *result) : Status(result.error());
    });
}

} // namespace

void bindBench(CLI::App& app, int& exitCode) {
    CLI::App* command =
        app.add_subcommand("bench", "What a surface costs beside other libraries and plain loops; regressions");
    auto flags = std::make_shared<BenchFlags>();
    bench::BenchOptions& options = flags->bench;
    bindDevice(*command, flags->device);
    std::vector<std::string> schemeNames;
    for (const Scheme& known : kSchemes) {
        if (known.smooth) {
            schemeNames.emplace_back(known.name);
        }
    }
    command->add_option("FILE", options.files, "Characters to measure as well");
    command->add_option("--cages", options.cages, "Built-in cages to measure, or none")
        ->delimiter(',')
        ->transform([](const std::string& name) { return name == "none" ? std::string() : name; })
        ->check([](const std::string& name) {
            const std::vector<std::string>& known = bench::builtInCages();
            return name.empty() || std::find(known.begin(), known.end(), name) != known.end()
                       ? std::string()
                       : name + " is none of " + CLI::detail::join(known);
        })
        ->capture_default_str();
    command->add_option("--schemes", options.schemes, "Schemes to measure; all that take the cage if left out")
        ->delimiter(',')
        ->check(CLI::IsMember(schemeNames));
    command->add_option("--rates", options.rates, "Tessellation rates")
        ->delimiter(',')
        ->check(CLI::Range(1u, SUPPLE_MAX_RATE))
        ->capture_default_str();
    CLI::Option* rounds = command->add_option("--rounds", options.rounds, "Interleaved rounds")
                              ->check(CLI::Range(1u, 1000u))
                              ->capture_default_str();
    CLI::Option* rates = command->get_option("--rates");
    CLI::Option* quick = command->add_flag("--quick", options.quick, "Rate 8, three short rounds: does it all work?");
    command
        ->add_option("--crowd", options.crowd,
                     "Characters of the crowd, 0: none; if left out 1000 on GPUs and few on CPU devices, where the "
                     "sphere is measured")
        ->check(CLI::Range(0u, 100000u));
    command
        ->add_option("--scene", options.scene,
                     "The most characters of the scene, all different, 0: none; if left out 60, with --quick 3, where "
                     "the sphere is measured")
        ->check(CLI::Range(0u, 10000u));
    command->add_flag_callback(
        "--no-loading", [flags] { flags->bench.loading = false; }, "Leave out loading, static data and pipelines");
    command
        ->add_option("--kernels", options.kernels,
                     "Also measure evaluation by classes of patches, of so many characters, in both mappings and with "
                     "fan records; 0: do not")
        ->check(CLI::Range(0u, 100000u));
    command->add_flag("--driver-cache", flags->driverCache,
                      "Let the driver keep its own cache of shaders on disk, which times of pipelines then include");
    command
        ->add_option("--json", flags->json,
                     "Write the result to this file, and what there is of it after every measurement")
        ->type_name("OUT.json");
    command->add_option("--plots", flags->plots, "Write plots of the result to this folder")->type_name("FOLDER");
    command
        ->add_option("--check", flags->check,
                     "Fail where something is worse by more than 15 % than in this earlier result, or is missing")
        ->type_name("RESULT.json");
    command->add_option("--from", flags->from, "Report on this earlier result instead of measuring")
        ->type_name("RESULT.json");
    command->add_flag("--papers", flags->papers,
                      "Instead: the tables of the papers, on models of the same make, beside what they print; with "
                      "--quick a frame each at N = 5");
    command->callback([flags, rounds, rates, quick, &exitCode] {
        if (flags->papers) {
            exitCode = runPapersCommand(*flags);
            return;
        }
        if (quick->count() > 0) {
            flags->bench.rounds = rounds->count() > 0 ? flags->bench.rounds : 3;
            flags->bench.rates = rates->count() > 0 ? flags->bench.rates : std::vector<uint32_t>{8};
        }
        std::erase(flags->bench.cages, "");
        exitCode = runBenchCommand(*flags);
    });
}

} // namespace supple::tools
