// supple convert: any character file to a GLB that keeps its polygons, creases and seams. Needs no device.
#include "base/utf8_path.h"
#include "cage/normal_creases.h"
#include "host/whole_file.h"
#include "tools/common/character_file.h"
#include "tools/gltf/writer.h"
#include "tools/supple/command.h"
#include "tools/supple/options.h"
#include "tools/supple/output_files.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

namespace supple::tools {
namespace {

namespace fs = std::filesystem;

struct ConvertOptions {
    std::string file;
    std::string output;
    std::optional<double> creaseAngle; ///< degrees
    host::ReadOptions reading;
};

/// Cage vertices whose corners do not agree in texture coordinates or color.
size_t seamVertexCount(const cage::Cage& cage) {
    using Values = std::array<float, 8>;
    std::vector<const Values*> first(cage.vertexCount(), nullptr);
    std::vector<Values> corners(cage.cornerCount(), Values{});
    std::vector<uint8_t> seam(cage.vertexCount(), 0);
    for (uint32_t corner = 0; corner < cage.cornerCount(); ++corner) {
        Values& values = corners[corner];
        const auto put = [&](const auto& list, size_t at) {
            for (int k = 0; !list.empty() && k < list[corner].length(); ++k) {
                values[at + static_cast<size_t>(k)] = list[corner][k];
            }
        };
        put(cage.cornerUvs, 0);
        put(cage.cornerUvs1, 2);
        put(cage.cornerColors, 4);
        const uint32_t vertex = cage.faceVertices[corner];
        first[vertex] = first[vertex] == nullptr ? &values : first[vertex];
        seam[vertex] = seam[vertex] != 0 || *first[vertex] != values ? 1 : 0;
    }
    return static_cast<size_t>(std::count(seam.begin(), seam.end(), 1));
}

void report(const ConvertOptions& options, const cage::Character& character, const cage::GlbFile& glb) {
    const cage::Cage& cage = character.cage;
    std::map<uint32_t, uint32_t> sides;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        ++sides[cage.sides(face)];
    }
    std::string bySides;
    for (const auto& [count, faces] : sides) {
        bySides += (bySides.empty() ? "" : ", ") + std::to_string(count) + ": " + std::to_string(faces);
    }
    const auto line = [](const char* label, const std::string& text) {
        std::printf("%-18s %s\n", label, printable(text).c_str());
    };
    line("written", options.output + ", " + std::to_string(glb.bytes.size()) + " bytes");
    line("polygons from", cage::polygonSourceName(character.parts[0].polygonSource));
    line("faces", std::to_string(cage.faceCount()));
    line("  by sides", bySides);
    line("vertices", std::to_string(cage.vertexCount()) + " (" + std::to_string(glb.vertexCount) + " in the GLB)");
    line("seams", std::to_string(seamVertexCount(cage)) + " vertices");
    const auto hard = std::count_if(cage.creases.begin(), cage.creases.end(), [](const cage::Crease& crease) {
        return crease.sharpness >= cage::kHardSharpness;
    });
    line("creases", std::to_string(cage.creases.size()) + " edges, " + std::to_string(hard) + " of them hard; " +
                        std::to_string(cage.sharpVertices.size()) + " sharp vertices; " +
                        std::to_string(cage.holes.size()) + " holes" +
                        (cage.creaseScalars.empty()
                             ? ""
                             : "; " + std::to_string(cage.creaseScalars.size()) + " crease scalars of P_m"));
    line("joints", std::to_string(character.skin.joints.size()));
    line("clips", std::to_string(character.clips.size()));
    line("morph targets", std::to_string(character.morphs.targets.size()));
    line("materials", std::to_string(character.materials.size()));
    for (const auto* warnings : {&character.warnings, &glb.warnings}) {
        for (const std::string& warning : *warnings) {
            warn(options.file + ": " + warning);
        }
    }
}

int runConvert(const ConvertOptions& options) {
    Result<host::CharacterFile> file = host::readCharacterFile(options.file, options.reading);
    if (!file) {
        return fail(file.error());
    }
    if (options.creaseAngle) {
        cage::creaseAngles(file->character.cage, *options.creaseAngle);
    }
    const Result<cage::GlbFile> glb = cage::writeGlb(file->character);
    if (!glb) {
        return fail(glb.error());
    }
    const Status written = host::writeWhole(options.output, glb->bytes);
    if (!written) {
        return fail(written.error());
    }
    report(options, file->character, *glb);
    return kExitOk;
}

std::string glbName(const std::string& text) {
    return utf8Path(text).extension() == ".glb" ? "" : text + " does not end in .glb";
}

} // namespace

void bindConvert(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<ConvertOptions>();
    CLI::App* command =
        app.add_subcommand("convert", "A character file to a GLB that keeps polygons, creases and seams");
    command->add_option("FILE", options->file, "glTF, GLB or OBJ")->required();
    command->add_option("-o,--output", options->output, "GLB to write")
        ->required()
        ->check(CLI::Validator(glbName, ""))
        ->type_name("OUT.glb");
    bindReading(*command, options->reading);
    command
        ->add_option("--creases-from-angle", options->creaseAngle,
                     "Make edges hard creases where their two faces meet at more than so many degrees")
        ->check(CLI::Range(0.0, 180.0))
        ->type_name("DEGREES");
    command->callback([options, &exitCode] {
        checkOutputs(inputsOf(options->file, options->reading.clipFiles), {{"--output", options->output}});
        exitCode = runConvert(*options);
    });
}

} // namespace supple::tools
