// supple bake: the evaluated surface exactly as the device wrote it, as an OBJ; the patches behind it as JSON.
#include "surface/choice.h"
#include "surface/scheme.h"
#include "tools/common/character_file.h"
#include "tools/supple/command.h"
#include "tools/supple/evaluation.h"
#include "tools/supple/text_file.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cstring>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>

namespace supple::tools {
namespace {

constexpr const char* kCageScheme = "cage"; ///< not a surface: the deformed cage itself

struct BakeOptions {
    std::string file;
    std::string output;
    std::string patches;
    SurfaceFlags surface;
    std::string clip; ///< name or index; empty: the bind pose
    double time = 0.0;
    std::vector<host::MorphSetting> morphs;
    DeviceFlags device;
};

template <class Vec>
void writeVector(TextFile& file, std::string_view keyword, const Vec& value) {
    file.text(keyword);
    for (int i = 0; i < Vec::length(); ++i) {
        file.text(" ").number(value[i]);
    }
    file.text("\n");
}

/// The faces of a patch's grid as samples: quads on quads, triangles elsewhere.
std::vector<std::vector<uint32_t>> gridFaces(const SuppleDrawRange& range, uint32_t rate,
                                             const std::vector<std::byte>& indices) {
    std::vector<std::vector<uint32_t>> faces;
    if (range.domain == SUPPLE_DOMAIN_QUAD) {
        const uint32_t row = rate + 1;
        for (uint32_t v = 0; v < rate; ++v) {
            for (uint32_t u = 0; u < rate; ++u) {
                const uint32_t first = v * row + u;
                faces.push_back({first, first + 1, first + row + 1, first + row});
            }
        }
        return faces;
    }
    for (uint32_t i = 0; i < range.indexCount; i += 3) {
        uint16_t corners[3];
        std::memcpy(corners, indices.data() + (size_t{range.firstIndex} + i) * sizeof(uint16_t), sizeof corners);
        faces.push_back({corners[0], corners[1], corners[2]});
    }
    return faces;
}

/// Writes surfaces part by part into one file, which counts vertices through.
class SurfaceWriter {
public:
    SurfaceWriter(TextFile& file, const EvaluatedSurface& surface, uint64_t firstPatch)
        : file_(file), surface_(surface), firstPatch_(firstPatch) {}

    /// What the surface has of a part: a group per patch, of a mesh one per material. `written`: vertices in the file.
    void write(uint32_t part, uint64_t& written);

private:
    [[nodiscard]] bool isMesh() const {
        return surface_.output.surface.tessellation == SUPPLE_TESSELLATION_INDEXED_MESH;
    }
    void writeVertices(uint64_t first, uint64_t count, uint64_t& written);
    void writeFace(std::span<const uint64_t> vertices);
    void writeTriangles(const SuppleDrawRange& range);
    void writePatches(const SuppleDrawRange& range, uint64_t& written);

