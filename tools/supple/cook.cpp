// supple cook: a character file to a cooked file, which is loaded without parsing or building anything. Needs no
// device.
#include "base/utf8_path.h"
#include "host/whole_file.h"
#include "tools/common/character_file.h"
#include "tools/supple/command.h"
#include "tools/supple/options.h"
#include "tools/supple/output_files.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <supple/supple_prepare.h>
#include <supple/supple_view.h>

namespace supple::tools {
namespace {

namespace fs = std::filesystem;

struct CookOptions {
    std::string file;
    std::string output;
    std::vector<std::string> schemes{"auto"};
    std::vector<uint32_t> rates{8};
    std::vector<std::string> uses{"grids", "levels"};
    std::string mapping = "both";
    ClipPacking packing{1e-4, 0.0};
    SurfaceFlags surface; ///< --skinning; --scheme and --rate are the lists above
};

struct PreparedDeleter {
    void operator()(SupplePrepared_T* prepared) const { suppleDestroyPrepared(prepared); }
};
using PreparedPointer = std::unique_ptr<SupplePrepared_T, PreparedDeleter>;

struct Told {
    std::string error = "out of memory"; ///< of which no message can be made
    bool warns = true;
};
void tell(SuppleSeverity severity, SuppleMessage /*id*/, const char* message, void* user) {
    auto& told = *static_cast<Told*>(user);
    if (severity == SUPPLE_SEVERITY_ERROR) {
        told.error = message;
    } else if (severity == SUPPLE_SEVERITY_WARNING && told.warns) {
        warn(message);
    }
}

/// The groups that are prepared: every scheme at every rate for every use.
class Plan {
public:
    [[nodiscard]] Status fill(const CookOptions& options, const cage::Character& character) {
        for (const std::string& scheme : options.schemes) {
            for (const uint32_t rate : options.rates) {
                for (const std::string& use : options.uses) {
                    SurfaceFlags surface = options.surface;
                    surface.scheme = scheme;
                    surface.rate = rate;
                    if (Status added = add(surface, use, character); !added) {
                        return added;
                    }
                }
            }
        }
        return success();
    }
    [[nodiscard]] const std::vector<SupplePlannedGroup>& groups() const { return planned_; }

private:
    struct Group {
        SuppleGroupDesc desc{};
        SchemeOptions options;
    };
    Status add(const SurfaceFlags& surface, const std::string& use, const cage::Character& character) {
        auto group = std::make_unique<Group>();
        group->desc.structSize = sizeof group->desc;
        if (Status described = describeSurface(surface, character, group->options, group->desc); !described) {
            return described;
        }
        group->desc.scheme = schemeOf(surface.scheme);
        group->desc.rate = surface.rate;
        group->desc.poseSource = SUPPLE_POSES_PLAYBACK;
        const bool inView = use == "levels";
        if (!inView) {
            group->desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS;
            group->desc.flags |= use == "meshes" ? SUPPLE_GROUP_INDEXED_MESH : 0;
        }
        planned_.push_back(
            {&group->desc, inView ? 1u : 0u, inView ? SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_TANGENTS : 0u});
        groups_.push_back(std::move(group));
        return success();
    }

