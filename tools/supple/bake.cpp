// supple bake: the evaluated surface exactly as the device wrote it, as an OBJ; the patches behind it as JSON.
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

/// The elements `first` .. `first + count - 1` of the surface's streams.
void writeVertices(TextFile& file, const Evaluation& baked, uint64_t first, uint64_t count) {
    const SuppleBufferRange& view = baked.output.streams.vertices;
    for (uint64_t i = first; i < first + count; ++i) {
        writeVector(file, "v", element<glm::vec3>(baked.surfaceVertices, view, i));
    }
    for (uint64_t i = first; i < first + count; ++i) {
        writeVector(file, "vn", element<glm::vec3>(baked.surfaceVertices, view, i, sizeof(glm::vec3)));
    }
    for (uint64_t i = first; !baked.attributes.empty() && i < first + count; ++i) {
        writeVector(file, "vt", element<glm::vec2>(baked.attributes, baked.output.streams.attributes, i));
    }
}

/// `vertices` of the surface, counted from 0 through the whole file.
void writeFace(TextFile& file, const Evaluation& baked, std::span<const uint64_t> vertices) {
    file.text("f");
    for (const uint64_t vertex : vertices) {
        file.text(" ").number(vertex + 1).text("/"); // OBJ counts from 1
        if (!baked.attributes.empty()) {
            file.number(vertex + 1);
        }
        file.text("/").number(vertex + 1);
    }
    file.text("\n");
}

/// One group per material, over the vertices of the whole mesh.
void writeMesh(TextFile& file, const Evaluation& baked) {
    const SuppleGridOutput& grid = baked.output.grid;
    writeVertices(file, baked, 0, grid.vertexCount);
    for (const SuppleDrawRange& range : std::span(grid.drawRanges, grid.drawRangeCount)) {
        file.text("g material_");
        if (range.material == SUPPLE_NO_MATERIAL) {
            file.text("none\n");
        } else {
            file.number(uint64_t{range.material}).text("\n");
        }
        for (size_t i = range.firstIndex; i < size_t{range.firstIndex} + range.indexCount; i += 3) {
            uint32_t corners[3];
            std::memcpy(corners, baked.gridIndices.data() + i * sizeof(uint32_t), sizeof corners);
            writeFace(file, baked, std::array<uint64_t, 3>{corners[0], corners[1], corners[2]});
        }
    }
}

/// One group per patch, each with its vertices.
void writePatchGrids(TextFile& file, const Evaluation& baked) {
    const SuppleGridOutput& grid = baked.output.grid;
    for (const SuppleDrawRange& range : std::span(grid.drawRanges, grid.drawRangeCount)) {
        const std::vector<std::vector<uint32_t>> faces = gridFaces(range, grid.rate, baked.gridIndices);
        for (uint64_t patch = range.firstPatch; patch < range.firstPatch + range.patchCount; ++patch) {
            const uint64_t samples = range.samplesPerPatch;
            const uint64_t first = range.firstVertex + (patch - range.firstPatch) * samples;
            file.text("g patch_").number(patch).text("\n");
            writeVertices(file, baked, first, samples);
            for (const std::vector<uint32_t>& face : faces) {
                std::vector<uint64_t> vertices;
                for (const uint32_t sample : face) {
                    vertices.push_back(first + sample);
                }
                writeFace(file, baked, vertices);
            }
        }
    }
}

Status writeSurface(const std::string& path, const Evaluation& baked, const std::string& scheme, uint32_t askedRate) {
    const host::GroupOutput& output = baked.output;
    const bool mesh = output.info.tessellation == SUPPLE_TESSELLATION_INDEXED_MESH;
    TextFile file(path);
    file.text("# supple bake: scheme ").text(scheme);
    if (mesh) {
        file.text(", ").number(uint64_t{output.info.patchCount}).text(" triangles\n");
        writeMesh(file, baked);
        return file.close();
    }
    file.text(", rate ").number(uint64_t{output.grid.rate});
    if (output.grid.rate != askedRate) {
        file.text(" (").number(uint64_t{askedRate}).text(" asked for along an edge of the cage)");
    }
    file.text(", ").number(uint64_t{output.info.patchCount}).text(" patches\n");
    writePatchGrids(file, baked);
    return file.close();
}

Status writeCage(const std::string& path, const Evaluation& baked, const cage::Cage& cage) {
    TextFile file(path);
    file.text("# supple bake: deformed cage\n");
    for (uint32_t vertex = 0; vertex < cage.vertexCount(); ++vertex) {
        writeVector(file, "v", element<glm::vec3>(baked.deformedCage, baked.output.info.deformedCage, vertex));
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

Status writePatches(const std::string& path, const Evaluation& baked, const std::string& scheme) {
    const SuppleBufferRange& view = baked.output.info.patchCoefficients;
    TextFile file(path);
    file.text("{\"scheme\":\"").text(scheme).text("\",\"rate\":").number(uint64_t{baked.output.grid.rate});
    file.text(",\"patches\":[");
    for (uint64_t patch = 0; patch < baked.output.info.patchCount; ++patch) {
        const SupplePatchInfo& info = baked.patches[patch];
        file.text(patch == 0 ? "\n" : ",\n").text("{\"face\":").number(uint64_t{info.face});
        file.text(",\"class\":\"")
            .text(surface::className(static_cast<surface::PatchClass>(info.patchClass)))
            .text("\",\"corners\":[");
        for (uint32_t i = 0; i < info.cornerCount; ++i) {
            file.text(i == 0 ? "" : ",").number(uint64_t{info.corners[i]});
        }
        file.text("],\"coefficients\":[");
        // p-rep's always come as 16 g, 16 h; a regular patch's h are zero.
        const uint64_t count = scheme == "prep" ? SUPPLE_PATCH_STRIDE : info.coefficientCount;
        for (uint64_t i = 0; i < count; ++i) {
            const auto value = element<glm::vec3>(baked.coefficients, view, patch * SUPPLE_PATCH_STRIDE + i);
            file.text(i == 0 ? "[" : ",[").number(value.x).text(",").number(value.y).text(",").number(value.z);
            file.text("]");
        }
        file.text("]}");
    }
    file.text("\n]}\n");
    return file.close();
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
        const Result<Evaluation> baked = evaluate(session, *asset, options.surface, pose, groupFlags);
        if (!baked) {
            return baked.error();
        }
        if (cageOnly) {
            return writeCage(options.output, *baked, cage);
        }
        const std::string scheme = resolvedScheme(options.surface.scheme);
        Status status = writeSurface(options.output, *baked, scheme, options.surface.rate);
        if (status && !options.patches.empty()) {
            status = writePatches(options.patches, *baked, scheme);
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
    command->callback([options, &exitCode] {
        if (!options->patches.empty() && !hasCoefficients(options->surface.scheme)) {
            throw CLI::ValidationError("--patches", options->surface.scheme + " has no patch coefficients");
        }
        exitCode = runBake(*options);
    });
}

} // namespace supple::tools