    TextFile& file_;
    const EvaluatedSurface& surface_;
    uint64_t firstPatch_;                ///< number of its first patch in the file
    std::optional<uint64_t> meshVertex_; ///< of a mesh whose vertices are written: the first
};

void SurfaceWriter::write(uint32_t part, uint64_t& written) {
    const SuppleGridOutput& grid = surface_.output.grid;
    for (const SuppleDrawRange& range : std::span(grid.drawRanges, grid.drawRangeCount)) {
        if (range.part != part) {
            continue;
        }
        if (!isMesh()) {
            writePatches(range, written);
            continue;
        }
        if (!meshVertex_) {
            meshVertex_ = written;
            writeVertices(0, grid.vertexCount, written);
        }
        writeTriangles(range);
    }
}

/// The elements first .. first + count - 1 of the surface's streams.
void SurfaceWriter::writeVertices(uint64_t first, uint64_t count, uint64_t& written) {
    const SuppleVertexStreams& streams = surface_.output.streams;
    for (uint64_t i = first; i < first + count; ++i) {
        writeVector(file_, "v", element<glm::vec3>(surface_.vertices, streams.vertices, i));
    }
    for (uint64_t i = first; i < first + count; ++i) {
        writeVector(file_, "vn", element<glm::vec3>(surface_.vertices, streams.vertices, i, sizeof(glm::vec3)));
    }
    for (uint64_t i = first; !surface_.attributes.empty() && i < first + count; ++i) {
        writeVector(file_, "vt", element<glm::vec2>(surface_.attributes, streams.attributes, i));
    }
    written += count;
}

/// `vertices`, counted from 0 through the whole file.
void SurfaceWriter::writeFace(std::span<const uint64_t> vertices) {
    file_.text("f");
    for (const uint64_t vertex : vertices) {
        file_.text(" ").number(vertex + 1).text("/"); // OBJ counts from 1
        if (!surface_.attributes.empty()) {
            file_.number(vertex + 1);
        }
        file_.text("/").number(vertex + 1);
    }
    file_.text("\n");
}

void SurfaceWriter::writeTriangles(const SuppleDrawRange& range) {
    file_.text("g material_");
    if (range.material == SUPPLE_NO_MATERIAL) {
        file_.text("none\n");
    } else {
        file_.number(uint64_t{range.material}).text("\n");
    }
    for (size_t i = range.firstIndex; i < size_t{range.firstIndex} + range.indexCount; i += 3) {
        uint32_t corners[3];
        std::memcpy(corners, surface_.gridIndices.data() + i * sizeof(uint32_t), sizeof corners);
        writeFace(
            std::array<uint64_t, 3>{*meshVertex_ + corners[0], *meshVertex_ + corners[1], *meshVertex_ + corners[2]});
    }
}

/// Each with its vertices.
void SurfaceWriter::writePatches(const SuppleDrawRange& range, uint64_t& written) {
    const std::vector<std::vector<uint32_t>> faces = gridFaces(range, surface_.output.grid.rate, surface_.gridIndices);
    for (uint64_t patch = range.firstPatch; patch < range.firstPatch + range.patchCount; ++patch) {
        const uint64_t samples = range.samplesPerPatch, first = written;
        file_.text("g patch_").number(firstPatch_ + patch).text("\n");
        writeVertices(range.firstVertex + (patch - range.firstPatch) * samples, samples, written);
        for (const std::vector<uint32_t>& face : faces) {
            std::vector<uint64_t> vertices;
            for (const uint32_t sample : face) {
                vertices.push_back(first + sample);
            }
            writeFace(vertices);
        }
    }
}

/// "scheme pm, rate 4, 8 patches"
void writeSummary(TextFile& file, const host::GroupOutput& output, uint32_t askedRate) {
    file.text("# supple bake: scheme ").text(schemeName(output.surface.scheme));
    if (output.surface.tessellation == SUPPLE_TESSELLATION_INDEXED_MESH) {
        file.text(", ").number(uint64_t{output.surface.patchCount}).text(" triangles\n");
        return;
    }
    file.text(", rate ").number(uint64_t{output.grid.rate});
    if (output.grid.rate != askedRate) {
        file.text(" (").number(uint64_t{askedRate}).text(" asked for along an edge of the cage)");
    }
    file.text(", ").number(uint64_t{output.surface.patchCount}).text(" patches\n");
}

/// Parts follow each other as the character has them. Patches are numbered surface by surface.
Status writeSurfaces(const std::string& path, const Evaluation& baked, size_t partCount, uint32_t askedRate) {
    TextFile file(path);
    std::vector<SurfaceWriter> writers;
    uint64_t patches = 0, written = 0;
    for (const EvaluatedSurface& surface : baked.surfaces) {
        writeSummary(file, surface.output, askedRate);
        writers.emplace_back(file, surface, patches);
        patches += surface.output.surface.patchCount;
    }
    for (uint32_t part = 0; part < partCount; ++part) {
        for (SurfaceWriter& writer : writers) {
            writer.write(part, written);
        }
    }
    return file.close();
}

Status writeCage(const std::string& path, const Evaluation& baked, const cage::Cage& cage) {
    TextFile file(path);
    file.text("# supple bake: deformed cage\n");
    const SuppleBufferRange& view = baked.surfaces.front().output.info.deformedCage;
    for (uint32_t vertex = 0; vertex < cage.vertexCount(); ++vertex) {
        writeVector(file, "v", element<glm::vec3>(baked.deformedCage, view, vertex));
    }
    for (const glm::vec2& uv : cage.cornerUvs) {
        writeVector(file, "vt", uv);
    }
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        file.text("f");
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            file.text(" ").number(uint64_t{cage.faceVertices[corner]} + 1);
            if (!cage.cornerUvs.empty()) {
                file.text("/").number(uint64_t{corner} + 1);
            }
        }
        file.text("\n");
    }
    return file.close();
}

void writePatch(TextFile& file, const EvaluatedSurface& surface, uint64_t patch) {
    const SupplePatchInfo& info = surface.patches[patch];
    file.text("{\"face\":").number(uint64_t{info.face});
    file.text(",\"class\":\"")
        .text(surface::className(static_cast<surface::PatchClass>(info.patchClass)))
        .text("\",\"corners\":[");
    for (uint32_t i = 0; i < info.cornerCount; ++i) {
        file.text(i == 0 ? "" : ",").number(uint64_t{info.corners[i]});
    }
    file.text("],\"coefficients\":[");
    // p-rep's always come as 16 g, 16 h; a regular patch's h are zero.
    const host::GroupOutput& output = surface.output;
    const uint64_t count = output.surface.scheme == SUPPLE_SCHEME_PREP ? SUPPLE_PATCH_STRIDE : info.coefficientCount;
    for (uint64_t i = 0; i < count; ++i) {
        const auto value =
            element<glm::vec3>(surface.coefficients, output.surface.patchCoefficients, patch * SUPPLE_PATCH_STRIDE + i);
        file.text(i == 0 ? "[" : ",[").number(value.x).text(",").number(value.y).text(",").number(value.z);
        file.text("]");
    }
    file.text("]}");
}

