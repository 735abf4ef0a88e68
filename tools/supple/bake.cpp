// supple bake: the evaluated surface for other programs, as OBJ, PLY or GLB; the patches behind it as JSON.
#include "base/utf8_path.h"
#include "host/whole_file.h"
#include "tools/common/word_hash.h"
#include "tools/gltf/writer.h"
#include "tools/supple/baked_mesh.h"
#include "tools/supple/baked_obj.h"
#include "tools/supple/baked_patches.h"
#include "tools/supple/baked_ply.h"
#include "tools/supple/command.h"
#include "tools/supple/output_files.h"
#include "tools/supple/posed_file.h"
#include "tools/supple/progress.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace supple::tools {
namespace {

constexpr const char* kCageScheme = "cage"; ///< not a surface: the deformed cage itself

struct BakeOptions {
    std::string file;
    std::string output;
    std::string patches;
    std::string basis = "stored"; ///< of the patches
    bool noTangentFrames = false;
    bool hash = false;
    SurfaceFlags surface;
    std::string clip; ///< name or index; empty: the bind pose
    double time = 0.0;
    bool restPose = false; ///< as the nodes of the file stand
    std::vector<host::MorphSetting> morphs;
    ModifierFlags modifiers;
    host::TransitionSetting transition;
    uint32_t updateInterval = 0;
    double simulate = 0.0;
    DeviceFlags device;
};

enum class BakeFormat { obj, ply, glb };

/// By the ending of the file's name, whatever its case.
std::optional<BakeFormat> bakeFormatOf(const std::string& path) {
    std::string ending = utf8Text(utf8Path(path).extension());
    for (char& letter : ending) {
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    return ending == ".obj"   ? std::optional(BakeFormat::obj)
           : ending == ".ply" ? std::optional(BakeFormat::ply)
           : ending == ".glb" ? std::optional(BakeFormat::glb)
                              : std::nullopt;
}

std::string bakeName(const std::string& text) {
    return bakeFormatOf(text) ? "" : text + " does not end in .obj, .ply or .glb";
}

/// With all that the file has a place for.
Result<Evaluation> evaluateForBake(Session& session, SuppleAsset asset, const cage::Character& character,
                                   const BakeOptions& options, const Pose& pose) {
    const std::optional<BakeFormat> format = bakeFormatOf(options.output); // nothing: there is no file
    const bool surface = options.surface.scheme != kCageScheme;
    const bool uvs = format && !character.cage.cornerUvs.empty();
    const bool colors = format && format != BakeFormat::obj && !character.cage.cornerColors.empty();
    uint32_t flags = 0;
    if (surface && (uvs || colors)) {
        flags |= SUPPLE_GROUP_ATTRIBUTES;
    }
    if (!options.patches.empty()) {
        flags |= SUPPLE_GROUP_PATCHES;
    }
    if (surface && uvs && format == BakeFormat::glb && !options.noTangentFrames) {
        flags |= SUPPLE_GROUP_TANGENTS;
    }
    return evaluate(session, asset, character, options.surface, pose, flags);
}

/// PLY and GLB.
Status writeBakedMeshes(const BakeOptions& options, const Evaluation& baked, const cage::Character& character) {
    const bool glb = *bakeFormatOf(options.output) == BakeFormat::glb;
    const BakedContent content{.polygons = !glb, .uvs1 = glb};
    Result<std::vector<BakedMesh>> meshes = options.surface.scheme == kCageScheme
                                                ? bakedCage(baked, character, content)
                                                : bakedSurfaces(baked, character, content);
    if (!meshes) {
        return meshes.error();
    }
    if (!glb) {
        const Result<std::vector<std::byte>> ply = plyOf(*meshes, character);
        return ply ? host::writeWhole(options.output, *ply) : Status(ply.error());
    }
    const Result<cage::GlbFile> file = cage::writeGlb(character, stillMeshes(std::move(*meshes), character));
    if (!file) {
        return file.error();
    }
    for (const std::string& warning : file->warnings) {
        warn(character.name + ": " + warning);
    }
    return host::writeWhole(options.output, file->bytes);
}

/// The joint palette with the morph weights behind it, as SuppleGroupInfo.poses has them, without padding.
Result<std::vector<std::byte>> readPalette(Session& session, SuppleAsset asset, const SuppleGroupInfo& group) {
    SuppleAssetInfo info{};
    info.structSize = sizeof info;
    const Status status =
        session.context->check(suppleGetAssetInfo(session.context->handle(), asset, &info), "suppleGetAssetInfo");
    if (!status) {
        return status.error();
    }
    Result<std::vector<std::byte>> palette = session.device->readBuffer(group.poses);
    if (palette) {
        const size_t joints = info.jointCount;
        const size_t rows = group.skinning == SUPPLE_SKINNING_LINEAR ? 3 * joints : 3 + 4 * joints;
        palette->resize(sizeof(float) * (4 * rows + info.morphTargetCount));
    }
    return palette;
}

void printHash(const char* name, const WordHash& hash) {
    std::printf("%-7s %016llx\n", name, static_cast<unsigned long long>(hash.value()));
}

/// The hashes of what the device wrote for the instance, without padding.
void printHashes(std::span<const std::byte> palette, const Evaluation& baked, bool hasSurface) {
    const SuppleGroupInfo& info = baked.surfaces.front().output.info;
    WordHash ofPalette, ofCage, ofSurface;
    ofPalette.add(palette);
    ofCage.add(std::span(baked.deformedCage).first(size_t{info.cageVertexCount} * info.deformedCage.stride));
    printHash("palette", ofPalette);
    printHash("cage", ofCage);
    if (!hasSurface) {
        return;
    }
    for (const EvaluatedSurface& surface : baked.surfaces) {
        const size_t bytes = size_t{surface.output.grid.vertexCount} * surface.output.streams.vertices.stride;
        ofSurface.add(std::span(surface.vertices).first(bytes));
    }
    printHash("surface", ofSurface);
}

/// Reads what only the hashes need, and prints them.
Status writeHashes(Session& session, SuppleAsset asset, const BakeOptions& options, const Evaluation& baked) {
    const Result<std::vector<std::byte>> palette = readPalette(session, asset, baked.surfaces.front().output.info);
    if (!palette) {
        return palette.error();
    }
    printHashes(*palette, baked, options.surface.scheme != kCageScheme);
    return success();
}

Status writeBaked(const BakeOptions& options, const Evaluation& baked, const cage::Character& character) {
    if (*bakeFormatOf(options.output) != BakeFormat::obj) {
        return writeBakedMeshes(options, baked, character);
    }
    return options.surface.scheme == kCageScheme
               ? writeCageObj(options.output, baked, character.cage)
               : writeObj(options.output, baked, character.parts.size(), options.surface.rate);
}

int runBake(const BakeOptions& options) {
    Result<PosedFile> posed =
        readPosed(options.file, options.surface.reading, options.clip, options.time, options.morphs);
    if (!posed) {
        return fail(kExitBadInput, posed.error().message);
    }
    const host::CharacterFile* const file = &posed->file;
    const Result<std::vector<SuppleScheme>> partSchemes =
        host::partSchemes(options.file, host::partNames(file->character), options.surface.partSchemes);
    if (!partSchemes) {
        return fail(kExitBadInput, partSchemes.error().message);
    }
    const std::string noPatches =
        options.patches.empty() ? "" : whyNoPatches(file->character, options.surface, *partSchemes);
    if (!noPatches.empty()) {
        return fail(kExitUsage, noPatches);
    }
    Result<std::vector<SuppleModifier>> modifiers =
        host::modifiersOf(file->character, options.modifiers.settings, options.modifiers.weight);
    if (!modifiers) {
        return fail(kExitBadInput, modifiers.error().message);
    }
    const Result<std::optional<host::PlannedTransition>> transition = host::planTransition(
        options.transition, [&](const std::string& clip) { return host::findClip(file->character, clip); });
    if (!transition) {
        return fail(kExitBadInput, transition.error().message);
    }
    Pose& pose = posed->pose;
    if (options.restPose) {
        pose.clip = SUPPLE_REST_POSE;
    }
    pose.modifiers = std::move(*modifiers);
    pose.transition = *transition;
    pose.updateInterval = options.updateInterval;
    pose.simulate = options.simulate;
    showProgress("opening the device");
    const int code = withSession(options.device, [&](Session& session) -> Status {
        showProgress("compiling kernels and evaluating; the first time takes longest");
        const Result<SuppleAsset> asset = host::createAsset(*session.context, *file);
        if (!asset) {
            return asset.error();
        }
        const Result<Evaluation> baked = evaluateForBake(session, *asset, file->character, options, pose);
        if (!baked) {
            return baked.error();
        }
        showProgress("writing");
        const PatchBasis basis = options.basis == "bezier" ? PatchBasis::bezier : PatchBasis::stored;
        Status status = checkBasis(*baked, basis);
        if (status && !options.output.empty()) {
            status = writeBaked(options, *baked, file->character);
        }
        if (status && !options.patches.empty()) {
            status = writePatches(options.patches, *baked, basis);
        }
        if (status && options.hash) {
            status = writeHashes(session, *asset, options, *baked);
        }
        return status;
    });
    for (const std::string& path : {options.output, options.patches}) {
        if (code == kExitOk && !path.empty()) {
            tellWritten(path);
        }
    }
    return code;
}

} // namespace

void bindBake(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<BakeOptions>();
    CLI::App* command = app.add_subcommand("bake", "The evaluated surface, for other programs: OBJ, PLY or GLB");
    command->add_option("FILE", options->file, "glTF, GLB or OBJ")->required();
    command
        ->add_option(
            "-o,--output", options->output,
            "File to write. GLB: with materials, for any viewer; PLY: vertices and faces; OBJ: patch by patch, "
            "exactly as the device wrote it")
        ->check(CLI::Validator(bakeName, ""))
        ->type_name("OUT.glb|OUT.ply|OUT.obj");
    command->add_flag("--no-tangent-frames", options->noTangentFrames,
                      "GLB: leave tangents out. Where these jump, neighbouring faces then have vertices in common");
    command->add_option("--patches", options->patches, "JSON of the patches and their coefficients")
        ->type_name("OUT.json");
    command
        ->add_option("--basis", options->basis,
                     "Coefficients of --patches: as the device wrote them, or as tensor products in Bezier form, "
                     "4x4, or 6x6 where p-rep has perturbed a patch")
        ->check(CLI::IsMember({"stored", "bezier"}))
        ->capture_default_str()
        ->needs(command->get_option("--patches"));
    command->add_flag(
        "--hash", options->hash,
        "Print hashes of the words that the device wrote: joint palette and morph weights, deformed cage, "
        "surface vertices. Then no file need be written");
    bindSurface(*command, options->surface, {kCageScheme});
    bindPose(*command, options->clip, options->time);
    command->add_flag("--rest-pose", options->restPose, "The rest pose instead: as the nodes of the file stand")
        ->excludes(command->get_option("--clip"));
    bindMorphs(*command, options->morphs);
    bindModifiers(*command, options->modifiers);
    bindTransition(*command, options->transition);
    command->get_option("--transition")
        ->excludes(command->get_option("--rest-pose"))
        ->needs(command->get_option("--time"));
    command
        ->add_option("--update-interval", options->updateInterval,
                     "What is shown if poses are made every N steps of 1/60 s only, and are straight between these")
        ->check(CLI::IsMember({1, 2, 4, 8}))
        ->type_name("N")
        ->needs(command->get_option("--clip"))
        ->excludes(command->get_option("--transition"));
    bindSimulate(*command, options->simulate);
    command->get_option("--simulate")
        ->excludes(command->get_option("--transition"))
        ->excludes(command->get_option("--update-interval"));
    bindDevice(*command, options->device);
    bindRecord(*command, options->device.record);
    command->callback([options, &exitCode] {
        if (options->output.empty() && !options->hash) {
            throw CLI::RequiredError("--output");
        }
        checkOutputs(inputsOf(options->file, options->surface.reading.clipFiles),
                     {{"--output", options->output}, {"--patches", options->patches}});
        exitCode = runBake(*options);
    });
}

} // namespace supple::tools