    std::vector<std::unique_ptr<Group>> groups_; ///< what planned_ points to
    std::vector<SupplePlannedGroup> planned_;
};

using Bytes = std::vector<std::byte>;

Result<Bytes> prepare(const SuppleAssetDesc& asset, const Plan& plan, SuppleMapping mapping, const ClipPacking& packing,
                      const std::string& madeBy, bool warns) {
    SupplePrepareDesc desc{};
    desc.structSize = sizeof desc;
    desc.mapping = mapping;
    desc.clipError = static_cast<float>(packing.error);
    desc.coarseClipError = static_cast<float>(packing.coarseError);
    desc.asset = &asset;
    desc.groups = plan.groups().data();
    desc.groupCount = static_cast<uint32_t>(plan.groups().size());
    Told told;
    told.warns = warns;
    desc.log = tell;
    desc.logUser = &told;
    SupplePrepared made = nullptr;
    if (supplePrepare(&desc, &made) != SUPPLE_OK) {
        return Error{ErrorCode::asset, told.error};
    }
    const PreparedPointer prepared(made);
    size_t size = 0;
    if (suppleSavePrepared(made, madeBy.c_str(), nullptr, &size) != SUPPLE_OK) {
        return Error{ErrorCode::hostMemory, told.error};
    }
    Bytes cooked(size);
    if (suppleSavePrepared(made, madeBy.c_str(), cooked.data(), &size) != SUPPLE_OK) {
        return Error{ErrorCode::hostMemory, told.error};
    }
    return cooked;
}

/// For both mappings: what was prepared for one is prepared once more for the other.
Result<Bytes> cook(const host::CharacterFile& file, const Plan& plan, const CookOptions& options,
                   const std::string& madeBy) {
    const host::AssetDescription source(file);
    const bool wide = options.mapping != "narrow";
    Result<Bytes> first =
        prepare(source.desc(), plan, wide ? SUPPLE_MAPPING_WIDE : SUPPLE_MAPPING_NARROW, options.packing, madeBy, true);
    if (!first || options.mapping != "both") {
        return first;
    }
    SuppleAssetDesc cooked{};
    cooked.structSize = sizeof cooked;
    cooked.name = file.path.c_str();
    cooked.bytes = first->data();
    cooked.byteCount = first->size();
    return prepare(cooked, plan, SUPPLE_MAPPING_NARROW, {}, madeBy, false);
}

/// How the file is read, as flags.
std::string readingOf(const host::ReadOptions& reading) {
    std::string line;
    const auto add = [&](bool given, const std::string& flag) { line += given ? " --" + flag : ""; };
    add(reading.pairQuads, "pair-quads");
    add(reading.keepTriangles, "keep-triangles");
    add(reading.creasesFromNormals, "creases-from-normals");
    add(reading.smooth, "smooth");
    add(reading.partsApart, "parts-apart");
    add(reading.verticesApart, "vertices-apart");
    add(reading.strict, "strict");
    add(reading.memoryLimit != 0, "memory-limit " + std::to_string(reading.memoryLimit));
    add(reading.scene.has_value(), "scene " + std::to_string(reading.scene.value_or(0)));
    add(!reading.variant.empty(), "variant " + reading.variant);
    add(!reading.clipFiles.empty(), "clips");
    for (const std::string& clips : reading.clipFiles) {
        line += " " + utf8Text(utf8Path(clips).filename());
    }
    add(reading.retargeting != host::ReadOptions{}.retargeting, "retarget " + reading.retargeting);
    add(!reading.retargetMap.empty(), "retarget-map " + utf8Text(utf8Path(reading.retargetMap).filename()));
    return line;
}

/// The command line, without the folders, which are this machine's.
std::string madeByOf(const CookOptions& options) {
    std::string line = "supple cook " + utf8Text(utf8Path(options.file).filename()) + " -o " +
                       utf8Text(utf8Path(options.output).filename());
    const auto add = [&](const char* flag, const auto& values, auto text) {
        line += std::string(" ") + flag + " ";
        for (size_t i = 0; i < values.size(); ++i) {
            line += (i > 0 ? "," : "") + text(values[i]);
        }
    };
    const auto asIs = [](const std::string& value) { return value; };
    add("--scheme", options.schemes, asIs);
    add("--rate", options.rates, [](uint32_t rate) { return std::to_string(rate); });
    add("--for", options.uses, asIs);
    if (options.surface.skinning != SurfaceFlags().skinning) {
        line += " --skinning " + options.surface.skinning;
    }
    char clipError[80];
    std::snprintf(clipError, sizeof clipError, " --clip-error %g", options.packing.error);
    if (options.packing.coarseError > 0.0) {
        std::snprintf(clipError, sizeof clipError, " --clip-error %g --coarse-clip-error %g", options.packing.error,
                      options.packing.coarseError);
    }
    return line + " --mapping " + options.mapping + clipError + readingOf(options.surface.reading);
}

int runCook(const CookOptions& options) {
    const Result<host::CharacterFile> file = host::readCharacterFile(options.file, options.surface.reading);
    if (!file) {
        return fail(file.error());
    }
    Plan plan;
    if (const Status filled = plan.fill(options, file->character); !filled) {
        return fail(filled.error());
    }
    const Result<Bytes> cooked = cook(*file, plan, options, madeByOf(options));
    if (!cooked) {
        return fail(cooked.error());
    }
    if (const Status written = host::writeWhole(options.output, *cooked); !written) {
        return fail(written.error());
    }
    std::printf("written %s, %zu bytes\n", printable(options.output).c_str(), cooked->size());
    return kExitOk;
}

} // namespace

void bindCook(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<CookOptions>();
    CLI::App* command = app.add_subcommand("cook", "A character file to one that is loaded without building anything");
    command->add_option("FILE", options->file, "glTF, GLB, OBJ or a cooked file")->required();
    command->add_option("-o,--output", options->output, "Cooked file to write")->required()->type_name("OUT.supple");
    std::vector<std::string> names{"auto"};
    for (const Scheme& scheme : kSchemes) {
        names.emplace_back(scheme.name);
    }
    command->add_option("--scheme", options->schemes, "Schemes to build tables of")
        ->delimiter(',')
        ->check(CLI::IsMember(names))
        ->capture_default_str();
    command->add_option("--rate", options->rates, "Tessellation rates, for schemes whose tables depend on them")
        ->delimiter(',')
        ->check(CLI::Range(1u, 64u))
        ->capture_default_str();
    command
        ->add_option("--for", options->uses,
                     "What groups will draw: grids at a rate, levels of detail in a view, indexed meshes")
        ->delimiter(',')
        ->check(CLI::IsMember({"grids", "levels", "meshes"}))
        ->capture_default_str();
    command->add_option("--mapping", options->mapping, "Devices: CPUs are narrow, GPUs wide")
        ->check(CLI::IsMember({"narrow", "wide", "both"}))
        ->capture_default_str();
    bindSkinning(*command, options->surface.skinning);
    bindClipPacking(*command, options->packing);
    bindReading(*command, options->surface.reading);
    command->callback([options, &exitCode] {
        checkOutputs(inputsOf(options->file, options->surface.reading.clipFiles), {{"--output", options->output}});
        exitCode = runCook(*options);
    });
}

} // namespace supple::tools