Status writePatches(const std::string& path, const Evaluation& baked) {
    std::string schemes;
    for (const EvaluatedSurface& surface : baked.surfaces) {
        schemes += (schemes.empty() ? "" : "+") + std::string(schemeName(surface.output.surface.scheme));
    }
    TextFile file(path);
    file.text("{\"scheme\":\"").text(schemes).text("\",\"rate\":");
    file.number(uint64_t{baked.surfaces.front().output.grid.rate}).text(",\"patches\":[");
    const char* separator = "\n";
    for (const EvaluatedSurface& surface : baked.surfaces) {
        for (uint64_t patch = 0; patch < surface.output.surface.patchCount; ++patch) {
            file.text(separator);
            writePatch(file, surface, patch);
            separator = ",\n";
        }
    }
    file.text("\n]}\n");
    return file.close();
}

/// Why --patches cannot be, or empty: which part has a scheme without coefficients.
std::string whyNoPatches(const cage::Character& character, const SurfaceFlags& flags,
                         const std::vector<SuppleScheme>& partSchemes) {
    const SuppleScheme named = schemeOf(flags.scheme);
    if (partSchemes.empty() && named != SUPPLE_SCHEME_AUTO) {
        return hasCoefficients(named) ? "" : "--patches: " + flags.scheme + " has no patch coefficients";
    }
    const std::vector<surface::SchemeChoice> choices = surface::chooseSchemes(character);
    for (size_t part = 0; part < choices.size(); ++part) {
        SuppleScheme scheme = partSchemes.empty() ? SUPPLE_SCHEME_AUTO : partSchemes[part];
        scheme = scheme == SUPPLE_SCHEME_AUTO ? named : scheme;
        scheme = scheme == SUPPLE_SCHEME_AUTO ? static_cast<SuppleScheme>(choices[part].scheme) : scheme;
        if (!hasCoefficients(scheme)) {
            return "--patches: part " + std::to_string(part) + " has scheme " + schemeName(scheme) +
                   ", which has no patch coefficients";
        }
    }
    return {};
}

int runBake(const BakeOptions& options) {
    const Result<host::CharacterFile> file = host::readCharacterFile(options.file, options.surface.reading);
    if (!file) {
        return fail(kExitBadInput, file.error().message);
    }
    const Result<uint32_t> clip = host::findClip(file->character, options.clip);
    if (!clip) {
        return fail(kExitBadInput, clip.error().message);
    }
    Result<std::vector<float>> weights = host::morphWeights(file->character, options.morphs);
    if (!weights) {
        return fail(kExitBadInput, weights.error().message);
    }
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
    const Pose pose{*clip, options.time, std::move(*weights)};
    const cage::Cage& cage = file->character.cage;
    const bool cageOnly = options.surface.scheme == kCageScheme;
    const bool uvs = !cageOnly && !cage.cornerUvs.empty();
    uint32_t groupFlags = 0;
    if (uvs) {
        groupFlags |= SUPPLE_GROUP_ATTRIBUTES;
    }
    if (!options.patches.empty()) {
        groupFlags |= SUPPLE_GROUP_PATCHES;
    }

    return withSession(options.device, [&](Session& session) -> Status {
        const Result<SuppleAsset> asset = host::createAsset(*session.context, *file);
        if (!asset) {
            return asset.error();
        }
        const Result<Evaluation> baked = evaluate(session, *asset, file->character, options.surface, pose, groupFlags);
        if (!baked) {
            return baked.error();
        }
        if (cageOnly) {
            return writeCage(options.output, *baked, cage);
        }
        Status status = writeSurfaces(options.output, *baked, file->character.parts.size(), options.surface.rate);
        if (status && !options.patches.empty()) {
            status = writePatches(options.patches, *baked);
        }
        return status;
    });
}

} // namespace

void bindBake(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<BakeOptions>();
    CLI::App* command = app.add_subcommand("bake", "The evaluated surface exactly as the device wrote it, as an OBJ");
    command->add_option("FILE", options->file, "glTF, GLB or OBJ")->required();
    command->add_option("-o,--output", options->output, "OBJ to write")->required()->type_name("OUT.obj");
    command->add_option("--patches", options->patches, "JSON of the patches and their coefficients")
        ->type_name("OUT.json");
    bindSurface(*command, options->surface, {kCageScheme});
    bindPose(*command, options->clip, options->time);
    bindMorphs(*command, options->morphs);
    bindDevice(*command, options->device);
    command->callback([options, &exitCode] { exitCode = runBake(*options); });
}

} // namespace supple::tools
